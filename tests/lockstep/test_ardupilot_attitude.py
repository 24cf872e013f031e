"""The ArduPilot flavour flies attitudes as ArduCopter does: half thrust keeps the height, more climbs, less sinks."""

import math

import pytest
from vehicle_pilot import Pilot

from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

_m = mavlink


@pytest.fixture(scope="module")
def pilot() -> Pilot:
    """Hovering in GUIDED at 10 m."""
    pilot = Pilot(Vehicle(VehicleConfig(autopilot="ardupilot", links=(LinkConfig("onboard", "onboard"),), seed=4)))
    pilot.run(8)
    for command, *params in ((176, 1, 4), (400, 1), (22, 0, 0, 0, 0, 0, 0, 10)):
        assert pilot.command(command, *params) == 0
    pilot.run(14)
    return pilot


def tilted(pitch_deg: float, thrust: float) -> _m.MAVLink_set_attitude_target_message:
    """Nose to the north, pitched; rates ignored."""
    half = math.radians(pitch_deg) / 2
    q = [math.cos(half), 0.0, math.sin(half), 0.0]
    return _m.MAVLink_set_attitude_target_message(0, 1, 1, 0b111, q, 0, 0, 0, thrust)


@pytest.mark.parametrize(
    ("pitch", "thrust", "climb"), [(0, 0.5, 0.0), (0, 0.75, 1.25), (0, 0.25, -0.75), (-10, 0.5, 0.0)]
)
def test_the_thrust_of_an_attitude_is_a_climb_rate(pilot: Pilot, pitch: float, thrust: float, climb: float) -> None:
    pilot.fly(2.0, tilted(pitch, thrust))
    before = pilot.vehicle.truth
    pilot.fly(1.0, tilted(pitch, thrust))
    after = pilot.vehicle.truth
    assert float(before.position_n[2] - after.position_n[2]) == pytest.approx(climb, abs=0.25)
    if pitch:
        assert float(after.velocity_n[0] - before.velocity_n[0]) > 0.8  # g tan(10 deg) less drag
    pilot.run(6)  # silence: GUID_TIMEOUT, then a stop
    assert float(abs(pilot.vehicle.truth.velocity_n).max()) < 0.3
    assert pilot.last("HEARTBEAT").custom_mode == 4
