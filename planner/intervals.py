"""Shortest knot intervals of a cubic spline under its limits, control points given.

With D_i the knot intervals, and P_i the control points, the derivatives' control points are

    V_i = 3 (P_{i+1} - P_i) / (D_{i-2} + D_{i-1} + D_i)      intervals beyond the ends count as 0
    A_i = 2 (V_{i+1} - V_i) / (D_{i-1} + D_i)
    J_i =   (A_{i+1} - A_i) / D_i

which are what `limits` proves the limits on. So the fastest run is the least sum of D_i with |V_i| <= v, |A_i| <= a,
|J_i| <= j: no samples, and what is optimised is what is proved. A logarithmic barrier (Nocedal & Wright, Numerical
Optimization, 2nd ed., sec. 19.6) keeps every step strictly inside:

    t sum D_i - sum log(1 - c_k(D)) - FLOOR_WEIGHT sum log(D_i - f_i) + (r_i - r_{i+1})^2 evenness^2 / 2 summed

c_k = |X_k|^2 / limit^2 of every control point, r_i = D_i over its first value. The third term keeps knots apart where
nothing else does (standing still), the last lets the rate change gradually: the control polygon stays, so the curve
moves a little where neighbouring intervals change differently. Newton's method with the Gauss-Newton part of the
barrier's Hessian (nine diagonals: J_i has a part in five intervals), for t growing until the constraints' share of the
duration, their number over t, is below the gap wanted.

Intervals may be held, two at an end: they fix the velocity and the acceleration there. Then no scaling makes a
feasible start; the limits are widened, v s, a s^2, j s^3, and s is shrunk to 1 as the steps permit.
"""

import math

import numpy as np

from planner.bspline import FloatArray
from planner.jit import kernel

PAD = 2
"""Intervals of zero before the first and after the last, so that the formulas hold at the ends as they stand."""
FLOOR = 1e-3
"""f_i as a fraction of an interval's first value."""
FLOOR_WEIGHT = 0.05
FIRST, FASTER = 30.0, 10.0
"""t begins where the gap is 1/FIRST of the duration, and grows by this factor."""
IDLE = 1.0
"""A stage ends when a step lowers the barrier by less; that is worth a gap's fraction of one over the constraints."""
WIDER = 1.02
"""s beyond what the limits need at least, while it is above 1."""
EVEN_WIDE = 1.0
"""Meanwhile the evenness weighs no more than this."""
HALVINGS = 20
"""Of a step, before none is taken."""
BAND = 5
"""Diagonals kept of the symmetric Hessian: row i holds its columns i .. i + 4."""


@kernel
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


@kernel
def largest(X: FloatArray, first: int, end: int) -> float:
    """Largest |X_i|^2 of rows first .. end - 1."""
    most = 0.0
    for i in range(first, end):
        most = max(most, X[i, 0] * X[i, 0] + X[i, 1] * X[i, 1] + X[i, 2] * X[i, 2])
    return most


@kernel
def _log_room(X: FloatArray, first: int, end: int, squared: float) -> float:
    """sum log(1 - |X_i|^2 / limit^2), -inf when a limit is reached."""
    total = 0.0
    for i in range(first, end):
        room = 1.0 - (X[i, 0] * X[i, 0] + X[i, 1] * X[i, 1] + X[i, 2] * X[i, 2]) / squared
        if not room > 1e-14:
            return -np.inf
        total += math.log(room)
    return total


