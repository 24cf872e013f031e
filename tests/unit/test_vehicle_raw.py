"""The messages a client has to ask for, against the samples they are made of."""

import numpy as np
import pytest
from flight_double import PointMass
from vehicle_pilot import ACCEPTED, Pilot

import fakevehicle.vehicle
from fakevehicle.airframe import load_airframe
from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle
from fakevehicle.vocabulary import ControlStatus, Setpoint, Wind
from wire.dialect import mavlink as m


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard"),))))
    pilot.run(1.0)
    return pilot


def test_pressure_comes_by_itself_and_the_rest_at_the_rate_it_is_asked_for(pilot: Pilot) -> None:
    kinds = {
        "SCALED_IMU": 26,
        "RAW_IMU": 27,
        "SCALED_PRESSURE": 29,
        "ACTUATOR_CONTROL_TARGET": 140,
        "ACTUATOR_OUTPUT_STATUS": 375,
    }
    assert [kind for kind in kinds if pilot.of(kind)] == ["SCALED_PRESSURE"]
    for number in kinds.values():
        assert pilot.command(511, number, 100_000) == ACCEPTED
    pilot.heard.clear()
    pilot.run(2.0)
    assert {kind: len(pilot.of(kind)) for kind in kinds} == dict.fromkeys(kinds, 20)


def test_the_imu_is_told_in_thousandths(pilot: Pilot) -> None:
    for number in (26, 27, 105):
        assert pilot.command(512, number) == ACCEPTED
    fine, scaled, raw = (pilot.last(kind) for kind in ("HIGHRES_IMU", "SCALED_IMU", "RAW_IMU"))
    for axis in "xyz":
        assert getattr(scaled, f"{axis}acc") == pytest.approx(getattr(fine, f"{axis}acc") / 9.80665e-3, abs=0.51)
        assert getattr(scaled, f"{axis}gyro") == pytest.approx(getattr(fine, f"{axis}gyro") * 1e3, abs=0.51)
        assert getattr(scaled, f"{axis}mag") == pytest.approx(getattr(fine, f"{axis}mag") * 1e3, abs=0.51)
        assert getattr(scaled, f"{axis}acc") == getattr(raw, f"{axis}acc")
    assert scaled.zacc == pytest.approx(-1000, abs=20)


def test_motors_are_told_as_zero_until_they_are_armed(pilot: Pilot) -> None:
    assert pilot.command(512, m.MAVLINK_MSG_ID_ACTUATOR_OUTPUT_STATUS) == ACCEPTED
    told = pilot.last("ACTUATOR_OUTPUT_STATUS")
    assert (told.active, list(told.actuator)) == (4, [0.0] * 32)
    assert pilot.command(400, 1) == ACCEPTED
    pilot.run(0.1)
    assert pilot.command(512, m.MAVLINK_MSG_ID_ACTUATOR_OUTPUT_STATUS) == ACCEPTED
    motors = pilot.vehicle._stack.control.motor
    np.testing.assert_allclose(pilot.last("ACTUATOR_OUTPUT_STATUS").actuator[:4], motors, atol=1e-6)


@pytest.mark.parametrize(
    ("speeds", "controls"),
    [
        ((1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0)),
        ((0.0, 1.0, 1.0, 0.0), (1.0, 0.0, 0.0, 0.5)),  # the left ones lift: it rolls to the right
        ((1.0, 0.0, 1.0, 0.0), (0.0, 1.0, 0.0, 0.5)),  # the front ones lift: the nose goes up
        ((1.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.5)),  # those that turn anticlockwise turn it clockwise
        ((0.5, 0.5, 0.5, 0.5), (0.0, 0.0, 0.0, 0.25)),
    ],
)
def test_controls_are_what_the_motors_come_to(
    pilot: Pilot, speeds: tuple[float, ...], controls: tuple[float, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Motors in the order front right, rear left, front left, rear right."""
    status = ControlStatus(Setpoint(), np.array([1.0, 0, 0, 0]), np.zeros(3), 0.5, np.array(speeds), False)
    assert pilot.command(400, 1) == ACCEPTED
    monkeypatch.setattr(PointMass, "control", status)
    assert pilot.command(512, m.MAVLINK_MSG_ID_ACTUATOR_CONTROL_TARGET) == ACCEPTED
    told = pilot.last("ACTUATOR_CONTROL_TARGET")
    assert told.group_mlx == 0
    np.testing.assert_allclose(told.controls, [*controls, 0, 0, 0, 0], atol=1e-6)


@pytest.mark.parametrize("airframe", ["x500", "iris", "crazyflie"])
def test_controls_have_the_signs_of_the_torques(airframe: str) -> None:
    """Rows of an airframe's mix are motors, its columns roll, pitch, yaw, thrust."""
    mix = load_airframe(airframe).record()["mix"][0]
    signs = [[-1, 1, 1, 1], [1, -1, 1, 1], [1, 1, -1, 1], [-1, -1, -1, 1]]
    np.testing.assert_array_equal(np.sign(mix), signs)


def test_the_wind_is_told_once_it_is_known(pilot: Pilot) -> None:
    assert pilot.command(512, m.MAVLINK_MSG_ID_WIND_COV) == m.MAV_RESULT_TEMPORARILY_REJECTED
    assert not pilot.of("WIND_COV")
    pilot.vehicle._stack.wind = Wind(3.0, -4.0, 1.5, 0.5)
    pilot.heard.clear()
    pilot.run(1.0)
    assert len(pilot.of("WIND_COV")) == 10
    told = pilot.last("WIND_COV")
    assert (told.wind_x, told.wind_y, told.var_horiz, told.horiz_accuracy) == (3.0, -4.0, 1.5, 0.5)
    assert told.wind_alt == pytest.approx(488.0, abs=0.1)
    assert np.isnan([told.wind_z, told.var_vert, told.vert_accuracy]).all()
