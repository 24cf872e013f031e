"""`companion campaign show`: what a campaign has found so far: a table, failures gathered by kind, pictures."""

import shlex
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from campaigns.clusters import Cluster, clusters
from campaigns.errors import CampaignError
from campaigns.show import Group, Row, flown, groups, varying
from campaigns.sofar import rows_so_far
from campaigns.store import Store
from companion.cli import show

MOST_CELLS = 24
"""Combinations of axes in a table; of more each axis stands by itself."""
MOST_LINES = 40
"""Groups of an axis on the screen; of more those that end well least often. The JSON has all."""
FIGURES_WIDE = 53
"""What the figures of a table need, in letters."""
LEGEND = (
    "95 %: interval of the part that ends as expected; p95: median of the flights' 95th percentiles of the tracking "
    "error, and the worst of them; clear: least clearance of the hull"
)
NO_TERMINAL_WIDE = 160
MOST_CLUSTERS = 12
MOST_IDS = 3


def show_campaign(folder: Path, by: Sequence[str], png: Path | None, as_json: bool) -> int:
    """Show a campaign as far as it is; returns the exit code. Parameters and errors as of `show_rows`."""
    store = Store(folder)
    rows = rows_so_far(store)
    for run_id in store.unreadable:
        problem = f"{folder / 'runs' / run_id}: damaged, and left out; --resume flies it again"
        print(f"companion: {problem}", file=sys.stderr)
    return show_rows(folder, rows, len(store.run_ids), by, png, as_json)


def show_rows(
    folder: Path, rows: Sequence[Row], planned: int, by: Sequence[str], png: Path | None, as_json: bool
) -> int:
    """Show the rows of a campaign; returns the exit code.

    Parameters
    ----------
    folder : the campaign's.
    rows : of what has come to an end.
    planned : how many runs the campaign has.
    by : columns to group by; empty: the axes that vary.
    png : folder for pictures.

    Raises
    ------
    CampaignError : no such column, or the pictures cannot be written.
    """
    flights = flown(rows)
    axes = list(by) or varying(flights)
    try:
        tables = [groups(flights, by)] if by else _tables(flights, axes)
    except KeyError as error:
        there = ", ".join(sorted({"wind", *(rows[0] if rows else ())}))
        raise CampaignError(f"--by: found {error.args[0]}, expected columns among {there}") from error
    failures = clusters(rows)
    pictures: list[Path] = []
    if png is not None:
        from campaigns.plots import write_pictures

        pictures = write_pictures(flights, axes, png, folder.resolve().name)
    if as_json:
        show.print_json(
            {
                "ok": True,
                "runs": planned,
                "flown": len(flights),
                "failed": sum(not row["ok"] for row in flights),
                "not_flown": len(rows) - len(flights),
                "groups": [asdict(group) for table in tables for group in table],
                "failures": [asdict(cluster) | {"count": len(cluster.run_ids)} for cluster in failures],
                "pictures": [str(picture) for picture in pictures],
            }
        )
        return 0
    out = Console(highlight=False)
    if not out.is_terminal:
        out.width = NO_TERMINAL_WIDE
    out.print(_head(folder, rows, flights, planned), soft_wrap=True)
    if flights:
        if not by and not _fits(tables[0], out.width):
            tables = [groups(flights, [axis]) for axis in axes]
        out.print(_table(tables))
        out.print(f"[dim]{LEGEND}[/dim]")
    _tell_failures(failures, folder, out)
    for picture in pictures:
        out.print(f"[dim]{show.plain(str(picture))}[/dim]", soft_wrap=True)
    return 0


def _tables(flights: Sequence[Row], axes: Sequence[str]) -> list[list[Group]]:
    """Every combination of the axes, where these are few; else the values of each axis by itself."""
    together = groups(flights, axes)
    return [together] if len(together) <= MOST_CELLS else [groups(flights, [axis]) for axis in axes]


