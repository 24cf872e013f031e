"""Two recordings side by side: parameters, events, and where their messages part.

Decoded messages are paired by topic and place in it: the hundredth ATTITUDE of one with the hundredth of the other.
What they hold is compared, not when it was written; NaN equals NaN. Recordings of two flights in real time differ in
every time stamp: `ignore` and `tolerance` are for those.
"""

import struct
from collections import Counter, deque
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from difflib import SequenceMatcher
from math import isinf, isnan
from typing import Any

from logs.parameters import ATTACHMENT, Key, ToldParameters
from logs.reader import Recording
from logs.rows import Row, flat, row
from logs.selection import Selection, selected
from wire.dialect import mavlink

ALL = Selection()
MOST_EVENTS = 5_000
"""Of each recording; what comes after is not compared."""
_FLOAT = struct.Struct("<f")


@dataclass(frozen=True, slots=True)
class FieldDifference:
    """A field that differs: in how many pairs, by how much at most (None where it is no number), and first where."""

    topic: str
    name: str
    count: int
    largest: float | None
    first_ns: int
    left: Any
    right: Any


@dataclass(frozen=True, slots=True)
class EventDifference:
    """An event that one recording has and the other has not in its place; `side` is ``left`` or ``right``."""

    side: str
    time_ns: int
    text: str


@dataclass(frozen=True, slots=True)
class Diff:
    """How two recordings differ. Times are [ns] from the first message of each.

    Attributes
    ----------
    parameters : by (system, component, name), the last value of each, told or attached; None where one has none.
    events : in order.
    counts : messages by topic, where the numbers differ.
    fields : by topic and field, the earliest first.
    compared, equal : pairs of messages.
    """

    parameters: Mapping[Key, tuple[float | None, float | None]]
    events: tuple[EventDifference, ...]
    counts: Mapping[str, tuple[int, int]]
    fields: tuple[FieldDifference, ...]
    compared: int
    equal: int

    @property
    def same(self) -> bool:
        """Whether nothing differs."""
        return not (self.parameters or self.events or self.counts or self.fields)

    @property
    def first(self) -> FieldDifference | None:
        """The first field that differs."""
        return self.fields[0] if self.fields else None


def diff(
    left: Recording,
    right: Recording,
    wanted: Selection | None = None,
    *,
    ignore: Collection[str] = (),
    tolerance: float = 0.0,
) -> Diff:
    """Compare two recordings.

    Parameters
    ----------
    wanted : compare these messages only, and of parameters and events those in them.
    ignore : fields not compared, as ``time_boot_ms`` or ``ATTITUDE.time_boot_ms``.
    tolerance : numbers that differ by no more than this, absolutely or relative to the greater one, are the same.

    Raises
    ------
    RecordingError    As `Recording.messages` and `Recording.decode`.
    """
    wanted = wanted or ALL
    one, other = _Side(left, wanted), _Side(right, wanted)
    found = _Fields(frozenset(ignore), tolerance)
    both = one.counts.keys() & other.counts.keys()
    most = {topic: min(one.counts[topic], other.counts[topic]) for topic in both}
    for first, second in _pairs(one.rows(both), other.rows(both), most):
        found.pair(first, second)
    topics = sorted(one.counts.keys() | other.counts.keys())
    numbers = {topic: (one.counts[topic], other.counts[topic]) for topic in topics}
    return Diff(
        parameters={
            key: (one.parameters.get(key), other.parameters.get(key))
            for key in sorted(one.parameters.keys() | other.parameters.keys())
            if not _same(one.parameters.get(key), other.parameters.get(key), 0.0)
        },
        events=tuple(_events(one.events, other.events)),
        counts={topic: pair for topic, pair in numbers.items() if pair[0] != pair[1]},
        fields=tuple(sorted(found.told(), key=lambda item: item.first_ns)),
        compared=found.compared,
        equal=found.equal,
    )


class _Side:
    """One recording: counted, its parameters and events gathered, in one pass; its rows in a second."""

    def __init__(self, recording: Recording, wanted: Selection) -> None:
        self._recording, self._wanted = recording, wanted
        self.counts: Counter[str] = Counter()
        self.events: list[tuple[int, str]] = []
        self.start_ns = 0
        told, imported = ToldParameters(), dict[Key, float]()
        if attached := recording.attachments.get(ATTACHMENT) if wanted == ALL else None:
            told.read(attached.data)
        modes: dict[tuple[int | None, int | None], int] = {}
        for message in selected(recording.messages(), wanted):
            if not self.counts and not self.start_ns:
                self.start_ns = message.log_time_ns
            name = message.channel.schema.rpartition(".")[2]
            if not name:
                continue
            self.counts[message.channel.topic] += 1
            if name not in _EVENTS and name not in ("PARAM_VALUE", "HEARTBEAT", *_IMPORTED):
                continue
            item = row(recording, message)
            values = item.values
            if name == "PARAM_VALUE" and item.system is not None and item.component is not None:
                key = (item.system, item.component, values["param_id"])
                told.told(key, _FLOAT.pack(values["param_value"]), values["param_type"])
            elif name in _IMPORTED:
                key_field, value_field = _IMPORTED[name]
                imported[0, 0, values[key_field]] = values[value_field]
            elif name == "HEARTBEAT":
                if values["autopilot"] == mavlink.MAV_AUTOPILOT_PX4 and item.system is not None:
                    told.is_px4(item.system)
                sender = (item.system, item.component)
                mode = values["custom_mode"]
                if values["autopilot"] != mavlink.MAV_AUTOPILOT_INVALID and modes.get(sender) != mode:
                    modes[sender] = mode
                    self._event(item, f"mode of {item.system}/{item.component}: {mode}")
            else:
                self._event(item, _EVENTS[name].format(system=item.system, component=item.component, **values))
        self.parameters = told.values() | imported

    def rows(self, topics: Collection[str]) -> Iterator[Row]:
        for message in selected(self._recording.messages(), self._wanted):
            if message.channel.topic in topics and message.channel.schema:
                item = row(self._recording, message)
                yield Row(
                    item.topic,
                    item.name,
                    item.system,
                    item.component,
                    item.log_time_ns - self.start_ns,
                    item.tick,
                    item.values,
                )

    def _event(self, item: Row, text: str) -> None:
        if len(self.events) < MOST_EVENTS:
            self.events.append((item.log_time_ns - self.start_ns, text))


