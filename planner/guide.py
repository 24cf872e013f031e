"""The way round, when bows do not find it: A* on a coarse grid of the free space, then pulled taut.

The grid is the map less the radius. An edge to one of the 26 neighbours is free when all of it keeps the radius and a
little more, proved with the 1-Lipschitz distance: no solid is too thin to be seen. Edges nearer than BUFFER beyond the
radius count up to CAUTION times longer, so that the way leads through the middle of what is narrow. What it is pulled
taut by keeps half of that buffer. The result is a guess for the spline all the same: what it leads to is proved or
refused like any other curve. Hart, Nilsson & Raphael 1968; the heuristic is the straight distance.
"""

import math
from dataclasses import dataclass

import numpy as np

from planner.bspline import FloatArray
from planner.distance import Scene, nearest_solid
from planner.jit import kernel
from planner.worlds import World

CELLS = (4.0, 2.0, 1.0, 0.5, 0.25, 0.125)
"""Cell widths tried in turn [m]: those that make FEWEST_CELLS to MOST_CELLS of a map; a larger map gets wider ones."""
FEWEST_CELLS, MOST_CELLS = 5_000, 2_000_000
SLACK = 0.01
"""Beyond the radius, what a guide keeps [m]: one that just touches leaves the spline no room."""
BUFFER, CAUTION = 0.3, 3.0


@dataclass(frozen=True, slots=True)
class Guide:
    """What the search graph says: a polyline from start to goal, and by what cells."""

    path: FloatArray  # (m, 3) [m]; m = 0 when the cells show no way
    width: float  # of the finest cells looked at [m]

    @property
    def length(self) -> float:
        """[m], inf when there is no way."""
        if not len(self.path):
            return math.inf
        return float(np.linalg.norm(np.diff(self.path, axis=0), axis=1).sum())


@kernel
def _free(scene: Scene, radius: float, a: FloatArray, b: FloatArray) -> bool:
    """Whether the segment from a to b keeps the radius less SLACK / 2.

    Sphere marching: the distance is 1-Lipschitz, so from a point that keeps the radius a step of d - radius + SLACK / 2
    meets nothing nearer than that. True is a proof, False means that a point nearer than the radius was met.
    """
    length = math.sqrt((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2 + (b[2] - a[2]) ** 2)
    t = 0.0
    while True:
        f = t / length if length > 0.0 else 0.0
        d, _ = nearest_solid(scene, a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2]))
        if d < radius:
            return False
        if t >= length:
            return True
        t = min(t + d - radius + 0.5 * SLACK, length)


