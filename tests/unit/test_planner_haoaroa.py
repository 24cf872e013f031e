"""HAOAROA: its update by hand, its independence of the origin, its repeatability, and that it finds minima."""

import numpy as np
import pytest

from planner import Box, Limits, World
from planner.cost import SplineCost
from planner.descent import search
from planner.search.haoaroa import Haoaroa, Population, draws, move, remember
from planner.seeds import fan


def sphere(x: np.ndarray) -> np.ndarray:
    return ((x - 1.3) ** 2).sum(axis=1)


def rastrigin(x: np.ndarray) -> np.ndarray:
    z = x - 1.37
    return 10 * z.shape[1] + (z**2 - 10 * np.cos(2 * np.pi * z)).sum(axis=1)


def minimise(function, dim: int, seed: int, budget: int = 6000, gradient=None, shift: float = 0.0) -> Haoaroa:
    optimiser = Haoaroa(
        np.full(dim, -5.0 + shift), np.full(dim, 5.0 + shift), np.random.default_rng(seed), budget=budget
    )
    while not optimiser.done:
        x = optimiser.ask() - shift
        optimiser.tell(function(x), None if gradient is None else gradient(x))
    return optimiser


def small_population() -> Population:
    """Four candidates of one dimension; the third is the best."""
    x = np.array([[1.0], [2.0], [3.0], [5.0]])
    costs = np.array([4.0, 3.0, 1.0, 2.0])
    return Population(
        positions=x.copy(),
        velocities=np.array([[0.5], [0.0], [0.0], [-1.0]]),
        gradients=np.array([[2.0], [-4.0], [0.0], [1.0]]),
        costs=costs.copy(),
        previous=np.array([9.0, 2.0, 2.0, 3.0]),
        best_positions=x.copy(),
        best_costs=costs.copy(),
        steps=np.array([0.1, 0.2, 0.3, 0.4]),
        traits=np.full((4, 3), 0.5),
        lower=np.array([-10.0]),
        upper=np.array([5.2]),
    )


def test_steps_grow_when_the_cost_fell_and_shrink_when_it_did_not() -> None:
    p = small_population()
    remember(p)
    assert p.steps == pytest.approx([0.12, 0.14, 0.36, 0.48])


def test_one_exploring_move_worked_by_hand() -> None:
    p = small_population()
    u = np.zeros((4, draws(1)))
    u[:, 0] = 0.3  # int(0.3 * 4) = 1: everybody's random candidate is the second, at 2
    u[:, 8] = 0.5  # r1
    move(p, 1, 10, u, True)
    w, d = 0.8 - 0.04, np.exp(0.9) - 0.1
    moved = 1.0 + w * 0.5 + 0.3 * 0.5 * d * (2.0 - 1.0) - 0.1  # s g, with g = 1 after division by its own size
    assert p.positions[0, 0] == pytest.approx(moved)
    assert p.positions[1, 0] == pytest.approx(2.0 + 0.2)  # its random one is itself; the gradient points down


def test_one_exploiting_move_of_each_rider_worked_by_hand() -> None:
    p = small_population()
    p.velocities[:] = 0.0
    p.gradients[:] = 0.0
    p.best_positions[:] = [[1.5], [2.0], [3.0], [4.0]]
    u = np.zeros((4, draws(1)))
    u[:, 1], u[:, 2] = 0.3, 0.8  # mates: second and fourth
    u[:, 4] = 0.25
    u[:, 8], u[:, 9] = 0.5, 0.4  # r1, r2
    move(p, 8, 10, u, True)
    own = 2.0 * 0.5  # c1 r1
    lead = 1.5 * 0.4  # c2 r2
    bypass = 0.25 * 2.0 + 0.75 * 4.0
    assert p.positions[0, 0] == pytest.approx(1.0 + (own * 0.5 + lead * (bypass - 1.0)) / 2)
    assert p.positions[1, 0] == pytest.approx(2.0 + lead * (3.0 - 2.0) / 2)  # follower: 0.4 < 8/10, the leader counts
    assert p.positions[2, 0] == pytest.approx(3.0)  # the leader stays
    assert p.positions[3, 0] == pytest.approx(5.0 + (own * (4.0 - 5.0) + lead * (3.0 - 5.0)) / 2)  # attacker


def test_a_candidate_that_hits_a_bound_stops_there() -> None:
    p = small_population()
    p.velocities[3] = 2.0
    move(p, 1, 10, np.full((4, draws(1)), 0.99), True)
    assert p.positions[3, 0] == 5.2
    assert p.velocities[3, 0] == 0.0


@pytest.mark.parametrize("seed", range(5))
def test_it_finds_the_minimum_of_a_shifted_bowl_with_and_without_gradient(seed: int) -> None:
    assert minimise(sphere, 5, seed).best.cost < 1e-3
    assert minimise(sphere, 5, seed, gradient=lambda x: 2 * (x - 1.3)).best.cost < 1e-6


def test_it_leaves_local_minima_of_a_shifted_rastrigin() -> None:
    costs = [minimise(rastrigin, 2, seed).best.cost for seed in range(5)]
    assert np.median(costs) < 0.1  # the nearest other minimum costs about 1


def test_moving_the_problem_moves_the_answer_with_it() -> None:
    here, there = minimise(rastrigin, 3, 2), minimise(rastrigin, 3, 2, shift=64.0)
    np.testing.assert_allclose(there.best.position - 64.0, here.best.position, atol=1e-6)


def test_the_same_seed_makes_the_same_moves_and_another_seed_others() -> None:
    a, b, c = (minimise(rastrigin, 3, seed, budget=400).ask() for seed in (1, 1, 2))
    np.testing.assert_array_equal(a, b)
    assert not np.array_equal(a, c)


def test_the_fused_loop_makes_the_moves_of_ask_and_tell_bit_for_bit() -> None:
    world = World(bounds=((0, 0, 0), (20, 20, 4)), obstacles=[Box((9, 6, 0), (10, 15, 4))])
    start, goal = np.array([1.0, 10.0, 1.5]), np.array([19.0, 10.0, 1.5])
    cost = SplineCost(world, start, goal, 16, Limits(3.0, 6.0, 60.0), 0.42)
    low, high = np.full(3, 0.3), np.array([19.7, 19.7, 3.7])
    seeds = fan(start, goal, low, high, 16, 20, np.random.default_rng(0))
    fused, spoken = (
        Haoaroa(np.tile(low, 10), np.tile(high, 10), np.random.default_rng(9), seeds, budget=20 * 33) for _ in range(2)
    )
    search(fused, cost)
    while not spoken.done:
        told = [cost(x) for x in spoken.ask()]
        spoken.tell(np.array([value for value, _ in told]), np.array([gradient for _, gradient in told]))
    np.testing.assert_array_equal(fused.ask(), spoken.ask())
    assert fused.best.cost == spoken.best.cost
    assert fused.evaluations == spoken.evaluations == 660


def test_the_budget_counts_evaluations_and_is_not_overdrawn() -> None:
    optimiser = minimise(sphere, 2, 0, budget=419)
    assert optimiser.evaluations == 400
    with pytest.raises(ValueError, match="spent"):
        optimiser.tell(np.zeros(20))


def test_costs_that_are_no_numbers_are_refused() -> None:
    optimiser = Haoaroa(np.zeros(2), np.ones(2), np.random.default_rng(0))
    with pytest.raises(ValueError, match="costs"):
        optimiser.tell(np.full(20, np.nan))
    with pytest.raises(ValueError, match="bounds"):
        Haoaroa(np.ones(2), np.zeros(2), np.random.default_rng(0))
