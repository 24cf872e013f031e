"""First guesses: a fan of bows from start to goal, so that the search begins on every side of the obstacles.

The paper perturbs each control point independently (Eq. 43: P_init + epsilon). Such curves all pass the obstacles on
the same side; on an L or a U no method then finds the way round. Here the perturbations are correlated along the
curve: bows A sin(pi s) in the plane frame of the line (e1 along it, e2 level, e3 the third), one side after the
other, amplitudes in even steps up to the room there is; then random mixtures of the first sine modes, which are the
soft modes of the stretch.
"""

import numpy as np

from planner.bspline import FloatArray
from planner.cost import FIXED
from planner.nearby import IntArray
from planner.query import Query

SIDE = 6
"""Bows on each level side."""
MODES = 3


def plane_frame(start: FloatArray, goal: FloatArray) -> FloatArray:
    """Rows e1, e2, e3 (3, 3): along the line, level and square to it, and square to both (up or down)."""
    along = goal - start
    length = float(np.linalg.norm(along))
    e1 = along / length if length > 0.0 else np.array([1.0, 0.0, 0.0])
    level = np.array([-e1[1], e1[0], 0.0])
    size = float(np.linalg.norm(level))
    e2 = level / size if size > 1e-6 else np.array([0.0, 1.0, 0.0])
    (a, b, c), (d, e, f) = e1.tolist(), e2.tolist()
    e3 = np.array([b * f - c * e, c * d - a * f, a * e - b * d])
    return np.array([e1, e2, e3 / np.linalg.norm(e3)])


def _room(point: FloatArray, direction: FloatArray, lower: FloatArray, upper: FloatArray) -> float:
    """How far one can go from a point inside a box along a unit direction."""
    ways = [
        ((upper[a] if direction[a] > 0 else lower[a]) - point[a]) / direction[a]
        for a in range(3)
        if abs(direction[a]) > 1e-9
    ]
    return max(float(min(ways)), 0.0)


def fan(
    start: FloatArray,
    goal: FloatArray,
    lower: FloatArray,
    upper: FloatArray,
    n: int,
    count: int,
    generator: np.random.Generator,
) -> FloatArray:
    """Free control points of `count` seeds, from the straight line outward.

    Parameters
    ----------
    start, goal : (3,)      [m].
    lower, upper : (3,)     where control points may be: the map less the radius [m].
    n : int                 control points of the whole spline.
    count : int             seeds wanted; beyond the bows they are random.

    Returns
    -------
    (count, 3 (n - 6))      [m].
    """
    f = n - 2 * FIXED
    s = np.arange(1, f + 1) / (f + 1)
    line = start + s[:, None] * (goal - start)
    _, e2, e3 = plane_frame(start, goal)
    middle = (start + goal) / 2
    longest = max(0.75 * float(np.linalg.norm(goal - start)), 1.0)
    sides = [(e, min(_room(middle, e, lower, upper), longest)) for e in (e2, -e2, e3, -e3)]
    farthest = [e * room for e, room in sides]
    offsets = [np.zeros(3)]
    for k in range(SIDE):
        part = (k + 1) / SIDE
        offsets += [farthest[0] * part, farthest[1] * part]
        if k in (SIDE // 2 - 1, SIDE - 1):
            offsets += [farthest[2] * part, farthest[3] * part]
    bow = np.sin(np.pi * s)
    bows = line + bow[:, None] * np.array(offsets[:count])[:, None, :]  # (bows, f, 3)
    modes = np.sin(np.pi * np.arange(1, MODES + 1)[:, None] * s)  # (MODES, f)
    fall = 1.0 / np.arange(1, MODES + 1)
    waves = generator.standard_normal((count - len(bows), 2, MODES)) * fall @ modes  # (others, 2, f)
    room = 0.5 * np.array([max(sides[0][1], sides[1][1]), max(sides[2][1], sides[3][1])])
    others = line + np.einsum("sef,ea->sfa", waves, room[:, None] * np.array([e2, e3]))
    seeds: FloatArray = np.clip(np.concatenate([bows, others]), lower, upper).reshape(count, 3 * f)
    return seeds


def fan_through(
    corners: FloatArray,
    lower: FloatArray,
    upper: FloatArray,
    at: IntArray,
    n: int,
    count: int,
    generator: np.random.Generator,
) -> FloatArray:
    """`count` seeds (count, 3 (n - 6)) through via points: each leg has its own fan, mixed by chance but for the first.

    Parameters
    ----------
    corners : (m + 2, 3)    start, via points, goal [m].
    at : (m,)               free control points nearest to the via points; those get the points themselves.
    """
    f = n - 2 * FIXED
    seeds = np.empty((count, f, 3))
    firsts = np.concatenate([[0], at + 1])
    ends = np.concatenate([at, [f]])
    for leg, (first, end) in enumerate(zip(firsts, ends, strict=True)):
        few = int(end - first)
        rows = fan(corners[leg], corners[leg + 1], lower, upper, few + 2 * FIXED, count, generator)
        order = np.arange(count)
        if leg > 0:
            order[count // 4 :] = count // 4 + generator.permutation(count - count // 4)
        seeds[:, first:end] = rows[order].reshape(count, few, 3)
        if end < f:
            seeds[:, end] = corners[leg + 1]
    return seeds.reshape(count, 3 * f)


def swerve(query: Query, n: int, length: float) -> FloatArray:
    """What moving ends add to a seed (3 (n - 6),) [m]: quintic terms that start with a velocity or an acceleration.

    Velocity along the way, up to its mean, is what evenly spaced seeds have anyway.
    """
    f = n - 2 * FIXED
    s = (np.arange(1, f + 1) / (f + 1))[:, None]
    T = query.duration(length)
    mean = (query.goal - query.start) / T
    first, last = _beyond(query.start_velocity, mean), _beyond(query.goal_velocity, mean)
    added: FloatArray = (
        T * first * (s - 6 * s**3 + 8 * s**4 - 3 * s**5)
        + 0.5 * T**2 * query.start_acceleration * (s**2 - 3 * s**3 + 3 * s**4 - s**5)
        + T * last * (-4 * s**3 + 7 * s**4 - 3 * s**5)
    )
    return added.ravel()


def _beyond(velocity: FloatArray, mean: FloatArray) -> FloatArray:
    """A velocity less its part along `mean`, which counts from none to all of it."""
    square = float(mean @ mean)
    share = min(max(float(velocity @ mean) / square, 0.0), 1.0) if square > 0.0 else 0.0
    rest: FloatArray = velocity - share * mean
    return rest


def along_path(path: FloatArray, n: int) -> FloatArray:
    """Free control points (3 (n - 6),) spaced evenly along a polyline (m, 3) [m]."""
    f = n - 2 * FIXED
    s = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    where = np.arange(1, f + 1) / (f + 1) * s[-1]
    return np.stack([np.interp(where, s, path[:, a]) for a in range(3)], axis=1).ravel()
