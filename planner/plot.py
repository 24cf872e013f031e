"""A picture of a plan: seen from above, its height, and its speed against the limit. Brings matplotlib, when called."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from planner.bspline import FloatArray
from planner.limits import Limits
from planner.plan import Plan
from planner.worlds import Box, Cylinder, PointCloud, Prism, Sphere, VoxelGrid, World

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.patches import Patch

SAMPLES = 600
MOST_QUADS = 400
"""Squares along an axis that voxels are drawn with; more of them are drawn by blocks."""
Solid = Box | Cylinder | Sphere | Prism
SOLID, FAINT, HALO, PATH, ACCENT = "#5b6472", "#ced1d5", "#f2dfc8", "#1769aa", "#c0392b"
"""Obstacles, those above or below the flight, the radius around the former; opaque, so that overlaps do not show."""
HALO_Z, FAINT_Z, SOLID_Z = 0.2, 0.4, 0.6
ROUND = 64
"""Corners of what stands for a circle."""


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
        "east", "-altitude") draws altitude upward. When the first is "north", north is drawn up and the second right.

    Raises
    ------
    OSError : the file cannot be written.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    trajectory = plan.trajectory
    t = np.linspace(0.0, trajectory.duration, SAMPLES)
    points, velocity, acceleration = trajectory.position(t), trajectory.velocity(t), trajectory.acceleration(t)
    view, labels, up_sign = view_of(names)
    gone = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])

    figure = Figure(figsize=(11.0, 6.2), dpi=130, layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1.0))
    top = figure.add_subplot(grid[:, 0])
    height, speed = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])

    draw_map(top, world, points[:, 2].min(), points[:, 2].max(), view, radius)
    draw_path(top, points @ view)
    top.set(xlabel=f"{labels[0]} [m]", ylabel=f"{labels[1]} [m]")
    clearance, nearest = world.distance(points), 0
    if world.obstacles:
        nearest = int(np.argmin(clearance))
        _mark_nearest(top, world, points[nearest], view)
        near = f"nearest obstacle {clearance[nearest]:.3f} m away"
        if plan.certified:
            near += f", proved at least {radius + plan.clearance:.3f} m" + (f", asked {radius:g} m" if radius else "")
        top.set_title(near, loc="left", fontsize=10, color=ACCENT)
    proved = "proved clear" if plan.certified else "NOT PROVED"
    title = f"{plan.method}: {plan.length:.2f} m in {trajectory.duration:.2f} s, {proved}"
    figure.suptitle(title, x=0.01, ha="left", fontsize=12)

    low, high = sorted(up_sign * world.walls[:, 2])
    draw_beside(height, world, points, gone, up_sign)
    height.plot(gone, up_sign * points[:, 2], color=PATH, lw=2)
    height.axhline(low, color="black", lw=1)
    height.axhline(high, color="black", lw=1)
    if world.obstacles:
        height.plot(gone[nearest], up_sign * points[nearest, 2], "o", color=ACCENT, ms=5)
    margin = 0.06 * (high - low)
    height.set(xlabel="way gone [m]", ylabel=f"{labels[2]} [m]", ylim=(low - margin, high + margin), xlim=(0, gone[-1]))
    height.set_title("height along the way (grey: obstacles above and below it)", loc="left", fontsize=10)

    v, a = np.linalg.norm(velocity, axis=1), np.linalg.norm(acceleration, axis=1)
    speed.plot(t, v, color=PATH, lw=2, label="speed [m/s]")
    speed.plot(t, a, color="#7f8c8d", lw=1.2, label="acceleration [m/s²]")
    if limits is not None:
        speed.axhline(limits.speed, color=PATH, lw=1, ls="--", label=f"limit {limits.speed:g} m/s")
        speed.axhline(limits.acceleration, color="#7f8c8d", lw=1, ls="--", label=f"limit {limits.acceleration:g} m/s²")
    highest = max(float(v.max()), float(a.max()), *((limits.speed, limits.acceleration) if limits else (0.1,)))
    speed.set(xlabel="time [s]", xlim=(0, trajectory.duration), ylim=(0, 1.3 * highest))
    speed.legend(loc="upper center", ncol=2, fontsize=8, frameon=False)
    for axes in (height, speed):
        axes.grid(alpha=0.25)
    figure.savefig(path)


def view_of(names: tuple[str, str, str]) -> tuple[FloatArray, tuple[str, str, str], float]:
    """For the names of the axes as `save_plot` takes them: what takes points to the page (3, 2), as points @ view; the
    names of the page's axes, to the right, up, and out of it; and the sign of the third."""
    signs = [-1.0 if name.startswith("-") else 1.0 for name in names]
    labels = [name.removeprefix("-") for name in names]
    right, up = (1, 0) if labels[0] == "north" else (0, 1)
    view = np.zeros((3, 2))
    view[right, 0], view[up, 1] = signs[right], signs[up]
    return view, (labels[right], labels[up], labels[2]), signs[2]