@kernel
def _barrier(
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
def _newton_system(
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


@kernel
def _solve(H: FloatArray, g: FloatArray, step: FloatArray) -> float:
    """H step = g by banded elimination, H and g overwritten; returns g . step, NaN when H is not positive."""
    n, decrement = g.size, 0.0
    for i in range(n):
        if not H[i, 0] > 0.0:
            return np.nan
        decrement += g[i] * g[i] / H[i, 0]
        end = min(BAND, n - i)
        for q in range(1, end):
            f = H[i, q] / H[i, 0]
            for r in range(q, end):
                H[i + q, r - q] -= f * H[i, r]
            g[i + q] -= f * g[i]
    for i in range(n - 1, -1, -1):
        x = g[i]
        for q in range(1, min(BAND, n - i)):
            x -= H[i, q] * step[i + q]
        step[i] = x / H[i, 0]
    return decrement


@kernel
def stretch_needed(V: FloatArray, A: FloatArray, J: FloatArray, limits: FloatArray, held: tuple[int, int]) -> float:
    """By what factor time would have to be stretched for the limits (3,) to hold, of what is not held."""
    m = J.shape[0]
    v = largest(V, 2 * held[0], m + 2 - 2 * held[1]) ** 0.5 / limits[0]
    a = largest(A, held[0], m + 1 - held[1]) ** 0.25 / limits[1] ** 0.5
    j = largest(J, 0, m) ** (1.0 / 6.0) / limits[2] ** (1.0 / 3.0)
    needed: float = max(v, max(a, j))
    return needed


@kernel
def stretch_of(points: FloatArray, e: FloatArray, limits: FloatArray) -> float:
    """By what factor padded intervals e (m + 4,) would have to be stretched for the limits (3,) to hold."""
    m = e.size - 2 * PAD
    V, A, J = np.empty((m + 2, 3)), np.empty((m + 1, 3)), np.empty((m, 3))
    derivatives(points, e, V, A, J)
    needed: float = stretch_needed(V, A, J, limits, (0, 0))
    return needed


@kernel
def shorten(
    points: FloatArray,
    e: FloatArray,
    limits: FloatArray,
    held: tuple[int, int],
    evenness: float,
    gap: float,
    most: int,
) -> tuple[float, int]:
    """Shorten the intervals in place. (stretch that the limits still ask for: below 1 when they hold, steps taken).

    Parameters
    ----------
    points : (m + 3, 3)       control points.
    e : (m + 4,)              intervals, two zeros at each end.
    limits : (3,)             speed, acceleration, jerk.
    held : (int, int)         1 where the first, the last two intervals are held, else 0.
    evenness : float          weight of an even rate.
    gap : float               wanted, as a fraction of the duration.
    most : int                Newton steps.
    """
    m = e.size - 2 * PAD
    V, A, J = np.empty((m + 2, 3)), np.empty((m + 1, 3)), np.empty((m, 3))
    H, g, step, new = np.empty((m + 2 * PAD, BAND)), np.empty(m + 2 * PAD), np.empty(m + 2 * PAD), e.copy()
    rate, squared = 1.0 / e[PAD : m + PAD], np.empty(3)
    total, count = np.sum(e), 3.0 * m
    t, last = FIRST * count / total, count / (gap * total)
    derivatives(points, e, V, A, J)
    wide = stretch_needed(V, A, J, limits, held)
    even = evenness
    if wide >= 1.0:
        wide *= WIDER
        t, even = 0.1 * count / total, min(evenness, EVEN_WIDE)
    else:
        wide = 1.0
    taken = 0
    while taken < most:
        taken += 1
        for k in range(3):
            squared[k] = (limits[k] * wide ** (k + 1)) ** 2
        _newton_system(e, rate, even, t, V, A, J, squared, held, g, H)
        decrement = _solve(H, g, step)
        before = _barrier(e, rate, even, t, V, A, J, squared, held)
        if not (decrement > 0.0 and before < np.inf):
            break
        part, after = 1.0, np.inf
        for i in range(PAD, m + PAD):
            if step[i] > 0.0:
                part = min(part, 0.95 * (e[i] - FLOOR / rate[i - PAD]) / step[i])
        for halving in range(HALVINGS + 1):
            if halving == HALVINGS:
                part = 0.0  # back to where it was
            for i in range(PAD, m + PAD):
                new[i] = e[i] - part * step[i]
            derivatives(points, new, V, A, J)
            after = _barrier(new, rate, even, t, V, A, J, squared, held)
            if after <= before - 1e-4 * part * decrement:
                break
            part *= 0.5
        e[:] = new
        if wide > 1.0:
            narrower = WIDER * stretch_needed(V, A, J, limits, held)
            if not narrower < wide and before - after < IDLE:
                break
            wide = min(wide, narrower)
            if narrower <= WIDER:
                wide, t, even = 1.0, count / np.sum(e), evenness
            continue
        if not before - after >= IDLE:
            if t >= last:
                break
            t = min(FASTER * t, last)
    return stretch_needed(V, A, J, limits, held), taken
