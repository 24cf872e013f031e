"""Planning in flight: exact switches, true claims, kept stops; held against sampled true positions."""

import numpy as np
import pytest
from scipy.interpolate import BSpline

from benchmarks.bench_replan import fly
from planner import METHODS, Cylinder, GoalInCollision, Limits, MovingSphere, Trajectory, World, plan
from planner.movers import UNTIL
from planner.replan import Decision, Flight, Kind, Replanner, Settings
from planner.warm import judge

LIMITS, RADIUS = Limits(3.0, 6.0, 60.0), 0.3
BOUNDS = ((0, 0, 0), (14, 10, 4))
WORLD = World(BOUNDS, [Cylinder((7.0, 3.0), 0.5, (0, 4))])


@pytest.fixture(scope="module")
def first() -> Trajectory:
    return plan(WORLD, (1, 5, 1.5), (13, 5, 1.5), LIMITS, RADIUS).trajectory


def ball(at_s: float, place: tuple[float, float, float], velocity: tuple[float, float, float]) -> MovingSphere:
    return MovingSphere(place, velocity, 0.4, growth=0.1, stamp=at_s)


def joint_gap(before: Flight, after: Flight) -> float:
    """Largest difference of position, velocity and acceleration where the one takes over from the other."""
    a = before.trajectory.state(after.start_s - before.start_s)
    b = after.trajectory.state(0.0)
    pairs = ((a.position, b.position), (a.velocity, b.velocity), (a.acceleration, b.acceleration))
    return max(float(np.abs(x - y).max()) for x, y in pairs)


def wall_gap(world: World, place: np.ndarray) -> float:
    """Least distance of points (m, 3) to the upright cylinders, which fill the map's height, and to the walls [m]."""
    low, high = np.array(world.bounds, dtype=float)
    gaps = [(place - low).min(), (high - place).min()]
    gaps += [(np.hypot(*(place[:, :2] - c.centre).T) - c.radius).min() for c in world.obstacles]
    return float(min(gaps))


def check_claims(
    world: World, decision: Decision, movers: list[MovingSphere], horizon: float, since: float | None = None
) -> None:
    """What is certified is so from `since` on: solids and limits all along, movers as far as they are predicted.

    By scipy's spline and differences of its samples, not by the planner's own distances and bounds. After its end the
    vehicle stands there.
    """
    trajectory, start = decision.flight.trajectory, decision.flight.start_s
    since = start if since is None else since
    spline, end = BSpline(trajectory.knots, trajectory.control_points, 3), float(trajectory.knots[-1])
    t = np.linspace(0.0, end, 4001)
    place, step = spline(t), t[1]
    assert wall_gap(world, spline(np.linspace(min(since - start, end), end, 4001))) >= RADIUS
    for k, limit in enumerate((LIMITS.speed, LIMITS.acceleration, LIMITS.jerk), 1):
        mean = np.diff(place, n=k, axis=0) / step**k  # of the derivative, over k steps: never above its maximum
        noise = 2.0**k * np.abs(place).max() * 4e-16 / step**k
        assert np.linalg.norm(mean, axis=1).max() <= limit * (1.0 + 1e-9) + noise
    clock = np.linspace(since, since + horizon, 2001)
    place = spline(np.clip(clock - start, 0.0, end))
    for m in movers:
        centre = np.array(m.centre) + (clock - m.stamp)[:, None] * np.array(m.velocity)
        gap = np.linalg.norm(place - centre, axis=1) - m.radius - m.growth * np.abs(clock - m.stamp)
        assert gap.min() >= RADIUS


def test_nothing_in_the_way_keeps_what_is_flown(first):
    decision = Replanner(WORLD, LIMITS, RADIUS, first).step(0.5)
    assert decision.kind is Kind.KEEP
    assert decision.flight.trajectory is first
    assert decision.certified


def test_a_mover_in_the_way_is_passed_by_a_proved_switch_that_begins_exactly_as_flown(first):
    replanner = Replanner(WORLD, LIMITS, RADIUS, first)
    before = replanner.flight
    x, y, z = first.position(2.2)
    movers = [ball(1.0, (x, y + 1.5, z), (0.0, -1.2, 0.0))]
    decision = replanner.step(1.0, movers)
    assert decision.kind is Kind.SWITCH
    assert decision.flight.start_s == pytest.approx(1.02)
    assert joint_gap(before, decision.flight) < 1e-9
    check_claims(WORLD, decision, movers, 2.0)
    np.testing.assert_allclose(decision.flight.trajectory.position(99.0), (13, 5, 1.5), atol=1e-9)


