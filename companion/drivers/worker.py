"""A process that plans, and what becomes of its questions when it dies or hangs.

One question is under way at a time. Of those that wait, plans are made in their turn; of questions about what is flown
only the newest waits, since the ones before are about a moment that has passed. A process that ends, or does not answer
in time, is ended and started again, `RESTARTS` times at most; the question it had is answered with the reason, and in
the end so is every other. A thread of its own waits for all that: the flight loop never does.
"""

import os
import signal
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

from companion.drivers.desk import ReplanDesk
from companion.seam import PlanReady, PlanWanted, ReplanReady, ReplanWanted
from planner import World, replan, warm_up

Question = PlanWanted | ReplanWanted
Answer = PlanReady | ReplanReady

RESTARTS = 5
PLAN_S, REPLAN_S = 60.0, 5.0
"""A process that has not answered for so long hangs [s]."""
WARM_S = 600.0
"""Compiling may take so long [s]."""
AFTER_S = 0.05
"""How often a worker looks whether the one before it has compiled the kernels [s]."""
LOOK_S = 0.5
"""How often an idle process is looked after [s]."""


class Worker:
    """Parameters
    ----------
    world : handed to each process once.
    answer : makes a plan; a function of a module.
    replans : whether the kernels for planning in flight are compiled too.
    hung_s : how long an answer may take [s], whatever the question; None: `PLAN_S`, `REPLAN_S`.
    after : one that compiles the same kernels: they are compiled once, and this one begins when they are.

    Attributes
    ----------
    warm : its kernels are compiled, or were before it was started again.
    fault : why it will never be, or is not started again; empty otherwise.
    starts : how often it was started.
    dropped : questions that newer ones have taken the place of.
    """

    def __init__(
        self,
        world: World,
        answer: Callable[[World, PlanWanted], PlanReady],
        replans: bool = False,
        hung_s: float | None = None,
        after: "Worker | None" = None,
    ) -> None:
        self.warm, self.fault, self.starts, self.dropped = False, "", 0, 0
        self._args = (world, answer, replans)
        self._hung_s, self._after = hung_s, after
        self._waiting: list[Question] = []
        self._answers: deque[Answer] = deque()
        self._change = threading.Condition()
        self._closed = False
        self._process: BaseProcess | None = None
        self._thread = threading.Thread(target=self._run, name="planning", daemon=True)
        self._thread.start()

    @property
    def pid(self) -> int | None:
        """Of the process that is there now."""
        return None if self._process is None else self._process.pid

    def submit(self, wanted: Question) -> None:
        """Ask; never waits."""
        with self._change:
            if isinstance(wanted, ReplanWanted):
                stale = [q for q in self._waiting if isinstance(q, ReplanWanted) and q.cold == wanted.cold]
                self._waiting = [q for q in self._waiting if q not in stale]
                self.dropped += len(stale)
            self._waiting.append(wanted)
            self._change.notify()

    def ready(self) -> list[Answer]:
        """The answers since the last call; never waits."""
        answers = []
        while self._answers:
            answers.append(self._answers.popleft())
        return answers

    def close(self) -> None:
        """End the process at once; whatever it still plans is dropped."""
        with self._change:
            self._closed = True
            if self._process is not None:
                self._process.kill()
            self._change.notify()
        self._thread.join()

    # ---- in the thread ------------------------------------------------------------------------------------------

    def _run(self) -> None:
        spawn = get_context("spawn")
        why = ""
        with self._change:
            while self._after is not None and not (self._closed or self._after.warm or self._after.fault):
                self._change.wait(AFTER_S)
        while not self._closed and not self.fault and self.starts <= RESTARTS:
            ours, theirs = spawn.Pipe()
            process = spawn.Process(target=_work, args=(theirs, *self._args), daemon=True)
            process.start()
            theirs.close()
            with self._change:
                self._process = process
                self.starts += 1
                if self._closed:
                    process.kill()
            why = self._serve(process, ours)
            process.kill()
            process.join()
            ours.close()
        self.fault = self.fault or f"the planning process {why}, after {self.starts} starts"
        while (question := self._next(None)) is not None:
            self._answers.append(refusal(question, self.fault))

    def _serve(self, process: BaseProcess, pipe: Connection) -> str:
        """Answer questions until the process is no good any more: why."""
        question: Question | None = None
        try:
            if not pipe.poll(WARM_S):
                return f"was not ready in {WARM_S:g} s"
            self.fault = pipe.recv()
            self.warm = self.warm or not self.fault
            while not self.fault and (question := self._next(process)) is not None:
                pipe.send(question)
                hung_s = self._hung_s or (PLAN_S if isinstance(question, PlanWanted) or question.cold else REPLAN_S)
                if not pipe.poll(hung_s):
                    why = f"gave no answer in {hung_s:g} s"
                    break
                self._answers.append(pipe.recv())
                question = None
            else:
                return "was closed"
        except (EOFError, OSError):
            process.join(1.0)
            why = f"ended with exit code {process.exitcode}"
        if question is not None and not self._closed:
            self._answers.append(refusal(question, f"the planning process {why}"))
        return why

    def _next(self, process: BaseProcess | None) -> Question | None:
        """The next question, when there is one; None when this is closed.

        Raises
        ------
        EOFError : the process has ended meanwhile.
        """
        with self._change:
            while not self._closed:
                if self._waiting:
                    return self._waiting.pop(0)
                self._change.wait(LOOK_S)
                if process is not None and not process.is_alive():
                    raise EOFError
        return None


def refusal(wanted: Question, why: str) -> Answer:
    """The answer to a question that nobody could look at."""
    if isinstance(wanted, ReplanWanted):
        return ReplanReady(wanted.request_id, "failed", None, False, float("nan"), None, why)
    return PlanReady(wanted.request_id, None, error="PlanningFailed", text=why, method=wanted.method)


def _work(
    pipe: Connection, world: World, answer: Callable[[World, PlanWanted], PlanReady], replans: bool
) -> None:  # pragma: no cover  in its own process
    os.nice(10)  # the flight loop comes first where cores are few
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the flight loop, which ends this process itself
    desk = ReplanDesk(world)
    try:
        warm_up()
        if replans:
            replan.warm_up()
    except Exception as error:
        pipe.send(f"{type(error).__name__}: {error}")
        return
    pipe.send("")
    while True:
        try:
            wanted = pipe.recv()
        except (EOFError, OSError):
            return  # whoever asked is gone
        started = time.thread_time()
        try:
            ready: Answer = desk.answer(wanted) if isinstance(wanted, ReplanWanted) else answer(world, wanted)
        except Exception as error:  # a fault of ours must end in a refusal or a stop, not in the flight loop
            ready = refusal(wanted, f"{type(error).__name__}: {error}")
        if isinstance(ready, ReplanReady):
            ready = replace(ready, cpu_ms=1e3 * (time.thread_time() - started))
        pipe.send(ready)
