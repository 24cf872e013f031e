"""A* and jump point search on grids of cells, against scipy's Dijkstra; and grids of cells against the solids."""

import itertools
import math

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from planner import Box, Cylinder, Sphere, World
from planner.baselines import astar, jps
from planner.baselines.grid import MOST_CELLS, build, cell_of, widths
from planner.baselines.heap import octile
from planner.baselines.route import straightened

MOVES = [move for move in itertools.product((-1, 0, 1), repeat=3) if any(move)]


def shortest_length(free: np.ndarray, start: np.ndarray, goal: np.ndarray) -> float:
    """Dijkstra on the same 26 neighbours, corners cut: scipy's, on a graph of this file's making."""
    number = np.full(np.array(free.shape) + 2, -1)
    number[1:-1, 1:-1, 1:-1][free > 0] = np.arange(free.sum())
    cells = np.argwhere(number >= 0)
    rows, columns, lengths = [], [], []
    for move in MOVES:
        other = number[tuple((cells + move).T)]
        rows.append(number[tuple(cells[other >= 0].T)])
        columns.append(other[other >= 0])
        lengths.append(np.full((other >= 0).sum(), np.linalg.norm(move)))
    edges = (np.concatenate(rows), np.concatenate(columns))
    graph = coo_matrix((np.concatenate(lengths), edges), shape=(len(cells), len(cells))).tocsr()
    return float(dijkstra(graph, indices=number[tuple(start + 1)])[number[tuple(goal + 1)]])


def random_grids(count: int) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Noise of every density, flat grids and lines too; and walls with holes, where ways turn often."""
    rng = np.random.default_rng(11)
    grids = []
    while len(grids) < count:
        shape = rng.integers(1, 12, 3)
        if len(grids) % 2:
            free = (rng.random(shape) > rng.uniform(0.05, 0.75)).astype(np.uint8)
        else:
            free = np.ones(shape, dtype=np.uint8)
            for axis in range(3):
                for layer in range(1, shape[axis] - 1, 3):
                    wall = np.moveaxis(free, axis, 0)[layer]
                    wall[:] = rng.random(wall.shape) < rng.uniform(0.05, 0.4)
        cells = np.argwhere(free)
        if len(cells) > 1:
            start, goal = cells[rng.integers(len(cells), size=2)]
            grids.append((free, start, goal))
    return grids


def walked(free: np.ndarray, cells: np.ndarray) -> float:
    """Length of a way, every cell of it walked and free: legs go along one of the 26 directions."""
    length = 0.0
    for a, b in itertools.pairwise(cells):
        steps = np.abs(b - a).max()
        move = (b - a) // steps
        assert (a + steps * move == b).all()
        for k in range(steps + 1):
            assert free[tuple(a + k * move)]
        length += steps * np.linalg.norm(move)
    return length


def test_astar_and_jps_are_as_short_as_dijkstra_on_random_grids() -> None:
    unreachable = turned = 0
    for free, start, goal in random_grids(300):
        expected = shortest_length(free, start, goal)
        for method in (astar, jps):
            cells, length, _ = method.shortest(free, start, goal)
            assert length == pytest.approx(expected, abs=1e-9)
            if math.isinf(expected):
                assert len(cells) == 0
                continue
            assert (cells[0] == start).all()
            assert (cells[-1] == goal).all()
            assert walked(free, cells) == pytest.approx(expected, abs=1e-9)
        unreachable += math.isinf(expected)
        turned += len(cells) > 3
    assert unreachable > 20
    assert turned > 100


@pytest.mark.slow
def test_jps_is_as_short_as_dijkstra_on_many_more_grids() -> None:
    for free, start, goal in random_grids(1500):
        _, length, _ = jps.shortest(free, start, goal)
        assert length == pytest.approx(shortest_length(free, start, goal), abs=1e-9)


def test_jps_expands_far_fewer_cells_than_astar_round_a_wall() -> None:
    free = np.ones((40, 40, 10), dtype=np.uint8)
    free[20, 5:35, :] = 0
    start, goal = np.array([2, 20, 5]), np.array([37, 20, 5])
    _, _, astar_expanded = astar.shortest(free, start, goal)
    _, _, jps_expanded = jps.shortest(free, start, goal)
    assert 20 * jps_expanded < astar_expanded


def test_a_start_that_is_the_goal_is_a_way_of_one_cell() -> None:
    here = np.array([1, 1, 0])
    for method in (astar, jps):
        cells, length, _ = method.shortest(np.ones((3, 3, 1), dtype=np.uint8), here, here)
        assert length == 0.0
        assert (cells == here).all()


def test_moves_survive_pruning_in_free_space_only_along_the_axes_of_the_last_one() -> None:
    """Of the planar rules: one natural neighbour straight on, three diagonally; seven in space (Harabor & Grastien)."""
    counts = [len(row) for row in jps.NATURAL]
    assert sorted(counts) == [1] * 6 + [3] * 12 + [7] * 8


def test_every_move_that_may_be_forced_has_a_way_round_inside_its_own_box() -> None:
    """Then nothing is forced where no neighbour is blocked, at the grid's border too (see `mark_crowded`)."""
    for d, row in zip(jps.MOVES, jps.FORCED, strict=True):
        for k, offsets in row:
            n = d + jps.MOVES[k]  # from p
            low, high = np.minimum(0, n), np.maximum(0, n)
            assert any(((o + d >= low) & (o + d <= high)).all() for o in offsets)


