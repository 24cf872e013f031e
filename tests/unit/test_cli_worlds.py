"""`companion worlds`: what it writes is a mission that plans, of the very world it names; files are safe from it."""

import subprocess
import sys

import numpy as np
import pytest

from companion.cli.worlds import mission_text, write_world
from companion.errors import CompanionError
from companion.mission import Mission
from companion.missionfile import load_mission, parse_mission
from planner import Box, NoPathFound, plan
from planner.families import FAMILIES, make


def planned(mission: Mission, seed: int = 0):
    start = (*mission.start_m()[:2], -mission.steps[0].takeoff.altitude)
    goal = mission.steps[-2].goto.ned()
    world = mission.planner_world()
    return plan(world, start, goal, mission.planner_limits(), mission.planner_radius(), seed=seed)


@pytest.mark.parametrize("family", FAMILIES)
def test_what_is_written_is_the_families_world_in_north_east_and_altitude(family: str) -> None:
    scenario = make(family, 5)
    mission = parse_mission(mission_text(family, 5, scenario).encode(), family)
    world = mission.planner_world()
    assert len(world.obstacles) == len(scenario.world.obstacles)
    for written, meant in zip(world.obstacles, scenario.world.obstacles, strict=True):
        if isinstance(meant, Box):
            low, high = np.array(meant.lower), np.array(meant.upper)
            np.testing.assert_allclose(written.lower, [low[0], low[1], -high[2]], atol=5.1e-4)
            np.testing.assert_allclose(written.upper, [high[0], high[1], -low[2]], atol=5.1e-4)
        else:
            assert written.radius == pytest.approx(meant.radius, abs=5.1e-4)
            np.testing.assert_allclose(written.centre, meant.centre, atol=5.1e-4)
            assert written.z == (-meant.z[1], -meant.z[0])
    x, y, z = scenario.start
    np.testing.assert_allclose(mission.start_m(), (x, y, 0.0), atol=5.1e-4)
    assert mission.steps[0].takeoff.altitude == z
    np.testing.assert_allclose(mission.steps[-2].goto.ned(), np.array(scenario.goal) * (1, 1, -1), atol=5.1e-4)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("seed", [0, 3, 2**31 - 1])
def test_what_is_written_can_be_planned_with_its_clearance_or_says_that_it_is_closed(family: str, seed: int) -> None:
    scenario = make(family, seed)
    text = mission_text(family, seed, scenario)
    assert ("Walled off on purpose" in text) == scenario.closed
    mission = parse_mission(text.encode(), family)
    if scenario.closed:
        with pytest.raises(NoPathFound) as caught:
            planned(mission)
        assert caught.value.proved
    else:
        assert planned(mission).certified


def test_a_file_is_written_once_and_replaced_only_on_request(tmp_path) -> None:
    file = tmp_path / "gap.yaml"
    assert write_world("gap", 1, file, force=False) == 0
    first = file.read_text()
    assert load_mission(file).name == "gap 1"
    with pytest.raises(CompanionError, match="exists already; --force replaces it"):
        write_world("gap", 2, file, force=False)
    assert file.read_text() == first
    assert write_world("gap", 2, file, force=True) == 0
    assert load_mission(file).name == "gap 2"
    with pytest.raises(CompanionError, match="cannot be written: No such file or directory"):
        write_world("gap", 1, tmp_path / "no" / "gap.yaml", force=False)


def test_the_command_prints_the_mission_or_one_clear_line() -> None:
    command = [sys.executable, "-m", "companion", "worlds"]
    done = subprocess.run([*command, "Omega", "--seed", "4"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == mission_text("Omega", 4, make("Omega", 4))
    done = subprocess.run([*command, "spiral"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "companion: family: expected one of gap, L, H, U, Omega, forest, maze, found 'spiral'\n"
