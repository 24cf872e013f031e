"""ArduCopter's way: plain mode numbers, GUIDED, streams on request, an ACK before everything else.

Measured on ArduCopter V4.7-dev in its own simulator. Rules of thumb that the code below keeps:

- COMMAND_ACK first, then a HEARTBEAT at once if the mode changed, then texts (during boot the text comes first). Arming
  sends no HEARTBEAT of its own.
- While disarmed any mode may be chosen; the mode stays what it was after a landing, and nobody arms in LAND, RTL, AUTO.
- Refusals are FAILED (4), not TEMPORARILY_REJECTED or DENIED; a stream it does not have is DENIED (2).
- The first `BOOT_US` are boot: nothing arms, and a mode chosen in it is lost at its end.

Underneath is the one vehicle: GUIDED takes off, follows setpoints and goes to places as the supervisor has it.
"""

from collections.abc import Mapping

from fakevehicle.codec import Message
from fakevehicle.config import Profile
from fakevehicle.faults import Fault, FaultKind, Sensor
from fakevehicle.flavours import ardupilot_parameters as names
from fakevehicle.flavours.ardupilot_commands import ArduCommands, failed
from fakevehicle.flavours.ardupilot_modes import (
    AUTO,
    BRAKE,
    BY_ATTITUDE,
    BY_NUMBER,
    GUIDED,
    LAND,
    MODES,
    RTL,
    STABILIZE,
)
from fakevehicle.flavours.ardupilot_setpoints import GuidedSetpoints
from fakevehicle.flavours.ardupilot_streams import RATES_HZ, StreamRequests
from fakevehicle.flavours.base import Flavour, ModeInfo, Parts, Said
from fakevehicle.modes import Mode
from fakevehicle.params import ParameterSet
from fakevehicle.services.missions import MissionHabits
from fakevehicle.services.outbox import Sender
from fakevehicle.services.service import ACCEPTED, Builder, Command, CommandSpec, Handler, Verdict
from fakevehicle.vocabulary import Estimate
from wire.dialect import mavlink

BOOT_US = 2_440_000
"""From the start to "ArduPilot Ready"; measured 2.44 to 2.54 s."""
QUIET_US = 1_000_000
"""The same refusal of a setpoint or a stream is not put into words again before this."""
MAX_WARNED = 32
_m = mavlink
_INFO, _WARNING, _CRITICAL = _m.MAV_SEVERITY_INFO, _m.MAV_SEVERITY_WARNING, _m.MAV_SEVERITY_CRITICAL

NOTES: tuple[tuple[str, Said | None], ...] = (
    ("Armed by", (_INFO, "Arming motors")),
    ("Disarmed by", (_INFO, "Disarming motors")),
    ("Takeoff detected", None),
    ("Landing detected", None),
    ("Failsafe activated: position lost", (_CRITICAL, "EKF Failsafe: changed to LAND Mode")),
    ("Failsafe activated: fence", (_m.MAV_SEVERITY_NOTICE, "Fence breached")),
)
"""How the supervisor's notes are put, by how they begin; others stay as they are. None: ArduCopter keeps silent."""

SEVERITY = {_m.MAV_CMD_COMPONENT_ARM_DISARM: _CRITICAL, _m.MAV_CMD_SET_MESSAGE_INTERVAL: _INFO}
"""Of the text that explains a command's refusal; a warning where nothing is said here."""

_OWN_BASE = _m.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | _m.MAV_MODE_FLAG_STABILIZE_ENABLED
_OWN_BASE |= _m.MAV_MODE_FLAG_MANUAL_INPUT_ENABLED


