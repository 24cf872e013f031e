"""Where in a map to look: around the question first, in all of it when that shows nothing.

Grids have a bounded number of cells. Over a map of kilometres these are metres wide, and a way of eighteen metres found
on them is half as long again as it need be; so what is far from the question is left out as long as it is not needed.
"""

import numpy as np

from planner.bspline import FloatArray

ROOM = 20.0
"""Least room left around a question on each side [m]; as much as the question is long, when that is more."""
WORTH = 2.0
"""A map that is less than this many times as large as the surroundings is looked at as a whole."""

TINY = 1e-9
"""What a side of a map counts for at least [m]: less the radius on both sides, there may be nothing left of it."""


def surroundings(walls: FloatArray, points: FloatArray) -> FloatArray:
    """The part (2, 3) of a map that is around points; all of it unless it is far larger [m].

    Parameters
    ----------
    walls : (2, 3)      corners of the map [m].
    points : (m, 3)     start, via points, goal [m].
    """
    low, high = points.min(axis=0), points.max(axis=0)
    room = max(ROOM, float(np.linalg.norm(high - low)))
    near: FloatArray = np.clip(np.array([low - room, high + room]), walls[0], walls[1])
    share = np.prod(np.maximum(near[1] - near[0], TINY) / np.maximum(walls[1] - walls[0], TINY))
    return near if share * WORTH < 1.0 else walls


def places(walls: FloatArray, points: FloatArray) -> list[FloatArray]:
    """Where to look in turn: the surroundings (2, 3) of points (m, 3), then all of the map if that is more [m]."""
    near = surroundings(walls, points)
    return [near] if near is walls else [near, walls]
