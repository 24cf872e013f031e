"""Recovery, judged by the plain `mcap` readers with their checksums on."""

import errno
import json
import os
import random
import time
import tracemalloc
from collections import Counter
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from logs_traffic import record, record_captured
from mcap.opcode import Opcode
from mcap.reader import NonSeekingReader, make_reader
from mcap.writer import CompressionType, Writer

from logs import Attachment, Recording, RecordingError, schema, ticks
from logs import recovery as recovery_module
from logs.recorder import Recorder
from logs.recovery import recover, recover_unfinished

Read = list[tuple[str, int, int, int, bytes]]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recording") / "whole.mcap"
    mission = Attachment("mission.yaml", "application/yaml", b"name: l_shape\n")
    with Recorder(path, metadata={"run": {"seed": "7"}}, attachments=[mission], threaded=False) as recorder:
        record_captured(recorder)
    return path


def records(data: bytes) -> list[tuple[int, int, int]]:
    """(kind, start, end) of every record between the magics."""
    found, position = [], 8
    while position < len(data) - 8:
        end = position + 9 + int.from_bytes(data[position + 1 : position + 9], "little")
        found.append((data[position], position, end))
        position = end
    return found


def linear(data: bytes) -> Read:
    """What the plain reader gets that goes from front to back and checks, up to where it raises."""
    found: Read = []
    try:
        for _, channel, m in NonSeekingReader(BytesIO(data), validate_crcs=True).iter_messages(log_time_order=False):
            found.append((channel.topic, m.log_time, m.publish_time, m.sequence, m.data))
    except Exception:
        pass
    return found


def strict(path: Path) -> Read:
    """What both plain readers get; they must agree, with each other, the statistics and the index."""
    data = path.read_bytes()
    straight = [
        (channel.topic, m.log_time, m.publish_time, m.sequence, m.data)
        for _, channel, m in NonSeekingReader(BytesIO(data), validate_crcs=True).iter_messages(log_time_order=False)
    ]
    reader = make_reader(BytesIO(data), validate_crcs=True)
    sought = [
        (channel.topic, m.log_time, m.publish_time, m.sequence, m.data)
        for _, channel, m in reader.iter_messages(log_time_order=False)
    ]
    assert straight == sought
    summary = reader.get_summary()
    assert summary is not None
    assert summary.statistics is not None
    assert summary.statistics.message_count == len(straight)
    topics = Counter(topic for topic, *_ in straight)
    counted: Counter[str] = Counter()
    for channel_id, count in summary.statistics.channel_message_counts.items():
        counted[summary.channels[channel_id].topic] += count
    assert counted == topics
    for index in summary.chunk_indexes:
        for channel_id, offset in index.message_index_offsets.items():
            assert data[offset] == 7
            assert int.from_bytes(data[offset + 9 : offset + 11], "little") == channel_id
    assert len(list(reader.iter_metadata())) == summary.statistics.metadata_count
    assert len(list(reader.iter_attachments())) == summary.statistics.attachment_count
    return straight


def recovered_or_refused(path: Path, damaged: bytes, everything: Read) -> bool:
    """Recover a file of these bytes and judge it; whether it was recovered rather than refused."""
    path.write_bytes(damaged)
    before = linear(damaged)
    refusal = ""
    try:
        outcome = recover(path)
    except RecordingError as error:
        refusal = str(error)
    if refusal:
        assert "\n" not in refusal
        assert refusal.startswith(f"{path}: ")
        assert not before
        assert path.read_bytes() == damaged
        return False
    found = strict(path)
    assert len(found) == outcome.messages >= len(before)
    assert not Counter(found) - Counter(everything)  # nothing that was not written
    assert Recording.open(path).complete
    again = recover(path)
    assert not again.changed
    assert list(path.parent.iterdir()) == [path]
    return True


def test_a_file_cut_off_anywhere_is_recovered_with_all_that_a_linear_read_finds(whole: Path, tmp_path: Path) -> None:
    data, everything = whole.read_bytes(), strict(whole)
    rng = random.Random(1)
    for length in sorted(rng.sample(range(len(data)), 40)):
        recovered_or_refused(tmp_path / "cut.mcap", data[:length], everything)


def test_a_file_with_one_wrong_byte_anywhere_is_recovered_or_refused(whole: Path, tmp_path: Path) -> None:
    data, everything = whole.read_bytes(), strict(whole)
    rng = random.Random(2)
    for position in rng.sample(range(len(data)), 40):
        damaged = bytearray(data)
        damaged[position] ^= rng.randrange(1, 256)
        if recovered_or_refused(tmp_path / "damaged.mcap", bytes(damaged), everything):
            # no more than one chunk, and what only that one declared
            assert len(strict(tmp_path / "damaged.mcap")) > 0.8 * len(everything)


