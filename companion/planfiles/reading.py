"""Plan items, told as our steps.

What is not flown is refused by the item's number and the command's name, never passed over.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

from companion.planfiles.items import GLOBAL, MOST_ITEMS, Item, ItemFlaw
from companion.steps import MOST_VIA
from wire.dialect import mavlink

_m = mavlink
_OPEN = -1
"""Ends of items whose way is not flown yet."""


@dataclass(slots=True)
class _Reading:
    """Where the reading of a plan is; places are as a mission file writes them."""

    home_altitude: float  # above the sea [m]
    steps: list[dict[str, Any]] = field(default_factory=list)
    via: list[dict[str, float]] = field(default_factory=list)
    here: dict[str, float] = field(default_factory=dict)
    speed: float | None = None
    begins: list[int] = field(default_factory=list)  # by item, as `GroundPlan` has them
    ends: list[int] = field(default_factory=list)

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
        self.ends = [len(self.steps) if end == _OPEN else end for end in self.ends]

    def climbed(self, altitude: float) -> None:
        """Begin with a climb where the plan does not."""
        if not self.steps:
            self.steps.append({"takeoff": {"altitude": altitude}})


class Told(NamedTuple):
    """A plan's steps, and by item the step it begins with and the one at which it is over."""

    steps: list[dict[str, Any]]
    begins: tuple[int, ...]
    ends: tuple[int, ...]


def to_steps(items: Sequence[Item], home_altitude: float) -> list[dict[str, Any]]:
    """The steps of a plan; see `told`."""
    return told(items, home_altitude).steps


def told(items: Sequence[Item], home_altitude: float) -> Told:
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
        if any(math.isinf(p) for p in item.params):
            raise ItemFlaw(index, f"{item.name}: found an infinite number, expected none")
        reading.begins.append(len(reading.steps))
        read(reading, index, item)
        reading.ends.append(_OPEN if reading.via else len(reading.steps))
    if reading.via:
        reading.goto(reading.via.pop())  # a spline's last point is where it ends
    steps = reading.steps
    if steps and "return" in steps[-1]:
        reading.ends[-1] += 1  # it lands, too
    if len(steps) < 2 and not (steps and "takeoff" in steps[0]):
        raise ItemFlaw(0, "found no place to go to, expected at least one")
    if "land" not in steps[-1] and "return" not in steps[-1]:
        steps.append({"land": {}})
    return Told(steps, tuple(reading.begins), tuple(itertools.accumulate(reading.ends, max)))


def _place(reading: _Reading, index: int, item: Item, level: bool = True) -> dict[str, float]:
    """Where an item is; one in a global frame at latitude and longitude 0 is where the one before is (ArduPilot).

    `level`: its altitude counts. 0 is refused: to some autopilots it is the ground, to others the altitude before.
    """
    *_, x, y, z = item.params
    if item.frame in GLOBAL and x == y == 0.0:
        altitude = reading.steps[0]["takeoff"]["altitude"] if reading.steps else 0.0
        here = (reading.via[-1:] or [reading.here or {"north": 0.0, "east": 0.0, "altitude": altitude}])[0]
        if z == 0.0 and reading.steps:
            return dict(here)
        return {**here, "altitude": _altitude(reading, index, item, level)}
    if not all(map(math.isfinite, (x, y, z))):
        raise ItemFlaw(index, f"{item.name}: found no place, expected latitude, longitude and altitude")
    if item.frame == _m.MAV_FRAME_LOCAL_NED:
        return {"north": x, "east": y, "altitude": _altitude(reading, index, item, level)}
    if item.frame not in GLOBAL:
        raise ItemFlaw(index, f"{item.name}: found frame {_frame(item)}, expected one without terrain or body", True)
    if not (abs(x) <= 89.0 and abs(y) <= 180.0):
        raise ItemFlaw(index, f"{item.name}: found latitude {x:g}, longitude {y:g}, expected degrees on the earth")
    return {"latitude": x, "longitude": y, "altitude": _altitude(reading, index, item, level)}


def _altitude(reading: _Reading, index: int, item: Item, level: bool = True) -> float:
    """Above home [m]."""
    z = item.params[6]
    if item.frame == _m.MAV_FRAME_LOCAL_NED:
        above = -z
    else:
        above = z - reading.home_altitude if GLOBAL.get(item.frame) is False else z
    if level and above == 0.0:
        raise ItemFlaw(index, f"{item.name}: found altitude 0 m above home, expected where to fly above it or below")
    return above


def _frame(item: Item) -> str:
    entry = _m.enums["MAV_FRAME"].get(item.frame)
    return f"{entry.name} ({item.frame})" if entry is not None else str(item.frame)


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
    if item.params[1] == _m.PRECISION_LAND_MODE_REQUIRED:
        raise ItemFlaw(index, f"{item.name}: found a precision landing, expected none", True)
    if math.isfinite(x) and math.isfinite(y) and (x, y) != (0.0, 0.0) and "return" not in reading.steps[-1]:
        there = _place(reading, index, replace(item, params=(*item.params[:6], 0.0)), level=False)
        there["altitude"] = reading.here.get("altitude", reading.steps[0]["takeoff"]["altitude"])
        if {**there, "altitude": 0.0} != {**reading.here, "altitude": 0.0}:
            reading.goto(there)
    reading.add("land", {})


def _takeoff(reading: _Reading, index: int, item: Item) -> None:
    if reading.steps:
        raise ItemFlaw(index, f"{item.name} comes in the air")
    over_ground = (_m.MAV_FRAME_GLOBAL_TERRAIN_ALT, _m.MAV_FRAME_GLOBAL_TERRAIN_ALT_INT)  # home is on it
    if item.frame not in (*GLOBAL, *over_ground, _m.MAV_FRAME_LOCAL_NED):
        raise ItemFlaw(index, f"{item.name}: found frame {_frame(item)}, expected one that says how high", True)
    high = _altitude(reading, index, item, level=False)
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
