"""A path is slowed to a stop and let run again without a jump; circles and turns keep their limits."""

import math

import numpy as np
import pytest

from companion.pace import RAMPS_US, Pace, go_us, paced, stop_us
from companion.profile import Circle, MotionState, StraightMove, Turn
from planner import Limits

LIMITS = Limits(speed=3.0, acceleration=6.0, jerk=60.0)
TICK_US = 1000


def cruise(t):
    """Straight on at 3 m/s."""
    return MotionState(np.array([3.0 * t, 0.0, 0.0]), np.array([3.0, 0.0, 0.0]), np.zeros(3))


def walked(pace, motion, times_us):
    states = []
    for t in times_us:
        time = pace.at(int(t))
        states.append(paced(motion(time.us * 1e-6), time))
    return tuple(np.array([getattr(s, name) for s in states]) for name in ("position", "velocity", "acceleration"))


def assert_smooth(times_us, position, velocity, acceleration, most):
    """Velocity and acceleration are the position's own numeric derivatives; nothing jumps."""
    dt = np.diff(times_us)[:, None] * 1e-6
    np.testing.assert_allclose(np.diff(position, axis=0) / dt, (velocity[1:] + velocity[:-1]) / 2, atol=1e-4)
    np.testing.assert_allclose(np.diff(velocity, axis=0) / dt, (acceleration[1:] + acceleration[:-1]) / 2, atol=0.05)
    assert np.linalg.norm(acceleration, axis=1).max() <= most * 1.05


def test_until_it_is_told_otherwise_the_path_goes_with_the_flight_to_the_microsecond():
    assert [Pace().at(t) for t in (0, 7, 123_456_789)] == [(0, 1, 0), (7, 1, 0), (123_456_789, 1, 0)]


def test_at_3_m_per_s_it_stops_within_2_m_and_goes_on_from_there():
    pace, begin = Pace(), 2_000_000
    ramp = stop_us(cruise, begin * 1e-6, LIMITS)
    pace.stop(begin, ramp)
    assert not pace.running(begin + 1)
    assert pace.still(begin + ramp)
    stopped = pace.at(begin + ramp + 9_000_000)
    assert stopped == pace.at(begin + ramp)
    assert stopped.rate == 0.0
    assert 3.0 * (stopped.us - begin) * 1e-6 < 1.6
    times = np.arange(begin, begin + ramp + 500_000, TICK_US)
    assert_smooth(times, *walked(pace, cruise, times), LIMITS.acceleration)
    again = begin + 5_000_000
    pace.go(again, go_us(cruise, stopped.us * 1e-6, LIMITS))
    times = np.arange(again, again + 2_000_000, TICK_US)
    position, velocity, acceleration = walked(pace, cruise, times)
    assert_smooth(times, position, velocity, acceleration, LIMITS.acceleration)
    assert position[0, 0] == pytest.approx(3e-6 * stopped.us, abs=1e-5)
    assert velocity[-1, 0] == 3.0
    assert pace.running(again + RAMPS_US[-1])


def test_a_slow_path_stops_sooner_and_a_hard_one_later():
    slow = lambda t: MotionState(np.array([0.2 * t, 0, 0]), np.array([0.2, 0, 0]), np.zeros(3))  # noqa: E731
    assert stop_us(slow, 0.0, LIMITS) == RAMPS_US[0]
    assert stop_us(cruise, 0.0, Limits(3.0, 1.5, 60.0)) == RAMPS_US[-1]
    assert stop_us(cruise, 0.0, Limits(3.0, 0.5, 60.0)) == 0  # none of them is gentle enough


@pytest.mark.parametrize(("radius", "turns", "clockwise"), [(3.0, 1.25, True), (0.2, 0.01, False), (50.0, 3.0, True)])
def test_a_circle_is_round_smooth_within_the_limits_and_from_rest_to_rest(radius, turns, clockwise):
    angle = 2 * math.pi * turns * (1 if clockwise else -1)
    circle = Circle.within(np.array([5.0, -2.0, -3.0]), 0.7, radius, angle, LIMITS)
    times = np.linspace(0, circle.duration, 40_001)
    states = [circle.state(t) for t in times]
    position, velocity, acceleration = (np.array([s[k] for s in states]) for k in range(3))
    np.testing.assert_allclose(np.linalg.norm(position - (5, -2, -3), axis=1), radius, rtol=1e-12)
    np.testing.assert_allclose((velocity[0], velocity[-1]), 0, atol=1e-9)
    dt = times[1] - times[0]
    np.testing.assert_allclose(np.gradient(position, dt, axis=0)[2:-2], velocity[2:-2], atol=2e-3)
    assert np.linalg.norm(velocity, axis=1).max() <= LIMITS.speed + 1e-9
    assert np.linalg.norm(acceleration, axis=1).max() <= LIMITS.acceleration + 1e-9
    assert np.linalg.norm(np.diff(acceleration, axis=0) / dt, axis=1).max() <= LIMITS.jerk * 1.01
    swept = np.unwrap(np.arctan2(position[:, 1] + 2, position[:, 0] - 5))
    assert swept[-1] - swept[0] == pytest.approx(angle, rel=1e-9)


@pytest.mark.parametrize(
    ("start", "end", "angle"), [(350, 10, 20), (10, 350, -20), (0, 90, 90), (90, 90, 0), (-170, 170, -20)]
)
def test_the_nose_turns_the_short_way_at_no_more_than_its_rate(start, end, angle):
    turn = Turn.within(math.radians(start), math.radians(end), math.radians(45))
    assert math.degrees(turn.angle) == pytest.approx(angle, abs=1e-9)
    times = np.linspace(0, turn.duration, 500)
    yaw = np.unwrap([turn.yaw(t) for t in times])
    assert math.degrees(yaw[-1] - yaw[0]) == pytest.approx(angle, abs=1e-9)
    if angle:
        assert np.abs(np.gradient(yaw, times)).max() <= math.radians(45) * 1.001
    assert math.cos(turn.yaw(99.0)) == pytest.approx(math.cos(math.radians(end)))


def test_a_straight_move_is_unchanged_by_a_pace_that_runs():
    move = StraightMove.within(np.zeros(3), np.array([0.0, 0.0, -2.0]), LIMITS)
    state = move.state(0.3)
    assert paced(state, Pace().at(300_000)) is state
