"""ROA: each rider's rule worked by hand in each mode, its bias to the origin where it has one, and minima."""

import math

import numpy as np
import pytest

from planner.search.asktell import Mode
from planner.search.roa import Riders, Roa, direction, draws, move, race


def riders() -> Riders:
    """Four riders in the plane, one of each group; the third leads."""
    x = np.array([[1.0, 2.0], [2.0, -1.0], [3.0, 1.0], [5.0, 4.0]])
    return Riders(
        positions=x.copy(),
        gradients=np.zeros((4, 2)),
        costs=np.array([4.0, 3.0, 1.0, 2.0]),
        previous=np.array([5.0, 2.0, 1.0, 3.0]),
        angles=np.array([[0.0, math.pi], [math.pi / 3, 0.0], [math.pi, 0.0], [math.pi / 2, math.pi / 3]]),
        gears=np.array([0.0, 2.0, 4.0, 3.0]),
        leader=np.array([3.0, 1.0]),
        best_position=np.array([3.0, 1.0]),
        best_cost=np.array([1.0]),
        steps=np.array([0.1, 0.2, 0.3, 0.4]),
        lower=np.array([-10.0, -20.0]),
        upper=np.array([10.0, 20.0]),
    )


def ride(invariant: bool, t: int = 5, with_gradient: bool = False, p: Riders | None = None) -> np.ndarray:
    """Where everybody is after one move: eta is the second rider, xi the fourth, delta 1/2, beta 1/4 and 3/4."""
    p = riders() if p is None else p
    u = np.zeros((4, draws(2)))
    u[:, 0], u[:, 1], u[:, 2], u[:, 3], u[:, 4] = 0.3, 0.8, 0.5, 0.25, 0.75
    move(p, t, 10, u, with_gradient, invariant)
    return p.positions


def test_successful_riders_shift_up_and_take_the_next_rider_s_angles() -> None:
    p = riders()
    race(p, True)
    assert p.gears == pytest.approx([1.0, 1.0, 3.0, 4.0])  # the third only equals its last cost: no success
    angles = riders().angles
    np.testing.assert_array_equal(p.angles, [angles[1], angles[0], angles[1], angles[0]])
    assert p.steps == pytest.approx([0.12, 0.14, 0.21, 0.48])


def test_the_leader_is_the_best_so_far_or_the_best_of_this_iteration() -> None:
    for remembered, leader in ((True, [9.0, 9.0]), (False, [3.0, 1.0])):
        p = riders()
        p.best_cost[:], p.best_position[:] = 0.5, [9.0, 9.0]
        race(p, remembered)
        assert list(p.leader) == leader


def test_the_direction_indicator_worked_by_hand() -> None:
    assert direction(np.array([1.0, 3.0, 2.0])) == pytest.approx(
        [1.0, 2 / (1 + math.log(1e6)) - 1, 2 / (1 + math.log(2)) - 1]
    )
    assert direction(np.array([2.0, 2.0])) == pytest.approx([1.0, 1.0])
    assert direction(np.array([2.0, np.inf])) == pytest.approx([1.0, 2 / (1 + math.log(1e6)) - 1])


def test_the_four_printed_rules_worked_by_hand() -> None:
    bypass, follower, overtaker, attacker = ride(invariant=False)
    mix = [0.25 * 2 + 0.75 * 5, 0.75 * -1 + 0.25 * 4]
    assert bypass == pytest.approx([0.5 * mix[0], 0.5 * mix[1]])
    d = 20 / 10 * 2 / 4  # second gear, in the first coordinate
    assert follower == pytest.approx([3 + 0.5 * 3 * d, -1.0])  # beta 3/4 is not below 5/10: closed
    assert overtaker == pytest.approx([3.0 + 3.0, 1.0 + 1.0])  # the leader itself: I = 1
    assert attacker == pytest.approx([3 + 0.0 * 3 + 20 / 10 * 3 / 4, 1 + 0.5 * 1 + 40 / 10 * 3 / 4])


def test_the_four_rules_by_differences_worked_by_hand() -> None:
    bypass, follower, overtaker, attacker = ride(invariant=True)
    mix = [0.25 * 2 + 0.75 * 5, 0.75 * -1 + 0.25 * 4]
    assert bypass == pytest.approx([1 + 0.5 * (mix[0] - 1), 2 + 0.5 * (mix[1] - 2)])
    assert follower == pytest.approx([3 + 0.5 * (3 - 2) * 2 / 4, -1.0])
    assert overtaker == pytest.approx([3.0, 1.0])
    assert attacker == pytest.approx([3 + 0.0 + 20 / 10 * 3 / 4, 1 + 0.5 * (1 - 4) + 40 / 10 * 3 / 4])


def test_an_overtaker_moves_on_the_coordinates_on_which_it_is_near_the_leader() -> None:
    p = riders()
    p.costs[:] = [1.0, 3.0, 2.0, 3.0]
    p.leader[:] = [4.0, 8.0]  # 1 and 7 away, 4 on the mean
    sign = 2 / (1 + math.log(2)) - 1
    assert ride(True, p=p)[2] == pytest.approx([3 + sign * (4 - 3), 1.0])


def test_a_gradient_adds_a_step_down_of_each_rider_s_own_length() -> None:
    with_it, without = riders(), riders()
    with_it.gradients[:] = [[4.0, -2.0], [0.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]
    moved = ride(True, with_gradient=True, p=with_it) - ride(True, p=without)
    assert moved == pytest.approx(np.array([[-0.1, 0.05], [0.0, 0.0], [0.0, -0.3], [0.4, 0.0]]))


def run(mode: Mode, seed: int, shift: float = 0.0, peak: float = 0.0, budget: int = 4000) -> Roa:
    """Minimise a bowl with its least at `peak`, the whole problem moved by `shift`."""
    low, high = np.full(3, -5.0 + shift), np.full(3, 5.0 + shift)
    optimiser = Roa(low, high, np.random.default_rng(seed), budget=budget, mode=mode)
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


def test_it_comes_near_the_minimum_of_a_bowl_wherever_it_is() -> None:
    costs = [run(Mode.SHIFT_INVARIANT, seed, peak=1.37, budget=20_000).best.cost for seed in range(9)]
    assert np.median(costs) < 1e-2
    assert max(costs) < 1.0  # a point taken at random costs about 30


@pytest.mark.parametrize("mode", list(Mode))
def test_riders_stay_in_bounds_and_the_same_seed_repeats(mode: Mode) -> None:
    a, b, c = run(mode, 3, budget=400), run(mode, 3, budget=400), run(mode, 4, budget=400)
    np.testing.assert_array_equal(a.ask(), b.ask())
    assert not np.array_equal(a.ask(), c.ask())
    assert (np.abs(a.ask()) <= 5.0).all()
    assert a.evaluations == 400
