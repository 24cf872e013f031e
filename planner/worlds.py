"""What a plan has to miss: solids inside the walls of a map.

Any Cartesian frame will do, as long as all of it is in that one frame and the cylinders' axis is its z axis; z may
point up or down. Lengths in metres.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from planner import distance
from planner.distance import FloatArray, Scene

Point = tuple[float, float, float]


def as_point(name: str, value: Sequence[float] | FloatArray) -> Point:
    """Three finite floats, or a ValueError that says what was found."""
    found = tuple(float(v) for v in value)
    if len(found) != 3 or not all(math.isfinite(v) for v in found):
        raise ValueError(f"{name}: expected three finite numbers, found {found}")
    return found


def _positive(name: str, value: float) -> float:
    if not (math.isfinite(value) and value > 0):
        raise ValueError(f"{name}: expected a finite number above 0, found {value}")
    return float(value)


@dataclass(frozen=True, slots=True)
class Box:
    """An axis-aligned box between two corners [m]; ValueError unless lower < upper on every axis."""

    lower: Point
    upper: Point

    def __post_init__(self) -> None:
        object.__setattr__(self, "lower", as_point("box lower", self.lower))
        object.__setattr__(self, "upper", as_point("box upper", self.upper))
        if not all(a < b for a, b in zip(self.lower, self.upper, strict=True)):
            raise ValueError(f"box: expected lower < upper on every axis, found {self.lower} and {self.upper}")

    def packed(self) -> tuple[float, ...]:
        """The row that `distance` reads."""
        centre = tuple((a + b) / 2 for a, b in zip(self.lower, self.upper, strict=True))
        half = tuple((b - a) / 2 for a, b in zip(self.lower, self.upper, strict=True))
        return (distance.BOX, *centre, *half)


@dataclass(frozen=True, slots=True)
class Cylinder:
    """A solid upright cylinder: centre (x, y), radius, and the interval z = (low, high) between its caps [m]."""

    centre: tuple[float, float]
    radius: float
    z: tuple[float, float]

    def __post_init__(self) -> None:
        x, y, low = as_point("cylinder centre and z", (*self.centre, self.z[0]))
        _, _, high = as_point("cylinder z", (0.0, *self.z))
        if not low < high:
            raise ValueError(f"cylinder z: expected low < high, found {self.z}")
        object.__setattr__(self, "centre", (x, y))
        object.__setattr__(self, "z", (low, high))
        object.__setattr__(self, "radius", _positive("cylinder radius", self.radius))

    def packed(self) -> tuple[float, ...]:
        """The row that `distance` reads."""
        low, high = self.z
        return (distance.CYLINDER, *self.centre, (low + high) / 2, self.radius, (high - low) / 2, 0.0)


@dataclass(frozen=True, slots=True)
class Sphere:
    """A solid ball [m]."""

    centre: Point
    radius: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre", as_point("sphere centre", self.centre))
        object.__setattr__(self, "radius", _positive("sphere radius", self.radius))

    def packed(self) -> tuple[float, ...]:
        """The row that `distance` reads."""
        return (distance.SPHERE, *self.centre, self.radius, 0.0, 0.0)


Obstacle = Box | Cylinder | Sphere


@dataclass(frozen=True, slots=True)
class World:
    """Solids inside a box-shaped map whose walls are solid too.

    `bounds` are two opposite corners. Solids may overlap each other and reach beyond the bounds.

    Raises
    ------
    ValueError : bounds that are not low < high on every axis, or an obstacle of an unknown kind (its index is named).
    """

    bounds: tuple[Point, Point]
    obstacles: Sequence[Obstacle] = ()  # kept as a tuple
    scene: Scene = field(init=False, repr=False, compare=False)  # the obstacles, for the kernels
    walls: FloatArray = field(init=False, repr=False, compare=False)  # (2, 3) the bounds as an array
    largest: float = field(init=False, repr=False, compare=False)  # absolute coordinate or size of all these [m]

    def __post_init__(self) -> None:
        low, high = self.bounds
        low, high = as_point("bounds low", low), as_point("bounds high", high)
        if not all(a < b for a, b in zip(low, high, strict=True)):
            raise ValueError(f"bounds: expected low < high on every axis, found {low} and {high}")
        obstacles: Iterable[object] = self.obstacles
        for index, obstacle in enumerate(obstacles):
            if not isinstance(obstacle, Box | Cylinder | Sphere):
                raise ValueError(f"obstacle {index}: expected a Box, Cylinder or Sphere, found {obstacle!r}")
        object.__setattr__(self, "bounds", (low, high))
        object.__setattr__(self, "obstacles", tuple(self.obstacles))
        rows = [o.packed() for o in self.obstacles]
        solids = np.array(rows, dtype=np.float64).reshape(-1, distance.WIDTH)
        object.__setattr__(self, "scene", Scene(solids))
        object.__setattr__(self, "walls", np.array([low, high], dtype=np.float64))
        largest = max(np.abs(self.walls).max(), np.abs(solids[:, 1:]).max(initial=0.0))
        object.__setattr__(self, "largest", float(largest))

    def distance(self, points: FloatArray) -> FloatArray:
        """Signed distance (m,) [m] of points (m, 3) to the nearest obstacle, negative inside; inf without any."""
        return self.distance_gradient(points)[0]

    def distance_gradient(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The same and its unit gradient (m, 3), which is zero when there is no obstacle."""
        p = np.ascontiguousarray(points, dtype=np.float64).reshape(-1, 3)
        d, g = np.empty(len(p)), np.empty((len(p), 3))
        distance.least_distances(self.scene, p, d, g)
        return d, g

    def wall_distance(self, points: FloatArray) -> FloatArray:
        """Signed distance (m,) from points (m, 3) to the nearest wall of the map, positive inside the map [m].

        Inside the map it is the distance; outside, minus the largest excess over one bound (never farther than the
        truth).
        """
        p = np.asarray(points, dtype=np.float64).reshape(-1, 3)
        least: FloatArray = np.minimum(p - self.walls[0], self.walls[1] - p).min(axis=1)
        return least
