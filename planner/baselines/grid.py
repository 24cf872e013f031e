"""Cells for A* and JPS: one regular grid, every edge of it proved clear.

Cell centres are `width` apart along each axis; an edge joins a free cell with any of its 26 neighbours, so it is at
most sqrt(3) width long, and it may pass between two blocked cells (it cuts corners). Still each edge keeps the radius
r. For p on an edge from a to b of length L, a share t of the way, and any point q of a solid (Stewart's theorem),

    |p - q|^2 = (1 - t) |a - q|^2 + t |b - q|^2 - t (1 - t) L^2  >=  min(|a - q|, |b - q|)^2 - L^2 / 4

so a cell is free when its centre is sqrt(r^2 + 3/4 width^2) from every solid, and r from every wall. That is 5 cm more
than a radius of 0.3 m for cells of 0.2 m. The start is a cell's centre; the goal is joined to the nearest free cell by
an edge of its own, which is put to the proof of `certificate`.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from planner.bspline import FloatArray, clamped_knots
from planner.certificate import certify, needed
from planner.distance import Scene, nearest_solid
from planner.jit import kernel
from planner.worlds import World

WIDTHS = (0.2, 0.1, 0.05)
"""Cell widths tried in turn until there is a way [m]; a place too large for the first gets wider cells."""
MOST_CELLS = 2_000_000
BLOCK = 4
"""Cells a side of the blocks that are looked at as one first."""
NEAREST = 2
"""How many cells away from an end its own cell may be."""

ByteArray = NDArray[np.uint8]
IntArray = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class CellGrid:
    """Free and blocked cells of a map or of a part of it."""

    free: ByteArray  # (nx, ny, nz) 1 where free
    origin: FloatArray  # (3,) centre of the first cell [m]
    width: float  # [m]

    def centres(self, cells: IntArray) -> FloatArray:
        """Centres (m, 3) [m] of cells (m, 3)."""
        points: FloatArray = self.origin + self.width * cells
        return points


@kernel
def mark_free(scene: Scene, origin: FloatArray, width: float, need: float, free: ByteArray) -> None:
    """Write 1 into `free` where a centre is at least `need` from every solid.

    A block of cells whose middle is farther than that by half its diagonal is free without another look.
    """
    nx, ny, nz = free.shape
    middle = 0.5 * (BLOCK - 1) * width
    reach = math.sqrt(3.0) * middle
    for bx in range(0, nx, BLOCK):
        for by in range(0, ny, BLOCK):
            for bz in range(0, nz, BLOCK):
                x, y, z = origin[0] + bx * width, origin[1] + by * width, origin[2] + bz * width
                d, _ = nearest_solid(scene, x + middle, y + middle, z + middle)
                clear = d - reach >= need
                for ix in range(bx, min(bx + BLOCK, nx)):
                    for iy in range(by, min(by + BLOCK, ny)):
                        for iz in range(bz, min(bz + BLOCK, nz)):
                            if not clear:
                                d, _ = nearest_solid(
                                    scene, x + (ix - bx) * width, y + (iy - by) * width, z + (iz - bz) * width
                                )
                            free[ix, iy, iz] = 1 if clear or d >= need else 0


def widths(extent: FloatArray) -> list[float]:
    """The cell widths for a place of that extent (3,), widest first and at least one [m]."""
    fitting = [width for width in WIDTHS if _cells(extent, width) <= MOST_CELLS]
    wider = WIDTHS[0]
    while not fitting:
        wider *= 1.25
        if _cells(extent, wider) <= MOST_CELLS:
            fitting.append(wider)
    return fitting


def _cells(extent: FloatArray, width: float) -> float:
    return float(np.prod(np.floor(extent / width) + 1.0))


def build(world: World, start: FloatArray, radius: float, width: float, place: FloatArray | None = None) -> CellGrid:
    """The grid of cells `width` [m] wide that has a centre at `start` (3,), for a radius [m].

    place (2, 3) is the part of the map that it fills, all of it if not given [m].
    """
    room = needed(world, radius)
    low, high = world.walls[0] + room, world.walls[1] - room
    if place is not None:
        low, high = np.maximum(low, place[0]), np.minimum(high, place[1])
    origin = start - width * np.floor(np.maximum(start - low, 0.0) / width)
    shape = np.floor(np.maximum(high - origin, 0.0) / width).astype(np.int64) + 1
    free = np.empty(tuple(shape), dtype=np.uint8)
    mark_free(world.scene, origin, width, math.sqrt(room**2 + 0.75 * width**2), free)
    return CellGrid(free, origin, width)


def sees(world: World, radius: float, a: FloatArray, b: FloatArray) -> bool:
    """Whether the segment from a to b (3,) is proved to keep the radius."""
    line = a + np.linspace(0.0, 1.0, 4)[:, None] * (b - a)
    return certify(line, clamped_knots(4), world, radius, full=False).certified


def cell_of(grid: CellGrid, world: World, radius: float, point: FloatArray) -> IntArray | None:
    """The nearest free cell (3,) that is joined to a point (3,) by a proved segment; None when there is none near."""
    middle = np.rint((point - grid.origin) / grid.width).astype(np.int64)
    low, high = np.maximum(middle - NEAREST, 0), np.minimum(middle + NEAREST + 1, grid.free.shape)
    if (low >= high).any():
        return None
    window = grid.free[low[0] : high[0], low[1] : high[1], low[2] : high[2]]
    cells: IntArray = low + np.argwhere(window)
    away = np.linalg.norm(grid.centres(cells) - point, axis=1)
    for i in np.argsort(away, kind="stable"):
        if away[i] <= 1e-9 or sees(world, radius, point, grid.centres(cells[i])):
            found: IntArray = cells[i]
            return found
    return None
