"""Whole plans: judged by dense sampling, scipy and arithmetic of this file, not by the planner's own proofs."""

import math
import pickle
import subprocess
import sys

import numpy as np
import pytest
from scipy.interpolate import BSpline

import planner
from planner import Box, Cylinder, Limits, Plan, Sphere, World, plan
from planner.certificate import Certificate
from planner.jit import _STAMP

LIMITS = Limits(speed=3.0, acceleration=6.0, jerk=60.0)
BOUNDS = ((0, 0, 0), (20, 20, 4))
START, GOAL, RADIUS = (1.0, 10.0, 1.5), (19.0, 10.0, 1.5), 0.3

WORLDS = {
    "empty": [],
    "wall": [Box((9, 6, 0), (10, 15, 4)), Cylinder(centre=(5, 5), radius=0.4, z=(0, 4))],
    "gap": [Box((9.75, 0, 0), (10.25, 12.3, 4)), Box((9.75, 13.7, 0), (10.25, 20, 4))],
    "over": [Box((9, 0, 0), (10, 20, 2.5))],
    "L": [Box((9.5, 6, 0), (10.5, 14, 4)), Box((5, 13, 0), (9.5, 14, 4))],
    "U": [Box((6, 6, 0), (12, 7, 4)), Box((6, 13, 0), (12, 14, 4)), Box((11, 7, 0), (12, 13, 4))],
    "balls": [Sphere((5, 10, 1.5), 1.2), Sphere((10, 9, 1.5), 1.5), Sphere((14.5, 11, 2), 1.4)],
    "baffles": [Box((5, 0, 0), (5.5, 17, 4)), Box((10, 3, 0), (10.5, 20, 4)), Box((15, 0, 0), (15.5, 17, 4))],
}


def box_distance(p: np.ndarray, box: Box) -> np.ndarray:
    q = np.maximum(np.array(box.lower) - p, p - np.array(box.upper))
    return np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0)


def cylinder_distance(p: np.ndarray, c: Cylinder) -> np.ndarray:
    radial = np.hypot(p[:, 0] - c.centre[0], p[:, 1] - c.centre[1]) - c.radius
    axial = np.maximum(c.z[0] - p[:, 2], p[:, 2] - c.z[1])
    outside = np.hypot(np.maximum(radial, 0), np.maximum(axial, 0))
    return outside + np.minimum(np.maximum(radial, axial), 0)


def sampled_clearance(p: Plan, obstacles: list) -> float:
    spline = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)
    points = spline(np.linspace(0, p.trajectory.duration, 20001)[:-1])
    assert (points > np.array(BOUNDS[0]) + RADIUS).all()
    assert (points < np.array(BOUNDS[1]) - RADIUS).all()
    least = math.inf
    for o in obstacles:
        if isinstance(o, Box):
            d = box_distance(points, o)
        elif isinstance(o, Cylinder):
            d = cylinder_distance(points, o)
        else:
            d = np.linalg.norm(points - o.centre, axis=1) - o.radius
        least = min(least, float(d.min()))
    return least - RADIUS


@pytest.mark.parametrize("name", WORLDS)
def test_a_plan_is_clear_within_limits_and_at_rest_at_its_ends(name: str) -> None:
    p = plan(World(BOUNDS, WORLDS[name]), START, GOAL, LIMITS, RADIUS)
    assert p.certified
    clearance = sampled_clearance(p, WORLDS[name])
    assert 0 <= p.clearance <= clearance
    assert name == "empty" or p.clearance >= clearance - 2e-3
    spline = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)
    t = np.linspace(0, p.trajectory.duration, 5001)[:-1]
    for k, limit in ((1, LIMITS.speed), (2, LIMITS.acceleration), (3, LIMITS.jerk)):
        assert np.linalg.norm(spline.derivative(k)(t), axis=1).max() <= limit
    for time, place in ((0.0, START), (p.trajectory.duration, GOAL)):
        state = p.trajectory.state(time)
        np.testing.assert_allclose(state.position, place, atol=1e-12)
        np.testing.assert_allclose([state.velocity, state.acceleration], 0.0, atol=1e-9)
    steps = np.diff(spline(np.linspace(0, p.trajectory.duration, 20001)[:-1]), axis=0)
    assert p.length == pytest.approx(np.linalg.norm(steps, axis=1).sum(), rel=1e-4)


