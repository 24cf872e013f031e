"""Parts of a recording: by size and time, and across a disk that is full; judged by the plain `mcap` reader."""

import errno
import random
from collections import Counter, defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from logs_traffic import heartbeat, record
from mcap.reader import NonSeekingReader, make_reader

from logs import Attachment, Recording, RecordingError, schema, ticks
from logs import parts as parts_module
from logs.info import info
from logs.mirrors import Said
from logs.parts import Room, Rotation
from logs.recorder import Recorder

MISSION = Attachment("mission.yaml", "application/yaml", b"name: l_shape\n")
TICK_US = 20_000
Read = list[tuple[str, int, int, bytes]]


def fly(recorder: Recorder, seconds: float, first: int = 0, noise: int = 100) -> int:
    """A flight's seam: a heartbeat, some noise and a tick each tick; returns the next tick."""
    rng = random.Random(first)
    for tick in range(first, first + round(seconds * 50)):
        now_us = (tick + 1) * TICK_US
        at = {"log_time_ns": now_us * 1000, "now_us": now_us, "tick": tick}
        recorder.datagram("autopilot", "rx", heartbeat(sequence=tick & 0xFF), **at)
        recorder.datagram("autopilot", "rx", rng.randbytes(noise), **at)
        record(recorder, schema.Tick(now_us, 2, 1), now_us, tick)
        record(recorder, schema.Note(6, "FLYING", f"tick {tick}"), now_us, tick)
    return first + round(seconds * 50)


def strict(path: Path) -> Read:
    """What a strict reader finds in one file, from front to back and by its index."""
    with path.open("rb") as file:
        straight = [
            (channel.topic, m.log_time, m.sequence, m.data)
            for _, channel, m in NonSeekingReader(file, validate_crcs=True).iter_messages(log_time_order=False)
        ]
        file.seek(0)
        sought = list(make_reader(file, validate_crcs=True).iter_messages())
    assert len(sought) == len(straight)
    return straight


def all_of(folder: Path) -> Read:
    """The messages of every file in the folder, in the order of the names."""
    return [message for path in sorted(folder.iterdir()) for message in strict(path)]


def test_parts_by_size_lose_nothing_and_stand_in_order(tmp_path: Path) -> None:
    whole, parted = tmp_path / "whole", tmp_path / "parted"
    for folder, rotation in ((whole, None), (parted, Rotation(size_bytes=40_000))):
        folder.mkdir()
        path = folder / "flight.mcap"
        with Recorder(
            path, metadata={"run": {"seed": "7"}}, attachments=[MISSION], threaded=False, rotation=rotation
        ) as r:
            fly(r, 20.0)
    names = [path.name for path in sorted(parted.iterdir())]
    assert names[:3] == ["flight.mcap", "flight.part0002.mcap", "flight.part0003.mcap"]
    assert len(names) > 3
    assert all_of(parted) == all_of(whole)
    assert len(all_of(parted)) == 1000 * 5
    sizes = [path.stat().st_size for path in sorted(parted.iterdir())]
    assert max(sizes) < 40_000 + 30_000  # half a second more, and what stands at the end
    for number, path in enumerate(sorted(parted.iterdir()), start=1):
        with path.open("rb") as file:
            reader = make_reader(file)
            metadata = {entry.name: entry.metadata for entry in reader.iter_metadata()}
            assert [a.name for a in reader.iter_attachments()] == ["mission.yaml"]
        assert metadata["run"] == {"seed": "7"}
        assert (metadata["part"]["number"], metadata["part"]["of"]) == (str(number), "flight.mcap")
        assert "gap" not in metadata["part"]


def test_parts_by_time_end_at_their_time(tmp_path: Path) -> None:
    rotation = Rotation(seconds=3.0)
    with Recorder(tmp_path / "a.mcap", metadata={}, threaded=False, rotation=rotation) as recorder:
        fly(recorder, 10.0)
    spans = [strict(path)[-1][1] - strict(path)[0][1] for path in sorted(tmp_path.iterdir())]
    assert len(spans) == 4
    assert all(2.9e9 <= span <= 3.6e9 for span in spans[:-1])


