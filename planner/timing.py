"""From a shape to a motion: how fast to run along it, so that every limit holds everywhere.

The slow way is one time scale for the whole curve. Running C(u), u in [0, 1], as C(t/T) divides the k-th derivative by
T^k; with the hull bounds of `limits` on C' C'' C''',

    T = max(V/speed, (A/acceleration)^(1/2), (J/jerk)^(1/3))

is the shortest duration for which those bounds meet the limits. The fast way writes the same curve on finer knots and
then shortens every knot interval for itself (`intervals`). The control polygon stays, so the curve moves: by less than
a millimetre, since its points are close and neighbouring intervals change alike. What is proved is the result: bounds
and clearance are computed again on the knots that were found, so neither rounding nor that millimetre slips through.

Rest at an end: with the first three control points equal, C' and C'' vanish at the start (C'(0) ~ P1 - P0,
C''(0) ~ P2 - 2 P1 + P0 up to the clamped knots' factors), likewise at the end; for simple interior knots nothing weaker
gives zero velocity and zero acceleration. A moving end is fixed by its first three control points and two intervals;
those are held.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from planner.bspline import DEGREE, FloatArray, clamped_knots, refine
from planner.intervals import PAD, WIDER, shorten, stretch_of
from planner.limits import Limits, derivative_bounds

SHORTEST = 0.1
"""Duration of standing still [s]: a trajectory needs a range of time even when it goes nowhere."""
PARTS = 4
"""Finer intervals in each of a shape's: with 8 the duration is 0.2 % less, and everything after it takes twice as long.
"""
MOST_INTERVALS = 600
"""Shapes with many intervals are cut less, to twice this at most, or not at all."""
MOST_HALVINGS = 6
EVENNESS = (5.0, 50.0)
"""Weights of an even rate, tried in turn until the motion is proved: with the first a curve moves by 0.3 mm at most in
the benchmark worlds, with the second by a tenth of that, at 1 % of the duration.
"""
GAP = 0.003
MOST_STEPS = 60
"""Of Newton's method; from rest to rest it takes about 15."""
_ROUNDING = 1e-12


class Motion(NamedTuple):
    """A motion: a curve over time."""

    control_points: FloatArray  # (n, 3) [m]
    knots: FloatArray  # (n + 4,) clamped, from 0 [s]


def timings(
    control_points: FloatArray, knots: FloatArray, limits: Limits, duration: float | None = None
) -> Iterator[Motion]:
    """Motions along a shape that keep the limits, fastest first; each is farther from the shape than the next.

    Parameters
    ----------
    control_points : (n, 3)    [m].
    knots : (n + 4,)           clamped on [0, 1].
    duration : float           what the first and the last three control points were set out for, so that they have the
                               asked velocity and acceleration [s]; None when they are at rest.

    From rest to rest there is always one; else none when the limits cannot be kept from such a start.
    """
    finer = finer_knots(control_points, knots, limits, moving=duration is not None)
    points = refine(control_points, knots, finer)
    if duration is None:
        points[:DEGREE], points[-DEGREE:] = control_points[0], control_points[-1]
    for evenness in EVENNESS:
        found = fastest(points, finer, limits, duration, evenness)
        if found is not None:
            yield found
    if duration is None:
        yield Motion(control_points, uniform_scaling(control_points, limits, knots))


def fastest(
    points: FloatArray, knots: FloatArray, limits: Limits, duration: float | None, evenness: float
) -> Motion | None:
    """The least duration that knot intervals alone can reach, or None when none keeps the limits."""
    intervals = np.zeros(len(points) - DEGREE + 2 * PAD)
    intervals[PAD:-PAD] = np.diff(knots[DEGREE:-DEGREE])
    bounds = np.array([limits.speed, limits.acceleration, limits.jerk])
    held = (0, 0) if duration is None else (1, 1)
    if duration is None:
        duration = WIDER * stretch_of(points, intervals, bounds)
        if duration <= SHORTEST:
            return None
    intervals *= duration
    stretch, _ = shorten(points, intervals, bounds, held, evenness, GAP, MOST_STEPS)
    if not stretch <= 1.0:
        return None
    times = np.cumsum(intervals[PAD:-PAD])
    timed = np.concatenate([np.zeros(DEGREE + 1), times, np.full(DEGREE, times[-1])])
    return Motion(points, timed) if within(points, timed, limits) else None


