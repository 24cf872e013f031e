"""All sensors but the IMU, which the compiled tick samples itself: when each is due, its parameters and its faults.

The vehicle stands in truth's n, local NED from home. Every sensor draws from a generator of its own, so that one more
sensor moves no other's numbers; so does what is off by default, and every fault.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from fakevehicle.faults import Channel, FaultSchedule, Sensor
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.sensors.barometer import Barometer, pressure_at
from fakevehicle.sensors.gps import GpsReceiver
from fakevehicle.sensors.imu import Instability, Record, set_faults
from fakevehicle.sensors.magnetometer import Magnetometer, field_n
from fakevehicle.sensors.obstacles import ObstacleSensor, World
from fakevehicle.sensors.rangefinder import Rangefinder
from fakevehicle.vocabulary import (
    BaroSample,
    FloatArray,
    Geodetic,
    GpsSample,
    MagSample,
    ObstacleScan,
    RangeSample,
)

GPS_TICKS, BARO_TICKS, RANGE_TICKS, OBSTACLE_TICKS = 25, 10, 12, 25
"""Ticks between samples: GPS 10 Hz, barometer and magnetometer 25, rangefinder 21, obstacle sensor 10."""
_CYCLE = math.lcm(GPS_TICKS, BARO_TICKS, RANGE_TICKS, OBSTACLE_TICKS)
_GPS_DUE, _BARO_DUE, _RANGE_DUE, _OBSTACLE_DUE = 1, 2, 4, 8
_DUE = tuple(
    _GPS_DUE * (n % GPS_TICKS == 0)
    + _BARO_DUE * (n % BARO_TICKS == 3)
    + _RANGE_DUE * (n % RANGE_TICKS == 5)
    + _OBSTACLE_DUE * (n % OBSTACLE_TICKS == 11)
    for n in range(_CYCLE)
)
"""Which sensors are due in a tick, spread so that few share one; then all begins anew."""
CHILDREN = 5
"""Generators a suite draws from: GPS, barometer, magnetometer, rangefinder, obstacle sensor."""

PARAMETERS: tuple[Parameter, ...] = (
    Parameter("SIM_GYR_NOISE", 0.003, 0, 0.1, "rad/s", "simulator: gyro noise of a 250 Hz sample"),
    Parameter("SIM_ACC_NOISE", 0.07, 0, 2, "m/s^2", "simulator: accelerometer noise of a 250 Hz sample"),
    Parameter("SIM_GYR_BIAS", 0.005, 0, 0.05, "rad/s", "simulator: spread of the gyro biases, drawn at the start"),
    Parameter("SIM_ACC_BIAS", 0.05, 0, 0.5, "m/s^2", "simulator: spread of the accelerometer biases"),
    Parameter("SIM_GYR_WALK", 1e-5, 0, 0.01, "rad/s/√s", "simulator: random walk of the gyro biases"),
    Parameter("SIM_ACC_WALK", 1e-4, 0, 0.1, "m/s²/√s", "simulator: random walk of the accelerometer biases"),
    Parameter("SIM_GYR_INSTAB", 0.0, 0, 0.01, "rad/s", "simulator: bias instability of the gyro"),
    Parameter("SIM_ACC_INSTAB", 0.0, 0, 0.2, "m/s^2", "simulator: bias instability of the accelerometer"),
    Parameter("SIM_IMU_VIB", 0.0, 0, 50, "m/s^2", "simulator: vibration of one rotor at 1000 rad/s"),
    Parameter("SIM_GPS_P_NOISE", 0.35, 0, 10, "m", "simulator: GPS horizontal noise, 1.5 times as much vertically"),
    Parameter("SIM_GPS_V_NOISE", 0.05, 0, 5, "m/s", "simulator: GPS velocity noise, 1.5 times as much vertically"),
    Parameter("SIM_GPS_DELAY", 112.0, 4, 300, "ms", "simulator: age of a fix when it arrives"),
    Parameter("SIM_GPS_WANDER", 0.0, 0, 10, "m", "simulator: slow part of the GPS position's error"),
    Parameter("SIM_GPS_LOST", 0.0, 0, 1, "", "simulator: share of the fixes that are lost"),
    Parameter("SIM_GPS_GLITCH", 0.0, 0, 1000, "m", "simulator: size of GPS glitches of 5 s"),
    Parameter("SIM_GPS_GLTCH_T", 60.0, 1, 10000, "s", "simulator: mean time between GPS glitches"),
    Parameter("SIM_BARO_NOISE", 0.2, 0, 5, "m", "simulator: barometer noise"),
    Parameter("SIM_BARO_DRIFT", 0.1, 0, 5, "m", "simulator: slow drift of the barometer"),
    Parameter("SIM_MAG_NOISE", 0.03, 0, 0.5, "gauss", "simulator: magnetometer noise"),
    Parameter("SIM_MAG_DECL", 3.4, -180, 180, "deg", "simulator: declination of the earth's field"),
    Parameter("SIM_MAG_INCL", 63.3, -90, 90, "deg", "simulator: inclination of the earth's field, known to all"),
    Parameter("SIM_MAG_OFFS_X", 0.0, -1, 1, "gauss", "simulator: hard iron, ahead"),
    Parameter("SIM_MAG_OFFS_Y", 0.0, -1, 1, "gauss", "simulator: hard iron, to the right"),
    Parameter("SIM_MAG_OFFS_Z", 0.0, -1, 1, "gauss", "simulator: hard iron, down"),
    Parameter("SIM_RNG_MAX", 20.0, 0, 200, "m", "simulator: reach of the rangefinder; 0 for none"),
)


def configure_imu(imu: Record, p: ParameterSet, substeps: int, tick_s: float) -> None:
    """The noises of the (1,) record of `imu.IMU`: of a 1 kHz sample, and the biases' steps a tick."""
    imu["gyro_noise"] = math.sqrt(substeps) * p["SIM_GYR_NOISE"]
    imu["accel_noise"] = math.sqrt(substeps) * p["SIM_ACC_NOISE"]
    imu["gyro_walk"] = p["SIM_GYR_WALK"] * math.sqrt(tick_s)
    imu["accel_walk"] = p["SIM_ACC_WALK"] * math.sqrt(tick_s)
    imu["vibration"] = p["SIM_IMU_VIB"] / 1e6


