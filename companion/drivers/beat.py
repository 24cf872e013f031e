"""When the next tick is due: periods apart, and soon after the vehicle has told its position.

A vehicle that tells its position at our own rate tells it at any moment of our period. Left to chance, a setpoint would
leave up to a whole period after the position it was computed with. So the beat is shifted, by at most
`MOST_SHIFT` of a period each time, until a position comes `LEAD_NS` before the tick that takes it: two oscillators,
one of which follows. The lead is what the sender's own jitter needs; setpoints still leave evenly.
"""

LEAD_NS = 3_500_000
"""Between a position's arrival and the tick that takes it."""
GAIN, MOST_SHIFT = 0.1, 0.0125
"""Part of the error that a tick makes up for; and of a period, at most: 0.25 ms of 20 ms."""
LOCAL_POSITION_NED = 32
SIGNED = 0x01
"""Bit of MAVLink 2's incompat_flags: 13 bytes of signature follow."""


class Beat:
    """The deadlines of a driver's ticks.

    Parameters
    ----------
    now_ns, period_ns : when it begins, and the time between two ticks.

    Attributes
    ----------
    deadline_ns : of the tick to come.
    missed : periods without a tick, since the one before took too long; they stay missed.
    """

    def __init__(self, now_ns: int, period_ns: int) -> None:
        self.deadline_ns = now_ns + period_ns
        self.missed = 0
        self._heard_ns: int | None = None

    def heard(self, received_ns: int) -> None:
        """A position came at `received_ns`, to be taken by the tick to come."""
        self._heard_ns = received_ns

    def next(self, now_ns: int, period_ns: int) -> None:
        """The tick is over: when is the next one?"""
        shift_ns = 0
        if self._heard_ns is not None:
            off_ns = self.deadline_ns - self._heard_ns - LEAD_NS
            off_ns -= period_ns * round(off_ns / period_ns)  # to the nearest beat
            most_ns = MOST_SHIFT * period_ns
            shift_ns = round(max(-most_ns, min(most_ns, GAIN * off_ns)))
            self._heard_ns = None
        self.deadline_ns += period_ns - shift_ns
        behind = (now_ns - self.deadline_ns) // period_ns
        if behind > 0:
            self.missed += behind
            self.deadline_ns += behind * period_ns


def tells_position(data: bytes) -> bool:
    """Whether one of the packets in a datagram is a LOCAL_POSITION_NED, by their headers alone."""
    at = 0
    while at + 10 <= len(data):
        if data[at] == 0xFD:
            if data[at + 7] == LOCAL_POSITION_NED and not data[at + 8] and not data[at + 9]:
                return True
            at += data[at + 1] + 12 + 13 * (data[at + 2] & SIGNED)
        elif data[at] == 0xFE:
            if data[at + 5] == LOCAL_POSITION_NED:
                return True
            at += data[at + 1] + 8
        else:
            return False
    return False
