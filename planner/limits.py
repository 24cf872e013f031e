"""Limits on the motion, and bounds on a spline's derivatives that hold everywhere on it."""

from dataclasses import dataclass

import numpy as np

from planner.bspline import FloatArray
from planner.errors import InfeasibleLimits, KnotError
from planner.jit import kernel

LEAST, MOST = 1e-6, 1e6
"""What a limit may be, in its SI unit. Vehicles have 0.1 to 1000; the room around that is for odd questions.
It ends where arithmetic starts to suffer: every product of powers of three such limits stays far from overflow and
underflow, and a metre takes weeks at worst.
"""


@dataclass(frozen=True, slots=True)
class Limits:
    """Euclidean norms that the motion may reach but not pass.

    Raises
    ------
    InfeasibleLimits : a limit is not a number from LEAST to MOST.
    """

    speed: float  # [m/s]
    acceleration: float  # [m/s^2]
    jerk: float  # [m/s^3]

    def __post_init__(self) -> None:
        for name in ("speed", "acceleration", "jerk"):
            value = float(getattr(self, name))
            if not LEAST <= value <= MOST:
                raise InfeasibleLimits(name, value, LEAST, MOST)
            object.__setattr__(self, name, value)


@dataclass(frozen=True, slots=True)
class DerivativeBounds:
    """Largest norm of the control points of each derivative: no point of the curve goes beyond."""

    speed: float
    acceleration: float
    jerk: float


def derivative_bounds(control_points: FloatArray, knots: FloatArray) -> DerivativeBounds:
    """Bounds on speed, acceleration and jerk of a cubic spline, by the convex hull property.

    A derivative lies in the hull of its own control points, and a Euclidean norm is convex, so its maximum over the
    hull is reached at a control point. For acceleration (piecewise linear) and jerk (piecewise constant) the bound is
    the maximum itself; for speed it is a little above.

    Parameters
    ----------
    control_points : (n, 3)   [m].
    knots : (n + 4,)          clamped [s].

    Raises
    ------
    KnotError : an interior knot repeats.
    """
    bounds = DerivativeBounds(*_largest_norms(control_points, knots))
    if bounds.speed < 0.0:
        raise KnotError("an interior knot repeats")
    return bounds


@kernel
def _largest_norms(P: FloatArray, knots: FloatArray) -> tuple[float, float, float]:
    """Largest norm of each derivative's control points (`bspline.derivative_control_points`, thrice); -1: bad knots."""
    n, largest = P.shape[0], np.zeros(3)
    Q = P.copy()
    for order in range(3):
        p, most = 3 - order, 0.0
        for i in range(n - 1 - order):
            spacing = knots[order + i + p + 1] - knots[order + i + 1]
            if not spacing > 0.0:
                return -1.0, -1.0, -1.0
            s = p / spacing
            for k in range(3):
                Q[i, k] = (Q[i + 1, k] - Q[i, k]) * s
            square = Q[i, 0] * Q[i, 0] + Q[i, 1] * Q[i, 1] + Q[i, 2] * Q[i, 2]
            if not square < np.inf:  # NaN too
                return np.inf, np.inf, np.inf
            most = max(most, square)
        largest[order] = most**0.5
    return largest[0], largest[1], largest[2]
