"""The other vehicles, as movers that the replanner flies round.

Each is where its trajectory says it is now, or goes on as it last said; a ball of its hull's radius. Whom we mind:

    a lower number                      has the right of way
    one that does not yield             holds, lands, or cannot plan: it goes on as it does
    anybody nearer than `NEAR`          whoever was right

Of a vehicle that falls silent the ball grows by `UNSURE` a second from `SILENT_US` on; after `GONE_US` it is forgotten,
and that is said. Clocks need not agree: the shortest time that any of the last datagrams took is the difference.
"""

import math
from collections import deque
from dataclasses import dataclass, field

from companion.fleet.exchange import FARTHEST, Shared, unpack
from companion.geodesy import Geodetic, to_local
from companion.seam import FloatArray, Level, Note, Vector
from companion.seeing.tracks import Tracks

NEAR = 1.5
"""Between centres [m]."""
SILENT_US, GONE_US = 500_000, 3_000_000
UNSURE = 1.0
MOST = 64
TRACKED = 0x1000000
"""Added to a number it is a track's address, beyond those of ADSB_VEHICLE (24 bits)."""
DELAYS = 32
LATE_START = 2**31
"""Sequence numbers that seem so far ahead are behind: the sender has started again."""


@dataclass(slots=True)
class _Other:
    shared: Shared
    heard_us: int
    delays: deque[int] = field(default_factory=lambda: deque(maxlen=DELAYS))  # arrival less stamp
    shift: Vector = (0.0, 0.0, 0.0)  # of its mission frame in ours

    def at(self, now_us: int) -> tuple[Vector, Vector]:
        """Its place and velocity in our mission frame."""
        s = self.shared
        theirs_us = now_us - min(self.delays)
        if s.flown is not None:
            seconds = (theirs_us - s.flown.start_us) / 1e6
            state = s.flown.trajectory.state(min(max(seconds, 0.0), s.flown.trajectory.duration))
            moving = 0.0 <= seconds < s.flown.trajectory.duration
            place = [float(p) for p in state.position]
            going = _vector(state.velocity) if moving else (0.0, 0.0, 0.0)
        else:
            age = min(max((theirs_us - s.stamp_us) / 1e6, 0.0), 1.0)
            place, going = [p + v * age for p, v in zip(s.position_m, s.velocity, strict=True)], s.velocity
        x, y, z = (p + d for p, d in zip(place, self.shift, strict=True))
        return (x, y, z), going


def _vector(values: FloatArray) -> Vector:
    return (float(values[0]), float(values[1]), float(values[2]))


class Others:
    """Whom we have heard of.

    Parameters
    ----------
    number : ours.
    frame, origin : of our mission, as in `Shared`.

    Attributes
    ----------
    bad : datagrams that were none, or ours.
    """

    def __init__(self, number: int, frame: int, origin: Geodetic | None) -> None:
        self.bad = 0
        self._number, self._frame, self._origin = number, frame, origin
        self._others: dict[int, _Other] = {}
        self._elsewhere: set[int] = set()
        self._said: list[Note] = []

    def take(self, now_us: int, data: bytes) -> None:
        """A datagram of another companion."""
        shared = unpack(data)
        if shared is None or shared.sender == self._number:
            self.bad += 1
            if shared is not None and self._number not in self._elsewhere:
                self._elsewhere.add(self._number)
                self._tell(Level.ERROR, f"another companion also calls itself vehicle {self._number}")
            return
        shift = self._shift(shared)
        if shift is None:
            if shared.sender not in self._elsewhere:
                self._elsewhere.add(shared.sender)
                self._tell(
                    Level.WARNING,
                    f"vehicle {shared.sender} does not say where near us on the earth it flies: not minded",
                )
            return
        other = self._others.get(shared.sender)
        if other is None:
            if len(self._others) >= MOST:
                return
            other = self._others[shared.sender] = _Other(shared, now_us)
            self._tell(Level.INFO, f"vehicle {shared.sender} is heard")
        elif (shared.sequence - other.shared.sequence) % 2**32 > LATE_START and shared.sequence > 1:
            return  # an older one, overtaken
        other.shared, other.heard_us, other.shift = shared, now_us, shift
        other.delays.append(now_us - shared.stamp_us)

    def step(self, now_us: int, flight_us: int, here: FloatArray, tracks: Tracks) -> None:
        """Put whom we mind among the tracks, and take the others from it.

        Parameters
        ----------
        here : (3,) where we are, in our mission frame.
        """
        for number, other in list(self._others.items()):
            silent_us = now_us - other.heard_us
            if silent_us > GONE_US:
                del self._others[number]
                tracks.drop(TRACKED + number)
                self._tell(Level.WARNING, f"vehicle {number} is not heard any more")
                continue
            place, going = other.at(now_us)
            near = math.dist(place, here) < NEAR
            if number < self._number or near or not other.shared.yields:
                unsure = UNSURE * max(0, silent_us - SILENT_US) / 1e6
                tracks.told(flight_us, TRACKED + number, place, going, other.shared.radius + unsure)
            else:
                tracks.drop(TRACKED + number)

    def places(self, now_us: int) -> dict[int, Vector]:
        """Everybody's place in our mission frame, by number."""
        return {number: other.at(now_us)[0] for number, other in sorted(self._others.items())}

    def take_said(self) -> list[Note]:
        """What people should know; each is told once."""
        said, self._said = self._said, []
        return said

    def _shift(self, shared: Shared) -> Vector | None:
        """Where the sender's mission frame is in ours; None: that cannot be known."""
        if shared.frame == self._frame:
            return (0.0, 0.0, 0.0)
        if shared.origin is None or self._origin is None:
            return None
        north, east = to_local(self._origin, shared.origin.latitude, shared.origin.longitude)
        shift = (north, east, self._origin.altitude - shared.origin.altitude)
        return shift if max(map(abs, shift)) <= FARTHEST else None

    def _tell(self, level: Level, text: str) -> None:
        if len(self._said) < 8:
            self._said.append(Note(level, text))
