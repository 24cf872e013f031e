"""A plan as any of the file formats gives it, and the mission it makes."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from companion.errors import MissionError
from companion.geodesy import Geodetic, to_local
from companion.mission import Mission
from companion.planfiles.fence import Fence, fence_items
from companion.planfiles.items import GroundPlan, Item, ItemFlaw
from companion.planfiles.reading import to_steps, told
from companion.shapes import ORIGIN

AROUND = 50.0
"""The world of a plan reaches so far beyond its places [m]; a plan says nothing of obstacles."""
ABOVE = 20.0
"""... and so far above the highest [m]."""


@dataclass(slots=True)
class Plan:
    """Items, the home that altitudes count from, and what else a format has.

    Attributes
    ----------
    items : without home.
    home : None where the file has none.
    first : the number of the first item in the file, for people.
    fence : as the key `fence` of a mission file; None: none.
    speed : as the key `limits.speed` [m/s]; None: not said.
    document : the parsed file, with everything this program does not know.
    home_item : the item that home was, where a ground station counts it as one.
    fence_items : those that the fence came as, where it did.
    """

    items: list[Item]
    home: Geodetic | None
    first: int = 0
    fence: Fence | None = None
    speed: float | None = None
    document: dict[str, Any] = field(default_factory=dict)
    home_item: Item | None = None
    fence_items: list[Item] = field(default_factory=list)


def mission_document(plan: Plan, name: str, file: str) -> dict[str, Any]:
    """What a mission file would say that flies a plan from wherever the vehicle stands.

    Raises
    ------
    MissionError : an item that is not flown, by its number and name, or no home.
    """
    if plan.home is None:
        raise MissionError(file, ["found no home and no place on the earth, expected one"])
    home = plan.home
    try:
        steps = to_steps(plan.items, home.altitude)
    except ItemFlaw as flaw:
        raise MissionError(file, [f"item {flaw.index + plan.first}: {flaw.what}"]) from flaw
    document: dict[str, Any] = {
        "name": name,
        "origin": {"latitude": home.latitude, "longitude": home.longitude, "altitude": home.altitude},
        "vehicle": {"start": {"north": 0.0, "east": 0.0, "anywhere": True}},
        "world": {"bounds": bounds_around(steps, home)},
    }
    if plan.speed is not None:
        document["limits"] = {"speed": plan.speed}
    if plan.fence is not None:
        document["fence"] = plan.fence
    return {**document, "steps": steps}


def ground_plan(plan: Plan) -> GroundPlan:
    """The items of a plan that is flown, as ground stations count them."""
    assert plan.home is not None
    steps = told(plan.items, plan.home.altitude)
    first = int(plan.home_item is not None)
    home = () if plan.home_item is None else (plan.home_item,)
    return GroundPlan(
        items=(*home, *plan.items),
        first=first,
        begins=(0,) * first + steps.begins,
        ends=(0,) * first + steps.ends,
        fence=tuple(plan.fence_items or fence_items(plan.fence)),
    )


def to_mission(document: dict[str, Any], home: Geodetic) -> Mission:
    """The mission of a document; raises pydantic's ValidationError."""
    return Mission.model_validate(document, context={ORIGIN: home})


def bounds_around(steps: Sequence[dict[str, Any]], home: Geodetic) -> dict[str, list[float]]:
    """A world [m] with room around every place of the steps and around home."""
    norths, easts, altitudes = [0.0], [0.0], [0.0]
    for step in steps:
        places = step.get("via", [])
        for kind in ("goto", "orbit"):
            places = [*places, step[kind]] if kind in step else places
        for place in places:
            local = "north" in place
            north, east = (
                (place["north"], place["east"]) if local else to_local(home, place["latitude"], place["longitude"])
            )
            reach = place.get("radius", 0.0)
            norths += [north - reach, north + reach]
            easts += [east - reach, east + reach]
            altitudes.append(place["altitude"])
        if "takeoff" in step:
            altitudes.append(step["takeoff"]["altitude"])
    low = 0.0 if min(altitudes) >= 0.0 else min(altitudes) - ABOVE
    return {
        "north": [math.floor(min(norths) - AROUND), math.ceil(max(norths) + AROUND)],
        "east": [math.floor(min(easts) - AROUND), math.ceil(max(easts) + AROUND)],
        "altitude": [low, math.ceil(max(altitudes) + ABOVE)],
    }
