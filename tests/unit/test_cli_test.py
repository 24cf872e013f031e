"""`companion test`: every mission file against what it expects, the first cause of a failure named; and the plug-in."""

import json
import pickle
import subprocess
import sys
from pathlib import Path

import pytest

from companion.cli.test import fly_missions, mission_files
from companion.testing.flight import fly
from companion.testing.spec import FlightSpec
from companion.testing.wire import LinkFaults

MISSIONS = Path(__file__).parents[2] / "missions"
BROKEN = MISSIONS / "broken"


def flown(capsys: pytest.CaptureFixture[str], keep: Path, *paths: Path, autopilot: str = "px4"):
    code = fly_missions(paths, autopilot, seeds=1, jobs=1, keep=keep, as_json=True)
    return code, json.loads(capsys.readouterr().out)


def test_a_folder_is_its_mission_files_by_name_and_not_those_of_folders_in_it() -> None:
    names = [file.name for file in mission_files([MISSIONS])]
    assert names == sorted(names)
    assert {"hop.yaml", "l_shape.yaml"} <= set(names)
    assert "walled_off.yaml" not in names


def test_the_result_is_one_json_object_with_a_row_for_every_flight(capsys, tmp_path: Path) -> None:
    code, told = flown(capsys, tmp_path, MISSIONS / "hop.yaml", autopilot="both")
    assert code == 0
    assert (told["ok"], told["passed"], told["failed"]) == (True, 2, 0)
    assert list(told["results"][0]) == ["mission", "autopilot", "seed", "ok", "cause", "seconds", "recording"]
    assert [row["autopilot"] for row in told["results"]] == ["px4", "ardupilot"]
    assert all(row["ok"] and row["cause"] == "" and row["recording"] is None for row in told["results"])
    assert not list(tmp_path.iterdir())


def test_broken_missions_fail_with_their_first_cause_and_keep_a_recording(capsys, tmp_path: Path) -> None:
    code, told = flown(capsys, tmp_path, BROKEN)
    assert code == 1
    assert (told["ok"], told["passed"], told["failed"]) == (False, 0, 3)
    near, typing_error, walled_off = told["results"]
    assert near["cause"].startswith("min_clearance_m: found 0.5")
    assert "typing_error.yaml: line 9: steps.1.goto" in typing_error["cause"]
    assert walled_off["cause"].startswith("no plan: step 1: no path found, and it is proved that there is none")
    assert [row["recording"] is not None and Path(row["recording"]).exists() for row in told["results"]] == [
        True,
        False,
        True,
    ]


def test_a_file_that_is_not_there_is_a_failure_with_its_name(capsys, tmp_path: Path) -> None:
    code, told = flown(capsys, tmp_path, tmp_path / "gone.yaml")
    assert code == 1
    assert "gone.yaml: cannot be read" in told["results"][0]["cause"]


def test_a_flight_and_what_came_of_it_can_be_sent_to_another_process() -> None:
    spec = FlightSpec(BROKEN / "walled_off.yaml", faults=("gps:off@3-4",), link=LinkFaults(loss=0.1), seed=2)
    result = fly(pickle.loads(pickle.dumps(spec)))
    again = pickle.loads(pickle.dumps(result))
    assert again.spec == spec
    assert (again.cause, again.notes) == (result.cause, result.notes)
    assert again.said("planning -> failed")


def test_an_empty_folder_is_a_wrong_use(capsys, tmp_path: Path) -> None:
    assert fly_missions([tmp_path], "px4", 1, 1, tmp_path, True) == 2
    assert "no mission file" in capsys.readouterr().err


@pytest.mark.slow
def test_a_failing_test_tells_cause_and_story_and_keeps_the_recording(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", f"--rootdir={tmp_path}"]
    run = subprocess.run(
        [*command, str(MISSIONS / "fails_on_purpose.py")], cwd=MISSIONS.parent, capture_output=True, text=True
    )
    assert run.returncode == 1, run.stderr
    assert "cause: no plan: step 1: no path found" in run.stdout
    assert "planning -> failed" in run.stdout
    kept = [line.partition(": ")[2] for line in run.stdout.splitlines() if line.startswith("recording: ")]
    assert Path(kept[0]).exists()
    assert Path(kept[0]).is_relative_to(tmp_path)


@pytest.mark.slow
def test_a_mark_that_cannot_be_is_one_clear_line(tmp_path: Path) -> None:
    (tmp_path / "test_it.py").write_text(
        f"""
import pytest
HOP = pytest.mark.mission({str(MISSIONS / "hop.yaml")!r})
@HOP
@pytest.mark.link(loss=2)
def test_link(flight): pass
@HOP
@pytest.mark.fault("gps:lost")
def test_fault(flight): pass
@HOP
@pytest.mark.wind(up=3)
def test_wind(flight): pass
@HOP
@pytest.mark.autopilot("betaflight")
def test_autopilot(flight): pass
@pytest.mark.mission("gone.yaml")
def test_file(flight): pass
def test_none(flight): pass
"""
    )
    (tmp_path / "conftest.py").write_text((MISSIONS / "conftest.py").read_text())  # the plug-in, installed or not
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-q"]
    run = subprocess.run(
        [*command, f"--rootdir={tmp_path}", "-c", "/dev/null", str(tmp_path)],
        cwd=MISSIONS.parent,
        capture_output=True,
        text=True,
    )
    assert "6 errors" in run.stdout, run.stdout
    assert "Traceback" not in run.stdout
    for said in (
        "loss 2: expected 0 to 1",
        "fault 'gps:lost': expected one of",
        "unexpected keyword argument 'up'",
        "autopilot 'betaflight': expected one of px4, ardupilot",
        "gone.yaml: cannot be read",
        "expected a mark that names one mission",
    ):
        assert said in run.stdout
