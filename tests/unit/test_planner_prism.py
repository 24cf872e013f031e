"""Polygon prisms: distances against every edge one by one, supporting planes where they hold, what is no outline."""

import math
import pickle

import numpy as np
import pytest

from planner import Box, Limits, Prism, StartInCollision, World, plan
from planner.bspline import clamped_knots, evaluate
from planner.certificate import certify
from planner.cost import SplineCost
from planner.distance import NOTCHED, PRISM
from planner.nearby import build_grid

WALLS = ((-10.0, -10.0, -10.0), (10.0, 10.0, 10.0))
LIMITS = Limits(3.0, 6.0, 60.0)
STAR = [
    (r * math.cos(a), r * math.sin(a)) for a, r in zip(np.arange(10) * math.pi / 5 + 0.1, [3, 1.2] * 5, strict=True)
]
L_SHAPE = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
COMB = [(0, 0), (6, 0), (6, 3), (5, 3), (5, 1), (4, 1), (4, 3), (3, 3), (3, 0.5), (1, 0.5), (1, 3), (0, 3)]
TRIANGLE = [(-2.0, -1.0), (3.0, 0.0), (0.5, 2.5)]
STRAIGHT = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)]  # corners where nothing bends
SHAPES = {"star": STAR, "L": L_SHAPE, "comb": COMB, "triangle": TRIANGLE, "straight": STRAIGHT}
CONVEX = {"triangle", "straight"}


def outline_distance(corners: list[tuple[float, float]], p: np.ndarray) -> np.ndarray:
    """Signed distance (m,) of points (m, 2): the least over the edges, the sign by the sum of the angles seen."""
    a = np.array(corners, dtype=float)
    b = np.roll(a, -1, axis=0)
    least, turned = np.full(len(p), np.inf), np.zeros(len(p))
    for v, w in zip(a, b, strict=True):
        t = np.clip((p - v) @ (w - v) / ((w - v) @ (w - v)), 0, 1)
        least = np.minimum(least, np.linalg.norm(p - v - t[:, None] * (w - v), axis=1))
        to_v, to_w = np.arctan2(*(v - p).T[::-1]), np.arctan2(*(w - p).T[::-1])
        turned += (to_w - to_v + math.pi) % (2 * math.pi) - math.pi
    return np.where(np.abs(turned) > math.pi, -least, least)


def prism_distance(corners: list[tuple[float, float]], z: tuple[float, float], p: np.ndarray) -> np.ndarray:
    side, cap = outline_distance(corners, p[:, :2]), np.maximum(z[0] - p[:, 2], p[:, 2] - z[1])
    return np.where((side > 0) & (cap > 0), np.hypot(side, cap), np.maximum(side, cap))


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("turn", [1, -1])
def test_the_distance_is_exact_inside_and_out_whichever_way_round_the_corners_go(name: str, turn: int) -> None:
    corners = SHAPES[name][::turn]
    world = World(WALLS, [Box((50, 50, 0), (51, 51, 1)), Prism(STAR, (20, 30)), Prism(corners, (-1, 2))])
    rng = np.random.default_rng(1)
    points = rng.uniform(-5, 7, (4000, 3))
    points[:1000] = np.round(points[:1000])  # on corners, edges and their lines
    expected = prism_distance(corners, (-1, 2), points)
    sure = np.abs(outline_distance(corners, points[:, :2])) > 1e-9  # on the outline the angles seen are no oracle
    np.testing.assert_allclose(world.distance(points)[sure], expected[sure], atol=1e-12)
    np.testing.assert_allclose(np.abs(world.distance(points)), np.abs(expected), atol=1e-12)


@pytest.mark.parametrize("name", SHAPES)
def test_the_gradient_is_the_central_difference_and_has_norm_one(name: str) -> None:
    world = World(WALLS, [Prism(SHAPES[name], (-1, 2))])
    points = np.random.default_rng(2).uniform(-5, 7, (500, 3))
    _, gradient = world.distance_gradient(points)
    h = 1e-6
    numeric = np.stack([(world.distance(points + h * e) - world.distance(points - h * e)) / (2 * h) for e in np.eye(3)])
    np.testing.assert_allclose(np.linalg.norm(gradient, axis=1), 1.0, atol=1e-12)
    assert (np.abs(gradient - numeric.T).max(axis=1) < 1e-5).mean() > 0.99


@pytest.mark.parametrize("name", sorted(CONVEX))
def test_every_gradient_of_a_convex_prism_supports_the_distance_everywhere(name: str) -> None:
    world = World(WALLS, [Prism(SHAPES[name], (-1, 2))])
    rng = np.random.default_rng(3)
    x, y = rng.uniform(-5, 5, (2, 3000, 3))
    x[:500, :2] = np.round(x[:500, :2])
    d, g = world.distance_gradient(x)
    assert (world.distance(y) >= d + np.einsum("ij,ij->i", g, y - x) - 1e-12).all()


@pytest.mark.parametrize("name", SHAPES)
def test_only_what_is_convex_is_taken_for_it(name: str) -> None:
    kind = World(WALLS, [Prism(SHAPES[name], (0, 1))]).scene.solids[0, 0]
    assert kind == (PRISM if name in CONVEX else NOTCHED)


