"""Answering `PlanWanted`: in line for lockstep, in a worker process beside the flight loop over UDP."""

import os
import signal
from dataclasses import replace
from multiprocessing import get_context
from multiprocessing.pool import AsyncResult
from typing import Protocol

from companion.seam import PlanReady, PlanWanted
from companion.wording import in_mission_words
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
        via=wanted.via_m,
        start_velocity=wanted.start_velocity,
        start_acceleration=wanted.start_acceleration,
    )


def answer(world: World, wanted: PlanWanted) -> PlanReady:
    """Make one plan; a planner's refusal is an answer too."""
    try:
        made = make_plan(world, wanted)
    except PlannerError as error:
        return PlanReady(
            wanted.request_id, None, error=type(error).__name__, text=in_mission_words(error), method=wanted.method
        )
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
    try:
        return answer(_world, wanted)
    except Exception as error:  # a fault of ours must end in a refusal on the ground, not in the flight loop
        return PlanReady(wanted.request_id, None, error=type(error).__name__, text=str(error), method=wanted.method)


class WorkerPlanning:
    """Plans in one worker process, so that setpoints never wait for a plan.

    Parameters
    ----------
    world : handed to the worker once. The worker compiles its kernels first (`warmed`).
    """

    def __init__(self, world: World) -> None:
        self._pool = get_context("spawn").Pool(1, initializer=_enter_worker, initargs=(world,))
        self._warming = self._pool.apply_async(warm_up)
        self._pending: list[AsyncResult[PlanReady]] = []

    def warmed(self) -> bool:
        """Whether the worker's kernels are compiled.

        Raises
        ------
        Exception : whatever kept them from it.
        """
        if not self._warming.ready():
            return False
        self._warming.get()
        return True

    def submit(self, wanted: PlanWanted) -> None:
        self._pending.append(self._pool.apply_async(_answer_in_worker, (wanted,)))

    def ready(self) -> list[PlanReady]:
        done = [result for result in self._pending if result.ready()]
        self._pending = [result for result in self._pending if result not in done]
        return [result.get() for result in done]

    def close(self) -> None:
        """End the worker at once; whatever it still plans is dropped."""
        self._pool.terminate()
        self._pool.join()
