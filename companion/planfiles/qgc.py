"""QGroundControl's `.plan`: JSON with a mission, a geofence and rally points.

https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html. Whatever this program does not know is
kept: the parsed document is written back with only the items, the speed and the fence put in their places.
"""

import copy
import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

from companion.errors import MissionError
from companion.geodesy import Geodetic
from companion.planfiles.document import Plan
from companion.planfiles.fence import Fence
from companion.planfiles.items import MOST_ITEMS, NAN, Item

UPLOADED = "uploaded"
"""Our own key: home and the fence as the items that a ground station uploaded."""
LARGEST = 3.4e38
"""Of a number: what MAVLink's 32 bits hold; JSON's have no end."""
MOST_DEPTH = 64
"""Of nested lists and objects."""


def read_plan(text: str, file: str) -> Plan:
    """The plan of a file's text.

    Raises
    ------
    MissionError : it is not one, or has an item that is not simple (a survey, say), by its name.
    """
    document = _parsed(text, file)
    mission = document.get("mission")
    if document.get("fileType") != "Plan":
        raise MissionError(file, [f"fileType: found {_shown(document.get('fileType'))}, expected 'Plan'"])
    if not isinstance(mission, dict):
        raise MissionError(file, [f"mission: found {_shown(mission)}, expected an object"])
    listed = mission.get("items")
    if not isinstance(listed, list) or len(listed) > MOST_ITEMS:
        raise MissionError(file, [f"mission.items: expected a list of at most {MOST_ITEMS}"])
    items: list[Item] = []
    problems: list[str] = []
    for index, entry in enumerate(listed):
        found = _item(entry)
        if isinstance(found, str):
            problems.append(f"mission.items.{index}: {found}")
        else:
            items.append(found)
    home = mission.get("plannedHomePosition")
    if not (isinstance(home, list) and len(home) == 3 and all(map(_is_number, home))):
        problems.append("mission.plannedHomePosition: expected [latitude, longitude, altitude]")
        home = [0.0, 0.0, 0.0]
    hover: Any = mission.get("hoverSpeed")
    if not (hover is None or (_is_number(hover) and 0.1 <= hover <= 100.0)):
        problems.append(f"mission.hoverSpeed: found {_shown(hover)}, expected 0.1 to 100 m/s")
    fence, wrong = _fence(document.get("geoFence"))
    problems += wrong
    if problems:
        raise MissionError(file, problems)
    speed = None if hover is None else float(hover)
    came = document.get(UPLOADED)
    ours = {"home": [], "fence": []} if not isinstance(came, dict) else came
    before, corners = _items(ours.get("home")), _items(ours.get("fence"))
    return Plan(
        items,
        Geodetic(*map(float, home)),
        first=len(before),
        fence=fence,
        speed=speed,
        document=document,
        home_item=before[0] if before else None,
        fence_items=corners,
    )


def write_plan(
    items: Sequence[Item],
    home: Geodetic,
    speed: float,
    fence: Fence | None,
    kept: dict[str, Any] | None,
    uploaded: Mapping[str, Sequence[Item]] | None = None,
) -> str:
    """A file's text.

    Parameters
    ----------
    fence : areas with `latitude` and `longitude`, as the key `fence` of a mission file; None: as `kept` has it.
    kept : the document of a plan that was read: everything in it but our items stays as it is.
    uploaded : items that a ground station has beside these: `home`, at most one, and `fence`.
    """
    document = copy.deepcopy(kept) if kept else _empty()
    mission = document["mission"]
    mission["items"] = [_entry(item, number) for number, item in enumerate(items, start=1)]
    if not kept:
        mission["hoverSpeed"] = speed
        mission["plannedHomePosition"] = list(home)
    if fence is not None:
        document["geoFence"] = _geofence(fence)
    if uploaded is not None:
        document[UPLOADED] = {key: [_entry(item, 0) for item in some] for key, some in uploaded.items()}
    return json.dumps(document, indent=4, ensure_ascii=False) + "\n"


