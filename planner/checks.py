"""Checks of what a caller hands over, where an object is built."""

import math
from collections.abc import Sequence
from numbers import Integral, Real

import numpy as np
from numpy.typing import NDArray

Point = tuple[float, float, float]


def as_point(name: str, value: Sequence[float] | NDArray[np.float64]) -> Point:
    """Three finite floats, or a ValueError that says what was found."""
    try:
        found = tuple(float(v) for v in value) if not isinstance(value, str) else ()
    except (TypeError, ValueError):
        found = ()
    if len(found) != 3 or not all(math.isfinite(v) for v in found):
        raise ValueError(f"{name}: expected three finite numbers, found {found or repr(value)}")
    return found


def as_number(name: str, value: object, unit: str = "") -> float:
    """A finite float of at least 0, or an error: TypeError for what is no number, ValueError for another one."""
    wanted = f"{name}: expected a finite number of at least 0{unit and ' ' + unit}"
    if not isinstance(value, Real):
        raise TypeError(f"{wanted}, found {value!r}")
    number = float(value)
    if not (math.isfinite(number) and number >= 0.0):
        raise ValueError(f"{wanted}, found {value}")
    return number


def as_seed(name: str, value: object) -> int:
    """A whole number of at least 0, or an error: TypeError for what is none, ValueError for a negative one."""
    if not isinstance(value, Integral):
        raise TypeError(f"{name}: expected a whole number of at least 0, found {value!r}")
    if value < 0:
        raise ValueError(f"{name}: expected a whole number of at least 0, found {value}")
    return int(value)


def as_kind(name: str, value: object, kind: type) -> None:
    """TypeError unless `value` is a `kind`."""
    if not isinstance(value, kind):
        article = "an" if kind.__name__[0] in "AEIO" else "a"
        raise TypeError(f"{name}: expected {article} {kind.__name__}, found {value!r}")


def as_positive(name: str, value: float) -> float:
    """A finite float above 0, or a ValueError."""
    if not (math.isfinite(value) and value > 0):
        raise ValueError(f"{name}: expected a finite number above 0, found {value}")
    return float(value)


def as_interval(name: str, value: Sequence[float]) -> tuple[float, float]:
    """Two finite floats low < high, or a ValueError."""
    found = tuple(float(v) for v in value)
    if len(found) != 2 or not all(math.isfinite(v) for v in found):
        raise ValueError(f"{name}: expected two finite numbers, found {found}")
    if not found[0] < found[1]:
        raise ValueError(f"{name}: expected low < high, found {found}")
    return found
