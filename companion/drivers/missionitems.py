"""The mission in a recording as a ground station reads it: what a replay answers where none crossed the wire."""

from typing import Any

from companion.drivers.recording import MISSION_ATTACHMENT
from companion.drivers.worldfiles import recorded_mission
from companion.errors import CompanionError
from companion.geodesy import Geodetic, to_geodetic
from companion.planfiles import is_plan_file, read
from companion.planfiles.items import Item, ItemFlaw
from companion.planfiles.writing import from_steps
from logs.reader import Recording
from wire.dialect import mavlink


def mission_items(recording: Recording) -> list[Any]:
    """The attached mission as MISSION_ITEM_INT; none where it has no mission, or that no place on the earth."""
    attached = recording.attachments.get(MISSION_ATTACHMENT)
    if attached is None:
        return []
    try:
        items = _items(attached.data, recording)
    except (CompanionError, ItemFlaw):  # written by another version, or beyond what items say
        return []
    return [_item(number, item) for number, item in enumerate(items)]


def _items(data: bytes, recording: Recording) -> list[Item]:
    if is_plan_file(data, MISSION_ATTACHMENT):
        return list(read(data, MISSION_ATTACHMENT).items)
    mission = recorded_mission(recording, data, MISSION_ATTACHMENT)
    north, east, _ = mission.start_m()
    origin = mission.geodetic_origin()
    if origin is None:  # the mission's frame is the vehicle's, moved so that it stands where the mission says
        home = _home(recording)
        if home is None:
            return []
        origin = Geodetic(*to_geodetic(home, -north, -east), home.altitude)
    return from_steps(mission.steps, origin, (north, east))[0]


def _home(recording: Recording) -> Geodetic | None:
    """Where the vehicle said that its home is."""
    for message in recording.messages():
        if message.channel.schema == "mavlink.HOME_POSITION":
            home = recording.decode(message)
            return Geodetic(home.latitude / 1e7, home.longitude / 1e7, home.altitude / 1e3)
    return None


def _item(number: int, item: Item) -> Any:
    p1, p2, p3, p4, latitude, longitude, altitude = item.params
    x, y = (round(degrees * 1e7) if degrees == degrees else 0 for degrees in (latitude, longitude))
    frame, follows = item.frame, int(item.follows)
    return mavlink.MAVLink_mission_item_int_message(
        0, 0, number, frame, item.command, int(number == 0), follows, p1, p2, p3, p4, x, y, altitude
    )
