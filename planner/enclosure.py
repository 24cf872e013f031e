"""Proof that no curve leads from start to goal: cells that no curve can enter wall the one off from the other.

The map less the radius is cut into cells by planes square to its axes. A cell is blocked when all of it is nearer to a
solid than the radius. Signed distances to a convex solid are convex functions, so all of a cell is nearer than r to it
when its eight corners are. A curve that keeps the radius never meets a blocked cell and goes from cell to neighbouring
cell, of which each has 26, corners included. So when the cells not blocked that can be reached from the start's do not
include the goal's, there is no such curve, thick or thin, certified or not. The other outcome proves nothing.

The planes are laid where solids make them tell most: at the faces of a box that just fits into each solid thickened by
the radius. One layer of cells then closes a wall, however thin it is, and one cell of full height is enough for one of
full height. Finer planes are laid between these in turn, as long as the reckoning takes at most MOST_DISTANCES and has
at most MOST_CORNERS; in a large map, only around start and goal. "Keeps the radius" is meant as `certificate` needs it,
a rounding margin included.
"""

import itertools
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from planner.bspline import FloatArray
from planner.certificate import margin, needed
from planner.distance import NOTCHED, Scene, nearest_exact, nearest_solid, solid_distance
from planner.jit import kernel, leaf
from planner.surroundings import surroundings
from planner.worlds import Box, Cylinder, Obstacle, Sphere, World

PITCHES = (
    (math.inf, math.inf),
    *((w, math.inf) for w in (1.0, 0.5, 0.25, 0.125)),
    *((w, w) for w in (0.5, 0.25, 0.125)),
)
"""Most that planes are apart, in turn [m]: upright ones, and level ones. Most obstacles stand."""
MOST_DISTANCES = 30_000_000
"""Corners times solids of one reckoning: about 0.1 s, if all of them had to be asked for."""
MOST_CORNERS = 8_000_000
"""Of one reckoning: each takes some 30 bytes."""


@leaf
def blocked(scene: Scene, corners: FloatArray, nearest: NDArray[np.int64], need: float) -> bool:
    """Whether all of a cell with these corners (8, 3) is nearer than `need` to what is solid; False if in doubt.

    `nearest` (8,): what is nearest to each corner, all nearer than `need` already.
    """
    solids, edges = scene.solids, scene.edges
    for i in range(8):
        k = nearest[i]
        if k == solids.shape[0] or solids[k, 0] >= NOTCHED:
            continue  # corners tell nothing about what is not convex
        inside = True
        for c in range(8):
            if nearest[c] != k:
                d, _, _, _ = solid_distance(solids, edges, k, corners[c, 0], corners[c, 1], corners[c, 2])
                if not d < need:
                    inside = False
                    break
        if inside:
            return True
    # A distance is 1-Lipschitz: the centre's plus half the diagonal. Inside voxels it is known from below only.
    x, y, z = corners[0, 0] + corners[7, 0], corners[0, 1] + corners[7, 1], corners[0, 2] + corners[7, 2]
    dx, dy, dz = corners[7, 0] - corners[0, 0], corners[7, 1] - corners[0, 1], corners[7, 2] - corners[0, 2]
    half = 0.5 * math.sqrt(dx * dx + dy * dy + dz * dz)
    if half >= need:
        return False
    d, _ = nearest_exact(scene, 0.5 * x, 0.5 * y, 0.5 * z, need)
    return max(d, 0.0) + half < need


@kernel
def reachable(
    scene: Scene, xs: FloatArray, ys: FloatArray, zs: FloatArray, cells: NDArray[np.int64], need: float
) -> bool:
    """Whether cells not blocked join cells[0] to cells[1] (2, 3), cell i lying between planes i and i + 1.

    Both ends spread by turns, a cell each: where one of them is shut in, it is soon known.
    """
    nx, ny, nz = xs.shape[0] - 1, ys.shape[0] - 1, zs.shape[0] - 1
    my, mz = ny + 1, nz + 1
    near = np.full((nx + 1) * my * mz, np.nan)
    solid = np.empty((nx + 1) * my * mz, dtype=np.int64)
    owner = np.zeros(nx * ny * nz, dtype=np.uint8)  # 0 not looked at, 1 start's, 2 goal's, 3 blocked
    queue = np.empty((2, nx * ny * nz), dtype=np.int64)
    first, count = np.zeros(2, dtype=np.int64), np.ones(2, dtype=np.int64)
    corners, nearest = np.empty((8, 3)), np.empty(8, dtype=np.int64)
    for e in range(2):
        queue[e, 0] = (cells[e, 0] * ny + cells[e, 1]) * nz + cells[e, 2]
        if owner[queue[e, 0]] != 0:
            return True
        owner[queue[e, 0]] = e + 1
    e = 0
    while first[e] < count[e]:
        cell = queue[e, first[e]]
        first[e] += 1
        ix, iy, iz = cell // (ny * nz), (cell // nz) % ny, cell % nz
        for jx in range(max(ix - 1, 0), min(ix + 2, nx)):
            for jy in range(max(iy - 1, 0), min(iy + 2, ny)):
                for jz in range(max(iz - 1, 0), min(iz + 2, nz)):
                    other = (jx * ny + jy) * nz + jz
                    if owner[other] == 2 - e:
                        return True
                    if owner[other] != 0:
                        continue
                    inside = True
                    for c in range(8):
                        kx, ky, kz = jx + (c & 1), jy + ((c >> 1) & 1), jz + (c >> 2)
                        node = (kx * my + ky) * mz + kz
                        if math.isnan(near[node]):
                            near[node], solid[node] = nearest_solid(scene, xs[kx], ys[ky], zs[kz])
                        if not near[node] < need:
                            inside = False
                            break
                        corners[c, 0], corners[c, 1], corners[c, 2], nearest[c] = xs[kx], ys[ky], zs[kz], solid[node]
                    if inside and blocked(scene, corners, nearest, need):
                        owner[other] = 3
                        continue
                    owner[other] = e + 1
                    queue[e, count[e]] = other
                    count[e] += 1
        e = 1 - e
    return False


