"""Jump point search in three dimensions: as short as A* on the same grid, with fewer entries in the heap.

D. Harabor, A. Grastien, "Online graph pruning for pathfinding on grid maps", AAAI 2011, in the plane; three dimensions
as S. Liu et al., "Planning dynamically feasible trajectories for quadrotors using safe flight corridors in 3-D complex
environments", IEEE RA-L 2 (2017) have it. Which neighbours are pruned is derived here from one rule, not listed.

Reach x from p by the move d, go on to n = x + e. Drop n when p leads there around x, by one move, or by two (first m,
then the rest) that are shorter than d + e, or as long with m along more axes than d. Then every pair of moves left on
the best of all shortest ways, the one that goes diagonal first, is kept (it can have no such replacement), so the
search finds a shortest way. In free space only the moves along some of d's own axes survive ("natural"); the others
need every such m blocked ("forced"). A move is repeated until it meets the goal, a cell with a forced neighbour, or
one from which a natural side move does ("jump"). Cells reached equally short by different moves are expanded for each,
since they prune differently: that makes it exact. Moves may cut corners, as A*'s (see `grid`).
"""

from typing import NamedTuple

import numpy as np

from planner.baselines.astar import flat, padded, trace
from planner.baselines.grid import ByteArray, IntArray
from planner.baselines.heap import FIRST, STEPS, TIE, estimate, pop, push
from planner.jit import kernel

