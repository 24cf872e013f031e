"""All sensors but the IMU, which the compiled tick samples itself: when each is due, and its parameters.

The vehicle stands in truth's n, local NED from home. Every sensor draws from a generator of its own, so that one more
sensor moves no other's numbers.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from fakevehicle.faults import FaultSchedule
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.sensors.barometer import Barometer
from fakevehicle.sensors.gps import GpsReceiver
from fakevehicle.sensors.magnetometer import Magnetometer
from fakevehicle.sensors.obstacles import World
from fakevehicle.vocabulary import (
    BaroSample,
    FloatArray,
    Geodetic,
    GpsSample,
    MagSample,
    ObstacleScan,
    RangeSample,
)

GPS_TICKS, BARO_TICKS, MAG_TICKS = 25, 10, 10
"""Ticks between samples: 10, 25 and 25 Hz."""
GPS_DELAY_TICKS = 28
"""A fix arrives 112 ms after it was true."""
CHILDREN = 5
"""Generators a suite draws from: GPS, barometer, magnetometer, rangefinder, obstacle sensor."""

PARAMETERS: tuple[Parameter, ...] = (
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
)


def configure_imu(imu: np.ndarray[Any, np.dtype[np.void]], p: ParameterSet, substeps: int, tick_s: float) -> None:
    """The noises of the (1,) record of `imu.IMU`: of a 1 kHz sample, and the biases' steps a tick."""
    imu["gyro_noise"] = math.sqrt(substeps) * p["SIM_GYR_NOISE"]
    imu["accel_noise"] = math.sqrt(substeps) * p["SIM_ACC_NOISE"]
    imu["gyro_walk"] = p["SIM_GYR_WALK"] * math.sqrt(tick_s)
    imu["accel_walk"] = p["SIM_ACC_WALK"] * math.sqrt(tick_s)


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
    ) -> None:
        self._home, self._faults, self._world, self._period_us = home, faults, world, period_us
        self._gps = GpsReceiver(home, generators[0], GPS_DELAY_TICKS * period_us, 0.0, 0.0)
        self._baro = Barometer(generators[1], 0.0, 0.0)
        self._mag = Magnetometer(generators[2], 0.0)
        self.configure(parameters)
        self.gps: GpsSample | None = None
        self.baro: BaroSample = self._baro.measure(0, home.altitude, 0.0)
        self.mag: MagSample = self._mag.measure(0, q_nb)
        self.range: RangeSample | None = None
        self.obstacles: ObstacleScan | None = None

    def configure(self, p: ParameterSet) -> None:
        """Read every parameter again."""
        self._gps.position_noise, self._gps.velocity_noise = float(p["SIM_GPS_P_NOISE"]), float(p["SIM_GPS_V_NOISE"])
        self._baro.noise, self._baro.drift = float(p["SIM_BARO_NOISE"]), float(p["SIM_BARO_DRIFT"])
        self._mag.noise = float(p["SIM_MAG_NOISE"])

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
        if n % GPS_TICKS == 0:
            self._gps.measure(now_us, x[0:3], x[3:6])
        if n % BARO_TICKS == 3:
            dt = BARO_TICKS * self._period_us * 1e-6
            self.baro = self._baro.measure(now_us, self._home.altitude - float(x[2]), dt)
            arrived(self.baro)
        if n % MAG_TICKS == 7:
            self.mag = self._mag.measure(now_us, x[6:10])
            arrived(self.mag)
        fix = self._gps.arrived(now_us)
        if fix is not None:
            self.gps = fix
            arrived(fix)
