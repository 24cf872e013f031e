"""Obstacles as sensors and maps give them: occupied voxels and clouds of points, through a distance field.

An occupied voxel is a solid cube; a point blocks the voxel it is in; what is not known to be occupied is free. The
field is built with the obstacle, once: a 200 x 200 x 40 grid takes some 30 ms, and a world of it then takes no time.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from planner.checks import Point, as_point, as_positive
from planner.esdf import BoolArray, signed_distances
from planner.field import NEAR, NO_FIELD, Field

FloatArray = NDArray[np.float64]
AnyArray = TypeVar("AnyArray", BoolArray, FloatArray)

MOST_VOXELS = 40_000_000
"""In one field; its distances then take 160 MB."""
MOST_POINTS = 20_000_000
MARGIN = NEAR
"""Free voxels kept around a cloud: outside its lattice a field's bound is good only for what is well within."""
ALIGNED = 1e-6
"""Share of a voxel by which lattices that are merged may seem apart; rounding of the corners' coordinates, no more."""


@dataclass(frozen=True, slots=True, eq=False)
class VoxelGrid:
    """A regular grid of cubes, some of them solid.

    Parameters
    ----------
    occupied : (nx, ny, nz) bool    whether voxel (i, j, k) is solid; copied.
    origin : (3,)                   lowest corner of voxel (0, 0, 0) [m].
    resolution : float              edge of a voxel [m].

    Raises
    ------
    ValueError : another shape or type, no voxels or more than MOST_VOXELS, numbers that are not finite.
    """

    occupied: BoolArray
    origin: Point
    resolution: float
    field: Field = field(init=False, repr=False)  # for the kernels

    def __post_init__(self) -> None:
        array = np.asarray(self.occupied)
        if array.ndim != 3 or array.dtype != np.bool_:
            raise ValueError(f"voxels: expected a bool array (nx, ny, nz), found {array.dtype} {array.shape}")
        if not 1 <= array.size <= MOST_VOXELS:
            raise ValueError(f"voxels: expected 1 to {MOST_VOXELS}, found {array.size} in {array.shape}")
        occupied = np.array(array, order="C")  # the kernels', which tell writable arrays from others
        object.__setattr__(self, "occupied", _read_only(occupied))
        object.__setattr__(self, "origin", as_point("voxels origin", self.origin))
        object.__setattr__(self, "resolution", as_positive("voxels resolution", self.resolution))
        object.__setattr__(self, "field", build_field(occupied, np.array(self.origin), self.resolution))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, VoxelGrid):
            return NotImplemented
        same = (self.origin, self.resolution) == (other.origin, other.resolution)
        return same and np.array_equal(self.occupied, other.occupied)

    def __hash__(self) -> int:
        return hash((self.occupied.shape, self.origin, self.resolution))

    def __repr__(self) -> str:
        solid = int(np.count_nonzero(self.occupied))
        return f"VoxelGrid({solid} of {self.occupied.shape}, origin={self.origin}, resolution={self.resolution})"


@dataclass(frozen=True, slots=True, eq=False)
class PointCloud:
    """Points, each of which makes the voxel it is in solid.

    Parameters
    ----------
    points : (n, 3)         [m]; copied.
    resolution : float      edge of a voxel [m].
    origin : (3,)           a corner of the voxels' lattice [m].

    Raises
    ------
    ValueError : another shape, more than MOST_POINTS, a point that is not finite (its index is named), or points so far
        apart that their voxels would be more than MOST_VOXELS.
    """

    points: FloatArray
    resolution: float
    origin: Point = (0.0, 0.0, 0.0)
    field: Field = field(init=False, repr=False)  # for the kernels

    def __post_init__(self) -> None:
        array = np.asarray(self.points)
        if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "fiu":
            raise ValueError(f"cloud: expected an array of numbers (n, 3), found {array.dtype} {array.shape}")
        if len(array) > MOST_POINTS:
            raise ValueError(f"cloud: expected at most {MOST_POINTS} points, found {len(array)}")
        points = _read_only(np.array(array, dtype=np.float64, order="C"))
        strays = np.flatnonzero(~np.isfinite(points).all(axis=1))
        if len(strays):
            raise ValueError(f"cloud point {strays[0]}: expected finite numbers, found {tuple(points[strays[0]])}")
        origin, resolution = as_point("cloud origin", self.origin), as_positive("cloud resolution", self.resolution)
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "origin", origin)
        object.__setattr__(self, "resolution", resolution)
        object.__setattr__(self, "field", _field_of_points(points, np.array(origin), resolution))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PointCloud):
            return NotImplemented
        same = (self.origin, self.resolution) == (other.origin, other.resolution)
        return same and np.array_equal(self.points, other.points)

    def __hash__(self) -> int:
        return hash((len(self.points), self.origin, self.resolution))

    def __repr__(self) -> str:
        return f"PointCloud({len(self.points)} points, resolution={self.resolution}, origin={self.origin})"


