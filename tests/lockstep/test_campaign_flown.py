"""Campaigns flown: the same table however they are flown, and whenever they are killed."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest

from campaigns.campaign import Progress, fly_campaign, record_flights, write_campaign_tables
from campaigns.executors import local
from campaigns.flying import fly_run, record_run
from campaigns.store import Store, open_store
from campaigns.sweep import load_sweep
from companion.testing.flight import fly
from logs.errors import LogsError

MISSION = """\
name: nudge
vehicle: {start: {north: 2, east: 2}}
world:
  bounds: {north: [0, 10], east: [0, 10], altitude: [0, 4]}
  obstacles: [{cylinder: {north: 6, east: 6, radius: 0.4, altitude: [0, 4]}}]
limits: {climb: 1}
steps: [{takeoff: {altitude: 0.8}}, {goto: {north: 3, east: 2, altitude: 0.8}}, land]
"""
SWEEP = """\
name: nudges
missions: [nudge.yaml]
seeds: [1, 2]
autopilots: [px4]
faults: [none, "motor1:off@6"]
recordings: {failures: 1, sample: 0}
"""
"""Four flights of about ten seconds, of which one or more end on the ground before their time."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("nudges")
    (folder / "nudge.yaml").write_text(MISSION)
    (folder / "sweep.yaml").write_text(SWEEP)
    return folder


@pytest.fixture(scope="module")
def table(folder: Path) -> bytes:
    """What one process finds that does everything by itself."""
    sweep = load_sweep(folder / "sweep.yaml")
    store = open_store(folder / "alone", sweep, resume=False)
    progress = Progress(wanted=len(sweep.runs))
    with closing(local(1)) as executor:
        alone = type("Alone", (), {"map": lambda self, *a, timeout_s, **k: executor.map(*a, **k)})()
        fly_campaign(sweep, store, sweep.runs, alone, progress, lambda _: None)
        record_flights(sweep, store, sweep.runs, alone, progress, lambda _: None)
    write_campaign_tables(sweep, store, progress.lost)
    assert (progress.now, progress.lost, progress.differing) == (4, [], [])
    return (folder / "alone" / "runs.parquet").read_bytes()


COMMAND = [sys.executable, "-m", "companion", "campaign"]


def begun(folder: Path, *more: str) -> subprocess.Popen[bytes]:
    command = [*COMMAND, str(folder / "sweep.yaml"), *more]
    return subprocess.Popen(command, stdout=subprocess.PIPE)


def until(holds: Callable[[], bool]) -> None:
    end = time.monotonic() + 120.0
    while not holds():
        assert time.monotonic() < end, "it did not come to pass in two minutes"
        time.sleep(0.01)


def done_in(out: Path) -> int:
    runs = out / "runs"
    return sum(not path.name.startswith(".") for path in runs.iterdir()) if runs.exists() else 0


def test_the_rows_are_what_the_flights_themselves_say(folder: Path, table: bytes) -> None:
    rows = pq.read_table(folder / "alone" / "runs.parquet").to_pylist()
    assert len(rows) == 4
    assert {row["ok"] for row in rows} == {True, False}
    run = next(run for run in load_sweep(folder / "sweep.yaml").runs if not run.faults)
    row, result = next(row for row in rows if row["run_id"] == run.run_id), fly(run.spec())
    assert result.verdict is not None
    assert row["ok"] is result.ok is True
    assert row["simulated_s"] == result.simulated_s
    assert row["tracking_p95_m"] == result.verdict.tracking_error_p95_m
    assert row["tracking_p50_m"] <= row["tracking_rms_m"] <= row["tracking_max_m"]
    assert row["min_clearance_m"] == result.min_clearance_m
    failed = [row for row in rows if not row["ok"]]
    assert all(row["cause"] and row["faults"] == "motor1:off@6" for row in failed)