@pytest.mark.parametrize(
    ("corners", "message"),
    [
        ([(0, 0), (1, 0)], "expected 3 to 1000, found 2"),
        ([(0, 0), (1, 0), (0, math.nan)], "prism corner 2: expected two finite numbers"),
        ([(0, 0), (1, 0), (1, 0), (0, 1)], r"prism corners 1 and 2: expected different points"),
        ([(0, 0), (1, 0), (0, 1), (0, 0)], r"prism corners 3 and 0: expected different points"),
        ([(0, 0), (1, 1), (2, 2)], "touches or crosses"),
        ([(0, 0), (2, 2), (2, 0), (0, 2)], r"corner 0 to 1 touches or crosses corner 2 to 3"),
        ([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)], r"corner 0 to 1 touches or crosses corner 2 to 3"),  # a pinch
        ([(0, 0), (4, 0), (2, 0), (2, 2)], r"corner 0 to 1 touches or crosses corner 1 to 2"),  # folds back
        ([(0, 0), (2, 0), (3, 3), (4, 0)], r"corner 0 to 1 touches or crosses corner 3 to 0"),
        ([(0, 0), (4, 0), (4, 4), (0, 4), (0, 0.0), (2, 2)], "touches or crosses"),
    ],
)
def test_an_outline_that_is_no_simple_polygon_is_refused_with_the_corners_at_fault(
    corners: list[tuple[float, float]], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        Prism(corners, (0, 1))


def test_a_prism_without_height_is_refused() -> None:
    with pytest.raises(ValueError, match="prism z: expected low < high"):
        Prism(STAR, (1, 1))


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("seed", range(3))
def test_no_curve_is_proved_for_more_than_its_samples_keep(name: str, seed: int) -> None:
    prism = Prism(SHAPES[name], (-1, 2))
    world, rng = World(WALLS, [prism]), np.random.default_rng(seed)
    clear = 0
    for _ in range(15):
        middle = rng.uniform((-5, -5, -2), (6, 6, 3))
        points, knots = middle + rng.uniform(-1.5, 1.5, (9, 3)), clamped_knots(9)
        samples = evaluate(points, knots, np.linspace(0, 1, 8000))
        truth = prism_distance(SHAPES[name], prism.z, samples).min()
        proof = certify(points, knots, world, min(max(0.9 * truth, 0.0), 1.0))
        assert proof.obstacle_distance <= truth + 1e-9
        assert truth < 0.02 or (proof.certified and proof.obstacle_distance >= truth - 5e-3)
        clear += truth > 0.1
    assert clear


def test_every_cell_of_the_grid_lists_the_prisms_that_reach_it() -> None:
    world = World(((-6, -6, -3), (8, 8, 5)), [Prism(COMB, (-1, 2)), Prism(TRIANGLE, (3, 4))])
    grid = build_grid(world, 0.4)
    points = np.random.default_rng(4).uniform((-6, -6, -3), (8, 8, 5), (3000, 3))
    cells = np.clip(((points - grid.origin) * grid.per_metre).astype(int), 0, grid.shape - 1)
    for prism, corners in ((0, COMB), (1, TRIANGLE)):
        near = prism_distance(corners, world.obstacles[prism].z, points) < 0.4  # type: ignore[union-attr]
        assert near.any()
        for ix, iy, iz in cells[near]:
            cell = (ix * grid.shape[1] + iy) * grid.shape[2] + iz
            assert prism in grid.items[grid.starts[cell] : grid.starts[cell + 1]]


def test_the_cost_near_prisms_has_the_gradient_that_it_says() -> None:
    world = World(WALLS, [Prism(STAR, (-2, 2)), Prism(L_SHAPE, (-5, -1))])
    cost = SplineCost(world, np.array([-4.0, -4, -4]), np.array([4.0, 4, 4]), 16, LIMITS, 0.6)
    line = np.linspace(-3, 3, 10)[:, None] * np.ones(3)
    x = (line + np.random.default_rng(5).normal(0, 0.5, (10, 3))).ravel()
    _, gradient = cost(x)
    assert cost.terms(x).obstacle > 0
    numeric = np.array([(cost(x + 1e-6 * e)[0] - cost(x - 1e-6 * e)[0]) / 2e-6 for e in np.eye(x.size)])
    np.testing.assert_allclose(gradient, numeric, rtol=1e-4, atol=1e-3)


def test_a_plan_round_a_star_keeps_its_radius_and_into_its_notch_too() -> None:
    star = [(10 + x, 10 + y) for x, y in STAR]
    world = World(((0, 0, 0), (20, 20, 4)), [Prism(star, (0, 4))])
    goals = ((19.0, 10.0, 1.5), (10 + 2.2 * math.cos(0.1 + math.pi / 5), 10 + 2.2 * math.sin(0.1 + math.pi / 5), 1.5))
    for goal in goals:
        p = plan(world, (1, 10, 1.5), goal, LIMITS, 0.3)
        assert p.certified
        samples = p.trajectory.position(np.linspace(0, p.trajectory.duration, 3000))
        truth = prism_distance(star, (0, 4), samples).min()
        assert 0.3 + p.clearance <= truth + 1e-9


def test_a_start_in_a_prism_is_refused_by_name_and_the_world_survives_pickling() -> None:
    world = World(((-9, -9, -9), (9, 9, 9)), [Box((5, 5, 5), (6, 6, 6)), Prism(L_SHAPE, (-1, 2))])
    assert pickle.loads(pickle.dumps(world)) == world
    with pytest.raises(StartInCollision, match=r"0\.200 m inside obstacle 1 \(prism\)"):
        plan(world, (0.2, 2, 0), (-4, 0, 0), LIMITS, 0.3)