@pytest.mark.soak
@pytest.mark.parametrize("way", ["cut", "flipped"])
def test_five_hundred_damaged_files_are_recovered_or_refused(whole: Path, tmp_path: Path, way: str) -> None:
    data, everything = whole.read_bytes(), strict(whole)
    rng = random.Random(3)
    recovered = 0
    for _ in range(500):
        damaged = bytearray(data[: rng.randrange(len(data))] if way == "cut" else data)
        if way == "flipped":
            damaged[rng.randrange(len(damaged))] ^= rng.randrange(1, 256)
        recovered += recovered_or_refused(tmp_path / "damaged.mcap", bytes(damaged), everything)
    assert recovered > 490


def test_a_whole_file_is_left_as_it_is(whole: Path, tmp_path: Path) -> None:
    path = tmp_path / "whole.mcap"
    path.write_bytes(whole.read_bytes())
    os.utime(path, (1, 1))
    outcome = recover(path)
    assert (outcome.changed, outcome.lossy, outcome.lost_bytes, outcome.problem) == (False, False, 0, "")
    assert outcome.messages == len(strict(whole))
    assert path.stat().st_mtime == 1


def test_a_file_without_an_end_loses_nothing_and_says_what_was_done(whole: Path, tmp_path: Path) -> None:
    data, everything = whole.read_bytes(), strict(whole)
    path = tmp_path / "killed.mcap"
    starts = records(data)
    chunk_end = [end for kind, _, end in starts if kind == Opcode.CHUNK][-1]
    indexes_end = [end for kind, _, end in starts if kind == Opcode.MESSAGE_INDEX][-1]
    for end in (indexes_end, indexes_end - 5, chunk_end + 3, chunk_end):
        path.write_bytes(data[:end])
        outcome = recover(path)
        assert (outcome.changed, outcome.lossy, outcome.lost_bytes) == (True, False, 0)
        assert strict(path) == everything
        said = Recording.open(path).metadata["recovery"]
        assert "without a footer" in said["problem"] or "inside a record" in said["problem"]
        assert said["messages"] == str(len(everything))


def test_whole_messages_at_the_front_of_a_torn_chunk_are_kept(tmp_path: Path) -> None:
    path, rng = tmp_path / "torn.mcap", random.Random(5)
    with path.open("wb") as file:
        writer = Writer(file, chunk_size=1 << 22)
        writer.start()
        channel = writer.register_channel("/a", "bytes", 0)
        for number in range(4000):
            writer.add_message(channel, number, rng.randbytes(500), number, number)
        writer.finish()
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])
    assert not linear(path.read_bytes())
    outcome = recover(path)
    found = strict(path)
    assert [log_time for _, log_time, *_ in found] == list(range(len(found)))
    assert len(found) == outcome.messages > 1000
    assert outcome.lossy


