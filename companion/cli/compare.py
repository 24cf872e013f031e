"""`companion plan --compare`: every method on the mission's legs, side by side; the paper's Table 2 for this world."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import groupby
from pathlib import Path
from statistics import median

import numpy as np
from rich.console import Console
from rich.table import Table

from companion.cli import show
from companion.drivers.planning import make_plan
from companion.errors import CompanionError
from companion.itinerary import Itinerary
from companion.mission import Mission
from companion.missionfile import load_mission
from companion.seam import PlanWanted
from companion.wording import in_mission_words
from planner import METHODS, Plan, PlannerError, World

OURS = "haoaroa"
REPEATS = 5
"""Each leg is planned so often, with the same result; the CPU time is the median's."""
SAMPLES = 4000


@dataclass(slots=True)
class Row:
    """What one method made of all legs: sums, largest curvature, least clearance; NaN when a leg is missing."""

    method: str
    plans: list[Plan] = field(default_factory=list)
    cpu_ms: float = 0.0
    sampled: float = math.inf  # [m] clearance beyond the radius on samples of the curve: no proof
    error: str = ""
    text: str = ""

    @property
    def certified(self) -> bool:
        return not self.error and all(plan.certified for plan in self.plans)

    def value(self, name: str) -> float:
        """One column of the table, by its JSON name."""
        if self.error:
            return math.nan
        if name == "clearance_m":
            return min(plan.clearance for plan in self.plans) if self.certified else math.nan
        if name == "curvature_max":
            return max(plan.report.curvature_max for plan in self.plans)
        if name == "cpu_ms":
            return self.cpu_ms
        part: dict[str, Callable[[Plan], float]] = {
            "length_m": lambda plan: plan.length,
            "jerk_integral": lambda plan: plan.report.jerk_integral,
            "duration_s": lambda plan: plan.trajectory.duration,
        }
        return sum(part[name](plan) for plan in self.plans)


COLUMNS = {
    "length_m": ("length [m]", ".2f"),
    "jerk_integral": ("∫jerk² [m²/s⁵]", ".0f"),
    "curvature_max": ("curvature [1/m]", ".2f"),
    "duration_s": ("time [s]", ".2f"),
    "cpu_ms": ("CPU [ms]", ".1f"),
    "clearance_m": ("spare [m]", ".3f"),
}


def compare_methods(path: Path, seed: int, plot: Path | None, as_json: bool) -> int:
    """Plan `path` by every method; exit code 0 when HAOAROA's legs are certified."""
    if plot is not None and (plot.is_dir() or not plot.suffix):
        raise CompanionError(f"{plot}: expected the name of a picture file, such as plan.png")
    out = show.console()
    mission = load_mission(path)
    world, requests = mission.planner_world(), Itinerary(mission, seed).wanted()
    rows = []
    for method in METHODS:
        with show.working(out, f"{method}: compiling what is not compiled yet, then planning"):
            rows.append(_run(world, requests, method))
    ok = next(row for row in rows if row.method == OURS).certified
    if plot is not None:
        _draw(world, mission, rows, plot, out)
    if as_json:
        best = {name: [row.method for row in winners(rows, name)] for name in COLUMNS}
        methods = [_json(row) for row in rows]
        show.print_json({"ok": ok, "mission": mission.name, "seed": seed, "methods": methods, "best": best})
    else:
        _print(mission.name, len(requests), rows)
    for text, failed in groupby(sorted((row.text, i) for i, row in enumerate(rows) if row.error), key=lambda r: r[0]):
        names = ", ".join(rows[i].method for _, i in failed)
        out.print(f"[bold red]✗[/] {show.plain(f'{path}: {text} ({names})')}", soft_wrap=True)
    return 0 if ok else 1


def _run(world: World, requests: list[PlanWanted], method: str) -> Row:
    row = Row(method)
    for wanted in requests:
        asked = replace(wanted, method=method)
        try:
            make_plan(world, asked)  # compiles
            made = [make_plan(world, asked) for _ in range(REPEATS)]
        except PlannerError as error:
            row.error, row.text = type(error).__name__, f"step {wanted.request_id}: {in_mission_words(error)}"
            break
        row.plans.append(made[0])
        row.cpu_ms += median(plan.cpu_ms for plan in made)
        trajectory = made[0].trajectory
        points = trajectory.position(np.linspace(0.0, trajectory.duration, SAMPLES))
        nearest = min(world.distance(points).min(), world.wall_distance(points).min())
        row.sampled = min(row.sampled, float(nearest) - wanted.radius)
    return row


def winners(rows: list[Row], name: str) -> list[Row]:
    """Who is best in a column, among those whose legs are all certified; several when they are equal as shown."""
    proved = [row for row in rows if row.certified and row.plans and math.isfinite(row.value(name))]
    if not proved:
        return []
    choose = max if name == "clearance_m" else min
    digits = COLUMNS[name][1]
    best = format(choose(row.value(name) for row in proved), digits)
    return [row for row in proved if format(row.value(name), digits) == best]


def _print(name: str, legs: int, rows: list[Row]) -> None:
    table = Table(
        title=f"{show.plain(name)}: {legs} leg{'s' if legs != 1 else ''}, every method",
        caption="*: best of the proved. ∞: stops and turns on the spot.\n"
        "Spare: clearance beyond the radius; in brackets sampled, where it is not proved.",
    )
    table.add_column("method")
    for title, _ in COLUMNS.values():
        name, _, unit = title.partition(" ")
        table.add_column(f"{name}\n{show.plain(unit)}", justify="right")  # bare brackets would be markup
    table.add_column("proved", justify="right")
    best = {column: winners(rows, column) for column in COLUMNS}
    for row in rows:
        cells = []
        for column, (_, digits) in COLUMNS.items():
            value = row.value(column)
            text = "∞" if value == math.inf else "-" if math.isnan(value) else format(value, digits)
            if column == "clearance_m" and not row.error and not row.certified:
                text = f"({row.sampled:.3f})"
            cells.append(f"[bold green]{text}*[/]" if row in best[column] else text)
        table.add_row(row.method, *cells, "[green]yes[/]" if row.certified else "[red]no[/]")
    Console().print(table)


def _draw(world: World, mission: Mission, rows: list[Row], plot: Path, out: Console) -> None:
    from planner.plot_methods import save_comparison

    plans = {row.method: row.plans if not row.error else [] for row in rows}
    axes = ("north", "east", "-altitude")
    try:
        save_comparison(world, plans, plot, mission.planner_limits(), mission.planner_radius(), axes)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else error
        raise CompanionError(f"{plot}: cannot draw the plans: {reason}") from error
    out.print(f"plot: {plot}")


def _json(row: Row) -> dict[str, object]:
    return {
        "method": row.method,
        "certified": row.certified,
        **{name: row.value(name) for name in COLUMNS},
        "clearance_sampled_m": math.nan if row.error else row.sampled,
        "legs": len(row.plans),
        "error": row.error,
        "text": row.text,
    }
