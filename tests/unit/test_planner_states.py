"""Plans from any velocity and acceleration, through via points, to rest or through the goal."""

import pickle

import numpy as np
import pytest
from scipy.interpolate import BSpline

from benchmarks.minimum_time import straight
from planner import (
    Box,
    Cylinder,
    Limits,
    NoPathFound,
    NoTimingFound,
    Plan,
    Sphere,
    StateBeyondLimits,
    ViaInCollision,
    ViaOutOfBounds,
    World,
    plan,
)

LIMITS = Limits(speed=3.0, acceleration=6.0, jerk=60.0)
BOUNDS = ((0, 0, 0), (20, 20, 4))
WALL = Box((9, 6, 0), (10, 15, 4))
WORLD = World(BOUNDS, [WALL, Cylinder(centre=(5, 5), radius=0.4, z=(0, 4)), Sphere((14, 12, 2), 0.8)])
START, GOAL, RADIUS = (3.0, 10.0, 1.5), (17.0, 10.0, 1.5), 0.3


def assert_flyable(p: Plan, limits: Limits = LIMITS) -> None:
    """Dense samples and finite differences of scipy's spline: clear of everything, no limit passed from t = 0 on."""
    assert p.certified
    spline, T = BSpline(p.trajectory.knots, p.trajectory.control_points, 3), p.trajectory.duration
    t = np.linspace(0, T, 20001)[:-1]
    points = spline(t)
    q = np.maximum(np.array(WALL.lower) - points, points - np.array(WALL.upper))
    assert np.linalg.norm(np.maximum(q, 0), axis=1).min() >= RADIUS
    assert (np.hypot(points[:, 0] - 5, points[:, 1] - 5) - 0.4).min() >= RADIUS
    assert (np.linalg.norm(points - [14, 12, 2], axis=1) - 0.8).min() >= RADIUS
    assert (points >= np.array(BOUNDS[0]) + RADIUS).all()
    assert (points <= np.array(BOUNDS[1]) - RADIUS).all()
    for k, limit in ((1, limits.speed), (2, limits.acceleration), (3, limits.jerk)):
        assert np.linalg.norm(spline.derivative(k)(t), axis=1).max() <= limit * (1 + 1e-9)


def assert_state(p: Plan, t: float, position, velocity, acceleration) -> None:
    state = p.trajectory.state(t)
    np.testing.assert_allclose(state.position, position, atol=1e-9)
    np.testing.assert_allclose(state.velocity, velocity, atol=1e-9)
    np.testing.assert_allclose(state.acceleration, acceleration, atol=1e-9)


@pytest.mark.parametrize("seed", range(24))
def test_a_plan_begins_and_ends_in_the_states_that_were_asked_for(seed: int) -> None:
    rng = np.random.default_rng([41, seed])
    velocity, acceleration, leaving = (
        top * rng.uniform(0, 1) * v / np.linalg.norm(v)
        for v, top in zip(rng.normal(size=(3, 3)), (3, 4, 2), strict=True)
    )
    leaving = leaving if seed % 2 else np.zeros(3)
    p = plan(
        WORLD,
        START,
        GOAL,
        LIMITS,
        RADIUS,
        seed=seed,
        start_velocity=velocity,
        start_acceleration=acceleration,
        goal_velocity=leaving,
    )
    assert_flyable(p)
    assert_state(p, 0.0, START, velocity, acceleration)
    assert_state(p, p.trajectory.duration, GOAL, leaving, np.zeros(3))


@pytest.mark.parametrize("velocity", [(3.0, 0, 0), (0, 3.0, 0), (-3.0, 0, 0), (0, -1.8, 2.4)])
def test_the_speed_limit_itself_is_a_speed_to_start_with(velocity) -> None:
    p = plan(WORLD, (6.0, 10.0, 1.5), GOAL, LIMITS, RADIUS, start_velocity=velocity)
    assert_flyable(p)
    assert_state(p, 0.0, (6.0, 10.0, 1.5), velocity, np.zeros(3))


