"""The estimator: sensors meet the filter in the past, where the latest of them can still be in time.

Theory of operation. GPS arrives 110 ms after it was true. The filter therefore runs on a horizon that lies that far
behind the newest IMU sample: IMU samples wait in a ring, others wait until the horizon reaches the time they were true.
An output predictor (`predictor`) carries the result to now, at the IMU's rate and inside the compiled tick, which has
seen the filter of the tick before (PX4's EKF2 has the same structure). The filter takes three IMU samples at once
(`predict_us`), and what was true between two of its steps is moved to the later one with the velocity there. Before
that, on the ground and at rest, `alignment` finds the start.

Height. The barometer alone gives it, so what its zero was wrong by at the start and what it has drifted since go into
the height whole, and no other sensor can tell. The filter's own variance knows white noise only; the two others are
considered, not estimated (Schmidt's consider states, in the limit of a drift much slower than the filter follows):

    var(z) = P_zz + R_baro / n + sigma_d^2 (1 - exp(-2 t / tau_d)),      n samples in the zero, t since then

is what `Estimate` reports. Gates need neither: the innovation compares two heights that share both errors.

When sensors fail (`aiding` has the rules). Without the barometer the height is GPS's, less what the two last differed
by. Without GPS the velocity leans on the rotors' drag and the last known wind (`wind`), or on standing still, and
position drifts as that is wrong. A fix after a silence, and a sensor refused for `reset_after_us`, are believed
whatever they say; the jump this makes goes to the output at once and is told in `resets`, so that the loops can tell it
from motion.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtri

from fakevehicle.estimator import measurements
from fakevehicle.estimator.aiding import RESETTLE_US, Aid
from fakevehicle.estimator.alignment import Alignment, Start
from fakevehicle.estimator.eskf import ErrorStateFilter, Fusion
from fakevehicle.estimator.measurements import Measurement
from fakevehicle.estimator.predictor import PREDICTOR, SPARE
from fakevehicle.estimator.settings import EstimatorConfig
from fakevehicle.estimator.strapdown import dip_and_strength, shift_output
from fakevehicle.estimator.wind import WindWatch
from fakevehicle.geodesy import to_local
from fakevehicle.vocabulary import BaroSample, Estimate, FloatArray, Geodetic, GpsSample, MagSample, Resets, Wind

MOST_WAITING = 64
"""Samples that may wait for the horizon; the oldest goes first."""
UNAIDED_US = 400_000
"""The airspeed helps when GPS has not been accepted for this long [us]."""
DRAG_US = 200_000
"""Spacing of airspeeds [us]."""
DIFFERENCE_SHARE = 0.01
"""Of a new difference between GPS's height and the filter's in their mean."""
FIELD_TOLERANCE, FIELD_SHARE = 0.1, 0.05
"""A field whose mean strength or dip is wrong by this share of the whole is disturbed and never turns the vehicle by a
reset; share of a new sample in the mean."""
SETTLE_US = 2_000_000
"""After a reset the first fixes still correct it by much; for this long they do it as a part of the jump [us]."""
HANDOVER_US = 300_000
"""GPS's height takes over when the barometer has not been accepted for this long [us]."""
STANDING_RATE, STANDING_FORCE, STANDING_SPEED = 0.1, 1.0, 0.1
"""An IMU that turns slower [rad/s] and feels its weight to within this [m/s^2] stands; 1 sigma of its speed [m/s]."""
_NONE: frozenset[str] = frozenset()
_HORIZONTAL, _DOWN, _VELOCITY, _YAW = (6, 7), (8,), (3, 4, 5), (2,)