def draw_map(axes: Axes, world: World, bottom: float, ceiling: float, view: FloatArray, radius: float) -> None:
    """Bounds, obstacles (darker where they reach the heights from `bottom` to `ceiling`), and what lies within the
    radius of those and of the walls."""
    from matplotlib.patches import Rectangle

    corners = world.walls @ view
    low, size = corners.min(axis=0), np.ptp(corners, axis=0)
    walls = axes.add_patch(Rectangle((low[0], low[1]), size[0], size[1], fill=False, lw=1.2, color="black"))
    if radius > 0.0:
        inner = np.maximum(size - 2.0 * radius, 0.0)
        axes.add_patch(Rectangle((low[0], low[1]), size[0], size[1], color=HALO, lw=0, zorder=0.0))
        axes.add_patch(Rectangle((low + (size - inner) / 2).tolist(), *inner, color="white", lw=0, zorder=0.1))
    _draw_voxels(axes, world, view, bottom - radius, ceiling + radius, radius, walls)
    for solid in _solids(world):
        z0, z1 = _height(solid)
        reached = z0 - radius < ceiling and z1 + radius > bottom
        color, zorder = (SOLID, SOLID_Z) if reached else (FAINT, FAINT_Z)
        axes.add_patch(_outline(solid, 0.0, view, color=color, lw=0, zorder=zorder))
        if radius > 0.0 and reached:
            axes.add_patch(_outline(solid, radius, view, color=HALO, lw=0, zorder=HALO_Z)).set_clip_path(walls)
    pad = 0.03 * float(size.max())
    axes.set(xlim=(low[0] - pad, low[0] + size[0] + pad), ylim=(low[1] - pad, low[1] + size[1] + pad))
    axes.set_aspect("equal")


def draw_beside(axes: Axes, world: World, points: FloatArray, gone: FloatArray, sign: float) -> None:
    """What stands above and below each point (m, 3) of a path, over the way gone (m,)."""
    _draw_voxels_beside(axes, world, points, gone, sign)
    for solid in _solids(world):
        bottom, ceiling = _slice(solid, points)
        axes.fill_between(gone, sign * bottom, sign * ceiling, color=SOLID, alpha=0.55, lw=0)


def draw_path(axes: Axes, path: FloatArray) -> None:
    """A path (m, 2) on the page, a dot where it begins and a star where it ends."""
    axes.plot(*path.T, color=PATH, lw=2.2)
    axes.plot(*path[0], "o", color=PATH, ms=8)
    axes.plot(*path[-1], "*", color=PATH, ms=14)


def _mark_nearest(axes: Axes, world: World, point: FloatArray, view: FloatArray) -> None:
    """A line from the closest point of the path to the surface it is closest to."""
    distance, gradient = world.distance_gradient(point[None])
    ends = np.array([point, point - distance[0] * gradient[0]]) @ view
    axes.plot(*ends.T, color=ACCENT, lw=2, solid_capstyle="round", zorder=5)
    axes.plot(*ends[0], "o", color=ACCENT, ms=5, zorder=5)


def _solids(world: World) -> list[Solid]:
    return [obstacle for obstacle in world.obstacles if not isinstance(obstacle, VoxelGrid | PointCloud)]


