"""HAOAROA's two other modes. The default, shift invariant one is `haoaroa.Haoaroa`; see there for what it decides.

`literal` is the paper's Eq. 43-48 and Algorithm 1 with nothing added but numbers for what is never given:

    early:  x = x + lambda F_buoyancy,  F_buoyancy = -grad J                                Eq. 44, 45; steps 11-13
    late:   x = x + gamma (x_leader - x) - beta grad J                                      Eq. 47, 48; step 17
    then the cost, Eq. 46, is evaluated and the best is kept                                steps 19, 20

    "If" of step 11             early while TF = exp((t - T)/T) <= 1/2, AOA's transfer operator (Hashim 2021, Eq. 8)
    lambda_p grad, beta_p grad  s g, with g = grad divided by its largest component and s a length of each candidate's
                                own that grows by 1.2 when its cost fell and shrinks to 0.7 of itself when it did not
    gamma_p                     uniform in (0, 1), one a candidate and iteration
    Eq. 49                      both of its gradients are gradients of the one J: it is Eq. 45 and 48 once more

Printed so, it explores nothing: every candidate descends from where it began, and is then drawn to the leader. It is
shift invariant as it stands, and without a gradient there is nothing to compute.

`canonical` is what the paper's text says of the two phases: AOA explores while TF <= 1/2 and ROA exploits from what it
kept, each as in `aoa` and `roa` in canonical mode, and so drawn to the origin as they are.
"""

import math

import numpy as np
from numpy.typing import NDArray

from planner.search.aoa import Aoa
from planner.search.asktell import ITERATIONS, POPULATION, AskTell, Best, Mode
from planner.search.roa import Roa

FloatArray = NDArray[np.float64]


def _explores(t: int, last: int) -> bool:
    return math.exp((t - last) / last) <= 0.5


class HaoaroaLiteral(AskTell):
    """Ask/tell HAOAROA as printed. `tell` needs the gradients. Parameters and other errors as `AskTell`."""

    def __init__(
        self,
        lower: FloatArray,
        upper: FloatArray,
        generator: np.random.Generator,
        initial: FloatArray | None = None,
        population: int = POPULATION,
        budget: int = POPULATION * ITERATIONS,
        step: float = 0.1,
    ) -> None:
        super().__init__(lower, upper, generator, initial, population, budget, step)
        self._positions = self.first.copy()
        self._previous = np.full(population, np.inf)
        self._best = Best(self.first[0].copy(), np.inf)
        self.steps /= 1.2  # the first evaluation improves on infinity

    def ask(self) -> FloatArray:
        """The candidates to evaluate (n_pop, n_dim), a copy."""
        return self._positions.copy()

    def _move(self, costs: FloatArray, gradients: FloatArray | None) -> None:
        if gradients is None:
            raise ValueError("gradients: literal HAOAROA has no move without them (Eq. 45)")
        x = self._positions
        top = int(np.argmin(costs))
        if costs[top] < self._best.cost:
            self._best = Best(x[top].copy(), float(costs[top]))
        self.steps *= np.where(costs < self._previous, 1.2, 0.7)
        self._previous = costs
        largest = np.abs(gradients).max(axis=1, keepdims=True)
        downhill = -self.steps[:, None] * np.divide(gradients, largest, out=np.zeros_like(x), where=largest > 0.0)
        if _explores(self.iteration + 1, self.iterations):
            moved = x + downhill  # Eq. 44, 45
        else:
            gamma = self.generator.random((len(x), 1))
            moved = x + gamma * (self._best.position - x) + downhill  # Eq. 47, 48
        self._positions = np.clip(moved, self.lower, self.upper)

    @property
    def best(self) -> Best:
        """The best candidate so far; its cost is inf before the first `tell`."""
        return self._best


class HaoaroaCanonical(AskTell):
    """Ask/tell HAOAROA of the two original algorithms, one after the other. Parameters and errors as `AskTell`."""

    def __init__(
        self,
        lower: FloatArray,
        upper: FloatArray,
        generator: np.random.Generator,
        initial: FloatArray | None = None,
        population: int = POPULATION,
        budget: int = POPULATION * ITERATIONS,
        step: float = 0.1,
    ) -> None:
        super().__init__(lower, upper, generator, initial, population, budget, step)
        self._aoa = Aoa(lower, upper, generator, self.first, population, budget, step, Mode.CANONICAL)
        self._roa = Roa(lower, upper, generator, self.first, population, budget, step, Mode.CANONICAL)
        self._riding = False

    def ask(self) -> FloatArray:
        """The candidates to evaluate (n_pop, n_dim), a copy."""
        return self._roa.ask() if self._riding else self._aoa.ask()

    def _move(self, costs: FloatArray, gradients: FloatArray | None) -> None:
        if self._riding:
            self._roa.tell(costs, gradients)
            return
        self._aoa.tell(costs, gradients)
        if not _explores(self.iteration + 1, self.iterations):  # what AOA kept mounts, at the same time of the search
            kept, riders = self._aoa.population, self._roa.population
            riders.positions[:] = kept.positions
            riders.best_position[:], riders.best_cost[:] = kept.best[0], kept.best_cost
            self._roa.iteration = self.iteration
            self._roa.tell(kept.costs, None if gradients is None else kept.gradients)
            self._riding = True

    @property
    def best(self) -> Best:
        """The best candidate so far; its cost is inf before the first `tell`."""
        return min(self._aoa.best, self._roa.best, key=lambda best: best.cost)
