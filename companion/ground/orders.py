"""Commands that ground stations give to the companion itself, as orders; docs/mission.md has the table.

Only what is addressed to our system and our own component is looked at: a command for the vehicle (or for everybody of
it) is the autopilot's. Every command is answered with a COMMAND_ACK, every refusal with a text that says why. A command
repeated because its answer was lost (confirmation counted up) gets the same answer and is not carried out again.
"""

import math
from collections.abc import Callable
from typing import Any

from companion.ground.progress import Progress
from companion.ground.protocol import Answer, Sender
from companion.hooks import Obey
from companion.seam import Order
from wire.dialect import mavlink

_m = mavlink
Place = tuple[float, float, float]
Locate = Callable[[float, float, float, bool], Place | None]
"""(latitude [deg], longitude [deg], altitude [m], whether that counts from home) in the mission frame as north, east,
altitude [m]; None where that is not known."""

REPEATED_US = 5_000_000
MOST_KEPT = 64
ABOVE_HOME = (_m.MAV_FRAME_GLOBAL_RELATIVE_ALT, _m.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT)
ABOVE_SEA = (_m.MAV_FRAME_GLOBAL, _m.MAV_FRAME_GLOBAL_INT)


class Orders:
    """Turns commands into orders.

    Parameters
    ----------
    locate : finds places of the earth in the mission frame.
    progress : of the flight in its plan.
    """

    def __init__(self, locate: Locate, progress: Progress) -> None:
        self._locate, self._progress = locate, progress
        self._answered: dict[tuple[Sender, int], tuple[int, tuple[float, ...], int]] = {}

    def take(self, now_us: int, sender: Sender, message: Any, obey: Obey) -> Answer | None:
        """A COMMAND_LONG, COMMAND_INT or MISSION_SET_CURRENT that is for us; None for any other message."""
        kind = message.get_type()
        if kind == "MISSION_SET_CURRENT":
            return self._set_current(sender, message.seq, obey)
        if kind not in ("COMMAND_LONG", "COMMAND_INT"):
            return None
        params, key = _params(message), (sender, message.command)
        before = self._answered.get(key)
        if kind == "COMMAND_LONG" and message.confirmation > 0 and before is not None:
            then_us, asked, result = before
            if now_us - then_us <= REPEATED_US and _same(asked, params):
                return Answer(sender, (self._ack(sender, message.command, result),))
        source = f"{sender.system_id}/{sender.component_id}"
        frame = message.frame if kind == "COMMAND_INT" else _m.MAV_FRAME_GLOBAL
        result, text, more = self._carry_out(message.command, params, frame, source, obey)
        while len(self._answered) >= MOST_KEPT:
            del self._answered[next(iter(self._answered))]
        self._answered[key] = (now_us, params, result)
        return Answer(sender, (self._ack(sender, message.command, result), *more), text)

    def _carry_out(
        self, command: int, params: tuple[float, ...], frame: int, source: str, obey: Obey
    ) -> tuple[int, str, tuple[Any, ...]]:
        """MAV_RESULT, why it is no better, and what is sent beside it."""
        entry = _m.enums["MAV_CMD"].get(command)
        name = entry.name.removeprefix("MAV_CMD_") if entry is not None else f"command {command}"
        if command == _m.MAV_CMD_REQUEST_MESSAGE:
            told = self._told(params[0])
            text = "" if told is not None else f"{name}: message {params[0]:g} is not told by the companion"
            return _m.MAV_RESULT_UNSUPPORTED if text else _m.MAV_RESULT_ACCEPTED, text, (told,) if told else ()
        if command in NOT_OBEYED:
            return _m.MAV_RESULT_UNSUPPORTED, f"{name} is not obeyed by the companion: {NOT_OBEYED[command]}", ()
        order = self._order(command, params, frame, source)
        if order is None:
            return _m.MAV_RESULT_UNSUPPORTED, f"{name} is not obeyed by the companion", ()
        reason = order if isinstance(order, str) else obey(order)
        if reason:
            return _m.MAV_RESULT_DENIED, f"{name} refused: {reason}", ()
        left = _left_out(command, params)
        return _m.MAV_RESULT_ACCEPTED, f"{name}: {left}" if left else "", ()

    def _set_current(self, sender: Sender, item: int, obey: Obey) -> Answer:
        """The older form of DO_SET_MISSION_CURRENT: it has no acknowledgement but MISSION_CURRENT."""
        order = self._gone_on_with(float(item), f"{sender.system_id}/{sender.component_id}")
        reason = order if isinstance(order, str) else obey(order)
        return Answer(sender, (self._progress.message(),), f"MISSION_SET_CURRENT refused: {reason}" if reason else "")

    def _told(self, number: float) -> Any:
        """A message that is asked for; None: it is none of ours."""
        match number:
            case _m.MAVLINK_MSG_ID_AUTOPILOT_VERSION:
                return _version()
            case _m.MAVLINK_MSG_ID_MISSION_CURRENT:
                return self._progress.message()
        return None

    def _order(self, command: int, params: tuple[float, ...], frame: int, source: str) -> Order | str | None:
        """The order that is meant; why there is none; None: not ours."""
        p1, p2 = params[:2]
        match command:
            case _m.MAV_CMD_MISSION_START if p1 > 0.0 and p1 != self._progress.first:
                return f"found first item {p1:g}, expected 0: a plan is begun at its beginning"
            case _m.MAV_CMD_MISSION_START if p2 > 0.0 and p2 != self._progress.last:
                return f"found last item {p2:g}, expected 0: a plan is flown to its end"
            case _m.MAV_CMD_MISSION_START:
                return Order("start", source=source)
            case _m.MAV_CMD_DO_SET_MISSION_CURRENT:
                return self._gone_on_with(p1, source)
            case _m.MAV_CMD_DO_PAUSE_CONTINUE if p1 in (0.0, 1.0):
                return Order("resume" if p1 else "hold", source=source)
            case _m.MAV_CMD_DO_PAUSE_CONTINUE:
                return f"found {p1:g}, expected 0 to pause or 1 to go on"
            case _m.MAV_CMD_NAV_LOITER_UNLIM if _somewhere(params):
                return "DO_REPOSITION goes to a place"
            case _m.MAV_CMD_NAV_LOITER_UNLIM:
                return Order("hold", source=source)
            case _m.MAV_CMD_NAV_RETURN_TO_LAUNCH:
                return Order("return", source=source)
            case _m.MAV_CMD_NAV_LAND:
                return Order("land", source=source)
            case _m.MAV_CMD_COMPONENT_ARM_DISARM if p1 == 0.0:
                return Order("abort", source=source)
            case _m.MAV_CMD_COMPONENT_ARM_DISARM:
                return "it arms by itself when a mission is started"
            case _m.MAV_CMD_DO_REPOSITION:
                return self._reposition(params, frame, source)
        return None

    def _gone_on_with(self, item: float, source: str) -> Order | str:
        """The order to leave the items before one out."""
        step = self._progress.step_of(int(item)) if item >= 0.0 and item == int(item) else f"found item {item:g}"
        return step if isinstance(step, str) else Order("skip", (float(step),), source)

    def _reposition(self, params: tuple[float, ...], frame: int, source: str) -> Order | str:
        latitude, longitude, altitude = params[4:7]
        if math.isnan(latitude) and math.isnan(longitude):
            return Order("hold", source=source)  # nowhere: stay
        if frame not in (*ABOVE_HOME, *ABOVE_SEA):
            return f"found frame {frame}, expected a global one"
        if not (abs(latitude) <= 90.0 and abs(longitude) <= 180.0 and math.isfinite(altitude)):
            return "found no place, expected latitude, longitude and altitude"
        place = self._locate(latitude, longitude, altitude, frame in ABOVE_HOME)
        if place is None:
            return "where the vehicle is on the earth is not known"
        return Order("goto", place, source=source)

    def _ack(self, sender: Sender, command: int, result: int) -> Any:
        return _m.MAVLink_command_ack_message(command, result, 0, 0, *sender)


