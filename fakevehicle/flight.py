"""The flight stack: the vehicle below MAVLink, one tick of 4 ms at a time.

A tick runs the loops, the physics, the IMU and the estimator's output in one compiled call (`tick.advance`), then the
slower sensors that are due, then the filter. The loops see the estimate of the tick before and never truth.

Frames: setpoints and estimates in local NED from the estimator's origin (the first fix); truth in local NED from home,
where the vehicle stands at the start. One seed gives every random number; the same seed and inputs give the same
outputs bit for bit.
"""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from fakevehicle import tick
from fakevehicle.airframe import GRAVITY, Airframe
from fakevehicle.battery import Battery
from fakevehicle.control import gains
from fakevehicle.control.gains import ControlTables
from fakevehicle.errors import DivergedError
from fakevehicle.estimator import settings, terrain
from fakevehicle.estimator.horizon import Estimator
from fakevehicle.estimator.settings import estimator_config
from fakevehicle.estimator.terrain import Terrain
from fakevehicle.faults import Fault, FaultKind, FaultSchedule, Sensor
from fakevehicle.params import Parameter, ParameterSet, ParameterType
from fakevehicle.physics.wind import TURBULENCE, Gust, gust_table
from fakevehicle.sensors import suite
from fakevehicle.sensors.gauge import Gauge
from fakevehicle.sensors.magnetometer import field_n
from fakevehicle.sensors.obstacles import World
from fakevehicle.sensors.suite import Sensors
from fakevehicle.vocabulary import (
    BaroSample,
    ControlStatus,
    Estimate,
    FloatArray,
    Geodetic,
    Glance,
    GpsSample,
    ImuSample,
    MagSample,
    ObstacleScan,
    RangeSample,
    Setpoint,
    Truth,
    Wind,
)

BATTERY_US = 100_000
"""The battery is drawn from this often, and motors break then."""
VALIDITY_US = 40_000
"""How long a glance goes by what it has found to be valid."""
BLOCK = 256
"""Ticks whose random draws are made at once."""

