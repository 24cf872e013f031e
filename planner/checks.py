"""Checks of what a caller hands over, where an object is built."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Point = tuple[float, float, float]


def as_point(name: str, value: Sequence[float] | NDArray[np.float64]) -> Point:
    """Three finite floats, or a ValueError that says what was found."""
    found = tuple(float(v) for v in value)
    if len(found) != 3 or not all(math.isfinite(v) for v in found):
        raise ValueError(f"{name}: expected three finite numbers, found {found}")
    return found


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
