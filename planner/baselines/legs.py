"""Via points for methods that know none: each leg on its own, from rest to rest, then one curve.

With three equal control points at an end, a clamped spline goes on into the next without a change: near its last knot
it is B + w (u - 1)^3, whose blossom is B wherever 1 is among the arguments (Ramshaw), so the same control points on
knots that go on evenly draw the same curve. Joining is leaving out the triple that two legs share.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from planner.bspline import DEGREE, FloatArray, clamped_knots
from planner.certificate import certify
from planner.query import Query
from planner.shape import Effort, Shape

Leg = Callable[[Query, Effort], Iterator[Shape]]
"""A method for one leg, from rest at `start` to rest at `goal`: shapes on even knots, most promising first."""
SAME_WAY = 1e-9
"""Sine of the angle below which a curve goes on straight."""


def leg_by_leg(method: str, leg: Leg) -> Leg:
    """The finder that runs a method leg by leg, and stops at each via point.

    It raises ValueError when an end is asked to move, since these methods know curves from rest to rest alone.
    """

    def find(query: Query, effort: Effort) -> Iterator[Shape]:
        for name in ("start_velocity", "start_acceleration", "goal_velocity"):
            if getattr(query, name).any():
                raise ValueError(f"{name}: expected rest for method {method}, which plans from rest to rest only")
        if not len(query.via):
            yield from leg(query, effort)
            return
        ends, still = query.corners, np.empty((0, 3))
        parts = []
        for k in range(len(ends) - 1):
            part: Shape | None = None
            for part in leg(replace(query, start=ends[k], goal=ends[k + 1], via=still), effort):
                if certify(part.control_points, part.knots, query.world, query.radius, full=False).certified:
                    break
            assert part is not None, f"{method} hands over a shape or raises"
            parts.append(part)
        yield joined(parts)

    return find


def joined(parts: list[Shape]) -> Shape:
    """One curve of curves that each begin at rest where the one before ends at rest."""
    points = np.concatenate([parts[0].control_points, *(part.control_points[DEGREE:] for part in parts[1:])])
    return Shape(
        points,
        clamped_knots(len(points)),
        sum(part.stretch for part in parts),
        sum(part.smoothness for part in parts),
        sum(part.obstacle for part in parts),
        turns_on_spot=turns_on_spot(points),
    )


def turns_on_spot(points: FloatArray) -> bool:
    """Whether a curve of control points (n, 3) stops somewhere and goes on in another direction."""
    same = (points[1:] == points[:-1]).all(axis=1)
    stops = np.flatnonzero(same[1:-2] & same[2:-1] & ~same[:-3] & ~same[3:]) + 1  # first of three equal ones
    before, after = points[stops] - points[stops - 1], points[stops + DEGREE] - points[stops + DEGREE - 1]
    cross = np.linalg.norm(np.cross(before, after), axis=1)
    sizes = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    return bool(((cross > SAME_WAY * sizes) | ((before * after).sum(axis=1) < 0.0)).any())
