"""What each sensor says about the state: innovation y = z - h(x), Jacobian H by the error state, noise R.

One function a sensor. All positions are from the estimator's origin; the magnetometer's h turns the local field into b:
h = R^T m_n, and with R = R_hat Exp(dtheta) its Jacobian is [h]x in dtheta.
"""

from dataclasses import dataclass

import numpy as np

from fakevehicle.estimator.strapdown import ERROR, matrix
from fakevehicle.vocabulary import FloatArray


@dataclass(frozen=True, slots=True)
class Measurement:
    """One sensor's word, ready for the filter.

    Attributes
    ----------
    sensor : name for status and test ratios.
    innovation : (m,) y = z - h(x_hat).
    H : (m, 15) dh/d(error).
    R : (m, m) covariance of z.
    """

    sensor: str
    innovation: FloatArray
    H: FloatArray
    R: FloatArray


def _selector(first: int, count: int) -> FloatArray:
    H = np.zeros((count, ERROR))
    H[np.arange(count), first + np.arange(count)] = 1.0
    return H


_H_VELOCITY = _selector(3, 3)
_H_HORIZONTAL = _selector(6, 2)
_H_DOWN = _selector(8, 1)


def gps_position(nominal: FloatArray, position_n: FloatArray, noise: float) -> Measurement:
    """North and east of a fix, (>= 2,) [m]. Height is the barometer's: a GPS height is worse and has another zero."""
    return Measurement("gps_position", position_n[:2] - nominal[0:2], _H_HORIZONTAL, noise**2 * np.eye(2))


def gps_velocity(nominal: FloatArray, velocity_n: FloatArray, noise: float) -> Measurement:
    """Velocity of a fix, (3,) [m/s]; the vertical part is 1.5 times as noisy, as PX4 takes it."""
    R = np.diag([noise**2, noise**2, (1.5 * noise) ** 2])
    return Measurement("gps_velocity", velocity_n - nominal[3:6], _H_VELOCITY, R)


def baro(nominal: FloatArray, height: float, noise: float) -> Measurement:
    """Height above where the estimator was aligned [m]; z = -height. R is white noise; for drift see `horizon`."""
    return Measurement("baro", np.array([-height - nominal[2]]), _H_DOWN, np.array([[noise**2]]))


def magnetometer(nominal: FloatArray, field_b: FloatArray, field_n: FloatArray, noise: float) -> Measurement:
    """Magnetic field in b, (3,) [gauss], against the known local field in n."""
    x, y, z = (np.array(matrix(nominal[6:10])).reshape(3, 3).T @ field_n).tolist()
    H = np.zeros((3, ERROR))
    H[0, 1], H[0, 2], H[1, 0], H[1, 2], H[2, 0], H[2, 1] = -z, y, z, -x, -y, x
    return Measurement("mag", field_b - np.array([x, y, z]), H, noise**2 * np.eye(3))
