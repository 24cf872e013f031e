"""The steps are walked by the clock, each from where the last one ended; climb and landing are checked beforehand."""

import numpy as np
import pytest

from companion.itinerary import SPOOL_UP_S, Itinerary
from companion.missionfile import parse_mission
from planner import Trajectory

MISSION = """\
name: steps
vehicle: {start: {north: 2, east: 2}, radius: 0.3}
world:
  bounds: {north: [0, 10], east: [0, 10], altitude: [0, 4]}
limits: {climb: 1, clearance: 0.2}
steps:
  - takeoff: {altitude: 2}
  - hold: {seconds: 1.5}
  - goto: {north: 8, east: 2, altitude: 2}
  - goto: {north: 8, east: 8, altitude: 1}
  - land
"""


def itinerary(text=MISSION):
    return Itinerary(parse_mission(text.encode(), "steps.yaml"), seed=5)


def straight(a, b, seconds):
    """A cubic spline from a to b, at rest at both ends."""
    points = np.array([a, a, a, b, b, b], dtype=float)
    return Trajectory(points, seconds * np.array([0, 0, 0, 0, 1 / 3, 2 / 3, 1, 1, 1, 1]))


def test_each_leg_is_wanted_from_where_the_step_before_ends_with_a_seed_of_its_own():
    first, second = itinerary().wanted()
    assert (first.start_m, first.goal_m, first.seed) == ((2, 2, -2), (8, 2, -2), 7)
    assert (second.start_m, second.goal_m, second.seed) == ((8, 2, -2), (8, 8, -1), 8)
    assert first.radius == pytest.approx(0.5)


def test_the_reference_is_continuous_over_every_step_and_ends_at_rest_above_the_landing():
    steps = itinerary()
    for wanted in steps.wanted():
        steps.take(wanted.request_id, straight(wanted.start_m, wanted.goal_m, 4.0))
    assert steps.planned()
    steps.begin(0)
    walked, kinds = [], []
    for now_us in range(0, 30_000_000, 20_000):
        if steps.advance(now_us):
            kinds.append(steps.step.kind)
        walked.append(steps.reference(now_us).position_m)
    assert kinds == ["hold", "goto", "goto", "land"]
    np.testing.assert_allclose(walked[0], (2, 2, 0))
    np.testing.assert_allclose(walked[-1], (8, 8, -1))
    assert np.linalg.norm(np.diff(walked, axis=0), axis=1).max() < 0.1
    moved = next(i for i, p in enumerate(walked) if abs(p[2]) > 1e-9)
    assert moved * 0.02 == pytest.approx(SPOOL_UP_S, abs=0.05)


def test_several_short_steps_within_one_tick_are_all_walked_through():
    steps = itinerary(MISSION.replace("1.5", "0"))
    for wanted in steps.wanted():
        steps.take(wanted.request_id, straight(wanted.start_m, wanted.goal_m, 0.001))
    steps.begin(0)
    assert steps.advance(20_000_000)
    assert steps.finished()


@pytest.mark.parametrize(
    ("obstacle", "words"),
    [
        ("box: {north: [1.7, 2.3], east: [1.7, 2.3], altitude: [1, 1.2]}", "the climb"),
        ("cylinder: {north: 2.7, east: 2, radius: 0.3, altitude: [0, 4]}", "the climb"),
        ("sphere: {north: 8, east: 8, altitude: 0.3, radius: 0.2}", "the landing"),
        ("sphere: {north: 8, east: 8.65, altitude: 0.3, radius: 0.2}", "the landing"),
    ],
)
def test_an_obstacle_in_or_beside_the_column_of_climb_or_landing_is_named_with_the_lack_of_room(obstacle, words):
    world = MISSION.replace("limits:", f"  obstacles:\n    - {obstacle}\nlimits:")
    reason = itinerary(world).obstruction()
    assert reason.startswith(words)
    assert "too near an obstacle (it keeps 0.5 m)" in reason


def test_a_climb_to_the_ceiling_is_refused_and_a_free_one_is_not():
    high = MISSION.replace("takeoff: {altitude: 2}", "takeoff: {altitude: 3.6}")
    assert "the climb at north 2, east 2, altitude 3.6 is 0.10 m too near the bounds" in itinerary(high).obstruction()
    assert itinerary().obstruction() == ""
    beside = "  obstacles:\n    - sphere: {north: 2, east: 2.75, altitude: 1, radius: 0.2}\nlimits:"
    assert itinerary(MISSION.replace("limits:", beside)).obstruction() == ""


def test_a_vehicle_found_outside_the_fence_is_told_so_rather_than_of_an_obstacle():
    fenced = MISSION.replace("steps:\n", "fence: {include: [{circle: {north: 6, east: 5, radius: 5.6}}]}\nsteps:\n")
    steps = itinerary(fenced)
    assert steps.obstruction() == ""
    steps.stand(np.array([0.0, 5.0, 0.0]))
    assert steps.obstruction() == "the climb at north 0, east 5, altitude 2 is 0.40 m outside the fence"
