"""Two runs of the same core, output by output: where they first differ, and in what.

Outputs are paired by tick, channel and place within those: one extra datagram in tick 7 is one extra output, not a
shift of all that follow. Bytes decide. Where they differ and are MAVLink packets or records of ours, the message and
its fields are named; otherwise the first differing byte is.
"""

import hashlib
import struct
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from itertools import zip_longest
from typing import Any

from logs import schema
from wire.dialect import mavlink
from wire.framing import Framer

_TICK_AND_LENGTH = struct.Struct("<IH")
_LENGTH = struct.Struct("<I")


@dataclass(frozen=True, slots=True)
class Output:
    """One output of a core.

    Attributes
    ----------
    tick : index of the tick that gave it.
    channel : the link's name for a datagram; for a record its full schema name (``companion.Note``).
    data : the datagram, or the record's bytes.
    """

    tick: int
    channel: str
    data: bytes


@dataclass(frozen=True, slots=True)
class Difference:
    """Where recorded and produced part.

    Attributes
    ----------
    tick, channel : where.
    recorded, produced : the two outputs; None where one side has none.
    kinds : what differs: ``NAME.field`` for each differing field, or one word on the whole output.
    text : the same for people, in one line, with the values.
    values : recorded and produced value of each kind that is a field.
    """

    tick: int
    channel: str
    recorded: Output | None
    produced: Output | None
    kinds: tuple[str, ...]
    text: str
    values: Mapping[str, tuple[Any, Any]] = field(default_factory=dict)


@dataclass(slots=True)
class Change:
    """All differences of one kind.

    Attributes
    ----------
    kind : as in `Difference.kinds`.
    count : pairs of outputs that differ so.
    tick : of the first of them.
    recorded, produced : the field's values there; None where the kind is no field.
    largest : greatest difference of two numbers, over all pairs and elements; None where they are no numbers.
    largest_tick : where that is.
    """

    kind: str
    count: int
    tick: int
    recorded: Any = None
    produced: Any = None
    largest: float | None = None
    largest_tick: int | None = None

    def add(self, tick: int, recorded: Any, produced: Any) -> None:
        """One pair more."""
        self.count += 1
        apart = _apart(recorded, produced)
        if apart is not None and (self.largest is None or apart > self.largest):
            self.largest, self.largest_tick = apart, tick


@dataclass(frozen=True, slots=True)
class Comparison:
    """The outcome of comparing two runs.

    Attributes
    ----------
    outputs : pairs looked at; equal : those that are the same to the byte.
    first : the first difference, None if there is none.
    kinds : how many pairs differ in each kind (see `Difference.kinds`).
    changes : the same in more words, in the same order: most first.
    """

    outputs: int
    equal: int
    first: Difference | None
    kinds: Mapping[str, int] = field(default_factory=dict)
    changes: tuple[Change, ...] = ()


def compare(recorded: Iterable[Output], produced: Iterable[Output]) -> Comparison:
    """Compare two runs.

    Parameters
    ----------
    recorded, produced : outputs in the order they came, ticks not decreasing.
    """
    outputs = equal = 0
    first: Difference | None = None
    changes: dict[str, Change] = {}
    for left, right in _paired(recorded, produced):
        outputs += 1
        if left is not None and right is not None and left.data == right.data:
            equal += 1
            continue
        difference = _difference(left, right)
        for kind in difference.kinds:
            values = difference.values.get(kind, (None, None))
            changes.setdefault(kind, Change(kind, 0, difference.tick, *values)).add(difference.tick, *values)
        if first is None:
            first = difference
    most = sorted(changes.values(), key=lambda change: -change.count)
    return Comparison(outputs, equal, first, {change.kind: change.count for change in most}, tuple(most))


def first_difference(recorded: Iterable[Output], produced: Iterable[Output]) -> Difference | None:
    """The first difference of two runs, looked for no further than needed; None if they are the same."""
    for left, right in _paired(recorded, produced):
        if left is None or right is None or left.data != right.data:
            return _difference(left, right)
    return None


class OutputHash:
    """One number for all outputs of a run.

    SHA-256 over, for every output in order: tick (uint32), length of the channel's name (uint16), the name (UTF-8),
    length of the data (uint32), the data; integers little-endian. Order, ticks and links count; times and peers do not.
    """

    def __init__(self) -> None:
        self._digest = hashlib.sha256()

    def add(self, output: Output) -> None:
        """Take one output more."""
        name = output.channel.encode()
        head = _TICK_AND_LENGTH.pack(output.tick & 0xFFFFFFFF, len(name))
        self._digest.update(head + name + _LENGTH.pack(len(output.data)) + output.data)

    def hexdigest(self) -> str:
        """The hash of what was added so far, in hexadecimal."""
        return self._digest.hexdigest()


def outputs_sha256(outputs: Iterable[Output]) -> str:
    """`OutputHash` of all outputs of a run, in hexadecimal."""
    total = OutputHash()
    for output in outputs:
        total.add(output)
    return total.hexdigest()


