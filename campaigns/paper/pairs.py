"""Two methods in the same worlds: the mean ratio with its confidence interval, so that the worlds cancel out.

What was flown is compared over flights that ended as their missions expect.
"""

import math
from typing import Any

import numpy as np

from campaigns.tuning.statistics import mean

FLOWN = frozenset({"tracking_percentile_m"})
"""Columns that are a flight's, not the plan's."""


def versus(rows: list[dict[str, Any]], column: str, method: str, rival: str) -> dict[str, Any]:
    """How many times as much of a column `rival` has as `method`, over the worlds where both have a value.

    Returns
    -------
    n : worlds; ratio, low, high : geometric mean and its interval, None where there are fewer than two.
    less : worlds in which the method has less; largest : difference, whichever way.
    """
    ours, theirs = _column(rows, column, method), _column(rows, column, rival)
    both = [world for world in ours if world in theirs]
    found: dict[str, Any] = {"column": column, "method": method, "rival": rival, "n": len(both)}
    if len(both) < 2:
        return found | dict.fromkeys(("ratio", "low", "high", "less", "largest"))
    told = mean(np.array([math.log(theirs[world] / ours[world]) for world in both]))
    return found | {
        "ratio": math.exp(told.mean),
        "low": math.exp(told.mean - told.half),
        "high": math.exp(told.mean + told.half),
        "less": sum(theirs[world] > ours[world] for world in both),
        "largest": max(abs(theirs[world] - ours[world]) for world in both),
    }


def all_pairs(rows: list[dict[str, Any]], columns: tuple[str, ...], methods: tuple[str, ...]) -> list[dict[str, Any]]:
    """Every method against every other, in every column; the values are above zero."""
    return [versus(rows, c, a, b) for c in columns for a in methods for b in methods if a != b]


def _column(rows: list[dict[str, Any]], column: str, method: str) -> dict[tuple[str, int], float]:
    """The values that a method has, by world."""
    mine = [row for row in rows if row["method"] == method and row.get(column) is not None]
    mine = [row for row in mine if column not in FLOWN or row["flown_ok"]]
    return {(row["family"], row["seed"]): float(row[column]) for row in mine}
