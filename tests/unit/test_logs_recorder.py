"""The recorder, judged by the plain `mcap` reader and its protobuf decoder."""

import errno
import os
import threading
from collections import Counter
from pathlib import Path

import pytest
from logs_traffic import PEER, captured, heartbeat, record, record_captured, sent_by_ground
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

from logs import Attachment, Direction, Recording, RecordingError, schema
from logs import recorder as recorder_module
from logs import settling as settling_module
from logs.container import Container
from logs.parts import Rotation
from logs.recorder import Recorder
from wire.dialect import mavlink

METADATA = {"run": {"version": "0.1.0", "seed": "7"}}
MISSION = Attachment("mission.yaml", "application/yaml", b"name: l_shape\n")


def recorded(path: Path, threaded: bool = False) -> Path:
    with Recorder(path, metadata=METADATA, attachments=[MISSION], threaded=threaded) as recorder:
        record_captured(recorder)
    return path


@pytest.mark.parametrize("threaded", [False, True])
def test_every_datagram_is_there_in_order_and_byte_for_byte(tmp_path: Path, threaded: bool) -> None:
    with recorded(tmp_path / "a.mcap", threaded).open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        raw: dict[str, list[bytes]] = {"rx": [], "tx": []}
        for _, channel, message in reader.iter_messages(log_time_order=False):
            if channel.topic.startswith("/mavlink/raw/"):
                assert (channel.message_encoding, channel.schema_id) == ("mavlink", 0)
                raw[channel.topic.rpartition("/")[2]].append(message.data)
    assert raw["rx"] == [packet for _, packet in captured() if not sent_by_ground(packet)]
    assert raw["tx"] == [packet for _, packet in captured() if sent_by_ground(packet)]


def test_every_decoded_channel_carries_its_descriptor_and_every_known_packet_is_decoded(tmp_path: Path) -> None:
    expected: Counter[str] = Counter()
    for _, packet in captured():
        definition = mavlink.mavlink_map.get(int.from_bytes(packet[7:10], "little"))
        if definition is not None:
            expected[f"/mavlink/{packet[5]}/{packet[6]}/{definition.msgname}"] += 1
    found: Counter[str] = Counter()
    with recorded(tmp_path / "a.mcap").open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        summary = reader.get_summary()
        assert summary is not None
        decoded = [
            channel.topic for channel in summary.channels.values() if not channel.topic.startswith("/mavlink/raw")
        ]
        for schema_, channel, _, message in reader.iter_decoded_messages(topics=decoded, log_time_order=False):
            assert schema_ is not None
            assert schema_.encoding == "protobuf"
            assert message.DESCRIPTOR.full_name == schema_.name
            found[channel.topic] += 1
    assert len(expected) > 30
    assert {topic: count for topic, count in found.items() if topic.startswith("/mavlink/")} == expected
    assert found["/companion/tick"] == 300