def test_the_estimate_is_the_length_of_the_free_way() -> None:
    assert octile(3, -7, 2) == pytest.approx(2 * math.sqrt(3) + math.sqrt(2) + 4)
    assert octile(0, 0, -5) == 5.0


WORLD = World(
    ((0, 0, 0), (5, 4, 2)),
    [
        Box((1, 1, 0), (1.003, 3, 2)),
        Cylinder((3, 2), 0.3, (0, 1.2)),
        Sphere((4, 1, 1), 0.4),
        Box((2, 3.4, 0), (3, 4, 2)),
    ],
)


@pytest.mark.parametrize("radius", [0.0, 0.1, 0.3])
def test_every_edge_between_free_cells_keeps_the_radius(radius: float) -> None:
    """Sampled every 4 mm, by exact distances."""
    start = np.array([0.4, 2.0, 1.0])
    grid = build(WORLD, start, radius, 0.2)
    free = np.argwhere(grid.free)
    share = np.linspace(0.0, 1.0, 50)[:, None]
    seen = 0
    for move in MOVES[: len(MOVES) // 2]:
        other = free + move
        inside = ((other >= 0) & (other < grid.free.shape)).all(axis=1)
        ends = free[inside][grid.free[tuple(other[inside].T)] > 0]
        a, b = grid.centres(ends), grid.centres(ends + move)
        points = (a[:, None] + share * (b - a)[:, None]).reshape(-1, 3)
        assert WORLD.distance(points).min() >= radius
        assert WORLD.wall_distance(points).min() >= radius
        seen += len(ends)
    assert seen > 5000


def test_cells_are_free_exactly_where_their_centre_is_far_enough() -> None:
    grid = build(WORLD, np.array([0.4, 2.0, 1.0]), 0.1, 0.2)
    cells = np.argwhere(np.ones_like(grid.free))
    distance = WORLD.distance(grid.centres(cells))
    np.testing.assert_array_equal(grid.free.ravel() > 0, distance >= math.sqrt(0.01 + 0.75 * 0.04) + 1e-10)


def test_the_start_is_a_cells_centre() -> None:
    start = np.array([0.437, 2.013, 1.0007])
    grid = build(WORLD, start, 0.1, 0.2)
    cell = cell_of(grid, WORLD, 0.1, start)
    assert cell is not None
    np.testing.assert_allclose(grid.centres(cell), start, atol=1e-12)


@pytest.mark.parametrize("size", [1e-3, 1.0, 30.0, 1e4, 2e5])
def test_the_number_of_cells_is_bounded_for_any_map(size: float) -> None:
    extent = np.array([size, size, size / 3])
    for width in widths(extent):
        assert np.prod(np.floor(extent / width) + 1) <= MOST_CELLS


def test_straightening_keeps_corners_and_ends_alone() -> None:
    points = np.array([[0, 0, 0], [0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0], [2, 3, 0], [2, 3, 0]], dtype=float)
    np.testing.assert_array_equal(straightened(points), [[0, 0, 0], [2, 0, 0], [2, 3, 0]])
    there_and_back = np.array([[0, 0, 0], [2, 0, 0], [1, 0, 0]], dtype=float)
    np.testing.assert_array_equal(straightened(there_and_back), there_and_back)
    np.testing.assert_array_equal(straightened(np.zeros((4, 3))), np.zeros((1, 3)))
