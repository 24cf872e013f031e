"""A last look at what is to be flown, against what is seen now: when would the vehicle first come too near?

The planner proves; this samples, in the flight loop, on the very newest map: every `EVERY_S`, with half the longest
step between two samples added to the radius, so that nothing slips through between.
"""

import math

import numpy as np

from companion.jit import kernel
from companion.seam import FloatArray, Flown
from companion.seeing.rollingmap import LongArray, RollingMap, ShortArray
from planner import MovingSphere
from planner.movers import table

EVERY_S = 0.02


@kernel
def first_violation(
    times: FloatArray,
    points: FloatArray,
    low: ShortArray,
    high: ShortArray,
    window: LongArray,
    cells: FloatArray,
    movers: FloatArray,
    radius: float,
) -> int:
    """Index of the first sample that is too near to a taken cell or a mover, -1 without any.

    Parameters
    ----------
    times, points : (m,) movers' clock [s], (m, 3) [m].
    low, high, window : as `RollingMap` has them.
    cells : (4,) resolution [m], how far above and below a hit is taken [m], lowest and highest z that count [m].
    movers : (k, 13) of `planner.movers.table`, balls only.
    radius : to keep [m].
    """
    n, size, column = low.shape[0], cells[0], cells[1]
    for s in range(points.shape[0]):
        x, y, z = points[s, 0], points[s, 1], points[s, 2]
        for i in range(math.floor((x - radius) / size), math.floor((x + radius) / size) + 1):
            if not window[0] <= i < window[0] + n:
                continue
            gx = max(max(i * size - x, x - (i + 1) * size), 0.0)
            for j in range(math.floor((y - radius) / size), math.floor((y + radius) / size) + 1):
                if not window[1] <= j < window[1] + n:
                    continue
                a, b = i % n, j % n
                if high[a, b] <= low[a, b]:
                    continue
                gy = max(max(j * size - y, y - (j + 1) * size), 0.0)
                bottom, top = max(low[a, b] * size - column, cells[2]), min(high[a, b] * size + column, cells[3])
                gz = max(max(bottom - z, z - top), 0.0)
                if gx * gx + gy * gy + gz * gz < radius * radius:
                    return s
        for m in range(movers.shape[0]):
            t = times[s] - movers[m, 11]
            if times[s] > movers[m, 12]:
                continue
            gap = 0.0
            for axis in range(3):
                gap += (points[s, axis] - movers[m, 1 + axis] - movers[m, 7 + axis] * t) ** 2
            if gap < (radius + movers[m, 4] + movers[m, 10] * abs(t)) ** 2:
                return s
    return -1


def clear_for(
    flown: Flown,
    from_us: int,
    until_us: int,
    seen: RollingMap,
    movers: tuple[MovingSphere, ...],
    radius: float,
) -> float:
    """For how long [s] from `from_us` on the radius is kept; infinity when it is kept until `until_us`."""
    until_us = max(until_us, from_us)
    steps = max(1, math.ceil((until_us - from_us) / 1e6 / EVERY_S))
    times: FloatArray = (from_us - flown.start_us) / 1e6 + EVERY_S * np.arange(steps + 1, dtype=np.float64)
    points: FloatArray = flown.trajectory.position(times)
    stretch = float(np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1)).max())
    cells = np.array([seen.resolution, seen.column, *seen.z])
    rows = table(movers)
    clock: FloatArray = times + flown.start_us / 1e6
    at = first_violation(clock, points, seen.low, seen.high, seen.window, cells, rows, radius + 0.5 * stretch)
    return math.inf if at < 0 else at * EVERY_S


__all__ = ["clear_for", "first_violation"]
