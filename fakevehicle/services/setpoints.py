"""OFFBOARD setpoints from the wire: the local, the global and the attitude one of MAVLink's SET_..._TARGET messages.

Bits of `type_mask` mean *ignore*, one an axis; NaN means the same. LOCAL_NED is the estimator's frame. In BODY_NED the
velocity and acceleration are turned by the heading at the time of arrival (the roll and pitch of the vehicle do not
count, as in PX4), and a position has no meaning. What cannot be flown is refused with a text, at most once a second:
a stream of refusals would drown the rest. The sender's clock (`time_boot_ms`) is never looked at.
"""

import math
from collections.abc import Callable, Mapping

import numpy as np

from fakevehicle.codec import Message
from fakevehicle.places import Places
from fakevehicle.services.commands import RADIANS_PER_E7
from fakevehicle.services.outbox import Sender
from fakevehicle.services.service import Handler, Service
from fakevehicle.supervisor import Supervisor
from fakevehicle.vocabulary import FloatArray, Geodetic, Setpoint
from wire.dialect import mavlink

FORCE = 0x200
IGNORE_THRUST, IGNORE_ATTITUDE = 0x40, 0x80
IGNORE_YAW = 0x400
IGNORE_YAW_RATE = 0x800
QUIET_US = 1_000_000
_GLOBAL = (mavlink.MAV_FRAME_GLOBAL, mavlink.MAV_FRAME_GLOBAL_INT)
_RELATIVE = (mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT, mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT)


