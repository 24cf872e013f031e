"""A straight move from rest to rest: the takeoff, and nothing that needs a plan.

    s(tau) = 10 tau^3 - 15 tau^4 + 6 tau^5,  tau = t/T    (the quintic with no velocity or acceleration at its ends)

Its peaks are max |s'| = 15/8, max |s''| = 10/sqrt(3), max |s'''| = 60 (at the ends), each over the matching power of T
(differentiate and set to zero), so the shortest T under the limits is a maximum of three.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner import Limits

FloatArray = NDArray[np.float64]

PEAK_SPEED = 15.0 / 8.0
PEAK_ACCELERATION = 10.0 / math.sqrt(3.0)
PEAK_JERK = 60.0


class MotionState(NamedTuple):
    """(3,) each [m], [m/s], [m/s^2]."""

    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray


@dataclass(frozen=True, slots=True)
class StraightMove:
    """From `start` to `end` (3,) [m], in `duration` [s]."""

    start: FloatArray
    end: FloatArray
    duration: float

    @classmethod
    def within(cls, start: FloatArray, end: FloatArray, limits: Limits) -> "StraightMove":
        """The fastest such move whose speed, acceleration and jerk stay within the limits."""
        distance = float(np.linalg.norm(end - start))
        duration = max(
            PEAK_SPEED * distance / limits.speed,
            math.sqrt(PEAK_ACCELERATION * distance / limits.acceleration),
            (PEAK_JERK * distance / limits.jerk) ** (1.0 / 3.0),
        )
        return cls(start, end, duration)

    def state(self, t: float) -> MotionState:
        """The motion at t [s]; at rest before and after."""
        if self.duration <= 0.0:
            return MotionState(self.end, np.zeros(3), np.zeros(3))
        tau, span, T = min(max(t / self.duration, 0.0), 1.0), self.end - self.start, self.duration
        s = tau**3 * (10.0 + tau * (-15.0 + 6.0 * tau))
        ds = 30.0 * tau**2 * (1.0 - tau) ** 2
        dds = 60.0 * tau * (1.0 - tau) * (1.0 - 2.0 * tau)
        return MotionState(self.start + s * span, ds / T * span, dds / T**2 * span)
