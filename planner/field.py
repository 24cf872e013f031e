"""What kernels ask of a distance field: a smooth value for the cost, a proved lower bound, and the exact distance.

A field is a lattice of signed distances d_i at voxel corners n_i (see `esdf`) of spacing h, and the voxels themselves.
In a cell let w_i be the trilinear weights of its corners at p, so that p = sum w_i n_i, and f_a in [0, 1] the place of
p along axis a.

Value. T[d](p) = sum w_i d_i, continuous everywhere, with the gradient it has inside the cell.

Lower bound. The squared distance to a set S is |p|^2 + min over s of (|s|^2 - 2 p . s): what is added to |p|^2 is a
minimum of affine functions, so concave, hence (Jensen)

    d(p)^2 - |p|^2 >= sum w_i (d_i^2 - |n_i|^2)
    d(p)^2         >= T[d^2](p) - sum w_i |n_i - p|^2 = T[d^2](p) - h^2 sum_a f_a (1 - f_a)

for any set S, convex or not. Where one cube is the nearest to all of the cell, this is about 3 h^2 / (8 d) below the
truth at most, a few per cent of h beyond a few voxels. Where the nearest one changes within the cell it can be 0.9 h,
no better than the 1-Lipschitz property: midway in a gap the exact distance has to be looked up. Corners are kept in
float32, to 6e-8 of themselves; SHRINK takes more than that off. Within solids the depth is 1-Lipschitz too, so
T[depth](p) >= depth(p) - h sqrt(sum_a f_a (1 - f_a)).

Outside the lattice let q be the lattice's nearest point to p. All that is solid lies in the lattice, which is convex,
so the angle at q is obtuse and d(p)^2 >= d(q)^2 + |p - q|^2: a proof too, but a loose one where what is nearest lies
deep within.

Exact. The lower bound L and the corners' upper bound U = min d_i + |p - n_i| leave a shell of voxels to look at.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner.esdf import BoolArray, Float32Array
from planner.jit import leaf

FloatArray = NDArray[np.float64]

SHRINK = 1.0 - 5e-7
"""Takes the rounding of float32 corners off a squared distance."""
CLOSE, NEAR = 4.0, 8.0
"""Voxels within which distances are looked up exactly by a search, which asks often, and by a proof."""


class Field(NamedTuple):
    """A distance field over occupied voxels, as the kernels read it; without voxels, nothing is there."""

    distances: Float32Array  # (nx + 1, ny + 1, nz + 1) signed, at the voxels' corners [m]
    occupied: BoolArray  # (nx, ny, nz)
    origin: FloatArray  # (3,) of the lattice's first corner [m]
    resolution: float  # h: edge of a voxel [m]


NO_FIELD = Field(np.empty((0, 0, 0), np.float32), np.empty((0, 0, 0), np.bool_), np.zeros(3), 1.0)


@leaf
def _along(x: float, origin: float, h: float, cells: int) -> tuple[int, float, float]:
    """(cell, place in it in [0, 1], way from the lattice [m] with its sign) of one coordinate."""
    u = (x - origin) / h
    if u <= 0.0:
        return 0, 0.0, x - origin
    if u >= cells:
        return cells - 1, 1.0, (u - cells) * h  # not x - (origin + cells h), which rounds in a frame's far corner
    i = min(int(u), cells - 1)
    return i, u - i, 0.0


@leaf
def interpolate(
    distances: Float32Array, x0: float, y0: float, z0: float, h: float, far: float, x: float, y: float, z: float
) -> tuple[float, float, float, float]:
    """(T, gradient) of the signed distance [m] at a point; T = inf without a gradient when it surely exceeds `far`."""
    i, fx, ex = _along(x, x0, h, distances.shape[0] - 1)
    j, fy, ey = _along(y, y0, h, distances.shape[1] - 1)
    k, fz, ez = _along(z, z0, h, distances.shape[2] - 1)
    d000 = float(distances[i, j, k])
    if d000 > far + 1.7321 * h:  # no corner of this cell is nearer than `far`
        return np.inf, 0.0, 0.0, 0.0
    d001, d010 = float(distances[i, j, k + 1]), float(distances[i, j + 1, k])
    d011, d100 = float(distances[i, j + 1, k + 1]), float(distances[i + 1, j, k])
    d101, d110 = float(distances[i + 1, j, k + 1]), float(distances[i + 1, j + 1, k])
    d111 = float(distances[i + 1, j + 1, k + 1])
    c00, c01 = d000 + fx * (d100 - d000), d001 + fx * (d101 - d001)
    c10, c11 = d010 + fx * (d110 - d010), d011 + fx * (d111 - d011)
    b0, b1 = c00 + fy * (c10 - c00), c01 + fy * (c11 - c01)
    d = b0 + fz * (b1 - b0)
    gx = (1.0 - fy) * ((1.0 - fz) * (d100 - d000) + fz * (d101 - d001)) + fy * (
        (1.0 - fz) * (d110 - d010) + fz * (d111 - d011)
    )
    gy = (1.0 - fz) * (c10 - c00) + fz * (c11 - c01)
    gz = b1 - b0
    if ex == 0.0 and ey == 0.0 and ez == 0.0:
        return d, gx / h, gy / h, gz / h
    # Outside: sqrt(T(q)^2 + |p - q|^2); T >= 0 on the lattice's own sides, beyond which all is free.
    d = max(d, 0.0)
    r = math.sqrt(d * d + ex * ex + ey * ey + ez * ez)
    gx = ex if ex != 0.0 else d * gx / h
    gy = ey if ey != 0.0 else d * gy / h
    gz = ez if ez != 0.0 else d * gz / h
    return r, gx / r, gy / r, gz / r


@leaf
def field_bound(field: Field, x: float, y: float, z: float) -> float:
    """A proved lower bound of the signed distance from a point to the occupied voxels [m]; inf without any."""
    distances, origin, h = field.distances, field.origin, field.resolution
    if distances.size == 0:
        return np.inf
    i, fx, ex = _along(x, origin[0], h, distances.shape[0] - 1)
    j, fy, ey = _along(y, origin[1], h, distances.shape[1] - 1)
    k, fz, ez = _along(z, origin[2], h, distances.shape[2] - 1)
    beyond = ex * ex + ey * ey + ez * ez
    square, solid = 0.0, field.occupied[i, j, k] and beyond == 0.0
    for a in range(2):
        wx = fx if a == 1 else 1.0 - fx
        for b in range(2):
            wxy = wx * (fy if b == 1 else 1.0 - fy)
            low, high = float(distances[i + a, j + b, k]), float(distances[i + a, j + b, k + 1])
            square += wxy * ((1.0 - fz) * low * low + fz * high * high)
    spread = h * h * (fx * (1.0 - fx) + fy * (1.0 - fy) + fz * (1.0 - fz))
    if solid:
        # All corners are at most 0; the mean depth is at most the root of the mean square.
        return -(math.sqrt(square) + math.sqrt(spread)) * (2.0 - SHRINK)
    return math.sqrt(max(square * SHRINK - spread, 0.0) + beyond)


@leaf
def field_distance(field: Field, x: float, y: float, z: float, most: float) -> float:
    """The distance from a point to the occupied voxels [m], exact where it is below `most`.

    Where it is not, some lower bound of it that is at least `most`. Inside a voxel: at most 0, not exact.
    """
    low = field_bound(field, x, y, z)
    if low >= most or low < 0.0:
        return low
    distances, occupied, origin, h = field.distances, field.occupied, field.origin, field.resolution
    nx, ny, nz = occupied.shape
    u, v, w = (x - origin[0]) / h, (y - origin[1]) / h, (z - origin[2]) / h
    i, fx, _ = _along(x, origin[0], h, nx)
    j, fy, _ = _along(y, origin[1], h, ny)
    k, fz, _ = _along(z, origin[2], h, nz)
    a, b, c = i + (fx > 0.5), j + (fy > 0.5), k + (fz > 0.5)
    # By the nearest corner; nothing found below it would mean that it is the distance, so it is rounded up.
    upper = distances[a, b, c] / h * (2.0 - SHRINK) + math.sqrt((u - a) ** 2 + (v - b) ** 2 + (w - c) ** 2) + 1e-9
    upper = min(upper, most / h)
    best = upper * upper
    skip = max(low / h - 1e-9, 0.0) ** 2  # what is nearer than this is free
    for i in range(max(math.floor(u - upper), 0), min(math.floor(u + upper) + 1, nx)):
        gx = max(max(i - u, u - (i + 1)), 0.0)
        for j in range(max(math.floor(v - upper), 0), min(math.floor(v + upper) + 1, ny)):
            gy = max(max(j - v, v - (j + 1)), 0.0)
            flat = gx * gx + gy * gy
            if flat >= best:
                continue
            reach, hollow = math.sqrt(best - flat), math.sqrt(max(skip - flat, 0.0))
            k, last = max(math.floor(w - reach), 0), min(math.floor(w + reach) + 1, nz)
            while k < last:
                gz = max(max(k - w, w - (k + 1)), 0.0)
                if gz < hollow:
                    k = max(k + 1, math.floor(w + hollow))
                    continue
                if flat + gz * gz < best and occupied[i, j, k]:
                    best = flat + gz * gz
                k += 1
    return math.sqrt(best) * h
