"""A tuning, whole: search on the training seeds, then judge what was found, and the base, on unseen ones, too."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from campaigns.executors import Executor
from campaigns.tuning.cost import FlightFigures, Parts, evaluate, judge, score
from campaigns.tuning.journal import Journal, key
from campaigns.tuning.optimisers import search
from campaigns.tuning.spec import Spec
from companion.errors import CompanionError
from fakevehicle.vocabulary import FloatArray

RETRIES = 2
"""Of an evaluation whose worker was lost."""
FLIGHT_S = 60.0
"""Time that one flight may take at most [s]; it takes 0.2."""
Progress = Callable[[int, float], None]
"""Told the number of evaluations done and the lowest cost so far."""


@dataclass(frozen=True, slots=True)
class Found:
    """What a search has found.

    Attributes
    ----------
    values : parameters of the cheapest candidate, or of the base when none was cheaper (then empty).
    cost, parts : its cost and parts.
    base_cost, base : the base's.
    history : (n,) cost of every evaluation, in the search's order.
    """

    method: str
    values: dict[str, float]
    cost: float
    parts: Parts
    base_cost: float
    base: Parts
    history: FloatArray = field(repr=False)


@dataclass(frozen=True, slots=True)
class Judged:
    """One set of gains on a set of seeds: flights in the order of seeds, then courses and winds."""

    unseen: bool
    flights: list[FlightFigures]


class Evaluator:
    """Costs of candidates: read from the journal, else flown.

    Parameters
    ----------
    executor : flies.
    journal : remembers across runs; None: nothing does.
    progress : told after every evaluation.
    """

    def __init__(self, spec: Spec, executor: Executor, journal: Journal | None, progress: Progress | None) -> None:
        self._spec, self._executor, self._journal, self._progress = spec, executor, journal, progress
        self._weights, self._bounds = spec.weighed(), spec.bounds.model_dump()
        self._seen: dict[str, Parts] = {}
        self.history: list[float] = []
        self.best: dict[str, float] = {}
        self.cost = math.inf
        self.unit = self._fly([{}], spec.at_unit())[0]
        if self.unit.lost:
            raise CompanionError(f"{spec.name}: {spec.unit or spec.base} does not fly the courses: {self.unit.lost}")
        self.base = self._fly([{}], spec)[0]
        self.parts, self.cost = self.base, score(self.base, self.unit, self._weights, self._bounds)

    def __call__(self, rows: FloatArray) -> FloatArray:
        """Costs (m,) of candidates (m, n_dim) in the unit cube."""
        candidates = [self._spec.values(row) for row in rows]
        for values, parts in zip(candidates, self._fly(candidates, self._spec), strict=True):
            cost = score(parts, self.unit, self._weights, self._bounds)
            self.history.append(cost)
            if cost < self.cost:
                self.best, self.parts, self.cost = values, parts, cost
        self._tell(0)
        return np.array(self.history[-len(candidates) :])

    def _fly(self, candidates: list[dict[str, float]], spec: Spec) -> list[Parts]:
        """Parts of each; none is flown twice."""
        digest = spec.digest()
        keys = [key(digest, values) for values in candidates]
        todo: dict[str, dict[str, float]] = {}
        for name, values in zip(keys, candidates, strict=True):
            known = self._seen.get(name) or (self._journal.get(name) if self._journal is not None else None)
            if known is not None:
                self._seen[name] = known
            else:
                todo[name] = values
        tasks = [(spec, values) for values in todo.values()]
        limit = FLIGHT_S * len(spec.flown()) * spec.train
        trouble = ""
        for done, outcome in enumerate(self._executor.map(evaluate, tasks, timeout_s=limit, retries=RETRIES), start=1):
            if outcome.result is None:
                trouble = outcome.error or outcome.infrastructure
                continue
            values = outcome.item[1]
            name = key(digest, values)
            self._seen[name] = outcome.result
            if self._journal is not None:
                self._journal.put(name, values, outcome.result)
            self._tell(done)
        if trouble:
            raise CompanionError(f"{spec.name}: an evaluation was not flown: {trouble}; --resume goes on from here")
        return [self._seen[name] for name in keys]

    def _tell(self, more: int) -> None:
        if self._progress is not None:
            self._progress(len(self.history) + more, self.cost)


def find(
    spec: Spec, method: str, executor: Executor, *, journal: Journal | None = None, progress: Progress | None = None
) -> Found:
    """Search: the same specification, method and versions find the same, however many processes fly.

    Raises
    ------
    CompanionError : the base does not fly, an evaluation could not be flown, or the journal not be written.
    """
    cost = Evaluator(spec, executor, journal, progress)
    s = spec.search
    search(method, cost, spec.first(), budget=s.budget, population=s.population, seed=s.seed)
    before = score(cost.base, cost.unit, spec.weighed(), spec.bounds.model_dump())
    return Found(method, cost.best, cost.cost, cost.parts, before, cost.base, np.array(cost.history))


def judged(spec: Spec, values: Mapping[str, float], executor: Executor, *, unseen: bool) -> Judged:
    """Fly a set of gains with every seed.

    Raises
    ------
    CompanionError : a flight could not be flown (one that is lost is a result).
    """
    count = spec.test if unseen else spec.train
    tasks = [(spec, dict(values), unseen, k) for k in range(count)]
    found: dict[int, list[FlightFigures]] = {}
    for outcome in executor.map(judge, tasks, timeout_s=FLIGHT_S * len(spec.flown()), retries=RETRIES):
        if outcome.result is None:
            raise CompanionError(f"{spec.name}: a flight was not flown: {outcome.error or outcome.infrastructure}")
        found[outcome.item[3]] = outcome.result
    return Judged(unseen, [flight for k in range(count) for flight in found[k]])
