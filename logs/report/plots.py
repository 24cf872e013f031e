"""Pictures of a report: one figure a section, with the scene from above and from the side, for papers and tickets.

Colours are of the Okabe-Ito palette, which people tell apart however they see colours.
"""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

from logs.errors import RecordingError
from logs.report import contract as c

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#6a3d9a", "#000000")
_LEVEL = {3: "#c02020", 4: "#b8860b", 6: "#555555"}
_DRAWN: dict[str, dict[str, Any]] = {"line": {"linewidth": 1.0}, "step": {"linewidth": 1.0, "drawstyle": "steps-post"}}
_DOTS: dict[str, Any] = {"linestyle": "none", "marker": ".", "markersize": 3}
WIDTH = 10.0
DPI = 110


def write_pictures(report: c.Report, folder: Path) -> list[Path]:
    """Write ``path-3d.png`` and one ``SECTION.png`` for each section that has plots; returns them in order.

    Raises
    ------
    RecordingError    The folder or a file cannot be written.
    """
    figures: list[tuple[str, Figure]] = [("scene", _scene(report))] if np.size(report.scene.path.t) else []
    for section in c.SECTIONS:
        drawn: list[Callable[[Axes], None]] = [_plotter(plot) for plot in report.plots if plot.section == section]
        drawn += [_bars(shown) for shown in report.histograms if shown.section == section]
        if section == "timeline" and report.events:
            drawn = [_events(report)]
        if drawn:
            figures.append((section, _figure(f"{report.header.title}: {section}", drawn)))
    written = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, figure in figures:
            path = folder / f"{name}.png"
            figure.savefig(path, dpi=DPI)
            written.append(path)
    except OSError as error:
        raise RecordingError(folder, f"cannot write the pictures: {error.strerror or error}") from error
    return written


def _figure(title: str, drawn: list[Callable[[Axes], None]]) -> Figure:
    columns = 1 if len(drawn) == 1 else 2
    rows = math.ceil(len(drawn) / columns)
    figure = Figure(figsize=(WIDTH if columns == 1 else 1.4 * WIDTH, 0.5 + 3.0 * rows), layout="constrained")
    figure.suptitle(title, fontsize=11)
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for draw, at in zip(drawn, axes, strict=False):
        draw(at)
    for at in axes[len(drawn) :]:
        at.set_visible(False)
    return figure


def _plotter(plot: c.Plot) -> Callable[[Axes], None]:
    def draw(at: Axes) -> None:
        for k, series in enumerate(plot.series):
            style: dict[str, Any] = _DRAWN.get(series.style, _DOTS)
            at.plot(series.t, series.v, color=COLOURS[k % len(COLOURS)], label=series.label, **style)
        for label, value in plot.bounds:
            at.axhline(value, color="#888888", linewidth=0.8, linestyle="--")
            at.annotate(label, (1.0, value), xycoords=("axes fraction", "data"), fontsize=7, ha="right", va="bottom")
        at.set_title(plot.title, fontsize=9)
        at.set_xlabel("time [s]", fontsize=8)
        at.set_ylabel(plot.unit, fontsize=8)
        _tidy(at)
        if len(plot.series) > 1:
            at.legend(fontsize=7, loc="best", framealpha=0.7)

    return draw


def _bars(shown: c.Histogram) -> Callable[[Axes], None]:
    def draw(at: Axes) -> None:
        edges = np.asarray(shown.edges, dtype=np.float64)
        at.bar(edges[:-1], shown.counts, width=np.diff(edges), align="edge", color=COLOURS[5], edgecolor="white")
        for k, (label, value) in enumerate(shown.marks):
            at.axvline(value, color=COLOURS[1], linewidth=1.0)
            at.annotate(
                label, (value, 0.97 - 0.08 * k), xycoords=("data", "axes fraction"), fontsize=7, va="top", ha="left"
            )
        at.set_title(shown.title, fontsize=9)
        at.set_xlabel(shown.unit, fontsize=8)
        _tidy(at)

    return draw


