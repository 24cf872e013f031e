"""A fence as ground stations send and keep it, told as the key `fence` of a mission file, and back.

Each corner of a polygon is an item, as is each circle (https://mavlink.io/en/services/mission.html#geofence). The
corners of a polygon follow one another, and each says how many there are. Of several areas to stay in all must hold:
that is what MAVLink says of one group of them, and the stricter reading of autopilots that ask for one of them only.
"""

import math
from collections.abc import Sequence
from typing import Any

from companion.geodesy import Geodetic, to_local
from companion.geofence import MOST_INCLUDED
from companion.planfiles.items import GLOBAL, Item, ItemFlaw
from planner import Prism
from planner.prism import MOST_CORNERS
from wire.dialect import mavlink

_m = mavlink
CORNERS = {
    _m.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION: True,
    _m.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION: False,
}
"""Corners: whether one stays inside."""
CIRCLES = {_m.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION: True, _m.MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION: False}
"""Circles likewise."""
MOST = MOST_CORNERS // 2
"""Corners of one polygon."""
LARGEST = 1e5
"""Radius [m]."""

Fence = dict[str, Any]
"""As the key `fence` of a mission file, places by latitude and longitude."""


def to_fence(items: Sequence[Item]) -> Fence | None:
    """The fence of its items; None where there are none.

    Raises
    ------
    ItemFlaw : an item that cannot be kept to.
    """
    fence: Fence = {"include": [], "exclude": []}
    index = 0
    groups: set[float] = set()
    while index < len(items):
        item = items[index]
        inside = CORNERS.get(item.command, CIRCLES.get(item.command))
        if inside is None:
            raise ItemFlaw(index, f"{item.name} is not kept to", unsupported=True)
        if inside and math.isfinite(item.params[1]):
            groups.add(item.params[1])
        if len(groups) > 1:
            raise ItemFlaw(index, f"{item.name}: found a second group, expected one of all areas to stay in", True)
        if item.command in CIRCLES:
            area: dict[str, Any] = {"circle": {**_place(index, item), "radius": _radius(index, item)}}
            count = 1
        else:
            count = _count(index, items)
            area = {"corners": _corners(index, items[index : index + count])}
        fence["include" if inside else "exclude"].append(area)
        if len(fence["include"]) > MOST_INCLUDED:
            raise ItemFlaw(index, f"{item.name}: expected at most {MOST_INCLUDED} areas to stay in")
        index += count
    return fence if items else None


def fence_items(fence: Fence | None) -> list[Item]:
    """The items of a fence."""
    items: list[Item] = []
    for inside, areas in ((True, (fence or {}).get("include", [])), (False, (fence or {}).get("exclude", []))):
        corner = next(command for command, within in CORNERS.items() if within is inside)
        circle = next(command for command, within in CIRCLES.items() if within is inside)
        for area in areas:
            if "corners" in area:
                count = float(len(area["corners"]))
                items += [_item(corner, count, c) for c in area["corners"]]
            else:
                items.append(_item(circle, area["circle"]["radius"], area["circle"]))
    return items


def _item(command: int, first: float, place: dict[str, float]) -> Item:
    return Item(command, _m.MAV_FRAME_GLOBAL, (first, 0.0, 0.0, 0.0, place["latitude"], place["longitude"], 0.0))


def _place(index: int, item: Item) -> dict[str, float]:
    x, y = item.params[4:6]
    if item.frame not in GLOBAL:
        raise ItemFlaw(index, f"{item.name}: found frame {item.frame}, expected a global one", unsupported=True)
    if not (abs(x) <= 89.0 and abs(y) <= 180.0):
        raise ItemFlaw(index, f"{item.name}: found latitude {x:g}, longitude {y:g}, expected degrees on the earth")
    return {"latitude": x, "longitude": y}


def _radius(index: int, item: Item) -> float:
    radius = item.params[0]
    if not 0.0 < radius <= LARGEST:
        raise ItemFlaw(index, f"{item.name}: found radius {radius:g} m, expected 0 to {LARGEST:g}")
    return radius


def _count(index: int, items: Sequence[Item]) -> int:
    """How many corners a polygon has, all of which are there."""
    item = items[index]
    count = item.params[0]
    if not (3.0 <= count <= MOST and count == int(count)):
        raise ItemFlaw(index, f"{item.name}: found {count:g} corners, expected 3 to {MOST}")
    for k in range(index, index + int(count)):
        if k >= len(items) or items[k].command != item.command or items[k].params[0] != count:
            raise ItemFlaw(min(k, len(items) - 1), f"{item.name}: found {k - index} corners, expected {count:g}")
    return int(count)


def _corners(index: int, items: Sequence[Item]) -> list[dict[str, float]]:
    places = [_place(index + k, item) for k, item in enumerate(items)]
    origin = Geodetic(places[0]["latitude"], places[0]["longitude"])
    outline = [to_local(origin, p["latitude"], p["longitude"]) for p in places]
    try:
        Prism(tuple(outline), (0.0, 1.0))
    except ValueError as error:
        raise ItemFlaw(index, f"{items[0].name}: {error}") from error
    return places
