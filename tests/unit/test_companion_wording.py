"""The planner speaks of x, y, z; people wrote north, east and altitude."""

import pytest

from companion.wording import in_mission_words
from planner import Box, Limits, PlannerError, World, plan

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