def test_a_recovery_that_is_killed_loses_nothing_of_a_torn_chunk_nor_what_others_may_do_with_the_file(
    tmp_path: Path,
) -> None:
    path, rng = tmp_path / "torn.mcap", random.Random(5)
    with path.open("wb") as file:
        writer = Writer(file, chunk_size=1 << 22)
        writer.start()
        channel = writer.register_channel("/a", "bytes", 0)
        for number in range(2000):
            writer.add_message(channel, number, rng.randbytes(500), number, number)
        writer.finish()
    torn = path.read_bytes()[: path.stat().st_size // 2]
    path.write_bytes(torn)
    recover(path)
    wanted = strict(path)
    for calls in range(1, 6):
        path.write_bytes(torn)
        path.chmod(0o640)
        with pytest.MonkeyPatch.context() as patch:
            _die_after(patch, calls)
            with suppress(_KilledError):
                recover(path)
        assert recover(path).messages == len(wanted) > 800
        assert strict(path) == wanted
        assert path.stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("error", [errno.ENOSPC, errno.EDQUOT])
def test_with_no_room_for_a_copy_the_torn_end_is_given_up_and_that_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: int
) -> None:
    path, rng = tmp_path / "torn.mcap", random.Random(5)
    with path.open("wb") as file:
        writer = Writer(file, chunk_size=1 << 20)
        writer.start()
        for name in ("/a", "/b"):  # the second is declared in the chunk that is cut off
            channel = writer.register_channel(name, "bytes", 0)
            for number in range(3000):
                writer.add_message(channel, number, rng.randbytes(500), number, number)
        writer.finish()
    data = path.read_bytes()
    chunks = [(start, end) for kind, start, end in records(data) if kind == Opcode.CHUNK]
    start, end = chunks[1]
    torn = data[: (start + end) // 2]
    path.write_bytes(torn)
    before = linear(torn)

    def full(*arguments: Any) -> None:
        raise OSError(error, os.strerror(error))

    with monkeypatch.context() as patch:
        patch.setattr(recovery_module, "_rewrite", _failing_at_zero(recovery_module._rewrite, full))
        outcome = recover(path)
    assert outcome.lossy
    assert outcome.lost_bytes == len(torn) - start
    assert "with no room for a copy" in outcome.problem
    assert strict(path) == before
    assert len(before) == outcome.messages > 1000
    assert [entry.name for entry in tmp_path.iterdir()] == ["torn.mcap"]
    assert not recover(path).changed


def _failing_at_zero(true: Any, fail: Any) -> Any:
    """Writing a whole copy fails; writing an end does not."""
    return lambda *arguments: (fail if arguments[4] == 0 else true)(*arguments)


@pytest.mark.parametrize("compression", [CompressionType.ZSTD, CompressionType.LZ4, CompressionType.NONE])
@pytest.mark.parametrize("chunked", [True, False])
def test_files_of_other_writers_are_recovered_too(tmp_path: Path, compression: CompressionType, chunked: bool) -> None:
    path = tmp_path / "other.mcap"
    with path.open("wb") as file:
        writer = Writer(file, chunk_size=2000, compression=compression, use_chunking=chunked)
        writer.start("", "someone else")
        channel = writer.register_channel("/a", "text", writer.register_schema("S", "text", b"s"))
        for number in range(300):
            writer.add_message(channel, number, b"hello %d" % number, number, number)
        writer.add_metadata("table", {"key": "value"})
        writer.finish()
    data, everything = path.read_bytes(), linear(path.read_bytes())
    assert len(everything) == 300
    rng = random.Random(4)
    for length in rng.sample(range(len(data)), 30):
        path.write_bytes(data[:length])
        before = linear(data[:length])
        try:
            recover(path)
        except RecordingError:
            assert not before
        else:
            assert len(linear(path.read_bytes())) >= len(before)
            assert not recover(path).changed


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "the file is empty"),
        (b"fmt: tlog, sorry", "not an MCAP file"),
        (b"\x89MCAP0\r\n", "there is nothing in it"),
        (b"\x89MCAP0\r\n" + bytes(5000), "there is nothing in it"),
    ],
)
def test_what_is_no_recording_is_refused_in_one_line_and_left_as_it_is(
    tmp_path: Path, content: bytes, reason: str
) -> None:
    path = tmp_path / "flight.mcap"
    path.write_bytes(content)
    with pytest.raises(RecordingError, match=reason) as caught:
        recover(path)
    assert "\n" not in str(caught.value)
    assert path.read_bytes() == content


def test_a_chunk_that_claims_or_unpacks_to_enormous_sizes_takes_no_memory(whole: Path, tmp_path: Path) -> None:
    data = bytearray(whole.read_bytes())
    chunk = data.index(b"\x04\0\0\0zstd") - 37
    data[chunk + 9 + 16 : chunk + 9 + 24] = (1 << 62).to_bytes(8, "little")  # its unpacked size
    path = tmp_path / "claims.mcap"
    path.write_bytes(data)
    tracemalloc.start()
    try:
        outcome = recover(path)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert strict(path) == strict(whole)
    assert not outcome.lost_bytes
    assert peak < 2 * len(data)


