"""Plans among movers: every claim is held against sampled true positions."""

import pickle

import numpy as np
import pytest

from planner import BlockedByMovers, Box, Cylinder, Limits, MovingBox, MovingSphere, NoPathFound, World, plan
from planner.among import wait

LIMITS, RADIUS = Limits(3.0, 6.0, 60.0), 0.3
OPEN = World(((0, 0, 0), (12, 12, 4)), [Cylinder((6.0, 3.0), 0.4, (0, 4))])
CORRIDOR = World(((0, 0, 0), (12, 4, 1.2)), [Box((3, 0, 0), (9, 1.5, 1.2)), Box((3, 2.5, 0), (9, 4, 1.2))])


def least_gap(trajectory, movers: list[MovingSphere]) -> float:
    t = np.linspace(0.0, trajectory.duration, 4001)
    place = trajectory.position(t)
    gaps = [
        np.linalg.norm(place - m.centre - t[:, None] * np.array(m.velocity), axis=1) - m.radius - m.growth * t
        for m in movers
    ]
    return float(np.min(gaps))


def crossing(rng: np.random.Generator) -> list[MovingSphere]:
    movers = []
    while len(movers) < 6:
        centre = rng.uniform([2.5, 0.0, 0.5], [12.0, 12.0, 3.5])
        velocity = rng.normal(size=3)
        if np.linalg.norm(centre - (1.0, 6.0, 1.5)) > 2.0:
            movers.append(MovingSphere(tuple(centre), tuple(velocity), rng.uniform(0.2, 0.5), growth=0.05))
    return movers


@pytest.mark.parametrize("seed", range(8))
def test_a_plan_keeps_its_clearance_from_every_mover_all_the_way(seed):
    movers = crossing(np.random.default_rng(seed))
    made = plan(OPEN, (1, 6, 1.5), (11, 6, 1.5), LIMITS, RADIUS, movers=movers)
    assert made.certified
    assert made.clearance >= 0.0
    assert least_gap(made.trajectory, movers) >= RADIUS + made.clearance - 1e-9


def test_a_mover_that_is_nowhere_near_changes_nothing():
    away = MovingSphere((6.0, 11.0, 3.0), (0.0, 0.1, 0.0), 0.3)
    alone = plan(OPEN, (1, 3, 1.5), (11, 3, 1.5), LIMITS, RADIUS)
    assert plan(OPEN, (1, 3, 1.5), (11, 3, 1.5), LIMITS, RADIUS, movers=[away]).trajectory == alone.trajectory


def test_a_corridor_that_a_mover_fills_is_waited_for():
    train = MovingBox((3.0, 1.5, 0.0), (5.0, 2.5, 1.2), (2.0, 0.0, 0.0))  # leaves the corridor after 3 s
    made = plan(CORRIDOR, (1, 2, 0.6), (11, 0.8, 0.6), LIMITS, RADIUS, movers=[train])
    assert made.certified
    alone = plan(CORRIDOR, (1, 2, 0.6), (11, 0.8, 0.6), LIMITS, RADIUS)
    assert alone.trajectory.duration <= made.trajectory.duration


def test_oncoming_traffic_is_let_out_of_a_corridor_first():
    oncoming = MovingBox((8.5, 1.5, 0.0), (9.0, 2.5, 1.2), (-1.0, -0.0, 0.0), until=6.0)
    made = plan(CORRIDOR, (1.5, 3.5, 0.6), (11, 2, 0.6), LIMITS, RADIUS, movers=[oncoming])
    t = np.linspace(0.0, made.trajectory.duration, 2001)
    place = made.trajectory.position(t)
    low = np.array([8.5, 1.5, 0.0]) + t[:, None] * np.array([-1.0, 0.0, 0.0])
    high = np.array([9.0, 2.5, 1.2]) + t[:, None] * np.array([-1.0, 0.0, 0.0])
    gap = np.linalg.norm(np.maximum(np.maximum(low - place, place - high), 0.0), axis=1)
    assert made.certified
    assert gap[t <= 6.0].min() >= RADIUS


def test_a_mover_that_stays_in_the_only_way_is_named():
    plug = MovingBox((5.0, 1.4, 0.0), (6.0, 2.6, 1.2), (0.0, 0.0, 0.0))
    away = MovingSphere((1.0, 3.5, 0.6), (-1.0, 0.0, 0.0), 0.1)
    with pytest.raises(BlockedByMovers, match="mover 1 is in the way") as caught:
        plan(CORRIDOR, (1, 2, 0.6), (11, 2, 0.6), LIMITS, RADIUS, movers=[away, plug])
    assert isinstance(caught.value, NoPathFound)
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value)
    assert again.mover == 1


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ({}, "on other sides, slower and later too"),
        ({"via": [(4.0, 2.0, 0.6)]}, "later too"),
        ({"start_velocity": (0.5, 0.0, 0.0)}, "on other sides and slower too"),
        ({"start_acceleration": (0.5, 0.0, 0.0)}, "on other sides and slower too"),
        ({"start_velocity": (0.5, 0.0, 0.0), "via": [(4.0, 2.0, 0.6)]}, None),
    ],
    ids=["rest", "via", "moving", "pushed", "moving and via"],
)
def test_only_what_was_tried_among_movers_is_told_as_tried(more, told):
    plug = MovingBox((5.0, 1.4, 0.0), (6.0, 2.6, 1.2), (0.0, 0.0, 0.0))
    with pytest.raises(BlockedByMovers) as caught:
        plan(CORRIDOR, (1, 2, 0.6), (11, 2, 0.6), LIMITS, RADIUS, movers=[plug], **more)
    for error in (caught.value, pickle.loads(pickle.dumps(caught.value))):
        assert str(error).endswith(f" s, {told}" if told else " s")


def test_a_near_mover_after_a_thousand_far_ones_is_passed_as_if_it_came_first():
    rng = np.random.default_rng(0)
    far = [MovingSphere(tuple(p), (0.0, 0.0, 0.0), 0.2) for p in rng.uniform((0, 30, 0), (20, 60, 4), (1000, 3))]
    near = MovingSphere((6.0, 6.8, 1.5), (0.0, -0.01, 0.0), 0.3)
    ends = (1, 6, 1.5), (11, 6, 1.5)
    made = [plan(OPEN, *ends, LIMITS, RADIUS, movers=crowd) for crowd in ([*far, near], [near, *far])]
    assert all(p.certified for p in made)
    assert made[0].trajectory == made[1].trajectory


def test_waiting_is_standing_and_then_the_same_motion():
    first = plan(OPEN, (1, 6, 1.5), (11, 6, 1.5), LIMITS, RADIUS).trajectory
    later = wait(first, 1.5)
    t = np.linspace(0.0, first.duration, 300)
    np.testing.assert_allclose(later.position(np.linspace(0.0, 1.5, 50)), np.tile(first.position(0.0), (50, 1)))
    np.testing.assert_allclose(later.position(t + 1.5), first.position(t), atol=1e-10)
    np.testing.assert_allclose(later.acceleration(t + 1.5), first.acceleration(t), atol=1e-7)


def test_something_that_is_no_mover_is_refused():
    with pytest.raises(ValueError, match="mover 0"):
        plan(OPEN, (1, 6, 1.5), (11, 6, 1.5), LIMITS, RADIUS, movers=[OPEN.obstacles[0]])
