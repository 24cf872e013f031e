"""`companion campaign`: a sweep in, a folder of results out; and one of its runs again."""

import re
import shlex
import signal
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, TextColumn
from rich.progress import Progress as Bar
from rich.table import Table

from campaigns.campaign import (
    Progress,
    differences,
    fly_campaign,
    record_flights,
    shard_of,
    write_campaign_tables,
)
from campaigns.errors import CampaignError, CampaignInterrupted, SchedulerError
from campaigns.executors import Executor, local
from campaigns.flying import Row, fly_recorded, fly_run
from campaigns.runs import Run
from campaigns.store import Store, open_store
from campaigns.sweep import Sweep, load_sweep
from campaigns.table import check_parquet
from companion.cli import show

TELL_S = 10.0
"""Between two lines where there is no terminal [s]."""
FEW = 8
"""Flights from which no pace is taken yet."""
CAUSES = 3
DIFFERS = 3
_SHARD = re.compile(r"([1-9]\d{0,5})/([1-9]\d{0,5})")


def fly_sweep(
    path: Path, out: Path | None, jobs: int, resume: bool, shard: str | None, scheduler: str | None, as_json: bool
) -> int:
    """Fly a sweep; returns the exit code: 0 when every run is flown, however its flight ended.

    Raises
    ------
    CompanionError, CampaignError : one line for a person.
    """
    part = _shard(shard)
    if part is None:
        print(f"companion: --shard: found {shard!r}, expected K/N such as 3/50, K at most N", file=sys.stderr)
        return 2
    with show.working(show.console(), f"reading {path}"):
        sweep = load_sweep(path)
    folder = Path(f"{path.stem}-campaign") if out is None else out
    check_parquet(folder)
    started = time.monotonic()
    with ExitStack() as stack:
        here = stack.enter_context(closing(local(jobs)))
        there = here if scheduler is None else stack.enter_context(closing(_dask(scheduler)))
        store = open_store(folder, sweep, resume)
        progress = _fly(sweep, store, shard_of(sweep.runs, *part), there, here)
    return _tell_end(store, progress, time.monotonic() - started, as_json)


def _fly(sweep: Sweep, store: Store, runs: Sequence[Run], there: Executor, here: Executor) -> Progress:
    """Fly there, record here, and write the tables whatever happens."""
    progress = Progress(wanted=len(runs))
    try:
        with _ended_by_a_signal(), telling(show.console(), store.folder) as tell:
            fly_campaign(sweep, store, runs, there, progress, tell)
            record_flights(sweep, store, runs, here, progress, tell)
    except KeyboardInterrupt:
        done = f"{len(store.done())} of {len(store.run_ids)} runs are done"
        raise CampaignInterrupted(f"{store.folder}: interrupted, {done}: --resume goes on") from None
    except SchedulerError as error:
        done = f"{len(store.done())} of {len(store.run_ids)} runs are done"
        raise CampaignError(f"{error}; {done}: --resume goes on") from error
    except OSError as error:  # no process can be started, or the like
        raise CampaignError(f"{store.folder}: {error.strerror or error}; --resume goes on") from error
    finally:
        here.close()  # nobody writes any more
        store.clear_partial()
        write_campaign_tables(sweep, store, progress.lost)
    return progress


def rerun_run(folder: Path, run_id: str, record: Path | None, as_json: bool) -> int:
    """Fly a run again; returns 0 when its row is the one that is stored, 3 when it is not.

    Raises
    ------
    CampaignError : there is no such run.
    """
    store = Store(folder)
    run_id = store.whole_id(run_id)
    run, stored = store.run(run_id), store.read(run_id)
    if run.run_id != run_id or stored is None:
        raise CampaignError(f"{folder}: run {run_id} is of another version, or was changed: it is {run.run_id} now")
    with show.working(show.console(), f"flying {run.mission} again, {run.autopilot}, seed {run.seed}"):
        again = fly_run(run) if record is None else fly_recorded(run, record)
    differ = differences(stored.row, again.row)
    if as_json:
        told = {name: {"stored": stored.row.get(name), "again": again.row[name]} for name in differ}
        show.print_json({"ok": not differ, "row": again.row, "differing": told, "recording": record and str(record)})
    else:
        Console().print(_row_table(run_id, stored.row, again.row))
        Console(highlight=False).print(
            f"[bold red]differs in {', '.join(differ)}[/bold red]" if differ else "the same as stored, in every column"
        )
    return DIFFERS if differ else 0


