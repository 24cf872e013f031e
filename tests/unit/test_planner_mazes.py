"""Mazes, whole: certified plans by an independent dense check where there is a way, a proof where there is none."""

import math

import numpy as np
import pytest
from scipy.interpolate import BSpline

from planner import Limits, NoPathFound, Plan, World, plan
from planner.families import MAZES, RADIUS, Scenario, maze

LIMITS = Limits(speed=3.0, acceleration=6.0, jerk=60.0)


def solve(scenario: Scenario, seed: int) -> Plan:
    return plan(scenario.world, scenario.start, scenario.goal, LIMITS, RADIUS, seed=seed)


def least_distance(p: Plan, world: World) -> float:
    curve = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)
    points = curve(np.linspace(0, p.trajectory.duration, 20_001)[:-1])
    low, high = (np.array(bound) for bound in world.bounds)
    least = float(np.minimum(points - low, high - points).min())
    for wall in world.obstacles:
        beyond = np.maximum(np.maximum(np.array(wall.lower) - points, points - np.array(wall.upper)), 0.0)
        least = min(least, float(np.linalg.norm(beyond, axis=1).min()))
    return least


def check(scenario: Scenario, seed: int) -> None:
    if scenario.closed:
        with pytest.raises(NoPathFound, match="proved unreachable") as caught:
            solve(scenario, seed)
        assert caught.value.proved
        return
    p = solve(scenario, seed)
    assert p.certified
    assert p.report.guided or p.report.seeds_certified > 0
    assert least_distance(p, scenario.world) >= RADIUS
    np.testing.assert_allclose(p.trajectory.position(0.0), scenario.start, atol=1e-9)
    np.testing.assert_allclose(p.trajectory.position(math.inf), scenario.goal, atol=1e-9)


@pytest.mark.parametrize("kind", MAZES)
@pytest.mark.parametrize("seed", range(3))
def test_a_maze_is_solved_or_proved_closed(kind: str, seed: int) -> None:
    check(maze(np.random.default_rng([1, seed]), kind), seed)


@pytest.mark.slow
@pytest.mark.parametrize("kind", MAZES)
def test_forty_mazes_of_each_kind_are_solved_or_proved_closed(kind: str) -> None:
    for seed in range(40):
        check(maze(np.random.default_rng([2, seed]), kind), seed)


def test_the_shorter_way_round_is_taken_where_a_maze_has_two() -> None:
    """Never longer than the way in the maze with fewer walls taken down: the same seed's perfect maze."""
    for seed in range(6):
        perfect, loops = (maze(np.random.default_rng([3, seed]), kind) for kind in ("perfect", "loops"))
        assert solve(loops, seed).length <= 1.02 * solve(perfect, seed).length


def test_the_same_seed_solves_a_maze_alike_to_the_last_bit() -> None:
    scenario = maze(np.random.default_rng([1, 5]), "loops")
    a, b = solve(scenario, 1), solve(scenario, 1)
    assert a.trajectory == b.trajectory
    assert a.report == b.report
