"""Plans that clients load: the mission, the fence and the rally points, and what an item may be.

An item is kept as MAVLink has it, so that it reads back as it was written; places in degrees. `COMMANDS` is the table
of what this vehicle can do, `item_flaw` looks at one item as it arrives and `plan_flaw` at a whole plan: a plan that is
stored can be flown. The result codes are MAV_MISSION_RESULT's, told by the number of the parameter that is wrong.
"""

import math
import struct
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

from wire.dialect import mavlink

MAX_ITEMS = 1000
"""Most items of one plan."""
FARTHEST = 10_000.0
"""Highest altitude of an item, and largest radius [m]."""
LOWEST = -500.0
"""Lowest altitude of an item [m]: the shores of the Dead Sea are at -430."""

_m = mavlink
GLOBAL_FRAMES = (_m.MAV_FRAME_GLOBAL, _m.MAV_FRAME_GLOBAL_INT)
"""Altitude above mean sea level."""
RELATIVE_FRAMES = (_m.MAV_FRAME_GLOBAL_RELATIVE_ALT, _m.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT)
"""Altitude above home."""
VERTICES = (_m.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, _m.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION)
CIRCLES = (_m.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION, _m.MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION)


class Kind(Enum):
    """MAV_MISSION_TYPE."""

    MISSION = 0
    FENCE = 1
    RALLY = 2


@dataclass(frozen=True, slots=True)
class PlanItem:
    """One item.

    Attributes
    ----------
    command, frame : MAV_CMD, MAV_FRAME.
    params : the seven parameters. In a global frame 5 and 6 are latitude and longitude [deg], 7 the altitude [m].
    autocontinue : whether the next one follows by itself.
    """

    command: int
    frame: int
    params: tuple[float, float, float, float, float, float, float]
    autocontinue: bool = True

    @property
    def has_place(self) -> bool:
        """Whether it names a point on the globe; clients leave 0, 0 or NaN where they name none."""
        latitude, longitude = self.params[4:6]
        return not (math.isnan(latitude) or math.isnan(longitude) or latitude == longitude == 0.0)


@dataclass(frozen=True, slots=True)
class Flaw:
    """What is wrong with an item or a plan: MAV_MISSION_RESULT, and why in words."""

    result: int
    reason: str


@dataclass(frozen=True, slots=True)
class CommandKind:
    """One row of `COMMANDS`.

    Attributes
    ----------
    title : for people.
    place : whether parameters 5, 6 and 7 are a place.
    limits : lowest and highest value by parameter number; NaN stands for not given.
    needed : parameters that have to be given; of the others NaN is always allowed.
    whole : parameters that count something.
    lacking : what this vehicle would need for it; None: it does it. Such items are kept, told of and passed over, as
        PX4 and ArduPilot do without the device.
    """

    title: str
    place: bool
    limits: Mapping[int, tuple[float, float]] = field(default_factory=dict)
    lacking: str | None = None
    needed: tuple[int, ...] = ()
    whole: tuple[int, ...] = ()


