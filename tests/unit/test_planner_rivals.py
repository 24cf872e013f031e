"""HAOAROA's rivals by the same call: what they say of their plans is judged by dense sampling and by arithmetic."""

import itertools
import math

import numpy as np
import pytest
from scipy.interpolate import BSpline, CubicSpline

from planner import METHODS, Box, Cylinder, Limits, MovingSphere, NoPathFound, World, plan
from planner.baselines import astar
from planner.baselines.bezier import halved, through
from planner.baselines.lbsgf import inverse_laplacian
from planner.baselines.legs import turns_on_spot
from planner.baselines.parents import costs_of
from planner.baselines.polyline import phases, run, stopping
from planner.baselines.route import route
from planner.bspline import clamped_knots
from planner.families import make
from planner.query import Query
from planner.shape import Effort, Search

LIMITS = Limits(3.0, 6.0, 60.0)
RADIUS = 0.3
RIVALS = tuple(method for method in METHODS if method != "haoaroa")
ON_GRID = ("astar", "jps", "bezier")
WALL = World(((0, 0, 0), (20, 20, 4)), [Box((9, 6, 0), (10, 15, 4)), Cylinder((5, 5), 0.4, (0, 4))])
START, GOAL = (1.0, 10.0, 1.5), (19.0, 10.0, 1.5)


def test_every_method_of_the_comparison_is_there() -> None:
    assert set(METHODS) == {"haoaroa", "astar", "jps", "bezier", "lbsgf", "aoa", "roa"}


@pytest.mark.parametrize("family", ["gap", "U", "forest"])
@pytest.mark.parametrize("method", RIVALS)
def test_what_is_called_certified_is_clear_and_within_limits_on_samples(method: str, family: str) -> None:
    scenario = make(family, 3)
    p = plan(scenario.world, scenario.start, scenario.goal, LIMITS, RADIUS, method=method)
    assert p.method == method
    spline = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)
    t = np.linspace(0.0, p.trajectory.duration, 20001)[:-1]
    points = spline(t)
    for k, limit in ((1, LIMITS.speed), (2, LIMITS.acceleration), (3, LIMITS.jerk)):
        assert np.linalg.norm(spline.derivative(k)(t), axis=1).max() <= limit
    np.testing.assert_allclose(points[0], scenario.start, atol=1e-12)
    np.testing.assert_allclose(spline(p.trajectory.duration), scenario.goal, atol=1e-12)
    clearance = scenario.world.distance(points).min() - RADIUS
    if p.certified:
        assert 0.0 <= p.clearance <= clearance
        assert scenario.world.wall_distance(points).min() >= RADIUS
    else:
        assert p.clearance < 0.0 or clearance < 0.0
    assert p.certified or method not in ON_GRID


@pytest.mark.parametrize("method", RIVALS)
def test_the_same_question_has_the_same_answer(method: str) -> None:
    first, second = (plan(WALL, START, GOAL, LIMITS, RADIUS, seed=4, method=method) for _ in range(2))
    assert first.trajectory == second.trajectory


@pytest.mark.parametrize("method", RIVALS)
def test_a_hop_to_where_one_stands_is_standing_still(method: str) -> None:
    p = plan(WALL, START, START, LIMITS, RADIUS, method=method)
    assert p.certified
    assert p.length == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("method", RIVALS)
@pytest.mark.parametrize("goal", [(1.0, 10.0, 1.51), (1.3, 10.2, 1.5), (1.0, 10.0, 3.4)])
def test_a_short_free_way_is_flown_straight_or_nearly(method: str, goal: tuple[float, float, float]) -> None:
    p = plan(WALL, START, goal, LIMITS, RADIUS, method=method)
    straight = math.dist(START, goal)
    assert p.certified
    assert straight - 1e-9 <= p.length <= 1.3 * straight


@pytest.mark.parametrize("method", ON_GRID)
def test_no_way_is_told_as_an_error_that_says_whether_it_is_proved(method: str) -> None:
    closed = World(WALL.bounds, [Box((9, 0, 0), (10, 20, 4))])
    with pytest.raises(NoPathFound) as caught:
        plan(closed, START, GOAL, LIMITS, RADIUS, method=method)
    assert caught.value.proved


def test_a_gap_too_narrow_for_wide_cells_is_found_by_narrower_ones() -> None:
    tight = World(WALL.bounds, [Box((9.75, 0, 0), (10.25, 9.66, 4)), Box((9.75, 10.34, 0), (10.25, 20, 4))])
    p = plan(tight, START, GOAL, LIMITS, RADIUS, method="jps")
    assert p.certified
    assert p.length < 18.5