_EVENTS: dict[str, str] = {
    "STATUSTEXT": "{system}/{component} says: {text}",
    "COMMAND_ACK": "{system}/{component} answers command {command}: result {result}",
    "Note": "note: {text}",
    "OperatorCommand": "order: {name} {values}",
}
"""What counts as an event, and how it is told; and changes of mode."""
_IMPORTED = {"Parameter": ("name", "value"), "PARM": ("Name", "Value")}
"""Parameters in what was a .ulg or a .BIN; of no system there."""


def _pairs(one: Iterator[Row], other: Iterator[Row], most: Mapping[str, int]) -> Iterator[tuple[Row, Row]]:
    """Rows of the same topic and place in it, in the order in which the second of a pair comes.

    `most` are there by topic; what comes after finds no other and is not kept.
    """
    waiting: tuple[dict[str, deque[Row]], dict[str, deque[Row]]] = ({}, {})
    taken: tuple[Counter[str], Counter[str]] = (Counter(), Counter())
    sides = (one, other)
    ended = [False, False]
    while not all(ended):
        for side in (0, 1):
            item = next(sides[side], None)
            if item is None:
                ended[side] = True
                continue
            taken[side][item.topic] += 1
            if taken[side][item.topic] > most[item.topic]:
                continue
            theirs = waiting[1 - side].get(item.topic)
            if theirs:
                match = theirs.popleft()
                yield (item, match) if side == 0 else (match, item)
            elif not ended[1 - side]:
                waiting[side].setdefault(item.topic, deque()).append(item)


@dataclass(slots=True)
class _Found:
    count: int
    largest: float | None
    first_ns: int
    left: Any
    right: Any


@dataclass(slots=True)
class _Fields:
    """The fields that differ."""

    ignore: frozenset[str]
    tolerance: float
    compared: int = 0
    equal: int = 0
    found: dict[tuple[str, str], _Found] = field(default_factory=dict)

    def pair(self, left: Row, right: Row) -> None:
        self.compared += 1
        if left.values == right.values:
            self.equal += 1
            return
        one, other = dict(flat(left.values)), dict(flat(right.values))
        same = True
        for name in one.keys() | other.keys():
            if name in self.ignore or f"{left.name}.{name}" in self.ignore:
                continue
            a, b = one.get(name), other.get(name)
            if _same(a, b, self.tolerance):
                continue
            same = False
            apart = _apart(a, b)
            known = self.found.get((left.topic, name))
            if known is None:
                self.found[left.topic, name] = _Found(1, apart, left.log_time_ns, a, b)
                continue
            known.count += 1
            if apart is not None and (known.largest is None or apart > known.largest):
                known.largest = apart
            if left.log_time_ns < known.first_ns:
                known.first_ns, known.left, known.right = left.log_time_ns, a, b
        self.equal += same

    def told(self) -> Iterator[FieldDifference]:
        for (topic, name), item in sorted(self.found.items()):
            yield FieldDifference(topic, name, item.count, item.largest, item.first_ns, item.left, item.right)


def _same(left: Any, right: Any, tolerance: float) -> bool:
    if isinstance(left, list) and isinstance(right, list):
        return len(left) == len(right) and all(_same(a, b, tolerance) for a, b in zip(left, right, strict=True))
    if left == right:
        return True
    if not isinstance(left, int | float) or not isinstance(right, int | float):
        return False
    if isnan(left) and isnan(right):
        return True
    if isnan(left) or isnan(right) or isinf(left) or isinf(right):
        return False
    return abs(left - right) <= tolerance * max(1.0, abs(left), abs(right))


def _apart(left: Any, right: Any) -> float | None:
    """How far two numbers are apart, or the furthest of two lists; None where there is no saying."""
    if isinstance(left, list) and isinstance(right, list) and len(left) == len(right):
        each = [apart for a, b in zip(left, right, strict=True) if (apart := _apart(a, b)) is not None]
        return max(each, default=None)
    if isinstance(left, bool | str) or not isinstance(left, int | float) or not isinstance(right, int | float):
        return None
    distance = float(abs(left - right))
    return None if isnan(distance) or isinf(distance) else distance


def _events(one: list[tuple[int, str]], other: list[tuple[int, str]]) -> Iterator[EventDifference]:
    matcher = SequenceMatcher(None, [text for _, text in one], [text for _, text in other], autojunk=False)
    for kind, i, j, k, m in matcher.get_opcodes():
        if kind != "equal":
            yield from (EventDifference("left", time_ns, text) for time_ns, text in one[i:j])
            yield from (EventDifference("right", time_ns, text) for time_ns, text in other[k:m])
