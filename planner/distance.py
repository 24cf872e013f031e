"""Exact signed distances to convex solids, with gradients, as numba kernels.

d > 0 outside, 0 on the surface, < 0 inside. For a convex solid d is a convex function on all of space and the
gradient g returned is a unit subgradient, so d(y) >= d(x) + g . (y - x) for every y: the supporting plane that
`certificate` uses.

A solid is one row of seven float64:
    BOX       0, centre x y z, half extents x y z
    CYLINDER  1, centre x y z, radius, half height, 0       upright: its axis is z, caps flat
    SPHERE    2, centre x y z, radius, 0, 0
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner.jit import kernel

FloatArray = NDArray[np.float64]

BOX, CYLINDER, SPHERE = 0.0, 1.0, 2.0
WIDTH = 7
"""Numbers a solid takes."""


class Scene(NamedTuple):
    """Everything solid, as the kernels read it."""

    solids: FloatArray  # (k, 7)


@kernel
def solid_distance(solids: FloatArray, k: int, x: float, y: float, z: float) -> tuple[float, float, float, float]:
    """(d, gx, gy, gz): signed distance [m] from a point to row k of `solids` and its unit (sub)gradient.

    The table and an index rather than the row: numba counts references to a row, which takes thrice the arithmetic.
    """
    dx, dy, dz = x - solids[k, 1], y - solids[k, 2], z - solids[k, 3]
    if solids[k, 0] == BOX:
        sx, sy, sz = math.copysign(1.0, dx), math.copysign(1.0, dy), math.copysign(1.0, dz)
        qx, qy, qz = abs(dx) - solids[k, 4], abs(dy) - solids[k, 5], abs(dz) - solids[k, 6]
        if qx <= 0.0 and qy <= 0.0 and qz <= 0.0:  # inside: the nearest face
            if qx >= qy and qx >= qz:
                return qx, sx, 0.0, 0.0
            if qy >= qz:
                return qy, 0.0, sy, 0.0
            return qz, 0.0, 0.0, sz
        qx, qy, qz = max(qx, 0.0), max(qy, 0.0), max(qz, 0.0)
        d = math.sqrt(qx * qx + qy * qy + qz * qz)
        return d, sx * qx / d, sy * qy / d, sz * qz / d
    if solids[k, 0] == CYLINDER:
        rho = math.sqrt(dx * dx + dy * dy)
        ux, uy = (dx / rho, dy / rho) if rho > 0.0 else (1.0, 0.0)  # on the axis any direction is a subgradient
        sz = math.copysign(1.0, dz)
        qr, qz = rho - solids[k, 4], abs(dz) - solids[k, 5]
        if qr > 0.0 and qz > 0.0:  # beyond the rim
            d = math.sqrt(qr * qr + qz * qz)
            return d, ux * qr / d, uy * qr / d, sz * qz / d
        if qr >= qz:
            return qr, ux, uy, 0.0
        return qz, 0.0, 0.0, sz
    r = math.sqrt(dx * dx + dy * dy + dz * dz)
    if r > 0.0:
        return r - solids[k, 4], dx / r, dy / r, dz / r
    return -solids[k, 4], 1.0, 0.0, 0.0


@kernel
def nearest_solid(scene: Scene, x: float, y: float, z: float) -> tuple[float, int]:
    """(d, index) of the solid with the least signed distance; (inf, -1) when there is none."""
    solids = scene.solids
    least, index = np.inf, -1
    for k in range(solids.shape[0]):
        d, _, _, _ = solid_distance(solids, k, x, y, z)
        if d < least:
            least, index = d, k
    return least, index


@kernel
def least_distances(scene: Scene, points: FloatArray, distances: FloatArray, gradients: FloatArray) -> None:
    """Write into `distances` (m,) and `gradients` (m, 3) the distance of every point (m, 3) to its nearest solid."""
    for i in range(points.shape[0]):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        distances[i], k = nearest_solid(scene, x, y, z)
        if k >= 0:
            _, gradients[i, 0], gradients[i, 1], gradients[i, 2] = solid_distance(scene.solids, k, x, y, z)
        else:
            gradients[i, :] = 0.0