def test_a_thread_rotates_as_well(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("logs.recorder.FLUSH_S", 0.0)
    rotation = Rotation(size_bytes=20_000)
    with Recorder(tmp_path / "a.mcap", metadata={}, threaded=True, rotation=rotation) as recorder:
        fly(recorder, 20.0)
    assert recorder.counters.parts == len(recorder.paths) == len(list(tmp_path.iterdir())) > 1
    by_topic: dict[str, list[int]] = defaultdict(list)
    for topic, log_time, _, _ in all_of(tmp_path):
        by_topic[topic].append(log_time)
    assert all(stamps == sorted(stamps) for stamps in by_topic.values())
    assert len(by_topic["/mavlink/raw/autopilot/rx"]) == 2000


def test_the_first_part_is_read_as_the_whole_recording(tmp_path: Path) -> None:
    path = tmp_path / "flight [1].mcap"
    with Recorder(path, metadata={}, attachments=[MISSION], threaded=False, rotation=Rotation(size_bytes=30_000)) as r:
        fly(r, 20.0)
    recording = Recording.open(path)
    assert recording.complete
    assert len(recording.paths) == len(list(tmp_path.iterdir())) > 3
    assert [(m.channel.topic, m.log_time_ns, m.tick, m.data) for m in recording.messages()] == all_of(tmp_path)
    assert [row.index for row in ticks(recording)] == list(range(1000))
    assert info(path).messages == 5000
    assert info(path).parts == len(recording.paths)
    assert len(list(Recording.open(recording.paths[2]).messages())) < 5000  # a later part stands for itself
    recording.paths[2].unlink()
    assert "the part before flight [1].part0004.mcap is not there" in Recording.open(path).problem


def test_the_same_calls_give_the_same_parts(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        path = tmp_path / name / "f.mcap"
        with Recorder(path, metadata={}, threaded=False, rotation=Rotation(seconds=2.0)) as recorder:
            fly(recorder, 7.0)
    one, other = ([p.read_bytes() for p in sorted((tmp_path / name).iterdir())] for name in ("a", "b"))
    assert one == other


class FullDisk:
    """Takes the place of `open` for the files of a recording: one budget of bytes for all of them."""

    def __init__(self, room: int) -> None:
        self.room = room

    def open(self, path: Path, mode: str, buffering: int = -1) -> Any:
        return _File(self, path.open(mode, buffering=buffering))


class _File:
    def __init__(self, disk: FullDisk, file: Any) -> None:
        self._disk, self._file, self._size, self._at = disk, file, 0, 0

    def write(self, data: memoryview, /) -> int:
        most = self._size - self._at + max(0, self._disk.room)  # what is overwritten takes no room
        if most <= 0 and data:
            raise OSError(errno.ENOSPC, "No space left on device")
        taken: int = self._file.write(data[:most])
        self._at += taken
        self._disk.room -= max(0, self._at - self._size)
        self._size = max(self._size, self._at)
        return taken

    def truncate(self, size: int, /) -> int:
        self._disk.room += self._size - size
        self._size = size
        return int(self._file.truncate(size))

    def seek(self, offset: int, /) -> int:
        self._at = int(self._file.seek(offset))
        return self._at

    def fileno(self) -> int:
        return int(self._file.fileno())

    def close(self) -> None:
        self._file.close()


@pytest.fixture
def disk(monkeypatch: pytest.MonkeyPatch) -> Callable[[int], FullDisk]:
    def of(room: int) -> FullDisk:
        disk = FullDisk(room)
        monkeypatch.setattr(parts_module, "open", disk.open, raising=False)
        return disk

    return of


def told(path: Path) -> dict[str, str]:
    with path.open("rb") as file:
        return next(e.metadata for e in make_reader(file).iter_metadata() if e.name == "part")


@pytest.mark.parametrize("room", [20_000, 30_001, 47_777, 61_234, 99_990])
@pytest.mark.parametrize("chunk_bytes", [1024 * 1024, 3000])  # a chunk ends by its time; in the middle of a datagram
def test_a_full_disk_ends_a_part_and_a_new_one_tells_what_is_missing(
    tmp_path: Path, disk: Callable[[int], FullDisk], room: int, chunk_bytes: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("logs.container.CHUNK_BYTES", chunk_bytes)
    full = disk(room)
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=False)
    tick = fly(recorder, 20.0)
    assert "No space left" in recorder.failure
    assert any("nothing is recorded: No space left on device" in notice for notice in recorder.notices())
    full.room += 1_000_000
    tick = fly(recorder, 20.0, tick)
    with pytest.raises(RecordingError, match=r"No space left on device; \d+ entries are missing between its parts"):
        recorder.close()
    paths = sorted(tmp_path.iterdir())
    assert recorder.paths == tuple(paths)
    read = [strict(path) for path in paths]  # each is a whole file to others
    gaps = [told(path) for path in paths[1:]]  # a part may find room for itself, and none for what comes
    raw = [m for part in read for m in part if m[0] not in ("/mavlink/1/1/HEARTBEAT", "/companion/losses")]
    missing = sum(int(gap["gap_missing"]) for gap in gaps)
    assert len(raw) + missing == 2000 * 4 == len(raw) + recorder.counters.dropped_raw
    for before, gap, after in zip(read, gaps, read[1:], strict=False):
        assert not before or before[-1][1] == int(gap["gap_from_ns"])
        assert int(gap["gap_from_ns"]) < int(gap["gap_to_ns"])
        assert not after or int(gap["gap_to_ns"]) <= after[0][1]
    counters, found = recorder.counters, Counter(topic for part in read for topic, *_ in part)
    assert counters.rx == {"autopilot": found["/mavlink/raw/autopilot/rx"]}
    assert counters.decoded == found["/mavlink/1/1/HEARTBEAT"]
    assert counters.messages == sum(count for topic, count in found.items() if topic.startswith("/companion/"))
    recording = Recording.open(tmp_path / "a.mcap")
    text = f"{gaps[0]['gap_missing']} entries are missing before part 2: No space left on device"
    assert recording.gaps[0] == text
    assert len(recording.gaps) == len(gaps)


def test_a_table_that_finds_no_room_stands_in_the_next_part_and_mirrors_are_no_entries_that_are_missing(
    tmp_path: Path, disk: Callable[[int], FullDisk]
) -> None:
    full = disk(20_000)
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=False)
    tick = fly(recorder, 20.0)
    missing = recorder.counters.dropped_raw
    at: dict[str, int] = {"log_time_ns": 21_000_000_000, "now_us": 21_000_000, "tick": tick}
    recorder.mirror(Said(6, "words"), **at)
    recorder.metadata("outcome", {"ok": "yes"})
    assert recorder.counters.dropped_raw == missing > 0
    full.room += 100_000
    with pytest.raises(RecordingError, match=f"; {missing} entries are missing between its parts"):
        recorder.close()
    others = sorted(tmp_path.iterdir())[1:]
    assert {told(path)["gap"] for path in others} == {"No space left on device"}
    assert sum(int(told(path)["gap_missing"]) for path in others) == missing
    assert Recording.open(tmp_path / "a.mcap").metadata["outcome"] == {"ok": "yes"}


def test_a_gap_is_told_once_however_often_a_new_part_finds_no_room(
    tmp_path: Path, disk: Callable[[int], FullDisk], monkeypatch: pytest.MonkeyPatch
) -> None:
    full = disk(20_000)
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=False)
    tick, tried = fly(recorder, 20.0), 0
    withdraw = parts_module.Parts.withdraw

    def count(parts: parts_module.Parts) -> None:
        nonlocal tried
        tried += 1
        withdraw(parts)
        full.room = 600

    monkeypatch.setattr(parts_module.Parts, "withdraw", count)
    full.room = 600  # for the beginning of a part, not for what comes
    recorder.notices()
    recorder.metadata("outcome", {"words": "x" * 2000})
    tick = fly(recorder, 30.0, tick)
    assert tried >= 5
    assert recorder.notices() == []
    full.room += 1_000_000
    fly(recorder, 20.0, tick)
    told = [notice.partition(":")[0] for notice in recorder.notices()]
    assert told == [f"recording goes on in {recorder.paths[-1]}"]
    with pytest.raises(RecordingError, match="entries are missing between its parts"):
        recorder.close()
    assert Recording.open(tmp_path / "a.mcap").metadata["outcome"] == {"words": "x" * 2000}


