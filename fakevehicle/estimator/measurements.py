"""What each sensor says about the state: innovation y = z - h(x), Jacobian H by the error state, noise R.

One function a sensor. All positions are from the estimator's origin; the magnetometer's h turns the local field into b:
h = R^T m_n, and with R = R_hat Exp(dtheta) its Jacobian is [h]x in dtheta.

Without GPS the rotors' drag still tells the airspeed (Martin & Salaun 2010, The true role of accelerometer feedback in
quadrotor control): in the rotors' plane nothing else is felt, f_xy = -k (R^T (v - w))_xy + b_a + n. With the wind w as
it was when GPS was last good this holds the velocity, as PX4's EKF2 does with EKF2_MCOEF.
"""

from dataclasses import dataclass

import numpy as np

from fakevehicle.estimator.strapdown import ERROR, field_in_body, matrix, seen_from_body
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
_EYE, _PLANE = np.eye(3), np.eye(2)
_VERTICAL = np.diag([1.0, 1.0, 2.25])  # 1.5 times as noisy, squared


def gps_position(nominal: FloatArray, position_n: FloatArray, noise: float) -> Measurement:
    """North and east of a fix, (>= 2,) [m]. Height is the barometer's: a GPS height is worse and has another zero."""
    return Measurement("gps_position", position_n[:2] - nominal[0:2], _H_HORIZONTAL, noise**2 * _PLANE)


def gps_velocity(nominal: FloatArray, velocity_n: FloatArray, noise: float) -> Measurement:
    """Velocity of a fix, (3,) [m/s]; the vertical part is 1.5 times as noisy, as PX4 takes it."""
    return Measurement("gps_velocity", velocity_n - nominal[3:6], _H_VELOCITY, noise**2 * _VERTICAL)


def gps_height(nominal: FloatArray, z: float, noise: float) -> Measurement:
    """Down coordinate of a fix [m], brought to the barometer's zero; `noise` is the horizontal one."""
    return Measurement("gps_height", np.array([z - nominal[2]]), _H_DOWN, np.array([[(1.5 * noise) ** 2]]))


def baro(nominal: FloatArray, height: float, noise: float) -> Measurement:
    """Height above where the estimator was aligned [m]; z = -height. R is white noise; for drift see `horizon`."""
    return Measurement("baro", np.array([-height - nominal[2]]), _H_DOWN, np.array([[noise**2]]))


def magnetometer(nominal: FloatArray, field_b: FloatArray, field_n: FloatArray, noise: float) -> Measurement:
    """Magnetic field in b, (3,) [gauss], against the known local field in n."""
    y, H = np.empty(3), np.zeros((3, ERROR))
    field_in_body(nominal, field_n, field_b, y, H)
    return Measurement("mag", y, H, noise**2 * _EYE)


def drag(nominal: FloatArray, felt_b: FloatArray, wind_n: FloatArray, k: float, sigma: float) -> Measurement:
    """Airspeed in the rotors' plane from what the accelerometer feels there.

    Parameters
    ----------
    nominal : (16,).
    felt_b : (>= 2,) specific force with the believed bias removed [m/s^2].
    wind_n : (3,) velocity of the air over ground [m/s].
    k : drag per mass and airspeed [1/s].
    sigma : 1 sigma of an airspeed, gusts included [m/s].
    """
    air = np.empty(3)
    seen_from_body(nominal[6:10], nominal[3:6] - wind_n, air)
    x, y, z = air.tolist()
    R = matrix(nominal[6:10])
    H = np.zeros((2, ERROR))
    H[0, 1], H[0, 2], H[1, 0], H[1, 2] = -z, y, z, -x  # rows 0 and 1 of [air]x
    H[0, 3:6], H[1, 3:6] = R[0::3], R[1::3]
    H[0, 12] = H[1, 13] = -1.0 / k  # a bias is taken for drag
    return Measurement("drag", -felt_b[:2] / k - air[:2], H, sigma**2 * _PLANE)
