"""Which solids are near: a regular grid over the surroundings of a question, whose cells list the solids within reach.

A sample of the obstacle term (`cost`) looks at its own cell's solids only, and a span about whose hull no cell lists
any looks at none: `sums` holds the numbers of listed solids added up along all three axes, so that eight of them tell
of any block of cells at once.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner.bspline import FloatArray
from planner.distance import BOX, PRISM, SPHERE, Scene
from planner.jit import leaf
from planner.surroundings import surroundings
from planner.worlds import World

FINEST, MOST_CELLS, MOST_ITEMS = 2.0, 30_000, 4_000_000
"""Cells a metre along each axis at most, and in all, and what all of them list."""

IntArray = NDArray[np.int64]


class Grid(NamedTuple):
    """Solids near each cell of a regular grid: cell i lists items[starts[i]:starts[i + 1]].

    A point outside the grid belongs to the nearest cell, which so lists what is near such points too.
    """

    origin: FloatArray  # (3,) [m]
    per_metre: float  # cells a metre
    shape: IntArray  # (3,)
    starts: IntArray  # (cells + 1,)
    items: IntArray
    sums: IntArray  # (nx + 1, ny + 1, nz + 1): sums[i, j, k] items are listed in the cells [0, i) x [0, j) x [0, k)


@leaf
def cell_along(v: float, origin: float, per_metre: float, count: int) -> int:
    """Number of the cell along one axis; the nearest when there is none."""
    return min(max(int((v - origin) * per_metre), 0), count - 1)


@leaf
def _cell_range(scene: Scene, k: int, axis: int, reach: float, walls: FloatArray, grid: Grid) -> tuple[int, int]:
    """First and one past the last cell along an axis that solid k comes within reach of; see `Grid` for its border."""
    solids = scene.solids
    if solids[k, 0] == BOX:
        half = solids[k, 4 + axis]
    elif solids[k, 0] >= PRISM and axis < 2:
        half = 0.0
        for e in range(int(solids[k, 4]), int(solids[k, 4] + solids[k, 6])):
            half = max(half, abs(scene.edges[e, axis]))
    elif solids[k, 0] != SPHERE and axis == 2:
        half = solids[k, 5]
    else:
        half = solids[k, 4]
    low, high = solids[k, 1 + axis] - half - reach, solids[k, 1 + axis] + half + reach
    if low > walls[1, axis] or high < walls[0, axis]:
        return 0, 0  # out of reach of the whole map
    low, high = (low - grid.origin[axis]) * grid.per_metre, (high - grid.origin[axis]) * grid.per_metre
    last = grid.shape[axis] - 1.0
    return int(min(max(math.floor(low), 0.0), last)), int(min(max(math.floor(high), 0.0), last)) + 1


@leaf
def fill_grid(scene: Scene, reach: float, walls: FloatArray, grid: Grid, counting: bool) -> None:
    """Two passes over the same cells: count into `starts` (shifted by one), then write into `items`."""
    solids, ny, nz = scene.solids, grid.shape[1], grid.shape[2]
    for k in range(solids.shape[0]):
        x0, x1 = _cell_range(scene, k, 0, reach, walls, grid)
        y0, y1 = _cell_range(scene, k, 1, reach, walls, grid)
        z0, z1 = _cell_range(scene, k, 2, reach, walls, grid)
        for ix in range(x0, x1):
            for iy in range(y0, y1):
                for iz in range(z0, z1):
                    cell = (ix * ny + iy) * nz + iz
                    if counting:
                        grid.starts[cell + 1] += 1
                    else:
                        grid.items[grid.starts[cell]] = k
                        grid.starts[cell] += 1


@leaf
def sum_grid(starts: IntArray, sums: IntArray) -> None:
    """Write `sums` from the filled grid's `starts`: the numbers of items, summed along all three axes."""
    cell = 0
    for ix in range(1, sums.shape[0]):
        for iy in range(1, sums.shape[1]):
            column = starts[cell]
            for iz in range(1, sums.shape[2]):
                cell += 1
                beside = sums[ix - 1, iy, iz] + sums[ix, iy - 1, iz] - sums[ix - 1, iy - 1, iz]
                sums[ix, iy, iz] = beside + starts[cell] - column


def build_grid(world: World, reach: float, around: FloatArray | None = None) -> Grid:
    """The grid whose cells list every solid within `reach` [m] of any of their points, over what is around points.

    Parameters
    ----------
    around : (m, 3)     points of the question, whose surroundings are divided into cells [m]; else all of the map.
    """
    near = world.walls if around is None else surroundings(world.walls, around)
    extent = near[1] - near[0]
    per_metre = min(FINEST, float(MOST_CELLS / np.prod(np.maximum(extent, 1.0))) ** (1 / 3))
    while True:
        while np.prod(np.maximum(np.ceil(extent * per_metre), 1.0)) > MOST_CELLS:  # an axis has a cell at least
            per_metre *= 0.9
        shape = np.maximum(np.ceil(extent * per_metre), 1.0).astype(np.int64)
        starts = np.zeros(int(np.prod(shape)) + 1, dtype=np.int64)
        sums = np.zeros(shape + 1, dtype=np.int64)
        empty = Grid(near[0].copy(), per_metre, shape, starts, np.empty(0, dtype=np.int64), sums)
        fill_grid(world.scene, reach, world.walls, empty, True)
        ends = np.cumsum(starts)
        if ends[-1] <= MOST_ITEMS or len(starts) == 2:
            break
        per_metre *= 0.5
    sum_grid(ends, sums)
    grid = empty._replace(starts=ends.copy(), items=np.empty(int(ends[-1]), dtype=np.int64))
    fill_grid(world.scene, reach, world.walls, grid, False)
    return grid._replace(starts=ends)  # the second pass moved each start to its end
