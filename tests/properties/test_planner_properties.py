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
