"""The decoded messages of a recording as plain values: what exports, look-up and comparison read.

Any protobuf channel is a source, by the descriptor in the file: packets, our own records, mirrors, imported logs.

Values are as they were: 64-bit integers exact, NaN a NaN. A 32-bit float becomes the shortest decimal number that is
the same 32-bit float (0.1, not 0.10000000149011612). ``uint8[n]`` of MAVLink is a list of numbers.
"""

import math
import struct
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from google.protobuf.descriptor import Descriptor, FieldDescriptor

from logs.reader import RecordedMessage, Recording
from logs.transcode import PACKAGE

_FLOAT = struct.Struct("<f")


@dataclass(frozen=True, slots=True)
class Row:
    """One decoded message.

    Attributes
    ----------
    topic, name : such as ``/mavlink/1/1/ATTITUDE`` and ``ATTITUDE``.
    system, component : who sent it; None where it is no packet.
    log_time_ns, tick : as recorded.
    values : by field, in the order of the schema; nested messages are dictionaries, repeated fields lists.
    """

    topic: str
    name: str
    system: int | None
    component: int | None
    log_time_ns: int
    tick: int
    values: dict[str, Any]


def rows(recording: Recording, messages: Iterable[RecordedMessage]) -> Iterator[Row]:
    """Decode what can be decoded; raw datagrams are passed over.

    Raises
    ------
    RecordingError    The bytes of a message do not fit their own schema.
    """
    for message in messages:
        if message.channel.schema:
            yield row(recording, message)


def row(recording: Recording, message: RecordedMessage) -> Row:
    """One message, which has a schema, decoded."""
    name = message.channel.schema.rpartition(".")[2]
    system, component = sender(message.channel.topic)
    values = plain(recording.decode(message))
    return Row(message.channel.topic, name, system, component, message.log_time_ns, message.tick, values)


def sender(topic: str) -> tuple[int | None, int | None]:
    """System and component in the topic of a decoded packet; None, None in any other."""
    parts = topic.split("/")
    if len(parts) == 5 and parts[1] == "mavlink" and parts[2].isdecimal() and parts[3].isdecimal():
        return int(parts[2]), int(parts[3])
    return None, None


def plain(message: Any) -> dict[str, Any]:
    """The values of a protobuf message."""
    descriptor = message.DESCRIPTOR
    readers = _READERS.get(descriptor)
    if readers is None:
        readers = _READERS[descriptor] = _readers(descriptor)
    return {name: read(message) for name, read in readers}


def shortest(value: float) -> float:
    """The shortest decimal number that is the same 32-bit float as `value`."""
    if not math.isfinite(value):
        return value
    packed = _FLOAT.pack(value)
    for digits in (6, 7, 8):
        short = float(f"{value:.{digits}g}")
        try:
            if _FLOAT.pack(short) == packed:
                return short
        except OverflowError:  # the greatest of them, rounded up
            continue
    return float(f"{value:.9g}")


def flat(values: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Names and values with nested messages taken apart: ``pose.position.x``. Lists stay lists."""
    for name, value in values.items():
        if isinstance(value, dict):
            yield from flat(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value


_Reader = Callable[[Any], Any]
_READERS: dict[Any, list[tuple[str, _Reader]]] = {}


def nests(field: FieldDescriptor) -> bool:
    """Whether a field is a message that is taken apart: one, no list, and of no kind that can hold itself."""
    return field.message_type is not None and not field.is_repeated and not _holds_itself(field.message_type)


def _holds_itself(kind: Descriptor) -> bool:
    waiting, seen = [kind], set[str]()
    while waiting:
        for field in waiting.pop().fields:
            inner = field.message_type
            if inner is None or inner.full_name in seen:
                continue
            if inner.full_name == kind.full_name:
                return True
            seen.add(inner.full_name)
            waiting.append(inner)
    return False


def _readers(descriptor: Descriptor) -> list[tuple[str, _Reader]]:
    octets = descriptor.full_name.startswith(f"{PACKAGE}.")
    return [(field.name, _reader(field, octets)) for field in descriptor.fields]


def _reader(field: FieldDescriptor, octets: bool) -> _Reader:
    name, repeated, kind = field.name, field.is_repeated, field.message_type
    if kind is not None and kind.GetOptions().map_entry:
        return lambda message: [
            {"key": key, "value": _map_value(value)} for key, value in sorted(getattr(message, name).items())
        ]
    if kind is not None and repeated:
        return lambda message: [plain(item) for item in getattr(message, name)]
    if kind is not None and not nests(field):  # a list of one or none: however deep it goes, one column
        return lambda message: [plain(getattr(message, name))] if message.HasField(name) else []
    if kind is not None:
        absent = _absent(kind)
        return lambda message: plain(getattr(message, name)) if message.HasField(name) else absent
    if field.type == FieldDescriptor.TYPE_FLOAT:
        if repeated:
            return lambda message: [shortest(item) for item in getattr(message, name)]
        return lambda message: shortest(getattr(message, name))
    if repeated or (octets and field.type == FieldDescriptor.TYPE_BYTES):
        return lambda message: list(getattr(message, name))
    return lambda message: getattr(message, name)


def _map_value(value: Any) -> Any:
    return plain(value) if hasattr(value, "DESCRIPTOR") else value


def _absent(descriptor: Descriptor | None) -> dict[str, Any]:
    """A nested message that is not there: None for each of its fields, so that columns stay what they are."""
    fields = () if descriptor is None else descriptor.fields
    return {field.name: _absent(field.message_type) if nests(field) else None for field in fields}
