"""The mission protocol of the companion's own component: a ground station hands over a plan, reads or clears it.

A plan is a mission or a fence; rally points are refused, since the way back leads to where the flight began.

Upload: MISSION_COUNT begins it, items are asked for one by one (MISSION_REQUEST_INT), MISSION_ACK ends it
(https://mavlink.io/en/services/mission.html); MISSION_WRITE_PARTIAL_LIST does the same for a few items of a plan that
is there. A plan is kept only when it is whole and every item of it is flown; until then the one before stays. A request
without an answer is repeated, and given up after a while. One upload at a time. Download keeps no state: any item may
be asked for at any time, in either form.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from companion.planfiles.fence import to_fence
from companion.planfiles.items import GLOBAL, MOST_ITEMS, Item, ItemFlaw
from companion.planfiles.reading import to_steps
from wire.dialect import mavlink

_m = mavlink
MISSION, FENCE = _m.MAV_MISSION_TYPE_MISSION, _m.MAV_MISSION_TYPE_FENCE
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
    plan: int
    count: int  # of items when it is whole
    rest: list[Item] = field(default_factory=list)  # what stays after those that come
    items: list[Item] = field(default_factory=list)
    asked_us: int = 0
    tries: int = 1


class MissionProtocol:
    """Keeps a mission and a fence.

    Parameters
    ----------
    items, fence : the plans at the beginning.
    fixed : why the fence cannot be changed now; empty: it can.

    Attributes
    ----------
    items, fence : the plans that are kept, as they were uploaded.
    uploads : how many were taken; a clearing counts.
    """

    def __init__(self, items: Sequence[Item] = (), fence: Sequence[Item] = (), fixed: str = "") -> None:
        self._plans = {MISSION: list(items), FENCE: list(fence)}
        self._fixed = fixed
        self.uploads = 0
        self._upload: _Upload | None = None

    @property
    def items(self) -> list[Item]:
        return self._plans[MISSION]

    @property
    def fence(self) -> list[Item]:
        return self._plans[FENCE]

    def take_over(self, flight: "MissionProtocol") -> None:
        """Keep the mission that another was given; its fence is the flight's, which does not change."""
        self._plans[MISSION] = list(flight.items)
        self.uploads += 1

    def take(self, now_us: int, sender: Sender, message: Any) -> Answer | None:
        """One message of the protocol that is for us; None when it is none of it."""
        kind = message.get_type()
        handler = HANDLERS.get(kind)
        if handler is None:
            return None
        plan = getattr(message, "mission_type", MISSION)
        everything = plan == _m.MAV_MISSION_TYPE_ALL and kind == "MISSION_CLEAR_ALL"
        if plan not in self._plans and not everything and kind != "MISSION_ACK":
            name = "rally points are" if plan == _m.MAV_MISSION_TYPE_RALLY else f"plans of type {plan} are"
            return self._refused(sender, _m.MAV_MISSION_UNSUPPORTED, f"{name} not kept here", plan)
        if self._fixed and kind in CHANGING and (everything or plan == FENCE):
            return self._refused(sender, _m.MAV_MISSION_DENIED, self._fixed, plan)
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
            return self._refused(upload.sender, _m.MAV_MISSION_OPERATION_CANCELLED, wanted, upload.plan)
        upload.tries += 1
        return self._ask(now_us, upload)

    # ---- up -----------------------------------------------------------------------------------------------------

    def _count(self, now_us: int, sender: Sender, m: Any) -> Answer:
        if m.count > MOST_ITEMS:
            found = f"found {m.count} items, expected at most {MOST_ITEMS}"
            return self._refused(sender, _m.MAV_MISSION_NO_SPACE, found, m.mission_type)
        if m.count == 0:
            return self._clear(now_us, sender, m)
        return self._begin(now_us, _Upload(sender, m.mission_type, m.count))

    def _partial(self, now_us: int, sender: Sender, m: Any) -> Answer:
        there, first, last = self._plans[m.mission_type], m.start_index, m.end_index
        if not 0 <= first <= last < len(there):
            found = f"found items {first} to {last}, expected some of the {len(there)} that are there"
            return self._refused(sender, _m.MAV_MISSION_INVALID_SEQUENCE, found, m.mission_type)
        upload = _Upload(sender, m.mission_type, last + 1, rest=there[last + 1 :], items=there[:first])
        return self._begin(now_us, upload)

    def _begin(self, now_us: int, upload: _Upload) -> Answer:
        if self._upload is not None and self._upload.sender != upload.sender:
            return self._refused(upload.sender, _m.MAV_MISSION_DENIED, "somebody else uploads a plan", upload.plan)
        self._upload = upload
        return self._ask(now_us, upload)

    def _item(self, now_us: int, sender: Sender, m: Any) -> Answer:
        upload, plan = self._upload, m.mission_type
        if upload is None or upload.sender != sender or upload.plan != plan:
            return self._refused(sender, _m.MAV_MISSION_DENIED, f"item {m.seq} was not asked for", plan)
        wanted = len(upload.items)
        if m.seq == wanted - 1:
            return self._ask(now_us, upload)  # our last request was late, or doubled
        if m.seq != wanted:
            came = f"item {m.seq} came, item {wanted} was asked for"
            return self._refused(sender, _m.MAV_MISSION_INVALID_SEQUENCE, came, plan)
        upload.items.append(item_of(m))
        upload.tries = 1
        if len(upload.items) < upload.count:
            return self._ask(now_us, upload)
        self._upload, items = None, upload.items + upload.rest
        try:
            judge(items, plan)
        except ItemFlaw as flaw:
            result = _m.MAV_MISSION_UNSUPPORTED if flaw.unsupported else _m.MAV_MISSION_INVALID
            return self._refused(sender, result, f"item {flaw.index}: {flaw.what}", plan)
        self._plans[plan] = items
        self.uploads += 1
        return Answer(sender, (self._ack(sender, _m.MAV_MISSION_ACCEPTED, plan),))

    def _clear(self, now_us: int, sender: Sender, m: Any) -> Answer:
        cleared = list(self._plans) if m.mission_type not in self._plans else [m.mission_type]
        self._plans |= {plan: [] for plan in cleared}
        self._upload = None
        self.uploads += 1
        return Answer(sender, (self._ack(sender, _m.MAV_MISSION_ACCEPTED, m.mission_type),))

    def _cancel(self, now_us: int, sender: Sender, m: Any) -> Answer | None:
        """Its MISSION_ACK ends a download, or gives an upload up."""
        if self._upload is not None and self._upload.sender == sender and m.type != _m.MAV_MISSION_ACCEPTED:
            self._upload = None
        return None

    def _ask(self, now_us: int, upload: _Upload) -> Answer:
        upload.asked_us = now_us
        to, wanted = upload.sender, len(upload.items)
        return Answer(to, (_m.MAVLink_mission_request_int_message(*to, wanted, upload.plan),))

    # ---- down ---------------------------------------------------------------------------------------------------

    def _list(self, now_us: int, sender: Sender, m: Any) -> Answer:
        count = len(self._plans[m.mission_type])
        return Answer(sender, (_m.MAVLink_mission_count_message(*sender, count, m.mission_type),))

    def _request(self, now_us: int, sender: Sender, m: Any) -> Answer:
        items = self._plans[m.mission_type]
        if m.seq >= len(items):
            there = f"item {m.seq} was asked for, there are {len(items)}"
            return self._refused(sender, _m.MAV_MISSION_INVALID_SEQUENCE, there, m.mission_type)
        whole = m.get_type() == "MISSION_REQUEST_INT"
        return Answer(sender, (message_of(items[m.seq], m.seq, sender, whole, m.mission_type),))

    def _part(self, now_us: int, sender: Sender, m: Any) -> Answer:
        why = "plans are not read in parts: MISSION_REQUEST_INT asks for one item"
        return self._refused(sender, _m.MAV_MISSION_UNSUPPORTED, why, m.mission_type)

    # ---- words --------------------------------------------------------------------------------------------------

    def _refused(self, sender: Sender, result: int, why: str, plan: int = 0) -> Answer:
        what = {FENCE: "fence", _m.MAV_MISSION_TYPE_RALLY: "rally points"}.get(plan, "plan")
        return Answer(sender, (self._ack(sender, result, plan),), f"{what} refused: {why}")

    def _ack(self, sender: Sender, result: int, plan: int = 0) -> Any:
        return _m.MAVLink_mission_ack_message(sender.system_id, sender.component_id, result, plan)


