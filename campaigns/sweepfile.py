"""SWEEP.yaml: what is swept, as people write it; read and checked once, every problem with its line.

docs/campaigns.md has every key. What the file names (missions, parameter files, airframes) is looked at by `sweep`.
"""

import difflib
import re
from collections import Counter
from pathlib import Path
from typing import Annotated, Any, Literal

import yaml
from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationError,
    field_validator,
    model_validator,
)

from companion.errors import ConfigError
from companion.testing.wire import LinkFaults
from companion.yamlfile import line_of, read_yaml, shown
from fakevehicle.config import Autopilot
from fakevehicle.faults import MOST as MOST_FAULTS
from fakevehicle.faults import parse_fault
from planner import METHODS
from planner.families import FAMILIES

MAX_BYTES = 1_000_000
MOST_VALUES = 100_000
"""Of one axis."""
MOST_RUNS = 200_000
MOST_SEED = 2**31 - 1
EXPECTED = "a mapping with missions or worlds, seeds, and other axes"
MISSION = "mission"
"""The word for what the mission itself says."""
_RANGE = re.compile(r"(\d{1,10})-(\d{1,10})")

Real = Annotated[float, Field(allow_inf_nan=False)]
Speed = Annotated[float, Field(ge=-60, le=60, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0, le=1)]
Seed = Annotated[int, Field(ge=0, le=MOST_SEED)]
Name = Annotated[str, Field(min_length=1, max_length=200)]


