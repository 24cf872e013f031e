"""What the vehicle says of itself: the newest value of each message the companion flies by.

Only messages of the one configured vehicle (its system id, component 1) get here; `Telemetry.take` is called once a
packet and decodes only the kinds listed in `HANDLERS`.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from companion.fields import attitude, local_position_ned
from wire.dialect import mavlink
from wire.framing import Packet

FloatArray = NDArray[np.float64]


@dataclass(slots=True)
class Ack:
    """A COMMAND_ACK as it came."""

    command: int
    result: int  # MAV_RESULT


@dataclass(slots=True)
class Telemetry:
    """Newest values; None until heard. Vectors are in the vehicle's local frame n (NED)."""

    heartbeat_us: int | None = None
    autopilot: int = 0  # MAV_AUTOPILOT
    armed: bool = False
    custom_mode: int = 0
    system_status: int = 0  # MAV_STATE
    position_us: int | None = None
    position_n: FloatArray = field(default_factory=lambda: np.zeros(3))  # (3,) [m]
    velocity_n: FloatArray = field(default_factory=lambda: np.zeros(3))  # (3,) [m/s]
    attitude_us: int | None = None
    roll: float = 0.0  # [rad]
    pitch: float = 0.0  # [rad]
    yaw: float = 0.0  # [rad]
    landed_state: int = 0  # MAV_LANDED_STATE
    prearm_ok: bool = False  # SYS_STATUS: every pre-arm check passes
    estimator_flags: int | None = None  # ESTIMATOR_STATUS_FLAGS
    rejected: list[str] = field(default_factory=list)  # whose innovation is outside its gate
    parameters: dict[str, bytes] = field(default_factory=dict)  # the raw four bytes of param_value, for those asked for
    acks: list[Ack] = field(default_factory=list)  # taken and emptied once a tick
    texts: list[tuple[int, str]] = field(default_factory=list)  # (severity, text) of STATUSTEXT, likewise
    _chunks: dict[int, list[str]] = field(default_factory=dict)  # STATUSTEXT id -> chunks so far

    def take(self, now_us: int, packet: Packet, mav: Any) -> None:
        """Decode one packet and keep what it says; kinds we do not fly by cost nothing."""
        frequent = FREQUENT.get(packet.message_id)
        if frequent is not None:
            frequent(self, now_us, packet.payload)
            return
        handler = HANDLERS.get(packet.message_id)
        if handler is not None:
            handler(self, now_us, mav.decode(bytearray(packet.raw)))

    def _heartbeat(self, now_us: int, m: Any) -> None:
        self.heartbeat_us = now_us
        self.autopilot = m.autopilot
        self.armed = bool(m.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
        self.custom_mode = m.custom_mode
        self.system_status = m.system_status

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

    def _extended_state(self, now_us: int, m: Any) -> None:
        self.landed_state = m.landed_state

    def _sys_status(self, now_us: int, m: Any) -> None:
        self.prearm_ok = bool(m.onboard_control_sensors_health & mavlink.MAV_SYS_STATUS_PREARM_CHECK)

    def _estimator_status(self, now_us: int, m: Any) -> None:
        self.estimator_flags = m.flags
        ratios = {
            "velocity": m.vel_ratio,
            "horizontal position": m.pos_horiz_ratio,
            "height": m.pos_vert_ratio,
            "magnetometer": m.mag_ratio,
        }
        self.rejected = [name for name, ratio in ratios.items() if ratio > 1.0]

    def _command_ack(self, now_us: int, m: Any) -> None:
        if len(self.acks) < 64:
            self.acks.append(Ack(m.command, m.result))

    def _parameter(self, now_us: int, m: Any) -> None:
        if m.param_id in self.parameters:
            self.parameters[m.param_id] = bytes(m.get_msgbuf()[10:14]) if m.get_msgbuf()[0] == 0xFD else b""

    def _statustext(self, now_us: int, m: Any) -> None:
        """A text longer than 50 characters comes in chunks with one id; the last is shorter than 50."""
        text = m.text
        if m.id:
            if len(self._chunks) >= 16 and m.id not in self._chunks:
                self._chunks.clear()
            chunks = self._chunks.setdefault(m.id, [])
            chunks.append(text)
            if len(text) >= 50 and len(chunks) < 8:
                return
            text = "".join(self._chunks.pop(m.id))
        if len(self.texts) < 64:
            self.texts.append((m.severity, text.strip()))


FREQUENT: dict[int, Callable[[Telemetry, int, bytes], None]] = {
    mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED: Telemetry._local_position,
    mavlink.MAVLINK_MSG_ID_ATTITUDE: Telemetry._attitude,
}
"""Kinds that come every tick, from their payload."""

HANDLERS: dict[int, Callable[[Telemetry, int, Any], None]] = {
    mavlink.MAVLINK_MSG_ID_HEARTBEAT: Telemetry._heartbeat,
    mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: Telemetry._extended_state,
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: Telemetry._sys_status,
    mavlink.MAVLINK_MSG_ID_ESTIMATOR_STATUS: Telemetry._estimator_status,
    mavlink.MAVLINK_MSG_ID_COMMAND_ACK: Telemetry._command_ack,
    mavlink.MAVLINK_MSG_ID_PARAM_VALUE: Telemetry._parameter,
    mavlink.MAVLINK_MSG_ID_STATUSTEXT: Telemetry._statustext,
}
