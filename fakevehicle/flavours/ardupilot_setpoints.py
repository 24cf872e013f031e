"""Setpoints in GUIDED: read as ArduCopter reads them, flown by the supervisor, and carried on while the next is late.

They are flown in GUIDED only, and once the takeoff has reached its height; on the ground and in other modes they are
dropped, with a text at most once a second (ArduCopter drops in silence). What cannot be read is a stop.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from fakevehicle.codec import Message
from fakevehicle.flavours.ardupilot_modes import GUIDED
from fakevehicle.flavours.base import Parts
from fakevehicle.flavours.climb import ClimbThrust, climb_rate
from fakevehicle.flavours.guided import POSITION, Wanted, carried_on, setpoint_of, stop
from fakevehicle.modes import Mode
from fakevehicle.services.commands import RADIANS_PER_E7
from fakevehicle.services.outbox import Sender
from fakevehicle.services.service import Handler, Service
from fakevehicle.vocabulary import Geodetic, Setpoint
from wire.dialect import mavlink

if TYPE_CHECKING:
    from fakevehicle.flavours.ardupilot import ArduPilot

CARRY_US = 60_000
"""A setpoint older than this is carried on along its velocity."""
NOSE_SPEED = 0.5
"""From this speed over ground on [m/s] the nose turns to where it travels, when no yaw is asked for."""
NOSE_RATE = math.radians(60.0)
"""How fast [rad/s]; measured on ArduCopter (WP_YAW_BEHAVIOR 2)."""
LOOK_S = 0.02
_m = mavlink
_GLOBAL = (_m.MAV_FRAME_GLOBAL, _m.MAV_FRAME_GLOBAL_INT)
_RELATIVE = (_m.MAV_FRAME_GLOBAL_RELATIVE_ALT, _m.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT)


class GuidedSetpoints(Service):
    """The three setpoint messages."""

    def __init__(self, flavour: ArduPilot, parts: Parts) -> None:
        self._flavour = flavour
        self._parts = parts
        self._asked: Setpoint | None = None  # newest, as it came
        self._asked_us = 0
        self._lift: ClimbThrust | None = None  # while attitudes are flown
        self._nose: float | None = None  # heading on the way to that of travel; None: as the vehicle's

    def routes(self) -> Mapping[int, Handler]:
        """The three setpoint messages."""
        return {
            _m.MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED: self.local_ned,
            _m.MAVLINK_MSG_ID_SET_POSITION_TARGET_GLOBAL_INT: self.global_int,
            _m.MAVLINK_MSG_ID_SET_ATTITUDE_TARGET: self.attitude,
        }

    def local_ned(self, _sender: Sender, m: Message, now_us: int) -> None:
        """SET_POSITION_TARGET_LOCAL_NED."""
        self._take(m, m.coordinate_frame, np.array([m.x, m.y, m.z]), now_us)

    def global_int(self, _sender: Sender, m: Message, now_us: int) -> None:
        """SET_POSITION_TARGET_GLOBAL_INT: latitude and longitude e7, altitude above sea level or above home."""
        places, home = self._parts.places, self._parts.supervisor.home
        origin = places.origin
        position_n = None
        if abs(m.lat_int) <= 900_000_000 and abs(m.lon_int) <= 1_800_000_000 and origin is not None:
            place = Geodetic(m.lat_int * RADIANS_PER_E7, m.lon_int * RADIANS_PER_E7, origin.altitude)
            position_n = places.local(place)
        if position_n is None or origin is None or home is None or m.coordinate_frame not in _GLOBAL + _RELATIVE:
            position_n, frame = np.zeros(3), _m.MAV_FRAME_GLOBAL  # a frame in which nothing can be flown: a stop
        else:
            relative = m.coordinate_frame in _RELATIVE
            position_n[2] = (float(home.position_n[2]) if relative else origin.altitude) - m.alt
            frame = _m.MAV_FRAME_LOCAL_NED
        self._take(m, frame, position_n, now_us)

    def attitude(self, sender: Sender, message: Message, now_us: int) -> None:
        """SET_ATTITUDE_TARGET as everywhere, but that its thrust is a climb rate."""
        s = self._parts.supervisor
        if not self._flown(now_us):
            return
        rejected = self._parts.setpoints.rejected
        self._parts.setpoints.attitude(sender, message, now_us)
        if self._parts.setpoints.rejected == rejected:
            self._asked, self._asked_us = s.asked, now_us
            self._nose = None
            if self._lift is None:
                self._lift = ClimbThrust(self._parts.stack.glance.thrust)
            self._lift_for(s.asked, 0.0)

    def _lift_for(self, asked: Setpoint | None, dt_s: float) -> None:
        """An attitude's thrust is a climb rate (GUID_OPTIONS without 8): the thrust for it now."""
        p, g, lift = self._parts.parameters, self._parts.stack.glance, self._lift
        if asked is None or lift is None:
            return
        wanted = climb_rate(asked.thrust, float(p["MPC_Z_V_AUTO_UP"]), float(p["MPC_Z_V_AUTO_DN"]))
        x, y = asked.attitude_q_nb[1:3].tolist()
        cosine = 1.0 if math.isnan(x) else 1.0 - 2.0 * (x * x + y * y)
        thrust = lift.step(wanted, -g.vz, cosine, dt_s)
        self._parts.supervisor.offboard(self._asked_us, replace(asked, thrust=thrust))

    def stop(self, now_us: int) -> None:
        """Forget what was followed, and stand still."""
        self._asked = self._nose = self._lift = None
        self._parts.supervisor.offboard(now_us, stop())

    def look(self, now_us: int) -> None:
        """A followed point goes on at its velocity while the next one is late, and the nose turns to the travel."""
        s, asked = self._parts.supervisor, self._asked
        if asked is None:
            return
        age_s, timeout_s = (now_us - self._asked_us) * 1e-6, float(self._parts.parameters["GUID_TIMEOUT"])
        held = not math.isnan(float(asked.position_n[0]))
        if s.mode is not Mode.GUIDED or not s.airborne or s.asked is None or not (held or age_s < timeout_s):
            self._asked = self._lift = None
            return
        if not math.isnan(asked.thrust):
            self._lift_for(asked, LOOK_S)
            return
        moved = carried_on(asked, age_s, timeout_s) if now_us - self._asked_us > CARRY_US else None
        nose = self._nose_to_travel() if math.isnan(asked.yaw) and math.isnan(asked.yaw_rate) else None
        if nose is not None:
            moved = replace(moved or asked, yaw=nose)
        if moved is not None:
            s.offboard(self._asked_us, moved)  # no younger for that

    def _nose_to_travel(self) -> float | None:
        """The next heading on the way to that of travel [rad]; None while it is too slow to have one."""
        glance = self._parts.stack.glance
        if self._nose is None:
            self._nose = glance.yaw
        if math.hypot(glance.vx, glance.vy) >= NOSE_SPEED:
            turn = math.remainder(math.atan2(glance.vy, glance.vx) - self._nose, 2.0 * math.pi)
            step = NOSE_RATE * LOOK_S
            self._nose = math.remainder(self._nose + min(max(turn, -step), step), 2.0 * math.pi)
        return self._nose

    def _take(
        self, m: Message, frame: int, position: np.ndarray[tuple[int], np.dtype[np.float64]], now_us: int
    ) -> None:
        s = self._parts.supervisor
        here_n, heading = s.position_n, s.yaw
        if not self._flown(now_us) or here_n is None or heading is None:
            return
        wanted = Wanted(
            m.type_mask,
            frame,
            position,
            np.array([m.vx, m.vy, m.vz]),
            np.array([m.afx, m.afy, m.afz]),
            m.yaw,
            m.yaw_rate,
        )
        asked = setpoint_of(wanted, here_n, heading)
        if asked is None:
            self._refuse("not a combination that can be flown: a stop", now_us)
            self.stop(now_us)
            return
        if not m.type_mask & POSITION and self._outside(asked):
            self._refuse("outside the fence", now_us)
            return
        self._asked, self._asked_us = asked, now_us
        self._lift = None
        if not (math.isnan(asked.yaw) and math.isnan(asked.yaw_rate)):
            self._nose = None
        elif self._nose is not None:
            asked = replace(asked, yaw=self._nose)
        s.offboard(now_us, asked)

    def _outside(self, asked: Setpoint) -> bool:
        s = self._parts.supervisor
        if s.home is None or not self._parts.parameters["GF_ACTION"]:
            return False
        return s.fence.breach_at(asked.position_n, s.home.position_n) is not None

    def _flown(self, now_us: int) -> bool:
        s = self._parts.supervisor
        if self._flavour.number != GUIDED or s.mode is not Mode.GUIDED:
            self._refuse("the mode is not GUIDED", now_us)
            return False
        if not s.airborne:
            self._refuse("not on the ground, take off first", now_us)
            return False
        return True

    def _refuse(self, reason: str, now_us: int) -> None:
        self._parts.setpoints.rejected += 1
        self._flavour.warn(f"Setpoint refused: {reason}", now_us)
