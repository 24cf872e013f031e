"""`companion campaign` as a person meets it: one clear line for what goes wrong, and an exit code."""

import json
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import pytest

from campaigns import campaign
from campaigns.errors import SchedulerError
from campaigns.executors.base import Outcome
from campaigns.flying import FIGURES, Flown
from campaigns.runs import Run
from companion.cli import app
from companion.cli import campaign as cli

MISSION = """\
name: hop
vehicle: {start: {north: 2, east: 2}}
world: {bounds: {north: [0, 10], east: [0, 10], altitude: [0, 4]}}
steps: [{takeoff: {altitude: 1}}, land]
"""
SWEEP = "name: s\nmissions: [hop.yaml]\nseeds: 1-4\nrecordings: {failures: 0, sample: 0}\n"


class Script:
    """An executor that does what it is told with each run's seed."""

    def __init__(self, told: dict[int, str]) -> None:
        self.told = told

    def map(self, work: Any, items: Iterable[Any], **_: Any) -> Iterator[Outcome[Any, Any]]:
        for item in items:
            match self.told.get(item.seed):
                case None:
                    yield Outcome(item, work(item))
                case "Ctrl-C":
                    raise KeyboardInterrupt
                case "the scheduler is gone" as why:
                    raise SchedulerError("tcp://a:1", why)
                case why:
                    yield Outcome(item, infrastructure=why, attempts=3)

    def close(self) -> None: ...


def made_up(run: Run) -> Flown:
    ended = {"status": "flown", "ok": run.seed != 3, "phase": "done", "failure": "", "cause": "", "innovation": ""}
    return Flown({**run.columns(), **ended, **dict.fromkeys(FIGURES)}, 0.5, 1.0, "here")


@pytest.fixture
def companion(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]):
    (tmp_path / "hop.yaml").write_text(MISSION)
    (tmp_path / "s.yaml").write_text(SWEEP)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(campaign, "fly_run", made_up)

    def companion(*words: str, told: dict[int, str] | None = None) -> tuple[int, str, list[str]]:
        monkeypatch.setattr(cli, "local", lambda jobs: Script(told or {}))
        monkeypatch.setattr(sys, "argv", ["companion", "campaign", *words])
        with pytest.raises(SystemExit) as end:
            app.main()
        out, err = capsys.readouterr()
        return int(end.value.code or 0), out, err.splitlines()

    return companion


def test_the_word_fly_may_be_left_out_and_flights_that_fail_are_results(companion) -> None:
    code, out, _ = companion("s.yaml")
    assert code == 0
    assert out.startswith("4 of 4 runs flown, 1 did not end as expected, 0 recorded, in 0 s")
    assert Path("s-campaign/runs.parquet").exists()
    assert companion("fly", "s.yaml", "--out", "other")[0] == 0


def test_json_is_one_object_with_what_was_flown(companion) -> None:
    told = json.loads(companion("--json", "s.yaml")[1])
    assert {k: told[k] for k in ("ok", "runs", "flown", "failed")} == {"ok": True, "runs": 4, "flown": 4, "failed": 1}


def test_runs_nobody_could_fly_are_one_line_for_each_cause_and_exit_code_1(companion) -> None:
    code, out, err = companion("s.yaml", told={1: "its process was killed by signal 9", 2: "took longer than 600 s"})
    assert code == 1
    assert out.startswith("2 of 4 runs flown, 1 did not end as expected")
    assert err[-2:] == [
        "companion: 1 run could not be flown: its process was killed by signal 9; --resume tries again",
        "companion: 1 run could not be flown: took longer than 600 s; --resume tries again",
    ]
    assert companion("s.yaml", "--resume")[0] == 0


def test_ctrl_c_is_one_line_that_says_how_to_go_on_and_exit_code_130(companion) -> None:
    code, _, err = companion("s.yaml", told={3: "Ctrl-C"})
    assert code == 130
    assert err[-1] == "companion: s-campaign: interrupted, 2 of 4 runs are done: --resume goes on"
    assert Path("s-campaign/runs.parquet").exists()
    code, out, _ = companion("s.yaml", "--resume")
    assert (code, out.splitlines()[0][:34]) == (0, "4 of 4 runs flown (2 before), 1 di")


