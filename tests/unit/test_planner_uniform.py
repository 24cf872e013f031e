"""The paper's uniform splines (Eq. 1-11) and its polynomial initialisation (Eq. 12-20), mended; scipy is the judge."""

import numpy as np
import pytest
from scipy.interpolate import BPoly, BSpline

from planner.bspline import DEGREE, clamped_knots
from planner.polynomial import fit, quintic, quintics, segment_times, waypoints
from planner.uniform import UniformSpline, basis, through

S = np.linspace(0.0, 1.0, 11)


def test_the_basis_of_equation_2_is_the_uniform_cubic_b_spline_of_scipy() -> None:
    knots = np.arange(-3.0, 5.0)
    for derivative in range(3):
        for j, ours in enumerate(basis(S[:-1], derivative).T):
            theirs = BSpline(knots, np.eye(4)[j], DEGREE)(S[:-1], nu=derivative)
            np.testing.assert_allclose(ours, theirs, atol=1e-14)


def test_equation_6_needs_the_derivatives_that_lead_to_equation_7() -> None:
    v = basis(S, 1)
    np.testing.assert_allclose(v[:, 1], 1.5 * S**2 - 2.0 * S, atol=1e-15)
    np.testing.assert_allclose(v[:, 2], -1.5 * S**2 + S + 0.5, atol=1e-15)
    np.testing.assert_allclose(basis(S, 2), np.stack([1 - S, 3 * S - 2, 1 - 3 * S, S], axis=1), atol=1e-15)  # Eq. 7
    printed = S**2 - 2.0 * S  # v_2 as printed: its slope is 2 s - 2, and Eq. 7 says 3 s - 2
    assert np.abs(np.gradient(printed, S)[1:-1] - basis(S, 2)[1:-1, 1]).max() > 0.5


def test_velocity_and_acceleration_carry_the_time_scale_that_equations_8_and_9_leave_out() -> None:
    spline = UniformSpline(np.random.default_rng(0).normal(size=(7, 3)), dt=0.3)
    t, h = np.linspace(0.01, spline.duration - 0.01, 50), 1e-5
    for k in (1, 2):
        numeric = (spline.evaluate(t + h, k - 1) - spline.evaluate(t - h, k - 1)) / (2.0 * h)
        np.testing.assert_allclose(spline.evaluate(t, k), numeric, atol=1e-6)


def test_equation_10_passes_the_ends_with_the_velocity_asked_for_and_no_acceleration() -> None:
    inner = np.random.default_rng(1).normal(size=(5, 3))
    v0, v1 = np.array([1.0, -0.5, 0.2]), np.array([0.3, 0.3, -0.1])
    spline = through(inner, 0.4, v0, v1)
    ends = np.array([0.0, spline.duration])
    np.testing.assert_allclose(spline.evaluate(ends), inner[[0, -1]], atol=1e-14)
    np.testing.assert_allclose(spline.evaluate(ends, 1), [v0, v1], atol=1e-14)
    np.testing.assert_allclose(spline.evaluate(ends, 2), 0.0, atol=1e-12)


def test_the_clamped_form_of_a_uniform_spline_is_the_same_curve() -> None:
    spline = UniformSpline(np.random.default_rng(2).normal(size=(9, 3)), dt=0.5)
    points, knots = spline.clamped()
    t = np.linspace(0.0, spline.duration, 101)
    np.testing.assert_allclose(BSpline(knots, points, DEGREE)(t), spline.evaluate(t), atol=1e-13)


@pytest.mark.parametrize("points", [np.zeros((3, 3)), np.zeros((5, 2)), np.full((5, 3), np.nan)])
def test_a_uniform_spline_refuses_what_makes_no_span(points: np.ndarray) -> None:
    with pytest.raises(ValueError, match="control points"):
        UniformSpline(points, 1.0)


def test_waypoints_divide_the_line_evenly_and_no_wider_than_asked() -> None:
    start, goal = np.zeros(3), np.array([6.0, 8.0, 0.0])
    points = waypoints(start, goal, 3.0)
    assert len(points) == 5  # m = floor(10/3) + 1 = 4
    np.testing.assert_allclose(np.linalg.norm(np.diff(points, axis=0), axis=1), 2.5)
    assert len(waypoints(start, goal, 20.0)) == 3  # m = 2: one in the middle


def test_the_first_and_last_segment_take_twice_the_time() -> None:
    times = segment_times(waypoints(np.zeros(3), np.array([9.0, 0.0, 0.0]), 3.1), 3.0)
    np.testing.assert_allclose(times, [2.0, 1.0, 2.0])


@pytest.mark.parametrize("t", [0.01, 0.7, 40.0])
def test_a_quintic_is_the_hermite_polynomial_of_its_end_states(t: float) -> None:
    rng = np.random.default_rng(3)
    begin, end = rng.normal(size=(2, 3, 3))
    F = quintic(begin, end, t)
    theirs = BPoly.from_derivatives([0.0, t], [begin, end])
    s = np.linspace(0.0, t, 20)
    ours = np.stack([np.polyval(F[:, a], s) for a in range(3)], axis=1)
    np.testing.assert_allclose(ours, theirs(s), rtol=1e-9, atol=1e-9 * max(1.0, t**2))


def test_the_fitted_spline_keeps_the_end_states_and_follows_the_polynomial() -> None:
    begin = np.array([[1.0, 10.0, 1.5], [2.0, 1.0, 0.0], [0.5, 0.0, 0.0]])
    end = np.array([[19.0, 9.0, 1.5], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
    curve = quintics(begin, end, speed=3.0, spacing=5.0)
    points = fit(curve, 30)
    spline = BSpline(clamped_knots(30, curve.duration), points, DEGREE)
    for k in range(3):
        np.testing.assert_allclose(spline(0.0, nu=k), begin[k], atol=1e-9)
        np.testing.assert_allclose(spline(curve.duration - 1e-12, nu=k), end[k], atol=1e-6)
    t = np.linspace(0.0, curve.duration, 300)
    assert np.abs(spline(t) - curve.evaluate(t)).max() < 0.02
    assert np.abs(spline(t, nu=1) - curve.evaluate(t, 1)).max() < 0.25
