"""Turns about a place, from rest to rest.

With radius r and the acceleration a that there is, 0.8 a is kept for the turn and 0.6 a for speeding up and slowing
down, so that both together are never above a: the speed is at most sqrt(0.8 a r). The way along the circle is that of a
`Leg` as long as the turns.
"""

import math
from dataclasses import dataclass

import numpy as np

from fakevehicle.guidance import Leg
from fakevehicle.vocabulary import FloatArray, Setpoint

INWARD, ALONG = 0.8, 0.6
"""Shares of the acceleration; the root of their squares' sum is one."""


@dataclass(frozen=True, slots=True)
class Circle:
    """Turns about a place.

    Attributes
    ----------
    centre_n : (3,) local NED [m]; down is the height that is flown.
    radius : [m], > 0.
    bearing : where on the circle it begins, seen from the centre [rad].
    sense : 1.0 clockwise seen from above, -1.0 the other way.
    along : the way along the circle.
    """

    centre_n: FloatArray
    radius: float
    bearing: float
    sense: float
    along: Leg

    @property
    def start_us(self) -> int:
        """When it begins [us]."""
        return self.along.start_us

    @property
    def duration_s(self) -> float:
        """How long it takes [s]."""
        return self.along.duration_s

    def setpoint(self, now_us: int, yaw: float) -> Setpoint:
        """Position, velocity and acceleration at `now_us`."""
        way, speed, gain = self.along.at(now_us)
        angle = self.bearing + self.sense * way / self.radius
        out_n = np.array([math.cos(angle), math.sin(angle), 0.0])
        on_n = np.array([-self.sense * math.sin(angle), self.sense * math.cos(angle), 0.0])
        return Setpoint(
            self.centre_n + self.radius * out_n,
            speed * on_n,
            gain * on_n - (speed * speed / self.radius) * out_n,
            yaw,
        )


def circle(
    now_us: int, start_n: FloatArray, centre_n: FloatArray, turns: float, *, clockwise: bool, speed: float, most: float
) -> Circle:
    """Turns that begin at rest at a point of the circle.

    Parameters
    ----------
    start_n, centre_n : (3,) [m]; the radius is their distance over ground, the height the start's.
    turns : how many, > 0.
    speed : highest [m/s].
    most : highest acceleration [m/s^2].
    """
    north, east = (start_n - centre_n)[:2].tolist()
    radius = math.hypot(north, east)
    long_n = np.array([2.0 * math.pi * radius * turns, 0.0, 0.0])
    along = Leg(now_us, np.zeros(3), long_n, min(speed, math.sqrt(INWARD * most * radius)), ALONG * most)
    at_n = np.array([centre_n[0], centre_n[1], start_n[2]])
    return Circle(at_n, radius, math.atan2(east, north), 1.0 if clockwise else -1.0, along)
