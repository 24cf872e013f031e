"""`minimize`: known minima in every method and mode, honest counting, odd functions, and misuse told by name."""

import itertools

import numpy as np
import pytest
from scipy.optimize import Bounds, OptimizeResult, check_grad, rosen, rosen_der

from planner.search import BENCHMARKS, HaoaroaCanonical, HaoaroaLiteral, Mode, minimize
from planner.search.evaluator import Evaluator

METHODS = ["haoaroa", "aoa", "roa"]
BOX = [(-5.0, 5.0)] * 2


def bowl(x: np.ndarray) -> float:
    return float((x[0] - 1.3) ** 2 + 2 * (x[1] + 0.7) ** 2)


def bowl_slope(x: np.ndarray) -> np.ndarray:
    return np.array([2 * (x[0] - 1.3), 4 * (x[1] + 0.7)])


class Counted:
    """A function that counts how often it is called and checks what it is given."""

    def __init__(self) -> None:
        self.calls = 0

    def __call__(self, x: np.ndarray) -> float:
        self.calls += 1
        assert (np.abs(x) <= 5.0).all()
        return bowl(x)


@pytest.mark.parametrize("mode", list(Mode))
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("jac", [None, bowl_slope])
def test_every_method_in_every_mode_finds_a_bowl_with_and_without_gradient(method: str, mode: str, jac) -> None:
    result = minimize(bowl, BOX, method=method, mode=mode, seed=1, maxiter=60, jac=jac)
    assert result.success
    assert result.x == pytest.approx([1.3, -0.7], abs=1e-5)
    assert result.fun == pytest.approx(bowl(result.x))
    assert result.nfev <= 1200


@pytest.mark.parametrize("shift", [0.0, 0.137])
@pytest.mark.parametrize("b", BENCHMARKS, ids=lambda b: b.name)
def test_haoaroa_reaches_the_minimum_of_all_nine_functions_plain_and_moved(b, shift: float) -> None:
    b = b.shifted(shift)
    result = minimize(b, b.bounds(2), seed=0, vectorized=True)
    assert result.fun - b.minimum(2) < 1e-8
    assert np.abs(b.best_points(2) - result.x).max(axis=1).min() < 1e-3
    assert result.nfev <= 20_000


@pytest.mark.parametrize("budget", [20, 39, 500, 1234])
@pytest.mark.parametrize("method", METHODS)
def test_every_evaluation_counts_and_the_budget_is_not_overdrawn(method: str, budget: int) -> None:
    polish = 0.0 if budget < 40 else 0.3
    fun = Counted()
    result = minimize(fun, BOX, method=method, budget=budget, polish=polish)
    assert result.nfev == fun.calls <= budget
    assert result.nit == int(budget * (1 - polish)) // 20


def test_literal_haoaroa_takes_differences_and_counts_them() -> None:
    fun = Counted()
    result = minimize(fun, BOX, mode="literal", budget=600, polish=0.0)
    assert result.nfev == fun.calls == 600
    assert result.nit == 600 // (20 * 3)


def test_costs_with_gradients_in_one_call_give_what_two_functions_give() -> None:
    one = minimize(lambda x: (rosen(x), rosen_der(x)), BOX, jac=True, maxiter=30)
    two = minimize(rosen, BOX, jac=rosen_der, maxiter=30)
    np.testing.assert_array_equal(one.x, two.x)
    assert one.nfev == two.nfev
    assert one.njev > 0


def test_a_vectorized_function_gives_what_a_plain_one_gives() -> None:
    one = minimize(bowl, BOX, seed=4, maxiter=30)
    many = minimize(lambda x: (x[:, 0] - 1.3) ** 2 + 2 * (x[:, 1] + 0.7) ** 2, BOX, seed=4, maxiter=30, vectorized=True)
    np.testing.assert_allclose(one.x, many.x, atol=1e-9)
    assert one.nfev == many.nfev


def test_its_differences_are_the_gradient_up_to_the_bounds() -> None:
    low, high = np.full(3, -2.0), np.full(3, 2.0)
    evaluator = Evaluator(rosen, None, (), False, low, high, 10_000)
    rng = np.random.default_rng(0)
    points = np.concatenate([rng.uniform(-2, 2, (10, 3)), [[2.0, 2.0, 2.0], [-2.0, 2.0, 0.0]]])
    _, gradients = evaluator.costs_and_gradients(points)
    exact = np.array([rosen_der(x) for x in points])
    assert gradients == pytest.approx(exact, rel=1e-4, abs=1e-3)
    assert check_grad(rosen, rosen_der, points[0]) < 1e-3  # the oracle itself


