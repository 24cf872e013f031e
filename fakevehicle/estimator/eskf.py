"""The error-state Kalman filter: filterpy's extended filter carries the covariance, the nominal state stands beside it.

Between measurements the error's mean is zero, so filterpy's x stays zero and only P moves. A measurement's innovation
is what `update` gets for its residual; what comes out in x is moved into the nominal state (`strapdown.inject`).
Measurements of one moment go in together: one update of five rows costs what one of two rows does.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from types import FunctionType, SimpleNamespace
from typing import Any

import numpy as np
from filterpy.kalman import ExtendedKalmanFilter

from fakevehicle.estimator.measurements import Measurement
from fakevehicle.estimator.strapdown import (
    ERROR,
    NOMINAL,
    inject,
    inverse,
    normalised_innovation_squared,
    propagate,
    stacked,
)
from fakevehicle.vocabulary import FloatArray

FELT_TIME = 0.1
"""Time constant of the smoothed specific force [s]."""


@dataclass(frozen=True, slots=True)
class Fusion:
    """What became of a measurement: NIS = y^T S^-1 y, its degrees of freedom, and whether it passed the gate."""

    sensor: str
    nis: float
    dof: int
    accepted: bool


def _zero(_: FloatArray) -> float:
    return 0.0


def _with(method: Any, **names: Any) -> Any:
    """filterpy's own method, in which some of its modules' names mean something else."""
    return FunctionType(method.__code__, {**method.__globals__, **names}, method.__name__, method.__defaults__)


class ErrorStateFilter(ExtendedKalmanFilter):  # type: ignore[misc]  # filterpy is untyped
    """Error-state filter of position, velocity, attitude and IMU biases (frames and order in `strapdown`).

    Parameters
    ----------
    nominal : (16,) first nominal state.
    sigma : (15,) 1 sigma of its error.
    gravity : [m/s^2].

    Attributes
    ----------
    nominal : (16,), moved in place.  P : (15, 15) covariance of the error state.
    felt : (7,) smoothed specific force in b and newest acceleration_n, see `strapdown.propagate`.
    """

    def __init__(self, nominal: FloatArray, sigma: FloatArray, gravity: float) -> None:
        super().__init__(dim_x=ERROR, dim_z=3)
        if nominal.shape != (NOMINAL,) or sigma.shape != (ERROR,):
            raise ValueError(f"nominal {nominal.shape}, sigma {sigma.shape}: expected ({NOMINAL},) and ({ERROR},)")
        self.x = np.zeros(ERROR)
        self.P = np.diag(sigma**2)
        self.Q = np.zeros((ERROR, ERROR))
        self.nominal = nominal.copy()
        self.felt: FloatArray = np.zeros(7)
        self.felt[6] = FELT_TIME
        self._gravity = gravity
        self._scratch = np.zeros((ERROR, ERROR))

    # our inverse of S, since the checks around scipy's take a quarter of an update; no copies of x and P before a step,
    # which nobody reads
    update = _with(ExtendedKalmanFilter.update, linalg=SimpleNamespace(inv=inverse))
    predict = _with(ExtendedKalmanFilter.predict, np=SimpleNamespace(copy=lambda array: array))

    def predict_x(self, u: object = 0) -> None:
        """The error's mean stays zero between measurements; the nominal state moves instead."""

    def carry(self, samples: FloatArray, first: int, count: int, dt: float, noise: FloatArray) -> None:
        """Move nominal state and covariance over `count` IMU samples; parameters as in `strapdown.propagate`."""
        propagate(self.nominal, samples, first, count, dt, self._gravity, noise, self.F, self.Q, self.felt)
        self.predict()

    def weigh(self, measurement: Measurement, gate: float) -> Fusion:
        """What a measurement is worth now; nothing changes."""
        y = measurement.innovation
        nis: float = normalised_innovation_squared(self.P, measurement.H, measurement.R, y)
        return Fusion(measurement.sensor, nis, len(y), nis <= gate)

    def take(self, measurements: Sequence[Measurement]) -> None:
        """Take measurements of one moment in, together, whatever they are worth; their noises are independent."""
        y, H, R = measurements[0].innovation, measurements[0].H, measurements[0].R
        for other in measurements[1:]:
            y, H, R = stacked(y, H, R, other.innovation, other.H, other.R)
        self.update(0.0, lambda _: H, _zero, R=R, residual=lambda _z, _h: y)
        inject(self.nominal, self.x, self.P, self._scratch)

    def forget(self, states: Sequence[int], sigma: float) -> None:
        """Know nothing of some states any more: no correlation with the others, and this 1 sigma each."""
        for i in states:
            self.P[i, :] = 0.0
            self.P[:, i] = 0.0
            self.P[i, i] = sigma**2
