"""MAVLink payloads to protobuf bytes, without an object in between.

A MAVLink payload is a packed little-endian struct; a protobuf message is a run of (tag, value). With the fixed-width
wire types the values are little-endian structs too, so one `struct.unpack` and one `struct.pack` with the tags
in between do the whole job, about ten times faster than through message objects:

    MAVLink                     protobuf                    on the way
    uint8 uint16 uint32         fixed32                     widened
    int8 int16 int32            sfixed32                    widened
    uint64, int64               fixed64, sfixed64           as they are
    float, double               float, double               as they are, NaN payloads too
    T[n]                        repeated, packed            as above
    uint8[n]                    bytes, all n
    char, char[n]               string, cut at the first NUL; bytes that are no UTF-8 become U+FFFD

Field numbers are the order of the message's definition, MAVLink 2 extensions last; values stand in wire order, which
protobuf allows. Payloads cut short by MAVLink 2 are filled with zeros again, as the standard says.
"""

import struct
from dataclasses import dataclass
from functools import cache
from typing import Any

from google.protobuf import descriptor_pb2

from wire.dialect import mavlink

PACKAGE = "mavlink"

_Field = descriptor_pb2.FieldDescriptorProto


@dataclass(frozen=True, slots=True)
class _Scalar:
    """How one MAVLink type is unpacked, packed and declared."""

    size: int
    unpack: str
    pack: str
    wire_type: int
    type: "_Field.Type.ValueType"


# Types whose bytes do not change are moved as bytes ("4s"), which keeps even a signalling NaN.
_SCALARS = {
    "uint8_t": _Scalar(1, "B", "I", 5, _Field.TYPE_FIXED32),
    "uint16_t": _Scalar(2, "H", "I", 5, _Field.TYPE_FIXED32),
    "uint32_t": _Scalar(4, "4s", "4s", 5, _Field.TYPE_FIXED32),
    "int8_t": _Scalar(1, "b", "i", 5, _Field.TYPE_SFIXED32),
    "int16_t": _Scalar(2, "h", "i", 5, _Field.TYPE_SFIXED32),
    "int32_t": _Scalar(4, "4s", "4s", 5, _Field.TYPE_SFIXED32),
    "uint64_t": _Scalar(8, "8s", "8s", 1, _Field.TYPE_FIXED64),
    "int64_t": _Scalar(8, "8s", "8s", 1, _Field.TYPE_SFIXED64),
    "float": _Scalar(4, "4s", "4s", 5, _Field.TYPE_FLOAT),
    "double": _Scalar(8, "8s", "8s", 1, _Field.TYPE_DOUBLE),
}
_LENGTH_DELIMITED = 2
_OCTETS = _Scalar(1, "s", "s", _LENGTH_DELIMITED, _Field.TYPE_BYTES)  # the elements of uint8[n]


class Transcoder:
    """Transcodes the payloads of one MAVLink message.

    Attributes
    ----------
    name : the message's name, such as ``ATTITUDE``.
    schema_name : full protobuf name, such as ``mavlink.ATTITUDE``.
    descriptor_set : serialized FileDescriptorSet that declares it.
    """

    def __init__(self, definition: Any) -> None:
        self.name: str = definition.msgname
        self.schema_name = f"{PACKAGE}.{self.name}"
        file = descriptor_pb2.FileDescriptorProto(name=f"{PACKAGE}/{self.name}.proto", package=PACKAGE, syntax="proto3")
        declaration = file.message_type.add(name=self.name)
        unpack, pack = ["<"], ["<"]
        slots: list[Any] = []  # prefix, value, prefix, value ... : one prefix (perhaps empty) before every value
        texts: list[tuple[bytes, int, int]] = []  # tag, first byte and length of every text in the payload
        offset = 0
        numbers = {name: number for number, name in enumerate(definition.fieldnames, start=1)}
        types = dict(zip(definition.fieldnames, definition.fieldtypes, strict=True))
        declared: dict[int, tuple[str, _Field.Type.ValueType, bool]] = {}
        # pymavlink keeps array_lengths in wire order; fieldnames and fieldtypes in the order of the definition.
        for name, length in zip(definition.ordered_fieldnames, definition.array_lengths, strict=True):
            number = numbers[name]
            if types[name] == "char":
                count = length or 1
                texts.append((_varint(number << 3 | _LENGTH_DELIMITED), offset, count))
                unpack.append(f"{count}x")
                offset += count
                declared[number] = (name, _Field.TYPE_STRING, False)
                continue
            scalar = _OCTETS if types[name] == "uint8_t" and length else _SCALARS[types[name]]
            if length:
                packed = struct.calcsize("<" + scalar.pack) * length
                prefix = _varint(number << 3 | _LENGTH_DELIMITED) + _varint(packed)
            else:
                prefix = _varint(number << 3 | scalar.wire_type)
            if scalar.unpack == scalar.pack:  # nothing is widened: the whole array moves in one piece
                piece = f"{scalar.size * (length or 1)}s"
                unpack.append(piece)
                pack.append(f"{len(prefix)}s{piece}")
                slots += (prefix, None)
            else:
                for index in range(length or 1):
                    before = b"" if index else prefix
                    unpack.append(scalar.unpack)
                    pack.append(f"{len(before)}s{scalar.pack}")
                    slots += (before, None)
            offset += scalar.size * (length or 1)
            declared[number] = (name, scalar.type, bool(length) and scalar is not _OCTETS)
        for number, (name, type_, repeated) in sorted(declared.items()):
            label = _Field.LABEL_REPEATED if repeated else _Field.LABEL_OPTIONAL
            declaration.field.add(name=name, number=number, type=type_, label=label)
        self.descriptor_set: bytes = descriptor_pb2.FileDescriptorSet(file=[file]).SerializeToString(deterministic=True)
        self._size = offset
        self._unpack = struct.Struct("".join(unpack)).unpack
        self._pack = struct.Struct("".join(pack)).pack
        self._slots = slots
        self._texts = texts

    def __call__(self, payload: bytes) -> bytes:
        """Protobuf bytes of a payload of any length: short ones are filled with zeros, longer ones cut."""
        size = self._size
        if len(payload) != size:
            payload = payload.ljust(size, b"\0")[:size]
        slots = self._slots.copy()
        slots[1::2] = self._unpack(payload)
        data = self._pack(*slots)
        for tag, first, count in self._texts:
            text = payload[first : first + count].partition(b"\0")[0]
            if not text.isascii():
                text = text.decode("utf-8", "replace").encode()
            data += tag + _varint(len(text)) + text
        return data


@cache
def transcoder(message_id: int) -> Transcoder | None:
    """The transcoder of a message of the dialect, built on first use; None if the dialect does not know it."""
    definition = mavlink.mavlink_map.get(message_id)
    return None if definition is None else Transcoder(definition)


def _varint(value: int) -> bytes:
    """Protobuf's base-128 integer."""
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    out.append(value)
    return bytes(out)
