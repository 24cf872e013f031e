"""Uniform cubic B-splines in the paper's own words (Eq. 1-11), and the way to clamped ones.

On uniform knots every span has the same four basis functions of s in [0, 1] (the paper's "fourth order" is degree 3):

    P_i(s) = sum_j f_j(s) C_{i+j}                           Eq. 1 with k = 4, Eq. 3;   f of Eq. 2
    V_i    = (1/dt)   sum_j v_j(s) C_{i+j},   v = df/ds      Eq. 4, 8, the printed Eq. 8 has no time scale
    A_i    = (1/dt^2) sum_j a_j(s) C_{i+j},   a = dv/ds      Eq. 5, 9, likewise

Eq. 6 prints v_2 = s^2 - 2 s and v_3 = -s^2 + s + 1/2, which are not the derivatives of Eq. 2 and do not lead to Eq. 7:

    v_2 = 3/2 s^2 - 2 s,    v_3 = -3/2 s^2 + s + 1/2

Such a curve does not reach its first control point. Eq. 10 and 11 put one more on each side of an end c passed with
velocity v and no acceleration; both signs of Eq. 10 are printed minus, and L, "an appropriate constant", has to be dt:

    c_before = c - v dt,   c_after = c + v dt

for then (c_before + 4 c + c_after)/6 = c and (c_after - c_before)/(2 dt) = v.

Plans are clamped splines (Eq. 21, `bspline`); `clamped` gives the same curve in that form.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from planner.bspline import DEGREE, FloatArray, clamped_knots, refine

_POWERS = (
    np.array([[1.0, -3.0, 3.0, -1.0], [4.0, 0.0, -6.0, 3.0], [1.0, 3.0, 3.0, -3.0], [0.0, 0.0, 0.0, 1.0]])
    / 6.0  # Eq. 2
)
"""Row j: coefficients of 1, s, s^2, s^3 of f_j. Eq. 6 and 7 are its derivatives."""


def basis(s: ArrayLike, derivative: int = 0) -> FloatArray:
    """The four basis functions of Eq. 2 (derivative 0), the mended Eq. 6 (1), Eq. 7 (2) at s (m,): (m, 4)."""
    columns = [np.polynomial.polynomial.polyder(row, derivative) for row in _POWERS]
    at = np.atleast_1d(np.asarray(s, dtype=np.float64))
    return np.stack([np.polynomial.polynomial.polyval(at, c) for c in columns], axis=1)


@dataclass(frozen=True, slots=True, eq=False)
class UniformSpline:
    """A uniform cubic B-spline over t in [0, (n - 3) dt].

    Parameters
    ----------
    control_points : (n, 3)   C_i [m], n >= 4.
    dt : float                duration of a span [s].

    Raises
    ------
    ValueError : fewer than four control points, or a dt that is not finite and positive.
    """

    control_points: FloatArray
    dt: float

    def __post_init__(self) -> None:
        points = np.array(self.control_points, dtype=np.float64)
        if points.ndim != 2 or points.shape[1] != 3 or len(points) <= DEGREE or not np.isfinite(points).all():
            raise ValueError(f"control points: expected at least 4 finite rows of three, found shape {points.shape}")
        if not (np.isfinite(self.dt) and self.dt > 0.0):
            raise ValueError(f"dt: expected a finite number above 0 s, found {self.dt}")
        object.__setattr__(self, "control_points", points)

    @property
    def duration(self) -> float:
        """[s]; N control points make N - 3 spans."""
        return (len(self.control_points) - DEGREE) * self.dt

    def evaluate(self, t: ArrayLike, derivative: int = 0) -> FloatArray:
        """Position, velocity or acceleration (m, 3) in SI units at t (m,) [s], clamped to the range (Eq. 3, 8, 9)."""
        u = np.clip(np.atleast_1d(np.asarray(t, dtype=np.float64)) / self.dt, 0.0, len(self.control_points) - DEGREE)
        span = np.minimum(u.astype(np.int64), len(self.control_points) - DEGREE - 1)
        weights = basis(u - span, derivative) / self.dt**derivative
        value: FloatArray = np.einsum("mj,mja->ma", weights, self.control_points[span[:, None] + np.arange(4)])
        return value

    def clamped(self) -> tuple[FloatArray, FloatArray]:
        """(control points (n, 3), knots (n + 4,)) of the same curve as a clamped spline (Eq. 21)."""
        n = len(self.control_points)
        uniform: FloatArray = (np.arange(n + DEGREE + 1, dtype=np.float64) - DEGREE) * self.dt
        knots = clamped_knots(n, self.duration)
        return np.asarray(refine(self.control_points, uniform, knots)), knots


def through(
    control_points: FloatArray, dt: float, start_velocity: FloatArray, goal_velocity: FloatArray
) -> UniformSpline:
    """The spline that starts at the first and ends at the last of the given points (Eq. 10, 11).

    Parameters
    ----------
    control_points : (n, 3)               C_1 .. C_n [m], n >= 2; the first and the last are passed.
    dt : float                            [s].
    start_velocity, goal_velocity : (3,)  there, with zero acceleration [m/s].
    """
    first, last = control_points[0], control_points[-1]
    start = [first - start_velocity * dt, first, first + start_velocity * dt]  # Eq. 10, its signs mended
    goal = [last - goal_velocity * dt, last, last + goal_velocity * dt]  # Eq. 11
    return UniformSpline(np.array([*start, *control_points[1:-1], *goal]), dt)
