"""The optimisers on nine functions with known minima: `python -m benchmarks.bench_search [runs [dimension ...]]`.

The paper's set-up: population 20, 1000 iterations, 20 runs (seeds 0 to 19), so 20 000 evaluations a run. Told is
f - f*. HAOAROA, AOA and ROA are run bare; "+ polish" spends 30 % of the same 20 000 evaluations on `minimize`'s polish.
Every function is measured as it is and with its minimum moved by 0.137 widths of the domain.
"""

import math
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from planner.search import BENCHMARKS, Benchmark, minimize

RUNS, POPULATION, ITERATIONS = 20, 20, 1000
TARGET = 1e-8


@dataclass(frozen=True, slots=True)
class Contender:
    """What is run, and the name it is told under."""

    name: str
    method: str
    mode: str = "shift_invariant"
    polish: float = 0.0


CONTENDERS = (
    Contender("HAOAROA + polish", "haoaroa", polish=0.3),
    Contender("HAOAROA", "haoaroa"),
    Contender("AOA", "aoa"),
    Contender("ROA", "roa"),
)
POLISHED = (Contender("AOA + polish", "aoa", polish=0.3), Contender("ROA + polish", "roa", polish=0.3))
PRINTED = tuple(
    Contender(f"{method.upper()} {mode}", method, mode)
    for method in ("haoaroa", "aoa", "roa")
    for mode in ("literal", "canonical")
)


@dataclass(frozen=True, slots=True)
class Spread:
    """Five numbers about the runs of one contender on one function; of f - f*."""

    best: float
    worst: float
    mean: float
    median: float
    std: float  # of the runs themselves: divided by n

    @classmethod
    def of(cls, errors: Iterable[float]) -> "Spread":
        """From the runs."""
        e = np.array(list(errors))
        return cls(float(e.min()), float(e.max()), float(e.mean()), float(np.median(e)), float(e.std()))

    def least_std(self, runs: int = RUNS) -> float:
        """(worst - mean)/sqrt(runs - 1): no `runs` numbers with this worst and this mean have a smaller one.

        One number lies D = worst - mean above the mean, so the others lie D below it together; their squares are least
        when each lies D/(n - 1) below. The variance is then (D^2 + D^2/(n - 1))/n = D^2/(n - 1), and more if the sum
        is divided by n - 1 instead.
        """
        return (self.worst - self.mean) / math.sqrt(runs - 1)

    def least_mean(self, runs: int = RUNS) -> float:
        """(worst + (runs - 1) best)/runs: one number is the worst, and none of the others is below the best."""
        return (self.worst + (runs - 1) * self.best) / runs

    def possible(self, runs: int = RUNS, slack: float = 1e-9) -> bool:
        """Whether any `runs` numbers have this best, worst, mean and std; `slack` is for rounded ones, relative."""
        enough = 1.0 - slack
        return self.mean >= self.least_mean(runs) * enough and self.std >= self.least_std(runs) * enough


@dataclass(frozen=True, slots=True)
class Row:
    """One contender on one function in one dimension."""

    function: str
    dimension: int
    moved: bool
    contender: str
    spread: Spread
    reached: int  # runs within TARGET of f*
    runs: int
    evaluations: int  # most of any run


TABLE_3 = """
sphere       AOA  1.23e-10  5.68e-08  3.46e-09  2.35e-09  1.23e-09
sphere       ROA  2.35e-09  1.23e-06  7.89e-08  6.79e-08  4.57e-08
rosenbrock   AOA  2.57e-11  8.91e-09  4.57e-10  3.46e-10  1.79e-10
rosenbrock   ROA  4.68e-10  2.35e-08  1.23e-09  9.01e-10  3.46e-09
rastrigin    AOA  4.57e-08  9.88e-06  5.68e-07  4.57e-07  2.35e-07
rastrigin    ROA  9.88e-07  1.23e-04  1.57e-06  8.90e-07  7.89e-07
griewank     AOA  3.46e-07  7.65e-05  1.23e-06  8.90e-07  4.57e-07
griewank     ROA  6.54e-06  2.35e-04  5.68e-06  3.46e-06  1.23e-06
ackley       AOA  1.23e-05  5.68e-03  3.46e-04  2.35e-04  1.23e-03
ackley       ROA  3.46e-04  1.23e-02  9.88e-04  7.65e-04  3.46e-03
michalewicz  AOA  1.23e-08  4.57e-06  2.35e-07  1.23e-07  5.68e-08
michalewicz  ROA  2.35e-07  9.88e-05  1.57e-06  1.23e-06  2.35e-07
himmelblau   AOA  1.23e-06  3.46e-04  1.57e-05  9.01e-06  2.35e-05
himmelblau   ROA  1.57e-05  5.68e-03  2.35e-04  1.23e-04  4.57e-04
booth        AOA  2.35e-06  4.57e-04  1.23e-05  6.79e-06  2.35e-05
booth        ROA  5.68e-05  2.35e-03  1.23e-04  9.01e-05  3.46e-04
beale        AOA  1.23e-03  7.65e-02  2.35e-03  1.23e-03  5.68e-03
beale        ROA  3.46e-03  1.23e-01  4.57e-03  2.35e-03  1.23e-02
"""
"""The paper's, its f1 to f9: best, worst, mean, median, std. For HAOAROA all its 45 numbers are 0."""