def _fits(table: Sequence[Group], width: int) -> bool:
    wide = FIGURES_WIDE
    for axis in table[0].values:
        wide += 2 + max(len(axis), *(len(group.values[axis]) for group in table))
    return wide <= width


def _head(folder: Path, rows: Sequence[Row], flights: Sequence[Row], planned: int) -> str:
    ok = sum(bool(row["ok"]) for row in flights)
    parts = [f"{len(flights)} flown of {planned} runs" if len(flights) < planned else f"{planned} flights"]
    if flights:
        parts.append(f"{ok} ended as expected ({100.0 * ok / len(flights):.1f} %), {len(flights) - ok} did not")
    if lost := len(rows) - len(flights):
        parts.append(f"[yellow]{lost} could not be flown[/yellow]")
    return f"[bold]{show.plain(str(folder))}[/bold]: " + "; ".join(parts)


def _table(tables: Sequence[Sequence[Group]]) -> Table:
    """One table: a section for each of them."""
    several = len(tables) > 1
    table = Table(box=SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0), show_edge=False)
    names = ["axis", "value"] if several else list(tables[0][0].values)
    for name in names:
        table.add_column(show.plain(name), overflow="fold", min_width=4)
    for name in ("flown", "ok %", "95 %", "p95 m", "worst", "clear", "sim s"):
        table.add_column(name, justify="right", no_wrap=True)
    for section in tables:
        shown, left = list(section), 0
        if len(shown) > MOST_LINES:
            shown = sorted(shown, key=lambda group: group.ok / group.flights)[:MOST_LINES]
            left = len(section) - len(shown)
        for k, group in enumerate(shown):
            values = [show.plain(value) for value in group.values.values()]
            head = [show.plain(next(iter(group.values))) if k == 0 else "", *values] if several else values
            table.add_row(*head, *_figures(group))
        if left:
            table.add_row(*([""] if several else []), f"[dim]{left} more that do better[/dim]")
        table.add_section()
    return table


def _figures(group: Group) -> list[str]:
    rate = group.ok / group.flights
    style = "green" if group.ok == group.flights else "yellow" if rate >= 0.9 else "red"
    return [
        str(group.flights),
        f"[{style}]{100.0 * rate:.1f}[/{style}]",
        f"{100.0 * group.low:.1f}-{100.0 * group.high:.1f}",
        _metres(group.p95_median_m),
        _metres(group.p95_worst_m),
        _metres(group.clearance_m),
        f"{group.simulated_s:.0f}",
    ]


def _tell_failures(failures: Sequence[Cluster], folder: Path, out: Console) -> None:
    """The kinds, the commonest first, each with runs to look at."""
    if not failures:
        return
    piped = not out.is_terminal
    out.print("\n[bold]failures by kind[/bold]")
    for cluster in failures[:MOST_CLUSTERS]:
        shared = "".join(f", all with {axis} {show.plain(value)}" for axis, value in cluster.common.items())
        out.print(
            f"[red]{len(cluster.run_ids):5d}[/red]  {show.plain(cluster.kind)}[dim]{shared}[/dim]", soft_wrap=True
        )
        ids = " ".join(show.plain(run_id) for run_id in cluster.run_ids[:MOST_IDS])
        more = f" and {len(cluster.run_ids) - MOST_IDS} more" if len(cluster.run_ids) > MOST_IDS else ""
        out.print(f"       [dim]{ids}{more}[/dim]", soft_wrap=piped)
    if len(failures) > MOST_CLUSTERS:
        out.print(f"       {len(failures) - MOST_CLUSTERS} kinds more: --json has them")
    again = f"companion campaign rerun {shlex.quote(str(folder))} {failures[0].run_ids[0]}"
    out.print(f"[dim]the very same flight again: {show.plain(again)}[/dim]", soft_wrap=True)


def _metres(value: Any) -> str:
    return "-" if value is None else f"{round(value, 2) + 0.0:.2f}"
