"""Commands about home, missions, speed and faults, heartbeats of ground stations, and FENCE_STATUS."""

import math
from collections.abc import Callable, Mapping

from fakevehicle.codec import Message
from fakevehicle.faults import INSTANCES, Fault, FaultKind, Sensor, typical
from fakevehicle.fence import FenceMonitor
from fakevehicle.modes import Event, Refusal
from fakevehicle.places import Places
from fakevehicle.plans import GLOBAL_FRAMES
from fakevehicle.services.commands import FASTEST, MAX_GOTO, SLOWEST
from fakevehicle.services.missions import Missions
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import (
    ACCEPTED,
    Builder,
    Command,
    CommandSpec,
    Handler,
    Service,
    Verdict,
    denied,
    judged,
)
from fakevehicle.supervisor import Supervisor
from fakevehicle.vocabulary import Geodetic
from wire.dialect import mavlink

_m = mavlink


class Navigation(Service):
    """Carries out what concerns the way rather than the mode.

    Parameters
    ----------
    supervisor : flies.
    missions : knows the items as clients count them.
    outbox, places : as everywhere.
    inject, mend : give a fault to the flight stack, and end those of a sensor, or of one of several alike.
    announce_home, announce_origin : build HOME_POSITION and GPS_GLOBAL_ORIGIN.
    restart : begins the vehicle anew after this tick.
    """

    def __init__(
        self,
        supervisor: Supervisor,
        missions: Missions,
        outbox: Outbox,
        places: Places,
        inject: Callable[[Fault], None],
        mend: Callable[[Sensor, int, int | None], None],
        announce_home: Builder,
        announce_origin: Builder,
        restart: Callable[[], None],
    ) -> None:
        self._supervisor = supervisor
        self._missions = missions
        self._outbox = outbox
        self._places = places
        self._inject = inject
        self._mend = mend
        self._announce_home = announce_home
        self._announce_origin = announce_origin
        self._restart = restart
        self._breached = False

    def routes(self) -> Mapping[int, Handler]:
        """Heartbeats are listened to; SET_HOME_POSITION is the old way to set home."""
        return {
            _m.MAVLINK_MSG_ID_HEARTBEAT: self.heartbeat,
            _m.MAVLINK_MSG_ID_SET_HOME_POSITION: self.set_home_position,
            _m.MAVLINK_MSG_ID_SET_GPS_GLOBAL_ORIGIN: self.set_origin,
        }

    def commands(self) -> Mapping[int, CommandSpec]:
        """In the order of their numbers."""
        return {
            _m.MAV_CMD_DO_CHANGE_SPEED: CommandSpec(self._change_speed, "Speed change", (1, 2, 3)),
            _m.MAV_CMD_DO_SET_HOME: CommandSpec(self._set_home, "Home", (1, 4, 5, 6, 7)),
            _m.MAV_CMD_DO_FLIGHTTERMINATION: CommandSpec(self._terminate, "Termination", (1,)),
            _m.MAV_CMD_DO_PAUSE_CONTINUE: CommandSpec(self._pause, "Pause", (1,)),
            _m.MAV_CMD_DO_FENCE_ENABLE: CommandSpec(self._enable_fence, "Fence", (1,)),
            _m.MAV_CMD_DO_SET_MISSION_CURRENT: CommandSpec(self._set_current, "Mission item", (1, 2)),
            _m.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN: CommandSpec(self._reboot, "Reboot", (1, 2, 3, 4, 5, 6, 7)),
            _m.MAV_CMD_MISSION_START: CommandSpec(self._start, "Mission start", (1, 2)),
            _m.MAV_CMD_GET_HOME_POSITION: CommandSpec(self._get_home, "Home request"),
            _m.MAV_CMD_INJECT_FAILURE: CommandSpec(self._inject_failure, "Failure", (1, 2, 3)),
        }

    def builders(self) -> Mapping[int, Builder]:
        """What the fence has to say."""
        return {_m.MAVLINK_MSG_ID_FENCE_STATUS: self.fence_status}

    def step(self, now_us: int) -> None:
        """Tell of a breach as soon as it begins or ends."""
        breached = self._supervisor.fence.breach is not None
        if breached is not self._breached:
            self._breached = breached
            message = self.fence_status()
            if message is not None:
                self._outbox.everywhere(message)

    def heartbeat(self, _sender: Sender, message: Message, now_us: int) -> None:
        """A ground station's keeps the data link; everybody else's says nothing to us."""
        if message.type == _m.MAV_TYPE_GCS:
            self._supervisor.ground_station(now_us)

    def fence_status(self) -> Message | None:
        """None without a fence."""
        fence: FenceMonitor = self._supervisor.fence
        if not fence.present:
            return None
        kind = _m.FENCE_BREACH_NONE if fence.breach is None else fence.breach.value
        return _m.MAVLink_fence_status_message(
            fence.breach is not None, min(fence.breaches, 0xFFFF), kind, fence.since_us // 1000 & 0xFFFFFFFF, 0
        )

    # Home

    def set_origin(self, sender: Sender, _message: Message, _now_us: int) -> None:
        """The origin is where the receiver put it: it is told again, and that it stays."""
        message = self._announce_origin()
        if message is not None:
            self._outbox.answer(sender, message)
        self._outbox.text(_m.MAV_SEVERITY_WARNING, "Origin denied: it is the first fix's")

    def set_home_position(self, sender: Sender, message: Message, now_us: int) -> None:
        """The old message: latitude and longitude e7, altitude in mm; answered by HOME_POSITION."""
        place = (message.latitude * 1e-7, message.longitude * 1e-7, message.altitude * 1e-3)
        refusal = self._put_home(*place, math.nan)
        if refusal is not None:
            self._outbox.text(_m.MAV_SEVERITY_WARNING, f"Home denied: {refusal}")

    def _set_home(self, _sender: Sender, command: Command, _now_us: int) -> Verdict:
        """Parameter 1: 1 here, 0 the place in 5, 6 and 7; 4 is the heading [deg]."""
        degrees = command.params[3]
        yaw = math.radians(degrees) if degrees and math.isfinite(degrees) else math.nan
        if command.params[0] == 1.0:
            return judged(self._supervisor.ask_home(None, yaw))
        if command.params[0] != 0.0:
            return denied(f"param1 is {command.params[0]:g}, expected 0 or 1")
        if command.frame not in GLOBAL_FRAMES:
            return denied(f"frame {command.frame}, expected a global one above sea level")
        refusal = self._put_home(command.latitude_deg, command.longitude_deg, command.params[4], yaw)
        return ACCEPTED if refusal is None else denied(refusal)

    def _put_home(self, latitude: float, longitude: float, altitude: float, yaw: float) -> str | None:
        if not (abs(latitude) <= 90.0 and abs(longitude) <= 180.0 and math.isfinite(altitude)):
            return "the place is not on the globe"
        here_n = self._supervisor.position_n
        place = Geodetic(math.radians(latitude), math.radians(longitude), altitude)
        position_n = self._places.local(place)
        if position_n is None or here_n is None:
            return Refusal.NO_POSITION.value
        if math.dist(position_n, here_n) > MAX_GOTO:
            return f"{math.dist(position_n, here_n) / 1000:.1f} km away"
        refusal = self._supervisor.ask_home(position_n, yaw)
        return None if refusal is None else refusal.value

    def _get_home(self, sender: Sender, _command: Command, _now_us: int) -> Verdict:
        """By HOME_POSITION; clients ask every 2 s while there is none, so that is said by the result alone."""
        message = self._announce_home()
        if message is None:
            return Verdict(_m.MAV_RESULT_FAILED)
        self._outbox.answer(sender, message)
        return ACCEPTED

    # The mission

    def _start(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        """From the item in parameter 1, when it names one; arms, as PX4 does. What is refused changes nothing."""
        s, first = self._supervisor, command.params[0]
        named = math.isfinite(first) and first > 0.0
        reason = self._missions.why_not_current(round(first)) if named else None
        if reason is not None:
            return denied(reason)
        refusal = s.why_not_startable(now_us)
        if refusal is not None:
            return judged(refusal)
        if named:
            self._missions.jump(round(first))
        refusal = s.ask(Event.ASK_MISSION, now_us)
        return judged(refusal if refusal is not None or s.armed else s.ask(Event.ASK_ARM, now_us))

    def _set_current(self, _sender: Sender, command: Command, _now_us: int) -> Verdict:
        """Parameter 1: the item, -1 for the present one; 2: begin anew, with its jumps."""
        item = command.params[0]
        if not math.isfinite(item) or item == -1.0:
            return ACCEPTED
        reason = self._missions.jump(round(item))
        return ACCEPTED if reason is None else denied(reason)

    def _pause(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        """0 holds, 1 goes on with the mission."""
        if command.params[0] not in (0.0, 1.0):
            return denied(f"param1 is {command.params[0]:g}, expected 0 or 1")
        return judged(self._supervisor.ask(Event.ASK_MISSION if command.params[0] else Event.ASK_HOLD, now_us))

    def _change_speed(self, _sender: Sender, command: Command, _now_us: int) -> Verdict:
        """Over ground (types 0 and 1) until the mode changes; -2 gives back the default, -1 changes nothing."""
        kind, speed = command.params[:2]
        if kind not in (0.0, 1.0) and not math.isnan(kind):
            return denied(f"param1 is {kind:g}, only the speed over ground can be changed")
        if math.isnan(speed) or speed == -1.0:
            return ACCEPTED
        if speed != -2.0 and not SLOWEST <= speed <= FASTEST:
            return denied(f"param2 is {speed:g}, expected {SLOWEST:g}..{FASTEST:g} m/s")
        self._supervisor.ask_speed(None if speed == -2.0 else speed)
        return ACCEPTED

    # The vehicle itself

    def _terminate(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        """Motors off, wherever it is; parameter 1 above a half, as PX4 has it. Otherwise nothing, and that is said."""
        if command.params[0] > 0.5:
            return judged(self._supervisor.ask(Event.ASK_KILL, now_us))
        self._outbox.text(_m.MAV_SEVERITY_INFO, "Termination not asked for, param1 is not 1: nothing done")
        return ACCEPTED

    def _enable_fence(self, _sender: Sender, command: Command, _now_us: int) -> Verdict:
        """0 off, 1 on; the floor alone (2) is nothing this fence has."""
        if command.params[0] not in (0.0, 1.0):
            return denied(f"param1 is {command.params[0]:g}, expected 0 or 1")
        self._supervisor.fence.enabled = command.params[0] == 1.0
        return ACCEPTED

    def _reboot(self, _sender: Sender, command: Command, _now_us: int) -> Verdict:
        """Parameter 1: 1 begins the vehicle anew, 0 leaves it; what the others are about is not here.

        Clients that mean everything set 1 to 4 alike.
        """
        wanted = command.params[0]
        if wanted != 1.0:
            if all(not p or math.isnan(p) for p in command.params):
                return ACCEPTED
            return Verdict(_m.MAV_RESULT_UNSUPPORTED, _NO_REBOOT.get(wanted, "only the autopilot can be rebooted"))
        if self._supervisor.armed:
            return Verdict(_m.MAV_RESULT_TEMPORARILY_REJECTED, "it is armed")
        self._restart()
        self._outbox.text(_m.MAV_SEVERITY_INFO, "Rebooting by external command")
        return ACCEPTED

    def _inject_failure(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        """FAILURE_UNIT, FAILURE_TYPE and instance (0: all of them): failing or, with OK, well again from now on."""
        unit, kind, instance = (round(p) if math.isfinite(p) else -1 for p in command.params[:3])
        sensor = _UNITS.get(unit)
        if sensor is None:
            return denied(f"param1 is {unit}, a unit this vehicle cannot fail")
        most = INSTANCES.get(sensor, 1)
        if not 0 <= instance <= most:
            return denied(f"param3 is {instance}, expected 0..{most}")
        if kind == _m.FAILURE_TYPE_OK:
            self._mend(sensor, now_us, instance - 1 if instance else None)
            return ACCEPTED
        fault = _FAILURES.get(kind)
        magnitude = None if fault is None else typical(sensor, fault)
        if fault is None or magnitude is None:
            known = "ok (0), off (1), stuck (2), garbage (3), wrong (4) or delayed (6)"
            if sensor is Sensor.MOTOR:
                known = "ok (0), off (1) or wrong (4)"
            return Verdict(_m.MAV_RESULT_UNSUPPORTED, f"param2 is {kind}, expected {known}")
        for index in (instance - 1,) if instance else range(most):
            self._inject(Fault(sensor, fault, now_us, None, magnitude, index))
        return ACCEPTED


_NO_REBOOT = {2.0: "it is switched off by ending the simulator", 3.0: "it has no bootloader to stay in"}
_UNITS = {
    _m.FAILURE_UNIT_SENSOR_GYRO: Sensor.GYRO,
    _m.FAILURE_UNIT_SENSOR_ACCEL: Sensor.ACCEL,
    _m.FAILURE_UNIT_SENSOR_MAG: Sensor.MAG,
    _m.FAILURE_UNIT_SENSOR_BARO: Sensor.BARO,
    _m.FAILURE_UNIT_SENSOR_GPS: Sensor.GPS,
    _m.FAILURE_UNIT_SENSOR_DISTANCE_SENSOR: Sensor.RANGE,
    _m.FAILURE_UNIT_SYSTEM_BATTERY: Sensor.BATTERY,
    _m.FAILURE_UNIT_SYSTEM_MOTOR: Sensor.MOTOR,
    _m.FAILURE_UNIT_SYSTEM_AVOIDANCE: Sensor.OBSTACLE,
}
_FAILURES = {
    _m.FAILURE_TYPE_OFF: FaultKind.OFF,
    _m.FAILURE_TYPE_STUCK: FaultKind.STUCK,
    _m.FAILURE_TYPE_GARBAGE: FaultKind.NOISE,
    _m.FAILURE_TYPE_WRONG: FaultKind.BIAS,
    _m.FAILURE_TYPE_DELAYED: FaultKind.DELAY,
}
