"""Reading back: whole files, files cut short, damaged ones, and files that are something else."""

import random
from pathlib import Path

import pytest
from logs_traffic import PEER, captured, heartbeat, record_captured
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

from logs import Attachment, Recording, RecordingError, SchemaVersionError, schema
from logs.container import MAGIC
from logs.info import info
from logs.recorder import Recorder


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recording") / "whole.mcap"
    mission = Attachment("mission.yaml", "application/yaml", b"name: l_shape\n")
    with Recorder(path, metadata={"run": {"seed": "7"}}, attachments=[mission], threaded=False) as recorder:
        record_captured(recorder)
    return path


def test_what_was_recorded_is_read_back(whole: Path) -> None:
    recording = Recording.open(whole)
    assert recording.complete
    assert recording.problem == ""
    assert recording.library == "mavlink-companion"
    assert recording.metadata["run"] == {"seed": "7"}
    assert recording.attachments["mission.yaml"].data == b"name: l_shape\n"
    raw = [message for message in recording.messages() if message.channel.direction is not None]
    assert sorted(message.data for message in raw) == sorted(packet for _, packet in captured())
    assert {(m.channel.link, m.channel.peer) for m in raw} == {("autopilot", PEER)}


def test_our_reader_and_the_plain_one_see_the_same_messages(whole: Path) -> None:
    ours = [
        (m.channel.topic, m.log_time_ns, m.publish_time_ns, m.tick, m.data) for m in Recording.open(whole).messages()
    ]
    with whole.open("rb") as file:
        plain = [
            (channel.topic, message.log_time, message.publish_time, message.sequence, message.data)
            for _, channel, message in make_reader(file).iter_messages(log_time_order=False)
        ]
    assert ours == plain


def test_messages_come_by_topic_and_by_time(whole: Path) -> None:
    recording = Recording.open(whole)
    attitudes = list(recording.messages(topics=["/mavlink/1/1/ATTITUDE"], order="time"))
    stamps = [message.log_time_ns for message in attitudes]
    assert stamps == sorted(stamps)
    assert len(stamps) > 100
    decoded = recording.decode(attitudes[0])
    assert decoded.DESCRIPTOR.full_name == "mavlink.ATTITUDE"
    assert abs(decoded.roll) < 0.5
    assert recording.decode(next(iter(recording.messages(topics=["/mavlink/raw/autopilot/rx"])))) is None


def test_a_file_cut_anywhere_gives_what_its_whole_chunks_hold(whole: Path, tmp_path: Path) -> None:
    data = whole.read_bytes()
    everything = list(Recording.open(whole).messages())
    cut = tmp_path / "cut.mcap"
    most = 0
    for length in sorted(random.Random(1).sample(range(8, len(data)), 25)):
        cut.write_bytes(data[:length])
        recording = Recording.open(cut)
        found = list(recording.messages())
        assert found == everything[: len(found)]
        assert len(found) >= most
        assert not recording.complete
        assert "cut short" in recording.problem
        most = len(found)
    assert most > len(everything) // 2


def test_one_flipped_bit_is_noticed_wherever_it_is(whole: Path, tmp_path: Path) -> None:
    data = whole.read_bytes()
    everything = list(Recording.open(whole).messages())
    damaged = tmp_path / "damaged.mcap"
    rng = random.Random(2)
    for position in rng.sample(range(8, len(data) - 8), 40):
        copy = bytearray(data)
        copy[position] ^= 1 << rng.randrange(8)
        damaged.write_bytes(copy)
        try:
            recording = Recording.open(damaged)
        except SchemaVersionError:
            continue
        found = list(recording.messages())
        assert not recording.complete, position
        assert found == everything[: len(found)]


@pytest.mark.parametrize("bit", range(8))
def test_a_chunk_whose_kind_is_damaged_is_not_passed_over(whole: Path, tmp_path: Path, bit: int) -> None:
    data = bytearray(whole.read_bytes())
    everything = list(Recording.open(whole).messages())
    position, chunks = len(MAGIC), []
    while position < len(data) - len(MAGIC):
        if data[position] == Opcode.CHUNK:
            chunks.append(position)
        position += 9 + int.from_bytes(data[position + 1 : position + 9], "little")
    data[chunks[1]] ^= 1 << bit
    damaged = tmp_path / "damaged.mcap"
    damaged.write_bytes(data)
    recording = Recording.open(damaged)
    found = list(recording.messages())
    assert not recording.complete
    assert 0 < len(found) < len(everything)
    assert found == everything[: len(found)]


