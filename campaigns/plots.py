"""Pictures of a campaign: how many flights ended well, how near to their way, how near to what stands in it, by axis.

Colours are of the Okabe-Ito palette, which people tell apart however they see colours.
"""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from campaigns.errors import CampaignError
from campaigns.show import Group, Row, groups, labels, numbers

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BLUE, RED, GREY = "#0072B2", "#D55E00", "#888888"
MOST_GROUPS = 24
"""Of an axis, in one picture; of more those that end well least often are shown."""
MOST_AXES = 6
FAR = 3.0
"""Of the tracking error that nine in ten flights keep: how far the picture goes."""
DPI = 110
ROW_IN, HEAD_IN, WIDTH_IN = 0.32, 1.1, 9.0
Draw = Callable[["Axes", Sequence[Row], str, Sequence[Group]], None]


def write_pictures(rows: Sequence[Row], axes: Sequence[str], folder: Path, title: str) -> list[Path]:
    """Write ``ok.png``, ``tracking.png`` and ``clearance.png``, with a panel for each axis; returns what was written.

    Parameters
    ----------
    rows : flights.
    axes : columns to group by, one panel each; none: all flights in one group.

    Raises
    ------
    CampaignError : the folder or a file cannot be written.
    """
    spread = "m; box: middle half, whiskers: 5 % to 95 %, red: flights that failed"
    pictures: list[tuple[str, str, str, str, Draw]] = [
        ("ok", "simulated_s", "flights that ended as expected, with the 95 % interval", "% of flights", _draw_ok),
        ("tracking", "tracking_p95_m", "tracking error of a flight, 95th percentile", spread, _draw_tracking),
        ("clearance", "min_clearance_m", "least clearance of the hull in a flight", spread, _draw_clearance),
    ]
    written = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, column, what, beneath, draw in pictures:
            if len(numbers(rows, column)):
                path = folder / f"{name}.png"
                _write(rows, axes[:MOST_AXES], path, f"{title}: {what}", beneath, draw)
                written.append(path)
    except OSError as error:
        raise CampaignError(f"{folder}: cannot write the pictures: {error.strerror or error}") from error
    return written


def _write(rows: Sequence[Row], axes: Sequence[str], path: Path, title: str, beneath: str, draw: Draw) -> None:
    from matplotlib.figure import Figure

    panels = [(axis, _shown(groups(rows, [axis]))) for axis in axes] or [("", groups(rows, []))]
    heights = [1 + len(shown) for _, shown in panels]
    figure = Figure(figsize=(WIDTH_IN, HEAD_IN + ROW_IN * sum(heights) + 0.45 * len(panels)), layout="constrained")
    figure.suptitle(title, fontsize=11)
    every = figure.subplots(len(panels), 1, squeeze=False, sharex=True, height_ratios=heights)[:, 0]
    for at, (axis, shown) in zip(every, panels, strict=True):
        draw(at, rows, axis, shown)
        at.set_yticks(range(len(shown)), [_tick(axis, group) for group in shown], fontsize=8)
        at.set_ylim(len(shown) - 0.5, -0.5)
        at.tick_params(axis="x", labelsize=8)
        at.set_title(axis or "all flights", fontsize=9, loc="left")
        at.grid(axis="x", alpha=0.25)
        at.set_axisbelow(True)
        for side in ("top", "right"):
            at.spines[side].set_visible(False)
    every[-1].set_xlabel(beneath, fontsize=8)
    figure.savefig(path, dpi=DPI)


def _draw_ok(at: "Axes", rows: Sequence[Row], axis: str, shown: Sequence[Group]) -> None:
    part = np.array([100.0 * group.ok / group.flights for group in shown])
    low, high = (
        np.array([100.0 * bound for bound in bounds]) for bounds in zip(*((g.low, g.high) for g in shown), strict=True)
    )
    at.barh(range(len(shown)), part, color=BLUE, alpha=0.35, height=0.7)
    at.errorbar(part, range(len(shown)), xerr=(part - low, high - part), fmt="o", ms=3.5, color=BLUE, capsize=3, lw=1.2)
    at.set_xlim(0.0, 100.5)


def _draw_tracking(at: "Axes", rows: Sequence[Row], axis: str, shown: Sequence[Group]) -> None:
    _draw_spread(at, rows, axis, shown, "tracking_p95_m")
    every = numbers(rows, "tracking_p95_m")
    near = every[every <= FAR * np.quantile(every, 0.9)]
    at.set_xlim(0.0, 1.05 * near.max())
    if len(near) < len(every):  # vehicles that crashed or lost their way: they would press the others into a line
        at.set_title(f"{len(every) - len(near)} further right, up to {every.max():.3g} m", fontsize=8, loc="right")


def _draw_clearance(at: "Axes", rows: Sequence[Row], axis: str, shown: Sequence[Group]) -> None:
    _draw_spread(at, rows, axis, shown, "min_clearance_m")
    at.axvline(0.0, color=RED, lw=1.0)


def _draw_spread(at: "Axes", rows: Sequence[Row], axis: str, shown: Sequence[Group], column: str) -> None:
    """Every flight a dot, red where it failed; the box holds the middle half, its line is the median."""
    of_row = labels(rows, axis) if axis else [""] * len(rows)
    scatter = np.random.default_rng(0)  # dots beside one another, the same in every picture
    for k, group in enumerate(shown):
        label = group.values.get(axis, "")
        members = [row for row, its in zip(rows, of_row, strict=True) if its == label]
        every = numbers(members, column)
        if len(every):
            at.boxplot(
                every,
                positions=[k],
                orientation="horizontal",
                widths=0.62,
                showfliers=False,
                whis=(5, 95),
                manage_ticks=False,
                medianprops={"color": "black"},
                boxprops={"color": GREY},
            )
        else:
            place = ("axes fraction", "data")
            at.annotate("none measured", (0.01, k), xycoords=place, fontsize=8, color=GREY, va="center")
        for ok, color, size, alpha in ((True, BLUE, 5, 0.5), (False, RED, 6, 0.9)):
            values = numbers((row for row in members if bool(row["ok"]) is ok), column)
            beside = k + scatter.uniform(-0.24, 0.24, len(values))
            at.plot(values, beside, ".", mew=0, color=color, ms=size, alpha=alpha)


def _shown(every: Sequence[Group]) -> list[Group]:
    """All of them in their order, or of too many those that end well least often."""
    if len(every) <= MOST_GROUPS:
        return list(every)
    return sorted(every, key=lambda group: group.ok / group.flights)[:MOST_GROUPS]


def _tick(axis: str, group: Group) -> str:
    name = group.values.get(axis, "")
    short = name if len(name) <= 28 else name[:27] + "…"
    return f"{short}  {group.ok}/{group.flights}".strip()
