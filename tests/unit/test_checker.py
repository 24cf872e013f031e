"""The independent judge of trajectories finds what is wrong, and finds nothing wrong with what is certified."""

import numpy as np
import pytest

from benchmarks.bench_certificates import judge
from benchmarks.checker import check, cubes_distance
from planner import Box, Cylinder, Limits, Plan, Prism, Sphere, Trajectory, World, plan

LIMITS = Limits(speed=3.0, acceleration=6.0, jerk=60.0)
WORLD = World(((0, 0, 0), (20, 20, 4)), [Box((9, 6, 0), (10, 15, 4))])


@pytest.fixture(scope="module")
def made() -> Plan:
    return plan(WORLD, (1, 10, 1.5), (19, 10, 1.5), LIMITS, 0.3)


def test_a_certified_trajectory_is_found_good(made: Plan) -> None:
    found = check(made.trajectory, WORLD, LIMITS, 0.3)
    assert found.violations == ()
    assert found.clearance >= made.clearance - 1e-9


@pytest.mark.parametrize(
    "obstacle",
    [
        lambda p: Sphere(tuple(np.add(p, (0.0, 0.0, 0.5))), 0.21),
        lambda p: Box(tuple(np.add(p, (0.29, -1.0, -1.0))), tuple(np.add(p, (2.0, 1.0, 1.0)))),
        lambda p: Cylinder((p[0] + 0.4, p[1]), 0.11, (0.0, 4.0)),
        lambda p: Prism(((p[0] + 0.29, p[1] - 1), (p[0] + 2, p[1]), (p[0] + 0.29, p[1] + 1)), (0.0, 4.0)),
    ],
    ids=["sphere", "box", "cylinder", "prism"],
)
def test_a_solid_a_centimetre_too_near_is_seen(made: Plan, obstacle) -> None:
    place = made.trajectory.position(made.trajectory.duration / 2)
    found = check(made.trajectory, World(WORLD.bounds, [obstacle(place)]), LIMITS, 0.3)
    assert any("too near" in text for text in found.violations)


@pytest.mark.parametrize(("factor", "name"), [(1.01, "speed"), (1.01, "acceleration"), (1.01, "jerk")])
def test_a_limit_passed_by_a_percent_is_seen(made: Plan, factor: float, name: str) -> None:
    found = check(made.trajectory, WORLD, LIMITS, 0.3)
    lower = {"speed": found.speed, "acceleration": found.acceleration, "jerk": found.jerk}
    tight = Limits(**{k: v / (factor if k == name else 0.5) for k, v in lower.items()})
    assert [name] == [text.split()[0] for text in check(made.trajectory, WORLD, tight, 0.3).violations]


def test_a_curve_pushed_out_of_the_map_is_seen(made: Plan) -> None:
    moved = Trajectory(np.add(made.trajectory.control_points, (0.0, 0.0, 2.3)), made.trajectory.knots)
    assert any("too near" in text for text in check(moved, WORLD, LIMITS, 0.3).violations)


def test_the_distance_to_cubes_is_that_of_the_nearest_of_all() -> None:
    rng = np.random.default_rng(0)
    occupied = rng.random((6, 5, 4)) < 0.1
    points = rng.uniform(-0.5, 1.5, (200, 3))
    centres = (np.argwhere(occupied) + 0.5) * 0.2
    every = np.linalg.norm(np.maximum(np.abs(points[:, None] - centres) - 0.1, 0.0), axis=2).min(axis=1)
    np.testing.assert_allclose(cubes_distance(occupied, np.zeros(3), 0.2, points), every, atol=1e-15)


def test_nothing_certified_is_in_violation_in_a_sample_of_every_kind_of_world() -> None:
    tallies = judge(0.01)
    assert sum(t.certified for t in tallies.values()) > 20
    assert [line for t in tallies.values() for line in t.violations] == []
