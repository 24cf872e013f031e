"""AOA: its rules worked by hand in each mode, its bias to the origin where it has one, and that it finds minima."""

import numpy as np
import pytest

from planner.search.aoa import Aoa, Materials, draws, keep, move
from planner.search.asktell import Mode

LITERAL, CANONICAL, INVARIANT = 0, 1, 2


def materials() -> Materials:
    """Four materials of one dimension at 1, 2, 3, 5; the third is the best and known to be."""
    return Materials(
        positions=np.array([[1.0], [2.0], [3.0], [5.0]]),
        costs=np.array([4.0, 3.0, 1.0, 2.0]),
        gradients=np.zeros((4, 1)),
        trials=np.array([[1.5], [2.5], [3.5], [4.5]]),
        trial_costs=np.array([3.5, 3.5, 0.5, np.inf]),
        trial_gradients=np.array([[2.0], [-4.0], [1.0], [1.0]]),
        density=np.array([[0.2], [0.4], [0.6], [0.8]]),
        volume=np.array([[0.5], [0.5], [0.5], [1.0]]),
        acceleration=np.array([[0.1], [0.4], [0.7], [1.0]]),
        best=np.array([[3.0], [0.6], [0.5], [0.7]]),
        best_cost=np.array([1.0]),
        steps=np.array([0.1, 0.2, 0.3, 0.4]),
        lower=np.array([-10.0]),
        upper=np.array([10.0]),
    )


def uniforms(r_traits: float, other: float, r: float, flag: float) -> np.ndarray:
    """The same numbers for everybody: H7's, the random material's, H13's or H14's, and the flag's."""
    u = np.zeros((4, draws(1)))
    u[:, 0], u[:, 1], u[:, 3], u[:, 4] = r_traits, other, other, flag
    u[:, 5], u[:, 6], u[:, 7] = r, other, flag
    return u


def scaled(raw: list[float]) -> np.ndarray:
    low, high = min(raw), max(raw)
    return np.array([0.1 + 0.9 * (v - low) / (high - low) for v in raw])


def test_greedy_modes_refuse_what_is_worse_and_the_printed_one_takes_it() -> None:
    for mode in (CANONICAL, INVARIANT):
        m = materials()
        keep(m, mode)
        assert m.positions.ravel() == pytest.approx([1.5, 2.0, 3.5, 5.0])
        assert m.costs == pytest.approx([3.5, 3.0, 0.5, 2.0])
        assert m.steps == pytest.approx([0.12, 0.14, 0.36, 0.28])
    m = materials()
    keep(m, LITERAL)
    assert m.positions.ravel() == pytest.approx([1.5, 2.5, 3.5, 4.5])
    assert m.best.ravel() == pytest.approx([3.5, 0.6, 0.5, 0.7])
    assert m.best_cost[0] == 0.5


@pytest.mark.parametrize("mode", [LITERAL, INVARIANT])
def test_one_early_move_worked_by_hand(mode: int) -> None:
    m = materials()
    move(m, 1, 10, uniforms(0.5, 0.3, 0.25, 0.0), False, mode, 1.0, 2.0)  # int(0.3 * 4) = 1: the second material
    d = np.exp(0.9) - 0.1  # H9
    density = [0.4, 0.5, 0.6, 0.7]  # halfway to 0.6, H7; the second's is used as it is when it is its turn
    volume = [0.5, 0.5, 0.5, 0.75]
    push = [0.4 + 0.5 * 0.4, 0.5 + 0.5 * 0.4, 0.5 + 0.5 * 0.4, 0.5 + 0.5 * 0.4]  # H10
    acc = scaled([p / (q * v) for p, q, v in zip(push, density, volume, strict=True)])  # H12
    x = np.array([1.0, 2.0, 3.0, 5.0])
    assert m.acceleration.ravel() == pytest.approx(acc)
    assert m.trials.ravel() == pytest.approx(x + 2.0 * 0.25 * acc * d * (2.0 - x))  # H13


@pytest.mark.parametrize(("mode", "tau"), [(LITERAL, np.exp(-0.2)), (INVARIANT, 1.0)])
@pytest.mark.parametrize(("flag", "sign"), [(0.2, 1.0), (0.9, -1.0)])
def test_one_late_move_worked_by_hand(mode: int, tau: float, flag: float, sign: float) -> None:
    m = materials()
    move(m, 8, 10, uniforms(0.0, 0.3, 0.25, flag), False, mode, 1.0, 0.5)  # 2 r - C4 = -0.1 and 1.3
    d = np.exp(0.2) - 0.8
    push = 0.6 + 0.5 * 0.7  # H11: the best material's
    acc = scaled([push / (q * v) for q, v in zip([0.2, 0.4, 0.6, 0.8], [0.5, 0.5, 0.5, 1.0], strict=True)])
    x = np.array([1.0, 2.0, 3.0, 5.0])
    assert m.trials.ravel() == pytest.approx(3.0 + sign * 6.0 * 0.25 * acc * d * (tau * 3.0 - x))  # H14, H15