class Model(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


def _seeds(value: Any) -> Any:
    """`1-50` is the seeds from 1 to 50."""
    if isinstance(value, str):
        match = _RANGE.fullmatch(value.strip())
        if match is None:
            raise ValueError(f"found {value!r}, expected a count, a list, or FIRST-LAST such as 1-50")
        first, last = int(match[1]), int(match[2])
        if not first <= last <= MOST_SEED or last - first >= MOST_VALUES:
            raise ValueError(f"found {value!r}, expected FIRST <= LAST, at most {MOST_VALUES} of them")
        return list(range(first, last + 1))
    return value


Seeds = Annotated[
    Annotated[int, Field(ge=1, le=MOST_VALUES)] | Annotated[list[Seed], Field(min_length=1, max_length=MOST_VALUES)],
    BeforeValidator(_seeds),
]
"""A count, drawn from the sweep's `seed`; or the seeds themselves."""


class Gust(Model):
    at: Annotated[Real, Field(ge=0)]
    rise: Annotated[Real, Field(ge=0)] = 0.5
    hold: Annotated[Real, Field(ge=0)] = 2.0
    velocity: Annotated[list[Real], Field(min_length=3, max_length=3)]  # north, east, down


class Wind(Model):
    """Velocity of the air over ground [m/s], and gusts on top; with `of_mission` the mission's wind."""

    north: Speed = 0.0
    east: Speed = 0.0
    down: Speed = 0.0
    gusts: Annotated[list[Gust], Field(max_length=1000)] = []
    of_mission: bool = False


class Link(Model):
    """As `companion.testing.wire.LinkFaults` has them."""

    loss: Share = 0.0
    duplicate: Share = 0.0
    reorder: Share = 0.0
    jitter_ms: Annotated[Real, Field(ge=0, le=10_000)] = 0.0
    blackouts: Annotated[list[Annotated[list[Real], Field(min_length=2, max_length=2)]], Field(max_length=1000)] = []
    garbage: Annotated[Real, Field(ge=0, le=1000)] = 0.0
    shouting: bool = False

    @model_validator(mode="after")
    def _can_be(self) -> "Link":
        self.faults(0)
        return self

    def faults(self, seed: int) -> LinkFaults | None:
        """As the flight takes them; None when nothing goes wrong."""
        values = self.model_dump()
        if values == Link.model_construct().model_dump():
            return None
        values["blackouts"] = tuple((start, end) for start, end in self.blackouts)
        return LinkFaults(**values, seed=seed)


class Gains(Model):
    """A preset, then a parameter file, then single parameters; and what they are called together."""

    name: Name = ""
    preset: Literal["default", "paper", "pid", "tid", "fopid"] = "default"
    file: Name | None = None
    set: dict[Name, Real] = {}

    @property
    def label(self) -> str:
        """Its name, or else what it is made of."""
        if self.name:
            return self.name
        parts = [Path(self.file).stem] if self.file else []
        parts += [f"{name}={value:g}" for name, value in self.set.items()]
        return " ".join([self.preset] * (self.preset != "default" or not parts) + parts)


class Worlds(Model):
    family: Annotated[str, Field(max_length=20)]
    seeds: Seeds = [1]

    @field_validator("family")
    @classmethod
    def _known(cls, family: str) -> str:
        if family not in FAMILIES:
            raise ValueError(f"found {family!r}, expected one of {', '.join(FAMILIES)}")
        return family


class Recordings(Model):
    """How many are kept: of the flights that fail, and of all of them, drawn."""

    failures: Annotated[int, Field(ge=0, le=MOST_RUNS)] = 20
    sample: Annotated[int, Field(ge=0, le=MOST_RUNS)] = 5


def _wind(value: Any) -> Any:
    """`mission`, or [north, east]."""
    if value == MISSION:
        return {"of_mission": True}
    if isinstance(value, list) and len(value) == 2:
        return {"north": value[0], "east": value[1]}
    if isinstance(value, dict) and "of_mission" in value:
        raise ValueError(f"found of_mission, expected the word {MISSION}")
    return value


def _gains(value: Any) -> Any:
    """A preset's name, or a parameter file's."""
    if isinstance(value, str):
        return {"file": value} if Path(value).suffix else {"preset": value}
    return value


def _faults(value: Any) -> Any:
    """A single one; or the word `none`."""
    return [] if value == "none" else [value] if isinstance(value, str) else value


def _link(value: Any) -> Any:
    return {} if value == "none" else value


def _fault(text: str) -> str:
    parse_fault(text)
    return text


Faults = Annotated[
    list[Annotated[str, AfterValidator(_fault)]], Field(max_length=MOST_FAULTS), BeforeValidator(_faults)
]
Method = Literal["mission", "haoaroa", "astar", "jps", "bezier", "lbsgf", "aoa", "roa"]
assert set(METHODS) | {MISSION} == set(Method.__args__)  # type: ignore[attr-defined]  # a Literal has them


class SweepFile(Model):
    """The whole file."""

    name: Annotated[str, Field(min_length=1, max_length=100)]
    missions: Annotated[list[Name], Field(max_length=1000)] = []
    worlds: Annotated[list[Worlds], Field(max_length=100)] = []
    seeds: Seeds = [1]
    autopilots: Annotated[list[Autopilot], Field(min_length=1, max_length=2)] = ["px4"]
    winds: Annotated[list[Annotated[Wind, BeforeValidator(_wind)]], Field(min_length=1, max_length=MOST_VALUES)] = [
        Wind(of_mission=True)
    ]
    faults: Annotated[list[Faults], Field(min_length=1, max_length=1000)] = [[]]
    links: Annotated[list[Annotated[Link, BeforeValidator(_link)]], Field(min_length=1, max_length=1000)] = [Link()]
    airframes: Annotated[list[Name], Field(min_length=1, max_length=100)] = ["x500"]
    gains: Annotated[list[Annotated[Gains, BeforeValidator(_gains)]], Field(min_length=1, max_length=1000)] = [Gains()]
    methods: Annotated[list[Method], Field(min_length=1, max_length=10)] = ["mission"]
    seed: Seed = 1
    sample: Annotated[int, Field(ge=1, le=MOST_RUNS)] | None = None
    limit_s: Annotated[Real, Field(ge=1, le=86_400)] = 600.0
    timeout_s: Annotated[Real, Field(ge=1, le=86_400)] = 600.0
    recordings: Recordings = Recordings()

    @field_validator("missions", "autopilots", "winds", "faults", "links", "airframes", "gains", "methods", "seeds")
    @classmethod
    def _each_once(cls, axis: Any) -> Any:
        if isinstance(axis, list):
            told = [repr(value) for value in axis]
            most, times = Counter(told).most_common(1)[0] if told else ("", 1)
            if times > 1:
                raise ValueError(f"found {shown(axis[told.index(most)])} twice, expected each value once")
        return axis

    @model_validator(mode="after")
    def _something(self) -> "SweepFile":
        if not self.missions and not self.worlds:
            raise ValueError("found neither missions nor worlds, expected at least one of them")
        return self


def read_sweep(path: Path) -> tuple[SweepFile, yaml.MappingNode, bytes]:
    """Read and check a file: what it says, its nodes, which know their lines, and its bytes.

    Raises
    ------
    ConfigError : it cannot be read, is too large, not YAML, or not a sweep; every problem has its own line.
    """
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        raise ConfigError(str(path), [f"cannot be read: {error.strerror or error}"]) from error
    document, node = read_yaml(data, str(path), ConfigError, most_bytes=MAX_BYTES, expected=EXPECTED)
    try:
        return SweepFile.model_validate(document), node, data
    except ValidationError as error:
        raise ConfigError(str(path), _problems(error, document, node)) from error


def _problems(error: ValidationError, document: dict[Any, Any], node: yaml.MappingNode) -> list[str]:
    """One line for each place: `line N: key: found ..., expected ...`."""
    told: dict[str, str] = {}
    for item in error.errors():
        keys = _path(item["loc"], document)
        place = f"line {line_of(node, keys)}: {'.'.join(map(str, keys)) or 'sweep'}"
        told.setdefault(place, f"{place}: {_what(item, keys)}")
    return list(told.values())


def _path(loc: tuple[Any, ...], document: Any) -> list[Any]:
    """The keys of a place, without pydantic's own words for the forms that a value can have."""
    keys: list[Any] = []
    for k, key in enumerate(loc):
        inside = isinstance(document, list) if isinstance(key, int) else isinstance(document, dict)
        if inside and (isinstance(document, list) or key in document or k == len(loc) - 1):
            keys.append(key)
            document = document[key] if isinstance(document, list) else document.get(key)
    return keys


def _what(item: Any, keys: list[Any]) -> str:
    message = item["msg"].removeprefix("Value error, ")
    if item["type"] == "missing":
        return "found nothing, expected a value"
    if item["type"] == "extra_forbidden":
        near = difflib.get_close_matches(str(keys[-1]), _keys(), n=1)
        meant = f"; did you mean {near[0]}?" if near else ""
        return f"found an unknown key, expected one of docs/campaigns.md{meant}"
    if item["type"] == "value_error":
        return message if "expected" in message else f"{message}, found {shown(item['input'])}"
    if keys and keys[-1] == "seeds":
        return f"found {shown(item['input'])}, expected a count, a list of seeds, or FIRST-LAST such as 1-50"
    expected = _FORMS.get(item["type"]) or message.removeprefix("Input should be ").split(", unable")[0]
    if keys and keys[0] in _SHORT and item["type"] == "model_type":
        expected = _SHORT[str(keys[0])]
    return f"found {shown(item['input'])}, expected {expected}"


_FORMS = {
    "too_short": "at least one value",
    "too_long": "fewer values",
    "model_type": "a mapping",
    "dict_type": "a mapping",
    "list_type": "a list",
    "string_type": "text",
}
_SHORT = {
    "winds": f"the word {MISSION}, [NORTH, EAST] in m/s, or a mapping",
    "links": "the word none, or a mapping",
    "gains": "a preset, a parameter file, or a mapping",
}


def _keys() -> set[str]:
    """Every key there is."""
    models: tuple[type[BaseModel], ...] = (SweepFile, Gust, Wind, Link, Gains, Worlds, Recordings)
    return {name for model in models for name in model.model_fields} - {"of_mission"}
