"""Whatever arrives, the framer neither raises nor loses count, and finds what is whole."""

from hypothesis import given
from hypothesis import strategies as st

from wire import Framer
from wire.dialect import mavlink

START_BYTES = (0xFE, 0xFD)
_messages = [
    mavlink.MAVLink_heartbeat_message(2, 12, 0x9D, 0x60000, 4, 3),
    mavlink.MAVLink_attitude_message(1000, 0.1, -0.2, 0.3, 0.0, 0.0, 0.0),
    mavlink.MAVLink_statustext_message(6, b"Armed", 0, 0),
    mavlink.MAVLink_timesync_message(1, 2),
]


def _encode(which: int, sequence: int, version_1: bool) -> bytes:
    """pymavlink's own encoding, so that no code is shared with the framer."""
    mav = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    mav.seq = sequence
    return bytes(_messages[which].pack(mav, force_mavlink1=version_1))


packets = st.builds(_encode, st.integers(0, len(_messages) - 1), st.integers(0, 255), st.booleans())
quiet_noise = st.binary(max_size=30).map(lambda data: bytes(byte for byte in data if byte not in START_BYTES))
# Noise made to hurt: start bytes, small lengths, known ids.
nasty = st.lists(st.sampled_from([0xFE, 0xFD, 0, 1, 2, 9, 30, 253, 255]), max_size=60).map(bytes)
anything = st.one_of(st.binary(max_size=400), nasty, packets)


@given(st.lists(anything, max_size=6).map(b"".join))
def test_any_bytes_are_framed_without_an_error_and_every_byte_is_accounted_for(data: bytes) -> None:
    framer = Framer()
    found = framer.packets(data)
    counters = framer.counters
    framed = sum(len(packet.raw) for packet in found)
    assert counters.packets == len(found)
    assert framed + counters.garbage_bytes <= len(data)
    if not counters.incompatible:
        assert framed + counters.garbage_bytes == len(data)
    position = 0
    for packet in found:
        position = data.index(packet.raw, position) + len(packet.raw)


@given(st.lists(st.tuples(quiet_noise, packets), max_size=6), quiet_noise)
def test_packets_between_noise_without_start_bytes_are_all_found(parts: list[tuple[bytes, bytes]], tail: bytes) -> None:
    framer = Framer()
    data = b"".join(noise + packet for noise, packet in parts) + tail
    assert [packet.raw for packet in framer.packets(data)] == [packet for _, packet in parts]
    assert framer.counters.garbage_bytes == sum(len(noise) for noise, _ in parts) + len(tail)


@given(packets, packets, st.data())
def test_a_datagram_cut_anywhere_leaves_the_next_one_whole(first: bytes, second: bytes, data: st.DataObject) -> None:
    cut = data.draw(st.integers(0, len(first) - 1))
    framer = Framer()
    framer.packets(first[:cut])
    framer.packets(first[cut:])
    assert [packet.raw for packet in framer.packets(second)] == [second]


@given(st.lists(anything, max_size=5))
def test_two_framers_fed_the_same_datagrams_agree_in_everything(datagrams: list[bytes]) -> None:
    one, other = Framer(), Framer()
    assert [one.packets(data) for data in datagrams] == [other.packets(data) for data in datagrams]
    assert one.counters == other.counters
    assert one.senders == other.senders


@given(st.lists(packets, min_size=1, max_size=8).map(b"".join))
def test_our_framing_of_clean_streams_is_that_of_pymavlink(data: bytes) -> None:
    reference = mavlink.MAVLink(None)
    expected = [(m.get_msgId(), m.get_seq(), bytes(m.get_msgbuf())) for m in reference.parse_buffer(data) or []]
    assert [(packet.message_id, packet.sequence, packet.raw) for packet in Framer().packets(data)] == expected