def build_field(occupied: BoolArray, origin: FloatArray, resolution: float) -> Field:
    """The field of occupied voxels (nx, ny, nz), C order; NO_FIELD when none is."""
    if not occupied.any():
        return NO_FIELD
    return Field(signed_distances(occupied, resolution), occupied, origin, resolution)


def merge(fields: Sequence[tuple[int, Field]]) -> Field:
    """One field of several obstacles' voxels, given with the obstacles' indices; built afresh if there are several.

    Raises
    ------
    ValueError : voxels of different sizes, or lattices that lie a part of a voxel apart, or more than MOST_VOXELS in
        the box around them all; the obstacles are named.
    """
    some = [(index, one) for index, one in fields if one.distances.size > 0]
    if len(some) <= 1:
        return some[0][1] if some else NO_FIELD
    first, base = some[0]
    places = []
    for index, one in some:
        if one.resolution != base.resolution:
            raise ValueError(
                f"obstacles {first} and {index}: expected voxels of one size, "
                f"found {base.resolution:g} m and {one.resolution:g} m"
            )
        apart = (one.origin - base.origin) / base.resolution
        place = np.round(apart)
        if (np.abs(apart - place) > ALIGNED).any() or not _same_lattice(one.origin, base.origin, place, one.resolution):
            raise ValueError(
                f"obstacles {first} and {index}: expected voxels of one lattice, "
                f"found them {', '.join(f'{v:.3f}' for v in apart)} voxels apart"
            )
        places.append(place)
    low = np.min(places, axis=0)
    high = np.max([place + one.occupied.shape for place, (_, one) in zip(places, some, strict=True)], axis=0)
    shape = _shape(high - low, f"obstacles {', '.join(str(index) for index, _ in some)}", base.resolution)
    occupied = np.zeros(shape, dtype=np.bool_)
    for place, (_, one) in zip(places, some, strict=True):
        i, j, k = (int(v) for v in place - low)
        nx, ny, nz = one.occupied.shape
        occupied[i : i + nx, j : j + ny, k : k + nz] |= one.occupied
    return build_field(occupied, base.origin + low * base.resolution, base.resolution)


def _same_lattice(a: FloatArray, b: FloatArray, place: FloatArray, resolution: float) -> bool:
    """Whether a lies at that place of b's lattice to within rounding, which the proof's margin covers."""
    largest = max(float(np.abs(a).max()), float(np.abs(b).max()), resolution)
    return bool((np.abs(b + place * resolution - a) <= 1e-14 * largest).all())


def _field_of_points(points: FloatArray, origin: FloatArray, resolution: float) -> Field:
    if not len(points):
        return NO_FIELD
    places = np.floor((points - origin) / resolution)
    low = places.min(axis=0) - MARGIN
    shape = _shape(places.max(axis=0) - low + 1.0 + MARGIN, "cloud", resolution)
    i, j, k = (places - low).astype(np.int64).T
    occupied = np.zeros(shape, dtype=np.bool_)
    occupied[i, j, k] = True
    return build_field(occupied, origin + low * resolution, resolution)


def _shape(size: FloatArray, whose: str, resolution: float) -> tuple[int, int, int]:
    if not float(np.prod(size)) <= MOST_VOXELS:
        extent = " x ".join(f"{v * resolution:.6g}" for v in size)
        raise ValueError(
            f"{whose}: expected at most {MOST_VOXELS} voxels, found {math.prod(size):.3g} of {resolution:g} m "
            f"in a box of {extent} m; crop it or take larger voxels"
        )
    nx, ny, nz = (int(v) for v in size)
    return nx, ny, nz


def _read_only(array: AnyArray) -> AnyArray:
    view = array.view()
    view.setflags(write=False)
    return view