@dataclass(frozen=True, slots=True)
class Claim:
    """One row of the paper's Table 3."""

    function: str
    contender: str
    spread: Spread


CLAIMS = tuple(
    Claim(words[0], words[1], Spread(*map(float, words[2:]))) for words in map(str.split, TABLE_3.strip().splitlines())
)


def measure(
    dimension: int,
    contenders: Iterable[Contender] = CONTENDERS,
    runs: int = RUNS,
    functions: Iterable[Benchmark] = BENCHMARKS,
) -> Iterator[Row]:
    """Every function that is defined in this dimension, plain and moved, one row a contender."""
    for plain in functions:
        if dimension not in plain.dimensions:
            continue
        minimum = plain.minimum(dimension)
        for copy in (plain, plain.shifted()):
            for who in contenders:
                found = [
                    minimize(
                        copy,
                        copy.bounds(dimension),
                        method=who.method,
                        mode=who.mode,
                        seed=seed,
                        population=POPULATION,
                        maxiter=ITERATIONS,
                        polish=who.polish,
                        vectorized=True,
                    )
                    for seed in range(runs)
                ]
                errors = [result.fun - minimum for result in found]
                yield Row(
                    function=plain.name,
                    dimension=dimension,
                    moved=copy.shift != 0.0,
                    contender=who.name,
                    spread=Spread.of(errors),
                    reached=sum(e < TARGET for e in errors),
                    runs=runs,
                    evaluations=max(result.nfev for result in found),
                )


def _numbers(s: Spread) -> str:
    return " | ".join(f"{v:.2e}" for v in (s.best, s.worst, s.mean, s.median, s.std))


def table(rows: Iterable[Row]) -> Iterator[str]:
    """Markdown lines, one a row."""
    yield "| function | d | minimum | algorithm | best | worst | mean | median | std | within 1e-8 |"
    yield "|---|---|---|---|---|---|---|---|---|---|"
    for r in rows:
        where = "moved" if r.moved else "plain"
        yield (
            f"| {r.function} | {r.dimension} | {where} | {r.contender} | {_numbers(r.spread)} | {r.reached}/{r.runs} |"
        )


def summary(rows: Iterable[Row]) -> Iterator[str]:
    """Markdown lines, one a contender and copy: how many runs reached the minimum, function by function."""
    kept = list(rows)
    names = list(dict.fromkeys(r.function for r in kept))
    yield "| algorithm | minimum | " + " | ".join(names) + " |"
    yield "|---|---|" + "---|" * len(names)
    for who in dict.fromkeys(r.contender for r in kept):
        for moved in (False, True):
            mine = {r.function: r for r in kept if r.contender == who and r.moved is moved}
            cells = " | ".join(f"{mine[n].reached}/{mine[n].runs} ({mine[n].spread.median:.0e})" for n in names)
            yield f"| {who} | {'moved' if moved else 'plain'} | {cells} |"


def claims(slack: float = 0.01) -> Iterator[str]:
    """Markdown lines: the paper's numbers, and what their own worst leaves possible; they are told to three digits."""
    yield "| function | algorithm | best | worst | mean | median | std | least mean | least std | |"
    yield "|---|---|---|---|---|---|---|---|---|---|"
    for claim in CLAIMS:
        s = claim.spread
        wrong = [
            name
            for name, value, least in (("mean", s.mean, s.least_mean()), ("std", s.std, s.least_std()))
            if value < least * (1.0 - slack)
        ]
        told = f"{' and '.join(wrong)} cannot be" if wrong else "can be"
        yield (
            f"| {claim.function} | {claim.contender} | {_numbers(s)} | {s.least_mean():.2e} | {s.least_std():.2e} "
            f"| {told} |"
        )


def main() -> None:
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else RUNS
    dimensions = [int(d) for d in sys.argv[2:]] or [2]
    print("The paper's Table 3 for AOA and ROA; for HAOAROA it has 0 everywhere\n")
    print("\n".join(claims()))
    plane: list[Row] = []
    for dimension in dimensions:
        print(f"\nf - f* at d = {dimension}, {runs} runs of at most {POPULATION * ITERATIONS} evaluations\n")
        rows = list(measure(dimension, CONTENDERS, runs))
        print("\n".join(table(rows)), flush=True)
        plane += rows if dimension == 2 else []
    if plane:
        print(f"\nRuns within {TARGET:g} of f* (median of f - f*) at d = 2: what the polish does for the parents,")
        print("and what moving the minimum does to the algorithms as published\n")
        print("\n".join(summary([*plane, *measure(2, (*POLISHED, *PRINTED), runs)])))


if __name__ == "__main__":
    main()