def test_new_trees_near_the_way_are_passed(first):
    switched = 0
    rng = np.random.default_rng(3)
    for _ in range(12):
        at = rng.uniform(0.5, 2.0)
        place = first.position(at + rng.uniform(1.2, 1.8)) + rng.uniform(-0.4, 0.4, 3)
        world = World(BOUNDS, [*WORLD.obstacles, Cylinder((place[0], place[1]), 0.35, (0, 4))])
        replanner = Replanner(WORLD, LIMITS, RADIUS, first)
        before = replanner.flight
        replanner.remap(world)
        decision = replanner.step(at)
        assert decision.certified
        if decision.kind is Kind.SWITCH:
            switched += 1
            assert joint_gap(before, decision.flight) < 1e-9
            check_claims(world, decision, [], 0.0)
    assert switched >= 8


@pytest.mark.parametrize("goal", [(12.5, 5.4, 1.8), (4.0, 8.5, 2.0)])
def test_another_goal_is_flown_to_near_or_far(first, goal):
    replanner = Replanner(WORLD, LIMITS, RADIUS, first)
    before = replanner.flight
    replanner.retarget(goal)
    decision = replanner.step(1.3)
    assert decision.kind is Kind.SWITCH
    assert joint_gap(before, decision.flight) < 1e-9
    check_claims(WORLD, decision, [], 0.0)
    np.testing.assert_allclose(decision.flight.trajectory.position(99.0), goal, atol=1e-9)


def test_a_goal_moved_a_little_late_in_the_flight_is_flown_to_on_what_is_left_of_the_way(first):
    replanner = Replanner(WORLD, LIMITS, RADIUS, first)
    replanner.retarget((12.5, 5.3, 1.2))
    decision = replanner.step(0.75 * first.duration)
    assert decision.reason == "on along the way"
    assert decision.flight.trajectory.duration < 0.25 * first.duration + 1.0
    check_claims(WORLD, decision, [], 2.0)


def test_a_goal_inside_a_tree_is_refused_and_the_old_one_stays(first):
    replanner = Replanner(WORLD, LIMITS, RADIUS, first)
    with pytest.raises(GoalInCollision):
        replanner.retarget((7.0, 3.0, 1.5))
    assert replanner.step(0.5).kind is Kind.KEEP


def test_a_wall_across_the_way_stops_the_vehicle_by_a_proved_stop(first):
    wall = [Cylinder((9.0, y), 0.5, (0, 4)) for y in np.arange(0.0, 10.5, 0.5)]
    world = World(BOUNDS, [*WORLD.obstacles, *wall])
    replanner = Replanner(WORLD, LIMITS, RADIUS, first)
    before = replanner.flight
    replanner.remap(world)
    decision = replanner.step(1.2)
    assert decision.kind is Kind.BACKUP
    assert joint_gap(before, decision.flight) < 1e-9
    check_claims(world, decision, [], 0.0)
    end = decision.flight.trajectory.state(99.0)
    assert np.abs(end.velocity).max() < 1e-9


def test_a_stop_is_kept_ready_and_begins_on_what_is_flown(first):
    replanner = Replanner(WORLD, LIMITS, RADIUS, first)
    for tick in range(0, 100, 5):
        decision = replanner.step(0.02 * tick)
        assert decision.backup is not None
        assert joint_gap(decision.flight, decision.backup) < 1e-9
        assert np.abs(decision.backup.trajectory.velocity(99.0)).max() < 1e-9
        assert wall_gap(WORLD, decision.backup.trajectory.position(np.linspace(0, 9, 500))) >= RADIUS


def test_what_cannot_be_missed_is_never_called_certified(first):
    replanner = Replanner(WORLD, LIMITS, RADIUS, first)
    x, y, z = first.position(1.1)
    decision = replanner.step(1.0, [ball(1.0, (x + 0.75, y, z), (-2.0, 0.0, 0.0))])
    assert decision.kind is Kind.NONE
    assert not decision.certified
    assert decision.backup is None
    assert decision.clearance < 0.0


@pytest.mark.parametrize("late", [0.3, 0.8, 1.4])
def test_a_mover_that_comes_to_the_goal_after_the_end_is_seen_as_far_as_it_is_predicted(first, late):
    now, ahead = first.duration - 0.2, 0.2 + late
    x, y, z = first.position(99.0)
    mover = ball(now, (x, y + 1.5 * ahead, z), (0.0, -1.5, 0.0))  # on the goal `late` after the end
    decision = Replanner(WORLD, LIMITS, RADIUS, first).step(now, [mover])
    assert decision.clearance < 0.0 or decision.flight.trajectory is not first
    if decision.certified:
        check_claims(WORLD, decision, [mover], 2.0, since=now + 0.02)
    passed = ball(now, (x, y + 1.5 * 4.0, z), (0.0, -1.5, 0.0))  # still 3 m away when the prediction ends
    assert Replanner(WORLD, LIMITS, RADIUS, first).step(now, [passed]).certified


