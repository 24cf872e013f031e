"""A campaign's flights in groups: how many ended well, how near they kept to their way and off what stands in it.

A row is a flight's, column by column (`campaigns.flying`). Flights are grouped by the axes that vary in them; seeds are
no axis, they are what the flights of a group repeat with.
"""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

Row = Mapping[str, Any]

AXES = ("mission", "autopilot", "method", "airframe", "gains", "wind", "gusts", "faults", "link")
"""What flights can differ in. `mission` is a world's family where it has one; `wind` is north and east."""
MOST_VALUES = 12
"""Of numbers; more are put into bins."""
BINS = 5
NONE = "none"
Z95 = 1.959963984540054
"""Two-sided 95 % of the normal distribution."""


@dataclass(frozen=True, slots=True)
class Group:
    """Flights that have something in common.

    Attributes
    ----------
    values : what it is, by axis.
    flights, ok : how many were flown, and ended as expected.
    low, high : 95 % interval of the part that ends well.
    p95_median_m, p95_worst_m : of the flights' 95th percentiles of the tracking error [m]; None: none was measured.
    clearance_m : least of all [m]; None: there was nothing near.
    simulated_s : of all flights together.
    """

    values: dict[str, str]
    flights: int
    ok: int
    low: float
    high: float
    p95_median_m: float | None
    p95_worst_m: float | None
    clearance_m: float | None
    simulated_s: float


def wilson(ok: int, flights: int) -> tuple[float, float]:
    """95 % score interval of a probability (Wilson 1927, eq. of section 2; Brown, Cai & DasGupta 2001, eq. 4)."""
    if flights == 0:
        return 0.0, 1.0
    p, n, zz = ok / flights, flights, Z95**2
    middle = (p + zz / (2 * n)) / (1 + zz / n)
    half = Z95 / (1 + zz / n) * math.sqrt(p * (1 - p) / n + zz / (4 * n * n))
    return max(0.0, min(middle - half, p)), min(1.0, max(middle + half, p))  # by rounding p could be outside


def flown(rows: Iterable[Row]) -> list[Row]:
    """Those that came to an end, well or not; the others say nothing about flying."""
    return [row for row in rows if row["status"] == "flown"]


def varying(rows: Sequence[Row]) -> list[str]:
    """The axes in which the rows differ."""
    return [axis for axis in AXES if len(set(labels(rows, axis))) > 1]


def labels(rows: Sequence[Row], column: str) -> list[str]:
    """What each row is by an axis or any column, in words; many different numbers are put into bins.

    Raises
    ------
    KeyError : there is no such column.
    """
    if column == "mission":
        return [str(row.get("family") or row["mission"]) for row in rows]
    if column == "wind":
        winds = [(float(row["wind_north"] or 0.0), float(row["wind_east"] or 0.0)) for row in rows]
        if len(set(winds)) <= MOST_VALUES:
            return [f"{north:g}, {east:g} m/s" for north, east in winds]
        return _numbers([math.hypot(*wind) for wind in winds], " m/s")
    values = [row[column] for row in rows]
    if all(isinstance(value, int | float) and not isinstance(value, bool) for value in values):
        return _numbers([float(value) for value in values])
    return [_word(value) for value in values]


def groups(rows: Sequence[Row], by: Sequence[str]) -> list[Group]:
    """The flights grouped by every combination of some columns that is there; by none: all in one.

    Raises
    ------
    KeyError : there is no such column.
    """
    of_column = [labels(rows, column) for column in by]
    members: dict[tuple[str, ...], list[Row]] = {}
    for row, *values in zip(rows, *of_column, strict=True):
        members.setdefault(tuple(values), []).append(row)
    ordered = sorted(members, key=lambda values: [_natural(value) for value in values])
    return [group_of(dict(zip(by, values, strict=True)), members[values]) for values in ordered]


def group_of(values: dict[str, str], rows: Sequence[Row]) -> Group:
    """The figures of some flights."""
    ok = sum(bool(row["ok"]) for row in rows)
    p95, clearances = numbers(rows, "tracking_p95_m"), numbers(rows, "min_clearance_m")
    low, high = wilson(ok, len(rows))
    return Group(
        values=values,
        flights=len(rows),
        ok=ok,
        low=low,
        high=high,
        p95_median_m=float(np.median(p95)) if len(p95) else None,
        p95_worst_m=float(p95.max()) if len(p95) else None,
        clearance_m=float(clearances.min()) if len(clearances) else None,
        simulated_s=float(sum(row["simulated_s"] or 0.0 for row in rows)),
    )


def numbers(rows: Iterable[Row], column: str) -> "np.ndarray[Any, np.dtype[np.float64]]":
    """A column's finite numbers, shape (at most the rows,)."""
    values = np.array([row[column] for row in rows if row[column] is not None], dtype=float)
    return np.asarray(values[np.isfinite(values)])


def _word(value: Any) -> str:
    return NONE if value is None or value == "" else str(value)


def _numbers(values: Sequence[float], unit: str = "") -> list[str]:
    """Numbers in words; of more than MOST_VALUES the bin of each, of which all hold as many."""
    if len(set(values)) <= MOST_VALUES:
        return [f"{value:g}{unit}" for value in values]
    edges = np.quantile(values, np.linspace(0.0, 1.0, BINS + 1))
    bins = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, BINS - 1)
    return [f"{edges[k]:.3g} to {edges[k + 1]:.3g}{unit}" for k in bins]


def _natural(text: str) -> list[tuple[float, str]]:
    """Sorts as people do: nothing first, and numbers in a text by their size."""
    if text == NONE:
        return []
    parts = re.split(r"((?:(?<!\w)-)?\d+(?:\.\d+)?)", text)
    return [(float(part), "") if k % 2 else (math.inf, part) for k, part in enumerate(parts) if part]
