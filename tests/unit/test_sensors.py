"""Each sensor: unbiased where it should be, as noisy as it says, late by what it says, true without noise."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fakevehicle.battery import Battery, Pack
from fakevehicle.faults import Channel, FaultSchedule, Sensor, parse_fault
from fakevehicle.geodesy import to_geodetic, to_local
from fakevehicle.sensors.barometer import Barometer, altitude_of, pressure_at
from fakevehicle.sensors.gauge import Gauge
from fakevehicle.sensors.gps import GpsReceiver
from fakevehicle.sensors.imu import GYRO_RANGE, IMU, integrate_imu, read_gyro
from fakevehicle.sensors.magnetometer import Magnetometer, field_n
from fakevehicle.sensors.obstacles import MAXIMUM, MOST_NEAR, SECTORS, ObstacleSensor, World
from fakevehicle.sensors.rangefinder import Rangefinder
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


def test_hard_iron_turns_with_the_body_and_declination_with_the_place() -> None:
    magnetometer = Magnetometer(np.random.default_rng(1), 0.0)
    magnetometer.hard_iron_b = np.array([0.1, -0.05, 0.02])
    magnetometer.field_n = field_n(math.radians(20.0), math.radians(50.0))
    level = np.array([1.0, 0.0, 0.0, 0.0])
    seen = magnetometer.measure(0, level).field_b - magnetometer.hard_iron_b
    assert math.degrees(math.atan2(seen[1], seen[0])) == pytest.approx(20.0)
    assert math.degrees(math.atan2(seen[2], math.hypot(seen[0], seen[1]))) == pytest.approx(50.0)
    assert float(np.linalg.norm(seen)) == pytest.approx(0.484)


def fixes(gps: GpsReceiver, seconds: float) -> list[tuple[float, FloatArray, int]]:
    out = []
    for k in range(round(10 * seconds)):
        gps.measure(100_000 * k, np.zeros(3), np.zeros(3))
        fix = gps.arrived(100_000 * k + gps.delay_us)
        assert fix is not None
        out.append((0.1 * k, to_local(fix.position, HOME), fix.fix_type))
    return out


def test_a_receiver_loses_the_share_of_fixes_it_is_asked_to() -> None:
    gps = GpsReceiver(HOME, np.random.default_rng(5), 4000, 0.3, 0.05)
    gps.lost = 0.3
    lost = [kind != 3 for _, _, kind in fixes(gps, 400.0)]
    assert float(np.mean(lost)) == pytest.approx(0.3, abs=0.03)


def test_glitches_are_as_large_as_asked_last_five_seconds_and_come_as_often() -> None:
    gps = GpsReceiver(HOME, np.random.default_rng(6), 4000, 0.0, 0.05)
    gps.glitch, gps.glitch_every_s = 20.0, 50.0
    off = np.array([math.hypot(*place[:2]) for _, place, _ in fixes(gps, 4000.0)])
    glitching = off > 1e-3
    np.testing.assert_allclose(off[glitching], 20.0, atol=1e-3)
    starts = int(np.sum(glitching[1:] & ~glitching[:-1]))
    assert 50 < starts < 95  # 4000 s / (50 + 5) = 73
    assert float(glitching.sum()) / 10.0 / starts == pytest.approx(5.0, abs=0.6)


def test_the_white_noise_of_a_receiver_is_the_same_with_a_wander_added() -> None:
    plain, wandering = (GpsReceiver(HOME, np.random.default_rng(7), 4000, 0.3, 0.05) for _ in range(2))
    wandering.wander = 2.0
    apart = np.array([b[1] - a[1] for a, b in zip(fixes(plain, 600.0), fixes(wandering, 600.0), strict=True)])
    assert float(np.abs(np.diff(apart, axis=0)).max()) < 1.0  # slow
    assert 0.8 < float(apart[:, :2].std()) < 3.5


SOLIDS = World(
    boxes=np.array([[3.0, -1.0, -4.0, 5.0, 2.0, 0.0], [-6.0, -6.0, -1.0, -5.0, -5.0, 0.0]]),
    spheres=np.array([[0.0, 5.0, -2.0, 1.5]]),
    cylinders=np.array([[-4.0, 1.0, 0.7, -6.0, -1.0]]),
)


def distance_to_solids(p: FloatArray) -> float:
    """Signed distance from a point to the nearest of SOLIDS, by their definitions."""
    out = [float(np.linalg.norm(p - s[:3])) - s[3] for s in SOLIDS.spheres]
    for b in SOLIDS.boxes:
        q = np.maximum(b[:3] - p, p - b[3:])
        out.append(float(np.linalg.norm(np.maximum(q, 0.0)) + min(q.max(), 0.0)))
    for c in SOLIDS.cylinders:
        side, end = math.hypot(p[0] - c[0], p[1] - c[1]) - c[2], max(c[3] - p[2], p[2] - c[4])
        out.append(math.hypot(max(side, 0.0), max(end, 0.0)) + min(max(side, end), 0.0))
    return min(out)


def test_a_ray_ends_where_walking_by_the_distance_to_the_solids_ends() -> None:
    rng = np.random.default_rng(8)
    origin = np.array([0.0, 0.0, -2.0])
    directions = rng.standard_normal((400, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    cast = SOLIDS.cast(origin, directions, 12.0)
    hits = 0
    for direction, t in zip(directions, cast, strict=True):
        walked = 0.0
        while walked < 12.0 and (step := distance_to_solids(origin + walked * direction)) > 1e-4:
            walked += step
        if walked >= 12.0:
            assert math.isinf(t)
        else:
            hits += 1
            assert t == pytest.approx(walked, abs=5e-3)
    assert 40 < hits < 390


def test_a_wall_is_met_between_its_ends_and_edges_only_and_within_a_solid_the_distance_is_zero() -> None:
    wall = World(walls=np.array([[4.0, -1.0, 4.0, 1.0, -3.0, 0.0]]))
    ahead, right, up = np.array([[1.0, 0, 0]]), np.array([[0.8, 0.6, 0]]), np.array([[0.8, 0, -0.6]])
    start = np.array([0.0, 0.0, -1.0])
    assert wall.cast(start, ahead, 10.0)[0] == pytest.approx(4.0)
    assert math.isinf(wall.cast(start, right, 10.0)[0])
    assert math.isinf(wall.cast(start, up, 10.0)[0])
    assert math.isinf(wall.cast(start, ahead, 3.0)[0])
    assert SOLIDS.cast(np.array([4.0, 0.0, -2.0]), ahead, 9.0)[0] == 0.0


def test_what_is_near_is_found_by_its_nearest_part_and_limited_to_the_nearest() -> None:
    here = np.array([0.0, 0.0, -2.0])
    near = World(
        boxes=np.array([[9.0, -50.0, -9.0, 99.0, 50.0, 0.0], [11.0, 0.0, -2.0, 12.0, 1.0, -1.0]]),
        spheres=np.array([[0.0, 30.0, -2.0, 21.0], [0.0, 30.0, -2.0, 19.0]]),
        cylinders=np.array([[0.0, 0.0, 1.0, 7.0, 9.0], [0.0, 0.0, 1.0, 9.0, 10.0]]),
        walls=np.array([[9.0, -40.0, 9.0, 40.0, -3.0, 0.0], [9.0, 40.0, 9.0, 60.0, -3.0, 0.0]]),
    ).near(here, 10.0)
    assert [len(rows) for rows in (near.boxes, near.spheres, near.cylinders, near.walls)] == [1, 1, 1, 1]
    assert (near.boxes[0, 0], near.spheres[0, 3], near.cylinders[0, 3], near.walls[0, 1]) == (9.0, 21.0, 7.0, -40.0)
    row = np.arange(1000.0)[:, None]
    crowd = World(boxes=np.hstack([0.01 * row, 0 * row, 0 * row, 0.01 * row + 0.005, 0 * row + 1, 0 * row + 1]))
    kept = crowd.near(np.array([10.0, 0.5, 0.5]), 20.0).boxes
    assert len(kept) == MOST_NEAR
    assert kept[0, 0] == pytest.approx(10.0 - 0.01 * MOST_NEAR, abs=0.02)


def test_a_sensor_that_travels_sees_what_it_comes_near_to() -> None:
    channel = Channel(Sensor.OBSTACLE, FaultSchedule(), np.random.default_rng(0))
    sensor = ObstacleSensor(
        World(boxes=np.array([[100.0, -1.0, -9.0, 101.0, 1.0, 0.0]])), np.random.default_rng(1), channel
    )
    for north in np.arange(0.0, 99.0, 0.7):
        scan = sensor.measure(0, np.array([north, 0.0, -2.0]), np.array([1.0, 0.0, 0.0, 0.0]))
        assert scan is not None
        if 100.0 - north < MAXIMUM - 0.2:
            assert scan.distance[0] == pytest.approx(100.0 - north, abs=0.2)
        else:
            assert math.isnan(scan.distance[0]) or 100.0 - north < MAXIMUM + 0.2


def test_a_world_that_is_no_world_is_refused() -> None:
    with pytest.raises(ValueError, match=r"boxes of shape \(1, 5\)"):
        World(boxes=np.zeros((1, 5)))
    with pytest.raises(ValueError, match="finite"):
        World(spheres=np.full((1, 4), np.nan))


def test_the_obstacle_sensor_sees_ahead_what_is_ahead_whichever_way_it_looks() -> None:
    for yaw_deg, sector in ((0.0, 0), (90.0, 54), (-90.0, 18)):  # the box is north; clockwise from the nose
        half = math.radians(yaw_deg) / 2.0
        sensor = ObstacleSensor(
            World(boxes=np.array([[3.0, -0.1, -9.0, 4.0, 0.1, 0.0]])),
            np.random.default_rng(9),
            Channel(Sensor.OBSTACLE, FaultSchedule(), np.random.default_rng(0)),
        )
        scan = sensor.measure(0, np.array([0.0, 0.0, -2.0]), np.array([math.cos(half), 0.0, 0.0, math.sin(half)]))
        assert scan is not None
        level = scan.distance[:SECTORS]
        assert level[sector] == pytest.approx(3.0, abs=0.15)
        assert int(np.isfinite(level).sum()) == 1
        assert scan.maximum == MAXIMUM


def test_the_rangefinder_tells_the_height_longer_when_tilted_shorter_over_a_roof_and_nothing_out_of_reach() -> None:
    def look(height: float, tilt_deg: float = 0.0, world: World | None = None, fault: str = "gps:off") -> float | None:
        channel = Channel(Sensor.RANGE, FaultSchedule([parse_fault(fault)]), np.random.default_rng(0))
        sensor = Rangefinder(world, 0.2, np.random.default_rng(10), channel)
        half = math.radians(tilt_deg) / 2.0
        q = np.array([math.cos(half), math.sin(half), 0.0, 0.0])
        words = [sensor.measure(0, np.array([0.0, 0.0, 0.2 - height]), q) for _ in range(100)]
        return None if words[0] is None else float(np.mean([w.distance for w in words if w is not None]))

    assert look(3.0) == pytest.approx(3.0, abs=0.01)
    assert look(3.0, 30.0) == pytest.approx(3.0 / math.cos(math.radians(30.0)), abs=0.01)
    assert look(5.0, world=World(boxes=np.array([[-1.0, -1.0, -1.8, 1.0, 1.0, 0.2]]))) == pytest.approx(3.0, abs=0.01)
    assert math.isnan(look(25.0) or 0.0)
    assert look(3.0, fault="range:off") is None


def gauge_reads(fault: str) -> Gauge:
    battery = Battery(Pack(cells=4, capacity=5.0, resistance=0.02, idle_power=8.0, full_power=400.0))
    gauge = Gauge(battery, FaultSchedule([parse_fault(fault)]), np.random.default_rng(1))
    for k in range(100):
        battery.draw(0.4, 0.1)
        gauge.read(100_000 * k)
    true = Gauge(battery, FaultSchedule(), np.random.default_rng(1))
    true.read(0)
    gauge.read(9_900_000)
    assert battery.voltage == true.voltage
    gauge.true = true  # type: ignore[attr-defined]
    return gauge


def test_a_battery_s_monitor_reads_true_low_stuck_or_nothing_and_stays_within_its_registers() -> None:
    healthy, low, stuck, off, wild = (
        gauge_reads(f"{text}") for text in
        ("gps:off", "battery:bias=-2,0,-0.5@5", "battery:stuck@5", "battery:off@5", "battery:bias=1e9")
    )  # fmt: skip
    true = healthy.true  # type: ignore[attr-defined]
    assert (healthy.voltage, healthy.current, healthy.remaining) == (true.voltage, true.current, true.remaining)
    assert low.voltage == pytest.approx(true.voltage - 2.0)
    assert low.remaining == pytest.approx(true.remaining - 0.5)
    assert stuck.remaining > true.remaining
    assert (off.silent, healthy.silent) == (True, False)
    assert off.remaining > true.remaining  # the last there was
    assert wild.voltage < 65.535
    assert abs(wild.current) < 327.67
    assert wild.remaining == 1.0
