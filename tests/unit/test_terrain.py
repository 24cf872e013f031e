"""The ground below: worked by hand, and against truth of a flight over a box."""

import math

import numpy as np
import pytest

from fakevehicle.airframe import load_airframe
from fakevehicle.estimator.terrain import PARAMETERS, Terrain
from fakevehicle.faults import Fault, FaultKind, Sensor
from fakevehicle.flight import PARAMETERS as ALL
from fakevehicle.flight import FlightStack
from fakevehicle.params import ParameterSet
from fakevehicle.sensors.obstacles import World
from fakevehicle.vocabulary import FloatArray, Geodetic, RangeSample, Setpoint

PERIOD_US = 48_000


def out(z: float, vx: float = 0.0, tilt: float = 0.0) -> FloatArray:
    """An estimator's output at a height, with a speed and rolled."""
    nav = np.zeros(16)
    nav[2], nav[3], nav[6], nav[7] = z, vx, math.cos(tilt / 2), math.sin(tilt / 2)
    return nav


def sample(now_us: int, distance: float) -> RangeSample:
    return RangeSample(now_us, distance, 0.05, 20.0)


@pytest.fixture
def terrain() -> Terrain:
    """Of a vehicle 5 m above the ground at down 1 m, which has been looked at for two seconds."""
    terrain = Terrain(ParameterSet(PARAMETERS))
    for k in range(1, 41):
        terrain.take(sample(k * PERIOD_US, 5.0 + 1e-4 * (k % 2)), out(-4.0), True)
    return terrain


NEWEST_US = 40 * PERIOD_US


def test_the_first_sample_is_believed_and_the_next_weighed_by_the_two_variances() -> None:
    terrain = Terrain(ParameterSet(PARAMETERS))
    assert not terrain.valid(0)
    terrain.take(sample(100_000, 5.0), out(-4.0), True)
    first = 0.02**2 + 0.025**2
    assert (terrain.down, terrain.variance) == (1.0, pytest.approx(first))
    terrain.take(sample(200_000, 5.1), out(-4.0), True)
    before = first + 0.01 * 0.1
    gain = before / (before + 0.02**2 + (0.005 * 5.1) ** 2)
    assert terrain.down == pytest.approx(1.0 + 0.1 * gain)
    assert terrain.variance == pytest.approx((1 - gain) * before)


def test_a_tilted_beam_is_longer_and_one_that_looks_aside_is_passed_over(terrain: Terrain) -> None:
    terrain.take(sample(NEWEST_US + PERIOD_US, 5.0 / math.cos(0.5)), out(-4.0, tilt=0.5), True)
    assert terrain.down == pytest.approx(1.0, abs=1e-3)
    before = terrain.down
    terrain.take(sample(NEWEST_US + 2 * PERIOD_US, 3.0), out(-4.0, tilt=0.8), True)
    assert terrain.down == before


def test_one_wrong_word_is_refused_and_six_that_agree_are_a_new_ground(terrain: Terrain) -> None:
    terrain.take(sample(NEWEST_US + PERIOD_US, 2.0), out(-4.0), True)
    assert terrain.down == pytest.approx(1.0, abs=1e-3)
    assert terrain.test_ratio > 1.0
    terrain.take(sample(NEWEST_US + 2 * PERIOD_US, 5.001), out(-4.0), True)
    for k in range(3, 9):
        assert terrain.down == pytest.approx(1.0, abs=1e-2)
        terrain.take(sample(NEWEST_US + k * PERIOD_US, 2.0 + 1e-4 * k), out(-4.0), True)
    assert terrain.down == pytest.approx(-2.0, abs=1e-2)
    assert terrain.resets == 1


