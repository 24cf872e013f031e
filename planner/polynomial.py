"""Polynomial initialisation: a first curve from quintics between waypoints (Eq. 12-20).

Waypoints stand on the line from start to goal, no farther apart than d_c; between two of them a polynomial of degree
five meets position, velocity and acceleration at both ends; a clamped spline is then fitted to it:

    m   = floor(d_z/d_c) + 1  if d_z > d_c,  else 2                                     Eq. 12, its condition restored
    x_n = (1 - n/m) x_0 + (n/m) x_N,   n = 0 .. m                                       Eq. 13, printed "1/(m x_N)"
    F   = A^-1 B,   B = (x_0, v_0, a_0, x_n, v_n, a_n)                                  Eq. 14 ("B/A"), 15
    A   : rows t^5 .. 1 of x, v, a at 0 and at t; its first rows are [0 0 0 0 0 1], [0 0 0 0 1 0], [0 0 0 2 0 0]
                                                                                        Eq. 16, shifted in print
    t_n = |x_{n+1} - x_n|/v_max, twice that in the first and the last segment           Eq. 17, its norm restored
    x(t) = (t^5, t^4, t^3, t^2, t, 1) F                                                 Eq. 18, the order restored

Eq. 18's step to control points is not computable as printed; it is a least-squares fit to samples here, with position,
velocity and acceleration at both ends held. Eq. 19 and 20 are the chain rule, dP/dt = P_s s'(t), which `bspline` has in
its knots.

At a waypoint between two segments the velocity is v_max along the way and the acceleration zero, so that the first
segment, twice as long as at full speed, is just the rise from rest to v_max at half of it on average. The paper fixes a
waypoint's speed nowhere.
"""

import math
from dataclasses import dataclass

import numpy as np

from planner.bspline import DEGREE, FloatArray, basis, clamped_knots, end_control_points

_SAMPLES = 8
"""Samples a span that the spline is fitted to."""


@dataclass(frozen=True, slots=True, eq=False)
class Quintics:
    """Quintic segments one after the other."""

    coefficients: FloatArray  # (m, 6, 3) F of Eq. 14, highest power first
    times: FloatArray  # (m + 1,) where segments begin, and the end [s]

    @property
    def duration(self) -> float:
        """[s]."""
        return float(self.times[-1])

    def evaluate(self, t: FloatArray, derivative: int = 0) -> FloatArray:
        """Position or derivative (k, 3) at t (k,), clamped to the range (Eq. 18)."""
        u = np.clip(t, 0.0, self.duration)
        i = np.clip(np.searchsorted(self.times, u, side="right") - 1, 0, len(self.coefficients) - 1)
        s = (u - self.times[i])[:, None]
        value = np.zeros((len(u), 3))
        for j in range(5, derivative - 1, -1):
            value = value * s + math.perm(j, derivative) * self.coefficients[i, 5 - j]
        return value


def waypoints(start: FloatArray, goal: FloatArray, spacing: float) -> FloatArray:
    """(m + 1, 3) points on the line, both ends included, so many that none is farther than `spacing` from the next."""
    gaps = np.abs(goal - start)  # d_z: "the maximum singular value" of a difference is its norm
    d_z = float(np.linalg.norm(gaps))
    m = math.floor(d_z / spacing) + 1 if d_z > spacing else 2  # Eq. 12
    n = np.arange(m + 1)[:, None]
    points: FloatArray = (1.0 - n / m) * start + (n / m) * goal  # Eq. 13
    return points


def segment_times(points: FloatArray, speed: float) -> FloatArray:
    """Durations (m,) of the segments between waypoints (m + 1, 3), at `speed` [m/s] (Eq. 17)."""
    times: FloatArray = np.linalg.norm(np.diff(points, axis=0), axis=1) / speed
    times[0] *= 2.0
    if len(times) > 1:
        times[-1] *= 2.0
    return times


def quintic(begin: FloatArray, end: FloatArray, t: float) -> FloatArray:
    """Coefficients F (6, 3), highest power first, of the segment from `begin` to `end` in t [s] (Eq. 14-16).

    Parameters
    ----------
    begin, end : (3, 3)   rows position, velocity, acceleration.
    """
    powers = np.arange(5, -1, -1)
    A = np.zeros((6, 6))
    A[0, 5], A[1, 4], A[2, 3] = 1.0, 1.0, 2.0  # Eq. 16, its first rows one column further right than printed
    for row, k in enumerate(range(3), start=3):
        A[row] = [math.perm(p, k) * t ** (p - k) if p >= k else 0.0 for p in powers]
    scale = t ** powers.astype(np.float64)  # columns of one size, so that short and long segments solve alike
    solved: FloatArray = np.linalg.solve(A / scale, np.concatenate([begin, end])) / scale[:, None]  # Eq. 14
    return solved


def quintics(begin: FloatArray, end: FloatArray, speed: float, spacing: float) -> Quintics:
    """The polynomial curve between two states, each (3, 3) with rows position, velocity, acceleration.

    Parameters
    ----------
    speed : float     at the waypoints in between, along the line [m/s].
    spacing : float   d_c, between waypoints at most [m].
    """
    points = waypoints(begin[0], end[0], spacing)
    length = float(np.linalg.norm(end[0] - begin[0]))
    along = (end[0] - begin[0]) / length if length > 0.0 else np.zeros(3)
    durations = np.maximum(segment_times(points, speed), 1e-3)
    states = [begin, *(np.array([p, speed * along, np.zeros(3)]) for p in points[1:-1]), end]
    F = [quintic(a, b, t) for a, b, t in zip(states, states[1:], durations, strict=False)]
    return Quintics(np.array(F), np.concatenate([[0.0], np.cumsum(durations)]))


def fit(curve: Quintics, n: int) -> FloatArray:
    """Control points (n, 3) of the clamped spline nearest to the curve, on `clamped_knots(n, curve.duration)`.

    Position, velocity and acceleration at both ends are the curve's; the n - 6 points between are the least-squares
    solution over evenly spaced samples.
    """
    T = curve.duration
    knots = clamped_knots(n, T)
    ends = [curve.evaluate(np.array([0.0, T]), k) for k in range(3)]
    points = np.zeros((n, 3))
    points[:DEGREE] = end_control_points(ends[0][0], ends[1][0], ends[2][0], knots)
    points[-DEGREE:] = end_control_points(ends[0][1], -ends[1][1], ends[2][1], T - knots[::-1])[::-1]
    t = (np.arange(_SAMPLES * (n - DEGREE)) + 0.5) / (_SAMPLES * (n - DEGREE)) * T
    N = basis(knots, n, t)
    free = slice(DEGREE, n - DEGREE)
    points[free] = np.linalg.lstsq(N[:, free], curve.evaluate(t) - N @ points, rcond=None)[0]
    return points