def test_the_published_program_divides_the_collision_once_more_and_ends_it_sooner() -> None:
    m = materials()
    u = uniforms(0.0, 0.3, 0.25, 0.2)
    u[:, 2] = [0.0, 0.5, 0.75, 0.0]
    move(m, 2, 10, u, False, CANONICAL, 1.0, 2.0)  # TF = 0.449: H10 still, H14 already
    push = 0.4 + 0.5 * 0.4
    more, density, volume = [1.0, 0.5, 0.25, 1.0], [0.2, 0.4, 0.6, 0.8], [0.5, 0.5, 0.5, 1.0]
    acc = scaled([push / (a * b * c) for a, b, c in zip(more, density, volume, strict=True)])
    d, tau, x = np.exp(0.8) - 0.2, np.exp(-0.8), np.array([1.0, 2.0, 3.0, 5.0])
    moved = 3.0 + 6.0 * 0.25 * acc * d * (tau * 3.0 - x)
    assert m.trials.ravel() == pytest.approx(np.clip(moved, -10, 10))


def test_a_gradient_adds_a_step_down_of_each_material_s_own_length() -> None:
    with_it, without = materials(), materials()
    for m in (with_it, without):
        m.gradients[:] = [[5.0], [-0.1], [0.0], [2.0]]
    move(with_it, 1, 10, uniforms(0.5, 0.3, 0.25, 0.0), True, INVARIANT, 1.0, 0.5)
    move(without, 1, 10, uniforms(0.5, 0.3, 0.25, 0.0), False, INVARIANT, 1.0, 0.5)
    assert (with_it.trials - without.trials).ravel() == pytest.approx([-0.1, 0.2, 0.0, -0.4])


def run(mode: Mode, seed: int, shift: float = 0.0, peak: float = 0.0, budget: int = 4000) -> Aoa:
    """Minimise a bowl with its least at `peak`, the whole problem moved by `shift`."""
    low, high = np.full(3, -5.0 + shift), np.full(3, 5.0 + shift)
    optimiser = Aoa(low, high, np.random.default_rng(seed), budget=budget, mode=mode)
    while not optimiser.done:
        optimiser.tell(((optimiser.ask() - shift - peak) ** 2).sum(axis=1))
    return optimiser


def test_moving_the_problem_moves_the_answer_of_the_invariant_mode_with_it() -> None:
    here, there = run(Mode.SHIFT_INVARIANT, 1, peak=1.37), run(Mode.SHIFT_INVARIANT, 1, shift=64.0, peak=1.37)
    np.testing.assert_allclose(there.best.position - 64.0, here.best.position, atol=1e-6)


@pytest.mark.parametrize("mode", [Mode.LITERAL, Mode.CANONICAL])
def test_the_published_algorithm_is_drawn_to_the_origin(mode: Mode) -> None:
    centred = np.median([run(mode, seed).best.cost for seed in range(5)])
    moved = np.median([run(mode, seed, peak=1.37).best.cost for seed in range(5)])
    assert centred < 1e-3 * moved


@pytest.mark.parametrize("seed", range(5))
def test_it_finds_the_minimum_of_a_bowl_wherever_it_is(seed: int) -> None:
    assert run(Mode.SHIFT_INVARIANT, seed, peak=1.37, budget=20_000).best.cost < 1e-6


@pytest.mark.parametrize("mode", list(Mode))
def test_candidates_stay_in_bounds_and_the_same_seed_repeats(mode: Mode) -> None:
    a, b, c = run(mode, 3, budget=400), run(mode, 3, budget=400), run(mode, 4, budget=400)
    np.testing.assert_array_equal(a.ask(), b.ask())
    assert not np.array_equal(a.ask(), c.ask())
    assert (np.abs(a.ask()) <= 5.0).all()
    assert a.evaluations == 400
    with pytest.raises(ValueError, match="spent"):
        a.tell(np.zeros(20))


def test_costs_and_bounds_that_do_not_fit_are_refused() -> None:
    optimiser = Aoa(np.zeros(2), np.ones(2), np.random.default_rng(0))
    with pytest.raises(ValueError, match="costs"):
        optimiser.tell(np.full(20, np.nan))
    with pytest.raises(ValueError, match="gradients"):
        optimiser.tell(np.zeros(20), np.zeros((20, 3)))
    with pytest.raises(ValueError, match="bounds"):
        Aoa(np.ones(2), np.zeros(2), np.random.default_rng(0))
    with pytest.raises(ValueError, match="population"):
        Aoa(np.zeros(2), np.ones(2), np.random.default_rng(0), population=3)