def test_with_nothing_in_the_way_the_path_is_straight_and_the_clearance_infinite() -> None:
    p = plan(World(BOUNDS), START, GOAL, LIMITS, RADIUS)
    assert p.length == pytest.approx(18.0, abs=1e-3)
    assert p.clearance == math.inf
    assert p.report.curvature_max < 1e-3


def test_the_way_round_a_wall_is_hardly_longer_than_a_string_pulled_around_it() -> None:
    p = plan(World(BOUNDS, [Box((9, 6, 0), (10, 16, 4))]), START, GOAL, LIMITS, RADIUS)
    aside = (
        4 + RADIUS
    )  # the wall's near end is 4 m off the line; rounding its corners makes the string a little shorter
    assert p.length <= 1.01 * (math.hypot(8, aside) + 1 + math.hypot(9, aside))


def test_a_maze_that_no_bow_passes_is_solved_with_the_search_graphs_help() -> None:
    p = plan(World(BOUNDS, WORLDS["baffles"]), START, GOAL, LIMITS, RADIUS)
    assert p.certified
    assert p.length > 30


def thin_baffles(radius: float, seed: int) -> list[Box]:
    """Sheets a fraction of a millimetre to a centimetre thick across the way, each with an opening; so there is one."""
    rng = np.random.default_rng(seed)
    room = 2 * (radius + 0.2)
    sheets: list[Box] = []
    for x in np.arange(3.0, 17.0, rng.uniform(2.0, 5.0) + room):
        low, thickness = rng.uniform(0, 20 - room), rng.choice([5e-4, 5e-3, 1e-2])
        if rng.random() < 0.3:  # open below or above
            under = rng.random() < 0.5
            sheets.append(Box((x, 0, room if under else 0), (x + thickness, 20, 4 if under else 4 - room)))
        else:
            sheets += [Box((x, -1, -1), (x + thickness, low, 5)), Box((x, low + room, -1), (x + thickness, 21, 5))]
    return sheets


@pytest.mark.parametrize("radius", [0.0, 0.05, 0.3, 0.6])
@pytest.mark.parametrize("seed", range(5))
def test_a_way_between_sheets_of_paper_is_found_and_kept(radius: float, seed: int) -> None:
    sheets = thin_baffles(radius, seed)
    p = plan(World(BOUNDS, sheets), START, GOAL, LIMITS, radius, seed=seed)
    assert p.certified
    spline = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)
    points = spline(np.linspace(0, p.trajectory.duration, 40001)[:-1])
    assert min(box_distance(points, sheet).min() for sheet in sheets) >= radius


def test_a_kilometre_of_gates_is_planned_through() -> None:
    gates = [Box((100 * k, -20 if k % 2 else -5, 0), (100 * k + 1, 5 if k % 2 else 20, 10)) for k in range(1, 10)]
    p = plan(World(((-10, -20, 0), (1100, 20, 10)), gates), (0, 0, 5), (1000, 0, 5), LIMITS, RADIUS)
    assert p.certified
    spline = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)
    points = spline(np.linspace(0, p.trajectory.duration, 100_001)[:-1])
    assert min(box_distance(points, gate).min() for gate in gates) >= RADIUS
    assert 1000 < p.length < 1100


def test_a_fast_and_weak_vehicle_gets_round_the_same_corners_more_slowly() -> None:
    world = World(BOUNDS, WORLDS["baffles"])
    nimble = plan(world, START, GOAL, Limits(8.0, 8.0, 80.0), RADIUS)
    weak = plan(world, START, GOAL, Limits(8.0, 2.0, 8.0), RADIUS)
    assert weak.certified
    assert sampled_clearance(weak, WORLDS["baffles"]) >= 0
    assert weak.trajectory.duration > nimble.trajectory.duration


