"""The cost of a motion and the kernels under it, against finite differences, scipy and the proofs' own bounds."""

import numpy as np
import pytest
from scipy.interpolate import BSpline

from planner import Box, Cylinder, Limits, MovingBox, MovingSphere, World
from planner.backup import PUSHES, dash
from planner.limits import derivative_bounds
from planner.movers import table
from planner.timed import derivative_norms, pin, span_basis, span_of, timed_cost, timed_of
from planner.trajectory import Trajectory
from planner.warm import factor, solve

LIMITS = np.array([3.0, 6.0, 60.0])


def uneven_knots(rng: np.random.Generator, n: int) -> np.ndarray:
    inner = np.cumsum(rng.uniform(0.1, 0.5, n - 3))
    return np.concatenate([np.zeros(4), inner, np.repeat(inner[-1], 3)])


def crowded() -> tuple[World, np.ndarray]:
    world = World(((-5, -5, -5), (5, 5, 5)), [Cylinder((1.0, 0.5), 0.4, (-5, 5)), Box((-2, -2, -2), (-1, -1, 2))])
    movers = [
        MovingSphere((0.0, 0.0, 0.0), (0.5, 0.2, 0.0), 0.4, growth=0.1),
        MovingBox((2.0, 2.0, 2.0), (3.0, 3.0, 3.0), (-0.5, 0.0, 0.0), growth=0.1, until=2.0),
    ]
    return world, table(movers)


def test_basis_functions_and_their_derivatives_are_those_of_scipy():
    rng = np.random.default_rng(0)
    knots, row = uneven_knots(rng, 10), np.empty((3, 4))
    for t in rng.uniform(0.0, knots[-1], 50):
        k = span_of(knots, t)
        assert knots[k] <= t < knots[k + 1]
        span_basis(knots, k, t, row)
        for q in range(4):
            spline = BSpline(knots, np.eye(10)[k - 3 + q], 3)
            for derivative in range(3):
                assert row[derivative, q] == pytest.approx(float(spline(t, nu=derivative)), abs=1e-9)


def test_the_gradient_of_the_cost_is_that_of_finite_differences():
    rng = np.random.default_rng(1)
    world, movers = crowded()
    for _ in range(5):
        knots = uneven_knots(rng, 12)
        points = rng.uniform(-4.0, 4.0, (12, 3))
        cost = timed_of(points, knots, 0.5, world.scene, world.walls, movers, LIMITS, 0.6, 0.9, 10.0)
        x, g, scratch = points[3:-3].ravel().copy(), np.empty(18), np.empty(18)
        timed_cost(x, g, cost)
        assert np.abs(g).max() > 1.0
        for i in range(18):
            step = np.zeros(18)
            step[i] = 1e-6
            slope = (timed_cost(x + step, scratch, cost) - timed_cost(x - step, scratch, cost)) / 2e-6
            assert g[i] == pytest.approx(slope, rel=1e-4, abs=1e-4 * np.abs(g).max())


def test_the_norms_held_by_the_hinges_are_those_that_are_proved():
    rng = np.random.default_rng(2)
    knots, points = uneven_knots(rng, 12), rng.normal(size=(12, 3))
    bounds = derivative_bounds(points, knots)
    expected = [bounds.speed, bounds.acceleration, bounds.jerk]
    np.testing.assert_allclose(derivative_norms(points, knots), expected, rtol=1e-12)


def test_pinned_control_points_give_both_ends_the_states_asked_for():
    rng = np.random.default_rng(3)
    knots, points = uneven_knots(rng, 9), rng.normal(size=(9, 3))
    start, end = rng.normal(size=(3, 3)), rng.normal(size=(3, 3))
    pin(points, knots, start, end)
    spline = BSpline(knots, points, 3)
    for derivative in range(3):
        np.testing.assert_allclose(spline(0.0, nu=derivative), start[derivative], atol=1e-10)
        np.testing.assert_allclose(spline(knots[-1], nu=derivative), end[derivative], atol=1e-9)


def test_the_first_metric_inverts_the_energys_second_derivative():
    rng = np.random.default_rng(4)
    knots, n = uneven_knots(rng, 12), 12
    d_v = np.array([3.0 / (knots[i + 4] - knots[i + 1]) * (np.eye(n)[i + 1] - np.eye(n)[i]) for i in range(n - 1)])
    d_a = np.array([2.0 / (knots[i + 4] - knots[i + 2]) * (d_v[i + 1] - d_v[i]) for i in range(n - 2)])
    m_v = (knots[4 : n + 3] - knots[1:n]) / 3.0
    m_a = (knots[4 : n + 2] - knots[2:n]) / 2.0
    tau = LIMITS[0] / LIMITS[1]
    whole = 2.0 / LIMITS[0] ** 2 * (d_v.T @ (m_v[:, None] * d_v) + tau**2 * d_a.T @ (m_a[:, None] * d_a))
    q = rng.normal(size=(n - 6, 3))
    solved = q.ravel().copy()
    solve(factor(knots, n - 6, LIMITS), solved)
    np.testing.assert_allclose(whole[3:-3, 3:-3] @ solved.reshape(-1, 3), q, atol=1e-9)


def test_a_dash_begins_as_flown_ends_at_rest_and_pushes_within_the_limits():
    rng = np.random.default_rng(5)
    limits = Limits(*LIMITS)
    for _ in range(100):
        velocity, acceleration, direction = rng.normal(size=(3, 3))
        velocity *= rng.uniform(0.0, 2.0) / np.linalg.norm(velocity)
        acceleration *= rng.uniform(0.0, 2.0) / np.linalg.norm(acceleration)
        direction /= np.linalg.norm(direction)
        state = np.array([rng.normal(size=3), velocity, acceleration])
        for pushes in PUSHES:
            points, knots = dash(state, direction, pushes, LIMITS)
            flown = Trajectory(points, knots)
            begun, ended = flown.state(0.0), flown.state(flown.duration)
            np.testing.assert_allclose([begun.position, begun.velocity, begun.acceleration], state, atol=1e-9)
            np.testing.assert_allclose([ended.velocity, ended.acceleration], np.zeros((2, 3)), atol=1e-9)
            bounds = derivative_bounds(points, knots)
            assert bounds.acceleration <= limits.acceleration
            assert bounds.jerk <= limits.jerk


def test_the_straight_stop_takes_little_more_than_the_fastest_there_is():
    state = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    _, knots = dash(state, np.zeros(3), 0, LIMITS)
    fastest = 3.0 / 6.0 + 6.0 / 60.0  # v/a + a/j: the trapezium of acceleration
    assert fastest <= knots[-1] <= 1.08 * fastest
