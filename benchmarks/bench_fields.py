"""Distance fields: `python -m benchmarks.bench_fields [worlds per family]`.

The families of `bench_planner` as voxels of 0.1 m (a voxel is solid when its middle is), radius 0.3 m, limits 3/6/60.
CPU time of one thread, kernels warm; the field is built with its obstacle and not part of a plan's time.
"""

import sys
import time
from collections.abc import Callable

import numpy as np
from scipy.ndimage import distance_transform_edt

from benchmarks.bench_planner import LIMITS, RADIUS, WORLDS, world_of
from planner import PlannerError, VoxelGrid, World, plan, warm_up
from planner.esdf import signed_distances

RESOLUTION = 0.1


def voxelised(world: World) -> World:
    """The world's obstacles as voxels over the whole map."""
    low, high = world.walls
    shape = np.round((high - low) / RESOLUTION).astype(int)
    axes = [low[a] + RESOLUTION * (np.arange(shape[a]) + 0.5) for a in range(3)]
    middles = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    occupied = (world.distance(middles) <= 0.0).reshape(shape)
    return World(world.bounds, [VoxelGrid(occupied, tuple(low), RESOLUTION)])


def _median_ms(call: Callable[[], object], times: int = 9) -> float:
    spent = []
    for _ in range(times):
        start = time.thread_time()
        call()
        spent.append(time.thread_time() - start)
    return 1e3 * float(np.median(spent))


def building() -> None:
    """The transform alone, against scipy's, which is unsigned and to the voxels' middles."""
    print("| 200 x 200 x 40 voxels | built in ms | scipy's EDT ms |")
    print("|---|---|---|")
    cases = {}
    for family in ("gap", "forest"):
        (grid,) = voxelised(world_of(family, 0)[0]).obstacles
        assert isinstance(grid, VoxelGrid)
        cases[family] = np.array(grid.occupied)
    rng = np.random.default_rng(0)
    for share in (0.0001, 0.01, 0.3):
        cases[f"{100 * share:g} % at random"] = rng.random((200, 200, 40)) < share
    for name, occupied in cases.items():
        ours = _median_ms(lambda o=occupied: signed_distances(o, RESOLUTION))
        theirs = _median_ms(lambda o=occupied: distance_transform_edt(~o), 3)
        print(f"| {name} | {ours:.1f} | {theirs:.0f} |")


def plans(most: int) -> None:
    """Every family: certified, time, and length against the same world of solids."""
    print("\n| family | certified | guided | CPU ms median | p95 | of solids | length m | of solids | clearance m |")
    print("|---|---|---|---|---|---|---|---|---|")
    for family, worlds in WORLDS.items():
        found, solid, failed = [], [], 0
        for seed in range(min(worlds, most)):
            world, start, goal = world_of(family, seed)
            solid.append(plan(world, start, goal, LIMITS, RADIUS, seed=seed))
            try:
                found.append(plan(voxelised(world), start, goal, LIMITS, RADIUS, seed=seed))
            except PlannerError as error:
                failed += 1
                print(f"  {family} {seed}: {error}")
        ms = [p.cpu_ms for p in found]
        print(
            f"| {family} | {sum(p.certified for p in found)}/{len(found) + failed} "
            f"| {sum(p.report.guided for p in found)} | {np.median(ms):.2f} | {np.percentile(ms, 95):.2f} "
            f"| {np.median([p.cpu_ms for p in solid]):.2f} | {np.median([p.length for p in found]):.2f} "
            f"| {np.median([p.length for p in solid]):.2f} | {min(p.clearance for p in found):.3f} |"
        )


def main() -> None:
    most = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    warm_up()
    building()
    plans(most)


if __name__ == "__main__":
    main()
