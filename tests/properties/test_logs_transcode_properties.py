"""Transcoded packets, judged by pymavlink's decoder and by google.protobuf's parser: no code shared with ours."""

import math
import struct
from functools import cache
from typing import Any

import pytest
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.unknown_fields import UnknownFieldSet
from hypothesis import given, settings
from hypothesis import strategies as st

from logs.transcode import transcoder
from wire.dialect import mavlink

MESSAGE_IDS = sorted(mavlink.mavlink_map)


@cache
def message_class(message_id: int) -> type[Any]:
    encode = transcoder(message_id)
    assert encode is not None
    pool = descriptor_pool.DescriptorPool()
    for file in descriptor_pb2.FileDescriptorSet.FromString(encode.descriptor_set).file:
        pool.Add(file)
    kind: type[Any] = message_factory.GetMessageClass(pool.FindMessageTypeByName(encode.schema_name))
    return kind


def expected(message_id: int, payload: bytes) -> dict[str, Any]:
    """Field values by the generated definition alone: its struct, its array lengths, its order."""
    definition = mavlink.mavlink_map[message_id]
    full = payload.ljust(definition.unpacker.size, b"\0")[: definition.unpacker.size]
    flat = list(definition.unpacker.unpack(full))
    types = dict(zip(definition.fieldnames, definition.fieldtypes, strict=True))
    values: dict[str, Any] = {}
    for name, length in zip(definition.ordered_fieldnames, definition.array_lengths, strict=True):
        if types[name] == "char":
            text = flat.pop(0)
            values[name] = text.split(b"\0")[0].decode("utf-8", "replace")
        elif length and types[name] == "uint8_t":
            octets = flat.pop(0) if isinstance(flat[0], bytes) else bytes(flat.pop(0) for _ in range(length))
            values[name] = octets
        elif length:
            values[name] = [flat.pop(0) for _ in range(length)]
        else:
            values[name] = flat.pop(0)
    assert not flat
    return values


def same(left: Any, right: Any) -> bool:
    if isinstance(left, list):
        return len(left) == len(right) and all(same(*pair) for pair in zip(left, right, strict=True))
    if isinstance(left, float) and math.isnan(left):
        return math.isnan(right)
    return bool(left == right)


def check(message_id: int, payload: bytes) -> None:
    encode = transcoder(message_id)
    assert encode is not None
    parsed = message_class(message_id)()
    parsed.ParseFromString(encode(payload))
    assert len(UnknownFieldSet(parsed)) == 0
    for name, value in expected(message_id, payload).items():
        found = getattr(parsed, name)
        found = list(found) if isinstance(value, list) else found
        assert same(value, found), (encode.name, name, value, found)


@pytest.mark.parametrize("fill", [0x00, 0x41, 0x7F, 0xFF])
def test_every_message_of_the_dialect_is_transcoded_field_by_field(fill: int) -> None:
    for message_id in MESSAGE_IDS:
        size = mavlink.mavlink_map[message_id].unpacker.size
        check(message_id, bytes((fill + at * (fill not in (0, 0xFF))) & 0xFF for at in range(size)))


@settings(max_examples=300)
@given(st.sampled_from(MESSAGE_IDS), st.binary(max_size=260))
def test_any_payload_of_any_length_is_what_pymavlink_reads_from_it(message_id: int, payload: bytes) -> None:
    check(message_id, payload)


def test_pymavlinks_own_decoder_agrees_on_a_message_with_extensions_and_arrays() -> None:
    sent = mavlink.MAVLink_battery_status_message(
        1, 2, 3, 2500, list(range(4000, 4010)), -150, 100, 200, 87, time_remaining=55, voltages_ext=[1, 2, 3, 4]
    )
    mav = mavlink.MAVLink(None)
    raw = bytes(sent.pack(mav))
    read = mav.decode(bytearray(raw))
    encode = transcoder(147)
    assert encode is not None
    parsed = message_class(147)()
    parsed.ParseFromString(encode(raw[10:-2]))
    for name in read.get_fieldnames():
        found = getattr(parsed, name)
        assert (list(found) if isinstance(getattr(read, name), list) else found) == getattr(read, name)


def test_a_signalling_nan_keeps_its_bits() -> None:
    payload = struct.pack("<I", 0x7FA00001) * 7
    encode = transcoder(30)
    assert encode is not None
    assert encode(payload).count(struct.pack("<I", 0x7FA00001)) == 7


def test_a_text_that_is_no_utf_8_still_parses() -> None:
    encode = transcoder(253)
    assert encode is not None
    parsed = message_class(253)()
    parsed.ParseFromString(encode(b"\x06caf\xe9\0rubbish"))
    assert parsed.text == "caf�"


def test_a_message_nobody_knows_has_no_transcoder() -> None:
    assert transcoder(0xFFFFFF) is None