class Unclosable(FullDisk):
    """What was written does not all reach it, which it says when a file is closed."""

    def open(self, path: Path, mode: str, buffering: int = -1) -> Any:
        file = super().open(path, mode, buffering)
        close = file.close

        def failing() -> None:
            close()
            raise OSError(errno.EIO, "Input/output error")

        file.close = failing
        return file


def test_a_disk_that_fails_as_a_part_is_closed_ends_no_writer_and_every_entry_is_accounted_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parts_module, "open", Unclosable(30_000).open, raising=False)
    monkeypatch.setattr("logs.container.CHUNK_BYTES", 3000)
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=True)
    fly(recorder, 20.0)
    recorder._wake.wait(0.12)  # two turns of the writer
    tick = fly(recorder, 20.0, 1000)
    assert tick == 2000
    with pytest.raises(RecordingError, match=r"entries are missing at its end"):
        recorder.close()
    assert not recorder._queue
    raw = [m for m in strict(tmp_path / "a.mcap") if m[0] not in ("/mavlink/1/1/HEARTBEAT", "/companion/losses")]
    assert len(raw) + recorder.counters.dropped_raw == 2000 * 4


def test_a_last_part_that_is_not_closed_well_is_told_and_not_raised_past_the_recorder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parts_module, "open", Unclosable(1_000_000).open, raising=False)
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=False)
    fly(recorder, 1.0)
    with pytest.raises(RecordingError, match="writing failed: Input/output error; 0 entries"):
        recorder.close()


