"""A look ahead on what is flown as it was planned: climbs, circles, legs with points on the way, and standing.

`replanning` looks after legs to one goal. These it cannot plan again, so the way ahead is held against what is seen:

    climb       stopped on while something crosses ahead, unless it would be met there
    circle      stopped on before what is in the way; when that stays, flown round to where the circle is clear again
    points      are flown to one by one from then on, and left out where there is no way: legs to one goal
    standing    a detour (`itinerary`) out of the way of what comes, on what is proved, and back
    landing     waits while something is about to cross the column under it, for a minute at most
"""

import math

import numpy as np

from companion.column import COLUMN_GROWTH, landing_crossed_s
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
AROUND_US, AROUND_EVERY_S, AROUND_MOST_S = 5_000_000, 0.1, 120.0
"""What stays on a circle for so long is flown round; how finely, and how far on, it is looked for a place behind it."""
WAY_S, WAY_EVERY_S = 5.0, 0.1
"""How much of the next step's way a wait for movers looks at, and how finely [s]."""
LONGEST_WAIT_US = 60_000_000
"""Above a landing, until nothing is about to cross the column; then it lands all the same."""


class Lookout:
    """Attributes
    ----------
    trouble : why it does not go on, once that has lasted a while; else empty.
    """

    def __init__(self, mission: Mission, itinerary: Itinerary, sight: Sight) -> None:
        self.trouble = ""
        self._mission, self._itinerary, self._sight = mission, itinerary, sight
        self._keep = mission.vehicle.radius + SPARE
        self._due_us = 0
        self._since_us: int | None = None  # it stands before something
        self._round_us = 0  # when it is looked next for a place behind it
        self._waits_us: int | None = None  # since when it could land
        self._said: list[Note] = []

    def step(self, flight_us: int, climbing: bool = False) -> list[Note]:
        """Once a tick while FLYING, or climbing by setpoints: what people should know."""
        if flight_us >= self._due_us:
            self._due_us = flight_us + PERIOD_US
            if climbing:
                self._look_up(flight_us)
            elif not self._itinerary.away:  # else that is planned again and again
                self._look(flight_us)
        said, self._said = self._said, []
        return said

    def may_land(self, flight_us: int) -> bool:
        """Whether nothing is about to cross the column under it; after a minute, whatever is."""
        crossed_s = self._descent_crossed_s(flight_us)
        if crossed_s == math.inf:
            return True
        if self._waits_us is None:
            self._waits_us = flight_us
            self._tell(Level.INFO, f"the landing waits: something crosses it in {crossed_s:.1f} s")
        return flight_us - self._waits_us > LONGEST_WAIT_US

    def _look(self, flight_us: int) -> None:
        itinerary = self._itinerary
        itinerary.blocked &= self._since_us is not None  # not from the climb
        wait = itinerary.step.wait
        if wait is not None and wait.for_ == "movers clear":
            itinerary.heed_movers(self._next_is_clear(flight_us, wait.radius))
        points = itinerary.ahead(flight_us, AHEAD_S, EVERY_S)
        in_the_way = points is not None and self._touched(flight_us, points)
        step = f"step {itinerary.index}"
        if in_the_way and itinerary.by_places(flight_us):
            self._tell(Level.WARNING, f"{step}: something is in the way: planned by what is seen, point by point")
            return
        place = itinerary.standing(flight_us)
        if place is not None and self._touched(flight_us, np.tile(place, (round(AHEAD_S / EVERY_S) + 1, 1))):
            itinerary.detour(flight_us, place)
        elif in_the_way and self._since_us is None:
            self._since_us, itinerary.blocked = flight_us, True
            self._round_us = flight_us + AROUND_US
            self._tell(Level.WARNING, f"{step}: something is in the way: stopping before it")
        elif in_the_way and place is not None and flight_us >= self._round_us and self._go_round(flight_us, place):
            self._since_us, itinerary.blocked, self.trouble = None, False, ""
            self._tell(Level.INFO, f"{step}: something stays in the way: round it")
        elif in_the_way and self._since_us is not None and flight_us - self._since_us > PATIENCE_US:
            self.trouble = f"{step}: something stays in the way"
        elif not in_the_way and self._since_us is not None:
            self._since_us, itinerary.blocked, self.trouble = None, False, ""
            self._tell(Level.INFO, f"{step}: the way is free again")

    def _next_is_clear(self, flight_us: int, radius: float | None) -> bool:
        """Whether no mover, going on as it says, comes within the radius [m] of the way of the next step."""
        points = self._itinerary.next_way(WAY_S, WAY_EVERY_S)
        if points is None:
            return self._descent_crossed_s(flight_us) == math.inf
        ahead = WAY_EVERY_S * np.arange(len(points))
        keep = (self._mission.seen_radius() if radius is None else radius) + COLUMN_GROWTH * ahead
        for mover in self._sight.tracks.movers():
            age = flight_us / 1e6 - mover.stamp + ahead
            apart = points - np.array(mover.centre) - age[:, None] * np.array(mover.velocity)
            if (np.linalg.norm(apart, axis=1) < keep + mover.radius).any():
                return False
        return True

    def _descent_crossed_s(self, flight_us: int) -> float:
        place = self._itinerary.reference(flight_us).position_m
        return landing_crossed_s(self._mission, self._sight.tracks, flight_us, place)

    def _look_up(self, flight_us: int) -> None:
        """On a climb: stop while that keeps out of the way of what crosses it, and going on does not."""
        points = self._itinerary.ahead(flight_us, AHEAD_S, EVERY_S)
        if points is None:
            return
        here = np.tile(points[0], (len(points), 1))
        stops = self._touched(flight_us, points) and not self._touched(flight_us, here)
        if stops and not self._itinerary.blocked:
            self._tell(Level.WARNING, "something crosses the climb: stopping below it")
        self._itinerary.blocked = stops

    def _go_round(self, flight_us: int, place: FloatArray) -> bool:
        """Begin a detour to where the circle is clear again; False as long as there is no such place."""
        self._round_us = flight_us + PATIENCE_US
        points = self._itinerary.ahead(flight_us, AROUND_MOST_S, AROUND_EVERY_S)
        if points is None:
            return False
        radius = self._mission.seen_radius()
        taken = np.array([self._touched(flight_us, point[None], radius) for point in points])
        stretch = round(AHEAD_S / AROUND_EVERY_S)
        for k in range(int(np.argmax(taken)) if taken.any() else len(points), len(points)):
            if not taken[k : k + stretch].any():
                return self._itinerary.detour(flight_us, place, AROUND_EVERY_S * k)
        return False

    def _touched(self, flight_us: int, points: FloatArray, radius: float | None = None) -> bool:
        """Whether what is seen is too near to the points (m, 3), flown one each `EVERY_S` from now on."""
        seen = self._sight.map
        apart = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1))
        times: FloatArray = flight_us / 1e6 + EVERY_S * np.arange(len(points), dtype=np.float64)
        cells = np.array([seen.resolution, seen.column, *seen.z])
        movers = table(self._sight.tracks.movers())
        keep = (self._keep if radius is None else radius) + 0.5 * float(apart.max(initial=0.0))
        return first_violation(times, points, seen.low, seen.high, seen.window, cells, movers, keep) >= 0

    def _tell(self, level: Level, text: str) -> None:
        self._said.append(Note(level, text))
