"""The rolling map: which cells around the vehicle are taken, by what rays hit and what they passed through.

    hit at p        the cell under p is taken from p's height on down and up to what was seen of it
    ray through     a taken cell that MISSES scans in a row look through, at a height where it was taken, is free again
    time            a cell not seen for `decay_s` is forgotten, but never near the path that was flown: a pocket once
                    left must not look open again on the way back

Cells stand on one lattice of the mission frame, so that a cell keeps its place while the window rolls over it: cell
(i, j) is kept at (i mod n, j mod n). Of each only one interval of heights is known, the union of what was hit; `column`
says how far above and below a hit is taken as well. The ray's cells are those of Amanatides & Woo, A Fast Voxel
Traversal Algorithm for Ray Tracing, Eurographics 1987.
"""

import math

import numpy as np
from numpy.typing import NDArray

from companion.jit import kernel
from companion.seam import FloatArray, MapView
from companion.seeing.sensing import Scan

ShortArray = NDArray[np.int16]
LongArray = NDArray[np.int64]
ByteArray = NDArray[np.uint8]

MISSES = 3
"""Scans in a row that must look through a cell before it is free."""
SPARED = 1.5
"""Cells at the end of a ray that it does not free."""
STRIDE = 2.0
"""The window is moved when the vehicle is so far from its middle [m]."""
KEPT = 3.0
"""Cells this near to the path flown are never forgotten [m]."""
LATER_US = 30_000_000
MOST_PLACES = 500
"""Of the path flown, a metre apart each."""
SWEEP_US = 1_000_000
EMPTY = -(1 << 40)


@kernel
def put_hits(
    points: FloatArray,
    low: ShortArray,
    high: ShortArray,
    stamp: LongArray,
    misses: ByteArray,
    mark: LongArray,
    window: LongArray,
    resolution: float,
    flight_us: int,
    turn: int,
) -> int:
    """Take the cells of points (m, 3) [m]; how many were free before."""
    n, fresh = low.shape[0], 0
    for m in range(points.shape[0]):
        i, j = math.floor(points[m, 0] / resolution), math.floor(points[m, 1] / resolution)
        if not (window[0] <= i < window[0] + n and window[1] <= j < window[1] + n):
            continue
        k, a, b = math.floor(points[m, 2] / resolution), i % n, j % n
        if high[a, b] <= low[a, b]:
            low[a, b], high[a, b] = k, k + 1
            fresh += 1
        elif k < low[a, b] or k >= high[a, b]:
            low[a, b], high[a, b] = min(low[a, b], k), max(high[a, b], k + 1)
            fresh += 1
        stamp[a, b], misses[a, b], mark[a, b] = flight_us, 0, turn
    return fresh


@kernel
def look_through(
    origin: FloatArray,
    directions: FloatArray,
    reach: FloatArray,
    low: ShortArray,
    high: ShortArray,
    misses: ByteArray,
    mark: LongArray,
    window: LongArray,
    resolution: float,
    turn: int,
    most: int,
) -> int:
    """Count a miss for each taken cell that rays pass, `reach` (m,) [m] far; how many are free now."""
    n, freed = low.shape[0], 0
    for m in range(directions.shape[0]):
        x, y, z = origin[0], origin[1], origin[2]
        dx, dy, dz = directions[m, 0], directions[m, 1], directions[m, 2]
        i, j = math.floor(x / resolution), math.floor(y / resolution)
        step_i, step_j = (1 if dx > 0.0 else -1), (1 if dy > 0.0 else -1)
        each_i = resolution / abs(dx) if dx != 0.0 else math.inf
        each_j = resolution / abs(dy) if dy != 0.0 else math.inf
        next_i = ((i + (1 if dx > 0.0 else 0)) * resolution - x) / dx if dx != 0.0 else math.inf
        next_j = ((j + (1 if dy > 0.0 else 0)) * resolution - y) / dy if dy != 0.0 else math.inf
        t = 0.0
        while t < reach[m]:
            if not (window[0] <= i < window[0] + n and window[1] <= j < window[1] + n):
                break
            a, b = i % n, j % n
            leave = min(next_i, next_j)
            if high[a, b] > low[a, b] and mark[a, b] != turn and leave < reach[m]:
                k = math.floor((z + 0.5 * (t + leave) * dz) / resolution)
                if low[a, b] <= k < high[a, b]:
                    mark[a, b] = turn
                    misses[a, b] += 1
                    if misses[a, b] >= most:
                        low[a, b] = high[a, b] = 0
                        freed += 1
            t = leave
            if next_i < next_j:
                i, next_i = i + step_i, next_i + each_i
            else:
                j, next_j = j + step_j, next_j + each_j
    return freed


