"""Corners and circles: continuous by numeric derivatives, within their limits, as near as they say."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fakevehicle.circle import circle
from fakevehicle.corner import SLOWEST_PASS, rounded
from fakevehicle.course import PARAMETERS, Course
from fakevehicle.guidance import Leg
from fakevehicle.params import ParameterSet
from fakevehicle.vocabulary import FloatArray, Glance, Setpoint

A = 3.0
"""Highest acceleration [m/s^2]."""
FRAME = Glance(0, 0.0, 0.0, -5.0, 0.0, 0.0, 0.0, 0.0, 0.5, True, True, True, True, 0)


def sampled(course: Course, seconds: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Positions, velocities and accelerations (n, 3) every 4 ms."""
    asked = [course.setpoint(4_000 * k) for k in range(round(seconds * 250))]
    return (
        np.array([s.position_n for s in asked]),
        np.array([s.velocity_n for s in asked]),
        np.array([s.acceleration_n for s in asked]),
    )


def test_a_right_angle_is_passed_without_a_jump_and_as_near_as_it_says() -> None:
    corner_n = np.array([20.0, 0.0, -5.0])
    course = Course(ParameterSet(PARAMETERS))
    course.stop(FRAME, moving=False)
    course.leg_to(0, corner_n)
    assert course.round_to(0, np.array([20.0, 20.0, -5.0]), None, 0.6) is not None
    place_n, velocity_n, acceleration_n = sampled(course, 0.1 - course.late_s(0))
    # THEN velocity is the place's derivative and never jumps by more than the acceleration there is
    np.testing.assert_allclose(np.diff(place_n, axis=0) / 0.004, 0.5 * (velocity_n[1:] + velocity_n[:-1]), atol=3e-3)
    assert np.linalg.norm(np.diff(velocity_n, axis=0), axis=1).max() <= A * 0.004 + 1e-9
    assert np.linalg.norm(acceleration_n, axis=1).max() <= A + 1e-9
    # AND the way is 0.6 m from the corner, at v / sqrt(2) with v^2 = 8 c A / k^2 and the bend k = sqrt(2)
    away = np.linalg.norm(place_n - corner_n, axis=1)
    assert away.min() == pytest.approx(0.6, abs=0.01)
    speed = np.linalg.norm(velocity_n, axis=1)
    assert speed[away.argmin()] == pytest.approx(math.sqrt(8 * 0.6 * A / 2) / math.sqrt(2), abs=0.01)
    assert speed.max() == pytest.approx(5.0)
    # AND it ends at rest where it should
    np.testing.assert_allclose(place_n[-1], [20.0, 20.0, -5.0])
    np.testing.assert_array_equal(velocity_n[-1], 0.0)


_metre = st.floats(-30.0, 30.0)
_point = st.tuples(_metre, _metre, st.floats(-30.0, -2.0)).map(np.array)


@settings(max_examples=150, deadline=None)
@given(
    here=_point,
    corner=_point,
    ahead=_point,
    speeds=st.tuples(st.floats(0.5, 8.0), st.floats(0.5, 8.0)),
    cut=st.floats(0.1, 5.0),
    share=st.floats(0.0, 0.9),
)
def test_any_corner_keeps_place_velocity_speed_and_acceleration(
    here: FloatArray, corner: FloatArray, ahead: FloatArray, speeds: tuple[float, float], cut: float, share: float
) -> None:
    leg = Leg(1_000, here, corner, speeds[0], A)
    now_us = leg.start_us + round(1e6 * share * leg.duration_s)
    found = rounded(leg, now_us, ahead, speeds[1], cut)
    if found is None:  # no room, or too slow to be worth it
        return
    (first, turn, last), told = found
    assert told is turn
    assert turn.start_us == pytest.approx(first.start_us + 1e6 * first.duration_s, abs=1)
    assert last.start_us == turn.end_us
    v = float(np.linalg.norm(turn.velocity_n))
    assert SLOWEST_PASS <= v <= min(speeds) + 1e-9
    # no jump where the pieces meet, nor where the leg was when it was decided
    for before, after, at_us in (
        (leg, first, first.start_us),
        (first, turn, turn.start_us),
        (turn, last, last.start_us),
    ):
        one, two = before.setpoint(at_us, 0.0), after.setpoint(at_us, 0.0)
        np.testing.assert_allclose(one.position_n, two.position_n, atol=2e-5)
        np.testing.assert_allclose(one.velocity_n, two.velocity_n, atol=1e-5)
    for piece in (first, last):
        assert piece.top <= piece.speed + 1e-9
        assert abs(piece.entry**2 - piece.leave**2) <= 2.0 * A * piece.length + 1e-6
    assert np.linalg.norm(turn.acceleration_n) <= A + 1e-9
    middle_n = turn.setpoint(turn.middle_us, 0.0).position_n
    assert math.dist(middle_n, corner) <= cut + 1e-5


