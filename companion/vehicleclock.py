"""The flight's clock: ours, at the vehicle's pace.

A simulator may run faster or slower than the wall, and a real one drifts a little. What is flown must take the
vehicle's time, not ours: a reference that runs at another pace asks for other speeds than it says. The pace is read
from the time since boot in the vehicle's messages. A message is late by what the link took, never early, so of each
bucket the one with the greatest (time since boot - our time) counts, and the pace is the slope over some seconds:

    rate = 1 + (offset_b - offset_a) / (t_b - t_a)

Within `DEAD_BAND` of 1 it is 1, so that a vehicle in step with us has exactly our time. The flight's clock starts at
ours and never jumps or runs backwards; in the air its rate changes by `SLEW` at most.
"""

from collections import deque

BUCKET_US = 500_000
BUCKETS = 17
FEWEST = 5
"""Messages in a bucket that make it worth a look."""
SHORTEST_US = 1_500_000
"""No slope over less than this."""
DEAD_BAND = 0.003
JITTER_US = 10_000
"""What the least delay of a bucket may differ by from one to another."""
SLEW = 0.05
"""Of the rate, a second."""
SLOWEST, FASTEST = 0.1, 10.0


class VehicleClock:
    """Attributes
    ----------
    rate : the vehicle's seconds for one of ours.
    """

    def __init__(self) -> None:
        self.rate = 1.0
        self._slope: float | None = None  # as of the newest bucket
        self._best: deque[tuple[int, int]] = deque(maxlen=BUCKETS)  # (our time, time since boot less ours) [us]
        self._bucket: tuple[int, int] | None = None
        self._bucket_end_us = 0
        self._count = 0
        self._now_us: int | None = None
        self._flight_us = 0

    @property
    def known(self) -> bool:
        """Whether the rate has been measured."""
        return self._slope is not None

    def heard(self, now_us: int, boot_ms: int) -> None:
        """A time since boot that came just now; packets that came late or twice must not get here."""
        if now_us >= self._bucket_end_us:
            if self._bucket is not None and self._count >= FEWEST:
                self._best.append(self._bucket)
                self._slope = self._measured()
            self._bucket, self._count, self._bucket_end_us = None, 0, now_us + BUCKET_US
        offset = boot_ms * 1000 - now_us
        self._count += 1
        if self._bucket is None or offset > self._bucket[1]:
            self._bucket = (now_us, offset)

    def forget(self) -> None:
        """The vehicle booted again: its time before that says nothing any more. The rate stays."""
        self._best.clear()
        self._slope = None
        self._bucket, self._count = None, 0

    def at(self, now_us: int, slowly: bool) -> int:
        """The flight's time [us]; asked once a tick, `slowly` while something is flown by it."""
        if self._now_us is None:
            self._now_us = self._flight_us = now_us
        gone_us = now_us - self._now_us
        wanted = self._slope
        if wanted is not None and wanted != self.rate:
            most = SLEW * gone_us * 1e-6 if slowly else float("inf")
            self.rate += min(max(wanted - self.rate, -most), most)
        self._flight_us += gone_us if self.rate == 1.0 else round(gone_us * self.rate)
        self._now_us = now_us
        return self._flight_us

    def _measured(self) -> float | None:
        """The slope over the seconds kept; None when they are too few."""
        if len(self._best) < 2:
            return None
        (a_us, a), (b_us, b) = self._best[0], self._best[-1]
        span_us = b_us - a_us
        if span_us < SHORTEST_US:
            return None
        slope = (b - a) / span_us
        if abs(slope) <= max(DEAD_BAND, JITTER_US / span_us):
            return 1.0
        return min(max(1.0 + slope, SLOWEST), FASTEST)