NOT_OBEYED = {
    _m.MAV_CMD_DO_SET_MODE: "the vehicle's mode is its own; MISSION_START flies, DO_PAUSE_CONTINUE pauses",
    _m.MAV_CMD_NAV_TAKEOFF: "it takes off by itself when a mission is started",
    _m.MAV_CMD_DO_CHANGE_SPEED: "the speed is the plan's",
    _m.MAV_CMD_DO_SET_HOME: "home is where the flight began",
    _m.MAV_CMD_SET_MESSAGE_INTERVAL: "what it tells has its own rate",
}
"""Commands that a ground station may well send, and why they are not obeyed."""


def _somewhere(params: tuple[float, ...]) -> bool:
    """Whether a command names a place; 0 and NaN are none."""
    return any(math.isfinite(p) and p != 0.0 for p in params[4:6])


def _left_out(command: int, params: tuple[float, ...]) -> str:
    """What of a command that is obeyed is not done, for people."""
    speed, heading = params[0], params[3]
    match command:
        case _m.MAV_CMD_NAV_LAND if _somewhere(params):
            return "it lands where it is"
        case _m.MAV_CMD_DO_REPOSITION if speed > 0.0:
            return "at the mission's speed, with the nose as it is"
        case _m.MAV_CMD_DO_REPOSITION if math.isfinite(heading) and heading != 0.0:
            return "the nose stays as it is"
    return ""


def _params(message: Any) -> tuple[float, ...]:
    m = message
    if m.get_type() == "COMMAND_LONG":
        return (m.param1, m.param2, m.param3, m.param4, m.param5, m.param6, m.param7)
    none = -(2**31)  # "not given" in the integer fields
    x, y = (math.nan if v in (none, 2**31 - 1) else v / 1e7 for v in (m.x, m.y))
    return (m.param1, m.param2, m.param3, m.param4, x, y, m.z)


def _same(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return all(x == y or (x != x and y != y) for x, y in zip(a, b, strict=True))


def _version() -> Any:
    capabilities = (
        _m.MAV_PROTOCOL_CAPABILITY_MISSION_INT
        | _m.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
        | _m.MAV_PROTOCOL_CAPABILITY_MAVLINK2
    )
    nothing = [0] * 8
    return _m.MAVLink_autopilot_version_message(capabilities, 0, 0, 0, 0, nothing, nothing, nothing, 0, 0, 0)
