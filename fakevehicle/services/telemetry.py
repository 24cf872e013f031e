"""The content of every message the vehicle sends by itself: one method a message, from the estimate or the sensor.

Only HIL_STATE_QUATERNION shows the simulator's truth. A builder gives None while it has nothing true to say: no
attitude before the alignment, no position before the fix. Numbers that MAVLink packs into small integers are clipped
to what fits. What this vehicle does not have or know yet (a rangefinder, the wind) it does not send.

The file is long since it is a list: 24 messages, each read against its definition on one screen.
"""

import math
from collections.abc import Mapping

import numpy as np

from fakevehicle.codec import Layout, Message
from fakevehicle.config import VehicleConfig
from fakevehicle.flight import FlightStack
from fakevehicle.places import Places
from fakevehicle.sensors.gauge import Gauge
from fakevehicle.services.service import Builder, Service
from fakevehicle.supervisor import Supervisor
from fakevehicle.vocabulary import Estimate, FloatArray
from wire.dialect import mavlink

G = 9.80665
NAN = math.nan
_UNKNOWN16 = 0xFFFF
VERSION = 0 << 24 | 1 << 16 | 0 << 8 | mavlink.FIRMWARE_VERSION_TYPE_DEV
OWN_VERSION = list(b"sim0.1.0")
"""flight_custom_version: eight bytes, text as ArduPilot has there."""
CAPABILITIES = (
    mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_FLOAT
    | mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_FLOAT
    | mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_FTP
    | mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
    | mavlink.MAV_PROTOCOL_CAPABILITY_SET_ATTITUDE_TARGET
    | mavlink.MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_LOCAL_NED
    | mavlink.MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_GLOBAL_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
    | mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_FENCE
    | mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_RALLY
)
_INERTIAL = mavlink.MAV_SYS_STATUS_SENSOR_3D_GYRO | mavlink.MAV_SYS_STATUS_SENSOR_3D_ACCEL
_SENSORS = (  # there is no receiver for sticks, and none is needed
    _INERTIAL
    | mavlink.MAV_SYS_STATUS_SENSOR_3D_MAG
    | mavlink.MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE
    | mavlink.MAV_SYS_STATUS_SENSOR_GPS
    | mavlink.MAV_SYS_STATUS_SENSOR_MOTOR_OUTPUTS
    | mavlink.MAV_SYS_STATUS_SENSOR_BATTERY
    | mavlink.MAV_SYS_STATUS_AHRS
    | mavlink.MAV_SYS_STATUS_PREARM_CHECK
)

_ATTITUDE = Layout(mavlink.MAVLink_attitude_message)
_ATTITUDE_QUATERNION = Layout(mavlink.MAVLink_attitude_quaternion_message)
_LOCAL_POSITION_NED = Layout(mavlink.MAVLink_local_position_ned_message)
_GLOBAL_POSITION_INT = Layout(mavlink.MAVLink_global_position_int_message)
_HIGHRES_IMU = Layout(mavlink.MAVLink_highres_imu_message)
_ODOMETRY = Layout(mavlink.MAVLink_odometry_message)
_HIL_STATE_QUATERNION = Layout(mavlink.MAVLink_hil_state_quaternion_message)
_WIND_COV = Layout(mavlink.MAVLink_wind_cov_message)
"""What goes out ten times a second and more."""


