"""A report of each kind of recording: it says what the flight's verdict says, and what a recording does not hold."""

import gzip
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from companion.cli.app import app
from companion.cli.report import surroundings_of, write_report
from logs import schema
from logs.errors import RecordingError
from logs.importing import import_log
from logs.reader import Recording
from logs.recorder import Recorder
from logs.report import contract as c
from logs.report.gather import gather
from tests.recorded.streams import packets
from wire.dialect import mavlink

TLOGS = Path("tests/data")
MOST_SECTIONS = ["path", "tracking", "setpoints", "estimator", "actuators", "planning", "link", "parameters"]


@pytest.fixture(scope="session")
def companions(flown) -> c.Report:
    recording = Recording.open(flown.companions)
    return gather(recording, surroundings_of(recording))


@pytest.fixture(scope="session")
def vehicles(flown) -> c.Report:
    return gather(Recording.open(flown.vehicles))


def imported(name: str, path: Path) -> Path:
    """A recording of somebody's telemetry log, both directions on one link."""
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for k, (us, packet) in enumerate(packets(TLOGS / name)):
            recorder.datagram("tlog", "rx", packet, log_time_ns=us * 1000, now_us=us, tick=k)
    return path


def series_of(report: c.Report, id: str, label: str) -> c.Series:
    plot = next(plot for plot in report.plots if plot.id == id)
    return next(series for series in plot.series if series.label == label)


def table_of(report: c.Report, title: str) -> dict[object, list[object]]:
    table = next(table for table in report.tables if table.title == title)
    return {row[0]: list(row[1:]) for row in table.rows}


def left_out(report: c.Report) -> dict[object, object]:
    rows = [t.rows for t in report.tables if t.title.startswith("Left out")]
    return {row[0]: row[1] for row in (rows[0] if rows else [])}


def test_a_report_of_a_flight_says_what_its_verdict_says(flown, companions):
    verdict, header = flown.verdict, companions.header
    assert (header.title, header.ok, header.phase, header.failure) == ("L-shaped wall", True, "done", "")
    found = {check.name: check.value for check in header.checks}
    assert found["tracking_error_p95_m"] == verdict["tracking_error_p95_m"]
    assert found["min_clearance_m"] == verdict["min_clearance_m"]
    assert all(check.ok for check in header.checks)
    assert len(header.checks) == 5


def test_what_a_report_measures_itself_is_what_the_verdict_measured_in_flight(flown, companions):
    verdict = flown.verdict
    to = table_of(companions, "Tracking error")
    assert to["to the truth"][1] == pytest.approx(verdict["tracking_error_p95_m"], abs=0.002)
    assert to["to the truth"][2] == pytest.approx(verdict["tracking_error_max_m"], abs=0.003)
    assert to["to the estimate"][1] == pytest.approx(verdict["estimate_error_p95_m"], abs=0.002)
    assert companions.scene.least is not None
    assert companions.scene.least[2] == pytest.approx(verdict["min_clearance_m"], abs=0.005)
    spacing = table_of(companions, "Spacing")
    assert spacing["spacing p99 [ms]"][0] == pytest.approx(verdict["setpoint_gap_p99_ms"], abs=0.01)


def test_every_section_of_a_companions_flight_has_something_in_it(companions):
    filled = {entry.section for entry in (*companions.plots, *companions.tables)}
    assert [section for section in MOST_SECTIONS if section not in filled] == []
    assert left_out(companions) == {}
    assert len({plot.id for plot in companions.plots}) == len(companions.plots)


def test_the_obstacles_are_known_without_the_mission_from_what_viewers_are_told(flown, companions):
    bare = gather(Recording.open(flown.companions)).scene
    known = [(tuple(o["low"]), tuple(o["high"])) for o in companions.scene.obstacles]
    assert [(tuple(o["low"]), tuple(o["high"])) for o in bare.obstacles] == known


def test_the_scene_has_the_walls_the_plan_and_the_place_of_the_least_clearance(companions):
    scene = companions.scene
    assert [solid["kind"] for solid in scene.obstacles] == ["box", "box"]
    assert scene.obstacles[0]["low"] == [9.0, 6.0, 0.0]
    plan = np.asarray(scene.plans[0].points)
    np.testing.assert_allclose(plan[[0, -1]], [[1, 10, 1.5], [19, 10, 1.5]], atol=1e-6)
    assert scene.least is not None
    _, (n, e, u), clearance = scene.least
    away = np.maximum([9.0 - n, 6.0 - e, 0.0 - u], [n - 10.0, e - 15.0, u - 4.0]).clip(0.0)  # of the long arm
    assert clearance == pytest.approx(np.linalg.norm(away) - 0.35, abs=1e-6)
    assert np.nanmin(series_of(companions, "clearance", "nearest").v) == pytest.approx(clearance)
    landed = np.asarray(scene.truth.n)[-1], np.asarray(scene.truth.e)[-1]
    assert landed == pytest.approx((19.0, 10.0), abs=0.4)


