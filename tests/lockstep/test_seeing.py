"""GIVEN obstacles that nobody told of, WHEN the mission is flown by what is seen, THEN nothing is touched."""

import math
from pathlib import Path

import numpy as np
import pytest

from benchmarks.bench_seeing import fly as fly_bench
from companion.cli.vehicle import LINK, build_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.lockstep import fly_lockstep
from companion.drivers.planning import InlinePlanning
from companion.drivers.recording import RecordingTap, header
from companion.drivers.rerun import rerun
from companion.missionfile import parse_mission
from companion.phases import Phase
from companion.seam import Note, Order, Reference, ReplanReady, ReplanWanted
from companion.verdict import FlightMeter, judge
from logs.reader import Recording
from logs.recorder import Recorder

UNKNOWN = Path("missions/l_shape_unknown.yaml").read_text()


def flown(autopilot, record=None, text=UNKNOWN, seed=1, orders=None):
    mission = parse_mission(text.encode(), "test.yaml")
    companion = Companion(mission, CompanionConfig(seed=seed))
    meter, ticks = FlightMeter(companion), []
    taps = [meter, ticks.append]
    recorder = None if record is None else Recorder(record, threaded=False, **header(companion, text.encode()))
    if recorder is not None:
        taps.append(RecordingTap(companion, recorder))
    vehicle, planning = build_vehicle(mission, seed, autopilot), InlinePlanning(mission.planner_world())
    operator = lambda now_us: (orders or {}).pop(now_us // 1_000_000, None)  # noqa: E731
    fly_lockstep(companion, vehicle, LINK, planning, taps, limit_s=120.0, operator=operator)
    if recorder is not None:
        recorder.close()
    return companion, judge(companion, meter), ticks


@pytest.fixture(scope="module")
def flight(tmp_path_factory):
    file = tmp_path_factory.mktemp("seen") / "flight.mcap"
    return *flown("px4", file), file


def test_a_wall_that_the_planner_does_not_know_is_flown_around(flight):
    companion, verdict, _, _ = flight
    assert verdict.ok, verdict.failure or verdict.failed_expectations
    assert companion.replanning.switches > 0
    assert companion.replanning.late == 0


def test_the_planner_was_never_told_of_it(flight):
    companion, _, _, _ = flight
    assert not companion.mission.planner_world().obstacles
    assert len(companion.mission.whole_world().obstacles) == 2


def test_no_reference_jumps_from_tick_to_tick(flight):
    _, _, ticks, _ = flight
    references = [o for tick in ticks for o in tick.outputs if isinstance(o, Reference)]
    places = np.array([r.position_m for r in references])
    speeds = np.array([r.velocity_m for r in references])
    pushes = np.array([r.acceleration_m for r in references])
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() <= 3.0 * 0.02 + 1e-6  # the speed limit, a tick long
    assert np.linalg.norm(np.diff(speeds, axis=0), axis=1).max() <= 6.0 * 0.02 + 1e-6
    assert np.linalg.norm(np.diff(pushes, axis=0), axis=1).max() <= 60.0 * 0.02 + 1e-6


def test_it_is_asked_ten_times_a_second_and_answered_before_the_switch(flight):
    _, _, ticks, _ = flight
    asked = {o.request_id: o for t in ticks for o in t.outputs if isinstance(o, ReplanWanted) and not o.cold}
    apart = np.diff([wanted.now_us for wanted in asked.values()])
    assert np.median(apart) == apart.max() == 100_000  # sooner when a plan from scratch is there and it rests
    for tick in ticks:
        for _, item in tick.inputs:
            if isinstance(item, ReplanReady) and item.request_id in asked:
                assert tick.now_us <= asked[item.request_id].switch_us


def test_a_rerun_of_the_sensed_flight_reproduces_every_output(flight):
    _, _, _, file = flight
    outcome = rerun(Recording.open(file))
    assert outcome.comparison.first is None
    assert outcome.comparison.equal == outcome.comparison.outputs


def test_ardupilot_asked_for_the_sensors_streams_flies_the_same_file():
    companion, verdict, _ = flown("ardupilot")
    assert verdict.ok, verdict.failure or verdict.failed_expectations
    assert companion.seeing.scans > 100


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow), pytest.param(2, marks=pytest.mark.slow)])
def test_a_wall_that_pops_up_six_metres_ahead_is_not_touched(seed):
    outcome = fly_bench(("pop-up", seed, "px4"))
    assert outcome.reached, outcome.failure
    assert outcome.clearance > 0.0


@pytest.mark.parametrize(
    "family", ["gap", pytest.param("U", marks=pytest.mark.slow), pytest.param("maze", marks=pytest.mark.slow)]
)
def test_an_unknown_world_is_crossed_without_touching_anything(family):
    outcome = fly_bench((family, 0, "px4"))
    assert outcome.reached, outcome.failure
    assert outcome.clearance > 0.0


@pytest.mark.slow
def test_a_place_ordered_in_flight_is_reached_round_what_is_seen_and_the_mission_goes_on_from_there():
    orders = {12: Order("goto", (17.0, 4.0, 1.5)), 24: Order("resume")}
    _, verdict, ticks = flown("px4", orders=orders)
    assert verdict.ok, verdict.failure or verdict.failed_expectations
    notes = [o.text for tick in ticks for o in tick.outputs if isinstance(o, Note)]
    assert "at north 17, east 4, altitude 1.5, holding until ordered on" in notes


@pytest.mark.soak
@pytest.mark.slow
def test_a_goal_that_is_walled_off_is_given_up_at_a_stop_and_landed():
    walled = UNKNOWN.replace("east: [6, 15], altitude: [0, 4]}, hidden", "east: [-1, 21], altitude: [0, 4]}, hidden")
    companion, verdict, ticks = flown("px4", text=walled)
    assert companion.phase is Phase.DONE
    assert companion.failure.startswith("no safe way for 30 s (NoPathFound")
    assert verdict.min_clearance_m > 0.0
    assert not math.isnan(verdict.duration_s)
    assert ticks
