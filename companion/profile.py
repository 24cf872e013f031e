"""Motions from rest to rest that need no plan: straight (the takeoff), round a point, and a turn on the spot.

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


@dataclass(frozen=True, slots=True)
class Turn:
    """The nose from one heading to another [rad], the short way, by the same quintic, in `duration` [s]."""

    start: float
    angle: float  # signed
    duration: float

    @classmethod
    def within(cls, start: float, end: float, rate: float) -> "Turn":
        """The turn whose greatest rate is `rate` [rad/s]."""
        angle = math.remainder(end - start, 2.0 * math.pi)
        return cls(start, angle, PEAK_SPEED * abs(angle) / rate)

    def yaw(self, t: float) -> float:
        """[rad], within half a turn of zero."""
        tau = 1.0 if self.duration <= 0.0 else min(max(t / self.duration, 0.0), 1.0)
        return math.remainder(self.start + tau**3 * (10.0 + tau * (-15.0 + 6.0 * tau)) * self.angle, 2.0 * math.pi)


@dataclass(frozen=True, slots=True)
class Circle:
    """Round a point at constant speed, from rest to rest.

    The speed grows along 3 u^2 - 2 u^3 within `ramp` [s] and falls likewise, so position, velocity and acceleration
    are continuous, and the acceleration is v^2/R toward the centre and dv/dt along the way.

    Attributes
    ----------
    centre : (3,) [m].
    start : angle of the first point [rad], from north over east.
    radius : [m].
    angle : swept [rad]; positive from north over east: clockwise from above.
    speed : between the ramps [m/s].
    ramp : [s].
    """

    centre: FloatArray
    start: float
    radius: float
    angle: float
    speed: float
    ramp: float

    @classmethod
    def within(cls, centre: FloatArray, start: float, radius: float, angle: float, limits: Limits) -> "Circle":
        """As fast as the limits allow.

        Of the acceleration a the turn takes at most 0.8 a and the ramp at most 0.6 a, together a; of the jerk each
        takes half: v^3/R^2 and 3 v (dv/dt)/R the one, 6 v/T^2 the other.
        """
        a, half = limits.acceleration, 0.5 * limits.jerk
        speed = min(limits.speed, math.sqrt(0.8 * a * radius), (half * radius**2 / 2.0) ** (1.0 / 3.0))
        while True:
            ramp = max(1.5 * speed / (0.6 * a), math.sqrt(6.0 * speed / half), 3.0 * speed**2 * 1.5 / (radius * half))
            if speed * ramp <= abs(angle) * radius:
                return cls(centre, start, radius, angle, speed, ramp)
            speed *= 0.9

    @property
    def duration(self) -> float:
        """[s]."""
        return abs(self.angle) * self.radius / self.speed + self.ramp

    def state(self, t: float) -> MotionState:
        """The motion at t [s]; at rest before and after."""
        t = min(max(t, 0.0), self.duration)
        before_end = self.duration - t
        u = min(min(t, before_end) / self.ramp, 1.0)
        speed, change = self.speed * u * u * (3.0 - 2.0 * u), self.speed * 6.0 * u * (1.0 - u) / self.ramp
        way = self.speed * (self.ramp * u**3 * (1.0 - 0.5 * u) + max(min(t, before_end) - self.ramp, 0.0))
        if t > before_end:
            way, change = abs(self.angle) * self.radius - way, -change
        turn = math.copysign(1.0, self.angle)
        at = self.start + turn * way / self.radius
        outward = np.array([math.cos(at), math.sin(at), 0.0])
        along = turn * np.array([-math.sin(at), math.cos(at), 0.0])
        acceleration = change * along - speed**2 / self.radius * outward
        return MotionState(self.centre + self.radius * outward, speed * along, acceleration)
