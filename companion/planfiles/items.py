"""Plan items, as ground stations keep and send them, and our steps: the two told in each other's words.

An item is a MAV_CMD with a frame and seven numbers; x and y are latitude and longitude [deg] in a global frame, north
and east [m] in a local one, z is an altitude above home, above the sea, or down, as the frame says.

What is not flown is refused by the item's number and the command's name, never passed over.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from companion.geodesy import Geodetic, to_geodetic
from companion.legs import circle_of
from companion.steps import MOST_VIA, Step
from planner import Limits
from wire.dialect import mavlink

MOST_ITEMS = 1000
"""Of one plan."""
NAN = float("nan")

_m = mavlink
GLOBAL = {
    _m.MAV_FRAME_GLOBAL: False,
    _m.MAV_FRAME_GLOBAL_INT: False,
    _m.MAV_FRAME_GLOBAL_RELATIVE_ALT: True,
    _m.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT: True,
}
"""Frames with latitude and longitude: whether the altitude counts from home."""


@dataclass(frozen=True, slots=True)
class Item:
    """One item.

    Attributes
    ----------
    command : MAV_CMD.
    frame : MAV_FRAME.
    params : p1 to p7; NaN where nothing is said.
    extra : what a file has beside that; kept as it is.
    """

    command: int
    frame: int
    params: tuple[float, float, float, float, float, float, float]
    extra: dict[str, Any] = field(default_factory=dict, compare=False)

    @property
    def name(self) -> str:
        """MAV_CMD's name and number."""
        entry = _m.enums["MAV_CMD"].get(self.command)
        return f"{entry.name} ({self.command})" if entry is not None else f"MAV_CMD {self.command}"


class ItemFlaw(ValueError):
    """An item that is not flown: `index` and why, `what` one clause."""

    def __init__(self, index: int, what: str, unsupported: bool = False) -> None:
        self.index, self.what, self.unsupported = index, what, unsupported
        super().__init__(f"item {index}: {what}")


@dataclass(slots=True)
class _Reading:
    """Where the reading of a plan is; places are as a mission file writes them."""

    home_altitude: float  # above the sea [m]
    steps: list[dict[str, Any]] = field(default_factory=list)
    via: list[dict[str, float]] = field(default_factory=list)
    here: dict[str, float] = field(default_factory=dict)
    speed: float | None = None

    def add(self, kind: str, values: Any) -> None:
        step: dict[str, Any] = {kind: values}
        if self.speed is not None and kind in ("goto", "orbit", "return"):
            step["speed"] = self.speed
        self.steps.append(step)

    def goto(self, place: dict[str, float]) -> None:
        if self.via:
            self.steps.append({"via": self.via})
            self.via = []
        self.add("goto", place)
        self.here = place

    def climbed(self, altitude: float) -> None:
        """Begin with a climb where the plan does not."""
        if not self.steps:
            self.steps.append({"takeoff": {"altitude": altitude}})


def to_steps(items: Sequence[Item], home_altitude: float) -> list[dict[str, Any]]:
    """The steps of a plan, as a mission file writes them; home is the mission's origin.

    Parameters
    ----------
    items : without the home that some formats begin with.
    home_altitude : of home, above the sea [m].

    Raises
    ------
    ItemFlaw : an item that is not flown.
    """
    if len(items) > MOST_ITEMS:
        raise ItemFlaw(MOST_ITEMS, f"found {len(items)} items, expected at most {MOST_ITEMS}")
    reading = _Reading(home_altitude)
    for index, item in enumerate(items):
        read = READERS.get(item.command)
        if read is None:
            raise ItemFlaw(index, f"{item.name} is not flown", unsupported=True)
        last = reading.steps[-1] if reading.steps else {}
        if "land" in last or ("return" in last and item.command != _m.MAV_CMD_NAV_LAND):
            raise ItemFlaw(index, f"{item.name} comes after the landing")
        read(reading, index, item)
    if reading.via:
        reading.goto(reading.via.pop())  # a spline's last point is where it ends
    steps = reading.steps
    if len(steps) < 2 and not (steps and "takeoff" in steps[0]):
        raise ItemFlaw(0, "found no place to go to, expected at least one")
    if "land" not in steps[-1] and "return" not in steps[-1]:
        steps.append({"land": {}})
    return steps


