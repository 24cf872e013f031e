"""The geofence: is the vehicle where it may be?

Inside every inclusion zone, outside every exclusion zone, and within GF_MAX_HOR_DIST and GF_MAX_VER_DIST of home. A
polygon's inside is found by counting the edges that a ray to the north crosses; a point on an edge may be on either
side. Zones are turned into the local frame once, when the plan or the origin changes.
"""

import math
from dataclasses import dataclass
from enum import Enum

from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.places import Places
from fakevehicle.plans import CIRCLES, PlanItem, PlanStore
from fakevehicle.vocabulary import FloatArray, Geodetic
from wire.dialect import mavlink

_m = mavlink
PARAMETERS: tuple[Parameter, ...] = (
    Parameter("GF_MAX_HOR_DIST", 0.0, 0.0, 10_000.0, "m", "Fence: farthest from home; 0: no limit"),
    Parameter("GF_MAX_VER_DIST", 0.0, 0.0, 10_000.0, "m", "Fence: highest above home; 0: no limit"),
)


class Breach(Enum):
    """What was crossed: FENCE_BREACH."""

    CEILING = 2
    BOUNDARY = 3


@dataclass(frozen=True, slots=True)
class _Zone:
    """A circle (one corner and a radius) or a polygon (radius 0), in local north and east [m]."""

    inclusion: bool
    corners: tuple[tuple[float, float], ...]
    radius: float

    def holds(self, north: float, east: float) -> bool:
        if self.radius > 0.0:
            return math.dist((north, east), self.corners[0]) <= self.radius
        inside = False
        n0, e0 = self.corners[-1]
        for n1, e1 in self.corners:
            if (e0 > east) != (e1 > east) and north < n0 + (n1 - n0) * (east - e0) / (e1 - e0):
                inside = not inside
            n0, e0 = n1, e1
        return inside


class FenceMonitor:
    """Looks whether a point is allowed.

    Attributes
    ----------
    enabled : whether it counts; switched by command.
    breaches : how many have begun; `since_us` is when the newest did, `breach` the one that holds now.
    """

    def __init__(self, store: PlanStore, parameters: ParameterSet, places: Places) -> None:
        self._store = store
        self._parameters = parameters
        self._places = places
        self._zones: tuple[_Zone, ...] = ()
        self._made_of: tuple[object, Geodetic | None] = (None, None)
        self.enabled = True
        self.breach: Breach | None = None
        self.breaches = 0
        self.since_us = 0

    @property
    def present(self) -> bool:
        """Whether there is any fence."""
        p = self._parameters
        return bool(self._store.fence) or p["GF_MAX_HOR_DIST"] > 0.0 or p["GF_MAX_VER_DIST"] > 0.0

    @property
    def holding(self) -> bool:
        """Whether it keeps anybody in: with GF_ACTION 0 or 1 it is told of at most, and nothing is refused for it."""
        return self.enabled and self._parameters["GF_ACTION"] > 1

    def step(self, now_us: int, position_n: FloatArray, home_n: FloatArray) -> Breach | None:
        """Look at the vehicle's own position, (3,) [m], and count what begins."""
        breach = self.breach_at(position_n, home_n)
        if breach is not None and self.breach is None:
            self.breaches += 1
            self.since_us = now_us
        self.breach = breach
        return breach

    def breach_at(self, position_n: FloatArray, home_n: FloatArray) -> Breach | None:
        """What being at a point would breach, (3,) local NED [m]; None: it is allowed."""
        if not (self.enabled and self.present):
            return None
        north, east, down = position_n.tolist()
        far, high = self._parameters["GF_MAX_HOR_DIST"], self._parameters["GF_MAX_VER_DIST"]
        if 0.0 < high < float(home_n[2]) - down:
            return Breach.CEILING
        if 0.0 < far < math.dist((north, east), home_n[:2]):
            return Breach.BOUNDARY
        if any(zone.holds(north, east) is not zone.inclusion for zone in self._local_zones()):
            return Breach.BOUNDARY
        return None

    def _local_zones(self) -> tuple[_Zone, ...]:
        origin = self._places.origin
        fence, made_of = self._store.fence, self._made_of
        if fence is not made_of[0] or origin is not made_of[1]:
            self._made_of = (fence, origin)
            self._zones = () if origin is None else tuple(self._convert(self._store.fence))
        return self._zones

    def _convert(self, items: tuple[PlanItem, ...]) -> list[_Zone]:
        zones: list[_Zone] = []
        i = 0
        while i < len(items):
            first = items[i]
            circle = first.command in CIRCLES
            count = 1 if circle else int(first.params[0])
            corners = tuple(self._corner(item) for item in items[i : i + count])
            inclusion = first.command in _INCLUSIONS
            zones.append(_Zone(inclusion, corners, first.params[0] if circle else 0.0))
            i += count
        return zones

    def _corner(self, item: PlanItem) -> tuple[float, float]:
        latitude, longitude = item.params[4:6]
        place_n = self._places.local(Geodetic(math.radians(latitude), math.radians(longitude), 0.0))
        return (0.0, 0.0) if place_n is None else (float(place_n[0]), float(place_n[1]))


_INCLUSIONS = (_m.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, _m.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION)
