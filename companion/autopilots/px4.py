"""PX4: OFFBOARD mode, as PX4 v1.16 was seen to behave on the wire.

custom_mode is main << 16 | sub << 24 (px4_custom_mode.h). PX4 wants setpoints to be streaming before OFFBOARD is asked
for while armed; it answers TEMPORARILY_REJECTED until then, which `commands.Command` keeps alive. A mode it took shows
in CURRENT_MODE within 0.1 s and in HEARTBEAT up to 1.02 s late. When the stream stops for COM_OF_LOSS_T it holds
(COM_OBL_RC_ACT 5) while CURRENT_MODE still says that OFFBOARD is intended, and returns by itself when the stream does.
After landing and disarming it returns to the last intended mode, OFFBOARD, by itself.
"""

import struct

from companion.autopilots.base import ParameterWish, common_reasons
from companion.commands import Command
from companion.telemetry import Telemetry
from wire.dialect import mavlink

MAIN_AUTO, MAIN_OFFBOARD = 4, 6
AUTO_HOLD, AUTO_RTL, AUTO_LAND = 3, 5, 6
MAIN_NAMES = {1: "Manual", 2: "Altitude", 3: "Position", 5: "Acro", 6: "OFFBOARD", 7: "Stabilized"}
AUTO_NAMES = {2: "Takeoff", 3: "Hold", 4: "Mission", 5: "Return", 6: "Land"}

ESTIMATOR_NEEDED = (
    mavlink.ESTIMATOR_ATTITUDE
    | mavlink.ESTIMATOR_VELOCITY_HORIZ
    | mavlink.ESTIMATOR_VELOCITY_VERT
    | mavlink.ESTIMATOR_POS_HORIZ_REL
    | mavlink.ESTIMATOR_POS_HORIZ_ABS
    | mavlink.ESTIMATOR_POS_VERT_ABS
)
STREAMS_HZ = {
    mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED: 50.0,
    mavlink.MAVLINK_MSG_ID_ATTITUDE: 50.0,
    mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 5.0,
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: 5.0,
    mavlink.MAVLINK_MSG_ID_ESTIMATOR_STATUS: 5.0,
    mavlink.MAVLINK_MSG_ID_CURRENT_MODE: 5.0,
}

STREAM_LOSS_ACTION = "COM_OBL_RC_ACT"
HOLD_ON_LOSS = 5
SAFE_LOSS_ACTIONS = {4: "Land", HOLD_ON_LOSS: "Hold"}


def _mode(telemetry: Telemetry) -> tuple[int, int]:
    return _parts(telemetry.custom_mode)


def _parts(custom_mode: int) -> tuple[int, int]:
    return custom_mode >> 16 & 0xFF, custom_mode >> 24 & 0xFF


