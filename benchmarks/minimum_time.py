"""An oracle: the least time in which a path can be run from rest to rest. Shares no code with the planner.

On a path p(s), s the arc length, with q = v^2 as a function of s:

    a = q'/2                                                            along the path
    |acceleration|^2 = k^2 q^2 + (q'/2)^2                               k^2 = |p''|^2
    |jerk|^2         = q |p'''_n q + 3/2 p'' q'|^2 + q (p'''_t q + q''/2)^2
    time             = int ds / sqrt(q)

(the chain rule; p'''_n is the part of p''' across the path, p'''_t = -k^2 that along it). Central differences over a
grid that is fine where the path begins and ends at rest; a logarithmic barrier and Newton's method on the values of q.
From rest without acceleration v <= j t^2/2 where s = j t^3/6, which bounds q near the ends, where differences see
nothing. The error falls with the grid, from above: 0.1 % at 800 cells on a line (`main` of `bench_timing` prints it).
"""

import numpy as np
from scipy.interpolate import BSpline
from scipy.linalg import solveh_banded


class Path:
    """Arc length (N + 1,) on a grid, and p'' and p'''_n (N - 1, 3) at its inner nodes."""

    def __init__(self, s: np.ndarray, second: np.ndarray, across: np.ndarray) -> None:
        self.s, self.second, self.across = s, second, across

    @classmethod
    def of_spline(cls, knots: np.ndarray, points: np.ndarray, cells: int) -> "Path":
        """The path of a clamped cubic spline over time; the nodes are even in its time."""
        c, T = BSpline(knots, points, 3), knots[-1]
        t = np.linspace(0.0, T, cells + 1)
        nodes, weights = np.polynomial.legendre.leggauss(5)
        inner = t[:-1, None] + np.diff(t)[:, None] * (nodes + 1) / 2
        way = (np.linalg.norm(c(inner, 1), axis=2) @ weights) * np.diff(t) / 2
        v, a = c(t[1:-1], 1), c(t[1:-1], 2)
        j = (c(t[1:-1] - 1e-9 * T, 3) + c(t[1:-1] + 1e-9 * T, 3)) / 2  # it may jump there
        speed = np.linalg.norm(v, axis=1, keepdims=True)
        along = v / speed
        faster = (a * along).sum(axis=1, keepdims=True)
        second = (a - faster * along) / speed**2
        across = j - 3 * second * speed * faster
        across -= (across * along).sum(axis=1, keepdims=True) * along
        return cls(np.concatenate([[0.0], np.cumsum(way)]), second, across / speed**3)