def test_the_same_seed_gives_the_same_result_and_a_generator_will_do() -> None:
    a, b = minimize(rosen, BOX, seed=5, maxiter=20), minimize(rosen, BOX, seed=np.random.default_rng(5), maxiter=20)
    c = minimize(rosen, BOX, seed=6, maxiter=20, polish=0.0)
    np.testing.assert_array_equal(a.x, b.x)
    assert not np.array_equal(a.x, c.x)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("hole", [np.nan, np.inf])
def test_holes_in_a_function_are_walked_around_and_counted(method: str, hole: float) -> None:
    def holed(x: np.ndarray) -> float:
        return hole if x[0] < 0.0 else bowl(x)

    result = minimize(holed, BOX, method=method, seed=2, maxiter=100)
    assert result.success
    assert result.x == pytest.approx([1.3, -0.7], abs=1e-4)
    assert "costs were NaN or inf" in result.message


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("mode", list(Mode))
def test_flat_stepped_and_enormous_functions_in_one_dimension_do_no_harm(method: str, mode: str) -> None:
    def least(fun, bound=(-5.0, 5.0)) -> OptimizeResult:
        return minimize(lambda x: float(fun(x[0])), [bound], method=method, mode=mode, maxiter=50)

    assert least(lambda x: 3.0).fun == 3.0
    assert least(lambda x: np.floor(abs(x - 1.5))).fun == 0.0
    assert least(lambda x: 1.7e308 * np.sin(x)).fun == pytest.approx(-1.7e308, rel=0.1)
    assert least(lambda x: (x / 1e149) ** 2, (-1e150, 3e150)).fun < 1.0
    assert least(lambda x: (x - 1.0) ** 2, (1 - 1e-12, 1 + 1e-12)).fun < 1e-24


@pytest.mark.parametrize("method", METHODS)
def test_a_function_that_is_nowhere_a_number_is_no_success(method: str) -> None:
    result = minimize(lambda x: np.nan, BOX, method=method, maxiter=5)
    assert (result.success, result.status, result.fun) == (False, 1, np.inf)
    assert result.x.shape == (2,)


def test_a_function_without_a_lower_bound_is_told_as_such() -> None:
    result = minimize(lambda x: -np.inf if x[0] > 0 else 0.0, BOX, maxiter=5)
    assert (result.success, result.status) == (False, 2)
    assert result.x[0] > 0


def test_gradients_that_are_no_numbers_move_nothing() -> None:
    result = minimize(bowl, BOX, jac=lambda x: np.full(2, np.nan), maxiter=50, polish=0.0)
    assert result.fun < 0.1


def test_the_callback_sees_the_best_so_far_and_may_stop_the_search() -> None:
    seen: list[OptimizeResult] = []

    def watch(now: OptimizeResult) -> bool:
        seen.append(now)
        return len(seen) == 4

    result = minimize(bowl, BOX, callback=watch)
    assert (result.success, result.status, result.nit, result.nfev) == (False, 99, 4, 80)
    assert [now.nit for now in seen] == [1, 2, 3, 4]
    assert all(later.fun <= now.fun for now, later in itertools.pairwise(seen))
    assert result.fun == seen[-1].fun == pytest.approx(bowl(seen[-1].x))

    def stop(now: OptimizeResult) -> None:
        raise StopIteration

    assert minimize(bowl, BOX, callback=stop).nit == 1


def test_it_begins_where_it_is_told_and_never_returns_worse() -> None:
    start = np.array([1.2, -0.6])
    assert minimize(bowl, BOX, x0=start, maxiter=1, polish=0.0).fun <= bowl(start)
    result = minimize(bowl, BOX, x0=[[9.0, 9.0], [1.3, -0.7]], maxiter=1, polish=0.0)
    assert result.fun == 0.0


def test_scipy_bounds_are_understood_and_args_are_passed_on() -> None:
    result = minimize(lambda x, a: float(((x - a) ** 2).sum()), Bounds([0, 0, 0], [1, 2, 3]), args=(0.5,), maxiter=60)
    assert result.x == pytest.approx([0.5] * 3, abs=1e-5)