@pytest.mark.parametrize("method", ON_GRID)
@pytest.mark.parametrize("name", ["start_velocity", "start_acceleration", "goal_velocity"])
def test_a_method_that_needs_rest_refuses_a_moving_end_by_name(method: str, name: str) -> None:
    with pytest.raises(ValueError, match=f"{name}: expected rest for method {method}"):
        plan(WALL, START, GOAL, LIMITS, RADIUS, method=method, **{name: (0.5, 0.0, 0.0)})


@pytest.mark.parametrize("method", RIVALS)
def test_via_points_are_passed_exactly_and_in_order(method: str) -> None:
    via = ((6.0, 8.0, 1.5), (8.0, 17.0, 2.0))
    p = plan(WALL, START, GOAL, LIMITS, RADIUS, method=method, via=via)
    t = np.linspace(0.0, p.trajectory.duration, 200_001)
    points = p.trajectory.position(t)
    at = [int(np.argmin(np.linalg.norm(points - v, axis=1))) for v in via]
    assert at == sorted(at)
    for i, v in zip(at, via, strict=True):
        assert np.linalg.norm(points[i] - v) < 1e-4  # the samples' own distance
    assert p.certified or method not in ON_GRID
    if method in ON_GRID:
        assert math.isinf(p.report.curvature_max)  # it stops there and turns


def test_a_search_on_the_cost_starts_from_any_velocity() -> None:
    p = plan(World(WALL.bounds), START, GOAL, LIMITS, RADIUS, method="lbsgf", start_velocity=(1.0, 0.5, 0.0))
    assert p.certified
    np.testing.assert_allclose(p.trajectory.state(0.0).velocity, (1.0, 0.5, 0.0), atol=1e-9)


def test_a_rival_misses_movers_too() -> None:
    mover = MovingSphere((10.0, 3.0, 1.5), (0.0, 0.5, 0.0), 0.4)
    p = plan(World(WALL.bounds), START, GOAL, LIMITS, RADIUS, method="astar", movers=[mover])
    t = np.linspace(0.0, p.trajectory.duration, 5001)
    centres = np.array(mover.centre) + t[:, None] * np.array(mover.velocity)
    assert p.certified
    assert np.linalg.norm(p.trajectory.position(t) - centres, axis=1).min() >= RADIUS + mover.radius


