"""The planner speaks of x, y, z; people wrote north, east and altitude."""

import inspect
import math

import pytest

from companion import wording
from companion.wording import in_mission_words
from planner import (
    BlockedByMovers,
    Box,
    GoalInCollision,
    InfeasibleLimits,
    Limits,
    NoPathFound,
    NoTimingFound,
    PlannerError,
    StartInCollision,
    StateBeyondLimits,
    World,
    plan,
)

WORLD = World(bounds=((0, 0, -4), (10, 10, 0)), obstacles=[Box((4, 4, -3), (6, 6, 0))])


def refusal(start, goal):
    with pytest.raises(PlannerError) as caught:
        plan(WORLD, start, goal, Limits(3, 6, 60), 0.5)
    return in_mission_words(caught.value)


@pytest.mark.parametrize(
    ("start", "goal", "words"),
    [
        ((1, 1, -2), (5, 5, -2), "the goal at north 5, east 5, altitude 2 is 1.00 m inside obstacle 0 (box)"),
        ((3.7, 5, -2), (1, 1, -2), "the start at north 3.7, east 5, altitude 2 is 0.30 m from obstacle 0 (box)"),
        ((1, 1, -2), (12, 5, -2), "the goal at north 12, east 5, altitude 2 is 2.00 m beyond the upper north bound 10"),
        ((1, 1, -2), (1, 5, -4.5), "altitude 4.5 is 0.50 m beyond the upper altitude bound 4"),
        ((1, 1, -0.2), (1, 5, -2), "altitude 0.2 is 0.20 m inside the lower altitude bound"),
    ],
)
def test_a_bad_end_is_told_in_the_mission_files_words_with_what_is_missing(start, goal, words):
    text = refusal(start, goal)
    assert words in text
    assert "more are needed to keep 0.5 m" in text


def test_a_bad_via_point_is_told_in_the_same_words_with_its_number():
    with pytest.raises(PlannerError) as caught:
        plan(WORLD, (1, 1, -2), (9, 9, -2), Limits(3, 6, 60), 0.5, via=[(1, 9, -2), (5, 5, -2)])
    assert "the via point 1 at north 5, east 5, altitude 2 is 1.00 m inside obstacle 0 (box)" in in_mission_words(
        caught.value
    )


def test_what_is_missing_is_never_told_as_nothing():
    assert "0.74970 m from obstacle 3 (box); 0.00030 m more are needed" in in_mission_words(
        StartInCollision((1.0, 2.0, -3.0), 3, "box", 0.7497, 0.75)
    )
    told = in_mission_words(GoalInCollision((1.0, 2.0, 0.0), 3, "box", 0.75, 0.75, 1e-9))
    assert "altitude 0 is" in told
    assert "that keeps 0.75 m, but 1e-09 m more are needed to prove it" in told


def test_no_way_names_the_keys_that_make_the_radius_and_whether_it_is_proved():
    told = in_mission_words(NoPathFound(0, 10, 0.0, 0.75, math.inf, 0.1, proved=True))
    assert told.startswith("no path found")
    assert "proved that there is none" in told
    assert "0.75 m (vehicle.radius + limits.clearance)" in told
    told = in_mission_words(NoPathFound(0, 10, 0.0, 0.75, math.inf, 0.1))
    assert "no way is seen on cells of 0.1 m; that is no proof" in told
    told = in_mission_words(NoPathFound(6, 10, 0.03, 0.75, 12.34, 0.1))
    assert "the best of 6 curves lacks 0.03 m; a way of 12.3 m is seen on cells of 0.1 m" in told
    assert "proved that there is none" not in told


def test_what_moves_is_named_with_its_time():
    told = in_mission_words(BlockedByMovers(4, 100, 2, 1.26, 0.75))
    assert "4 curves keep 0.75 m (vehicle.radius + limits.clearance)" in told
    assert "moving obstacle 2 is in the way after 1.3 s" in told


def test_a_motion_that_cannot_be_flown_is_told_with_the_keys_of_its_limits():
    told = in_mission_words(NoTimingFound(1, 100, 2.5, 0.0, 0.75))
    assert "1 curve keeps 0.75 m" in told
    assert "from 2.5 m/s and 0 m/s² at the start" in told
    assert "limits.speed, limits.acceleration and limits.jerk" in told
    told = in_mission_words(StateBeyondLimits("start_velocity", 4.0, 3.0))
    assert told == "the velocity at the start is 4 m/s, 1 m/s beyond limits.speed of 3 m/s"
    told = in_mission_words(StateBeyondLimits("start_acceleration", 7.0, 6.0))
    assert told == "the acceleration at the start is 7 m/s², 1 m/s² beyond limits.acceleration of 6 m/s²"
    with pytest.raises(InfeasibleLimits) as caught:
        Limits(-1, 6, 60)
    assert in_mission_words(caught.value).startswith("limits.speed: found -1, expected 1e-06 to ")


def test_every_kind_of_refusal_is_worded_and_only_those_without_axes_are_left_as_they_are():
    def kinds(kind):
        return {kind}.union(*(kinds(k) for k in kind.__subclasses__()))

    own = {kind for kind in kinds(PlannerError) if not kind.__name__.startswith("_")}
    source = inspect.getsource(wording)
    unworded = {kind.__name__ for kind in own if f"{kind.__name__}()" not in source}
    assert unworded == {"PlannerError", "EndpointError", "KnotError", "WorldFileError"}
