"""Faults: as people write them, as a schedule, and what they do to a sensor's words."""

import math

import numpy as np
import pytest

from fakevehicle.faults import MOST, Channel, Fault, FaultKind, FaultSchedule, Sensor, parse_fault, typical
from fakevehicle.sensors.imu import GYRO_RANGE, IMU, Instability, integrate_imu, read_gyro, set_faults


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("gps:off@20-40", Fault(Sensor.GPS, FaultKind.OFF, 20_000_000, 40_000_000)),
        ("gyro:bias=0.02,0,-0.01@10", Fault(Sensor.GYRO, FaultKind.BIAS, 10_000_000, None, (0.02, 0.0, -0.01))),
        ("Baro:Delay=0.5", Fault(Sensor.BARO, FaultKind.DELAY, 0, None, (0.5,))),
        ("motor2:bias=0.65@30.5", Fault(Sensor.MOTOR, FaultKind.BIAS, 30_500_000, None, (0.65,), 1)),
    ],
)
def test_a_fault_is_read_as_people_write_it(text: str, fault: Fault) -> None:
    assert parse_fault(text) == fault


BAD = [
    "gps",
    "gps:gone",
    "nose:off",
    "gps:bias",
    "gps:off@40-20",
    "gps:noise=-1",
    "baro:delay=60",
    "gyro:bias=a",
    "gps:off@x",
    "motor0:off@.",
    "motor0:off",
    "motor5:off",
    "gps2:off",
    "gps:bias=1,2",
    "range:noise=1,2",
    "motor:noise=0.3",
    "motor:delay=0.5",
    "motor:stuck",
    "motor:bias=1.5",
    "motor:bias=-0.1",
]


@pytest.mark.parametrize("text", ["", *BAD])
def test_a_fault_that_cannot_be_is_refused_with_its_name(text: str) -> None:
    with pytest.raises(ValueError, match="fault"):
        parse_fault(text)


def test_a_motor_says_nothing_that_could_be_stuck_late_or_noisy() -> None:
    assert typical(Sensor.MOTOR, FaultKind.OFF) == ()
    assert typical(Sensor.BARO, FaultKind.STUCK) == ()
    for kind in FaultKind:
        for sensor in Sensor:
            magnitude = typical(sensor, kind)
            assert (magnitude is None) == (sensor is Sensor.MOTOR and kind not in (FaultKind.OFF, FaultKind.BIAS))
            if magnitude is not None:
                assert Fault(sensor, kind, 0, None, magnitude).kind is kind
    with pytest.raises(ValueError, match="motor:stuck: a motor can be off, or have a bias"):
        parse_fault("motor2:stuck")


def test_a_schedule_knows_what_holds_when_and_forgets_the_oldest_of_too_many() -> None:
    schedule = FaultSchedule([parse_fault("gps:off@1-2"), parse_fault("gps:noise=3@1.5"), parse_fault("mag:off@0")])
    assert schedule.active(Sensor.GPS, 999_999) == ()
    assert [f.kind for f in schedule.active(Sensor.GPS, 1_000_000)] == [FaultKind.OFF]
    assert [f.kind for f in schedule.active(Sensor.GPS, 1_600_000)] == [FaultKind.OFF, FaultKind.NOISE]
    assert [f.kind for f in schedule.active(Sensor.GPS, 2_000_000)] == [FaultKind.NOISE]
    schedule.mend(Sensor.GPS, 3_000_000)
    assert schedule.active(Sensor.GPS, 3_000_000) == ()
    assert schedule.active(Sensor.MAG, 3_000_000)
    for k in range(10 * MOST):
        schedule.add(Fault(Sensor.BARO, FaultKind.OFF, k))
    assert len(schedule.active(Sensor.BARO, 10**9)) == MOST
    assert not schedule.active(Sensor.MAG, 10**9)
    assert schedule.concerns(Sensor.MAG)
    assert not schedule.concerns(Sensor.GYRO)


def test_one_motor_of_several_is_mended_by_its_number() -> None:
    schedule = FaultSchedule([parse_fault("motor2:off"), parse_fault("motor3:off")])
    schedule.mend(Sensor.MOTOR, 1_000_000, 1)
    assert [f.index for f in schedule.active(Sensor.MOTOR, 1_000_000)] == [2]
    schedule.mend(Sensor.MOTOR, 2_000_000)
    assert schedule.active(Sensor.MOTOR, 2_000_000) == ()


def test_a_fault_is_refused_in_the_units_people_write_it_in() -> None:
    with pytest.raises(ValueError, match="from 20 to 10 s, expected an end after the start"):
        parse_fault("gps:off@20-10")
    with pytest.raises(ValueError, match="fault motor:off: number 9, this vehicle has 4"):
        parse_fault("motor9:off")


def said(text: str, seconds: int = 40) -> list[float]:
    """What a sensor that counts seconds says each second; NaN for nothing."""
    channel = Channel(Sensor.BARO, FaultSchedule([parse_fault(text)]), np.random.default_rng(1))
    words = [channel.through(k * 1_000_000, np.array([float(k)])) for k in range(seconds)]
    return [math.nan if word is None else float(word[0]) for word in words]


def test_off_says_nothing_and_comes_back() -> None:
    words = said("baro:off@10-20")
    assert words[:10] == list(range(10))
    assert all(math.isnan(word) for word in words[10:20])
    assert words[20:] == list(range(20, 40))


def test_stuck_repeats_what_was_said_last() -> None:
    words = said("baro:stuck@10-20")
    assert words[10:20] == [9.0] * 10
    assert words[20] == 20.0


