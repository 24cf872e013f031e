"""The cost: its gradient against central differences, its terms against quadrature and closed forms."""

import numpy as np
import pytest
from scipy.interpolate import BSpline

from planner import Box, Cylinder, Limits, Sphere, Trajectory, World
from planner.bspline import clamped_knots
from planner.cost import SAMPLES, SplineCost, hinge

LIMITS = Limits(speed=3.0, acceleration=6.0, jerk=60.0)
WORLD = World(
    bounds=((0, 0, 0), (20, 20, 4)),
    obstacles=[Box((9, 6, 0), (10, 15, 4)), Cylinder((5, 9), 0.6, (0, 4)), Sphere((14, 11, 2), 1.0)],
)
START, GOAL = np.array([1.0, 10.0, 1.5]), np.array([19.0, 10.0, 1.5])


def random_curve(cost: SplineCost, seed: int) -> np.ndarray:
    f = cost.size // 3
    line = START + np.arange(1, f + 1)[:, None] / (f + 1) * (GOAL - START)
    return (line + np.random.default_rng(seed).normal(scale=[1.0, 2.5, 1.0], size=(f, 3))).ravel()


@pytest.mark.parametrize("seed", range(5))
def test_the_gradient_is_the_central_difference(seed: int) -> None:
    cost = SplineCost(WORLD, START, GOAL, 16, LIMITS, 0.45)
    x = random_curve(cost, seed)
    _, gradient = cost(x)
    h = 1e-6
    numeric = [(cost(x + h * e)[0] - cost(x - h * e)[0]) / (2 * h) for e in np.eye(cost.size)]
    np.testing.assert_allclose(gradient, numeric, rtol=1e-5, atol=1e-5 * np.abs(gradient).max())


def test_the_kernel_is_the_sum_of_the_three_terms() -> None:
    cost = SplineCost(WORLD, START, GOAL, 16, LIMITS, 0.45)
    x = random_curve(cost, 7)
    assert cost(x)[0] == pytest.approx(cost.terms(x).total, rel=1e-12)


def test_the_obstacle_term_sums_the_hinge_over_all_solids_and_walls_at_every_sample() -> None:
    cost = SplineCost(WORLD, START, GOAL, 16, LIMITS, 0.45, weight=30.0)
    x, c = random_curve(cost, 3), 0.45
    count = 13 * SAMPLES
    curve = BSpline(clamped_knots(16), cost.control_points(x), 3)((np.arange(count) + 0.5) / count)
    total = 0.0
    gaps = [World(WORLD.bounds, [o]).distance(curve) for o in WORLD.obstacles]
    gaps += [curve[:, a] - WORLD.bounds[0][a] for a in range(3)] + [WORLD.bounds[1][a] - curve[:, a] for a in range(3)]
    for d in gaps:
        e = np.maximum(c - d, 0.0)
        total += np.where(e <= c, e**3, 3 * c * e**2 - 3 * c**2 * e + c**3).sum()
    assert cost.obstacle(x) == pytest.approx(30.0 * 18.0 / (c**2 * count) * total, rel=1e-12)


@pytest.mark.parametrize(
    ("speed", "acceleration"), [(3.0, 6.0), (1.0, 10.0), (10.0, 5.0), (30.0, 2.0)], ids=["3/6", "1/10", "10/5", "30/2"]
)
def test_smoothness_is_weighed_by_the_share_of_the_fastest_run_that_goes_into_speeding_up(speed, acceleration) -> None:
    """Eq. 38 with the weight of the header; the fastest run over 18 m is integrated here, step by step."""
    dt, s, v, speeding = 1e-4, 0.0, 0.0, 0.0
    while s < 9.0 and v < speed:  # a run is symmetric: this is its first half
        v, speeding = v + acceleration * dt, speeding + dt
        s += v * dt
    share = speeding / (2.0 * (speeding + max(9.0 - s, 0.0) / speed))
    cost = SplineCost(WORLD, START, GOAL, 16, Limits(speed, acceleration, 60.0), 0.45)
    x = random_curve(cost, 4)
    curve = BSpline(clamped_knots(16), cost.control_points(x), 3)
    u = (np.arange(200_000) + 0.5) / 200_000
    bending = (curve.derivative(2)(u) ** 2).sum(axis=1).mean() / 18.0
    assert cost.smoothness(x) == pytest.approx(share**2 * bending, rel=2e-3)
    assert cost.stretch(x) == pytest.approx((curve.derivative(1)(u) ** 2).sum(axis=1).mean() / 18.0, rel=1e-6)