class Px4:
    """PX4, version 1.14 or newer."""

    name = "PX4"
    offboard_mode = "OFFBOARD"
    takes_off_itself = False
    streams_on_ground = True
    streams_until_landing = True

    def streams_hz(self) -> dict[int, float]:
        return STREAMS_HZ

    def parameters_wanted(self) -> list[str]:
        return [STREAM_LOSS_ACTION]

    def parameters_to_set(self, telemetry: Telemetry) -> list[ParameterWish]:
        """Without sticks PX4's default (0, Position mode) sinks to the ground when our stream stops: Hold instead."""
        action = _int32(telemetry.parameters.get(STREAM_LOSS_ACTION, b""))
        if action is None or action in SAFE_LOSS_ACTIONS:
            return []
        (value,) = struct.unpack("<f", struct.pack("<i", HOLD_ON_LOSS))
        return [ParameterWish(STREAM_LOSS_ACTION, value, mavlink.MAV_PARAM_TYPE_INT32, f"{HOLD_ON_LOSS} (Hold)")]

    def warnings(self, telemetry: Telemetry) -> list[str]:
        action = _int32(telemetry.parameters.get(STREAM_LOSS_ACTION, b""))
        if action is None:
            return [f"{STREAM_LOSS_ACTION} could not be read: what a lost setpoint stream does is not known"]
        if action in SAFE_LOSS_ACTIONS:
            return []
        return [f"{STREAM_LOSS_ACTION} is {action}: when setpoints stop, expect neither Hold (5) nor Land (4)"]

    def booting(self, telemetry: Telemetry) -> bool:
        """Never: a PX4 that fails its pre-arm checks says 0, too, so only its time since boot tells."""
        return False

    def not_ready(self, now_us: int, telemetry: Telemetry) -> list[str]:
        reasons = common_reasons(now_us, telemetry)
        lost = self.estimator_lost(telemetry)
        reasons.extend([lost] if lost else [])
        # In OFFBOARD without setpoints PX4 fails its own check until the stream begins, so there it does not count.
        # Only the health bit is looked at: PX4 leaves the present and enabled bits of this check at 0.
        if not telemetry.prearm_ok and not self.in_control(telemetry):
            reasons.append("pre-arm checks fail")
        return reasons

    def estimator_lost(self, telemetry: Telemetry) -> str:
        """The bit for a constant position (128) is set on the ground of a good PX4, too: it does not count."""
        flags = telemetry.estimator_flags
        if flags is None:
            return "no estimator status"
        return "" if flags & ESTIMATOR_NEEDED == ESTIMATOR_NEEDED else "estimator not converged"

    def take_control(self) -> Command:
        return Command(
            mavlink.MAV_CMD_DO_SET_MODE,
            (mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED, MAIN_OFFBOARD, 0),
            "switch to OFFBOARD",
        )

    def in_control(self, telemetry: Telemetry) -> bool:
        return _mode(telemetry)[0] == MAIN_OFFBOARD

    def arm(self) -> Command:
        return Command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, (1.0,), "arm")

    def disarm(self) -> Command:
        return Command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, (0.0,), "disarm")

    def takeoff(self, height_m: float) -> Command | None:
        return None

    def airborne(self, telemetry: Telemetry) -> bool:
        return bool(telemetry.landed_state == mavlink.MAV_LANDED_STATE_IN_AIR)

    def land(self) -> Command:
        return _auto(AUTO_LAND, "land")

    def go_home(self) -> Command:
        return _auto(AUTO_RTL, "return")

    def comes_down(self, telemetry: Telemetry) -> bool:
        return _mode(telemetry) in ((MAIN_AUTO, AUTO_LAND), (MAIN_AUTO, AUTO_RTL))

    def lands(self, telemetry: Telemetry) -> bool:
        return _mode(telemetry) == (MAIN_AUTO, AUTO_LAND)

    def lost_our_stream(self, telemetry: Telemetry) -> bool:
        return _mode(telemetry) == (MAIN_AUTO, AUTO_HOLD) and self._offboard_intended(telemetry)

    def mode_name(self, telemetry: Telemetry) -> str:
        main, sub = _mode(telemetry)
        return AUTO_NAMES.get(sub, f"Auto {sub}") if main == MAIN_AUTO else MAIN_NAMES.get(main, f"mode {main}")

    def failsafe(self, telemetry: Telemetry) -> str:
        if _mode(telemetry)[0] == MAIN_OFFBOARD:
            return ""
        critical = telemetry.system_status == mavlink.MAV_STATE_CRITICAL
        chosen = critical or self._offboard_intended(telemetry)
        return f"PX4's failsafe chose {self.mode_name(telemetry)}" if chosen else ""

    def _offboard_intended(self, telemetry: Telemetry) -> bool:
        return telemetry.intended_mode is not None and _parts(telemetry.intended_mode)[0] == MAIN_OFFBOARD


def _auto(sub: int, what: str) -> Command:
    values = (mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED, MAIN_AUTO, sub)
    return Command(mavlink.MAV_CMD_DO_SET_MODE, values, what)


def _int32(raw: bytes) -> int | None:
    """PX4 sends an INT32's bytes in the float field."""
    return int.from_bytes(raw, "little", signed=True) if len(raw) == 4 else None
