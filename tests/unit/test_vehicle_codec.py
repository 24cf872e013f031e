"""The vehicle's encoder and decoder against pymavlink's own, over every message of the dialect."""

from typing import Any

import numpy as np
import pytest

from fakevehicle.codec import Encoder, Layout, decode
from wire.dialect import mavlink
from wire.framing import Framer

KINDS = [kind for _, kind in sorted(mavlink.mavlink_map.items())]


def example(kind: Any, seed: int) -> Any:
    """A message with arbitrary fields, made by pymavlink from a random payload."""
    rng = np.random.default_rng([seed, kind.id])
    raw = bytes(rng.integers(0, 128, kind.unpacker.size, dtype=np.uint8).tobytes())
    keep = rng.integers(0, len(raw) + 1)  # trailing zeros, so that cutting them is tried as well
    raw = raw[:keep].ljust(len(raw), b"\0")
    flat = kind.unpacker.unpack(raw)
    wire: list[Any] = []
    at = 0
    for length in kind.lengths:
        wire.append(flat[at] if length == 1 else list(flat[at : at + length]))
        at += length
    return kind(*[wire[i] for i in kind.orders])


@pytest.mark.parametrize("seed", [1, 2])
def test_every_message_is_packed_as_pymavlink_packs_it(seed: int) -> None:
    encoder = Encoder(7)
    reference = mavlink.MAVLink(None, srcSystem=7, srcComponent=1)
    for kind in KINDS:
        expected = example(kind, seed).pack(reference)
        reference.seq = (reference.seq + 1) % 256
        assert encoder.pack(example(kind, seed)) == expected, kind.msgname


def test_every_message_without_a_text_is_laid_out_as_pymavlink_packs_it() -> None:
    encoder = Encoder(7)
    reference = mavlink.MAVLink(None, srcSystem=7, srcComponent=1)
    for kind in KINDS:
        if "char" in kind.fieldtypes:
            continue
        message = example(kind, 5)
        expected = message.pack(reference)
        reference.seq = (reference.seq + 1) % 256
        flat: list[Any] = []
        for name in kind.ordered_fieldnames:
            value = getattr(message, name)
            flat += value if isinstance(value, list) else [value]
        assert encoder.pack(Layout(kind)(*flat)) == expected, kind.msgname


@pytest.mark.parametrize("seed", [3])
def test_every_message_is_decoded_as_pymavlink_decodes_it(seed: int) -> None:
    reference = mavlink.MAVLink(None, srcSystem=7, srcComponent=1)
    framer = Framer()
    for kind in KINDS:
        data = example(kind, seed).pack(reference)
        (packet,) = framer.packets(data)
        ours = decode(packet)
        theirs = reference.decode(bytearray(data))
        assert ours is not None
        for name in kind.fieldnames:
            a, b = getattr(ours, name), getattr(theirs, name)
            np.testing.assert_equal(list(a) if isinstance(a, tuple) else a, list(b) if isinstance(b, tuple) else b)


def test_mavlink1_is_understood_with_its_extensions_zero() -> None:
    reference = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
    message = mavlink.MAVLink_command_ack_message(400, 0)
    data = message.pack(reference, force_mavlink1=True)
    assert data[0] == 0xFE
    (packet,) = Framer().packets(data)
    ours = decode(packet)
    assert ours is not None
    assert (ours.command, ours.result, ours.target_system) == (400, 0, 0)


def test_an_unknown_message_is_none() -> None:
    (packet,) = Framer().packets(bytes.fromhex("fd 01 00 00 00 ff be ff ff ff 2a 00 00"))
    assert decode(packet) is None


def test_sequence_counts_every_packet_of_a_link_round_the_byte() -> None:
    encoder = Encoder(1)
    seen = [encoder.pack(mavlink.MAVLink_system_time_message(0, i))[4] for i in range(300)]
    assert seen == [i % 256 for i in range(300)]
