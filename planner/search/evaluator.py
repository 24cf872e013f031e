"""A function under a budget: evaluations counted, costs that are no numbers put last, gradients however it has them.

Points are rows (n, n_dim), costs (n,).
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_DIFFERENCE = float(np.sqrt(np.finfo(np.float64).eps))


class Over(Exception):
    """The budget is spent, or the function is unbounded."""


@dataclass(slots=True)
class Evaluator:
    """The function, counted, with the best point it was ever asked for."""

    fun: Callable[..., Any]
    jac: Callable[..., Any] | bool | None
    args: tuple[Any, ...]
    vectorized: bool
    lower: FloatArray
    upper: FloatArray
    budget: int
    nfev: int = 0
    njev: int = 0
    refused: int = 0  # costs that were NaN or +inf
    x: FloatArray = field(default_factory=lambda: np.empty(0))
    cost: float = np.inf

    def costs(self, points: FloatArray) -> FloatArray:
        """Costs (n,) of points (n, n_dim); +inf where there is none. Raises Over rather than overdraw."""
        if self.jac is True:
            return self.costs_and_gradients(points)[0]
        if self.nfev + len(points) > self.budget:
            raise Over("the budget is spent")
        if self.vectorized:
            values = np.array(self.fun(points.copy(), *self.args), dtype=np.float64)
            if values.shape != (len(points),):
                raise ValueError(f"fun: expected {len(points)} costs of {points.shape}, found shape {values.shape}")
        else:
            values = np.array([self._scalar(self.fun(x.copy(), *self.args)) for x in points])
        return self._take(points, values)

    def costs_and_gradients(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Costs (n,) and gradients (n, n_dim): the caller's, or forward differences. A gradient that is none is 0."""
        if self.jac is True:
            if self.nfev + len(points) > self.budget:
                raise Over("the budget is spent")
            told = [self.fun(x.copy(), *self.args) for x in points]
            values = self._take(points, np.array([self._scalar(value) for value, _ in told]))
            slopes = [gradient for _, gradient in told]
        elif callable(self.jac):
            values = self.costs(points)
            slopes = [self.jac(x.copy(), *self.args) for x in points]
        else:
            return self._differences(points)
        self.njev += len(points)
        gradients = np.array(slopes, dtype=np.float64)
        if gradients.shape != points.shape:
            raise ValueError(f"jac: expected gradients of shape {points.shape[1:]}, found {gradients.shape[1:]}")
        return values, self._clean(values, gradients)

    def _differences(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Forward differences, turned inward at the upper bounds."""
        n, dim = points.shape
        h = _DIFFERENCE * np.maximum(np.abs(points), 1e-3 * (self.upper - self.lower))
        h = np.where(points + h > self.upper, -h, h)
        beside = points[:, None, :] + h[:, :, None] * np.eye(dim)
        h = beside[:, np.arange(dim), np.arange(dim)] - points  # what the sum really made of it
        values = self.costs(np.concatenate([points[:, None, :], beside], axis=1).reshape(-1, dim)).reshape(n, dim + 1)
        with np.errstate(invalid="ignore", over="ignore"):
            gradients = (values[:, 1:] - values[:, :1]) / h
        return values[:, 0], self._clean(values[:, 0], gradients)

    @staticmethod
    def _clean(values: FloatArray, gradients: FloatArray) -> FloatArray:
        usable = np.isfinite(gradients).all(axis=1, keepdims=True) & np.isfinite(values)[:, None]
        return np.where(usable, gradients, 0.0)

    @staticmethod
    def _scalar(value: Any) -> float:
        if np.size(value) != 1:
            raise ValueError(f"fun: expected one cost, found shape {np.shape(value)}")
        return float(np.asarray(value, dtype=np.float64).reshape(()))

    def _take(self, points: FloatArray, values: FloatArray) -> FloatArray:
        self.nfev += len(points)
        none = np.isnan(values) | (values == np.inf)
        self.refused += int(none.sum())
        values = np.where(none, np.inf, values)
        top = int(np.argmin(values))
        if values[top] < self.cost or not self.x.size:
            self.x, self.cost = points[top].copy(), float(values[top])
        if self.cost == -np.inf:
            raise Over("the function is -inf at x: it has no minimum")
        return values
