"""Table 3: HAOAROA, AOA and ROA on nine functions, each as it is and with its minimum moved.

The paper's set-up: population 20, 1000 iterations, 20 runs (seeds 0 to 19), d = 2, so 20 000 evaluations a run. Told is
f - f*. Each algorithm is run bare in three readings (`planner.search.Mode`), HAOAROA also with `minimize`'s polish,
which has 30 % of the same evaluations.
"""

import time
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from campaigns.paper.spread import Spread
from planner.search import BENCHMARKS, Benchmark, minimize

TARGET = 1e-8
"""A run has reached the minimum when it ends this near, in f."""
NEAR = 0.01
"""A point is at a minimiser when it is this near, in widths of the domain."""
DIMENSION = 2


@dataclass(frozen=True, slots=True)
class Contender:
    """What is run, and the name it is told under."""

    name: str
    method: str
    mode: str = "shift_invariant"
    polish: float = 0.0


CONTENDERS = (Contender("HAOAROA", "haoaroa"), Contender("AOA", "aoa"), Contender("ROA", "roa"))
"""Told in full; the modes in which moving a problem moves its answer."""
OTHERS = (
    Contender("HAOAROA + polish", "haoaroa", polish=0.3),
    *(
        Contender(f"{method.upper()} {mode}", method, mode)
        for mode in ("canonical", "literal")
        for method in ("haoaroa", "aoa", "roa")
    ),
)


@dataclass(frozen=True, slots=True)
class Searches:
    """All runs of one contender on one function."""

    function: str
    moved: bool
    contender: Contender
    runs: int
    population: int
    iterations: int


def benchmark(name: str, moved: bool) -> Benchmark:
    """A function of Table 1, or its copy with the minimum moved."""
    plain = next(b for b in BENCHMARKS if b.name == name)
    return plain.shifted() if moved else plain


def search(item: Searches) -> dict[str, Any]:
    """Run them: spread of f - f*, runs within TARGET, of exactly 0, at a minimiser, and the points (runs, 2)."""
    function, who = benchmark(item.function, item.moved), item.contender
    minimum, targets = function.minimum(DIMENSION), function.best_points(DIMENSION)
    began = time.process_time()
    found = [
        minimize(
            function,
            function.bounds(DIMENSION),
            method=who.method,
            mode=who.mode,
            seed=seed,
            population=item.population,
            maxiter=item.iterations,
            polish=who.polish,
            vectorized=True,
        )
        for seed in range(item.runs)
    ]
    spent = time.process_time() - began
    errors = [float(result.fun) - minimum for result in found]
    points = np.array([result.x for result in found])
    away = np.linalg.norm(points[:, None] - targets[None], axis=2).min(axis=1) / (function.upper - function.lower)
    return {
        "function": item.function,
        "moved": item.moved,
        "contender": who.name,
        "runs": item.runs,
        "evaluations": max(int(result.nfev) for result in found),
        **asdict(Spread.of(errors)),
        "reached": sum(e < TARGET for e in errors),
        "exact": sum(e == 0.0 for e in errors),
        "at_minimum": int((away < NEAR).sum()),
        "cpu_ms": 1e3 * spent / item.runs,
        "points": [[float(v) for v in point] for point in points],
    }


def items(runs: int, population: int, iterations: int) -> Iterable[Searches]:
    """Every function that has d = 2, plain and moved, by every contender."""
    return [
        Searches(function.name, moved, who, runs, population, iterations)
        for function in BENCHMARKS
        for moved in (False, True)
        for who in (*CONTENDERS, *OTHERS)
    ]


def by_contender(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """One row a contender and copy: on how many functions all runs, and how many runs in all, reached the minimum."""
    made = []
    for who in dict.fromkeys(row["contender"] for row in rows):
        for moved in (False, True):
            mine = [row for row in rows if row["contender"] == who and row["moved"] is moved]
            made.append(
                {
                    "contender": who,
                    "moved": moved,
                    "functions": len(mine),
                    "solved": sum(row["reached"] == row["runs"] for row in mine),
                    "reached": sum(row["reached"] for row in mine),
                    "runs": sum(row["runs"] for row in mine),
                    "exact": sum(row["exact"] for row in mine),
                    "cpu_ms": float(np.mean([row["cpu_ms"] for row in mine])),
                    "by_function": {
                        row["function"]: {name: row[name] for name in ("reached", "runs", "median")} for row in mine
                    },
                }
            )
    return made
