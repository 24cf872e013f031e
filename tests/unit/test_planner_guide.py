"""The search graph: what it calls free is free by arithmetic of this file, however thin solids or large maps are."""

import itertools
import math

import numpy as np
import pytest

from planner import Box, Cylinder, World
from planner.families import maze
from planner.guide import MOST_POINTS, Guides, guide, widths

BOUNDS = ((0, 0, 0), (12, 8, 3))


def sheet(x: float, low: float, high: float, thickness: float) -> Box:
    """Across the way, full height, from y = low to y = high."""
    return Box((x, low, -1), (x + thickness, high, 4))


def samples(path: np.ndarray, each: int = 5000) -> np.ndarray:
    return np.concatenate([np.linspace(a, b, each) for a, b in itertools.pairwise(path)])


def outside(p: np.ndarray, box: Box) -> np.ndarray:
    beyond = np.maximum(np.maximum(np.array(box.lower) - p, p - np.array(box.upper)), 0.0)
    return np.linalg.norm(beyond, axis=1)


@pytest.mark.parametrize("radius", [0.0, 0.05, 0.3])
@pytest.mark.parametrize("thickness", [1e-4, 5e-3, 0.5])
@pytest.mark.parametrize("seed", range(3))
def test_no_sheet_is_too_thin_to_go_round(radius: float, thickness: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    sheets = [sheet(x + rng.uniform(-0.3, 0.3), -1, rng.uniform(6.5, 7), thickness) for x in (3.0, 8.0)]
    sheets.append(sheet(5.5 + rng.uniform(-0.3, 0.3), rng.uniform(1, 1.5), 9, thickness))
    start, goal = np.array([1.0, 4.0, 1.5]), np.array([11.0, 4.0, 1.5])
    way = guide(World(BOUNDS, sheets), start, goal, radius)
    assert len(way.path)
    np.testing.assert_array_equal(way.path[[0, -1]], [start, goal])
    assert way.length == pytest.approx(np.linalg.norm(np.diff(way.path, axis=0), axis=1).sum())
    p = samples(way.path)
    assert min(outside(p, box).min() for box in sheets) >= radius + 0.004
    assert (p >= radius).all()
    assert (p <= np.array(BOUNDS[1]) - radius).all()


def test_a_way_is_led_through_the_middle_of_a_narrow_door() -> None:
    walls = [sheet(6, -1, 3.0, 0.2), sheet(6, 4.0, 9, 0.2)]
    way = guide(World(BOUNDS, walls), np.array([1.0, 1, 1.5]), np.array([11.0, 7, 1.5]), 0.3)
    p = samples(way.path)
    within = p[(p[:, 0] > 6) & (p[:, 0] < 6.2)]
    assert min(abs(within[:, 1] - 3.0).min(), abs(within[:, 1] - 4.0).min()) > 0.35


def test_where_there_is_no_way_the_path_is_empty_and_its_length_infinite() -> None:
    way = guide(World(BOUNDS, [sheet(6, -1, 9, 1e-3)]), np.array([1.0, 4, 1.5]), np.array([11.0, 4, 1.5]), 0.0)
    assert len(way.path) == 0
    assert way.length == math.inf
    assert way.width == 0.125


def test_an_end_that_hardly_keeps_the_radius_is_left_all_the_same() -> None:
    post = Cylinder((3, 4), 1.0, (-1, 4))
    way = guide(World(BOUNDS, [post]), np.array([1.7 - 1e-6, 4, 1.5]), np.array([11.0, 4, 1.5]), 0.3)
    assert len(way.path)
    p = samples(way.path)
    assert np.hypot(p[:, 0] - 3, p[:, 1] - 4).min() >= 1.3 - 0.01


@pytest.mark.parametrize("extent", [(0.1, 0.1, 0.1), (20, 20, 4), (1110, 40, 10), (20_000, 20_000, 500)])
def test_every_map_has_a_grid_that_fits(extent: tuple[float, float, float]) -> None:
    found = widths(np.array(extent, dtype=float))
    assert found == sorted(found, reverse=True)
    assert all(math.prod(math.ceil(e / w) + 1 for e in extent) <= MOST_POINTS for w in found)
    assert found


def test_a_map_of_a_kilometre_has_a_guide_too() -> None:
    walls = [sheet(100 * k, -20 if k % 2 else -5, 5 if k % 2 else 20, 1.0) for k in range(1, 10)]
    high = [Box((b.lower[0], b.lower[1], 0), (b.upper[0], b.upper[1], 10)) for b in walls]
    world = World(((-10, -20, 0), (1100, 20, 10)), high)
    way = guide(world, np.array([0.0, 0, 5]), np.array([1000.0, 0, 5]), 0.3)
    assert 1000.0 < way.length < 1100.0
    assert min(outside(samples(way.path), box).min() for box in high) >= 0.3


def turns_about(path: np.ndarray, x: float, y: float) -> float:
    """How far a path winds about an upright axis [rad]: ways past it on either side differ by a full turn."""
    angles = np.unwrap(np.arctan2(path[:, 1] - y, path[:, 0] - x))
    return float(angles[-1] - angles[0])


def ways(world: World, start: np.ndarray, goal: np.ndarray, count: int) -> list[np.ndarray]:
    guides = Guides(world, start, goal, 0.3)
    guides.refine()
    return [way.path for way in (guides.another() for _ in range(count)) if way is not None]


def test_ways_pass_a_pillar_on_both_sides_and_no_third() -> None:
    world = World(BOUNDS, [Box((5, 3, -1), (7, 5, 4))])
    found = ways(world, np.array([1.0, 4, 1.5]), np.array([11.0, 4, 1.5]), 5)
    assert len(found) == 2
    a, b = (turns_about(samples(path), 6.0, 4.0) for path in found)
    assert abs(a - b) == pytest.approx(2 * math.pi, abs=1e-6)


@pytest.mark.parametrize("pillars", [2, 3])
def test_no_two_ways_wind_about_all_pillars_alike(pillars: int) -> None:
    posts = [Cylinder((3.0 * (k + 1), 4.0), 0.9, (-1, 4)) for k in range(pillars)]
    found = ways(World(BOUNDS, posts), np.array([0.7, 4, 1.5]), np.array([11.3, 4, 1.5]), 12)
    windings = [tuple(round(turns_about(samples(path), *post.centre), 6) for post in posts) for path in found]
    assert len(found) >= 2
    assert len(set(windings)) == len(found)


def test_over_a_beam_and_under_it_are_two_ways_but_over_a_wall_and_round_its_end_is_one() -> None:
    start, goal = np.array([1.0, 3, 0.9]), np.array([11.0, 3, 0.9])
    beam = [Box((5, 0, -1), (6, 9, 0.4)), Box((5, 0, 1.4), (6, 9, 1.6))]
    found = ways(World(((0, 2, 0), (12, 4, 3)), beam), start, goal, 5)
    assert len(found) == 2
    heights = sorted(np.interp(5.5, path[:, 0], path[:, 2]) for path in found)
    assert heights[0] < 1.1 < 1.9 < heights[1]
    assert len(ways(World(BOUNDS, [Box((5, -1, -1), (6, 6, 1.5))]), start, goal, 5)) == 1


def test_a_bound_on_the_length_leaves_out_longer_ways() -> None:
    guides = Guides(
        World(BOUNDS, [Box((5, -1, -1), (6, 7, 4))]), np.array([1.0, 6, 1.5]), np.array([11.0, 6, 1.5]), 0.3
    )
    guides.refine()
    assert guides.another(10.0) is None
    way = guides.another(14.0)
    assert way is not None
    assert 10.0 < way.length < 14.0


@pytest.mark.parametrize("seed", range(6))
def test_ways_through_a_maze_with_loops_keep_the_radius_and_wind_differently_about_its_walls(seed: int) -> None:
    scenario = maze(np.random.default_rng(seed), "loops")
    found = ways(scenario.world, np.array(scenario.start), np.array(scenario.goal), 5)
    walls = [wall for wall in scenario.world.obstacles if isinstance(wall, Box)]
    assert len(found) >= 2
    windings = set()
    for path in found:
        p = samples(path, 300)
        assert min(outside(p, wall).min() for wall in walls) >= 0.3 + 0.004
        middles = [(np.array(wall.lower) + wall.upper) / 2 for wall in walls]
        windings.add(tuple(round(turns_about(p, x, y), 6) for x, y, _ in middles))
    assert len(windings) == len(found)
