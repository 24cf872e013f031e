"""The error-state Kalman filter: filterpy's extended filter carries the covariance, the nominal state stands beside it.

Between measurements the error's mean is zero, so filterpy's x stays zero and only P moves. A measurement's innovation
is handed to `update` as z with Hx = 0; what comes out in x is moved into the nominal state (`strapdown.inject`).
"""

from dataclasses import dataclass

import numpy as np
from filterpy.kalman import ExtendedKalmanFilter

from fakevehicle.estimator.measurements import Measurement
from fakevehicle.estimator.strapdown import ERROR, NOMINAL, inject, normalised_innovation_squared, propagate
from fakevehicle.vocabulary import FloatArray


@dataclass(frozen=True, slots=True)
class Fusion:
    """What became of a measurement: NIS = y^T S^-1 y, its degrees of freedom, and whether it passed the gate."""

    sensor: str
    nis: float
    dof: int
    accepted: bool


def _zero(_: FloatArray) -> float:
    return 0.0


class ErrorStateFilter(ExtendedKalmanFilter):  # type: ignore[misc]  # filterpy is untyped
    """Error-state filter of position, velocity, attitude and IMU biases (frames and order in `strapdown`).

    Parameters
    ----------
    nominal : (16,) first nominal state.
    sigma : (15,) 1 sigma of its error.
    gravity : [m/s^2].

    Attributes
    ----------
    nominal : (16,).  P : (15, 15) covariance of the error state.
    """

    def __init__(self, nominal: FloatArray, sigma: FloatArray, gravity: float) -> None:
        super().__init__(dim_x=ERROR, dim_z=3)
        if nominal.shape != (NOMINAL,) or sigma.shape != (ERROR,):
            raise ValueError(f"nominal {nominal.shape}, sigma {sigma.shape}: expected ({NOMINAL},) and ({ERROR},)")
        self.x = np.zeros(ERROR)
        self.P = np.diag(sigma**2)
        self.Q = np.zeros((ERROR, ERROR))
        self.nominal = nominal.copy()
        self._gravity = gravity
        self._scratch = np.zeros((ERROR, ERROR))

    def predict_x(self, u: object = 0) -> None:
        """The error's mean stays zero between measurements; the nominal state moves instead."""

    def carry(self, imu: FloatArray, dt: float, noise: FloatArray) -> None:
        """Move nominal state and covariance over one IMU sample; parameters as in `strapdown.propagate`."""
        propagate(self.nominal, imu, dt, self._gravity, noise, self.F, self.Q)
        self.predict()

    def fuse(self, measurement: Measurement, gate: float) -> Fusion:
        """Weigh a measurement and, when its NIS is below `gate`, take it in."""
        y, H, R = measurement.innovation, measurement.H, measurement.R
        nis: float = normalised_innovation_squared(self.P, H, R, y)
        accepted = nis <= gate
        if accepted:
            self.update(y, lambda _: H, _zero, R=R)
            inject(self.nominal, self.x, self.P, self._scratch)
        return Fusion(measurement.sensor, nis, len(y), accepted)
