"""Where a shape's knots are made finer before it is timed.

Even parts of every interval serve the way between the ends. At an end at rest, a vehicle with little jerk or much of it
passes its ramp in a small part of an interval or in several; halving the outermost one shrinks the distance to the next
knot by eight, so a few halvings suit any vehicle. At a moving end the two outermost intervals are held (see
`intervals`), so they are made short.
"""

import numpy as np

from planner.bspline import DEGREE, FloatArray
from planner.limits import Limits

MOST_INTERVALS = 1600
"""A shape with many intervals is cut into fewer parts, down to one."""
MOST_HALVINGS = 8


def parts_of(knots: FloatArray, most: int) -> int:
    """How many parts each span of a shape is cut into: `most`, a power of two, or less for a long shape."""
    parts, spans = most, len(knots) - 2 * DEGREE - 1
    while parts > 1 and parts * spans > MOST_INTERVALS:
        parts //= 2
    return parts


def finer_knots(
    control_points: FloatArray,
    knots: FloatArray,
    limits: Limits,
    duration: float | None,
    moving: tuple[bool, bool],
    parts: int,
) -> FloatArray:
    """A shape's knots with each span cut into parts, the outermost of them halved until they resolve the ramps.

    Parameters
    ----------
    control_points : (n, 3)    [m].
    knots : (n + 4,)           clamped on [0, 1].
    duration : float           what a moving end was set out for [s].
    moving : (bool, bool)      whether the start, the goal is not at rest.
    """
    breaks = knots[DEGREE:-DEGREE]
    inner = (breaks[:-1, None] + np.diff(breaks)[:, None] * (np.arange(parts) / parts)).ravel()
    first, last = (inner[1] if parts > 1 else breaks[1]) - breaks[0], breaks[-1] - inner[-1]
    halvings = []
    for end, from_end, moves in (
        (control_points[:4], knots[:6], moving[0]),
        (control_points[:-5:-1], knots[-1] - knots[:-7:-1], moving[1]),
    ):
        if moves:
            assert duration is not None, "moving ends are set out for a duration"
            halvings.append(_halvings_moving(end, from_end * duration, parts, limits))
        else:
            halvings.append(_halvings(end, parts, limits))
    fall = 0.5 ** np.arange(MOST_HALVINGS, 0, -1)
    early = breaks[0] + first * fall[MOST_HALVINGS - halvings[0] :]
    late = breaks[-1] - last * fall[MOST_HALVINGS - halvings[1] :][::-1]
    return np.concatenate([knots[:DEGREE], inner[:1], early, inner[1:], late, knots[-DEGREE - 1 :]])


def _halvings_moving(end: FloatArray, knots: FloatArray, parts: int, limits: Limits) -> int:
    """The same at an end in motion: twice, or until the second control point of the velocity keeps the limit too.

    That is the velocity plus half the first interval of acceleration.
    """
    first, both = knots[4] - knots[3], knots[5] - knots[3]
    velocity = 3.0 * (end[1] - end[0]) / first
    change = 3.0 * (end[2] - end[1]) / both - velocity
    for halvings in range(2, MOST_HALVINGS):
        if np.linalg.norm(velocity + change / (parts * 2**halvings)) <= limits.speed:
            return halvings
    return MOST_HALVINGS


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