def test_the_timeline_has_phases_modes_commands_and_their_answers_in_order(companions):
    events = companions.events
    assert [e.t for e in events] == sorted(e.t for e in events)
    phases = [e.text.split(" -> ")[1].split(" (")[0] for e in events if e.kind == "phase"]
    assert phases == ["preparing", "planning", "engaging", "arming", "taking off", "flying", "landing", "done"]
    assert [e.text for e in events if e.kind == "mode"][:3] == ["mode Hold", "mode Offboard", "armed"]
    assert any(e.text.startswith("COMPONENT_ARM_DISARM (1)") for e in events if e.kind == "command")
    assert any(e.text == "COMPONENT_ARM_DISARM: accepted" for e in events if e.kind == "ack")
    said = [e for e in events if "Takeoff detected" in e.text]
    assert len(said) == 1  # the vehicle's text and the companion's word of it are one event


def test_a_vehicles_own_recording_shows_rotors_and_whether_its_filter_believes_itself_rightly(vehicles):
    shown = {series.label for plot in vehicles.plots if plot.id == "rotors" for series in plot.series}
    assert shown == {f"rotor {k}" for k in (1, 2, 3, 4)}
    rows = table_of(vehicles, "Normalised innovations squared")
    for name, dof in (("gps velocity", 3), ("gps position", 2), ("baro", 1), ("mag", 3)):
        assert rows[name][0] == dof
        assert rows[name][1] == pytest.approx(dof, rel=0.3)  # the mean of chi^2 is its degrees of freedom
        assert rows[name][3] > 85.0
    assert left_out(vehicles).keys() == {"planning"}
    assert vehicles.header.ok is None


def test_the_positions_error_is_weighed_with_the_covariance_that_is_told(companions):
    nees = np.asarray(series_of(companions, "nees", "NEES").v)
    off = np.asarray(series_of(companions, "estimate-error", "horizontal").v)
    assert np.nanmin(nees) >= 0.0
    assert 0.05 < np.nanmedian(nees) / (np.nanmedian(off) ** 2 / 0.0018) < 20.0  # a variance of about 0.0018 m^2


def test_test_ratios_and_the_gate_give_the_nis_that_the_estimator_itself_tells(flown, vehicles, monkeypatch):
    monkeypatch.setattr(
        "logs.report.traffic._UNSEEN", (schema.EstimatorBegin, schema.EstimatorInputs, schema.EstimatorState)
    )
    guessed = gather(Recording.open(flown.vehicles))
    told = table_of(vehicles, "Normalised innovations squared")
    rows = table_of(guessed, "Normalised innovations squared")
    names = {"velocity": "gps velocity", "horizontal position": "gps position", "height": "baro", "magnetometer": "mag"}
    for name, known in names.items():
        assert rows[name][:1] == told[known][:1]
        assert rows[name][1] == pytest.approx(told[known][1], rel=0.35)  # of every measurement, and of five a second
    nis = next(series for plot in guessed.plots if plot.id == "nis-velocity" for series in plot.series)
    every = np.asarray(next(s for plot in vehicles.plots if plot.id == "nis-gps-velocity" for s in plot.series).v)
    found = [np.abs(every - value).min() < 1e-4 * max(1.0, value) for value in np.asarray(nis.v)]
    assert np.mean(found) > 0.95  # the same numbers, through a float32


def test_both_sides_of_one_flight_tell_the_same_motion(companions, vehicles):
    theirs, ours = (series_of(r, "altitude", "truth") for r in (vehicles, companions))
    assert np.max(theirs.v) - theirs.v[0] == pytest.approx(np.max(ours.v) - ours.v[0], abs=0.02)
    spacing = table_of(vehicles, "Spacing"), table_of(companions, "Spacing")
    assert spacing[0]["setpoints"][0] == pytest.approx(spacing[1]["setpoints"][0], abs=1)


def test_a_real_px4_flight_recorded_by_somebody_else_is_told_with_what_it_has(tmp_path):
    report = gather(Recording.open(imported("px4-offboard.tlog.gz", tmp_path / "px4.mcap")))
    assert "planning" in left_out(report)
    assert {"mode Offboard", "mode Land", "armed", "disarmed"} <= {e.text for e in report.events if e.kind == "mode"}
    assert "px4" in dict(report.header.facts)["vehicle"]
    assert report.header.ok is None
    assert report.header.start_utc is not None