def test_from_full_speed_to_rest_takes_what_the_double_s_takes_from_there() -> None:
    p = plan(World(BOUNDS), (2, 10, 1.5), (14, 10, 1.5), LIMITS, RADIUS, start_velocity=(3, 0, 0))
    at_rest = straight(24.0, 3.0, 6.0, 60.0)  # its second half
    assert p.trajectory.duration <= 1.02 * at_rest / 2


def test_through_the_goal_at_full_speed_is_as_fast_as_the_first_half_of_twice_the_way() -> None:
    p = plan(World(BOUNDS), (2, 10, 1.5), (14, 10, 1.5), LIMITS, RADIUS, goal_velocity=(3, 0, 0))
    assert p.trajectory.duration <= 1.02 * straight(24.0, 3.0, 6.0, 60.0) / 2


@pytest.mark.parametrize("part", [0.1, 0.3, 0.5, 0.7, 0.9])
@pytest.mark.parametrize("seed", range(3))
def test_what_is_being_flown_can_be_planned_on_from_any_moment(part: float, seed: int) -> None:
    first = plan(WORLD, START, GOAL, LIMITS, RADIUS, seed=seed)
    now = first.trajectory.state(part * first.trajectory.duration)
    p = plan(
        WORLD,
        now.position,
        GOAL,
        LIMITS,
        RADIUS,
        start_velocity=now.velocity,
        start_acceleration=now.acceleration,
    )
    assert_flyable(p)
    assert_state(p, 0.0, now.position, now.velocity, now.acceleration)


@pytest.mark.parametrize(
    ("name", "value", "limit"),
    [
        ("start_velocity", (0, 3.5, 0), 3.0),
        ("start_acceleration", (4, 4, 4), 6.0),
        ("goal_velocity", (-3.1, 0, 0), 3.0),
    ],
)
def test_a_state_beyond_the_limits_is_refused_and_told_by_how_much(name, value, limit) -> None:
    with pytest.raises(StateBeyondLimits, match=name.replace("_", " ")) as caught:
        plan(WORLD, START, GOAL, LIMITS, RADIUS, **{name: value})
    error = pickle.loads(pickle.dumps(caught.value))
    assert (error.name, error.limit) == (name, limit)
    assert error.excess == pytest.approx(np.linalg.norm(value) - limit)


def test_too_fast_to_brake_before_a_wall_is_a_typed_refusal() -> None:
    room = World(((0, 0, 0), (20, 20, 4)), [Box((5, 0, 0), (6, 20, 4))])
    with pytest.raises(NoPathFound):  # half a metre, where braking takes more than one
        plan(room, (4.2, 10, 1.5), (2, 10, 1.5), LIMITS, RADIUS, start_velocity=(3, 0, 0))


def test_when_curves_there_are_but_none_can_be_flown_the_refusal_says_so() -> None:
    weak = Limits(speed=3.0, acceleration=0.3, jerk=1.0)  # 7 m to brake, in a room of 6 m
    with pytest.raises(NoTimingFound, match="can be flown") as caught:
        plan(World(((0, 0, 0), (6, 6, 3))), (1, 3, 1.5), (5, 3, 1.5), weak, RADIUS, start_velocity=(2, 0, 0))
    error = pickle.loads(pickle.dumps(caught.value))
    assert str(error) == str(caught.value)
    assert error.speed == pytest.approx(2.0)


def test_no_velocity_is_the_plan_from_rest_to_the_last_bit() -> None:
    a = plan(WORLD, START, GOAL, LIMITS, RADIUS)
    b = plan(WORLD, START, GOAL, LIMITS, RADIUS, start_velocity=np.zeros(3), goal_velocity=[0, 0, 0], via=[])
    assert a.trajectory == b.trajectory


