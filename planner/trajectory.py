"""A planned motion: where to be, how fast, and how hard to push, at any time.

Each span is kept as its Taylor polynomial about the span's first knot, so that the flight loop pays a few
microseconds a call, in plain floats.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from planner.bspline import DEGREE, FloatArray, check_knots, refine
from planner.errors import KnotError
from planner.jit import kernel

_GAUSS = np.polynomial.legendre.leggauss(12)
Polynomial = tuple[tuple[float, float, float, float], ...]  # one row an axis: x, x', x''/2, x'''/6 at the span's start


@dataclass(frozen=True, slots=True)
class State:
    """Position [m], velocity [m/s] and acceleration [m/s^2] at one time, each (3,), in the world's frame."""

    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray


class Measures(NamedTuple):
    """What a motion is like as a whole."""

    length: float  # arc length [m]
    curvature_max: float  # |C' x C''| / |C'|^3, sampled where the speed is above 1 % of its peak [1/m]
    jerk_integral: float  # int |jerk|^2 dt, exact: the jerk is constant on each span [m^2/s^5]


@dataclass(frozen=True, slots=True, eq=False)
class Trajectory:
    """A clamped cubic B-spline over time, starting at t = 0.

    Parameters
    ----------
    control_points : (n, 3)   [m].
    knots : (n + 4,)          clamped, from 0 to the duration, interior knots simple [s].

    `position`, `velocity`, `acceleration` and `jerk` take a scalar t [s] and give (3,), or t (m,) and give (m, 3).
    t is clamped to [0, duration]; NaN raises ValueError. Jerk is piecewise constant; at a knot the later piece counts.

    Raises
    ------
    KnotError : knots that do not fit the control points, or do not start at 0.
    ValueError : control points that are not finite numbers of shape (n, 3).
    """

    control_points: FloatArray
    knots: FloatArray
    _spans: tuple[Polynomial, ...] = field(init=False, repr=False)
    _starts: tuple[float, ...] = field(init=False, repr=False)
    _table: FloatArray = field(init=False, repr=False)  # (spans, 3, 4), the same numbers as _spans

    def __post_init__(self) -> None:
        points = np.array(self.control_points, dtype=np.float64)
        knots = np.array(self.knots, dtype=np.float64)
        if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
            raise ValueError(f"control points: expected finite numbers of shape (n, 3), found shape {points.shape}")
        check_knots(knots, len(points))
        if knots[0] != 0.0:
            raise KnotError(f"a trajectory starts at 0 s, found first knot {knots[0]:g}")
        starts = knots[DEGREE : len(points)]
        table = taylor(points, knots)
        for name, value in (("control_points", points), ("knots", knots), ("_table", table)):
            object.__setattr__(self, name, value)
        object.__setattr__(self, "_starts", tuple(starts.tolist()))
        object.__setattr__(self, "_spans", tuple(tuple(map(tuple, span)) for span in table.tolist()))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Trajectory):
            return NotImplemented
        return np.array_equal(self.control_points, other.control_points) and np.array_equal(self.knots, other.knots)

    def __hash__(self) -> int:
        return hash((self.control_points.tobytes(), self.knots.tobytes()))

    @property
    def duration(self) -> float:
        """[s]."""
        return float(self.knots[-1])

    @property
    def length(self) -> float:
        """Arc length [m]."""
        return self.measures().length

    def measures(self) -> Measures:
        """Length, largest curvature and the integral of the squared jerk."""
        return Measures(*_measure(self._table, self.knots, *_GAUSS))

    def state(self, t: float) -> State:
        """Position, velocity and acceleration at t [s], scalar; the cheapest way to ask for all three."""
        if t != t:
            raise ValueError("t: expected a number of seconds, found NaN")
        t = min(max(float(t), 0.0), self._last())
        i = bisect_right(self._starts, t) - 1
        s = t - self._starts[i]
        x, v, a = [], [], []
        for c0, c1, c2, c3 in self._spans[i]:
            x.append(c0 + s * (c1 + s * (c2 + s * c3)))
            v.append(c1 + s * (2.0 * c2 + s * 3.0 * c3))
            a.append(2.0 * c2 + 6.0 * s * c3)
        return State(np.array(x), np.array(v), np.array(a))

    def position(self, t: ArrayLike) -> FloatArray:
        """[m]."""
        return self._evaluate(t, 0)

    def velocity(self, t: ArrayLike) -> FloatArray:
        """[m/s]."""
        return self._evaluate(t, 1)

    def acceleration(self, t: ArrayLike) -> FloatArray:
        """[m/s^2]."""
        return self._evaluate(t, 2)

    def jerk(self, t: ArrayLike) -> FloatArray:
        """[m/s^3]."""
        return self._evaluate(t, 3)

    def after(self, t: float) -> "Trajectory":
        """The remainder from t [s] on, as a trajectory whose own time starts there: the same curve on the same knots.

        Raises
        ------
        ValueError : t is not a number from 0 up to, but not including, the duration.
        """
        if not 0.0 <= t < self.duration:
            raise ValueError(f"t: expected from 0 s to less than {self.duration} s, found {t}")
        inside = self.knots[self.knots > t]
        knots = np.concatenate([np.full(DEGREE + 1, t), inside])
        return Trajectory(refine(self.control_points, self.knots, knots), knots - t)

    def then(self, other: "Trajectory") -> "Trajectory":
        """This one, then another that begins with the position, velocity and acceleration that this one ends with.

        The knot between them is simple, so only one control point is new. It is the blossom f(a, T, T + b) of the
        other's first piece, with a and T + b the knots beside it; in the first argument that is affine, f(T, ..) = P_1
        and f(T + c, ..) = P_2 with T + c the knot after T + b.
        """
        p, q, u, w = self.control_points, other.control_points, self.knots, other.knots
        n, end = len(p), self.duration
        new = q[1] + (u[n - 1] - end) / w[DEGREE + 2] * (q[2] - q[1])
        points = np.concatenate([p[: n - 2], new[None], q[2:]])
        return Trajectory(points, np.concatenate([u[: n + 1], w[DEGREE + 1 :] + end]))

    def _last(self) -> float:
        return float(self.knots[-1])

    def _evaluate(self, t: ArrayLike, derivative: int) -> FloatArray:
        """Horner's rule on the span of each time; the factors are those of the k-th derivative of s^j."""
        times = np.asarray(t, dtype=np.float64)
        if np.isnan(times).any():
            raise ValueError("t: expected seconds, found NaN")
        u = np.clip(np.atleast_1d(times), 0.0, self._last())
        i = np.searchsorted(self._starts, u, side="right") - 1
        c, s = self._table[i], (u - np.take(self._starts, i))[:, None]
        value = np.zeros((len(u), 3))
        for j in range(DEGREE, derivative - 1, -1):
            value = value * s + math.perm(j, derivative) * c[:, :, j]
        return value.reshape(*times.shape, 3)


