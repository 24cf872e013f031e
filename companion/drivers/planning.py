"""Answering `PlanWanted`: in line for lockstep, in a worker process beside the flight loop over UDP."""

import os
import signal
from concurrent.futures import Future, ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from typing import Protocol

from companion.seam import PlanReady, PlanWanted
from planner import Plan, PlannerError, World, plan, warm_up


class Planning(Protocol):
    """A place where plans are made."""

    def submit(self, wanted: PlanWanted) -> None: ...

    def ready(self) -> list[PlanReady]:
        """The answers since the last call; never waits."""
        ...

    def close(self) -> None: ...


def make_plan(world: World, wanted: PlanWanted) -> Plan:
    """Call the planner with what is wanted; raises as `planner.plan`."""
    return plan(
        world,
        start=wanted.start_m,
        goal=wanted.goal_m,
        limits=wanted.limits,
        radius=wanted.radius,
        seed=wanted.seed,
        method=wanted.method,
    )


def answer(world: World, wanted: PlanWanted) -> PlanReady:
    """Make one plan; a planner's refusal is an answer too."""
    try:
        made = make_plan(world, wanted)
    except PlannerError as error:
        return PlanReady(wanted.request_id, None, error=type(error).__name__, text=str(error), method=wanted.method)
    return PlanReady(
        request_id=wanted.request_id,
        trajectory=made.trajectory,
        length=made.length,
        clearance=made.clearance,
        certified=made.certified,
        cpu_ms=made.cpu_ms,
        method=made.method,
    )


class InlinePlanning:
    """Plans at once in the caller's thread; the answer is an input of the next tick."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._ready: list[PlanReady] = []

    def submit(self, wanted: PlanWanted) -> None:
        # What planning cost differs from run to run; a lockstep flight is the same to the byte, so it is not told.
        self._ready.append(replace(answer(self._world, wanted), cpu_ms=float("nan")))

    def ready(self) -> list[PlanReady]:
        ready, self._ready = self._ready, []
        return ready

    def close(self) -> None:
        """Nothing to give back."""


_world: World | None = None  # the worker process's own copy


def _enter_worker(world: World) -> None:
    global _world
    _world = world
    os.nice(5)  # the flight loop comes first where cores are few
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the flight loop, which ends this process itself


def _answer_in_worker(wanted: PlanWanted) -> PlanReady:
    assert _world is not None
    return answer(_world, wanted)


class WorkerPlanning:
    """Plans in one worker process, so that setpoints never wait for a plan.

    Parameters
    ----------
    world : handed to the worker once. The worker compiles its kernels first (`warmed`).
    """

    def __init__(self, world: World) -> None:
        self._pool = ProcessPoolExecutor(1, get_context("spawn"), initializer=_enter_worker, initargs=(world,))
        self._pending: list[tuple[PlanWanted, Future[PlanReady]]] = []
        self.warmed: Future[None] = self._pool.submit(warm_up)  # done when its kernels are compiled

    def submit(self, wanted: PlanWanted) -> None:
        self._pending.append((wanted, self._pool.submit(_answer_in_worker, wanted)))

    def ready(self) -> list[PlanReady]:
        done = [(wanted, future) for wanted, future in self._pending if future.done()]
        self._pending = [pair for pair in self._pending if not pair[1].done()]
        return [_result(wanted, future) for wanted, future in done]

    def close(self) -> None:
        """End the worker; whatever it still plans is dropped."""
        self._pool.shutdown(wait=False, cancel_futures=True)


def _result(wanted: PlanWanted, future: "Future[PlanReady]") -> PlanReady:
    error = future.exception()
    if error is None:
        return future.result()
    return PlanReady(wanted.request_id, None, error=type(error).__name__, text=str(error), method=wanted.method)
