"""A look ahead on what is flown as it was planned: circles, legs with points on the way, and standing.

`replanning` looks after legs to one goal. These it cannot plan again, so the way ahead is held against what is seen:
a circle is stopped on before it, until it is gone; of a leg the points on the way are left out, and then it is a leg to
one goal. A vehicle that stands where something comes begins a detour (`itinerary`), which `replanning` looks after:
out of the way on what is proved, and back.
"""

import numpy as np

from companion.guard import first_violation
from companion.itinerary import Itinerary
from companion.mission import Mission
from companion.seam import FloatArray, Level, Note
from companion.seeing.sight import Sight
from planner.movers import table

PERIOD_US = 100_000
EVERY_S = 0.02
AHEAD_S = 2.5
"""How far it looks: a stop from 3 m/s takes one second, half of that on the way."""
SPARE = 0.1
"""Kept beyond the hull [m]."""
PATIENCE_US = 1_000_000


class Lookout:
    """Attributes
    ----------
    trouble : why it does not go on, once that has lasted a while; else empty.
    """

    def __init__(self, mission: Mission, itinerary: Itinerary, sight: Sight) -> None:
        self.trouble = ""
        self._itinerary, self._sight = itinerary, sight
        self._keep = mission.vehicle.radius + SPARE
        self._due_us = 0
        self._since_us: int | None = None  # it stands before something

    def step(self, flight_us: int) -> list[Note]:
        """Once a tick while FLYING: what people should know."""
        if flight_us < self._due_us:
            return []
        self._due_us = flight_us + PERIOD_US
        if self._itinerary.away:
            return []  # that is planned again and again
        aim, points = self._itinerary.aim(), self._itinerary.ahead(flight_us, AHEAD_S, EVERY_S)
        in_the_way = points is not None and self._touched(flight_us, points)
        step = f"step {self._itinerary.index}"
        if in_the_way and aim is not None and aim.via_m and self._itinerary.leave_out_via():
            return [Note(Level.WARNING, f"{step}: something is in the way: the points on the way are left out")]
        place = self._itinerary.standing(flight_us)
        if place is not None and self._touched(flight_us, np.tile(place, (round(AHEAD_S / EVERY_S) + 1, 1))):
            self._itinerary.detour(flight_us, place)
        if in_the_way and self._since_us is None:
            self._since_us, self._itinerary.blocked = flight_us, True
            return [Note(Level.WARNING, f"{step}: something is in the way: stopping before it")]
        if in_the_way and self._since_us is not None and flight_us - self._since_us > PATIENCE_US:
            self.trouble = f"{step}: something stays in the way"
        if not in_the_way and self._since_us is not None:
            self._since_us, self._itinerary.blocked, self.trouble = None, False, ""
            return [Note(Level.INFO, f"{step}: the way is free again")]
        return []

    def _touched(self, flight_us: int, points: FloatArray) -> bool:
        """Whether what is seen is too near to the points (m, 3), flown one each `EVERY_S` from now on."""
        seen = self._sight.map
        stretch = float(np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1)).max())
        times: FloatArray = flight_us / 1e6 + EVERY_S * np.arange(len(points), dtype=np.float64)
        cells = np.array([seen.resolution, seen.column, *seen.z])
        movers = table(self._sight.tracks.movers())
        keep = self._keep + 0.5 * stretch
        return first_violation(times, points, seen.low, seen.high, seen.window, cells, movers, keep) >= 0
