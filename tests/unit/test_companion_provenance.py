"""What a recording says of itself: whose it is, and what came of the flight."""

import json
import math
import shutil
import subprocess
from dataclasses import replace

import pytest

from companion.drivers.provenance import outcome_table, revision
from companion.mission import Expect
from companion.verdict import Verdict

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


@pytest.mark.parametrize("head", [None, "rubbish", "ref: refs/heads/nowhere", "\xff"])
def test_a_folder_without_a_commit_has_no_revision(tmp_path, head):
    if head is not None:
        (tmp_path / ".git").mkdir()
        (tmp_path / ".git/HEAD").write_bytes(head.encode("latin-1"))
    revision.cache_clear()
    assert revision(tmp_path) == ""
