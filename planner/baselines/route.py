"""From one end to the other over free cells: what A* and JPS say, as corners in space."""

import math
from collections.abc import Callable

import numpy as np

from planner import errors
from planner.baselines.grid import ByteArray, IntArray, build, cell_of, sees, widths
from planner.bspline import FloatArray
from planner.enclosure import PITCHES, apart
from planner.query import Query
from planner.shape import Effort
from planner.surroundings import places

Shortest = Callable[[ByteArray, IntArray, IntArray], tuple[IntArray, float, int]]
"""`astar.shortest` or `jps.shortest`."""
STRAIGHT = 1e-9
"""How far [m] a point may be beside a line to count as on it."""


def route(query: Query, effort: Effort, shortest: Shortest) -> FloatArray:
    """Corners (m, 3) [m] from start to goal along the widest cells that show a way; every leg keeps the radius.

    In a large map the surroundings of the ends are looked at first (see `surroundings`).

    Raises
    ------
    NoPathFound : the narrowest cells show none either.
    """
    world, radius = query.world, query.radius
    tried = [
        (place, width)
        for place in places(world.walls, np.array([query.start, query.goal]))
        for width in widths(place[1] - place[0])
    ]
    for place, width in tried:
        grid = build(world, query.start, radius, width, place)
        first = cell_of(grid, world, radius, query.start)
        last = cell_of(grid, world, radius, query.goal)
        if first is None or last is None:
            continue
        cells, _, expanded = shortest(grid.free, first, last)
        effort.iterations += expanded
        if len(cells):
            centres = grid.centres(cells)
            corners = straightened(np.concatenate([query.start[None], centres, query.goal[None]]))
            # The ends' cells are the grid's doing: leave one out where the end is seen from what comes next.
            if len(corners) > 2 and at(corners[-2], centres[-1]) and sees(world, radius, corners[-3], corners[-1]):
                corners = np.delete(corners, -2, axis=0)
            if len(corners) > 2 and at(corners[1], centres[0]) and sees(world, radius, corners[0], corners[2]):
                corners = np.delete(corners, 1, axis=0)
            return corners
    width = min(width for _, width in tried)
    closed = apart(world, query.start, query.goal, radius, PITCHES)
    raise errors.NoPathFound(effort.tried, effort.evaluations, math.inf, radius, math.inf, width, proved=closed)


def at(a: FloatArray, b: FloatArray) -> bool:
    """Whether two points (3,) are the same place."""
    return bool(np.linalg.norm(a - b) <= STRAIGHT)


def straightened(points: FloatArray) -> FloatArray:
    """The corners (m, 3) of a polyline: without points that repeat the one before or lie on the way to the next."""
    kept = [points[0]]
    for point in points[1:]:
        if np.linalg.norm(point - kept[-1]) <= STRAIGHT:
            continue
        while len(kept) > 1:
            before, along = kept[-1] - kept[-2], point - kept[-2]
            beside = np.linalg.norm(np.cross(before, along)) / np.linalg.norm(along) if along.any() else math.inf
            if beside > STRAIGHT or before @ (point - kept[-1]) < 0.0:
                break
            kept.pop()
        kept.append(point)
    if len(kept) > 1:
        kept[-1] = points[-1]
    return np.array(kept)
