"""What the vehicle says of itself: the newest value of each message the companion flies by.

Only messages of the one configured vehicle (its system id, component 1) get here; `Telemetry.take` is called once a
packet and decodes only the kinds listed in `HANDLERS`. UDP may bring an old packet late or a packet twice: a position
or an attitude that is not newer than the last is dropped by its time since boot, and what only changes when people or
failsafes act (mode, arming) is sure when nothing else was said for a while before.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from companion.fields import attitude, boot_ms, local_position_ned
from wire.dialect import mavlink
from wire.framing import Packet

FloatArray = NDArray[np.float64]

REBOOT_MS = 1_000
"""A time since boot that goes back farther than this is another boot; less is a packet that came late."""
REBOOT_SAMPLES = 3
"""So many in a row must say so."""
SURE_US = 300_000
"""No report comes later than this after one that was sent after it."""
NEVER_US = 10**15
MAX_CHUNKED, MAX_CHUNKS, MAX_WAITING = 16, 8, 64


@dataclass(slots=True)
class Ack:
    """A COMMAND_ACK as it came; targets of 0 mean everybody."""

    command: int
    result: int  # MAV_RESULT
    target_system: int = 0
    target_component: int = 0


@dataclass(slots=True)
class Telemetry:
    """Newest values; None until heard. Vectors are in the vehicle's local frame n (NED)."""

    heartbeat_us: int | None = None
    autopilot: int = 0  # MAV_AUTOPILOT
    armed: bool = False
    armed_for_us: int = NEVER_US  # since a HEARTBEAT last said the contrary, as of the newest
    custom_mode: int = 0  # by HEARTBEAT or CURRENT_MODE, whichever came last
    mode_for_us: int = NEVER_US  # since they last said another, as of the newest
    intended_mode: int | None = None  # CURRENT_MODE: what was asked for last
    system_status: int = 0  # MAV_STATE
    boot_ms: int | None = None  # time since boot, of the newest position or attitude
    boots: int = 1  # how often the vehicle was seen to boot, the first included
    position_us: int | None = None
    position_n: FloatArray = field(default_factory=lambda: np.zeros(3))  # (3,) [m]
    velocity_n: FloatArray = field(default_factory=lambda: np.zeros(3))  # (3,) [m/s]
    attitude_us: int | None = None
    roll: float = 0.0  # [rad]
    pitch: float = 0.0  # [rad]
    yaw: float = 0.0  # [rad]
    global_e7: tuple[int, int, int] | None = None  # latitude, longitude [deg * 1e7], altitude [mm] of now
    origin_e7: tuple[int, int, int] | None = None  # the same of the local frame's origin
    home_e7: tuple[int, int, int] | None = None  # the same of home, which moves
    landed_state: int = 0  # MAV_LANDED_STATE
    prearm_ok: bool = False  # SYS_STATUS: every pre-arm check passes
    battery: float | None = None  # what is left, 0..1
    estimator_us: int | None = None
    estimator_flags: int | None = None  # of ESTIMATOR_STATUS (PX4) or EKF_STATUS_REPORT (ArduPilot)
    rejected: list[str] = field(default_factory=list)  # whose innovation is outside its gate
    parameters: dict[str, bytes] = field(default_factory=dict)  # the raw four bytes of param_value, for those asked for
    acks: list[Ack] = field(default_factory=list)  # taken and emptied once a tick
    texts: list[tuple[int, str]] = field(default_factory=list)  # (severity, text) of STATUSTEXT, likewise
    _arming_us: int = -NEVER_US
    _other_arming_us: int = -NEVER_US
    _mode_us: int = -NEVER_US
    _other_mode_us: int = -NEVER_US
    _chunks: dict[int, list[str]] = field(default_factory=dict)  # STATUSTEXT id -> chunks so far
    _newest: dict[int, int] = field(default_factory=dict)  # message id -> its newest time since boot
    _back: list[int] = field(default_factory=list)  # times since boot that may be another boot's

    def take(self, now_us: int, packet: Packet, mav: Any) -> None:
        """Decode one packet and keep what it says; kinds we do not fly by cost nothing."""
        frequent = FREQUENT.get(packet.message_id)
        if frequent is not None:
            if self._is_newer(packet.message_id, boot_ms(packet.payload)):
                frequent(self, now_us, packet.payload)
            return
        handler = HANDLERS.get(packet.message_id)
        if handler is not None:
            handler(self, now_us, mav.decode(bytearray(packet.raw)))

    def _is_newer(self, message_id: int, stamp_ms: int) -> bool:
        """Whether a packet is not a late or a doubled one; notices a reboot."""
        newest = self._newest.get(message_id)
        if newest is not None:
            ahead_ms = (stamp_ms - newest + 2**31) % 2**32 - 2**31  # the count wraps after 49 days
            if ahead_ms < -REBOOT_MS:
                self._count_back(stamp_ms)
                return False
            if ahead_ms <= 0:
                return False
        self._back.clear()
        self._newest[message_id] = stamp_ms
        self.boot_ms = stamp_ms
        return True

    def _count_back(self, stamp_ms: int) -> None:
        """Another boot is `REBOOT_SAMPLES` old stamps in a row that do not fall; what was known before it is void."""
        if self._back and stamp_ms < self._back[-1]:
            self._back.clear()
        self._back.append(stamp_ms)
        if len(self._back) >= REBOOT_SAMPLES:
            self.forget()
            self.boots += 1

    def forget(self) -> None:
        """Another boot, or another connection: nothing that was said before it counts."""
        kept = (self.heartbeat_us, self.autopilot, self.boots, self.texts, self.parameters)
        for name, value in _fields(Telemetry()).items():
            setattr(self, name, value)
        self.heartbeat_us, self.autopilot, self.boots, self.texts, self.parameters = kept

    @property
    def mode_is_sure(self) -> bool:
        """Whether the mode is not perhaps an old one, told by packets that came late."""
        return self.mode_for_us >= SURE_US

    @property
    def mode_told_us(self) -> int:
        """When it last said in which mode it is."""
        return max(self._mode_us, 0)

    @property
    def arming_is_sure(self) -> bool:
        """The same of `armed`."""
        return self.armed_for_us >= SURE_US

    def _mode(self, now_us: int, mode: int) -> None:
        if mode != self.custom_mode:
            self._other_mode_us = self._mode_us
        self.custom_mode, self._mode_us, self.mode_for_us = mode, now_us, now_us - self._other_mode_us

    def _heartbeat(self, now_us: int, m: Any) -> None:
        self.heartbeat_us = now_us
        self.autopilot = m.autopilot
        armed = bool(m.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
        if armed != self.armed:
            self._other_arming_us = self._arming_us
        self.armed, self._arming_us, self.armed_for_us = armed, now_us, now_us - self._other_arming_us
        self.system_status = m.system_status
        self._mode(now_us, m.custom_mode)

    def _current_mode(self, now_us: int, m: Any) -> None:
        self.intended_mode = m.intended_custom_mode
        self._mode(now_us, m.custom_mode)

    def _local_position(self, now_us: int, payload: bytes) -> None:
        values = local_position_ned(payload)
        if all(map(math.isfinite, values)):
            self.position_us = now_us
            self.position_n = np.array(values[:3])
            self.velocity_n = np.array(values[3:])

    def _attitude(self, now_us: int, payload: bytes) -> None:
        angles = attitude(payload)
        if all(map(math.isfinite, angles)):
            self.attitude_us = now_us
            self.roll, self.pitch, self.yaw = angles

    def _global_position(self, now_us: int, m: Any) -> None:
        self.global_e7 = (m.lat, m.lon, m.alt)

    def _origin(self, now_us: int, m: Any) -> None:
        self.origin_e7 = (m.latitude, m.longitude, m.altitude)

    def _home(self, now_us: int, m: Any) -> None:
        self.home_e7 = (m.latitude, m.longitude, m.altitude)

    def _extended_state(self, now_us: int, m: Any) -> None:
        self.landed_state = m.landed_state

    def _sys_status(self, now_us: int, m: Any) -> None:
        self.prearm_ok = bool(m.onboard_control_sensors_health & mavlink.MAV_SYS_STATUS_PREARM_CHECK)
        self.battery = m.battery_remaining / 100.0 if m.battery_remaining >= 0 else None

    def _estimator_status(self, now_us: int, m: Any) -> None:
        self.estimator_us, self.estimator_flags = now_us, m.flags
        self._rejects(m.vel_ratio, m.pos_horiz_ratio, m.pos_vert_ratio, m.mag_ratio)

    def _ekf_status(self, now_us: int, m: Any) -> None:
        self.estimator_us, self.estimator_flags = now_us, m.flags
        self._rejects(m.velocity_variance, m.pos_horiz_variance, m.pos_vert_variance, m.compass_variance)

    def _rejects(self, velocity: float, horizontal: float, height: float, magnetometer: float) -> None:
        """Ratios of an innovation to its gate: above 1 the measurement is not used."""
        ratios = {
            "velocity": velocity,
            "horizontal position": horizontal,
            "height": height,
            "magnetometer": magnetometer,
        }
        self.rejected = [name for name, ratio in ratios.items() if ratio > 1.0]

    def _command_ack(self, now_us: int, m: Any) -> None:
        if len(self.acks) < MAX_WAITING:
            self.acks.append(Ack(m.command, m.result, m.target_system, m.target_component))

    def _parameter(self, now_us: int, m: Any) -> None:
        if m.param_id in self.parameters:
            self.parameters[m.param_id] = bytes(m.get_msgbuf()[10:14]) if m.get_msgbuf()[0] == 0xFD else b""

    def _statustext(self, now_us: int, m: Any) -> None:
        """A text longer than 50 characters comes in chunks with one id; the last is shorter than 50."""
        text = m.text
        if m.id:
            if len(self._chunks) >= MAX_CHUNKED and m.id not in self._chunks:
                self._chunks.clear()
            chunks = self._chunks.setdefault(m.id, [])
            chunks.append(text)
            if len(text) >= 50 and len(chunks) < MAX_CHUNKS:
                return
            text = "".join(self._chunks.pop(m.id))
        if len(self.texts) < MAX_WAITING:
            self.texts.append((m.severity, text.strip()))


FREQUENT: dict[int, Callable[[Telemetry, int, bytes], None]] = {
    mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED: Telemetry._local_position,
    mavlink.MAVLINK_MSG_ID_ATTITUDE: Telemetry._attitude,
}
"""Kinds that come every tick, from their payload, which begins with the time since boot."""

HANDLERS: dict[int, Callable[[Telemetry, int, Any], None]] = {
    mavlink.MAVLINK_MSG_ID_HEARTBEAT: Telemetry._heartbeat,
    mavlink.MAVLINK_MSG_ID_CURRENT_MODE: Telemetry._current_mode,
    mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: Telemetry._extended_state,
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: Telemetry._sys_status,
    mavlink.MAVLINK_MSG_ID_ESTIMATOR_STATUS: Telemetry._estimator_status,
    mavlink.MAVLINK_MSG_ID_EKF_STATUS_REPORT: Telemetry._ekf_status,
    mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: Telemetry._global_position,
    mavlink.MAVLINK_MSG_ID_GPS_GLOBAL_ORIGIN: Telemetry._origin,
    mavlink.MAVLINK_MSG_ID_HOME_POSITION: Telemetry._home,
    mavlink.MAVLINK_MSG_ID_COMMAND_ACK: Telemetry._command_ack,
    mavlink.MAVLINK_MSG_ID_PARAM_VALUE: Telemetry._parameter,
    mavlink.MAVLINK_MSG_ID_STATUSTEXT: Telemetry._statustext,
}


def _fields(telemetry: Telemetry) -> dict[str, Any]:
    return {name: getattr(telemetry, name) for name in Telemetry.__slots__}
