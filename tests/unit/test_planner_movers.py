"""Moving obstacles: the identity the proof rests on, and proofs held against dense sampling of true positions."""

import math

import numpy as np
import pytest
from scipy.interpolate import BSpline

from planner.bspline import clamped_knots
from planner.movers import MOST_MOVERS, MovingBox, MovingSphere, certify_movers, table


def greville(knots: np.ndarray) -> np.ndarray:
    return (knots[1:-3] + knots[2:-2] + knots[3:-1]) / 3.0


def uneven_knots(rng: np.random.Generator, n: int) -> np.ndarray:
    inner = np.cumsum(rng.uniform(0.05, 0.7, n - 3))
    return np.concatenate([np.zeros(4), inner, np.repeat(inner[-1], 3)])


def least_distance(points: np.ndarray, knots: np.ndarray, mover: MovingSphere | MovingBox, start: float) -> float:
    """By sampling: where the vehicle is, where the mover is, how large it has become."""
    t = np.linspace(0.0, knots[-1], 4001)
    t = t[t + start <= mover.until]
    if not len(t):
        return math.inf
    since = t + start - mover.stamp
    vehicle = BSpline(knots, points, 3)(t)
    grown = mover.growth * np.abs(since)
    if isinstance(mover, MovingSphere):
        centre = np.array(mover.centre) + since[:, None] * np.array(mover.velocity)
        return float((np.linalg.norm(vehicle - centre, axis=1) - mover.radius - grown).min())
    low = np.array(mover.lower) + since[:, None] * np.array(mover.velocity) - grown[:, None]
    high = np.array(mover.upper) + since[:, None] * np.array(mover.velocity) + grown[:, None]
    outside = np.maximum(np.maximum(low - vehicle, vehicle - high), 0.0)
    inside = np.minimum(np.maximum(low - vehicle, vehicle - high).max(axis=1), 0.0)
    return float((np.linalg.norm(outside, axis=1) + inside).min())


def random_mover(rng: np.random.Generator) -> MovingSphere | MovingBox:
    centre, velocity = rng.uniform(-4.0, 4.0, 3), rng.uniform(-2.0, 2.0, 3)
    stamp = rng.uniform(-1.0, 1.0)
    until = stamp + rng.choice([math.inf, rng.uniform(1.0, 4.0)])
    common = {"velocity": tuple(velocity), "growth": rng.uniform(0.0, 0.3), "stamp": stamp, "until": until}
    if rng.random() < 0.5:
        return MovingSphere(centre=tuple(centre), radius=rng.uniform(0.1, 0.8), **common)
    half = rng.uniform(0.1, 0.8, 3)
    return MovingBox(lower=tuple(centre - half), upper=tuple(centre + half), **common)


def test_a_spline_seen_from_a_steady_frame_is_the_spline_of_control_points_moved_by_greville_abscissae():
    rng = np.random.default_rng(1)
    for _ in range(20):
        knots, w = uneven_knots(rng, 12), rng.normal(size=3)
        points = rng.normal(size=(12, 3))
        t = np.linspace(0.0, knots[-1], 200)
        moved = BSpline(knots, points - greville(knots)[:, None] * w, 3)(t)
        np.testing.assert_allclose(moved, BSpline(knots, points, 3)(t) - t[:, None] * w, atol=1e-12)


def test_a_proved_distance_to_a_mover_is_below_and_near_that_of_dense_samples():
    rng = np.random.default_rng(2)
    proved = 0
    for _ in range(300):
        points = np.cumsum(rng.normal(size=(10, 3)), axis=0)
        knots, start, mover = uneven_knots(rng, 10), rng.uniform(-1.0, 1.0), random_mover(rng)
        truth = least_distance(points, knots, mover, start)
        proof = certify_movers(points, knots, table([mover]), 0.3, start)
        if truth < 0.299 or math.isinf(truth):
            assert proof.certified == math.isinf(truth)
            continue
        if proof.certified:
            proved += 1
            assert 0.3 <= proof.distance <= truth + 1e-9
            assert proof.distance >= truth - 2e-3
        else:
            assert truth < 0.301
    assert proved > 100


def test_the_nearest_mover_and_its_time_are_told():
    knots = clamped_knots(8, 4.0)
    points = greville(knots)[:, None] * np.array([1.0, 0.0, 0.0])  # x = t
    far = MovingSphere((0.0, 9.0, 0.0), (0.0, 0.0, 0.0), 0.5)
    crossing = MovingSphere((2.0, -3.0, 0.0), (0.0, 1.0, 0.0), 0.5)  # at (2, 0) when t = 3
    proof = certify_movers(points, knots, table([far, crossing]), 0.1)
    assert proof.certified
    assert proof.mover == 1
    assert proof.time == pytest.approx(2.5, abs=0.05)  # closest approach of two unit speeds at right angles
    assert proof.distance == pytest.approx(math.sqrt(0.5) - 0.5, abs=2e-3)


