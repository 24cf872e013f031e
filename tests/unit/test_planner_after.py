"""Cutting a trajectory and joining two: the curve stays, held against scipy's splines."""

import numpy as np
import pytest
from scipy.interpolate import BSpline

from planner import Trajectory


def uneven(seed: int, n: int = 12) -> Trajectory:
    rng = np.random.default_rng(seed)
    inner = np.cumsum(rng.uniform(0.05, 0.7, n - 3))
    return Trajectory(rng.normal(size=(n, 3)), np.concatenate([np.zeros(4), inner, np.repeat(inner[-1], 3)]))


def truth(trajectory: Trajectory, t: np.ndarray, derivative: int) -> np.ndarray:
    return BSpline(trajectory.knots, trajectory.control_points, 3)(t, nu=derivative)


@pytest.mark.parametrize("part", [0.0, 0.13, 0.5, 0.97])
def test_the_remainder_is_the_same_curve(part):
    whole = uneven(1)
    cut = part * whole.duration
    rest = whole.after(cut)
    assert rest.duration == pytest.approx(whole.duration - cut, abs=1e-14)
    t = np.linspace(0.0, rest.duration * (1 - 1e-9), 100)
    for derivative in range(3):
        np.testing.assert_allclose(truth(rest, t, derivative), truth(whole, t + cut, derivative), atol=1e-8)


def test_the_remainder_from_a_knot_starts_there():
    whole = uneven(2)
    rest = whole.after(float(whole.knots[6]))
    assert len(rest.control_points) == len(whole.control_points) - 3
    np.testing.assert_allclose(rest.position(0.0), whole.position(whole.knots[6]), atol=1e-14)


@pytest.mark.parametrize("t", [-0.1, 1e9, float("nan")])
def test_there_is_no_remainder_outside_a_trajectory(t):
    with pytest.raises(ValueError, match="expected from 0 s"):
        uneven(3).after(t)


def test_two_halves_joined_are_the_whole():
    whole = uneven(4)
    cut = 0.4 * whole.duration
    back = Trajectory(whole.control_points[::-1], whole.duration - whole.knots[::-1])  # flown backward
    front = back.after(whole.duration - cut)
    front = Trajectory(front.control_points[::-1], front.duration - front.knots[::-1])
    joined = front.then(whole.after(cut))
    assert joined.duration == pytest.approx(whole.duration, abs=1e-14)
    t = np.linspace(0.0, whole.duration, 300)
    for derivative in range(3):
        np.testing.assert_allclose(truth(joined, t, derivative), truth(whole, t, derivative), atol=1e-8)