def _events(report: c.Report) -> Callable[[Axes], None]:
    kinds = ("phase", "mode", "failsafe", "order", "command", "ack", "text")

    def draw(at: Axes) -> None:
        for event in report.events:
            at.plot([event.t], [kinds.index(event.kind)], "|", color=_LEVEL.get(event.level, "#555555"), markersize=12)
        told = [event for event in report.events if event.kind == "phase" and " -> " in event.text]
        last = -math.inf
        for event in told[:200]:
            at.axvline(event.t, color="#cccccc", linewidth=0.8, zorder=0)
            if event.t - last < 0.02 * report.header.duration_s:
                continue
            last = event.t
            name = event.text.split(" -> ", 1)[1].split(" (")[0]
            at.annotate(
                name, (event.t, 1.0), xycoords=("data", "axes fraction"), rotation=90, fontsize=7, va="top", ha="right"
            )
        at.set_ylim(len(kinds) + 0.6, -2.2)
        at.set_yticks(range(len(kinds)), kinds)
        at.set_xlabel("time [s]", fontsize=8)
        _tidy(at)

    return draw


def _tidy(at: Axes) -> None:
    at.tick_params(labelsize=8)
    at.grid(True, linewidth=0.4, alpha=0.5)
    at.spines[["top", "right"]].set_visible(False)


def _scene(report: c.Report) -> Figure:
    """From above and from the west."""
    scene = report.scene
    figure = Figure(figsize=(1.4 * WIDTH, 6.0), layout="constrained")
    figure.suptitle(f"{report.header.title}: path", fontsize=11)
    above, side = figure.subplots(1, 2)
    for solid in scene.obstacles:
        _solid(above, side, solid)
    if scene.fence:
        above.add_patch(Polygon([(e, n) for n, e in scene.fence], fill=False, color=COLOURS[1], linestyle=":"))
    for k, way in enumerate(scene.plans):
        points = np.asarray(way.points).reshape(-1, 3)
        label = "plans" if k == 0 else None
        for at, x, y in ((above, points[:, 1], points[:, 0]), (side, points[:, 0], points[:, 2])):
            at.plot(x, y, color=COLOURS[5], linewidth=0.7, alpha=0.7, label=label)
    for mover in scene.movers:
        track = mover.track
        above.plot(track.e, track.n, color=COLOURS[3], linewidth=0.8, linestyle=":")
        side.plot(track.n, track.u, color=COLOURS[3], linewidth=0.8, linestyle=":")
    tracks = (("reference", scene.reference, COLOURS[2], "--"), ("flown", scene.path, COLOURS[0], "-"))
    for label, track_or_none, colour, dashes in (*tracks, ("truth", scene.truth, COLOURS[1], "-")):
        if track_or_none is not None:
            track = track_or_none
            above.plot(track.e, track.n, color=colour, linewidth=1.3, linestyle=dashes, label=label)
            side.plot(track.n, track.u, color=colour, linewidth=1.3, linestyle=dashes, label=label)
    if scene.least is not None:
        _, (n, e, u), clearance = scene.least
        above.plot([e], [n], "x", color="black")
        side.plot([n], [u], "x", color="black", label=f"least clearance {clearance:.2f} m")
    for at, x_name, y_name in ((above, "east [m]", "north [m]"), (side, "north [m]", "up [m]")):
        at.set_xlabel(x_name, fontsize=8)
        at.set_ylabel(y_name, fontsize=8)
        at.set_aspect("equal", adjustable="datalim")
        _tidy(at)
    side.legend(fontsize=7, loc="upper right", framealpha=0.7)
    return figure


def _solid(above: Axes, side: Axes, solid: c.Json) -> None:
    look: dict[str, Any] = {"facecolor": "#b0b0b0", "edgecolor": "#808080", "linewidth": 0.5, "alpha": 0.6, "zorder": 0}
    match solid["kind"]:
        case "box":
            (n0, e0, u0), (n1, e1, u1) = solid["low"], solid["high"]
            above.add_patch(Rectangle((e0, n0), e1 - e0, n1 - n0, **look))
            side.add_patch(Rectangle((n0, u0), n1 - n0, u1 - u0, **look))
        case "cylinder":
            (n, e, u), radius = solid["base"], solid["radius"]
            above.add_patch(Circle((e, n), radius, **look))
            side.add_patch(Rectangle((n - radius, u), 2 * radius, solid["height"], **look))
        case "sphere":
            (n, e, u), radius = solid["centre"], solid["radius"]
            above.add_patch(Circle((e, n), radius, **look))
            side.add_patch(Circle((n, u), radius, **look))
        case "prism":
            corners = solid["polygon"]
            north = [n for n, _ in corners]
            above.add_patch(Polygon([(e, n) for n, e in corners], **look))
            foot = (min(north), solid["low"])
            side.add_patch(Rectangle(foot, max(north) - min(north), solid["high"] - solid["low"], **look))
        case _:
            return
