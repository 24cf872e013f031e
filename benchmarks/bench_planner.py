"""Planner figures on seeded worlds: `python -m benchmarks.bench_planner [worlds per family]`.

Worlds of 20 x 20 x 4 m, full-height obstacles, radius 0.3 m, limits 3/6/60, start (1, ~10, 1.5), goal (19, ~10, 1.5).
Times are CPU time of one thread with kernels warm; ratios are taken within one run, so they mean the same elsewhere.
"""

import sys
import time

import numpy as np
from scipy.ndimage import label

from planner import Box, Cylinder, Limits, NoPathFound, PlannerError, Sphere, World, plan, warm_up
from planner.cost import SplineCost
from planner.descent import search
from planner.families import RADIUS, make
from planner.query import Query
from planner.search.haoaroa import Haoaroa
from planner.seeds import fan
from planner.shape import Effort, haoaroa
from planner.worlds import Obstacle, Point

LIMITS = Limits(speed=3.0, acceleration=6.0, jerk=60.0)
WORLDS = {"gap": 50, "L": 30, "H": 30, "U": 30, "Omega": 30, "forest": 100}
"""Families and how many worlds of each."""


def world_of(family: str, seed: int) -> tuple[World, Point, Point]:
    """One seeded world with its start and goal."""
    made = make(family, seed)
    return made.world, made.start, made.goal


def plans(most: int) -> None:
    """Every family: certified, time, length, duration. "shape ms": until the curve is proved, before its timing."""
    print(
        "| family | certified | guided | shape ms median | p95 | plan ms median | p95 "
        "| length m | duration s | evaluations | clearance m |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    every: tuple[list[float], list[float]] = [], []
    for family, worlds in WORLDS.items():
        found, shaped, failed = [], [], 0
        for seed in range(min(worlds, most)):
            world, start, goal = world_of(family, seed)
            try:
                begin = time.thread_time()
                next(haoaroa(Query(world, np.array(start), np.array(goal), LIMITS, RADIUS, seed), Effort()))
                shaped.append(1e3 * (time.thread_time() - begin))
                found.append(plan(world, start, goal, LIMITS, RADIUS, seed=seed))
            except PlannerError as error:
                failed += 1
                print(f"  {family} {seed}: {error}")
        ms = [p.cpu_ms for p in found]
        print(
            f"| {family} | {sum(p.certified for p in found)}/{len(found) + failed} "
            f"| {sum(p.report.guided for p in found)} "
            f"| {np.median(shaped):.2f} | {np.percentile(shaped, 95):.2f} "
            f"| {np.median(ms):.2f} | {np.percentile(ms, 95):.2f} | {np.median([p.length for p in found]):.2f} "
            f"| {np.median([p.trajectory.duration for p in found]):.2f} "
            f"| {np.median([p.report.evaluations for p in found]):.0f} | {min(p.clearance for p in found):.3f} |"
        )
        every[0].extend(shaped)
        every[1].extend(ms)
    row = " | ".join(f"{np.median(ms):.2f} | {np.percentile(ms, 95):.2f}" for ms in every)
    print(f"| all | | | {row} | | | | |")


def cluttered(seed: int, radius: float) -> tuple[World, np.ndarray, np.ndarray] | None:
    """A small room of boxes, posts, balls and sheets of half a millimetre to 10 cm; ends 0.1 m clear, 3 m apart."""
    rng = np.random.default_rng([777, seed])
    size = np.array([rng.uniform(6.0, 20.0), rng.uniform(6.0, 20.0), rng.uniform(2.5, 6.0)])
    obstacles: list[Obstacle] = []
    for _ in range(rng.integers(4, 25)):
        c = size * rng.uniform(-0.1, 1.1, 3)
        kind = rng.integers(5)
        if kind <= 1:
            half = size * rng.uniform(0.1, 0.4, 3)
            half[rng.integers(2)] = rng.choice([0.00025, 0.005, 0.05])
            half[2] = size[2] * rng.uniform(0.3, 0.7)
            obstacles.append(Box(tuple(c - half), tuple(c + half)))
        elif kind == 2:
            half = rng.uniform(0.1, 1.5, 3)
            obstacles.append(Box(tuple(c - half), tuple(c + half)))
        elif kind == 3:
            obstacles.append(Cylinder((c[0], c[1]), rng.uniform(0.02, 1.2), (-1.0, size[2] + 1.0)))
        else:
            obstacles.append(Sphere(tuple(c), rng.uniform(0.02, 1.5)))
    world = World(((0.0, 0.0, 0.0), tuple(size)), obstacles)
    points = size * rng.random((400, 3))
    clear = points[np.minimum(world.distance(points), world.wall_distance(points)) > radius + 0.1]
    apart = np.linalg.norm(clear - clear[:1], axis=1) > 3.0
    return (world, clear[0], clear[apart][0]) if apart.any() else None


def is_open(world: World, start: np.ndarray, goal: np.ndarray, radius: float) -> bool:
    """Whether a 0.1 m grid joins the ends with 0.1 m to spare: more than half a cell's diagonal, so truly joined."""
    low, high = world.walls
    axes = [np.arange(low[a], high[a], 0.1) for a in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), -1)
    flat = points.reshape(-1, 3)
    clear = np.minimum(world.distance(flat), world.wall_distance(flat)) > radius + 0.1
    groups, _ = label(clear.reshape(points.shape[:3]))
    near = [set(groups[(np.linalg.norm(points - end, axis=-1) < 0.1) & (groups > 0)]) for end in (start, goal)]
    return bool(near[0] & near[1])