class ArduPilot(Flavour):
    """As ArduCopter V4.7 behaves.

    Attributes
    ----------
    number : the mode it shows.
    booting : whether it still boots.
    """

    parameters = names.OWN
    defaults = names.DEFAULTS
    bytewise = False
    habits = MissionHabits(ask_int=False, retry_us=1_000_000, give_up_us=8_000_000, home_first=True, plain_frames=True)
    texts_first = False
    software = 4 << 24 | 7 << 16 | 0 << 8 | _m.FIRMWARE_VERSION_TYPE_DEV

    def __init__(self) -> None:
        self.number = STABILIZE
        self.booting = True
        self._after: list[tuple[Sender, Message]] = []  # to be sent after the ACK
        self._warned_us: dict[str, int] = {}  # a handful of fixed texts
        self._using_gps = False
        self._gps = True

    def attach(self, parts: Parts) -> None:
        """The vehicle stands."""
        super().attach(parts)
        self._commands = ArduCommands(self, parts)
        self._setpoints = GuidedSetpoints(self, parts)
        self._requests = StreamRequests(parts.streams, self.warn)

    def rates(self, profile: Profile) -> Mapping[int, float]:
        """The same for every link: a HEARTBEAT."""
        return RATES_HZ

    def named(self, parameters: ParameterSet) -> ParameterSet:
        """ArduPilot's names where it has one."""
        return names.NamedParameters(parameters)

    def routes(self) -> Mapping[int, Handler]:
        """Messages that mean something else, or that only ArduPilot takes."""
        return {**self._requests.routes(), **self._commands.routes(), **self._setpoints.routes()}

    def commands(self) -> Mapping[int, CommandSpec]:
        """Commands that mean something else, or that only ArduPilot has."""
        return self._commands.commands()

    def builders(self) -> Mapping[int, Builder]:
        """Messages with another content, or that only ArduPilot has."""
        return {
            _m.MAVLINK_MSG_ID_HEARTBEAT: self.heartbeat,
            _m.MAVLINK_MSG_ID_CURRENT_MODE: self.current_mode,
            _m.MAVLINK_MSG_ID_AUTOPILOT_VERSION: self.autopilot_version,
            _m.MAVLINK_MSG_ID_EKF_STATUS_REPORT: self.ekf_status_report,
            _m.MAVLINK_MSG_ID_AVAILABLE_MODES_MONITOR: self.available_modes_monitor,
        }

    # The mode

    def modes(self) -> tuple[ModeInfo, ...]:
        """ArduCopter's, as far as this vehicle has them."""
        return tuple(ModeInfo(mode.name, mode.number, mode.standard) for mode in MODES)

    def change(self, number: int, now_us: int) -> Verdict:
        """Another mode, as a peer asks for it; its number is shown from here on."""
        wanted = BY_NUMBER.get(number)
        if wanted is None:
            return failed(f"No such mode {number}")
        s = self.parts.supervisor
        if s.armed:
            if wanted.needs_position and not s.conditions(now_us).position_valid:
                return failed(f"Mode change to {wanted.name} failed: requires position")
            refusal = s.ask(wanted.event, now_us)
            if refusal is not None:
                return failed(f"Mode change to {wanted.name} failed: {refusal.value}")
            if number == GUIDED:
                self._setpoints.stop(now_us)
        self.number = number
        return ACCEPTED

    def begin(self, now_us: int) -> None:
        """Let the supervisor fly the mode that was chosen while it was disarmed."""
        wanted = BY_NUMBER[self.number]
        if self.parts.supervisor.mode is not wanted.mode:
            self.parts.supervisor.ask(wanted.event, now_us)

    # What happens by itself

    def look(self, now_us: int) -> None:
        """End of boot, modes the vehicle took by itself, setpoints that go on, the simulator's switches."""
        s = self.parts.supervisor
        if self.booting and now_us >= BOOT_US:
            self.booting = False
            self.number = STABILIZE
            s.notes.append((_INFO, "ArduPilot Ready"))
        if s.armed and s.mode is Mode.LAND:
            self.number = LAND
        elif s.armed and s.mode is Mode.RTL and (s.failsafe or self.number != AUTO):
            self.number = RTL
        elif s.armed and s.mode is Mode.HOLD and s.failsafe:
            self.number = BRAKE
        using_gps = s.position_n is not None
        if using_gps and not self._using_gps:
            s.notes.append((_INFO, "EKF3 IMU0 is using GPS"))
        self._using_gps = using_gps
        self._setpoints.look(now_us)
        self._switch_gps(now_us)
        self._switch_fence()

    def _switch_fence(self) -> None:
        """The ceiling and the circle of the fence count only while it is enabled."""
        p = self.parts.parameters
        enabled = bool(p["GF_ACTION"])
        for ours, name in (("GF_MAX_VER_DIST", "FENCE_ALT_MAX"), ("GF_MAX_HOR_DIST", "FENCE_RADIUS")):
            wanted = p[name] if enabled else 0.0
            if p[ours] != wanted:
                p.set(ours, wanted)

    def _switch_gps(self, now_us: int) -> None:
        """SIM_GPS1_ENABLE takes the receiver away and gives it back."""
        wanted = bool(self.parts.parameters["SIM_GPS1_ENABLE"])
        if wanted is self._gps:
            return
        self._gps = wanted
        if wanted:
            self.parts.stack.mend(Sensor.GPS, now_us)
        else:
            self.parts.stack.inject(Fault(Sensor.GPS, FaultKind.OFF, now_us))

    def state(self) -> object:
        """The mode, and the end of boot."""
        return self.number, self.booting

    def announcement(self) -> tuple[Message, ...]:
        """A HEARTBEAT."""
        return (self.heartbeat(),)

    # How it is told

    def noted(self, severity: int, text: str) -> Said | None:
        """In ArduCopter's words where it has some."""
        return next((said for begin, said in NOTES if text.startswith(begin)), (severity, text))

    def judged(self, command: Command, title: str, verdict: Verdict) -> tuple[int, tuple[Said, ...]]:
        """FAILED for whatever PX4 would reject or deny; every reason is a text of its own."""
        result = verdict.result
        if command.command not in self._commands.own and result in _REFUSALS:
            result = _m.MAV_RESULT_FAILED
        severity = SEVERITY.get(command.command, _WARNING)
        prefix = "" if command.command in _AS_IT_IS else f"{title}: "
        return result, tuple((severity, prefix + reason) for reason in verdict.reason.split("\n") if reason)

    def after_ack(self, sender: Sender, message: Message) -> None:
        """Send a message once the present command is acknowledged."""
        self._after.append((sender, message))

    def acknowledged(self, _sender: Sender) -> None:
        """What was to follow."""
        for sender, message in self._after:
            self.parts.outbox.answer(sender, message)
        self._after.clear()

    def warn(self, text: str, now_us: int) -> None:
        """A warning, at most once a second."""
        if now_us - self._warned_us.get(text, -QUIET_US) >= QUIET_US:
            if len(self._warned_us) >= MAX_WARNED:
                self._warned_us.clear()
            self._warned_us[text] = now_us
            self.parts.outbox.text(_WARNING, text)

    # Messages

    def heartbeat(self) -> Message:
        """base_mode without guided where a pilot would steer and when it lands blindly."""
        s = self.parts.supervisor
        base = _OWN_BASE
        if self.booting or not (self.number in BY_ATTITUDE or (self.number == LAND and s.position_n is None)):
            base |= _m.MAV_MODE_FLAG_GUIDED_ENABLED
        if s.armed:
            base |= _m.MAV_MODE_FLAG_SAFETY_ARMED
        if self.booting:
            status = _m.MAV_STATE_BOOT
        elif s.failsafe and s.position_n is None:
            status = _m.MAV_STATE_CRITICAL
        else:
            status = _m.MAV_STATE_ACTIVE if s.armed and s.airborne else _m.MAV_STATE_STANDBY
        return _m.MAVLink_heartbeat_message(
            _m.MAV_TYPE_QUADROTOR, _m.MAV_AUTOPILOT_ARDUPILOTMEGA, base, self.number, status, 3
        )

    def current_mode(self) -> Message:
        """The mode it shows; nobody else intends another."""
        return _m.MAVLink_current_mode_message(BY_NUMBER[self.number].standard, self.number, self.number)

    def autopilot_version(self) -> Message:
        """As everywhere, but for how integers travel in parameters."""
        message = self.parts.telemetry.autopilot_version()
        message.capabilities &= ~_m.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
        message.capabilities |= _m.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_C_CAST
        return message

    def ekf_status_report(self) -> Message:
        """What the filter knows, and its innovation test ratios (above 1: rejected)."""
        e = self.parts.telemetry.estimate
        ratio = e.test_ratio
        return _m.MAVLink_ekf_status_report_message(
            ekf_flags(e, airborne=self.parts.supervisor.airborne),
            ratio.get("gps_velocity", 0.0),
            ratio.get("gps_position", 0.0),
            ratio.get("baro", 0.0),
            ratio.get("mag", 0.0),
            0.0,
        )


_REFUSALS = (_m.MAV_RESULT_TEMPORARILY_REJECTED, _m.MAV_RESULT_DENIED)
_AS_IT_IS = (_m.MAV_CMD_DO_SET_MODE, _m.MAV_CMD_SET_MESSAGE_INTERVAL)
"""Commands whose reasons are whole sentences already."""


def ekf_flags(e: Estimate, *, airborne: bool) -> int:
    """EKF_STATUS_FLAGS: constant position is what a vehicle on the ground assumes until it knows better."""
    if not e.attitude_valid:
        return int(_m.EKF_UNINITIALIZED)
    flags = _m.EKF_ATTITUDE
    if e.velocity_valid:
        flags |= _m.EKF_VELOCITY_HORIZ | _m.EKF_VELOCITY_VERT
    if e.altitude_valid:
        flags |= _m.EKF_VELOCITY_VERT | _m.EKF_POS_VERT_ABS
    if e.position_valid:
        flags |= _m.EKF_POS_HORIZ_REL | _m.EKF_POS_HORIZ_ABS | _m.EKF_PRED_POS_HORIZ_REL | _m.EKF_PRED_POS_HORIZ_ABS
    elif not airborne:
        flags |= _m.EKF_CONST_POS_MODE
    return int(flags)