class Sensors:
    """GPS, barometer, magnetometer, rangefinder and obstacle sensor of one vehicle.

    Parameters
    ----------
    home : where truth's frame begins, and the vehicle stands at the start.
    parameters : the values of (at least) `PARAMETERS`.
    generators : `CHILDREN` of them, one a sensor.
    faults : what misbehaves when.
    world : what rangefinder and obstacle sensor see; None: the ground only.
    period_us : of a tick [us].
    q_nb : (4,) attitude at the start.
    imu : (1,) record of `imu.IMU`, whose biases wander and whose faults are set here.
    ground : down coordinate of the ground [m].

    Attributes
    ----------
    gps, baro, mag, range, obstacles : the newest sample of each; None before the first.
    """

    def __init__(
        self,
        *,
        home: Geodetic,
        parameters: ParameterSet,
        generators: Sequence[np.random.Generator],
        faults: FaultSchedule,
        world: World | None,
        period_us: int,
        q_nb: FloatArray,
        imu: Record,
        ground: float,
    ) -> None:
        self._home, self._faults, self._period_us = home, faults, period_us
        rng = dict(zip((Sensor.GPS, Sensor.BARO, Sensor.MAG, Sensor.RANGE, Sensor.OBSTACLE), generators, strict=True))
        spoilt = {sensor: Channel(sensor, faults, generator.spawn(1)[0]) for sensor, generator in rng.items()}
        self._baro_faults, self._mag_faults = spoilt[Sensor.BARO], spoilt[Sensor.MAG]
        self._gps = GpsReceiver(home, rng[Sensor.GPS], 0, 0.0, 0.0, spoilt[Sensor.GPS])
        self._baro = Barometer(rng[Sensor.BARO], 0.0, 0.0)
        self._mag = Magnetometer(rng[Sensor.MAG], 0.0)
        self._range = Rangefinder(world, ground, rng[Sensor.RANGE], spoilt[Sensor.RANGE])
        self._obstacles = (
            None if world is None else ObstacleSensor(world, rng[Sensor.OBSTACLE], spoilt[Sensor.OBSTACLE])
        )
        self._imu = imu
        self._instability = Instability(rng[Sensor.BARO].spawn(1)[0], BARO_TICKS * period_us * 1e-6)
        self.configure(parameters)
        self.gps: GpsSample | None = None
        self.baro: BaroSample = self._baro.measure(0, home.altitude, 0.0)
        self.mag: MagSample = self._mag.measure(0, q_nb)
        self.range: RangeSample | None = None
        self.obstacles: ObstacleScan | None = None

    def configure(self, p: ParameterSet) -> None:
        """Read every parameter again."""
        gps, mag = self._gps, self._mag
        gps.position_noise, gps.velocity_noise = float(p["SIM_GPS_P_NOISE"]), float(p["SIM_GPS_V_NOISE"])
        gps.delay_us = round(1e3 * p["SIM_GPS_DELAY"])
        gps.wander, gps.lost = float(p["SIM_GPS_WANDER"]), float(p["SIM_GPS_LOST"])
        gps.glitch, gps.glitch_every_s = float(p["SIM_GPS_GLITCH"]), float(p["SIM_GPS_GLTCH_T"])
        self._baro.noise, self._baro.drift = float(p["SIM_BARO_NOISE"]), float(p["SIM_BARO_DRIFT"])
        mag.noise = float(p["SIM_MAG_NOISE"])
        mag.field_n = field_n(math.radians(p["SIM_MAG_DECL"]), math.radians(p["SIM_MAG_INCL"]))
        mag.hard_iron_b = np.array([p["SIM_MAG_OFFS_X"], p["SIM_MAG_OFFS_Y"], p["SIM_MAG_OFFS_Z"]])
        self._range.maximum = float(p["SIM_RNG_MAX"])
        self._instability.gyro, self._instability.accel = float(p["SIM_GYR_INSTAB"]), float(p["SIM_ACC_INSTAB"])
        self._imu_noises = 2.0 * p["SIM_GYR_NOISE"], 2.0 * p["SIM_ACC_NOISE"]  # of 1 kHz samples, four a tick

    def sense(
        self, n: int, now_us: int, x: FloatArray, arrived: Callable[[GpsSample | BaroSample | MagSample], None]
    ) -> None:
        """Read the sensors that are due at the end of tick number `n`.

        Parameters
        ----------
        n : ticks since the start, this one included.
        now_us : its end [us].
        x : (17,) truth, see `physics.dynamics`.
        arrived : takes what came out of a sensor, in order.
        """
        due = _DUE[n % _CYCLE]
        if due:
            if due & _GPS_DUE:
                self._gps.measure(now_us, x[0:3], x[3:6])
                if self._gps.silent and self.gps is not None and self.gps.fix_type != 0:
                    self.gps = replace(self.gps, now_us=now_us, fix_type=0, satellites=0)
            if due & _BARO_DUE:
                self._look_at_pressure_and_field(now_us, x, arrived)
            if due & _RANGE_DUE and self._range.maximum > 0.0:
                self.range = self._range.measure(now_us, x[0:3], x[6:10]) or self.range
            if due & _OBSTACLE_DUE and self._obstacles is not None:
                self.obstacles = self._obstacles.measure(now_us, x[0:3], x[6:10]) or self.obstacles
        fix = self._gps.arrived(now_us)
        if fix is not None:
            self.gps = fix
            arrived(fix)
        if self._faults.concerns(Sensor.GYRO) or self._faults.concerns(Sensor.ACCEL):
            set_faults(self._imu, self._faults, now_us, self._imu_noises)

    def _look_at_pressure_and_field(
        self, now_us: int, x: FloatArray, arrived: Callable[[GpsSample | BaroSample | MagSample], None]
    ) -> None:
        """Barometer and magnetometer, in one tick so that the filter takes both in one update."""
        dt = BARO_TICKS * self._period_us * 1e-6
        self._instability.step(self._imu)
        baro = self._baro.measure(now_us, self._home.altitude - float(x[2]), dt)
        height = self._baro_faults.through(now_us, np.array([baro.altitude]))
        if height is not None:
            if height[0] != baro.altitude:
                baro = replace(baro, altitude=float(height[0]), pressure=pressure_at(float(height[0])))
            self.baro = baro
            arrived(baro)
        mag = self._mag.measure(now_us, x[6:10])
        field_b = self._mag_faults.through(now_us, mag.field_b)
        if field_b is not None:
            self.mag = mag if field_b is mag.field_b else MagSample(now_us, field_b)
            arrived(self.mag)
