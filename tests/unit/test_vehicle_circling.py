"""DO_ORBIT and DO_SET_ROI by command, told on the wire and flown by a point that follows its setpoint."""

import math

import numpy as np
import pytest
from flight_double import PointMass
from vehicle_pilot import ACCEPTED, DENIED, HOLD, NAN, REJECTED, Pilot

import fakevehicle.vehicle
from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

m = mavlink
LATITUDE, LONGITUDE = 47.397742, 8.545594
NORTH, EAST = 1.0 / 111_180.0, 1.0 / 75_500.0
"""A metre in degrees there, to a thousandth."""


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    """Of a vehicle that hovers 2.5 m up."""
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard", "gcs"),))))
    pilot.run(1.0)
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 10)
    return pilot


def point(pilot: Pilot) -> PointMass:
    stack = pilot.vehicle._stack
    assert isinstance(stack, PointMass)
    return stack


def about(pilot: Pilot, number: int, params: tuple[float, ...], north: float, east: float, up: float) -> int:
    """Send a command about a place, metres from home; its result. An orbit's height is above sea level in any frame."""
    up += 488.0 if number == 34 else 0.0
    x, y = round((LATITUDE + north * NORTH) * 1e7), round((LONGITUDE + east * EAST) * 1e7)
    pilot.send(m.MAVLink_command_int_message(1, 1, 6, number, 0, 0, *params, x, y, up))
    return Pilot.ack(pilot.tick(), number)


def off_nose(pilot: Pilot, north: float, east: float) -> float:
    """Angle between where the nose is wanted and a place [rad]."""
    bearing = math.atan2(east - point(pilot).p[1], north - point(pilot).p[0])
    return abs(math.remainder(point(pilot).setpoint.yaw - bearing, 2.0 * math.pi))


@pytest.mark.parametrize(("radius", "sense"), [(5.0, 1.0), (-5.0, -1.0)])
def test_an_orbit_goes_round_as_far_as_it_is_told_with_the_nose_to_its_centre(
    pilot: Pilot, radius: float, sense: float
) -> None:
    assert about(pilot, 34, (radius, 2.0, 0.0, 1.5 * math.pi), 10.0, 0.0, 6.0) == ACCEPTED
    pilot.until(lambda: math.dist(point(pilot).p, (5.0, 0.0, -6.0)) < 0.1, 20)
    bearings = [math.pi]
    for _ in range(200):
        pilot.run(0.1)
        north, east = (point(pilot).p[:2] - [10.0, 0.0]).tolist()
        assert math.hypot(north, east) == pytest.approx(5.0, abs=0.4)
        bearings.append(math.atan2(east, north))
        assert np.linalg.norm(point(pilot).setpoint.velocity_n) <= 2.0 + 1e-9
    assert np.unwrap(bearings)[-1] - math.pi == pytest.approx(sense * 1.5 * math.pi, abs=0.05)
    assert off_nose(pilot, 10.0, 0.0) < 0.1
    assert pilot.mode == HOLD
    assert np.linalg.norm(point(pilot).v) < 0.05


def test_an_orbit_without_numbers_goes_on_round_here_until_another_mode(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_command_int_message(1, 1, 6, 34, 0, 0, NAN, NAN, NAN, NAN, 2**31 - 1, 2**31 - 1, NAN))
    assert Pilot.ack(pilot.tick(), 34) == ACCEPTED
    pilot.run(120.0)
    assert math.hypot(*point(pilot).p[:2]) == pytest.approx(10.0, abs=0.8)
    assert np.linalg.norm(point(pilot).v) == pytest.approx(math.sqrt(0.8 * 3.0 * 10.0), abs=0.3)
    assert pilot.command(176, 1, 4, 3) == ACCEPTED
    pilot.run(5.0)
    assert np.linalg.norm(point(pilot).v) < 0.05


@pytest.mark.parametrize(
    ("params", "words"),
    [
        ((0.5, 1.0, 0.0, 0.0), "param1 is 0.5"),
        ((5000.0, 1.0, 0.0, 0.0), "param1 is 5000"),
        ((5.0, 100.0, 0.0, 0.0), "param2 is 100"),
        ((5.0, 1.0, 3.0, 0.0), "param3 is 3"),
        ((5.0, 1.0, 0.0, math.inf), "param4 is inf"),
    ],
)
def test_an_orbit_that_cannot_be_flown_is_denied_with_its_reason(
    pilot: Pilot, params: tuple[float, ...], words: str
) -> None:
    assert about(pilot, 34, params, 10.0, 0.0, 6.0) == DENIED
    assert words in pilot.texts()[-1]


def test_an_orbit_beyond_the_fence_or_from_the_ground_is_refused(pilot: Pilot) -> None:
    pilot.vehicle.parameters.set("GF_MAX_HOR_DIST", 12.0)
    assert about(pilot, 34, (5.0, 1.0, 0.0, 0.0), 10.0, 0.0, 6.0) == REJECTED
    assert "outside the fence" in pilot.texts()[-1]
    assert about(pilot, 34, (5.0, 1.0, 0.0, 0.0), 5.0, 0.0, 6.0) == ACCEPTED
    assert pilot.command(21, 0, 0, 0, 0, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: not pilot.armed, 30)
    assert about(pilot, 34, (5.0, 1.0, 0.0, 0.0), 5.0, 0.0, 6.0) == REJECTED
    assert "not flying" in pilot.texts()[-1]


@pytest.mark.parametrize(("number", "params"), [(195, (0.0, 0.0, 0.0, 0.0)), (201, (3.0, 0.0, 0.0, 0.0))])
def test_a_place_is_looked_at_until_it_is_taken_back(pilot: Pilot, number: int, params: tuple[float, ...]) -> None:
    assert about(pilot, number, params, -3.0, 8.0, 0.0) == ACCEPTED
    pilot.run(4.0)
    assert off_nose(pilot, -3.0, 8.0) < 0.02
    assert pilot.command(197) == ACCEPTED if number == 195 else pilot.command(201, 0) == ACCEPTED
    before = point(pilot).setpoint.yaw
    pilot.run(1.0)
    assert point(pilot).setpoint.yaw == before


def test_a_place_to_look_at_that_cannot_be_is_denied(pilot: Pilot) -> None:
    assert about(pilot, 201, (2.0, 0.0, 0.0, 0.0), 5.0, 5.0, 0.0) == DENIED
    assert "param1 is 2" in pilot.texts()[-1]
    assert pilot.command(195, 0, 0, 0, 0, 95.0, 8.0, 0.0) == DENIED
    assert "not on the globe" in pilot.texts()[-1]
    assert about(pilot, 195, (0.0, 0.0, 0.0, 0.0), 50_000.0, 0.0, 0.0) == DENIED
    assert "km away" in pilot.texts()[-1]