def test_a_minimum_on_the_bounds_is_found_there() -> None:
    result = minimize(lambda x: float(x.sum()), [(-1.0, 2.0), (3.0, 4.0)], maxiter=60)
    assert result.x == pytest.approx([-1.0, 3.0])


@pytest.mark.parametrize(
    ("arguments", "names"),
    [
        ({"bounds": [(0, 1), (2, 1)]}, r"bounds\[1\]"),
        ({"bounds": [(0, 1), (0, np.inf)]}, r"bounds\[1\]"),
        ({"bounds": [(0, 1), (-1e308, 1e308)]}, r"bounds\[1\]"),
        ({"bounds": [(np.nan, 1)]}, r"bounds\[0\]"),
        ({"bounds": [(0, 1), (1, 2, 3)]}, r"bounds\[1\]"),
        ({"bounds": [(0, 1), 3]}, r"bounds\[1\]"),
        ({"bounds": [(None, 1)]}, r"bounds\[0\]"),
        ({"bounds": []}, "bounds"),
        ({"method": "pso"}, "method"),
        ({"mode": "printed"}, "mode"),
        ({"population": 3}, "population"),
        ({"maxiter": 0}, "maxiter"),
        ({"budget": 19}, "budget"),
        ({"budget": 20}, "budget"),  # it pays for one iteration, and then for no polish
        ({"polish": 1.0}, "polish"),
        ({"polish": np.nan}, "polish"),
        ({"step": 0.0}, "step"),
        ({"x0": [1.0, 2.0, 3.0]}, "x0"),
        ({"x0": [[0.0, 1.0], [np.nan, 1.0]]}, r"x0\[1\]"),
        ({"x0": np.zeros((21, 2))}, "x0"),
        ({"jac": 3}, "jac"),
        ({"jac": True, "vectorized": True}, "jac"),
    ],
)
def test_misuse_is_told_with_the_name_of_the_entry(arguments: dict, names: str) -> None:
    with pytest.raises(ValueError, match=names):
        minimize(bowl, **{"bounds": BOX, **arguments})


def test_functions_of_the_wrong_shape_are_told_so() -> None:
    with pytest.raises(ValueError, match="fun"):
        minimize(lambda x: x, BOX)
    with pytest.raises(ValueError, match="fun"):
        minimize(lambda x: x, BOX, vectorized=True)
    with pytest.raises(ValueError, match="jac"):
        minimize(bowl, BOX, jac=lambda x: np.zeros(3))


def test_literal_haoaroa_descends_early_and_is_drawn_to_the_leader_late() -> None:
    optimiser = HaoaroaLiteral(
        np.full(2, -9.0), np.full(2, 9.0), np.random.default_rng(0), population=4, budget=40, step=0.5
    )
    first = optimiser.ask()
    gradients = np.array([[2.0, -1.0], [0.0, 0.0], [0.0, 8.0], [-3.0, 3.0]])
    optimiser.tell(np.array([4.0, 3.0, 1.0, 2.0]), gradients)
    down = np.array([[-0.5, 0.25], [0.0, 0.0], [0.0, -0.5], [0.5, -0.5]])
    np.testing.assert_allclose(optimiser.ask(), np.clip(first + down, -9, 9), atol=1e-12)  # Eq. 44, 45
    optimiser.iteration = 8  # TF = exp(-0.1)
    before = optimiser.ask()
    optimiser.tell(np.array([0.5, 9.0, 9.0, 9.0]), np.zeros((4, 2)))
    after, leader = optimiser.ask(), before[0]
    shares = (after[1:] - before[1:]) / (leader - before[1:])  # gamma, the same on both coordinates
    assert (shares > 0).all()
    assert (shares < 1).all()
    np.testing.assert_allclose(shares[:, 0], shares[:, 1], rtol=1e-9)
    with pytest.raises(ValueError, match="gradients"):
        optimiser.tell(np.zeros(4))


def test_canonical_haoaroa_hands_what_aoa_kept_to_the_riders() -> None:
    optimiser = HaoaroaCanonical(np.full(2, -5.0), np.full(2, 5.0), np.random.default_rng(3), budget=2000)
    bests = []
    while not optimiser.done:
        optimiser.tell((optimiser.ask() ** 2).sum(axis=1))
        bests.append(optimiser.best.cost)
    assert optimiser.evaluations == 2000
    assert all(b <= a for a, b in itertools.pairwise(bests))
    assert bests[-1] < 1e-3 * bests[30]  # the riders begin where exp((t - T)/T) passes 1/2, at t = 31 of 100