VIAS = {
    "one": [(10.0, 3.0, 2.0)],
    "there and back": [(16.0, 16.0, 1.0), (3.0, 16.0, 2.0)],
    "five": [(5, 10, 1), (8, 4, 2), (12, 4, 3), (12, 16, 1), (15, 15, 2)],
    "on the line": [(5, 10, 1.5), (7, 10, 1.5)],
}


@pytest.mark.parametrize("moving", [False, True])
@pytest.mark.parametrize("name", VIAS)
def test_via_points_are_passed_exactly_and_in_order(name: str, moving: bool) -> None:
    via = np.array(VIAS[name], dtype=float)
    extra = {"start_velocity": (1.0, 0.5, 0.0), "goal_velocity": (1.0, 0.0, 0.0)} if moving else {}
    p = plan(WORLD, START, GOAL, LIMITS, RADIUS, via=via, **extra)
    assert_flyable(p)
    knots = p.trajectory.knots[3:-3]
    passed = p.trajectory.position(knots)
    order = []
    for point in via:
        away = np.linalg.norm(passed - point, axis=1)
        assert away.min() < 1e-9
        order.append(int(away.argmin()))
    assert order == sorted(set(order))
    if moving:
        assert_state(p, 0.0, START, (1.0, 0.5, 0.0), np.zeros(3))


def test_a_loop_through_via_points_ends_where_it_began() -> None:
    p = plan(WORLD, START, START, LIMITS, RADIUS, via=[(6, 14, 2), (3, 17, 1)])
    assert_flyable(p)
    assert p.length > 10.0


def test_a_bad_via_point_is_told_by_its_number() -> None:
    with pytest.raises(ViaInCollision, match=r"via point 1 \(9.50, 10.00, 1.50\) is 0.500 m inside obstacle 0") as hit:
        plan(WORLD, START, GOAL, LIMITS, RADIUS, via=[(5, 10, 1.5), (9.5, 10, 1.5)])
    error = pickle.loads(pickle.dumps(hit.value))
    assert (error.index, error.obstacle, error.which) == (1, 0, "via point 1")
    with pytest.raises(ViaOutOfBounds, match=r"via point 0 .* upper z bound 4") as out:
        plan(WORLD, START, GOAL, LIMITS, RADIUS, via=[(5, 10, 5)])
    assert pickle.loads(pickle.dumps(out.value)).index == 0
    with pytest.raises(ValueError, match="via: expected at most"):
        plan(WORLD, START, GOAL, LIMITS, RADIUS, via=[(5, 10, 1.5)] * 40)
    with pytest.raises(ValueError, match="via point 0: expected three finite numbers"):
        plan(WORLD, START, GOAL, LIMITS, RADIUS, via=[(5, 10)])


def test_a_via_point_in_a_closed_cell_is_not_reached() -> None:
    cell = [Box((9, 9, 0), (9.2, 12, 4)), Box((12, 9, 0), (12.2, 12, 4))]
    cell += [Box((9, 9, 0), (12.2, 9.2, 4)), Box((9, 11.8, 0), (12.2, 12, 4))]
    with pytest.raises(NoPathFound):
        plan(World(BOUNDS, cell), START, GOAL, LIMITS, RADIUS, via=[(10.5, 10.5, 2)])


def test_a_via_point_behind_baffles_is_reached_with_the_search_graphs_help() -> None:
    baffles = [Box((5, 0, 0), (5.5, 17, 4)), Box((10, 3, 0), (10.5, 20, 4)), Box((15, 0, 0), (15.5, 17, 4))]
    p = plan(World(BOUNDS, baffles), (1, 2, 1.5), (19, 2, 1.5), LIMITS, RADIUS, via=[(12.5, 10, 2)])
    assert p.certified
    away = np.linalg.norm(p.trajectory.position(p.trajectory.knots[3:-3]) - [12.5, 10, 2], axis=1)
    assert away.min() < 1e-9
