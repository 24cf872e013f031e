"""What is asked of the planner, checked and in arrays."""

from dataclasses import dataclass, field

import numpy as np

from planner.bspline import FloatArray
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

    @property
    def distance(self) -> float:
        """Straight from start to goal, through the via points [m]."""
        corners = np.concatenate([self.start[None], self.via, self.goal[None]])
        return float(np.linalg.norm(np.diff(corners, axis=0), axis=1).sum())