@kernel
def taylor(points: FloatArray, knots: FloatArray) -> FloatArray:
    """x, x', x''/2, x'''/6 at the start of each span (n - 3, 3, 4), by de Boor's recursion there."""
    spans = points.shape[0] - DEGREE
    table, d = np.empty((spans, 3, 4)), np.empty(4)
    for i in range(spans):
        u = knots[i + 3]
        for axis in range(3):
            for q in range(4):
                d[q] = points[i + q, axis]
            factor = 1.0
            for k in range(4):  # d holds the k-th derivative's 4 - k control points of this span
                p = 3 - k
                e0, e1, e2, e3 = d[0], d[1], d[2], d[3]
                for r in range(1, p + 1):
                    for q in range(p, r - 1, -1):
                        left, right = knots[i + k + q], knots[i + 4 + q - r]
                        alpha = (u - left) / (right - left)
                        d[q] = (1.0 - alpha) * d[q - 1] + alpha * d[q]
                table[i, axis, k] = d[p] / factor
                d[0], d[1], d[2], d[3] = e0, e1, e2, e3
                for q in range(p):
                    d[q] = p * (d[q + 1] - d[q]) / (knots[i + 4 + q] - knots[i + 1 + k + q])
                factor *= k + 1
    return table


@kernel
def _measure(
    table: FloatArray, knots: FloatArray, nodes: FloatArray, weights: FloatArray
) -> tuple[float, float, float]:
    """(length, largest curvature, integral of the squared jerk) of the spans in `table`, by Gauss's rule on each."""
    length, jerk, fastest = 0.0, 0.0, 0.0
    speed, v, w = np.empty((table.shape[0], nodes.size)), np.empty(3), np.empty(3)
    for i in range(table.shape[0]):
        h = knots[i + 4] - knots[i + 3]
        for a in range(3):
            jerk += h * (6.0 * table[i, a, 3]) ** 2
        for g in range(nodes.size):
            s, square = 0.5 * h * (1.0 + nodes[g]), 0.0
            for a in range(3):
                c = table[i, a, 1] + s * (2.0 * table[i, a, 2] + s * 3.0 * table[i, a, 3])
                square += c * c
            speed[i, g] = math.sqrt(square)
            fastest = max(fastest, speed[i, g])
            length += 0.5 * h * weights[g] * speed[i, g]
    curvature = 0.0
    for i in range(table.shape[0]):
        h = knots[i + 4] - knots[i + 3]
        for g in range(nodes.size):
            if not speed[i, g] > 0.01 * fastest:
                continue
            s = 0.5 * h * (1.0 + nodes[g])
            for a in range(3):
                v[a] = table[i, a, 1] + s * (2.0 * table[i, a, 2] + s * 3.0 * table[i, a, 3])
                w[a] = 2.0 * table[i, a, 2] + 6.0 * s * table[i, a, 3]
            x, y, z = v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]
            curvature = max(curvature, math.sqrt(x * x + y * y + z * z) / speed[i, g] ** 3)
    return length, curvature, jerk
