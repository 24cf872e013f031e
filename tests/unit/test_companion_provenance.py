"""What a recording says of itself: whose it is, and what came of the flight."""

import json
import math
import shutil
import subprocess
import time
from dataclasses import replace

import numpy as np
import pytest

from companion.core import Companion, CompanionConfig
from companion.drivers.provenance import outcome_table, revision
from companion.drivers.recording import header, unix_clock
from companion.drivers.rerun import fresh_companion
from companion.mission import Expect
from companion.missionfile import parse_mission
from companion.verdict import Verdict
from logs import Recording
from logs.parts import Rotation
from logs.recorder import Recorder

FLOWN = Verdict(
    ok=False,
    mission="a wall",
    seed=0,
    phase="done",
    failure="",
    failed_expectations=["duration_max_s: found 21.000, expected at most 20"],
    duration_s=21.0,
    path_length_m=None,
    tracking_error_p50_m=0.05,
    tracking_error_p95_m=0.1,
    tracking_error_max_m=0.2,
    tracking_error_source="truth",
    estimate_error_p50_m=0.1,
    estimate_error_p95_m=0.1,
    estimate_error_max_m=0.1,
    min_clearance_m=0.7,
    setpoint_rate_hz=50.0,
    setpoint_gap_p99_ms=None,
    setpoint_gap_max_ms=math.inf,
    track=None,
)
EXPECT = Expect(tracking_error_p95_m=0.35, min_clearance_m=0.1, duration_max_s=20.0, setpoint_gap_p99_ms=30.0)


def outcome(verdict, expect=EXPECT):
    return json.loads(outcome_table(verdict, expect)["json"], parse_constant=lambda text: pytest.fail(text))


def test_the_outcome_holds_every_expectation_with_what_was_found():
    checks = {c["name"]: (c["value"], c["expected"], c["ok"]) for c in outcome(FLOWN)["checks"]}
    assert checks == {
        "phase": ("done", "done", True),
        "tracking_error_p95_m": (0.1, "<= 0.35", True),
        "min_clearance_m": (0.7, ">= 0.1", True),
        "duration_max_s": (21.0, "<= 20", False),
        "setpoint_gap_p99_ms": (None, "<= 30", False),
    }


def test_the_outcome_is_json_that_everybody_reads():
    told = outcome(FLOWN)
    assert (told["ok"], told["mission"], told["phase"], told["setpoint_gap_max_ms"]) == (False, "a wall", "done", None)
    failed = outcome(replace(FLOWN, phase="failed", failure="no plan"))
    assert (failed["failure"], failed["checks"][0]["ok"]) == ("no plan", False)


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_the_revision_is_what_git_says_it_is(tmp_path):
    def git(*words, at=tmp_path):
        who = ["-c", "user.name=n", "-c", "user.email=e@e"]
        return subprocess.run(["git", *who, *words], cwd=at, check=True, capture_output=True, text=True).stdout.strip()

    git("init", "-q", "-b", "main")
    git("commit", "-q", "--allow-empty", "-m", "first")
    head = git("rev-parse", "HEAD")[:12]
    revision.cache_clear()
    assert revision(tmp_path) == head
    git("worktree", "add", "-q", "-b", "other", str(tmp_path / "other"))
    assert revision(tmp_path / "other") == head
    git("pack-refs", "--all")
    revision.cache_clear()
    assert revision(tmp_path) == revision(tmp_path / "other") == head
    git("checkout", "-q", "--detach")
    revision.cache_clear()
    assert revision(tmp_path) == head


VOXELS = """
name: a stair
vehicle: {radius: 0.3, start: {north: 1, east: 1}}
world:
  bounds: {north: [0, 20], east: [0, 30], altitude: [0, 5]}
  obstacles:
    - voxels: ../maps/stair.npz
steps:
  - takeoff: {altitude: 1.5}
  - land
"""


def test_a_recording_holds_the_maps_that_its_mission_names_so_that_it_can_be_run_again_anywhere(tmp_path):
    maps, missions, elsewhere = (tmp_path / name for name in ("maps", "missions", "elsewhere"))
    for folder in (maps, missions, elsewhere):
        folder.mkdir()
    occupied = np.zeros((4, 3, 2), dtype=bool)
    occupied[1, 2, :] = True
    np.savez(maps / "stair.npz", occupied=occupied, origin=np.array([6.0, 20.0, 0.0]), resolution=0.5)
    companion = Companion(parse_mission(VOXELS.encode(), str(missions / "m.yaml")), CompanionConfig(seed=3))
    path = elsewhere / "a.mcap"
    rotation = Rotation(seconds=1.0)
    with Recorder(path, threaded=False, rotation=rotation, **header(companion, VOXELS.encode())) as recorder:
        for tick in range(100):
            at = {"log_time_ns": tick * 20_000_000, "now_us": tick * 20_000, "tick": tick}
            recorder.datagram("autopilot", "rx", b"x", **at)
    shutil.rmtree(maps)
    shutil.rmtree(missions)
    assert len(Recording.open(path).paths) > 1
    for part in Recording.open(path).paths:
        alone = elsewhere / "alone.mcap"
        shutil.copy(part, alone)
        again = fresh_companion(Recording.open(alone))
        (grid,) = again.mission.whole_world().obstacles
        assert np.array_equal(grid.occupied, companion.mission.whole_world().obstacles[0].occupied)
        assert again.config == companion.config


def test_times_of_a_recording_can_be_set_against_what_the_machine_counts_from_its_start():
    ahead_ns = int(unix_clock()["ahead_of_monotonic_ns"])
    assert abs(time.monotonic_ns() + ahead_ns - time.time_ns()) < 50_000_000


@pytest.mark.parametrize("head", [None, "rubbish", "ref: refs/heads/nowhere", "\xff"])
def test_a_folder_without_a_commit_has_no_revision(tmp_path, head):
    if head is not None:
        (tmp_path / ".git").mkdir()
        (tmp_path / ".git/HEAD").write_bytes(head.encode("latin-1"))
    revision.cache_clear()
    assert revision(tmp_path) == ""
