"""Faults on a schedule: which sensor misbehaves how, and when.

A schedule is fixed before the flight or added to in it; whoever simulates a sensor sends each of its words, an array of
numbers, through a `Channel`:

    OFF     nothing comes            STUCK   the last word, for ever
    BIAS    word + magnitude         NOISE   word + magnitude * n          DELAY   the word of `magnitude` seconds ago

A motor says nothing; it can be OFF, or keep a share of its thrust, which is what BIAS means to it. Nothing else.

Several hold together, in the order in which they were given.
"""

import math
import re
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from fakevehicle.vocabulary import FloatArray

MOST = 64
"""Faults a schedule holds; more can come in flight."""
LONGEST_DELAY_S = 5.0
"""Words older than this are forgotten [s]."""


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


WORDS = {Sensor.GYRO: 3, Sensor.ACCEL: 3, Sensor.MAG: 3, Sensor.GPS: 6, Sensor.BATTERY: 3}
"""How many numbers a sensor's word has, where it is not one."""
INSTANCES = {Sensor.MOTOR: 4}
"""How many of a kind there are, where it is not one."""


@dataclass(frozen=True, slots=True)
class Fault:
    """One fault.

    Attributes
    ----------
    sensor, kind : what fails, and how.
    start_us, end_us : when [us]; None: it stays.
    magnitude : of BIAS an axis, of NOISE (1 sigma) or of DELAY [s], in the sensor's units; a motor's share of thrust.
    index : which motor, from 0; 0 for sensors, of which there is one each.
    """

    sensor: Sensor
    kind: FaultKind
    start_us: int
    end_us: int | None = None
    magnitude: tuple[float, ...] = ()
    index: int = 0

    def __post_init__(self) -> None:
        what = f"fault {self.sensor.value}:{self.kind.value}"
        if self.start_us < 0 or (self.end_us is not None and self.end_us <= self.start_us):
            end_s = math.inf if self.end_us is None else self.end_us * 1e-6
            raise ValueError(f"{what}: from {self.start_us * 1e-6:g} to {end_s:g} s, expected an end after the start")
        if len(self.magnitude) > 6 or not all(math.isfinite(m) for m in self.magnitude):
            raise ValueError(f"{what}: magnitude {self.magnitude}, expected at most six finite numbers")
        if self.kind in (FaultKind.BIAS, FaultKind.NOISE, FaultKind.DELAY) and not self.magnitude:
            raise ValueError(f"{what}: expected a magnitude, as in {self.sensor.value}:{self.kind.value}=0.5")
        if self.kind in (FaultKind.NOISE, FaultKind.DELAY) and min(self.magnitude) < 0.0:
            raise ValueError(f"{what}: magnitude {self.magnitude}, expected none below 0")
        if self.kind is FaultKind.DELAY and self.magnitude[0] > LONGEST_DELAY_S:
            raise ValueError(f"{what}: {self.magnitude[0]:g} s, expected at most {LONGEST_DELAY_S:g}")
        numbers = len(self.magnitude)
        if self.kind in (FaultKind.BIAS, FaultKind.NOISE) and numbers not in (1, WORDS.get(self.sensor, 1)):
            raise ValueError(f"{what}: {numbers} numbers, expected 1 or {WORDS.get(self.sensor, 1)}")
        if self.sensor is Sensor.MOTOR and self.kind is not FaultKind.OFF:
            if self.kind is not FaultKind.BIAS:
                raise ValueError(f"{what}: a motor can be off, or have a bias, the share of its thrust that is left")
            if not 0.0 <= self.magnitude[0] <= 1.0:
                raise ValueError(f"{what}: {self.magnitude[0]:g}, expected the share of thrust that is left, 0..1")
        if not 0 <= self.index < INSTANCES.get(self.sensor, 1):
            raise ValueError(f"{what}: number {self.index + 1}, this vehicle has {INSTANCES.get(self.sensor, 1)}")


_TYPICAL: dict[Sensor, dict[FaultKind, tuple[float, ...]]] = {
    Sensor.GYRO: {FaultKind.BIAS: (0.2,), FaultKind.NOISE: (0.2,), FaultKind.DELAY: (0.02,)},
    Sensor.ACCEL: {FaultKind.BIAS: (1.0,), FaultKind.NOISE: (2.0,), FaultKind.DELAY: (0.02,)},
    Sensor.GPS: {
        FaultKind.BIAS: (30.0, 30.0, 0.0, 0.0, 0.0, 0.0),
        FaultKind.NOISE: (10.0, 10.0, 15.0, 2.0, 2.0, 3.0),
        FaultKind.DELAY: (0.5,),
    },
    Sensor.BARO: {FaultKind.BIAS: (10.0,), FaultKind.NOISE: (5.0,), FaultKind.DELAY: (0.5,)},
    Sensor.MAG: {FaultKind.BIAS: (0.2,), FaultKind.NOISE: (0.3,), FaultKind.DELAY: (0.5,)},
    Sensor.RANGE: {FaultKind.BIAS: (3.0,), FaultKind.NOISE: (2.0,), FaultKind.DELAY: (0.5,)},
    Sensor.OBSTACLE: {FaultKind.BIAS: (3.0,), FaultKind.NOISE: (2.0,), FaultKind.DELAY: (0.5,)},
    Sensor.BATTERY: {FaultKind.BIAS: (-2.0, 0.0, -0.5), FaultKind.NOISE: (1.0, 5.0, 0.1), FaultKind.DELAY: (2.0,)},
    Sensor.MOTOR: {FaultKind.BIAS: (0.65,)},
}