_SECONDS = (0.0, 86_400.0)
_RADIUS = (0.0, FARTHEST)
MAX_TURNS = 1000.0
_LACKING: Mapping[str, tuple[int, ...]] = {
    "camera": (
        _m.MAV_CMD_DO_DIGICAM_CONFIGURE,
        _m.MAV_CMD_DO_DIGICAM_CONTROL,
        _m.MAV_CMD_DO_SET_CAM_TRIGG_DIST,
        _m.MAV_CMD_DO_SET_CAM_TRIGG_INTERVAL,
        _m.MAV_CMD_SET_CAMERA_MODE,
        _m.MAV_CMD_SET_CAMERA_ZOOM,
        _m.MAV_CMD_SET_CAMERA_FOCUS,
        _m.MAV_CMD_IMAGE_START_CAPTURE,
        _m.MAV_CMD_IMAGE_STOP_CAPTURE,
        _m.MAV_CMD_DO_TRIGGER_CONTROL,
        _m.MAV_CMD_VIDEO_START_CAPTURE,
        _m.MAV_CMD_VIDEO_STOP_CAPTURE,
    ),
    "gimbal": (
        _m.MAV_CMD_DO_MOUNT_CONFIGURE,
        _m.MAV_CMD_DO_MOUNT_CONTROL,
        _m.MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW,
        _m.MAV_CMD_DO_GIMBAL_MANAGER_CONFIGURE,
    ),
    "servo": (_m.MAV_CMD_DO_SET_SERVO, _m.MAV_CMD_DO_REPEAT_SERVO, _m.MAV_CMD_DO_SET_ACTUATOR),
    "relay": (_m.MAV_CMD_DO_SET_RELAY, _m.MAV_CMD_DO_REPEAT_RELAY),
    "gripper": (_m.MAV_CMD_DO_GRIPPER,),
}
COMMANDS: Mapping[Kind, Mapping[int, CommandKind]] = {
    Kind.MISSION: {
        _m.MAV_CMD_NAV_WAYPOINT: CommandKind("waypoint", True, {1: _SECONDS, 2: _RADIUS}),
        _m.MAV_CMD_NAV_LOITER_UNLIM: CommandKind("loiter", True),
        _m.MAV_CMD_NAV_LOITER_TIME: CommandKind("loiter for a time", True, {1: _SECONDS}),
        _m.MAV_CMD_NAV_LOITER_TURNS: CommandKind("turns", True, {1: (0.0, MAX_TURNS), 3: (-FARTHEST, FARTHEST)}),
        _m.MAV_CMD_CONDITION_GATE: CommandKind("gate", True),
        _m.MAV_CMD_NAV_RETURN_TO_LAUNCH: CommandKind("return", False),
        _m.MAV_CMD_NAV_LAND: CommandKind("landing", True),
        _m.MAV_CMD_NAV_TAKEOFF: CommandKind("takeoff", True),
        _m.MAV_CMD_NAV_DELAY: CommandKind("delay", False, {1: (-1.0, 86_400.0)}),
        _m.MAV_CMD_CONDITION_DELAY: CommandKind("delay", False, {1: _SECONDS}),
        _m.MAV_CMD_CONDITION_YAW: CommandKind("turn", False, {1: (-360.0, 360.0), 4: (0.0, 1.0)}),
        _m.MAV_CMD_DO_JUMP: CommandKind(
            "jump", False, {1: (0.0, MAX_ITEMS), 2: (-1.0, 65_535.0)}, needed=(1, 2), whole=(1, 2)
        ),
        _m.MAV_CMD_DO_CHANGE_SPEED: CommandKind("speed", False, {1: (0.0, 3.0), 2: (-2.0, 30.0)}),
        _m.MAV_CMD_DO_SET_ROI: CommandKind("place to look at", False, {1: (0.0, 4.0)}),
        _m.MAV_CMD_DO_SET_ROI_LOCATION: CommandKind("place to look at", True),
        _m.MAV_CMD_DO_SET_ROI_NONE: CommandKind("nothing to look at", False),
        _m.MAV_CMD_DO_LAND_START: CommandKind("start of the landing", False),
        **{number: CommandKind(what, False, {}, what) for what, numbers in _LACKING.items() for number in numbers},
    },
    Kind.FENCE: {
        _m.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION: CommandKind("inclusion vertex", True, {1: (3.0, MAX_ITEMS)}),
        _m.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION: CommandKind("exclusion vertex", True, {1: (3.0, MAX_ITEMS)}),
        _m.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION: CommandKind("inclusion circle", True, {1: (0.1, FARTHEST)}, needed=(1,)),
        _m.MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION: CommandKind("exclusion circle", True, {1: (0.1, FARTHEST)}, needed=(1,)),
    },
    Kind.RALLY: {_m.MAV_CMD_NAV_RALLY_POINT: CommandKind("rally point", True)},
}


