"""COMMAND_LONG and COMMAND_INT: what each command does, and the COMMAND_ACK that always follows.

Both messages become one `Command`; the table that the services' `commands()` make together says who carries it out and
which parameters are understood. A handler returns a `Verdict`; every refusal gives a reason, which goes out as a
STATUSTEXT beside the ACK. NaN in a parameter counts as not given, and so does 0 in one that is not understood; in
PX4's flavour any other value there is DENIED, since it asks for something that would not happen (in ArduPilot's own
commands it is ignored, as ArduPilot does). Three are taken though they change nothing, for what clients really send:
the pitch of a takeoff (of planes only; QGroundControl sends -1), a place to take off or land at, as long as it is the
one below the vehicle, and the version number of REQUEST_AUTOPILOT_CAPABILITIES.

The refusals' result codes are PX4's: TEMPORARILY_REJECTED when the vehicle's condition forbids it, DENIED when the
parameters do, UNSUPPORTED for a command it does not have, FAILED where PX4 fails (a stream it does not know).
"""

import math
from collections.abc import Mapping
from typing import Protocol

import numpy as np

from fakevehicle.codec import Message
from fakevehicle.modes import Event, Refusal
from fakevehicle.places import Places
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import (
    ACCEPTED,
    Command,
    CommandSpec,
    Handler,
    Service,
    Verdict,
    denied,
    judged,
)
from fakevehicle.services.streams import Streams
from fakevehicle.supervisor import Supervisor
from fakevehicle.vocabulary import Geodetic
from wire.dialect import mavlink

FORCE = 21196
"""COMPONENT_ARM_DISARM's param2 that means: whatever the state."""
INT_UNSET = 2**31 - 1
RADIANS_PER_E7 = math.radians(1e-7)
_GLOBAL = (mavlink.MAV_FRAME_GLOBAL, mavlink.MAV_FRAME_GLOBAL_INT)
_RELATIVE = (mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT, mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT)


class Judge(Protocol):
    """What a flavour has to say about every command."""

    def judged(self, command: Command, title: str, verdict: Verdict) -> tuple[int, tuple[tuple[int, str], ...]]:
        """MAV_RESULT, and the texts (severity, words) that explain a refusal."""

    def acknowledged(self, sender: Sender) -> None:
        """The ACK has just been sent."""


