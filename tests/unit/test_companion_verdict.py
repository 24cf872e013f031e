"""The verdict's numbers against worked examples, and what makes a flight fail."""

import numpy as np
import pytest

from companion.core import Companion, CompanionConfig
from companion.drivers.tick import Tick
from companion.missionfile import parse_mission
from companion.phases import Phase
from companion.seam import Reference
from companion.vehiclelink import VEHICLE_LINK
from companion.verdict import FlightMeter, failed_expectations, judge, least_clearance
from wire.datagram import Datagram
from wire.dialect import mavlink

MISSION = parse_mission(
    b"""
name: one pole
vehicle: {start: {north: 0, east: 0}, radius: 0.5}
world:
  bounds: {north: [-50, 50], east: [-50, 50], altitude: [0, 10]}
  obstacles:
    - cylinder: {north: 3, east: 4, radius: 1, altitude: [0, 10]}
steps:
  - takeoff: {altitude: 2}
  - goto: {north: 10, east: 0, altitude: 2}
  - land
expect: {tracking_error_p95_m: 0.35, min_clearance_m: 1.0, duration_max_s: 20}
""",
    "one pole",
)
PEER = ("127.0.0.1", 1)


def fly(offset_n, sideways, clock_s=10.0, broken=()):
    """A flight straight north at 1 m/s, the vehicle always `sideways` metres east of its reference."""
    companion = Companion(MISSION, CompanionConfig())
    meter = FlightMeter(companion)
    mav = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    companion.step(0, [Datagram(VEHICLE_LINK, mavlink.MAVLink_heartbeat_message(2, 12, 0x81, 0, 4, 3).pack(mav), PEER)])
    companion.origin_n = np.array(offset_n)
    companion.phase = Phase.FLYING
    companion.telemetry.armed = True
    for index in range(int(clock_s * 50) + 1):
        t = index / 50
        p = np.array([t, sideways, -2.0]) + offset_n
        x = float("nan") if index in broken else p[0]
        message = mavlink.MAVLink_local_position_ned_message(index * 20, x, p[1], p[2], 1, 0, 0)
        inputs = [(index * 20_000, Datagram(VEHICLE_LINK, bytes(message.pack(mav)), PEER))]
        reference = Reference(np.array([t, 0.0, -2.0]), np.array([1.0, 0, 0]), np.zeros(3), 0.0)
        meter(Tick(index, index * 20_000, inputs, [reference], index * 20_000))
    companion.phase = Phase.DONE
    return judge(companion, meter)


def test_a_constant_offset_is_the_tracking_error_whatever_the_local_origin():
    verdict = fly((100.0, -20.0, 3.0), 0.25)
    assert verdict.tracking_error_source == "estimate"
    for value in (verdict.tracking_error_p50_m, verdict.tracking_error_p95_m, verdict.tracking_error_max_m):
        assert value == pytest.approx(0.25, abs=1e-4)
    assert verdict.path_length_m == pytest.approx(10.0, abs=0.02)
    assert verdict.setpoint_rate_hz == pytest.approx(50.0)
    assert verdict.setpoint_gap_max_ms == pytest.approx(20.0)
    assert verdict.ok


def test_the_clearance_is_the_distance_to_the_poles_wall_less_the_hull():
    # Passing the pole's axis at 4 - 0.25 m east: 3.75 - 1 (pole) - 0.5 (hull).
    assert fly((0.0, 0.0, 0.0), 0.25).min_clearance_m == pytest.approx(2.25, abs=1e-3)
    assert least_clearance(MISSION, np.array([[3.0, 4.0, -1.0]])) == pytest.approx(-1.5)


def test_a_hull_inside_an_obstacle_fails_whatever_the_mission_expects():
    verdict = fly((0.0, 0.0, 0.0), 3.0)
    assert not verdict.ok
    assert "the hull was 0.500 m inside an obstacle" in verdict.failed_expectations


def test_samples_that_are_no_numbers_are_left_out():
    assert fly((0.0, 0.0, 0.0), 0.25, broken=range(50, 60)).tracking_error_max_m == pytest.approx(0.25, abs=1e-4)


def test_each_expectation_that_is_not_met_is_named_with_what_was_found():
    numbers = {"tracking_error_p95_m": 0.4, "min_clearance_m": None, "duration_max_s": 19.0}
    assert failed_expectations(MISSION, numbers) == [
        "tracking_error_p95_m: found 0.400, expected at most 0.35",
        "min_clearance_m: not measured, expected at least 1",
    ]
