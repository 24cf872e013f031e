"""What PX4's and ArduPilot's own logs hold, said in the MAVLink messages that a report reads.

An imported .ulg or .BIN has channels with the log's own names (`logs.importing`). Those below mean the same as messages
that the vehicle would have told over a link; no other is read. Names, units and signs are those of the logs:

    PX4         https://github.com/PX4/PX4-Autopilot/tree/main/msg, and px4_custom_mode.h for the modes
    ArduPilot   https://ardupilot.org/copter/docs/logmessages.html

Local positions are NED in the estimator's own frame, as in LOCAL_POSITION_NED. Setpoints inside PX4
(`trajectory_setpoint`) are no messages to it: they are references.
"""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from logs.report.columns import payload_type
from wire.dialect import mavlink

Said = tuple[int, dict[str, Any]]
"""A message's id and its fields; those that are not here are 0."""
_ARMED, _CUSTOM = 128, 1
_LAST = 65_535

_PX4_MODES = {
    0: (1, 0), 1: (2, 0), 2: (3, 0), 3: (4, 4), 4: (4, 3), 5: (4, 5), 10: (5, 0), 14: (6, 0), 15: (7, 0), 17: (4, 2),
    18: (4, 6), 19: (4, 8), 20: (4, 9),
}  # fmt: skip
"""NAVIGATION_STATE of VehicleStatus.msg -> main and sub mode of custom_mode."""
_PX4_LEVELS = {"EMERGENCY": 0, "ALERT": 1, "CRITICAL": 2, "ERROR": 3, "WARNING": 4, "NOTICE": 5, "INFO": 6, "DEBUG": 7}
_ARMED_EVENT, _DISARMED_EVENT = 10, 11  # of ArduPilot's EV


class Translator:
    """One log's; it keeps what only several messages together tell."""

    def __init__(self) -> None:
        self._beat: dict[str, Any] = {}
        self._readers: dict[str, Callable[[Any], Iterator[Said]]] = {
            "px4.vehicle_local_position": _px4_position,
            "px4.vehicle_attitude": _px4_attitude,
            "px4.vehicle_status": self._px4_status,
            "px4.estimator_status": _px4_estimator,
            "px4.battery_status": _px4_battery,
            "px4.actuator_motors": _px4_motors,
            "px4.LoggedMessage": lambda m: _text(m.text, _PX4_LEVELS.get(m.level, 6)),
            "px4.Parameter": lambda m: _parameter(m.name, m.value),
            "ardupilot.XKF1": _ardupilot_position,
            "ardupilot.ATT": _ardupilot_attitude,
            "ardupilot.XKF4": _ardupilot_estimator,
            "ardupilot.BAT": _ardupilot_battery,
            "ardupilot.RCOU": _ardupilot_servos,
            "ardupilot.MODE": lambda m: self._ardupilot_beat(custom_mode=m.ModeNum),
            "ardupilot.ARM": lambda m: self._ardupilot_beat(base_mode=_CUSTOM | _ARMED * bool(m.ArmState)),
            "ardupilot.EV": self._ardupilot_event,
            "ardupilot.MSG": lambda m: _text(m.Message, 6),
            "ardupilot.PARM": lambda m: _parameter(m.Name, m.Value),
        }

    def reads(self, schema: str, topic: str) -> bool:
        """Whether a channel is read: of several estimators, batteries ... the first."""
        return schema in self._readers and not topic.rpartition("/")[2].strip("0").isdecimal()

    def said(self, schema: str, message: Any) -> list[tuple[int, bytes]]:
        """Ids and payloads of what a message says; nothing where it lacks a field or holds what does not fit."""
        try:
            return [(number, _payload(number, fields)) for number, fields in self._readers[schema](message)]
        except (AttributeError, IndexError, KeyError, ValueError, OverflowError, TypeError):
            return []  # another version of the log's

    def _px4_status(self, m: Any) -> Iterator[Said]:
        main, sub = _PX4_MODES.get(int(m.nav_state), (0, 0))
        armed = _ARMED if int(m.arming_state) == 2 else 0  # ARMING_STATE_ARMED
        kind = int(getattr(m, "system_type", 0)) or mavlink.MAV_TYPE_GENERIC
        yield 0, {
            "custom_mode": main << 16 | sub << 24, "base_mode": _CUSTOM | armed, "type": kind,
            "autopilot": mavlink.MAV_AUTOPILOT_PX4, "system_status": 5 if m.failsafe else 4 if armed else 3,
        }  # fmt: skip

    def _ardupilot_event(self, m: Any) -> Iterator[Said]:
        if int(m.Id) in (_ARMED_EVENT, _DISARMED_EVENT):
            yield from self._ardupilot_beat(base_mode=_CUSTOM | _ARMED * (int(m.Id) == _ARMED_EVENT))

    def _ardupilot_beat(self, **fields: Any) -> Iterator[Said]:
        self._beat |= fields
        yield 0, self._beat | {"type": mavlink.MAV_TYPE_GENERIC, "autopilot": mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA}


