"""HAOAROA and its rivals on the six families: `python -m benchmarks.bench_rivals [worlds per family]`.

Worlds, radius and limits as `bench_planner`. Times are CPU time of one thread with kernels warm; ratios are taken
within one run. mealpy is measured where it can be imported; it is no dependency, since it asks for an old numpy.
"""

import math
import sys
import time
from collections.abc import Callable

import numpy as np
from scipy.optimize import differential_evolution

from benchmarks.bench_planner import LIMITS, WORLDS, world_of
from benchmarks.shortest import Plan2D
from planner import METHODS, Plan, PlannerError, plan, warm_up
from planner.baselines.parents import descend
from planner.certificate import certify
from planner.cost import SplineCost
from planner.descent import polish, search
from planner.families import RADIUS
from planner.query import Query
from planner.search import Aoa, Haoaroa, Roa
from planner.shape import STIFFER, Effort, Search

SEEDS = 20
SOME = 3
"""Worlds of each family that a search is repeated on with SEEDS seeds."""
WITHOUT_MEALPY = "mealpy not installed: make bench-peers"


def by_every_method(most: int) -> None:
    """The paper's Table 2 for each family; medians over the worlds where a method's plan is certified."""
    print("| family | method | certified | length m | jerk integral m2/s5 | curvature 1/m | duration s | CPU ms |")
    print("|---|---|---|---|---|---|---|---|")
    lengths: dict[tuple[str, str], list[float]] = {}
    for family, worlds in WORLDS.items():
        count = min(worlds, most)
        for method in METHODS:
            plans = [_planned(family, seed, method) for seed in range(count)]
            lengths[family, method] = [math.inf if p is None else p.length for p in plans]
            spent = np.median([p.cpu_ms for p in plans if p is not None])
            good = [p for p in plans if p is not None and p.certified]
            row = "- | - | - | -"
            if good:
                row = (
                    f"{np.median([p.length for p in good]):.2f} "
                    f"| {np.median([p.report.jerk_integral for p in good]):.0f} "
                    f"| {np.median([p.report.curvature_max for p in good]):.2f} "
                    f"| {np.median([p.trajectory.duration for p in good]):.2f}"
                )
            print(f"| {family} | {method} | {len(good)}/{count} | {row} | {spent:.1f} |", flush=True)
    against_taut_strings(most, lengths)


def _planned(family: str, seed: int, method: str) -> Plan | None:
    world, start, goal = world_of(family, seed)
    try:
        return plan(world, start, goal, LIMITS, RADIUS, seed=seed, method=method)
    except PlannerError as error:
        print(f"  {family} {seed} {method}: {error}")
        return None


def against_taut_strings(most: int, lengths: dict[tuple[str, str], list[float]]) -> None:
    """HAOAROA's length against the shortest way there is, and against A*'s."""
    print("\n| family | taut m | HAOAROA m | ratio of medians | worst ratio | A* m | HAOAROA / A* | longer than A*'s |")
    print("|---|---|---|---|---|---|---|---|")
    for family, worlds in WORLDS.items():
        taut = []
        for seed in range(min(worlds, most)):
            world, start, goal = world_of(family, seed)
            taut.append(Plan2D(world, RADIUS).shortest(start, goal))
        ours, theirs = np.array(lengths[family, "haoaroa"]), np.array(lengths[family, "astar"])
        short, middle, far = np.median(taut), np.median(ours), np.median(theirs)
        print(
            f"| {family} | {short:.2f} | {middle:.2f} | {middle / short:.4f} | {(ours / np.array(taut)).max():.3f} "
            f"| {far:.2f} | {middle / far:.3f} | {(ours > theirs).sum()} of {len(ours)} |",
            flush=True,
        )


def problem(family: str, seed: int) -> tuple[SplineCost, np.ndarray, np.ndarray, np.ndarray, Search]:
    """HAOAROA's cost in one world, with its seeds and bounds; and the search it is from."""
    world, start, goal = world_of(family, seed)
    work = Search(Query(world, np.array(start), np.array(goal), LIMITS, RADIUS, seed), Effort())
    cost = work.first_cost()
    f = cost.size // 3
    return cost, work.seeds(cost), np.tile(work.lower, f), np.tile(work.upper, f), work


def proved(cost: SplineCost, x: np.ndarray, work: Search) -> bool:
    """Whether a curve keeps the radius."""
    return certify(cost.control_points(work.inside(cost, x)), cost.knots, work.world, RADIUS, full=False).certified


def alone() -> None:
    """HAOAROA, AOA and ROA, 20 x 100, on the planning cost: the spread over seeds, no polish."""
    print(f"\n| family ({SOME} worlds x {SEEDS} seeds) | algorithm | best J | mean | std | worst | certified | ms |")
    print("|---|---|---|---|---|---|---|---|")
    kinds: dict[str, Callable[..., Haoaroa | Aoa | Roa]] = {"HAOAROA": Haoaroa, "AOA": Aoa, "ROA": Roa}
    for family in WORLDS:
        for name, kind in kinds.items():
            costs, clear, spent = np.empty((SOME, SEEDS)), 0, []
            for k in range(SOME):
                cost, seeds, low, high, work = problem(family, k)
                for s in range(SEEDS):
                    begin = time.thread_time()
                    step = {"step": 0.02 * cost.distance} if kind is Haoaroa else {}
                    optimiser = kind(low, high, np.random.default_rng(s), seeds, **step)
                    if isinstance(optimiser, Haoaroa):
                        search(optimiser, cost)
                    else:
                        descend(optimiser, cost.problem)
                    spent.append(1e3 * (time.thread_time() - begin))
                    costs[k, s] = optimiser.best.cost
                    clear += proved(cost, optimiser.best.position, work)
            print(
                f"| {family} | {name} | {costs.min(axis=1).mean():.2f} | {costs.mean():.2f} "
                f"| {costs.std(axis=1, ddof=1).mean():.2f} | {costs.max(axis=1).mean():.2f} "
                f"| {clear}/{costs.size} | {np.median(spent):.1f} |",
                flush=True,
            )