def test_a_scheduler_that_is_lost_is_one_line_that_says_what_is_safe(companion) -> None:
    code, _, err = companion("s.yaml", told={3: "the scheduler is gone"})
    assert code == 1
    assert err[-1] == "companion: tcp://a:1: the scheduler is gone; 2 of 4 runs are done: --resume goes on"
    assert Path("s-campaign/runs.parquet").exists()
    assert companion("s.yaml", "--resume")[1].startswith("4 of 4 runs flown (2 before)")


def test_the_time_left_does_not_count_how_long_the_first_took_to_begin(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 0.0
    monkeypatch.setattr("time.monotonic", lambda: now)
    clock, progress = cli.Clock(), campaign.Progress(wanted=1000)
    assert clock.words(progress) == "0 of 1000 flown, 0 failed"
    now, progress.now = 100.0, 1  # imports, kernels, a scheduler's workers
    assert clock.words(progress).endswith(", 27 h 45 min left")
    for progress.now in range(2, 101):
        now += 1.0
        said = clock.words(progress)
    assert said == "100 of 1000 flown, 0 failed, 15 min 00 s left"


@pytest.mark.parametrize("shard", ["0/4", "5/4", "1/0", "1-4", "x", "1/"])
def test_a_shard_that_cannot_be_is_wrong_usage(companion, shard: str) -> None:
    code, _, err = companion("s.yaml", "--shard", shard)
    assert code == 2
    assert err == [f"companion: --shard: found '{shard}', expected K/N such as 3/50, K at most N"]


def test_shards_fly_their_part(companion) -> None:
    assert companion("s.yaml", "--shard", "1/3")[1].startswith("2 of 2 runs flown")
    assert companion("s.yaml", "--shard", "2/3", "--resume")[1].startswith("1 of 1 runs flown")
    assert companion("s.yaml", "--resume")[1].startswith("4 of 4 runs flown (3 before)")


def test_a_scheduler_that_cannot_be_is_one_line_and_leaves_no_folder(companion) -> None:
    code, _, err = companion("s.yaml", "--scheduler", "nowhere")
    assert code == 2
    assert err[-1].startswith("companion: nowhere: ")
    assert not Path("s-campaign").exists()


@pytest.mark.parametrize("words", [("gone.yaml",), ("show", "gone"), ("rerun", "gone", "12")])
def test_what_is_not_there_is_one_line(companion, words: tuple[str, ...]) -> None:
    code, _, err = companion(*words)
    assert code == 1
    assert err[-1].startswith("companion: gone")
    assert "No such file or directory" in err[-1]


def test_a_run_that_gives_another_row_now_is_told_column_by_column_with_exit_code_3(
    companion, monkeypatch: pytest.MonkeyPatch
) -> None:
    companion("s.yaml")
    run_id = next(path.name for path in Path("s-campaign/runs").iterdir())
    monkeypatch.setattr(cli, "fly_run", made_up)
    code, out, _ = companion("rerun", "s-campaign", run_id[:10])
    assert (code, out.splitlines()[-1]) == (0, "the same as stored, in every column")

    def changed(run: Run) -> Flown:
        return Flown({**made_up(run).row, "phase": "failed", "tracking_p95_m": 0.5}, 0.5, 1.0, "here")

    monkeypatch.setattr(cli, "fly_run", changed)
    code, out, _ = companion("rerun", "s-campaign", run_id[:10])
    assert (code, out.splitlines()[-1]) == (3, "differs in phase, tracking_p95_m")
    told = json.loads(companion("rerun", "s-campaign", run_id, "--json")[1])
    assert told["differing"]["phase"] == {"stored": "done", "again": "failed"}


def test_without_pyarrow_it_says_so_before_it_flies(companion, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    code, _, err = companion("s.yaml")
    assert code == 1
    assert err[-1].endswith("Parquet wants the package pyarrow: pip install 'mavlink-companion[parquet]'")
    assert not Path("s-campaign").exists()