def test_no_damage_takes_more_memory_than_twice_the_file_or_more_time_than_it_is_long(
    whole: Path, tmp_path: Path
) -> None:
    data, path, rng = whole.read_bytes(), tmp_path / "damaged.mcap", random.Random(6)
    files = [data[: rng.randrange(100_000, len(data))] for _ in range(3)]
    for _ in range(5):
        damaged = bytearray(data)
        for position in rng.sample(range(len(data)), 30):
            damaged[position] ^= rng.randrange(1, 256)
        files.append(bytes(damaged))
    starts = [b"\x06\x40\0\0\0\0\0\0\0", b"\x0c\x08\0\0\0\0\0\0\0", b"\x09\xff\xff\0\0\0\0\0\0", b"\x07"]
    files += [data[:20_000] + start * (200_000 // len(start)) for start in starts]  # what looks like records everywhere
    for content in files:
        path.write_bytes(content)
        tracemalloc.start()
        began = time.process_time()
        try:
            recover(path)
        finally:
            took, peak = time.process_time() - began, tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
        assert peak < 2 * len(content)
        assert took < 5.0
        strict(path)


def test_records_in_records_in_records_are_given_up_in_time(whole: Path, tmp_path: Path) -> None:
    """Attachments from every 45th byte to the end of the file, each with lengths that fit and a wrong checksum."""
    data, path, count = whole.read_bytes()[:100_000], tmp_path / "hostile.mcap", 60_000
    lengths = range(count * 45 - 5, 0, -45)
    heads = [
        b"\x09" + length.to_bytes(8, "little") + bytes(24) + (length - 36).to_bytes(8, "little") + b"####"
        for length in lengths
    ]
    path.write_bytes(data + b"".join(heads) + b"####")
    began = time.process_time()
    outcome = recover(path)
    assert time.process_time() - began < 5.0
    assert strict(path)
    assert "what checksums over 16 times its size had not proved was given up" in outcome.problem


def test_a_recovery_killed_at_any_write_can_be_begun_again(whole: Path, tmp_path: Path) -> None:
    data, everything = whole.read_bytes(), strict(whole)
    for name, damaged in (("cut", data[:100_000]), ("hole", data[:50_000] + bytes(20) + data[50_020:])):
        path = tmp_path / f"{name}.mcap"
        path.write_bytes(damaged)
        recover(path)
        wanted = strict(path)
        for calls in range(1, 8):
            path.write_bytes(damaged)
            with pytest.MonkeyPatch.context() as patch:
                _die_after(patch, calls)
                with suppress(_KilledError):
                    recover(path)
            recover(path)
            assert strict(path) == wanted
        assert not Counter(wanted) - Counter(everything)


class _KilledError(BaseException):
    """As if the process had ended here."""


def _die_after(patch: pytest.MonkeyPatch, calls: int) -> None:
    """Every system call recovery changes something with: the last one is done by half, then the process is dead."""
    left = calls
    for name, system in (
        ("pwrite", os.pwrite),
        ("ftruncate", os.ftruncate),
        ("fsync", os.fsync),
        ("replace", os.replace),
    ):

        def call(*args: Any, true: Any = system, name: str = name) -> Any:
            nonlocal left
            left -= 1
            if left == 0:
                if name == "pwrite":
                    true(args[0], args[1][: len(args[1]) // 2], args[2])
                raise _KilledError
            return true(*args)

        patch.setattr(recovery_module.os, name, call)


def test_a_full_disk_leaves_every_whole_message_in_the_file(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "cut.mcap"
    for room, complete in ((100, True), (0, False)):  # room for the shortest end, and for none
        path.write_bytes(whole.read_bytes()[:100_000])
        before = linear(path.read_bytes())

        def pwrite(descriptor: int, data: bytes, position: int, room: int = room, true: Any = os.pwrite) -> int:
            if len(data) > room:
                raise OSError(errno.ENOSPC, "No space left on device")
            return int(true(descriptor, data, position))

        with monkeypatch.context() as patch:
            patch.setattr(recovery_module.os, "pwrite", pwrite)
            if complete:
                recover(path)
            else:
                with pytest.raises(RecordingError, match="cannot recover: No space left on device"):
                    recover(path)
        assert len(linear(path.read_bytes())) >= len(before) > 0
        assert path.read_bytes().endswith(b"\x89MCAP0\r\n") is complete  # others read it to its end
        recover(path)  # there is room again
        assert len(strict(path)) >= len(before)


def test_a_file_that_somebody_writes_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "live.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        record_captured(recorder)
        before = path.read_bytes()
        with pytest.raises(RecordingError, match="it is being written"):
            recover(path)
        assert recover_unfinished(tmp_path) == []
        assert path.read_bytes() == before
    assert recover_unfinished(tmp_path) == []


def test_where_there_are_no_locks_nothing_is_recovered_unasked(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It might be being written."""

    def flock(descriptor: int, operation: int) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr("logs.lock.fcntl.flock", flock)
    path = tmp_path / "a.mcap"
    path.write_bytes(whole.read_bytes()[:90_000])
    assert recover_unfinished(tmp_path) == []
    assert path.stat().st_size == 90_000
    assert recover(path).changed


def test_unfinished_files_of_a_folder_are_recovered_and_the_others_passed_over(whole: Path, tmp_path: Path) -> None:
    data = whole.read_bytes()
    for name, content in (("a", data), ("b", data[:90_000]), ("c", b""), ("d", b"rubbish" * 10), ("e", data[:-3])):
        (tmp_path / f"{name}.mcap").write_bytes(content)
    done = recover_unfinished(tmp_path)
    assert [Path(str(item.path)).name for item in done] == ["b.mcap", "e.mcap"]
    assert (tmp_path / "d.mcap").read_bytes() == b"rubbish" * 10
    assert strict(tmp_path / "e.mcap") == strict(whole)
    assert not recover(tmp_path / "b.mcap").changed


def test_the_command_says_by_its_exit_code_what_was_lost(whole: Path, tmp_path: Path) -> None:
    from typer.testing import CliRunner

    from companion.cli.app import app

    data = whole.read_bytes()
    indexes_end = [end for kind, _, end in records(data) if kind == Opcode.MESSAGE_INDEX][-1]
    contents = {"whole": data, "killed": data[:indexes_end], "torn": data[:90_000], "none": b"rubbish"}
    for name, content in contents.items():
        (tmp_path / f"{name}.mcap").write_bytes(content)

    def run(*names: str) -> tuple[int, dict[str, Any]]:
        result = CliRunner().invoke(app, ["log", "recover", *(str(tmp_path / f"{n}.mcap") for n in names), "--json"])
        return result.exit_code, json.loads(result.stdout)

    assert run("whole", "killed")[0] == 0
    code, told = run("torn")
    assert (code, told["ok"], told["recordings"][0]["changed"]) == (3, False, True)
    assert told["recordings"][0]["lost_bytes"] > 0
    code, told = run("none", "whole")
    assert (code, [item["ok"] for item in told["recordings"]]) == (1, [False, True])


def test_the_command_recovers_the_last_part_by_the_name_of_the_first(whole: Path, tmp_path: Path) -> None:
    from companion.cli.log import recover_logs

    first, last = tmp_path / "a.mcap", tmp_path / "a.part0002.mcap"
    first.write_bytes(whole.read_bytes())
    last.write_bytes(whole.read_bytes()[:90_000])
    assert recover_logs([first, last], as_json=True) == 3
    assert strict(last)
    last.write_bytes(whole.read_bytes()[:90_000])
    assert recover_logs([first], as_json=True) == 3
    assert strict(last)
    assert first.read_bytes() == whole.read_bytes()


def test_a_recovered_recording_has_whole_ticks_to_run_again(whole: Path, tmp_path: Path) -> None:
    data, path = whole.read_bytes(), tmp_path / "cut.mcap"
    ends = [end for kind, _, end in records(data) if kind == Opcode.CHUNK]
    for end in ends:  # in the middle of a tick, most of them
        path.write_bytes(data[:end])
        recover(path)
        rows = list(ticks(Recording.open(path)))
        assert [row.index for row in rows] == list(range(len(rows)))
    assert len(rows) == 300


def test_somebody_elses_file_is_not_touched_without_being_asked(tmp_path: Path) -> None:
    path = tmp_path / "theirs.mcap"
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start("", "someone else")
        writer.add_message(writer.register_channel("/a", "text", 0), 0, b"hello", 0, 0)
        writer.finish()
    path.write_bytes(path.read_bytes()[:-20])
    before = path.read_bytes()
    assert recover_unfinished(tmp_path) == []
    assert path.read_bytes() == before
    assert recover(path).changed


def test_a_file_is_whole_for_others_at_every_moment_it_is_written(tmp_path: Path) -> None:
    path = tmp_path / "live.mcap"
    with Recorder(path, metadata={"run": {"seed": "7"}}, threaded=False) as recorder:
        copies = [path.read_bytes()]
        for tick in range(200):
            now_us = (tick + 1) * 20_000
            record(recorder, schema.Note(6, "", str(tick)), now_us, tick)
            copies.append(path.read_bytes())
    for copy in copies:
        reader = NonSeekingReader(BytesIO(copy), validate_crcs=True)
        found = list(reader.iter_messages(log_time_order=False))
        assert len(found) == len(linear(copy))
        assert [entry.name for entry in make_reader(BytesIO(copy)).iter_metadata()][:2] == ["schema", "run"]
    other = tmp_path / "copy.mcap"
    other.write_bytes(copies[-1])
    assert "without a summary: not closed" in Recording.open(other).problem  # but it is not what we would have left
    (done,) = recover_unfinished(tmp_path)
    assert not isinstance(done, RecordingError)
    assert (done.path, done.lossy) == (other, False)
    assert len(strict(other)) >= 175
