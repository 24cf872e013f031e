"""The way that an automatic mode flies: from rest to rest, one leg after another, with the nose turned at a set rate.

A `Course` is where the vehicle is meant to be now; modes and missions say where it goes next. It stays where it is when
the estimate jumps: the loops take the jump for what it is and fly back to the course gently.
"""

import math

import numpy as np

from fakevehicle.guidance import Leg, descent, landing_speed, still, stopping_point
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.vocabulary import FloatArray, Glance, Setpoint

PARAMETERS: tuple[Parameter, ...] = (
    Parameter("MPC_TKO_SPEED", 1.5, 0.3, 5.0, "m/s", "Climb rate of a takeoff"),
    Parameter("MPC_LAND_SPEED", 0.7, 0.3, 3.0, "m/s", "Sink rate of a landing below 5 m"),
    Parameter("MPC_Z_V_AUTO_DN", 1.5, 0.5, 4.0, "m/s", "Sink rate of automatic modes"),
    Parameter("MPC_Z_V_AUTO_UP", 3.0, 0.5, 8.0, "m/s", "Climb rate of automatic modes"),
    Parameter("MPC_XY_CRUISE", 5.0, 1.0, 15.0, "m/s", "Speed of automatic modes over ground"),
    Parameter("MPC_ACC_HOR", 3.0, 1.0, 8.0, "m/s^2", "Acceleration of automatic modes"),
    Parameter("MPC_YAWRAUTO_MAX", 60.0, 5.0, 360.0, "deg/s", "Turn rate of automatic modes"),
)
SLOWEST = 0.1
"""Lowest speed that may be asked for [m/s]."""


class Course:
    """Where the vehicle is meant to be.

    Attributes
    ----------
    anchor_n : (3,) where the newest leg ends, or where it stays [m].
    cruise : speed over ground that somebody asked for [m/s]; None: MPC_XY_CRUISE.
    """

    def __init__(self, parameters: ParameterSet) -> None:
        self._parameters = parameters
        self.anchor_n: FloatArray = np.zeros(3)
        self.cruise: float | None = None
        self._leg: Leg | None = None
        self._yaw_from = self._yaw_by = 0.0
        self._turn_us = 0
        self._still: Setpoint | None = None

    def stop(self, glance: Glance, moving: bool) -> None:
        """Come to rest: where braking ends when it moves, else here; the nose stays."""
        p = self._parameters
        position_n, velocity_n = np.array([glance.x, glance.y, glance.z]), np.array([glance.vx, glance.vy, glance.vz])
        self.anchor_n = stopping_point(position_n, velocity_n, p["MPC_ACC_HOR"]) if moving else position_n
        self._leg = self._still = None
        self._yaw_from, self._yaw_by = glance.yaw, 0.0

    def leg_to(self, now_us: int, end_n: FloatArray, speed: float | None = None) -> None:
        """Go on to a point, (3,) [m]: within `speed`, or the cruise speed and the climb and sink rates."""
        p = self._parameters
        if speed is None:
            rise = float(self.anchor_n[2] - end_n[2])
            vertical = p["MPC_Z_V_AUTO_UP"] if rise > 0.0 else p["MPC_Z_V_AUTO_DN"]
            speed = float(p["MPC_XY_CRUISE"]) if self.cruise is None else self.cruise
            if rise:
                speed = min(speed, vertical * math.dist(self.anchor_n, end_n) / abs(rise))
        self._leg = Leg(now_us, self.anchor_n, end_n, max(speed, SLOWEST), p["MPC_ACC_HOR"])
        self._still, self.anchor_n = None, end_n

    def turn_to(self, now_us: int, yaw: float) -> None:
        """Point the nose [rad] by the shorter way, as fast as MPC_YAWRAUTO_MAX lets it."""
        now = self.yaw(now_us)
        self._yaw_from, self._yaw_by = now, math.remainder(yaw - now, 2.0 * math.pi)
        self._turn_us, self._still = now_us, None

    def yaw(self, now_us: int) -> float:
        """Where the nose is meant to point now [rad]."""
        if self._yaw_by == 0.0:
            return self._yaw_from
        turned = math.radians(self._parameters["MPC_YAWRAUTO_MAX"]) * (now_us - self._turn_us) * 1e-6
        if turned >= abs(self._yaw_by):
            self._yaw_from, self._yaw_by = math.remainder(self._yaw_from + self._yaw_by, 2.0 * math.pi), 0.0
            return self._yaw_from
        return self._yaw_from + math.copysign(turned, self._yaw_by)

    def late_s(self, now_us: int) -> float:
        """How long ago the newest leg should have ended [s]; below 0 while it is flown."""
        leg = self._leg
        return math.inf if leg is None else (now_us - leg.start_us) * 1e-6 - leg.duration_s

    def setpoint(self, now_us: int) -> Setpoint:
        """Where to be now; the same object again and again while nothing changes."""
        if self._still is not None:
            return self._still
        yaw = self.yaw(now_us)
        leg = self._leg
        if leg is not None and self.late_s(now_us) < 0.0:
            return leg.setpoint(now_us, yaw)
        rest = still(self.anchor_n, yaw)
        if self._yaw_by == 0.0:
            self._still = rest
        return rest

    def descend(self, now_us: int, glance: Glance, ground_z: float) -> Setpoint:
        """Sink to the ground, at down coordinate `ground_z` [m], below the anchor.

        Without a position it stands still by the velocity the estimate still has: some seconds old that is a metre a
        second wrong, where sinking level would let the way it had and the wind carry it off.
        """
        p = self._parameters
        speed = landing_speed(ground_z - glance.z, p["MPC_LAND_SPEED"], p["MPC_Z_V_AUTO_DN"])
        if glance.position_valid:
            return descent(self.anchor_n, speed, self.yaw(now_us))
        return Setpoint(velocity_n=np.array([0.0, 0.0, speed]), acceleration_n=np.zeros(3), yaw=self.yaw(now_us))