def least_time(path: Path, speed: float, acceleration: float, jerk: float, gap: float = 1e-4) -> float:
    """[s]."""
    s, N = path.s, len(path.s) - 1
    k2 = (path.second**2).sum(axis=1)
    n2, cross = (path.across**2).sum(axis=1), (path.across * path.second).sum(axis=1)
    away = np.minimum(s, s[-1] - s)[1:-1]
    top = np.minimum(speed**2, (jerk / 2) ** 2 * (6 * away / jerk) ** (4 / 3))
    # derivatives by s through the node's number: q ~ s^(4/3) near a rest, which no polynomial in s follows
    s1, s2 = (s[2:] - s[:-2]) * N / 2, (s[2:] - 2 * s[1:-1] + s[:-2]) * N * N
    one = np.ones(N - 1)
    d0 = np.array([0 * one, one, 0 * one])
    d1 = np.array([-N / 2 * one, 0 * one, N / 2 * one]) / s1
    d2 = (np.array([N * N * one, -2.0 * N * N * one, N * N * one]) - d1 * s2) / s1**2
    w = s1 / N
    w[[0, -1]] *= 1.5  # the outermost half cells, in which ds/sqrt(q) is about even

    def terms(q: np.ndarray) -> tuple[np.ndarray, ...]:
        rows = np.array([q[:-2], q[1:-1], q[2:]])
        Q, q1, q2 = ((d * rows).sum(axis=0) for d in (d0, d1, d2))
        along = q2 / 2 - k2 * Q
        square = n2 * Q**2 + 3 * cross * Q * q1 + 2.25 * k2 * q1**2 + along**2
        used = np.array([Q / top, (k2 * Q**2 + q1**2 / 4) / acceleration**2, Q * square / jerk**2])
        return Q, q1, along, square, used

    def barrier(q: np.ndarray, t: float) -> float:
        if (q[1:-1] <= 0).any():
            return np.inf
        Q, *_, used = terms(q)
        return np.inf if used.max() >= 1 else t * (w / np.sqrt(Q)).sum() - np.log1p(-used).sum()

    q = np.concatenate([[0.0], s1**2, [0.0]])  # the grid's own run, slowed until it is inside
    while not terms(q)[-1].max() < 0.7:
        q *= 0.8
    T = (w / np.sqrt(q[1:-1])).sum()
    t, last = 3 * N / T, 3 * N / (gap * T)
    for _ in range(500):
        Q, q1, along, square, used = terms(q)
        d_along, d_square = d2 / 2 - k2 * d0, 2 * n2 * Q * d0 + 3 * cross * (d0 * q1 + Q * d1) + 4.5 * k2 * q1 * d1
        d_square = d_square + 2 * along * d_along
        slopes = (
            d0 / top,
            (2 * k2 * Q * d0 + q1 / 2 * d1) / acceleration**2,
            (d0 * square + Q * d_square) / jerk**2,
        )
        g, H = np.zeros(N + 1), np.zeros((3, N + 1))
        g[1:-1] = -0.5 * t * w * Q**-1.5
        H[0, 1:-1] = 0.75 * t * w * Q**-2.5
        for a in range(3):
            for k in range(3):
                g[a : N - 1 + a] += slopes[k][a] / (1 - used[k])
            for b in range(a, 3):
                bend_a = (2 * k2 * d0[a] * d0[b] + d1[a] * d1[b] / 2) / acceleration**2
                bend_j = 2 * n2 * d0[a] * d0[b] + 3 * cross * (d0[a] * d1[b] + d0[b] * d1[a])
                bend_j = (bend_j + 4.5 * k2 * d1[a] * d1[b] + 2 * d_along[a] * d_along[b]) * Q / jerk**2
                both = bend_a / (1 - used[1]) + bend_j / (1 - used[2])
                both = both + sum(slopes[k][a] * slopes[k][b] / (1 - used[k]) ** 2 for k in range(3))
                H[b - a, a : N - 1 + a] += both
        bands = np.zeros((3, N - 1))
        bands[0], bands[1, :-1], bands[2, :-2] = H[0, 1:-1], H[1, 1:-2], H[2, 1:-3]
        step = np.zeros(N + 1)
        step[1:-1] = solveh_banded(bands, g[1:-1], lower=True)
        gain, part, now = step @ g, 1.0, barrier(q, t)
        while barrier(q - part * step, t) > now - 1e-4 * part * gain and part > 1e-9:
            part /= 2
        if part > 1e-9:
            q = q - part * step
        if part <= 1e-9 or gain < 0.05:
            if t >= last:
                break
            t = min(4 * t, last)
    return float((w / np.sqrt(q[1:-1])).sum())


def straight(length: float, speed: float, acceleration: float, jerk: float) -> float:
    """Closed form on a line: seven phases of constant jerk, or fewer (the double S)."""

    def ramp(v: float) -> float:
        return v / acceleration + acceleration / jerk if v * jerk >= acceleration**2 else 2 * (v / jerk) ** 0.5

    if ramp(speed) * speed <= length:
        return 2 * ramp(speed) + (length - ramp(speed) * speed) / speed
    low, high = 0.0, speed
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if ramp(middle) * middle < length else (low, middle)
    return 2 * ramp(low)


def line(length: float, cells: int) -> Path:
    """A straight path whose grid is cubic at its ends."""
    u = np.linspace(0.0, 1.0, cells + 1)
    zero = np.zeros((cells - 1, 3))
    return Path(length * (10 * u**3 - 15 * u**4 + 6 * u**5), zero, zero)


def arc(radius: float, angle: float, cells: int) -> Path:
    """Part of a circle, on the same grid."""
    path = line(radius * angle, cells)
    phi = path.s[1:-1] / radius
    inward = -np.stack([np.cos(phi), np.sin(phi), 0 * phi], axis=1) / radius
    return Path(path.s, inward, np.zeros_like(inward))
