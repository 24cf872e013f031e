"""Work on other machines: a real scheduler and two real workers, in processes of their own, on loopback."""

import os
import re
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, closing, contextmanager, suppress
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from types import SimpleNamespace
from typing import Self

import pytest

if find_spec("distributed") is None:
    pytest.skip("the extra dask is not installed", allow_module_level=True)

from dask_work import raises_hangs_or_dies, square, squares_slowly
from pyarrow import parquet

from campaigns.campaign import Progress, fly_campaign, write_campaign_tables
from campaigns.errors import AddressError, SchedulerError
from campaigns.executors.dask import Cluster as Workers
from campaigns.executors.dask import dask
from campaigns.executors.versions import difference, versions
from campaigns.flying import fly_run
from campaigns.store import open_store
from campaigns.sweep import load_sweep
from campaigns.table import COLUMNS

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.slow


@contextmanager
def started(module: str, *arguments: str, at: str, search: Sequence[Path]) -> Iterator[tuple[int, str]]:
    """A process: its id, and what it says of where it is. What it says later is read and dropped."""
    process = subprocess.Popen(
        [sys.executable, "-m", f"distributed.cli.{module}", *arguments, "--no-dashboard"],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, search))},
        cwd="/",
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stderr is not None
    found = next(found for line in process.stderr if (found := re.search(at, line)))
    drain = threading.Thread(target=process.stderr.read, daemon=True)
    drain.start()
    try:
        yield process.pid, found[1]
    finally:
        process.terminate()
        try:
            process.wait(10.0)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        drain.join(10.0)
        process.stderr.close()


SWEEP = """\
name: gap
worlds: [{family: gap}]
winds: [[0, 0], [6, 0]]
seeds: [1, 2, 3, 4]
limit_s: 6
timeout_s: 120
recordings: {failures: 0, sample: 0}
"""
"""Flights that are cut short are flights, too."""
HERE = (ROOT, ROOT / "tests" / "unit")
ONE_SOURCE = """\
from campaigns.executors import versions
versions.source = lambda: "of the tests"
"""
"""Somebody may edit our sources while the tests run."""


def scheduler(*options: str, search: Sequence[Path] = HERE) -> AbstractContextManager[tuple[int, str]]:
    options = ("--host", "127.0.0.1", "--port", "0", *options)
    return started("dask_scheduler", *options, at=r"Scheduler at:\s+(tcp://\S+)", search=search)


def worker(address: str, *options: str) -> AbstractContextManager[tuple[int, str]]:
    options = ("--nthreads", "1", "--host", "127.0.0.1", *options)
    return started("dask_worker", address, *options, at=r"Registered to:\s+(tcp://\S+)", search=HERE)


@dataclass
class Cluster:
    """Where a scheduler is, and the processes."""

    address: str
    scheduler: int
    loose: int  # a worker without a nanny: nobody starts it again


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    """A scheduler and two workers, one of them under a nanny; each test takes away what none after it needs."""
    preload = tmp_path_factory.mktemp("preload") / "one_source.py"
    preload.write_text(ONE_SOURCE)
    more = ("--preload", str(preload))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("campaigns.executors.versions.source", lambda: "of the tests")
        versions.cache_clear()
        with scheduler(*more) as (process, address), pytest.MonkeyPatch.context() as impatient:
            impatient.setattr("campaigns.executors.dask.WORKERS_S", 0.2)
            with pytest.raises(SchedulerError, match=r"no worker within 0\.2 s"):
                dask(address)
            impatient.undo()
            with worker(address, "--no-nanny", *more) as (loose, _), worker(address, *more):
                yield Cluster(address, process, loose)
    versions.cache_clear()


