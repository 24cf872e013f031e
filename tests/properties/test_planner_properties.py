"""What must hold for any world: a certified plan is clear by an independent check, whatever was asked."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BSpline

from planner import Cylinder, Limits, PlannerError, Sphere, World, plan

coordinate = st.floats(0.5, 9.5)
posts = st.lists(st.tuples(coordinate, coordinate, st.floats(0.05, 1.0), st.booleans()), max_size=12)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    posts=posts,
    ends=st.tuples(coordinate, coordinate, coordinate, coordinate),
    speed=st.floats(0.3, 12),
    acceleration=st.floats(0.5, 10),
    radius=st.sampled_from([0.0, 0.1, 0.35]),
    seed=st.integers(0, 3),
)
def test_every_plan_is_clear_and_within_limits_or_a_typed_error(
    posts: list[tuple[float, float, float, bool]],
    ends: tuple[float, float, float, float],
    speed: float,
    acceleration: float,
    radius: float,
    seed: int,
) -> None:
    solids = [Sphere((x, y, 1.5), r) if ball else Cylinder((x, y), r, (0, 3)) for x, y, r, ball in posts]
    limits = Limits(speed, acceleration, 10 * acceleration)
    try:
        p = plan(World(((0, 0, 0), (10, 10, 3)), solids), (*ends[:2], 1.5), (*ends[2:], 1.5), limits, radius, seed=seed)
    except PlannerError:
        return
    assert p.certified
    spline = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)
    t = np.linspace(0, p.trajectory.duration, 3001)[:-1]
    points = spline(t)
    for x, y, r, ball in posts:
        flat = np.hypot(points[:, 0] - x, points[:, 1] - y)
        away = np.hypot(flat, points[:, 2] - 1.5) if ball else flat
        assert away.min() - r >= radius
    for k, limit in ((1, limits.speed), (2, limits.acceleration), (3, limits.jerk)):
        assert np.linalg.norm(spline.derivative(k)(t), axis=1).max() <= limit * (1 + 1e-9)


vector = st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1))


@settings(max_examples=40, deadline=None, derandomize=True)
@given(
    posts=posts,
    ends=st.tuples(coordinate, coordinate, coordinate, coordinate),
    limits=st.tuples(st.floats(0.3, 12), st.floats(0.5, 10), st.floats(3, 30)),
    state=st.tuples(vector, vector, vector),
    via=st.lists(st.tuples(coordinate, coordinate), max_size=2),
)
def test_from_any_state_through_any_points_no_limit_is_passed_or_it_is_a_typed_error(
    posts: list[tuple[float, float, float, bool]],
    ends: tuple[float, float, float, float],
    limits: tuple[float, float, float],
    state: tuple[tuple[float, float, float], ...],
    via: list[tuple[float, float]],
) -> None:
    solids = [Sphere((x, y, 1.5), r) if ball else Cylinder((x, y), r, (0, 3)) for x, y, r, ball in posts]
    asked = [np.array(v) * limits[k] / 2 for v, k in zip(state, (0, 1, 0), strict=True)]  # norms below the limits
    bounds = Limits(limits[0], limits[1], limits[1] * limits[2])
    try:
        p = plan(
            World(((0, 0, 0), (10, 10, 3)), solids),
            (*ends[:2], 1.5),
            (*ends[2:], 1.5),
            bounds,
            0.1,
            start_velocity=asked[0],
            start_acceleration=asked[1],
            goal_velocity=asked[2],
            via=[(x, y, 1.5) for x, y in via],
        )
    except PlannerError:
        return
    assert p.certified
    T = p.trajectory.duration
    t = np.concatenate([np.linspace(0, T, 3001), p.trajectory.knots[4:-3] - 1e-12 * T])
    x = p.trajectory.position(t[:3001])
    for r, o in ((s.radius, s.centre) for s in solids):
        assert (np.linalg.norm(x[:, : len(o)] - np.array(o), axis=1) - r).min() >= 0.1
    spline = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)
    for k, limit in enumerate((bounds.speed, bounds.acceleration, bounds.jerk), start=1):
        assert np.linalg.norm(spline.derivative(k)(t[t < T]), axis=1).max() <= limit * (1 + 1e-9)
    h = T / 3000  # finite differences of positions see no more than that either
    for k, limit in ((1, bounds.speed), (2, bounds.acceleration), (3, bounds.jerk)):
        assert np.linalg.norm(np.diff(x, n=k, axis=0), axis=1).max() <= limit * h**k * (1 + 1e-6) + 1e-13
    first, last = p.trajectory.state(0.0), p.trajectory.state(T)
    np.testing.assert_allclose(first.velocity, asked[0], atol=1e-9)
    np.testing.assert_allclose(first.acceleration, asked[1], atol=1e-8)
    np.testing.assert_allclose(last.velocity, asked[2], atol=1e-9)
