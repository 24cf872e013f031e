"""A composite cubic Bezier curve, twice continuously differentiable, through the pruned corners of A*'s way.

One cubic piece a leg, its parameter's range as long as the leg in whole units of UNIT; the first and the last piece are
cut once, since rest at both ends asks for two conditions more at each. Such a curve is a spline with simple knots at
the corners: with m corners it has m + 4 control points, the first and the last three of which are the ends, and the
inner ones follow from C(tau_k) = corner_k, a banded linear system (Farin, Curves and Surfaces for CAGD, ch. 9). It is
then written on even knots, without a change (Ramshaw's blossom, `bspline.refine`).

Between the corners the curve swings to their outside or into what is inside, so the bare one is often refused by the
proof. Then points halfway along every leg are added, ROUNDS times at most; more points keep it closer to the polyline.
"""

import math
from collections.abc import Iterator

import numpy as np

from planner.baselines import astar
from planner.baselines.legs import leg_by_leg
from planner.baselines.polyline import shape_of
from planner.baselines.route import route
from planner.bspline import DEGREE, FloatArray, basis, clamped_knots, refine
from planner.guide import pull_taut
from planner.query import Query
from planner.shape import Effort, Shape

UNIT = 0.7
"""Aimed length of a knot interval [m]."""
MOST_UNITS = 400
ROUNDS = 4


def through(corners: FloatArray) -> FloatArray:
    """Control points (n, 3), on even knots, of the curve through corners (m, 3) [m], at rest at both ends; m >= 2."""
    lengths = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    unit = max(UNIT, lengths.sum() / MOST_UNITS)
    units = np.maximum(np.round(lengths / unit), 1).astype(int)
    units[[0, -1]] = np.maximum(units[[0, -1]], 2 if len(units) > 1 else 3)  # room for the cuts
    at = np.concatenate([[0], np.cumsum(units)]).astype(np.float64)
    breaks = np.sort(np.concatenate([at, [1.0, at[-1] - 1.0]]))
    knots = np.concatenate([np.zeros(DEGREE), breaks, np.full(DEGREE, at[-1])])
    n = len(breaks) + DEGREE - 1
    points = np.empty((n, 3))
    points[:DEGREE], points[-DEGREE:] = corners[0], corners[-1]
    if len(corners) > 2:
        rows = basis(knots, n, at[1:-1])
        ends = rows[:, :DEGREE].sum(axis=1)[:, None] * corners[0] + rows[:, -DEGREE:].sum(axis=1)[:, None] * corners[-1]
        points[DEGREE:-DEGREE] = np.linalg.solve(rows[:, DEGREE:-DEGREE], corners[1:-1] - ends)
    even = clamped_knots(int(at[-1]) + DEGREE, float(at[-1]))
    found = np.asarray(refine(points, knots, even))
    found[:DEGREE], found[-DEGREE:] = corners[0], corners[-1]  # rest to the last digit
    return found


def halved(corners: FloatArray) -> FloatArray:
    """The corners (m, 3) and the points halfway between each two (2 m - 1, 3) [m]."""
    points = np.empty((2 * len(corners) - 1, 3))
    points[::2], points[1::2] = corners, (corners[:-1] + corners[1:]) / 2.0
    return points


def _curves(query: Query, effort: Effort) -> Iterator[Shape]:
    corners = route(query, effort, astar.shortest)
    corners = np.asarray(pull_taut(query.world.scene, query.radius, corners))
    if len(corners) < 2:
        yield shape_of(corners, query.limits)
        return
    for _ in range(ROUNDS + 1):
        effort.tried += 1
        points = through(corners)
        yield Shape(points, clamped_knots(len(points)), math.nan, math.nan, math.nan)
        corners = halved(corners)


find_bezier = leg_by_leg("bezier", _curves)
