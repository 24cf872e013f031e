"""The mission's steps, walked by the clock: which reference is flown now.

Legs are planned before anything moves (`wanted`); takeoff is a straight climb, hold keeps the last point, and land is
where this file ends: the vehicle lands by itself. Everything here is in the mission frame (NED).
"""

import math
from dataclasses import dataclass, field

import numpy as np

from companion.mission import Mission
from companion.profile import StraightMove
from companion.seam import FloatArray, PlanWanted, Reference
from companion.steps import Step
from planner import Limits, Trajectory

SPOOL_UP_S = 1.0
"""Between the word that it is armed and the first climb: PX4 spools its motors up for COM_SPOOLUP_TIME, 1 s."""

COLUMN_STEP = 0.02
"""Spacing of the samples along climb and landing [m]."""

Path = StraightMove | Trajectory


@dataclass(slots=True)
class Itinerary:
    """Where the flight is in its steps.

    Attributes
    ----------
    mission : what to fly.
    seed : for the planner; the leg of step k is planned with seed + k.
    yaw : where the nose points throughout [rad].
    """

    mission: Mission
    seed: int
    yaw: float = 0.0
    index: int = 0
    _ends: list[FloatArray] = field(init=False)  # (3,) each: where step k ends; _ends[-1] is where the flight begins
    _paths: dict[int, Path] = field(init=False)  # by step index
    _entered_us: int | None = None

    def __post_init__(self) -> None:
        here = start = np.array(self.mission.start_m())
        limits = self.mission.planner_limits()
        climb = Limits(speed=self.mission.limits.climb, acceleration=limits.acceleration, jerk=limits.jerk)
        self._ends, self._paths = [], {}
        for i, step in enumerate(self.mission.steps):
            if step.takeoff is not None:
                there = np.array([here[0], here[1], -step.takeoff.altitude])
                self._paths[i] = StraightMove.within(here, there, climb)
                here = there
            elif step.goto is not None:
                here = np.array(step.goto.ned())
            self._ends.append(here)
        self._ends.append(start)

    def wanted(self) -> list[PlanWanted]:
        """One request a leg, from where the step before ends; `request_id` is the step's index."""
        return [
            PlanWanted(
                request_id=i,
                start_m=_vector(self._ends[i - 1]),
                goal_m=_vector(self._ends[i]),
                limits=self.mission.planner_limits(),
                radius=self.mission.planner_radius(),
                seed=self.seed + i,
                method=self.mission.method,
            )
            for i, step in enumerate(self.mission.steps)
            if step.goto is not None
        ]

    def wants(self, request_id: int) -> bool:
        """Whether this is the number of a leg."""
        return 0 <= request_id < len(self.mission.steps) and self.mission.steps[request_id].goto is not None

    def take(self, request_id: int, trajectory: Trajectory) -> None:
        """Keep the trajectory of one leg."""
        self._paths[request_id] = trajectory

    def obstruction(self) -> str:
        """Why the climb or the landing cannot be flown, or nothing.

        Both are vertical, through the points where takeoff and mission end. They keep the planner's radius from every
        obstacle; samples every `COLUMN_STEP` prove it for all between, since a distance changes no faster than the
        point moves. From the map's walls the upper end keeps the radius; the ground is what they lead to.
        """
        world, radius = self.mission.planner_world(), self.mission.planner_radius()
        for what, top in (("the climb", self._ends[0]), ("the landing", self._ends[-2])):
            place = f"north {top[0]:g}, east {top[1]:g}, altitude {-top[2]:g}"
            margin = float(world.wall_distance(top[None])[0]) - radius
            if margin < 0.0:
                return f"{what} at {place} is {-margin:.2f} m too near the bounds (it keeps {radius:g} m)"
            column = np.repeat(top[None], max(2, math.ceil(-top[2] / COLUMN_STEP) + 1), axis=0)
            column[:, 2] = np.linspace(0.0, top[2], len(column))
            least = float(world.distance(column).min()) - abs(top[2]) / (len(column) - 1) / 2.0
            if least < radius:
                return f"{what} at {place} is {radius - least:.2f} m too near an obstacle (it keeps {radius:g} m)"
        return ""

    def planned(self) -> bool:
        """Whether every leg has its trajectory."""
        return all(step.goto is None or i in self._paths for i, step in enumerate(self.mission.steps))

    @property
    def step(self) -> Step:
        return self.mission.steps[self.index]

    def begin(self, now_us: int) -> None:
        """Start walking: the takeoff begins after the motors have spooled up."""
        self._entered_us = now_us + round(SPOOL_UP_S * 1e6)

    def advance(self, now_us: int) -> bool:
        """Move on from every step whose time is over; True when the step changed."""
        before = self.index
        while self._entered_us is not None and self.step.land is None:
            end_us = self._entered_us + round(self._duration() * 1e6)
            if now_us < end_us:
                break
            self.index, self._entered_us = self.index + 1, end_us
        return self.index != before

    def finished(self) -> bool:
        """Whether only landing is left."""
        return self.step.land is not None

    def reference(self, now_us: int) -> Reference:
        """Where the vehicle should be at `now_us`."""
        path = self._paths.get(self.index)
        if path is None:
            return self.rest()
        t = 0.0 if self._entered_us is None else (now_us - self._entered_us) / 1e6
        state = path.state(t)
        return Reference(state.position, state.velocity, state.acceleration, self.yaw)

    def rest(self) -> Reference:
        """At rest where the current step ends (hold, land)."""
        return Reference(self._ends[self.index], np.zeros(3), np.zeros(3), self.yaw)

    def remaining(self, position_m: FloatArray) -> float:
        """Straight distance [m] to where the current step ends."""
        return float(np.linalg.norm(self._ends[self.index] - position_m))

    def _duration(self) -> float:
        if self.step.hold is not None:
            return self.step.hold.seconds
        path = self._paths.get(self.index)
        return 0.0 if path is None else float(path.duration)


def _vector(a: FloatArray) -> tuple[float, float, float]:
    return (float(a[0]), float(a[1]), float(a[2]))
