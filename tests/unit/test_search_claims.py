"""The arithmetic by which a table of best, worst, mean and std is found impossible, and the table it is used on."""

import numpy as np
import pytest

from benchmarks.bench_search import CONTENDERS, claims, measure, summary, table
from campaigns.paper.printed import CLAIMS
from campaigns.paper.spread import Spread
from planner.search import BENCHMARKS


@pytest.mark.parametrize("seed", range(20))
def test_numbers_that_exist_are_possible(seed: int) -> None:
    rng = np.random.default_rng(seed)
    assert Spread.of(10.0 ** rng.uniform(-12, 0, 20)).possible(20)
    assert Spread.of(rng.standard_normal(20)).possible(20)


def test_the_bounds_are_reached_by_nineteen_equal_numbers_and_one_above() -> None:
    s = Spread.of([1.0] * 19 + [5.0])
    assert s.least_std(20) == pytest.approx(s.std, rel=1e-12)
    assert s.least_mean(20) == pytest.approx(s.mean, rel=1e-12)


def test_sixteen_of_the_eighteen_rows_of_the_paper_have_an_impossible_std() -> None:
    assert len(CLAIMS) == 18
    impossible = [c for c in CLAIMS if c.spread.std < 0.99 * (c.spread.worst - c.spread.mean) / 19**0.5]
    assert len(impossible) == 16
    assert {c.function for c in CLAIMS} - {c.function for c in impossible} == {"ackley"}


def test_thirteen_of_its_means_are_below_what_their_best_and_worst_bring() -> None:
    told = [c.spread for c in CLAIMS]
    assert sum(20 * 1.01 * s.mean < s.worst + 19 * s.best for s in told) == 13
    assert sum("mean" in line for line in list(claims())[2:]) == 13
    assert sum(s.mean < s.best for s in told) == 1  # Griewank, ROA


def test_the_tables_have_a_line_for_every_function_copy_and_contender() -> None:
    rows = list(measure(2, CONTENDERS[1:3], runs=2, functions=BENCHMARKS[:1]))
    assert [(r.moved, r.contender) for r in rows] == [(m, c.name) for m in (False, True) for c in CONTENDERS[1:3]]
    assert all(r.evaluations == 20_000 and r.spread.possible(2) for r in rows)
    assert len(list(table(rows))) == len(list(summary(rows))) == 6
