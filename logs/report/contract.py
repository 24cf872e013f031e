"""What the page shows: the contract between those who gather a flight and the script that draws it, version 1.

One JSON object, the same for a report and for the live view. Long columns travel as little-endian float32 in base64,
even times as three numbers. Times are seconds from the start of the flight; places are (north, east, up) from the
mission's origin [m]; angles are radians. None, NaN and infinities leave a gap in a line.

The live view gets the whole object first and then `{"append": {...}}`:

    series      {plot id: {label: [[t, ...], [v, ...]]}}
    path, reference, truth     [[t, n, e, u], ...]; path may go on with roll, pitch, yaw
    pose        {"n", "e", "u", "roll", "pitch", "yaw"}
    plans, events              further entries, as below
    movers      [{"id", "radius", "t", "n", "e", "u"}]: their columns are appended by id
    header, scene              fields that replace those of before
    histograms, tables         whole ones, in the place of those of the same id (histograms) or title (tables)

The page answers with `{"order": name, "values": [...], "token": token}`: land, hold, resume, and goto with north, east,
altitude. `{"answer": {"order": name, "ok": true or false, "text": ...}}` is shown to the person who gave it.
"""

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

VERSION = 1
FRAME = "NED metres from the mission's origin, shown as north/east/up"
SECTIONS = (
    "verdict", "path", "tracking", "setpoints", "estimator", "actuators", "planning", "link", "timeline", "parameters",
)  # fmt: skip
"""In this order on the page; others follow, by name."""

Point = tuple[float, float, float]  # north, east, up [m]
Column = NDArray[np.floating[Any]] | Sequence[float]
Json = dict[str, Any]
_EVEN_S = 1e-6  # times this close to even ones are even [s]


def array(values: ArrayLike) -> Any:
    """A column as the page reads it: a list when short, three numbers when even, else float32 in base64.

    Parameters
    ----------
    values : any shape; read in C order, so (k, 3) is n e u n e u ...
    """
    flat = np.asarray(values, dtype=np.float64).ravel()
    if flat.size > 2 and np.isfinite(flat).all():
        step = (flat[-1] - flat[0]) / (flat.size - 1)
        if step > 0 and np.abs(flat - (flat[0] + step * np.arange(flat.size))).max() < _EVEN_S:
            return {"u": int(flat.size), "t0": float(flat[0]), "dt": float(step)}
    if flat.size <= 4:
        return [float(v) if np.isfinite(v) else None for v in flat]
    return {"f32": base64.b64encode(flat.astype("<f4").tobytes()).decode()}


@dataclass(frozen=True, slots=True)
class Check:
    """One expectation and what came of it; `expected` says how it was judged, such as ``<= 0.35``."""

    name: str
    value: float | str | None
    expected: float | str | None
    ok: bool | None


@dataclass(frozen=True, slots=True)
class Header:
    """The verdict. `ok` None: none yet, or nothing was expected."""

    title: str
    ok: bool | None = None
    phase: str = ""
    failure: str = ""
    start_utc: str | None = None
    duration_s: float = 0.0
    checks: tuple[Check, ...] = ()
    facts: tuple[tuple[str, str | float], ...] = ()
    loss: tuple[tuple[str, int], ...] = ()

    def to_json(self) -> Json:
        """As the page reads it."""
        checks = [{"name": c.name, "value": c.value, "expected": c.expected, "ok": c.ok} for c in self.checks]
        return {
            "title": self.title,
            "ok": self.ok,
            "phase": self.phase,
            "failure": self.failure,
            "start_utc": self.start_utc,
            "duration_s": self.duration_s,
            "checks": checks,
            "facts": [list(fact) for fact in self.facts],
            "loss": [list(entry) for entry in self.loss],
        }


@dataclass(frozen=True, slots=True)
class Track:
    """Where something was: equally long columns; attitude [rad] and error [m] where they are known."""

    t: Column
    n: Column
    e: Column
    u: Column
    roll: Column | None = None
    pitch: Column | None = None
    yaw: Column | None = None
    error: Column | None = None  # distance from where it should have been [m]; the page colours by it

    def to_json(self) -> Json:
        """As the page reads it."""
        columns = {name: getattr(self, name) for name in ("t", "n", "e", "u", "roll", "pitch", "yaw", "error")}
        return {name: array(column) for name, column in columns.items() if column is not None}


@dataclass(frozen=True, slots=True)
class Way:
    """A plan made at `t` [s]: (k, 3) points north, east, up [m]."""

    t: float
    points: ArrayLike
    kind: Literal["plan", "switch", "backup"] = "plan"


@dataclass(frozen=True, slots=True)
class Mover:
    """Something that moves by itself, as it was heard of or seen."""

    id: str
    radius: float
    track: Track


