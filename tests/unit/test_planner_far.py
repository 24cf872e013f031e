"""Maps of any size: what is asked in them has the answer, and takes the memory, that it has in a small one."""

import math
import tracemalloc

import numpy as np
import pytest

from planner import Box, Cylinder, Limits, NoPathFound, Prism, Sphere, VoxelGrid, World, plan
from planner.cost import SplineCost
from planner.enclosure import PITCHES, apart
from planner.guide import Guides, guide
from planner.nearby import MOST_CELLS, build_grid
from planner.surroundings import places

LIMITS, RADIUS = Limits(3.0, 6.0, 60.0), 0.3
START, GOAL = np.array([1.0, 10.0, 1.5]), np.array([19.0, 10.0, 1.5])
POST = Cylinder((10, 10), 1.0, (0, 4))
AROUND_THE_POST = 2.0 * (math.sqrt(9.0**2 - 1.3**2) + 1.3 * math.asin(1.3 / 9.0))
"""The shortest way from start to goal: two tangents and an arc."""


def square(half: float, obstacles: list) -> World:
    return World(((-half, -half, 0), (half, half, 4)), obstacles)


@pytest.mark.parametrize("method", ["haoaroa", "astar", "jps"])
@pytest.mark.parametrize("half", [1e3, 1e5, 1e7, 1e9])
def test_a_way_of_metres_is_as_short_in_a_map_of_any_size(method: str, half: float) -> None:
    made = plan(square(half, [POST]), START, GOAL, LIMITS, RADIUS, method=method)
    assert made.certified
    assert AROUND_THE_POST - 1e-3 < made.length < (1.01 if method == "haoaroa" else 1.06) * AROUND_THE_POST


@pytest.mark.parametrize("method", ["haoaroa", "astar"])
def test_a_way_round_that_leaves_the_surroundings_is_found_in_the_whole_map(method: str) -> None:
    wall = Box((9, -60, 0), (10, 60, 4))
    made = plan(square(300, [wall]), START, GOAL, LIMITS, RADIUS, method=method)
    assert made.certified
    shortest = 2.0 * math.hypot(8.5, 50.3)
    assert shortest < made.length < 1.2 * shortest
    assert len(places(square(300, []).walls, np.array([START, GOAL]))) == 2


def test_a_small_map_is_looked_at_as_a_whole() -> None:
    walls = square(20, []).walls
    assert places(walls, np.array([START, GOAL])) == [walls]


@pytest.mark.parametrize("half", [20.0, 1e3, 1e5, 1e7, 1e9])
def test_a_grid_of_solids_has_a_bounded_number_of_cells_over_a_map_of_any_shape(half: float) -> None:
    for low, high in (((-half, -half, 0), (half, half, 4)), ((-half, 0, 0), (half, 1, 1)), ((-half,) * 3, (half,) * 3)):
        world = World((low, high), [POST])
        for around in (None, np.array([[1.0, 0.5, 0.5], [19.0, 0.5, 0.5]])):
            grid = build_grid(world, 0.5, around)
            assert len(grid.starts) - 1 == int(np.prod(grid.shape)) <= MOST_CELLS


def test_what_a_cell_lists_does_not_change_the_cost_wherever_the_curve_leads() -> None:
    rng = np.random.default_rng(5)
    places_ = rng.uniform((-100, -100, 0), (100, 100, 4), (3000, 3))
    posts = [
        Cylinder((x, y), r, (0, 4)) for (x, y, _), r in zip(places_[:1500], rng.uniform(0.5, 4, 1500), strict=True)
    ]
    world = square(100, [*posts, *(Sphere(tuple(p), 2.0) for p in places_[1500:])])
    whole, near = build_grid(world, 0.6), build_grid(world, 0.6, np.array([START, GOAL]))
    one = build_grid(square(100, []), 0.6)._replace(  # a single cell that lists everything
        per_metre=1e-3,
        shape=np.ones(3, dtype=np.int64),
        starts=np.array([0, 3000]),
        items=np.arange(3000),
        sums=np.array([[[0, 0], [0, 0]], [[0, 0], [0, 3000]]]),
    )
    assert near.per_metre > whole.per_metre
    costs = [SplineCost(world, START, GOAL, 30, LIMITS, 0.6, grid=grid) for grid in (one, near, whole)]
    for spread in (1.0, 10.0, 50.0, 150.0):
        x = rng.normal(10.0, spread, costs[0].size)
        (truth, slope), *others = [cost(x) for cost in costs]
        for value, gradient in others:
            assert value == pytest.approx(truth, rel=1e-12)
            np.testing.assert_allclose(gradient, slope, rtol=1e-9, atol=1e-9 * np.abs(slope).max())


