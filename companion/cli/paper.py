"""`companion paper`: the paper's tables and figures made again, each of its claims with a verdict."""

import time
from contextlib import closing
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn
from rich.table import Table

from campaigns.executors import local
from campaigns.paper.run import PAGE, costs, make_paper
from campaigns.paper.sizes import FULL, QUICK, Sizes
from companion.cli import show


def make(quick: bool, out: Path, jobs: int, as_json: bool) -> int:
    """Run the paper into a folder; returns the exit code.

    Raises
    ------
    CompanionError : something failed; what is done is kept, and the same command goes on with it.
    """
    sizes = QUICK if quick else FULL
    began = time.monotonic()
    with closing(local(jobs)) as executor, HowFar(sizes, show.console()) as progress:
        results = make_paper(sizes, out, executor, progress)
    counts: dict[str, int] = {}
    for claim in results["claims"]:
        counts[claim["verdict"]] = counts.get(claim["verdict"], 0) + 1
    if as_json:
        show.print_json(
            {"ok": True, "page": str(out / PAGE), "size": sizes.name, "verdicts": counts, "claims": results["claims"]}
        )
        return 0
    table = Table(title=f"{len(results['claims'])} claims of the paper", show_lines=True)
    for name in ("where", "the paper says", "verdict"):
        table.add_column(name)
    for claim in results["claims"]:
        table.add_row(*(show.plain(claim[name]) for name in ("place", "says", "verdict")))
    Console().print(table)
    minutes = (time.monotonic() - began) / 60.0
    Console().print(f"page: {out / PAGE}  ({minutes:.1f} min)", soft_wrap=True)
    return 0


class HowFar:
    """Progress over all stages, weighed by what their items cost: a bar on a terminal, else lines now and then."""

    def __init__(self, sizes: Sizes, out: Console) -> None:
        self._costs, self._out = costs(sizes), out
        self._total = sum(items * each for items, each in self._costs.values())
        self._stage, self._items, self._count = "", 0, 0
        self._behind = self._made = 0.0  # cost of all that is done; and of what was done in this run
        self._base = 0.0
        self._began = self._told = time.monotonic()
        self._bar = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            TextColumn("{task.percentage:3.0f} %  {task.fields[left]}"),
            console=out,
        )
        self._task = self._bar.add_task("paper", total=self._total, left="")

    def __enter__(self) -> "HowFar":
        if self._out.is_terminal:
            self._bar.start()
        return self

    def __exit__(self, *exception: object) -> None:
        self._bar.stop()

    def begin(self, stage: str, items: int, kept: int) -> None:
        """As `stages.Progress`."""
        self._base = sum(
            n * each
            for name, (n, each) in self._costs.items()
            if list(self._costs).index(name) < list(self._costs).index(stage)
        )
        self._stage, self._items, self._count = stage, items, kept
        self._tell(always=True)

    def done(self) -> None:
        """As `stages.Progress`."""
        self._count += 1
        self._made += self._costs[self._stage][1]
        self._tell(always=False)

    def _tell(self, *, always: bool) -> None:
        now = time.monotonic()
        each = self._costs[self._stage][1]
        self._behind = self._base + min(self._count, self._items) * each
        left = (self._total - self._behind) / self._made * (now - self._began) if self._made else None
        said = (
            "" if left is None else f"about {left / 60.0:.0f} min left" if left > 90.0 else f"about {left:.0f} s left"
        )
        what = f"{self._stage} {min(self._count, self._items)}/{self._items}"
        if self._out.is_terminal:
            self._bar.update(self._task, completed=self._behind, description=what, left=said)
        elif always or now - self._told >= show.TELL_S:
            self._told = now
            self._out.print(f"{what}, {100.0 * self._behind / self._total:.0f} % of all{', ' + said if said else ''}")