def clutter(worlds: int) -> None:
    """Rooms with thin sheets: how many that are open by an independent grid are not planned through."""
    print("\n| radius m | certified | missed though open | closed | guided | CPU ms median | p95 | mean length m |")
    print("|---|---|---|---|---|---|---|---|")
    for radius in (0.0, 0.05, 0.3, 0.6):
        found, missed, closed = [], 0, 0
        for seed in range(worlds):
            room = cluttered(seed, radius)
            if room is None:
                continue
            try:
                found.append(plan(*room, LIMITS, radius, seed=seed))
            except NoPathFound:
                reachable = is_open(*room, radius)
                missed, closed = missed + reachable, closed + (not reachable)
        ms = [p.cpu_ms for p in found]
        print(
            f"| {radius} | {sum(p.certified for p in found)} | {missed} | {closed} "
            f"| {sum(p.report.guided for p in found)} | {np.median(ms):.2f} | {np.percentile(ms, 95):.2f} "
            f"| {np.mean([p.length for p in found]):.2f} |"
        )


def _cost(family: str, seed: int) -> tuple[SplineCost, np.ndarray, np.ndarray, np.ndarray]:
    world, start, goal = world_of(family, seed)
    cost = SplineCost(world, np.array(start), np.array(goal), 16, LIMITS, 0.42)
    low, high = world.walls[0] + RADIUS, world.walls[1] - RADIUS
    seeds = fan(np.array(start), np.array(goal), low, high, 16, 20, np.random.default_rng(seed))
    return cost, seeds, np.tile(low, 10), np.tile(high, 10)


def kernel() -> None:
    """Cost with gradient: microseconds a call, inside compiled code (HAOAROA's own moves are counted too)."""
    print("\n| family | HAOAROA 20 x 100, ms | us an evaluation, moves included |")
    print("|---|---|---|")
    for family in WORLDS:
        spent = []
        for seed in range(5):
            cost, seeds, low, high = _cost(family, seed)
            optimiser = Haoaroa(low, high, np.random.default_rng(seed), seeds, step=0.3)
            start = time.thread_time()
            search(optimiser, cost)
            spent.append(time.thread_time() - start)
        print(f"| {family} | {1e3 * np.median(spent):.2f} | {1e6 * np.median(spent) / optimiser.evaluations:.2f} |")


def main() -> None:
    most = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    warm_up()
    plans(most)
    clutter(most)
    kernel()


if __name__ == "__main__":
    main()