_I = ParameterType.INT32
PARAMETERS: tuple[Parameter, ...] = (
    *gains.PARAMETERS,
    *settings.PARAMETERS,
    *terrain.PARAMETERS,
    *suite.PARAMETERS,
    Parameter("MC_BAT_SCALE_EN", 1, 0, 1, "", "raise the motors' commands as the battery's voltage falls", _I),
    Parameter("SIM_BAT_CAPACITY", 0, 0, 100000, "mAh", "simulator: capacity of the battery, 0 for the airframe's"),
    Parameter("SIM_BAT_SAG", 1, 0, 1, "", "simulator: whether the motors feel the battery's voltage", _I),
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
    faults : of sensors and motors, on a schedule.
    gusts : of the wind, on a schedule.
    world : what rangefinder and obstacle sensor see.

    Attributes
    ----------
    terrain : the ground below, by the rangefinder.
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
        faults: Iterable[Fault] = (),
        gusts: Iterable[Gust] = (),
        world: World | None = None,
    ) -> None:
        p = parameters
        self._parameters, self._version = parameters, parameters.version
        self._faults = FaultSchedule(faults)
        self._gusts = gust_table(tuple(gusts))
        self._rng, *generators, self._gust_rng = np.random.default_rng(seed).spawn(2 + suite.CHILDREN)
        self._noise: FloatArray = np.zeros((BLOCK, tick.DRAWS))
        self._gust_noise: FloatArray = np.zeros((BLOCK, TURBULENCE))
        self._ticks = 0
        whole = np.zeros(1, tick.VEHICLE)
        self._body, self._world, self._imu = whole["body"], whole["world"], whole["imu"]
        self._body[:] = airframe.record()
        self._world[:] = _start(airframe, heading, wind_n)
        self._x: FloatArray = self._world["x"][0]
        self._control = ControlTables(airframe, parameters)
        self._control.rest(heading)
        self._imu["gyro_bias"] = p["SIM_GYR_BIAS"] * self._rng.standard_normal(3)
        self._imu["accel_bias"] = p["SIM_ACC_BIAS"] * self._rng.standard_normal(3)
        self._sensors = Sensors(
            home=home,
            parameters=p,
            generators=generators,
            faults=self._faults,
            world=world,
            period_us=self.TICK_US,
            q_nb=self._x[6:10],
            imu=self._imu,
            ground=float(self._body[0]["ground"]),
        )
        field = field_n(math.radians(p["EKF2_MAG_DECL"]), math.radians(p["SIM_MAG_INCL"]))
        self._estimator = Estimator(estimator_config(p), field, GRAVITY, self.TICK_US)
        self._turbulent = False
        self._resets = self._estimator.resets
        self.terrain = Terrain(p)
        self._range: RangeSample | None = None
        self._battery = Battery(airframe.battery)
        self._gauge = Gauge(self._battery, self._faults, self._gust_rng.spawn(1)[0])
        self._read_own_parameters()
        self._setpoint: FloatArray = self._world["setpoint"][0]
        self._thrust, self._effort = self._world["thrust"], self._world["effort"]
        _share(whole, self._control, self._estimator)
        self._tables = (  # what `tick.advance` works on, all of it for the vehicle's whole life
            self._noise,
            self._gust_noise,
            self._gusts,
            whole.view(np.float64),
            self._estimator.imu,
            self._estimator.ring,
        )
        self._setpoint_from: Setpoint | None = None
        self._motors = tick.RESTING
        self._touches = True
        self._now_us = 0
        self._estimate: Estimate | None = None
        self._glance: Glance | None = None
        self._valid, self._look_again_us = self._estimator.validity(0), 0

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
        if motors == tick.RESTING != self._motors:
            self._control.update(self._parameters, at_rest=True)  # orders that were asked for in flight
        if motors == tick.FLYING:
            if setpoint is not self._setpoint_from and setpoint is not None:
                self._follow(setpoint)
            if self._motors != tick.FLYING:
                self._control.rest(_yaw(self._estimator.out[6:10]))
        row = self._ticks % BLOCK
        if row == 0:
            self._rng.standard_normal(out=self._noise)
            if self._turbulent:
                self._gust_rng.standard_normal(out=self._gust_noise)
        estimator = self._estimator
        flags = tick.advance(motors, now_us * 1e-6, row, *self._tables)
        if flags & tick.DIVERGED:
            raise DivergedError(now_us, "position, velocity, attitude or body rate is not a finite number")
        self._touches = flags != 0
        self._motors, self._now_us = motors, now_us
        self._estimate = self._glance = None
        self._ticks += 1
        self._sensors.sense(self._ticks, now_us, self._x, estimator.add)
        estimator.flying = motors == tick.FLYING
        estimator.step(now_us)
        if estimator.resets is not self._resets:
            self._resets = estimator.resets
            self._control.follow(self._resets)
            self.terrain.moved(float(self._resets.delta_position_n[2]))
        if self._sensors.range is not self._range:
            self._range = self._sensors.range
            if self._range is not None and estimator.filter is not None:
                self.terrain.take(self._range, estimator.out, estimator.flying)
        if now_us % BATTERY_US == 0:
            self._drain(now_us)

    def _drain(self, now_us: int) -> None:
        """Draw what the motors take, let them feel the voltage, and break those whose time has come."""
        battery, body = self._battery, self._body[0]
        battery.draw(float(self._effort[0]), BATTERY_US * 1e-6)
        self._gauge.read(now_us)
        if self._sagging:
            body["sag"] = sag = battery.sag
            body["boost"] = boost = 1.0 / sag if self._boosting else 1.0
            self._control.weaken(boost)
        if self._faults.concerns(Sensor.MOTOR):
            body["effect"] = 1.0
            for fault in self._faults.active(Sensor.MOTOR, now_us):
                body["effect"][fault.index] = 0.0 if fault.kind is FaultKind.OFF else fault.magnitude[0]

    def inject(self, fault: Fault) -> None:
        """Add a fault to the schedule."""
        self._faults.add(fault)

    def mend(self, sensor: Sensor, now_us: int, index: int | None = None) -> None:
        """End every fault of one sensor; of motors that with `index`, or all."""
        self._faults.mend(sensor, now_us, index)

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
    def glance(self) -> Glance:
        """The estimate in a few numbers."""
        if self._glance is not None:
            return self._glance
        estimator = self._estimator
        if self._now_us >= self._look_again_us:
            self._valid, self._look_again_us = estimator.validity(self._now_us), self._now_us + VALIDITY_US
        valid = self._valid
        x, y, z, vx, vy, vz, qw, qx, qy, qz, p, q, r, *_ = estimator.out.tolist()
        glance = self._glance = Glance(
            self._now_us,
            x,
            y,
            z,
            vx,
            vy,
            vz,
            math.atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz)),
            float(self._thrust[0]),
            valid.attitude,
            valid.velocity,
            valid.position,
            valid.altitude,
            estimator.resets.count,
            (qw, qx, qy, qz),
            (p, q, r),
        )
        return glance

    @property
    def origin(self) -> Geodetic | None:
        """Where the estimator's frame begins; None until it knows."""
        return self._estimator.origin

    @property
    def wind(self) -> Wind | None:
        """The wind as the estimator knows it; None before it does."""
        return self._estimator.wind

    @property
    def truth(self) -> Truth:
        """What the physics knows; never for the loops."""
        x = self._x
        return Truth(
            now_us=self._now_us,
            position_n=x[0:3].copy(),
            velocity_n=x[3:6].copy(),
            acceleration_n=(x[3:6] - self._world["velocity_before"][0]) / (self.TICK_US * 1e-6),
            q_nb=x[6:10].copy(),
            omega_b=x[10:13].copy(),
            rotor_speed=x[13:17].copy(),
            wind_n=self._world["wind"][0].copy(),
            on_ground=bool(self._touches),
        )

    @property
    def imu(self) -> ImuSample:
        """Mean of the newest tick."""
        imu = self._imu[0]
        if self._ticks == 0:
            return ImuSample(0, np.zeros(3), np.array([0.0, 0.0, -GRAVITY]))
        return ImuSample(self._now_us, imu["gyro_sum"] / tick.SUBSTEPS, imu["accel_sum"] / tick.SUBSTEPS)

    @property
    def gps(self) -> GpsSample | None:
        """The newest fix; None before the first."""
        return self._sensors.gps

    @property
    def baro(self) -> BaroSample:
        """The newest sample."""
        return self._sensors.baro

    @property
    def mag(self) -> MagSample:
        """The newest sample."""
        return self._sensors.mag

    @property
    def clearance(self) -> float | None:
        """Height above the ground below [m], as the rangefinder tells it; None while it does not."""
        return self.terrain.down - float(self._estimator.out[2]) if self.terrain.valid(self._now_us) else None

    @property
    def range(self) -> RangeSample | None:
        """The newest sample of the rangefinder; None without one."""
        return self._sensors.range

    @property
    def obstacles(self) -> ObstacleScan | None:
        """The newest round of the obstacle sensor; None without one."""
        return self._sensors.obstacles

    @property
    def battery(self) -> Gauge:
        """What the battery's monitor reads."""
        return self._gauge

    @property
    def control(self) -> ControlStatus:
        """What the loops did in the newest tick; `thrust` is what they asked for, before the mixer."""
        s, f = self._control.status[0], self._control.status["followed"][0].copy()
        speed_max, speed = float(self._body[0]["speed_max"]), s["command"]
        return ControlStatus(
            setpoint=Setpoint(f[0:3], f[3:6], f[6:9], float(f[9]), float(f[10])),
            attitude_setpoint_q_nb=s["q_sp"].copy(),
            rate_setpoint_b=s["rate_sp"].copy(),
            thrust=float(self._thrust[0]),
            motor=speed / speed_max,
            saturated=bool(s["saturated"] != 0.0),
        )

    @property
    def now_us(self) -> int:
        """Time of the newest tick [us]."""
        return self._now_us

    @property
    def estimator(self) -> Estimator:
        """The estimator itself, for those who study it."""
        return self._estimator

    def _follow(self, setpoint: Setpoint) -> None:
        s = self._setpoint
        s[0:3], s[3:6], s[6:9] = setpoint.position_n, setpoint.velocity_n, setpoint.acceleration_n
        s[9], s[10] = setpoint.yaw, setpoint.yaw_rate
        s[11:15], s[15:18], s[18] = setpoint.attitude_q_nb, setpoint.rate_b, setpoint.thrust
        self._setpoint_from = setpoint

    def _reload(self) -> None:
        self._version = self._parameters.version
        self._control.update(self._parameters, at_rest=self._motors == tick.RESTING)
        self._estimator.configure(estimator_config(self._parameters))
        self._sensors.configure(self._parameters)
        self.terrain.configure(self._parameters)
        self._read_own_parameters()

    def _read_own_parameters(self) -> None:
        suite.configure_imu(self._imu, self._parameters, tick.SUBSTEPS, self.TICK_US * 1e-6)
        p = self._parameters
        self._sagging, self._boosting = bool(p["SIM_BAT_SAG"]), bool(p["MC_BAT_SCALE_EN"])
        if not self._sagging:
            self._body["sag"], self._body["boost"] = 1.0, 1.0
            self._control.weaken(1.0)
        capacity = p["SIM_BAT_CAPACITY"] or 1000.0 * self._battery.pack.capacity
        self._battery.capacity = 3.6 * float(capacity)
        strength = float(p["SIM_WIND_GUST"])
        self._world["strength"] = strength
        if strength > 0.0 and not self._turbulent:  # the block under way has none for it yet
            self._gust_rng.standard_normal(out=self._gust_noise)
        self._turbulent = strength > 0.0