@contextmanager
def telling(console: Console, folder: Path) -> Iterator[Callable[[Progress], None]]:
    """To be told how far a campaign is: a bar on a terminal, a line now and then elsewhere."""
    clock = Clock()
    if not console.is_terminal:
        told_s = 0.0

        def say(progress: Progress) -> None:
            nonlocal told_s
            if clock.seconds() >= told_s + TELL_S:
                told_s = clock.seconds()
                console.print(f"{folder}: {clock.words(progress)}", soft_wrap=True)

        yield say
        return
    with Bar(BarColumn(24), TextColumn("{task.description}"), console=console, transient=True) as bar:
        task = bar.add_task("starting", total=1.0)
        yield lambda progress: bar.update(
            task, description=show.plain(clock.words(progress)), completed=progress.done / max(progress.wanted, 1)
        )


class Clock:
    """How long it goes on, and will."""

    def __init__(self) -> None:
        self._began = time.monotonic()
        self._first: tuple[float, int] | None = None

    def seconds(self) -> float:
        """Since the beginning."""
        return time.monotonic() - self._began

    def words(self, progress: Progress) -> str:
        """How far it is, for people."""
        said = f"{progress.done} of {progress.wanted} flown, {progress.failed} failed"
        if progress.lost:
            said += f", {len(progress.lost)} could not be flown"
        if progress.recordings:
            return f"{said}; {progress.recorded} of {progress.recordings} recorded"
        left = progress.wanted - progress.done - len(progress.lost)
        if not progress.now or not left:
            return said
        return f"{said}, {_duration(left * self._each_s(progress.now))} left"

    def _each_s(self, now: int) -> float:
        """Between two that are flown [s]: since the first, which had to wait for imports and kernels."""
        self._first = self._first or (self.seconds(), now)
        since_s, before = self._first
        return self.seconds() / now if now < before + FEW else (self.seconds() - since_s) / (now - before)


def _duration(seconds: float) -> str:
    """Hours, minutes and seconds, in two words."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes:02d} min" if hours else f"{minutes} min {rest:02d} s" if minutes else f"{rest} s"


def _tell_end(store: Store, progress: Progress, seconds: float, as_json: bool) -> int:
    """What came of it; the exit code."""
    lost, differing = progress.lost, progress.differing
    kept = sum(bool(store.recording(run_id)) for run_id in store.done())
    if as_json:
        show.print_json(
            {
                "ok": not lost and not differing and not progress.unrecorded,
                "campaign": str(store.folder),
                "runs": progress.wanted,
                "flown": progress.done,
                "flown_now": progress.now,
                "failed": progress.failed,
                "not_flown": [{"run_id": row["run_id"], "cause": row["cause"]} for row in lost],
                "differing": differing,
                "not_recorded": progress.unrecorded,
                "recordings": kept,
                "seconds": seconds,
            }
        )
    else:
        before = f" ({progress.before} before)" if progress.before else ""
        out = Console(highlight=False)
        out.print(
            f"[bold]{progress.done} of {progress.wanted} runs flown[/bold]{before}, {progress.failed} did not end as "
            f"expected, {kept} recorded, in {_duration(seconds)}",
            soft_wrap=True,
        )
        out.print(f"[dim]companion campaign show {show.plain(shlex.quote(str(store.folder)))}[/dim]", soft_wrap=True)
    for text in progress.unrecorded[:CAUSES]:
        print(f"companion: could not be recorded: run {text}; --resume tries again", file=sys.stderr)
    for run_id in differing:
        print(f"companion: run {run_id}: flown again to be recorded, it differs from what is stored", file=sys.stderr)
    causes = Counter(row["cause"] for row in lost)
    for cause, count in causes.most_common(CAUSES):
        many = f"{count} runs" if count > 1 else "1 run"
        print(f"companion: {many} could not be flown: {cause}; --resume tries again", file=sys.stderr)
    return DIFFERS if differing else 1 if lost or progress.unrecorded else 0


def _shard(text: str | None) -> tuple[int, int] | None:
    """Which of how many; None: it is not of that form."""
    match = _SHARD.fullmatch(text or "1/1")
    if match is None or int(match[1]) > int(match[2]):
        return None
    return int(match[1]), int(match[2])


def _row_table(run_id: str, stored: Row, again: Row) -> Table:
    """Its columns; where it differs, both values."""
    differ = differences(stored, again)
    table = Table("column", *(("stored", "again") if differ else ("value",)), title=f"run {run_id}")
    table.title_justify = "left"
    for name in again:
        rows = (stored, again) if differ else (again,)
        table.add_row(name, *(_value(row.get(name)) for row in rows), style="bold red" if name in differ else "")
    return table


def _value(value: object) -> str:
    if value is None or value == "":
        return "-"
    return f"{value:.6g}" if isinstance(value, float) else show.plain(str(value))


@contextmanager
def _ended_by_a_signal() -> Iterator[None]:
    """SIGTERM ends it as Ctrl-C does, with the tables written."""
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _dask(address: str) -> Executor:
    from campaigns.executors.dask import dask

    return dask(address)
