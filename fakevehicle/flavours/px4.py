"""PX4's way: its mode numbers, its streams, a HEARTBEAT at every change and texts before it."""

import math
from collections.abc import Mapping

from fakevehicle.codec import Message
from fakevehicle.config import Profile
from fakevehicle.flavours.base import Flavour, ModeInfo
from fakevehicle.flavours.px4_modes import PX4_NUMBERS, automatic, custom_mode, event_for_custom_mode
from fakevehicle.modes import Mode
from fakevehicle.services.outbox import Sender
from fakevehicle.services.service import ACCEPTED, Builder, Command, CommandSpec, Handler, Verdict, denied, judged
from wire.dialect import mavlink

_m = mavlink
RATES_HZ: Mapping[Profile, Mapping[int, float]] = {
    "gcs": {
        _m.MAVLINK_MSG_ID_HEARTBEAT: 1,
        _m.MAVLINK_MSG_ID_ATTITUDE: 15,
        _m.MAVLINK_MSG_ID_ATTITUDE_QUATERNION: 10,
        _m.MAVLINK_MSG_ID_LOCAL_POSITION_NED: 1,
        _m.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 5,
        _m.MAVLINK_MSG_ID_SYS_STATUS: 1,
        _m.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 1,
        _m.MAVLINK_MSG_ID_BATTERY_STATUS: 0.5,
        _m.MAVLINK_MSG_ID_HOME_POSITION: 0.5,
        _m.MAVLINK_MSG_ID_VFR_HUD: 4,
        _m.MAVLINK_MSG_ID_ALTITUDE: 1,
        _m.MAVLINK_MSG_ID_POSITION_TARGET_LOCAL_NED: 1.5,
        _m.MAVLINK_MSG_ID_ATTITUDE_TARGET: 2,
        _m.MAVLINK_MSG_ID_GPS_RAW_INT: 5,
        _m.MAVLINK_MSG_ID_SYSTEM_TIME: 1,
        _m.MAVLINK_MSG_ID_ESTIMATOR_STATUS: 1,
        _m.MAVLINK_MSG_ID_SCALED_PRESSURE: 1,
        _m.MAVLINK_MSG_ID_WIND_COV: 0.5,
        _m.MAVLINK_MSG_ID_SERVO_OUTPUT_RAW: 1,
        _m.MAVLINK_MSG_ID_CURRENT_MODE: 0.5,
        _m.MAVLINK_MSG_ID_MISSION_CURRENT: 1,
        _m.MAVLINK_MSG_ID_MISSION_ITEM_REACHED: 1,
        _m.MAVLINK_MSG_ID_DISTANCE_SENSOR: 0.5,
        _m.MAVLINK_MSG_ID_OBSTACLE_DISTANCE: 1,  # where there is a world to see
    },
    "onboard": {
        _m.MAVLINK_MSG_ID_HEARTBEAT: 1,
        _m.MAVLINK_MSG_ID_ATTITUDE: 100,
        _m.MAVLINK_MSG_ID_ATTITUDE_QUATERNION: 50,
        _m.MAVLINK_MSG_ID_LOCAL_POSITION_NED: 50,  # 30 on hardware; PX4's simulations raise it
        _m.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 50,
        _m.MAVLINK_MSG_ID_ODOMETRY: 30,
        _m.MAVLINK_MSG_ID_HIGHRES_IMU: 50,
        _m.MAVLINK_MSG_ID_SYS_STATUS: 5,
        _m.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 5,
        _m.MAVLINK_MSG_ID_BATTERY_STATUS: 0.5,
        _m.MAVLINK_MSG_ID_HOME_POSITION: 0.5,
        _m.MAVLINK_MSG_ID_VFR_HUD: 10,
        _m.MAVLINK_MSG_ID_ALTITUDE: 10,
        _m.MAVLINK_MSG_ID_POSITION_TARGET_LOCAL_NED: 10,
        _m.MAVLINK_MSG_ID_ATTITUDE_TARGET: 10,
        _m.MAVLINK_MSG_ID_GPS_RAW_INT: 5,
        _m.MAVLINK_MSG_ID_SYSTEM_TIME: 1,
        _m.MAVLINK_MSG_ID_ESTIMATOR_STATUS: 1,
        _m.MAVLINK_MSG_ID_SCALED_PRESSURE: 1,
        _m.MAVLINK_MSG_ID_WIND_COV: 10,
        _m.MAVLINK_MSG_ID_SERVO_OUTPUT_RAW: 5,
        _m.MAVLINK_MSG_ID_CURRENT_MODE: 0.5,
        _m.MAVLINK_MSG_ID_MISSION_CURRENT: 1,
        _m.MAVLINK_MSG_ID_MISSION_ITEM_REACHED: 1,
        _m.MAVLINK_MSG_ID_DISTANCE_SENSOR: 10,
        _m.MAVLINK_MSG_ID_OBSTACLE_DISTANCE: 10,
        _m.MAVLINK_MSG_ID_HIL_STATE_QUATERNION: 50,  # the simulator's truth, for judging a flight; no loop sees it
    },
}
_STANDARD_MODE = {
    Mode.POSITION: mavlink.MAV_STANDARD_MODE_POSITION_HOLD,
    Mode.ALTITUDE: mavlink.MAV_STANDARD_MODE_ALTITUDE_HOLD,
    Mode.MISSION: mavlink.MAV_STANDARD_MODE_MISSION,
    Mode.TAKEOFF: mavlink.MAV_STANDARD_MODE_TAKEOFF,
    Mode.LAND: mavlink.MAV_STANDARD_MODE_LAND,
    Mode.RTL: mavlink.MAV_STANDARD_MODE_SAFE_RECOVERY,
}