def test_the_frame_may_have_z_pointing_down() -> None:
    flip = World(((0, 0, -4), (20, 20, 0)), [Box((9, 0, -2.5), (10, 20, 0)), Cylinder((5, 10), 0.5, (-4, 0))])
    p = plan(flip, (1, 10, -1.5), (19, 10, -1.5), LIMITS, RADIUS)
    assert p.certified
    assert p.trajectory.position(np.linspace(0, p.trajectory.duration, 99))[:, 2].min() < -2.5


def test_the_same_seed_gives_the_same_plan_to_the_last_bit() -> None:
    world = World(BOUNDS, WORLDS["U"])
    a, b = (plan(world, START, GOAL, LIMITS, RADIUS, seed=5) for _ in range(2))
    assert a.trajectory == b.trajectory
    assert (a.length, a.clearance, a.report) == (b.length, b.clearance, b.report)


def test_a_plan_survives_pickling() -> None:
    p = plan(World(BOUNDS, WORLDS["wall"]), START, GOAL, LIMITS, RADIUS)
    assert pickle.loads(pickle.dumps(p)) == p


def test_the_report_counts_the_work_and_describes_the_shape() -> None:
    p = plan(World(BOUNDS, WORLDS["wall"]), START, GOAL, LIMITS, RADIUS)
    t = (np.arange(100000) + 0.5) / 100000 * p.trajectory.duration
    squares = (p.trajectory.jerk(t) ** 2).sum(axis=1)
    assert p.report.jerk_integral == pytest.approx(squares.mean() * p.trajectory.duration, rel=1e-3)
    assert p.report.evaluations >= 20 * p.report.iterations > 0
    assert 1 <= p.report.seeds_certified <= p.report.seeds_tried
    assert p.method == "haoaroa"
    assert p.cpu_ms > 0


@pytest.mark.parametrize("distance", [0.0, 1e-9, 0.01, 1.0])
def test_a_short_hop_or_none_is_planned_too(distance: float) -> None:
    p = plan(World(BOUNDS), START, (1.0 + distance, 10.0, 1.5), LIMITS, RADIUS)
    assert p.certified
    assert p.length == pytest.approx(distance, abs=1e-6)
    assert p.trajectory.duration < 2.0


def test_straight_up_is_a_direction_like_any_other() -> None:
    p = plan(World(((0, 0, 0), (5, 5, 30)), [Sphere((2.5, 2.5, 12), 1)]), (2.5, 2.5, 1), (2.5, 2.5, 25), LIMITS, RADIUS)
    assert p.certified
    assert 24.0 < p.length < 24.5


@pytest.mark.parametrize(
    ("start", "goal", "error", "numbers", "words"),
    [
        ((9.8, 10, 1.5), GOAL, planner.StartInCollision, (1, "box", -0.2), "start .* 0.200 m inside obstacle 1 .box"),
        (START, (5, 5.5, 1.5), planner.GoalInCollision, (0, "cylinder", 0.1), "goal .* 0.100 m from obstacle 0"),
    ],
)
def test_an_end_in_an_obstacle_says_which_and_by_how_much(start, goal, error, numbers, words) -> None:
    world = World(BOUNDS, [Cylinder((5, 5), 0.4, (0, 4)), Box((9, 6, 0), (10, 15, 4))])
    with pytest.raises(error, match=words) as caught:
        plan(world, start, goal, LIMITS, RADIUS)
    e = pickle.loads(pickle.dumps(caught.value))
    assert (e.obstacle, e.kind) == numbers[:2]
    assert e.distance == pytest.approx(numbers[2])
    assert e.shortfall == pytest.approx(RADIUS - numbers[2])
    assert str(e) == str(caught.value)


