"""A campaign is flown: what is not done yet, then the recordings that are to be kept, then the tables.

Nothing is recorded while flying: a recording costs time and disk, and few are wanted. Since the same run is the same
flight, those that are wanted (flights that failed, in the campaign's order, and a drawn sample) are flown once more
for it, on this machine, and must give the same row.
"""

import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

from campaigns.executors import Executor
from campaigns.executors.versions import digest
from campaigns.flying import Row, fly_run, lost_row, record_run
from campaigns.runs import Run
from campaigns.store import Store
from campaigns.sweep import Sweep
from campaigns.table import write_tables

RETRIES = 2
"""How often a run is flown again whose process or machine was lost."""


@dataclass(slots=True)
class Progress:
    """How far a campaign is.

    Attributes
    ----------
    wanted : runs this command is to fly, those that are done before included.
    before, now : done before it, and by it.
    failed : of both, flights that did not end as expected.
    lost : rows of runs that nobody could fly, or whose result is not there in the end.
    recordings, recorded : to be made, and made.
    unrecorded : ids of runs whose recording could not be made, and why.
    differing : ids of runs that did not give the same row again.
    """

    wanted: int
    before: int = 0
    now: int = 0
    failed: int = 0
    lost: list[Row] = field(default_factory=list)
    recordings: int = 0
    recorded: int = 0
    unrecorded: list[str] = field(default_factory=list)
    differing: list[str] = field(default_factory=list)

    @property
    def done(self) -> int:
        return self.before + self.now


def shard_of(runs: Sequence[Run], number: int, count: int) -> list[Run]:
    """Every `count`-th run, from the `number`-th on (from 1): the shards have all runs, each once."""
    return list(runs[number - 1 :: count])


def fly_campaign(
    sweep: Sweep,
    store: Store,
    runs: Sequence[Run],
    executor: Executor,
    progress: Progress,
    tell: Callable[[Progress], None],
) -> None:
    """Fly those of `runs` that are not done, and see that each is done then, or told as lost.

    How many results are there of other sources, packages or processors than ours is told in a line on the standard
    error: the same run may have come out otherwise there.

    Parameters
    ----------
    progress : is kept up to date.
    tell : called with it after each.

    Raises
    ------
    CampaignError : a result cannot be read or kept, or the executor's place is gone. What is done is safe.
    """
    done = store.done()
    there = {run.run_id: found for run in runs if run.run_id in done and (found := store.read(run.run_id))}
    store.discard_damaged()
    progress.before = len(there)
    progress.failed = sum(not found.row["ok"] for found in there.values())
    if other := sum(found.versions != digest() for found in there.values()):
        told = f"{other} of {len(there)} results are of other sources, packages or processors than these"
        print(f"companion: {store.folder}: {told}: they may not be what these would give", file=sys.stderr)
    left = [run for run in runs if run.run_id not in there]
    tell(progress)
    for outcome in executor.map(fly_run, left, timeout_s=sweep.timeout_s, retries=RETRIES):
        if outcome.result is None:
            progress.lost.append(lost_row(outcome.item, outcome.infrastructure or outcome.error))
        else:
            store.complete(outcome.item, outcome.result, outcome.attempts)
            progress.now += 1
            progress.failed += not outcome.result.row["ok"]
        tell(progress)
    _miss(store, runs, progress)


def _miss(store: Store, runs: Sequence[Run], progress: Progress) -> None:
    """What is neither done nor lost by now is lost: its result was taken away, damaged, or never came."""
    lost = {row["run_id"] for row in progress.lost}
    missing = [run for run in runs if run.run_id not in lost and store.read(run.run_id) is None]
    progress.lost += [lost_row(run, "its result is not there, or is damaged") for run in missing]
    progress.now = len(runs) - len(progress.lost) - progress.before


def to_record(sweep: Sweep, store: Store) -> list[str]:
    """Ids of the runs whose recordings are kept, as far as is known by now."""
    failed = [s.row["run_id"] for s in store.stored() if not s.row["ok"]][: sweep.failures]
    done = store.done()
    return list(dict.fromkeys([*failed, *(i for i in store.run_ids if i in sweep.sampled and i in done)]))


def record_flights(
    sweep: Sweep,
    store: Store,
    runs: Iterable[Run],
    executor: Executor,
    progress: Progress,
    tell: Callable[[Progress], None],
) -> None:
    """Fly again, recorded, those of `runs` whose recording is wanted and not there.

    Raises
    ------
    CampaignError : a recording cannot be kept.
    """
    wanted = set(to_record(sweep, store))
    left = [run for run in runs if run.run_id in wanted and not store.recording(run.run_id)]
    progress.recordings = len(left)
    tell(progress)
    items = ((run, store.place_for_recording(run.run_id)) for run in left)
    for outcome in executor.map(record_run, items, timeout_s=sweep.timeout_s, retries=RETRIES):
        run, again = outcome.item[0], outcome.result
        stored = store.read(run.run_id)
        same = again is not None and stored is not None and not differences(stored.row, again.row)
        store.end_recording(run.run_id, keep=same)
        if again is None:
            progress.unrecorded.append(f"{run.run_id}: {outcome.infrastructure or outcome.error}")
        elif not same:
            progress.differing.append(run.run_id)
        else:
            progress.recorded += 1
        tell(progress)


def differences(stored: Row, again: Row) -> list[str]:
    """The columns in which two rows of one run differ."""
    return [name for name, value in again.items() if stored.get(name) != value]


def write_campaign_tables(sweep: Sweep, store: Store, lost: Iterable[Row]) -> None:
    """Both tables of what is done, and of what could not be.

    Raises
    ------
    CampaignError : they cannot be written.
    """
    recorded = set(to_record(sweep, store))
    stored = {found.row["run_id"]: found for found in store.stored()}
    missed = {row["run_id"]: row for row in lost if row["run_id"] not in stored}
    rows = [
        {**row, "recording": store.recording(run_id) if run_id in recorded else ""}
        for run_id in store.run_ids
        if (row := stored[run_id].row if run_id in stored else missed.get(run_id)) is not None
    ]
    with store.writing():
        write_tables(store.folder, rows, [found.cost for found in stored.values()])