def test_bias_is_added_and_delay_is_the_past() -> None:
    assert said("baro:bias=-2.5@10-20")[9:21] == [9.0, *(k - 2.5 for k in range(10, 20)), 20.0]
    assert said("baro:delay=3@10-20")[9:21] == [9.0, *(float(k - 3) for k in range(10, 20)), 20.0]


def test_noise_is_as_large_as_it_says_and_leaves_the_sensor_s_own_draws_alone() -> None:
    schedule = FaultSchedule([parse_fault("mag:noise=0.2,0,0.1")])
    channel = Channel(Sensor.MAG, schedule, np.random.default_rng(2))
    words = np.array([channel.through(k, np.zeros(3)) for k in range(4000)])
    np.testing.assert_allclose(words.std(axis=0), [0.2, 0.0, 0.1], rtol=0.05)


def test_a_healthy_sensor_says_the_very_same_array() -> None:
    channel = Channel(Sensor.MAG, FaultSchedule([parse_fault("gps:off")]), np.random.default_rng(3))
    word = np.ones(3)
    assert channel.through(0, word) is word


def imu_says(text: str, ticks: int = 60) -> np.ndarray:
    """(n, 3) sums of gyro x, its sample, and force z of an IMU whose vehicle turns by k rad/s in millisecond k."""
    schedule, imu, out = FaultSchedule([parse_fault(text)]), np.zeros(1, IMU), []
    for k in range(ticks):
        set_faults(imu, schedule, k * 1000, (0.0, 0.0))
        x = np.zeros(17)
        x[6], x[10] = 1.0, 0.1 * k
        imu["gyro_sum"], imu["accel_sum"] = 0.0, 0.0
        read_gyro(x, imu[0], np.zeros(6), 0)
        integrate_imu(x, x, 9.80665, 0.001, imu[0], np.zeros(6), 0)
        out.append((imu["gyro_sum"][0, 0], imu["gyro_sample"][0, 0], imu["accel_sum"][0, 2]))
    return np.array(out)


def test_a_stuck_gyro_holds_its_rate_and_not_zero() -> None:
    healthy, stuck = imu_says("mag:off"), imu_says("gyro:off@0.03-0.05")
    np.testing.assert_array_equal(stuck[:30], healthy[:30])
    np.testing.assert_allclose(stuck[30:50, :2], 2.9)
    np.testing.assert_array_equal(stuck[30:50, 2], healthy[30:50, 2])
    np.testing.assert_array_equal(stuck[50:], healthy[50:])


def test_a_biased_accelerometer_and_a_late_gyro_say_what_they_should() -> None:
    healthy, biased = imu_says("mag:off"), imu_says("accel:bias=0,0,0.5@0.03")
    np.testing.assert_allclose(biased[30:, 2] - healthy[30:, 2], 0.5)
    np.testing.assert_array_equal(biased[:, :2], healthy[:, :2])
    late = imu_says("gyro:delay=0.01@0.02")
    np.testing.assert_allclose(late[30:, 0], healthy[20:-10, 0])  # ten milliseconds on, it is ten behind
    np.testing.assert_allclose(late[30:, 1], healthy[20:-10, 1])


def test_even_a_faulty_gyro_stays_within_its_range() -> None:
    assert np.abs(imu_says("gyro:bias=1000")[:, 0]).max() == GYRO_RANGE


def test_noise_of_the_imu_is_added_to_what_there_is() -> None:
    imu = np.zeros(1, IMU)
    set_faults(imu, FaultSchedule([parse_fault("gyro:noise=0.4")]), 0, (0.6, 0.1))
    assert imu["gyro_noise"][0] == pytest.approx(math.hypot(0.6, 0.8))  # 0.4 of a 250 Hz mean is 0.8 of each of four
    assert imu["accel_noise"][0] == 0.1


def test_bias_instability_wanders_as_much_as_it_says_and_forgets() -> None:
    drift = Instability(np.random.default_rng(4), 2.0)
    drift.gyro, drift.accel = 1e-3, 0.02
    imu, seen = np.zeros(1, IMU), []
    for _ in range(20_000):
        drift.step(imu)
        seen.append(imu["gyro_bias"][0].copy())
    series = np.array(seen)
    assert float(series.std()) == pytest.approx(1e-3, rel=0.15)
    again = float(np.mean(series[100:] * series[:-100]) / series.var())
    assert again == pytest.approx(math.exp(-1.0), abs=0.12)  # 100 steps of 2 s are one time constant


def test_vibration_follows_the_rotors_and_averages_out() -> None:
    imu, x = np.zeros(1, IMU), np.zeros(17)
    imu["vibration"] = 5.0 / 1e6
    x[6], x[13] = 1.0, 800.0  # one rotor turns
    forces = []
    for _ in range(4000):
        imu["accel_sum"] = 0.0
        integrate_imu(x, x, 9.80665, 0.001, imu[0], np.zeros(6), 0)
        forces.append(imu["accel_sum"][0].copy())
    shaken = np.array(forces)
    np.testing.assert_allclose(shaken.mean(axis=0), [0.0, 0.0, -9.80665], atol=0.02)
    size = 5.0 * 0.64
    np.testing.assert_allclose(shaken.std(axis=0), size / math.sqrt(2.0), rtol=0.02)
    spectrum = np.abs(np.fft.rfft(shaken[:, 0]))
    assert np.argmax(spectrum[1:]) + 1 == round(800.0 / (2 * math.pi) * 4.0)
