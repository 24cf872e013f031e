"""What is asked of the planner, checked and in arrays."""

from dataclasses import dataclass, field

import numpy as np

from planner.bspline import DEGREE, FloatArray, clamped_knots, end_control_points
from planner.limits import Limits
from planner.worlds import World


def _zero() -> FloatArray:
    return np.zeros(3)


@dataclass(frozen=True, slots=True, eq=False)
class Query:
    """One question. Every point keeps the radius from obstacles and walls, as a proof needs it."""

    world: World
    start: FloatArray  # (3,) [m]
    goal: FloatArray  # (3,) [m]
    limits: Limits
    radius: float  # [m]
    seed: int = 0
    start_velocity: FloatArray = field(default_factory=_zero)  # (3,) [m/s]
    start_acceleration: FloatArray = field(default_factory=_zero)  # (3,) [m/s^2]
    goal_velocity: FloatArray = field(default_factory=_zero)  # (3,) [m/s]
    via: FloatArray = field(default_factory=lambda: np.empty((0, 3)))  # (m, 3) points passed in this order [m]

    pace: float = 1.0  # a moving end's curve is set out for this many times the duration guessed at first
    guides: bool = True  # whether a method may ask the search graph, when it has a quicker way to begin with

    @property
    def moving(self) -> bool:
        """Whether an end is anything but at rest."""
        return bool(self.start_velocity.any() or self.start_acceleration.any() or self.goal_velocity.any())

    @property
    def corners(self) -> FloatArray:
        """Start, via points, goal (m + 2, 3) [m]."""
        corners: FloatArray = np.concatenate([self.start[None], self.via, self.goal[None]])
        return corners

    @property
    def legs(self) -> list[float]:
        """Straight from each of those to the next [m]."""
        lengths: list[float] = np.linalg.norm(np.diff(self.corners, axis=0), axis=1).tolist()
        return lengths

    @property
    def distance(self) -> float:
        """Straight from start to goal, through the via points [m]."""
        return sum(self.legs)

    def duration(self, length: float) -> float:
        """A guess of how long a way of that length [m] takes [s]; with moving ends, what their points are set out for.

        The time at full speed, one ramp from rest, and 15 % for what is not straight.
        """
        v, a, j = self.limits.speed, self.limits.acceleration, self.limits.jerk
        ramp = v / a + a / j if v * j >= a * a else 2.0 * (v / j) ** 0.5
        return self.pace * (1.15 * length / v + ramp)

    def pinned(self, n: int, length: float) -> FloatArray:
        """The first and the last three of n control points (6, 3) [m], on even knots: the states at the ends."""
        points: FloatArray = np.repeat(np.array([self.start, self.goal]), DEGREE, axis=0)
        if self.moving:
            knots = clamped_knots(n, self.duration(length))
            points[:DEGREE] = end_control_points(self.start, self.start_velocity, self.start_acceleration, knots)
            points[DEGREE:] = end_control_points(self.goal, -self.goal_velocity, np.zeros(3), knots)[::-1]
        return points
