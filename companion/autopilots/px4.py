"""PX4: OFFBOARD mode, as PX4 v1.16 was seen to behave on the wire.

custom_mode is main << 16 | sub << 24 (px4_custom_mode.h). PX4 wants setpoints to be streaming before OFFBOARD is asked
for while armed; it answers TEMPORARILY_REJECTED until then, which `commands.Command` keeps alive. After landing and
disarming it returns to the last intended mode, OFFBOARD, by itself.
"""

import struct

from companion.commands import Command
from companion.telemetry import Telemetry
from wire.dialect import mavlink

MAIN_AUTO, MAIN_OFFBOARD = 4, 6
AUTO_LAND = 6

ESTIMATOR_NEEDED = (
    mavlink.ESTIMATOR_ATTITUDE
    | mavlink.ESTIMATOR_VELOCITY_HORIZ
    | mavlink.ESTIMATOR_VELOCITY_VERT
    | mavlink.ESTIMATOR_POS_HORIZ_REL
    | mavlink.ESTIMATOR_POS_HORIZ_ABS
    | mavlink.ESTIMATOR_POS_VERT_ABS
)
POSITION_FRESH_US = 500_000

STREAMS_HZ = {
    mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED: 50.0,
    mavlink.MAVLINK_MSG_ID_ATTITUDE: 50.0,
    mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 5.0,
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: 5.0,
    mavlink.MAVLINK_MSG_ID_ESTIMATOR_STATUS: 5.0,
}

STREAM_LOSS_ACTION = "COM_OBL_RC_ACT"
SAFE_LOSS_ACTIONS = {4: "Land", 5: "Hold"}


def _mode(telemetry: Telemetry) -> tuple[int, int]:
    return telemetry.custom_mode >> 16 & 0xFF, telemetry.custom_mode >> 24 & 0xFF


class Px4:
    name = "PX4"
    offboard_mode = "OFFBOARD"

    def stream_requests(self) -> list[Command]:
        command = mavlink.MAV_CMD_SET_MESSAGE_INTERVAL
        return [
            Command(command, (float(message_id), 1e6 / hz), f"stream message {message_id} at {hz:g} Hz")
            for message_id, hz in STREAMS_HZ.items()
        ]

    def parameters_wanted(self) -> list[str]:
        return [STREAM_LOSS_ACTION]

    def warnings(self, telemetry: Telemetry) -> list[str]:
        """Without sticks PX4's default (0, Position mode) sinks to the ground when our stream stops."""
        raw = telemetry.parameters.get(STREAM_LOSS_ACTION, b"")
        if len(raw) != 4:
            return [f"{STREAM_LOSS_ACTION} could not be read: what a lost setpoint stream does is not known"]
        (action,) = struct.unpack("<i", raw)  # PX4 sends an INT32's bytes in the float field
        if action in SAFE_LOSS_ACTIONS:
            return []
        return [f"{STREAM_LOSS_ACTION} is {action}: when setpoints stop, expect neither Hold (5) nor Land (4)"]

    def not_ready(self, now_us: int, telemetry: Telemetry) -> list[str]:
        reasons = []
        if telemetry.position_us is None or now_us - telemetry.position_us > POSITION_FRESH_US:
            reasons.append("no local position")
        if telemetry.attitude_us is None:
            reasons.append("no attitude")
        if telemetry.armed:
            reasons.append("armed already")
        if telemetry.landed_state != mavlink.MAV_LANDED_STATE_ON_GROUND:
            reasons.append("not on the ground")
        reasons.extend(f"estimator rejects {name}" for name in telemetry.rejected)
        flags = telemetry.estimator_flags
        if flags is None or flags & ESTIMATOR_NEEDED != ESTIMATOR_NEEDED:
            reasons.append("estimator not converged" if flags is not None else "no estimator status")
        # In OFFBOARD without setpoints PX4 fails its own check until the stream begins, so there it does not count.
        if not telemetry.prearm_ok and not self.in_control(telemetry):
            reasons.append("pre-arm checks fail")
        return reasons

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

    def land(self) -> Command:
        return Command(
            mavlink.MAV_CMD_DO_SET_MODE, (mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED, MAIN_AUTO, AUTO_LAND), "land"
        )

    def is_landing(self, telemetry: Telemetry) -> bool:
        return _mode(telemetry) == (MAIN_AUTO, AUTO_LAND)
