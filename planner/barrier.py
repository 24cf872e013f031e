"""The barrier function of a spline's knot intervals, and its Newton system: see `intervals` for what they are for.

Arrays of intervals e (m + 4,) have two zeros before the first and after the last, so that the formulas hold at the ends
as they stand. V (m + 2, 3), A (m + 1, 3), J (m, 3) are the control points of velocity, acceleration and jerk; `rate`
(m,) is one over each interval's first value, `squared` (3,) the limits' squares, `held` (2,) 1 where the first, the
last two intervals are held: what they determine is then no constraint.
"""

import math

import numpy as np

from planner.bspline import FloatArray
from planner.jit import kernel, leaf

PAD = 2
"""Intervals of zero before the first and after the last, so that the formulas hold at the ends as they stand."""
FLOOR = 1e-3
"""f_i as a fraction of an interval's first value."""
FLOOR_WEIGHT = 0.05
BAND = 5
"""Diagonals kept of the symmetric Hessian: row i holds its columns i .. i + 4."""


@leaf
def derivatives(points: FloatArray, e: FloatArray, V: FloatArray, A: FloatArray, J: FloatArray) -> None:
    """Write the control points of velocity, acceleration and jerk for padded intervals e (m + 4,) [s]."""
    m = e.size - 2 * PAD
    for i in range(m + 2):
        s = 3.0 / (e[i] + e[i + 1] + e[i + 2])
        for k in range(3):
            V[i, k] = (points[i + 1, k] - points[i, k]) * s
    for i in range(m + 1):
        s = 2.0 / (e[i + 1] + e[i + 2])
        for k in range(3):
            A[i, k] = (V[i + 1, k] - V[i, k]) * s
    for i in range(m):
        s = 1.0 / e[i + 2]
        for k in range(3):
            J[i, k] = (A[i + 1, k] - A[i, k]) * s


@leaf
def _log_room(X: FloatArray, first: int, end: int, squared: float) -> float:
    """sum log(1 - |X_i|^2 / limit^2), -inf when a limit is reached."""
    total = 0.0
    for i in range(first, end):
        room = 1.0 - (X[i, 0] * X[i, 0] + X[i, 1] * X[i, 1] + X[i, 2] * X[i, 2]) / squared
        if not room > 1e-14:
            return -np.inf
        total += math.log(room)
    return total


@leaf
def barrier(
    e: FloatArray,
    rate: FloatArray,
    evenness: float,
    t: float,
    V: FloatArray,
    A: FloatArray,
    J: FloatArray,
    squared: FloatArray,
    held: tuple[int, int],
) -> float:
    """The barrier's value, inf outside; `rate` (m,) is one over each interval's first value."""
    m = rate.size
    total = -_log_room(V, 2 * held[0], m + 2 - 2 * held[1], squared[0])
    total -= _log_room(A, held[0], m + 1 - held[1], squared[1])
    total -= _log_room(J, 0, m, squared[2])
    before = e[PAD] * rate[0]
    for i in range(m):
        r = e[i + PAD] * rate[i]
        if not r > FLOOR:
            return np.inf
        total += t * e[i + PAD] - FLOOR_WEIGHT * math.log(r - FLOOR) + 0.5 * (evenness * (r - before)) ** 2
        before = r
    return total


