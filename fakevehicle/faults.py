"""Faults on a schedule: which sensor misbehaves how, and when.

A schedule is fixed before the flight or added to in it; whoever simulates a sensor asks `active` at each sample.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import Enum


class Sensor(Enum):
    """What can fail."""

    GYRO = "gyro"
    ACCEL = "accel"
    GPS = "gps"
    BARO = "baro"
    MAG = "mag"
    RANGE = "range"
    BATTERY = "battery"
    OBSTACLE = "obstacle"
    MOTOR = "motor"


class FaultKind(Enum):
    """How it fails."""

    OFF = "off"
    STUCK = "stuck"
    BIAS = "bias"
    NOISE = "noise"
    DELAY = "delay"


@dataclass(frozen=True, slots=True)
class Fault:
    """One fault.

    Attributes
    ----------
    sensor, kind : what fails, and how.
    start_us, end_us : when [us]; None: it stays.
    magnitude : of BIAS an axis, of NOISE (1 sigma) or of DELAY [s], in the sensor's units; a motor's share of thrust.
    index : which motor, from 0; 0 for sensors.
    """

    sensor: Sensor
    kind: FaultKind
    start_us: int
    end_us: int | None = None
    magnitude: tuple[float, ...] = ()
    index: int = 0


class FaultSchedule:
    """The faults of one flight.

    Parameters
    ----------
    faults : those known before it.
    """

    def __init__(self, faults: Iterable[Fault] = ()) -> None:
        self._faults = tuple(faults)

    def add(self, fault: Fault) -> None:
        """One more."""
        self._faults = (*self._faults, fault)

    def mend(self, sensor: Sensor, now_us: int) -> None:
        """End every fault of one sensor that holds at `now_us`."""
        ending = self.active(sensor, now_us)
        self._faults = tuple(replace(f, end_us=now_us) if f in ending else f for f in self._faults)

    def active(self, sensor: Sensor, now_us: int) -> tuple[Fault, ...]:
        """Those of one sensor that hold at `now_us`, in the order they were given."""
        if not self._faults:
            return ()
        return tuple(
            f
            for f in self._faults
            if f.sensor is sensor and f.start_us <= now_us and (f.end_us is None or now_us < f.end_us)
        )
