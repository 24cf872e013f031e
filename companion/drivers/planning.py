"""Plans and replans: made in line for lockstep, in worker processes beside the flight loop over UDP."""

from dataclasses import replace
from typing import Protocol

from companion.drivers.desk import ReplanDesk
from companion.drivers.worker import Worker
from companion.seam import PlanReady, PlanWanted, ReplanReady, ReplanWanted
from companion.wording import in_mission_words
from planner import Plan, PlannerError, World, plan


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


class WorkerPlanning:
    """Plans in worker processes, so that setpoints never wait for a plan.

    Parameters
    ----------
    world : handed to each worker once. Workers compile their kernels first (`warmed`).
    replans : what is flown will be planned again and again: that has a worker of its own, and does not wait for plans
        from scratch, which the other makes.
    hung_s : how long an answer may take before its worker is started again [s]; None: as `worker` has it.
    """

    def __init__(self, world: World, replans: bool = False, hung_s: float | None = None) -> None:
        self._plans = Worker(world, answer, replans, hung_s)
        self._again = Worker(world, answer, replans, hung_s, after=self._plans) if replans else self._plans
        self.workers = [self._plans, self._again] if replans else [self._plans]

    def warmed(self) -> bool:
        """Whether the workers' kernels are compiled.

        Raises
        ------
        RuntimeError : whatever kept them from it.
        """
        for worker in self.workers:
            if worker.fault and not worker.warm:
                raise RuntimeError(worker.fault)
        return all(worker.warm for worker in self.workers)

    def submit(self, wanted: PlanWanted | ReplanWanted) -> None:
        (self._again if isinstance(wanted, ReplanWanted) and not wanted.cold else self._plans).submit(wanted)

    def ready(self) -> list[PlanReady | ReplanReady]:
        return [ready for worker in self.workers for ready in worker.ready()]

    def close(self) -> None:
        """End the workers at once; whatever they still plan is dropped."""
        for worker in self.workers:
            worker.close()