def _place(reading: _Reading, index: int, item: Item) -> dict[str, float]:
    """Where an item is."""
    *_, x, y, z = item.params
    if not all(map(math.isfinite, (x, y, z))):
        raise ItemFlaw(index, f"{item.name}: found no place, expected latitude, longitude and altitude")
    if item.frame == _m.MAV_FRAME_LOCAL_NED:
        return {"north": x, "east": y, "altitude": -z}
    relative = GLOBAL.get(item.frame)
    if relative is None:
        entry = _m.enums["MAV_FRAME"].get(item.frame)
        name = f"{entry.name} ({item.frame})" if entry is not None else str(item.frame)
        raise ItemFlaw(index, f"{item.name}: found frame {name}, expected one without terrain or body", True)
    if not (abs(x) <= 89.0 and abs(y) <= 180.0):
        raise ItemFlaw(index, f"{item.name}: found latitude {x:g}, longitude {y:g}, expected degrees on the earth")
    return {"latitude": x, "longitude": y, "altitude": z if relative else z - reading.home_altitude}


def _nothing_else(index: int, item: Item, **fields: float) -> None:
    """Refuse what an item asks for beside what is flown."""
    for name, value in fields.items():
        if math.isfinite(value) and value != 0.0:
            raise ItemFlaw(index, f"{item.name}: found {name.replace('_', ' ')} {value:g}, expected none", True)


def _heading(reading: _Reading, yaw: float) -> None:
    """Zero is what formats without NaN write for no heading."""
    if math.isfinite(yaw) and yaw != 0.0:
        reading.add("yaw", {"heading_deg": math.remainder(yaw, 360.0)})


def _hold(reading: _Reading, index: int, item: Item, seconds: float) -> None:
    if math.isfinite(seconds) and seconds != 0.0:
        if not 0.0 < seconds <= 86_400.0:
            raise ItemFlaw(index, f"{item.name}: found {seconds:g} s, expected 0 to 86400")
        reading.add("hold", {"seconds": seconds})


def _waypoint(reading: _Reading, index: int, item: Item) -> None:
    place = _place(reading, index, item)
    _nothing_else(index, item, pass_radius=item.params[2])
    reading.climbed(place["altitude"])
    _heading(reading, item.params[3])
    reading.goto(place)
    _hold(reading, index, item, item.params[0])


def _spline(reading: _Reading, index: int, item: Item) -> None:
    place = _place(reading, index, item)
    reading.climbed(place["altitude"])
    if item.params[0] > 0.0 or len(reading.via) >= MOST_VIA:
        reading.goto(place)
        _hold(reading, index, item, item.params[0])
    else:
        reading.via.append(place)


def _loiter_forever(reading: _Reading, index: int, item: Item) -> None:
    place = _place(reading, index, item)
    reading.climbed(place["altitude"])
    reading.goto(place)
    reading.add("wait", {"for": "order"})


def _loiter_time(reading: _Reading, index: int, item: Item) -> None:
    place = _place(reading, index, item)
    reading.climbed(place["altitude"])
    reading.goto(place)
    _hold(reading, index, item, item.params[0])


def _loiter_turns(reading: _Reading, index: int, item: Item) -> None:
    turns, _, radius = item.params[:3]
    place = _place(reading, index, item)
    if not (math.isfinite(radius) and abs(radius) >= 0.1 and 0.0 < turns <= 1000.0):
        raise ItemFlaw(index, f"{item.name}: found {turns:g} turns of radius {radius:g} m, expected both")
    reading.climbed(place["altitude"])
    if reading.via:
        reading.goto(reading.via.pop())
    reading.add("orbit", {**place, "radius": abs(radius), "turns": turns, "clockwise": radius > 0.0})
    reading.here = place


