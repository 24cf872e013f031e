"""The error-state filter: its algebra against numerical derivatives, its belief against truth."""

import math
from collections import deque

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from fakevehicle.airframe import load_airframe
from fakevehicle.estimator import measurements
from fakevehicle.estimator.eskf import ErrorStateFilter
from fakevehicle.estimator.strapdown import inverse, normalised_innovation_squared, propagate
from fakevehicle.estimator.wind import WindWatch
from fakevehicle.flight import PARAMETERS, FlightStack
from fakevehicle.params import ParameterSet
from fakevehicle.sensors.barometer import Barometer
from fakevehicle.sensors.magnetometer import field_n
from fakevehicle.vocabulary import FloatArray, Geodetic, Setpoint

HOME = Geodetic(math.radians(47.397742), math.radians(8.545594), 488.0)
G = 9.80665
QUIET = np.zeros(4)


def some_state(seed: int) -> FloatArray:
    rng = np.random.default_rng(seed)
    n = rng.standard_normal(16)
    n[6:10] /= np.linalg.norm(n[6:10])
    n[10:13] *= 0.01
    n[13:16] *= 0.1
    return n


def moved(nominal: FloatArray, error: FloatArray) -> FloatArray:
    """The true state that lies `error` from `nominal`, by scipy."""
    out = nominal.copy()
    w, x, y, z = nominal[6:10]
    q = (Rotation.from_quat([x, y, z, w]) * Rotation.from_rotvec(error[0:3])).as_quat()
    out[6:10] = [q[3], q[0], q[1], q[2]]
    out[3:6] += error[3:6]
    out[0:3] += error[6:9]
    out[10:13] += error[9:12]
    out[13:16] += error[12:15]
    return out


def between(a: FloatArray, b: FloatArray) -> FloatArray:
    """The error that leads from `a` to `b`."""
    ra, rb = (Rotation.from_quat([s[7], s[8], s[9], s[6]]) for s in (a, b))
    return np.concatenate(
        [(ra.inv() * rb).as_rotvec(), b[3:6] - a[3:6], b[0:3] - a[0:3], b[10:13] - a[10:13], b[13:16] - a[13:16]]
    )


def felt() -> FloatArray:
    return np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1])


@pytest.mark.parametrize("count", [1, 2])
def test_the_transition_matrix_is_the_derivative_of_the_strapdown(count: int) -> None:
    imu = np.array([[0.8, -0.5, 0.3, 1.0, -2.0, -9.0], [0.7, -0.4, 0.5, 1.5, -1.0, -9.5]])[:count]
    nominal, dt = some_state(1), 0.004
    F, Q = np.eye(15), np.zeros((15, 15))
    carried = nominal.copy()
    propagate(carried, imu, 0, count, dt, G, QUIET, F, Q, felt())
    numeric, h = np.zeros((15, 15)), 1e-5
    for j in range(15):
        ends = []
        for sign in (1.0, -1.0):
            error = np.zeros(15)
            error[j] = sign * h
            other = moved(nominal, error)
            propagate(other, imu, 0, count, dt, G, QUIET, np.eye(15), Q, felt())
            ends.append(between(carried, other))
        numeric[:, j] = (ends[0] - ends[1]) / (2 * h)
    np.testing.assert_allclose(F, numeric, atol=3e-4 * count)  # F leaves out terms of second order in dt


@pytest.mark.parametrize("sensor", ["gps_position", "gps_velocity", "gps_height", "baro", "mag", "drag"])
def test_every_jacobian_is_the_derivative_of_its_measurement(sensor: str) -> None:
    nominal, h = some_state(2), 1e-6

    def measure(state: FloatArray) -> measurements.Measurement:
        if sensor == "gps_position":
            return measurements.gps_position(state, np.zeros(3), 0.5)
        if sensor == "gps_velocity":
            return measurements.gps_velocity(state, np.zeros(3), 0.5)
        if sensor == "gps_height":
            return measurements.gps_height(state, 0.0, 0.5)
        if sensor == "baro":
            return measurements.baro(state, 0.0, 0.5)
        if sensor == "drag":  # what is felt has the believed bias taken off: y is of the state alone
            return measurements.drag(state, np.array([0.2, -0.1]) - state[13:15], np.array([3.0, -1.0, 0.0]), 0.12, 0.5)
        return measurements.magnetometer(state, np.zeros(3), field_n(), 0.05)

    H = measure(nominal).H
    for j in range(15):
        error = np.zeros(15)
        error[j] = h
        # y = z - h(x): with z = 0 the measurement is -y
        slope = -(measure(moved(nominal, error)).innovation - measure(moved(nominal, -error)).innovation) / (2 * h)
        np.testing.assert_allclose(H[:, j], slope, atol=1e-8)


def test_nis_is_the_quadratic_form_of_the_innovation() -> None:
    rng = np.random.default_rng(3)
    A = rng.standard_normal((15, 15))
    P, H, R, y = A @ A.T, rng.standard_normal((3, 15)), np.diag([0.1, 0.2, 0.3]), rng.standard_normal(3)
    direct = float(y @ np.linalg.inv(H @ P @ H.T + R) @ y)
    assert normalised_innovation_squared(P, H, R, y) == pytest.approx(direct, rel=1e-10)


