"""Legs, descents and setpoints: identities, and derivatives taken numerically."""

import math

import numpy as np
import pytest

from fakevehicle.guidance import (
    Leg,
    asks_to_climb,
    completed,
    landing_speed,
    return_height,
    stopping_point,
)
from fakevehicle.vocabulary import Setpoint


def leg(length: float) -> Leg:
    direction = np.array([1.0, 2.0, -2.0]) / 3.0
    return Leg(1_000_000, np.array([1.0, 2.0, 3.0]), np.array([1.0, 2.0, 3.0]) + length * direction, 3.0, 2.0)


@pytest.mark.parametrize("length", [0.0, 0.5, 4.5, 40.0])
def test_a_leg_begins_and_ends_at_rest_at_its_ends(length: float) -> None:
    path = leg(length)
    end_us = path.start_us + math.ceil(path.duration_s * 1e6)
    for now_us, point in ((0, path.start_n), (path.start_us, path.start_n), (end_us, path.end_n), (10**9, path.end_n)):
        setpoint = path.setpoint(now_us, 0.3)
        np.testing.assert_allclose(setpoint.position_n, point, atol=1e-9)
        np.testing.assert_allclose(setpoint.velocity_n, 0.0, atol=1e-5)
        assert setpoint.yaw == 0.3


@pytest.mark.parametrize("length", [0.5, 4.5, 40.0])
def test_velocity_and_acceleration_of_a_leg_are_derivatives_of_its_position(length: float) -> None:
    path = leg(length)
    h = 100
    corners = (path.speed / path.acceleration, length / path.speed)
    for share in np.linspace(0.05, 0.95, 41):
        tau = share * path.duration_s
        if min(abs(tau - c) for c in corners) < 1e-3 or abs(share - 0.5) < 1e-3:
            continue  # acceleration steps here
        now_us = path.start_us + round(tau * 1e6)
        before, here, after = (path.setpoint(now_us + k, 0.0) for k in (-h, 0, h))
        slope = (after.position_n - before.position_n) / (2e-6 * h)
        np.testing.assert_allclose(here.velocity_n, slope, atol=1e-6)
        slope = (after.velocity_n - before.velocity_n) / (2e-6 * h)
        np.testing.assert_allclose(here.acceleration_n, slope, atol=1e-6)
        assert np.linalg.norm(here.velocity_n) <= path.speed + 1e-12


def test_the_stopping_point_is_where_constant_braking_ends() -> None:
    p, v, a = np.array([1.0, -2.0, 3.0]), np.array([3.0, 4.0, 0.0]), 2.5
    t = 5.0 / a  # |v| / a
    np.testing.assert_allclose(stopping_point(p, v, a), p + v * t - 0.5 * a * (v / 5.0) * t**2)


def test_a_landing_slows_down_between_ten_and_five_metres() -> None:
    assert landing_speed(20.0, 0.7, 1.5) == 1.5
    assert landing_speed(7.5, 0.7, 1.5) == pytest.approx(1.1)
    assert landing_speed(1.0, 0.7, 1.5) == pytest.approx(0.7)


def test_a_return_climbs_no_more_than_it_is_away_and_never_sinks() -> None:
    assert return_height(5.0, 2.0, 30.0) == 5.0
    assert return_height(5.0, 20.0, 30.0) == 20.0
    assert return_height(5.0, 200.0, 30.0) == 30.0
    assert return_height(50.0, 200.0, 30.0) == 50.0


def test_an_axis_nobody_asked_for_stands_still() -> None:
    asked = Setpoint(position_n=np.array([1.0, np.nan, np.nan]), velocity_n=np.array([np.nan, np.nan, 0.5]))
    done = completed(asked)
    np.testing.assert_array_equal(done.velocity_n, [np.nan, 0.0, 0.5])
    np.testing.assert_array_equal(done.position_n, asked.position_n)


def test_a_standing_vehicle_climbs_only_when_asked_to() -> None:
    at = np.array
    assert asks_to_climb(Setpoint(position_n=at([0, 0, -1.0])), 0.0)
    assert not asks_to_climb(Setpoint(position_n=at([0, 0, -0.05])), 0.0)
    assert asks_to_climb(Setpoint(velocity_n=at([0, 0, -0.5])), 0.0)
    assert not asks_to_climb(Setpoint(velocity_n=at([1.0, 0, 0.0])), 0.0)
    assert not asks_to_climb(Setpoint(acceleration_n=at([1.0, 0, np.nan])), 0.0)