MOVES = np.array([(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if x or y or z])
AXES = np.abs(MOVES).sum(axis=1)
"""How many axes a move goes along."""
_NONE = len(MOVES)  # the move that led to the start


def _natural(d: IntArray) -> list[int]:
    """Moves along some of d's own axes, d included, those along more axes first."""
    found = [k for k, e in enumerate(MOVES) if ((e == 0) | (e == d)).all()]
    return sorted(found, key=lambda k: -AXES[k])


def _around(d: IntArray, e: IntArray) -> list[IntArray]:
    """First moves m of the ways of two moves that make d + e needless, as offsets from x (so m - d)."""
    length, found = STEPS[np.abs(d).sum() - 1] + STEPS[np.abs(e).sum() - 1], []
    for m in MOVES:
        rest = d + e - m
        if (m == d).all() or not rest.any() or np.abs(rest).max() > 1 or np.abs(m - d).max() > 1:
            continue
        other = STEPS[np.abs(m).sum() - 1] + STEPS[np.abs(rest).sum() - 1]
        more = np.abs(m).sum() > np.abs(d).sum()
        if other < length - TIE or (other < length + TIE and more):
            found.append(m - d)
    return found


def _forced() -> list[list[tuple[int, list[IntArray]]]]:
    """For each move d: the moves e that may be forced, with the offsets that must all be blocked for it."""
    table = []
    for d in MOVES:
        natural = _natural(d)
        rows = [(k, e) for k, e in enumerate(MOVES) if k not in natural and np.abs(d + e).max() > 1]
        table.append([(k, _around(d, e)) for k, e in rows])
    return table


NATURAL = [_natural(d) for d in MOVES]
FORCED = _forced()


class Rules(NamedTuple):
    """The pruning rules, for one grid's strides."""

    step: IntArray  # (26,) what a move adds to a flat index
    axes: IntArray  # (26,)
    natural: IntArray  # (26, 7) moves, -1 where there are fewer
    forced: IntArray  # (26, k) moves that may be forced, -1 where there are fewer
    blockers: IntArray  # (26, k, j) offsets that must be blocked for it, 0 (x itself, free) never stands there
    counts: IntArray  # (26, k) how many


def _filled(rows: list[list[int]]) -> IntArray:
    width = max(map(len, rows))
    return np.array([row + [-1] * (width - len(row)) for row in rows], dtype=np.int64)


def rules(stride_x: int, stride_y: int) -> Rules:
    """The rules for a grid whose flat index grows by stride_x, stride_y and 1 along x, y and z."""
    strides = np.array([stride_x, stride_y, 1])
    most = max(len(row) for row in FORCED)
    widest = max(len(offsets) for row in FORCED for _, offsets in row)
    blockers, counts = (
        np.zeros((len(MOVES), most, widest), dtype=np.int64),
        np.zeros((len(MOVES), most), dtype=np.int64),
    )
    for d, row in enumerate(FORCED):
        for k, (_, offsets) in enumerate(row):
            counts[d, k] = len(offsets)
            blockers[d, k, : len(offsets)] = np.array(offsets) @ strides
    return Rules(
        step=(MOVES @ strides).astype(np.int64),
        axes=AXES.astype(np.int64),
        natural=_filled(NATURAL),
        forced=_filled([[e for e, _ in row] for row in FORCED]),
        blockers=blockers,
        counts=counts,
    )


@kernel
def mark_crowded(free: ByteArray, crowded: ByteArray, r: Rules, nx: int, ny: int, nz: int) -> None:
    """Write 1 where a cell has a blocked neighbour inside the grid: elsewhere nothing is forced.

    The border does not count: for every e that may be forced, one blocker is in the box between p and n.
    """
    for x in range(1, nx - 1):
        for y in range(1, ny - 1):
            for z in range(1, nz - 1):
                cell = (x * ny + y) * nz + z
                if not free[cell]:
                    for k in range(26):
                        crowded[cell + r.step[k]] = 1


@kernel
def is_forced(free: ByteArray, cell: int, d: int, k: int, r: Rules) -> bool:
    """Whether the k-th neighbour that may be forced behind move d is."""
    if not free[cell + r.step[r.forced[d, k]]]:
        return False
    for j in range(r.counts[d, k]):  # noqa: SIM110 compiled
        if free[cell + r.blockers[d, k, j]]:
            return False
    return True


@kernel
def has_forced(free: ByteArray, cell: int, d: int, r: Rules) -> bool:
    """Whether any neighbour is forced behind move d."""
    for k in range(r.forced.shape[1]):
        if r.forced[d, k] < 0:
            break
        if is_forced(free, cell, d, k, r):
            return True
    return False


@kernel
def jump_line(free: ByteArray, crowded: ByteArray, cell: int, d: int, goal: int, r: Rules) -> tuple[int, int]:
    """(jump point or -1, moves to it) along one axis."""
    step, count = r.step[d], 0
    while True:
        cell += step
        count += 1
        if not free[cell]:
            return -1, 0
        if cell == goal or (crowded[cell] and has_forced(free, cell, d, r)):
            return cell, count


@kernel
def jump_plane(free: ByteArray, crowded: ByteArray, cell: int, d: int, goal: int, r: Rules) -> tuple[int, int]:
    """The same along two axes; also where a move along one of them has a jump point."""
    step, count, first, second = r.step[d], 0, r.natural[d, 1], r.natural[d, 2]
    while True:
        cell += step
        count += 1
        if not free[cell]:
            return -1, 0
        if cell == goal or (crowded[cell] and has_forced(free, cell, d, r)):
            return cell, count
        if jump_line(free, crowded, cell, first, goal, r)[0] >= 0:
            return cell, count
        if jump_line(free, crowded, cell, second, goal, r)[0] >= 0:
            return cell, count


@kernel
def jump(free: ByteArray, crowded: ByteArray, cell: int, d: int, goal: int, r: Rules) -> tuple[int, int]:
    """The same along one, two or three axes."""
    if r.axes[d] == 1:
        return jump_line(free, crowded, cell, d, goal, r)
    if r.axes[d] == 2:
        return jump_plane(free, crowded, cell, d, goal, r)
    step, count = r.step[d], 0
    while True:
        cell += step
        count += 1
        if not free[cell]:
            return -1, 0
        if cell == goal or (crowded[cell] and has_forced(free, cell, d, r)):
            return cell, count
        for k in range(4, 7):
            if jump_line(free, crowded, cell, r.natural[d, k], goal, r)[0] >= 0:
                return cell, count
        for k in range(1, 4):
            if jump_plane(free, crowded, cell, r.natural[d, k], goal, r)[0] >= 0:
                return cell, count


@kernel
def search(
    free: ByteArray, crowded: ByteArray, begin: int, goal: int, stride_x: int, stride_y: int, r: Rules
) -> tuple[IntArray, float, int]:
    """(jump points' flat indices (m,) from begin to goal, length in cell widths, entries expanded); see `astar`."""
    cost = np.full(free.shape[0], np.inf)
    parent = np.full(free.shape[0], -1, dtype=np.int64)
    queued = np.zeros(free.shape[0], dtype=np.int64)  # a bit for each move by which a cell was reached at its cost
    keys, items, size = np.empty(FIRST), np.empty(FIRST, dtype=np.int64), 0
    cost[begin] = 0.0
    keys, items, size = push(keys, items, size, estimate(begin, goal, stride_x, stride_y), begin * 27 + 26)
    moves = np.empty(27, dtype=np.int64)
    expanded = 0
    while size > 0:
        key, item = keys[0], items[0]
        size = pop(keys, items, size)
        cell, d = item // 27, item % 27
        if cell == goal:
            break
        if key > cost[cell] * (1.0 - TIE) + estimate(cell, goal, stride_x, stride_y) + TIE:
            continue  # an older, dearer entry
        expanded += 1
        count = 0
        if d == 26:
            for k in range(26):
                moves[count] = k
                count += 1
        else:
            for k in range(7):
                if r.natural[d, k] >= 0:
                    moves[count] = r.natural[d, k]
                    count += 1
            if crowded[cell]:
                for k in range(r.forced.shape[1]):
                    if r.forced[d, k] >= 0 and is_forced(free, cell, d, k, r):
                        moves[count] = r.forced[d, k]
                        count += 1
        for k in range(count):
            e = moves[k]
            other, steps = jump(free, crowded, cell, e, goal, r)
            if other < 0:
                continue
            moved = cost[cell] + steps * STEPS[r.axes[e] - 1]
            if moved < cost[other] - TIE:
                cost[other], parent[other], queued[other] = moved, cell, 0
            elif moved > cost[other] + TIE:
                continue
            if not (queued[other] >> e) & 1:
                queued[other] |= 1 << e
                key = cost[other] * (1.0 - TIE) + estimate(other, goal, stride_x, stride_y)
                keys, items, size = push(keys, items, size, key, other * 27 + e)
    if cost[goal] == np.inf:
        return np.empty(0, dtype=np.int64), np.inf, expanded
    return trace(parent, begin, goal), cost[goal], expanded


def shortest(free: ByteArray, start: IntArray, goal: IntArray) -> tuple[IntArray, float, int]:
    """A shortest way through free cells, as `astar.shortest`, but the cells returned are those where it turns."""
    room = padded(free)
    nx, ny, nz = room.shape
    table = rules(ny * nz, nz)
    cells, crowded = room.ravel(), np.zeros(room.size, dtype=np.uint8)
    mark_crowded(cells, crowded, table, nx, ny, nz)
    begin, end = flat(start, room.shape), flat(goal, room.shape)
    path, length, expanded = search(cells, crowded, begin, end, ny * nz, nz, table)
    found: IntArray = np.stack(np.unravel_index(path, room.shape), axis=1).astype(np.int64) - 1
    return found, length, expanded
