"""The fence: where the vehicle may be. Areas to stay in, all at once, areas to stay out of, a ceiling.

To the planner a fence is solid: areas to stay out of are prisms and cylinders, and an area to stay in is the world
less a polygon, in two prisms (`_outside`). To everybody else it is one number, `Geofence.inside`.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from companion.seam import FloatArray, Vector
from companion.shapes import Corner, Located, Model, Size
from planner import Cylinder, Prism
from planner.prism import MOST_CORNERS
from planner.worlds import Obstacle

MARGIN = 0.3
"""What a reference keeps from a fence that says nothing of it, if the ways keep as much [m]."""
CIRCLE_CORNERS = 96
"""Of the polygon inside a circle to stay in: it gives away 0.05 % of the radius."""
MOST_INCLUDED = 16
"""Areas to stay in."""
BEYOND = 10.0
"""How far the solids of a fence reach beyond the world [m]."""

Outline = tuple[tuple[float, float], ...]
Round = tuple[float, float, float]
"""North, east and radius of a circle."""


class FenceCircle(Located):
    north: float = Field(ge=-1e5, le=1e5)
    east: float = Field(ge=-1e5, le=1e5)
    radius: Size


class Area(Model):
    """Exactly one of corners and circle."""

    corners: Annotated[list[Corner], Field(min_length=3, max_length=MOST_CORNERS // 2)] | None = None
    circle: FenceCircle | None = None

    @model_validator(mode="after")
    def _one_and_simple(self) -> "Area":
        if (self.corners is None) == (self.circle is None):
            raise ValueError("expected exactly one of corners, circle")
        if self.corners is not None:
            Prism(self.outline(), (0.0, 1.0))
        return self

    def outline(self) -> Outline:
        """The corners (north, east); of a circle those of a polygon inside it."""
        if self.corners is not None:
            return tuple((c.north, c.east) for c in self.corners)
        return _ring(self.round())

    def round(self) -> Round:
        """The circle, where it is one."""
        assert self.circle is not None
        return (self.circle.north, self.circle.east, self.circle.radius)


class FenceModel(Model):
    """Where the mission may fly, as its file says it."""

    include: Annotated[list[Area], Field(default_factory=list, max_length=MOST_INCLUDED)]  # stay in each
    exclude: Annotated[list[Area], Field(default_factory=list, max_length=1000)]  # stay out of each
    ceiling: Size | None = None  # altitude [m]
    margin: Annotated[float, Field(ge=0, le=100)] | None = None  # a reference nearer to the fence than this waits [m]

    def geofence(self, kept: float = math.inf) -> "Geofence":
        """The fence of a mission whose ways keep `kept` [m] from it."""
        return Geofence(
            include=tuple(a.outline() for a in self.include if a.circle is None),
            within=tuple(a.round() for a in self.include if a.circle is not None),
            exclude=tuple(a.outline() for a in self.exclude if a.circle is None),
            circles=tuple(a.round() for a in self.exclude if a.circle is not None),
            ceiling=math.inf if self.ceiling is None else self.ceiling,
            margin=min(MARGIN, kept) if self.margin is None else self.margin,
        )


@dataclass(frozen=True, slots=True)
class Geofence:
    """A fence in the mission frame.

    Attributes
    ----------
    include : corners (north, east) of each area to stay in [m].
    within : (north, east, radius) of each that is a circle [m].
    exclude : corners of each area to stay out of.
    circles : (north, east, radius) likewise.
    ceiling : greatest altitude [m].
    margin : what the reference keeps from the fence [m].
    """

    include: tuple[Outline, ...] = ()
    within: tuple[Round, ...] = ()
    exclude: tuple[Outline, ...] = ()
    circles: tuple[Round, ...] = ()
    ceiling: float = math.inf
    margin: float = MARGIN

    def inside(self, position_m: Sequence[float] | FloatArray) -> float:
        """Distance [m] of a point (3,) (NED) to the fence: positive inside, negative beyond it."""
        north, east, altitude = float(position_m[0]), float(position_m[1]), -float(position_m[2])
        least = self.ceiling - altitude
        for n, e, radius in self.within:
            least = min(least, radius - math.hypot(north - n, east - e))
        for outline in self.include:
            least = min(least, -_to_outline(outline, north, east))
        for outline in self.exclude:
            least = min(least, _to_outline(outline, north, east))
        for n, e, radius in self.circles:
            least = min(least, math.hypot(north - n, east - e) - radius)
        return least

    def told(self, position_m: Sequence[float] | FloatArray, keep: float) -> str:
        """Why a point is not inside by `keep` [m], or nothing."""
        distance = self.inside(position_m)
        if distance >= keep:
            return ""
        if distance < 0.0:
            return f"{-distance:.2f} m outside the fence"
        return f"{keep - distance:.2f} m too near the fence (it keeps {keep:g} m)"

    def solids(self, bounds: tuple[Vector, Vector]) -> list[Obstacle]:
        """What a planner has to miss in a world of these bounds (NED) to stay inside; the ceiling is not among it."""
        (n0, e0, z0), (n1, e1, z1) = bounds
        z = (z0 - BEYOND, z1 + BEYOND)
        found: list[Obstacle] = [Prism(outline, z) for outline in self.exclude]
        found += [Cylinder((n, e), radius, z) for n, e, radius in self.circles]
        for area in (*self.include, *map(_ring, self.within)):
            found += [Prism(outline, z) for outline in _outside(area, (n0, e0), (n1, e1))]
        return found


def _outside(polygon: Outline, low: tuple[float, float], high: tuple[float, float]) -> list[Outline]:
    """A box less a simple polygon, as two simple polygons.

    The box reaches `BEYOND` beyond the polygon and the given corners. It is cut along the polygon's southernmost and
    northernmost corner: nothing of the polygon is south of the one or north of the other, so the cuts cross nothing.
    """
    corners = np.array(polygon)
    least = np.minimum(corners.min(axis=0), low) - BEYOND
    most = np.maximum(corners.max(axis=0), high) + BEYOND
    count = len(polygon)
    south = int(np.lexsort((corners[:, 1], corners[:, 0]))[0])
    north = int(np.lexsort((corners[:, 1], corners[:, 0]))[-1])
    forward = [polygon[(south + k) % count] for k in range((north - south) % count + 1)]
    backward = [polygon[(south - k) % count] for k in range((south - north) % count + 1)]
    first, last = (float(least[0]), polygon[south][1]), (float(most[0]), polygon[north][1])
    x = corners
    y = np.roll(x, -1, axis=0)
    area = float((x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0]).sum())
    eastern, western = (backward, forward) if area > 0.0 else (forward, backward)
    return [
        tuple([first, *chain, last, (float(most[0]), float(side)), (float(least[0]), float(side))])
        for chain, side in ((eastern, most[1]), (western, least[1]))
    ]


def _ring(circle: Round) -> Outline:
    """Corners of a polygon inside a circle."""
    n, e, r = circle
    turn = [2.0 * math.pi * k / CIRCLE_CORNERS for k in range(CIRCLE_CORNERS)]
    return tuple((n + r * math.cos(a), e + r * math.sin(a)) for a in turn)


def _to_outline(outline: Outline, north: float, east: float) -> float:
    """Signed distance [m] of a point to a simple polygon, negative inside; by even-odd crossings."""
    least, within = math.inf, False
    an, ae = outline[-1]
    for bn, be in outline:
        dn, de = bn - an, be - ae
        along = ((north - an) * dn + (east - ae) * de) / (dn * dn + de * de)
        along = min(max(along, 0.0), 1.0)
        least = min(least, math.hypot(north - an - along * dn, east - ae - along * de))
        if (ae > east) != (be > east) and north < an + (east - ae) * dn / de:
            within = not within
        an, ae = bn, be
    return -least if within else least