@pytest.mark.parametrize("seed", [6, 7, 8])
def test_a_magnetometer_that_is_right_surprises_nobody(seed: int) -> None:
    state = some_state(seed)
    w, x, y, z = state[6:10]
    seen = Rotation.from_quat([x, y, z, w]).inv().apply(field_n())
    np.testing.assert_allclose(measurements.magnetometer(state, seen, field_n(), 0.05).innovation, 0.0, atol=1e-12)


def test_the_inverse_of_a_covariance_is_numpys() -> None:
    rng = np.random.default_rng(3)
    for m in (1, 2, 3, 5, 6):
        a = rng.standard_normal((m, m))
        S = a @ a.T + 0.1 * np.eye(m)
        np.testing.assert_allclose(inverse(S), np.linalg.inv(S), rtol=1e-9, atol=1e-12)


def test_an_update_moves_the_state_as_the_gain_says_and_keeps_p_symmetric() -> None:
    nominal = some_state(4)
    f = ErrorStateFilter(nominal, np.full(15, 0.3), G)
    z = nominal[:2] + np.array([0.5, -0.2])
    measurement = measurements.gps_position(f.nominal, np.array([*z, 0.0]), 0.4)
    assert f.weigh(measurement, 13.8).accepted
    f.take([measurement])
    share = 0.09 / (0.09 + 0.16)
    np.testing.assert_allclose(f.nominal[:2] - nominal[:2], share * np.array([0.5, -0.2]), rtol=1e-9)
    np.testing.assert_allclose(f.P, f.P.T, atol=0)
    assert f.P[6, 6] == pytest.approx(0.09 * (1 - share))
    assert not f.x.any()


def test_a_wild_measurement_is_refused_and_changes_nothing() -> None:
    f = ErrorStateFilter(some_state(5), np.full(15, 0.1), G)
    before, P = f.nominal.copy(), f.P.copy()
    fusion = f.weigh(measurements.baro(f.nominal, 500.0, 0.2), 10.83)
    assert not fusion.accepted
    assert fusion.nis > 1000
    np.testing.assert_array_equal(f.nominal, before)
    np.testing.assert_array_equal(f.P, P)


NO_DRIFT = {"SIM_BARO_DRIFT": 0.0}


def test_the_filter_believes_itself_as_much_as_it_should_on_the_ground_and_in_flight() -> None:
    stack = FlightStack(
        airframe=load_airframe("x500"),
        parameters=ParameterSet(PARAMETERS, NO_DRIFT),
        home=HOME,
        heading=0.5,
        wind_n=np.array([2.0, 1.0, 0.0]),
        seed=11,
    )
    seen: dict[str, list[float]] = {"gps_position": [], "gps_velocity": [], "baro": [], "mag": []}
    dof = {"gps_position": 2, "gps_velocity": 3, "baro": 1, "mag": 3}
    last: dict[str, object] = {}
    ground = None
    for k in range(1, 10_001):
        t = k * 0.004
        setpoint = None
        if t > 8.0:
            if ground is None:
                ground = stack.estimate.position_n.copy()
            s = min((t - 8.0) / 4.0, 1.0)
            phase = max(t - 14.0, 0.0)
            north, east = 2.0 * math.sin(0.6 * phase), 1.5 * (1 - math.cos(0.6 * phase))
            place = ground + np.array([north, east, -3.0 * s * s * (3 - 2 * s)])
            setpoint = Setpoint(position_n=place, yaw=0.5)
        stack.tick(k * 4000, setpoint, t > 7.0)
        for name, fusion in stack.estimator.fusions.items():
            if fusion is not last.get(name):
                last[name] = fusion
                seen[name].append(fusion.nis)
                assert fusion.dof == dof[name]
    for name, values in seen.items():
        n, m = len(values), dof[name]
        assert n > 350
        mean = float(np.mean(values))
        band = chi2.ppf([0.0005, 0.9995], n * m) / n
        # neighbouring innovations share the filter's slow errors, so a little more than the white band is allowed
        assert band[0] * 0.95 < mean < band[1] * 1.05, (name, mean / m)
        assert float(np.mean(np.array(values) > chi2.ppf(0.95, m))) < 0.09
    truth, estimate = stack.truth, stack.estimate
    assert estimate.position_valid
    assert estimate.origin is not None
    np.testing.assert_allclose(estimate.gyro_bias, stack._imu["gyro_bias"][0], atol=2e-3)
    w, x, y, z = truth.q_nb
    a, b, c, d = estimate.q_nb
    apart = Rotation.from_quat([x, y, z, w]).inv() * Rotation.from_quat([b, c, d, a])
    assert float(apart.magnitude()) < math.radians(2.0)


