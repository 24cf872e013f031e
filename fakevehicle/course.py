"""The way that an automatic mode flies: legs from rest to rest, or joined by corners, the nose turned at a set rate.

A `Course` is where the vehicle is meant to be now; modes and missions say where it goes next. It stays where it is when
the estimate jumps: the loops take the jump for what it is and fly back to the course gently.
"""

import math
from dataclasses import replace

import numpy as np

from fakevehicle.circle import Circle, circle
from fakevehicle.corner import Corner, rounded
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
TOO_NEAR = 0.3
"""Nearer than this over ground [m] nothing can be pointed at."""
LONGEST_TICK = 0.02
"""The nose follows what it points at in steps of at most this [s], however long nobody asked."""


class Course:
    """Where the vehicle is meant to be.

    Attributes
    ----------
    anchor_n : (3,) where the newest leg ends, or where it stays [m].
    cruise : speed over ground that somebody asked for [m/s]; None: MPC_XY_CRUISE.
    looks_at : (3,) what the nose points at, wherever it flies [m]; None: where it is turned to.
    """

    def __init__(self, parameters: ParameterSet) -> None:
        self._parameters = parameters
        self.anchor_n: FloatArray = np.zeros(3)
        self.cruise: float | None = None
        self.looks_at: FloatArray | None = None
        self._nose_us = 0  # when it last followed that
        self._way: tuple[Leg | Corner | Circle, ...] = ()  # what is flown now, and what comes after it
        self._yaw_from = self._yaw_by = 0.0
        self._turn_us = 0
        self._still: Setpoint | None = None

    def stop(self, glance: Glance, moving: bool) -> None:
        """Come to rest: where braking ends when it moves, else here; the nose stays."""
        p = self._parameters
        position_n, velocity_n = np.array([glance.x, glance.y, glance.z]), np.array([glance.vx, glance.vy, glance.vz])
        self.anchor_n = stopping_point(position_n, velocity_n, p["MPC_ACC_HOR"]) if moving else position_n
        self._way, self._still = (), None
        self._yaw_from, self._yaw_by = glance.yaw, 0.0

    def leg_to(self, now_us: int, end_n: FloatArray, speed: float | None = None) -> None:
        """Go on to a point, (3,) [m]: within `speed`, or the cruise speed and the climb and sink rates."""
        if speed is None:
            speed = self.speed_to(self.anchor_n, end_n, self.cruise)
        leg = Leg(now_us, self.anchor_n, end_n, max(speed, SLOWEST), self._parameters["MPC_ACC_HOR"])
        self._way, self._still, self.anchor_n = (leg,), None, end_n

    def round_to(self, now_us: int, next_n: FloatArray, cruise: float | None, cut: float) -> Corner | None:
        """Do not stop at the end of the newest leg but go on to a point, (3,) [m], as `cruise` allows.

        The corner passes within `cut` [m] of where the leg was to end. None when there is no room for one: then the
        leg ends at rest as it was to.
        """
        leg = self._way[-1] if self._way else None
        if not isinstance(leg, Leg) or self.late_s(now_us) >= 0.0:
            return None
        speed = max(self.speed_to(self.anchor_n, next_n, cruise), SLOWEST)
        found = rounded(leg, now_us, next_n, speed, cut)
        if found is None:
            return None
        pieces, corner = found
        self._way, self.anchor_n = (*self._way[:-1], *pieces), next_n
        return corner

    def turn_about(self, now_us: int, centre_n: FloatArray, turns: float, clockwise: bool) -> None:
        """Fly circles about a place, (3,) [m], from the anchor, once it is reached, and back to rest.

        At the cruise speed, if the circle lets it.
        """
        p = self._parameters
        speed = max(float(p["MPC_XY_CRUISE"]) if self.cruise is None else self.cruise, SLOWEST)
        most = float(p["MPC_ACC_HOR"])
        late_s = self.late_s(now_us)
        begin_us, before = (now_us, ()) if late_s >= 0.0 else (now_us - round(1e6 * late_s), self._way)
        way = circle(begin_us, self.anchor_n, centre_n, turns, clockwise=clockwise, speed=speed, most=most)
        end_us = begin_us + math.ceil(1e6 * way.duration_s)
        self._way, self._still, self.anchor_n = (*before, way), None, way.setpoint(end_us, 0.0).position_n

    def look_at(self, place_n: FloatArray | None) -> None:
        """Point the nose at a place, (3,) [m], from now on; None: no longer."""
        self.looks_at, self._still = place_n, None

    def speed_to(self, start_n: FloatArray, end_n: FloatArray, cruise: float | None) -> float:
        """Speed of a leg [m/s] at which neither the cruise speed nor the climb and sink rates are exceeded."""
        p = self._parameters
        rise = float(start_n[2] - end_n[2])
        vertical = p["MPC_Z_V_AUTO_UP"] if rise > 0.0 else p["MPC_Z_V_AUTO_DN"]
        speed = float(p["MPC_XY_CRUISE"]) if cruise is None else cruise
        return min(speed, vertical * math.dist(start_n, end_n) / abs(rise)) if rise else speed

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
        if not self._way:
            return math.inf
        last = self._way[-1]
        return (now_us - last.start_us) * 1e-6 - last.duration_s

    def setpoint(self, now_us: int) -> Setpoint:
        """Where to be now; the same object again and again while nothing changes."""
        if self._still is not None:
            return self._still
        yaw = self.yaw(now_us)
        if self._way and self.late_s(now_us) < 0.0:
            while len(self._way) > 1 and now_us >= self._way[1].start_us:
                self._way = self._way[1:]
            flown = self._way[0].setpoint(now_us, yaw)
        else:
            flown = still(self.anchor_n, yaw)
            if self._yaw_by == 0.0 and self.looks_at is None:
                self._still = flown
        return flown if self.looks_at is None else self._looking(now_us, flown)

    def _looking(self, now_us: int, flown: Setpoint) -> Setpoint:
        """The same, with the nose on its way to what it is to point at, at most at MPC_YAWRAUTO_MAX."""
        assert self.looks_at is not None
        north, east = (self.looks_at - flown.position_n)[:2].tolist()
        since_s = min((now_us - self._nose_us) * 1e-6, LONGEST_TICK)
        self._nose_us = now_us
        yaw = self.yaw(now_us)
        if math.hypot(north, east) < TOO_NEAR or since_s <= 0.0:
            return flown
        most = math.radians(self._parameters["MPC_YAWRAUTO_MAX"]) * since_s
        turned = min(max(math.remainder(math.atan2(east, north) - yaw, 2.0 * math.pi), -most), most)
        self._yaw_from, self._yaw_by = math.remainder(yaw + turned, 2.0 * math.pi), 0.0
        return replace(flown, yaw=self._yaw_from, yaw_rate=turned / since_s)

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