def reference_of(schema: str, message: Any) -> tuple[float, ...] | None:
    """Position [m], velocity [m/s], NED, and yaw [rad] that PX4 steered for; None of another message."""
    if schema != "px4.trajectory_setpoint":
        return None
    wanted = tuple(getattr(message, "position", ())), tuple(getattr(message, "velocity", ()))
    if [len(v) for v in wanted] != [3, 3] or not all(math.isfinite(v) for v in wanted[0]):
        return None
    return (*wanted[0], *(v if math.isfinite(v) else 0.0 for v in wanted[1]), float(getattr(message, "yaw", 0.0)))


def _px4_position(m: Any) -> Iterator[Said]:
    if m.xy_valid and m.z_valid:
        yield 32, {name: getattr(m, name) for name in ("x", "y", "z", "vx", "vy", "vz")}


def _px4_attitude(m: Any) -> Iterator[Said]:
    w, x, y, z = m.q
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    yield 30, {"roll": roll, "pitch": pitch, "yaw": math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))}


def _px4_estimator(m: Any) -> Iterator[Said]:
    names = {
        "vel_ratio": "vel_test_ratio", "pos_horiz_ratio": "pos_test_ratio", "pos_vert_ratio": "hgt_test_ratio",
        "mag_ratio": "mag_test_ratio", "hagl_ratio": "hagl_test_ratio", "tas_ratio": "tas_test_ratio",
        "pos_horiz_accuracy": "pos_horiz_accuracy", "pos_vert_accuracy": "pos_vert_accuracy",
    }  # fmt: skip
    yield 230, {ours: float(getattr(m, theirs)) for ours, theirs in names.items()}


def _px4_battery(m: Any) -> Iterator[Said]:
    yield _battery(m.voltage_v, m.current_a, 100.0 * m.remaining)


def _px4_motors(m: Any) -> Iterator[Said]:
    motors = [float(v) for v in m.control][:12]
    used = sum(1 << k for k, v in enumerate(motors) if math.isfinite(v))
    yield 375, {"active": used, "actuator": motors + [math.nan] * (32 - len(motors))}


def _ardupilot_position(m: Any) -> Iterator[Said]:
    if not getattr(m, "C", 0):  # the first core
        yield 32, {"x": m.PN, "y": m.PE, "z": m.PD, "vx": m.VN, "vy": m.VE, "vz": m.VD}


def _ardupilot_attitude(m: Any) -> Iterator[Said]:
    yaw = (m.Yaw + 180.0) % 360.0 - 180.0
    yield 30, {"roll": math.radians(m.Roll), "pitch": math.radians(m.Pitch), "yaw": math.radians(yaw)}


def _ardupilot_estimator(m: Any) -> Iterator[Said]:
    if not getattr(m, "C", 0):
        ratios = {"velocity_variance": m.SV, "pos_horiz_variance": m.SP, "pos_vert_variance": m.SH}
        yield 193, {**ratios, "compass_variance": m.SM, "airspeed_variance": m.SVT}


def _ardupilot_battery(m: Any) -> Iterator[Said]:
    if not getattr(m, "Inst", getattr(m, "Instance", 0)):
        yield _battery(m.Volt, m.Curr, getattr(m, "RemPct", -1.0))


def _ardupilot_servos(m: Any) -> Iterator[Said]:
    yield 36, {f"servo{k}_raw": min(max(int(getattr(m, f"C{k}")), 0), _LAST) for k in range(1, 9)}


def _battery(volts: float, amperes: float, left: float) -> Said:
    current = round(100 * amperes) if 0.0 <= amperes < 327.0 else -1
    told = round(left) if 0.0 <= left <= 100.0 else -1
    return 1, {"voltage_battery": round(1000 * volts), "current_battery": current, "battery_remaining": told}


def _text(text: str, severity: int) -> Iterator[Said]:
    yield 253, {"severity": severity, "text": text.encode()[:50]}


def _parameter(name: str, value: float) -> Iterator[Said]:
    yield 22, {"param_id": name.encode()[:16], "param_value": value, "param_type": mavlink.MAV_PARAM_TYPE_REAL32}


def _payload(number: int, fields: dict[str, Any]) -> bytes:
    payload = np.zeros((), payload_type(number))
    for name, value in fields.items():
        payload[name] = value
    return payload.tobytes()
