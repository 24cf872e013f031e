"""Our steps, told as plan items; a step that no item can say is refused by its number."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from companion.geodesy import Geodetic, to_geodetic
from companion.legs import circle_of
from companion.planfiles.items import NAN, Item, ItemFlaw
from companion.steps import Step
from planner import Limits
from wire.dialect import mavlink

_m = mavlink


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
