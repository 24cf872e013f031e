"""Planner figures on seeded worlds: `python -m benchmarks.bench_planner [worlds per family]`.

Worlds of 20 x 20 x 4 m, full-height obstacles, radius 0.3 m, limits 3/6/60, start (1, ~10, 1.5), goal (19, ~10, 1.5).
Times are CPU time of one thread with kernels warm; ratios are taken within one run, so they mean the same elsewhere.
"""

import math
import sys
import time
from collections.abc import Callable

import numpy as np
from scipy.ndimage import label
from scipy.optimize import differential_evolution

from planner import Box, Cylinder, Limits, NoPathFound, PlannerError, Sphere, World, plan, warm_up
from planner.cost import SplineCost
from planner.descent import search
from planner.search.haoaroa import Haoaroa
from planner.seeds import fan
from planner.worlds import Obstacle

LIMITS, RADIUS, HEIGHT = Limits(speed=3.0, acceleration=6.0, jerk=60.0), 0.3, 4.0
BOUNDS = ((0.0, 0.0, 0.0), (20.0, 20.0, HEIGHT))


def _wall(x0: float, y0: float, x1: float, y1: float) -> Box:
    return Box((x0, y0, 0.0), (x1, y1, HEIGHT))


def gap(rng: np.random.Generator) -> list[Obstacle]:
    """A wall with one gap of 1.4 m."""
    y = rng.uniform(4.0, 16.0)
    return [_wall(9.75, 0.0, 10.25, y - 0.7), _wall(9.75, y + 0.7, 10.25, 20.0)]


def l_shape(rng: np.random.Generator) -> list[Obstacle]:
    """Two arms that meet at a right angle, across the line and back toward the start."""
    dx, dy = rng.uniform(-1.0, 1.0, 2)
    return [_wall(9.5 + dx, 6.0 + dy, 10.5 + dx, 14.0 + dy), _wall(5.0 + dx, 13.0 + dy, 9.5 + dx, 14.0 + dy)]


def h_shape(rng: np.random.Generator) -> list[Obstacle]:
    """Two bars along the way joined by a bar across it."""
    dx, dy = rng.uniform(-1.0, 1.0, 2)
    bars = [_wall(6.0 + dx, y + dy, 14.0 + dx, y + 1.0 + dy) for y in (5.5, 13.5)]
    return [*bars, _wall(9.5 + dx, 6.5 + dy, 10.5 + dx, 13.5 + dy)]


def u_shape(rng: np.random.Generator) -> list[Obstacle]:
    """A pocket open toward the start."""
    dx, dy = rng.uniform(-1.0, 1.0, 2)
    arms = [_wall(6.0 + dx, y + dy, 12.0 + dx, y + 1.0 + dy) for y in (6.0, 13.0)]
    return [*arms, _wall(11.0 + dx, 7.0 + dy, 12.0 + dx, 13.0 + dy)]


def omega(rng: np.random.Generator) -> list[Obstacle]:
    """A ring of radius 4 m made of posts, open at the start's side, with a neck."""
    dx, dy = rng.uniform(-1.0, 1.0, 2)
    angles = np.linspace(-math.pi + 0.35, math.pi - 0.35, 42)
    ring = [Cylinder((10 + dx + 4 * math.cos(a), 10 + dy + 4 * math.sin(a)), 0.4, (0, HEIGHT)) for a in angles]
    neck = [_wall(4.0 + dx, y + dy, 6.2 + dx, y + 0.5 + dy) for y in (8.4, 11.1)]
    return [*ring, *neck]


def forest(rng: np.random.Generator) -> list[Obstacle]:
    """Fifty trees, every gap between two of them passable."""
    trees: list[tuple[float, float, float]] = []
    while len(trees) < 50:
        x, y, r = rng.uniform(2.5, 17.5), rng.uniform(0.5, 19.5), rng.uniform(0.25, 0.6)
        if all(math.hypot(x - a, y - b) > r + s + 2 * RADIUS + 0.2 for a, b, s in trees):
            trees.append((x, y, r))
    return [Cylinder((x, y), r, (0.0, HEIGHT)) for x, y, r in trees]