def _draw_voxels(
    axes: Axes, world: World, view: FloatArray, low: float, high: float, radius: float, walls: Patch
) -> None:
    """A field's voxels from above, darker where one lies between the heights low and high; and their halo there."""
    field = world.scene.field
    if not field.occupied.size:
        return
    h, shape = field.resolution, field.occupied.shape
    edges = [field.origin[a] + h * np.arange(shape[a] + 1) for a in range(3)]
    level = np.flatnonzero((edges[2][1:] > low) & (edges[2][:-1] < high))
    block = [max(1, -(-shape[a] // MOST_QUADS)) for a in (0, 1)]
    starts = [np.arange(0, shape[a], block[a]) for a in (0, 1)]
    grid = np.stack(np.meshgrid(*(np.append(edges[a][starts[a]], edges[a][-1]) for a in (0, 1)), indexing="ij"))
    page = np.einsum("aij,ab->bij", grid, view[:2])
    if radius > 0.0 and len(level):
        near = field.distances[:, :, level[0] : level[-1] + 2].min(axis=2)
        places, inside, beyond = [], [], []
        for a in (0, 1):  # the lattice's corners and some outside, which are farther by the way there
            margin = int(np.ceil(radius / h / block[a])) + 1
            place = block[a] * np.arange(-margin, -(-shape[a] // block[a]) + margin + 1)
            places.append(place)
            inside.append(np.clip(place, 0, shape[a]))
            beyond.append(h * (place - inside[a]))
        halo = np.sqrt(np.maximum(near[np.ix_(*inside)], 0.0) ** 2 + beyond[0][:, None] ** 2 + beyond[1] ** 2)
        x, y = np.meshgrid(*(field.origin[a] + h * places[a] for a in (0, 1)), indexing="ij")
        around = np.einsum("aij,ab->bij", np.stack([x, y]), view[:2])
        axes.contourf(*around, halo, levels=[-1.0, radius], colors=[HALO], zorder=HALO_Z).set_clip_path(walls)
    for columns, color, zorder in ((field.occupied, FAINT, FAINT_Z), (field.occupied[:, :, level], SOLID, SOLID_Z)):
        met = np.logical_or.reduceat(np.logical_or.reduceat(columns.any(axis=2), starts[0], 0), starts[1], 1)
        drawn = np.where(met, 1.0, np.nan)
        axes.pcolormesh(*page, drawn, cmap=_plain(color), linewidth=0, rasterized=True, zorder=zorder)


def _draw_voxels_beside(axes: Axes, world: World, points: FloatArray, gone: FloatArray, sign: float) -> None:
    """The voxels above and below each point of the path."""
    field = world.scene.field
    if not field.occupied.size:
        return
    column = np.floor((points[:-1] - field.origin) / field.resolution).astype(np.int64)
    over = ((column >= 0) & (column < field.occupied.shape))[:, :2].all(axis=1)
    met = np.zeros((len(column), field.occupied.shape[2]))
    met[over] = field.occupied[column[over, 0], column[over, 1]]
    z = sign * (field.origin[2] + field.resolution * np.arange(met.shape[1] + 1))
    axes.pcolormesh(
        gone, z, np.where(met > 0, 1.0, np.nan).T, cmap=_plain(SOLID), alpha=0.55, linewidth=0, rasterized=True
    )


def _plain(color: str) -> Colormap:
    from matplotlib.colors import ListedColormap

    return ListedColormap([color])


def _height(solid: Solid) -> tuple[float, float]:
    if isinstance(solid, Box):
        return solid.lower[2], solid.upper[2]
    if isinstance(solid, Cylinder | Prism):
        return solid.z
    return solid.centre[2] - solid.radius, solid.centre[2] + solid.radius


def _outline(solid: Solid, grown: float, view: FloatArray, **style: Any) -> Patch:
    """A solid's shadow from above, grown by the radius (with round corners)."""
    from matplotlib.patches import Circle, FancyBboxPatch, PathPatch
    from matplotlib.path import Path as Outline

    if isinstance(solid, Prism):
        page = np.array([(x, y, 0.0) for x, y in solid.corners]) @ view
        parts = [Outline(page, closed=False)]
        turn = np.linspace(0.0, 2.0 * np.pi, ROUND, endpoint=False)
        circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
        for a, b in zip(page, np.roll(page, -1, axis=0), strict=True) if grown > 0.0 else ():
            aside = grown * np.array([a[1] - b[1], b[0] - a[0]]) / np.hypot(*(b - a))
            parts += [Outline(a + grown * circle), Outline([a - aside, b - aside, b + aside, a + aside])]
        rings = [_turned(np.asarray(ring)) for part in parts for ring in part.to_polygons(closed_only=False)]
        return PathPatch(Outline.make_compound_path(*(Outline(ring, closed=True) for ring in rings)), **style)
    if isinstance(solid, Cylinder | Sphere):
        x, y = np.array([*solid.centre[:2], 0.0]) @ view
        return Circle((x, y), solid.radius + grown, **style)
    corners = np.array([solid.lower, solid.upper]) @ view
    low, size = corners.min(axis=0), np.ptp(corners, axis=0)
    shape = f"round,pad={grown},rounding_size={grown}" if grown > 0 else "square,pad=0"
    return FancyBboxPatch((low[0], low[1]), size[0], size[1], boxstyle=shape, mutation_scale=1, **style)


def _turned(ring: FloatArray) -> FloatArray:
    """A closed ring (m, 2) of points, counter-clockwise: rings that overlap are filled once if they turn alike."""
    ring = ring if (ring[0] == ring[-1]).all() else np.concatenate([ring, ring[:1]])
    area = float((ring[:-1, 0] * ring[1:, 1] - ring[1:, 0] * ring[:-1, 1]).sum())
    return ring if area > 0.0 else ring[::-1]


def _slice(solid: Solid, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Lower and upper z (m,) [m] of a solid along the vertical through each point; NaN where it is not met."""
    if isinstance(solid, Box):
        met = ((points[:, :2] >= solid.lower[:2]) & (points[:, :2] <= solid.upper[:2])).all(axis=1)
    elif isinstance(solid, Prism):
        from matplotlib.path import Path as Outline

        met = Outline(np.array(solid.corners)).contains_points(points[:, :2])
    else:
        away = np.hypot(points[:, 0] - solid.centre[0], points[:, 1] - solid.centre[1])
        met = away <= solid.radius
    if isinstance(solid, Sphere):
        half = np.sqrt(np.where(met, solid.radius**2 - away**2, np.nan))
        return solid.centre[2] - half, solid.centre[2] + half
    low, high = _height(solid)
    return np.where(met, low, np.nan), np.where(met, high, np.nan)
