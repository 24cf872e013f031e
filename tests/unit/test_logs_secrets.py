"""Keys of signing are not in recordings, neither raw nor decoded."""

from pathlib import Path

import pytest
from logs_traffic import heartbeat, record

from logs import Recording, schema, ticks
from logs.recorder import Recorder
from logs.secrets import masked
from logs.table import inputs_digest
from logs.wire_replay import vehicle_traffic
from wire.datagram import Datagram
from wire.dialect import mavlink
from wire.framing import Framer

KEY = bytes(range(100, 132))


def setup_signing(key: bytes = KEY, sequence: int = 0) -> bytes:
    mav = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
    mav.seq = sequence
    return bytes(mavlink.MAVLink_setup_signing_message(1, 1, list(key), 123_456_789).pack(mav))


def test_the_key_is_in_no_byte_of_the_file_and_the_packet_is_still_one(tmp_path: Path) -> None:
    sent = [setup_signing(), heartbeat() + setup_signing(), setup_signing()[:40], b"\xfd" + setup_signing()]
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for tick, data in enumerate(sent):
            now_us = (tick + 1) * 20_000
            at = {"log_time_ns": now_us * 1000, "now_us": now_us, "tick": tick}
            recorder.datagram("gcs", "rx", data, **at)
            entry = Datagram("gcs", data)
            record(recorder, schema.Tick(now_us, 1, 1, inputs_digest([entry])), now_us, tick)
            recorder.datagram("autopilot", "tx", data, **at)
    assert recorder.counters.masked == 8
    recording = Recording.open(path)
    assert recording.metadata["recorder"]["masked_keys"] == "8"
    for message in recording.messages():
        for first in range(len(KEY) - 3):
            assert KEY[first : first + 4] not in message.data
    raw = [m.data for m in recording.messages(["/mavlink/raw/autopilot/tx"])]
    assert list(map(len, raw)) == list(map(len, sent))
    framer = Framer()
    assert [packet.message_id for data in raw for packet in framer.packets(data)] == [256, 0, 256, 256]
    decoded = [recording.decode(m) for m in recording.messages(["/mavlink/255/190/SETUP_SIGNING"])]
    assert decoded
    assert all(m.secret_key == bytes(32) and m.initial_timestamp == 123_456_789 for m in decoded)
    # what a re-run is fed has the digest that the flight took of what it was given
    for row in ticks(recording):
        assert row.declared is not None
        assert inputs_digest([entry for _, entry in row.inputs]) == row.declared.inputs_crc32


def test_a_masked_packet_is_never_replayed_to_anybody(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for tick, data in enumerate([heartbeat(), setup_signing(), heartbeat(sequence=1), setup_signing()[:30]]):
            recorder.datagram("autopilot", "rx", data, log_time_ns=tick, now_us=tick, tick=tick)
    replayed = [message.data for message in vehicle_traffic(Recording.open(path), "autopilot")]
    assert replayed == [heartbeat(), heartbeat(sequence=1)]


@pytest.mark.parametrize("cut", range(11, 66))
def test_a_packet_cut_off_anywhere_gives_nothing_of_its_key(cut: int) -> None:
    data = masked(setup_signing()[:cut])
    assert len(data) == min(cut, len(setup_signing()))
    assert not any(byte in data[20:52] for byte in KEY)


def test_a_key_that_ends_in_zeros_which_the_packet_leaves_out_is_masked_too() -> None:
    data = masked(setup_signing(KEY[:5] + bytes(27)))
    assert KEY[:2] not in data
    assert [packet.message_id for packet in Framer().packets(data)] == [256]


def test_other_traffic_is_the_same_object() -> None:
    for data in (heartbeat(), b"", b"\xfd\x00\x01\x00", bytes(300), b"\x00\x01\x00" * 50):
        assert masked(data) is data


def test_a_damaged_packet_stays_a_damaged_one() -> None:
    data = bytearray(setup_signing())
    data[-1] ^= 0xFF
    assert Framer().packets(masked(bytes(data))) == []
    assert KEY[:4] not in masked(bytes(data))
