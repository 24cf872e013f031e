"""A smaller recording made of another, and two recordings side by side."""

import math
import tracemalloc
from pathlib import Path
from typing import Any

import pytest
from logs_traffic import heartbeat, record, record_captured
from mcap.reader import make_reader

from logs import Recording, RecordingError, schema
from logs.container import Attachment
from logs.diff import diff
from logs.filter import filtered
from logs.recorder import Recorder
from logs.selection import Selection
from logs.table import ticks
from logs.wire_replay import paced, vehicle_link, vehicle_traffic
from wire.dialect import mavlink as m


def flight(path: Path, **changes: Any) -> Recording:
    """A small flight; `changes` says what is otherwise in it."""
    mav = m.MAVLink(None, srcSystem=1, srcComponent=1)
    attachment = Attachment("mission.yaml", "application/yaml", b"name: x")
    speed = changes.get("speed", 5.0)
    messages = [
        m.MAVLink_param_value_message(b"MPC_XY_VEL_MAX", speed, 9, 2, 0),
        m.MAVLink_param_value_message(b"SYS_AUTOSTART", 5.605193857299268e-45, 6, 2, 1),  # 4, in PX4's bytes
        m.MAVLink_statustext_message(6, changes.get("says", b"Takeoff detected")),
        *(m.MAVLink_attitude_message(t, 0.1, math.nan, 0.3, 0, 0, 0) for t in range(20)),
        *(m.MAVLink_attitude_message(t, changes.get("roll", 0.1), math.nan, 0.3, 0, 0, 0) for t in range(20, 40)),
        *(m.MAVLink_system_time_message(t, t) for t in range(changes.get("times", 3))),
    ]
    with Recorder(path, metadata={"run": {"seed": "1"}}, attachments=[attachment], threaded=False) as recorder:
        recorder.datagram("autopilot", "rx", heartbeat(), log_time_ns=changes.get("at", 0), now_us=0, tick=0)
        for tick, message in enumerate(messages, 1):
            at_ns = changes.get("at", 0) + tick * 1_000_000
            recorder.datagram("autopilot", "rx", bytes(message.pack(mav)), log_time_ns=at_ns, now_us=tick, tick=tick)
    return Recording.open(path)


def test_what_is_wanted_comes_with_its_times_tables_and_attachments_for_any_reader(tmp_path: Path) -> None:
    path = tmp_path / "flight.mcap"
    with Recorder(
        path, metadata={"run": {"seed": "1"}}, attachments=[Attachment("m", "text/plain", b"x")], threaded=False
    ) as recorder:
        record_captured(recorder)
        record(recorder, schema.Note(6, "flying", "x"), 3_000_000, 400)
    recording = Recording.open(path)
    done = filtered(recording, tmp_path / "small.mcap", Selection(start_s=1.0, duration_s=2.0))
    small = Recording.open(done.path)
    assert small.complete
    assert small.attachments == recording.attachments
    assert small.metadata["run"] == {"seed": "1"}
    assert small.metadata["filter"] == {"of": "flight.mcap", "start_s": "1.0", "duration_s": "2.0"}
    expected = [item for item in recording.messages() if 1_000_000_000 <= item.log_time_ns <= 3_000_000_000]
    assert list(small.messages()) == expected
    with done.path.open("rb") as file:
        assert sum(1 for _ in make_reader(file, validate_crcs=True).iter_messages()) == done.messages
    assert len(list(paced(vehicle_traffic(small, vehicle_link(small))))) > 100
    with pytest.raises(RecordingError, match=r"should be|some were lost"):
        list(ticks(small))


def test_a_recording_is_not_filtered_into_itself(tmp_path: Path) -> None:
    recording = flight(tmp_path / "a.mcap")
    with pytest.raises(RecordingError, match="is the recording itself"):
        filtered(recording, recording.path, Selection(), force=True)
    assert recording.complete


