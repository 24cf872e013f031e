"""Five numbers about several runs, and which such numbers can be."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, slots=True)
class Spread:
    """Five numbers about the runs of one contender on one function; of f - f*."""

    best: float
    worst: float
    mean: float
    median: float
    std: float  # of the runs themselves: divided by n

    @classmethod
    def of(cls, errors: Iterable[float]) -> "Spread":
        """From the runs."""
        e = np.array(list(errors))
        return cls(float(e.min()), float(e.max()), float(e.mean()), float(np.median(e)), float(e.std()))

    def least_std(self, runs: int) -> float:
        """(worst - mean)/sqrt(runs - 1): no `runs` numbers with this worst and this mean have a smaller one.

        One number lies D = worst - mean above the mean, so the others lie D below it together; their squares are least
        when each lies D/(n - 1) below. The variance is then (D^2 + D^2/(n - 1))/n = D^2/(n - 1), and more if the sum
        is divided by n - 1 instead.
        """
        return (self.worst - self.mean) / math.sqrt(runs - 1)

    def least_mean(self, runs: int) -> float:
        """(worst + (runs - 1) best)/runs: one number is the worst, and none of the others is below the best."""
        return (self.worst + (runs - 1) * self.best) / runs

    def possible(self, runs: int, slack: float = 1e-9) -> bool:
        """Whether any `runs` numbers have this best, worst, mean and std; `slack` is for rounded ones, relative."""
        enough = 1.0 - slack
        return self.mean >= self.least_mean(runs) * enough and self.std >= self.least_std(runs) * enough
