"""Missions as tests: ten ways to ask whether a flight holds. Read from the top; each adds one thing.

    pytest missions                     all of them
    companion test missions             the mission files alone, each against what it expects of itself

The flights are in memory and without a clock: the same every time, some twenty times as fast as real. When a test
fails, its recording is under recordings/failed, and the report tells what the companion said.
"""

import math

import pytest

from companion.seam import Order


@pytest.mark.mission("l_shape.yaml")
def test_a_mission_holds_what_its_file_expects(flight):
    result = flight.fly()
    assert result.ok, result.cause  # `cause` is the first thing that went wrong, in words


@pytest.mark.mission("hop.yaml")
@pytest.mark.autopilot("px4", "ardupilot")
def test_the_same_file_is_flown_by_both_autopilots(flight):
    result = flight.fly()
    assert result.ok, result.cause
    assert result.phase == "done"


@pytest.mark.mission("hop.yaml")
@pytest.mark.seeds(1, 2, 3)
def test_three_seeds_keep_to_the_reference(flight):
    # A seed is other sensor noise and other dice for the planner. Errors are against the truth of the simulation.
    verdict = flight.fly().verdict
    assert verdict.tracking_error_p95_m < 0.25
    assert verdict.min_clearance_m > 0.1


@pytest.mark.mission("hop.yaml")
@pytest.mark.wind(north=5, east=2, gust=4, at=12)
def test_wind_and_a_gust_cost_less_than_half_a_metre(flight):
    result = flight.fly()
    assert result.phase == "done", result.cause
    assert result.verdict.tracking_error_max_m < 0.5


@pytest.mark.mission("hop.yaml")
@pytest.mark.fault("baro:bias=10@13")
def test_a_barometer_that_jumps_is_noticed_first_in_the_height(flight):
    # `innovation` is the first measurement that the estimator refused: what to look for when a flight went wrong.
    assert flight.fly().innovation.startswith("height")


@pytest.mark.mission("hop.yaml")
@pytest.mark.link(loss=0.3, duplicate=0.2, jitter_ms=100)
def test_a_third_of_all_packets_may_be_lost(flight):
    result = flight.fly()
    assert result.phase == "done", result.cause


@pytest.mark.mission("popup_wall.yaml")
def test_a_wall_that_appears_is_not_touched(flight):
    result = flight.fly()
    assert result.min_clearance_m > 0.0, result.cause


@pytest.mark.mission("hop.yaml")
def test_a_person_who_asks_to_land_gets_a_landing(flight, companion):
    def orders(now_us):
        return Order("land") if companion.phase.value == "flying" and now_us > 14_000_000 else None

    result = flight.fly(orders)
    assert result.said("land")
    assert not companion.telemetry.armed


@pytest.mark.mission("hop.yaml")
def test_it_lands_where_it_was_told_to(flight, vehicle, mission):
    # `vehicle` is the simulator: what it knows of itself is the truth, from where it stood at the start.
    flight.fly()
    landed = vehicle.truth.position_n + mission.start_m()
    goal = mission.steps[1].goto.ned()
    assert math.dist(landed[:2], goal[:2]) < 0.5


@pytest.mark.mission("l_shape.yaml")
def test_where_the_vehicle_flies_is_looked_at_by_a_tap(flight, mission, companion):
    # A tap is called once a tick with everything that went in and out; here it keeps the place and the step.
    places = {}

    def tap(tick):
        if companion.phase.value == "flying":
            places[companion.itinerary.step.kind] = companion.telemetry.position_n - companion.origin_n

    flight.fly(taps=[tap])
    goal = mission.steps[2].goto.ned()
    assert abs(places["goto"] - goal).max() < 0.3