def _paired(recorded: Iterable[Output], produced: Iterable[Output]) -> Iterator[tuple[Output | None, Output | None]]:
    """Pair by tick, then channel (in order of appearance), then place."""
    left, right = _by_tick(recorded), _by_tick(produced)
    one, other = next(left, None), next(right, None)
    while one is not None or other is not None:
        tick = min(group[0].tick for group in (one, other) if group is not None)
        ours = one if one is not None and one[0].tick == tick else []
        theirs = other if other is not None and other[0].tick == tick else []
        for channel in dict.fromkeys(output.channel for output in (*ours, *theirs)):
            yield from zip_longest(
                (output for output in ours if output.channel == channel),
                (output for output in theirs if output.channel == channel),
            )
        if ours:
            one = next(left, None)
        if theirs:
            other = next(right, None)


def _by_tick(outputs: Iterable[Output]) -> Iterator[list[Output]]:
    """Runs of outputs with the same tick."""
    group: list[Output] = []
    for output in outputs:
        if group and output.tick != group[0].tick:
            yield group
            group = []
        group.append(output)
    if group:
        yield group


def _difference(recorded: Output | None, produced: Output | None) -> Difference:
    """Say in what two paired outputs differ."""
    if recorded is None or produced is None:
        present = recorded or produced
        assert present is not None
        side, other = ("recorded", "produced") if recorded is not None else ("produced", "recorded")
        name = _name(present)
        kinds: tuple[str, ...] = (f"{name} only {side}",)
        text = f"{name} was {side}, and not {other}"
        values: dict[str, tuple[Any, Any]] = {}
    else:
        present = recorded
        kinds, text, values = _differing(recorded, produced)
    return Difference(
        tick=present.tick,
        channel=present.channel,
        recorded=recorded,
        produced=produced,
        kinds=kinds,
        text=f"tick {present.tick}, {present.channel}: {text}",
        values=values,
    )


def _differing(recorded: Output, produced: Output) -> tuple[tuple[str, ...], str, dict[str, tuple[Any, Any]]]:
    """Name the fields that differ, with their values, or the first byte."""
    one, other = _parts(recorded), _parts(produced)
    names = [name for name, _ in one]
    if names and names == [name for name, _ in other]:
        found = [
            (f"{name}.{key}", value, other_values[key])
            for (name, values), (_, other_values) in zip(one, other, strict=True)
            for key, value in values.items()
            if not _same(value, other_values[key])
        ]
        if found:
            shown = ", ".join(f"{key} recorded {left!r}, produced {right!r}" for key, left, right in found[:4])
            more = f", and {len(found) - 4} fields more" if len(found) > 4 else ""
            values = {key: (left, right) for key, left, right in found}
            return tuple(values), shown + more, values
    elif names and other:
        left, right = "+".join(names), "+".join(name for name, _ in other)
        return (f"{left} became {right}",), f"recorded {left}, produced {right}", {}
    offset = next(
        (at for at, pair in enumerate(zip(recorded.data, produced.data, strict=False)) if pair[0] != pair[1]),
        min(len(recorded.data), len(produced.data)),
    )
    sizes = f"{len(recorded.data)} and {len(produced.data)} bytes"
    return (f"{_name(recorded)} bytes",), f"{_name(recorded)} differs from byte {offset} on ({sizes})", {}


def _name(output: Output) -> str:
    """What an output is, in a word or two."""
    return "+".join(name for name, _ in _parts(output)) or "datagram"


def _parts(output: Output) -> list[tuple[str, dict[str, Any]]]:
    """The messages in an output: name, and every field with its value; headers count as fields."""
    kind = schema.kind_of(output.channel)
    if kind is not None:
        try:
            record = schema.decode(kind, output.data)
        except ValueError:
            return []
        return [(kind.__name__, {entry.name: getattr(record, entry.name) for entry in fields(record)})]
    parts: list[tuple[str, dict[str, Any]]] = []
    decoder = mavlink.MAVLink(None)
    for packet in Framer().packets(output.data):
        values: dict[str, Any] = {
            "sequence": packet.sequence,
            "system_id": packet.system_id,
            "component_id": packet.component_id,
        }
        if packet.message_id in mavlink.mavlink_map:
            message = decoder.decode(bytearray(packet.raw))
            name = str(message.get_type())
            values |= {key: getattr(message, key) for key in message.get_fieldnames()}
        else:
            name = f"message {packet.message_id}"
            values["payload"] = packet.payload.hex()
        parts.append((name, values))
    return parts


def _apart(left: Any, right: Any) -> float | None:
    """The greatest difference of two numbers, or of numbers in equally long lists; None where there is none."""
    if isinstance(left, list | tuple) and isinstance(right, list | tuple):
        found = [_apart(*pair) for pair in zip(left, right, strict=False)] if len(left) == len(right) else []
        return max((apart for apart in found if apart is not None), default=None)
    if isinstance(left, int | float) and isinstance(right, int | float):
        apart = abs(float(left) - float(right))
        return apart if apart == apart else None
    return None


def _same(left: Any, right: Any) -> bool:
    """Equal, or both NaN, element by element."""
    if isinstance(left, list | tuple) and isinstance(right, list | tuple):
        return len(left) == len(right) and all(_same(*pair) for pair in zip(left, right, strict=True))
    return bool(left == right) or bool(left != left and right != right)