class Telemetry(Service):
    """Builds messages from the vehicle's parts.

    `now_us` is set by the vehicle at each tick; `software` is flight_sw_version.
    """

    def __init__(
        self,
        config: VehicleConfig,
        software: int,
        stack: FlightStack,
        supervisor: Supervisor,
        battery: Gauge,
        places: Places,
    ) -> None:
        self._config = config
        self._software = software
        self._stack = stack
        self._supervisor = supervisor
        self._battery = battery
        self._places = places
        self.now_us = 0

    @property
    def estimate(self) -> Estimate:
        """The estimator's newest; made once a tick at most."""
        return self._stack.estimate

    def builders(self) -> Mapping[int, Builder]:
        """By message id: everything the vehicle can stream or send on request."""
        m = mavlink
        return {
            m.MAVLINK_MSG_ID_SYS_STATUS: self.sys_status,
            m.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: self.extended_sys_state,
            m.MAVLINK_MSG_ID_SYSTEM_TIME: self.system_time,
            m.MAVLINK_MSG_ID_AUTOPILOT_VERSION: self.autopilot_version,
            m.MAVLINK_MSG_ID_ATTITUDE: self.attitude,
            m.MAVLINK_MSG_ID_ATTITUDE_QUATERNION: self.attitude_quaternion,
            m.MAVLINK_MSG_ID_LOCAL_POSITION_NED: self.local_position_ned,
            m.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: self.global_position_int,
            m.MAVLINK_MSG_ID_ODOMETRY: self.odometry,
            m.MAVLINK_MSG_ID_HIGHRES_IMU: self.highres_imu,
            m.MAVLINK_MSG_ID_GPS_RAW_INT: self.gps_raw_int,
            m.MAVLINK_MSG_ID_GPS_GLOBAL_ORIGIN: self.gps_global_origin,
            m.MAVLINK_MSG_ID_HOME_POSITION: self.home_position,
            m.MAVLINK_MSG_ID_ALTITUDE: self.altitude,
            m.MAVLINK_MSG_ID_VFR_HUD: self.vfr_hud,
            m.MAVLINK_MSG_ID_POSITION_TARGET_LOCAL_NED: self.position_target,
            m.MAVLINK_MSG_ID_POSITION_TARGET_GLOBAL_INT: self.position_target_global,
            m.MAVLINK_MSG_ID_ATTITUDE_TARGET: self.attitude_target,
            m.MAVLINK_MSG_ID_SERVO_OUTPUT_RAW: self.servo_output_raw,
            m.MAVLINK_MSG_ID_BATTERY_STATUS: self.battery_status,
            m.MAVLINK_MSG_ID_ESTIMATOR_STATUS: self.estimator_status,
            m.MAVLINK_MSG_ID_WIND_COV: self.wind_cov,
            m.MAVLINK_MSG_ID_HIL_STATE_QUATERNION: self.hil_state_quaternion,
        }

    # What the vehicle is doing

    def extended_sys_state(self) -> Message:
        s = self._supervisor
        if not s.airborne:
            landed = mavlink.MAV_LANDED_STATE_ON_GROUND
        elif s.landing:
            landed = mavlink.MAV_LANDED_STATE_LANDING
        elif s.taking_off:
            landed = mavlink.MAV_LANDED_STATE_TAKEOFF
        else:
            landed = mavlink.MAV_LANDED_STATE_IN_AIR
        return mavlink.MAVLink_extended_sys_state_message(mavlink.MAV_VTOL_STATE_UNDEFINED, landed)

    def sys_status(self) -> Message:
        """Health as the estimator has it; PREARM says whether arming would be accepted now (or has been).

        The geofence is there when one is loaded, and in order while it is not breached: clients call out its breach
        when its health goes, whether it is there or not.
        """
        e, s, b = self.estimate, self._supervisor, self._battery
        health = mavlink.MAV_SYS_STATUS_SENSOR_MOTOR_OUTPUTS
        if "imu" not in e.silent:
            health |= _INERTIAL
        if "baro" not in e.silent:
            health |= mavlink.MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE
        if "mag" not in e.silent:
            health |= mavlink.MAV_SYS_STATUS_SENSOR_3D_MAG
        if self._stack.gps is not None and "gps" not in e.silent:
            health |= mavlink.MAV_SYS_STATUS_SENSOR_GPS
        if e.attitude_valid:
            health |= mavlink.MAV_SYS_STATUS_AHRS
        if s.armed or s.why_not_armable(self.now_us) is None:
            health |= mavlink.MAV_SYS_STATUS_PREARM_CHECK
        if s.battery_good and not b.silent:
            health |= mavlink.MAV_SYS_STATUS_SENSOR_BATTERY
        if s.fence.breach is None:
            health |= mavlink.MAV_SYS_STATUS_GEOFENCE
        fence = mavlink.MAV_SYS_STATUS_GEOFENCE if s.fence.present else 0
        enabled = _SENSORS | (fence if s.fence.enabled else 0)
        millivolts, centiamps, percent = round(b.voltage * 1e3), round(b.current * 1e2), round(b.remaining * 100)
        if b.silent:
            millivolts, centiamps, percent = _UNKNOWN16, -1, -1
        return mavlink.MAVLink_sys_status_message(
            _SENSORS | fence, enabled, health, 0, millivolts, centiamps, percent, 0, 0, 0, 0, 0, 0
        )

    def system_time(self) -> Message:
        start = self._config.start_unix_us
        return mavlink.MAVLink_system_time_message(start + self.now_us if start else 0, self._boot_ms)

    def autopilot_version(self) -> Message:
        """The version of what is imitated, our own beside it (the middleware's, and in text), capabilities it has."""
        none = [0] * 8
        uid = self._config.system_id
        return mavlink.MAVLink_autopilot_version_message(
            CAPABILITIES,
            self._software,
            VERSION,
            0,
            0,
            OWN_VERSION,
            none,
            none,
            0,
            0,
            uid,
            [*uid.to_bytes(2, "little"), *[0] * 16],
        )

    # Where it is

    def attitude(self) -> Message | None:
        g = self._stack.glance
        if not g.attitude_valid:
            return None
        w, x, y, z = g.q_nb
        roll = math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
        pitch = math.asin(min(1.0, max(-1.0, 2.0 * (w * y - z * x))))
        return _ATTITUDE(self._boot_ms, roll, pitch, g.yaw, *g.omega_b)

    def attitude_quaternion(self) -> Message | None:
        g = self._stack.glance
        if not g.attitude_valid:
            return None
        return _ATTITUDE_QUATERNION(self._boot_ms, *g.q_nb, *g.omega_b, 0.0, 0.0, 0.0, 0.0)

    def local_position_ned(self) -> Message | None:
        g = self._stack.glance
        if not g.position_valid:
            return None
        return _LOCAL_POSITION_NED(self._boot_ms, g.x, g.y, g.z, g.vx, g.vy, g.vz)

    def global_position_int(self) -> Message | None:
        g, s = self._stack.glance, self._supervisor
        if not g.position_valid:
            return None
        place = self._places.e7(np.array((g.x, g.y, g.z)))
        if place is None:
            return None
        ground = float(s.home.position_n[2]) if s.home is not None else 0.0
        relative = round((ground - g.z) * 1e3)
        velocity = _clip16(g.vx * 100.0), _clip16(g.vy * 100.0), _clip16(g.vz * 100.0)
        return _GLOBAL_POSITION_INT(self._boot_ms, *place, relative, *velocity, _centidegrees(g.yaw))

    def odometry(self) -> Message | None:
        """Pose and velocity in local NED, body rates; variances of what the filter estimates.

        PX4 sends the velocity in local NED too (child frame 1, and not FRD), with its variances in that frame, and
        quality 0, unknown. The attitude's variances are of turns about the body's axes.
        """
        e = self.estimate
        if not (e.attitude_valid and e.position_valid):
            return None
        t1, t2, t3, v1, v2, v3, p1, p2, p3 = e.covariance.diagonal()[:9].tolist()
        return _ODOMETRY(
            self.now_us,
            *e.position_n.tolist(),
            *e.q_nb.tolist(),
            *e.velocity_n.tolist(),
            *e.omega_b.tolist(),
            *_upper_triangle(p1, p2, p3, t1, t2, t3),
            *_upper_triangle(v1, v2, v3, NAN, NAN, NAN),
            mavlink.MAV_FRAME_LOCAL_NED,
            mavlink.MAV_FRAME_LOCAL_NED,
            e.resets.count & 0xFF,
            mavlink.MAV_ESTIMATOR_TYPE_AUTOPILOT,
            0,
        )

    def home_position(self) -> Message | None:
        home = self._supervisor.home
        if home is None:
            return None
        place = self._places.e7(home.position_n)
        if place is None:
            return None
        half = 0.5 * home.yaw
        q = (math.cos(half), 0.0, 0.0, math.sin(half))
        return mavlink.MAVLink_home_position_message(*place, *home.position_n.tolist(), q, NAN, NAN, NAN, self.now_us)

    def gps_global_origin(self) -> Message | None:
        place = self._places.e7(np.zeros(3))
        return None if place is None else mavlink.MAVLink_gps_global_origin_message(*place, self.now_us)

    def altitude(self) -> Message | None:
        g, s, origin = self._stack.glance, self._supervisor, self._stack.origin
        if not g.altitude_valid or origin is None:
            return None
        up = -g.z
        amsl = origin.altitude + up
        above_home = up + float(s.home.position_n[2]) if s.home is not None else NAN
        clear = self._stack.clearance
        below = NAN if clear is None else clear
        return mavlink.MAVLink_altitude_message(self.now_us, amsl, amsl, up, above_home, below, below)

    def vfr_hud(self) -> Message | None:
        g, origin = self._stack.glance, self._stack.origin
        if not g.velocity_valid or origin is None:
            return None
        heading = round(math.degrees(g.yaw)) % 360
        throttle = round(100 * g.thrust) if self._supervisor.armed else 0
        amsl = origin.altitude - g.z
        return mavlink.MAVLink_vfr_hud_message(0.0, math.hypot(g.vx, g.vy), heading, throttle, amsl, -g.vz)

    # What it senses

    def highres_imu(self) -> Message:
        imu, mag, baro = self._stack.imu, self._stack.mag, self._stack.baro
        return _HIGHRES_IMU(
            self.now_us,
            *imu.specific_force_b.tolist(),
            *imu.omega_b.tolist(),
            *mag.field_b.tolist(),
            baro.pressure / 100.0,
            0.0,
            baro.altitude,
            baro.temperature,
            0b1_1011_1111_1111,  # everything but the differential pressure
            0,
        )

    def gps_raw_int(self) -> Message | None:
        gps = self._stack.gps
        if gps is None:
            return None
        vn, ve, _ = gps.velocity_n.tolist()
        ground_speed = math.hypot(vn, ve)
        course = _centidegrees(math.atan2(ve, vn)) if ground_speed > 0.1 else _UNKNOWN16
        millimetres = round(gps.position.altitude * 1e3)
        return mavlink.MAVLink_gps_raw_int_message(
            gps.now_us,
            gps.fix_type,
            round(math.degrees(gps.position.latitude) * 1e7),
            round(math.degrees(gps.position.longitude) * 1e7),
            millimetres,
            _UNKNOWN16,  # eph and epv are dilutions of precision, which the receiver does not model
            _UNKNOWN16,
            min(round(ground_speed * 100), _UNKNOWN16),
            course,
            gps.satellites,
            0,
            round(gps.eph * 1e3),
            round(gps.epv * 1e3),
            round(gps.speed_accuracy * 1e3),
        )

    def battery_status(self) -> Message | None:
        b = self._battery
        if b.silent:
            return None
        cells = min(b.pack.cells, 10)  # what the field has room for
        cell = round(b.voltage / b.pack.cells * 1e3)
        return mavlink.MAVLink_battery_status_message(
            0,
            mavlink.MAV_BATTERY_FUNCTION_ALL,
            mavlink.MAV_BATTERY_TYPE_LIPO,
            0x7FFF,
            [cell] * cells + [_UNKNOWN16] * (10 - cells),
            round(b.current * 100),
            round(b.used / 3.6),
            -1,
            round(b.remaining * 100),
            0,
            mavlink.MAV_BATTERY_CHARGE_STATE_OK,
        )

    # What it tries

    def position_target(self) -> Message | None:
        """What the position loop follows, NaN where it follows nothing."""
        if not self._supervisor.armed:
            return None
        s = self._stack.control.setpoint
        return mavlink.MAVLink_position_target_local_ned_message(
            self._boot_ms,
            mavlink.MAV_FRAME_LOCAL_NED,
            0,
            *s.position_n.tolist(),
            *s.velocity_n.tolist(),
            *s.acceleration_n.tolist(),
            s.yaw,
            s.yaw_rate,
        )

    def position_target_global(self) -> Message | None:
        """The place the position loop follows, altitude above mean sea level; nothing while it follows none."""
        s = self._stack.control.setpoint
        place = None
        if self._supervisor.armed and bool(np.isfinite(s.position_n).all()):
            place = self._places.e7(s.position_n)
        if place is None:
            return None
        latitude, longitude, millimetres = place
        return mavlink.MAVLink_position_target_global_int_message(
            self._boot_ms,
            mavlink.MAV_FRAME_GLOBAL_INT,
            0,
            latitude,
            longitude,
            millimetres * 1e-3,
            *s.velocity_n.tolist(),
            *s.acceleration_n.tolist(),
            s.yaw,
            s.yaw_rate,
        )

    def attitude_target(self) -> Message | None:
        if not self._supervisor.armed:
            return None
        c = self._stack.control
        return mavlink.MAVLink_attitude_target_message(
            self._boot_ms, 0, c.attitude_setpoint_q_nb.tolist(), *c.rate_setpoint_b.tolist(), c.thrust
        )

    def servo_output_raw(self) -> Message:
        """Motor commands as pulse widths: 1000 to 2000 us, 900 while disarmed, as PX4's SIH shows them."""
        if self._supervisor.armed:
            pulses = [1000 + round(1000 * min(max(m, 0.0), 1.0)) for m in self._stack.control.motor.tolist()]
        else:
            pulses = [900] * 4
        return mavlink.MAVLink_servo_output_raw_message(self.now_us & 0xFFFFFFFF, 0, *pulses, 0, 0, 0, 0)

    def estimator_status(self) -> Message:
        """Flags of what the filter knows, and its innovation test ratios (above 1: rejected)."""
        e = self.estimate
        flags = 0
        if e.velocity_valid or e.climb_valid:
            flags |= mavlink.ESTIMATOR_VELOCITY_VERT
        if "imu" in e.silent:
            flags |= mavlink.ESTIMATOR_ACCEL_ERROR
        above_ground = NAN
        if self._stack.clearance is not None:
            above_ground = self._stack.terrain.test_ratio
            flags |= mavlink.ESTIMATOR_POS_VERT_AGL
        if e.attitude_valid:
            flags |= mavlink.ESTIMATOR_ATTITUDE
        if e.velocity_valid:
            flags |= mavlink.ESTIMATOR_VELOCITY_HORIZ
        if e.position_valid:
            flags |= mavlink.ESTIMATOR_POS_HORIZ_REL | mavlink.ESTIMATOR_POS_HORIZ_ABS
            flags |= mavlink.ESTIMATOR_PRED_POS_HORIZ_REL | mavlink.ESTIMATOR_PRED_POS_HORIZ_ABS
        else:
            flags |= mavlink.ESTIMATOR_CONST_POS_MODE
        if e.altitude_valid:
            flags |= mavlink.ESTIMATOR_POS_VERT_ABS
        ratio = e.test_ratio
        if ratio.get("gps_position", 0.0) > 1.0:
            flags |= mavlink.ESTIMATOR_GPS_GLITCH
        north, east, down = e.covariance.diagonal()[6:9].tolist()
        return mavlink.MAVLink_estimator_status_message(
            self.now_us,
            flags,
            ratio.get("gps_velocity", NAN),
            ratio.get("gps_position", NAN),
            ratio.get("baro", NAN),
            ratio.get("mag", NAN),
            above_ground,
            NAN,
            math.sqrt(max(north + east, 0.0)),
            math.sqrt(max(down, 0.0)),
        )

    def wind_cov(self) -> Message | None:
        """The mean wind over ground as the estimator last knew it; its vertical part is not estimated."""
        wind, origin = self._stack.wind, self._stack.origin
        if wind is None or origin is None:
            return None
        height = origin.altitude - self._stack.glance.z
        return _WIND_COV(self.now_us, wind.north, wind.east, NAN, wind.scatter, NAN, height, wind.sigma, NAN)

    def hil_state_quaternion(self) -> Message:
        """The simulator's truth. Acceleration is kinematic, turned into the body frame [mG]; no air speed is given."""
        t = self._stack.truth
        q = t.q_nb.tolist()
        latitude, longitude, millimetres = self._places.truth_e7(t.position_n)
        acceleration = [_clip16(a / G * 1e3) for a in _into_body(q, t.acceleration_n.tolist())]
        return _HIL_STATE_QUATERNION(
            self.now_us,
            *q,
            *t.omega_b.tolist(),
            latitude,
            longitude,
            millimetres,
            *_centi(t.velocity_n),
            0,
            0,
            *acceleration,
        )

    @property
    def _boot_ms(self) -> int:
        return self.now_us // 1000 & 0xFFFFFFFF


