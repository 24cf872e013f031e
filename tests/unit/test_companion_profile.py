"""A straight move starts and ends at rest and touches exactly one of its limits."""

import numpy as np
import pytest

from companion.profile import StraightMove
from planner import Limits

START, END = np.array([1.0, 2.0, 0.0]), np.array([1.0, 2.0, -3.0])


@pytest.mark.parametrize(
    "limits", [(1, 100, 1000), (100, 2, 1000), (100, 100, 5)], ids=["speed", "acceleration", "jerk"]
)
def test_the_tightest_limit_is_reached_and_none_exceeded(limits):
    bounds = Limits(*map(float, limits))
    move = StraightMove.within(START, END, bounds)
    t = np.linspace(0, move.duration, 20_001)
    states = [move.state(x) for x in t]
    velocity = np.array([s.velocity for s in states])
    acceleration = np.array([s.acceleration for s in states])
    jerk = np.gradient(acceleration, t, axis=0)[1:-1]
    peaks = [np.linalg.norm(v, axis=1).max() for v in (velocity, acceleration, jerk)]
    ratios = [p / b for p, b in zip(peaks, (bounds.speed, bounds.acceleration, bounds.jerk), strict=True)]
    assert max(ratios) == pytest.approx(1.0, abs=1e-3)


def test_it_begins_and_ends_at_rest_and_stays_there():
    move = StraightMove.within(START, END, Limits(1.0, 5.0, 50.0))
    for t, place in ((-1.0, START), (0.0, START), (move.duration, END), (move.duration + 9, END)):
        state = move.state(t)
        np.testing.assert_allclose(state.position, place, atol=1e-12)
        np.testing.assert_allclose((state.velocity, state.acceleration), 0.0, atol=1e-9)


def test_velocity_and_acceleration_are_the_derivatives_of_position():
    move = StraightMove.within(START, END, Limits(1.0, 5.0, 50.0))
    t, h = 0.37 * move.duration, 1e-5
    before, here, later = (move.state(t + d) for d in (-h, 0.0, h))
    np.testing.assert_allclose((later.position - before.position) / (2 * h), here.velocity, atol=1e-7)
    np.testing.assert_allclose((later.velocity - before.velocity) / (2 * h), here.acceleration, atol=1e-7)


def test_no_distance_takes_no_time():
    move = StraightMove.within(START, START, Limits(1.0, 1.0, 1.0))
    assert move.duration == 0.0
    np.testing.assert_array_equal(move.state(0.5).position, START)