@pytest.mark.parametrize(
    ("start", "goal", "error", "axis", "side", "distance"),
    [
        (START, (19, 10, 4.5), planner.GoalOutOfBounds, 2, "upper", -0.5),
        ((-1, 10, 1.5), GOAL, planner.StartOutOfBounds, 0, "lower", -1.0),
        ((1, 10, 0.1), GOAL, planner.StartOutOfBounds, 2, "lower", 0.1),
    ],
)
def test_an_end_outside_says_beyond_which_bound_and_by_how_much(start, goal, error, axis, side, distance) -> None:
    with pytest.raises(error) as caught:
        plan(World(BOUNDS), start, goal, LIMITS, RADIUS)
    e = pickle.loads(pickle.dumps(caught.value))
    assert (e.axis, e.side) == (axis, side)
    assert e.distance == pytest.approx(distance)
    assert f"{side} {'xyz'[axis]} bound" in str(e)


@pytest.mark.parametrize(
    ("world", "start", "radius", "error"),
    [
        (World(BOUNDS), (0.25, 10, 2), 0.25, planner.StartOutOfBounds),
        (World(BOUNDS), (0, 10, 2), 0.0, planner.StartOutOfBounds),
        (World(((0, 0, 0), (20, 20, 0.5))), (1, 10, 0.25), 0.25, planner.StartOutOfBounds),
        (World(BOUNDS, [Box((9, 0, 0), (10, 15, 4))]), (8.75, 10, 2), 0.25, planner.StartInCollision),
        (World(BOUNDS, [Sphere((5, 5, 2), 1)]), (6, 5, 2), 0.0, planner.StartInCollision),
    ],
)
def test_an_end_at_the_radius_exactly_is_told_what_a_proof_lacks(world, start, radius, error) -> None:
    with pytest.raises(error, match=r"is kept, but proving so takes \d\.\de-\d+ m more") as caught:
        plan(world, start, (start[0], 18.0, start[2]), LIMITS, radius)
    e = pickle.loads(pickle.dumps(caught.value))
    assert e.distance == e.radius == radius
    assert 0.0 < e.shortfall < 1e-6
    assert str(e) == str(caught.value)


@pytest.mark.parametrize("spare", [1e-9, 1e-6, 1e-3])
def test_an_end_with_any_more_than_that_is_a_place_to_start_from(spare: float) -> None:
    obstacles = [Box((9, 0, 0), (10, 15, 4))]
    p = plan(World(BOUNDS, obstacles), (8.75 - spare, 10, 2), GOAL, LIMITS, 0.25)
    assert p.certified
    spline = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)
    points = spline(np.linspace(0, p.trajectory.duration, 20001)[:-1])
    assert box_distance(points, obstacles[0]).min() >= 0.25
    assert 0.0 <= p.clearance <= spare


@pytest.mark.parametrize("spare", [1e-8, 1e-5, 2e-3])
def test_a_map_hardly_higher_than_the_vehicle_is_flown_through_the_middle(spare: float) -> None:
    height = 2 * RADIUS + spare
    wall = Box((9, 6, 0), (10, 15, height))
    p = plan(World(((0, 0, 0), (20, 20, height)), [wall]), (1, 10, height / 2), (19, 10, height / 2), LIMITS, RADIUS)
    z = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)(np.linspace(0, p.trajectory.duration, 9999)[:-1])
    assert p.certified
    assert RADIUS <= z[:, 2].min() <= z[:, 2].max() <= height - RADIUS


