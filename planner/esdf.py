"""Signed Euclidean distances to a set of occupied voxels, exactly, on the lattice of the voxels' corners.

Occupied voxels are solid cubes. Seen from a corner of the lattice, the nearest point of a cube is one of the cube's own
corners: along each axis a whole number is clamped to a unit interval between two whole numbers. So the distance to the
cubes is the distance to the lattice points on their surface, those with both an occupied and a free voxel around them,
and its square in voxels is a whole number: nothing is lost. The same points are nearest from inside. One transform
serves both sides; a corner with eight occupied voxels around it lies inside. Beyond the array all is free.

The transform is separable: two sweeps along z, then along y and x the lower envelope of parabolas, one for each point
with a finite distance so far (Felzenszwalb & Huttenlocher, Distance Transforms of Sampled Functions, Theory of
Computing 8 (2012), algorithm 1), linear in the number of points; among close voxels it is quicker to look around.
"""

import math

import numpy as np
from numpy.typing import NDArray

from planner.jit import kernel

FAR = 1e18
"""A squared distance no lattice has: nothing occupied yet on this line."""
REACH = 12
"""Voxels that `near_minima` looks around at most."""
Float32Array = NDArray[np.float32]
Float64Array = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]


@kernel
def mark_surface(occupied: BoolArray, inside: BoolArray, squares: Float32Array) -> None:
    """Which corners (nx + 1, ny + 1, nz + 1) lie inside; in `squares` their squared way along z to the surface."""
    nx, ny, nz = occupied.shape
    around = np.empty(nz + 2, dtype=np.uint8)  # occupied voxels of the four columns round a vertical line, free at ends
    for i in range(nx + 1):
        for j in range(ny + 1):
            around[:] = 0
            for ii in range(max(i - 1, 0), min(i + 1, nx)):
                for jj in range(max(j - 1, 0), min(j + 1, ny)):
                    for k in range(nz):
                        around[k + 1] += occupied[ii, jj, k]
            last = -FAR
            for k in range(nz + 1):
                count = around[k] + around[k + 1]
                inside[i, j, k] = count == 8
                if 0 < count < 8:
                    last = k
                squares[i, j, k] = min((k - last) ** 2, FAR)
            last = FAR
            for k in range(nz, -1, -1):
                if squares[i, j, k] == 0.0:
                    last = k
                squares[i, j, k] = min(squares[i, j, k], (last - k) ** 2)


@kernel
def lower_envelope(f: Float64Array, out: Float64Array, hull: IntArray, begin: IntArray, n: int) -> None:
    """out[q] = min_p (q - p)^2 + f[p] for q, p in 0 .. n - 1; all FAR when every f is.

    hull, begin : scratch (n,), (n + 1,)  the envelope's parabolas by their p, and the first q where each is lowest.
    """
    top = -1
    for q in range(n):
        height = f[q]
        if height >= FAR:
            continue
        start = 0
        while top >= 0:
            p = hull[top]
            # Where parabola q passes below parabola p; equal heights at a whole number may fall on either.
            start = math.floor(((height - f[p]) + (q * q - p * p)) / (2 * (q - p))) + 1
            if start > begin[top]:
                break
            top -= 1
            start = 0
        if start < n:
            top += 1
            hull[top], begin[top] = q, start
    if top < 0:
        for q in range(n):
            out[q] = FAR
        return
    begin[top + 1] = n
    for k in range(top + 1):
        p = hull[k]
        height = f[p]
        for q in range(begin[k], begin[k + 1]):
            out[q] = (q - p) ** 2 + height


@kernel
def near_minima(f: Float32Array, out: Float32Array, n: int) -> bool:
    """As `lower_envelope` along the first axis of f (n, m), by looking around; False when REACH is not enough.

    Where occupied voxels lie close together this is far quicker, since all m are done at once; where they do not, it
    gives up at the first row.
    """
    m = f.shape[1]
    for q in range(n):
        for k in range(m):
            out[q, k] = f[q, k]
        step = 1
        while True:
            square = np.float32(step * step)
            most = np.float32(0.0)
            for k in range(m):
                most = max(most, out[q, k])
            if most <= square:
                break
            if step > REACH:
                return False
            if q >= step:
                for k in range(m):
                    out[q, k] = min(out[q, k], f[q - step, k] + square)
            if q + step < n:
                for k in range(m):
                    out[q, k] = min(out[q, k], f[q + step, k] + square)
            step += 1
    return True


@kernel
def spread(
    sheet: Float32Array, out: Float32Array, lines: Float64Array, hull: IntArray, begin: IntArray, n: int
) -> None:
    """out[q, k] = min_p (q - p)^2 + sheet[p, k] for each k; lines (2, m, n), hull and begin are scratch."""
    if near_minima(sheet, out, n):
        return
    m = sheet.shape[1]
    for q in range(n):
        for k in range(m):
            lines[0, k, q] = sheet[q, k]
    for k in range(m):
        lower_envelope(lines[0, k], lines[1, k], hull, begin, n)
    for q in range(n):
        for k in range(m):
            out[q, k] = lines[1, k, q]


@kernel
def signed_distances(occupied: BoolArray, resolution: float) -> Float32Array:
    """Signed distance [m] of every corner (nx + 1, ny + 1, nz + 1) to the cubes' surface, negative inside them.

    occupied : (nx, ny, nz), C order, with something occupied; resolution [m] is the edge of a voxel. Rounded to float32
    at the end, so to 6e-8 of itself.
    """
    nx, ny, nz = occupied.shape[0] + 1, occupied.shape[1] + 1, occupied.shape[2] + 1
    squares = np.empty((nx, ny, nz), dtype=np.float32)
    inside = np.empty((nx, ny, nz), dtype=np.bool_)
    mark_surface(occupied, inside, squares)
    longest = max(nx, ny)
    hull, begin = np.empty(longest, dtype=np.int64), np.empty(longest + 1, dtype=np.int64)
    sheet, out = np.empty((longest, nz), dtype=np.float32), np.empty((longest, nz), dtype=np.float32)
    lines = np.empty((2, nz, longest))
    for i in range(nx):
        spread(squares[i], out, lines, hull, begin, ny)
        for j in range(ny):
            for k in range(nz):
                squares[i, j, k] = out[j, k]
    for j in range(ny):
        for i in range(nx):  # gathered: neighbours along x lie far apart in memory
            for k in range(nz):
                sheet[i, k] = squares[i, j, k]
        spread(sheet, out, lines, hull, begin, nx)
        for i in range(nx):
            for k in range(nz):
                d = resolution * math.sqrt(float(out[i, k]))
                squares[i, j, k] = -d if inside[i, j, k] else d
    return squares
