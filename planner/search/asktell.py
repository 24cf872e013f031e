"""What the optimisers have in common: bounds, a population, a budget in evaluations, and the order of ask and tell.

    while not optimiser.done:
        optimiser.tell(cost(optimiser.ask()))
    optimiser.best

An optimiser proposes candidates and is told their costs; it never calls the cost.

Modes, with what they are true to:
    LITERAL            the equations as printed, nothing added
    CANONICAL          the original algorithms as they are run, with what the printed equations leave out
    SHIFT_INVARIANT    the default: wherever a rule multiplies coordinates, X_L (..), the difference, (X_L - X_i) (..),
                       so that moving a problem moves the answer with it
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

POPULATION, ITERATIONS = 20, 100
"""The paper's."""
FEWEST = 4
"""Candidates, so that each rider group has one."""


class Mode(StrEnum):
    """Which reading of an algorithm is run."""

    LITERAL = "literal"
    CANONICAL = "canonical"
    SHIFT_INVARIANT = "shift_invariant"


@dataclass(frozen=True, slots=True)
class Best:
    """The best candidate told so far."""

    position: FloatArray  # (n_dim,)
    cost: float


class AskTell(ABC):
    """One optimiser between two calls.

    Parameters
    ----------
    lower, upper : (n_dim,)         bounds, finite, lower < upper.
    generator : numpy Generator     the only source of chance.
    initial : (m, n_dim) or None    first candidates, clipped to the bounds; the rest are uniform in them.
    population : int                candidates, at least 4.
    budget : int                    evaluations; the last iteration is the last one that fits.
    step : float                    first length of the gradient step, in units of the candidates.

    Raises
    ------
    ValueError : bounds or shapes that do not fit, a cost that is NaN, or more iterations than the budget pays for.
    """

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
        self.lower, self.upper = np.array(lower, dtype=np.float64), np.array(upper, dtype=np.float64)
        low, high = self.lower, self.upper
        if low.ndim != 1 or low.shape != high.shape or not (np.isfinite(low) & np.isfinite(high) & (low < high)).all():
            raise ValueError("bounds: expected two finite vectors of one length with lower < upper")
        if population < FEWEST or budget < population:
            raise ValueError(f"expected a population of at least {FEWEST} and a budget that pays for it once")
        self.generator = generator
        self.first = low + (high - low) * generator.random((population, len(low)))
        if initial is not None:
            rows = np.asarray(initial, dtype=np.float64)[:population]
            self.first[: len(rows)] = np.clip(rows, low, high)
        self.steps = np.full(population, float(step))
        self.iteration, self.iterations = 0, budget // population
        self.evaluations = 0

    @property
    def done(self) -> bool:
        """Whether the budget is spent."""
        return self.iteration >= self.iterations

    @abstractmethod
    def ask(self) -> FloatArray:
        """The candidates to evaluate (n_pop, n_dim), a copy."""

    def tell(self, costs: FloatArray, gradients: FloatArray | None = None) -> None:
        """Take the costs (n_pop,) and gradients (n_pop, n_dim) of the candidates asked for, and move on."""
        values = np.array(costs, dtype=np.float64)
        if values.shape != self.steps.shape or np.isnan(values).any():
            raise ValueError(f"costs: expected {self.steps.shape} numbers, found {values.shape} or NaN")
        if self.done:
            raise ValueError(f"the budget of {self.iterations} iterations is spent")
        told = None if gradients is None else np.array(gradients, dtype=np.float64)
        if told is not None and told.shape != self.first.shape:
            raise ValueError(f"gradients: expected {self.first.shape}, found {told.shape}")
        self._move(values, told)
        self.iteration += 1
        self.evaluations += len(values)

    @abstractmethod
    def _move(self, costs: FloatArray, gradients: FloatArray | None) -> None:
        """Keep what is better, then move every candidate; t = iteration + 1 of `iterations`."""

    @property
    @abstractmethod
    def best(self) -> Best:
        """The best candidate so far; its cost is inf before the first `tell`."""
