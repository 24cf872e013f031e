"""One number tells how far inside a fence a place is, and the solids made of it leave exactly the inside free."""

import math

import numpy as np
import pytest

from companion.errors import MissionError
from companion.geofence import FenceModel, Geofence
from companion.missionfile import parse_mission
from planner import World

BOUNDS = ((-5.0, -5.0, -6.0), (15.0, 15.0, 0.0))
NOTCHED = ((0, 0), (10, 1), (4, 4), (9, 9), (1, 8), (3, 5))


@pytest.mark.parametrize(
    "outline", [((0, 0), (10, 0), (10, 10), (0, 10)), NOTCHED, NOTCHED[::-1], NOTCHED[2:] + NOTCHED[:2]]
)
def test_the_solids_of_an_area_to_stay_in_fill_exactly_what_is_outside_it(outline):
    fence = Geofence(include=(tuple(outline),))
    world = World(bounds=BOUNDS, obstacles=fence.solids(BOUNDS))
    points = np.random.default_rng(3).uniform(*BOUNDS, (3000, 3))
    inside = np.array([fence.inside(p) for p in points])
    solid = world.distance(points)
    assert (inside > 0).any()
    assert (inside < 0).any()
    np.testing.assert_allclose(solid[inside > 0], inside[inside > 0], atol=1e-9)
    assert (solid[inside < 0] <= 1e-9).all()


def test_a_square_is_measured_by_hand_from_within_and_from_beyond():
    fence = Geofence(include=(((0, 0), (10, 0), (10, 10), (0, 10)),), ceiling=5.0)
    assert fence.inside((5, 3, -1)) == pytest.approx(3.0)
    assert fence.inside((5, 5, -4.5)) == pytest.approx(0.5)
    assert fence.inside((5, 5, -7)) == pytest.approx(-2.0)
    assert fence.inside((13, 14, -1)) == pytest.approx(-5.0)  # 3, 4, 5 from the corner


def test_areas_to_stay_out_of_count_from_their_outline_and_the_nearest_says():
    fence = Geofence(exclude=(((0, 0), (2, 0), (2, 2), (0, 2)),), circles=((10.0, 0.0, 3.0),))
    assert fence.inside((-1, 1, -1)) == pytest.approx(1.0)
    assert fence.inside((1, 1, -1)) == pytest.approx(-1.0)
    assert fence.inside((6, 0, -1)) == pytest.approx(1.0)
    assert fence.inside((10, 1, -1)) == pytest.approx(-2.0)
    assert Geofence().inside((1e5, 1e5, -1e5)) == math.inf


def test_a_circle_to_stay_in_is_never_larger_than_it_says_and_hardly_smaller():
    fence = FenceModel.model_validate(
        {"include": [{"circle": {"north": 3.0, "east": 4.0, "radius": 100.0}}]}
    ).geofence()
    for turn in np.linspace(0, 2 * math.pi, 777):
        edge = (3 + 100 * math.cos(turn), 4 + 100 * math.sin(turn), -1.0)
        assert -0.06 < fence.inside(edge) <= 1e-9


def test_a_place_is_told_by_how_much_it_is_beyond_or_too_near():
    fence = Geofence(include=(((0, 0), (10, 0), (10, 10), (0, 10)),))
    assert fence.told((5, 5, -1), 0.75) == ""
    assert fence.told((5, 12.25, -1), 0.75) == "2.25 m outside the fence"
    assert fence.told((5, 9.5, -1), 0.75) == "0.25 m too near the fence (it keeps 0.75 m)"


MISSION = """\
name: fenced
vehicle: {start: {north: 1, east: 1}}
world: {bounds: {north: [-20, 20], east: [-20, 20], altitude: [0, 20]}}
fence: %s
steps:
  - takeoff: {altitude: 3}
  - via: [{north: 3, east: 3, altitude: 3}]
  - goto: {north: 8, east: 8, altitude: 3}
  - orbit: {north: 5, east: 5, altitude: 3, radius: 3}
  - land
"""
SQUARE = "{include: [{corners: [{north: 0, east: 0}, {north: 9, east: 0}, {north: 9, east: 9}, {north: 0, east: 9}]}]}"


@pytest.mark.parametrize(
    ("fence", "line", "words"),
    [
        (SQUARE.replace("9", "7"), 8, "steps.2.goto: found a place 1.41 m outside the fence"),
        ("{exclude: [{circle: {north: 3, east: 3, radius: 1}}]}", 7, "steps.1.via.0: found a place 1.00 m outside"),
        ("{exclude: [{circle: {north: 1, east: 1.5, radius: 1}}]}", 2, "vehicle.start: found a place 0.50 m outside"),
        ("{exclude: [{circle: {north: 5, east: 0, radius: 2.5}}]}", 9, "steps.3.orbit: found a place 0.50 m outside"),
        ("{ceiling: 3.5}", 6, "steps.0.takeoff: found a place 0.25 m too near the fence (it keeps 0.75 m)"),
        (
            SQUARE.replace("]}]}", "]}, {circle: {north: 0, east: 0, radius: 5}}]}"),
            8,
            "steps.2.goto: found a place 6.31 m",
        ),
        (
            SQUARE.replace("{north: 0, east: 9}", "{north: 0, east: -9}").replace(
                "north: 9, east: 9", "north: 4, east: 9"
            ),
            4,
            "touches or crosses",
        ),
        ("{include: [{corners: [{north: 0, east: 0}]}]}", 4, "at least 3 items"),
        ("{margin: 0.8, ceiling: 9}", 4, "fence.margin: found 0.8, expected at most 0.75 (what every way keeps)"),
        ("{include: [{}]}", 4, "expected exactly one of corners, circle"),
    ],
)
def test_a_fence_that_the_mission_does_not_fit_is_refused_where_the_file_is_read(fence, line, words):
    assert parse_mission((MISSION % SQUARE).encode(), "f.yaml").geofence() is not None
    with pytest.raises(MissionError) as caught:
        parse_mission((MISSION % fence).encode(), "f.yaml")
    assert any(words in problem and f"line {line}:" in problem for problem in caught.value.problems), caught.value


def test_a_fence_is_solid_to_the_planner_and_nothing_to_see_or_touch():
    mission = parse_mission((MISSION % SQUARE.replace("{include", "{ceiling: 6, include")).encode(), "f.yaml")
    assert len(mission.planner_world().obstacles) == 2
    assert mission.planner_world().bounds[0][2] == -6
    assert len(mission.whole_world().obstacles) == 0


def test_a_margin_that_is_not_said_is_no_more_than_what_the_ways_keep():
    text = MISSION % SQUARE
    assert parse_mission(text.encode(), "f.yaml").geofence().margin == 0.3
    small = "vehicle: {radius: 0.1, start" + text.partition("vehicle: {start")[2]
    small = text.partition("vehicle: {start")[0] + small + "limits: {clearance: 0.1}\n"
    assert parse_mission(small.encode(), "f.yaml").geofence().margin == pytest.approx(0.2)
    assert parse_mission((small + "sensing: {use: true}\n").encode(), "f.yaml").geofence().margin == 0.1