def typical(sensor: Sensor, kind: FaultKind) -> tuple[float, ...] | None:
    """A magnitude for who asks for a fault without one, as MAV_CMD_INJECT_FAILURE does: large enough to be noticed.

    None: this sensor has no such fault.
    """
    plain = kind is FaultKind.OFF or (kind is FaultKind.STUCK and sensor is not Sensor.MOTOR)
    return () if plain else _TYPICAL[sensor].get(kind)


_TEXT = re.compile(
    r"(?P<sensor>[a-z]+)(?P<index>\d?):(?P<kind>[a-z]+)(=(?P<magnitude>[^@]+))?(@(?P<start>[\d.]+)(-(?P<end>[\d.]+))?)?"
)


def parse_fault(text: str) -> Fault:
    """A fault as people write it: SENSOR[NUMBER]:KIND[=NUMBERS][@START[-END]], times in seconds since the start.

    "gps:off@20-40", "gyro:bias=0.02,0,0@10", "baro:delay=0.5", "motor2:bias=0.65@30" (motors count from 1).

    Raises
    ------
    ValueError : it is not of that form, or cannot be; the message says why.
    """
    match = _TEXT.fullmatch(text.strip().lower())
    if match is None:
        raise ValueError(f"fault {text!r}: expected SENSOR:KIND[=NUMBERS][@START[-END]], as in gps:off@20-40")
    try:
        sensor, kind = Sensor(match["sensor"]), FaultKind(match["kind"])
    except ValueError:
        sensors, kinds = (", ".join(m.value for m in members) for members in (Sensor, FaultKind))
        raise ValueError(f"fault {text!r}: expected one of {sensors}, then one of {kinds}") from None
    try:
        magnitude = tuple(float(m) for m in match["magnitude"].split(",")) if match["magnitude"] else ()
        start, end = (None if t is None else round(1e6 * float(t)) for t in (match["start"], match["end"]))
    except ValueError:
        raise ValueError(f"fault {text!r}: a magnitude or a time is not a number") from None
    return Fault(sensor, kind, start or 0, end, magnitude, int(match["index"] or 1) - 1)


class FaultSchedule:
    """The faults of one flight.

    Parameters
    ----------
    faults : those known before it.
    """

    def __init__(self, faults: Iterable[Fault] = ()) -> None:
        self._faults = tuple(faults)
        self._concerned = {f.sensor for f in self._faults}

    def concerns(self, sensor: Sensor) -> bool:
        """Whether there is, was or will be a fault of this one; cheap enough for every sample."""
        return bool(self._faults) and sensor in self._concerned  # mostly there are none, and enums hash slowly

    def add(self, fault: Fault) -> None:
        """One more; when there are `MOST`, the oldest is forgotten."""
        self._faults = (*self._faults, fault)[-MOST:]
        self._concerned.add(fault.sensor)

    def mend(self, sensor: Sensor, now_us: int, index: int | None = None) -> None:
        """End every fault of one sensor that holds at `now_us`; of several alike that with `index`, or all."""
        ending = [f for f in self.active(sensor, now_us) if index is None or f.index == index]
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


class Channel:
    """The way of one sensor's words through its faults.

    Parameters
    ----------
    sensor : whose.
    schedule : of all faults.
    rng : of the NOISE faults; the sensor's own noise has another.
    """

    def __init__(self, sensor: Sensor, schedule: FaultSchedule, rng: np.random.Generator) -> None:
        self._sensor, self._schedule, self._rng = sensor, schedule, rng
        self._last: FloatArray | None = None
        self._past: deque[tuple[int, FloatArray]] = deque(maxlen=1024)

    def through(self, now_us: int, word: FloatArray) -> FloatArray | None:
        """What comes out when the sensor says `word`, (n,); None: nothing."""
        if not self._schedule.concerns(self._sensor):
            return word
        self._past.append((now_us, word))
        while now_us - self._past[0][0] > LONGEST_DELAY_S * 1e6:
            self._past.popleft()
        for fault in self._schedule.active(self._sensor, now_us):
            match fault.kind:
                case FaultKind.OFF:
                    return None
                case FaultKind.STUCK:
                    word = word if self._last is None else self._last
                case FaultKind.BIAS:
                    word = word + spread(fault.magnitude, len(word))
                case FaultKind.NOISE:
                    word = word + spread(fault.magnitude, len(word)) * self._rng.standard_normal(len(word))
                case FaultKind.DELAY:
                    true_us = now_us - round(1e6 * fault.magnitude[0])
                    word = next((w for t, w in reversed(self._past) if t <= true_us), self._past[0][1])
        self._last = word
        return word


def spread(magnitude: tuple[float, ...], n: int) -> FloatArray:
    """A magnitude for n numbers: one for all, or one each and zero for the rest."""
    if len(magnitude) == 1:
        return np.full(n, magnitude[0])
    out = np.zeros(n)
    out[: len(magnitude)] = magnitude[:n]
    return out
