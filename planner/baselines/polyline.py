"""A polyline as a motion: A* and JPS, flown as they are.

A corner B is three equal control points: the curve passes it exactly, and there its first and second derivative vanish,
so a vehicle stops, turns and starts again. Four neighbouring control points never belong to two legs' insides, so the
curve is the polyline and nothing but it.

A leg of length L is run from rest to rest with jerk j, acceleration a, speed v at most, the "double S" (Biagiotti &
Melchiorri, Trajectory Planning for Automatic Machines and Robots, sec. 3.4):

    T_j = min(a/j, sqrt(v/j)),  T_a = T_j + v/a if the acceleration is reached, else 2 T_j
    T = L/v + T_a if L >= v T_a, else twice T_a of the highest speed that L has room for

Its control points are the places at even times. Their first, second and third differences are means of speed,
acceleration and jerk, so on even knots they keep the limits too; timing only has to make it faster.
"""

import math
from collections.abc import Iterator

import numpy as np

from planner.baselines import astar, jps
from planner.baselines.legs import leg_by_leg
from planner.baselines.route import Shortest, route
from planner.bspline import DEGREE, FloatArray, clamped_knots
from planner.limits import Limits
from planner.query import Query
from planner.shape import Effort, Shape

INTERVALS = 120
"""Knot intervals of the whole way, the stops and a few for rounding apart."""
SHORTEST = 1e-9
"""Least length of a leg [m]; what is shorter is standing still."""


def phases(length: float, limits: Limits) -> tuple[FloatArray, FloatArray]:
    """(jerks [m/s^3], durations [s]) of the seven phases of the fastest run from rest to rest over a length [m]."""
    v, a, j = limits.speed, limits.acceleration, limits.jerk
    if a > math.sqrt(v * j):  # the speed is reached before the acceleration
        tj, ta = math.sqrt(v / j), 2.0 * math.sqrt(v / j)
    else:
        tj, ta = a / j, a / j + v / a
    cruise = length / v - ta
    if cruise < 0.0:  # the speed is not reached
        cruise = 0.0
        if length >= 2.0 * a**3 / j**2:
            tj = a / j
            ta = 0.5 * tj + math.sqrt(0.25 * tj * tj + length / a)
        else:
            tj = (length / (2.0 * j)) ** (1.0 / 3.0)
            ta = 2.0 * tj
    flat = max(ta - 2.0 * tj, 0.0)
    return np.array([j, 0.0, -j, 0.0, -j, 0.0, j]), np.array([tj, flat, tj, cruise, tj, flat, tj])


def run(length: float, limits: Limits, share: FloatArray) -> FloatArray:
    """Ways gone (m,) as shares of a length [m] after these shares (m,) of the fastest run's time."""
    jerks, durations = phases(length, limits)
    starts = np.concatenate([[0.0], np.cumsum(durations)])
    states = np.zeros((len(jerks) + 1, 3))  # way, speed, acceleration
    for k, (jerk, t) in enumerate(zip(jerks, durations, strict=True)):
        s, v, a = states[k]
        states[k + 1] = s + t * (v + t * (a / 2.0 + t * jerk / 6.0)), v + t * (a + t * jerk / 2.0), a + t * jerk
    times = share * starts[-1]
    k = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, len(jerks) - 1)
    t, (s, v, a) = times - starts[k], states[k].T
    ways: FloatArray = np.clip((s + t * (v + t * (a / 2.0 + t * jerks[k] / 6.0))) / states[-1, 0], 0.0, 1.0)
    return ways


def stopping(corners: FloatArray, limits: Limits) -> FloatArray:
    """Control points (n, 3) of the polyline through corners (m, 3) [m], at rest at each."""
    lengths = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    times = np.array([phases(max(length, SHORTEST), limits)[1].sum() for length in lengths])
    counts = np.maximum(np.ceil(times / times.sum() * INTERVALS), 1).astype(int)
    points = [np.repeat(corners[:1], DEGREE, axis=0)]
    for a, b, length, count in zip(corners[:-1], corners[1:], lengths, counts, strict=True):
        ways = run(max(length, SHORTEST), limits, np.arange(1, count) / count)
        points += [a + ways[:, None] * (b - a), np.repeat(b[None], DEGREE, axis=0)]
    return np.concatenate(points)


def shape_of(corners: FloatArray, limits: Limits) -> Shape:
    """The polyline through corners (m, 3) [m] as a shape. It is not judged by the cost, so its terms are no numbers."""
    if len(corners) == 1:
        corners = np.repeat(corners, 2, axis=0)
    points = stopping(corners, limits)
    return Shape(points, clamped_knots(len(points)), math.nan, math.nan, math.nan, turns_on_spot=len(corners) > 2)


def _along(shortest: Shortest, query: Query, effort: Effort) -> Iterator[Shape]:
    yield shape_of(route(query, effort, shortest), query.limits)


def _astar(query: Query, effort: Effort) -> Iterator[Shape]:
    return _along(astar.shortest, query, effort)


def _jps(query: Query, effort: Effort) -> Iterator[Shape]:
    return _along(jps.shortest, query, effort)


find_astar = leg_by_leg("astar", _astar)
find_jps = leg_by_leg("jps", _jps)