@pytest.mark.parametrize("room", [20_000, 30_000, 33_333])
def test_a_disk_that_stays_full_costs_what_comes_after_and_close_says_so(
    tmp_path: Path, disk: Callable[[int], FullDisk], room: int
) -> None:
    full = disk(room)
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=False)
    fly(recorder, 60.0)
    full.room = 0
    with pytest.raises(RecordingError, match=r"writing failed: No space left on device; \d+ .* missing at its end"):
        recorder.close()
    assert recorder.paths == tuple(sorted(tmp_path.iterdir()))
    assert all(strict(path) for path in recorder.paths)  # no empty parts


def test_a_disk_that_fills_up_is_told_then_decoded_no_more_then_left_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    free = 900
    monkeypatch.setattr(parts_module.Parts, "disk", lambda self: (free, 1 << 40))
    monkeypatch.setattr("logs.recorder.FLUSH_S", 0.0)
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=True, room=Room(warn=500, raw_only=300, stop=100))
    notices: list[str] = []

    def go_on(bytes_free: int, tick: int) -> int:
        nonlocal free
        wait_for(lambda: not recorder._queue)
        free = bytes_free
        tick = fly(recorder, 1.0, tick)
        wait_for(lambda: not recorder._queue)
        return tick

    def wait_for(done: Callable[[], bool]) -> None:
        recorder._wake.wait(0.12)  # two turns of the writer
        while not done():
            recorder._wake.wait(0.01)

    tick = go_on(400, go_on(900, 0))
    notices += recorder.notices()
    assert len(notices) == 1
    assert "are left on the disk" in notices[0]
    decoded = recorder.counters.decoded
    tick = go_on(200, tick)
    tick = go_on(200, tick)
    assert "packets are kept raw only" in recorder.notices()[0]
    assert recorder.counters.dropped_decoded >= 50
    assert recorder.counters.decoded <= decoded + 50
    tick = go_on(50, tick)
    tick = go_on(50, tick)
    assert "nothing is recorded: 0.0 MB are left" in recorder.notices()[0]
    assert recorder.counters.dropped_raw >= 200
    with pytest.raises(RecordingError, match="entries are missing between its parts"):
        recorder.close()
    assert all(strict(path) for path in tmp_path.iterdir() if path.name == "a.mcap")
    assert told(tmp_path / "a.part0002.mcap")["gap"].startswith("0.0 MB are left")


def test_the_bounds_shrink_with_a_small_disk() -> None:
    assert Room().of_disk(1 << 40) == Room()
    assert Room().of_disk(4_000_000) == Room(warn=2_000_000, raw_only=800_000, stop=200_000)


def test_parts_of_another_recording_are_not_taken_for_ones_own(tmp_path: Path) -> None:
    (tmp_path / "a.part0002.mcap").write_bytes(b"older")
    with pytest.raises(RecordingError, match=r"a\.mcap: a\.part0002\.mcap is there already"):
        Recorder(tmp_path / "a.mcap", metadata={}, threaded=False)
    assert [path.name for path in tmp_path.iterdir()] == ["a.part0002.mcap"]


def test_a_fault_of_ours_ends_the_recording_with_a_word_and_leaves_it_readable(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=True)
    fly(recorder, 1.0)
    recorder.datagram("autopilot", "rx", "text", log_time_ns=1, now_us=1, tick=51)  # type: ignore[arg-type]
    fly(recorder, 1.0, 52)
    with pytest.raises(RecordingError, match=r"writing failed: TypeError: .* \d+ entries are missing at its end"):
        recorder.close()
    assert "the flight goes on without" in recorder.notices()[0]
    strict(tmp_path / "a.mcap")
    assert recorder.counters.dropped_raw >= 201