def apart(
    world: World, start: FloatArray, goal: FloatArray, radius: float, pitches: Sequence[tuple[float, float]]
) -> bool:
    """Whether planes at most as far apart as one of `pitches`, tried in turn, prove that nothing joins start and goal.

    Parameters
    ----------
    start, goal : (3,)    in the map, keeping what a proof needs [m].
    """
    solids = max(len(world.owners), 1)  # the voxels count as one
    most = min(MOST_DISTANCES // solids, MOST_CORNERS)
    near = surroundings(world.walls, np.array([start, goal]))
    everywhere, nowhere = world.walls, np.zeros((2, 3))
    for place in (everywhere, near, nowhere):  # whose faces count
        faces = [face_planes(world, radius, axis, near, place) for axis in range(3)]
        if math.prod(len(plane) for plane in faces) <= most:
            break
    for upright, level in pitches:
        pitched = [(faces[axis], (upright, upright, level)[axis], near[:, axis]) for axis in range(3)]
        if math.prod(float(parts(*of).sum()) + 1.0 for of in pitched) > most:
            return False
        planes = [subdivided(*of) for of in pitched]
        cells = np.empty((2, 3), dtype=np.int64)
        for axis, plane in enumerate(planes):
            ends = (start[axis], goal[axis])
            cells[:, axis] = np.clip(np.searchsorted(plane, ends, side="right") - 1, 0, len(plane) - 2)
        if not reachable(world.scene, planes[0], planes[1], planes[2], cells, radius + margin(world)):
            return True
    return False


def face_planes(world: World, radius: float, axis: int, near: FloatArray, place: FloatArray) -> FloatArray:
    """Where planes square to an axis tell most, ascending [m]: the map's walls and the solids' faces, moved by the
    radius; and the ends of what is near.

    Parameters
    ----------
    near : (2, 3)     the question's surroundings, all of a small map [m].
    place : (2, 3)    where solids' faces have to lie to count [m].
    """
    room, unit = needed(world, radius), margin(world)
    low, high = float(world.walls[0, axis]) + room, float(world.walls[1, axis]) - room
    found = near[:, axis].tolist()
    for obstacle in world.obstacles:
        found += [v for v in core(obstacle, radius, axis) if place[0, axis] < v < place[1, axis]]
    planes = np.sort(np.array([low, high, *(v for v in found if low + unit < v < high - unit)]))
    apart_enough = np.concatenate([[True], np.diff(planes) > unit])
    return np.asarray(planes[apart_enough])


def core(obstacle: Obstacle, radius: float, axis: int) -> tuple[float, float]:
    """Along one axis, the extent of a box that fits into an obstacle thickened by the radius, as large as may be."""
    if isinstance(obstacle, Box):
        more = radius / math.sqrt(3.0)
        return obstacle.lower[axis] - more, obstacle.upper[axis] + more
    if isinstance(obstacle, Cylinder):
        half = (obstacle.radius + radius) / math.sqrt(2.0)
        return obstacle.z if axis == 2 else (obstacle.centre[axis] - half, obstacle.centre[axis] + half)
    if isinstance(obstacle, Sphere):
        half = (obstacle.radius + radius) / math.sqrt(3.0)
        return obstacle.centre[axis] - half, obstacle.centre[axis] + half
    return math.inf, -math.inf


def parts(planes: FloatArray, pitch: float, near: FloatArray) -> FloatArray:
    """Into how many parts each gap (m - 1,) between planes (m,) is cut: to at most `pitch` [m] in `near` (2,)."""
    middles = (planes[1:] + planes[:-1]) / 2.0
    counts: FloatArray = np.maximum(np.ceil(np.diff(planes) / pitch), 1.0)
    counts[(middles < near[0]) | (middles > near[1])] = 1.0
    return counts


def subdivided(planes: FloatArray, pitch: float, near: FloatArray) -> FloatArray:
    """The planes (m,) and as many between them as make gaps of at most `pitch` [m] in what is near (2,)."""
    counts = parts(planes, pitch, near).astype(np.int64).tolist()
    pieces = [np.linspace(a, b, n + 1)[:-1] for (a, b), n in zip(itertools.pairwise(planes), counts, strict=True)]
    return np.concatenate([*pieces, planes[-1:]])
