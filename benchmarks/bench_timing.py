"""Durations against the least that a run along the same path needs: `python -m benchmarks.bench_timing [worlds]`.

The path is that of the final trajectory, the limits are the same, and the oracle is `minimum_time`.
"""

import sys
import time

import numpy as np

from benchmarks.bench_planner import LIMITS, WORLDS, world_of
from benchmarks.minimum_time import Path, arc, least_time, line, straight
from planner import plan, warm_up
from planner.families import RADIUS
from planner.query import Query
from planner.shape import Effort, haoaroa
from planner.timing import timings, uniform_scaling

CELLS = 600


def oracle() -> None:
    """What the oracle itself is worth: against closed forms."""
    print("| path | cells | oracle s | closed form s | ratio |")
    print("|---|---|---|---|---|")
    for length in (0.05, 2.0, 18.0):
        truth = straight(length, *bounds())
        for cells in (300, CELLS, 1200):
            found = least_time(line(length, cells), *bounds())
            print(f"| line of {length:g} m | {cells} | {found:.4f} | {truth:.4f} | {found / truth:.4f} |")
    for radius in (0.5, 0.2):  # so long that the ends count for little: v^2/r = a, or v^3/r^2 = j
        top = min((LIMITS.acceleration * radius) ** 0.5, (LIMITS.jerk * radius**2) ** (1 / 3))
        found = [least_time(arc(radius, angle, CELLS), *bounds()) for angle in (20, 40)]
        rate = radius * 20 / (found[1] - found[0])
        print(f"| arc of {radius:g} m, cruising | {CELLS} | {rate:.4f} m/s | {top:.4f} m/s | {top / rate:.4f} |")


def families(most: int) -> None:
    """Every family: duration, what one time scale for the same shape gives, the oracle, and what timing takes."""
    print("\n| family | duration s | one time scale s | least s | ratio median | max | timing ms | plan ms | p95 |")
    print("|---|---|---|---|---|---|---|---|---|")
    for family, worlds in WORLDS.items():
        rows = []
        for seed in range(min(worlds, most)):
            world, start, goal = world_of(family, seed)
            p = plan(world, start, goal, LIMITS, RADIUS, seed=seed)
            points, knots = p.trajectory.control_points, p.trajectory.knots
            least = least_time(Path.of_spline(knots, points, CELLS), *bounds(), gap=1e-3)
            query = Query(world, np.array(start), np.array(goal), LIMITS, RADIUS, seed)
            shape = next(haoaroa(query, Effort()))
            slow = uniform_scaling(shape.control_points, LIMITS)[-1]
            begin = time.thread_time()
            next(timings(shape.control_points, shape.knots, LIMITS))
            rows.append((p.trajectory.duration, slow, least, 1e3 * (time.thread_time() - begin), p.cpu_ms))
        duration, slow, least, took, whole = np.array(rows).T
        ratio = duration / least
        print(
            f"| {family} | {np.median(duration):.3f} | {np.median(slow):.3f} | {np.median(least):.3f} "
            f"| {np.median(ratio):.4f} | {ratio.max():.4f} | {np.median(took):.2f} | {np.median(whole):.2f} "
            f"| {np.percentile(whole, 95):.2f} |"
        )


def bounds() -> tuple[float, float, float]:
    return LIMITS.speed, LIMITS.acceleration, LIMITS.jerk


def main() -> None:
    most = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    warm_up()
    oracle()
    families(most)


if __name__ == "__main__":
    main()