FAMILIES: dict[str, tuple[Callable[[np.random.Generator], list[Obstacle]], int]] = {
    "gap": (gap, 50),
    "L": (l_shape, 30),
    "H": (h_shape, 30),
    "U": (u_shape, 30),
    "Omega": (omega, 30),
    "forest": (forest, 100),
}


def world_of(family: str, seed: int) -> tuple[World, tuple[float, float, float], tuple[float, float, float]]:
    """One seeded world with its start and goal."""
    rng = np.random.default_rng([seed, list(FAMILIES).index(family)])
    y0, y1 = 10.0 + rng.uniform(-0.5, 0.5, 2)
    return World(bounds=BOUNDS, obstacles=FAMILIES[family][0](rng)), (1.0, y0, 1.5), (19.0, y1, 1.5)


def plans(most: int) -> None:
    """Every family: certified, time, length, duration."""
    print("| family | certified | guided | CPU ms median | p95 | length m | duration s | evaluations | clearance m |")
    print("|---|---|---|---|---|---|---|---|---|")
    for family, (_, worlds) in FAMILIES.items():
        found, failed = [], 0
        for seed in range(min(worlds, most)):
            world, start, goal = world_of(family, seed)
            try:
                found.append(plan(world, start, goal, LIMITS, RADIUS, seed=seed))
            except PlannerError as error:
                failed += 1
                print(f"  {family} {seed}: {error}")
        ms = [p.cpu_ms for p in found]
        print(
            f"| {family} | {sum(p.certified for p in found)}/{len(found) + failed} "
            f"| {sum(p.report.guided for p in found)} "
            f"| {np.median(ms):.2f} | {np.percentile(ms, 95):.2f} | {np.median([p.length for p in found]):.2f} "
            f"| {np.median([p.trajectory.duration for p in found]):.2f} "
            f"| {np.median([p.report.evaluations for p in found]):.0f} | {min(p.clearance for p in found):.3f} |"
        )


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
    for family in FAMILIES:
        spent = []
        for seed in range(5):
            cost, seeds, low, high = _cost(family, seed)
            optimiser = Haoaroa(low, high, np.random.default_rng(seed), seeds, step=0.3)
            start = time.thread_time()
            search(optimiser, cost)
            spent.append(time.thread_time() - start)
        print(f"| {family} | {1e3 * np.median(spent):.2f} | {1e6 * np.median(spent) / optimiser.evaluations:.2f} |")


def against_scipy(worlds: int) -> None:
    """HAOAROA against scipy's differential evolution: same cost, population, seeds and evaluations, in the same run.

    HAOAROA is given the gradient, which differential evolution cannot use; and its loop is compiled, DE's is Python.
    """
    print("\n| family | HAOAROA J | DE J | HAOAROA ms | DE ms | time ratio |")
    print("|---|---|---|---|---|---|")
    for family in FAMILIES:
        rows = []
        for seed in range(worlds):
            cost, seeds, low, high = _cost(family, seed)
            start = time.thread_time()
            optimiser = Haoaroa(low, high, np.random.default_rng(seed), seeds, step=0.3)
            search(optimiser, cost)
            middle = time.thread_time()
            rival = differential_evolution(
                lambda x, cost=cost: cost(x)[0],
                list(zip(low, high, strict=True)),
                init=np.clip(seeds, low, high),
                maxiter=99,
                tol=0.0,
                polish=False,
                rng=seed,
            )
            rows.append((optimiser.best.cost, rival.fun, middle - start, time.thread_time() - middle))
        ours, theirs, t_ours, t_theirs = np.median(rows, axis=0)
        print(
            f"| {family} | {ours:.2f} | {theirs:.2f} | {1e3 * t_ours:.2f} | {1e3 * t_theirs:.1f} "
            f"| {t_theirs / t_ours:.0f} |"
        )


def main() -> None:
    most = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    warm_up()
    plans(most)
    clutter(most)
    kernel()
    against_scipy(min(most, 5))


if __name__ == "__main__":
    main()