HANDLERS: dict[str, Any] = {
    "MISSION_COUNT": MissionProtocol._count,
    "MISSION_WRITE_PARTIAL_LIST": MissionProtocol._partial,
    "MISSION_ITEM_INT": MissionProtocol._item,
    "MISSION_ITEM": MissionProtocol._item,
    "MISSION_CLEAR_ALL": MissionProtocol._clear,
    "MISSION_REQUEST_LIST": MissionProtocol._list,
    "MISSION_REQUEST_PARTIAL_LIST": MissionProtocol._part,
    "MISSION_REQUEST_INT": MissionProtocol._request,
    "MISSION_REQUEST": MissionProtocol._request,
    "MISSION_ACK": MissionProtocol._cancel,
}
"""What each message of the protocol does."""
CHANGING = frozenset({"MISSION_COUNT", "MISSION_WRITE_PARTIAL_LIST", "MISSION_CLEAR_ALL"})
"""Those that change a plan."""


def judge(items: Sequence[Item], plan: int) -> None:
    """Raise `ItemFlaw` where a plan is not flown or kept to; its index counts all items."""
    if plan == FENCE:
        to_fence(items)
        return
    flown, home_altitude = without_home(items)
    try:
        to_steps(flown, home_altitude)
    except ItemFlaw as flaw:
        raise ItemFlaw(flaw.index + len(items) - len(flown), flaw.what, flaw.unsupported) from flaw


