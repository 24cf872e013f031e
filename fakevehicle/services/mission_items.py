"""Mission items between MAVLink's messages and the plans, and items as places.

MISSION_ITEM_INT multiplies a place's latitude and longitude by 1e7, a local point by 1e4, and anything else by 1;
INT32_MAX there stands for NaN. MISSION_ITEM carries both as 32-bit floats.
"""

import math

from fakevehicle.codec import Message
from fakevehicle.modes import Refusal
from fakevehicle.places import Places
from fakevehicle.plans import GLOBAL_FRAMES, RELATIVE_FRAMES, Kind, PlanItem
from fakevehicle.services.commands import MAX_GOTO
from fakevehicle.supervisor import Supervisor
from fakevehicle.waypoints import target_of
from wire.dialect import mavlink

_m = mavlink
_LOCAL = (_m.MAV_FRAME_LOCAL_NED, _m.MAV_FRAME_LOCAL_ENU, _m.MAV_FRAME_LOCAL_OFFSET_NED)
INT_UNSET = 2**31 - 1
UNKNOWN_HOME = PlanItem(_m.MAV_CMD_NAV_WAYPOINT, _m.MAV_FRAME_GLOBAL, (0.0,) * 7)
"""Home as a mission's item before anybody knows where it is."""


def home_item(supervisor: Supervisor, places: Places) -> PlanItem | None:
    """Home as a mission's item; None before it is known."""
    place = None if supervisor.home is None else places.e7(supervisor.home.position_n)
    if place is None:
        return None
    latitude, longitude, millimetres = place
    where = (latitude * 1e-7, longitude * 1e-7, millimetres * 1e-3)
    return PlanItem(_m.MAV_CMD_NAV_WAYPOINT, _m.MAV_FRAME_GLOBAL, (0.0, 0.0, 0.0, 0.0, *where))


def go_to(supervisor: Supervisor, places: Places, item: PlanItem, now_us: int) -> str | None:
    """Fly to the place of an item and hold there; None, or the reason why not."""
    here_n, home = supervisor.position_n, supervisor.home
    if here_n is None or home is None:
        return Refusal.NO_POSITION.value
    if item.frame not in GLOBAL_FRAMES + RELATIVE_FRAMES:
        return f"frame {item.frame}, expected a global one"
    latitude, longitude, altitude = item.params[4:]
    if not (abs(latitude) <= 90.0 and abs(longitude) <= 180.0 and math.isfinite(altitude)):
        return "the place is not on the globe"
    target_n = target_of(item, places, float(home.position_n[2]), here_n)
    if target_n is None:
        return Refusal.NO_POSITION.value
    distance = math.dist(target_n, here_n)
    if distance > MAX_GOTO:
        return f"{distance / 1000:.1f} km away, expected at most {MAX_GOTO / 1000:g} km"
    refusal = supervisor.ask_goto(now_us, target_n, math.nan)
    return None if refusal is None else refusal.value


PLAIN_FRAMES = {
    _m.MAV_FRAME_GLOBAL_INT: _m.MAV_FRAME_GLOBAL,
    _m.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT: _m.MAV_FRAME_GLOBAL_RELATIVE_ALT,
}


def kind_of(message: Message) -> Kind | None:
    """The plan a message is about; MAVLink 1 has only missions."""
    number = getattr(message, "mission_type", 0)
    return Kind(number) if 0 <= number <= 2 else None


def scale_of(frame: int) -> float:
    """What MISSION_ITEM_INT multiplies x and y by."""
    return 1.0 if frame == _m.MAV_FRAME_MISSION else 1e4 if frame in _LOCAL else 1e7


def as_int32(value: float) -> int:
    """The nearest number that fits; INT_UNSET for NaN."""
    return INT_UNSET if math.isnan(value) else round(min(max(value, -(2.0**31)), INT_UNSET))


def item_of(message: Message) -> PlanItem:
    """An item as it is kept. INT32_MAX in an integer place stands for NaN."""
    x, y = float(message.x), float(message.y)
    if message.get_type() == "MISSION_ITEM_INT":
        scale = scale_of(message.frame)
        x = math.nan if message.x == INT_UNSET else message.x / scale
        y = math.nan if message.y == INT_UNSET else message.y / scale
    params = (message.param1, message.param2, message.param3, message.param4, x, y, message.z)
    return PlanItem(message.command, message.frame, params, bool(message.autocontinue))
