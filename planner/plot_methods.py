"""One picture of what several methods make of the same legs: from above, height along the way, speed. For people."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from planner.bspline import FloatArray
from planner.limits import Limits
from planner.plan import Plan
from planner.plot import SAMPLES, draw_beside, draw_map, view_of
from planner.worlds import World

COLOURS = ("#1769aa", "#d35400", "#7d3c98", "#148f77", "#b7950b", "#c0392b", "#e377c2")
"""One a method; the first is drawn wide and pale beneath the others, so that none hides another."""
WIDTHS, ALPHAS = (5.0, 1.5), (0.55, 1.0)
HIGH = 0.85
"""Of a row of the picture of speeds, what the speed limit takes."""


def save_comparison(
    world: World,
    plans: Mapping[str, Sequence[Plan]],
    path: str | Path,
    limits: Limits | None = None,
    radius: float = 0.0,
    names: tuple[str, str, str] = ("x", "y", "z"),
) -> None:
    """Write a PNG of every method's plans in one world.

    Parameters
    ----------
    plans : the legs that each method found, in order; a method without any is only named. Dashed: not proved.
    path, limits, radius, names : as `plot.save_plot`.

    Raises
    ------
    OSError : the file cannot be written.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    view, labels, sign = view_of(names)
    figure = Figure(figsize=(12.0, 7.2), dpi=130, layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1.0))
    top = figure.add_subplot(grid[:, 0])
    height, speed = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])

    heights = [plan.trajectory.control_points[:, 2] for legs in plans.values() for plan in legs]
    bottom, ceiling = (min(h.min() for h in heights), max(h.max() for h in heights)) if heights else (0.0, 0.0)
    draw_map(top, world, bottom, ceiling, view, radius)
    rows = list(plans)[::-1]  # the first is the highest
    fastest = limits.speed if limits else max((_speed(p).max() for legs in plans.values() for p in legs), default=1.0)
    beside = next((method for method, legs in plans.items() if legs), None)
    for k, (method, legs) in enumerate(plans.items()):
        rest, color, row = min(k, 1), COLOURS[k % len(COLOURS)], rows.index(method)
        look: dict[str, Any] = {"color": color, "lw": WIDTHS[rest], "alpha": ALPHAS[rest], "zorder": 3 + k}
        gone = begun = 0.0
        for i, plan in enumerate(legs):
            style = "-" if plan.certified else (0, (4, 2))
            label = _label(method, legs) if i == 0 else None
            t = np.linspace(0.0, plan.trajectory.duration, SAMPLES)
            points = plan.trajectory.position(t)
            way = gone + np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
            top.plot(*(points @ view).T, label=label, ls=style, solid_capstyle="butt", **look)
            height.plot(way, sign * points[:, 2], ls=style, solid_capstyle="butt", **look)
            if method == beside:
                draw_beside(height, world, points, way, sign)
            v = row + HIGH * _speed(plan) / fastest
            speed.fill_between(begun + t, row, v, color=color, alpha=0.25, lw=0)
            speed.plot(begun + t, v, color=color, lw=1.2, ls=style)
            gone, begun = way[-1], begun + plan.trajectory.duration
        if not legs:
            top.plot([], [], label=_label(method, legs), **look)
    for plan in next((legs for legs in plans.values() if legs), ()):
        ends = plan.trajectory.control_points[[0, -1]] @ view
        top.plot(*ends[0], "o", color="black", ms=7, zorder=20)
        top.plot(*ends[1], "*", color="black", ms=13, zorder=20)

    handles, texts = top.get_legend_handles_labels()
    figure.legend(handles, texts, loc="outside lower center", ncol=4, fontsize=9, frameon=False)
    top.set(xlabel=f"{labels[0]} [m]", ylabel=f"{labels[1]} [m]")
    top.set_title("from above (dashed: not proved; pale: nearer than the radius)", loc="left", fontsize=10)
    low, high = sorted(sign * world.walls[:, 2])
    margin = 0.06 * (high - low)
    for bound in (low, high):
        height.axhline(bound, color="black", lw=1)
    height.set(xlabel="way gone [m]", ylabel=f"{labels[2]} [m]", ylim=(low - margin, high + margin))
    grey = f" (grey: obstacles above and below {beside}'s)" if beside and world.obstacles else ""
    height.set_title(f"height along the way{grey}", loc="left", fontsize=10)
    speed.set(xlabel="time [s]", ylim=(-0.1, len(rows)), yticks=range(len(rows)))
    speed.set_yticklabels(rows, va="bottom")
    most = "the limit of" if limits else "at most"
    speed.set_title(f"speed, each from 0 to {most} {fastest:.3g} m/s", loc="left", fontsize=10)
    for axes in (height, speed):
        axes.set_xlim(left=0.0)
        axes.grid(alpha=0.25)
    figure.savefig(path)


def _speed(plan: Plan) -> FloatArray:
    """At SAMPLES even times (m,) [m/s]."""
    t = np.linspace(0.0, plan.trajectory.duration, SAMPLES)
    return np.asarray(np.linalg.norm(plan.trajectory.velocity(t), axis=1))


def _label(method: str, legs: Sequence[Plan]) -> str:
    if not legs:
        return f"{method}: no plan"
    length, duration = sum(plan.length for plan in legs), sum(plan.trajectory.duration for plan in legs)
    proved = "" if all(plan.certified for plan in legs) else ", not proved"
    return f"{method}: {length:.2f} m, {duration:.2f} s{proved}"
