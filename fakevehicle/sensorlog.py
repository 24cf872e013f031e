"""What crosses the estimator's seam, as records: IMU samples, the slow sensors' samples as they arrive, and what it
makes of them. With it the estimator can be run again without the vehicle (`fakevehicle.estimator_rerun`).

A tenth of a second is one record. Rows of `EstimatorInputs.samples`, padded with zeros to `WIDTH`:

    tick, GPS,  now_us, measured_us, latitude, longitude, altitude, velocity_n (3),
                eph, epv, speed_accuracy, fix_type, satellites
    tick, BARO, now_us, altitude, pressure, temperature
    tick, MAG,  now_us, field_b (3)

`tick` counts from 0 in its record. All of it are doubles, bit for bit.
"""

import json
import math
from collections.abc import Callable, Sequence

import numpy as np

from fakevehicle.airframe import GRAVITY
from fakevehicle.estimator.horizon import Estimator
from fakevehicle.estimator.settings import PARAMETERS, EstimatorConfig
from fakevehicle.params import ParameterSet
from fakevehicle.sensors.magnetometer import field_n
from fakevehicle.vocabulary import BaroSample, FloatArray, Geodetic, GpsSample, MagSample
from logs import schema

Sample = GpsSample | BaroSample | MagSample
BLOCK, WIDTH = 25, 15
"""Ticks in a record, numbers in a row."""
GPS, BARO, MAG = 0.0, 1.0, 2.0
NAMES = (*(parameter.name for parameter in PARAMETERS), "SIM_MAG_INCL")
"""Parameters that the estimator goes by; the field's inclination is known to all."""


class SensorLog:
    """Turns what an estimator took into records.

    Parameters
    ----------
    write : takes each record.
    period_us : of a tick [us].
    """

    def __init__(self, write: Callable[[schema.Record], None], period_us: int) -> None:
        self._write, self._period_us = write, period_us
        self._estimator: Estimator | None = None
        self._config: EstimatorConfig | None = None
        self._heard: list[Sample] = []
        self._imu: list[float] = []
        self._flying: list[float] = []
        self._samples: list[float] = []
        self._now_us = 0

    def tick(self, now_us: int, estimator: Estimator, parameters: ParameterSet) -> None:
        """Note one tick, after it; `now_us` is the estimator's time."""
        if estimator is not self._estimator or estimator.config is not self._config:
            self.flush(state=estimator is not self._estimator)
            self._begin(now_us, estimator, parameters)
        self._imu += estimator.newest.tolist()
        self._flying.append(float(estimator.flying))
        if self._heard:
            tick = float(len(self._flying) - 1)
            for sample in self._heard:
                self._samples += row_of(tick, sample)
            self._heard.clear()
        self._now_us = now_us
        if len(self._flying) >= BLOCK:
            self.flush()

    def flush(self, state: bool = True) -> None:
        """Write what is waiting; and what came of it, unless the estimator is a tick ahead of that."""
        if self._estimator is None or not self._flying:
            return
        inputs = tuple(self._imu), tuple(self._flying), tuple(self._samples)
        self._write(schema.EstimatorInputs(self._now_us, *inputs))
        if state:
            self._write(state_of(self._now_us, self._estimator))
        self._imu, self._flying, self._samples = [], [], []

    def _begin(self, now_us: int, estimator: Estimator, parameters: ParameterSet) -> None:
        """Another estimator, or other parameters: nothing arrives in an estimator's first tick, so none is missed."""
        fresh = estimator is not self._estimator
        self._estimator, self._config = estimator, estimator.config
        if fresh:
            self._heard = estimator.heard = []
        values = {name: parameters[name] for name in NAMES}
        field = tuple(field_of(values).tolist())
        self._write(schema.EstimatorBegin(now_us, fresh, json.dumps(values), field, GRAVITY, self._period_us))


def field_of(values: dict[str, float | int]) -> FloatArray:
    """The earth's field (3,) [gauss] as the estimator knows it."""
    return field_n(math.radians(values["EKF2_MAG_DECL"]), math.radians(values["SIM_MAG_INCL"]))


def row_of(tick: float, sample: Sample) -> list[float]:
    """A sample as a row."""
    if isinstance(sample, GpsSample):
        place = sample.position
        head = [tick, GPS, sample.now_us, sample.measured_us, place.latitude, place.longitude, place.altitude]
        accuracy = [sample.eph, sample.epv, sample.speed_accuracy, sample.fix_type, sample.satellites]
        row = [*head, *sample.velocity_n.tolist(), *accuracy]
    elif isinstance(sample, BaroSample):
        row = [tick, BARO, sample.now_us, sample.altitude, sample.pressure, sample.temperature]
    else:
        row = [tick, MAG, sample.now_us, *sample.field_b.tolist()]
    return [float(value) for value in row] + [0.0] * (WIDTH - len(row))


def sample_of(row: Sequence[float]) -> Sample:
    """The sample in a row."""
    kind, now_us = row[1], int(row[2])
    if kind == GPS:
        velocity, accuracy = np.array(row[7:10]), (row[10], row[11], row[12], int(row[13]), int(row[14]))
        return GpsSample(now_us, int(row[3]), Geodetic(row[4], row[5], row[6]), velocity, *accuracy)
    if kind == BARO:
        return BaroSample(now_us, row[3], row[4], row[5])
    return MagSample(now_us, np.array(row[3:6]))


def state_of(now_us: int, estimator: Estimator) -> schema.EstimatorState:
    """What an estimator believes."""
    out, bias = estimator.out.tolist(), estimator.bias.tolist()
    fusions = sorted(estimator.fusions.items())
    filter_ = estimator.filter
    return schema.EstimatorState(
        now_us=now_us,
        position_n=tuple(out[0:3]),
        velocity_n=tuple(out[3:6]),
        acceleration_n=tuple(out[13:16]),
        q_nb=tuple(out[6:10]),
        omega_b=tuple(out[10:13]),
        gyro_bias=tuple(bias[0:3]),
        accel_bias=tuple(bias[3:6]),
        sigma=() if filter_ is None else tuple(np.sqrt(np.maximum(filter_.P.diagonal(), 0.0)).tolist()),
        resets=estimator.resets.count,
        sensors=",".join(name for name, _ in fusions),
        nis=tuple(fusion.nis for _, fusion in fusions),
        dof=tuple(float(fusion.dof) for _, fusion in fusions),
        accepted=tuple(float(fusion.accepted) for _, fusion in fusions),
    )
