"""The nine benchmark functions against their printed formulas, published minima and dense sampling."""

import itertools
import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar, rosen

from planner.search.functions import BENCHMARKS, SHIFT, Benchmark

BY_NAME = {b.name: b for b in BENCHMARKS}
CASES = [(b, d) for b in BENCHMARKS for d in b.dimensions]
NAMES = [f"{b.name}-{d}" for b, d in CASES]


def printed(name: str, x: list[float]) -> float:
    """The formulas as they are usually printed, one point at a time."""
    d = len(x)
    match name:
        case "sphere":
            return sum(v * v for v in x)
        case "rosenbrock":
            return float(rosen(x))
        case "rastrigin":
            return 10 * d + sum(v * v - 10 * math.cos(2 * math.pi * v) for v in x)
        case "griewank":
            return sum(v * v for v in x) / 4000 - math.prod(math.cos(v / math.sqrt(i + 1)) for i, v in enumerate(x)) + 1
        case "ackley":
            rms = math.sqrt(sum(v * v for v in x) / d)
            mean = sum(math.cos(2 * math.pi * v) for v in x) / d
            return -20 * math.exp(-0.2 * rms) - math.exp(mean) + 20 + math.e
        case "michalewicz":
            return -sum(math.sin(v) * math.sin((i + 1) * v * v / math.pi) ** 20 for i, v in enumerate(x))
    raise AssertionError(name)


@pytest.mark.parametrize("name", ["sphere", "rosenbrock", "rastrigin", "griewank", "ackley", "michalewicz"])
@pytest.mark.parametrize("dimension", [2, 5])
def test_each_row_is_the_printed_formula_of_that_point(name: str, dimension: int) -> None:
    b = BY_NAME[name]
    x = np.random.default_rng(dimension).uniform(b.lower, b.upper, (50, dimension))
    assert b(x) == pytest.approx([printed(name, list(row)) for row in x], rel=1e-12, abs=1e-11)


def test_the_two_dimensional_ones_at_points_worked_by_hand() -> None:
    at = np.array([[0.0, 0.0], [1.0, 1.0]])
    assert BY_NAME["himmelblau"](at) == pytest.approx([121 + 49, 81 + 25])
    assert BY_NAME["booth"](at) == pytest.approx([49 + 25, 16 + 4])
    assert BY_NAME["beale"](at) == pytest.approx([2.25 + 5.0625 + 6.890625] * 2)


@pytest.mark.parametrize(("dimension", "minimum"), [(2, -1.801303), (5, -4.687658), (10, -9.660152)])
def test_michalewicz_has_the_published_minima(dimension: int, minimum: float) -> None:
    assert BY_NAME["michalewicz"].minimum(dimension) == pytest.approx(minimum, abs=5e-7)


def test_michalewicz_is_the_sum_of_one_dimensional_minima_found_by_another_search() -> None:
    total = 0.0
    for i in range(1, 11):
        ends = np.linspace(0.0, np.pi, 400)
        found = [
            minimize_scalar(
                lambda v, i=i: -math.sin(v) * math.sin(i * v * v / math.pi) ** 20,
                bounds=(a, b),
                method="bounded",
                options={"xatol": 1e-12},
            ).fun
            for a, b in itertools.pairwise(ends)
        ]
        total += min(found)
    assert BY_NAME["michalewicz"].minimum(10) == pytest.approx(total, abs=1e-12)


def test_michalewicz_is_nowhere_positive_in_its_domain() -> None:
    x = np.random.default_rng(0).uniform(0.0, np.pi, (20_000, 2))
    assert (BY_NAME["michalewicz"](x) <= 0.0).all()


def test_himmelblau_has_the_four_published_minimisers() -> None:
    published = [[-3.779310, -3.283186], [3.0, 2.0], [-2.805118, 3.131312], [3.584428, -1.848126]]
    found = BY_NAME["himmelblau"].best_points(2)
    for point in published:
        assert np.abs(found - point).max(axis=1).min() < 1e-6


@pytest.mark.parametrize("shift", [0.0, SHIFT])
@pytest.mark.parametrize(("b", "dimension"), CASES, ids=NAMES)
def test_no_point_is_lower_than_the_minimum_and_the_minimisers_reach_it(
    b: Benchmark, dimension: int, shift: float
) -> None:
    copy, minimum = b.shifted(shift), b.minimum(dimension)
    points = copy.best_points(dimension)
    assert len(points) >= 1
    assert copy(points) == pytest.approx(np.full(len(points), minimum), abs=1e-12)
    rng = np.random.default_rng(1)
    anywhere = rng.uniform(b.lower, b.upper, (5_000, dimension))
    about = points[0] + rng.standard_normal((5_000, dimension)) * 10.0 ** rng.uniform(-8, 0, (5_000, 1))
    near = np.clip(about, b.lower, b.upper)
    assert copy(np.concatenate([anywhere, near])).min() >= minimum - 1e-12


def test_a_moved_copy_has_its_minimum_moved_and_nothing_else() -> None:
    b = BY_NAME["rastrigin"]
    assert b.shifted().best_points(3)[0] == pytest.approx([1.37, -1.37, 1.37])
    assert b.shifted().bounds(3) == b.bounds(3)
    x = np.random.default_rng(2).uniform(-3, 3, (10, 3))
    np.testing.assert_allclose(b.shifted()(x + np.array([1.37, -1.37, 1.37])), b(x), rtol=1e-12)


def test_ackley_reaches_zero_where_its_printed_sum_cannot() -> None:
    assert BY_NAME["ackley"](np.zeros((1, 2)))[0] == 0.0
    assert 0.0 < printed("ackley", [0.0, 0.0]) < 1e-15
