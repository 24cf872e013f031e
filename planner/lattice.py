"""A* on a lattice of points in the free space, by edges that are proved clear.

The lattice fills the map less the radius, or a part of it. An edge to one of the 26 neighbours is free when all of it
keeps the radius, proved with the 1-Lipschitz distance: no solid is too thin to be seen. Edges nearer than BUFFER beyond
the radius, to walls of the map too, count up to CAUTION times longer, so that the way leads through the middle of what
is narrow.
Hart, Nilsson & Raphael 1968; the heuristic is the straight distance.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner.bspline import FloatArray
from planner.distance import Scene, nearest_solid
from planner.jit import kernel, leaf

SLACK = 0.01
"""Beyond the radius, what a guide keeps [m]: one that just touches leaves the spline no room."""
BUFFER, CAUTION = 0.3, 3.0
DEEPEST = 64
"""Halvings of a segment: each leaves less than half, and 64 leave nothing of any."""


class Lattice(NamedTuple):
    """Points origin + i step, i < shape, and what is known of them; one lattice serves every search in one world."""

    origin: FloatArray  # (3,) [m]
    step: FloatArray  # (3,) [m]
    shape: NDArray[np.int64]  # (3,)
    ends: FloatArray  # (2, 3) [m] start and goal; the points nearest to them stand for them
    distance: FloatArray  # (points,) to the nearest solid [m], NaN until it is asked for
    burden: FloatArray  # (points,) factor on the length of edges that lead here, at least 1


def build_lattice(low: FloatArray, high: FloatArray, ends: FloatArray, width: FloatArray) -> Lattice:
    """The lattice from `low` to `high` (3,) [m] with at most `width` (3,) [m] between neighbours along each axis."""
    shape = np.maximum(np.ceil((high - low) / width), 1.0).astype(np.int64) + 1
    step = np.maximum((high - low) / (shape - 1), 1e-9)
    points = int(np.prod(shape))
    return Lattice(low, step, shape, ends, np.full(points, np.nan), np.ones(points))


@leaf
def free(
    scene: Scene, radius: float, a: FloatArray, b: FloatArray, spare_a: float, spare_b: float, gaps: FloatArray
) -> bool:
    """Whether the segment from a to b keeps the radius less SLACK / 2.

    The distance is 1-Lipschitz: a point that keeps the radius vouches for d - radius + SLACK / 2 on both sides of it.
    What the ends, by their `spare` d - radius, leave is asked for in its middle, and so on. True is a proof, False
    means that a point nearer than the radius was met. `gaps` (2, DEEPEST) is scratch.
    """
    length = math.sqrt((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2 + (b[2] - a[2]) ** 2)
    gaps[0, 0], gaps[1, 0], top = spare_a + 0.5 * SLACK, length - spare_b - 0.5 * SLACK, 0
    while top >= 0:
        first, last = gaps[0, top], gaps[1, top]
        if first >= last:
            top -= 1
            continue
        t = 0.5 * (first + last)
        f = t / length
        d, _ = nearest_solid(scene, a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2]))
        if d < radius or top == DEEPEST - 1:
            return False
        gaps[1, top] = t - (d - radius + 0.5 * SLACK)
        top += 1
        gaps[0, top], gaps[1, top] = t + (d - radius + 0.5 * SLACK), last
    return True


@kernel
def astar(scene: Scene, lattice: Lattice, radius: float, longest: float) -> NDArray[np.int64]:
    """Lattice points (m,) of the lightest way from start to goal, none much longer than `longest` [m]; empty when
    there is none.

    The first and the last stand for the ends themselves: edges from and to them are judged from there, and keep what
    the end keeps if that is less.
    """
    origin, step, ends, distance, burden = lattice.origin, lattice.step, lattice.ends, lattice.distance, lattice.burden
    nx, ny, nz = lattice.shape[0], lattice.shape[1], lattice.shape[2]
    ox, oy, oz, sx, sy, sz = origin[0], origin[1], origin[2], step[0], step[1], step[2]
    here, there, gaps = np.empty(3), np.empty(3), np.empty((2, DEEPEST))
    cost, run = np.full(nx * ny * nz, np.inf), np.empty(nx * ny * nz)  # burdened, and as the crow flies [m]
    parent = np.full(nx * ny * nz, -1, dtype=np.int64)
    at, spares = np.empty((2, 3), dtype=np.int64), np.empty(2)
    for e in range(2):
        for a in range(3):
            at[e, a] = min(max(int((ends[e, a] - origin[a]) / step[a] + 0.5), 0), lattice.shape[a] - 1)
    begin, target = (at[0, 0] * ny + at[0, 1]) * nz + at[0, 2], (at[1, 0] * ny + at[1, 1]) * nz + at[1, 2]
    for e, node in ((0, begin), (1, target)):
        distance[node], _ = nearest_solid(scene, ends[e, 0], ends[e, 1], ends[e, 2])
        spares[e] = distance[node] - radius
    if begin == target and not free(
        scene, radius + min(0.0, min(spares[0], spares[1]) - 1e-9), ends[0], ends[1], 0.0, 0.0, gaps
    ):
        return np.empty(0, dtype=np.int64)  # one point stands for both, and they do not see each other
    gx, gy, gz = ox + at[1, 0] * sx, oy + at[1, 1] * sy, oz + at[1, 2] * sz
    ways = np.empty((3, 3, 3))
    for a in range(3):
        for b in range(3):
            for c in range(3):
                ways[a, b, c] = math.sqrt(((a - 1) * sx) ** 2 + ((b - 1) * sy) ** 2 + ((c - 1) * sz) ** 2)
    keys, nodes, size = np.empty(1024), np.empty(1024, dtype=np.int64), 1  # a binary heap
    keys[0], nodes[0], cost[begin], run[begin] = 0.0, begin, 0.0, 0.0
    while size > 0:
        node, key = nodes[0], keys[0]
        size -= 1
        last_key, last_node, i = keys[size], nodes[size], 0
        while 2 * i + 1 < size:  # sift down
            child = 2 * i + 1
            if child + 1 < size and keys[child + 1] < keys[child]:
                child += 1
            if keys[child] >= last_key:
                break
            keys[i], nodes[i] = keys[child], nodes[child]
            i = child
        keys[i], nodes[i] = last_key, last_node
        if node == target:
            break
        ix, iy, iz = node // (ny * nz), (node // nz) % ny, node % nz
        x, y, z = ox + ix * sx, oy + iy * sy, oz + iz * sz
        spent, ran, spare = cost[node], run[node], distance[node] - radius
        if key > spent + math.sqrt((x - gx) ** 2 + (y - gy) ** 2 + (z - gz) ** 2) + 1e-9:
            continue  # an older, dearer entry
        if node == begin:
            here[:] = ends[0]
        else:
            here[0], here[1], here[2] = x, y, z
        for jx in range(max(ix - 1, 0), min(ix + 2, nx)):
            for jy in range(max(iy - 1, 0), min(iy + 2, ny)):
                for jz in range(max(iz - 1, 0), min(iz + 2, nz)):
                    other = (jx * ny + jy) * nz + jz
                    way = ways[jx - ix + 1, jy - iy + 1, jz - iz + 1]
                    if spent + way * burden[other] >= cost[other]:
                        continue
                    px, py, pz = ox + jx * sx, oy + jy * sy, oz + jz * sz
                    left = math.sqrt((px - gx) ** 2 + (py - gy) ** 2 + (pz - gz) ** 2)
                    if ran + way + left > longest:
                        continue
                    if math.isnan(distance[other]):
                        distance[other], _ = nearest_solid(scene, px, py, pz)
                    near = min(spare, distance[other] - radius)
                    at_end = node == begin or other == target
                    if near < 0.0 and not at_end:
                        continue
                    walls = min(min(jx, nx - 1 - jx) * sx, min(jy, ny - 1 - jy) * sy, min(jz, nz - 1 - jz) * sz)
                    close = max(0.0, 1.0 - min(near, walls) / BUFFER)
                    dear = way * burden[other] * (1.0 + (CAUTION - 1.0) * close)
                    if spent + dear >= cost[other]:
                        continue
                    if at_end:
                        if other == target:
                            there[:] = ends[1]
                        else:
                            there[0], there[1], there[2] = px, py, pz
                        keep = radius + min(0.0, near - 1e-9)
                        if not free(scene, keep, here, there, 0.0, 0.0, gaps):
                            continue
                    elif spare + distance[other] - radius < way:
                        there[0], there[1], there[2] = px, py, pz
                        if not free(scene, radius, here, there, spare, distance[other] - radius, gaps):
                            continue
                    cost[other], run[other], parent[other] = spent + dear, ran + way, node
                    key = spent + dear + left
                    if size == keys.shape[0]:
                        keys, nodes = np.append(keys, np.empty_like(keys)), np.append(nodes, np.empty_like(nodes))
                    i = size
                    size += 1
                    while i > 0 and keys[(i - 1) // 2] > key:  # sift up
                        keys[i], nodes[i] = keys[(i - 1) // 2], nodes[(i - 1) // 2]
                        i = (i - 1) // 2
                    keys[i], nodes[i] = key, other
    if cost[target] == np.inf:
        return np.empty(0, dtype=np.int64)
    count, node = 1, target
    while node != begin:
        node = parent[node]
        count += 1
    path, node = np.empty(count, dtype=np.int64), target
    for i in range(count - 1, -1, -1):
        path[i] = node
        node = parent[node]
    return path


@kernel
def burden_along(lattice: Lattice, path: NDArray[np.int64], factor: float) -> None:
    """Multiply the burden of the path's points and of their neighbours, once each, by `factor`."""
    nx, ny, nz = lattice.shape[0], lattice.shape[1], lattice.shape[2]
    burden = lattice.burden
    done = np.zeros(burden.shape[0], dtype=np.uint8)
    for node in path:
        ix, iy, iz = node // (ny * nz), (node // nz) % ny, node % nz
        for jx in range(max(ix - 1, 0), min(ix + 2, nx)):
            for jy in range(max(iy - 1, 0), min(iy + 2, ny)):
                for jz in range(max(iz - 1, 0), min(iz + 2, nz)):
                    other = (jx * ny + jy) * nz + jz
                    if not done[other]:
                        done[other] = 1
                        burden[other] *= factor