def test_thousands_of_solids_that_fill_the_map_are_listed_in_bounded_memory() -> None:
    slabs = [Box((0, 0, 3 + 1e-4 * k), (20, 20, 3.5 + 1e-4 * k)) for k in range(3000)]
    grid = build_grid(World(((0, 0, 0), (20, 20, 4)), slabs), 0.5)
    assert len(grid.items) <= 4_000_000
    assert len(grid.starts) > 2


def test_lattices_are_laid_around_the_question_first() -> None:
    guides = Guides(square(1e6, [POST]), START, GOAL, RADIUS)
    (near, _), (far, _) = guides.levels[0], guides.levels[-1]
    assert np.ptp(near, axis=0).max() < 100.0
    assert np.ptp(far, axis=0).max() > 1e6
    assert guide(square(1e6, [POST]), START, GOAL, RADIUS).length < 1.02 * AROUND_THE_POST


def test_a_start_and_a_goal_that_share_a_lattice_point_and_do_not_see_each_other_have_no_way() -> None:
    shut = [Box((9, -1e6, 0), (10, 1e6, 4))]
    way = guide(square(1e6, shut), START, GOAL, RADIUS)  # the lattice over all of the map has its points 1 km apart
    assert not len(way.path)


@pytest.mark.parametrize("method", ["haoaroa", "astar"])
def test_being_shut_in_by_voxels_in_a_vast_map_is_proved_in_bounded_memory(method: str) -> None:
    hollow = np.ones((60, 60, 40), dtype=bool)
    hollow[5:55, 5:55] = False
    world = square(1e7, [VoxelGrid(hollow, (-2.0, 7.0, 0.0), 0.1)])
    tracemalloc.start()
    with pytest.raises(NoPathFound, match="proved unreachable"):
        plan(world, START, GOAL, LIMITS, RADIUS, method=method)
    assert tracemalloc.get_traced_memory()[1] < 300e6
    tracemalloc.stop()
    hollow[:, 25:35] = False  # a door of a metre
    assert not apart(square(1e7, [VoxelGrid(hollow, (-2.0, 7.0, 0.0), 0.1)]), START, GOAL, RADIUS, PITCHES)


@pytest.mark.parametrize("door", [0.0, 0.3, 0.65])
def test_a_room_among_a_thousand_others_in_a_large_map_is_proved_shut_if_its_door_is(door: float) -> None:
    rooms = []
    for x, y in np.ndindex(16, 16):
        a, b = 40.0 * x - 302.0, 40.0 * y - 293.0  # one of them has the start in its middle
        rooms += [Box((a, b, 0), (a + 0.2, b + 6, 4)), Box((a, b, 0), (a + 6, b + 0.2, 4))]
        rooms += [Box((a, b + 5.8, 0), (a + 6, b + 6, 4))]
        rooms += [Box((a + 5.8, b, 0), (a + 6, b + 3, 4)), Box((a + 5.8, b + 3 + door, 0), (a + 6, b + 6, 4))]
    world = square(1e3, rooms)
    start = np.array([-19.0, -10.0, 1.0])
    assert world.distance(start)[0] == pytest.approx(2.8)
    assert apart(world, start, np.array([19.0, 11.0, 1.5]), RADIUS, PITCHES) == (door < 2 * RADIUS)


@pytest.mark.parametrize(
    ("obstacle", "found"),
    [
        (Sphere((1e12, 0, 0), 1.0), "1e+12"),
        (Sphere((0, 0, 0), 2e9), "2e+09"),
        (Box((3, 3, -1e308), (4, 4, 1e308)), "1e+308"),
        (Cylinder((0, 0), 1.0, (-1e300, 1.0)), "1e+300"),
        (Prism(((0, 0), (1e10, 0), (0, 1e10)), (0, 1)), "1e+10"),
        (VoxelGrid(np.ones((1, 1, 1), dtype=bool), (0, 0, 1e15), 1.0), "1e+15"),
    ],
    ids=["far", "huge", "tall", "deep", "wide", "voxels"],
)
def test_an_obstacle_too_far_or_large_for_proofs_is_refused_by_its_number_and_not_held_against_the_start(
    obstacle, found: str
) -> None:
    with pytest.raises(ValueError, match="obstacle 1 ") as caught:
        World(((0, 0, 0), (20, 20, 4)), [POST, obstacle])
    assert found in str(caught.value)
    assert "at most 1e+09 m" in str(caught.value)


def test_a_map_that_reaches_too_far_is_refused() -> None:
    with pytest.raises(ValueError, match="bounds: expected coordinates of at most"):
        square(1e13, [])