@dataclass(frozen=True, slots=True)
class Validity:
    """Which quantities can be relied on."""

    attitude: bool
    velocity: bool
    position: bool
    altitude: bool
    climb: bool  # the vertical part of the velocity
    gps: bool  # sensors whose word has been accepted lately
    baro: bool
    mag: bool
    imu: bool


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
    resets : jumps so far, and the newest one.
    config : noises and time constants there are now.
    heard : takes every sample that arrives, for a recording; None: nobody wants them.
    flying : whether the motors carry it; set by the vehicle. Drag is felt and dead sensors are told only then.
    horizon_us : the time at which the filter's nominal state and covariance are true [us].
    """

    def __init__(self, config: EstimatorConfig, field_n: FloatArray, gravity: float, period_us: int) -> None:
        self._gravity, self._field_n = gravity, field_n
        self._period_us, self._dt = period_us, period_us * 1e-6
        self._lag = max(1, round(config.gps_delay_us / period_us))
        self._every = min(max(1, config.predict_us // period_us), SPARE + 1)
        self._lag_us = self._lag * period_us
        self.horizon_us = 0
        self._rows = self._lag + 1 + SPARE
        self.predictor = np.zeros(1, PREDICTOR)
        self.imu: FloatArray = np.zeros((self._rows, 6))
        self.ring: FloatArray = np.zeros((self._rows, 10))
        self._row, self._ticks = 0, 0  # the row the compiled tick wrote last, as `predictor.newest`
        self._waiting: list[tuple[int, int, GpsSample | BaroSample | MagSample]] = []
        self._arrivals = 0
        self.out: FloatArray = self.predictor["out"][0]
        self.out[6] = 1.0
        self.bias: FloatArray = self.predictor["nominal"][0, 10:16]
        self.filter: ErrorStateFilter | None = None
        self.origin: Geodetic | None = None
        self.fusions: dict[str, Fusion] = {}
        self.resets = Resets()
        self._reset_us = self._told_us = -1
        self.flying = False
        self._aids = {name: Aid() for name in ("gps_position", "gps_velocity", "gps_height", "baro", "mag", "imu")}
        self._settled = False
        self._alignment = Alignment(field_n, period_us)
        self._height_zero = 0.0
        self._zero_samples, self._zero_us = 1, 0
        self._difference = 0.0  # GPS's z less the filter's
        self._differences = 0
        self._true_dip, self._true_strength = float(field_n[2]), math.sqrt(float(field_n @ field_n))  # [gauss]
        self._dip, self._strength = self._true_dip, self._true_strength  # running means of what is measured
        self._wind = WindWatch()
        self._drag_us, self._leaned = 0, 0
        self._delay_us = config.gps_delay_us
        self.heard: list[GpsSample | BaroSample | MagSample] | None = None
        self.configure(config)

    def configure(self, config: EstimatorConfig) -> None:
        """Take new noises and time constants; a new delay or period counts from the next start only."""
        self._config = config
        self._noise = np.array([config.gyro_noise, config.accel_noise, config.gyro_walk, config.accel_walk])
        self._gate = {dof: float(chdtri(dof, 1.0 - config.gate_probability)) for dof in (1, 2, 3)}
        step = self._every * self._dt
        attitude = min(1.0, 2.0 * step / (config.tau_position + config.tau_velocity))
        self.predictor["shares"] = min(1.0, step / config.tau_position), min(1.0, step / config.tau_velocity), attitude

    @property
    def config(self) -> EstimatorConfig:
        return self._config

    @property
    def newest(self) -> FloatArray:
        """The IMU sample (6,) of the newest step; a view."""
        sample: FloatArray = self.imu[self._row]
        return sample

    def add(self, sample: GpsSample | BaroSample | MagSample) -> None:
        """Take in a sample that has just arrived; it is fused when the horizon reaches the time it was true."""
        if self.heard is not None:
            self.heard.append(sample)
        if self.filter is None:
            self._collect(sample)
            return
        true_us = sample.now_us - self._delay_us if isinstance(sample, GpsSample) else sample.now_us
        if len(self._waiting) >= MOST_WAITING:
            self._waiting.pop(0)
        self._waiting.append((true_us, self._arrivals, sample))
        self._waiting.sort(key=lambda entry: entry[:2])
        self._arrivals += 1

    def _collect(self, sample: GpsSample | BaroSample | MagSample) -> None:
        if isinstance(sample, BaroSample):
            self._alignment.heights.append(sample.altitude)
        elif isinstance(sample, MagSample):
            self._alignment.fields.append(sample.field_b)
        elif sample.fix_type >= 3:
            self._alignment.fixes.append(sample.position)

    def step(self, now_us: int) -> None:
        """Note an IMU sample, the one of `now_us` that is in the ring; every `predict_us` move the filter on."""
        self._row = self._row + 1 if self._row + 1 < self._rows else 0
        filter_ = self.filter
        if filter_ is None:
            start = self._alignment.step(self.imu[self._row])
            if start is not None:
                self._begin(start, now_us)
            return
        self._ticks += 1
        if self._ticks % self._every:
            return
        horizon = self._row - self._lag
        filter_.carry(self.imu, (horizon - self._every + 1) % self._rows, self._every, self._dt, self._noise)
        self.horizon_us = horizon_us = now_us - self._lag_us
        if self._waiting and self._waiting[0][0] <= horizon_us:
            self._fuse_due(horizon_us, now_us)
        if horizon_us - self._drag_us >= DRAG_US:
            self._drag_us = horizon_us
            if self.flying:
                self._lean_on_drag(now_us)
                self._watch_imu(now_us)
            else:
                self._stand(now_us)
        predictor = self.predictor[0]
        predictor["horizon"], predictor["moved"] = horizon % self._rows, 1

    def _watch_imu(self, now_us: int) -> None:
        """In flight an IMU that says the same as its last sample and the one before is dead."""
        newest, before = self.imu[self._row], self.imu[self._row - 1]
        if not ((newest[:3] == before[:3]).all() or (newest[3:] == before[3:]).all()):
            self._aids["imu"].accept(now_us)

    # What the sensors say

    def _fuse_due(self, horizon_us: int, now_us: int) -> None:
        """Fuse what has been waiting for the horizon; what is of one moment goes in together."""
        assert self.filter is not None
        group: list[Measurement] = []
        group_us = self._waiting[0][0]
        while self._waiting and self._waiting[0][0] <= horizon_us:
            true_us, _, sample = self._waiting.pop(0)
            if true_us != group_us and group:
                self._take(group, now_us)
                group = []
            group_us = true_us
            if isinstance(sample, GpsSample):
                group += self._gps(sample, (horizon_us - true_us) * 1e-6, now_us)
            elif isinstance(sample, BaroSample):
                group += self._baro(sample, now_us)
            else:
                group += self._mag(sample, now_us)
        if group:
            self._take(group, now_us)

    def _take(self, group: list[Measurement], now_us: int) -> None:
        """Take measurements of one moment in; soon after a reset what they correct is still part of the jump."""
        assert self.filter is not None
        settling = self.resets.count > 0 and now_us - self._reset_us < SETTLE_US
        before = self.filter.nominal[0:6].copy() if settling else None
        self.filter.take(group)
        if before is not None:
            self._jumped(self.filter.nominal[0:6] - before, 0.0, self.resets.count, now_us)

    def _gps(self, fix: GpsSample, late_s: float, now_us: int) -> list[Measurement]:
        """The parts of a fix that are to be taken in; it was true `late_s` before the horizon and is moved there."""
        if fix.fix_type < 3 or self.origin is None or self._dead("gps_velocity", fix.velocity_n.tobytes(), now_us):
            return []
        assert self.filter is not None
        config, nominal = self._config, self.filter.nominal
        velocity = fix.velocity_n + late_s * self.filter.felt[3:6]
        place = to_local(fix.position, self.origin) + late_s * nominal[3:6]
        returns = self._aids["gps_velocity"].returns(now_us)
        fast = self._weigh(
            lambda: measurements.gps_velocity(nominal, velocity, config.gps_velocity), _VELOCITY, now_us, returns
        )
        near = self._weigh(
            lambda: measurements.gps_position(nominal, place, config.gps_position), _HORIZONTAL, now_us, returns
        )
        taken = fast + near
        aid = self._aids["gps_position"]
        self._settled = self._settled or (aid.fresh(now_us) and now_us - aid.since_us >= config.gps_settling_us)
        heard = self._aids["baro"].accepted_us
        if heard is not None and now_us - heard < HANDOVER_US:
            self._differences += 1
            share = max(DIFFERENCE_SHARE, 1.0 / self._differences)
            self._difference += share * (float(place[2] - nominal[2]) - self._difference)
        elif self._differences:
            z = float(place[2]) - self._difference
            taken += self._weigh(lambda: measurements.gps_height(nominal, z, config.gps_position), _DOWN, now_us)
        if fast and self.flying and config.drag > 0.0:
            self._wind.note(nominal, self.filter.felt, config.drag)
        return taken

    def _baro(self, sample: BaroSample, now_us: int) -> list[Measurement]:
        if self._dead("baro", np.float64(sample.altitude).tobytes(), now_us):
            return []
        assert self.filter is not None
        nominal, height = self.filter.nominal, sample.altitude - self._height_zero
        return self._weigh(lambda: measurements.baro(nominal, height, self._config.baro), _DOWN, now_us)

    def _mag(self, sample: MagSample, now_us: int) -> list[Measurement]:
        if self._dead("mag", sample.field_b.tobytes(), now_us):
            return []
        assert self.filter is not None
        nominal, field_b = self.filter.nominal, sample.field_b
        dip, strength = dip_and_strength(nominal, field_b)
        self._dip += FIELD_SHARE * (dip - self._dip)
        self._strength += FIELD_SHARE * (strength - self._strength)
        wrong = max(abs(self._strength - self._true_strength), abs(self._dip - self._true_dip))
        clean = wrong < FIELD_TOLERANCE * self._true_strength
        return self._weigh(
            lambda: measurements.magnetometer(nominal, sample.field_b, self._field_n, self._config.mag),
            _YAW if clean else (),
            now_us,
        )

    def _dead(self, name: str, word: bytes, now_us: int) -> bool:
        """Whether a sensor keeps saying the same; on the ground, without noise, it may."""
        return self._aids[name].stuck(word, now_us) and self.flying

    def _weigh(
        self, measure: Callable[[], Measurement], states: tuple[int, ...], now_us: int, returns: bool = False
    ) -> list[Measurement]:
        """The measurement when it passes its gate; one that must be believed is taken at once, and none is left.

        `states` are those that a reset makes anew; empty: there is no reset by this sensor.
        """
        assert self.filter is not None
        measurement = measure()
        fusion = self.filter.weigh(measurement, self._gate[len(measurement.innovation)])
        self.fusions[fusion.sensor] = fusion
        aid = self._aids[fusion.sensor]
        overdue = bool(states) and aid.overdue(now_us, self._config.reset_after_us)
        if returns or overdue:
            self._believe(measurement, states if overdue or not fusion.accepted else (), now_us)
            aid.accept(now_us)
            return []
        if fusion.accepted:
            aid.accept(now_us)
            return [measurement]
        aid.refuse(now_us)
        return []

    def _believe(self, measurement: Measurement, anew: tuple[int, ...], now_us: int) -> None:
        """Take a measurement in whatever it says, move the output with it at once, and tell."""
        assert self.filter is not None
        nominal = self.filter.nominal
        before = nominal.copy()
        if anew:
            size = float(np.abs(measurement.innovation).max())
            self.filter.forget(anew, math.pi if anew == _YAW else 10.0 * max(size, math.sqrt(measurement.R[0, 0])))
        self.filter.take([measurement])
        turned = math.remainder(_yaw(nominal[6:10]) - _yaw(before[6:10]), 2.0 * math.pi) if anew == _YAW else 0.0
        count = self.resets.count + (self._reset_us != now_us)  # a fix is two measurements and one jump
        self._reset_us = now_us
        self._jumped(nominal[0:6] - before[0:6], turned, count, now_us)

    def _jumped(self, delta: FloatArray, turned: float, count: int, now_us: int) -> None:
        """Move the output by a jump of position and velocity (6,) and yaw, and tell of all jumps of this step."""
        moved, gained, told = delta[0:3], delta[3:6], self.resets
        shift_output(self.out, self.ring, moved, gained, turned)
        if self._told_us == now_us:
            moved, gained = moved + told.delta_position_n, gained + told.delta_velocity_n
            turned += told.delta_yaw
        self.resets = Resets(count, moved, gained, turned)
        self._told_us = now_us

    def _lean_on_drag(self, now_us: int) -> None:
        """Without GPS, hold the velocity by the airspeed and the wind there was."""
        accepted = self._aids["gps_velocity"].accepted_us
        if accepted is None or now_us - accepted < UNAIDED_US or not self._wind.known or self._config.drag == 0.0:
            self._leaned = 0
            return
        self._leaned += 1
        assert self.filter is not None
        f, wind = self.filter, self._wind
        f.take([measurements.drag(f.nominal, f.felt, wind.wind_n, self._config.drag, wind.sigma(self._leaned))])

    def _stand(self, now_us: int) -> None:
        """Without GPS, with motors that carry nothing and an IMU that feels its weight only: it stands."""
        if self._aids["gps_velocity"].fresh(now_us):
            return
        assert self.filter is not None
        sample = self.imu[self._row]
        turning, felt = math.hypot(*sample[:3].tolist()), math.hypot(*sample[3:].tolist())
        if turning > STANDING_RATE or abs(felt - self._gravity) > STANDING_FORCE:
            return
        still = measurements.gps_velocity(self.filter.nominal, np.zeros(3), STANDING_SPEED)
        if not self.filter.weigh(still, self._gate[3]).accepted:
            self.filter.forget(_VELOCITY, 1.0)
        self.filter.take([still])

    # Start

    def _begin(self, start: Start, now_us: int) -> None:
        nominal = np.zeros(16)
        nominal[6:10] = start.q_nb
        config = self._config
        tilt = math.hypot(config.accel_bias / self._gravity, 0.005)
        heading = 3.0 * config.mag / math.hypot(self._field_n[0], self._field_n[1]) / math.sqrt(start.mag_samples)
        place = config.gps_position / math.sqrt(start.fixes)
        sigma = np.repeat([tilt, 0.1, place, config.gyro_bias, config.accel_bias], 3)
        sigma[2], sigma[8] = heading, config.baro
        self.filter = ErrorStateFilter(nominal, sigma, self._gravity)
        shared = self.predictor["nominal"][0]
        shared[:] = nominal
        self.filter.nominal = shared  # from now on the compiled tick sees it move
        self.predictor["running"] = 1
        self.out[:10] = nominal[:10]
        self.ring[:] = self.out[:10]
        self.imu[:] = self.imu[self._row]
        self.origin = start.origin
        self._height_zero, self._zero_samples, self._zero_us = start.height_zero, start.zero_samples, now_us

    # What is believed

    def _height_variance(self, now_us: int) -> float:
        """What the barometer's zero and drift add to the variance of the height [m^2]."""
        config = self._config
        age = (now_us - self._zero_us) * 1e-6
        drifted = config.baro_drift**2 * -math.expm1(-2.0 * age / config.baro_drift_time)
        return config.baro**2 / self._zero_samples + drifted

    @property
    def wind(self) -> Wind | None:
        """The mean wind as it is known; None before it is."""
        if self.filter is None or self._config.drag == 0.0:
            return None
        bias = self.filter.P[12, 12] + self.filter.P[13, 13]
        return self._wind.told(math.sqrt(max(float(bias), 0.0)) / self._config.drag)

    def validity(self, now_us: int) -> Validity:
        """Which quantities can be relied on now; cheap enough for every look."""
        if self.filter is None:
            return Validity(*(False,) * 9)
        P, aids = self.filter.P, self._aids
        gps, since = aids["gps_position"].fresh(now_us), now_us - aids["gps_position"].since_us
        fast, baro = aids["gps_velocity"].fresh(now_us), aids["baro"].fresh(now_us)
        settled = since >= (RESETTLE_US if self._settled else self._config.gps_settling_us)
        height = baro or aids["gps_height"].fresh(now_us)
        imu = not self.flying or aids["imu"].accepted_us is None or now_us - aids["imu"].accepted_us < 2 * DRAG_US
        return Validity(
            attitude=bool(imu and max(P[0, 0], P[1, 1], P[2, 2]) < 0.3**2),
            velocity=bool(fast and max(P[3, 3], P[4, 4], P[5, 5]) < 1.0),
            position=bool(gps and settled and max(P[6, 6], P[7, 7]) < 3.0**2),
            altitude=bool(height and P[8, 8] + self._height_variance(now_us) < 3.0**2),
            climb=bool((height or fast) and P[5, 5] < 1.0),
            gps=gps,
            baro=baro,
            mag=aids["mag"].fresh(now_us),
            imu=imu,
        )

    def estimate(self, now_us: int) -> Estimate:
        """What is believed at the newest IMU sample; the arrays are copies.

        The covariance is the filter's, with the barometer's zero and drift added to the height's variance.
        """
        out, valid = self.out, self.validity(now_us)
        if self.filter is not None:
            P = self.filter.P.copy()
            P[8, 8] += self._height_variance(now_us)
        else:
            P = np.diag(np.full(15, 1e6))
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
            attitude_valid=valid.attitude,
            velocity_valid=valid.velocity,
            position_valid=valid.position,
            altitude_valid=valid.altitude,
            origin=self.origin,
            resets=self.resets,
            climb_valid=valid.climb,
            silent=_NONE
            if self.filter is None
            else frozenset(name for name in ("gps", "baro", "mag", "imu") if not getattr(valid, name)),
        )


def _yaw(q_nb: FloatArray) -> float:
    w, x, y, z = q_nb.tolist()
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
