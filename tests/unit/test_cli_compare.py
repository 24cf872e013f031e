"""`companion plan --compare`: one JSON object, one table, one picture, and who is best told as it is."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from companion.cli.compare import COLUMNS, Row, compare_methods, winners
from companion.errors import CompanionError
from planner import METHODS, Box, Limits, World, plan
from planner.plot_methods import save_comparison

MISSION = """\
name: two legs
vehicle:
  start: {north: 2, east: 2}
world:
  bounds: {north: [0, 12], east: [0, 12], altitude: [0, 4]}
  obstacles:
    - box: {north: [5, 6], east: [0, 8], altitude: [0, 4]}
steps:
  - takeoff: {altitude: 1.5}
  - goto: {north: 10, east: 2, altitude: 1.5}
  - goto: {north: 10, east: 9, altitude: 2}
  - land
"""


@pytest.fixture
def mission(tmp_path: Path) -> Path:
    file = tmp_path / "mission.yaml"
    file.write_text(MISSION)
    return file


def test_one_json_object_holds_every_method_and_no_number_that_json_has_not(mission: Path, tmp_path: Path) -> None:
    picture = tmp_path / "all.png"
    command = [sys.executable, "-m", "companion", "plan", str(mission), "--compare", "--json", "--plot", str(picture)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    assert "NaN" not in done.stdout
    assert "Infinity" not in done.stdout
    told = json.loads(done.stdout)
    assert told["ok"]
    rows = {row["method"]: row for row in told["methods"]}
    assert tuple(rows) == METHODS
    for name, row in rows.items():
        assert row["legs"] == 2, name
        assert row["cpu_ms"] > 0.0
        assert row["certified"] == (row["clearance_m"] is not None)
        assert row["clearance_sampled_m"] >= 0.0 or not row["certified"]
        if row["certified"]:
            assert row["clearance_m"] <= row["clearance_sampled_m"] + 1e-6
    assert rows["astar"]["curvature_max"] is None
    assert rows["astar"]["length_m"] == pytest.approx(rows["jps"]["length_m"], abs=0.5)
    assert rows["haoaroa"]["length_m"] < rows["astar"]["length_m"]
    for column, best in told["best"].items():
        assert all(rows[name]["certified"] and rows[name][column] is not None for name in best)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_the_table_names_every_method_its_units_and_the_best(
    mission: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "160")
    assert compare_methods(mission, 1, None, False) == 0
    shown = capsys.readouterr().out
    assert all(method in shown for method in METHODS)
    assert "*" in shown
    assert "∞" in shown
    for unit in ("[m]", "[m²/s⁵]", "[1/m]", "[s]", "[ms]"):
        assert unit in shown


def test_no_way_is_a_row_without_numbers_and_exit_code_1(
    mission: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mission.write_text(MISSION.replace("east: [0, 8]", "east: [0, 12]"))
    assert compare_methods(mission, 1, tmp_path / "none.png", True) == 1
    told = json.loads(capsys.readouterr().out)
    assert not told["ok"]
    rows = {row["method"]: row for row in told["methods"]}
    for method in ("haoaroa", "astar", "jps", "bezier"):
        assert rows[method]["error"] == "NoPathFound"
        assert rows[method]["length_m"] is None
    assert not any(row["certified"] for row in rows.values())
    assert not any(told["best"].values())
    assert (tmp_path / "none.png").exists()


def test_a_picture_needs_a_file_name(mission: Path, tmp_path: Path) -> None:
    with pytest.raises(CompanionError, match="expected the name of a picture file"):
        compare_methods(mission, 1, tmp_path, False)


def test_only_certified_methods_can_be_best() -> None:
    world, limits = World(((0, 0, 0), (10, 10, 4)), [Box((4, 0, 0), (5, 6, 4))]), Limits(3.0, 6.0, 60.0)
    made = plan(world, (1, 3, 1), (9, 3, 1), limits, 0.3)
    row, other = Row("haoaroa", [made], 1.0), Row("aoa", [made], 0.5, error="NoPathFound")
    assert winners([row, other], "cpu_ms") == [row]
    assert math.isnan(other.value("length_m"))
    assert winners([other], "length_m") == []
    assert all(row.value(name) == row.value(name) for name in COLUMNS)


def test_a_comparison_of_plans_is_drawn(tmp_path: Path) -> None:
    world, limits = World(((0, 0, -4), (10, 10, 0)), [Box((4, 0, -4), (5, 6, 0))]), Limits(3.0, 6.0, 60.0)
    made = [plan(world, (1, 3, -1), (9, 3, -1), limits, 0.3, method=method) for method in ("haoaroa", "astar")]
    plans = {"haoaroa": made[:1], "astar": made[1:], "roa": []}
    save_comparison(world, plans, tmp_path / "all.png", limits, 0.3, ("north", "east", "-altitude"))
    save_comparison(world, {"haoaroa": []}, tmp_path / "none.png")
    sizes = [(tmp_path / name).stat().st_size for name in ("all.png", "none.png")]
    assert np.min(sizes) > 10_000
