"""ArduCopter's commands, where they mean something else than PX4's, and SET_MODE.

An unsupported parameter is not looked at, as ArduCopter does not; a height for a takeoff is above home.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from fakevehicle.codec import Message
from fakevehicle.flavours.ardupilot_modes import ARMING_WORDS, AUTO, BY_NUMBER, GUIDED, LAND, LOITER, RTL
from fakevehicle.flavours.base import Parts
from fakevehicle.modes import GUARDS, Event
from fakevehicle.services.commands import FORCE
from fakevehicle.services.outbox import Sender
from fakevehicle.services.service import ACCEPTED, Command, CommandSpec, Handler, Service, Verdict
from wire.dialect import mavlink

if TYPE_CHECKING:
    from fakevehicle.flavours.ardupilot import ArduPilot

_m = mavlink
EVERY = (1, 2, 3, 4, 5, 6, 7)


class ArduCommands(Service):
    """What ArduPilot does with commands.

    Attributes
    ----------
    own : the commands whose results are ArduPilot's already.
    """

    def __init__(self, flavour: ArduPilot, parts: Parts) -> None:
        self._flavour = flavour
        self._parts = parts
        self._below = parts.commands.commands()
        self._as_long = False  # the command now carried out came as COMMAND_LONG
        self.own = frozenset(self.commands())

    def routes(self) -> Mapping[int, Handler]:
        """COMMAND_LONG, only to remember that it is one, and the old SET_MODE."""
        return {_m.MAVLINK_MSG_ID_COMMAND_LONG: self.command_long, _m.MAVLINK_MSG_ID_SET_MODE: self.set_mode}

    def commands(self) -> Mapping[int, CommandSpec]:
        """By number."""

        def mode(number: int, title: str) -> CommandSpec:
            return CommandSpec(lambda _s, _c, now_us: self._flavour.change(number, now_us), title, EVERY)

        return {
            _m.MAV_CMD_NAV_LOITER_UNLIM: mode(LOITER, "Loiter"),
            _m.MAV_CMD_NAV_RETURN_TO_LAUNCH: mode(RTL, "RTL"),
            _m.MAV_CMD_NAV_LAND: mode(LAND, "Land"),
            _m.MAV_CMD_NAV_TAKEOFF: CommandSpec(self._takeoff, "Takeoff", EVERY),
            _m.MAV_CMD_CONDITION_YAW: CommandSpec(self._condition_yaw, "Yaw", EVERY),
            _m.MAV_CMD_DO_SET_MODE: CommandSpec(self._set_mode, "Mode change", EVERY),
            _m.MAV_CMD_DO_REPOSITION: CommandSpec(self._reposition, "Goto", EVERY),
            _m.MAV_CMD_DO_FENCE_ENABLE: CommandSpec(self._fence_enable, "Fence", EVERY),
            _m.MAV_CMD_MISSION_START: mode(AUTO, "Mission"),
            _m.MAV_CMD_COMPONENT_ARM_DISARM: CommandSpec(self._arm_disarm, "Arm", EVERY),
            _m.MAV_CMD_RUN_PREARM_CHECKS: CommandSpec(self._run_checks, "PreArm", EVERY),
            _m.MAV_CMD_SET_MESSAGE_INTERVAL: CommandSpec(self._set_interval, "Message interval", EVERY),
            _m.MAV_CMD_REQUEST_MESSAGE: CommandSpec(self._request_message, "Message request", EVERY),
            _m.MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES: CommandSpec(self._request_version, "Version request", EVERY),
        }

    def command_long(self, sender: Sender, message: Message, now_us: int) -> None:
        """As below."""
        self._as_long = True
        self._parts.commands.command_long(sender, message, now_us)
        self._as_long = False

    def set_mode(self, _sender: Sender, message: Message, now_us: int) -> None:
        """The old SET_MODE message: no ACK, and the HEARTBEAT tells; a refusal is put into words."""
        verdict = self._flavour.change(message.custom_mode, now_us)
        if verdict.reason:
            self._flavour.warn(verdict.reason, now_us)

    def _set_mode(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        base, number = command.params[:2]
        if not (math.isfinite(base) and int(base) & _m.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED and math.isfinite(number)):
            return Verdict(_m.MAV_RESULT_DENIED, "only custom modes are understood (param1 = 1)")
        return self._flavour.change(round(number), now_us)

    def _arm_disarm(self, sender: Sender, command: Command, now_us: int) -> Verdict:
        s, flavour = self._parts.supervisor, self._flavour
        wanted, force = command.params[:2]
        if wanted != 1.0:
            if wanted != 0.0:
                return Verdict(_m.MAV_RESULT_UNSUPPORTED, f"param1 is {wanted:g}, expected 0 or 1")
            refusal = s.ask(Event.ASK_KILL if force == FORCE else Event.ASK_DISARM, now_us)
            return ACCEPTED if refusal is None else failed(refusal.value)
        if s.armed:
            return ACCEPTED
        if flavour.booting:  # the one text that comes before its ACK
            self._parts.outbox.text(_m.MAV_SEVERITY_CRITICAL, "Arm: System not initialised")
            return Verdict(_m.MAV_RESULT_FAILED)
        mode = BY_NUMBER[flavour.number]
        if not mode.armable:
            return failed(f"{mode.name} mode not armable")
        flavour.begin(now_us)
        reasons = self._unready(now_us)
        refusal = None if reasons else s.ask(Event.ASK_ARM, now_us)
        reasons = [refusal.value] if refusal is not None else reasons
        return failed("\n".join(reasons)) if reasons else ACCEPTED

    def _unready(self, now_us: int) -> list[str]:
        """Everything that keeps it from arming, in ArduPilot's words, each once."""
        conditions = self._parts.supervisor.conditions(now_us)
        missing = [guard.reason for guard in GUARDS[Event.ASK_ARM] if not guard.holds(conditions)]
        return list(dict.fromkeys(ARMING_WORDS.get(reason, reason.value) for reason in missing))

    def _run_checks(self, _sender: Sender, _command: Command, now_us: int) -> Verdict:
        """Accepted whatever they find; what they find is said."""
        for reason in self._unready(now_us):
            self._parts.outbox.text(_m.MAV_SEVERITY_CRITICAL, f"PreArm: {reason}")
        return ACCEPTED

    def _takeoff(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        """In GUIDED, armed and on the ground, to parameter 7 [m] above home."""
        s = self._parts.supervisor
        height = command.params[4]
        if self._flavour.number != GUIDED:
            return failed("the mode is not GUIDED")
        if not (math.isfinite(height) and height > 0.0):
            return failed(f"height is {height:g}")
        self._flavour.begin(now_us)
        refusal = s.ask_takeoff(now_us, (float(s.home.position_n[2]) if s.home is not None else 0.0) - height)
        return ACCEPTED if refusal is None else failed(refusal.value)

    def _reposition(self, sender: Sender, command: Command, now_us: int) -> Verdict:
        """In GUIDED, or into it where parameter 2 has bit 0; of COMMAND_LONG it is not known."""
        if self._as_long:
            return Verdict(_m.MAV_RESULT_UNSUPPORTED, "send it as COMMAND_INT")
        flags = command.params[1]
        if self._flavour.number != GUIDED:
            if not (math.isfinite(flags) and int(flags) & 1):
                return Verdict(_m.MAV_RESULT_DENIED, "the mode is not GUIDED")
            verdict = self._flavour.change(GUIDED, now_us)
            if verdict.reason:
                return verdict
        verdict = self._below[_m.MAV_CMD_DO_REPOSITION].carry_out(sender, command, now_us)
        return failed(verdict.reason) if verdict.reason else verdict

    def _condition_yaw(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        """Turn to parameter 1 [deg], from north or (parameter 4) from here by direction 3, where it stands."""
        s = self._parts.supervisor
        angle, _, direction, relative, _ = command.params
        if self._flavour.number != GUIDED or not s.airborne or s.position_n is None or s.yaw is None:
            return failed("not flying in GUIDED")
        if not math.isfinite(angle):
            return failed(f"param1 is {angle:g}")
        yaw = math.radians(angle) * (-1.0 if direction == -1.0 and relative == 1.0 else 1.0)
        yaw += s.yaw if relative == 1.0 else 0.0
        refusal = s.ask_goto(now_us, s.position_n, math.remainder(yaw, 2.0 * math.pi))
        return ACCEPTED if refusal is None else failed(refusal.value)

    def _fence_enable(self, _sender: Sender, command: Command, _now_us: int) -> Verdict:
        """FENCE_ENABLE by command: a breach leads to a return, or to nothing."""
        if command.params[0] not in (0.0, 1.0):
            return failed(f"param1 is {command.params[0]:g}, expected 0 or 1")
        self._parts.parameters.set("GF_ACTION", 3 * command.params[0])
        return ACCEPTED

    def _set_interval(self, sender: Sender, command: Command, now_us: int) -> Verdict:
        """A message it does not have is DENIED."""
        number, interval = command.params[:2]
        if not (math.isfinite(number) and math.isfinite(interval)):
            return Verdict(_m.MAV_RESULT_DENIED, "a message number and an interval are needed")
        if not self._parts.streams.set_interval(sender.link, round(number), round(interval), now_us):
            return Verdict(_m.MAV_RESULT_DENIED, f"No ap_message for mavlink id ({number:g})")
        return ACCEPTED

    def _request_message(self, sender: Sender, command: Command, _now_us: int) -> Verdict:
        """The ACK comes first. AVAILABLE_MODES goes by its index (parameter 2), 0 meaning 1; past the end: nothing."""
        number, index = command.params[:2]
        if not math.isfinite(number):
            return failed(f"param1 is {number:g}")
        if round(number) == _m.MAVLINK_MSG_ID_AVAILABLE_MODES:
            mode = self._flavour.available_mode(max(round(index), 1) if math.isfinite(index) else 1)
            if mode is not None:
                self._flavour.after_ack(sender, mode)
            return ACCEPTED
        message = self._parts.streams.build(round(number))
        if message is None:
            return failed(f"no message {number:g} now")
        self._flavour.after_ack(sender, message)
        return ACCEPTED

    def _request_version(self, sender: Sender, _command: Command, _now_us: int) -> Verdict:
        self._flavour.after_ack(sender, self._flavour.autopilot_version())
        return ACCEPTED


def failed(reason: str) -> Verdict:
    """What ArduPilot says to nearly everything it does not do."""
    return Verdict(_m.MAV_RESULT_FAILED, reason)
