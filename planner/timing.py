"""From a shape to a motion: how fast to run along it, so that every limit holds everywhere.

The slow way is one time scale for the whole curve. Running C(u), u in [0, 1], as C(t/T) divides the k-th derivative by
T^k; with the hull bounds of `limits` on C' C'' C''',

    T = max(V/speed, (A/acceleration)^(1/2), (J/jerk)^(1/3))

is the shortest duration for which those bounds meet the limits. The fast way writes the same curve on finer knots and
then shortens every knot interval for itself (`intervals`). The control polygon stays, so the curve moves: by less than
a millimetre as a rule, since its points are close and neighbouring intervals change alike. What is proved is the
result: bounds and clearance are computed again on the knots found, so neither rounding nor that millimetre slips by.

Rest at an end: with the first three control points equal, C' and C'' vanish at the start (C'(0) ~ P1 - P0,
C''(0) ~ P2 - 2 P1 + P0 up to the clamped knots' factors), likewise at the end; for simple interior knots nothing weaker
gives zero velocity and zero acceleration. A moving end is fixed by its first three control points and two intervals;
those are held.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner.barrier import PAD
from planner.bspline import DEGREE, FloatArray, clamped_knots, refine
from planner.finer import finer_knots, parts_of
from planner.intervals import WIDER, shorten, stretch_of
from planner.limits import Limits, derivative_bounds

IntArray = NDArray[np.int64]

SHORTEST = 0.1
"""Duration of standing still [s]: a trajectory needs a range of time even when it goes nowhere."""
CUTS = ((4, 5.0), (8, 20.0))
"""Parts that a shape's intervals are cut into and the weight of an even rate, tried in turn until the motion is proved.
On the benchmark worlds' shapes the first moves a curve by 0.16 mm at most, the second by less than 0.03 mm, with a
duration 0.2 % less but twice as many knots.
"""
GAP = 0.003
MOST_STEPS = 60
"""Of Newton's method; from rest to rest it takes about 15."""
ROUNDS, SPARE = 4, 0.995
"""With via points: how often intervals are shortened and the curve moved onto the points in turn, and the part of the
limits that the former may use.
"""
_ROUNDING = 1e-12


class Motion(NamedTuple):
    """A motion: a curve over time."""

    control_points: FloatArray  # (n, 3) [m]
    knots: FloatArray  # (n + 4,) clamped, from 0 [s]


class Pins(NamedTuple):
    """Where a curve has to pass."""

    at: IntArray  # (m,) indices of knots
    points: FloatArray  # (m, 3) [m]
    parts: int  # intervals in a span of the shape

    def onto(self, control_points: FloatArray, knots: FloatArray) -> FloatArray:
        """The control points (n, 3) moved so that the points are met, by a bump as wide as one of the shape's own.

        At a simple knot c between a, b and d, e three basis functions are not zero: the first is (d - c)^2 / ((d - b)
        (d - a)), the last (c - b)^2 / ((d - b) (e - b)), and they sum to 1 (de Boor's recursion). Moving one alone
        would do, but by a jerk. The shape's bumps end two spans away, so that no other via point feels one.
        """
        offsets = np.arange(-2 * self.parts + 1, 2 * self.parts)
        x = np.abs(offsets / self.parts)
        bump = np.where(x < 1.0, 4.0 - 6.0 * x**2 + 3.0 * x**3, (2.0 - x) ** 3) / 4.0  # cubic B-spline, 1 in its middle
        middle = 2 * self.parts - 1
        moved = control_points.copy()
        for j, point in zip(self.at.tolist(), self.points, strict=True):
            a, b, c, d, e = knots[j - 2 : j + 3].tolist()
            first, last = (d - c) ** 2 / ((d - b) * (d - a)), (c - b) ** 2 / ((d - b) * (e - b))
            weights = np.array([first, 1.0 - first - last, last])
            missing = point - weights @ moved[j - 3 : j]
            moved[j - 2 + offsets] += bump[:, None] * (missing / (weights @ bump[middle - 1 : middle + 2]))
        return moved


def timings(
    control_points: FloatArray,
    knots: FloatArray,
    limits: Limits,
    duration: float | None = None,
    via: FloatArray | None = None,
    via_knots: IntArray | None = None,
) -> Iterator[Motion]:
    """Motions along a shape that keep the limits; each follows it more closely than the one before.

    Parameters
    ----------
    control_points : (n, 3)    [m].
    knots : (n + 4,)           clamped on [0, 1].
    duration : float           what the first and the last three control points were set out for, so that they have the
                               asked velocity and acceleration [s]; None when they are at rest.
    via : (m, 3)               points that the curve passes [m], at the knots `via_knots` (m,), in spans from the start.

    From rest to rest there is always one, at last the shape itself on one time scale; else none when the limits cannot
    be kept from such a start.
    """
    moving = (_moves(control_points[:DEGREE]), _moves(control_points[-DEGREE:]))
    for most_parts, evenness in CUTS:
        parts = parts_of(knots, most_parts)
        finer = finer_knots(control_points, knots, limits, duration, moving, parts)
        points = refine(control_points, knots, finer)
        for end, moves in ((slice(0, DEGREE), moving[0]), (slice(-DEGREE, None), moving[1])):
            if not moves:
                points[end] = control_points[end]
        pins = None
        if via is not None and via_knots is not None and len(via):
            pins = Pins(np.searchsorted(finer, knots[DEGREE + via_knots]), via, parts)
        found = fastest(points, finer, limits, duration, moving, evenness, pins)
        if found is not None:
            yield found
    if duration is None:
        yield Motion(control_points, uniform_scaling(control_points, limits, knots))


def fastest(
    points: FloatArray,
    knots: FloatArray,
    limits: Limits,
    duration: float | None,
    moving: tuple[bool, bool],
    evenness: float,
    pins: Pins | None = None,
) -> Motion | None:
    """The least duration that knot intervals alone can reach, or None when none keeps the limits."""
    intervals = np.zeros(len(points) - DEGREE + 2 * PAD)
    intervals[PAD:-PAD] = np.diff(knots[DEGREE:-DEGREE])
    bounds = np.array([limits.speed, limits.acceleration, limits.jerk])
    if duration is None:
        duration = WIDER * stretch_of(points, intervals, bounds)
        if duration <= SHORTEST:
            return None
    intervals *= duration
    held = (int(moving[0]), int(moving[1]))
    for _ in range(1 if pins is None else ROUNDS):
        asked = bounds if pins is None else bounds * SPARE
        stretch, _ = shorten(points, intervals, asked, held, evenness, GAP, MOST_STEPS)
        if not stretch <= 1.0:
            return None
        times = np.cumsum(intervals[PAD:-PAD])
        timed = np.concatenate([np.zeros(DEGREE + 1), times, np.full(DEGREE, times[-1])])
        if pins is not None:
            points = pins.onto(points, timed)
        if within(points, timed, limits):
            return Motion(points, timed)
    return None


def _moves(end: FloatArray) -> bool:
    """Whether the three control points at an end differ."""
    return bool((end != end[0]).any())


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
