"""What the items of a mission mean: where they lead, how long they stay, what follows them. No state is kept here.

Points are (3,) local NED [m].
"""

import math

import numpy as np

from fakevehicle.places import Places
from fakevehicle.plans import RELATIVE_FRAMES, PlanItem
from fakevehicle.vocabulary import FloatArray, Geodetic
from wire.dialect import mavlink

_m = mavlink
TURN_RADIUS = 10.0
"""Of turns that do not say [m], as ArduCopter's CIRCLE_RADIUS."""
RING = 16
"""Points by which a circle is judged."""
PLACES = (
    _m.MAV_CMD_NAV_WAYPOINT,
    _m.MAV_CMD_CONDITION_GATE,  # in a survey, where the camera begins and ends: on the way, so it is flown to
    _m.MAV_CMD_NAV_LOITER_UNLIM,
    _m.MAV_CMD_NAV_LOITER_TURNS,
    _m.MAV_CMD_NAV_LOITER_TIME,
    _m.MAV_CMD_NAV_LAND,
    _m.MAV_CMD_NAV_TAKEOFF,
)
"""What a way leads to."""
STOPS = (_m.MAV_CMD_NAV_RETURN_TO_LAUNCH, _m.MAV_CMD_NAV_DELAY, _m.MAV_CMD_CONDITION_DELAY)
"""What is done at rest at the place before; anything else is done in passing."""


def target_of(item: PlanItem, places: Places, home_z: float, here_n: FloatArray) -> FloatArray | None:
    """The point an item names, (3,) local NED [m]; what it leaves open stays as it is in `here_n`.

    None before the first fix, which gives local coordinates their meaning.
    """
    origin = places.origin
    if origin is None:
        return None
    target_n = here_n.copy()
    latitude, longitude, altitude = item.params[4:]
    if item.has_place:
        place = places.local(Geodetic(math.radians(latitude), math.radians(longitude), origin.altitude))
        if place is None:
            return None
        target_n[:2] = place[:2]
    if not math.isnan(altitude):
        target_n[2] = (home_z if item.frame in RELATIVE_FRAMES else origin.altitude) - altitude
    return target_n


def aim_of(item: PlanItem, places: Places, home_z: float, came_n: FloatArray) -> FloatArray:
    """Where the way to an item ends when it comes from a point: for turns on their circle, for a landing above it."""
    aim_n = target_of(item, places, home_z, came_n)
    if aim_n is None:
        return came_n
    if item.command == _m.MAV_CMD_NAV_LAND:
        aim_n[2] = came_n[2]  # over the place first; its altitude is the ground's
    elif item.command == _m.MAV_CMD_NAV_LOITER_TURNS:
        return rim_of(aim_n, turn_radius(item), came_n)
    return aim_n


def rim_of(centre_n: FloatArray, radius: float, came_n: FloatArray) -> FloatArray:
    """The point of a circle that is nearest when one comes from a point; from the centre itself the northernmost."""
    north, east = (came_n - centre_n)[:2].tolist()
    bearing = math.atan2(east, north)
    return centre_n + radius * np.array([math.cos(bearing), math.sin(bearing), 0.0])


def ring_of(centre_n: FloatArray, radius: float) -> list[FloatArray]:
    """Points of a circle, by which it is judged."""
    angles = np.arange(RING) * (2.0 * math.pi / RING)
    return [centre_n + radius * np.array([math.cos(a), math.sin(a), 0.0]) for a in angles.tolist()]


def extent_of(item: PlanItem, places: Places, home_n: FloatArray) -> list[FloatArray]:
    """The points by which to judge whether an item leads out of a fence: its place, or points of its circle."""
    place_n = target_of(item, places, float(home_n[2]), home_n)
    if place_n is None or item.command not in PLACES:
        return []
    if item.command != _m.MAV_CMD_NAV_LOITER_TURNS:
        return [place_n]
    return ring_of(place_n, turn_radius(item))


def stay_s(item: PlanItem) -> float:
    """How long an item stays at its place [s]."""
    if item.command == _m.MAV_CMD_NAV_LOITER_UNLIM:
        return math.inf
    timed = item.command in (_m.MAV_CMD_NAV_WAYPOINT, _m.MAV_CMD_NAV_LOITER_TIME)
    return item.params[0] if timed and item.params[0] > 0.0 else 0.0


def cruise_after(item: PlanItem, cruise: float | None) -> float | None:
    """The cruise speed [m/s] after an item."""
    asks = item.command == _m.MAV_CMD_DO_CHANGE_SPEED and item.params[0] in (0.0, 1.0) and item.params[1] > 0.0
    return item.params[1] if asks else cruise


def index_after(item: PlanItem, index: int, jumped: dict[int, int]) -> int:
    """The item that follows the one at `index`; a jump that is taken is counted in `jumped`."""
    if item.command != _m.MAV_CMD_DO_JUMP:
        return index + 1
    done, times = jumped.get(index, 0), item.params[1]
    if not (times < 0.0 or done < times):
        return index + 1
    jumped[index] = done + 1
    return int(item.params[0])


def turn_radius(item: PlanItem) -> float:
    """Radius of turns [m]; its sign is their sense."""
    radius = abs(item.params[2])
    return radius if radius > 0.0 else TURN_RADIUS
