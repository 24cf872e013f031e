"""Splines: identities, and scipy's BSpline as the judge (it shares no code with ours)."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.interpolate import BSpline

from planner.bspline import (
    DEGREE,
    basis,
    bezier_pieces,
    clamped_knots,
    derivative_control_points,
    evaluate,
    gram_matrix,
    refine,
    span_hulls,
)
from planner.errors import KnotError
from planner.limits import derivative_bounds
from planner.trajectory import Trajectory


@pytest.fixture
def curve() -> tuple[np.ndarray, np.ndarray]:
    """A clamped cubic whose interior knots are unevenly spaced."""
    rng = np.random.default_rng(4)
    inner = np.cumsum(rng.uniform(0.2, 1.0, 8))
    return rng.normal(size=(12, 3)), np.concatenate([np.zeros(4), inner, np.full(4, inner[-1] + 0.5)])


def test_ten_cubic_control_points_take_fourteen_knots_spaced_by_a_seventh() -> None:
    assert clamped_knots(10) == pytest.approx([0] * 4 + [k / 7 for k in range(1, 7)] + [1] * 4)


@pytest.mark.parametrize("derivative", [0, 1, 2, 3])
def test_values_and_derivatives_agree_with_scipy(curve: tuple[np.ndarray, np.ndarray], derivative: int) -> None:
    points, knots = curve
    t = np.linspace(0, knots[-1], 173)[:-1]
    reference = BSpline(knots, points, 3).derivative(derivative) if derivative else BSpline(knots, points, 3)
    np.testing.assert_allclose(evaluate(points, knots, t, derivative=derivative), reference(t), atol=1e-10)


def test_a_scalar_time_gives_one_point_and_times_outside_are_clamped(curve: tuple[np.ndarray, np.ndarray]) -> None:
    points, knots = curve
    assert evaluate(points, knots, 0.3).shape == (3,)
    np.testing.assert_array_equal(evaluate(points, knots, -1.0), points[0])
    np.testing.assert_array_equal(evaluate(points, knots, knots[-1] + 1), points[-1])


def test_the_fourth_derivative_of_a_cubic_is_zero(curve: tuple[np.ndarray, np.ndarray]) -> None:
    assert not evaluate(*curve, np.linspace(0, 1, 5), derivative=4).any()


def test_basis_functions_sum_to_one_and_their_derivatives_to_zero() -> None:
    u = np.linspace(0, 1, 50)
    np.testing.assert_allclose(basis(clamped_knots(9), 9, u).sum(axis=1), 1.0, atol=1e-14)
    np.testing.assert_allclose(basis(clamped_knots(9), 9, u, derivative=1).sum(axis=1), 0.0, atol=1e-12)


def test_derivative_control_points_are_those_of_scipys_derivative(curve: tuple[np.ndarray, np.ndarray]) -> None:
    points, knots = curve
    reference = BSpline(knots, points, 3).derivative()
    np.testing.assert_allclose(derivative_control_points(points, knots, 3), reference.c[: len(points) - 1])


def test_a_knot_repeated_more_often_than_the_degree_has_no_derivative() -> None:
    knots = np.array([0.0] * 4 + [0.5] * 4 + [1.0] * 4)
    with pytest.raises(KnotError, match="more than 3"):
        derivative_control_points(np.zeros((8, 3)), knots, 3)


def test_bezier_pieces_trace_the_same_curve(curve: tuple[np.ndarray, np.ndarray]) -> None:
    points, knots = curve
    pieces = bezier_pieces(points, knots)
    s = np.linspace(0, 1, 7)[:, None]
    for piece, a, b in zip(pieces, knots[3:-4], knots[4:-3], strict=True):
        bernstein = np.hstack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3])
        np.testing.assert_allclose(bernstein @ piece, BSpline(knots, points, 3)(a + s[:, 0] * (b - a)), atol=1e-12)


def test_every_span_stays_in_its_ball_and_every_derivative_under_its_bound(
    curve: tuple[np.ndarray, np.ndarray],
) -> None:
    points, knots = curve
    centres, radii = span_hulls(points)
    for centre, radius, a, b in zip(centres, radii, knots[3:-4], knots[4:-3], strict=True):
        inside = BSpline(knots, points, 3)(np.linspace(a, b, 40))
        assert (np.linalg.norm(inside - centre, axis=1) <= radius + 1e-12).all()
    bounds = derivative_bounds(points, knots)
    t = np.linspace(0, knots[-1], 400)[:-1]
    for k, bound in enumerate((bounds.speed, bounds.acceleration, bounds.jerk), start=1):
        assert np.linalg.norm(BSpline(knots, points, 3).derivative(k)(t), axis=1).max() <= bound * (1 + 1e-12)


def test_the_gram_matrix_integrates_the_square_of_a_derivative(curve: tuple[np.ndarray, np.ndarray]) -> None:
    points, knots = curve
    for k in (1, 2):
        spline = BSpline(knots, points, 3).derivative(k)
        truth = sum(quad(lambda u, s=spline: (s(u) ** 2).sum(), a, b)[0] for a, b in pairwise(knots[3:-3]))
        q = gram_matrix(knots, len(points), k)
        assert np.einsum("ia,ij,ja->", points, q, points) == pytest.approx(truth, rel=1e-9)


def test_a_straight_line_is_as_long_as_its_ends_are_apart() -> None:
    points = np.linspace(0, 1, 8)[:, None] * np.array([3.0, 4.0, 12.0])
    assert Trajectory(points, clamped_knots(8)).length == pytest.approx(13.0, rel=1e-12)


def test_the_length_is_the_integral_of_the_speed(curve: tuple[np.ndarray, np.ndarray]) -> None:
    points, knots = curve
    velocity = BSpline(knots, points, 3).derivative()
    truth = sum(quad(lambda u: np.linalg.norm(velocity(u)), a, b, limit=200)[0] for a, b in pairwise(knots[3:-3]))
    assert Trajectory(points, knots).length == pytest.approx(truth, rel=1e-4)


@pytest.mark.parametrize(("n", "duration"), [(3, 1.0), (8, 0.0), (8, float("inf"))])
def test_knots_that_cannot_be_are_refused(n: int, duration: float) -> None:
    with pytest.raises(KnotError):
        clamped_knots(n, duration)


def test_a_curve_keeps_its_shape_on_finer_knots_and_on_a_part_of_its_range() -> None:
    rng = np.random.default_rng(0)
    points, knots = rng.normal(size=(9, 3)), clamped_knots(9, 2.0)
    finer = np.sort(np.concatenate([knots, rng.uniform(0.0, 2.0, 7)]))
    a, b = 0.7, 1.5
    part = np.concatenate([[a] * 4, knots[(knots > a) & (knots < b)], [b] * 4])
    for new in (finer, part):
        t = np.linspace(new[0], new[-1], 200)
        same = BSpline(new, refine(points, knots, new), DEGREE)(t)
        np.testing.assert_allclose(same, BSpline(knots, points, DEGREE)(t), atol=1e-13)
