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

import numpy as np

from planner.barrier import BAND, FLOOR, PAD, barrier, derivatives, newton_system
from planner.bspline import FloatArray
from planner.jit import kernel, leaf

FIRST, FASTER = 30.0, 10.0
"""t begins where the gap is 1/FIRST of the duration, and grows by this factor."""
IDLE = 1.0
"""A stage ends when a step lowers the barrier by less: a duration of the gap over the number of constraints."""
WIDER = 1.02
"""s beyond what the limits need at least, while it is above 1."""
EVEN_WIDE = 1.0
"""Meanwhile the evenness weighs no more than this."""
HALVINGS = 20
"""Of a step, before none is taken."""


@leaf
def largest(X: FloatArray, first: int, end: int) -> float:
    """Largest |X_i|^2 of rows first .. end - 1."""
    most = 0.0
    for i in range(first, end):
        most = max(most, X[i, 0] * X[i, 0] + X[i, 1] * X[i, 1] + X[i, 2] * X[i, 2])
    return most


@leaf
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


@leaf
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
        newton_system(e, rate, even, t, V, A, J, squared, held, g, H)
        decrement = _solve(H, g, step)
        before = barrier(e, rate, even, t, V, A, J, squared, held)
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
            after = barrier(new, rate, even, t, V, A, J, squared, held)
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
