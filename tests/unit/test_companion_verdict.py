"""The verdict's numbers against worked examples, and what makes a flight fail."""

import math
import tracemalloc

import numpy as np
import pytest

import companion.meter as meter_module
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


def long_flight(hours, hz=5, wild=2000):
    """A flight round and round a circle of 5 m, seconds apart more than usual; its errors grow and are known."""
    companion = Companion(MISSION, CompanionConfig())
    meter = FlightMeter(companion)
    mav = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    companion.step(0, [Datagram(VEHICLE_LINK, mavlink.MAVLink_heartbeat_message(2, 12, 0x81, 0, 4, 3).pack(mav), PEER)])
    companion.phase, companion.telemetry.armed = Phase.FLYING, True
    step_us, errors, held = 1_000_000 // hz, [], []
    for index in range(round(hours * 3600 * hz)):
        angle, now_us = 0.05 * index, index * step_us
        north, east = 5 * math.cos(angle) - 20, 5 * math.sin(angle)
        error = abs(math.sin(index)) * (3.0 if index == wild else 0.2)
        message = mavlink.MAVLink_local_position_ned_message(index % 2**32, north, east, -2.0 + error, 0, 0, 0)
        inputs = [(now_us, Datagram(VEHICLE_LINK, bytes(message.pack(mav)), PEER))]
        reference = Reference(np.array([north, east, -2.0]), np.zeros(3), np.zeros(3), 0.0)
        meter(Tick(index, now_us, inputs, [reference], now_us + (30_000 if index == wild else 0)))
        errors.append(error)
        if index % (3600 * hz) == 0:
            held.append(tracemalloc.get_traced_memory()[0])
    companion.phase = Phase.DONE
    return judge(companion, meter), np.array(errors), held


def test_ten_hours_in_the_air_are_measured_in_the_memory_of_minutes(monkeypatch):
    monkeypatch.setattr(meter_module, "MOST_ROWS", 3000)  # of ten hours at 1 Hz, not of 12 minutes at 50 Hz
    tracemalloc.start()
    try:
        verdict, errors, held = long_flight(10, hz=1)
    finally:
        tracemalloc.stop()
    own = 48 * len(errors)  # the test's own list
    assert held[-1] - held[2] < own  # what the meter keeps does not grow
    assert verdict.duration_s == pytest.approx(36_000, abs=1.1)
    for found, percent in ((verdict.tracking_error_p50_m, 50), (verdict.tracking_error_p95_m, 95)):
        assert found == pytest.approx(np.percentile(errors, percent), abs=0.001)
    assert verdict.tracking_error_max_m == pytest.approx(errors.max(), abs=1e-5)  # long gone, and not forgotten
    assert verdict.setpoint_gap_max_ms == pytest.approx(1030.0)
    assert verdict.setpoint_rate_hz == pytest.approx(1.0, abs=1e-4)
    # A chord of 0.05 rad is 0.25 m: each step is longer than the thinning, and counted.
    assert verdict.path_length_m == pytest.approx(10.0 * math.sin(0.025) * len(errors), rel=0.2)
    # The circle's nearest point to the pole's axis, less pole and hull.
    assert verdict.min_clearance_m == pytest.approx(math.hypot(23, 4) - 5 - 1.5, abs=0.01)


def test_a_flight_is_measured_alike_whether_its_beginning_is_still_kept_or_counted(monkeypatch):
    whole, _, _ = long_flight(0.3, hz=10)
    monkeypatch.setattr(meter_module, "MOST_ROWS", 3000)
    counted, errors, _ = long_flight(0.3, hz=10)
    assert len(errors) > 3 * 3000
    assert counted.tracking_error_p50_m == pytest.approx(whole.tracking_error_p50_m, abs=0.001)
    assert counted.tracking_error_p95_m == pytest.approx(whole.tracking_error_p95_m, abs=0.001)
    for name in ("tracking_error_max_m", "path_length_m", "min_clearance_m", "setpoint_gap_max_ms", "setpoint_rate_hz"):
        assert getattr(counted, name) == pytest.approx(getattr(whole, name), rel=1e-12)
    assert counted.setpoint_gap_p99_ms == pytest.approx(whole.setpoint_gap_p99_ms, abs=0.1)


def test_the_truth_is_placed_from_where_the_vehicle_stood_even_when_that_was_hours_ago(monkeypatch):
    monkeypatch.setattr(meter_module, "MOST_ROWS", 2000)
    companion = Companion(MISSION, CompanionConfig())
    meter, mav = FlightMeter(companion), mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    companion.step(0, [Datagram(VEHICLE_LINK, mavlink.MAVLink_heartbeat_message(2, 12, 0x81, 0, 4, 3).pack(mav), PEER)])
    companion.telemetry.armed = True
    for index in range(10_000):
        companion.phase = Phase.PLANNING if index < 100 else Phase.FLYING
        place = (473_977_418 + (0 if index < 100 else 90), 85_455_939, 488_000)  # 1.0009 m north of where it stood
        message = mavlink.MAVLink_hil_state_quaternion_message(
            index, (1, 0, 0, 0), 0, 0, 0, *place, 0, 0, 0, 0, 0, 0, 0, 0
        )
        inputs = [(index * 20_000, Datagram(VEHICLE_LINK, bytes(message.pack(mav)), PEER))]
        reference = Reference(np.zeros(3), np.zeros(3), np.zeros(3), 0.0)
        meter(Tick(index, index * 20_000, inputs, [reference], index * 20_000))
    verdict = judge(companion, meter)
    assert verdict.tracking_error_source == "truth"
    assert verdict.tracking_error_max_m == pytest.approx(1.0008, abs=2e-3)
    assert verdict.tracking_error_p50_m == pytest.approx(1.0008, abs=2e-3)


def test_hours_in_somebody_elses_hands_take_no_memory_and_leave_the_tracking_error_alone():
    companion = Companion(MISSION, CompanionConfig())
    meter, mav = FlightMeter(companion), mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    companion.step(0, [Datagram(VEHICLE_LINK, mavlink.MAVLink_heartbeat_message(2, 12, 0x81, 0, 4, 3).pack(mav), PEER)])
    companion.telemetry.armed = True
    for index in range(45_000):
        companion.phase = Phase.FLYING if index < 500 else Phase.HANDED_OVER
        message = mavlink.MAVLink_local_position_ned_message(index, 0.1 if index < 500 else 8.0, 0, -2, 0, 0, 0)
        inputs = [(index * 20_000, Datagram(VEHICLE_LINK, bytes(message.pack(mav)), PEER))]
        reference = [Reference(np.array([0.0, 0, -2]), np.zeros(3), np.zeros(3), 0.0)] if index < 500 else []
        meter(Tick(index, index * 20_000, inputs, reference, index * 20_000))
    verdict = judge(companion, meter)
    assert verdict.tracking_error_max_m == pytest.approx(0.1, abs=1e-5)
    assert verdict.min_clearance_m == pytest.approx(
        math.hypot(2.9, 4) - 1.5, abs=1e-3
    )  # of where it began, long dropped


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