@kernel
def newton_system(
    e: FloatArray,
    rate: FloatArray,
    evenness: float,
    t: float,
    V: FloatArray,
    A: FloatArray,
    J: FloatArray,
    squared: FloatArray,
    held: tuple[int, int],
    g: FloatArray,
    H: FloatArray,
) -> None:
    """Gradient g (m + 4,) and Gauss-Newton Hessian H (m + 4, BAND) of the barrier; held intervals get rows of I."""
    m, v2, a2, j2 = rate.size, squared[0], squared[1], squared[2]
    dA, before, dJ, dc = np.zeros((4, 3)), np.zeros((4, 3)), np.empty((5, 3)), np.empty(5)
    H[:, :] = 0.0
    g[:] = 0.0
    for i in range(m):
        over = FLOOR_WEIGHT * rate[i] / (e[i + PAD] * rate[i] - FLOOR)
        g[i + PAD] += t - over
        H[i + PAD, 0] += over * over / FLOOR_WEIGHT
        if i + 1 < m:
            w0, w1 = evenness * rate[i], evenness * rate[i + 1]
            d = e[i + PAD] * w0 - e[i + PAD + 1] * w1
            g[i + PAD] += d * w0
            g[i + PAD + 1] -= d * w1
            H[i + PAD, 0] += w0 * w0
            H[i + PAD + 1, 0] += w1 * w1
            H[i + PAD, 1] -= w0 * w1
    for i in range(2 * held[0], m + 2 - 2 * held[1]):  # c = K / S^2, S the sum of three intervals: exact
        S = e[i] + e[i + 1] + e[i + 2]
        c = (V[i, 0] * V[i, 0] + V[i, 1] * V[i, 1] + V[i, 2] * V[i, 2]) / v2
        r = 1.0 / (1.0 - c)
        slope = -2.0 * c / S * r
        w = slope * slope + 6.0 * c / (S * S) * r
        for p in range(3):
            g[i + p] += slope
            for q in range(3 - p):
                H[i + p, q] += w
    for i in range(m + 1):
        s = 2.0 / (e[i + 1] + e[i + 2])
        s0, s1 = s / (e[i] + e[i + 1] + e[i + 2]), s / (e[i + 1] + e[i + 2] + e[i + 3])
        c = 0.0
        for k in range(3):  # dA_i by the intervals i .. i + 3 of the padded ones: two velocities and the denominator
            for p in range(4):
                before[p, k] = dA[p, k]
            low, high, own = V[i, k] * s0, -V[i + 1, k] * s1, -0.5 * s * A[i, k]
            dA[0, k], dA[1, k], dA[2, k], dA[3, k] = low, low + high + own, low + high + own, high
            c += A[i, k] * A[i, k]
        if held[0] <= i < m + 1 - held[1]:
            r = 1.0 / (1.0 - c / a2)
            f = 2.0 * r / a2
            for p in range(4):
                dc[p] = f * (A[i, 0] * dA[p, 0] + A[i, 1] * dA[p, 1] + A[i, 2] * dA[p, 2])
            for p in range(4):
                g[i + p] += dc[p]
                for q in range(p, 4):
                    square = dA[p, 0] * dA[q, 0] + dA[p, 1] * dA[q, 1] + dA[p, 2] * dA[q, 2]
                    H[i + p, q - p] += dc[p] * dc[q] + f * square
        if i == 0:
            continue
        b = i - 1  # J_b = (A_i - A_b) / D_b
        s = 1.0 / e[b + PAD]
        c = 0.0
        for k in range(3):
            dJ[0, k] = -before[0, k] * s
            dJ[1, k] = (dA[0, k] - before[1, k]) * s
            dJ[2, k] = (dA[1, k] - before[2, k] - J[b, k]) * s
            dJ[3, k] = (dA[2, k] - before[3, k]) * s
            dJ[4, k] = dA[3, k] * s
            c += J[b, k] * J[b, k]
        f = 2.0 / (j2 - c)
        for p in range(5):
            dc[p] = f * (J[b, 0] * dJ[p, 0] + J[b, 1] * dJ[p, 1] + J[b, 2] * dJ[p, 2])
        for p in range(5):
            g[b + p] += dc[p]
            for q in range(p, 5):
                square = dJ[p, 0] * dJ[q, 0] + dJ[p, 1] * dJ[q, 1] + dJ[p, 2] * dJ[q, 2]
                H[b + p, q - p] += dc[p] * dc[q] + f * square
    for i in range(m + 2 * PAD):
        if PAD + 2 * held[0] <= i < m + PAD - 2 * held[1]:
            continue
        g[i] = 0.0
        H[i, :] = 0.0
        H[i, 0] = 1.0
        for q in range(1, min(BAND, i + 1)):
            H[i - q, q] = 0.0
