"""Parameters: what they are called, what they may be, and their values now.

Each room lists its own parameters beside the code that obeys them (a module-level tuple named PARAMETERS); the vehicle
puts the lists together. Values are kept as floats (REAL32) or ints (INT32), as MAVLink carries them.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum

import numpy as np


class ParameterType(Enum):
    """MAV_PARAM_TYPE of the two kinds PX4 and ArduPilot use."""

    INT32 = 6
    REAL32 = 9


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter's description.

    Raises
    ------
    ValueError : the name is longer than MAVLink's 16 characters, or the default lies outside the range.
    """

    name: str
    default: float | int
    minimum: float
    maximum: float
    unit: str
    description: str
    type: ParameterType = ParameterType.REAL32

    def __post_init__(self) -> None:
        if not 0 < len(self.name) <= 16 or not self.name.isascii():
            raise ValueError(f"parameter name {self.name!r}: expected 1 to 16 ASCII characters")
        if not self.minimum <= self.default <= self.maximum:
            raise ValueError(f"{self.name}: default {self.default} is outside {self.minimum}..{self.maximum}")

    def coerced(self, value: float) -> float | int:
        """The value as this parameter would store it: rounded to its type.

        Raises
        ------
        ValueError : not finite or out of range; the message names the parameter, what was found and what is allowed.
        """
        if not np.isfinite(value):
            raise ValueError(f"{self.name}: {value} is not a finite number")
        if not self.minimum <= value <= self.maximum:
            allowed = f"{self.minimum:g}..{self.maximum:g} {self.unit}".rstrip()
            raise ValueError(f"{self.name}: {value:g} is outside {allowed}")
        return round(value) if self.type is ParameterType.INT32 else float(np.float32(value))


class ParameterSet:
    """The parameters of one vehicle, in the order MAVLink indexes them (by name).

    `version` counts changes, so that whoever caches derived values knows when to look again.
    """

    def __init__(self, parameters: Iterable[Parameter], overrides: Mapping[str, float] | None = None) -> None:
        self._by_name = {p.name: p for p in sorted(parameters, key=lambda p: p.name)}
        self._values: dict[str, float | int] = {name: p.coerced(p.default) for name, p in self._by_name.items()}
        self._names = tuple(self._by_name)
        self._index = {name: i for i, name in enumerate(self._names)}
        self.version = 0
        for name, value in (overrides or {}).items():
            self.set(name, value)

    def __len__(self) -> int:
        return len(self._names)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._by_name

    def __getitem__(self, name: str) -> float | int:
        return self._values[name]

    def describe(self, name: str) -> Parameter:
        """The parameter's description; KeyError when there is none of that name."""
        return self._by_name[name]

    def index(self, name: str) -> int:
        """Position in the list that PARAM_REQUEST_LIST walks."""
        return self._index[name]

    def name_at(self, index: int) -> str:
        """Inverse of `index`; IndexError outside 0..len-1."""
        if not 0 <= index < len(self._names):
            raise IndexError(f"parameter index {index}: expected 0..{len(self._names) - 1}")
        return self._names[index]

    def set(self, name: str, value: float) -> None:
        """Set one value.

        Raises
        ------
        KeyError : no parameter of that name.
        ValueError : not finite or out of range (see `Parameter.coerced`).
        """
        self._values[name] = self._by_name[name].coerced(value)
        self.version += 1
