"""ArduPilot's copter: GUIDED mode, as ArduCopter V4.7 was seen to behave on the wire.

custom_mode is the mode's own number. It streams nothing until asked, and forgets that with every boot. A mode given
during boot is acknowledged, shown, and lost when the boot ends (1.4 s): neither counts while system_status is 0 or 1.
Arming shows in the next HEARTBEAT only, up to 0.8 s after the ACK. It takes off by command and drops setpoints until it
is done (landed_state 2; in 3 it still climbs, and a setpoint would end the climb); in GUIDED a lost stream leaves the
mode as it is. LOITER without sticks sinks: to hold means to repeat a point in GUIDED. After a landing the mode stays
LAND, in which it cannot be armed: GUIDED comes first.
"""

import math
import struct

from companion.autopilots.base import ParameterWish, common_reasons
from companion.commands import Command
from companion.telemetry import Telemetry
from wire.dialect import mavlink

GUIDED, RTL, LAND, SMART_RTL = 4, 6, 9, 21
NAMES = {
    0: "STABILIZE",
    2: "ALT_HOLD",
    3: "AUTO",
    4: "GUIDED",
    5: "LOITER",
    6: "RTL",
    9: "LAND",
    16: "POSHOLD",
    17: "BRAKE",
}

EKF_NEEDED = (
    mavlink.EKF_ATTITUDE
    | mavlink.EKF_VELOCITY_HORIZ
    | mavlink.EKF_VELOCITY_VERT
    | mavlink.EKF_POS_HORIZ_REL
    | mavlink.EKF_POS_HORIZ_ABS
    | mavlink.EKF_POS_VERT_ABS
)

STREAMS_HZ = {
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: 5.0,
    mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 5.0,
    mavlink.MAVLINK_MSG_ID_EKF_STATUS_REPORT: 5.0,
    mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED: 50.0,
    mavlink.MAVLINK_MSG_ID_ATTITUDE: 50.0,
    mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 5.0,
    mavlink.MAVLINK_MSG_ID_HOME_POSITION: 1.0,
    mavlink.MAVLINK_MSG_ID_HIL_STATE_QUATERNION: 50.0,
}
"""The last is a simulator's truth; a real vehicle refuses it."""


TIMEOUT = "GUID_TIMEOUT"
LONGEST_TIMEOUT = 1.0
"""[s]; as long as PX4 waits before it holds."""


class ArduPilot:
    """ArduCopter, version 4.3 or newer."""

    name = "ArduPilot"
    offboard_mode = "GUIDED"
    takes_off_itself = True
    streams_on_ground = False
    streams_until_landing = False

    def streams_hz(self) -> dict[int, float]:
        return STREAMS_HZ

    def parameters_wanted(self) -> list[str]:
        return [TIMEOUT]

    def parameters_to_set(self, telemetry: Telemetry) -> list[ParameterWish]:
        """By default a lost stream carries the vehicle on at its last velocity for 3 s: 9 m at 3 m/s."""
        timeout = _float(telemetry.parameters.get(TIMEOUT, b""))
        if timeout is None or timeout <= LONGEST_TIMEOUT:
            return []
        return [ParameterWish(TIMEOUT, LONGEST_TIMEOUT, mavlink.MAV_PARAM_TYPE_REAL32, f"{LONGEST_TIMEOUT:g} s")]

    def warnings(self, telemetry: Telemetry) -> list[str]:
        timeout = _float(telemetry.parameters.get(TIMEOUT, b""))
        if timeout is not None and timeout <= LONGEST_TIMEOUT:
            return []
        known = "could not be read" if timeout is None else f"is {timeout:g} s"
        return [f"{TIMEOUT} {known}: when setpoints stop, it flies on at its last velocity until then"]

    def booting(self, telemetry: Telemetry) -> bool:
        return telemetry.system_status in (mavlink.MAV_STATE_UNINIT, mavlink.MAV_STATE_BOOT)

    def not_ready(self, now_us: int, telemetry: Telemetry) -> list[str]:
        """In STABILIZE the pre-arm checks pass 18 s before there is a position: both are asked for."""
        reasons = (["booting"] if self.booting(telemetry) else []) + common_reasons(now_us, telemetry)
        lost = self.estimator_lost(telemetry)
        reasons.extend([lost] if lost else [])
        if not telemetry.prearm_ok:
            reasons.append("pre-arm checks fail")
        return reasons

    def estimator_lost(self, telemetry: Telemetry) -> str:
        flags = telemetry.estimator_flags
        if flags is None:
            return "no estimator status"
        good = flags & EKF_NEEDED == EKF_NEEDED and not flags & mavlink.EKF_CONST_POS_MODE
        return "" if good else "estimator not converged"

    def take_control(self) -> Command:
        return _mode(GUIDED, "switch to GUIDED")

    def in_control(self, telemetry: Telemetry) -> bool:
        return telemetry.custom_mode == GUIDED and not self.booting(telemetry)

    def arm(self) -> Command:
        return Command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, (1.0,), "arm")

    def disarm(self) -> Command:
        return Command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, (0.0,), "disarm")

    def takeoff(self, height_m: float) -> Command | None:
        return Command(mavlink.MAV_CMD_NAV_TAKEOFF, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, height_m), "take off")

    def airborne(self, telemetry: Telemetry) -> bool:
        return bool(telemetry.landed_state == mavlink.MAV_LANDED_STATE_IN_AIR)

    def land(self) -> Command:
        return _mode(LAND, "land")

    def go_home(self) -> Command:
        return _mode(RTL, "return")

    def comes_down(self, telemetry: Telemetry) -> bool:
        return telemetry.custom_mode in (LAND, RTL, SMART_RTL)

    def lands(self, telemetry: Telemetry) -> bool:
        return bool(telemetry.custom_mode == LAND)

    def lost_our_stream(self, telemetry: Telemetry) -> bool:
        return False

    def mode_name(self, telemetry: Telemetry) -> str:
        return NAMES.get(telemetry.custom_mode, f"mode {telemetry.custom_mode}")

    def failsafe(self, telemetry: Telemetry) -> str:
        """Only an estimator's failsafe shows as such; of a fence or a battery the texts tell."""
        critical = telemetry.system_status == mavlink.MAV_STATE_CRITICAL
        return f"ArduPilot's failsafe chose {self.mode_name(telemetry)}" if critical else ""


def _float(raw: bytes) -> float | None:
    """ArduPilot sends every parameter as a float."""
    value = struct.unpack("<f", raw)[0] if len(raw) == 4 else math.nan
    return value if math.isfinite(value) else None


def _mode(number: int, what: str) -> Command:
    values = (float(mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED), float(number))
    return Command(mavlink.MAV_CMD_DO_SET_MODE, values, what)
