"""Getting out of the way: as hard as the limits allow in some direction, then to rest.

The acceleration of a cubic spline is linear between knots, so what the limits allow can be written down: from a_0 it
goes with the full jerk to the full acceleration in a direction d, for a while, and then through three more intervals
t_1, t_2, t_3 to B, along B, and to 0, where

    v + (a + B)/2 t_1 + B t_2 + B/2 t_3 = 0,  so  B = -(v + a t_1/2)/(t_1/2 + t_2 + t_3/2)

brings the vehicle to rest; t_2 is the shortest (to STEP) with which B keeps the limit. Without a push this is the
straight stop. Where the speed would pass its limit, the push is turned along the sphere of velocities.
"""

import math

import numpy as np

from planner.bspline import FloatArray
from planner.jit import kernel, leaf
from planner.warm import Ask, Found, judge

STEP = 0.05
"""Of the times of the push and of t_2 [s]."""
FULL = 0.98
"""Part of each limit that is used; what is left is for the control points' hull."""
PUSHES = (0, 3, 6, 10)
"""Lengths of the push, in STEPs."""
MOST = 80
"""Most STEPs of t_2: what takes longer to stop is not stopped here."""


@leaf
def _toward(a: FloatArray, target: FloatArray, most: float) -> None:
    """Move a (3,) toward the target by `most` at most."""
    d = math.sqrt((target[0] - a[0]) ** 2 + (target[1] - a[1]) ** 2 + (target[2] - a[2]) ** 2)
    f = 1.0 if d <= most else most / d
    for c in range(3):
        a[c] += f * (target[c] - a[c])


@kernel
def dash(state: FloatArray, direction: FloatArray, pushes: int, limits: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Control points and knots of a push of that many STEPs, then a stop; empty when MOST is not enough.

    state (3, 3): position, velocity, acceleration; direction (3,) a unit vector, or 0.
    """
    top, push, snap = FULL * limits[0], FULL * limits[1], FULL * limits[2]
    spans = pushes + 3
    knots, a, v = np.zeros(spans + 7), np.empty((spans + 1, 3)), state[1].copy()
    a[0] = state[2]
    now, target = state[2].copy(), np.empty(3)
    for i in range(pushes):
        speed = 0.0
        for c in range(3):
            target[c] = v[c] + STEP * push * direction[c]
            speed += target[c] * target[c]
        turn = min(1.0, top / math.sqrt(speed)) if speed > 0.0 else 1.0
        for c in range(3):
            target[c] = (turn * target[c] - v[c]) / STEP
        size = math.sqrt(target[0] ** 2 + target[1] ** 2 + target[2] ** 2)
        if size > push:
            target *= push / size
        before = now.copy()
        _toward(now, target, snap * STEP)
        a[i + 1] = now
        for c in range(3):
            v[c] += 0.5 * (before[c] + now[c]) * STEP
        knots[i + 4] = (i + 1) * STEP
    t1, t2, t3, b = 0.02, 0.0, 0.02, np.zeros(3)
    for k in range(MOST + 1):
        t2 = max(k * STEP, 0.01)
        for _ in range(8):  # t_1 and t_3 depend on B and B on them
            size, change = 0.0, 0.0
            for c in range(3):
                b[c] = -(v[c] + now[c] * t1 / 2.0) / (t1 / 2.0 + t2 + t3 / 2.0)
                size += b[c] * b[c]
                change += (b[c] - now[c]) ** 2
            t1, t3 = max(0.02, math.sqrt(change) / snap), max(0.02, math.sqrt(size) / snap)
        size, change = 0.0, 0.0
        for c in range(3):
            b[c] = -(v[c] + now[c] * t1 / 2.0) / (t1 / 2.0 + t2 + t3 / 2.0)
            size += b[c] * b[c]
            change += (b[c] - now[c]) ** 2
        size, change = math.sqrt(size), math.sqrt(change)
        if size <= push and change <= 1.01 * snap * t1 and size <= 1.01 * snap * t3:  # 1.01 FULL is below 1
            break
    else:
        return np.empty((0, 3)), knots
    a[pushes + 1], a[pushes + 2], a[pushes + 3] = b, b, 0.0
    end = pushes * STEP
    knots[pushes + 4], knots[pushes + 5] = end + t1, end + t1 + t2
    knots[pushes + 6 :] = end + t1 + t2 + t3
    points, velocity = np.empty((spans + 3, 3)), state[1].copy()
    points[0] = state[0]
    for i in range(spans + 2):  # A_i = 2 (V_{i+1} - V_i)/..., V_i = 3 (P_{i+1} - P_i)/...
        for c in range(3):
            points[i + 1, c] = points[i, c] + velocity[c] * (knots[i + 4] - knots[i + 1]) / 3.0
            if i <= spans:
                velocity[c] += a[i, c] * (knots[i + 4] - knots[i + 2]) / 2.0
    return points, knots


@kernel
def escape(ask: Ask, state: FloatArray, begin: float, hold: float, directions: FloatArray, enough: float) -> Found:
    """The dash that keeps farthest from movers; the first that is proved and keeps `enough` [m] ends the search.

    The straight stop is tried first, then directions (m, 3). `begin` and `hold` as in `warm`.
    """
    best_points, best_knots = np.empty((0, 3)), np.empty(0)
    best, best_clear, best_mover, best_when, tried = -np.inf, False, -1, 0.0, 0
    for pushes in PUSHES:
        for k in range(directions.shape[0] if pushes > 0 else 1):
            points, knots = dash(state, directions[k], pushes, ask.limits)
            if points.shape[0] == 0:
                continue
            tried += 1
            free, within, passed, distance, mover, when = judge(ask, points, knots, 0.0, begin, hold)
            if not (free and within) or (best_clear and not passed):
                continue
            if distance > best or (passed and not best_clear):
                best_points, best_knots = points, knots
                best, best_clear, best_mover, best_when = distance, passed, mover, when
            if passed and distance >= enough:
                return Found(points, knots, True, True, distance, mover, when, tried)
    return Found(best_points, best_knots, best > -np.inf, best_clear, best, best_mover, best_when, tried)
