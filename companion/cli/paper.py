"""`companion paper`: the paper's tables and figures made again, each of its claims with a verdict."""

import time
from contextlib import closing
from itertools import accumulate
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn
from rich.table import Table

from campaigns.executors import local
from campaigns.paper.run import PAGE, costs, make_paper
from campaigns.paper.sizes import FULL, QUICK, Sizes
from companion.cli import show

ALL = "all"
"""Name of what comes after the last stage."""


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
    if as_json:
        show.print_json(
            {
                "ok": True,
                "page": str(out / PAGE),
                "size": sizes.name,
                "verdicts": results["verdicts"],
                "claims": results["claims"],
            }
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
        told = costs(sizes)
        self._each = {stage: each for stage, (_, each) in told.items()}
        behind = accumulate((items * each for items, each in told.values()), initial=0.0)
        self._before = dict(zip((*told, ALL), behind, strict=True))  # what the stages before each one cost
        self._stage, self._items, self._count, self._spent = "", 0, 0, 0.0
        self._began = self._told = time.monotonic()
        self._out = out
        shares = TextColumn("{task.percentage:3.0f} %  {task.fields[left]}")
        self._bar = Progress(TextColumn("{task.description}"), BarColumn(), shares, console=out)
        self._task = self._bar.add_task("", total=self._before[ALL], left="")

    def __enter__(self) -> "HowFar":
        if self._out.is_terminal:
            self._bar.start()
        return self

    def __exit__(self, *exception: object) -> None:
        if self._out.is_terminal:
            self._bar.stop()

    def begin(self, stage: str, items: int, kept: int) -> None:
        """As `stages.Progress`."""
        self._stage, self._items, self._count = stage, items, kept
        self._tell(always=True)

    def done(self) -> None:
        """As `stages.Progress`."""
        self._count = min(self._count + 1, self._items)
        self._spent += self._each[self._stage]
        self._tell(always=False)

    def _tell(self, *, always: bool) -> None:
        now, total = time.monotonic(), self._before[ALL]
        done = self._before[self._stage] + self._count * self._each[self._stage]
        left = f", {_about((total - done) / self._spent * (now - self._began))} left" if self._spent else ""
        what = f"{self._stage} {self._count}/{self._items}"
        if self._out.is_terminal:
            self._bar.update(self._task, completed=done, description=what, left=left.removeprefix(", "))
        elif always or now - self._told >= show.TELL_S:
            self._told = now
            self._out.print(f"{what}, {100.0 * done / total:.0f} % of all{left}")


def _about(seconds: float) -> str:
    """A time for people."""
    return f"about {seconds / 60.0:.0f} min" if seconds > 90.0 else f"about {seconds:.0f} s"
