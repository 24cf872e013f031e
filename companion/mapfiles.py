"""Voxel and cloud files of a mission, turned into its frame: north, east, down.

A file's columns (or array axes) are north, east and altitude unless the mission says otherwise. `sha256` in the mission
pins a file down: one with other bytes is refused.
"""

import hashlib
from pathlib import Path
from typing import Literal

import numpy as np

from planner import PointCloud, VoxelGrid
from planner.errors import WorldFileError
from planner.files import DEFAULT_RESOLUTION, read_points, read_voxels
from planner.pcd import MOST_FILE_BYTES

Axes = Literal["north east altitude", "east north altitude", "north east down", "east north down"]
DEFAULT_AXES: Axes = "north east altitude"
_NED = {"north": (0, 1.0), "east": (1, 1.0), "altitude": (2, -1.0), "down": (2, 1.0)}


def voxels_in_ned(path: Path, axes: Axes, sha256: str | None) -> VoxelGrid:
    """The grid of an .npz file (see `planner.files.read_voxels`) in the mission's frame.

    Raises
    ------
    WorldFileError : it is gone, changed, or no grid.
    """
    _check(path, sha256)
    grid = read_voxels(path)
    occupied, origin = grid.occupied, np.array(grid.origin)
    places = [_NED[name] for name in axes.split()]
    low = np.zeros(3)
    for axis, (place, sign) in enumerate(places):
        end = origin[axis] + occupied.shape[axis] * grid.resolution
        low[place] = origin[axis] if sign > 0 else -end
        if sign < 0:
            occupied = np.flip(occupied, axis)
    occupied = np.moveaxis(occupied, (0, 1, 2), [place for place, _ in places])
    return VoxelGrid(occupied, (low[0], low[1], low[2]), grid.resolution)


def cloud_in_ned(path: Path, axes: Axes, resolution: float | None, sha256: str | None) -> PointCloud:
    """The points of a .pcd or .npz file in the mission's frame, in voxels of `resolution` [m], else of the file's.

    Raises
    ------
    WorldFileError : it is gone, changed, or no cloud.
    """
    _check(path, sha256)
    points, own, origin = read_points(path)
    turned, corner = np.empty_like(points), np.zeros(3)
    for axis, name in enumerate(axes.split()):
        place, sign = _NED[name]
        turned[:, place] = sign * points[:, axis]
        corner[place] = sign * (origin[axis] if origin is not None else 0.0)
    size = resolution if resolution is not None else own if own is not None else DEFAULT_RESOLUTION
    try:
        return PointCloud(turned, size, (corner[0], corner[1], corner[2]))
    except ValueError as error:
        raise WorldFileError(str(path), "cloud", str(error), "a cloud that can be") from error


def _check(path: Path, sha256: str | None) -> None:
    """Refuse a file with other bytes than the mission's author had."""
    if sha256 is None:
        return
    digest = hashlib.sha256()
    try:
        with path.open("rb") as file:
            left = MOST_FILE_BYTES
            while left > 0 and (block := file.read(1 << 20)):
                digest.update(block)
                left -= len(block)
    except OSError as error:
        raise WorldFileError(str(path), "file", error.strerror or str(error), "a file that can be read") from error
    if digest.hexdigest() != sha256:
        raise WorldFileError(str(path), "sha256", digest.hexdigest(), f"{sha256}: the file has changed")
