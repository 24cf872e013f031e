"""A campaign's folder: what is done is whole and safe, whatever happens; flights here are made up, and cost nothing."""

import errno
import json
import os
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest

from campaigns import campaign
from campaigns.campaign import Progress, fly_campaign, record_flights, shard_of, write_campaign_tables
from campaigns.errors import CampaignError
from campaigns.executors.base import Outcome, R, T, answer
from campaigns.flying import FIGURES, Flown
from campaigns.runs import Run, Squall
from campaigns.store import Store, open_store
from campaigns.sweep import Sweep, load_sweep
from companion.testing.wire import LinkFaults

MISSION = """\
name: hop
vehicle: {start: {north: 2, east: 2}}
world: {bounds: {north: [0, 10], east: [0, 10], altitude: [0, 4]}}
steps: [{takeoff: {altitude: 1}}, land]
"""
SWEEP = """\
name: s
missions: [hop.yaml]
seeds: 1-6
winds: [{gusts: [{at: 3, velocity: [1, 0, 0.1]}]}]
links: [{loss: 0.1, blackouts: [[1, 2]]}]
gains: [pid]
recordings: {failures: 1, sample: 2}
"""


class Here:
    """Does the work in this process; of some items it has something else to say."""

    def __init__(self, lost: Iterable[int] = ()) -> None:
        self.lost = set(lost)
        self.begun: list[int] = []

    def map(
        self, work: Callable[[T], R], items: Iterable[T], *, timeout_s: float | None = None, retries: int = 0
    ) -> Iterator[Outcome[T, R]]:
        for item in items:
            run: Any = item[0] if isinstance(item, tuple) else item
            self.begun.append(run.seed)
            if run.seed in self.lost:
                yield Outcome(item, infrastructure="took longer than 600 s")
            else:
                done = answer(work, item)
                yield Outcome(item, done.result, done.error)

    def close(self) -> None: ...


def made_up(run: Run) -> Flown:
    figures = {**dict.fromkeys(FIGURES), "simulated_s": run.seed + 0.1, "tracking_p95_m": 1.0 / 3.0}
    ok = run.seed != 4
    row = {"status": "flown", "ok": ok, "phase": "done", "failure": "", "cause": "" if ok else "hit", "innovation": ""}
    return Flown({**run.columns(), **row, **figures}, cpu_s=0.5, wall_s=1.0, host="here")


def made_up_recorded(item: tuple[Run, Path]) -> Flown:
    item[1].parent.mkdir()
    item[1].write_bytes(b"recording")
    return made_up(item[0])


