"""The pictures: Fig. 5 in four parts, Fig. 6, and the laws. For people; matplotlib comes with the first one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from campaigns.paper import printed, worlds
from campaigns.paper.gain_rules import TUNERS
from campaigns.paper.search import DIMENSION, benchmark
from campaigns.paper.stages import file_error
from companion.errors import CompanionError
from planner.families import FLIGHT_LEVEL, make
from planner.plot import draw_map, view_of
from planner.plot_methods import COLOURS
from planner.worlds import Box, Cylinder

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Results = Mapping[str, Any]
COLOUR = dict(zip(printed.METHODS, COLOURS, strict=False))
FROM_ABOVE = ("L", "H")
"""Families of Fig. 5 A and B."""
LEVELS = 24
GRID = 161
BUSY = 1e-3
"""Above a landscape's minimum, what its logarithm begins with."""
RED, GREEN = "#c0392b", "#148f77"


def draw(results: Results, rows: Mapping[str, Any], folder: Path) -> None:
    """Write all pictures.

    Parameters
    ----------
    rows : of the stages, with paths and points, which `results` has not.

    Raises
    ------
    CompanionError : one cannot be written.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    for name, (size, paint) in PICTURES.items():
        figure = Figure(figsize=size, dpi=110, layout="constrained")
        FigureCanvasAgg(figure)
        paint(figure, results, rows)
        try:
            figure.savefig(folder / f"{name}.png", metadata={"Software": None})
        except OSError as error:
            raise file_error(folder / f"{name}.png", error) from error


def paths(figure: Figure, results: Results, rows: Mapping[str, Any]) -> None:
    """Fig. 5 A and B: the L and the H from above, every method."""
    view, _, _ = view_of(("x", "y", "z"))
    halo = results["setup"]["hull"] + results["setup"]["clearance"]
    for axes, family in zip(figure.subplots(1, 2), FROM_ABOVE, strict=True):
        world = make(family, worlds.SHOWN).world
        draw_map(axes, world, FLIGHT_LEVEL, FLIGHT_LEVEL, view, halo)
        for row in shown(rows, family):
            method, points = row["method"], np.array(row["path"])
            wide = method == "haoaroa"
            label = f"{printed.METHODS[method]} {row['length_m']:.2f} m"
            look = {"lw": 4.0, "alpha": 0.6} if wide else {"lw": 1.5}
            style = (0, (4, 3)) if method == "jps" else "-"
            axes.plot(points[:, 0], points[:, 1], color=COLOUR[method], ls=style, label=label, **look)
            if wide:
                axes.plot(*points[0, :2], "o", color="black", ms=6)
                axes.plot(*points[-1, :2], "*", color="black", ms=11)
        axes.set(xlabel="north [m]", ylabel="east [m]")
        axes.set_title(f"{family} (pale: nearer than hull and clearance)", loc="left", fontsize=10)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=8, loc="lower left", framealpha=0.9)


def lengths(figure: Figure, results: Results, rows: Mapping[str, Any]) -> None:
    """Fig. 5 D: median lengths by family, and the printed ones."""
    axes = figure.subplots()
    names = ["the paper", *families(results)]
    told = {"the paper": printed.LENGTHS}
    for family in families(results):
        mine = [row for row in results["planners"] if row["family"] == family]
        told[family] = {row["method"]: row["length_m"] for row in mine if row["length_m"] is not None}
    offset = np.linspace(0.3, -0.3, len(printed.METHODS))
    for k, (method, name) in enumerate(printed.METHODS.items()):
        for i, family in enumerate(names):
            if method not in told[family]:
                continue
            x, y = told[family][method], -i + offset[k]
            axes.plot([0.0, x], [y, y], color=COLOUR[method], lw=1, alpha=0.35)
            axes.plot(x, y, "o", color=COLOUR[method], ms=6, label=name if i == 0 else None)
            axes.text(x + 0.06, y, f"{x:.2f}" if i else f"{x:.1f}", va="center", fontsize=7)
    values = [v for family in told.values() for v in family.values()]
    axes.set(
        xlim=(min(values) - 0.6, max(values) + 0.8),
        xlabel="length [m], median over the worlds (the axis does not begin at 0)",
    )
    axes.set_yticks([-i for i in range(len(names))], names)
    axes.legend(loc="upper right", fontsize=8)
    axes.grid(axis="x", alpha=0.25)


def spaces(figure: Figure, results: Results, rows: Mapping[str, Any]) -> None:
    """Fig. 5 C: HAOAROA's plan and its flight in space, and where it comes nearest to an obstacle."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]

    here = families(results)
    for k, family in enumerate(here):
        axes: Any = figure.add_subplot(1, len(here), k + 1, projection="3d")
        world = make(family, worlds.SHOWN).world
        for solid in world.obstacles:
            faces = Poly3DCollection(sides(solid), facecolor="#5b6472", edgecolor="#3d4450", lw=0.3, alpha=0.28)
            axes.add_collection3d(faces)
        for row in (row for row in shown(rows, family) if row["method"] == "haoaroa"):
            plan, track = np.array(row["path"]), np.array(row["track"])
            axes.plot(plan[:, 0], plan[:, 1], -plan[:, 2], color=COLOUR["haoaroa"], lw=3, alpha=0.5, label="planned")
            if not len(track):
                continue
            axes.plot(track[:, 0], track[:, 1], -track[:, 2], color=GREEN, lw=1.2, label="flown")
            up = track * [1.0, 1.0, -1.0]
            near = up[int(np.argmin(world.distance(up)))]
            axes.plot([near[0]], [near[1]], [near[2]], "o", color=RED, ms=6, label="nearest to an obstacle")
        axes.set(xlim=(0, 20), ylim=(0, 20), zlim=(0, 4), title=family)
        axes.set_box_aspect((20, 20, 7))
        axes.view_init(elev=42, azim=-75)
        axes.tick_params(labelsize=6, pad=-2)
        axes.set_zticks([0, 2, 4])
        if k == 0:
            figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncol=3, fontsize=8)


