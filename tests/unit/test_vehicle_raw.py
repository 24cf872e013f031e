"""The messages a client has to ask for, against the samples they are made of."""

import numpy as np
import pytest
from flight_double import PointMass
from vehicle_pilot import ACCEPTED, Pilot

import fakevehicle.vehicle
from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink as m


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard"),))))
    pilot.run(1.0)
    return pilot


def test_nobody_gets_them_unasked_and_whoever_asks_gets_them_at_the_asked_rate(pilot: Pilot) -> None:
    kinds = {"SCALED_IMU": 26, "RAW_IMU": 27, "SCALED_PRESSURE": 29, "ACTUATOR_OUTPUT_STATUS": 375}
    assert not [kind for kind in kinds if pilot.of(kind)]
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