@pytest.mark.parametrize("offset", [1e3, 5e5, 5e6, -1e7])
def test_a_map_far_from_its_origin_is_planned_as_the_same_map_near_it(offset: float) -> None:
    here = [Box((9, 6, 0), (10, 15, 4)), Box((5, 14, 0), (9, 15, 4))]
    near = plan(World(BOUNDS, here), START, GOAL, LIMITS, RADIUS)
    shift = np.array([offset, offset, 0.0])
    there = [Box(tuple(shift + o.lower), tuple(shift + o.upper)) for o in here]
    world = World((tuple(shift + BOUNDS[0]), tuple(shift + BOUNDS[1])), there)
    p = plan(world, START + shift, GOAL + shift, LIMITS, RADIUS)
    assert p.certified
    assert p.length == pytest.approx(near.length, rel=1e-4)
    assert p.clearance == pytest.approx(near.clearance, abs=2e-3)
    points = BSpline(p.trajectory.knots, p.trajectory.control_points, 3)(
        np.linspace(0, p.trajectory.duration, 9999)[:-1]
    )
    assert min(box_distance(points, o).min() for o in there) >= RADIUS


def test_a_clearance_that_takes_too_many_pieces_leaves_the_proof_of_the_radius(monkeypatch) -> None:
    module = sys.modules["planner.plan"]  # the name in the package is the function's
    real = module.certify

    def spent(points, knots, world, radius, full=True):
        return Certificate(False, -math.inf, -math.inf, 20_000) if full else real(points, knots, world, radius, full)

    monkeypatch.setattr(module, "certify", spent)
    p = plan(World(BOUNDS, WORLDS["wall"]), START, GOAL, LIMITS, RADIUS)
    assert p.certified
    assert 0.0 <= p.clearance <= sampled_clearance(p, WORLDS["wall"])


def test_a_closed_room_is_proved_closed() -> None:
    walls = [Box((9, 0, 0), (10, 20, 4))]
    with pytest.raises(planner.NoPathFound, match="proved unreachable on the grid") as caught:
        plan(World(BOUNDS, walls), START, GOAL, LIMITS, RADIUS)
    e = pickle.loads(pickle.dumps(caught.value))
    assert e.proved
    assert e.tried > 0
    assert e.shortfall >= RADIUS
    assert e.way == math.inf
    assert str(e) == str(caught.value)


def test_a_room_whose_door_is_narrower_than_the_search_graphs_cells_is_given_up_not_called_closed() -> None:
    low, high = 10.0 - RADIUS - 0.0005, 10.0 + RADIUS + 0.0005
    door = [Box((9, 0, 0), (10, low, 4)), Box((9, high, 0), (10, 20, 4))]
    with pytest.raises(planner.NoPathFound, match=r"gave up after \d+ curves") as caught:
        plan(World(BOUNDS, door), (1.0, 5.0, 1.5), (19.0, 15.0, 1.5), LIMITS, RADIUS)
    e = pickle.loads(pickle.dumps(caught.value))
    assert not e.proved
    assert (e.way, e.cell) == (math.inf, 0.125)
    assert "the search graph shows no way through its cells of 0.125 m" in str(e)


def test_a_way_that_cannot_be_followed_is_told_with_its_length(monkeypatch) -> None:
    module = sys.modules["planner.plan"]
    monkeypatch.setattr(module, "certify", lambda *_, **__: Certificate(False, -math.inf, -math.inf, 1))
    with pytest.raises(
        planner.NoPathFound, match=r"the search graph's way of 18\.0 m .* could not be followed"
    ) as caught:
        plan(World(BOUNDS), START, GOAL, LIMITS, RADIUS)
    assert caught.value.way == pytest.approx(18.0)


def test_a_gap_narrower_than_the_vehicle_is_not_passed() -> None:
    tight = [Box((9.75, 0, 0), (10.25, 9.71, 4)), Box((9.75, 10.29, 0), (10.25, 20, 4))]
    with pytest.raises(planner.NoPathFound) as caught:
        plan(World(BOUNDS, tight), START, GOAL, LIMITS, RADIUS)
    assert caught.value.shortfall >= 0.01 - 1e-9
    assert caught.value.proved


def test_misuse_is_a_value_error_that_names_what_exists() -> None:
    with pytest.raises(ValueError, match=r"expected one of haoaroa, astar, .*, roa, found 'dijkstra'"):
        plan(World(BOUNDS), START, GOAL, LIMITS, RADIUS, method="dijkstra")
    with pytest.raises(ValueError, match="radius"):
        plan(World(BOUNDS), START, GOAL, LIMITS, -0.1)
    with pytest.raises(ValueError, match="goal: expected three finite numbers"):
        plan(World(BOUNDS), START, (1, 2, math.nan), LIMITS, RADIUS)