def test_what_is_in_the_way_only_after_the_prediction_ends_is_not_held_against_a_trajectory():
    knots = clamped_knots(8, 4.0)
    points = greville(knots)[:, None] * np.array([1.0, 0.0, 0.0])
    wall = dict(lower=(3.0, -1.0, -1.0), upper=(3.5, 1.0, 1.0), velocity=(0.0, 0.0, 0.0))
    assert not certify_movers(points, knots, table([MovingBox(**wall)]), 0.2).certified
    assert certify_movers(points, knots, table([MovingBox(**wall, until=2.5)]), 0.2).certified


def test_a_mover_on_the_start_whose_prediction_ends_at_once_is_named_with_its_time():
    knots = clamped_knots(8, 4.0)
    points = greville(knots)[:, None] * np.array([1.0, 0.0, 0.0])
    away = MovingSphere((0.0, 50.0, 0.0), (0.0, 0.0, 0.0), 0.1)
    for until in (0.0, 1e-9, 1e-3):
        proof = certify_movers(points, knots, table([away, MovingSphere((0, 0, 0), (0, 0, 0), 0.1, until=until)]), 0.2)
        assert not proof.certified
        assert proof.mover == 1
        assert 0.0 <= proof.time <= until
    assert certify_movers(points, knots, table([MovingSphere((0, 0.4, 0), (0, 0, 0), 0.1, until=0.0)]), 0.2).certified


@pytest.mark.parametrize("tolerance", [1e-3, math.inf])
def test_how_many_others_there_are_and_in_which_order_does_not_matter(tolerance):
    rng = np.random.default_rng(7)
    points = np.cumsum(rng.normal(size=(40, 3)), axis=0)
    knots = uneven_knots(rng, 40)
    t = float(knots[20])
    near = MovingBox(tuple(points[18] + (1.0, 1.0, 1.0)), tuple(points[18] + (1.2, 1.2, 1.2)), (0.1, 0.0, 0.0), stamp=t)
    alone = certify_movers(points, knots, table([near]), 0.1, tolerance=tolerance)
    assert alone.certified
    middle = points.mean(axis=0)
    others = rng.normal(size=(3000, 3))
    others = middle + others / np.linalg.norm(others, axis=1)[:, None] * rng.uniform(40.0, 60.0, (3000, 1))
    far = [MovingSphere(tuple(p), tuple(rng.normal(size=3)), 0.2) for p in others]
    for crowd in ([near, *far], [*far, near], [*far[:1500], near, *far[1500:]]):
        proof = certify_movers(points, knots, table(crowd), 0.1, tolerance=tolerance)
        assert proof.certified
        assert crowd[proof.mover] is near
        assert proof.distance == pytest.approx(alone.distance, abs=1e-3 if tolerance < 1.0 else math.inf)
    blocking = MovingSphere(tuple(points[0]), (0.0, 0.0, 0.0), 0.5)
    for crowd in ([blocking, *far], [*far, blocking]):
        proof = certify_movers(points, knots, table(crowd), 0.1, tolerance=tolerance)
        assert not proof.certified
        assert crowd[proof.mover] is blocking


def test_standing_on_after_the_end_is_proved_when_asked_for():
    knots, points = clamped_knots(8, 1.0), np.zeros((8, 3))
    late = table([MovingSphere((3.0, 0.0, 0.0), (-1.0, 0.0, 0.0), 0.5)])
    assert certify_movers(points, knots, late, 0.2).certified
    assert certify_movers(points, knots, late, 0.2, hold=1.2).certified
    assert not certify_movers(points, knots, late, 0.2, hold=1.5).certified


def test_without_movers_everything_is_proved():
    proof = certify_movers(np.zeros((8, 3)), clamped_knots(8, 1.0), table([]), 0.2)
    assert proof.certified
    assert proof.distance == math.inf
    assert proof.mover == -1


@pytest.mark.parametrize(
    "wrong",
    [
        {"radius": -1.0},
        {"radius": math.nan},
        {"growth": -0.1},
        {"growth": math.inf},
        {"velocity": (1.0, 2.0)},
        {"velocity": (1e9, 0.0, 0.0)},
        {"centre": (math.nan, 0.0, 0.0)},
        {"stamp": math.inf},
        {"until": -1.0},
        {"until": math.nan},
    ],
)
def test_a_mover_that_cannot_be_is_refused(wrong):
    good = {"centre": (0.0, 0.0, 0.0), "velocity": (1.0, 0.0, 0.0), "radius": 0.5}
    MovingSphere(**good)
    with pytest.raises(ValueError, match="mover"):
        MovingSphere(**{**good, **wrong})


def test_a_moving_box_has_its_corners_in_order():
    with pytest.raises(ValueError, match="lower < upper"):
        MovingBox((0.0, 0.0, 0.0), (1.0, 0.0, 1.0), (0.0, 0.0, 0.0))


def test_a_table_takes_movers_alone_and_not_too_many():
    one = MovingSphere((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), 0.5)
    with pytest.raises(ValueError, match="mover 1"):
        table([one, "tree"])
    with pytest.raises(ValueError, match="at most"):
        table([one] * (MOST_MOVERS + 1))
    with pytest.raises(TypeError, match="movers: expected a sequence of MovingSphere and MovingBox, found MovingSph"):
        table(one)
    assert table(None).shape == table([]).shape
