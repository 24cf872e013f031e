"""A recording as the table of ticks that a re-run feeds on."""

from pathlib import Path

import pytest
from logs_traffic import PEER, heartbeat, record, record_captured, setpoint

from logs import Recording, RecordingError, schema, ticks
from logs.recorder import Recorder
from wire.datagram import Datagram

PLAN = schema.PlanReady(request_id=1, ok=True, control_points=(0.1, 0.2, 0.3), knots=(0.0,))
LAND = schema.OperatorCommand("land")
NOTE = schema.Note(6, "FLYING", "leg 1 planned")
WANTED = schema.PlanWanted(request_id=2, start=(0.0, 0.0, 0.0), goal=(1.0, 0.0, 0.0))


def write_tick(
    recorder: Recorder,
    tick: int,
    inputs: list[Datagram | schema.Record],
    outputs: list[Datagram | schema.Record],
    *,
    forget: int = 0,
) -> None:
    """One tick as a driver records it; `forget` of its outputs are left out."""
    now_us = 1_000_000 + tick * 20_000
    for item in inputs:
        if isinstance(item, Datagram):
            recorder.datagram(
                item.link, "rx", item.data, log_time_ns=now_us * 1000 - 5, now_us=now_us, tick=tick, peer=item.peer
            )
        else:
            record(recorder, item, now_us, tick)
    record(recorder, schema.Tick(now_us, len(inputs), len(outputs)), now_us, tick)
    for item in outputs[: len(outputs) - forget]:
        if isinstance(item, Datagram):
            recorder.datagram(
                item.link, "tx", item.data, log_time_ns=now_us * 1000 + 5, now_us=now_us, tick=tick, peer=item.peer
            )
        else:
            record(recorder, item, now_us, tick)


def test_inputs_and_outputs_come_back_in_the_order_of_the_seam_with_links_and_peers(tmp_path: Path) -> None:
    inputs: list[Datagram | schema.Record] = [
        Datagram("gcs", heartbeat(255, 190), ("127.0.0.1", 14550)),
        PLAN,
        Datagram("autopilot", heartbeat(), PEER),
        Datagram("autopilot", b"rubbish", PEER),
        LAND,
    ]
    outputs: list[Datagram | schema.Record] = [
        NOTE,
        Datagram("autopilot", setpoint(1.0), PEER),
        WANTED,
        Datagram("gcs", b"x"),
    ]
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        write_tick(recorder, 0, inputs, outputs)
        write_tick(recorder, 1, [], [])
        write_tick(recorder, 2, [inputs[0]], [outputs[1]])
    rows = list(ticks(Recording.open(path)))
    assert [(row.index, row.now_us) for row in rows] == [(0, 1_000_000), (1, 1_020_000), (2, 1_040_000)]
    assert [item for _, item in rows[0].inputs] == inputs
    assert [item for _, item in rows[0].outputs] == outputs
    assert rows[0].inputs[0][0] == 1_000_000_000 - 5
    assert (rows[1].inputs, rows[1].outputs) == ([], [])
    assert len(rows[2].inputs) == len(rows[2].outputs) == 1


def test_a_real_flight_gives_one_row_a_tick(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=True) as recorder:
        rx, tx = record_captured(recorder)
    rows = list(ticks(Recording.open(path)))
    assert [row.index for row in rows] == list(range(300))
    assert sum(len(row.inputs) for row in rows) == rx
    assert sum(len(row.outputs) for row in rows) == tx


def test_a_lost_output_is_noticed_and_the_tick_named(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        write_tick(recorder, 0, [], [NOTE])
        write_tick(recorder, 1, [LAND], [NOTE, NOTE], forget=1)
        write_tick(recorder, 2, [], [])
    with pytest.raises(RecordingError, match="tick 1 has 1 of 1 inputs and 1 of 2 outputs: some were lost"):
        list(ticks(Recording.open(path)))


def test_a_missing_tick_is_noticed(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        write_tick(recorder, 0, [], [])
        write_tick(recorder, 2, [], [])
    with pytest.raises(RecordingError, match="tick 2 follows where tick 1 should be"):
        list(ticks(Recording.open(path)))


def test_of_a_recording_cut_short_the_whole_ticks_are_given(tmp_path: Path) -> None:
    whole, cut = tmp_path / "whole.mcap", tmp_path / "cut.mcap"
    with Recorder(whole, metadata={}, threaded=False) as recorder:
        record_captured(recorder)
    everything = list(ticks(Recording.open(whole)))
    data = whole.read_bytes()
    for length in range(len(data) // 4, len(data), len(data) // 5):
        cut.write_bytes(data[:length])
        rows = list(ticks(Recording.open(cut)))
        assert rows == everything[: len(rows)]
        assert rows


def test_the_end_of_a_filtered_recording_may_be_cut_within_a_tick_or_two_and_no_more(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={"filter": {"of": "whole.mcap"}}, threaded=False) as recorder:
        for index in range(4):
            write_tick(recorder, index, [LAND], [NOTE])
        write_tick(recorder, 4, [LAND], [NOTE, NOTE], forget=1)
        write_tick(recorder, 5, [LAND], [NOTE])
    assert [row.index for row in ticks(Recording.open(path))] == [0, 1, 2, 3]
    path = tmp_path / "b.mcap"
    with Recorder(path, metadata={"filter": {"of": "whole.mcap"}}, threaded=False) as recorder:
        write_tick(recorder, 0, [LAND], [NOTE, NOTE], forget=1)
        for index in range(1, 9):
            write_tick(recorder, index, [LAND], [NOTE])
    with pytest.raises(RecordingError, match="tick 0 has 1 of 1 inputs and 1 of 2 outputs"):
        list(ticks(Recording.open(path)))
