"""What moves around the vehicle, as it tells of itself: ADSB_VEHICLE, one track an address.

Each is predicted to go on as it said, as a ball that grows by what it may do otherwise (`GROWTH`), and forgotten when
it has been silent for `SILENCE_S`.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from companion.seam import FloatArray, Vector
from planner import MovingSphere

GROWTH = 0.4
"""How fast what a mover may do spreads [m/s]; `benchmarks/bench_replan.py` has what was measured with it."""
SILENCE_S = 3.0
MOST_TRACKS = 64
NEAR = 0.3
"""Hits this near to a mover's ball are of the mover [m]."""


@dataclass(slots=True)
class Track:
    position_m: Vector
    velocity: Vector
    radius: float
    seen_us: int


class Tracks:
    """At most `MOST_TRACKS` movers; the one unheard for longest makes room."""

    def __init__(self) -> None:
        self._tracks: dict[int, Track] = {}
        self.version = 0

    def told(self, flight_us: int, address: int, position_m: Vector, velocity: Vector, radius: float) -> None:
        """A mover says where it is, in the mission frame [m], [m/s]."""
        if address not in self._tracks and len(self._tracks) >= MOST_TRACKS:
            del self._tracks[min(self._tracks, key=lambda other: (self._tracks[other].seen_us, other))]
        self._tracks[address] = Track(position_m, velocity, radius, flight_us)
        self.version += 1

    def drop(self, address: int) -> None:
        """Somebody who need not be minded any more."""
        self.version += self._tracks.pop(address, None) is not None

    def forget(self, flight_us: int) -> None:
        """Drop who is silent."""
        gone = [a for a, track in self._tracks.items() if flight_us - track.seen_us > SILENCE_S * 1e6]
        for address in gone:
            del self._tracks[address]
        self.version += len(gone) > 0

    def movers(self) -> tuple[MovingSphere, ...]:
        """As the planner takes them, by address; stamps in seconds of the flight clock."""
        return tuple(
            MovingSphere(t.position_m, t.velocity, t.radius, GROWTH, t.seen_us / 1e6)
            for _, t in sorted(self._tracks.items())
        )

    def near(self, flight_us: int, points: FloatArray, below: int = 1 << 32) -> NDArray[np.bool_]:
        """Which of points (m, 3) may be of a mover whose address is below a number."""
        mine = np.zeros(len(points), dtype=np.bool_)
        for address, track in self._tracks.items():
            if address >= below:
                continue
            age = (flight_us - track.seen_us) / 1e6
            centre = [p + v * age for p, v in zip(track.position_m, track.velocity, strict=True)]
            mine |= ((points - centre) ** 2).sum(axis=1) <= (track.radius + NEAR + GROWTH * age) ** 2
        return mine

    def __len__(self) -> int:
        return len(self._tracks)
