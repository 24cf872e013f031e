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


def test_no_other_message_is_asked_for_by_an_index(pilot: Pilot) -> None:
    assert pilot.command(REQUEST, _m.MAVLINK_MSG_ID_AUTOPILOT_VERSION, 1) == DENIED
    assert pilot.command(REQUEST, _m.MAVLINK_MSG_ID_AVAILABLE_MODES_MONITOR) == ACCEPTED