@pytest.mark.slow
def test_whatever_ends_it_and_whoever_goes_on_the_table_is_the_same_to_the_byte(folder: Path, table: bytes) -> None:
    out = folder / "ended"

    # GIVEN a campaign of one process that was killed in the middle,
    process = begun(folder, "--out", str(out), "-j", "1")
    until(lambda: done_in(out) >= 1)
    process.kill()
    process.communicate()
    assert done_in(out) < 4

    # and then of two, killed while a flight was recorded,
    process = begun(folder, "--out", str(out), "-j", "2", "--resume")
    until(lambda: any((out / "runs").glob(".*/*.mcap")))
    process.kill()
    process.communicate()
    assert done_in(out) == 4

    # WHEN it goes on, and its worker is killed,
    process = begun(folder, "--out", str(out), "-j", "1", "--resume", "--json")
    until(lambda: bool(workers_of(process.pid)))
    os.kill(min(workers_of(process.pid)), signal.SIGKILL)
    told = json.loads(process.communicate(timeout=120)[0])

    # THEN it ends well, with the table that one process finds which nobody disturbed.
    assert process.returncode == 0
    assert (told["flown"], told["flown_now"], told["not_flown"], told["recordings"]) == (4, 0, [], 1)
    assert (out / "runs.parquet").read_bytes() == table
    assert not list((out / "runs").glob(".*"))


def test_a_flight_that_does_not_end_is_ended_and_a_failure(folder: Path) -> None:
    run = replace(load_sweep(folder / "sweep.yaml").runs[0], limit_s=3.0)
    row = fly_run(run).row
    assert (row["status"], row["ok"], row["simulated_s"]) == ("flown", False, pytest.approx(3.0, abs=0.1))
    assert row["cause"].startswith("not over after 3 s of simulated time")


def test_what_is_wrong_with_us_is_a_result_and_with_the_machine_none(folder: Path, tmp_path: Path) -> None:
    run = load_sweep(folder / "sweep.yaml").runs[0]
    row = fly_run(replace(run, parameters=(("NO_SUCH", 1.0),))).row
    assert (row["status"], row["ok"], row["simulated_s"]) == ("flown", False, None)
    assert row["cause"].startswith("KeyError at ")
    airframe = tmp_path / "own.yaml"
    with pytest.raises(FileNotFoundError):
        fly_run(replace(run, airframe=str(airframe), airframe_sha="0"))
    airframe.write_text("mass: 1\n")
    with pytest.raises(OSError, match="is not the file that the sweep was read with"):
        fly_run(replace(run, airframe=str(airframe), airframe_sha="0"))
    with pytest.raises((OSError, LogsError)):
        record_run((run, Path("/proc/none/flight.mcap")))


def test_a_recording_is_made_whatever_somebody_who_died_over_it_has_left(folder: Path, tmp_path: Path) -> None:
    run, file = load_sweep(folder / "sweep.yaml").runs[0], tmp_path / "partial" / "flight.mcap"
    run = replace(run, limit_s=2.0)
    file.parent.mkdir()
    file.write_bytes(b"half a recording")
    assert record_run((run, file)).row == fly_run(run).row
    assert file.read_bytes().startswith(b"\x89MCAP0")
    assert os.listdir(file.parent) == ["flight.mcap"]


def test_a_run_flown_again_is_the_very_same(folder: Path, table: bytes) -> None:
    store = Store(folder / "alone")
    stored = next(store.stored())
    assert fly_run(store.run(stored.row["run_id"])).row == stored.row


def workers_of(pid: int) -> set[int]:
    """Its children that are workers of an executor; not the process that looks after shared resources."""
    found: set[int] = set()
    for path in Path(f"/proc/{pid}/task/{pid}").glob("children"):
        for child in path.read_text().split():
            words: Any = Path(f"/proc/{child}/cmdline")
            try:
                if b"spawn_main" in words.read_bytes():
                    found.add(int(child))
            except FileNotFoundError:
                continue
    return found
