"""Time-optimal knots: no limit passed anywhere, hardly slower than the least that the same path needs.

The oracle (`benchmarks.minimum_time`) shares no code with the planner; here it is held against closed forms first.
"""

import itertools

import numpy as np
import pytest
from scipy.interpolate import BSpline

from benchmarks.minimum_time import Path, arc, least_time, line, straight
from planner import Box, Cylinder, Limits, World, plan
from planner.bspline import clamped_knots
from planner.timing import Motion, timings, uniform_scaling, within

LIMITS = Limits(speed=3.0, acceleration=6.0, jerk=60.0)


def wavy(n: int = 16, seed: int = 0) -> np.ndarray:
    """Control points of a curve that wanders along x, at rest at both ends."""
    points = np.linspace([0.0, 0, 0], [18.0, 0, 0], n) + np.random.default_rng(seed).normal(scale=0.5, size=(n, 3))
    points[:3], points[-3:] = points[0], points[-1]
    return points


def fastest(points: np.ndarray, limits: Limits) -> Motion:
    return next(timings(points, clamped_knots(len(points)), limits))


def assert_within(motion: Motion, limits: Limits) -> None:
    spline, end = BSpline(motion.knots, motion.control_points, 3), motion.knots[-1]
    t = np.concatenate([np.linspace(0, end, 4001)[:-1], motion.knots[3:-4], motion.knots[4:-3] - 1e-12 * end])
    for k, limit in ((1, limits.speed), (2, limits.acceleration), (3, limits.jerk)):
        assert np.linalg.norm(spline.derivative(k)(t), axis=1).max() <= limit * (1 + 1e-9)


@pytest.mark.parametrize("length", [0.05, 2.0, 18.0])
def test_the_oracle_meets_the_double_s_on_a_line_from_above(length: float) -> None:
    truth = straight(length, 3.0, 6.0, 60.0)
    assert truth <= least_time(line(length, 600), 3.0, 6.0, 60.0) <= 1.004 * truth


@pytest.mark.parametrize(
    ("radius", "top"), [(0.5, 3.0**0.5), (0.2, (6.0 * 0.2) ** 0.5), (0.05, (60 * 0.05**2) ** (1 / 3))]
)
def test_the_oracle_cruises_on_an_arc_as_fast_as_acceleration_and_jerk_allow(radius: float, top: float) -> None:
    times = [least_time(arc(radius, angle, 600), 3.0, 6.0, 60.0) for angle in (20.0, 40.0)]
    assert radius * 20.0 / (times[1] - times[0]) == pytest.approx(top, rel=2e-3)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("limits", [LIMITS, Limits(1.0, 2.0, 4.0), Limits(8.0, 5.0, 200.0), Limits(0.5, 6.0, 600.0)])
def test_the_duration_is_hardly_more_than_the_least_along_the_same_path(seed: int, limits: Limits) -> None:
    motion = fastest(wavy(seed=seed), limits)
    assert_within(motion, limits)
    path = Path.of_spline(motion.knots, motion.control_points, 400)
    assert motion.knots[-1] <= 1.03 * least_time(path, limits.speed, limits.acceleration, limits.jerk, gap=1e-3)


@pytest.mark.parametrize(("speed", "acceleration", "jerk"), list(itertools.product([1e-6, 1.0, 1e6], repeat=3)))
def test_on_a_line_it_is_the_double_s_whatever_the_limits(speed: float, acceleration: float, jerk: float) -> None:
    points = np.linspace([0.0, 0, 0], [10.0, 0, 0], 16)[[0, 0, *range(16), 15, 15]]
    limits = Limits(speed, acceleration, jerk)
    motion = fastest(points, limits)
    assert within(motion.control_points, motion.knots, limits)
    truth = straight(10.0, speed, acceleration, jerk)
    assert truth * (1 - 1e-9) <= motion.knots[-1] <= 1.005 * truth


@pytest.mark.parametrize("seed", range(3))
def test_each_way_to_time_a_shape_follows_it_more_closely_than_the_one_before(seed: int) -> None:
    points = wavy(seed=seed)
    shape = BSpline(clamped_knots(16), points, 3)(np.linspace(0, 1, 100001)[:-1])
    away, durations = [], []
    for motion in timings(points, clamped_knots(16), LIMITS):
        assert_within(motion, LIMITS)
        curve = BSpline(motion.knots, motion.control_points, 3)(np.linspace(0, motion.knots[-1], 200)[1:-1])
        away.append(max(np.linalg.norm(shape - p, axis=1).min() for p in curve))
        durations.append(motion.knots[-1])
    assert away[0] > away[1] > 0.99 * away[2]
    assert away[0] < 0.02  # sharp zigzags; the smooth shapes of plans move by 0.2 mm
    assert away[2] < 2e-4  # the shape itself, up to the samples' distance
    assert max(durations[:2]) < 0.9 * durations[2]