class Setpoints(Service):
    """Reads setpoints and hands them to the supervisor."""

    def __init__(self, supervisor: Supervisor, places: Places, warn: Callable[[str], None]) -> None:
        self._supervisor = supervisor
        self._places = places
        self._warn = warn
        self._warned_us: dict[str, int] = {}  # a handful of fixed texts
        self.rejected = 0

    def routes(self) -> Mapping[int, Handler]:
        """The three setpoint messages."""
        return {
            mavlink.MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED: self.local_ned,
            mavlink.MAVLINK_MSG_ID_SET_POSITION_TARGET_GLOBAL_INT: self.global_int,
            mavlink.MAVLINK_MSG_ID_SET_ATTITUDE_TARGET: self.attitude,
        }

    def local_ned(self, _sender: Sender, message: Message, now_us: int) -> None:
        """SET_POSITION_TARGET_LOCAL_NED."""
        m = message
        position_n = np.array([m.x, m.y, m.z])
        if m.coordinate_frame == mavlink.MAV_FRAME_LOCAL_NED:
            turn = 0.0
        elif m.coordinate_frame == mavlink.MAV_FRAME_BODY_NED:
            heading = self._supervisor.yaw
            if heading is None:
                self._refuse("attitude not known yet", now_us)
                return
            turn = heading
            position_n[:] = math.nan
        else:
            self._refuse("frame must be LOCAL_NED (1) or BODY_NED (8)", now_us)
            return
        self._take(m, position_n, turn, now_us)

    def global_int(self, _sender: Sender, message: Message, now_us: int) -> None:
        """SET_POSITION_TARGET_GLOBAL_INT: latitude and longitude e7, altitude above sea level or above home."""
        m = message
        origin, home = self._places.origin, self._supervisor.home
        if origin is None or home is None:
            self._refuse("position not known yet", now_us)
            return
        if m.coordinate_frame not in _GLOBAL + _RELATIVE:
            self._refuse("frame must be GLOBAL_INT or GLOBAL_RELATIVE_ALT_INT", now_us)
            return
        if abs(m.lat_int) > 900_000_000 or abs(m.lon_int) > 1_800_000_000:
            self._refuse("place is not on the globe", now_us)
            return
        place = Geodetic(m.lat_int * RADIANS_PER_E7, m.lon_int * RADIANS_PER_E7, origin.altitude)
        position_n = self._places.local(place)
        if position_n is None:
            self._refuse("position not known yet", now_us)
            return
        relative = m.coordinate_frame in _RELATIVE
        position_n[2] = (float(home.position_n[2]) if relative else origin.altitude) - m.alt
        self._take(m, position_n, 0.0, now_us)

    def attitude(self, _sender: Sender, message: Message, now_us: int) -> None:
        """SET_ATTITUDE_TARGET: an attitude, body rates or both, and the collective thrust, 0..1 of the maximum.

        A rate that is not given is zero where rates alone are flown. Without a thrust nothing can be flown.
        """
        m = message
        q_nb, rate_b = np.array(m.q), np.array([m.body_roll_rate, m.body_pitch_rate, m.body_yaw_rate])
        rate_b = _masked(rate_b, m.type_mask)
        if m.type_mask & IGNORE_ATTITUDE or np.isnan(q_nb).any():
            q_nb[:] = math.nan
            if np.isnan(rate_b).all():
                self._refuse("it asks for nothing", now_us)
                return
            rate_b = np.nan_to_num(rate_b, nan=0.0)
        norm = float(np.linalg.norm(q_nb))
        if norm < SMALLEST_NORM or math.isinf(norm) or bool((np.abs(rate_b) > LARGEST_RATE).any()):
            self._refuse("that attitude or rate cannot be", now_us)
            return
        if m.type_mask & IGNORE_THRUST or not 0.0 <= m.thrust <= 1.0:
            self._refuse("a thrust of 0 to 1 is needed", now_us)
            return
        setpoint = Setpoint(attitude_q_nb=q_nb / norm, rate_b=rate_b, thrust=float(m.thrust))
        self._supervisor.offboard(now_us, setpoint)

    def _take(self, m: Message, position_n: FloatArray, turn: float, now_us: int) -> None:
        mask = m.type_mask
        position_n = _masked(position_n, mask)
        velocity_n = _turned(_masked(np.array([m.vx, m.vy, m.vz]), mask >> 3), turn)
        acceleration_n = _turned(_masked(np.array([m.afx, m.afy, m.afz]), mask >> 6), turn)
        yaw = math.nan if mask & IGNORE_YAW else m.yaw
        yaw_rate = math.nan if mask & IGNORE_YAW_RATE else m.yaw_rate
        if mask & FORCE and not np.isnan(acceleration_n).all():
            self._refuse("forces are not supported", now_us)
            return
        if np.isnan(position_n).all() and np.isnan(velocity_n).all() and np.isnan(acceleration_n).all():
            self._refuse("it asks for nothing", now_us)
            return
        values = (*position_n.tolist(), *velocity_n.tolist(), *acceleration_n.tolist(), yaw, yaw_rate)
        if any(abs(value) > LARGEST for value in values):  # NaN is not larger than anything
            self._refuse("a value is infinite or absurdly large", now_us)
            return
        self._supervisor.offboard(now_us, Setpoint(position_n, velocity_n, acceleration_n, yaw, yaw_rate))

    def _refuse(self, reason: str, now_us: int) -> None:
        self.rejected += 1
        if now_us - self._warned_us.get(reason, -QUIET_US) >= QUIET_US:
            self._warned_us[reason] = now_us
            self._warn(f"Setpoint refused: {reason}")


SMALLEST_NORM = 0.1
"""A quaternion shorter than this is none."""
LARGEST_RATE = 30.0
"""No body rate is larger than this [rad/s]."""
LARGEST = 1e5
"""Nothing in a setpoint is larger than this [m, m/s, m/s^2, rad]."""


def _masked(values: FloatArray, mask: int) -> FloatArray:
    """NaN where one of the three low bits of `mask` says to ignore."""
    for axis in range(3):
        if mask >> axis & 1:
            values[axis] = math.nan
    return values


def _turned(values_b: FloatArray, yaw: float) -> FloatArray:
    """Turned about the vertical from heading-aligned axes into north and east; one ignored axis of the two is zero."""
    x, y, z = values_b.tolist()
    if yaw == 0.0 or (math.isnan(x) and math.isnan(y)):
        return values_b
    x, y = (0.0 if math.isnan(x) else x), (0.0 if math.isnan(y) else y)
    c, s = math.cos(yaw), math.sin(yaw)
    return np.array([c * x - s * y, s * x + c * y, z])
