"""What is lost is in the recording: in the kernel, on the way, in the queue."""

from pathlib import Path

import pytest
from logs_traffic import heartbeat, record

from logs import Recording, RecordingError, schema, ticks
from logs import recorder as recorder_module
from logs.mirrors import Said
from logs.parts import Rotation
from logs.recorder import Recorder

TICK_US = 20_000


def told(path: Path) -> list[tuple[float, str, int]]:
    """(when [s], of what, total) of every loss recorded."""
    return [
        (message.log_time_ns / 1e9, loss.of, loss.total)
        for message in Recording.open(path).messages(["/companion/losses"])
        for loss in [schema.decode(schema.Loss, message.data)]
    ]


def fly(recorder: Recorder, count: int, lost: range) -> None:
    for tick in range(count):
        now_us = (tick + 1) * TICK_US
        if tick not in lost:
            at = {"log_time_ns": now_us * 1000, "now_us": now_us, "tick": tick}
            recorder.datagram("autopilot", "rx", heartbeat(sequence=tick & 0xFF), **at)
        record(recorder, schema.Tick(now_us, int(tick not in lost), 0), now_us, tick)


def test_packets_missing_by_their_sequence_are_told_once_a_second_while_they_change_and_at_the_end(
    tmp_path: Path,
) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        fly(recorder, 1000, range(120, 190))
    found = told(path)
    assert {of for _, of, _ in found} == {"autopilot.1.1.sequence_gaps"}
    assert [total for *_, total in found] == [70]
    assert 190 * 0.02 <= found[0][0] <= 190 * 0.02 + 1.1
    assert len(list(ticks(Recording.open(path)))) == 1000  # they are no inputs and no outputs
    with Recorder(tmp_path / "end.mcap", metadata={}, threaded=False) as recorder:
        fly(recorder, 20, range(5, 8))
    assert [total for *_, total in told(tmp_path / "end.mcap")] == [3]


def test_nothing_is_told_where_nothing_is_lost(tmp_path: Path) -> None:
    with Recorder(tmp_path / "a.mcap", metadata={}, threaded=False) as recorder:
        fly(recorder, 1000, range(0))
    assert told(tmp_path / "a.mcap") == []


def test_other_counters_are_asked_for_and_told_like_it_and_a_closed_socket_does_no_harm(tmp_path: Path) -> None:
    drops = 0

    def losses() -> dict[str, int]:
        if drops > 10:
            raise ValueError("link 'autopilot' is closed")
        return {"autopilot.kernel_drops": drops, "gcs.kernel_drops": 0}

    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False, losses=losses) as recorder:
        for tick in range(300):
            drops = 7 if tick == 100 else 9 if tick == 200 else drops
            record(recorder, schema.Tick(tick * TICK_US, 0, 0), (tick + 1) * TICK_US, tick)
        drops = 11
    assert [(of, total) for _, of, total in told(path)] == [
        ("autopilot.kernel_drops", 7),
        ("autopilot.kernel_drops", 9),
    ]


def test_counters_that_cannot_be_read_end_the_recording_with_a_word_and_every_entry_is_accounted_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recorder_module, "FLUSH_S", 0.0)
    monkeypatch.setattr(recorder_module, "LOSSES_S", 0.0)

    def losses() -> dict[str, int]:
        raise RuntimeError("dictionary changed size during iteration")

    path = tmp_path / "a.mcap"
    recorder = Recorder(path, metadata={}, threaded=True, losses=losses)
    for _ in range(4):
        fly(recorder, 100, range(0))
        recorder._wake.wait(0.12)  # two turns of the writer
    with pytest.raises(
        RecordingError, match=r"RuntimeError: dictionary changed size .* entries are missing at its end"
    ):
        recorder.close()
    raw = [m for m in Recording.open(path).messages() if "HEARTBEAT" not in m.channel.topic]
    assert len(raw) + recorder.counters.dropped_raw == 800


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_what_still_waits_when_the_writer_has_ended_is_counted(tmp_path: Path) -> None:
    ended = False

    def losses() -> dict[str, int]:
        nonlocal ended
        if not ended:
            ended = True
            raise KeyboardInterrupt  # no exception that anybody catches
        return {}

    path = tmp_path / "a.mcap"
    recorder = Recorder(path, metadata={}, threaded=True, losses=losses)
    recorder._losses_at = 0
    recorder._flush_at = 0
    fly(recorder, 10, range(0))
    assert recorder._thread is not None
    recorder._thread.join(5.0)
    fly(recorder, 10, range(0))
    recorder.metadata("outcome", {"ok": "yes"})
    with pytest.raises(RecordingError, match=r"the writer ended before the flight; .* entries are missing"):
        recorder.close()
    recording = Recording.open(path)
    raw = [m for m in recording.messages() if m.channel.topic in ("/mavlink/raw/autopilot/rx", "/companion/tick")]
    assert len(raw) + recorder.counters.dropped_raw == 40
    assert recorder.counters.dropped_raw >= 20
    assert recording.metadata["outcome"] == {"ok": "yes"}


def test_every_part_tells_the_totals_so_far(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False, rotation=Rotation(seconds=5.0)) as recorder:
        fly(recorder, 1000, range(10, 20))
    parts = Recording.open(path).paths
    assert len(parts) >= 4
    assert all([total for *_, total in told(part)] == [10] for part in parts[1:])


def test_what_the_queue_drops_is_told_at_the_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recorder_module, "MAX_BACKLOG", 300)
    monkeypatch.setattr(recorder_module, "BATCH_S", 10.0)  # the thread sleeps until close
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=True)
    fly(recorder, 200, range(0))
    with pytest.raises(RecordingError, match="100 entries are missing"):
        recorder.close()
    assert ("recorder.dropped_raw", 100) in [(of, total) for _, of, total in told(tmp_path / "a.mcap")]


def test_mirrors_that_find_no_place_in_the_queue_are_no_entries_that_are_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recorder_module, "MAX_BACKLOG", 40)
    monkeypatch.setattr(recorder_module, "BATCH_S", 10.0)  # the thread sleeps until close
    with Recorder(tmp_path / "a.mcap", metadata={}, threaded=True) as recorder:
        fly(recorder, 20, range(0))
        for _ in range(7):
            recorder.mirror(Said(6, "words"), log_time_ns=400_000_000, now_us=400_000, tick=20)
        assert recorder.notices() == []
    assert (recorder.counters.dropped_raw, recorder.counters.dropped_decoded) == (0, 7)
    assert [(of, total) for _, of, total in told(tmp_path / "a.mcap")] == [("recorder.dropped_decoded", 7)]
    assert Recording.open(tmp_path / "a.mcap").metadata["recorder"]["dropped_decoded"] == "7"
