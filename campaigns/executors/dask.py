"""Work on other machines, by a Dask scheduler and its workers.

Dask may begin an item twice, when a worker is lost while it works or before its result was fetched. Work depends on its
item only, so that both are the same, and one future gives one outcome. Only the result crosses the network, to whoever
asked: nobody needs a common disk.

A worker must be what we are: its versions and the digest of its sources are compared with ours before anything is
given out, and again with every item, since workers come and go. With a time-out an item is worked on in a process that
the worker starts, as `local` does it: a thread cannot be ended. What happens to that process is tried again on the
spot; what happens to the worker, by Dask itself as often as its scheduler allows, and then by us.
"""

import asyncio
import logging
import math
import socket
import time
import warnings
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from importlib import util
from itertools import islice
from multiprocessing import current_process
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from campaigns.errors import AddressError, SchedulerError
from campaigns.executors.base import Executor, Outcome, R, T, answer, told
from campaigns.executors.local import local
from campaigns.executors.versions import OURS, difference, versions

if TYPE_CHECKING:
    from distributed import Client, Future

ANSWER_S = 4.0
"""For the scheduler to answer [s]."""
WORKERS_S = 20.0
"""For a first worker to come, and for one to come back when all are gone [s]."""
QUIET_S = 5.0
"""Without a result for so long, the scheduler is asked whether it is there [s]."""
LOOK_S = 2.0
"""How old our knowledge of the workers may be [s]."""
AHEAD = 3
"""Items given out for each thread of a worker: none waits for us, and few are lost with it."""
LOST = "the scheduler is gone"


def dask(address: str) -> Executor:
    """Workers of a Dask scheduler.

    Parameters
    ----------
    address : tcp://HOST:PORT.

    Raises
    ------
    AddressError : the address is none.
    SchedulerError : nobody is there, `distributed` is not installed, or a worker is not what we are.
    """
    host, port = _parts(address)
    if util.find_spec("distributed") is None:
        raise SchedulerError(address, "needs the package distributed: pip install 'mavlink-companion[dask]'")
    try:
        socket.create_connection((host, port), ANSWER_S).close()
    except OSError as error:
        raise SchedulerError(address, f"no scheduler there: {error.strerror or error}") from error
    return Cluster(address)


class Cluster:
    """A scheduler's workers; see `dask`."""

    def __init__(self, address: str) -> None:
        self._address = address
        self._client = _connected(address)
        self._looked, self._threads_then = -math.inf, 0
        try:
            self._refuse_a_strange_scheduler()
            self._client.wait_for_workers(1, timeout=WORKERS_S)
            self._refuse_strange_workers()
        except TimeoutError as error:
            self.close()
            raise SchedulerError(address, f"no worker within {WORKERS_S:g} s") from error
        except BaseException:
            self.close()
            raise

    def map(
        self, work: Callable[[T], R], items: Iterable[T], *, timeout_s: float | None = None, retries: int = 0
    ) -> Iterator[Outcome[T, R]]:
        """As `Executor.map`.

        Raises
        ------
        SchedulerError : the scheduler or its last worker is gone, or a worker came that is not what we are.
        """
        coming = iter(items)
        given: dict[Any, tuple[Future[Any], T, int]] = {}
        ended: SimpleQueue[Future[Any]] = SimpleQueue()

        def give(item: T, before: int) -> None:
            future = self._client.submit(perform, work, item, timeout_s, retries, versions(), pure=False)
            given[future.key] = (future, item, before)
            future.add_done_callback(ended.put)

        try:
            while True:
                for item in islice(coming, max(0, self._threads() * AHEAD - len(given))):
                    give(item, 0)
                if not given:
                    return
                future = self._next(ended)
                _, item, before = given.pop(future.key)
                outcome, lost = self._outcome(future, item, before)
                if lost and outcome.attempts <= retries:
                    give(item, outcome.attempts)
                else:
                    yield outcome
        finally:
            with suppress(Exception):  # where the scheduler is gone there is nothing to cancel
                self._client.cancel([future for future, _, _ in given.values()], force=True)

    def close(self) -> None:
        """Leave the scheduler; what it still works on is dropped."""
        with suppress(Exception):
            self._client.close(timeout=2.0)

    def _threads(self) -> int:
        """Of all workers together, as they were a moment ago."""
        if time.monotonic() > self._looked + LOOK_S:
            self._look()
        return max(1, self._threads_then)

    def _look(self) -> int:
        """How many workers there are."""
        try:
            ask = self._client.scheduler.identity
            there = self._client.sync(ask, n_workers=0, callback_timeout=ANSWER_S)
        except Exception as error:
            raise SchedulerError(self._address, LOST) from error
        self._looked, self._threads_then = time.monotonic(), int(there["total_threads"])
        return int(there["n_workers"])

    def _next(self, ended: "SimpleQueue[Future[Any]]") -> "Future[Any]":
        """The next that ended."""
        return self._waited(lambda: ended.get(timeout=QUIET_S), Empty)

    def _waited(self, get: Callable[[], R], nothing: type[Exception]) -> R:
        """What it gets. While that is `nothing`, make sure that there is somebody to wait for."""
        alone_since: float | None = None
        while True:
            try:
                return get()
            except nothing:
                if self._look():
                    alone_since = None
                elif alone_since is None:
                    alone_since = time.monotonic()
                elif time.monotonic() > alone_since + WORKERS_S:
                    raise SchedulerError(self._address, f"no worker for {WORKERS_S:g} s") from None

    def _outcome(self, future: "Future[Any]", item: T, before: int) -> tuple[Outcome[T, Any], bool]:
        """What came of an item that was begun so often before, and whether it was the loss of its workers."""
        try:
            done = self._fetched(future)
        except SchedulerError:
            raise
        except CancelledError as error:
            raise SchedulerError(self._address, LOST) from error
        except (StrangeWorker, ImportError) as error:
            raise SchedulerError(self._address, f"a worker came that is not the same as here: {error}") from error
        except Exception as error:
            if type(error).__name__ == "KilledWorker":
                return Outcome(item, infrastructure="every worker that had it died", attempts=before + 1), True
            if future.status != "error":
                self._look()  # it is there: only the result cannot be read here
            return Outcome(item, error=told(error), attempts=before + 1), False  # what cannot be sent back
        return Outcome(item, done.result, done.error, done.infrastructure, before + done.attempts), False

    def _fetched(self, future: "Future[Any]") -> Outcome[None, Any]:
        """The result, which may have to be worked out again first where its worker was lost with it."""
        return self._waited(lambda: future.result(timeout=QUIET_S), TimeoutError)

    def _refuse_a_strange_scheduler(self) -> None:
        """It reads what it hands on: our modules have to be there, and of one version."""
        try:
            there = self._client.run_on_scheduler(versions)
        except Exception as error:
            there = error
        self._compare("the scheduler", {name: versions()[name] for name in OURS}, there)

    def _refuse_strange_workers(self) -> None:
        """What they compute has to be the same."""
        for at, there in self._client.run(versions, on_error="return").items():
            self._compare(f"worker {at}", versions(), there)

    def _compare(self, who: str, ours: dict[str, str], there: dict[str, str] | Exception) -> None:
        if isinstance(there, Exception):
            raise SchedulerError(self._address, f"{who} has not the same companion: {told(there)}")
        if differs := difference(ours, there):
            raise SchedulerError(self._address, f"{who} is not the same as here: {differs}")


