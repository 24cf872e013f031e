"""The mission protocol of the companion's own component: a ground station hands over a plan, reads or clears it.

Upload: MISSION_COUNT begins it, items are asked for one by one (MISSION_REQUEST_INT), MISSION_ACK ends it
(https://mavlink.io/en/services/mission.html). A plan is kept only when it is whole and every item of it is flown; until
then the one before stays. A request without an answer is repeated, and given up after a while. One upload at a time.
Download keeps no state: any item may be asked for at any time, in either form.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from companion.planfiles.items import GLOBAL, MOST_ITEMS, Item, ItemFlaw
from companion.planfiles.reading import to_steps
from wire.dialect import mavlink

_m = mavlink
REPEAT_US = 500_000
TRIES = 5
DEGREES, METRES = 1e7, 1e4
"""What the integer form counts in, in a global frame and in a local one."""


class Sender(NamedTuple):
    """Who speaks."""

    system_id: int
    component_id: int


@dataclass(frozen=True, slots=True)
class Answer:
    """Messages to one sender, and a text that tells people why."""

    to: Sender
    messages: tuple[Any, ...] = ()
    text: str = ""


@dataclass(slots=True)
class _Upload:
    sender: Sender
    count: int
    items: list[Item] = field(default_factory=list)
    asked_us: int = 0
    tries: int = 1


class MissionProtocol:
    """Keeps one plan.

    Parameters
    ----------
    items : the plan at the beginning.

    Attributes
    ----------
    items : the plan that is kept, as it was uploaded.
    uploads : how many plans were taken; a clearing counts.
    """

    def __init__(self, items: Sequence[Item] = ()) -> None:
        self.items = list(items)
        self.uploads = 0
        self._upload: _Upload | None = None

    def take(self, now_us: int, sender: Sender, message: Any) -> Answer | None:
        """One message of the protocol that is for us; None when it is none of it."""
        kind = message.get_type()
        handler = HANDLERS.get(kind)
        if handler is None:
            return None
        plan = getattr(message, "mission_type", _m.MAV_MISSION_TYPE_MISSION)
        if plan != _m.MAV_MISSION_TYPE_MISSION and kind != "MISSION_ACK":
            return self._refused(
                sender, _m.MAV_MISSION_UNSUPPORTED, "only missions are kept here, no fence or rally", plan
            )
        answer: Answer | None = handler(self, now_us, sender, message)
        return answer

    def step(self, now_us: int) -> Answer | None:
        """Once a tick: ask again for an item that does not come, and give up at last."""
        upload = self._upload
        if upload is None or now_us - upload.asked_us < REPEAT_US:
            return None
        if upload.tries >= TRIES:
            self._upload = None
            wanted = f"item {len(upload.items)} of {upload.count} did not come"
            return self._refused(upload.sender, _m.MAV_MISSION_OPERATION_CANCELLED, wanted)
        upload.tries += 1
        return self._ask(now_us, upload)

    # ---- up -----------------------------------------------------------------------------------------------------

    def _count(self, now_us: int, sender: Sender, m: Any) -> Answer:
        if self._upload is not None and self._upload.sender != sender:
            return self._refused(sender, _m.MAV_MISSION_DENIED, "somebody else uploads a plan")
        if m.count > MOST_ITEMS:
            found = f"found {m.count} items, expected at most {MOST_ITEMS}"
            return self._refused(sender, _m.MAV_MISSION_NO_SPACE, found)
        if m.count == 0:
            return self._clear(now_us, sender, m)
        self._upload = _Upload(sender, m.count)
        return self._ask(now_us, self._upload)

    def _item(self, now_us: int, sender: Sender, m: Any) -> Answer:
        upload = self._upload
        if upload is None or upload.sender != sender:
            return self._refused(sender, _m.MAV_MISSION_DENIED, f"item {m.seq} was not asked for")
        wanted = len(upload.items)
        if m.seq == wanted - 1:
            return self._ask(now_us, upload)  # our last request was late, or doubled
        if m.seq != wanted:
            return self._refused(
                sender, _m.MAV_MISSION_INVALID_SEQUENCE, f"item {m.seq} came, item {wanted} was asked for"
            )
        upload.items.append(item_of(m))
        upload.tries = 1
        if len(upload.items) < upload.count:
            return self._ask(now_us, upload)
        self._upload = None
        try:
            to_steps(*without_home(upload.items))
        except ItemFlaw as flaw:
            first = len(upload.items) - len(without_home(upload.items)[0])
            result = _m.MAV_MISSION_UNSUPPORTED if flaw.unsupported else _m.MAV_MISSION_INVALID
            return self._refused(sender, result, f"item {flaw.index + first}: {flaw.what}")
        self.items = upload.items
        self.uploads += 1
        return Answer(sender, (self._ack(sender, _m.MAV_MISSION_ACCEPTED),))

    def _clear(self, now_us: int, sender: Sender, m: Any) -> Answer:
        self.items, self._upload = [], None
        self.uploads += 1
        return Answer(sender, (self._ack(sender, _m.MAV_MISSION_ACCEPTED),))

    def _cancel(self, now_us: int, sender: Sender, m: Any) -> Answer | None:
        """Its MISSION_ACK ends a download, or gives an upload up."""
        if self._upload is not None and self._upload.sender == sender and m.type != _m.MAV_MISSION_ACCEPTED:
            self._upload = None
        return None

    def _ask(self, now_us: int, upload: _Upload) -> Answer:
        upload.asked_us = now_us
        to, wanted = upload.sender, len(upload.items)
        return Answer(to, (_m.MAVLink_mission_request_int_message(to.system_id, to.component_id, wanted, 0),))

    # ---- down ---------------------------------------------------------------------------------------------------

    def _list(self, now_us: int, sender: Sender, m: Any) -> Answer:
        count = _m.MAVLink_mission_count_message(sender.system_id, sender.component_id, len(self.items), 0)
        return Answer(sender, (count,))

    def _request(self, now_us: int, sender: Sender, m: Any) -> Answer:
        if m.seq >= len(self.items):
            there = f"item {m.seq} was asked for, there are {len(self.items)}"
            return self._refused(sender, _m.MAV_MISSION_INVALID_SEQUENCE, there)
        whole = m.get_type() == "MISSION_REQUEST_INT"
        return Answer(sender, (message_of(self.items[m.seq], m.seq, sender, whole),))

    # ---- words --------------------------------------------------------------------------------------------------

    def _refused(self, sender: Sender, result: int, why: str, plan: int = 0) -> Answer:
        return Answer(sender, (self._ack(sender, result, plan),), f"plan refused: {why}")

    def _ack(self, sender: Sender, result: int, plan: int = 0) -> Any:
        return _m.MAVLink_mission_ack_message(sender.system_id, sender.component_id, result, plan)


HANDLERS: dict[str, Any] = {
    "MISSION_COUNT": MissionProtocol._count,
    "MISSION_ITEM_INT": MissionProtocol._item,
    "MISSION_ITEM": MissionProtocol._item,
    "MISSION_CLEAR_ALL": MissionProtocol._clear,
    "MISSION_REQUEST_LIST": MissionProtocol._list,
    "MISSION_REQUEST_INT": MissionProtocol._request,
    "MISSION_REQUEST": MissionProtocol._request,
    "MISSION_ACK": MissionProtocol._cancel,
}
"""What each message of the protocol does."""


def without_home(items: Sequence[Item]) -> tuple[list[Item], float]:
    """A plan's items without the home that ArduPilot's plans begin with, and home's altitude above the sea [m].

    Home is a waypoint before the takeoff: as an item it could not be flown. Where there is none the altitude is 0,
    which is good enough to judge a plan by.
    """
    home = len(items) > 1 and items[0].command == _m.MAV_CMD_NAV_WAYPOINT and items[1].command == _m.MAV_CMD_NAV_TAKEOFF
    return (list(items[1:]), items[0].params[6]) if home else (list(items), 0.0)


def item_of(m: Any) -> Item:
    """The item of a MISSION_ITEM_INT or a MISSION_ITEM."""
    scale = _scale(m.frame) if m.get_type() == "MISSION_ITEM_INT" else 1.0
    places = (m.x / scale, m.y / scale, m.z)
    extra = {"autocontinue": m.autocontinue}
    return Item(m.command, m.frame, (m.param1, m.param2, m.param3, m.param4, *places), extra)


def message_of(item: Item, index: int, to: Sender, whole: bool) -> Any:
    """The message that tells an item, in the integer form or the float one."""
    p1, p2, p3, p4, x, y, z = item.params
    build = _m.MAVLink_mission_item_int_message if whole else _m.MAVLink_mission_item_message
    scale = _scale(item.frame)
    places = (_int32(x * scale), _int32(y * scale)) if whole else (x, y)
    follows = int(item.extra.get("autocontinue", 1))
    return build(*to, index, item.frame, item.command, 0, follows, p1, p2, p3, p4, *places, z, 0)


def _scale(frame: int) -> float:
    if frame in GLOBAL or frame in (_m.MAV_FRAME_GLOBAL_TERRAIN_ALT, _m.MAV_FRAME_GLOBAL_TERRAIN_ALT_INT):
        return DEGREES
    return 1.0 if frame == _m.MAV_FRAME_MISSION else METRES


def _int32(value: float) -> int:
    return max(-(2**31), min(2**31 - 1, round(value))) if value == value else 0
