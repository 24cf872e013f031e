"""From a shape to a motion: one time scale for the whole curve, so that every limit holds everywhere.

Running C(u), u in [0, 1], as C(t/T) divides the k-th derivative by T^k. With the hull bounds of `limits` on C' C''
C''',

    T = max(V/speed, (A/acceleration)^(1/2), (J/jerk)^(1/3))

is the shortest duration for which those bounds meet the limits. What is proved is the result: the bounds are computed
again on the scaled knots, so rounding cannot slip through.

Rest at both ends: with the first three control points equal, C' and C'' vanish at the start (C'(0) ~ P1 - P0,
C''(0) ~ P2 - 2 P1 + P0 up to the clamped knots' factors), likewise at the end; for simple interior knots nothing weaker
gives zero velocity and zero acceleration.
"""

from planner.bspline import FloatArray, clamped_knots
from planner.limits import Limits, derivative_bounds

SHORTEST = 0.1
"""Duration of standing still [s]: a trajectory needs a range of time even when it goes nowhere."""
_ROUNDING = 1e-12


def uniform_scaling(control_points: FloatArray, limits: Limits) -> FloatArray:
    """Knots (n + 4,) [s] of the fastest uniform run through control points (n, 3) [m] under the limits.

    Raises
    ------
    KnotError : fewer than four control points.
    """
    n = len(control_points)
    unit = derivative_bounds(control_points, clamped_knots(n))
    duration = max(
        unit.speed / limits.speed,
        (unit.acceleration / limits.acceleration) ** 0.5,
        (unit.jerk / limits.jerk) ** (1.0 / 3.0),
        SHORTEST,
    ) * (1.0 + _ROUNDING)  # most often enough
    while True:
        knots = clamped_knots(n, duration)
        if within(control_points, knots, limits):
            return knots
        duration *= 1.0 + _ROUNDING


def within(control_points: FloatArray, knots: FloatArray, limits: Limits) -> bool:
    """Whether the hull bounds prove that speed, acceleration and jerk stay within the limits all along the curve."""
    bounds = derivative_bounds(control_points, knots)
    return bounds.speed <= limits.speed and bounds.acceleration <= limits.acceleration and bounds.jerk <= limits.jerk