def test_a_polyline_is_flown_exactly_with_a_stop_at_each_corner() -> None:
    corners = np.array([[0.0, 0, 0], [3, 0, 0], [3, 2, 1], [0.2, 2.5, 1]])
    points = stopping(corners, LIMITS)
    spline = BSpline(clamped_knots(len(points)), points, 3)
    u = np.linspace(0.0, 1.0, 40001)[:-1]
    way = spline(u)
    off = np.full(len(way), np.inf)
    for a, b in itertools.pairwise(corners):
        share = np.clip((way - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
        off = np.minimum(off, np.linalg.norm(way - a - share[:, None] * (b - a), axis=1))
    assert off.max() < 1e-12
    speed = np.linalg.norm(spline.derivative(1)(u), axis=1)
    for corner in corners[1:-1]:
        near = int(np.argmin(np.linalg.norm(way - corner, axis=1)))
        assert np.linalg.norm(way[near] - corner) < 1e-6
        assert speed[near] < 1e-2 * speed.max()
    assert turns_on_spot(points)
    assert not turns_on_spot(stopping(np.array([[0.0, 0, 0], [1, 0, 0], [3, 0, 0]]), LIMITS))


@pytest.mark.parametrize("length", [1e-3, 0.1, 0.9, 1.6, 3.0, 50.0])
@pytest.mark.parametrize("limits", [LIMITS, Limits(1.0, 6.0, 20.0), Limits(5.0, 1.0, 60.0), Limits(1e-6, 1e6, 1e-6)])
def test_a_leg_from_rest_to_rest_is_as_fast_as_the_limits_allow(length: float, limits: Limits) -> None:
    jerks, durations = phases(length, limits)
    s = v = a = 0.0
    fastest = strongest = 0.0
    for jerk, t in zip(jerks, durations, strict=True):
        s, v, a = s + v * t + a * t * t / 2 + jerk * t**3 / 6, v + a * t + jerk * t * t / 2, a + jerk * t
        fastest, strongest = max(fastest, v), max(strongest, abs(a))
    assert s == pytest.approx(length, rel=1e-9)
    assert abs(v) <= 1e-9 * limits.speed
    assert fastest <= limits.speed * (1 + 1e-9)
    assert strongest <= limits.acceleration * (1 + 1e-9)
    cruises = durations[3] > 0.0
    assert fastest == pytest.approx(limits.speed) if cruises else fastest <= limits.speed * (1 + 1e-9)
    if not cruises and durations[1] == 0.0:  # jerk alone decides: L = 2 j T_j^3
        assert length == pytest.approx(2.0 * limits.jerk * durations[0] ** 3)
    np.testing.assert_allclose(run(length, limits, np.array([0.0, 0.5, 1.0])), [0.0, 0.5, 1.0], atol=1e-9)


def test_a_polylines_duration_is_that_of_its_legs_flown_from_rest_to_rest() -> None:
    p = plan(World(WALL.bounds), START, (13.0, 10.0, 1.5), LIMITS, RADIUS, method="astar")
    least = phases(12.0, LIMITS)[1].sum()  # straight along the grid: one leg
    assert p.report.curvature_max < 1e-6
    assert least <= p.trajectory.duration <= 1.05 * least


def test_stops_at_corners_have_no_bounded_curvature() -> None:
    assert math.isinf(plan(WALL, START, GOAL, LIMITS, RADIUS, method="jps").report.curvature_max)


def test_the_bezier_curve_passes_its_corners_at_rest_at_its_ends_twice_differentiable() -> None:
    corners = np.array([[0.0, 0, 0], [4, 1, 0], [5, 4, 1], [9, 4, 1]])
    points = through(corners)
    spline = BSpline(clamped_knots(len(points)), points, 3)
    u = np.linspace(0.0, 1.0, 200_001)
    way = spline(np.minimum(u, 1.0 - 1e-15))
    for corner in corners:
        assert np.linalg.norm(way - corner, axis=1).min() < 1e-4
    for end in (0.0, 1.0 - 1e-12):
        assert np.linalg.norm(spline.derivative(1)(end)) < 1e-9
    second = spline.derivative(2)(u[:-1])
    assert np.linalg.norm(np.diff(second, axis=0), axis=1).max() < 1e-2 * np.linalg.norm(second, axis=1).max()


def test_the_bezier_curve_is_scipys_spline_through_the_same_places() -> None:
    """Between its first and its last cut it is the only such spline: scipy's, given its ends' slopes and their cuts."""
    corners = np.array([[0.0, 0, 0], [4.2, 0, 0], [4.2, 4.2, 0], [8.4, 4.2, 0]])  # legs of six units
    points = through(corners)
    spline = BSpline(clamped_knots(len(points), 18.0), points, 3)
    at = np.array([0.0, 1.0, 6.0, 12.0, 17.0, 18.0])
    other = CubicSpline(at, spline(at - [0, 0, 0, 0, 0, 1e-13]), bc_type="clamped")
    u = np.linspace(0.0, 18.0, 500)[:-1]
    np.testing.assert_allclose(spline(u), other(u), atol=1e-9)


def test_halving_adds_the_middle_of_every_leg() -> None:
    np.testing.assert_array_equal(halved(np.array([[0.0, 0, 0], [2, 0, 0]])), [[0, 0, 0], [1, 0, 0], [2, 0, 0]])


def test_the_inverse_laplacian_is_one() -> None:
    laplacian = 2 * np.eye(7) - np.eye(7, k=1) - np.eye(7, k=-1)
    np.testing.assert_allclose(inverse_laplacian(7) @ laplacian, np.eye(7), atol=1e-12)


def test_a_population_is_judged_by_the_planners_own_cost() -> None:
    query = Query(WALL, np.array(START), np.array(GOAL), LIMITS, RADIUS)
    work = Search(query, Effort())
    cost = work.first_cost()
    seeds = work.seeds(cost)
    costs = np.empty(len(seeds))
    costs_of(seeds.copy(), costs, cost.problem)
    np.testing.assert_array_equal(costs, [cost(x)[0] for x in seeds])


@pytest.mark.parametrize("method", ["aoa", "roa", "lbsgf"])
def test_the_searches_spend_what_haoaroa_is_given_in_the_paper(method: str) -> None:
    p = plan(WALL, START, GOAL, LIMITS, RADIUS, method=method)
    assert p.report.evaluations == 2000
    assert p.report.iterations == 100
    assert p.report.stretch > 0.0


def test_a_route_is_a_shortest_one_and_its_ends_are_exact() -> None:
    query = Query(World(WALL.bounds), np.array([1.03, 10.0, 1.5]), np.array([15.17, 3.31, 2.9]), LIMITS, RADIUS)
    corners = route(query, Effort(), astar.shortest)
    np.testing.assert_array_equal(corners[[0, -1]], [query.start, query.goal])
    dx, dy, dz = np.sort(np.abs(query.goal - query.start))
    free = math.sqrt(3) * dx + math.sqrt(2) * (dy - dx) + (dz - dy)
    length = np.linalg.norm(np.diff(corners, axis=0), axis=1).sum()
    assert length == pytest.approx(free, abs=0.35)  # the goal is at most half a cell's diagonal from its cell