def certified_share(most: int) -> None:
    """How often the best curve of HAOAROA 20 x 100 is clear: as it is, with obstacles weighed more, and polished."""
    weights = " | ".join(f"obstacles x {factor:g}" for factor in STIFFER[:2])
    print(f"\n| family | {weights} | polished once | polished until proved (as `plan` does) |\n|---|---|---|---|---|")
    total = np.zeros(len(STIFFER[:2]) + 2, dtype=int)
    runs = 0
    for family, worlds in WORLDS.items():
        counts = np.zeros_like(total)
        for seed in range(min(worlds, most)):
            for k, factor in enumerate(STIFFER[:2]):
                cost, seeds, low, high, work = problem(family, seed)
                cost.problem = cost.stiffened(factor)
                optimiser = Haoaroa(low, high, np.random.default_rng(seed), seeds, step=0.02 * cost.distance)
                search(optimiser, cost)
                counts[k] += proved(cost, optimiser.best.position, work)
                if k == 0:
                    first = optimiser.best.position
            cost = problem(family, seed)[0]
            x, once = first, False
            for k, factor in enumerate(STIFFER):
                x = work.inside(cost, polish(cost, x, factor)[0])
                if proved(cost, x, work):
                    once = k == 0
                    counts[-1] += 1
                    break
            counts[-2] += once
        total += counts
        runs += min(worlds, most)
        print(f"| {family} | " + " | ".join(f"{c}/{min(worlds, most)}" for c in counts) + " |", flush=True)
    print("| all | " + " | ".join(f"{100.0 * c / runs:.1f} %" for c in total) + " |")


def against_peers(worlds: int) -> None:
    """Same cost, seeds, population and evaluations, in the same run: mealpy's AOA and scipy's differential evolution.

    HAOAROA is given the gradient, which the peers cannot use, and its loop is compiled; theirs is Python. So HAOAROA is
    shown without a gradient too, by ask and tell; and the part of the peers' time that the cost itself takes.
    """
    mealpy = _mealpy()
    if mealpy is None:
        print(f"\n{WITHOUT_MEALPY}")
    print(
        "\n| family | HAOAROA J | without gradient J | mealpy AOA J | DE J "
        "| HAOAROA ms | mealpy ms | DE ms | of these the cost | mealpy / HAOAROA | DE / HAOAROA |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for family in WORLDS:
        rows = []
        for seed in range(worlds):
            cost, seeds, low, high, _ = problem(family, seed)
            times = [time.thread_time()]
            optimiser = Haoaroa(low, high, np.random.default_rng(seed), seeds, step=0.02 * cost.distance)
            search(optimiser, cost)
            times.append(time.thread_time())
            theirs = math.nan if mealpy is None else mealpy(cost, seeds, low, high, seed)
            times.append(time.thread_time())
            evolved = differential_evolution(
                lambda x, cost=cost: cost(x)[0],
                list(zip(low, high, strict=True)),
                init=np.clip(seeds, low, high),
                maxiter=99,
                tol=0.0,
                polish=False,
                rng=seed,
            )
            times.append(time.thread_time())
            for _ in range(100):
                for x in seeds:
                    cost(x)
            times.append(time.thread_time())
            blind = Haoaroa(low, high, np.random.default_rng(seed), seeds)
            while not blind.done:
                blind.tell(np.array([cost(x)[0] for x in blind.ask()]))
            rows.append((optimiser.best.cost, blind.best.cost, theirs, evolved.fun, *(1e3 * np.diff(times))))
        ours, without, theirs, evolved, t_ours, t_theirs, t_evolved, t_cost = np.median(rows, axis=0)
        known = mealpy is not None
        print(
            f"| {family} | {ours:.2f} | {without:.2f} | {f'{theirs:.2f}' if known else '-'} | {evolved:.2f} "
            f"| {t_ours:.2f} | {f'{t_theirs:.0f}' if known else '-'} | {t_evolved:.0f} | {t_cost:.0f} "
            f"| {f'{t_theirs / t_ours:.0f}' if known else '-'} | {t_evolved / t_ours:.0f} |",
            flush=True,
        )


Peer = Callable[[SplineCost, np.ndarray, np.ndarray, np.ndarray, int], float]


def _mealpy() -> Peer | None:
    """mealpy's AOA as a function of a problem, or None."""
    try:
        from mealpy import FloatVar
        from mealpy.physics_based.ArchOA import OriginalArchOA
    except ImportError:
        return None

    def least(cost: SplineCost, seeds: np.ndarray, low: np.ndarray, high: np.ndarray, seed: int) -> float:
        asked = {
            "bounds": FloatVar(lb=low.tolist(), ub=high.tolist()),
            "minmax": "min",
            "obj_func": lambda x: cost(x)[0],
            "log_to": None,
        }
        best = OriginalArchOA(epoch=99, pop_size=20).solve(
            asked, starting_solutions=np.clip(seeds, low, high), seed=seed
        )
        return float(best.target.fitness)

    return least


def main() -> None:
    most = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    warm_up()
    for method in METHODS:
        _planned("gap", 0, method)
    by_every_method(most)
    alone()
    certified_share(most)
    against_peers(min(most, 5))


if __name__ == "__main__":
    main()