def item_flaw(kind: Kind, item: PlanItem) -> Flaw | None:
    """What is wrong with one item by itself; None when nothing is."""
    row = COMMANDS[kind].get(item.command)
    if row is None:
        return Flaw(_m.MAV_MISSION_UNSUPPORTED, f"command {item.command} is not known here")
    if row.place and item.frame not in GLOBAL_FRAMES + RELATIVE_FRAMES:
        return Flaw(_m.MAV_MISSION_UNSUPPORTED_FRAME, f"{row.title} in frame {item.frame}, expected 0, 3, 5 or 6")
    for number, value in enumerate(item.params, start=1):
        if math.isinf(value):
            return Flaw(_param(number), f"{row.title}: param{number} is {value:g}, expected a finite number")
        if number in row.needed and math.isnan(value):
            return Flaw(_param(number), f"{row.title}: param{number} is not given")
        if number in row.whole and value != math.floor(value):
            return Flaw(_param(number), f"{row.title}: param{number} is {value:g}, expected a whole number")
    for number, (low, high) in row.limits.items():
        value = item.params[number - 1]
        if not (math.isnan(value) or low <= value <= high):
            return Flaw(_param(number), f"{row.title}: param{number} is {value:g}, expected {low:g}..{high:g}")
    for number, low, high in _PLACE if row.place else ():
        value = item.params[number - 1]
        if not (math.isnan(value) or low <= value <= high):
            return Flaw(_param(number), f"{row.title}: param{number} is {value:g}, expected {low:g}..{high:g}")
    if kind is not Kind.MISSION and not item.has_place:
        return Flaw(_param(5), f"{row.title} without a place")
    if item.command in _NEED_A_PLACE and not item.has_place:
        return Flaw(_param(5), f"{row.title} without a place")
    if item.command == _m.MAV_CMD_DO_SET_ROI:
        return _roi_flaw(item)
    return None


_PLACE = ((5, -90.0, 90.0), (6, -180.0, 180.0), (7, LOWEST, FARTHEST))
"""Latitude, longitude and altitude of whatever is a place: parameter, lowest, highest."""
_NEED_A_PLACE = (_m.MAV_CMD_NAV_WAYPOINT, _m.MAV_CMD_CONDITION_GATE, _m.MAV_CMD_DO_SET_ROI_LOCATION)


def _roi_flaw(item: PlanItem) -> Flaw | None:
    """MAV_CMD_DO_SET_ROI is a place only if its mode says so."""
    if item.params[0] not in (_m.MAV_ROI_NONE, _m.MAV_ROI_LOCATION):
        return Flaw(_param(1), f"look at: mode {item.params[0]:g}, expected 0 (nothing) or 3 (a place)")
    if item.params[0] == _m.MAV_ROI_LOCATION:
        return item_flaw(Kind.MISSION, replace(item, command=_m.MAV_CMD_DO_SET_ROI_LOCATION))
    return None


def plan_flaw(kind: Kind, items: Sequence[PlanItem], first: int = 0) -> Flaw | None:
    """What is wrong with a whole plan whose items are each right; None when nothing is.

    `first` is the number that people give to the first item.
    """
    if kind is Kind.FENCE:
        return _polygons_flaw(items)
    for item in items:
        if item.command == _m.MAV_CMD_DO_JUMP and not 0 <= item.params[0] < len(items):
            last = first + len(items) - 1
            return Flaw(_param(1), f"jump to item {item.params[0] + first:g}, expected {first}..{last}")
    ring = _endless(items)
    if ring is not None:
        return Flaw(_param(1), f"the jump at item {ring + first} leads back to itself and to no place on the way")
    return None