def test_the_stretch_is_least_for_the_straight_line_run_evenly() -> None:
    cost = SplineCost(World(WORLD.bounds), START, GOAL, 16, LIMITS, 0.3)
    x = cost.control_points(np.zeros(cost.size))[3:-3].ravel()
    line = START + np.arange(1, 11)[:, None] / 11 * (GOAL - START)
    least = cost.stretch(line.ravel())
    assert all(cost.stretch(line.ravel() + d) > least for d in np.random.default_rng(0).normal(size=(20, x.size)))


def test_length_squared_over_the_way_never_exceeds_the_stretch() -> None:
    cost = SplineCost(WORLD, START, GOAL, 16, LIMITS, 0.45)
    for seed in range(5):
        x = random_curve(cost, seed)
        assert Trajectory(cost.control_points(x), clamped_knots(16)).length ** 2 / 18.0 <= cost.stretch(x)


def test_the_hinge_joins_its_pieces_twice_continuously_differentiable() -> None:
    c, h = 0.4, 1e-7
    below, above = hinge(c - h, c), hinge(c + h, c)
    assert below[0] == pytest.approx(above[0], abs=1e-6)
    assert below[1] == pytest.approx(above[1], abs=1e-5)
    second = [(hinge(e + h, c)[1] - hinge(e, c)[1]) / h for e in (c - 2 * h, c + h)]
    assert second[0] == pytest.approx(second[1], rel=1e-5)


def test_moving_the_whole_world_changes_no_cost() -> None:
    shift = np.array([4e6, -5e5, 7.0])
    moved = World(
        bounds=(tuple(shift), tuple(shift + np.array([20, 20, 4]))),
        obstacles=[
            Box(tuple(shift + np.array([9, 6, 0])), tuple(shift + np.array([10, 15, 4]))),
            Cylinder((4e6 + 5, -5e5 + 9), 0.6, (7, 11)),
            Sphere(tuple(shift + np.array([14, 11, 2])), 1.0),
        ],
    )
    here = SplineCost(WORLD, START, GOAL, 16, LIMITS, 0.45)
    there = SplineCost(moved, START + shift, GOAL + shift, 16, LIMITS, 0.45)
    x = random_curve(here, 2)
    assert there((x.reshape(-1, 3) + shift).ravel())[0] == pytest.approx(here(x)[0], rel=1e-7)


def test_a_curve_out_of_reach_of_everything_costs_nothing_for_obstacles() -> None:
    cost = SplineCost(World(WORLD.bounds), START, GOAL, 16, LIMITS, 0.45)
    line = START + np.arange(1, 11)[:, None] / 11 * (GOAL - START)
    assert cost.obstacle(line.ravel()) == 0.0


def test_too_few_control_points_and_no_reach_are_refused() -> None:
    with pytest.raises(ValueError, match="control points"):
        SplineCost(WORLD, START, GOAL, 6, LIMITS, 0.4)
    with pytest.raises(ValueError, match="reach"):
        SplineCost(WORLD, START, GOAL, 16, LIMITS, 0.0)


def test_the_quick_energy_is_stretch_and_smoothness_together() -> None:
    cost = SplineCost(World(((0, 0, 0), (20, 20, 4))), np.array([1, 2, 1.0]), np.array([9, 8, 2.0]), 16, LIMITS, 0.4)
    x = np.random.default_rng(0).uniform(0.5, 3.5, cost.size)
    assert cost.energy(x) == pytest.approx(cost.stretch(x) + cost.smoothness(x), rel=1e-12)
