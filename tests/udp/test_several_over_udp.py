"""`companion fly` of a mission with several vehicles: processes over UDP, told of each other, landed by one Ctrl-C."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import typer

from companion.cli.fly import fly_mission
from companion.cli.several import MOST, fly_several, nearest_pair
from companion.errors import MissionError
from companion.fleet.missions import split

CROSS = """\
name: cross
world: {bounds: {north: [-4, 14], east: [-6, 6], altitude: [0, 5]}}
vehicle: {radius: 0.35}
vehicles:
  - name: a
    start: {north: 0, east: 0}
    steps: [{takeoff: {altitude: 2}}, {goto: {north: 10, east: 0, altitude: 2}}, {hold: {seconds: HOLD}}, land]
  - name: b
    start: {north: 10, east: 0}
    steps: [{takeoff: {altitude: 2}}, {goto: {north: 0, east: 0, altitude: 2}}, {hold: {seconds: HOLD}}, land]
"""


def started(folder: Path, hold_s: float) -> "subprocess.Popen[str]":
    mission = folder / "cross.yaml"
    mission.write_text(CROSS.replace("HOLD", f"{hold_s:g}"))
    with (folder / "log").open("w") as log:
        return subprocess.Popen(
            [sys.executable, "-m", "companion", "fly", str(mission), "--record", str(folder / "recordings"), "--json"],
            stdout=subprocess.PIPE,
            stderr=log,
            text=True,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        )


@pytest.mark.udp
@pytest.mark.soak
def test_two_bundled_vehicles_change_places_over_udp_and_each_keeps_a_recording(tmp_path: Path) -> None:
    with started(tmp_path, 1) as process:
        out, _ = process.communicate(timeout=300)
    result = json.loads(out)
    assert (process.returncode, result["ok"], result["failure"]) == (0, True, "")
    assert [vehicle["phase"] for vehicle in result["vehicles"]] == ["done", "done"]
    assert 0.7 < result["separation_m"] < 5.0
    assert all(Path(file).stat().st_size > 10_000 for file in result["recordings"])
    assert "vehicle 2 is heard" in (tmp_path / "log").read_text()


@pytest.mark.udp
@pytest.mark.soak
def test_one_ctrl_c_lands_all_of_them(tmp_path: Path) -> None:
    with started(tmp_path, 200) as process:
        end_s = time.monotonic() + 240
        while (tmp_path / "log").read_text().count("step 2: hold") < 2:
            assert process.poll() is None, (tmp_path / "log").read_text()
            assert time.monotonic() < end_s
            time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=60)
    result = json.loads(out)
    assert [vehicle["phase"] for vehicle in result["vehicles"]] == ["done", "done"]
    assert (process.returncode, result["failure"]) == (1, "a: cancelled by the operator")


def test_how_near_two_came_is_found_between_their_samples_and_only_while_both_are_in_the_air() -> None:
    t = np.arange(0, 10e6, 18_000.0)
    a = np.column_stack([t, t * 1e-6, 0 * t, 0 * t - 2])  # north at 1 m/s
    b = np.column_stack([t + 7_000, 10 - (t + 7_000) * 1e-6, 0 * t + 0.5, 0 * t - 2])  # and one the other way
    late = np.column_stack([t + 20e6, 5 + 0 * t, 0 * t, 0 * t - 2])
    least, (first, second, at_s) = nearest_pair([late, a, b])
    assert least == pytest.approx(0.5, abs=1e-3)
    assert (first, second) == (2, 3)
    assert at_s == pytest.approx(5.0, abs=0.02)
    assert nearest_pair([a, late, np.empty((0, 4))])[0] == np.inf


def test_what_is_for_one_vehicle_is_refused_with_several_and_the_other_way_round(tmp_path: Path) -> None:
    several, alone = tmp_path / "cross.yaml", Path("missions/hop.yaml")
    several.write_text(CROSS.replace("HOLD", "1"))
    rest = (tmp_path, 1, None, 60.0)
    with pytest.raises(typer.BadParameter, match="expected without: of a file with vehicles each is a bundled one"):
        fly_mission(several, "udpin:127.0.0.1:0", [], *rest, None, True)
    with pytest.raises(typer.BadParameter, match="found nothing, expected the URL where the vehicle is"):
        fly_mission(alone, None, [], *rest, None, True)
    with pytest.raises(typer.BadParameter, match="expected with a file of several"):
        fly_mission(alone, "udpin:127.0.0.1:0", [], *rest, "px4", True)
    parts = split(several.read_bytes(), "cross.yaml") * (MOST // 2 + 1)
    with pytest.raises(MissionError, match=f"found {MOST + 2}, expected at most {MOST} over UDP"):
        fly_several(parts, several, 1, tmp_path, "px4", True)
