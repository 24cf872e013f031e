"""AVAILABLE_MODES of the PX4 flavour: all of them or one by its index, before the ACK."""

import math
from typing import Any

import pytest
from flight_double import PointMass
from vehicle_pilot import ACCEPTED, DENIED, Pilot

import fakevehicle.vehicle
from fakevehicle.config import VehicleConfig
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

_m = mavlink
REQUEST, MODES = _m.MAV_CMD_REQUEST_MESSAGE, _m.MAVLINK_MSG_ID_AVAILABLE_MODES


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = Pilot(Vehicle(VehicleConfig()))
    pilot.run(1.1)
    return pilot


def listed(pilot: Pilot) -> list[Any]:
    return pilot.of("AVAILABLE_MODES")


def test_index_zero_lists_every_mode_and_each_can_be_asked_for(pilot: Pilot) -> None:
    assert pilot.command(REQUEST, MODES, 0) == ACCEPTED
    every = listed(pilot)
    assert [m.mode_index for m in every] == list(range(1, len(every) + 1))
    assert {m.number_modes for m in every} == {len(every)}
    names = {m.mode_name: m.custom_mode for m in every}
    assert names["Hold"] == 4 << 16 | 3 << 24
    assert names["Offboard"] == 6 << 16
    assert {m.mode_name: m.standard_mode for m in every}["Land"] == _m.MAV_STANDARD_MODE_LAND
    assert pilot.command(REQUEST, MODES, 3) == ACCEPTED
    assert listed(pilot)[-1].mode_index == 3


@pytest.mark.parametrize("index", [-1, 0.5, 99, math.inf])
def test_an_index_that_is_none_is_denied(pilot: Pilot, index: float) -> None:
    assert pilot.command(REQUEST, MODES, index) == DENIED
    assert listed(pilot) == []


def test_the_place_that_is_flown_to_is_told_in_degrees_and_above_sea_level(pilot: Pilot) -> None:
    target = _m.MAVLINK_MSG_ID_POSITION_TARGET_GLOBAL_INT
    assert pilot.command(REQUEST, target) != ACCEPTED  # nothing is flown to yet
    assert pilot.command(_m.MAV_CMD_COMPONENT_ARM_DISARM, 1) == ACCEPTED
    assert pilot.command(_m.MAV_CMD_NAV_TAKEOFF) == ACCEPTED
    pilot.run(8)
    assert pilot.command(REQUEST, target) == ACCEPTED
    told = pilot.last("POSITION_TARGET_GLOBAL_INT")
    assert (told.lat_int, told.lon_int) == (473977420, 85455940)
    assert told.alt == pytest.approx(488.0 + 2.5, abs=0.01)  # MIS_TAKEOFF_ALT


def test_no_other_message_is_asked_for_by_an_index(pilot: Pilot) -> None:
    assert pilot.command(REQUEST, _m.MAVLINK_MSG_ID_AUTOPILOT_VERSION, 1) == DENIED
    assert pilot.command(REQUEST, _m.MAVLINK_MSG_ID_AVAILABLE_MODES_MONITOR) == ACCEPTED
