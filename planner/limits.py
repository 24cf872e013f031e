"""Limits on the motion, and bounds on a spline's derivatives that hold everywhere on it."""

from dataclasses import dataclass

import numpy as np

from planner.bspline import DEGREE, FloatArray, derivative_control_points
from planner.errors import InfeasibleLimits

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
    norms = []
    for order in range(3):
        control_points = derivative_control_points(control_points, knots, DEGREE - order)
        knots = knots[1:-1]
        norms.append(float(np.sqrt(np.einsum("ij,ij->i", control_points, control_points)).max()))
    return DerivativeBounds(*norms)
