"""A fresh estimator on recorded sensors: `fakevehicle --record FOLDER --record-sensors` wrote them.

Every tick is what the vehicle's was: the IMU sample through the output predictor, the samples that arrived, whether
the motors carried it, the filter. So the same parameters give the same estimate, bit for bit on one class of machines;
with others (`changes`) it is what this estimator would have made of the flight that was flown.
"""

import difflib
import json
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fakevehicle.errors import VehicleError
from fakevehicle.estimator.horizon import Estimator
from fakevehicle.estimator.predictor import advance_alone
from fakevehicle.estimator.settings import PARAMETERS, estimator_config
from fakevehicle.params import ParameterSet
from fakevehicle.sensorlog import WIDTH, field_of, sample_of, state_of
from fakevehicle.sensors import suite
from logs import schema
from logs.compare import Comparison, Output, compare
from logs.reader import Recording

KINDS = (schema.EstimatorBegin, schema.EstimatorInputs, schema.EstimatorState)
_KNOWN = ParameterSet((*PARAMETERS, *(p for p in suite.PARAMETERS if p.name == "SIM_MAG_INCL")))


class EstimatorRerunError(VehicleError):
    """The recording holds no sensors, or a change names no parameter of the estimator's."""


@dataclass(frozen=True, slots=True)
class EstimatorRerun:
    """The outcome: ticks run, the time they simulate, and how recorded and new states compare (one each 0.1 s)."""

    ticks: int
    simulated_s: float
    comparison: Comparison


def rerun_estimator(recording: Recording, changes: Mapping[str, float] | None = None) -> EstimatorRerun:
    """Feed the recorded sensors to fresh estimators and compare what they believe.

    Parameters
    ----------
    changes : values of parameters by name, in the place of those that were set; the vehicle's did not change then.

    Raises
    ------
    EstimatorRerunError : no sensors are in the recording; or an unknown parameter, or a value out of its range.
    """
    own = _coerced(changes or {})
    estimator: Estimator | None = None
    recorded: list[Output] = []
    produced: list[Output] = []
    ticks = blocks = 0
    simulated_us, gravity, period_us, now_us = 0, 0.0, 0, 0
    name = schema.schema_name(schema.EstimatorState)
    for message in recording.messages(topics=tuple(schema.TOPICS[kind] for kind in KINDS)):
        kind = schema.kind_of(message.channel.schema)
        if kind is schema.EstimatorBegin:
            begin = schema.decode(schema.EstimatorBegin, message.data)
            values = json.loads(begin.parameters) | own
            config, gravity, period_us = estimator_config(_Values(values)), begin.gravity, begin.period_us
            if begin.fresh or estimator is None:
                field = field_of(values) if own else np.array(begin.field_n)
                estimator = Estimator(config, field, gravity, period_us)
            else:
                estimator.configure(config)
        elif kind is schema.EstimatorInputs and estimator is not None:
            block = schema.decode(schema.EstimatorInputs, message.data)
            _run(estimator, block, gravity, period_us)
            ticks += len(block.flying)
            simulated_us += len(block.flying) * period_us
            now_us = block.now_us
        elif kind is schema.EstimatorState and estimator is not None:
            recorded.append(Output(blocks, name, message.data))
            produced.append(Output(blocks, name, schema.encode(state_of(now_us, estimator))))
            blocks += 1
    if not ticks:
        told = "holds no sensors, expected a recording of `fakevehicle --record FOLDER --record-sensors`"
        raise EstimatorRerunError(f"{recording.path}: {told}")
    return EstimatorRerun(ticks, simulated_us / 1e6, compare(recorded, produced))


def _run(estimator: Estimator, block: schema.EstimatorInputs, gravity: float, period_us: int) -> None:
    """The ticks of one record."""
    imu = np.array(block.imu).reshape(-1, 6)
    rows = [block.samples[at : at + WIDTH] for at in range(0, len(block.samples), WIDTH)]
    predictor, dt = estimator.predictor.view(np.float64), period_us * 1e-6
    now_us, at = block.now_us - len(imu) * period_us, 0
    for tick, sample in enumerate(imu):
        now_us += period_us
        advance_alone(predictor, estimator.imu, estimator.ring, sample, dt, gravity)
        while at < len(rows) and rows[at][0] == tick:
            estimator.add(sample_of(rows[at]))
            at += 1
        estimator.flying = block.flying[tick] != 0.0
        estimator.step(now_us)


class _Values(ParameterSet):
    """Values as they are, without ranges: of an older version, say."""

    def __init__(self, values: Mapping[str, float]) -> None:
        super().__init__(())
        self._values = dict(values)


def _coerced(changes: Mapping[str, float]) -> dict[str, float | int]:
    """The changes as parameters store them."""
    values: dict[str, float | int] = {}
    for name, value in changes.items():
        if name not in _KNOWN:
            near = difflib.get_close_matches(name, _KNOWN, n=1)
            meant = f", did you mean {near[0]}?" if near else f": expected one of {', '.join(_KNOWN)}"
            raise EstimatorRerunError(f"--set {name}: the estimator has no such parameter{meant}")
        if not isinstance(value, int | float):
            raise EstimatorRerunError(f"--set {name}: found {value!r}, expected a number")
        try:
            values[name] = _KNOWN.describe(name).coerced(float(value))
        except ValueError as error:
            raise EstimatorRerunError(f"--set {name}: {error}") from error
    return values