def landscapes(figure: Figure, results: Results, rows: Mapping[str, Any]) -> None:
    """Fig. 5 E and F: five functions, plain and moved, their minima and what HAOAROA found."""
    grid = figure.subplots(2, len(printed.LANDSCAPES))
    for i, moved in enumerate((False, True)):
        for axes, name in zip(grid[i], printed.LANDSCAPES, strict=True):
            function = benchmark(name, moved)
            axis = np.linspace(function.lower, function.upper, GRID)
            points = np.stack(np.meshgrid(axis, axis), axis=-1)
            height = function(points.reshape(-1, DIMENSION)).reshape(GRID, GRID) - function.minimum(DIMENSION)
            axes.contourf(axis, axis, np.log10(height + BUSY), LEVELS, cmap="viridis")
            (row,) = [
                r
                for r in rows["searches"]
                if r["function"] == name and r["moved"] is moved and r["contender"] == "HAOAROA"
            ]
            found, best = np.array(row["points"]), function.best_points(DIMENSION)
            axes.plot(best[:, 0], best[:, 1], "+", color="white", ms=14, mew=1.5)
            axes.plot(found[:, 0], found[:, 1], "o", mfc="none", color=RED, ms=8, mew=1.5)
            where = "moved" if moved else "plain"
            axes.set_title(f"{name}, {where}: {row['at_minimum']}/{row['runs']}", fontsize=9)
            axes.set_aspect("equal")
            axes.tick_params(labelsize=7)
    figure.supxlabel(
        "white cross: minimum; red circles: where HAOAROA's runs ended (so many at the minimum); darker is lower",
        fontsize=9,
    )


def gains(figure: Figure, results: Results, rows: Mapping[str, Any]) -> None:
    """Fig. 6: the printed five gains and ours on one radar, and the offset they leave in a steady wind."""
    radar: Any = figure.add_subplot(1, 2, 1, projection="polar")
    terms = list(printed.GAINS)
    every = {"the paper": printed.GAINS} | {
        name: {t: values[t] for t in terms} for name, values in results["laws"]["gains"].items()
    }
    most = {t: max(values[t] for values in every.values()) or 1.0 for t in terms}
    angles = np.linspace(0.0, 2.0 * np.pi, len(terms), endpoint=False)
    around = np.append(angles, angles[0])
    for k, (name, values) in enumerate(every.items()):
        radius = [values[t] / most[t] for t in terms]
        color = RED if k == 0 else COLOURS[k - 1]
        radar.plot(around, [*radius, radius[0]], color=color, lw=2.5 if k == 0 else 1.5, label=name)
        if k < 2:
            radar.fill(around, [*radius, radius[0]], color=color, alpha=0.12)
    labels = [f"{printed.SYMBOLS[t]}\n(edge {most[t]:.3g})" for t in terms]
    radar.set_xticks(angles, labels, fontsize=9)
    radar.tick_params(axis="x", pad=12)
    radar.set(ylim=(0.0, 1.0), yticklabels=[])
    radar.legend(loc="upper left", bbox_to_anchor=(-0.32, 1.12), fontsize=8)
    radar.set_title("velocity loops' gains, each over the greatest", fontsize=10)
    bars = figure.add_subplot(1, 2, 2)
    held = [row for row in results["holds"] if row["offset_m"] is not None]
    colors = [RED if row["gains"] == "paper" else COLOURS[0] for row in held]
    half = [row["offset_half"] or 0.0 for row in held]
    bars.bar([row["gains"] for row in held], [row["offset_m"] for row in held], yerr=half, color=colors, capsize=4)
    for i, row in enumerate(held):
        bars.text(i, row["offset_m"] + half[i], f"{row['offset_m']:.3f}", ha="center", va="bottom", fontsize=9)
    bars.set(ylabel="offset from the place, mean [m]")
    bars.set_title(f"held in {results['wind']:.0f} m/s of steady wind", loc="left", fontsize=10)
    bars.grid(axis="y", alpha=0.25)


