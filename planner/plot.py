"""A picture of a plan: seen from above, its height, and its speed against the limit. Brings matplotlib, when called."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from planner.bspline import FloatArray
from planner.limits import Limits
from planner.plan import Plan
from planner.worlds import Box, Cylinder, Obstacle, Sphere, World

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

SAMPLES = 600
SOLID, HALO, PATH, ACCENT = "#5b6472", "#e9c9a3", "#1769aa", "#c0392b"


def save_plot(
    world: World,
    plan: Plan,
    path: str | Path,
    limits: Limits | None = None,
    radius: float = 0.0,
    names: tuple[str, str, str] = ("x", "y", "z"),
) -> None:
    """Write a PNG of a plan in its world.

    Parameters
    ----------
    path : where to write; its suffix chooses the format.
    limits : drawn as a line over the speed and used to scale acceleration, when given.
    radius : the halo that the curve keeps clear of, drawn around every obstacle [m].
    names : of the axes. A name starting with "-" turns that axis upside down: in a north-east-down frame ("north",
        "east", "-altitude") draws altitude upward.

    Raises
    ------
    OSError : the file cannot be written.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    trajectory = plan.trajectory
    t = np.linspace(0.0, trajectory.duration, SAMPLES)
    points, velocity, acceleration = trajectory.position(t), trajectory.velocity(t), trajectory.acceleration(t)
    signs = np.array([-1.0 if name.startswith("-") else 1.0 for name in names])
    labels = [name.removeprefix("-") for name in names]
    gone = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])

    figure = Figure(figsize=(11.0, 6.2), dpi=130, layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1.0))
    top = figure.add_subplot(grid[:, 0])
    height, speed = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])

    _draw_top(top, world, points, signs, radius)
    top.set(xlabel=f"{labels[0]} [m]", ylabel=f"{labels[1]} [m]")
    clearance, nearest = world.distance(points), 0
    if world.obstacles:
        nearest = int(np.argmin(clearance))
        _mark_clearance(top, world, points[nearest], signs, plan.clearance)
    proved = "proved clear" if plan.certified else "NOT PROVED"
    top.set_title(
        f"{plan.method}: {plan.length:.2f} m in {trajectory.duration:.2f} s, {proved}", loc="left", fontsize=11
    )

    low, high = sorted(signs[2] * world.walls[:, 2])
    for from_m, until_m, bottom, ceiling in _below(world, points, gone, signs[2]):
        height.fill_between([from_m, until_m], bottom, ceiling, color=SOLID, alpha=0.55, lw=0)
    height.plot(gone, signs[2] * points[:, 2], color=PATH, lw=2)
    height.axhline(low, color="black", lw=1)
    height.axhline(high, color="black", lw=1)
    if world.obstacles:
        height.plot(gone[nearest], signs[2] * points[nearest, 2], "o", color=ACCENT, ms=5)
    margin = 0.06 * (high - low)
    height.set(xlabel="way gone [m]", ylabel=f"{labels[2]} [m]", ylim=(low - margin, high + margin), xlim=(0, gone[-1]))
    height.set_title("height along the way (grey: obstacles above and below it)", loc="left", fontsize=10)

    v, a = np.linalg.norm(velocity, axis=1), np.linalg.norm(acceleration, axis=1)
    speed.plot(t, v, color=PATH, lw=2, label="speed [m/s]")
    speed.plot(t, a, color="#7f8c8d", lw=1.2, label="acceleration [m/s²]")
    if limits is not None:
        speed.axhline(limits.speed, color=PATH, lw=1, ls="--", label=f"limit {limits.speed:g} m/s")
        speed.axhline(limits.acceleration, color="#7f8c8d", lw=1, ls="--", label=f"limit {limits.acceleration:g} m/s²")
    ceiling = max(float(v.max()), float(a.max()), *((limits.speed, limits.acceleration) if limits else (0.1,)))
    speed.set(xlabel="time [s]", xlim=(0, trajectory.duration), ylim=(0, 1.3 * ceiling))
    speed.legend(loc="upper center", ncol=2, fontsize=8, frameon=False)
    for axes in (height, speed):
        axes.grid(alpha=0.25)
    figure.savefig(path)