def _return(reading: _Reading, index: int, item: Item) -> None:
    if not reading.steps:
        raise ItemFlaw(index, f"{item.name} comes first, expected a place to go to before")
    if reading.via:
        reading.goto(reading.via.pop())
    reading.add("return", {})


def _land(reading: _Reading, index: int, item: Item) -> None:
    if not reading.steps:
        raise ItemFlaw(index, f"{item.name} comes first, expected a place to go to before")
    if reading.via:
        reading.goto(reading.via.pop())
    *_, x, y, _ = item.params
    if math.isfinite(x) and math.isfinite(y) and (x, y) != (0.0, 0.0) and "return" not in reading.steps[-1]:
        there = _place(reading, index, replace(item, params=(*item.params[:6], 0.0)))
        there["altitude"] = reading.here.get("altitude", reading.steps[0]["takeoff"]["altitude"])
        if {**there, "altitude": 0.0} != {**reading.here, "altitude": 0.0}:
            reading.goto(there)
    reading.add("land", {})


def _takeoff(reading: _Reading, index: int, item: Item) -> None:
    z = item.params[6]
    if reading.steps:
        raise ItemFlaw(index, f"{item.name} comes in the air")
    high = z - reading.home_altitude if GLOBAL.get(item.frame) is False else z
    high = -high if item.frame == _m.MAV_FRAME_LOCAL_NED else high
    if not (math.isfinite(high) and high > 0.0):
        raise ItemFlaw(index, f"{item.name}: found altitude {high:g} m above home, expected more than 0")
    reading.climbed(high)


def _delay(reading: _Reading, index: int, item: Item) -> None:
    if not (math.isfinite(item.params[0]) and item.params[0] >= 0.0):
        raise ItemFlaw(index, f"{item.name}: found a time of day, expected seconds", True)
    _hold(reading, index, item, item.params[0])


def _yaw(reading: _Reading, index: int, item: Item) -> None:
    angle, rate, _, relative = item.params[:4]
    _nothing_else(index, item, relative_angle=relative)
    if not math.isfinite(angle):
        raise ItemFlaw(index, f"{item.name}: found no angle, expected degrees")
    turn = {"heading_deg": math.remainder(angle, 360.0)}
    if math.isfinite(rate) and rate != 0.0:
        turn["rate_deg"] = min(max(rate, 1.0), 360.0)
    reading.add("yaw", turn)


def _speed(reading: _Reading, index: int, item: Item) -> None:
    kind, speed = item.params[:2]
    if kind not in (0.0, 1.0):
        raise ItemFlaw(index, f"{item.name}: found speed type {kind:g}, expected 0 or 1, air or ground", True)
    if speed == -2.0:  # back to what is usual
        reading.speed = None
    elif speed != -1.0:
        if not 0.01 <= speed <= 100.0:
            raise ItemFlaw(index, f"{item.name}: found {speed:g} m/s, expected 0.01 to 100")
        reading.speed = speed


READERS: dict[int, Callable[[_Reading, int, Item], None]] = {
    _m.MAV_CMD_NAV_WAYPOINT: _waypoint,
    _m.MAV_CMD_NAV_LOITER_UNLIM: _loiter_forever,
    _m.MAV_CMD_NAV_LOITER_TURNS: _loiter_turns,
    _m.MAV_CMD_NAV_LOITER_TIME: _loiter_time,
    _m.MAV_CMD_NAV_RETURN_TO_LAUNCH: _return,
    _m.MAV_CMD_NAV_LAND: _land,
    _m.MAV_CMD_NAV_TAKEOFF: _takeoff,
    _m.MAV_CMD_NAV_SPLINE_WAYPOINT: _spline,
    _m.MAV_CMD_NAV_DELAY: _delay,
    _m.MAV_CMD_CONDITION_YAW: _yaw,
    _m.MAV_CMD_DO_CHANGE_SPEED: _speed,
}
"""What each command that is flown becomes."""