@kernel
def astar(
    scene: Scene,
    origin: FloatArray,
    step: FloatArray,
    shape: FloatArray,
    ends: FloatArray,
    radius: float,
) -> FloatArray:
    """Cells' centres (m, 3) from the cell of ends[0] to that of ends[1]; empty when they are not connected.

    origin, step, shape (3,): first centre, spacing, number of cells (whole numbers). The first and the last cell stand
    for the ends themselves: edges from and to them are judged from there, and keep what the end keeps if that is less.
    """
    nx, ny, nz = int(shape[0]), int(shape[1]), int(shape[2])
    total = nx * ny * nz
    distance = np.full(total, np.nan)  # not looked at yet
    here, there = np.empty(3), np.empty(3)
    cost = np.full(total, np.inf)
    parent = np.full(total, -1, dtype=np.int64)
    index = np.empty((2, 3), dtype=np.int64)
    for e in range(2):
        for a in range(3):
            index[e, a] = min(max(int((ends[e, a] - origin[a]) / step[a] + 0.5), 0), int(shape[a]) - 1)
    begin = (index[0, 0] * ny + index[0, 1]) * nz + index[0, 2]
    target = (index[1, 0] * ny + index[1, 1]) * nz + index[1, 2]
    keys, nodes, size = np.empty(1024), np.empty(1024, dtype=np.int64), 1  # a binary heap
    keys[0], nodes[0], cost[begin] = 0.0, begin, 0.0
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
        for a in range(3):
            here[a] = ends[0, a] if node == begin else origin[a] + (ix, iy, iz)[a] * step[a]
        if math.isnan(distance[node]):
            distance[node], _ = nearest_solid(scene, here[0], here[1], here[2])
        h0 = math.sqrt(
            ((ix - index[1, 0]) * step[0]) ** 2
            + ((iy - index[1, 1]) * step[1]) ** 2
            + ((iz - index[1, 2]) * step[2]) ** 2
        )
        if key > cost[node] + h0 + 1e-9:
            continue  # an older, dearer entry
        for dx in range(-1, 2):
            for dy in range(-1, 2):
                for dz in range(-1, 2):
                    jx, jy, jz = ix + dx, iy + dy, iz + dz
                    if (dx == 0 and dy == 0 and dz == 0) or not (0 <= jx < nx and 0 <= jy < ny and 0 <= jz < nz):
                        continue
                    other = (jx * ny + jy) * nz + jz
                    way = math.sqrt((dx * step[0]) ** 2 + (dy * step[1]) ** 2 + (dz * step[2]) ** 2)
                    if cost[node] + way >= cost[other]:
                        continue
                    for a in range(3):
                        there[a] = ends[1, a] if other == target else origin[a] + (jx, jy, jz)[a] * step[a]
                    if math.isnan(distance[other]):
                        distance[other], _ = nearest_solid(scene, there[0], there[1], there[2])
                    near = min(distance[node], distance[other])
                    keep = min(radius, near - 1e-9) if node == begin or other == target else radius
                    if near < keep:
                        continue
                    short = distance[node] + distance[other] < 2.0 * radius + way or node == begin or other == target
                    way *= 1.0 + (CAUTION - 1.0) * max(0.0, 1.0 - (near - radius) / BUFFER)
                    if cost[node] + way >= cost[other]:
                        continue
                    if short and not _free(scene, keep, here, there):
                        continue
                    cost[other], parent[other] = cost[node] + way, node
                    key = cost[other] + math.sqrt(
                        ((jx - index[1, 0]) * step[0]) ** 2
                        + ((jy - index[1, 1]) * step[1]) ** 2
                        + ((jz - index[1, 2]) * step[2]) ** 2
                    )
                    if size == keys.shape[0]:
                        keys, nodes = np.append(keys, np.empty_like(keys)), np.append(nodes, np.empty_like(nodes))
                    i = size
                    size += 1
                    while i > 0 and keys[(i - 1) // 2] > key:  # sift up
                        keys[i], nodes[i] = keys[(i - 1) // 2], nodes[(i - 1) // 2]
                        i = (i - 1) // 2
                    keys[i], nodes[i] = key, other
    if cost[target] == np.inf:
        return np.empty((0, 3))
    count, node = 1, target
    while node != begin:
        node = parent[node]
        count += 1
    path, node = np.empty((count, 3)), target
    for i in range(count - 1, -1, -1):
        path[i, 0] = origin[0] + (node // (ny * nz)) * step[0]
        path[i, 1] = origin[1] + ((node // nz) % ny) * step[1]
        path[i, 2] = origin[2] + (node % nz) * step[2]
        node = parent[node]
    return path


@kernel
def pull_taut(scene: Scene, radius: float, path: FloatArray) -> FloatArray:
    """The corners (m, 3) left when every point that the one after next can be seen past is dropped."""
    kept = np.empty_like(path)
    kept[0] = path[0]
    count, i, last = 1, 0, path.shape[0] - 1
    while i < last:
        j = i + 1
        while j < last and _free(scene, radius, path[i], path[j + 1]):
            j += 1
        kept[count] = path[j]
        count += 1
        i = j
    return kept[:count].copy()


def widths(extent: FloatArray) -> list[float]:
    """The cell widths for a map of that extent (3,), coarsest first and at least one, whatever its size [m]."""
    fitting = [width for width in CELLS if FEWEST_CELLS <= _cells(extent, width) <= MOST_CELLS]
    if not fitting and _cells(extent, CELLS[-1]) < FEWEST_CELLS:
        return [CELLS[-1]]
    wider = CELLS[0]
    while not fitting:
        wider *= 1.25
        if _cells(extent, wider) <= MOST_CELLS:
            fitting.append(wider)
    return fitting


def _cells(extent: FloatArray, width: float) -> float:
    return float(np.prod(np.maximum(np.ceil(extent / width), 1.0) + 1.0))


def guide(world: World, start: FloatArray, goal: FloatArray, radius: float) -> Guide:
    """The way that the coarsest grid with one shows, pulled taut.

    Parameters
    ----------
    start, goal : (3,)    in the map, keeping the radius [m].
    """
    low, high = world.walls[0] + radius, world.walls[1] - radius
    ends = np.array([start, goal])
    for width in widths(high - low):
        shape = np.maximum(np.ceil((high - low) / width), 1.0) + 1.0
        step = np.maximum((high - low) / (shape - 1.0), 1e-9)
        path = astar(world.scene, low, step, shape, ends, radius + SLACK)
        if len(path):
            whole = np.concatenate([ends[:1], path[1:-1], ends[1:]])
            return Guide(np.asarray(pull_taut(world.scene, radius + BUFFER / 2.0, whole)), width)
    return Guide(np.empty((0, 3)), width)