def test_a_decoded_packet_says_what_pymavlink_reads(tmp_path: Path) -> None:
    decoder = mavlink.MAVLink(None)
    attitudes = [decoder.decode(bytearray(p)) for _, p in captured() if p[7:10] == b"\x1e\x00\x00"]
    with recorded(tmp_path / "a.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        found = [m for *_, m in reader.iter_decoded_messages(topics="/mavlink/1/1/ATTITUDE", log_time_order=False)]
    assert [(m.time_boot_ms, m.roll, m.yawspeed) for m in found] == [
        (m.time_boot_ms, m.roll, m.yawspeed) for m in attitudes
    ]


def test_statistics_metadata_and_attachments_are_found_by_the_index_and_stand_first(tmp_path: Path) -> None:
    with recorded(tmp_path / "a.mcap").open("rb") as file:
        reader = make_reader(file)
        summary = reader.get_summary()
        assert summary is not None
        assert summary.statistics is not None
        assert summary.statistics.message_count == sum(1 for _ in reader.iter_messages())
        assert sum(summary.statistics.channel_message_counts.values()) == summary.statistics.message_count
        first_chunk = min(index.chunk_start_offset for index in summary.chunk_indexes)
        assert [index.name for index in summary.attachment_indexes] == ["mission.yaml"]
        assert all(index.offset < first_chunk for index in summary.attachment_indexes)
        metadata = {entry.name: entry.metadata for entry in reader.iter_metadata()}
        assert metadata["run"] == METADATA["run"]
        assert metadata["schema"]["version"] == str(schema.SCHEMA_VERSION)
        assert metadata["recorder"]["autopilot.rx.1.1.lost"] == "0"
        assert [(a.name, a.media_type, a.data) for a in reader.iter_attachments()] == [
            ("mission.yaml", "application/yaml", b"name: l_shape\n")
        ]


def test_time_and_tick_are_written_as_the_seam_says(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        recorder.datagram("autopilot", "rx", heartbeat(), log_time_ns=19_999_123, now_us=20_000, tick=5, peer=PEER)
        recorder.message("/companion/note", schema.Note(6, "", "x"), log_time_ns=20_000_456, now_us=20_000, tick=5)
    with path.open("rb") as file:
        found = [
            (channel.topic, message.log_time, message.publish_time, message.sequence)
            for _, channel, message in make_reader(file).iter_messages(log_time_order=False)
        ]
    assert found == [
        ("/mavlink/raw/autopilot/rx", 19_999_123, 20_000_000, 5),
        ("/mavlink/1/1/HEARTBEAT", 19_999_123, 20_000_000, 5),
        ("/companion/note", 20_000_456, 20_000_000, 5),
    ]


def test_the_same_calls_give_a_byte_identical_file(tmp_path: Path) -> None:
    assert recorded(tmp_path / "a.mcap").read_bytes() == recorded(tmp_path / "b.mcap").read_bytes()


def test_without_a_thread_the_file_is_flushed_by_log_time(tmp_path: Path) -> None:
    with recorded(tmp_path / "a.mcap").open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    spans = [(index.message_end_time - index.message_start_time) / 1e9 for index in summary.chunk_indexes]
    assert 13 <= len(spans) <= 16
    assert max(spans) < 0.5


CROSSED: tuple[tuple[str, Direction], ...] = (("autopilot", "rx"), ("gcs", "tx"), ("tablet", "tx"))


def test_a_packet_that_crosses_several_links_in_one_tick_is_decoded_once(tmp_path: Path) -> None:
    with Recorder(tmp_path / "a.mcap", metadata={}, threaded=False) as recorder:
        for tick in range(2):
            for link, direction in CROSSED:
                recorder.datagram(link, direction, heartbeat(), log_time_ns=tick, now_us=tick, tick=tick)
    counters = recorder.counters
    assert counters.decoded == 2
    assert (counters.rx, counters.tx) == ({"autopilot": 2}, {"gcs": 2, "tablet": 2})


def test_each_peer_of_a_link_has_its_own_channel(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for port in (14550, 14551):
            recorder.datagram("gcs", "rx", b"?", log_time_ns=1, now_us=1, tick=0, peer=("127.0.0.1", port))
        recorder.datagram("gcs", "tx", b"!", log_time_ns=1, now_us=1, tick=0)
    with path.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    assert [(c.topic, c.metadata.get("peer_port")) for c in summary.channels.values()] == [
        ("/mavlink/raw/gcs/rx", "14550"),
        ("/mavlink/raw/gcs/rx", "14551"),
        ("/mavlink/raw/gcs/tx", None),
    ]


def test_rubbish_is_kept_raw_and_not_decoded(tmp_path: Path) -> None:
    with Recorder(tmp_path / "a.mcap", metadata={}, threaded=False) as recorder:
        recorder.datagram("autopilot", "rx", b"\xfd\xff", log_time_ns=1, now_us=1, tick=0)
        recorder.datagram("autopilot", "rx", b"", log_time_ns=1, now_us=1, tick=0)
    assert recorder.counters.rx == {"autopilot": 2}
    assert recorder.counters.decoded == 0


def test_an_existing_file_is_never_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "precious.mcap"
    path.write_bytes(b"years of work")
    with pytest.raises(RecordingError, match=r"precious\.mcap: the file exists already"):
        Recorder(path, metadata={}, threaded=False)
    assert path.read_bytes() == b"years of work"


def test_a_folder_that_is_not_there_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="cannot make the file: No such file or directory"):
        Recorder(tmp_path / "missing" / "a.mcap", metadata={}, threaded=False)


def test_closing_twice_is_harmless_and_recording_after_it_is_our_own_mistake(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=True)
    recorder.close()
    recorder.close()
    with pytest.raises(ValueError, match="closed"):
        recorder.message("/companion/note", schema.Note(6, "", "late"), log_time_ns=0, now_us=0, tick=0)
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("recorder")]


class FullDisk:
    """An output that takes so many bytes and then says ENOSPC, in the middle of a write."""

    def __init__(self, room: int) -> None:
        self.data, self.room, self.at = bytearray(), room, 0

    def write(self, data: memoryview, /) -> int:
        left = self.room - self.at
        if left <= 0:
            raise OSError(errno.ENOSPC, "No space left on device")
        taken = min(left, len(data))
        self.data[self.at : self.at + taken] = data[:taken]
        self.at += taken
        return taken

    def truncate(self, size: int, /) -> int:
        del self.data[size:]
        return size

    def seek(self, offset: int, /) -> int:
        self.at = offset
        return offset


def test_a_chunk_that_does_not_fit_is_taken_back_whole(tmp_path: Path) -> None:
    disk = FullDisk(20_000)
    container = Container(disk)
    channel = container.add_channel("/a", "x", 0, {})
    written = 0
    with pytest.raises(OSError, match="No space"):  # noqa: PT012  the loop is what fails
        for number in range(10_000):
            container.add_message(channel, number, number, number, number.to_bytes(8, "big") * 8)
            if number % 100 == 99:
                container.flush()
                written = number + 1
    path = tmp_path / "prefix.mcap"
    path.write_bytes(disk.data)
    recording = Recording.open(path)
    assert [message.tick for message in recording.messages()] == list(range(written))
    assert written > 0
    assert not recording.complete


def test_a_writer_far_behind_gives_up_decoding_first_and_counts_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recorder_module, "DECODE_BACKLOG", 100)
    monkeypatch.setattr(recorder_module, "MAX_BACKLOG", 300)
    monkeypatch.setattr(recorder_module, "BATCH_S", 10.0)  # the thread sleeps until close
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=True)
    for tick in range(400):
        recorder.datagram("autopilot", "rx", heartbeat(), log_time_ns=tick, now_us=tick, tick=tick)
    assert recorder.notices() == ["the disk is too slow: not everything is recorded"]
    recorder.metadata("outcome", {"ok": "yes"})
    with pytest.raises(RecordingError, match="the disk was too slow; 100 entries are missing in it"):
        recorder.close()
    assert Recording.open(tmp_path / "a.mcap").metadata["outcome"] == {"ok": "yes"}
    counters = recorder.counters
    assert counters.rx == {"autopilot": 300}
    assert counters.dropped_raw == 100
    assert (counters.decoded, counters.dropped_decoded) == (99, 201)  # of the last 100 waiting one is the table


