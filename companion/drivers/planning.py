"""Plans and replans: made in line for lockstep, in worker processes beside the flight loop over UDP."""

import os
import signal
import time
from dataclasses import replace
from multiprocessing import get_context
from multiprocessing.pool import AsyncResult
from typing import Protocol

from companion.drivers.replanning import ReplanDesk
from companion.seam import PlanReady, PlanWanted, ReplanReady, ReplanWanted
from companion.wording import in_mission_words
from planner import Plan, PlannerError, World, plan, replan, warm_up


class Planning(Protocol):
    """A place where plans are made."""

    def submit(self, wanted: PlanWanted | ReplanWanted) -> None: ...

    def ready(self) -> list[PlanReady | ReplanReady]:
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
        self._desk, self._cold = ReplanDesk(world), ReplanDesk(world)
        self._ready: list[PlanReady | ReplanReady] = []

    def submit(self, wanted: PlanWanted | ReplanWanted) -> None:
        if isinstance(wanted, ReplanWanted):
            self._ready.append((self._cold if wanted.cold else self._desk).answer(wanted))
            return
        # What planning cost differs from run to run; a lockstep flight is the same to the byte, so it is not told.
        self._ready.append(replace(answer(self._world, wanted), cpu_ms=float("nan")))

    def ready(self) -> list[PlanReady | ReplanReady]:
        ready, self._ready = self._ready, []
        return ready

    def close(self) -> None:
        """Nothing to give back."""


_world: World | None = None  # the worker process's own copy
_desk: ReplanDesk | None = None


def _enter_worker(world: World) -> None:
    global _world, _desk
    _world, _desk = world, ReplanDesk(world)
    os.nice(5)  # the flight loop comes first where cores are few
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the flight loop, which ends this process itself


def _warm_worker(replans: bool) -> None:
    warm_up()
    if replans:
        replan.warm_up()


def _answer_in_worker(wanted: PlanWanted) -> PlanReady:
    assert _world is not None
    try:
        return answer(_world, wanted)
    except Exception as error:  # a fault of ours must end in a refusal on the ground, not in the flight loop
        return PlanReady(wanted.request_id, None, error=type(error).__name__, text=str(error), method=wanted.method)


def _replan_in_worker(wanted: ReplanWanted) -> ReplanReady:
    assert _desk is not None
    started = time.thread_time()
    try:
        ready = _desk.answer(wanted)
    except Exception as error:  # a fault of ours must end in a stop, not in the flight loop
        reason = f"{type(error).__name__}: {error}"
        ready = ReplanReady(wanted.request_id, "failed", None, False, float("nan"), None, reason)
    return replace(ready, cpu_ms=1e3 * (time.thread_time() - started))


class WorkerPlanning:
    """Plans in worker processes, so that setpoints never wait for a plan.

    Parameters
    ----------
    world : handed to each worker once. Workers compile their kernels first (`warmed`).
    replans : what is flown will be planned again and again: that has a worker of its own, and does not wait for plans
        from scratch, which the other makes.
    """

    def __init__(self, world: World, replans: bool = False) -> None:
        spawn = get_context("spawn")
        self._pool = spawn.Pool(1, initializer=_enter_worker, initargs=(world,))
        self._again = spawn.Pool(1, initializer=_enter_worker, initargs=(world,)) if replans else self._pool
        self._pools = [self._pool, self._again] if replans else [self._pool]
        self._warming = [pool.apply_async(_warm_worker, (replans,)) for pool in self._pools]
        self._pending: list[AsyncResult[PlanReady] | AsyncResult[ReplanReady]] = []

    def warmed(self) -> bool:
        """Whether the workers' kernels are compiled.

        Raises
        ------
        Exception : whatever kept them from it.
        """
        if not all(warming.ready() for warming in self._warming):
            return False
        for warming in self._warming:
            warming.get()
        return True

    def submit(self, wanted: PlanWanted | ReplanWanted) -> None:
        if isinstance(wanted, ReplanWanted):
            pool = self._pool if wanted.cold else self._again
            self._pending.append(pool.apply_async(_replan_in_worker, (wanted,)))
        else:
            self._pending.append(self._pool.apply_async(_answer_in_worker, (wanted,)))

    def ready(self) -> list[PlanReady | ReplanReady]:
        done = [result for result in self._pending if result.ready()]
        self._pending = [result for result in self._pending if result not in done]
        return [result.get() for result in done]

    def close(self) -> None:
        """End the workers at once; whatever they still plan is dropped."""
        for pool in self._pools:
            pool.terminate()
            pool.join()