def test_standing_at_the_end_is_judged_for_as_long_as_it_is_asked_for(first):
    ask = Replanner(WORLD, LIMITS, RADIUS, first)._ask(
        [MovingSphere((13.0, 5.0 + 1.0 * (first.duration + 1.0), 1.5), (0.0, -1.0, 0.0), 0.2)], 0.0
    )
    ask.movers[:, UNTIL] = np.inf  # it is half a metre from the goal half a second after the end
    points, knots = first.control_points, first.knots
    assert judge(ask, points, knots, 0.0, 0.0, 0.49)[2]
    assert not judge(ask, points, knots, 0.0, 0.0, 0.51)[2]


@pytest.mark.parametrize("radius", [-1.0, -1e-9, np.nan, np.inf])
def test_a_radius_that_cannot_be_is_refused(first, radius):
    with pytest.raises(ValueError, match="radius: expected a finite number of at least 0 m, found"):
        Replanner(WORLD, LIMITS, radius, first)


def test_a_trajectory_that_does_not_end_at_rest_is_refused():
    moving = plan(WORLD, (1, 5, 1.5), (13, 5, 1.5), LIMITS, RADIUS, goal_velocity=(0.5, 0, 0)).trajectory
    with pytest.raises(ValueError, match=r"trajectory: expected rest at its end, found 0\.5 m/s and"):
        Replanner(WORLD, LIMITS, RADIUS, moving)


@pytest.mark.parametrize("method", METHODS)
def test_every_methods_trajectory_counts_as_ending_at_rest_far_from_the_origin_too(method):
    for x, y in ((0.0, 0.0), (5e5, 5e6)):
        world = World(((x, y, 0), (x + 14, y + 10, 4)), [Cylinder((x + 7.0, y + 4.9), 0.5, (0, 4))])
        made = plan(world, (x + 1, y + 5, 1.5), (x + 13, y + 5, 1.5), LIMITS, RADIUS, method=method)
        assert Replanner(world, LIMITS, RADIUS, made.trajectory).step(0.5).certified


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"world": "maze"}, "world: expected a World, found 'maze'"),
        ({"limits": (3, 6, 60)}, r"limits: expected a Limits, found \(3, 6, 60\)"),
        ({"radius": "0.3"}, "radius: expected a finite number of at least 0 m, found '0.3'"),
        ({"trajectory": None}, "trajectory: expected a Trajectory, found None"),
    ],
)
def test_an_argument_of_another_type_is_refused_by_its_name(first, change, message):
    given = {"world": WORLD, "limits": LIMITS, "radius": RADIUS, "trajectory": first}
    with pytest.raises(TypeError, match=message):
        Replanner(**{**given, **change})


def test_a_new_world_that_covers_the_goal_is_told_in_every_decision_until_there_is_another_goal(first):
    replanner = Replanner(WORLD, LIMITS, RADIUS, first)
    covered = World(BOUNDS, [*WORLD.obstacles, Cylinder((13.0, 5.2), 0.6, (0, 4))])
    replanner.remap(covered)
    for tick in range(60):
        decision = replanner.step(1.0 + 0.02 * tick)
        assert "goal (13.00, 5.00, 1.50) is 0.400 m inside obstacle 1 (cylinder)" in decision.reason
        assert "0.700 m more" in decision.reason
        if decision.certified:
            check_claims(covered, decision, [], 0.0, since=1.02 + 0.02 * tick)
    assert np.abs(decision.flight.trajectory.velocity(99.0)).max() < 1e-9
    replanner.retarget((12.0, 4.0, 1.5))
    decision = replanner.step(2.2)
    assert "goal" not in decision.reason
    replanner.remap(WORLD)
    assert "goal" not in replanner.step(2.22).reason


def test_the_same_inputs_bring_the_same_decisions(first):
    def flown() -> list[Decision]:
        replanner = Replanner(WORLD, LIMITS, RADIUS, first)
        return [replanner.step(0.02 * k, [ball(0.02 * k, (8.0, 9.0 - 0.03 * k, 1.5), (0, -1.5, 0))]) for k in range(80)]

    assert flown() == flown()


def test_a_latency_and_settings_that_cannot_be_are_refused():
    with pytest.raises(ValueError, match="latency_s"):
        Settings(latency_s=-0.1)
    with pytest.raises(ValueError, match="hurry"):
        Settings(hurry=1.0)


@pytest.mark.slow
def test_ten_flights_among_twenty_balls_at_two_metres_a_second_arrive_untouched():
    assert [fly(seed).outcome for seed in range(10)] == ["reached"] * 10
