"""What a plan has to miss: solids and voxels inside the walls of a map.

Any Cartesian frame will do, as long as all of it is in that one frame and the cylinders' and prisms' axis is its z
axis; z may point up or down. Lengths in metres.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from planner import distance, prism, voxels
from planner.checks import Point, as_interval, as_point, as_positive
from planner.distance import FloatArray, Scene
from planner.field import NEAR, Field
from planner.voxels import PointCloud, VoxelGrid

__all__ = ["Box", "Cylinder", "Obstacle", "Point", "PointCloud", "Prism", "Sphere", "VoxelGrid", "World", "as_point"]


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
        x, y, _ = as_point("cylinder centre", (*self.centre, 0.0))
        object.__setattr__(self, "centre", (x, y))
        object.__setattr__(self, "z", as_interval("cylinder z", self.z))
        object.__setattr__(self, "radius", as_positive("cylinder radius", self.radius))

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
        object.__setattr__(self, "radius", as_positive("sphere radius", self.radius))

    def packed(self) -> tuple[float, ...]:
        """The row that `distance` reads."""
        return (distance.SPHERE, *self.centre, self.radius, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Prism:
    """A solid upright prism over a simple polygon, convex or not.

    Parameters
    ----------
    corners : ((x, y), ...)     of the polygon, either way round, the last joined to the first [m]; kept as tuples.
    z : (low, high)             interval between its two ends [m].

    Raises
    ------
    ValueError : what `prism.counter_clockwise` refuses (fewer than 3 corners, edges that meet, ...), or low >= high.
    """

    corners: Sequence[tuple[float, float]]
    z: tuple[float, float]

    def __post_init__(self) -> None:
        prism.counter_clockwise(self.corners)
        object.__setattr__(self, "corners", tuple((float(x), float(y)) for x, y in self.corners))
        object.__setattr__(self, "z", as_interval("prism z", self.z))

    def packed(self, first: int) -> tuple[tuple[float, ...], FloatArray]:
        """The row that `distance` reads, and its edges, the first of which will be row `first` of all edges."""
        corners = prism.counter_clockwise(self.corners)
        x, y = ((corners.min(axis=0) + corners.max(axis=0)) / 2).tolist()
        low, high = self.z
        kind = distance.PRISM if prism.is_convex(corners) else distance.NOTCHED
        row = (kind, x, y, (low + high) / 2, float(first), (high - low) / 2, float(len(corners)))
        return row, prism.edge_rows(corners - (x, y))


Obstacle = Box | Cylinder | Sphere | Prism | VoxelGrid | PointCloud
KINDS: dict[type[Obstacle], str] = {
    Box: "box",
    Cylinder: "cylinder",
    Sphere: "sphere",
    Prism: "prism",
    VoxelGrid: "voxel grid",
    PointCloud: "point cloud",
}
"""What each is called in messages."""
FARTHEST = 1e9
"""Largest coordinate of a map and of what is in it [m]. A proof's margin for rounding is a centimetre there; it grows
with the largest coordinate of all, so what is farther off would spoil the proofs of what is near.
"""


@dataclass(frozen=True, slots=True)
class World:
    """Solids and voxels inside a box-shaped map whose walls are solid too.

    `bounds` are two opposite corners. Obstacles may overlap each other and reach beyond the bounds. Voxel grids and
    point clouds share one distance field: a single one's own, or a new one over the voxels of all.

    Raises
    ------
    ValueError : bounds that are not low < high on every axis, an obstacle of an unknown kind or one that reaches beyond
        FARTHEST (its index is named), or voxels that cannot share a field (see `voxels.merge`).
    """

    bounds: tuple[Point, Point]
    obstacles: Sequence[Obstacle] = ()  # kept as a tuple
    scene: Scene = field(init=False, repr=False, compare=False)  # the obstacles, for the kernels
    owners: tuple[int, ...] = field(init=False, repr=False, compare=False)  # obstacle of each row, then of the field
    walls: FloatArray = field(init=False, repr=False, compare=False)  # (2, 3) the bounds as an array
    largest: float = field(init=False, repr=False, compare=False)  # absolute coordinate or size of all these [m]

    def __post_init__(self) -> None:
        low, high = self.bounds
        low, high = as_point("bounds low", low), as_point("bounds high", high)
        if not all(a < b for a, b in zip(low, high, strict=True)):
            raise ValueError(f"bounds: expected low < high on every axis, found {low} and {high}")
        far = max(abs(v) for v in (*low, *high))
        if far > FARTHEST:
            raise ValueError(f"bounds: expected coordinates of at most {FARTHEST:g} m, found {far:g}")
        obstacles: Iterable[object] = self.obstacles
        for index, obstacle in enumerate(obstacles):
            if not isinstance(obstacle, Obstacle):
                known = ", ".join(kind.__name__ for kind in KINDS)
                raise ValueError(f"obstacle {index}: expected one of {known}, found {obstacle!r}")
            far = _farthest(obstacle)
            if not far <= FARTHEST:
                kind = KINDS[type(obstacle)]
                raise ValueError(
                    f"obstacle {index} ({kind}): expected coordinates of at most {FARTHEST:g} m, found {far:g}"
                )
        object.__setattr__(self, "bounds", (low, high))
        object.__setattr__(self, "obstacles", tuple(self.obstacles))
        scene, owners = _scene(self.obstacles)
        object.__setattr__(self, "scene", scene)
        object.__setattr__(self, "owners", owners)
        object.__setattr__(self, "walls", np.array([low, high], dtype=np.float64))
        object.__setattr__(self, "largest", _largest(self.walls, scene))

    def distance(self, points: FloatArray) -> FloatArray:
        """Signed distance (m,) [m] of points (m, 3) to the nearest obstacle, negative inside; inf without any.

        Exact for solids. For voxels exact from their surface to eight voxels away; farther off a lower bound, at most a
        voxel too low in the grid and less good outside it; inside voxels some number of at most 0, no less deep than
        the truth.
        """
        return self.distance_gradient(points)[0]

    def distance_gradient(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The same and its unit gradient (m, 3), which is zero when there is no obstacle.

        For voxels the direction is that of the field's interpolation, and zero in a place between voxels that has none.
        """
        p = np.ascontiguousarray(points, dtype=np.float64).reshape(-1, 3)
        d, g = np.empty(len(p)), np.empty((len(p), 3))
        distance.least_distances(self.scene, NEAR * self.scene.field.resolution, p, d, g)
        return d, g

    def wall_distance(self, points: FloatArray) -> FloatArray:
        """Signed distance (m,) from points (m, 3) to the nearest wall of the map, positive inside the map [m].

        Inside the map it is the distance; outside, minus the largest excess over one bound (never farther than the
        truth).
        """
        p = np.asarray(points, dtype=np.float64).reshape(-1, 3)
        least: FloatArray = np.minimum(p - self.walls[0], self.walls[1] - p).min(axis=1)
        return least


