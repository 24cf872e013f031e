"""Trajectories, timing and the certificate, each against something that shares no code with it."""

import pickle

import numpy as np
import pytest
from scipy.interpolate import BSpline

from planner import Box, Cylinder, InfeasibleLimits, KnotError, Limits, Sphere, Trajectory, World
from planner.bspline import clamped_knots
from planner.certificate import TOLERANCE, certify
from planner.timing import uniform_scaling, within

LIMITS = Limits(speed=3.0, acceleration=6.0, jerk=60.0)


def wavy(n: int = 14, seed: int = 0) -> np.ndarray:
    """Control points of a curve that wanders along x, at rest at both ends."""
    points = np.linspace([0.0, 0, 0], [12.0, 0, 0], n) + np.random.default_rng(seed).normal(scale=0.6, size=(n, 3))
    points[:3], points[-3:] = points[0], points[-1]
    return points


@pytest.fixture
def trajectory() -> Trajectory:
    return Trajectory(wavy(), clamped_knots(14, 6.0))


def test_values_and_derivatives_agree_with_scipy(trajectory: Trajectory) -> None:
    t = np.linspace(0, 6.0, 301)[:-1]
    spline = BSpline(trajectory.knots, trajectory.control_points, 3)
    np.testing.assert_allclose(trajectory.position(t), spline(t), atol=1e-12)
    for k, ours in enumerate((trajectory.velocity, trajectory.acceleration, trajectory.jerk), start=1):
        np.testing.assert_allclose(ours(t), spline.derivative(k)(t), atol=1e-9)


def test_a_scalar_gives_one_row_an_array_gives_many(trajectory: Trajectory) -> None:
    assert trajectory.position(1.0).shape == (3,)
    assert trajectory.jerk(np.array([1.0, 2.0])).shape == (2, 3)
    assert trajectory.duration == 6.0


def test_the_state_is_position_velocity_and_acceleration_at_once(trajectory: Trajectory) -> None:
    for t in (-1.0, 0.0, 0.7, 3.3, 6.0, 9.0):
        state = trajectory.state(t)
        np.testing.assert_allclose(state.position, trajectory.position(t), atol=1e-13)
        np.testing.assert_allclose(state.velocity, trajectory.velocity(t), atol=1e-12)
        np.testing.assert_allclose(state.acceleration, trajectory.acceleration(t), atol=1e-12)


def test_before_and_after_it_stands_still_at_the_ends(trajectory: Trajectory) -> None:
    for t, end in ((-5.0, 0), (0.0, 0), (6.0, -1), (100.0, -1)):
        state = trajectory.state(t)
        np.testing.assert_allclose(state.position, trajectory.control_points[end], atol=1e-12)
        np.testing.assert_allclose(state.velocity, 0.0, atol=1e-12)
        np.testing.assert_allclose(state.acceleration, 0.0, atol=1e-11)


def test_position_velocity_and_acceleration_have_no_jumps_at_knots(trajectory: Trajectory) -> None:
    for knot in trajectory.knots[4:-4]:
        before, after = trajectory.state(knot - 1e-9), trajectory.state(knot + 1e-9)
        np.testing.assert_allclose(before.position, after.position, atol=1e-7)
        np.testing.assert_allclose(before.velocity, after.velocity, atol=1e-6)
        np.testing.assert_allclose(before.acceleration, after.acceleration, atol=1e-5)


def test_a_trajectory_survives_pickling_and_knows_its_equal(trajectory: Trajectory) -> None:
    copy = pickle.loads(pickle.dumps(trajectory))
    assert copy == trajectory
    assert hash(copy) == hash(trajectory)
    np.testing.assert_array_equal(copy.state(2.0).velocity, trajectory.state(2.0).velocity)
    assert trajectory != Trajectory(wavy(seed=1), clamped_knots(14, 6.0))


def test_what_is_no_trajectory_is_refused(trajectory: Trajectory) -> None:
    with pytest.raises(KnotError, match="take 18 knots"):
        Trajectory(wavy(), clamped_knots(13))
    with pytest.raises(KnotError, match="starts at 0"):
        Trajectory(wavy(), clamped_knots(14) + 1.0)
    with pytest.raises(ValueError, match="finite numbers"):
        Trajectory(np.full((14, 3), np.nan), clamped_knots(14))
    with pytest.raises(ValueError, match="NaN"):
        trajectory.state(float("nan"))


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize(
    "limits", [LIMITS, Limits(1.0, 100.0, 1e4), Limits(100.0, 0.5, 1e4), Limits(100.0, 100.0, 2.0)]
)
def test_no_limit_is_passed_anywhere_and_one_of_them_is_met(seed: int, limits: Limits) -> None:
    points = wavy(seed=seed)
    knots = uniform_scaling(points, limits)
    spline, t = BSpline(knots, points, 3), np.linspace(0, knots[-1], 4000)[:-1]
    peaks = [np.linalg.norm(spline.derivative(k)(t), axis=1).max() for k in (1, 2, 3)]
    assert peaks[0] <= limits.speed
    assert peaks[1] <= limits.acceleration
    assert peaks[2] <= limits.jerk
    shorter = knots * (1 - 1e-6)
    assert within(points, knots, limits)
    assert not within(points, shorter, limits)


def test_a_limit_nothing_can_move_under_says_which() -> None:
    with pytest.raises(InfeasibleLimits, match="acceleration") as caught:
        Limits(3.0, 0.0, 60.0)
    assert (caught.value.name, caught.value.value) == ("acceleration", 0.0)


