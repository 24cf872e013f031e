"""Exact signed distances to solids, with gradients, as numba kernels; and who is nearest, solids or a field's voxels.

d > 0 outside, 0 on the surface, < 0 inside. For a convex solid d is a convex function on all of space and the
gradient g returned is a unit subgradient, so d(y) >= d(x) + g . (y - x) for every y: the supporting plane that
`certificate` uses.

A solid is one row of seven float64:
    BOX       0, centre x y z, half extents x y z
    CYLINDER  1, centre x y z, radius, half height, 0       upright: its axis is z, caps flat
    SPHERE    2, centre x y z, radius, 0, 0
    PRISM     3, centre x y z, first edge, half height, edges      upright and convex; the edges (see `prism`) count
    NOTCHED   4, likewise, not convex                              from the centre
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner.field import CLOSE, NO_FIELD, Field, field_distance, interpolate
from planner.jit import leaf
from planner.prism import EDGE, polygon_distance

FloatArray = NDArray[np.float64]

BOX, CYLINDER, SPHERE, PRISM, NOTCHED = 0.0, 1.0, 2.0, 3.0, 4.0
"""Kinds; those before NOTCHED are convex."""
WIDTH = 7
"""Numbers a solid takes."""


class Scene(NamedTuple):
    """Everything solid, as the kernels read it."""

    solids: FloatArray  # (k, 7)
    edges: FloatArray = np.empty((0, EDGE))  # (m, EDGE) of the prisms
    field: Field = NO_FIELD  # of voxels and point clouds


@leaf
def plain_distance(solids: FloatArray, k: int, x: float, y: float, z: float) -> tuple[float, float, float, float]:
    """`solid_distance` for kinds before PRISM.

    Loops in which time counts choose between this and `prism_distance` themselves: with a call to both inside, neither
    is compiled into the loop, and that takes half as long again."""
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


@leaf
def beyond(solids: FloatArray, k: int, x: float, y: float, reach: float) -> bool:
    """Whether a box, cylinder or sphere is farther off than `reach` seen from above already: quicker than how far."""
    dx, dy = x - solids[k, 1], y - solids[k, 2]
    if solids[k, 0] == BOX:
        return bool(abs(dx) >= solids[k, 4] + reach or abs(dy) >= solids[k, 5] + reach)
    return bool(dx * dx + dy * dy >= (solids[k, 4] + reach) ** 2)


@leaf
def prism_distance(
    solids: FloatArray, edges: FloatArray, k: int, x: float, y: float, z: float
) -> tuple[float, float, float, float]:
    """`solid_distance` for prisms: to the polygon seen from above, then as for a cylinder."""
    dx, dy, dz = x - solids[k, 1], y - solids[k, 2], z - solids[k, 3]
    qr, ux, uy = polygon_distance(edges, int(solids[k, 4]), int(solids[k, 6]), dx, dy)
    sz, qz = math.copysign(1.0, dz), abs(dz) - solids[k, 5]
    if qr > 0.0 and qz > 0.0:
        d = math.sqrt(qr * qr + qz * qz)
        return d, ux * qr / d, uy * qr / d, sz * qz / d
    if qr >= qz:
        return qr, ux, uy, 0.0
    return qz, 0.0, 0.0, sz


@leaf
def solid_distance(
    solids: FloatArray, edges: FloatArray, k: int, x: float, y: float, z: float
) -> tuple[float, float, float, float]:
    """(d, gx, gy, gz): signed distance [m] from a point to row k of `solids` and its unit (sub)gradient.

    The table and an index rather than the row: numba counts references to a row, which takes thrice the arithmetic.
    """
    if solids[k, 0] < PRISM:
        return plain_distance(solids, k, x, y, z)
    return prism_distance(solids, edges, k, x, y, z)


@leaf
def _nearest_row(solids: FloatArray, edges: FloatArray, x: float, y: float, z: float) -> tuple[float, int]:
    """(d, row) of the nearest solid; (inf, -1) when there is none."""
    least, index = np.inf, -1
    for k in range(solids.shape[0]):
        if solids[k, 0] < PRISM:
            d, _, _, _ = plain_distance(solids, k, x, y, z)
        else:
            d, _, _, _ = prism_distance(solids, edges, k, x, y, z)
        if d < least:
            least, index = d, k
    return least, index


@leaf
def nearest_solid(scene: Scene, x: float, y: float, z: float) -> tuple[float, int]:
    """(d, index) of what is nearest: exact for solids and within CLOSE voxels of a field's, else a proved lower bound.

    Inside a voxel it is at most 0, and no better than that. The index is the row of the solid, or the number of solids
    when it is the field; (inf, -1) when there is nothing.
    """
    least, index = _nearest_row(scene.solids, scene.edges, x, y, z)
    if scene.field.distances.size > 0:
        d = field_distance(scene.field, x, y, z, min(least, CLOSE * scene.field.resolution))
        if d < least:
            least, index = d, scene.solids.shape[0]
    return least, index


@leaf
def nearest_exact(scene: Scene, x: float, y: float, z: float, most: float) -> tuple[float, int]:
    """`nearest_solid`, with the field's distance exact wherever it is below `most` and outside its voxels."""
    least, index = _nearest_row(scene.solids, scene.edges, x, y, z)
    if scene.field.distances.size > 0:
        d = field_distance(scene.field, x, y, z, min(most, least))
        if d < least:
            least, index = d, scene.solids.shape[0]
    return least, index


@leaf
def least_distances(
    scene: Scene, most: float, points: FloatArray, distances: FloatArray, gradients: FloatArray
) -> None:
    """Write into `distances` (m,) and `gradients` (m, 3) the distance of every point (m, 3) to what is nearest.

    As `nearest_exact`; a field's gradient is that of its interpolated value, scaled to one (zero where it has none).
    """
    field = scene.field
    for i in range(points.shape[0]):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        distances[i], k = nearest_exact(scene, x, y, z, most)
        gx, gy, gz = 0.0, 0.0, 0.0
        if k == scene.solids.shape[0]:
            o = field.origin
            _, gx, gy, gz = interpolate(field.distances, o[0], o[1], o[2], field.resolution, np.inf, x, y, z)
            size = math.sqrt(gx * gx + gy * gy + gz * gz)
            if size > 0.0:
                gx, gy, gz = gx / size, gy / size, gz / size
        elif k >= 0:
            _, gx, gy, gz = solid_distance(scene.solids, scene.edges, k, x, y, z)
        gradients[i, 0], gradients[i, 1], gradients[i, 2] = gx, gy, gz