def _draw_top(axes: Axes, world: World, points: FloatArray, signs: FloatArray, radius: float) -> None:
    """Bounds, obstacles (darker where they reach the path's height), halo, path."""
    from matplotlib.patches import Rectangle

    corners = signs[:2] * world.walls[:, :2]
    low, size = corners.min(axis=0), np.ptp(corners, axis=0)
    axes.add_patch(Rectangle((low[0], low[1]), size[0], size[1], fill=False, lw=1.2, color="black"))
    bottom, ceiling = points[:, 2].min(), points[:, 2].max()
    for layer in ("halo", "solid"):
        for solid in world.obstacles:
            z0, z1 = _height(solid)
            reached = z0 - radius < ceiling and z1 + radius > bottom
            if layer == "solid":
                axes.add_patch(_outline(solid, 0.0, signs, color=SOLID, alpha=0.9 if reached else 0.3, lw=0))
            elif radius > 0.0 and reached:
                axes.add_patch(_outline(solid, radius, signs, color=HALO, alpha=0.6, lw=0))
    axes.plot(*(signs[:2] * points[:, :2]).T, color=PATH, lw=2.2)
    axes.plot(*(signs[:2] * points[0, :2]), "o", color=PATH, ms=8)
    axes.plot(*(signs[:2] * points[-1, :2]), "*", color=PATH, ms=14)
    pad = 0.03 * float(size.max())
    axes.set(xlim=(low[0] - pad, low[0] + size[0] + pad), ylim=(low[1] - pad, low[1] + size[1] + pad))
    axes.set_aspect("equal")


def _mark_clearance(axes: Axes, world: World, point: FloatArray, signs: FloatArray, clearance: float) -> None:
    """A line from the closest point of the path to the surface it is closest to."""
    distance, gradient = world.distance_gradient(point[None])
    ends = np.array([point, point - distance[0] * gradient[0]])[:, :2] * signs[:2]
    axes.plot(*ends.T, color=ACCENT, lw=2, solid_capstyle="round", zorder=5)
    axes.annotate(
        f"nearest {distance[0]:.2f} m\n(radius + {clearance:.3f} m)",
        ends[0],
        xytext=(12, -30),
        textcoords="offset points",
        color=ACCENT,
        fontsize=9,
        bbox={"boxstyle": "round,pad=0.2", "fc": "white", "ec": "none", "alpha": 0.8},
        zorder=6,
    )


def _height(solid: Obstacle) -> tuple[float, float]:
    if isinstance(solid, Box):
        return solid.lower[2], solid.upper[2]
    if isinstance(solid, Cylinder):
        return solid.z
    return solid.centre[2] - solid.radius, solid.centre[2] + solid.radius


def _outline(solid: Obstacle, grown: float, signs: FloatArray, **style: object) -> Patch:
    """A solid's shadow from above, grown by the radius (with round corners)."""
    from matplotlib.patches import Circle, FancyBboxPatch

    if isinstance(solid, Cylinder | Sphere):
        x, y = signs[0] * solid.centre[0], signs[1] * solid.centre[1]
        return Circle((x, y), solid.radius + grown, **style)
    corners = signs[:2] * np.array([solid.lower[:2], solid.upper[:2]])
    low, size = corners.min(axis=0), np.ptp(corners, axis=0)
    shape = f"round,pad={grown},rounding_size={grown}" if grown > 0 else "square,pad=0"
    return FancyBboxPatch((low[0], low[1]), size[0], size[1], boxstyle=shape, mutation_scale=1, **style)  # type: ignore[arg-type]


def _below(world: World, points: FloatArray, gone: FloatArray, sign: float) -> list[tuple[float, float, float, float]]:
    """Where the path passes over or under a solid: (from, until, bottom, top) in way gone and drawn height [m]."""
    found = []
    for solid in world.obstacles:
        if isinstance(solid, Box):
            inside = ((points[:, :2] >= solid.lower[:2]) & (points[:, :2] <= solid.upper[:2])).all(axis=1)
        else:
            inside = np.hypot(points[:, 0] - solid.centre[0], points[:, 1] - solid.centre[1]) <= solid.radius
        edges = np.flatnonzero(np.diff(np.concatenate([[0], inside.astype(np.int8), [0]])))
        bottom, top = sorted(sign * z for z in _height(solid))
        found += [
            (float(gone[a]), float(gone[b - 1]), bottom, top) for a, b in zip(edges[::2], edges[1::2], strict=True)
        ]
    return found