def test_a_worker_of_other_versions_is_refused_though_it_comes_late(
    cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    with closing(dask(cluster.address)) as executor:
        here = versions()
        monkeypatch.setattr("campaigns.executors.dask.versions", lambda: {**here, "numpy": "1.0"})
        with pytest.raises(SchedulerError, match=rf"a worker came .*: numpy: found {here['numpy']}, expected 1\.0$"):
            list(executor.map(square, [1]))


def test_what_raises_hangs_or_dies_costs_its_own_item(cluster: Cluster) -> None:
    with closing(dask(cluster.address)) as executor:
        outcomes = list(executor.map(raises_hangs_or_dies, range(5), timeout_s=1.0, retries=1))
    told = {o.item: (o.result, o.error.partition(" at ")[0], o.infrastructure, o.attempts) for o in outcomes}
    assert told == {
        0: (0, "", "", 1),
        1: (None, "ValueError", "", 1),
        2: (None, "", "took longer than 1 s", 1),
        3: (None, "", "its process was killed by signal 9", 2),
        4: (4, "", "", 1),
    }


def test_a_campaign_whose_worker_is_killed_has_the_rows_of_this_machine_each_once(
    cluster: Cluster, tmp_path: Path
) -> None:
    (tmp_path / "gap.yaml").write_text(SWEEP)
    sweep = load_sweep(tmp_path / "gap.yaml")
    store = open_store(tmp_path / "campaign", sweep, resume=False)
    progress = Progress(wanted=len(sweep.runs))

    def kill_after_the_second(so_far: Progress) -> None:
        if so_far.now == 2:
            os.kill(cluster.loose, signal.SIGKILL)

    with closing(dask(cluster.address)) as executor:
        fly_campaign(sweep, store, sweep.runs, executor, progress, kill_after_the_second)
    write_campaign_tables(sweep, store, progress.lost)
    assert (progress.now, progress.lost) == (len(sweep.runs), [])
    here = [{**fly_run(run).row, "recording": ""} for run in sweep.runs]
    assert parquet.read_table(store.folder / "runs.parquet").to_pylist() == [
        {name: row[name] for name in COLUMNS} for row in here
    ]


class Alone:
    """A client whose scheduler has no worker any more, and whose futures end there and cannot be fetched."""

    scheduler = SimpleNamespace(identity=None)
    key = status = "finished"
    asked = 0

    def wait_for_workers(self, *_: object, **__: object) -> None: ...

    def run_on_scheduler(self, work: Callable[[], dict[str, str]]) -> dict[str, str]:
        return work()

    def run(self, *_: object, **__: object) -> dict[str, dict[str, str]]:
        return {}

    def sync(self, *_: object, **__: object) -> dict[str, int]:
        return {"n_workers": 0, "total_threads": 0}

    def submit(self, *_: object, **__: object) -> Self:
        return self

    def add_done_callback(self, ended: Callable[[Self], None]) -> None:
        ended(self)

    def result(self, timeout: float) -> None:
        self.asked += 1
        assert self.asked < 1000, "asked for ever"
        time.sleep(timeout)
        raise TimeoutError

    def cancel(self, *_: object, **__: object) -> None: ...


def test_a_result_whose_last_worker_died_before_it_was_fetched_is_not_waited_for_for_ever(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("campaigns.executors.dask.WORKERS_S", 0.05)
    monkeypatch.setattr("campaigns.executors.dask.QUIET_S", 0.001)
    monkeypatch.setattr("campaigns.executors.dask._connected", lambda address: Alone())
    with pytest.raises(SchedulerError, match=r"^tcp://a:1: no worker for 0\.05 s$"):
        list(Workers("tcp://a:1").map(square, [1]))


@pytest.mark.parametrize("fate", [signal.SIGSTOP, signal.SIGKILL])
def test_a_scheduler_lost_in_mid_campaign_is_one_line_after_the_results_so_far(
    cluster: Cluster,
    fate: signal.Signals,
    capfd: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with closing(dask(cluster.address)) as executor:
        monkeypatch.setattr("campaigns.executors.dask.QUIET_S", 0.5)
        monkeypatch.setattr("campaigns.executors.dask.ANSWER_S", 1.0)
        outcomes = executor.map(squares_slowly, range(100))
        assert next(outcomes).result is not None
        os.kill(cluster.scheduler, fate)
        with pytest.raises(SchedulerError, match="^" + re.escape(f"{cluster.address}: the scheduler is gone") + "$"):
            list(outcomes)
    os.kill(cluster.scheduler, signal.SIGCONT)
    assert capfd.readouterr().err == ""


def test_a_machine_without_the_extra_is_told_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("campaigns.executors.dask.util.find_spec", lambda name: None)
    with pytest.raises(
        SchedulerError, match=r"needs the package distributed: pip install 'mavlink-companion\[dask\]'$"
    ):
        dask("tcp://127.0.0.1:8786")


def test_a_scheduler_that_has_no_companion_is_told(tmp_path: Path) -> None:
    hidden = tmp_path / "campaigns" / "__init__.py"  # before one that may be installed
    hidden.parent.mkdir()
    hidden.write_text("raise ModuleNotFoundError\n")
    with scheduler(search=(tmp_path,)) as (_, address), pytest.raises(SchedulerError) as refused:
        dask(address)
    assert str(refused.value).startswith(f"{address}: the scheduler has not the same companion: ModuleNotFoundError")


def test_nobody_there_is_told_at_once() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    with pytest.raises(SchedulerError, match=rf"^tcp://127.0.0.1:{port}: no scheduler there: Connection refused$"):
        dask(f"tcp://127.0.0.1:{port}")


@pytest.mark.parametrize("says", [b"HTTP/1.1 400 Bad Request\r\n\r\n" * 9, b""])
def test_what_is_no_scheduler_is_told(says: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("campaigns.executors.dask.ANSWER_S", 0.5)
    with socket.create_server(("127.0.0.1", 0)) as server, ThreadPoolExecutor(1) as pool:

        def answer() -> None:
            server.accept()[0].close()
            with server.accept()[0] as peer:
                peer.sendall(says)
                peer.settimeout(5.0)
                with suppress(OSError):
                    peer.recv(1)
                    peer.recv(100_000)

        pool.submit(answer)
        with pytest.raises(SchedulerError, match="no Dask scheduler answers there"):
            dask(f"tcp://127.0.0.1:{server.getsockname()[1]}")


@pytest.mark.parametrize(
    "address", ["127.0.0.1:8786", "tcp://127.0.0.1", "tcp://:8786", "tcp://a:99999", "http://a:1", ""]
)
def test_an_address_that_is_none_is_told(address: str) -> None:
    with pytest.raises(AddressError, match="expected tcp://HOST:PORT"):
        dask(address)


def test_the_first_difference_is_named() -> None:
    ours = {"python": "3.11", "numpy": "2.4.6"}
    assert difference(ours, {**ours, "scipy": "1.0"}) == ""
    assert difference(ours, {"python": "3.11", "numpy": "2.3"}) == "numpy: found 2.3, expected 2.4.6"
    assert difference(ours, {"python": "3.11"}) == "numpy: found missing, expected 2.4.6"


def test_a_processor_is_told_by_its_name_and_by_the_vector_units_it_lets_be_used(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("llvmlite.binding.get_host_cpu_name", lambda: "cascadelake")
    monkeypatch.setattr("llvmlite.binding.get_host_cpu_features", lambda: {"avx2": True, "fma": True, "avx512f": False})
    told = versions.__wrapped__()
    assert told["cpu"] == "cascadelake fma avx2"
    whole = {**told, "cpu": "cascadelake fma avx2 avx512f"}
    assert difference(whole, told) == "cpu: found cascadelake fma avx2, expected cascadelake fma avx2 avx512f"