class Commands(Service):
    """Acknowledges every command, and carries out those of flying, streams and requests.

    Attributes
    ----------
    table : the commands of all services; set by the vehicle once all of them stand.
    rejected : how many were refused.
    """

    def __init__(
        self, supervisor: Supervisor, outbox: Outbox, streams: Streams, places: Places, flavour: Judge
    ) -> None:
        self._flavour = flavour
        self._supervisor = supervisor
        self._outbox = outbox
        self._streams = streams
        self._places = places
        self.table: Mapping[int, CommandSpec] = {}
        self.rejected = 0

    def routes(self) -> Mapping[int, Handler]:
        """The two command messages."""
        return {
            mavlink.MAVLINK_MSG_ID_COMMAND_LONG: self.command_long,
            mavlink.MAVLINK_MSG_ID_COMMAND_INT: self.command_int,
        }

    def commands(self) -> Mapping[int, CommandSpec]:
        """What this service carries out itself."""
        m = mavlink
        return {
            m.MAV_CMD_NAV_RETURN_TO_LAUNCH: CommandSpec(self._return, "Return"),
            m.MAV_CMD_NAV_LAND: CommandSpec(self._land, "Landing", (5, 6, 7)),
            m.MAV_CMD_NAV_TAKEOFF: CommandSpec(self._takeoff, "Takeoff", (1, 5, 6, 7)),
            m.MAV_CMD_DO_REPOSITION: CommandSpec(self._reposition, "Goto", (1, 2, 4, 5, 6, 7)),
            m.MAV_CMD_COMPONENT_ARM_DISARM: CommandSpec(self._arm_disarm, "Arming", (1, 2)),
            m.MAV_CMD_GET_MESSAGE_INTERVAL: CommandSpec(self._get_interval, "Message interval", (1,)),
            m.MAV_CMD_SET_MESSAGE_INTERVAL: CommandSpec(self._set_interval, "Message interval", (1, 2, 7)),
            m.MAV_CMD_REQUEST_MESSAGE: CommandSpec(self._request_message, "Message request", (1, 7)),
            m.MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES: CommandSpec(self._request_capabilities, "Version request", (1,)),
        }

    def command_long(self, sender: Sender, message: Message, now_us: int) -> None:
        """COMMAND_LONG: seven floats; 5 and 6 are degrees where they are a place."""
        m = message
        params = (m.param1, m.param2, m.param3, m.param4, m.param7)
        self.carry_out(sender, Command(m.command, params, m.param5, m.param6, mavlink.MAV_FRAME_GLOBAL), now_us)

    def command_int(self, sender: Sender, message: Message, now_us: int) -> None:
        """COMMAND_INT: x and y are degrees times 1e7 where they are a place."""
        m = message
        latitude = math.nan if m.x == INT_UNSET else m.x * 1e-7
        longitude = math.nan if m.y == INT_UNSET else m.y * 1e-7
        params = (m.param1, m.param2, m.param3, m.param4, m.z)
        self.carry_out(sender, Command(m.command, params, latitude, longitude, m.frame), now_us)

    def carry_out(self, sender: Sender, command: Command, now_us: int) -> None:
        """Do it or refuse it, and say so."""
        spec = self.table.get(command.command)
        if spec is None:
            verdict = Verdict(mavlink.MAV_RESULT_UNSUPPORTED, "this vehicle does not have it")
        elif surplus := _surplus(command, spec.understood):
            verdict = denied(surplus)
        else:
            verdict = spec.carry_out(sender, command, now_us)
        result, said = self._flavour.judged(command, _title(command, spec), verdict)
        self._outbox.answer(
            sender,
            mavlink.MAVLink_command_ack_message(command.command, result, 0, 0, sender.system_id, sender.component_id),
        )
        self._flavour.acknowledged(sender)
        if verdict.reason:
            self.rejected += 1
        for severity, text in said:
            self._outbox.text(severity, text)

    # The commands, in the order of their numbers

    def _return(self, _sender: Sender, _command: Command, now_us: int) -> Verdict:
        return judged(self._supervisor.ask(Event.ASK_RTL, now_us))

    def _land(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        """Here and now, as PX4 does; another place is refused where PX4 would quietly land here."""
        elsewhere = self._elsewhere(command)
        if elsewhere is not None:
            return denied(f"that place is {elsewhere:.0f} m away, it lands here")
        return judged(self._supervisor.ask(Event.ASK_LAND, now_us))

    def _takeoff(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        """To parameter 7, metres above mean sea level as in PX4; NaN or 0: MIS_TAKEOFF_ALT above the ground."""
        elsewhere = self._elsewhere(command)
        if elsewhere is not None:
            return denied(f"that place is {elsewhere:.0f} m away, it climbs here")
        altitude = command.params[4]
        if math.isnan(altitude) or altitude == 0.0:
            return judged(self._supervisor.ask_takeoff(now_us, None))
        origin = self._places.origin
        if origin is None:
            return judged(Refusal.NO_POSITION)
        if not math.isfinite(altitude):
            return denied(f"altitude {altitude}")
        if command.frame in _RELATIVE:
            home = self._supervisor.home
            return judged(self._supervisor.ask_takeoff(now_us, (home.position_n[2] if home else 0.0) - altitude))
        return judged(self._supervisor.ask_takeoff(now_us, origin.altitude - altitude))

    def _elsewhere(self, command: Command) -> float | None:
        """How far away [m] the command's place is, when it has one and that is not where the vehicle is."""
        latitude, longitude = command.latitude_deg, command.longitude_deg
        if math.isnan(latitude) or math.isnan(longitude) or latitude == longitude == 0.0:
            return None
        origin, here_n = self._places.origin, self._supervisor.position_n
        if origin is None or here_n is None:
            return None  # what needs a position is refused for want of one
        if not _on_globe(latitude, longitude):
            return math.inf
        there_n = self._places.local(Geodetic(np.radians(latitude), np.radians(longitude), origin.altitude))
        distance = math.inf if there_n is None else math.dist(there_n[:2], here_n[:2])
        return distance if distance > HERE else None

    def _reposition(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        """Fly to a place and hold. Parameter 4 is the yaw [rad]; NaN anywhere keeps what is.

        The speed (1) holds until the mode changes; -1 and 0 are MPC_XY_CRUISE. Of the flags (2) it has CHANGE_MODE.
        """
        speed, flags = command.params[:2]
        own = speed in (-1.0, 0.0) or math.isnan(speed)
        if not own and not SLOWEST <= speed <= FASTEST:
            return denied(f"param1 is {speed:g}, expected -1 or {SLOWEST:g}..{FASTEST:g} m/s")
        if flags not in (0.0, 1.0) and not math.isnan(flags):
            return denied(f"param2 is {flags:g}, expected 0 or 1")
        if command.frame not in _GLOBAL + _RELATIVE:
            return denied(f"frame {command.frame}, expected a global one")
        home, estimate_n = self._supervisor.home, self._supervisor.position_n
        origin = self._places.origin
        if origin is None or home is None or estimate_n is None:
            return judged(Refusal.NO_POSITION)
        target_n = estimate_n.copy()
        if not (math.isnan(command.latitude_deg) or math.isnan(command.longitude_deg)):
            if not _on_globe(command.latitude_deg, command.longitude_deg):
                return denied(f"latitude {command.latitude_deg}, longitude {command.longitude_deg}: not on the globe")
            place = Geodetic(np.radians(command.latitude_deg), np.radians(command.longitude_deg), origin.altitude)
            local_n = self._places.local(place)
            if local_n is None:
                return judged(Refusal.NO_POSITION)
            target_n[:2] = local_n[:2]
        altitude = command.params[4]
        if math.isfinite(altitude):
            relative = command.frame in _RELATIVE
            target_n[2] = home.position_n[2] - altitude if relative else origin.altitude - altitude
        distance = math.dist(target_n, estimate_n)
        if distance > MAX_GOTO:
            return denied(f"{distance / 1000:.1f} km away, expected at most {MAX_GOTO / 1000:g} km")
        yaw = command.params[3]
        yaw = yaw if math.isfinite(yaw) else math.nan
        return judged(self._supervisor.ask_goto(now_us, target_n, yaw, None if own else speed))

    def _arm_disarm(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        wanted, force = command.params[0], command.params[1]
        if wanted not in (0.0, 1.0):
            return denied(f"param1 is {wanted:g}, expected 0 or 1")
        if force not in (0.0, FORCE) and not math.isnan(force):
            return denied(f"param2 is {force:g}, expected 0 or {FORCE}")
        if wanted == 1.0:  # force does not bypass the checks of arming, in PX4 from outside either
            return judged(self._supervisor.ask(Event.ASK_ARM, now_us))
        event = Event.ASK_KILL if force == FORCE else Event.ASK_DISARM
        return judged(self._supervisor.ask(event, now_us))

    def _get_interval(self, sender: Sender, command: Command, _now_us: int) -> Verdict:
        """Answered by MESSAGE_INTERVAL: 0 for a message we do not have, -1 for one that is switched off."""
        number = _whole(command.params[0])
        interval = 0 if number is None else self._streams.interval_us(sender.link, number)
        answered = 0 if number is None or not 0 <= number <= 0xFFFF else number
        self._outbox.answer(sender, mavlink.MAVLink_message_interval_message(answered, interval))
        return ACCEPTED

    def _set_interval(self, sender: Sender, command: Command, now_us: int) -> Verdict:
        """For every peer of the sender's link: response target (7) 0, the vehicle's choice, or 2, broadcast."""
        if not _is_target(command.params[4], (0.0, 2.0)):
            return denied(f"param7 is {command.params[4]:g}, streams go to all (0 or 2)")
        number, interval = _whole(command.params[0]), command.params[1]
        if number is None or not math.isfinite(interval):
            return denied("a message number and an interval are needed")
        if not self._streams.set_interval(sender.link, number, round(interval), now_us):
            return Verdict(mavlink.MAV_RESULT_FAILED, f"this vehicle has no message {number}")
        return ACCEPTED

    def _request_message(self, sender: Sender, command: Command, now_us: int) -> Verdict:
        """The message goes out before its ACK, as PX4 does it.

        Response target (7): 0, the vehicle's choice, and 1 answer the sender, 2 tells everybody.
        """
        if not _is_target(command.params[4], (0.0, 1.0, 2.0)):
            return denied(f"param7 is {command.params[4]:g}, expected 0, 1 or 2")
        number = _whole(command.params[0])
        message = None if number is None else self._streams.build(number)
        if message is None:
            if number is not None and self._streams.knows(number):
                return Verdict(mavlink.MAV_RESULT_TEMPORARILY_REJECTED, f"message {number} has no content yet")
            return denied(f"this vehicle has no message {number}")
        if command.params[4] == BROADCAST:
            self._outbox.everywhere(message)
        else:
            self._outbox.answer(sender, message)
        return ACCEPTED

    def _request_capabilities(self, sender: Sender, _command: Command, now_us: int) -> Verdict:
        self._outbox.answer(sender, self._streams.build(mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION))
        return ACCEPTED


MAX_GOTO = 10_000.0
"""Farthest place a DO_REPOSITION may name [m]; the local frame is flat."""

SLOWEST, FASTEST = 0.1, 30.0
"""Speeds that may be asked for [m/s]."""
HERE = 10.0
"""A place this near to the vehicle [m] is where it is: clients send the place they last saw, and GPS wanders."""
BROADCAST = 2.0
"""REQUEST_MESSAGE's response target that means everybody."""


def _title(command: Command, spec: CommandSpec | None) -> str:
    if command.command == mavlink.MAV_CMD_COMPONENT_ARM_DISARM and command.params[0] == 0.0:
        return "Disarming"
    return f"Command {command.command}" if spec is None else spec.title


def _surplus(command: Command, understood: tuple[int, ...]) -> str:
    """The first parameter that asks for something which would not happen, in words; empty when none does."""
    p = command.params
    values = (p[0], p[1], p[2], p[3], command.latitude_deg, command.longitude_deg, p[4])
    for number, value in enumerate(values, start=1):
        if number not in understood and value != 0.0 and not math.isnan(value):
            return f"param{number} is {value:g}, not supported"
    return ""


def _is_target(value: float, known: tuple[float, ...]) -> bool:
    return math.isnan(value) or value in known


def _on_globe(latitude_deg: float, longitude_deg: float) -> bool:
    return abs(latitude_deg) <= 90.0 and abs(longitude_deg) <= 180.0


def _whole(value: float) -> int | None:
    """A parameter as a whole number; None when it is not finite."""
    return round(value) if math.isfinite(value) else None
