"""The independent judge of trajectories finds what is wrong, and finds nothing wrong with what is certified."""

import numpy as np
import pytest

from benchmarks.bench_certificates import judge
from benchmarks.checker import Asked, check, cubes_distance
from planner import (
    Box,
    Cylinder,
    Limits,
    MovingBox,
    MovingSphere,
    Plan,
    PointCloud,
    Prism,
    Sphere,
    Trajectory,
    VoxelGrid,
    World,
    plan,
)

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
        lambda p: VoxelGrid(np.ones((2, 2, 2), dtype=bool), tuple(np.add(p, (0.29, -0.1, -0.1))), 0.1),
        lambda p: PointCloud(np.add(p, [[0.34, 0.01, 0.0]]), 0.1, tuple(np.add(p, (0.29, -0.05, -0.05)))),
    ],
    ids=["sphere", "box", "cylinder", "prism", "voxels", "cloud"],
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


@pytest.mark.parametrize("where", ["point", "knot", "radius"])
def test_what_is_no_number_is_a_violation(made: Plan, where: str) -> None:
    class Broken:
        control_points, knots = made.trajectory.control_points.copy(), made.trajectory.knots.copy()

    if where == "point":
        Broken.control_points[7, 1] = np.nan
    if where == "knot":
        Broken.knots[7] = np.nan
    assert check(Broken, WORLD, LIMITS, np.nan if where == "radius" else 0.3).violations


ASKED = {"start": (1, 10, 1.5), "goal": (19, 10, 1.5)}


def test_the_ends_that_were_asked_for_are_found_good(made: Plan) -> None:
    assert check(made.trajectory, WORLD, LIMITS, 0.3, Asked(**ASKED)).violations == ()


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"start": (1, 10, 1.501)}, "start: position off by 1.00e-03"),
        ({"goal": (19, 10.01, 1.5)}, "goal: position off by 1.00e-02"),
        ({"start_velocity": (0.01, 0, 0)}, "start: velocity off by 1.00e-02"),
        ({"start_acceleration": (0.02, 0, 0)}, "start: acceleration off by 2.00e-02"),
        ({"goal_velocity": (0, 0, 0.03)}, "goal: velocity off by 3.00e-02"),
        ({"goal": (np.nan, 10, 1.5)}, "goal: position off by nan"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_an_end_beside_what_was_asked_for_is_seen(made: Plan, wrong: dict, told: str) -> None:
    assert check(made.trajectory, WORLD, LIMITS, 0.3, Asked(**{**ASKED, **wrong})).violations == (told,)


def test_via_points_that_are_missed_or_passed_in_another_order_are_seen(made: Plan) -> None:
    T = made.trajectory.duration
    a, b = made.trajectory.position(0.3137 * T), made.trajectory.position(0.7241 * T)
    beside = np.add(a, (0.0, 0.0, 1e-3))
    for via, missed in (([a, b], []), ([b, a], [1]), ([beside], [0]), ([a, (5, 5, 1)], [1])):
        found = check(made.trajectory, WORLD, LIMITS, 0.3, Asked(via=via)).violations
        assert [int(text.split()[2][:-1]) for text in found] == missed


@pytest.mark.parametrize("late", [0.0, 0.2])
@pytest.mark.parametrize("kind", ["ball", "box"])
def test_a_mover_that_meets_the_vehicle_is_seen_and_one_that_is_late_is_not(made: Plan, kind: str, late: float) -> None:
    T = made.trajectory.duration
    state = made.trajectory.state(0.5 * T)
    side = np.cross(state.velocity, (0.0, 0.0, 1.0)) / np.linalg.norm(state.velocity)
    velocity = 5.0 * side
    centre = state.position + 0.5 * side - velocity * (0.5 * T + 4.0 * late)  # at half time, half a metre away
    if kind == "ball":
        mover = MovingSphere(tuple(centre), tuple(velocity), 0.3)
    else:
        mover = MovingBox(tuple(centre - 0.3), tuple(centre + 0.3), tuple(velocity))
    found = check(made.trajectory, World(WORLD.bounds), LIMITS, 0.3, Asked(movers=[mover]))
    assert bool(found.violations) == (late == 0.0)
    assert all("too near to mover 0" in text for text in found.violations)
    ended = type(mover)(**{**{f: getattr(mover, f) for f in mover.__slots__}, "until": 0.2 * T})
    assert not check(made.trajectory, World(WORLD.bounds), LIMITS, 0.3, Asked(movers=[ended])).violations


def test_the_distance_to_cubes_is_that_of_the_nearest_of_all() -> None:
    rng = np.random.default_rng(0)
    occupied = rng.random((6, 5, 4)) < 0.1
    points = rng.uniform(-0.5, 1.5, (200, 3))
    centres = (np.argwhere(occupied) + 0.5) * 0.2
    every = np.linalg.norm(np.maximum(np.abs(points[:, None] - centres) - 0.1, 0.0), axis=2).min(axis=1)
    found = cubes_distance(np.argwhere(occupied), np.zeros(3), 0.2, points)
    np.testing.assert_allclose(np.maximum(found, 0.0), every, atol=1e-15)
    assert ((found < 0.0) == (every == 0.0)).all()
    one = cubes_distance(np.zeros((1, 3)), np.zeros(3), 0.2, np.array([[0.1, 0.1, 0.1], [0.05, 0.1, 0.1]]))
    np.testing.assert_allclose(one, [-0.1, -0.05])


def test_nothing_certified_is_in_violation_in_a_sample_of_every_kind_of_world() -> None:
    tallies = judge(0.01)
    assert sum(t.certified for t in tallies.values()) > 20
    assert [line for t in tallies.values() for line in t.violations] == []