@pytest.mark.parametrize("value", [-1.0, 1e-200, 9e-7, 1.1e6, 1e300, np.inf, np.nan])
@pytest.mark.parametrize("name", ["speed", "acceleration", "jerk"])
def test_a_limit_no_vehicle_has_is_refused_with_the_range_there_is(name: str, value: float) -> None:
    with pytest.raises(InfeasibleLimits, match=f"limit {name}: expected a number from 1e-06 to 1e[+]06") as caught:
        Limits(**{"speed": 1.0, "acceleration": 1.0, "jerk": 1.0, name: value})
    assert pickle.loads(pickle.dumps(caught.value)).name == name


@pytest.mark.parametrize("speed", [1e-6, 1e6])
@pytest.mark.parametrize("acceleration", [1e-6, 1e6])
@pytest.mark.parametrize("jerk", [1e-6, 1e6])
def test_the_ends_of_the_range_of_limits_are_still_flown(speed: float, acceleration: float, jerk: float) -> None:
    limits = Limits(speed, acceleration, jerk)
    knots = uniform_scaling(wavy(), limits)
    curve = BSpline(knots, wavy(), 3)
    t = np.linspace(0, knots[-1], 2001)[:-1]
    ratios = [
        np.linalg.norm(curve.derivative(k)(t), axis=1).max() / limit
        for k, limit in ((1, speed), (2, acceleration), (3, jerk))
    ]
    assert 0.4 < max(ratios) <= 1.0 + 1e-9


def world_around(points: np.ndarray, seed: int) -> World:
    rng = np.random.default_rng(seed)
    solids: list[Box | Cylinder | Sphere] = []
    for _ in range(6):
        corner = rng.uniform([0, -4, -4], [12, 4, 4])
        solids.append(Box(tuple(corner), tuple(corner + rng.uniform(0.2, 1.5, 3))))
        solids.append(Sphere(tuple(rng.uniform([0, -4, -4], [12, 4, 4])), rng.uniform(0.1, 0.8)))
        solids.append(Cylinder(tuple(rng.uniform([0, -4], [12, 4])), rng.uniform(0.1, 0.5), (-3.0, rng.uniform(-2, 3))))
    return World(((-5, -8, -8), (17, 8, 8)), solids)


@pytest.mark.parametrize("seed", range(12))
def test_the_proved_distance_is_below_the_sampled_one_by_no_more_than_the_tolerance(seed: int) -> None:
    points, knots = wavy(seed=seed), clamped_knots(14)
    world = world_around(points, seed)
    sampled = world.distance(BSpline(knots, points, 3)(np.linspace(0, 1, 20001)[:-1])).min()
    proof = certify(points, knots, world, radius=-10.0)
    assert sampled - TOLERANCE - 1e-5 <= proof.obstacle_distance <= sampled


@pytest.mark.parametrize("seed", range(12))
def test_a_radius_a_little_below_the_distance_is_certified_and_one_above_is_not(seed: int) -> None:
    points, knots = wavy(seed=seed), clamped_knots(14)
    world = world_around(points, seed)
    truth = world.distance(BSpline(knots, points, 3)(np.linspace(0, 1, 200001)[:-1])).min()
    for full in (True, False):
        assert certify(points, knots, world, truth - 2 * TOLERANCE, full).certified
        assert not certify(points, knots, world, truth + 1e-7, full).certified


def test_a_wire_thinner_than_any_sampling_is_seen() -> None:
    points = np.linspace([0.0, 0, 0], [10.0, 0, 0], 12)
    wire = World(((-1, -1, -1), (11, 1, 1)), [Cylinder((4.4321, 0.0), 1e-6, (-1, 1))])
    assert not certify(points, clamped_knots(12), wire, 0.0).certified


def test_a_curve_that_bulges_through_a_wall_of_the_map_is_not_certified() -> None:
    points = wavy()
    top = BSpline(clamped_knots(14), points, 3)(np.linspace(0, 1, 20001)[:-1])[:, 1].max()
    for ceiling, clear in ((top + 0.2001, True), (top + 0.1999, False)):
        assert certify(points, clamped_knots(14), World(((-5, -8, -8), (17, ceiling, 8))), 0.2).certified is clear


def test_touching_exactly_is_not_called_clear() -> None:
    points = np.linspace([0.0, 0, 0], [10.0, 0, 0], 12)
    world = World(((-1, -5, -5), (11, 5, 5)), [Box((0, 0.5, -1), (10, 1, 1))])
    assert not certify(points, clamped_knots(12), world, 0.5).certified
    assert certify(points, clamped_knots(12), world, 0.5 - 1e-6).certified


@pytest.mark.parametrize("seed", range(3))
def test_length_curvature_and_jerk_are_those_of_scipys_dense_samples(seed: int) -> None:
    knots = np.concatenate([np.zeros(4), np.sort(np.random.default_rng(seed).uniform(0.5, 5.5, 10)), np.full(4, 6.0)])
    trajectory = Trajectory(wavy(seed=seed), knots)
    spline, t = BSpline(knots, trajectory.control_points, 3), np.linspace(0, 6.0, 400_001)[:-1] + 7.5e-6
    v, a, j = (spline.derivative(k)(t) for k in (1, 2, 3))
    speed = np.linalg.norm(v, axis=1)
    curvature = (np.linalg.norm(np.cross(v, a), axis=1) / speed**3)[speed > 0.01 * speed.max()].max()
    measures = trajectory.measures()
    assert measures.length == pytest.approx(speed.mean() * 6.0, rel=1e-5)
    assert measures.jerk_integral == pytest.approx((j**2).sum(axis=1).mean() * 6.0, rel=1e-3)
    assert 0.6 * curvature <= measures.curvature_max <= curvature * (1 + 1e-6)


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e200])
def test_what_is_no_number_is_within_no_limit(bad: float) -> None:
    points = wavy()
    points[7, 1] = bad
    assert not within(points, clamped_knots(14, 100.0), LIMITS)
