"""A planned motion: where to be, how fast, and how hard to push, at any time.

Each span is kept as its Taylor polynomial about the span's first knot, so that the flight loop pays a few
microseconds a call, in plain floats, with nothing to compile.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from planner.bspline import DEGREE, FloatArray, arc_length, check_knots, derivative_control_points, evaluate
from planner.errors import KnotError

Polynomial = tuple[tuple[float, float, float, float], ...]  # one row an axis: x, x', x''/2, x'''/6 at the span's start


@dataclass(frozen=True, slots=True)
class State:
    """Position [m], velocity [m/s] and acceleration [m/s^2] at one time, each (3,), in the world's frame."""

    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray


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
        table = np.empty((len(starts), 3, DEGREE + 1))
        p, u = points, knots
        for k in range(DEGREE + 1):
            table[:, :, k] = evaluate(p, u, starts, DEGREE - k) / math.factorial(k)
            if k < DEGREE:
                p, u = derivative_control_points(p, u, DEGREE - k), u[1:-1]
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
        return arc_length(self.control_points, self.knots)

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
