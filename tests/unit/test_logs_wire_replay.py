"""Wire replay: what the vehicle sent, with its own spacing, and nothing else."""

from pathlib import Path

import pytest
from logs_traffic import captured, heartbeat, record_captured, sent_by_ground

from logs import Recording, RecordingError
from logs.recorder import Recorder
from logs.selection import Selection
from logs.wire_replay import Due, Pace, paced, repeated, sent_traffic, vehicle_link, vehicle_links, vehicle_traffic


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    path = tmp_path_factory.mktemp("recording") / "flight.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        recorder.datagram("gcs", "rx", heartbeat(255, 190, 8), log_time_ns=0, now_us=0, tick=0)
        record_captured(recorder)
    return Recording.open(path)


@pytest.mark.parametrize("rate", [1.0, 4.0, 0.5])
def test_the_recorded_spacing_is_kept_divided_by_the_rate(recording: Recording, rate: float) -> None:
    vehicle = [(time_us, packet) for time_us, packet in captured() if not sent_by_ground(packet)]
    start_us = vehicle[0][0]
    due = list(paced(vehicle_traffic(recording, "autopilot"), rate))
    assert [item.data for item in due] == [packet for _, packet in vehicle]
    assert [item.due_s for item in due] == pytest.approx([(time - start_us) / 1e6 / rate for time, _ in vehicle])
    assert due[0].due_s == 0.0


def test_what_was_sent_to_the_vehicle_is_never_replayed(recording: Recording) -> None:
    assert not any(sent_by_ground(item.data) for item in paced(vehicle_traffic(recording, "autopilot")))


def test_the_vehicles_link_is_the_one_an_autopilot_was_heard_on(recording: Recording) -> None:
    assert vehicle_link(recording) == "autopilot"


def test_a_recording_without_an_autopilot_is_one_line(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        recorder.datagram("gcs", "rx", heartbeat(255, 190, 8), log_time_ns=0, now_us=0, tick=0)
    with pytest.raises(RecordingError, match=r"no autopilot was heard on any link \(links: gcs\)"):
        vehicle_link(Recording.open(path))


def test_stamps_that_run_backwards_do_not_send_into_the_past(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for tick, stamp in enumerate((1_000, 5_000, 3_000, 6_000)):
            recorder.datagram("autopilot", "rx", heartbeat(), log_time_ns=stamp, now_us=tick, tick=tick)
    due = [item.due_s for item in paced(vehicle_traffic(Recording.open(path), "autopilot"))]
    assert due == pytest.approx([0.0, 4e-6, 4e-6, 5e-6])


@pytest.mark.parametrize("rate", [0.0, -1.0, float("inf"), float("nan")])
def test_a_rate_that_is_no_rate_is_refused(rate: float) -> None:
    with pytest.raises(ValueError, match="expected a positive number"):
        paced([], rate)


def test_what_was_sent_comes_only_by_its_own_name_and_then_alone(recording: Recording) -> None:
    sent = [packet for _, packet in captured() if sent_by_ground(packet)]
    assert sent
    assert [item.data for item in paced(sent_traffic(recording, "autopilot"))] == sent


def test_only_links_with_an_autopilot_are_the_vehicles(recording: Recording) -> None:
    assert vehicle_links(recording) == ("autopilot",)


def test_a_stretch_begins_at_once_and_says_where_it_is(recording: Recording) -> None:
    wanted = Selection(start_s=2.0, duration_s=1.0, names=("ATTITUDE",))
    due = list(paced(vehicle_traffic(recording, "autopilot", wanted), 2.0, origin_ns=0))
    assert due[0].due_s == 0.0
    assert 2.0 <= due[0].at_s < 2.1
    assert due[-1].at_s <= 3.0
    assert due[-1].due_s == pytest.approx((due[-1].at_s - due[0].at_s) / 2.0)
    assert all(item.data[7] == 30 for item in due)


def test_a_loop_goes_on_with_the_mean_spacing_between_its_rounds() -> None:
    traffic = [Due(0.0, b"a"), Due(1.0, b"b"), Due(4.0, b"c")]
    found = list(repeated(lambda: traffic, 2))
    assert [(item.due_s, item.data) for item in found] == [
        (0.0, b"a"),
        (1.0, b"b"),
        (4.0, b"c"),
        (6.0, b"a"),
        (7.0, b"b"),
        (10.0, b"c"),
    ]
    assert list(repeated(lambda: [])) == []
    endless = repeated(lambda: [Due(0.0, b"x")])
    assert [next(endless).due_s for _ in range(3)] == [0.0, 1.0, 2.0]


def test_a_pause_moves_everything_behind_it() -> None:
    pace, due = Pace(100.0), Due(5.0, b"x")
    assert pace.deadline(due) == 105.0
    pace.toggle(102.0)
    assert pace.paused
    assert pace.deadline(due) is None
    pace.toggle(112.0)
    assert pace.deadline(due) == 115.0


def test_a_step_sends_one_and_stands_still_and_the_next_keeps_its_distance() -> None:
    pace = Pace(100.0)
    first, second = Due(5.0, b"1"), Due(6.5, b"2")
    pace.step(102.0)
    deadline = pace.deadline(first)
    assert deadline is not None
    assert deadline <= 102.0
    pace.sent(first)
    assert pace.deadline(second) is None
    pace.toggle(200.0)
    assert pace.deadline(second) == pytest.approx(201.5)