class RollingMap:
    """What stands around the vehicle.

    Parameters
    ----------
    resolution : edge of a cell [m].
    z : (low, high) of the heights that matter, the world's bounds (down) [m].
    column : how far above and below a hit is taken, too [m]; infinity: from bottom to top.
    extent : edge of the window [m].
    decay_s : after which an unseen cell is forgotten [s].
    """

    def __init__(
        self,
        resolution: float = 0.1,
        z: tuple[float, float] = (-math.inf, math.inf),
        column: float = math.inf,
        extent: float = 48.0,
        decay_s: float = 120.0,
    ) -> None:
        self.resolution, self.z, self.column = resolution, z, column
        n = max(8, round(extent / resolution))
        self.low: ShortArray = np.zeros((n, n), dtype=np.int16)
        self.high: ShortArray = np.zeros((n, n), dtype=np.int16)
        self.window: LongArray = np.zeros(2, dtype=np.int64)  # the window's lowest cell
        self.version = 0
        self._stamp: LongArray = np.full((n, n), EMPTY, dtype=np.int64)
        self._misses = np.zeros((n, n), dtype=np.uint8)
        self._mark: LongArray = np.zeros((n, n), dtype=np.int64)
        self._turn, self._decay_us, self._sweep_us = 0, round(decay_s * 1e6), 0
        self._path: list[FloatArray] = []
        self._placed = False
        self._seen: tuple[int, MapView] | None = None

    def add(self, flight_us: int, scan: Scan) -> int:
        """Take in a scan; the number of cells that changed."""
        self._roll(scan.position_m)
        self._turn += 1
        hit = np.isfinite(scan.distance)
        points = scan.position_m + scan.directions[hit] * scan.distance[hit, None]
        inside = (points[:, 2] > self.z[0]) & (points[:, 2] < self.z[1])
        points = np.ascontiguousarray(points[inside])
        r, table = self.resolution, (self.low, self.high)
        changed = put_hits(points, *table, self._stamp, self._misses, self._mark, self.window, r, flight_us, self._turn)
        known = ~np.isnan(scan.distance)
        reach = np.where(hit, scan.distance - SPARED * r, scan.maximum)[known]
        changed += look_through(
            scan.position_m, np.ascontiguousarray(scan.directions[known]), reach, *table, self._misses, self._mark,
            self.window, r, self._turn, MISSES,
        )  # fmt: skip
        self.version += changed > 0
        return int(changed)

    def here(self, position_m: FloatArray, radius: float) -> None:
        """Free the cells whose middle is within the vehicle's own ball: where it is, nothing else can be."""
        r, n = self.resolution, self.low.shape[0]
        low, high = np.floor((position_m[:2] - radius) / r), np.floor((position_m[:2] + radius) / r)
        i, j = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1), indexing="ij")
        inside = ((i + 0.5) * r - position_m[0]) ** 2 + ((j + 0.5) * r - position_m[1]) ** 2 < radius**2
        a, b = i[inside].astype(np.int64) % n, j[inside].astype(np.int64) % n
        if (self.high[a, b] > self.low[a, b]).any():
            self.low[a, b] = self.high[a, b] = 0
            self.version += 1

    def decay(self, flight_us: int) -> None:
        """Forget what was not seen for long and is not near the path flown; once a second, whenever it is called."""
        if flight_us - self._sweep_us < SWEEP_US:
            return
        self._sweep_us = flight_us
        a, b = np.nonzero((self.high > self.low) & (self._stamp < flight_us - self._decay_us))
        if not len(a):
            return
        if self._path:
            path = np.array(self._path)[:, :2]
            middle = (np.column_stack(self._cells(a, b)) + 0.5) * self.resolution
            far = np.array([((place - path) ** 2).sum(axis=1).min() > KEPT**2 for place in middle])
            self._stamp[a[~far], b[~far]] = flight_us - self._decay_us + LATER_US  # asked again then, not every second
            a, b = a[far], b[far]
        self.low[a, b] = self.high[a, b] = 0
        self.version += len(a) > 0

    def forget_unseen(self, since_us: int) -> None:
        """Forget what was not hit since a time: some of it may never have been there."""
        a, b = np.nonzero((self.high > self.low) & (self._stamp < since_us))
        self.low[a, b] = self.high[a, b] = 0
        self.version += len(a) > 0

    def forget_around(self, places: FloatArray, radius: float, since_us: int) -> None:
        """Forget cells within a radius [m] of places (m, 2) that were hit since a time: it was something that moves."""
        a, b = np.nonzero((self.high > self.low) & (self._stamp >= since_us))
        if not len(a):
            return
        middle = (np.column_stack(self._cells(a, b)) + 0.5) * self.resolution
        near = (((middle[:, None, :] - places[None]) ** 2).sum(axis=2) <= radius**2).any(axis=1)
        self.low[a[near], b[near]] = self.high[a[near], b[near]] = 0
        self.version += bool(near.any())

    def shift(self) -> None:
        """Forget everything: the frame has moved under the map."""
        self.low[:] = self.high[:] = 0
        self._path.clear()
        self.version += 1

    def view(self) -> MapView:
        """The cells that are taken, as upright runs within the world's heights; the same object until it changes."""
        if self._seen is None or self._seen[0] != self.version:
            self._seen = (self.version, self._runs())
        return self._seen[1]

    def _runs(self) -> MapView:
        a, b = np.nonzero(self.high > self.low)
        i, j = self._cells(a, b)
        low, high = self.low[a, b].astype(np.int64), self.high[a, b].astype(np.int64)
        more = self.column / self.resolution
        bottom, top = (np.clip(np.array(self.z) / self.resolution, -32_000, 32_000)).tolist()
        k0 = (
            np.maximum(low - math.ceil(more), math.floor(bottom)) if more < 1e5 else np.full(len(a), math.floor(bottom))
        )
        k1 = np.minimum(high + math.ceil(more), math.ceil(top)) if more < 1e5 else np.full(len(a), math.ceil(top))
        order = np.lexsort((j, i))
        first = self.window.tolist()  # counted from there, numbers stay small wherever the flight is
        runs = np.column_stack((i - first[0], j - first[1], k0, k1))[order].astype(np.int16)
        origin = (first[0] * self.resolution, first[1] * self.resolution, 0.0)
        return MapView(origin, self.resolution, runs, self.version)

    def _cells(self, a: NDArray[np.int64], b: NDArray[np.int64]) -> tuple[LongArray, LongArray]:
        """The lattice's (i, j) of places in the arrays."""
        n = self.low.shape[0]
        return (a - self.window[0]) % n + self.window[0], (b - self.window[1]) % n + self.window[1]

    def _roll(self, position_m: FloatArray) -> None:
        """Keep the window around the vehicle, forgetting what leaves it; and remember where it was."""
        if not self._path or math.dist(position_m[:2], self._path[-1][:2]) > 1.0:
            self._path.append(position_m.copy())
            del self._path[:-MOST_PLACES]
        n, r = self.low.shape[0], self.resolution
        wanted = np.floor(position_m[:2] / r).astype(np.int64) - n // 2
        moved = wanted - self.window
        if self._placed and int(np.abs(moved).max()) * r < STRIDE:
            return
        for axis in (0, 1):
            gone = int(np.clip(moved[axis], -n, n))
            if gone and self._placed:
                first = self.window[axis] if gone > 0 else self.window[axis] + n + gone
                places = np.arange(first, first + abs(gone)) % n
                taken = (places, slice(None)) if axis == 0 else (slice(None), places)
                self.low[taken] = self.high[taken] = 0
        self.window[:] = wanted
        self._placed = True
