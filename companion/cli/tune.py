"""`companion tune`: gains found by flights, and what they are worth on seeds that the search has not seen."""

import os
import shutil
from contextlib import closing
from pathlib import Path

from rich.box import SIMPLE
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from campaigns.executors import local
from campaigns.tuning import report
from campaigns.tuning.compare import about
from campaigns.tuning.journal import Journal
from campaigns.tuning.optimisers import available
from campaigns.tuning.spec import Spec, load_spec
from campaigns.tuning.tune import Found, find, judged
from companion.cli import show
from companion.errors import CompanionError

SPEC = "spec.yaml"


def tune_gains(path: Path, method: str, jobs: int, out: Path | None, resume: bool, as_json: bool) -> int:
    """Tune as the file at `path` says, into the folder `out`; exit code 0."""
    console = show.console()
    spec = load_spec(path)
    available(method)
    folder = out if out is not None else Path("tunings") / f"{path.stem}-{method}"
    journal = Journal(folder, about(spec, method), resume=resume)
    _keep(path, folder / SPEC)
    rounds = spec.search.budget // spec.search.population
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with closing(local(jobs)) as executor, Progress(*columns, console=console, disable=not console.is_terminal) as bar:
        if not console.is_terminal:
            console.print(f"{spec.name}: {method}, {rounds * spec.search.population} evaluations, into {folder}")
        task = bar.add_task(method, total=rounds * spec.search.population)
        found = find(
            spec,
            method,
            executor,
            journal=journal,
            progress=lambda n, cost: bar.update(task, completed=n, description=f"{method}, lowest cost {cost:.3f}"),
        )
        bar.update(task, description="judging on every seed")
        table: list[report.Row] = []
        for unseen in (False, True):
            before = judged(spec, {}, executor, unseen=unseen)
            after = judged(spec, found.values, executor, unseen=unseen)
            table += report.rows(before, after)
    report.write(spec, found, table, folder)
    if as_json:
        show.print_json({"ok": True, "folder": str(folder), **report.result(spec, found, table)})
        return 0
    _print(spec, found, table, folder)
    return 0


def _keep(path: Path, copy: Path) -> None:
    """The specification beside what came of it."""
    try:
        if not copy.exists() or not os.path.samefile(path, copy):
            shutil.copyfile(path, copy)
    except OSError as error:
        raise CompanionError(f"{copy}: {error.strerror or error}") from error


def _print(spec: Spec, found: Found, rows: list[report.Row], folder: Path) -> None:
    console = Console(highlight=False)
    cost = Table(
        "part of the cost", "before", "after", title=f"{spec.name}: {found.method}", title_justify="left", box=SIMPLE
    )
    units = {"tracking": " m", "overshoot": " m", "activity": " rad/s²", "margin": " (Ms)"}
    for name, unit in units.items():
        before, after = getattr(found.base, name), getattr(found.parts, name)
        cost.add_row(name, f"{before:.4g}{unit}", f"{after:.4g}{unit}")
    cost.add_row("cost", f"{found.base_cost:.3f}", f"[bold]{found.cost:.3f}[/bold]")
    console.print(cost)
    for unseen, count in ((False, spec.train), (True, spec.test)):
        what = f"{'unseen seeds' if unseen else 'seeds trained on'}: {count}"
        title = f"RMS over ground in mm, {what}, mean ± 95 %"
        flights = Table(title=title, title_justify="left", box=SIMPLE, pad_edge=False)
        flights.add_column("flight", min_width=12)
        for name in ("before", "after", "change", "loops", "estimate", "largest"):
            flights.add_column(name, no_wrap=True)
        for row in (row for row in rows if row.unseen == unseen):
            flights.add_row(
                f"{row.course}, {row.wind}",
                row.before.told(1000.0, 0),
                row.after.told(1000.0, 0),
                f"{row.change.told(100.0, 1)} %",
                f"{1000.0 * row.control[0]:.0f} → {1000.0 * row.control[1]:.0f}",
                f"{1000.0 * row.estimator:.0f}",
                f"{1000.0 * row.largest:.0f}" if not row.lost else f"[red]{row.lost} lost[/red]",
            )
        console.print(flights)
    console.print("loops: estimate to setpoint; estimate: truth to estimate, which no gain mends", style="dim")
    if not found.values:
        console.print("Nothing cheaper than the base was found: result.params is the base.")
    changed = Table("parameter", "before", "after", title="Gains", title_justify="left", box=SIMPLE)
    start = spec.values(spec.first())
    for name, value in found.values.items():
        changed.add_row(name, f"{start[name]:.4g}", f"{value:.4g}")
    if found.values:
        console.print(changed)
    for name in (f"{report.PARAMS} (fakevehicle --params)", report.CONVERGENCE, report.BEFORE_AFTER):
        console.print(str(folder / name), soft_wrap=True)