def test_a_thread_has_the_file_put_on_the_disk_while_it_is_written_and_all_of_it_at_the_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(settling_module, "SYNC_S", 0.02)
    monkeypatch.setattr(recorder_module, "FLUSH_S", 0.0)
    sizes: list[tuple[int, int]] = []

    def sync(descriptor: int) -> None:
        sizes.append((os.fstat(descriptor).st_ino, os.fstat(descriptor).st_size))

    monkeypatch.setattr(settling_module, "_sync", sync)
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=True, rotation=Rotation(size_bytes=9_000)) as recorder:
        for _ in range(4):
            record_captured(recorder)
            recorder._wake.wait(0.1)
    assert len(recorder.paths) > 2
    for part in recorder.paths:
        of_part = [size for inode, size in sizes if inode == part.stat().st_ino]
        assert of_part[-1] == part.stat().st_size
    assert len(sizes) > len(recorder.paths)
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("recorder")]


def test_a_disk_that_fails_behind_our_back_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def sync(descriptor: int) -> None:
        raise OSError(errno.EIO, "Input/output error")

    monkeypatch.setattr(settling_module, "_sync", sync)
    with (
        pytest.raises(RecordingError, match="the disk failed: Input/output error"),
        Recorder(tmp_path / "a.mcap", metadata={}, threaded=True) as recorder,
    ):
        recorder.datagram("autopilot", "rx", heartbeat(), log_time_ns=1, now_us=1, tick=0)
    assert recorder.counters.dropped_raw == 0


def test_what_waits_is_bounded_in_bytes_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recorder_module, "MAX_BACKLOG_BYTES", 1_000_000)
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=True)
    writer = threading.Event()
    with monkeypatch.context() as patch:
        patch.setattr(recorder, "_look", writer.wait)  # the disk hangs
        for tick in range(40):
            recorder.datagram("autopilot", "rx", bytes(65_000), log_time_ns=tick, now_us=tick, tick=tick)
        assert sum(len(item[5]) for item in recorder._queue if len(item) == 7) <= 1_065_000
        writer.set()
    with pytest.raises(RecordingError, match="the disk was too slow"):
        recorder.close()
    assert recorder.counters.rx["autopilot"] + recorder.counters.dropped_raw == 40
    assert recorder.counters.rx["autopilot"] >= 16


def test_a_negative_time_is_our_own_mistake_at_the_call_even_with_a_thread(tmp_path: Path) -> None:
    with Recorder(tmp_path / "a.mcap", metadata={}, threaded=True) as recorder:
        with pytest.raises(ValueError, match="log_time_ns -1"):
            recorder.datagram("autopilot", "rx", b"", log_time_ns=-1, now_us=0, tick=0)
        with pytest.raises(ValueError, match="tick -1"):
            recorder.message("/companion/note", schema.Note(6, "", ""), log_time_ns=0, now_us=0, tick=-1)


def test_tables_known_only_at_the_end_are_kept_too(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=True) as recorder:
        record(recorder, schema.Note(6, "", "x"), 1_000, 0)
        recorder.metadata("sockets", {"autopilot.drops": "3"})
    assert Recording.open(path).metadata["sockets"] == {"autopilot.drops": "3"}
