"""The flight stack: the vehicle below MAVLink, one tick of 4 ms at a time.

A tick runs the loops, the physics and the IMU in one compiled call (`tick.advance`), then the slower sensors that are
due, then the estimator. The loops see the estimate of the tick before and never truth.

Frames: setpoints and estimates in local NED from the estimator's origin (the first fix); truth in local NED from home,
where the vehicle stands at the start. One seed gives every random number; the same seed and inputs give the same
outputs bit for bit.
"""

import math

import numpy as np

from fakevehicle import tick
from fakevehicle.airframe import GRAVITY, Airframe
from fakevehicle.control import gains
from fakevehicle.control.gains import ControlTables
from fakevehicle.errors import DivergedError
from fakevehicle.estimator.horizon import Estimator, EstimatorConfig
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.physics.dynamics import STATE
from fakevehicle.sensors.barometer import Barometer
from fakevehicle.sensors.gps import GpsReceiver
from fakevehicle.sensors.imu import IMU
from fakevehicle.sensors.magnetometer import Magnetometer, field_n
from fakevehicle.vocabulary import (
    BaroSample,
    ControlStatus,
    Estimate,
    FloatArray,
    Geodetic,
    GpsSample,
    ImuSample,
    MagSample,
    Setpoint,
    Truth,
)

GPS_TICKS, BARO_TICKS, MAG_TICKS = 25, 10, 10
"""Ticks between samples: 10, 25 and 25 Hz."""
GPS_DELAY_TICKS = 28
"""A fix arrives 112 ms after it was true."""
BLOCK = 256
"""Ticks whose random draws are made at once."""

# The filter believes its sensors to be a little worse than the simulated ones are (NIS a little below its mean) and
# their biases to wander a little faster: in a tick 8.0e-7 rad/s where SIM_GYR_WALK gives 6.3e-7, and 8.0e-6 m/s^2 where
# SIM_ACC_WALK gives 6.3e-6 (were it the other way round, long flights would make it ever more certain and ever more
# wrong). The simulated noises are a good receiver's (u-blox M9N: 0.05 m/s) and a MEMS IMU's with some vibration; PX4's
# own defaults (0.015 rad/s, 0.35 m/s^2, 0.5 m, 0.3 m/s) allow for much worse and would let the position wander by twice
# as much.
PARAMETERS: tuple[Parameter, ...] = (
    *gains.PARAMETERS,
    Parameter("EKF2_GYR_NOISE", 0.004, 1e-4, 0.1, "rad/s", "estimator: gyro noise"),
    Parameter("EKF2_ACC_NOISE", 0.09, 0.01, 1.0, "m/s^2", "estimator: accelerometer noise"),
    Parameter("EKF2_GYR_B_NOISE", 2e-4, 0, 0.01, "rad/s^2", "estimator: gyro bias walk"),
    Parameter("EKF2_ACC_B_NOISE", 2e-3, 0, 0.01, "m/s^3", "estimator: accelerometer bias walk"),
    Parameter("EKF2_GBIAS_INIT", 0.01, 0, 0.2, "rad/s", "estimator: gyro bias at the start"),
    Parameter("EKF2_ABIAS_INIT", 0.1, 0, 0.5, "m/s^2", "estimator: accelerometer bias at the start"),
    Parameter("EKF2_GPS_P_NOISE", 0.4, 0.01, 10, "m", "estimator: GPS position noise"),
    Parameter("EKF2_GPS_V_NOISE", 0.06, 0.01, 5, "m/s", "estimator: GPS velocity noise"),
    Parameter("EKF2_BARO_NOISE", 0.25, 0.01, 15, "m", "estimator: barometer noise"),
    Parameter("FT_EKF_BARO_DRFT", 0.1, 0, 5, "m", "estimator: drift of the barometer in the long run"),
    Parameter("FT_EKF_BARO_TAU", 300.0, 1, 10000, "s", "estimator: time in which the barometer's drift forgets"),
    Parameter("EKF2_MAG_NOISE", 0.04, 0.001, 1, "gauss", "estimator: magnetometer noise"),
    Parameter("EKF2_GPS_DELAY", 110.0, 4, 300, "ms", "estimator: age of a fix when it arrives, read at the start"),
    Parameter("EKF2_REQ_GPS_H", 4.0, 0, 30, "s", "estimator: GPS must be good for this long before position is valid"),
    Parameter("EKF2_TAU_POS", 0.25, 0.1, 1, "s", "estimator: time constant of the predicted position"),
    Parameter("EKF2_TAU_VEL", 0.25, 0.1, 1, "s", "estimator: time constant of the predicted velocity"),
    Parameter("FT_EKF_GATE", 0.999, 0.9, 0.999999, "", "estimator: chance of a good measurement to pass its gate"),
    Parameter("SIM_GYR_NOISE", 0.003, 0, 0.1, "rad/s", "simulator: gyro noise of a 250 Hz sample"),
    Parameter("SIM_ACC_NOISE", 0.07, 0, 2, "m/s^2", "simulator: accelerometer noise of a 250 Hz sample"),
    Parameter("SIM_GYR_BIAS", 0.005, 0, 0.05, "rad/s", "simulator: spread of the gyro biases, drawn at the start"),
    Parameter("SIM_ACC_BIAS", 0.05, 0, 0.5, "m/s^2", "simulator: spread of the accelerometer biases"),
    Parameter("SIM_GYR_WALK", 1e-5, 0, 0.01, "rad/s/√s", "simulator: random walk of the gyro biases"),
    Parameter("SIM_ACC_WALK", 1e-4, 0, 0.1, "m/s²/√s", "simulator: random walk of the accelerometer biases"),
    Parameter("SIM_GPS_P_NOISE", 0.35, 0, 10, "m", "simulator: GPS horizontal noise, 1.5 times as much vertically"),
    Parameter("SIM_GPS_V_NOISE", 0.05, 0, 5, "m/s", "simulator: GPS velocity noise, 1.5 times as much vertically"),
    Parameter("SIM_BARO_NOISE", 0.2, 0, 5, "m", "simulator: barometer noise"),
    Parameter("SIM_BARO_DRIFT", 0.1, 0, 5, "m", "simulator: slow drift of the barometer"),
    Parameter("SIM_MAG_NOISE", 0.03, 0, 0.5, "gauss", "simulator: magnetometer noise"),
    Parameter("SIM_WIND_GUST", 0.0, 0, 20, "m/s", "simulator: Dryden turbulence, as the mean wind at 20 ft; 0 is calm"),
)