def test_a_leg_with_speed_at_its_ends_is_its_own_derivative() -> None:
    leg = Leg(0, np.zeros(3), np.array([0.0, 12.0, 0.0]), 4.0, 2.0, 1.0, 3.0)
    h = 50
    for tau in np.linspace(0.05, 0.95, 37) * leg.duration_s:
        if min(abs(tau - (leg.top - 1.0) / 2.0), abs(tau - leg.level_s)) < 1e-3:
            continue  # acceleration steps here
        now_us = round(tau * 1e6)
        before, here, after = (leg.setpoint(now_us + k, 0.0) for k in (-h, 0, h))
        np.testing.assert_allclose(here.velocity_n, (after.position_n - before.position_n) / (2e-6 * h), atol=1e-5)
        np.testing.assert_allclose(here.acceleration_n, (after.velocity_n - before.velocity_n) / (2e-6 * h), atol=1e-5)
    assert leg.at(0)[1] == 1.0
    assert leg.at(10**8)[1] == pytest.approx(3.0)


@pytest.mark.parametrize("clockwise", [True, False])
def test_turns_go_round_their_centre_and_end_at_rest(clockwise: bool) -> None:
    centre_n, start_n = np.array([10.0, 5.0, -3.0]), np.array([10.0, 1.0, -6.0])
    way = circle(0, start_n, centre_n, 1.5, clockwise=clockwise, speed=2.0, most=A)
    asked = [way.setpoint(4_000 * k, 0.0) for k in range(round(way.duration_s * 250) + 2)]
    place_n = np.array([s.position_n for s in asked])
    velocity_n = np.array([s.velocity_n for s in asked])
    np.testing.assert_allclose(place_n[0], start_n, atol=1e-12)
    np.testing.assert_allclose(np.hypot(*(place_n - centre_n)[:, :2].T), 4.0, atol=1e-9)
    np.testing.assert_array_equal(place_n[:, 2], -6.0)
    np.testing.assert_allclose(np.diff(place_n, axis=0) / 0.004, 0.5 * (velocity_n[1:] + velocity_n[:-1]), atol=3e-3)
    assert np.linalg.norm([s.acceleration_n for s in asked], axis=1).max() <= A + 1e-9
    angle = np.unwrap(np.arctan2(place_n[:, 1] - 5.0, place_n[:, 0] - 10.0))
    assert angle[-1] - angle[0] == pytest.approx((1 if clockwise else -1) * 3.0 * math.pi)  # clockwise: north to east
    np.testing.assert_allclose(place_n[-1], [10.0, 9.0, -6.0], atol=1e-9)
    np.testing.assert_allclose(velocity_n[-1], 0.0, atol=1e-9)


def test_a_tight_circle_is_flown_no_faster_than_the_acceleration_allows() -> None:
    way = circle(0, np.zeros(3), np.array([0.5, 0.0, 0.0]), 3.0, clockwise=True, speed=5.0, most=A)
    assert way.along.top == pytest.approx(math.sqrt(0.8 * A * 0.5))


def test_the_nose_follows_what_it_looks_at_and_says_how_fast() -> None:
    course = Course(ParameterSet(PARAMETERS))
    course.stop(FRAME, moving=False)
    place_n = np.array([10.0, 8.0, -5.0])
    course.look_at(place_n)
    course.leg_to(0, np.array([20.0, 0.0, -5.0]))
    asked: list[Setpoint] = [course.setpoint(4_000 * k) for k in range(1, 1500)]
    yaw = np.unwrap([s.yaw for s in asked])
    rate = np.array([s.yaw_rate for s in asked])
    np.testing.assert_allclose(np.diff(yaw) / 0.004, rate[1:], atol=1e-6)
    assert np.degrees(np.abs(rate)).max() <= 60.0 + 1e-9
    for s in asked[300:]:  # it takes less than a second to get there
        north, east = (place_n - s.position_n)[:2]
        assert math.remainder(s.yaw - math.atan2(east, north), 2.0 * math.pi) == pytest.approx(0.0, abs=1e-6)
    # WHEN there is nothing to look at any more THEN the nose stays
    course.look_at(None)
    after = [course.setpoint(4_000 * k) for k in range(1500, 1510)]
    assert {s.yaw for s in after} == {asked[-1].yaw}
