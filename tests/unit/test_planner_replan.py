"""Planning in flight: exact switches, true claims, kept stops; held against sampled true positions."""

import numpy as np
import pytest

from benchmarks.bench_replan import fly
from planner import Cylinder, GoalInCollision, Limits, MovingSphere, Trajectory, World, plan
from planner.limits import derivative_bounds
from planner.replan import Decision, Flight, Kind, Replanner, Settings

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


def check_claims(world: World, decision: Decision, movers: list[MovingSphere], horizon: float) -> None:
    """What is certified is so: solids and limits all along, movers as far as they are predicted."""
    trajectory, start = decision.flight.trajectory, decision.flight.start_s
    t = np.linspace(0.0, trajectory.duration, 1501)
    place = trajectory.position(t)
    assert min(world.distance(place).min(), world.wall_distance(place).min()) >= RADIUS
    bounds = derivative_bounds(trajectory.control_points, trajectory.knots)
    assert bounds.speed <= LIMITS.speed
    assert bounds.acceleration <= LIMITS.acceleration
    assert bounds.jerk <= LIMITS.jerk
    near = t <= horizon
    for m in movers:
        since = t[near] + start - m.stamp
        centre = np.array(m.centre) + since[:, None] * np.array(m.velocity)
        gap = np.linalg.norm(place[near] - centre, axis=1) - m.radius - m.growth * np.abs(since)
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
        assert WORLD.distance(decision.backup.trajectory.position(np.linspace(0, 9, 500))).min() >= RADIUS


def test_what_cannot_be_missed_is_never_called_certified(first):
    replanner = Replanner(WORLD, LIMITS, RADIUS, first)
    x, y, z = first.position(1.1)
    decision = replanner.step(1.0, [ball(1.0, (x + 0.75, y, z), (-2.0, 0.0, 0.0))])
    assert decision.kind is Kind.NONE
    assert not decision.certified
    assert decision.backup is None
    assert decision.clearance < 0.0


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