def from_steps(steps: Sequence[Step], origin: Geodetic, start: tuple[float, float]) -> tuple[list[Item], list[str]]:
    """A mission's steps as items, and what no item says, in words.

    Parameters
    ----------
    origin : of the mission frame, which becomes home.
    start : where the vehicle stands (north, east) [m].

    Raises
    ------
    ItemFlaw : a step that no item can say; `index` is the step's.
    """
    items: list[Item] = []
    unsaid: list[str] = []
    speed: float | None = None
    north, east, altitude = (*start, 0.0)

    def add(command: int, *first: float) -> None:
        latitude, longitude = to_geodetic(origin, north, east)
        p1, p2, p3, p4 = (*first, *(0.0, 0.0, 0.0, NAN)[len(first) :])
        frame = _m.MAV_FRAME_GLOBAL_RELATIVE_ALT
        items.append(Item(command, frame, (p1, p2, p3, p4, latitude, longitude, altitude)))

    def do(command: int, *first: float) -> None:
        p1, p2, p3, p4 = (*first, *(0.0,) * (4 - len(first)))
        items.append(Item(command, _m.MAV_FRAME_MISSION, (p1, p2, p3, p4, 0.0, 0.0, 0.0)))

    for index, step in enumerate(steps):
        if step.kind in ("goto", "orbit", "return") and step.speed != speed:
            do(_m.MAV_CMD_DO_CHANGE_SPEED, 1.0, -2.0 if step.speed is None else step.speed, -1.0)
            speed = step.speed
        if step.clearance is not None:
            unsaid.append(f"steps.{index}.clearance")
        if step.takeoff is not None:
            altitude = step.takeoff.altitude
            add(_m.MAV_CMD_NAV_TAKEOFF)
        elif step.goto is not None:
            north, east, altitude = step.goto.north, step.goto.east, step.goto.altitude
            add(_m.MAV_CMD_NAV_WAYPOINT)
        elif step.via is not None:
            for place in step.via:
                north, east, altitude = place.north, place.east, place.altitude
                add(_m.MAV_CMD_NAV_SPLINE_WAYPOINT)
        elif step.orbit is not None:
            o = step.orbit
            circle = circle_of(o, np.array([north, east, -altitude]), Limits(1.0, 1.0, 1.0))
            north, east, altitude = o.north, o.east, o.altitude
            add(_m.MAV_CMD_NAV_LOITER_TURNS, o.turns, 0.0, o.radius if o.clockwise else -o.radius)
            north, east, _ = circle.state(math.inf).position.tolist()
        elif step.hold is not None:
            do(_m.MAV_CMD_NAV_DELAY, step.hold.seconds, -1.0, -1.0, -1.0)
        elif step.yaw is not None:
            do(_m.MAV_CMD_CONDITION_YAW, step.yaw.heading_deg % 360.0, step.yaw.rate_deg)
        elif step.return_home is not None:
            do(_m.MAV_CMD_NAV_RETURN_TO_LAUNCH)
            if step.return_home.altitude is not None:
                unsaid.append(f"steps.{index}.return.altitude")
        elif step.land is not None:
            if items[-1].command != _m.MAV_CMD_NAV_RETURN_TO_LAUNCH:
                do(_m.MAV_CMD_NAV_LAND)
        elif step.wait is not None and step.wait.for_ == "order" and step.wait.at_most is None:
            if items[-1].command == _m.MAV_CMD_NAV_WAYPOINT:
                items[-1] = replace(items[-1], command=_m.MAV_CMD_NAV_LOITER_UNLIM)
            else:
                add(_m.MAV_CMD_NAV_LOITER_UNLIM)
        else:
            raise ItemFlaw(index, f"found the step {step.kind}, which no plan item says", unsupported=True)
    return items, unsaid