@pytest.fixture
def sweep(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Sweep:
    (tmp_path / "hop.yaml").write_text(MISSION)
    (tmp_path / "s.yaml").write_text(SWEEP)
    monkeypatch.setattr(campaign, "fly_run", made_up)
    monkeypatch.setattr(campaign, "record_run", made_up_recorded)
    return load_sweep(tmp_path / "s.yaml")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "out"


def fly(sweep: Sweep, folder: Path, executor: Here, runs: list[Run] | None = None) -> Progress:
    store = open_store(folder, sweep, resume=True)
    runs = list(sweep.runs) if runs is None else runs
    progress = Progress(wanted=len(runs))
    fly_campaign(sweep, store, runs, executor, progress, lambda _: None)
    record_flights(sweep, store, runs, executor, progress, lambda _: None)
    write_campaign_tables(sweep, store, progress.lost)
    return progress


def test_a_campaign_is_a_row_a_run_in_the_sweeps_order(sweep: Sweep, folder: Path) -> None:
    progress = fly(sweep, folder, Here())
    table = pq.read_table(folder / "runs.parquet").to_pylist()
    assert [row["seed"] for row in table] == [1, 2, 3, 4, 5, 6]
    assert [row["run_id"] for row in table] == [run.run_id for run in sweep.runs]
    assert [row["ok"] for row in table] == [True, True, True, False, True, True]
    assert table[0]["tracking_p95_m"] == 1.0 / 3.0
    assert table[0]["tracking_rms_m"] is None
    assert (progress.now, progress.failed) == (6, 1)
    costs = pq.read_table(folder / "costs.parquet").to_pylist()
    assert costs[0] == {"run_id": table[0]["run_id"], "cpu_s": 0.5, "wall_s": 1.0, "host": "here", "attempts": 1}


def test_recordings_are_kept_of_failures_and_of_the_sample_and_of_nothing_else(sweep: Sweep, folder: Path) -> None:
    executor = Here()
    progress = fly(sweep, folder, executor)
    table = {row["run_id"]: row["recording"] for row in pq.read_table(folder / "runs.parquet").to_pylist()}
    failed = sweep.runs[3].run_id
    assert {i for i, recording in table.items() if recording} == sweep.sampled | {failed}
    assert table[failed] == f"runs/{failed}/flight.mcap"
    assert (folder / table[failed]).read_bytes() == b"recording"
    assert progress.recorded == len(sweep.sampled | {failed}) == len(executor.begun) - 6


def test_the_recordings_of_several_vehicles_are_a_folder_and_kept_as_such(
    sweep: Sweep, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def several(item: tuple[Run, Path]) -> Flown:
        item[1].mkdir(parents=True)
        (item[1] / "1.mcap").write_bytes(b"recording")
        return made_up(item[0])

    monkeypatch.setattr(campaign, "record_run", several)
    fly(sweep, folder, Here())
    row = pq.read_table(folder / "runs.parquet").to_pylist()[3]
    assert (folder / row["recording"] / "1.mcap").exists()
    again = Here()
    fly(sweep, folder, again)
    assert again.begun == []


def test_what_is_done_is_not_flown_again_and_the_table_is_the_same(sweep: Sweep, folder: Path, tmp_path: Path) -> None:
    fly(sweep, folder, Here())
    whole = (folder / "runs.parquet").read_bytes()
    again = Here()
    progress = fly(sweep, folder, again)
    assert again.begun == []
    assert (progress.before, progress.now, progress.failed) == (6, 0, 1)
    assert (folder / "runs.parquet").read_bytes() == whole
    other = tmp_path / "other"
    fly(sweep, other, Here(), list(reversed(sweep.runs)))
    assert (other / "runs.parquet").read_bytes() == whole


def test_a_run_nobody_could_fly_is_told_in_the_table_and_flown_the_next_time(sweep: Sweep, folder: Path) -> None:
    progress = fly(sweep, folder, Here(lost=[2]))
    row = pq.read_table(folder / "runs.parquet").to_pylist()[1]
    assert (row["status"], row["cause"]) == ("infrastructure", "took longer than 600 s")
    assert (progress.now, len(progress.lost)) == (5, 1)
    again = Here()
    fly(sweep, folder, again)
    assert again.begun == [2] or again.begun == [2, 2]  # once more if its recording is kept
    assert pq.read_table(folder / "runs.parquet").to_pylist()[1]["status"] == "flown"


def test_shards_have_every_run_once_and_their_folders_put_together_are_the_whole(sweep: Sweep, folder: Path) -> None:
    shards = [shard_of(sweep.runs, k, 4) for k in (1, 2, 3, 4)]
    assert sorted(run.seed for shard in shards for run in shard) == [1, 2, 3, 4, 5, 6]
    for shard in shards:
        fly(sweep, folder, Here(), shard)
    nothing = Here()
    fly(sweep, folder, nothing)
    assert nothing.begun == []
    assert len(pq.read_table(folder / "runs.parquet")) == 6


@pytest.mark.parametrize("after", [0, 1, 4])
def test_a_full_disk_is_one_line_and_what_is_done_is_whole(
    sweep: Sweep, folder: Path, monkeypatch: pytest.MonkeyPatch, after: int
) -> None:
    open_store(folder, sweep, resume=False)
    kept = 0

    def full(descriptor: int) -> None:
        nonlocal kept
        kept += "result" in os.readlink(f"/proc/self/fd/{descriptor}")
        if kept > after:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        with pytest.raises(CampaignError) as caught:
            fly(sweep, folder, Here())
    assert str(caught.value) == (
        f"{folder}: cannot be written: No space left on device; {after} of 6 runs are safe in it"
    )
    store = Store(folder)
    assert len(store.rows()) == len(store.done()) == after
    assert not list((folder / "runs").glob(".*"))
    again = Here()
    assert fly(sweep, folder, again).before == after
    assert len(Store(folder).rows()) == 6


@pytest.mark.parametrize(
    "data", [b"", b"{", b"[]", b'{"run": {}, "row": {}}', b'{"run": {}, "row": {"ok": true}, "cost": {}}', b"\xff\xfe"]
)
def test_a_damaged_result_is_flown_again(sweep: Sweep, folder: Path, data: bytes) -> None:
    fly(sweep, folder, Here())
    whole = (folder / "runs.parquet").read_bytes()
    (folder / "runs" / sweep.runs[2].run_id / "result.json").write_bytes(data)
    again = Here()
    fly(sweep, folder, again)
    assert again.begun[0] == 3
    assert (folder / "runs.parquet").read_bytes() == whole


def test_a_runs_folder_without_a_whole_result_of_its_own_is_flown_again(sweep: Sweep, folder: Path) -> None:
    fly(sweep, folder, Here())
    whole = (folder / "runs.parquet").read_bytes()
    results = [folder / "runs" / run.run_id / "result.json" for run in sweep.runs]
    results[2].unlink()
    results[3].write_text(results[3].read_text().replace('"cpu_s"', '"cpu"'))
    results[5].write_bytes(results[4].read_bytes())
    again = Here()
    progress = fly(sweep, folder, again)
    assert again.begun[:3] == [3, 4, 6]
    assert (progress.before, progress.now, progress.lost) == (3, 3, [])
    assert (folder / "runs.parquet").read_bytes() == whole


def test_who_dies_while_a_damaged_result_is_removed_leaves_no_run(
    sweep: Sweep, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    fly(sweep, folder, Here())
    run_id = sweep.runs[2].run_id
    (folder / "runs" / run_id / "result.json").write_bytes(b"{")

    def dies(path: Path, **_: object) -> None:
        (path / "result.json").unlink()
        raise KeyboardInterrupt

    store = open_store(folder, sweep, resume=True)
    assert store.read(run_id) is None
    with monkeypatch.context() as patch:
        patch.setattr("campaigns.store.shutil.rmtree", dies)
        with pytest.raises(KeyboardInterrupt):
            store.discard_damaged()
    assert run_id not in store.done()
    assert fly(sweep, folder, Here()).now == 1
    assert not list((folder / "runs").glob(".*"))


@pytest.mark.parametrize("code", [errno.EIO, errno.EMFILE, errno.ESTALE, errno.EACCES])
def test_a_result_that_the_disk_does_not_give_is_one_line_and_stays(
    sweep: Sweep, folder: Path, monkeypatch: pytest.MonkeyPatch, code: int
) -> None:
    fly(sweep, folder, Here())
    path, read = folder / "runs" / sweep.runs[2].run_id / "result.json", Path.read_bytes

    def fails(this: Path) -> bytes:
        if this == path:
            raise OSError(code, os.strerror(code))
        return read(this)

    with monkeypatch.context() as patch:
        patch.setattr(Path, "read_bytes", fails)
        with pytest.raises(CampaignError) as caught:
            fly(sweep, folder, Here())
    assert str(caught.value) == f"{path}: cannot be read: {os.strerror(code)}; it stays as it is"
    again = Here()
    assert fly(sweep, folder, again).before == 6
    assert again.begun == []


def test_a_run_of_which_nothing_came_is_lost(sweep: Sweep, folder: Path) -> None:
    class Forgets(Here):
        def map(self, work: Any, items: Iterable[Any], **_: Any) -> Iterator[Outcome[Any, Any]]:
            for outcome in super().map(work, items):
                run = outcome.item
                if run.seed != 2:
                    yield outcome  # which is kept before the next is asked for
                if run.seed == 5:
                    (folder / "runs" / run.run_id / "result.json").unlink()

    store, progress = open_store(folder, sweep, resume=False), Progress(wanted=6)
    fly_campaign(sweep, store, sweep.runs, Forgets(), progress, lambda _: None)
    assert (progress.done, [row["seed"] for row in progress.lost]) == (4, [2, 5])
    assert progress.lost[0]["cause"] == "its result is not there, or is damaged"


def test_it_says_how_many_results_are_of_other_versions_and_the_table_is_the_same(
    sweep: Sweep, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    fly(sweep, folder, Here(lost=[1, 2]))
    fly(sweep, folder, Here(lost=[1, 2]))
    assert capsys.readouterr().err == ""
    with monkeypatch.context() as patch:
        patch.setattr("campaigns.executors.versions.versions", lambda: {"numba": "0.1"})
        fly(sweep, folder, Here())
    other = "results are of other sources, packages or processors than these: they may not be what these would give\n"
    assert capsys.readouterr().err == f"companion: {folder}: 4 of 4 {other}"
    whole = (folder / "runs.parquet").read_bytes()
    fly(sweep, folder, Here())
    assert capsys.readouterr().err == f"companion: {folder}: 2 of 6 {other}"
    assert (folder / "runs.parquet").read_bytes() == whole


def test_half_a_run_that_was_left_is_no_run_and_is_cleared_away(sweep: Sweep, folder: Path) -> None:
    store = open_store(folder, sweep, resume=False)
    left = [folder / "runs" / f".{os.uname().nodename}.{pid}.{sweep.runs[0].run_id}" for pid in (2**22 + 1, 1)]
    for partial in left:
        partial.mkdir()
        (partial / "result.json").write_text("{")
    assert store.done() == set()
    assert fly(sweep, folder, Here()).now == 6
    assert [partial.exists() for partial in left] == [False, True]  # the second's process is alive


def test_another_sweep_in_the_same_folder_is_refused(sweep: Sweep, folder: Path, tmp_path: Path) -> None:
    fly(sweep, folder, Here())
    (tmp_path / "s.yaml").write_text(SWEEP.replace("1-6", "1-7"))
    for resume in (False, True):
        with pytest.raises(CampaignError, match=r"holds another campaign, 's': choose another --out"):
            open_store(folder, load_sweep(tmp_path / "s.yaml"), resume)


def test_a_folder_with_results_is_refused_without_resume_and_so_is_one_with_something_else(
    sweep: Sweep, folder: Path, tmp_path: Path
) -> None:
    open_store(folder, sweep, resume=False)
    open_store(folder, sweep, resume=False)  # nothing is done in it
    fly(sweep, folder, Here())
    with pytest.raises(CampaignError, match="holds this campaign, 6 of 6 runs are done: --resume goes on with it"):
        open_store(folder, sweep, resume=False)
    with pytest.raises(CampaignError, match="and no campaign, expected a new or an empty folder"):
        open_store(tmp_path, sweep, resume=True)


@pytest.mark.parametrize("text", ["", "{}", '{"name": "s", "digest": "", "version": "", "run_ids": 3}', "[]"])
def test_a_folder_whose_campaign_cannot_be_read_is_refused_in_one_line(folder: Path, text: str) -> None:
    folder.mkdir()
    (folder / "campaign.json").write_text(text)
    with pytest.raises(CampaignError, match=r"campaign\.json: ") as caught:
        Store(folder)
    assert "\n" not in str(caught.value)


def test_a_run_comes_back_from_the_folder_as_it_was_flown(sweep: Sweep, folder: Path) -> None:
    fly(sweep, folder, Here())
    store = Store(folder)
    run = sweep.runs[2]
    assert store.run(run.run_id) == run
    assert run.squalls == (Squall(3.0, 0.5, 2.0, (1.0, 0.0, 0.1)),)
    assert run.link == LinkFaults(loss=0.1, blackouts=((1.0, 2.0),), seed=run.seed)
    assert dict(run.parameters)["FT_VXY_KP"] == 6.0


def test_the_beginning_of_an_id_is_enough_if_it_is_of_one_run(sweep: Sweep, folder: Path) -> None:
    fly(sweep, folder, Here())
    store, run_id = Store(folder), sweep.runs[0].run_id
    assert store.whole_id(run_id[:12]) == run_id
    with pytest.raises(CampaignError, match="no run that is done begins with 'zz'"):
        store.whole_id("zz")
    with pytest.raises(CampaignError, match="6 runs that are done begin with ''"):
        store.whole_id("")


def test_a_result_is_plain_json_without_the_missions_text(sweep: Sweep, folder: Path) -> None:
    fly(sweep, folder, Here())
    run = sweep.runs[0]
    told = json.loads((folder / "runs" / run.run_id / "result.json").read_text())
    assert told["row"]["run_id"] == run.run_id
    assert "data" not in told["run"]
    assert (folder / "missions" / f"{run.mission_sha}.yaml").read_text() == MISSION


def test_a_flight_that_differs_when_it_is_recorded_is_told_and_its_recording_is_not_kept(
    sweep: Sweep, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def another(item: tuple[Run, Path]) -> Flown:
        flown = made_up_recorded(item)
        return Flown({**flown.row, "tracking_p95_m": 0.5}, flown.cpu_s, flown.wall_s, flown.host)

    monkeypatch.setattr(campaign, "record_run", another)
    progress = fly(sweep, folder, Here())
    assert set(progress.differing) == sweep.sampled | {sweep.runs[3].run_id}
    assert not list(folder.rglob("*.mcap"))


def test_a_recording_that_cannot_be_made_is_told_and_made_the_next_time(
    sweep: Sweep, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(item: tuple[Run, Path]) -> Flown:
        item[1].parent.mkdir()
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(campaign, "record_run", full)
        progress = fly(sweep, folder, Here())
    assert len(progress.unrecorded) == progress.recordings == len(sweep.sampled | {sweep.runs[3].run_id})
    assert "No space left on device" in progress.unrecorded[0]
    assert all(row["status"] == "flown" for row in pq.read_table(folder / "runs.parquet").to_pylist())
    assert not list((folder / "runs").glob(".*"))
    again = Here()
    assert fly(sweep, folder, again).recorded == len(again.begun) == progress.recordings