def test_importing_the_planner_brings_no_mavlink_and_no_plotting() -> None:
    code = "import sys, planner; print([m for m in sys.modules if m.startswith(('pymavlink', 'matplotlib', 'mcap'))])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_kernels_are_stamped_with_the_whole_package() -> None:
    from planner.cost import cost_gradient

    assert cost_gradient._cache._cache_file._source_stamp == _STAMP


@pytest.mark.parametrize(
    ("wrong", "kind", "message"),
    [
        ({"world": "forest"}, TypeError, r"world: expected a World, found 'forest'"),
        ({"limits": (3, 6, 60)}, TypeError, r"limits: expected a Limits, found \(3, 6, 60\)"),
        ({"radius": "0.3"}, TypeError, r"radius: expected a finite number of at least 0 m, found '0.3'"),
        ({"radius": np.array([0.3])}, TypeError, r"radius: expected a finite number of at least 0 m, found array"),
        ({"radius": None}, TypeError, r"radius: expected .*, found None"),
        ({"radius": -0.1}, ValueError, r"radius: expected a finite number of at least 0 m, found -0.1"),
        ({"radius": math.nan}, ValueError, r"radius: expected a finite number of at least 0 m, found nan"),
        ({"seed": -1}, ValueError, r"seed: expected a whole number of at least 0, found -1"),
        ({"seed": 1.5}, TypeError, r"seed: expected a whole number of at least 0, found 1.5"),
        ({"seed": None}, TypeError, r"seed: expected a whole number of at least 0, found None"),
        ({"start": None}, ValueError, r"start: expected three finite numbers, found None"),
        ({"start": "123"}, ValueError, r"start: expected three finite numbers, found '123'"),
        ({"goal": (1, "x", 2)}, ValueError, r"goal: expected three finite numbers, found \(1, 'x', 2\)"),
        ({"goal": (1, math.nan, 2)}, ValueError, r"goal: expected three finite numbers, found \(1.0, nan, 2.0\)"),
        ({"start_velocity": 1.0}, ValueError, r"start_velocity: expected three finite numbers, found 1.0"),
        ({"via": (1, 2, 3)}, ValueError, r"via point 0: expected three finite numbers, found 1"),
        ({"via": 7}, TypeError, r"via: expected a sequence of points, found 7"),
        ({"via": "abc"}, TypeError, r"via: expected a sequence of points, found 'abc'"),
        ({"via": [(5, 5, 1)] * 26}, ValueError, r"via: expected at most 25 points, found 26"),
        ({"movers": 3}, TypeError, r"movers: expected a sequence of MovingSphere and MovingBox, found 3"),
        ({"movers": "ab"}, ValueError, r"mover 0: expected a MovingSphere or a MovingBox, found 'a'"),
    ],
    ids=lambda value: str(value)[:30] if isinstance(value, dict) else "",
)
def test_an_argument_that_cannot_be_is_refused_by_its_name_with_what_was_found_and_expected(
    wrong, kind, message
) -> None:
    given = {"world": World(BOUNDS), "start": START, "goal": GOAL, "limits": LIMITS, "radius": RADIUS}
    with pytest.raises(kind, match=message):
        plan(**{**given, **wrong})


def test_numbers_of_numpy_and_none_for_nothing_are_taken() -> None:
    plain = plan(World(BOUNDS), START, GOAL, LIMITS, 0.5, 3)
    other = plan(
        World(BOUNDS), np.array(START), list(GOAL), LIMITS, np.float32(0.5), np.int64(3), via=None, movers=None
    )
    assert other.trajectory == plain.trajectory
    assert plan(World(BOUNDS), (2, 10, 2), (18, 10, 2), LIMITS, 1).certified
