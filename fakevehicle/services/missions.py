"""The mission protocol: plans up, down, in part and cleared; MISSION_CURRENT and MISSION_ITEM_REACHED.

Upload: MISSION_COUNT begins it, the vehicle asks for the items one by one, and MISSION_ACK ends it. Every item is
looked at as it arrives; the stored plan is replaced only when the whole new one is right, so that an upload that fails
leaves what was there. A request that stays unanswered is repeated, and given up with an ACK after a while. One upload
at a time: another client is told that it must wait. Download keeps no state: any item may be asked for at any time.

Items are asked for in the integer form or, for autopilots that do so, in the float one; either is taken and each
request is answered in the form it asks for. A plan read back has frame 3 where 6 was written and 0 where 5 was only if
`plain_frames` says so.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from fakevehicle.codec import Message
from fakevehicle.modes import Mode
from fakevehicle.places import Places
from fakevehicle.plans import MAX_ITEMS, Flaw, Kind, PlanItem, PlanStore, item_flaw, plan_flaw, renumbered
from fakevehicle.services.mission_items import (
    PLAIN_FRAMES,
    UNKNOWN_HOME,
    as_int32,
    go_to,
    home_item,
    item_of,
    kind_of,
    scale_of,
)
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import Builder, Handler, Service
from fakevehicle.services.words import Words
from fakevehicle.supervisor import Supervisor
from wire.dialect import mavlink

_m = mavlink
_ALL = 255
LOOK_US = 20_000
"""Progress and time-outs are looked at this often."""
SECOND_US = 1_000_000
MOST_REACHED = 50
"""Items told of as reached in one second; a plan of commands alone is done with one a tick."""
GUIDED_ITEM = 2
"""MISSION_ITEM.current of an item that is no mission's but a place to go to now."""


@dataclass(frozen=True, slots=True)
class MissionHabits:
    """How an autopilot speaks the protocol.

    Attributes
    ----------
    ask_int : ask for items by MISSION_REQUEST_INT, else by MISSION_REQUEST.
    retry_us, give_up_us : ask again after this long without an item; end the upload after that long.
    home_first : item 0 of the mission is home and no item of ours.
    plain_frames : frames 5 and 6 read back as 0 and 3.
    """

    ask_int: bool = True
    retry_us: int = 500_000
    give_up_us: int = 5_000_000
    home_first: bool = False
    plain_frames: bool = False


@dataclass(slots=True)
class _Upload:
    """One upload under way: items `first`..`last` of a plan of `kind`, the whole of it or a part."""

    sender: Sender
    kind: Kind
    first: int
    last: int
    partial: bool = False
    asked_us: int = 0
    heard_us: int = 0
    items: list[PlanItem] = field(default_factory=list)

    @property
    def wanted(self) -> int:
        return self.first + len(self.items)