def test_a_smaller_recording_is_not_put_before_parts_of_another(tmp_path: Path) -> None:
    recording = flight(tmp_path / "a.mcap")
    for number in (2, 3):
        (tmp_path / f"old.part000{number}.mcap").write_bytes(recording.path.read_bytes())
    with pytest.raises(RecordingError, match=r"old\.part0002\.mcap, old\.part0003\.mcap are there already, parts of"):
        filtered(recording, tmp_path / "old.mcap", Selection(), force=True)
    assert not (tmp_path / "old.mcap").exists()


def test_a_recording_does_not_differ_from_itself_nor_from_the_same_an_hour_later(tmp_path: Path) -> None:
    one, later = flight(tmp_path / "a.mcap"), flight(tmp_path / "b.mcap", at=3_600_000_000_000)
    found = diff(one, later)
    assert found.same
    assert found.compared == found.equal == 47


def test_the_first_divergence_is_named_by_message_and_field_with_how_often_and_how_far(tmp_path: Path) -> None:
    found = diff(flight(tmp_path / "a.mcap"), flight(tmp_path / "b.mcap", roll=0.25))
    assert not found.same
    [field] = found.fields
    assert found.first == field
    assert (field.topic, field.name, field.count) == ("/mavlink/1/1/ATTITUDE", "roll", 20)
    assert field.largest == pytest.approx(0.15)
    assert (field.left, field.right, field.first_ns) == (0.1, 0.25, 24_000_000)
    assert diff(Recording.open(tmp_path / "a.mcap"), Recording.open(tmp_path / "b.mcap"), ignore=["ATTITUDE.roll"]).same
    assert diff(Recording.open(tmp_path / "a.mcap"), Recording.open(tmp_path / "b.mcap"), tolerance=0.2).same


def test_what_only_one_recording_has_more_of_is_not_kept_in_memory(tmp_path: Path) -> None:
    count = 3000
    kinds = m.MAVLink_system_time_message(1, 1), m.MAVLink_vfr_hud_message(1, 1, 1, 1, 1, 1)
    sides = []
    for many, few in (kinds, kinds[::-1]):
        mav = m.MAVLink(None, srcSystem=1, srcComponent=1)
        path = tmp_path / f"{len(sides)}.mcap"
        with Recorder(path, metadata={}, threaded=False) as recorder:
            for tick, message in enumerate([few] + [many] * count):
                data = bytes(message.pack(mav))
                recorder.datagram("autopilot", "rx", data, log_time_ns=tick, now_us=tick, tick=tick)
        sides.append(Recording.open(path))
    diff(sides[0], sides[0])  # what is made once for all
    tracemalloc.start()
    try:
        found = diff(*sides)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert sorted(found.counts.values()) == [(1, count), (count, 1)]
    assert peak < 2_500_000, peak


def test_parameters_that_differ_are_named_with_both_values(tmp_path: Path) -> None:
    found = diff(flight(tmp_path / "a.mcap"), flight(tmp_path / "b.mcap", speed=8.0))
    assert found.parameters == {(1, 1, "MPC_XY_VEL_MAX"): (5.0, 8.0)}
    nothing = diff(
        flight(tmp_path / "c.mcap"), Recording.open(tmp_path / "a.mcap"), Selection(topics=("/mavlink/1/1/HEARTBEAT",))
    )
    assert nothing.same


def test_an_integer_in_px4s_bytes_is_told_as_the_integer(tmp_path: Path) -> None:
    path = tmp_path / "b.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        recorder.datagram("autopilot", "rx", heartbeat(), log_time_ns=0, now_us=0, tick=0)
    assert diff(flight(tmp_path / "a.mcap"), Recording.open(path)).parameters[1, 1, "SYS_AUTOSTART"] == (4, None)


def test_events_and_numbers_of_messages_that_differ_are_told(tmp_path: Path) -> None:
    found = diff(flight(tmp_path / "a.mcap"), flight(tmp_path / "b.mcap", says=b"Landing detected", times=5))
    assert [(event.side, event.text) for event in found.events] == [
        ("left", "1/1 says: Takeoff detected"),
        ("right", "1/1 says: Landing detected"),
    ]
    assert found.counts == {"/mavlink/1/1/SYSTEM_TIME": (3, 5)}