def test_the_height_s_variance_grows_as_an_unaided_barometer_s_error_does() -> None:
    """The judge is the barometer itself, many times: zero taken over 25 samples, drift watched without noise."""
    stack = FlightStack(
        airframe=load_airframe("x500"),
        parameters=ParameterSet(PARAMETERS),
        home=HOME,
        heading=0.0,
        wind_n=np.zeros(3),
        seed=1,
    )
    for k in range(1, 501):
        stack.tick(k * 4000, None, False)
    filter_ = stack.estimator.filter
    assert filter_ is not None
    for age in (20, 120, 600):
        added = stack.estimator.estimate(1_000_000 + age * 1_000_000).covariance[8, 8] - filter_.P[8, 8]
        wrong = []
        for seed in range(600):
            barometer = Barometer(np.random.default_rng(seed), 0.2, 0.1)
            zero = np.mean([barometer.measure(0, 0.0, 0.04).altitude for _ in range(25)])
            barometer.noise = 0.0
            wrong.append(barometer.measure(0, 0.0, float(age)).altitude - zero)
        assert math.sqrt(added) == pytest.approx(float(np.std(wrong)), rel=0.08)


@pytest.mark.slow
def test_a_long_flight_makes_the_filter_neither_surer_than_it_is_right_nor_more_wrong() -> None:
    """NEES of all fifteen states with the shipped parameters: the reported covariance, at the time of the horizon."""
    nees, heights = [], []
    for seed in (21, 22, 23):
        stack = FlightStack(
            airframe=load_airframe("x500"),
            parameters=ParameterSet(PARAMETERS),
            home=HOME,
            heading=0.5,
            wind_n=np.array([2.0, -1.0, 0.0]),
            seed=seed,
        )
        past: deque[FloatArray] = deque(maxlen=40)
        apart: FloatArray | None = None
        for k in range(1, round(260.0 / 0.004) + 1):
            t = k * 0.004
            phase = max(t - 14.0, 0.0)
            north, east = 4.0 * math.sin(0.5 * phase), 2.0 * math.sin(1.0 * phase)
            setpoint = Setpoint(position_n=np.array([north, east, -3.0]), yaw=0.5 + 0.5 * math.sin(0.4 * phase))
            stack.tick(k * 4000, setpoint if t > 7.0 else None, t > 7.0)
            past.append(stack._x.copy())
            if t < 20.0 or k % 250:
                continue
            estimator = stack.estimator
            truth = past[-1 - (k * 4000 - estimator.horizon_us) // 4000]
            assert estimator.filter is not None
            assert estimator.origin is not None
            if apart is None:  # from home to the origin: the ellipsoid's radii at Zurich's latitude, by hand
                apart = np.array(
                    [
                        (estimator.origin.latitude - HOME.latitude) * (6_370_064.0 + 488.0),
                        (estimator.origin.longitude - HOME.longitude) * (6_389_735.0 + 488.0) * math.cos(HOME.latitude),
                        0.0,
                    ]
                )
            biases = np.concatenate([stack._imu["gyro_bias"][0], stack._imu["accel_bias"][0]])
            actual = np.concatenate([truth[0:3] - apart, truth[3:6], truth[6:10], biases])
            error = between(estimator.filter.nominal, actual)
            covariance = stack.estimate.covariance
            nees.append((t, float(error @ np.linalg.solve(covariance, error))))
            heights.append(float(error[8] ** 2 / covariance[8, 8]))
    late = [value for t, value in nees if t > 200.0]
    early = [value for t, value in nees if t < 80.0]
    # 15 in the mean; the errors of a flight are correlated over seconds, so three flights scatter by a good tenth
    assert 12.0 < float(np.mean(early)) < 18.5
    assert 12.0 < float(np.mean(late)) < 18.5
    assert 0.3 < float(np.mean(heights)) < 1.7


@pytest.mark.parametrize("gust", [0.0, 1.5])
def test_the_wind_is_found_from_drag_and_gps_and_told_no_better_than_gusts_let_it_be(gust: float) -> None:
    """Flights through a wind of known mean, whose gusts forget in 5 s; the mean's error is judged over many."""
    rng, k, apart, told = np.random.default_rng(12), 0.12, [], []
    turn = Rotation.from_euler("ZYX", [40.0, 8.0, -5.0], degrees=True)
    x, y, z, w = turn.as_quat()
    for _ in range(40):
        watch, blowing = WindWatch(), gust * rng.standard_normal(2)
        for _ in range(600):
            keep = math.exp(-0.1 / 5.0)
            blowing = keep * blowing + gust * math.sqrt(1 - keep * keep) * rng.standard_normal(2)
            velocity = np.array([2.0, -1.0, 0.3])
            air_b = turn.inv().apply(velocity - np.array([4.0 + blowing[0], -2.0 + blowing[1], 0.0]))
            nominal = np.zeros(16)
            nominal[3:6], nominal[6:10] = velocity, [w, x, y, z]
            watch.note(nominal, -k * air_b, k)
        apart.append(watch.wind_n[:2] - np.array([4.0, -2.0]))
        told.append(watch.sigma(10_000) / 100.0)  # what is left of 10 000 airspeeds taken together
    wrong = float(np.sqrt(np.mean(np.square(apart))))
    assert wrong < 0.02 if gust == 0.0 else 0.3 < wrong < 0.8
    assert wrong < 1.5 * float(np.mean(told))