def _endless(items: Sequence[PlanItem]) -> int | None:
    """A jump that lies on a ring of items none of which takes time; None without one.

    Items that wait for no other are taken away until none is left (Kahn, 1962); what stays hangs behind a ring.
    """
    leads: dict[int, tuple[int, ...]] = {}
    for i, item in enumerate(items):
        if item.command < _m.MAV_CMD_NAV_LAST or item.command == _m.MAV_CMD_CONDITION_DELAY:
            continue  # to go somewhere, or to wait
        jumps = item.command == _m.MAV_CMD_DO_JUMP and item.params[1] != 0.0
        leads[i] = (i + 1, int(item.params[0])) if jumps else (i + 1,)
    waiting = dict.fromkeys(leads, 0)
    for targets in leads.values():
        for target in targets:
            if target in waiting:
                waiting[target] += 1
    free = [i for i, count in waiting.items() if count == 0]
    while free:
        i = free.pop()
        del waiting[i]
        for target in leads[i]:
            if target in waiting:
                waiting[target] -= 1
                if waiting[target] == 0:
                    free.append(target)
    return next((i for i in waiting if items[i].command == _m.MAV_CMD_DO_JUMP), None)


def renumbered(items: Sequence[PlanItem], by: int) -> tuple[PlanItem, ...]:
    """The same items with every jump's target `by` further on: for who counts from another item."""
    return tuple(
        replace(item, params=(item.params[0] + by, *item.params[1:])) if item.command == _m.MAV_CMD_DO_JUMP else item
        for item in items
    )


def _polygons_flaw(items: Sequence[PlanItem]) -> Flaw | None:
    """Vertices come in runs as long as the first one says, all of one sort."""
    i = 0
    while i < len(items):
        if items[i].command not in VERTICES:
            i += 1
            continue
        first, count = items[i], items[i].params[0]
        run = items[i : i + int(count)] if math.isfinite(count) else []
        if len(run) != count or any(v.command != first.command or v.params[0] != count for v in run):
            return Flaw(_param(1), f"polygon at item {i}: not {count:g} vertices of one sort")
        i += len(run)
    return None


def _param(number: int) -> int:
    """MAV_MISSION_INVALID_PARAM1..7."""
    return int(_m.MAV_MISSION_INVALID_PARAM1) + number - 1


class PlanStore:
    """The plans that are loaded. Every plan that is loaded is a new tuple, by which whoever caches values knows it.

    Attributes
    ----------
    mission : what MISSION mode flies.
    fence : where the vehicle may fly.
    rally : where a return may end, other than home.
    version : counts changes of any plan.
    """

    def __init__(self) -> None:
        self.mission: tuple[PlanItem, ...] = ()
        self.fence: tuple[PlanItem, ...] = ()
        self.rally: tuple[PlanItem, ...] = ()
        self.version = 0

    def __getitem__(self, kind: Kind) -> tuple[PlanItem, ...]:
        plan: tuple[PlanItem, ...] = getattr(self, kind.name.lower())
        return plan

    def replace(self, kind: Kind, items: Sequence[PlanItem]) -> None:
        """Load a plan.

        Raises
        ------
        ValueError : an item or the plan is flawed; whoever takes plans from peers asks `item_flaw` and `plan_flaw`.
        """
        flaws = [flaw for item in items if (flaw := item_flaw(kind, item))]
        flaw = flaws[0] if flaws else plan_flaw(kind, items)
        if flaw is not None or len(items) > MAX_ITEMS:
            raise ValueError(flaw.reason if flaw else f"{len(items)} items: expected at most {MAX_ITEMS}")
        setattr(self, kind.name.lower(), tuple(items))
        self.version += 1

    def opaque_id(self, kind: Kind) -> int:
        """A number that changes with the plan's content and outlives a restart: its CRC-32; 0 when there is none."""
        packed = b"".join(_ITEM.pack(i.command, i.frame, i.autocontinue, *i.params) for i in self[kind])
        return zlib.crc32(packed) if packed else 0


_ITEM = struct.Struct("<HBB4f2df")