def _parsed(text: str, file: str) -> dict[str, Any]:
    depth = deepest = 0
    for character in text:
        depth += (character in "[{") - (character in "]}")
        deepest = max(deepest, depth)
    if deepest > MOST_DEPTH:
        raise MissionError(file, [f"found {deepest} levels of nesting, expected at most {MOST_DEPTH}"])
    try:
        document = json.loads(text, object_pairs_hook=_once)
    except json.JSONDecodeError as error:
        raise MissionError(file, [f"line {error.lineno}: not JSON: {error.msg}"]) from error
    except ValueError as error:
        raise MissionError(file, [f"not JSON: {error}"]) from error
    if not isinstance(document, dict):
        raise MissionError(file, ["line 1: expected a JSON object with fileType and mission"])
    return document


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object; of two equal keys JSON would silently keep the last."""
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"{_shown(twice)}: found twice in one object, expected once")
    return found


def _items(listed: Any) -> list[Item]:
    """Items of our own key; what is none is left out."""
    found = map(_item, listed if isinstance(listed, list) else [])
    return [item for item in found if isinstance(item, Item)]


def _item(entry: Any) -> Item | str:
    """One of `mission.items`, or what is wrong with it."""
    if not isinstance(entry, dict):
        return "expected an object"
    if entry.get("type") != "SimpleItem":
        kind = _plain(entry.get("type"))
        which = f" {_shown(entry['complexItemType'])}" if "complexItemType" in entry else ""
        return f"found {kind}{which}, which is not flown: expected SimpleItem"
    command, frame, params = entry.get("command"), entry.get("frame"), entry.get("params")
    if type(command) is not int or type(frame) is not int or not 0 <= command <= 65_535 or not 0 <= frame <= 255:
        return f"found command {_shown(command)} and frame {_shown(frame)}, expected whole numbers"
    if not isinstance(params, list) or len(params) != 7:
        return "params: expected seven numbers or null"
    for number, p in enumerate(params, start=1):
        if not (p is None or _is_number(p)):
            return f"params: found {_shown(p)} as the {number}., expected seven numbers (3.4e38 at most) or null"
    p1, p2, p3, p4, x, y, z = (NAN if p is None else float(p) for p in params)
    return Item(command, frame, (p1, p2, p3, p4, x, y, z), extra=entry)


def _entry(item: Item, number: int) -> dict[str, Any]:
    """An item as the file has it; one that was read keeps its other keys, and its params where they are the same."""
    params: list[float | None] = [None if math.isnan(p) else p for p in item.params]
    known = item.extra if item.extra.get("type") == "SimpleItem" else {}
    if known and [None if p is None else float(p) for p in known["params"]] == params:
        params = known["params"]
    base: dict[str, Any] = known or {"autoContinue": item.follows, "doJumpId": number, "type": "SimpleItem"}
    return {**base, "command": item.command, "frame": item.frame, "params": params}


def _fence(found: Any) -> tuple[Fence | None, list[str]]:
    """The geofence as the key `fence` of a mission file, and what is wrong with it."""
    if not isinstance(found, dict):
        return None, []
    include: list[dict[str, Any]] = []
    exclude: list[dict[str, Any]] = []
    problems: list[str] = []
    for name in ("polygons", "circles"):
        if not isinstance(found.get(name, []), list | None):
            return None, [f"geoFence.{name}: expected a list"]
    for index, polygon in enumerate(found.get("polygons") or []):
        corners = polygon.get("polygon") if isinstance(polygon, dict) else None
        if not (isinstance(corners, list) and all(map(_is_pair, corners)) and 3 <= len(corners) <= 500):
            problems.append(f"geoFence.polygons.{index}: expected 3 to 500 corners [latitude, longitude]")
            continue
        area: dict[str, Any] = {"corners": [{"latitude": float(a), "longitude": float(b)} for a, b, *_ in corners]}
        (include if polygon.get("inclusion", True) else exclude).append(area)
    for index, entry in enumerate(found.get("circles") or []):
        circle = entry.get("circle") if isinstance(entry, dict) else None
        if not (isinstance(circle, dict) and _is_pair(circle.get("center")) and _is_number(circle.get("radius"))):
            problems.append(f"geoFence.circles.{index}: expected a center and a radius")
            continue
        a, b, *_ = circle["center"]
        area = {"circle": {"latitude": float(a), "longitude": float(b), "radius": float(circle["radius"])}}
        (include if entry.get("inclusion", True) else exclude).append(area)
    if not (include or exclude):
        return None, problems
    return {"include": include, "exclude": exclude}, problems


def _geofence(fence: Fence) -> dict[str, Any]:
    polygons, circles = [], []
    for inclusion, areas in ((True, fence.get("include", [])), (False, fence.get("exclude", []))):
        for area in areas:
            if "corners" in area:
                corners = [[c["latitude"], c["longitude"]] for c in area["corners"]]
                polygons.append({"inclusion": inclusion, "polygon": corners, "version": 1})
            else:
                c = area["circle"]
                centre = {"center": [c["latitude"], c["longitude"]], "radius": c["radius"]}
                circles.append({"circle": centre, "inclusion": inclusion, "version": 1})
    return {"circles": circles, "polygons": polygons, "version": 2}


def _empty() -> dict[str, Any]:
    """A plan with nothing in it; firmware and vehicle type 2 and 12 are a multirotor with PX4, altitudes from home."""
    return {
        "fileType": "Plan",
        "geoFence": {"circles": [], "polygons": [], "version": 2},
        "groundStation": "QGroundControl",
        "mission": {
            "cruiseSpeed": 15,
            "firmwareType": 12,
            "globalPlanAltitudeMode": 1,
            "hoverSpeed": 5,
            "items": [],
            "plannedHomePosition": [0.0, 0.0, 0.0],
            "vehicleType": 2,
            "version": 2,
        },
        "rallyPoints": {"points": [], "version": 2},
        "version": 1,
    }


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= LARGEST


def _shown(value: Any) -> str:
    """What was found, short and on one line."""
    if isinstance(value, dict | list):
        return "an object" if isinstance(value, dict) else f"a list of {len(value)}"
    if isinstance(value, int) and abs(value) > LARGEST:
        return "a number beyond all bounds"
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."


def _plain(value: Any) -> str:
    return value[:40] if isinstance(value, str) and value.isprintable() else _shown(value)


def _is_pair(value: Any) -> bool:
    return isinstance(value, list) and len(value) >= 2 and all(map(_is_number, value[:2]))