def test_a_plans_curve_and_clearance_hardly_move_by_being_timed() -> None:
    wall = [Box((9, 6, 0), (10, 15, 4)), Cylinder(centre=(5, 5), radius=0.4, z=(0, 4))]
    p = plan(World(((0, 0, 0), (20, 20, 4)), wall), (1, 10, 1.5), (19, 10, 1.5), LIMITS, 0.3)
    assert p.certified
    assert p.trajectory.duration < 0.9 * uniform_scaling(p.trajectory.control_points[::4], LIMITS)[-1]
    points = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)(
        np.linspace(0, p.trajectory.duration, 9999)[:-1]
    )
    q = np.maximum(np.array(wall[0].lower) - points, points - np.array(wall[0].upper))
    assert np.linalg.norm(np.maximum(q, 0), axis=1).min() >= 0.3


def test_standing_still_takes_the_shortest_time_there_is() -> None:
    motion = fastest(np.full((16, 3), 2.0), LIMITS)
    assert motion.knots[-1] == pytest.approx(0.1, rel=1e-9)


@pytest.mark.parametrize("length", [1e-9, 1e-6, 1e-3, 1e-2])
def test_a_tiny_move_is_timed_without_a_fuss(length: float) -> None:
    points = np.linspace([0.0, 0, 0], [length, 0, 0], 16)[[0, 0, *range(16), 15, 15]]
    motion = fastest(points, LIMITS)
    assert np.isfinite(motion.knots).all()
    assert within(motion.control_points, motion.knots, LIMITS)
    assert motion.knots[-1] <= max(0.11, 1.01 * straight(length, 3.0, 6.0, 60.0))


@pytest.mark.parametrize("corners", [3, 12])
def test_a_polyline_with_a_rest_at_each_corner_is_kept_exactly_and_each_leg_is_a_double_s(corners: int) -> None:
    rng = np.random.default_rng(corners)
    ends = np.cumsum(rng.uniform(0.5, 3.0, size=(corners, 3)) * [1, 1, 0.2], axis=0)
    points = [ends[0]] * 3
    for a, b in itertools.pairwise(ends):
        points += [a + (b - a) * k / 8 for k in range(1, 8)] + [b] * 3
    motion = fastest(np.array(points), LIMITS)
    assert_within(motion, LIMITS)
    curve = BSpline(motion.knots, motion.control_points, 3)(np.linspace(0, motion.knots[-1], 3000)[:-1])
    off = np.full(len(curve), np.inf)
    for a, b in itertools.pairwise(ends):
        along = np.clip((curve - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        off = np.minimum(off, np.linalg.norm(a + along[:, None] * (b - a) - curve, axis=1))
    assert off.max() < 1e-9
    legs = [straight(float(np.linalg.norm(b - a)), 3.0, 6.0, 60.0) for a, b in itertools.pairwise(ends)]
    assert motion.knots[-1] <= 1.05 * sum(legs)


def test_equal_control_points_in_a_row_leave_every_knot_apart() -> None:
    points = np.repeat(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0]]), [3, 9, 4], axis=0)
    for motion in timings(points, clamped_knots(16), LIMITS):
        assert (np.diff(motion.knots[3:-3]) > 0).all()
        assert_within(motion, LIMITS)


@pytest.mark.parametrize("n", [120, 400, 1000])
def test_long_shapes_are_timed_with_a_bounded_number_of_intervals(n: int) -> None:
    points = np.cumsum(np.random.default_rng(n).uniform(-0.1, 0.3, size=(n, 3)), axis=0)
    points[:3], points[-3:] = points[0], points[-1]
    motion = fastest(points, LIMITS)
    assert len(motion.control_points) <= 1700
    assert within(motion.control_points, motion.knots, LIMITS)
    assert motion.knots[-1] < 0.75 * uniform_scaling(points, LIMITS)[-1]


def test_uneven_knots_of_a_shape_are_welcome() -> None:
    points, rng = wavy(), np.random.default_rng(5)
    inner = np.cumsum(rng.uniform(0.5, 2.0, size=13))
    knots = np.concatenate([np.zeros(4), inner / inner[-1], np.ones(3)])
    motions = list(timings(points, knots, LIMITS))
    assert len(motions) == 3
    for motion in motions:
        assert_within(motion, LIMITS)
    np.testing.assert_allclose(motions[-1].knots / motions[-1].knots[-1], knots, atol=1e-12)