def _clip16(value: float) -> int:
    return min(max(round(value), -32768), 32767)


def _centi(values: FloatArray) -> tuple[int, int, int]:
    x, y, z = values.tolist()
    return _clip16(x * 100.0), _clip16(y * 100.0), _clip16(z * 100.0)


def _centidegrees(angle: float) -> int:
    """0..35999."""
    return round(math.degrees(angle) * 100.0) % 36000


def _into_body(q: list[float], v: list[float]) -> tuple[float, float, float]:
    """R(q)^T v for a wxyz quaternion that takes b to n; plain floats are faster than arrays here."""
    w, x, y, z = q
    a, b, c = v
    # v' = v + 2 u x (u x v + w v) with u = -(x, y, z): the inverse rotation
    tx, ty, tz = z * b - y * c + w * a, x * c - z * a + w * b, y * a - x * b + w * c
    return a + 2.0 * (z * ty - y * tz), b + 2.0 * (x * tz - z * tx), c + 2.0 * (y * tx - x * ty)


def _upper_triangle(a: float, b: float, c: float, d: float, e: float, f: float) -> list[float]:
    """Row-major upper triangle of a 6x6 matrix with this diagonal, NaN (not estimated) elsewhere."""
    n = NAN
    return [a, n, n, n, n, n, b, n, n, n, n, c, n, n, n, d, n, n, e, n, f]
