"""The estimator: sensors meet the filter in the past, where the latest of them can still be in time.

Theory of operation. GPS arrives 110 ms after it was true. The filter therefore runs on a horizon that lies that far
behind the newest IMU sample: IMU samples wait in a ring, others wait until the horizon reaches the time they were true.
An output predictor (`predictor`) carries the result to now, at the IMU's rate and inside the compiled tick, which has
seen the filter of the tick before (PX4's EKF2 has the same structure). Before that, on the ground and at rest, one
second of samples gives tilt (accelerometer), yaw (magnetometer) and the barometer's zero, and the first fix gives the
origin.

Height. The barometer alone gives it, so what its zero was wrong by at the start and what it has drifted since go into
the height whole, and no other sensor can tell. The filter's own variance knows white noise only; the two others are
considered, not estimated (Schmidt's consider states, in the limit of a drift much slower than the filter follows):

    var(z) = P_zz + R_baro / n + sigma_d^2 (1 - exp(-2 t / tau_d)),      n samples in the zero, t since then

is what `Estimate` reports. Gates need neither: the innovation compares two heights that share both errors.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtri

from fakevehicle.estimator import measurements
from fakevehicle.estimator.eskf import ErrorStateFilter, Fusion
from fakevehicle.estimator.measurements import Measurement
from fakevehicle.estimator.predictor import PREDICTOR, SPARE
from fakevehicle.geodesy import to_local
from fakevehicle.vocabulary import BaroSample, Estimate, FloatArray, Geodetic, GpsSample, MagSample

ALIGN_US = 1_000_000
"""How long the vehicle must stand before the filter starts [us]."""
STALE_US = 2_000_000
"""A quantity whose sensor has not been accepted for this long is no longer valid [us]."""


@dataclass(frozen=True, slots=True)
class EstimatorConfig:
    """What the estimator takes for true about its sensors; 1 sigma each.

    Attributes
    ----------
    gyro_noise, accel_noise : of one 250 Hz sample [rad/s], [m/s^2].
    gyro_walk, accel_walk : of the biases' rates [rad/s^2], [m/s^3].
    gyro_bias, accel_bias : of the biases at the start [rad/s], [m/s^2].
    gps_position, gps_velocity, baro, mag : [m], [m/s], [m], [gauss].
    baro_drift, baro_drift_time : the barometer's Gauss-Markov drift in the long run [m] and its time constant [s].
    gps_delay_us : age of a fix when it arrives [us].
    gps_settling_us : position is not called valid before GPS has been accepted for this long [us].
    gate_probability : a true measurement passes its gate with this probability.
    tau_position, tau_velocity : time constants of the output predictor [s].
    """

    gyro_noise: float
    accel_noise: float
    gyro_walk: float
    accel_walk: float
    gyro_bias: float
    accel_bias: float
    gps_position: float
    gps_velocity: float
    baro: float
    baro_drift: float
    baro_drift_time: float
    mag: float
    gps_delay_us: int
    gps_settling_us: int
    gate_probability: float
    tau_position: float
    tau_velocity: float


class Estimator:
    """Position, velocity, attitude and IMU biases from samples.

    Parameters
    ----------
    config : noises and delays.
    field_n : (3,) magnetic field at the place [gauss].
    gravity : [m/s^2].
    period_us : spacing of IMU samples [us].

    Attributes
    ----------
    predictor : (1,) of `predictor.PREDICTOR`, and the rings beside it: `imu` (n, 6) of IMU samples, `ring` (n, 10) of
        outputs. The compiled tick writes the newest sample and output; `step` reads the samples at the horizon.
    out : (16,) position, velocity, q_nb, omega_b, acceleration_n at the newest IMU sample; a view.
    bias : (6,) gyro and accelerometer bias at the horizon; a view, zeros before alignment.
    fusions : what became of each sensor's newest measurement.
    """

    def __init__(self, config: EstimatorConfig, field_n: FloatArray, gravity: float, period_us: int) -> None:
        self._gravity, self._field_n = gravity, field_n
        self._period_us, self._dt = period_us, period_us * 1e-6
        self._lag = max(1, round(config.gps_delay_us / period_us))
        rows = self._lag + 1 + SPARE
        self.predictor = np.zeros(1, PREDICTOR)
        self.imu: FloatArray = np.zeros((rows, 6))
        self.ring: FloatArray = np.zeros((rows, 10))
        self._row = rows - 1
        self._waiting: list[tuple[int, int, GpsSample | BaroSample | MagSample]] = []
        self._arrivals = 0
        self.out: FloatArray = self.predictor["out"][0]
        self.out[6] = 1.0
        self.bias: FloatArray = self.predictor["nominal"][0, 10:16]
        self.filter: ErrorStateFilter | None = None
        self.origin: Geodetic | None = None
        self.fusions: dict[str, Fusion] = {}
        self._accepted_us: dict[str, int] = {}
        self._since_us: dict[str, int] = {}
        self._height_zero = 0.0
        self._zero_samples = 1
        self._zero_us = 0
        self._still: list[FloatArray] = []
        self._still_baro: list[float] = []
        self._still_mag: list[FloatArray] = []
        self._delay_us = config.gps_delay_us
        self.configure(config)

    def configure(self, config: EstimatorConfig) -> None:
        """Take new noises and time constants; a new delay counts from the next start only."""
        self._config = config
        self._noise = np.array([config.gyro_noise, config.accel_noise, config.gyro_walk, config.accel_walk])
        self._gate = {dof: float(chdtri(dof, 1.0 - config.gate_probability)) for dof in (1, 2, 3)}
        attitude = min(1.0, 2.0 * self._dt / (config.tau_position + config.tau_velocity))
        self.predictor["shares"] = (
            min(1.0, self._dt / config.tau_position),
            min(1.0, self._dt / config.tau_velocity),
            attitude,
        )

    def add(self, sample: GpsSample | BaroSample | MagSample) -> None:
        """Take in a sample that has just arrived; it is fused when the horizon reaches the time it was true."""
        if isinstance(sample, GpsSample):
            if self.origin is None and sample.fix_type >= 3:
                self.origin = sample.position
            true_us = sample.now_us - self._delay_us
        else:
            true_us = sample.now_us
        if self.filter is None:
            if isinstance(sample, BaroSample):
                self._still_baro.append(sample.altitude)
            elif isinstance(sample, MagSample):
                self._still_mag.append(sample.field_b)
        else:
            self._waiting.append((true_us, self._arrivals, sample))
            self._waiting.sort(key=lambda entry: entry[:2])
            self._arrivals += 1

    def step(self, now_us: int) -> None:
        """Move the filter on by one IMU sample, the one at its horizon; the newest, of `now_us`, is in the ring."""
        rows = len(self.imu)
        self._row = self._row + 1 if self._row + 1 < rows else 0
        if self.filter is None:
            self._align(self.imu[self._row], now_us)
            return
        horizon = self._row - self._lag
        horizon_us = now_us - self._lag * self._period_us
        predictor = self.predictor[0]
        predictor["horizon"], predictor["moved"] = horizon % rows, 1
        self.filter.carry(self.imu[horizon], self._dt, self._noise)
        while self._waiting and self._waiting[0][0] <= horizon_us + self._period_us // 2:
            true_us, _, waiting = self._waiting.pop(0)
            if true_us > horizon_us - self._period_us:
                self._fuse(waiting, now_us)

    def _fuse(self, sample: GpsSample | BaroSample | MagSample, now_us: int) -> None:
        assert self.filter is not None
        nominal, config = self.filter.nominal, self._config
        if isinstance(sample, GpsSample):
            if sample.fix_type < 3 or self.origin is None:
                return
            self._weigh(measurements.gps_velocity(nominal, sample.velocity_n, config.gps_velocity), now_us)
            place = to_local(sample.position, self.origin)
            self._weigh(measurements.gps_position(nominal, place, config.gps_position), now_us)
        elif isinstance(sample, BaroSample):
            self._weigh(measurements.baro(nominal, sample.altitude - self._height_zero, config.baro), now_us)
        else:
            self._weigh(measurements.magnetometer(nominal, sample.field_b, self._field_n, config.mag), now_us)

    def _weigh(self, measurement: Measurement, now_us: int) -> None:
        assert self.filter is not None
        fusion = self.filter.fuse(measurement, self._gate[len(measurement.innovation)])
        self.fusions[fusion.sensor] = fusion
        if fusion.accepted:
            if not self._fresh(fusion.sensor, now_us):
                self._since_us[fusion.sensor] = now_us
            self._accepted_us[fusion.sensor] = now_us

    def _align(self, newest: FloatArray, now_us: int) -> None:
        """Collect a second at rest, then start the filter level, pointing where the magnetometer says."""
        self._still.append(newest.copy())
        enough = len(self._still) * self._period_us >= ALIGN_US
        if not (enough and self.origin and self._still_baro and self._still_mag):
            return
        mean = np.mean(self._still, axis=0)
        up = -mean[3:] / np.linalg.norm(mean[3:])  # specific force at rest is -g e3 seen from b
        roll = math.atan2(up[1], up[2])
        pitch = math.atan2(-up[0], math.hypot(up[1], up[2]))
        cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
        x, y, z = np.mean(self._still_mag, axis=0)
        level_x, level_y = cp * x + sp * (sr * y + cr * z), cr * y - sr * z
        yaw = math.atan2(-level_y, level_x) + math.atan2(self._field_n[1], self._field_n[0])
        cr, sr, cp, sp = math.cos(roll / 2), math.sin(roll / 2), math.cos(pitch / 2), math.sin(pitch / 2)
        cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
        q = [
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ]
        nominal = np.zeros(16)
        nominal[6:10] = q
        config = self._config
        tilt = math.hypot(config.accel_bias / self._gravity, 0.005)
        heading = 3.0 * config.mag / math.hypot(self._field_n[0], self._field_n[1]) / math.sqrt(len(self._still_mag))
        sigma = np.repeat([tilt, 0.1, config.gps_position, config.gyro_bias, config.accel_bias], 3)
        sigma[2], sigma[8] = heading, config.baro
        self.filter = ErrorStateFilter(nominal, sigma, self._gravity)
        self.filter.nominal = self.predictor["nominal"][0]  # where the compiled tick reads it
        self.filter.nominal[:] = nominal
        self.predictor["running"] = 1
        self.out[:10] = nominal[:10]
        self.ring[:] = self.out[:10]
        self.imu[:] = newest
        self._height_zero = float(np.mean(self._still_baro))
        self._zero_samples, self._zero_us = len(self._still_baro), now_us

    def _fresh(self, sensor: str, now_us: int) -> bool:
        accepted = self._accepted_us.get(sensor)
        return accepted is not None and now_us - accepted <= STALE_US

    def _height_variance(self, now_us: int) -> float:
        """What the barometer's zero and drift add to the variance of the height [m^2]."""
        config = self._config
        age = (now_us - self._zero_us) * 1e-6
        drifted = config.baro_drift**2 * -math.expm1(-2.0 * age / config.baro_drift_time)
        return config.baro**2 / self._zero_samples + drifted

    def estimate(self, now_us: int) -> Estimate:
        """What is believed at the newest IMU sample; the arrays are copies.

        The covariance is the filter's, with the barometer's zero and drift added to the height's variance.
        """
        out, aligned = self.out, self.filter is not None
        settled = now_us - self._since_us.get("gps_position", now_us) >= self._config.gps_settling_us
        P = self.filter.P.copy() if self.filter is not None else np.diag(np.full(15, 1e6))
        if aligned:
            P[8, 8] += self._height_variance(now_us)
        sigma = np.sqrt(np.diagonal(P))
        return Estimate(
            now_us=now_us,
            position_n=out[0:3].copy(),
            velocity_n=out[3:6].copy(),
            acceleration_n=out[13:16].copy(),
            q_nb=out[6:10].copy(),
            omega_b=out[10:13].copy(),
            gyro_bias=self.bias[:3].copy(),
            accel_bias=self.bias[3:].copy(),
            covariance=P,
            test_ratio={name: math.sqrt(f.nis / self._gate[f.dof]) for name, f in self.fusions.items()},
            attitude_valid=aligned and float(sigma[:3].max()) < 0.3,
            velocity_valid=aligned and self._fresh("gps_velocity", now_us) and float(sigma[3:6].max()) < 1.0,
            position_valid=aligned
            and settled
            and self._fresh("gps_position", now_us)
            and float(sigma[6:8].max()) < 3.0,
            altitude_valid=aligned and self._fresh("baro", now_us) and float(sigma[8]) < 3.0,
            origin=self.origin,
        )
