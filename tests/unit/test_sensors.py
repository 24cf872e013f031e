"""Each sensor: unbiased where it should be, as noisy as it says, late by what it says, true without noise."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fakevehicle.geodesy import to_geodetic, to_local
from fakevehicle.sensors.barometer import Barometer, altitude_of, pressure_at
from fakevehicle.sensors.gps import GpsReceiver
from fakevehicle.sensors.imu import GYRO_RANGE, IMU, integrate_imu, read_gyro
from fakevehicle.sensors.magnetometer import Magnetometer, field_n
from fakevehicle.vocabulary import Geodetic

HOME = Geodetic(math.radians(47.397742), math.radians(8.545594), 488.0)


def test_a_fix_arrives_late_with_what_was_true_then() -> None:
    gps = GpsReceiver(HOME, np.random.default_rng(1), 112_000, 0.0, 0.0)
    gps.measure(1_000_000, np.array([3.0, -4.0, -5.0]), np.array([1.0, 2.0, 3.0]))
    assert gps.arrived(1_108_000) is None
    fix = gps.arrived(1_112_000)
    assert fix is not None
    assert (fix.measured_us, fix.now_us) == (1_000_000, 1_112_000)
    np.testing.assert_allclose(to_local(fix.position, HOME), [3.0, -4.0, -5.0], atol=1e-6)
    np.testing.assert_array_equal(fix.velocity_n, [1.0, 2.0, 3.0])


def test_fixes_scatter_as_much_as_they_say() -> None:
    gps = GpsReceiver(HOME, np.random.default_rng(2), 4000, 0.4, 0.1)
    places, speeds = [], []
    for k in range(2000):
        gps.measure(4000 * k, np.zeros(3), np.zeros(3))
        fix = gps.arrived(4000 * (k + 1))
        assert fix is not None
        places.append(to_local(fix.position, HOME))
        speeds.append(fix.velocity_n)
    np.testing.assert_allclose(np.std(places, axis=0), [0.4, 0.4, 0.6], rtol=0.06)
    np.testing.assert_allclose(np.std(speeds, axis=0), [0.1, 0.1, 0.15], rtol=0.06)
    np.testing.assert_allclose(np.mean(places, axis=0), 0.0, atol=0.05)


def test_local_and_geodetic_are_inverses_and_one_minute_of_latitude_is_a_nautical_mile() -> None:
    there = np.array([120.0, -345.0, 7.0])
    np.testing.assert_allclose(to_local(to_geodetic(there, HOME), HOME), there, atol=1e-6)
    minute = Geodetic(HOME.latitude + math.radians(1 / 60), HOME.longitude, HOME.altitude)
    assert to_local(minute, HOME)[0] == pytest.approx(1852.0, rel=0.002)
    dateline = Geodetic(0.0, math.pi - 1e-6, 0.0)
    assert to_local(Geodetic(0.0, -math.pi + 1e-6, 0.0), dateline)[1] == pytest.approx(2e-6 * 6_378_137.0, rel=1e-6)


def test_the_atmosphere_is_the_standard_one() -> None:
    assert pressure_at(0.0) == pytest.approx(101_325.0)
    assert pressure_at(1000.0) == pytest.approx(89_874.6, rel=1e-4)  # ICAO table
    assert altitude_of(pressure_at(432.1)) == pytest.approx(432.1, abs=1e-6)


def test_the_barometer_is_noisy_at_once_and_drifts_slowly() -> None:
    quiet = Barometer(np.random.default_rng(3), 0.0, 0.5)
    seen = np.array([quiet.measure(0, 100.0, 0.04).altitude for _ in range(2500)])
    assert float(np.abs(np.diff(seen)).max()) < 0.05
    noisy = Barometer(np.random.default_rng(4), 0.2, 0.0)
    seen = np.array([noisy.measure(0, 100.0, 0.04).altitude for _ in range(2500)])
    assert float(seen.std()) == pytest.approx(0.2, rel=0.06)


def test_the_magnetometer_sees_the_field_turned_into_the_body() -> None:
    turn = Rotation.from_euler("ZYX", [40.0, -20.0, 10.0], degrees=True)
    x, y, z, w = turn.as_quat()
    sample = Magnetometer(np.random.default_rng(1), 0.0).measure(5, np.array([w, x, y, z]))
    np.testing.assert_allclose(turn.apply(sample.field_b), field_n(), atol=1e-12)


def test_an_imu_at_rest_feels_its_weight_and_clips_what_is_too_fast() -> None:
    imu = np.zeros(1, IMU)
    x = np.zeros(17)
    x[6] = 1.0
    integrate_imu(x, x, 9.80665, 0.001, imu[0], np.zeros(6), 0)
    np.testing.assert_allclose(imu["accel_sum"][0], [0.0, 0.0, -9.80665])
    x[10] = 100.0
    read_gyro(x, imu[0], np.zeros(6), 0)
    assert imu["gyro_sample"][0, 0] == GYRO_RANGE