@pytest.mark.parametrize(
    ("content", "reason"),
    [(b"", "the file is empty"), (b"\xfe\x09\x00", "not an MCAP file"), (b"fmt: tlog, sorry", "not an MCAP file")],
)
def test_a_file_that_is_no_recording_is_one_line(tmp_path: Path, content: bytes, reason: str) -> None:
    path = tmp_path / "flight.mcap"
    path.write_bytes(content)
    with pytest.raises(RecordingError, match=reason) as caught:
        Recording.open(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)


def test_a_missing_file_and_a_folder_are_one_line(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="No such file or directory"):
        Recording.open(tmp_path / "nothing.mcap")
    with pytest.raises(RecordingError, match="directory"):
        Recording.open(tmp_path)


def test_a_newer_schema_is_refused_by_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(schema, "SCHEMA_VERSION", 2)
    Recorder(tmp_path / "new.mcap", metadata={}, threaded=False).close()
    monkeypatch.setattr(schema, "SCHEMA_VERSION", 1)
    with pytest.raises(SchemaVersionError, match="schema version 2; this version reads 1 to 1"):
        Recording.open(tmp_path / "new.mcap")


@pytest.mark.parametrize("compression", [CompressionType.ZSTD, CompressionType.NONE])
def test_files_of_other_writers_are_read(tmp_path: Path, compression: CompressionType) -> None:
    path = tmp_path / "other.mcap"
    writer = Writer(str(path), compression=compression)
    writer.start("", "someone else")
    channel = writer.register_channel("/a", "text", 0)
    writer.add_message(channel, 5, b"hello", 6, 7)
    writer.finish()
    recording = Recording.open(path)
    assert [(m.channel.topic, m.log_time_ns, m.publish_time_ns, m.tick, m.data) for m in recording.messages()] == [
        ("/a", 5, 6, 7, b"hello")
    ]
    assert (recording.complete, recording.library) == (True, "someone else")


def test_info_sums_up(whole: Path) -> None:
    summary = info(whole)
    rx = [packet for _, packet in captured() if packet[5] == 1]
    tx = [packet for _, packet in captured() if packet[5] == 255]
    (link,) = summary.links
    assert (link.name, link.rx_datagrams, link.rx_bytes) == ("autopilot", len(rx), sum(map(len, rx)))
    assert (link.tx_datagrams, link.tx_bytes) == (len(tx), sum(map(len, tx)))
    topics = {topic.topic: topic for topic in summary.topics}
    assert topics["/mavlink/raw/autopilot/rx"].count == len(rx)
    assert topics["/mavlink/1/1/ATTITUDE"].schema == "mavlink.ATTITUDE"
    assert topics["/companion/tick"].rate_hz == pytest.approx(50.0, rel=0.01)
    assert summary.duration_s == pytest.approx(6.0, abs=0.05)
    assert summary.messages == sum(topic.count for topic in summary.topics)
    assert summary.attachments == {"mission.yaml": 14}
    assert summary.size_bytes == whole.stat().st_size
    assert summary.complete


def test_info_of_a_recording_without_a_message(tmp_path: Path) -> None:
    path = tmp_path / "empty.mcap"
    Recorder(path, metadata={}, threaded=False).close()
    summary = info(path)
    assert (summary.messages, summary.duration_s, summary.complete) == (0, 0.0, True)


def test_a_recording_still_being_written_can_be_read(tmp_path: Path) -> None:
    path = tmp_path / "live.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for tick in range(100):
            recorder.datagram(
                "autopilot", "rx", heartbeat(), log_time_ns=tick * 20_000_000, now_us=tick * 20_000, tick=tick
            )
        recording = Recording.open(path)
        assert sum(message.channel.direction == "rx" for message in recording.messages()) >= 75
        assert not recording.complete
