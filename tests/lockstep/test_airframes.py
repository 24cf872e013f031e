"""Every shipped airframe flies with the default gains, and every set of gains an X500; the estimator in the loop."""

import math
from importlib import resources
from typing import get_args

import numpy as np
import pytest

from fakevehicle.airframe import load_airframe
from fakevehicle.config import Gains, VehicleConfig
from fakevehicle.vehicle import Vehicle
from tests.vehicle_pilot import NAN, Pilot
from wire.dialect import mavlink

AIRFRAMES = sorted(f.name[:-5] for f in (resources.files("fakevehicle") / "airframes").iterdir())
LANDED = mavlink.MAV_LANDED_STATE_ON_GROUND


def test_three_airframes_are_shipped() -> None:
    assert AIRFRAMES == ["crazyflie", "iris", "x500"]


@pytest.mark.parametrize("name", AIRFRAMES)
def test_an_airframe_can_hover_with_thrust_to_spare_and_a_source_for_every_number(name: str) -> None:
    frame = load_airframe(name)
    assert 0.3 < (frame.hover_speed / frame.max_rotor_speed) ** 2 < 0.7
    assert all(len(text) > 5 for text in frame.source.values())


@pytest.mark.parametrize(
    ("name", "gains"), [*((name, "default") for name in AIRFRAMES), *(("x500", kind) for kind in get_args(Gains)[1:])]
)
def test_it_takes_off_hovers_and_lands(name: str, gains: Gains) -> None:
    vehicle = Vehicle(VehicleConfig(airframe=name, gains=gains, wind_n=np.array([1.0, 0.5, 0.0])))
    assert vehicle.parameters["FT_VXY_KT"] == pytest.approx({"default": 1.6, "tid": 8.5}.get(gains, 0.0))
    pilot = Pilot(vehicle)
    pilot.run(8.0)
    # WHEN it is armed and asked to take off
    assert pilot.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1) == mavlink.MAV_RESULT_ACCEPTED
    assert pilot.command(mavlink.MAV_CMD_NAV_TAKEOFF, *[NAN] * 7) == mavlink.MAV_RESULT_ACCEPTED
    pilot.run(8.0)
    # THEN it stands at the takeoff height and hardly moves
    start = vehicle.truth.position_n
    assert -start[2] == pytest.approx(2.5, abs=0.4)
    for _ in range(20):
        pilot.run(0.25)
        assert math.dist(vehicle.truth.position_n, start) < 0.4
        assert np.degrees(np.abs(vehicle.truth.omega_b).max()) < 20.0
    # WHEN it is asked to land THEN it comes down where it was and stops its motors
    assert pilot.command(mavlink.MAV_CMD_NAV_LAND, 0, 0, 0, 0, NAN, NAN, NAN) == mavlink.MAV_RESULT_ACCEPTED
    pilot.run(2.0)
    assert vehicle.truth.velocity_n[2] > 0.4
    pilot.until(lambda: not vehicle.flying.armed, 20)  # 7 s; the paper's loops take 12
    pilot.run(1.0)
    assert pilot.last("EXTENDED_SYS_STATE").landed_state == LANDED
    assert math.dist(vehicle.truth.position_n[:2], start[:2]) < 0.7
    assert vehicle.truth.rotor_speed.max() < 50.0