class Px4(Flavour):
    """As PX4 v1.16 behaves, and kinder where modes.py says so."""

    software = 1 << 24 | 16 << 16 | 0 << 8 | mavlink.FIRMWARE_VERSION_TYPE_OFFICIAL

    def rates(self, profile: Profile) -> Mapping[int, float]:
        """PX4's own for its two kinds of links."""
        return RATES_HZ[profile]

    def routes(self) -> Mapping[int, Handler]:
        """The old message for a mode."""
        return {mavlink.MAVLINK_MSG_ID_SET_MODE: self.set_mode}

    def commands(self) -> Mapping[int, CommandSpec]:
        """Those that name a mode by PX4's numbers."""
        self._below = self.parts.commands.commands()[mavlink.MAV_CMD_REQUEST_MESSAGE]
        spec = CommandSpec(self._request_message, self._below.title, (*self._below.understood, 2))
        return {
            mavlink.MAV_CMD_DO_SET_MODE: CommandSpec(self._set_mode, "Mode change", (1, 2, 3)),
            mavlink.MAV_CMD_REQUEST_MESSAGE: spec,
        }

    def set_mode(self, sender: Sender, message: Message, now_us: int) -> None:
        """The old SET_MODE message; it is acknowledged as its command would be."""
        main, sub = message.custom_mode >> 16 & 0xFF, message.custom_mode >> 24 & 0xFF
        params = (float(message.base_mode), float(main), float(sub), math.nan, math.nan)
        self.parts.commands.carry_out(sender, Command(mavlink.MAV_CMD_DO_SET_MODE, params), now_us)

    def _set_mode(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        base, main, sub = (round(p) if math.isfinite(p) else None for p in command.params[:3])
        if base is None or not base & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED:
            return denied("only PX4's custom modes are understood (param1 = 1)")
        event = event_for_custom_mode(-1 if main is None else main, 0 if sub is None else sub)
        if event is None:
            return denied(f"this vehicle has no mode {main}/{sub}")
        return judged(self.parts.supervisor.ask(event, now_us))

    def _request_message(self, sender: Sender, command: Command, now_us: int) -> Verdict:
        """AVAILABLE_MODES by its index (parameter 2), 0 for all of them; any other message as everywhere."""
        number, index = command.params[:2]
        wanted = 0.0 if math.isnan(index) else index
        if number != mavlink.MAVLINK_MSG_ID_AVAILABLE_MODES:
            if wanted != 0.0:
                return denied(f"param2 is {index:g}, not supported")
            return self._below.carry_out(sender, command, now_us)
        count = len(self.modes())
        if wanted not in range(count + 1):
            return denied(f"param2 is {index:g}, there are {count} modes")
        for each in range(1, count + 1) if wanted == 0.0 else (int(wanted),):
            self.parts.outbox.answer(sender, self.available_mode(each))
        return ACCEPTED

    def modes(self) -> tuple[ModeInfo, ...]:
        """PX4's, as far as this vehicle has them."""
        return tuple(
            ModeInfo(mode.title, custom_mode(mode), _STANDARD_MODE.get(mode, mavlink.MAV_STANDARD_MODE_NON_STANDARD))
            for mode in PX4_NUMBERS
        )

    def builders(self) -> Mapping[int, Builder]:
        """What tells the mode."""
        return {
            mavlink.MAVLINK_MSG_ID_HEARTBEAT: self.heartbeat,
            mavlink.MAVLINK_MSG_ID_CURRENT_MODE: self.current_mode,
            mavlink.MAVLINK_MSG_ID_AVAILABLE_MODES_MONITOR: self.available_modes_monitor,
        }

    def state(self) -> object:
        """Mode, arming and landed state."""
        s = self.parts.supervisor
        return s.mode, s.intended, s.armed, s.failsafe, s.airborne, s.landing

    def announcement(self) -> tuple[Message, ...]:
        """All three at every change of one of them."""
        return self.heartbeat(), self.current_mode(), self.parts.telemetry.extended_sys_state()

    def heartbeat(self) -> Message:
        """base_mode as PX4 sets it: automatic modes are stabilized, guided and auto."""
        s = self.parts.supervisor
        base = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | mavlink.MAV_MODE_FLAG_STABILIZE_ENABLED
        if automatic(s.mode):
            base |= mavlink.MAV_MODE_FLAG_GUIDED_ENABLED | mavlink.MAV_MODE_FLAG_AUTO_ENABLED
        elif s.mode is Mode.POSITION:
            base |= mavlink.MAV_MODE_FLAG_MANUAL_INPUT_ENABLED
        if s.armed:
            base |= mavlink.MAV_MODE_FLAG_SAFETY_ARMED
            status = mavlink.MAV_STATE_CRITICAL if s.failsafe else mavlink.MAV_STATE_ACTIVE
        elif s.why_not_armable(self.parts.telemetry.now_us) is None:
            status = mavlink.MAV_STATE_STANDBY
        else:
            status = mavlink.MAV_STATE_UNINIT
        return mavlink.MAVLink_heartbeat_message(
            mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_PX4, base, custom_mode(s.mode), status, 3
        )

    def current_mode(self) -> Message:
        s = self.parts.supervisor
        standard = _STANDARD_MODE.get(s.mode, mavlink.MAV_STANDARD_MODE_NON_STANDARD)
        return mavlink.MAVLink_current_mode_message(standard, custom_mode(s.mode), custom_mode(s.intended))