def without_home(items: Sequence[Item]) -> tuple[list[Item], float]:
    """A plan's items without the home that ArduPilot's plans begin with, and home's altitude above the sea [m].

    Home is a waypoint before the takeoff: as an item it could not be flown. Where there is none the altitude is 0,
    which is good enough to judge a plan by.
    """
    placed = (
        item.command for item in items[1:] if item.command < _m.MAV_CMD_NAV_LAST
    )  # beyond: what to do, conditions
    takeoff = next(placed, None) == _m.MAV_CMD_NAV_TAKEOFF
    home = takeoff and items[0].command == _m.MAV_CMD_NAV_WAYPOINT
    return (list(items[1:]), items[0].params[6]) if home else (list(items), 0.0)


def item_of(m: Any) -> Item:
    """The item of a MISSION_ITEM_INT or a MISSION_ITEM."""
    scale = _scale(m.frame) if m.get_type() == "MISSION_ITEM_INT" else 1.0
    places = (m.x / scale, m.y / scale, m.z)
    extra = {"autocontinue": m.autocontinue}
    return Item(m.command, m.frame, (m.param1, m.param2, m.param3, m.param4, *places), extra)


def message_of(item: Item, index: int, to: Sender, whole: bool, plan: int = 0) -> Any:
    """The message that tells an item, in the integer form or the float one."""
    p1, p2, p3, p4, x, y, z = item.params
    build = _m.MAVLink_mission_item_int_message if whole else _m.MAVLink_mission_item_message
    scale = _scale(item.frame)
    places = (_int32(x * scale), _int32(y * scale)) if whole else (x, y)
    return build(*to, index, item.frame, item.command, 0, int(item.follows), p1, p2, p3, p4, *places, z, plan)


def _scale(frame: int) -> float:
    if frame in GLOBAL or frame in (_m.MAV_FRAME_GLOBAL_TERRAIN_ALT, _m.MAV_FRAME_GLOBAL_TERRAIN_ALT_INT):
        return DEGREES
    return 1.0 if frame == _m.MAV_FRAME_MISSION else METRES


def _int32(value: float) -> int:
    return max(-(2**31), min(2**31 - 1, round(value))) if value == value else 0