def test_a_real_arducopter_flight_is_told_with_its_modes_by_name(tmp_path):
    report = gather(Recording.open(imported("arducopter-guided-circle-streams.tlog.gz", tmp_path / "copter.mcap")))
    assert {"mode Guided", "mode Land"} <= {e.text for e in report.events if e.kind == "mode"}
    assert any(plot.id == "ratios-193" for plot in report.plots)


def test_a_recording_of_nothing_but_a_text_still_makes_a_page(tmp_path):
    path = tmp_path / "empty.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        recorder.datagram("a", "rx", b"not mavlink", log_time_ns=5, now_us=0, tick=0)
    report, size, _ = write_report(path, tmp_path / "empty.html")
    assert set(left_out(report)) == {"path", "tracking", "setpoints", "estimator", "actuators", "planning", "timeline",
                                     "parameters"}  # fmt: skip
    assert report.scene.path.to_json()["t"] == []
    assert size > 100_000


def test_gaps_in_the_sequence_are_counted_and_shown_when_they_were(flown, tmp_path):
    path = tmp_path / "gaps.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for message in Recording.open(flown.vehicles).messages():
            if message.channel.direction == "tx" and not 4000 <= message.tick < 4025:
                at = {"log_time_ns": message.log_time_ns, "now_us": message.log_time_ns // 1000, "tick": message.tick}
                recorder.datagram("l", "rx", message.data, **at)
    report = gather(Recording.open(path))
    lost = dict(report.header.loss)["packets missing by sequence"]
    assert 20 < lost < 128
    shown = series_of(report, "link-gaps", "l 1/1")
    assert shown.v[-1] == lost
    assert shown.t[1] == pytest.approx(16.1, abs=0.1)  # tick 4000 of 4 ms, and what came before the first


def test_a_recording_too_long_to_be_kept_whole_keeps_its_extremes_and_says_so(flown, companions, monkeypatch):
    monkeypatch.setattr("logs.report.columns.MOST_ROWS", 600)
    part = gather(Recording.open(flown.companions))
    assert "ATTITUDE" in table_of(part, "Too long to be kept whole")
    for label in ("roll", "pitch"):
        kept, whole = (np.asarray(series_of(report, "attitude", label).v) for report in (part, companions))
        assert len(kept) < len(whole)
        assert (np.nanmin(kept), np.nanmax(kept)) == (np.nanmin(whole), np.nanmax(whole))


def test_parameters_are_held_against_another_recording(flown):
    recording = Recording.open(flown.companions)
    same = gather(recording, against=recording)
    assert any(table.title.startswith("Nothing differs") for table in same.tables)
    other = gather(recording, against=Recording.open(flown.vehicles))
    assert any(table.section == "parameters" for table in other.tables)


def test_the_command_writes_page_and_pictures_and_says_so(flown, tmp_path):
    page, folder = tmp_path / "r.html", tmp_path / "png"
    arguments = ["report", str(flown.companions), "-o", str(page), "--png", str(folder), "--json"]
    outcome = CliRunner().invoke(app, arguments)
    assert outcome.exit_code == 0
    told = json.loads(outcome.stdout)
    assert told["ok"]
    assert told["flight_ok"]
    assert told["bytes"] == page.stat().st_size < 2_000_000
    assert page.read_text().startswith("<!doctype html>")
    pictures = sorted(path.name for path in folder.iterdir())
    assert pictures == sorted(Path(p).name for p in told["pictures"])
    assert {"scene.png", "tracking.png", "timeline.png"} <= set(pictures)
    assert all(path.read_bytes()[:4] == b"\x89PNG" for path in folder.iterdir())


def test_another_programs_log_is_told_as_its_import_is_and_held_against_a_recording(flown, tmp_path):
    log, page = TLOGS / "px4-offboard-65s-71s.tlog", tmp_path / "r.html"
    report, size, _ = write_report(log, page, against=flown.companions)
    whole = gather(Recording.open(import_log(log, tmp_path / log.name).path), against=Recording.open(flown.companions))
    assert json.dumps(report.to_json()) == json.dumps(whole.to_json())
    assert dict(report.header.facts)["recording"] == log.name
    assert size == page.stat().st_size


def test_packets_that_are_missing_are_counted_once_though_the_recorder_counted_them_too(tmp_path):
    log = tmp_path / "a.tlog"
    log.write_bytes(gzip.decompress((TLOGS / "px4-offboard-streams.tlog.gz").read_bytes()))
    report, _, _ = write_report(log, tmp_path / "r.html")
    (missing,) = [count for _, count in report.header.loss if count]
    assert missing == next(row[3] for t in report.tables if t.title == "Senders" for row in t.rows if row[1] == "1/1")


@pytest.mark.parametrize("name", ["a.tlog", "a.BIN", "a.mcap", "a.txt"])
def test_what_is_no_log_is_one_line_and_no_page(tmp_path, name):
    (tmp_path / name).write_bytes(bytes(range(256)) * 8)
    with pytest.raises(RecordingError) as caught:
        write_report(tmp_path / name, tmp_path / "r.html")
    assert str(caught.value).startswith(f"{tmp_path / name}: ")
    assert "\n" not in str(caught.value)
    assert [path.name for path in tmp_path.iterdir()] == [name]


def test_the_page_is_never_written_over_the_recording(flown):
    before = flown.companions.read_bytes()
    outcome = CliRunner().invoke(app, ["report", str(flown.companions), "-o", str(flown.companions)])
    assert outcome.exit_code != 0
    assert flown.companions.read_bytes() == before


def test_a_report_is_the_same_for_the_same_recording(flown, companions):
    recording = Recording.open(flown.companions)
    again = gather(recording, surroundings_of(recording))
    assert json.dumps(again.to_json()) == json.dumps(companions.to_json())


def test_a_recording_without_a_verdict_is_judged_by_its_missions_expectations(flown, monkeypatch):
    monkeypatch.setattr("logs.report.gather._outcome", lambda metadata: {})
    recording = Recording.open(flown.companions)
    around = surroundings_of(recording)
    header = gather(recording, around).header
    assert (header.ok, header.phase) == (True, "done")
    assert [check.ok for check in header.checks] == [True] * 4
    assert float(dict(header.facts)["path"].split()[0]) == pytest.approx(flown.verdict["path_length_m"], abs=0.05)
    header = gather(recording, replace(around, expected={"tracking_error_p95_m": (0.01, False)})).header
    assert header.ok is False
    assert [check.ok for check in header.checks] == [False]


def test_what_tells_where_it_is_on_the_earth_is_shown_where_it_was_in_the_flights_frame(tmp_path):
    path, encoder = tmp_path / "told.mcap", mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for k in range(200):
            ms, north = 100 * k, 0.1 * k
            lat = round((47.0 + north / 111_165.0) * 1e7)  # a degree of latitude is 111 165 m at 47 N, 500 m up
            ball = round((47.0 + 30.0 / 111_165.0) * 1e7)
            told = [
                encoder.heartbeat_encode(2, 12, 0, 0, 3),
                encoder.local_position_ned_encode(ms, 5.0 + north, -3.0, -2.0, 1.0, 0.0, 0.0),
                encoder.global_position_int_encode(ms, lat, 85_000_000, 500_000, 2000, 100, 0, 0, 0),
                encoder.adsb_vehicle_encode(
                    0xABC, ball, 85_000_000, 1, 503_000 + 10 * k, 0, 0, 0, b"BALL", 14, 0, 3, 0
                ),
                encoder.adsb_vehicle_encode(
                    0xDEF, ball + 1_000_000, 85_000_000, 1, 503_000, 0, 0, 0, b"FAR", 14, 0, 3, 0
                ),
            ]
            for message in told:
                data = bytes(message.pack(encoder))
                recorder.datagram("l", "rx", data, log_time_ns=ms * 1_000_000, now_us=ms * 1000, tick=k)
    (mover,) = gather(Recording.open(path)).scene.movers
    assert mover.id == "BALL"
    assert np.asarray(mover.track.n)[[0, -1]] == pytest.approx([35.0, 35.0], abs=0.05)
    assert np.asarray(mover.track.e)[[0, -1]] == pytest.approx([-3.0, -3.0], abs=0.05)
    assert np.asarray(mover.track.u)[[0, -1]] == pytest.approx([5.0, 6.99], abs=0.01)


def test_aircraft_whose_place_is_not_known_are_not_shown(tmp_path):
    path, encoder = tmp_path / "unknown.mcap", mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for k in range(20):
            told = [
                encoder.heartbeat_encode(2, 12, 0, 0, 3),
                encoder.adsb_vehicle_encode(0xABC, 470_000_000, 85_000_000, 1, 0, 0, 0, 0, b"B", 14, 0, 3, 0),
            ]
            for message in told:
                data = bytes(message.pack(encoder))
                recorder.datagram("l", "rx", data, log_time_ns=k * 10**8, now_us=k * 10**5, tick=k)
    assert gather(Recording.open(path)).scene.movers == ()