class Missions(Service):
    """Answers the mission protocol's messages and keeps the plans.

    Parameters
    ----------
    store : where the plans are.
    supervisor : flies the mission.
    places : turns places into points.
    outbox : where answers go.
    refuse : puts a refusal into words.
    habits : of the autopilot that is played.
    """

    def __init__(
        self,
        store: PlanStore,
        supervisor: Supervisor,
        places: Places,
        outbox: Outbox,
        refuse: Words,
        habits: MissionHabits | None = None,
    ) -> None:
        self._store = store
        self._runner = supervisor.runner
        self._supervisor = supervisor
        self._outbox = outbox
        self._say = refuse
        self._places = places
        self.habits = habits or MissionHabits()
        self._upload: _Upload | None = None
        self._finished: tuple[Sender, int, int] | None = None  # whose upload ended well, its kind and last item
        self._told: object = None
        self._reached = self._reached_told = 0  # how many there were, and told of in this second

    def routes(self) -> Mapping[int, Handler]:
        """Which message goes where."""
        return {
            _m.MAVLINK_MSG_ID_MISSION_REQUEST_LIST: self.request_list,
            _m.MAVLINK_MSG_ID_MISSION_REQUEST_PARTIAL_LIST: self.request_list,
            _m.MAVLINK_MSG_ID_MISSION_COUNT: self.count,
            _m.MAVLINK_MSG_ID_MISSION_WRITE_PARTIAL_LIST: self.write_partial,
            _m.MAVLINK_MSG_ID_MISSION_CLEAR_ALL: self.clear_all,
            _m.MAVLINK_MSG_ID_MISSION_REQUEST: self.request_float,
            _m.MAVLINK_MSG_ID_MISSION_REQUEST_INT: self.request_int,
            _m.MAVLINK_MSG_ID_MISSION_SET_CURRENT: self.set_current,
            _m.MAVLINK_MSG_ID_MISSION_ITEM: self.item,
            _m.MAVLINK_MSG_ID_MISSION_ITEM_INT: self.item,
            _m.MAVLINK_MSG_ID_MISSION_ACK: self.ack,
        }

    def builders(self) -> Mapping[int, Builder]:
        """Messages that can be streamed or asked for."""
        return {
            _m.MAVLINK_MSG_ID_MISSION_CURRENT: self.mission_current,
            _m.MAVLINK_MSG_ID_MISSION_ITEM_REACHED: self.mission_item_reached,
        }

    # Down

    def request_list(self, sender: Sender, message: Message, now_us: int) -> None:
        """MISSION_REQUEST_LIST, and the one for a part: how many items there are."""
        kind = kind_of(message)
        if kind is None:
            self._refuse(sender, message.mission_type, Flaw(_m.MAV_MISSION_UNSUPPORTED, "no such kind of plan"))
            return
        count = len(self._items(kind))
        self._outbox.answer(
            sender, _m.MAVLink_mission_count_message(sender.system_id, sender.component_id, count, kind.value)
        )

    def request_int(self, sender: Sender, message: Message, now_us: int) -> None:
        """MISSION_REQUEST_INT: one item, places times 1e7."""
        self._send(sender, message, _m.MAVLink_mission_item_int_message, integer=True)

    def request_float(self, sender: Sender, message: Message, now_us: int) -> None:
        """MISSION_REQUEST: one item in the old form, places in degrees as 32-bit floats."""
        self._send(sender, message, _m.MAVLink_mission_item_message, integer=False)

    def _send(self, sender: Sender, message: Message, build: Callable[..., Message], integer: bool) -> None:
        kind = kind_of(message)
        items = () if kind is None else self._items(kind)
        if kind is None or message.seq >= len(items):
            flaw = Flaw(_m.MAV_MISSION_INVALID_SEQUENCE, f"there is no item {message.seq}")
            self._refuse(sender, message.mission_type, flaw)
            return
        item = items[message.seq]
        x, y = item.params[4:6]
        if integer:
            scale = scale_of(item.frame)
            x, y = as_int32(x * scale), as_int32(y * scale)
        frame = PLAIN_FRAMES.get(item.frame, item.frame) if self.habits.plain_frames else item.frame
        current = kind is Kind.MISSION and message.seq == self._sequence
        self._outbox.answer(
            sender,
            build(
                sender.system_id,
                sender.component_id,
                message.seq,
                frame,
                item.command,
                current,
                item.autocontinue,
                *item.params[:4],
                x,
                y,
                item.params[6],
                kind.value,
            ),
        )

    def _items(self, kind: Kind) -> tuple[PlanItem, ...]:
        """A plan as clients see it: with home before it, and jumps that count it."""
        items = self._store[kind]
        if not (self.habits.home_first and kind is Kind.MISSION):
            return items
        home = home_item(self._supervisor, self._places)
        return items if home is None and not items else (home or UNKNOWN_HOME, *renumbered(items, 1))

    # Up

    def count(self, sender: Sender, message: Message, now_us: int) -> None:
        """MISSION_COUNT: an upload begins. None at all is an empty plan."""
        kind = kind_of(message)
        if kind is None:
            self._refuse(sender, message.mission_type, Flaw(_m.MAV_MISSION_UNSUPPORTED, "no such kind of plan"))
        elif self._busy(sender):
            self._refuse(sender, kind.value, Flaw(_m.MAV_MISSION_DENIED, "another client is uploading"))
        elif message.count > MAX_ITEMS:
            flaw = Flaw(_m.MAV_MISSION_NO_SPACE, f"{message.count} items, there is room for {MAX_ITEMS}")
            self._refuse(sender, kind.value, flaw)
        elif message.count == 0:
            self._upload = None
            self._store.replace(kind, ())
            self._accept(sender, kind.value)
        else:
            self._begin(_Upload(sender, kind, 0, message.count - 1), now_us)

    def write_partial(self, sender: Sender, message: Message, now_us: int) -> None:
        """MISSION_WRITE_PARTIAL_LIST: some items of the stored plan are replaced."""
        kind = kind_of(message)
        first, last = message.start_index, message.end_index
        if kind is None:
            self._refuse(sender, message.mission_type, Flaw(_m.MAV_MISSION_UNSUPPORTED, "no such kind of plan"))
        elif self._busy(sender):
            self._refuse(sender, kind.value, Flaw(_m.MAV_MISSION_DENIED, "another client is uploading"))
        elif not 0 <= first <= last < len(self._items(kind)):
            flaw = Flaw(_m.MAV_MISSION_INVALID_SEQUENCE, f"items {first}..{last} of {len(self._items(kind))}")
            self._refuse(sender, kind.value, flaw)
        else:
            self._begin(_Upload(sender, kind, first, last, partial=True), now_us)

    def item(self, sender: Sender, message: Message, now_us: int) -> None:
        """MISSION_ITEM_INT or MISSION_ITEM: the one we asked for, or a place to go to."""
        item = item_of(message)
        if message.current == GUIDED_ITEM:
            reason = go_to(self._supervisor, self._places, item, now_us)
            if reason is None:
                self._accept(sender, Kind.MISSION.value)
            else:
                self._refuse(sender, Kind.MISSION.value, Flaw(_m.MAV_MISSION_ERROR, reason))
            return
        done = self._finished
        if self._upload is None and done == (sender, message.mission_type, message.seq):
            self._accept(sender, message.mission_type)  # our ACK was lost, and the last item comes once more
            return
        up = self._upload
        if up is None or up.sender != sender or message.mission_type != up.kind.value:
            flaw = Flaw(_m.MAV_MISSION_INVALID_SEQUENCE, "nobody asked for that item")
            self._refuse(sender, message.mission_type, flaw)
            return
        if message.seq != up.wanted:
            if up.items and message.seq == up.wanted - 1:
                return  # the same once more: our next request has crossed it
            flaw = Flaw(_m.MAV_MISSION_INVALID_SEQUENCE, f"item {message.seq}, expected {up.wanted}")
            self._refuse(sender, up.kind.value, flaw)
            return
        home = self.habits.home_first and up.kind is Kind.MISSION and message.seq == 0
        flaw_found = None if home else item_flaw(up.kind, item)
        if flaw_found is not None:
            self._upload = None
            self._refuse(sender, up.kind.value, Flaw(flaw_found.result, f"item {message.seq}, {flaw_found.reason}"))
            return
        up.items.append(item)
        up.heard_us = now_us
        if up.wanted <= up.last:
            self._ask(up, now_us)
        else:
            self._finish(up)

    def ack(self, sender: Sender, message: Message, now_us: int) -> None:
        """MISSION_ACK: the end of a download needs no answer; of an upload, the client gives up."""
        up = self._upload
        cancelled = message.type != _m.MAV_MISSION_ACCEPTED
        if up is not None and up.sender == sender and message.mission_type == up.kind.value and cancelled:
            self._upload = None

    def clear_all(self, sender: Sender, message: Message, now_us: int) -> None:
        """MISSION_CLEAR_ALL: one kind, or all."""
        kind = kind_of(message)
        if kind is None and message.mission_type != _ALL:
            self._refuse(sender, message.mission_type, Flaw(_m.MAV_MISSION_UNSUPPORTED, "no such kind of plan"))
        elif self._busy(sender):
            self._refuse(sender, message.mission_type, Flaw(_m.MAV_MISSION_DENIED, "another client is uploading"))
        else:
            self._upload = None
            for each in Kind if kind is None else (kind,):
                self._store.replace(each, ())
            self._accept(sender, message.mission_type)

    def step(self, now_us: int) -> None:
        """Ask again or give up, and tell of progress."""
        if now_us % SECOND_US == 0:
            self._reached_told = 0
        reached = self._runner.reached_count
        if reached != self._reached and self._reached_told < MOST_REACHED:
            self._reached = reached
            self._reached_told += 1
            message = self.mission_item_reached()
            if message is not None:
                self._outbox.everywhere(message)
        if now_us % LOOK_US:
            return
        up = self._upload
        if up is not None:
            if now_us - up.heard_us >= self.habits.give_up_us:
                self._upload = None
                flaw = Flaw(_m.MAV_MISSION_OPERATION_CANCELLED, f"upload timed out at item {up.wanted}")
                self._refuse(up.sender, up.kind.value, flaw)
            elif now_us - up.asked_us >= self.habits.retry_us:
                self._ask(up, now_us)
        if self._told is None:
            self._told = self._progress  # the streams tell the first
        elif self._progress != self._told:
            self._tell_progress()

    def _busy(self, sender: Sender) -> bool:
        return self._upload is not None and self._upload.sender != sender

    def _begin(self, up: _Upload, now_us: int) -> None:
        self._upload, self._finished = up, None
        up.heard_us = now_us
        self._ask(up, now_us)

    def _ask(self, up: _Upload, now_us: int) -> None:
        up.asked_us = now_us
        build = _m.MAVLink_mission_request_int_message if self.habits.ask_int else _m.MAVLink_mission_request_message
        to = up.sender
        self._outbox.answer(to, build(to.system_id, to.component_id, up.wanted, up.kind.value))

    def _finish(self, up: _Upload) -> None:
        self._upload = None
        old = self._items(up.kind)
        whole: Sequence[PlanItem] = up.items
        if up.partial:
            whole = (*old[: up.first], *up.items, *old[up.last + 1 :])
        first = 1 if self.habits.home_first and up.kind is Kind.MISSION else 0
        whole = renumbered(whole[first:], -first)
        flaw = plan_flaw(up.kind, whole, first)
        if flaw is not None:
            self._refuse(up.sender, up.kind.value, flaw)
            return
        self._store.replace(up.kind, whole)
        self._finished = (up.sender, up.kind.value, up.last)
        self._accept(up.sender, up.kind.value)
        unfit = self._supervisor.why_mission_unfit()
        if unfit is not None and up.kind is not Kind.RALLY:
            self._say(up.sender, f"Mission not possible: {unfit.value}")

    def _accept(self, sender: Sender, kind: int) -> None:
        self._answer(sender, kind, _m.MAV_MISSION_ACCEPTED)

    def _refuse(self, sender: Sender, kind: int, flaw: Flaw) -> None:
        self._answer(sender, kind, flaw.result)
        self._say(sender, f"Plan refused: {flaw.reason}")

    def _answer(self, sender: Sender, kind: int, result: int) -> None:
        self._outbox.answer(sender, _m.MAVLink_mission_ack_message(sender.system_id, sender.component_id, result, kind))

    # Progress

    @property
    def _sequence(self) -> int:
        """The current item as clients count."""
        return self._runner.current + (1 if self.habits.home_first else 0)

    def set_current(self, sender: Sender, message: Message, now_us: int) -> None:
        """MISSION_SET_CURRENT: answered by MISSION_CURRENT to all."""
        reason = self.jump(message.seq)
        if reason is not None:
            self._refuse(sender, Kind.MISSION.value, Flaw(_m.MAV_MISSION_INVALID_SEQUENCE, reason))

    @property
    def _progress(self) -> object:
        return self._runner.current, self._runner.state, self._store.mission

    def _tell_progress(self) -> None:
        self._told = self._progress
        self._outbox.everywhere(self.mission_current())

    def why_not_current(self, sequence: int) -> str | None:
        """Why an item, as clients count, cannot be the current one; None when it can."""
        return None if 0 <= self._index(sequence) < len(self._store.mission) else f"there is no item {sequence}"

    def _index(self, sequence: int) -> int:
        return max(sequence - 1, 0) if self.habits.home_first else sequence

    def jump(self, sequence: int) -> str | None:
        """Make an item, as clients count, the current one; None or the reason why not."""
        reason = self.why_not_current(sequence)
        if reason is not None:
            return reason
        self._runner.set_current(self._index(sequence))
        self._tell_progress()
        return None

    def mission_current(self) -> Message:
        """Where the mission is. Item 0 of 0 when there is none."""
        active = self._supervisor.mode is Mode.MISSION
        mode = 0 if not self._store.mission else 1 if active else 2
        return _m.MAVLink_mission_current_message(
            self._sequence if self._store.mission else 0, len(self._store.mission), self._runner.state.value, mode
        )

    def mission_item_reached(self) -> Message | None:
        """The newest item that was reached; None before the first."""
        reached = self._runner.reached
        if reached is None:
            return None
        return _m.MAVLink_mission_item_reached_message(reached + (1 if self.habits.home_first else 0))
