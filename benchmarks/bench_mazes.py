"""A thousand random mazes: each is solved by a certified plan, or proved closed.

`python -m benchmarks.bench_mazes [mazes]`. Radius 0.3 m, limits 3/6/60. An independent grid says which are open: walls
drawn as rectangles, the radius by scipy's exact distance transform, regions by its labels. CPU time of one thread,
kernels warm.
"""

import sys
from collections import defaultdict

import numpy as np
from scipy.ndimage import distance_transform_edt, label

from planner import Limits, NoPathFound, plan, warm_up
from planner.families import RADIUS, SIZE, Scenario, make
from planner.stopwatch import Stopwatch

LIMITS = Limits(speed=3.0, acceleration=6.0, jerk=60.0)
STEP = 0.05
"""Of the independent grid [m]."""


def joined(scenario: Scenario, spare: float) -> bool:
    """Whether a grid of points that keep the radius and `spare` [m] joins start to goal; from above, mazes are flat."""
    n = round(SIZE / STEP)
    solid = np.ones((n + 2, n + 2), dtype=bool)  # a frame of wall around the map
    solid[1:-1, 1:-1] = False
    middle = (np.arange(n) + 0.5) * STEP
    for wall in scenario.world.obstacles:
        x = (middle > wall.lower[0]) & (middle < wall.upper[0])
        y = (middle > wall.lower[1]) & (middle < wall.upper[1])
        solid[1:-1, 1:-1] |= x[:, None] & y
    free = distance_transform_edt(~solid)[1:-1, 1:-1] * STEP > RADIUS + spare
    groups, _ = label(free)
    start, goal = (groups[int(end[0] / STEP), int(end[1] / STEP)] for end in (scenario.start, scenario.goal))
    return bool(start == goal > 0)


def main() -> None:
    mazes = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    warm_up()
    spent: dict[str, list[float]] = defaultdict(list)
    lengths, wrong = [], 0
    for seed in range(mazes):
        scenario = make("maze", seed)
        watch = Stopwatch()
        try:
            p = plan(scenario.world, scenario.start, scenario.goal, LIMITS, RADIUS, seed=seed)
            outcome = "solved" if p.certified else "not certified"
            lengths.append(p.length)
        except NoPathFound as error:
            outcome = "proved closed" if error.proved else "gave up"
            if not error.proved:
                print(f"  maze {seed}: {error}")
        spent[outcome].append(watch.elapsed_ms())
        # Corridors are 1.5 m wide: two steps of the grid more or less change nothing for a right answer.
        judged = joined(scenario, 2 * STEP), joined(scenario, -2 * STEP)
        if judged != (outcome == "solved",) * 2:
            wrong += 1
            print(f"  maze {seed}: {outcome}, the independent grid says {judged}")
    print("| outcome | mazes | CPU ms median | p95 | max |")
    print("|---|---|---|---|---|")
    for outcome, ms in sorted(spent.items()):
        print(f"| {outcome} | {len(ms)} | {np.median(ms):.2f} | {np.percentile(ms, 95):.2f} | {max(ms):.2f} |")
    print(f"\nAgainst the independent grid: {wrong} of {mazes} wrong. Median length {np.median(lengths):.1f} m.")


if __name__ == "__main__":
    main()
