"""The estimator in whole flights: how sure it is against how right it is, and what it does when sensors fail.

The judge is the simulator's truth. Setpoints live in the estimator's frame; truth is brought there by the place of the
estimator's origin, so an error is an error of the estimate and not of the frame (`benchmarks.bench_estimator`).
"""

import math

import numpy as np
import pytest

from benchmarks.bench_estimator import HOVER, Belief, Run, believe, inside
from fakevehicle.vocabulary import FloatArray, Setpoint


def judge(belief: Belief) -> None:
    """ANEES in its 95 % band at 93 % of epochs, and every sensor's NIS per degree of freedom near 1."""
    low, high, share = inside(belief)
    assert share >= 0.93, f"ANEES inside {low:.2f}..{high:.2f} in {share:.1%} of epochs, mean {belief.nees.mean():.2f}"
    for name, value in belief.nis.items():
        assert 0.95 <= value <= 1.05, f"{name}: NIS per degree of freedom {value:.3f}"


@pytest.mark.slow
def test_over_many_flights_the_filter_is_as_sure_as_it_is_right() -> None:
    """The shipped parameters, drift of the barometer and latency of GPS included; more flights in the benchmark."""
    belief = believe(range(500, 516), {})
    judge(belief)
    assert belief.position_rms <= 0.11
    assert belief.tilt_rms_deg <= 0.3


# GPS lost


def attitude_step(before: FloatArray, after: FloatArray) -> float:
    """Angle between two attitude setpoints [deg]."""
    return math.degrees(2.0 * math.acos(min(1.0, abs(float(before @ after)))))


def largest_step(run: Run, seconds: float) -> float:
    """Largest change of the attitude setpoint in one tick over a while of hovering [deg]."""
    worst, q = 0.0, run.stack.control.attitude_setpoint_q_nb
    for _ in range(round(seconds / 0.004)):
        run.hover(0.004)
        now = run.stack.control.attitude_setpoint_q_nb
        worst, q = max(worst, attitude_step(q, now)), now
    return worst


@pytest.mark.parametrize("seed", [2, 3])
def test_without_gps_for_twenty_seconds_it_says_so_at_once_drifts_little_and_comes_back_without_a_jump(
    seed: int,
) -> None:
    run = Run(seed=seed, wind=(3.0, 0.0, 0.0), faults=("gps:off@20-40",))
    run.take_off()
    assert run.stack.estimate.position_valid
    told = math.nan
    while run.t < 39.0:
        run.hover(0.02)
        e = run.stack.estimate
        if math.isnan(told) and not (e.position_valid or e.velocity_valid):
            told = run.t - 20.0
        assert e.attitude_valid
        assert e.altitude_valid
    assert told <= 1.0
    assert float(np.linalg.norm(run.stack._x[3:6] - run.stack.estimator.out[3:6])) < 0.5
    assert float(np.linalg.norm(run.off())) < 4.0
    blind = largest_step(run, 1.0)
    assert run.stack.estimate.resets.count == 0
    assert largest_step(run, 0.216) < 3.0 * blind  # the first fix has come, and with it the reset
    assert run.stack.estimate.resets.count == 1
    assert 0.5 < float(np.linalg.norm(run.jumped[:3])) < 4.0
    assert largest_step(run, 3.0) < 3.0 * blind
    assert run.stack.estimate.resets.count == 1
    assert run.stack.estimate.position_valid
    assert float(np.linalg.norm(run.off())) < 0.5
    run.hover(10.0)
    assert float(np.linalg.norm(run.placed(run.stack._x) - HOVER)) < 0.4  # back where it was asked to be


def test_a_position_that_jumps_and_stays_is_refused_for_five_seconds_and_then_believed() -> None:
    run = Run(seed=4, faults=("gps:bias=20,-10,0,0,0,0@25-60",))
    run.take_off()
    run.hover(9.5)  # 4.5 s of it
    assert run.stack.estimate.test_ratio["gps_position"] > 5.0
    assert not run.stack.estimate.position_valid
    assert run.stack.estimate.velocity_valid
    assert float(np.linalg.norm(run.off())) < 1.0
    assert largest_step(run, 1.5) < 1.0  # 45 when the loops see the jump
    assert run.stack.estimate.resets.count == 1
    np.testing.assert_allclose(run.jumped[:3], [20.0, -10.0, 0.0], atol=0.5)
    np.testing.assert_allclose(run.jumped[3:], 0.0, atol=0.2)
    run.hover(3.0)
    assert run.stack.estimate.position_valid
    assert run.stack.estimate.test_ratio["gps_position"] < 1.0