def controllers(figure: Figure, results: Results, rows: Mapping[str, Any]) -> None:
    """RMS of each law on unseen seeds with its interval, and the optimisers' lowest cost by evaluation."""
    left, right = figure.subplots(1, 2)
    told = results["laws"]["rows"]
    laws, winds = list(dict.fromkeys(r["law"] for r in told)), results["laws"]["winds"]
    width = 0.8 / len(winds)
    for k, wind in enumerate(winds):
        mine = {row["law"]: row for row in told if row["wind"] == wind}
        place = np.arange(len(laws)) + (k - (len(winds) - 1) / 2.0) * width
        height = [mine[law]["rms_m"] or 0.0 for law in laws]
        half = [mine[law]["rms_m_half"] or 0.0 for law in laws]
        left.bar(place, height, 0.92 * width, yerr=half, color=COLOURS[k], capsize=4, label=wind)
    left.set_xticks(range(len(laws)), laws)
    left.set(ylabel="RMS error, mean over unseen seeds [m]")
    left.set_title("laws tuned alike", loc="left", fontsize=10)
    left.legend(fontsize=8, loc="lower right", framealpha=0.9)
    left.grid(axis="y", alpha=0.25)
    tuners = results["optimisers"]["rows"]
    for k, row in enumerate(tuners):
        x = np.arange(1, len(row["trace"]) + 1)  # one over the other, the first widest
        right.plot(
            x, row["trace"], color=COLOURS[k], lw=5.0 - 0.8 * k, label=TUNERS[row["optimiser"]], drawstyle="steps-post"
        )
    right.set(xlabel="evaluations", ylabel="lowest cost so far, mean of the runs")
    right.set_title("optimisers on FOPID-TID's gains", loc="left", fontsize=10)
    right.legend(fontsize=8)
    right.grid(alpha=0.25)


def families(results: Results) -> list[str]:
    """Those that were flown, in order."""
    return list(dict.fromkeys(row["family"] for row in results["planners"]))


def shown(rows: Mapping[str, Any], family: str) -> list[Mapping[str, Any]]:
    """The rows of a family's world that is drawn, where there is a path."""
    return [row for row in rows["worlds"] if row["family"] == family and row["seed"] == worlds.SHOWN and "path" in row]


def sides(solid: object) -> list[np.ndarray]:
    """Faces of a box or a cylinder, each (n, 3).

    Raises
    ------
    CompanionError : it is neither.
    """
    if isinstance(solid, Box):
        (x0, y0, z0), (x1, y1, z1) = solid.lower, solid.upper
        ring = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
    elif isinstance(solid, Cylinder):
        angle = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
        ring = np.array(solid.centre) + solid.radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        z0, z1 = solid.z
    else:
        raise CompanionError(f"a picture of {type(solid).__name__} is not drawn")
    floor, roof = (np.column_stack([ring, np.full(len(ring), z)]) for z in (z0, z1))
    walls = [np.array([floor[i - 1], floor[i], roof[i], roof[i - 1]]) for i in range(len(ring))]
    return [floor, roof, *walls]


PICTURES = {
    "paths": ((11.0, 5.6), paths),
    "lengths": ((9.0, 5.0), lengths),
    "worlds": ((15.0, 3.9), spaces),
    "landscapes": ((14.0, 6.2), landscapes),
    "gains": ((11.0, 4.8), gains),
    "controllers": ((11.0, 4.4), controllers),
}
