"""The benchmarks' taut string against closed forms, so that the ratios taken with it mean something."""

import math

import pytest

from benchmarks.shortest import Plan2D
from planner import Box, Cylinder, World

BOUNDS = ((0, 0, 0), (20, 20, 4))
START, GOAL, RADIUS = (1.0, 10.0, 1.5), (19.0, 10.0, 1.5), 0.3


def test_nothing_in_the_way_leaves_a_straight_line() -> None:
    aside = World(BOUNDS, [Box((9, 0, 0), (10, 9, 4)), Cylinder((5, 12), 1.0, (0, 4))])
    assert Plan2D(aside, RADIUS).shortest(START, GOAL) == pytest.approx(18.0, abs=1e-9)


def test_round_a_post_it_is_two_tangents_and_an_arc() -> None:
    world, r, d = World(BOUNDS, [Cylinder((10, 10), 1.0, (0, 4))]), 1.3, 9.0
    expected = 2 * math.sqrt(d * d - r * r) + r * (math.pi - 2 * math.acos(r / d))
    assert Plan2D(world, RADIUS).shortest(START, GOAL) == pytest.approx(expected, abs=1e-9)


def test_round_a_box_it_is_two_tangents_two_arcs_and_a_side() -> None:
    world = World(BOUNDS, [Box((9, 6, 0), (11, 14, 4))])
    far = math.hypot(8.0, 4.0)
    turn = math.atan2(4.0, 8.0) + math.asin(RADIUS / far)
    expected = 2 * math.sqrt(far**2 - RADIUS**2) + 2 * RADIUS * turn + 2.0
    assert Plan2D(world, RADIUS).shortest(START, GOAL) == pytest.approx(expected, abs=1e-9)


def test_a_closed_wall_leaves_no_way() -> None:
    assert math.isinf(Plan2D(World(BOUNDS, [Box((9, 0.2, 0), (10, 20, 4))]), RADIUS).shortest(START, GOAL))