@dataclass(frozen=True, slots=True)
class Scene:
    """The flight in space. `obstacles` are objects of `box`, `cylinder`, `sphere`, `prism` and `cells`."""

    path: Track
    obstacles: tuple[Json, ...] = ()
    bounds: tuple[Point, Point] | None = None
    fence: tuple[tuple[float, float], ...] | None = None
    truth: Track | None = None
    reference: Track | None = None
    plans: tuple[Way, ...] = ()
    movers: tuple[Mover, ...] = ()
    least: tuple[float, Point, float] | None = None  # least clearance: when [s], where, how much [m]

    def to_json(self) -> Json:
        """As the page reads it."""
        least = None
        if self.least is not None:
            t, at, clearance = self.least
            least = {"t": t, "at": list(at), "clearance": clearance}
        return {
            "obstacles": list(self.obstacles),
            "bounds": None if self.bounds is None else [list(corner) for corner in self.bounds],
            "fence": None if self.fence is None else [list(corner) for corner in self.fence],
            "path": self.path.to_json(),
            "truth": None if self.truth is None else self.truth.to_json(),
            "reference": None if self.reference is None else self.reference.to_json(),
            "plans": [{"t": p.t, "points": array(p.points), "kind": p.kind} for p in self.plans],
            "movers": [{"id": m.id, "radius": m.radius, **m.track.to_json()} for m in self.movers],
            "least": least,
        }


def box(low: Point, high: Point, label: str = "") -> Json:
    """An upright box between two corners."""
    return {"kind": "box", "low": list(low), "high": list(high), "label": label}


def cylinder(base: Point, radius: float, height: float, label: str = "") -> Json:
    """An upright cylinder from the middle of its foot."""
    return {"kind": "cylinder", "base": list(base), "radius": radius, "height": height, "label": label}


def sphere(centre: Point, radius: float, label: str = "") -> Json:
    """A ball."""
    return {"kind": "sphere", "centre": list(centre), "radius": radius, "label": label}


def prism(polygon: Sequence[tuple[float, float]], low: float, high: float, label: str = "") -> Json:
    """A polygon of (north, east) corners between two altitudes."""
    return {"kind": "prism", "polygon": [list(corner) for corner in polygon], "low": low, "high": high, "label": label}


def cells(size: float, at: ArrayLike) -> Json:
    """Cubes of a map, by their centres (k, 3)."""
    return {"kind": "cells", "size": size, "at": array(at)}


@dataclass(frozen=True, slots=True)
class Series:
    """One line, staircase or cloud of dots over time."""

    label: str
    t: Column
    v: Column
    style: Literal["line", "step", "dots"] = "line"


@dataclass(frozen=True, slots=True)
class Plot:
    """Series that share an axis; `bounds` are levels drawn across it; `id` is unique on the page."""

    id: str
    section: str
    title: str
    unit: str
    series: tuple[Series, ...]
    bounds: tuple[tuple[str, float], ...] = ()
    note: str = ""

    def to_json(self) -> Json:
        """As the page reads it."""
        series = [{"label": s.label, "t": array(s.t), "v": array(s.v), "style": s.style} for s in self.series]
        return {
            "id": self.id,
            "section": self.section,
            "title": self.title,
            "unit": self.unit,
            "series": series,
            "bounds": [{"label": label, "value": value} for label, value in self.bounds],
            "note": self.note,
        }


@dataclass(frozen=True, slots=True)
class Histogram:
    """`edges` has one more entry than `counts`; `marks` are values worth a line, such as a p95."""

    id: str
    section: str
    title: str
    unit: str
    edges: Column
    counts: Sequence[int]
    marks: tuple[tuple[str, float], ...] = ()
    note: str = ""

    def to_json(self) -> Json:
        """As the page reads it."""
        return {
            "id": self.id,
            "section": self.section,
            "title": self.title,
            "unit": self.unit,
            "edges": [float(edge) for edge in self.edges],
            "counts": [int(count) for count in self.counts],
            "marks": [{"label": label, "value": value} for label, value in self.marks],
            "note": self.note,
        }


@dataclass(frozen=True, slots=True)
class Event:
    """One line of the timeline; `level` is 3 error, 4 warning, 6 information."""

    t: float
    kind: Literal["phase", "text", "command", "ack", "order", "failsafe", "mode"]
    level: int
    text: str

    def to_json(self) -> Json:
        """As the page reads it."""
        return {"t": self.t, "kind": self.kind, "level": self.level, "text": self.text}


@dataclass(frozen=True, slots=True)
class Table:
    """A table of strings and numbers."""

    section: str
    title: str
    columns: tuple[str, ...]
    rows: Sequence[Sequence[str | float | None]]

    def to_json(self) -> Json:
        """As the page reads it."""
        rows = [list(row) for row in self.rows]
        return {"section": self.section, "title": self.title, "columns": list(self.columns), "rows": rows}


@dataclass(frozen=True, slots=True)
class Report:
    """Everything on the page."""

    header: Header
    scene: Scene
    plots: tuple[Plot, ...] = ()
    histograms: tuple[Histogram, ...] = ()
    events: tuple[Event, ...] = ()
    tables: tuple[Table, ...] = ()

    def to_json(self) -> Json:
        """The one object of the contract."""
        return {
            "version": VERSION,
            "header": self.header.to_json(),
            "frame": FRAME,
            "scene": self.scene.to_json(),
            "plots": [plot.to_json() for plot in self.plots],
            "histograms": [histogram.to_json() for histogram in self.histograms],
            "events": [event.to_json() for event in self.events],
            "tables": [table.to_json() for table in self.tables],
        }
