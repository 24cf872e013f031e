"""What a tuning is told: a YAML file, checked once, every problem with its line.

docs/tuning.md has every key. Names of vehicle parameters are checked against the vehicle's own, ranges against theirs.
"""

import difflib
import hashlib
import json
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator

from campaigns.executors.versions import versions
from campaigns.tuning.courses import Course, Eight, Hover, Step, Wind
from companion.errors import ConfigError
from companion.yamlfile import line_of, read_yaml, shown
from fakevehicle.airframe import load_airframe
from fakevehicle.control.gains import PRESETS
from fakevehicle.errors import AirframeError
from fakevehicle.flight import PARAMETERS
from fakevehicle.params import ParameterSet
from fakevehicle.vocabulary import FloatArray

MAX_BYTES = 100_000
MOST = 64
"""Parameters, courses or winds."""
Seconds = Annotated[float, Field(ge=1.0, le=600.0, allow_inf_nan=False)]
Speed = Annotated[float, Field(ge=0.0, le=25.0, allow_inf_nan=False)]
Real = Annotated[float, Field(allow_inf_nan=False)]
Weight = Annotated[float, Field(ge=0.0, le=1000.0, allow_inf_nan=False)]
Preset = Literal["default", "paper", "fopid", "tid", "pid"]
Name = Annotated[str, Field(min_length=1, max_length=100)]
_KNOWN = ParameterSet(PARAMETERS)


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class Range(_Model):
    """Where one parameter is looked for; `also` are parameters that get the same value."""

    low: Real
    high: Real
    log: bool = False
    also: Annotated[list[str], Field(max_length=MOST)] = []

    @model_validator(mode="after")
    def _some(self) -> "Range":
        if not self.low < self.high:
            raise ValueError(f"found low {self.low:g} and high {self.high:g}, expected low < high")
        if self.log and self.low <= 0.0:
            raise ValueError(f"found low {self.low:g} with log, expected one above 0")
        return self


class _EightModel(_Model):
    speed: Annotated[float, Field(ge=0.5, le=10.0)]
    seconds: Seconds = 24.0


class _StepModel(_Model):
    metres: Annotated[float, Field(ge=0.1, le=50.0)]
    seconds: Seconds = 6.0


class _HoverModel(_Model):
    seconds: Seconds = 10.0


class CourseModel(_Model):
    """One of the three, by its name."""

    eight: _EightModel | None = None
    step: _StepModel | None = None
    hover: _HoverModel | None = None

    @model_validator(mode="after")
    def _one(self) -> "CourseModel":
        if sum(one is not None for one in (self.eight, self.step, self.hover)) != 1:
            raise ValueError("found not exactly one of eight, step, hover, expected one")
        return self

    def course(self) -> Course:
        """As it is flown."""
        if self.eight is not None:
            return Eight(self.eight.speed, self.eight.seconds)
        if self.step is not None:
            return Step(self.step.metres, self.step.seconds)
        assert self.hover is not None
        return Hover(self.hover.seconds)


class WindModel(_Model):
    """One wind; all zero is calm."""

    mean: Speed = 0.0
    gusts: Annotated[float, Field(ge=0.0, le=20.0)] = 0.0
    squall: Speed = 0.0


class Weights(_Model):
    """What each part of the cost counts; each is divided by what the base has."""

    tracking: Weight = 1.0
    overshoot: Weight = 0.2
    activity: Weight = 0.2
    margin: Weight = 0.4

    @model_validator(mode="after")
    def _any(self) -> "Weights":
        if not self.tracking + self.activity + self.margin > 0.0:
            raise ValueError("found only zeros beside overshoot, expected a weight above 0")
        return self


class Bounds(_Model):
    """What parts of the cost may be at most; more is not forbidden, but costs `cost.BEYOND` times the share beyond."""

    activity: Annotated[float, Field(gt=0.0, allow_inf_nan=False)] | None = None  # [rad/s^2]
    margin: Annotated[float, Field(gt=1.0, allow_inf_nan=False)] | None = None  # Ms


