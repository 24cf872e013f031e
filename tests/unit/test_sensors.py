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
from fakevehicle.vocabulary import FloatArray, Geodetic

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


def ecef(point: Geodetic) -> FloatArray:
    """Earth-centred coordinates of a point above WGS-84 [m], from the ellipsoid's two axes."""
    a, b = 6_378_137.0, 6_356_752.314_245
    c, s = math.cos(point.latitude), math.sin(point.latitude)
    n = a * a / math.hypot(a * c, b * s)
    return np.array(
        [
            (n + point.altitude) * c * math.cos(point.longitude),
            (n + point.altitude) * c * math.sin(point.longitude),
            (n * (b / a) ** 2 + point.altitude) * s,
        ]
    )


@pytest.mark.parametrize(
    "home", [HOME, Geodetic(math.radians(-33.9), math.radians(151.2), 20.0), Geodetic(0.0, math.pi, 3000.0)]
)
@pytest.mark.parametrize("there", [(200.0, 0.0, 0.0), (0.0, 200.0, 0.0), (-120.0, 90.0, -60.0)])
def test_local_and_geodetic_agree_with_the_ellipsoid_s_cartesian_coordinates(
    home: Geodetic, there: tuple[float, float, float]
) -> None:
    lat, lon = home.latitude, home.longitude
    north = np.array([-math.sin(lat) * math.cos(lon), -math.sin(lat) * math.sin(lon), math.cos(lat)])
    east = np.array([-math.sin(lon), math.cos(lon), 0.0])
    down = -np.array([math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)])
    offset = ecef(to_geodetic(np.array(there), home)) - ecef(home)
    # a tangent plane and a curved earth part by d^2/2R = 3 mm at 200 m
    np.testing.assert_allclose([north @ offset, east @ offset, down @ offset], there, atol=0.006)


def test_a_degree_is_as_long_as_the_tables_say() -> None:
    # WGS-84 at the equator: 110 574 m of latitude, 111 320 m of longitude; at 45 degrees: 111 132 m and 78 847 m
    for latitude, north, east in ((0.0, 110_574.0, 111_320.0), (45.0, 111_132.0, 78_847.0)):
        origin = Geodetic(math.radians(latitude), 0.3, 0.0)
        step = math.radians(0.01)
        assert 100 * to_local(Geodetic(origin.latitude + step, 0.3, 0.0), origin)[0] == pytest.approx(north, abs=1.0)
        assert 100 * to_local(Geodetic(origin.latitude, 0.3 + step, 0.0), origin)[1] == pytest.approx(east, abs=1.0)


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


def test_the_magnetometer_of_a_vehicle_that_looks_east_sees_north_on_its_left_and_the_rest_below() -> None:
    # yaw 90 deg: x_b is east, y_b is south; nose straight down: x_b is down, z_b is south... worked by hand
    north, east, down = 0.21709, 0.01290, 0.43238  # 0.484 G, 63.3 deg down, 3.4 deg east
    half = math.sqrt(0.5)
    magnetometer = Magnetometer(np.random.default_rng(1), 0.0)
    looking_east = magnetometer.measure(0, np.array([half, 0.0, 0.0, half])).field_b
    np.testing.assert_allclose(looking_east, [east, -north, down], atol=2e-5)
    nose_down = magnetometer.measure(0, np.array([half, 0.0, -half, 0.0])).field_b
    np.testing.assert_allclose(nose_down, [down, east, -north], atol=2e-5)


def test_an_imu_at_rest_feels_its_weight_and_clips_what_is_too_fast() -> None:
    imu = np.zeros(1, IMU)
    x = np.zeros(17)
    x[6] = 1.0
    integrate_imu(x, x, 9.80665, 0.001, imu[0], np.zeros(6), 0)
    np.testing.assert_allclose(imu["accel_sum"][0], [0.0, 0.0, -9.80665])
    x[10] = 100.0
    read_gyro(x, imu[0], np.zeros(6), 0)
    assert imu["gyro_sample"][0, 0] == GYRO_RANGE