class FlightStack:
    """Physics, sensors, estimator and loops of one quadrotor.

    Parameters
    ----------
    airframe : its physical numbers.
    parameters : the values of (at least) `PARAMETERS`; read again whenever their version moves.
    home : where it stands at the start.
    heading : its yaw there [rad].
    wind_n : (3,) velocity of the air over ground [m/s].
    seed : of every random number.
    """

    TICK_US = 4_000

    def __init__(
        self,
        *,
        airframe: Airframe,
        parameters: ParameterSet,
        home: Geodetic,
        heading: float,
        wind_n: FloatArray,
        seed: int,
    ) -> None:
        p = parameters
        self._parameters, self._version = parameters, parameters.version
        self._home = home
        imu_seed, gps_seed, baro_seed, mag_seed = np.random.default_rng(seed).spawn(4)
        self._rng = imu_seed
        self._noise: FloatArray = np.zeros((BLOCK, tick.DRAWS))
        self._ticks = 0
        self._body = airframe.record()
        self._x: FloatArray = np.zeros(STATE)
        self._x[6], self._x[9] = math.cos(0.5 * heading), math.sin(0.5 * heading)
        self._work: FloatArray = np.zeros((6, STATE))
        c, s = math.cos(heading), math.sin(heading)
        self._anchor: FloatArray = np.array(airframe.contact_points_b) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        self._wind: FloatArray = np.zeros((3, 3))
        self._wind[0] = self._wind[2] = wind_n
        self._control = ControlTables(airframe, parameters)
        self._control.rest(heading)
        self._imu = np.zeros(1, IMU)
        self._imu["gyro_bias"] = p["SIM_GYR_BIAS"] * self._rng.standard_normal(3)
        self._imu["accel_bias"] = p["SIM_ACC_BIAS"] * self._rng.standard_normal(3)
        self._gps_receiver = GpsReceiver(home, gps_seed, GPS_DELAY_TICKS * self.TICK_US, 0.0, 0.0)
        self._barometer = Barometer(baro_seed, 0.0, 0.0)
        self._magnetometer = Magnetometer(mag_seed, 0.0)
        self._estimator = Estimator(self._estimator_config(), field_n(), GRAVITY, self.TICK_US)
        self._read_sensor_parameters()
        self._gyro_bias: FloatArray = np.zeros(3)
        self._setpoint: FloatArray = np.full(11, np.nan)
        self._setpoint_from: Setpoint | None = None
        self._motors = tick.RESTING
        self._touches = True
        self._now_us = 0
        self._gps: GpsSample | None = None
        self._baro = self._barometer.measure(0, home.altitude, 0.0)
        self._mag = self._magnetometer.measure(0, self._x[6:10])
        self._sums = (self._imu["gyro_sum"][0], self._imu["accel_sum"][0])
        self._imu_sample = ImuSample(0, np.zeros(3), np.array([0.0, 0.0, -GRAVITY]))
        self._estimate: Estimate | None = None
        self._velocity_before: FloatArray = np.zeros(3)

    def tick(self, now_us: int, setpoint: Setpoint | None, armed: bool) -> None:
        """Advance by `TICK_US` to `now_us`.

        Parameters
        ----------
        now_us : time at the end of the tick [us]; every call is one `TICK_US` later than the last.
        setpoint : what to follow, in the estimator's frame; None turns the motors slowly (armed) or not at all.
        armed : whether the motors may turn.

        Raises
        ------
        DivergedError : the state is no longer finite.
        """
        if self._parameters.version != self._version:
            self._reload()
        motors = tick.RESTING if not armed else tick.IDLE if setpoint is None else tick.FLYING
        if motors == tick.FLYING:
            if setpoint is not self._setpoint_from and setpoint is not None:
                self._take(setpoint)
            if self._motors != tick.FLYING:
                self._control.rest(_yaw(self._estimator.out[6:10]))
        row = self._ticks % BLOCK
        if row == 0:
            self._rng.standard_normal(out=self._noise)
        self._velocity_before[:] = self._x[3:6]
        control, estimator = self._control, self._estimator
        self._touches = tick.advance(
            motors,
            self._setpoint,
            estimator.out,
            self._gyro_bias,
            self._noise[row],
            self._x,
            self._work,
            self._anchor,
            self._wind,
            self._turbulence,
            self._body,
            control.gains,
            control.status,
            control.bank.loops,
            control.bank.coefficients,
            control.bank.states,
            self._imu,
        )
        if not math.isfinite(float(self._x[0] + self._x[3] + self._x[6] + self._x[10])):
            raise DivergedError(now_us, "position, velocity, attitude or body rate is not a finite number")
        self._motors, self._now_us, self._estimate = motors, now_us, None
        self._ticks += 1
        self._sense(now_us)
        estimator.step(self._imu_sample)
        self._gyro_bias[:] = estimator.bias[:3]

    def _sense(self, now_us: int) -> None:
        """Read the sensors that are due at the end of this tick, and hand them to the estimator."""
        self._imu_sample = ImuSample(now_us, self._sums[0] / tick.SUBSTEPS, self._sums[1] / tick.SUBSTEPS)
        n = self._ticks
        if n % GPS_TICKS == 0:
            self._gps_receiver.measure(now_us, self._x[0:3], self._x[3:6])
        if n % BARO_TICKS == 3:
            dt = BARO_TICKS * self.TICK_US * 1e-6
            self._baro = self._barometer.measure(now_us, self._home.altitude - float(self._x[2]), dt)
            self._estimator.add(self._baro)
        if n % MAG_TICKS == 7:
            self._mag = self._magnetometer.measure(now_us, self._x[6:10])
            self._estimator.add(self._mag)
        fix = self._gps_receiver.arrived(now_us)
        if fix is not None:
            self._gps = fix
            self._estimator.add(fix)

    def reset_control(self) -> None:
        """Forget the setpoints there were, without a bump of the motors: at a change of mode."""
        if self._motors == tick.FLYING:
            self._control.rebase()
        self._setpoint_from = None

    @property
    def estimate(self) -> Estimate:
        """What the vehicle believes."""
        if self._estimate is None:
            self._estimate = self._estimator.estimate(self._now_us)
        return self._estimate

    @property
    def truth(self) -> Truth:
        """What the physics knows; never for the loops."""
        x = self._x
        return Truth(
            now_us=self._now_us,
            position_n=x[0:3].copy(),
            velocity_n=x[3:6].copy(),
            acceleration_n=(x[3:6] - self._velocity_before) / (self.TICK_US * 1e-6),
            q_nb=x[6:10].copy(),
            omega_b=x[10:13].copy(),
            rotor_speed=x[13:17].copy(),
            wind_n=self._wind[2].copy(),
            on_ground=bool(self._touches),
        )

    @property
    def imu(self) -> ImuSample:
        """Mean of the newest tick."""
        return self._imu_sample

    @property
    def gps(self) -> GpsSample | None:
        """The newest fix; None before the first."""
        return self._gps

    @property
    def baro(self) -> BaroSample:
        """The newest sample."""
        return self._baro

    @property
    def mag(self) -> MagSample:
        """The newest sample."""
        return self._mag

    @property
    def control(self) -> ControlStatus:
        """What the loops did in the newest tick; `thrust` is what they asked for, before the mixer."""
        s, f = self._control.status[0], self._control.status["followed"][0].copy()
        speed_max, speed = float(self._body[0]["speed_max"]), s["command"]
        if self._motors == tick.FLYING:
            thrust = float(s["thrust"] / self._control.gains[0]["thrust_full"])
        else:
            thrust = float(np.sum(speed**2)) / (4.0 * speed_max**2)
        return ControlStatus(
            setpoint=Setpoint(f[0:3], f[3:6], f[6:9], float(f[9]), float(f[10])),
            attitude_setpoint_q_nb=s["q_sp"].copy(),
            rate_setpoint_b=s["rate_sp"].copy(),
            thrust=thrust,
            motor=speed / speed_max,
            saturated=bool(s["saturated"] != 0.0),
        )

    @property
    def estimator(self) -> Estimator:
        """The estimator itself, for those who study it."""
        return self._estimator

    def _take(self, setpoint: Setpoint) -> None:
        s = self._setpoint
        s[0:3], s[3:6], s[6:9] = setpoint.position_n, setpoint.velocity_n, setpoint.acceleration_n
        s[9], s[10] = setpoint.yaw, setpoint.yaw_rate
        s[~np.isfinite(s)] = np.nan  # infinity asks for nothing
        self._setpoint_from = setpoint

    def _reload(self) -> None:
        self._version = self._parameters.version
        self._control.update(self._parameters, at_rest=self._motors == tick.RESTING)
        self._estimator.configure(self._estimator_config())
        self._read_sensor_parameters()

    def _read_sensor_parameters(self) -> None:
        p, imu, dt = self._parameters, self._imu[0], self.TICK_US * 1e-6
        imu["gyro_noise"] = math.sqrt(tick.SUBSTEPS) * p["SIM_GYR_NOISE"]
        imu["accel_noise"] = math.sqrt(tick.SUBSTEPS) * p["SIM_ACC_NOISE"]
        imu["gyro_walk"], imu["accel_walk"] = p["SIM_GYR_WALK"] * math.sqrt(dt), p["SIM_ACC_WALK"] * math.sqrt(dt)
        self._gps_receiver.position_noise = float(p["SIM_GPS_P_NOISE"])
        self._gps_receiver.velocity_noise = float(p["SIM_GPS_V_NOISE"])
        self._barometer.noise, self._barometer.drift = float(p["SIM_BARO_NOISE"]), float(p["SIM_BARO_DRIFT"])
        self._magnetometer.noise = float(p["SIM_MAG_NOISE"])
        self._turbulence = float(p["SIM_WIND_GUST"])

    def _estimator_config(self) -> EstimatorConfig:
        p = self._parameters
        return EstimatorConfig(
            gyro_noise=float(p["EKF2_GYR_NOISE"]),
            accel_noise=float(p["EKF2_ACC_NOISE"]),
            gyro_walk=float(p["EKF2_GYR_B_NOISE"]),
            accel_walk=float(p["EKF2_ACC_B_NOISE"]),
            gyro_bias=float(p["EKF2_GBIAS_INIT"]),
            accel_bias=float(p["EKF2_ABIAS_INIT"]),
            gps_position=float(p["EKF2_GPS_P_NOISE"]),
            gps_velocity=float(p["EKF2_GPS_V_NOISE"]),
            baro=float(p["EKF2_BARO_NOISE"]),
            baro_drift=float(p["FT_EKF_BARO_DRFT"]),
            baro_drift_time=float(p["FT_EKF_BARO_TAU"]),
            mag=float(p["EKF2_MAG_NOISE"]),
            gps_delay_us=round(1000 * p["EKF2_GPS_DELAY"]),
            gps_settling_us=round(1e6 * p["EKF2_REQ_GPS_H"]),
            gate_probability=float(p["FT_EKF_GATE"]),
            tau_position=float(p["EKF2_TAU_POS"]),
            tau_velocity=float(p["EKF2_TAU_VEL"]),
        )


def _yaw(q_nb: FloatArray) -> float:
    w, x, y, z = q_nb.tolist()
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