class Search(_Model):
    """How long is looked, and with what chance."""

    budget: Annotated[int, Field(ge=5, le=1_000_000)] = 400  # evaluations
    population: Annotated[int, Field(ge=5, le=1000)] = 20
    seed: Annotated[int, Field(ge=0, le=2**31 - 1)] = 1

    @model_validator(mode="after")
    def _pays(self) -> "Search":
        if self.budget < self.population:
            raise ValueError(f"found a budget of {self.budget} for a population of {self.population}, expected more")
        return self


class Spec(_Model):
    """A tuning."""

    name: Name
    airframe: Name = "x500"
    base: Preset = "default"  # what is started from, and the result is held against
    unit: Preset | None = None  # whose parts the cost is in units of; None: the base's
    set: Annotated[dict[str, Real], Field(max_length=MOST)] = {}  # held as they are
    parameters: Annotated[dict[str, Range], Field(min_length=1, max_length=MOST)]
    courses: Annotated[list[CourseModel], Field(min_length=1, max_length=MOST)]
    winds: Annotated[list[WindModel | Literal["calm"]], Field(min_length=1, max_length=MOST)]
    weights: Weights = Weights()
    bounds: Bounds = Bounds()
    start: Annotated[dict[str, Real], Field(max_length=MOST)] = {}  # first candidate, where it is not the base
    train: Annotated[int, Field(ge=1, le=1000)] = 2  # seeds of chance in a cost
    test: Annotated[int, Field(ge=2, le=1000)] = 20  # others, for the judgement after it
    seed: Annotated[int, Field(ge=0, le=2**31 - 1)] = 1  # of both
    search: Search = Search()

    @field_validator("set")
    @classmethod
    def _held(cls, values: dict[str, float]) -> dict[str, float]:
        for name, value in values.items():
            _check(name, value)
        return values

    @field_validator("parameters")
    @classmethod
    def _looked_for(cls, ranges: dict[str, Range]) -> dict[str, Range]:
        seen: set[str] = set()
        for first, span in ranges.items():
            for name in (first, *span.also):
                if name in seen:
                    raise ValueError(f"{name}: found twice, expected once")
                seen.add(name)
                _check(name, span.low)
                _check(name, span.high)
        return ranges

    @model_validator(mode="after")
    def _apart(self) -> "Spec":
        searched = {name for first, span in self.parameters.items() for name in (first, *span.also)}
        for name in sorted(set(self.start) - set(self.parameters)):
            raise ValueError(f"start: {name}: found a parameter that is not searched, expected one of parameters")
        for name in sorted(searched & set(self.set)):
            raise ValueError(f"{name}: found in set and in parameters, expected in one of them")
        if "SIM_WIND_GUST" in searched | set(self.set):
            raise ValueError("SIM_WIND_GUST: found among the parameters, expected under winds: gusts")
        try:
            load_airframe(self.airframe)
        except AirframeError as error:
            raise ValueError(f"airframe: found {self.airframe!r}, expected an airframe: {error}") from error
        return self

    def flown(self) -> tuple[tuple[Course, Wind], ...]:
        """Every course in every wind."""
        winds = [Wind() if isinstance(w, str) else Wind(w.mean, w.gusts, w.squall) for w in self.winds]
        return tuple((c.course(), wind) for c in self.courses for wind in winds)

    def weighed(self) -> dict[str, float]:
        """The weights; where nothing is a step, overshoot has none."""
        weights: dict[str, float] = self.weights.model_dump()
        return weights if any(c.step is not None for c in self.courses) else {**weights, "overshoot": 0.0}

    def seeds(self, unseen: bool) -> tuple[int, ...]:
        """Seeds of the flights: of the cost, or of the judgement; children of one SeedSequence, so none in both."""
        child = np.random.SeedSequence(self.seed).spawn(2)[int(unseen)]
        return tuple(int(n) for n in child.generate_state(self.test if unseen else self.train))

    def fixed(self) -> dict[str, float]:
        """The vehicle's parameters before the search: the airframe's own, the base's, and what is set."""
        own = {k: v for k, v in load_airframe(self.airframe).parameters.items() if k in _KNOWN}
        return {**own, **PRESETS[self.base], **self.set}

    def values(self, unit: FloatArray) -> dict[str, float]:
        """Parameters of a candidate.

        Parameters
        ----------
        unit : (n_dim,) in 0..1, of each range; clipped to it.
        """
        found: dict[str, float] = {}
        for u, (first, span) in zip(np.clip(unit, 0.0, 1.0).tolist(), self.parameters.items(), strict=True):
            value = span.low * (span.high / span.low) ** u if span.log else span.low + u * (span.high - span.low)
            for name in (first, *span.also):
                found[name] = float(_KNOWN.describe(name).coerced(min(max(value, span.low), span.high)))
        return found

    def first(self) -> FloatArray:
        """(n_dim,) where `start`, or else the base, is in the ranges, at their edges where it is beyond."""
        base = ParameterSet(PARAMETERS, self.fixed())
        unit = []
        for name, span in self.parameters.items():
            value = min(max(self.start.get(name, float(base[name])), span.low), span.high)
            if span.log:
                unit.append(np.log(value / span.low) / np.log(span.high / span.low))
            else:
                unit.append((value - span.low) / (span.high - span.low))
        return np.array(unit)

    def at_unit(self) -> "Spec":
        """The same with the preset as base whose parts the cost is in units of."""
        return self if self.unit is None else self.model_copy(update={"base": self.unit})

    def digest(self) -> str:
        """Of all that the parts of a cost depend on: the same digest and parameters, the same parts.

        The airframe counts by what its file says now, and the sources and versions that fly count, too.
        """
        told = self.model_dump(mode="json", exclude={"name", "search", "test", "unit", "weights", "bounds", "start"})
        told |= {"airframe": load_airframe(self.airframe).model_dump(mode="json"), "versions": versions()}
        return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()[:16]