def _start(airframe: Airframe, heading: float, wind_n: FloatArray) -> np.ndarray[Any, np.dtype[np.void]]:
    """The (1,) record of `tick.WORLD` of a vehicle that stands at its home."""
    world = np.zeros(1, tick.WORLD)
    w = world[0]
    w["x"][6], w["x"][9] = math.cos(0.5 * heading), math.sin(0.5 * heading)
    c, s = math.cos(heading), math.sin(heading)
    w["anchor"] = airframe.record()[0]["contact"] @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    w["setpoint"] = np.nan
    w["steady"] = w["wind"] = wind_n
    speed = math.hypot(wind_n[0], wind_n[1])
    w["along"] = (wind_n[0] / speed, wind_n[1] / speed) if speed > 0.0 else (1.0, 0.0)
    return world


def _share(whole: np.ndarray[Any, np.dtype[np.void]], control: ControlTables, estimator: Estimator) -> None:
    """Move the tables of the loops and of the estimator's output into the (1,) record of `tick.VEHICLE`."""
    bank = control.bank
    whole["gains"], whole["status"], whole["predictor"] = control.gains, control.status, estimator.predictor
    whole["loops"][0], whole["coefficients"][0], whole["states"][0] = bank.loops, bank.coefficients, bank.states
    control.gains, control.status = whole["gains"], whole["status"]
    bank.loops, bank.coefficients, bank.states = whole["loops"][0], whole["coefficients"][0], whole["states"][0]
    estimator.predictor = whole["predictor"]
    estimator.out, estimator.bias = estimator.predictor["out"][0], estimator.predictor["nominal"][0, 10:16]


def _yaw(q_nb: FloatArray) -> float:
    w, x, y, z = q_nb.tolist()
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