class StrangeWorker(Exception):
    """A worker that is not what the one is who asks; its text says what differs."""


def perform(
    work: Callable[[T], R], item: T, timeout_s: float | None, retries: int, asked_by: dict[str, str]
) -> Outcome[None, R]:
    """Runs on a worker: do the work, in a process of its own if it may have to be ended.

    Raises
    ------
    StrangeWorker : this is not what the one is who asks.
    """
    if differs := difference(asked_by, versions()):
        raise StrangeWorker(differs)
    if timeout_s is None:
        done = answer(work, item)
        return Outcome(None, done.result, done.error)
    with _process() as process:
        (outcome,) = process.map(work, [item], timeout_s=timeout_s, retries=retries)
    return Outcome(None, outcome.result, outcome.error, outcome.infrastructure, outcome.attempts)


_idle: list[Executor] = []
"""Processes of this worker that have nothing to do; they end with it."""


@contextmanager
def _process() -> Iterator[Executor]:
    """A process to work in, for a thread of the worker; it is kept, since it pays once for its imports and kernels."""
    # A worker under a nanny is daemonic, and may have no children since nobody would end them. Ours end by themselves
    # when their parent does.
    current_process()._config["daemon"] = False  # type: ignore[attr-defined]
    try:
        process = _idle.pop()
    except IndexError:
        process = local(1)
    try:
        yield process
    finally:
        _idle.append(process)


def _parts(address: str) -> tuple[str, int]:
    """Host and port."""
    with suppress(ValueError):  # a port beyond what ports can be
        parts = urlsplit(address)
        if parts.scheme == "tcp" and parts.hostname and parts.port and not parts.path:
            return parts.hostname, parts.port
    raise AddressError(address, "expected tcp://HOST:PORT")


def _connected(address: str) -> "Client":
    """A client of what has proved to be a scheduler: a `Client` of anything else ends in a mess."""
    from distributed import Client

    for name in list(logging.root.manager.loggerDict):
        if name.partition(".")[0] in ("distributed", "tornado"):
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)  # what goes wrong is told once, by us
    try:
        there = asyncio.run(_identity(address))
    except Exception as error:
        raise SchedulerError(address, "no Dask scheduler answers there") from error
    if there.get("type") != "Scheduler":
        raise SchedulerError(address, f"found a Dask {str(there.get('type')).lower()}, expected a scheduler")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of versions, which are compared below
        try:
            return Client(address, timeout=ANSWER_S, set_as_default=False, name="companion")
        except Exception as error:
            raise SchedulerError(address, told(error)) from error


async def _identity(address: str) -> dict[str, Any]:
    """What a Dask server says of itself."""
    from distributed.core import rpc

    there = rpc(address, timeout=ANSWER_S)
    try:
        return dict(await asyncio.wait_for(there.identity(), ANSWER_S))
    finally:
        await there.close_rpc()