def _farthest(obstacle: Obstacle) -> float:
    """Largest absolute coordinate of an obstacle [m]."""
    match obstacle:
        case Box(lower, upper):
            return max(abs(v) for v in (*lower, *upper))
        case Cylinder(centre, radius, z):
            return max(*(abs(v) + radius for v in centre), *(abs(v) for v in z))
        case Sphere(centre, radius):
            return max(abs(v) + radius for v in centre)
        case Prism(corners, z):
            return max(abs(v) for pair in (*corners, z) for v in pair)
    lattice = obstacle.field
    far = lattice.origin + np.array(lattice.occupied.shape) * lattice.resolution
    return float(np.maximum(np.abs(lattice.origin), np.abs(far)).max()) if lattice.occupied.size else 0.0


def _scene(obstacles: Sequence[Obstacle]) -> tuple[Scene, tuple[int, ...]]:
    """The obstacles as kernels read them, and which obstacle each row is, the field's first one at the end."""
    rows: list[tuple[float, ...]] = []
    owners: list[int] = []
    edges: list[FloatArray] = []
    fields: list[tuple[int, Field]] = []
    for index, obstacle in enumerate(obstacles):
        if isinstance(obstacle, VoxelGrid | PointCloud):
            fields.append((index, obstacle.field))
            continue
        if isinstance(obstacle, Prism):
            row, own = obstacle.packed(sum(len(e) for e in edges))
            edges.append(own)
        else:
            row = obstacle.packed()
        rows.append(row)
        owners.append(index)
    solids = np.array(rows, dtype=np.float64).reshape(-1, distance.WIDTH)
    merged = voxels.merge(fields)
    owners += [index for index, one in fields if one.distances.size > 0][:1]
    scene = Scene(solids, np.concatenate([np.empty((0, prism.EDGE)), *edges]), merged)
    return scene, tuple(owners)


def _largest(walls: FloatArray, scene: Scene) -> float:
    lattice, sizes = scene.field, scene.solids[:, 1:].copy()
    prisms = scene.solids[:, 0] >= distance.PRISM
    sizes[prisms, 3] = sizes[prisms, 5] = 0.0  # where its edges stand is no size
    far = lattice.origin + np.array(lattice.occupied.shape) * lattice.resolution
    parts = (walls, sizes, scene.edges, lattice.origin, far if lattice.occupied.size else np.zeros(3))
    return max(float(np.abs(part).max(initial=0.0)) for part in parts)
