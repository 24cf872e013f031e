"""Parameter files as ground stations write them, so that a vehicle starts with what a real one flies.

Three forms, told apart line by line; `#` begins a comment:

    1   1   MPC_XY_CRUISE   5.0   9     QGroundControl's .params: vehicle, component, name, value, type
    RTL_ALT          3000.000000        MAVProxy's and ArduPilot's .parm
    RTL_ALT,3000                        Mission Planner's .param

Such files hold everything that a real autopilot has. What this vehicle has no parameter for is passed over and counted;
what is fixed at its start (the system id) likewise. Of a line that cannot be meant so, nothing is guessed.
"""

import math
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path

from fakevehicle.errors import ParameterFileError
from fakevehicle.params import ParameterSet, ParameterType

MOST_BYTES = 1_000_000
NAMED = 5
"""Names of those passed over that `ParameterFile.summary` tells."""
FORM = "NAME VALUE, or VEHICLE COMPONENT NAME VALUE TYPE"
AUTOPILOT = "1"
"""Component of the autopilot; a file may hold other components', too."""
_BETWEEN = re.compile(r"[\s,=]+")
_NAME = re.compile(r"[A-Za-z0-9_]{1,16}")


@dataclass(frozen=True, slots=True)
class ParameterFile:
    """What a file asks for.

    Attributes
    ----------
    path : as it was named.
    values : by name, as the vehicle would store them.
    passed_over : names that this vehicle does not have, or not to be set.
    """

    path: str
    values: dict[str, float]
    passed_over: tuple[str, ...]

    def summary(self) -> str:
        """One line for people."""
        line = f"{self.path}: {len(self.values)} parameters set"
        if not self.passed_over:
            return line
        names = ", ".join(self.passed_over[:NAMED]) + (", ..." if len(self.passed_over) > NAMED else "")
        return f"{line}, {len(self.passed_over)} passed over that this vehicle has not or has fixed: {names}"


def load_parameter_file(path: Path, known: ParameterSet, fixed: Collection[str] = ()) -> ParameterFile:
    """Read a file.

    Parameters
    ----------
    path : of the file.
    known : the vehicle's parameters, under the names and in the units of its flavour. They are not changed.
    fixed : names that cannot be set.

    Raises
    ------
    ParameterFileError : it cannot be read, a line is none of the forms, a value cannot be, or it has no name in common
        with the vehicle; the message says file, line, what was found and what was expected.
    """
    try:
        with path.open("rb") as file:
            data = file.read(MOST_BYTES + 1)
        text = data.decode("utf-8-sig")
    except OSError as error:
        raise ParameterFileError(str(path), 0, error.strerror or "it cannot be read") from error
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise ParameterFileError(str(path), line, "found bytes that are no text, expected " + FORM) from error
    if len(data) > MOST_BYTES:
        raise ParameterFileError(str(path), 0, f"found more than {MOST_BYTES // 1_000_000} MB, expected a few lines")
    values: dict[str, float] = {}
    passed_over: dict[str, None] = {}
    for number, name, written in _entries(str(path), text):
        if name not in known or name in fixed:
            passed_over[name] = None
            continue
        try:
            values[name] = _value(written, name, known)
        except ValueError as error:
            raise ParameterFileError(str(path), number, str(error)) from error
    if not values:
        found = f"{len(passed_over)} names that are not its" if passed_over else "nothing"
        raise ParameterFileError(str(path), 0, f"found {found}, expected at least one parameter of this vehicle")
    return ParameterFile(str(path), values, tuple(passed_over))


def _entries(path: str, text: str) -> Iterator[tuple[int, str, str]]:
    """Line number, name and value of every line that has one."""
    for number, whole in enumerate(text.splitlines(), start=1):
        line = whole.partition("#")[0].strip()
        if not line:
            continue
        match _BETWEEN.split(line):
            case [name, value] | [name, value, "@READONLY"] if _NAME.fullmatch(name):
                yield number, name, value
            case [vehicle, component, name, value, kind] if (vehicle + component + kind).isdecimal():
                if component == AUTOPILOT:
                    yield number, name, value
            case _:
                raise ParameterFileError(path, number, f"found {line[:60]!r}, expected {FORM}")


def _value(written: str, name: str, known: ParameterSet) -> float:
    """The number, as the parameter would store it."""
    try:
        value = float(int(written, 16)) if written.lower().startswith("0x") else float(written)
    except ValueError:
        raise ValueError(f"{name}: found {written[:40]!r}, expected a number") from None
    p = known.describe(name)
    if p.type is ParameterType.INT32 and math.isfinite(value) and value != math.floor(value):
        raise ValueError(f"{name}: found {value:g}, expected a whole number")
    if not p.minimum <= value <= p.maximum:
        raise ValueError(f"{name}: found {value:g}, expected {p.minimum:g}..{p.maximum:g} {p.unit}".rstrip())
    return float(p.coerced(value))
