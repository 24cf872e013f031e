"""The optimisers on nine functions with known minima: `python -m benchmarks.bench_search [runs [dimension ...]]`.

The paper's set-up: population 20, 1000 iterations, 20 runs (seeds 0 to 19), so 20 000 evaluations a run. Told is
f - f*. HAOAROA, AOA and ROA are run bare; "+ polish" spends 30 % of the same 20 000 evaluations on `minimize`'s polish.
Every function is measured as it is and with its minimum moved by 0.137 widths of the domain.
"""

import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from campaigns.paper.printed import CLAIMS, ITERATIONS, POPULATION, RUNS
from campaigns.paper.search import CONTENDERS as BARE
from campaigns.paper.search import TARGET, Contender
from campaigns.paper.spread import Spread
from planner.search import BENCHMARKS, Benchmark, minimize

CONTENDERS = (Contender("HAOAROA + polish", "haoaroa", polish=0.3), *BARE)
POLISHED = (Contender("AOA + polish", "aoa", polish=0.3), Contender("ROA + polish", "roa", polish=0.3))
PRINTED = tuple(
    Contender(f"{method.upper()} {mode}", method, mode)
    for method in ("haoaroa", "aoa", "roa")
    for mode in ("literal", "canonical")
)


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


def claims() -> Iterator[str]:
    """Markdown lines: the paper's numbers, and what their own worst leaves possible; they are told to three digits."""
    yield "| function | algorithm | best | worst | mean | median | std | least mean | least std | |"
    yield "|---|---|---|---|---|---|---|---|---|---|"
    for claim in CLAIMS:
        s = claim.spread
        told = f"{' and '.join(claim.wrong)} cannot be" if claim.wrong else "can be"
        yield (
            f"| {claim.function} | {claim.contender} | {_numbers(s)} "
            f"| {s.least_mean(RUNS):.2e} | {s.least_std(RUNS):.2e} | {told} |"
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
