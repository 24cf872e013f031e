"""GIVEN a mission that goes by what is seen, WHEN its sensor falls silent, THEN it stops, and touches nothing."""

import re
from pathlib import Path

import numpy as np
import pytest

from companion.phases import Phase
from companion.testing.flight import fly as fly_spec
from companion.testing.spec import FlightSpec
from companion.testing.wire import LinkFaults
from wire.dialect import mavlink

UNKNOWN = Path("missions/l_shape_unknown.yaml").read_text()
FLAVOURS = ("px4", "ardupilot")
ONE_FAST = ("px4", pytest.param("ardupilot", marks=pytest.mark.slow))
SILENT = "no scan from the obstacle sensor for 0.6 s"
SCANS = {
    number.to_bytes(3, "little")
    for number in (
        mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE,
        mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE_3D,
        mavlink.MAVLINK_MSG_ID_DISTANCE_SENSOR,
    )
}


class Unplugged:
    """A vehicle whose obstacle messages do not come, between two times [s]."""

    def __init__(self, vehicle, from_s, until_s=1e9):
        self.vehicle, self.TICK_US = vehicle, vehicle.TICK_US
        self.from_us, self.until_us = from_s * 1e6, until_s * 1e6

    @property
    def truth(self):
        return self.vehicle.truth

    def step(self, now_us, inputs):
        out = self.vehicle.step(now_us, inputs)
        silent = self.from_us < now_us < self.until_us
        return [d for d in out if not (silent and d.data[7:10] in SCANS)]


@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_a_sensor_that_falls_silent_in_flight_stops_the_vehicle_and_lands_it_and_nothing_is_touched(fly, autopilot):
    flight = fly(UNKNOWN, autopilot=autopilot, between=lambda v: Unplugged(v, 12.0))
    assert flight.companion.phase is Phase.DONE
    assert re.match(r"nothing seen for 30 s \(no scan", flight.companion.failure)
    assert flight.verdict.min_clearance_m > 0.0
    assert flight.notes.count(f"holding: {SILENT}") == 1


@pytest.mark.parametrize("autopilot", ONE_FAST)
def test_a_sensor_whose_last_round_is_told_again_and_again_is_silent_too(autopilot):
    result = fly_spec(FlightSpec(UNKNOWN.encode(), autopilot=autopilot, faults=("obstacle:off@12",)))
    assert result.phase == "done", result.story
    assert re.match(r"nothing seen for 30 s \(no scan", result.failure)
    assert result.min_clearance_m > 0.0


@pytest.mark.parametrize("autopilot", ONE_FAST)
def test_a_sensor_that_speaks_again_lets_the_mission_go_on(fly, autopilot):
    flight = fly(UNKNOWN, autopilot=autopilot, between=lambda v: Unplugged(v, 12.0, 18.0))
    assert flight.verdict.ok, flight.verdict.failure or flight.verdict.failed_expectations
    assert f"no longer holding: {SILENT}" in flight.notes


@pytest.mark.slow
@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_a_vehicle_without_an_obstacle_sensor_is_told_so_on_the_ground_and_not_flown(fly, autopilot):
    flight = fly(UNKNOWN, autopilot=autopilot, between=lambda v: Unplugged(v, 0.0), limit_s=140.0)
    assert flight.companion.phase is Phase.FAILED
    assert "no scan from the obstacle sensor yet" in flight.companion.failure
    assert flight.verdict.setpoint_rate_hz is None or np.isnan(flight.verdict.setpoint_rate_hz)


def test_a_sensor_that_falls_silent_on_the_ground_is_waited_for(fly):
    flight = fly(UNKNOWN, between=lambda v: Unplugged(v, 4.0, 10.0))
    assert flight.verdict.ok, flight.verdict.failure or flight.verdict.failed_expectations
    assert any(SILENT in note or "no scan from the obstacle sensor yet" in note for note in flight.notes)


@pytest.mark.slow
@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_a_link_that_loses_a_third_and_doubles_a_fifth_is_no_silent_sensor(autopilot):
    link = LinkFaults(loss=0.3, duplicate=0.2)
    result = fly_spec(FlightSpec(UNKNOWN.encode(), autopilot=autopilot, link=link))
    assert result.phase == "done", result.story
    assert not result.failure
    assert result.min_clearance_m > 0.0