def finer_knots(control_points: FloatArray, knots: FloatArray, limits: Limits, moving: bool) -> FloatArray:
    """A shape's knots with each span cut into parts, the outermost of them halved until they resolve the ramps."""
    breaks = knots[DEGREE:-DEGREE]
    spans = len(breaks) - 1
    parts = PARTS
    while parts > 1 and parts * spans > MOST_INTERVALS:
        parts //= 2
    steps = np.arange(parts) / parts
    inner = (breaks[:-1, None] + np.diff(breaks)[:, None] * steps).ravel()
    first, last = (inner[1] if parts > 1 else breaks[1]) - breaks[0], breaks[-1] - inner[-1]
    fall = 0.5 ** np.arange(MOST_HALVINGS, 0, -1)
    ends = [0 if moving else _halvings(end, parts, limits) for end in (control_points[:4], control_points[:-5:-1])]
    if moving:
        ends = [2, 2]
    early = breaks[0] + first * fall[MOST_HALVINGS - ends[0] :]
    late = breaks[-1] - last * fall[MOST_HALVINGS - ends[1] :][::-1]
    return np.concatenate([knots[:DEGREE], inner[:1], early, inner[1:], late, knots[-DEGREE - 1 :]])


def _halvings(end: FloatArray, parts: int, limits: Limits) -> int:
    """How often the interval at a rest is halved.

    Full jerk lasts tau = min(a/j, (v/j)^(1/2)) and goes j tau^3/6; a span that begins at rest goes |P3 - P2|/6 f^3 in
    its fraction f. The first interval shall be no longer than that.
    """
    tau = min(limits.acceleration / limits.jerk, (limits.speed / limits.jerk) ** 0.5)
    way, ramp = float(np.linalg.norm(end[3] - end[2])), limits.jerk * tau**3
    if not way > 0.0:
        return 0
    wanted = (way / ramp) ** (1.0 / 3.0) / parts
    return int(min(max(np.ceil(np.log2(max(wanted, 1e-9))), 0), MOST_HALVINGS))


def uniform_scaling(control_points: FloatArray, limits: Limits, knots: FloatArray | None = None) -> FloatArray:
    """Knots (n + 4,) [s] of the fastest uniform run through control points (n, 3) [m] under the limits.

    `knots` (n + 4,) on [0, 1] are the shape's, evenly spaced when not given.

    Raises
    ------
    KnotError : fewer than four control points.
    """
    shape = clamped_knots(len(control_points)) if knots is None else knots
    unit = derivative_bounds(control_points, shape)
    duration = max(
        unit.speed / limits.speed,
        (unit.acceleration / limits.acceleration) ** 0.5,
        (unit.jerk / limits.jerk) ** (1.0 / 3.0),
        SHORTEST,
    ) * (1.0 + _ROUNDING)  # most often enough
    while True:
        scaled = clamped_knots(len(control_points), duration) if knots is None else knots * duration
        if within(control_points, scaled, limits):
            return scaled
        duration *= 1.0 + _ROUNDING


def within(control_points: FloatArray, knots: FloatArray, limits: Limits) -> bool:
    """Whether the hull bounds prove that speed, acceleration and jerk stay within the limits all along the curve."""
    bounds = derivative_bounds(control_points, knots)
    return bounds.speed <= limits.speed and bounds.acceleration <= limits.acceleration and bounds.jerk <= limits.jerk