def test_rubbish_that_does_not_agree_is_never_believed(terrain: Terrain) -> None:
    rng = np.random.default_rng(3)
    for k in range(1, 60):
        terrain.take(sample(NEWEST_US + k * PERIOD_US, float(rng.uniform(8.0, 20.0))), out(-4.0), True)
    assert terrain.down == pytest.approx(1.0, abs=0.05)
    assert terrain.resets == 0
    assert not terrain.valid(NEWEST_US + 59 * PERIOD_US)


@pytest.mark.parametrize("word", [math.nan, 5.0])
def test_out_of_reach_or_stuck_it_is_no_longer_known_after_a_while(terrain: Terrain, word: float) -> None:
    for k in range(1, 40):
        terrain.take(sample(NEWEST_US + k * PERIOD_US, word), out(-4.0), True)
    assert terrain.valid(NEWEST_US + 15 * PERIOD_US)
    assert not terrain.valid(NEWEST_US + 39 * PERIOD_US)


def test_on_the_ground_it_may_say_the_same_for_ever(terrain: Terrain) -> None:
    for k in range(1, 60):
        terrain.take(sample(NEWEST_US + k * PERIOD_US, 5.0), out(-4.0), False)
    assert terrain.valid(NEWEST_US + 59 * PERIOD_US)


def test_a_jump_of_the_estimate_moves_the_ground_with_it(terrain: Terrain) -> None:
    terrain.moved(-3.0)
    terrain.take(sample(NEWEST_US + PERIOD_US, 5.0), out(-7.0), True)
    assert terrain.down == pytest.approx(-2.0, abs=1e-2)
    assert terrain.test_ratio < 1.0


HOME = Geodetic(0.82, 0.15, 488.0)
ROOF = 1.2


def flight(faults: tuple[Fault, ...] = ()) -> FloatArray:
    """(n, 3) of seconds, truth's north, and what is told of the height above ground less truth's (NaN: nothing).

    On a way over a box at 2 m/s, 3 m up, from 14 s on.
    """
    stack = FlightStack(
        airframe=load_airframe("x500"),
        parameters=ParameterSet(ALL),
        home=HOME,
        heading=0.0,
        wind_n=np.zeros(3),
        seed=5,
        faults=faults,
        world=World(boxes=np.array([[8.0, -5.0, -ROOF, 14.0, 5.0, 0.5]])),
    )
    for k in range(1, 2001):
        stack.tick(k * 4000, None, False)
    start_n = stack.estimate.position_n
    rows = []
    for k in range(2001, 7001):
        t = k * 0.004 - 8.0
        place_n = start_n + np.array([2.0 * max(t - 6.0, 0.0), 0.0, -min(0.75 * t, 3.0)])
        velocity_n = np.array([2.0 if t > 6.0 else 0.0, 0.0, -0.75 if t < 4.0 else 0.0])
        stack.tick(k * 4000, Setpoint(place_n, velocity_n, np.zeros(3), 0.0), True)
        north, _, down = stack.truth.position_n.tolist()
        ground = -ROOF if 8.0 <= north <= 14.0 else 0.22  # it stands with its centre of mass at 0
        clear = math.nan if stack.clearance is None else stack.clearance
        rows.append((t + 8.0, north, clear - (ground - down)))
    return np.array(rows)


def test_a_flight_over_a_box_knows_its_height_above_ground_and_above_the_box() -> None:
    _, north, error = flight().T
    assert np.isfinite(error).all()
    # a roof is believed after a third of a second, which is 0.7 m of way
    settled = np.minimum(np.abs(north - 8.0), np.abs(north - 14.0)) > 1.0
    assert np.sqrt((error[settled] ** 2).mean()) < 0.05
    assert np.abs(error[settled]).max() < 0.2


def test_a_silent_rangefinder_is_told_after_less_than_a_second() -> None:
    t, _, error = flight((Fault(Sensor.RANGE, FaultKind.OFF, 14_000_000, 18_000_000),)).T
    assert np.isnan(error[(t > 15.0) & (t < 18.0)]).all()
    assert np.isfinite(error[(t < 14.5) | (t > 18.2)]).all()
