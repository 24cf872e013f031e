"""A* on a grid of cells, 26 neighbours each.

Hart, Nilsson & Raphael, "A formal basis for the heuristic determination of minimum cost paths", IEEE Transactions on
Systems Science and Cybernetics 4 (1968). The estimate is the length of the way without obstacles, which never
overestimates and is consistent, so the first time the goal is taken from the heap its way is a shortest one.
"""

import numpy as np

from planner.baselines.grid import ByteArray, IntArray
from planner.baselines.heap import FIRST, STEPS, TIE, estimate, pop, push
from planner.jit import kernel


@kernel
def search(free: ByteArray, begin: int, goal: int, stride_x: int, stride_y: int) -> tuple[IntArray, float, int]:
    """(cells' flat indices (m,) from begin to goal, length in cell widths, cells expanded); m = 0 without a way.

    `free` (cells,) is flat, with a border of blocked cells; strides are those of x and y.
    """
    cost = np.full(free.shape[0], np.inf)
    parent = np.full(free.shape[0], -1, dtype=np.int64)
    done = np.zeros(free.shape[0], dtype=np.uint8)
    keys, items, size = np.empty(FIRST), np.empty(FIRST, dtype=np.int64), 0
    cost[begin] = 0.0
    keys, items, size = push(keys, items, size, 0.0, begin)
    expanded = 0
    while size > 0:
        cell = items[0]
        size = pop(keys, items, size)
        if cell == goal:
            break
        if done[cell]:
            continue
        done[cell] = 1
        expanded += 1
        for dx in range(-1, 2):
            for dy in range(-1, 2):
                for dz in range(-1, 2):
                    other = cell + dx * stride_x + dy * stride_y + dz
                    if not free[other] or done[other]:
                        continue
                    moved = cost[cell] + STEPS[max(abs(dx) + abs(dy) + abs(dz) - 1, 0)]
                    if moved < cost[other] - TIE:
                        cost[other], parent[other] = moved, cell
                        key = moved * (1.0 - TIE) + estimate(other, goal, stride_x, stride_y)
                        keys, items, size = push(keys, items, size, key, other)
    if cost[goal] == np.inf:
        return np.empty(0, dtype=np.int64), np.inf, expanded
    return trace(parent, begin, goal), cost[goal], expanded


@kernel
def trace(parent: IntArray, begin: int, goal: int) -> IntArray:
    """The cells (m,) from begin to goal by their parents."""
    count, cell = 1, goal
    while cell != begin:
        cell = parent[cell]
        count += 1
    path = np.empty(count, dtype=np.int64)
    cell = goal
    for i in range(count - 1, -1, -1):
        path[i] = cell
        cell = parent[cell]
    return path


def padded(free: ByteArray) -> ByteArray:
    """The grid (nx, ny, nz) with a border of blocked cells, so that no search has to look for the grid's end."""
    return np.pad(free, 1)


def flat(cell: IntArray, shape: tuple[int, ...]) -> int:
    """Index of a cell (3,) of a grid in the flattened padded grid of that shape."""
    return int(np.ravel_multi_index(tuple(int(c) + 1 for c in cell), shape))


def shortest(free: ByteArray, start: IntArray, goal: IntArray) -> tuple[IntArray, float, int]:
    """A shortest way through free cells.

    Parameters
    ----------
    free : (nx, ny, nz)     1 where a cell is free, 0 where it is blocked.
    start, goal : (3,)      free cells.

    Returns
    -------
    cells (m, 3) from start to goal, m = 0 when there is no way; the length in cell widths; the cells expanded.
    """
    room = padded(free)
    _, ny, nz = room.shape
    begin, end = flat(start, room.shape), flat(goal, room.shape)
    path, length, expanded = search(room.ravel(), begin, end, ny * nz, nz)
    cells: IntArray = np.stack(np.unravel_index(path, room.shape), axis=1).astype(np.int64) - 1
    return cells, length, expanded
