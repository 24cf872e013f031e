"""Work in processes of this machine.

Each worker has a pipe of its own, and nothing is shared between workers, no lock and no queue: one that is killed, at
whatever moment, costs the item it had and nothing else. Workers are started when there is something for them to do,
each once, since a process pays for its imports and kernels; they end when this process does, however it does.
"""

import math
import os
import signal
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection, wait
from threading import Thread
from typing import Any

from campaigns.executors.base import Answer, Executor, Outcome, R, T, answer, told

STARTING_S = 300.0
"""A worker's imports may take so long [s]: on a machine with much else to do, from a cold disk."""
SPARE = 3
"""How often an item may come to a worker that is dead before it begins: that says nothing about the item."""
BEGUN = "begun"
_END: Any = object()


def local(jobs: int) -> Executor:
    """Processes of this machine; with one job and no time-out the work is done in this process.

    Raises
    ------
    ValueError : fewer than one job.
    """
    return Processes(jobs)


class _Worker:
    """One process, and what it has to do.

    Attributes
    ----------
    item : what it was given; `_END`: nothing.
    attempts, given : how often that was begun, and given to a worker, this one included.
    begun : whether it works on it.
    pipe : ours of the two ends.
    """

    def __init__(self) -> None:
        spawn = get_context("spawn")
        self.pipe, theirs = spawn.Pipe()
        self._process = spawn.Process(target=_serve, args=(theirs,), daemon=True)
        self._process.start()
        theirs.close()
        self.item, self.attempts, self.given = _END, 0, 0
        self.begun = False
        self._timeout_s: float | None = None
        self._until = 0.0

    @property
    def free(self) -> bool:
        return self.item is _END

    @property
    def alive(self) -> bool:
        return self._process.is_alive()

    def give(self, work: Callable[[T], R], item: T, attempts: int, given: int, timeout_s: float | None) -> None:
        self.item, self.attempts, self.given, self._timeout_s = item, attempts, given, timeout_s
        self.begun, self._until = False, time.monotonic() + STARTING_S
        try:
            self.pipe.send((work, item))
        except OSError:  # it is dead: its pipe's end says so at once
            self._process.kill()

    @property
    def left_s(self) -> float:
        """Until it has taken too long [s]."""
        return self._until - time.monotonic()

    def hear(self) -> Answer[Any] | None:
        """What it says; None: only that it began.

        Raises
        ------
        EOFError : it is dead.
        """
        try:
            said = self.pipe.recv()
        except (OSError, EOFError) as error:
            raise EOFError from error
        except Exception as error:  # a result that cannot be unpickled here
            return Answer(error=told(error))
        if said == BEGUN:
            self.begun, self.attempts = True, self.attempts + 1
            self._until = math.inf if self._timeout_s is None else time.monotonic() + self._timeout_s
            return None
        assert isinstance(said, Answer)
        return said

    def end(self) -> str:
        """Kill it; how it ended."""
        self._process.join(0.2)  # for its own exit code, if it was ending anyway
        self._process.kill()
        self._process.join()
        self.pipe.close()
        code = self._process.exitcode or 0
        return f"was killed by signal {-code}" if code < 0 else f"ended with exit code {code}"


class Processes:
    """Workers of one machine; see `Executor`.

    Parameters
    ----------
    jobs : most processes at a time.
    """

    def __init__(self, jobs: int) -> None:
        if jobs < 1:
            raise ValueError(f"jobs: expected at least 1, found {jobs}")
        self._jobs = jobs
        self._workers: list[_Worker] = []

    def map(
        self, work: Callable[[T], R], items: Iterable[T], *, timeout_s: float | None = None, retries: int = 0
    ) -> Iterator[Outcome[T, R]]:
        """As `Executor.map`; one map at a time."""
        if self._jobs == 1 and timeout_s is None:
            for item in items:
                done = answer(work, item)
                yield Outcome(item, done.result, done.error)
            return
        coming, again = iter(items), deque[tuple[T, int, int]]()

        def hand_out() -> None:
            for worker in [worker for worker in self._workers if worker.free and not worker.alive]:
                self._end(worker)
            while len(self._workers) < self._jobs or any(worker.free for worker in self._workers):
                item, begun, given = again.popleft() if again else (next(coming, _END), 0, 0)
                if item is _END:
                    return
                if all(not worker.free for worker in self._workers):
                    self._workers.append(_Worker())
                worker = next(worker for worker in self._workers if worker.free)
                worker.give(work, item, begun, given + 1, timeout_s)

        try:
            hand_out()
            while busy := [worker for worker in self._workers if not worker.free]:
                ended = []
                for worker in self._stirring(busy):
                    outcome, lost = self._look(worker, timeout_s)
                    if outcome is not None and lost and worker.attempts <= retries and worker.given <= retries + SPARE:
                        again.append((outcome.item, worker.attempts, worker.given))
                    elif outcome is not None:
                        ended.append(outcome)
                hand_out()  # before the caller has its turn: workers do not wait for it
                yield from ended
        finally:
            for worker in [worker for worker in self._workers if not worker.free]:
                self._end(worker)

    def close(self) -> None:
        """Kill the workers."""
        for worker in list(self._workers):
            self._end(worker)

    def _stirring(self, busy: list[_Worker]) -> list[_Worker]:
        """Wait for those that say something, died or have taken too long."""
        patience = max(0.0, min(worker.left_s for worker in busy))
        said = wait([worker.pipe for worker in busy], None if math.isinf(patience) else patience)
        return [worker for worker in busy if worker.pipe in said or worker.left_s <= 0.0]

    def _look(self, worker: _Worker, timeout_s: float | None) -> tuple[Outcome[Any, Any] | None, bool]:
        """What came of a worker's item, None while it goes on; and whether its worker was lost over it."""
        item = worker.item
        try:
            done = worker.hear() if worker.pipe.poll() else None
        except (OSError, EOFError):
            what = f"its process {self._end(worker)}"
            return Outcome(item, infrastructure=what, attempts=worker.attempts), True
        if done is not None:
            worker.item = _END
            return Outcome(item, done.result, done.error, attempts=worker.attempts), False
        if worker.left_s > 0.0:
            return None, False
        self._end(worker)
        what = f"took longer than {timeout_s:g} s" if worker.begun else f"did not begin in {STARTING_S:g} s"
        return Outcome(item, infrastructure=what, attempts=worker.attempts), not worker.begun

    def _end(self, worker: _Worker) -> str:
        self._workers.remove(worker)
        return worker.end()


def _serve(pipe: Connection) -> None:
    """A worker's life: until its pipe ends, or the process that started it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the one who started us
    Thread(target=_end_with_parent, daemon=True).start()
    while True:
        try:
            work, item = pipe.recv()
        except EOFError:
            return
        except Exception as error:  # what cannot be unpickled here
            pipe.send(Answer(error=told(error)))
            continue
        pipe.send(BEGUN)
        done = answer(work, item)
        try:
            pipe.send(done)
        except OSError:
            return
        except Exception as error:  # a result that cannot be pickled
            pipe.send(Answer(error=told(error)))


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