def load_spec(path: Path) -> Spec:
    """Read and check a file.

    Raises
    ------
    ConfigError : it cannot be read, is too large, not YAML, or not a tuning; every problem has its own line.
    """
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        raise ConfigError(str(path), [f"cannot be read: {error.strerror or error}"]) from error
    expected = "a mapping with name, parameters, courses, winds"
    document, node = read_yaml(data, str(path), ConfigError, most_bytes=MAX_BYTES, expected=expected)
    try:
        return Spec.model_validate(document)
    except ValidationError as error:
        raise ConfigError(str(path), [_problem(item, node) for item in error.errors()]) from error


def _check(name: str, value: float) -> None:
    """A name the vehicle knows and a value it takes."""
    if name not in _KNOWN:
        near = difflib.get_close_matches(name, _KNOWN, n=1)
        meant = f"; did you mean {near[0]}?" if near else ""
        raise ValueError(f"{name}: found an unknown parameter, expected one of `fakevehicle --list-params`{meant}")
    try:
        _KNOWN.describe(name).coerced(value)
    except ValueError as error:
        raise ValueError(f"found {error}") from error


def _problem(item: Any, node: Any) -> str:
    """One pydantic error as `line N: key: found ..., expected ...`."""
    keys = [key for key in item["loc"] if key not in ("WindModel", "literal['calm']")]
    place = f"line {line_of(node, keys)}: {'.'.join(map(str, keys)) or 'tuning'}"
    if item["type"] == "missing":
        return f"{place}: found nothing, expected a value"
    if item["type"] == "extra_forbidden":
        near = difflib.get_close_matches(str(keys[-1]), _keys(), n=1)
        meant = f"; did you mean {near[0]}?" if near else ""
        return f"{place}: found an unknown key, expected one of docs/tuning.md{meant}"
    message = item["msg"].removeprefix("Value error, ")
    if item["type"] == "value_error":
        return f"{place}: {message}"
    return f"{place}: found {shown(item['input'])}, expected {message.removeprefix('Input should be ')}"


def _keys() -> set[str]:
    """Every key there is."""
    models = (Spec, Range, CourseModel, _EightModel, _StepModel, _HoverModel, WindModel, Weights, Bounds, Search)
    return {name for model in models for name in model.model_fields}
