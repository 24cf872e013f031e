"""What a section of a report is made of, and the surroundings that a recording alone does not tell."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from logs.report import contract as c
from logs.report.columns import FloatArray, pause_s, percentiles, short, with_gaps

TableRows = list[list[str | float | None]]
BEYOND = 1e30
"""No value is so great; a page's float32 could not hold it."""
MOST_SECONDS = 200_000
"""A flight is no longer than two days."""
Style = Literal["line", "step", "dots"]


@dataclass(slots=True)
class Part:
    """One section. `missing` says why it is left out, when nothing else is in it."""

    plots: list[c.Plot] = field(default_factory=list)
    histograms: list[c.Histogram] = field(default_factory=list)
    tables: list[c.Table] = field(default_factory=list)
    events: list[c.Event] = field(default_factory=list)
    missing: str = ""

    @property
    def empty(self) -> bool:
        """Whether there is nothing to show."""
        return not (self.plots or self.histograms or self.tables or self.events)


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What the mission in a recording says of the world; NED and north/east/up as in the contract.

    Attributes
    ----------
    name : of the mission. obstacles : as the contract has them. bounds, fence : likewise.
    clearance : (n, 3) NED -> (n,) distance of the hull to the nearest obstacle [m]; None: there is none.
    radius : of the hull [m]. limits : names and values, for levels across plots (`speed`).
    expected : name of a figure -> (bound, whether it is a least one).
    """

    name: str = ""
    obstacles: tuple[c.Json, ...] = ()
    bounds: tuple[c.Point, c.Point] | None = None
    fence: tuple[tuple[float, float], ...] | None = None
    clearance: Callable[[FloatArray], FloatArray] | None = None
    radius: float = 0.0
    limits: dict[str, float] = field(default_factory=dict)
    expected: dict[str, tuple[float, bool]] = field(default_factory=dict)
    phase: str = "done"


def lines(
    t: FloatArray, columns: dict[str, Any], style: Style = "line", pause: float | None = None
) -> tuple[c.Series, ...]:
    """Series over common times, with gaps where the stream paused, short enough for the page."""
    named = {name: np.asarray(column, dtype=np.float64) for name, column in columns.items()}
    named = {name: np.where(np.abs(column) < BEYOND, column, np.nan) for name, column in named.items()}
    named = {name: column for name, column in named.items() if np.isfinite(column).any()}
    if not len(t) or not named:
        return ()
    t, values = with_gaps(t, list(named.values()), pause_s(t) if pause is None else pause)
    t, *values = short(t, *values)
    return tuple(c.Series(name, t, column, style) for name, column in zip(named, values, strict=True))


def histogram(
    id: str, section: str, title: str, unit: str, values: FloatArray, bins: int = 40, note: str = ""
) -> c.Histogram | None:
    """Counts of the finite values with p50, p95 and the greatest marked; the far tail is in the last class."""
    finite = values[np.isfinite(values)]
    if len(finite) < 2:
        return None
    p50, p95, p995 = percentiles(finite, [50, 95, 99.5])
    least, most = float(finite.min()), float(finite.max())
    top = most if most <= least + 2 * (p995 - least) else p995 + 0.2 * (p995 - least)
    if top - least < 1e-6 * max(1.0, abs(top)):
        least, top = least - 0.5, least + 0.5
    counts, edges = np.histogram(np.minimum(finite, top), bins=bins, range=(least, top))
    if top < most:
        note = f"{note} The last class holds all up to {most:.4g} {unit}.".strip()
    marks = (("p50", p50), ("p95", p95)) if p95 > p50 else (("p50", p50),)
    return c.Histogram(id, section, title, unit, edges, counts.tolist(), marks, note)


def row(name: str, values: FloatArray, digits: int = 4) -> list[str | float | None]:
    """A table's row: name, p50, p95, greatest."""
    finite = values[np.isfinite(values)]
    figures = [*percentiles(finite, [50, 95]), float(finite.max())] if len(finite) else [np.nan] * 3
    return [name, *(round(v, digits) if np.isfinite(v) else None for v in figures)]


def each_second(
    counts: dict[int, tuple[int, int]], which: int, first_s: int, last_s: int
) -> tuple[FloatArray, FloatArray]:
    """Counts a second, with zeros where nothing came."""
    wild = last_s - first_s > MOST_SECONDS  # times that cannot be: only the seconds in which something came
    seconds = np.array(sorted(counts)) if wild else np.arange(first_s, last_s + 1)
    values = np.array([counts.get(int(s), (0, 0))[which] for s in seconds], dtype=np.float64)
    return seconds.astype(np.float64), values