def test_a_glitch_of_three_seconds_changes_nothing() -> None:
    run = Run(seed=5, faults=("gps:bias=20,-10,0,0,0,0@25-28",))
    run.take_off()
    run.hover(15.0)
    assert run.stack.estimate.resets.count == 0
    assert run.stack.estimate.position_valid
    assert float(np.linalg.norm(run.placed(run.stack._x) - HOVER)) < 0.4


def test_a_receiver_that_repeats_itself_in_flight_is_as_good_as_none() -> None:
    run = Run(seed=6, faults=("gps:stuck@25-40",))
    run.take_off()
    run.hover(5.9)
    assert run.stack.estimate.position_valid or run.t > 25.0
    run.hover(0.6)
    assert not run.stack.estimate.position_valid
    run.hover(13.0)
    assert float(np.linalg.norm(run.off())) < 4.0
    run.hover(5.0)
    assert run.stack.estimate.position_valid
    assert float(np.linalg.norm(run.off())) < 0.5


def test_without_its_barometer_it_flies_on_by_gps_height() -> None:
    run = Run(seed=7, faults=("baro:off@25",))
    run.take_off()
    run.hover(1.0)
    while run.t < 60.0:
        run.hover(0.1)
        assert run.stack.estimate.altitude_valid
        assert abs(float(run.off()[2])) < 0.8
    assert "gps_height" in run.stack.estimate.test_ratio
    assert abs(float(run.stack._x[2]) - HOVER[2]) < 0.8


def test_without_its_magnetometer_it_keeps_its_heading() -> None:
    run = Run(seed=8, faults=("mag:off@25",))
    run.take_off()
    while run.t < 60.0:
        run.hover(0.1)
        assert run.stack.estimate.attitude_valid
        assert run.stack.estimate.position_valid
    assert abs(float(run.error()[2])) < math.radians(3.0)
    assert float(np.linalg.norm(run.placed(run.stack._x) - HOVER)) < 0.4


def test_a_disturbed_magnetic_field_does_not_turn_it() -> None:
    run = Run(seed=9, faults=("mag:bias=0.2,0.15,0@25-45",))
    run.take_off()
    while run.t < 50.0:
        run.hover(0.1)
        assert abs(float(run.error()[2])) < math.radians(4.0)
    assert run.stack.estimate.resets.count == 0
    assert run.stack.estimate.test_ratio["mag"] < 1.0


def test_a_gyro_that_stops_is_told_within_half_a_second() -> None:
    run = Run(seed=10, faults=("gyro:off@25",))
    run.take_off()
    run.hover(5.0)
    assert run.stack.estimate.attitude_valid
    run.hover(0.5)
    assert not run.stack.estimate.attitude_valid


def test_without_gps_a_vehicle_that_has_landed_knows_that_it_stands_still() -> None:
    run = Run(seed=12, faults=("gps:off@21",))
    run.take_off()
    while run.stack._x[2] < -0.05:
        sinking = np.array([0.0, 0.0, 0.7])
        run.tick(Setpoint(position_n=np.full(3, np.nan), velocity_n=sinking, acceleration_n=np.zeros(3), yaw=0.5))
    for _ in range(500):
        run.tick(None)
    assert float(np.linalg.norm(run.stack.estimator.out[3:6])) < 0.1
    assert not run.stack.estimate.velocity_valid


def test_until_its_first_fault_a_flight_is_the_same_as_without() -> None:
    kinds = ("off", "stuck", "bias=1", "noise=1", "delay=0.1")
    sensors = ("gyro", "accel", "gps", "baro", "mag", "range", "battery")
    ends = []
    for faults in ((), tuple(f"{sensor}:{kind}@12" for sensor in sensors for kind in kinds)):
        run = Run(seed=13, faults=faults)
        while run.t < 11.99:
            run.tick(Setpoint(position_n=HOVER, yaw=0.5) if run.t > 7.0 else None)
        ends.append(np.concatenate([run.stack._x, run.stack.estimator.out]))
    np.testing.assert_array_equal(ends[0], ends[1])


def test_the_same_faults_and_seed_give_the_same_flight() -> None:
    ends = []
    for _ in range(2):
        run = Run(seed=11, faults=("gps:noise=2,2,3,0,0,0@10-14", "accel:noise=0.5@12", "baro:delay=0.4@11"))
        run.take_off()
        ends.append(run.stack._x.copy())
    np.testing.assert_array_equal(ends[0], ends[1])
