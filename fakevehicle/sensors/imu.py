# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""Gyro and accelerometer at 1 kHz: white noise, a bias that walks, saturation.

    gyro  = omega_b + b_g + n_g          accel = R^T (v' - g e3) + b_a + n_a

The specific force of a substep is taken from the change of velocity over it, turned by the attitude in its middle, so
that summing the samples gives back the true change. Noise parameters are those of the 250 Hz mean of four samples.
"""

import math

import numpy as np

from fakevehicle.jit import kernel

IMU = np.dtype(
    [
        ("gyro_noise", "f8"),  # 1 sigma of one 1 kHz sample [rad/s]
        ("accel_noise", "f8"),  # [m/s^2]
        ("gyro_walk", "f8"),  # 1 sigma of the bias's step per tick [rad/s]
        ("accel_walk", "f8"),
        ("gyro_bias", "f8", (3,)),
        ("accel_bias", "f8", (3,)),
        ("gyro_sample", "f8", (3,)),  # newest 1 kHz sample
        ("gyro_sum", "f8", (3,)),
        ("accel_sum", "f8", (3,)),
    ]
)
GYRO_RANGE = math.radians(2000.0)
ACCEL_RANGE = 16.0 * 9.80665
DRAWS = 6
"""Normal draws of one substep; a tick needs six more for the bias walks."""


@kernel
def read_gyro(x, imu, noise, first):
    """The gyro sample at the beginning of a substep, into `imu.gyro_sample`; noise draws first..first+2."""
    for i in range(3):
        sample = x[10 + i] + imu.gyro_bias[i] + imu.gyro_noise * noise[first + i]
        imu.gyro_sample[i] = min(max(sample, -GYRO_RANGE), GYRO_RANGE)


@kernel
def integrate_imu(before, x, gravity, dt, imu, noise, first):
    """Add one substep to the tick's sums.

    Parameters
    ----------
    before, x : (17,) state at the substep's beginning and end.
    gravity : [m/s^2].
    dt : length of the substep [s].
    noise, first : normal draws and where this substep's six begin (the gyro's three are the ones `read_gyro` used).
    """
    fx, fy, fz = (x[3] - before[3]) / dt, (x[4] - before[4]) / dt, (x[5] - before[5]) / dt - gravity
    qw, qx, qy, qz = before[6] + x[6], before[7] + x[7], before[8] + x[8], before[9] + x[9]
    n = 1.0 / math.sqrt(qw * qw + qx * qx + qy * qy + qz * qz)
    qw, qx, qy, qz = qw * n, qx * n, qy * n, qz * n
    ax = (1 - 2 * (qy * qy + qz * qz)) * fx + 2 * (qx * qy + qw * qz) * fy + 2 * (qx * qz - qw * qy) * fz
    ay = 2 * (qx * qy - qw * qz) * fx + (1 - 2 * (qx * qx + qz * qz)) * fy + 2 * (qy * qz + qw * qx) * fz
    az = 2 * (qx * qz + qw * qy) * fx + 2 * (qy * qz - qw * qx) * fy + (1 - 2 * (qx * qx + qy * qy)) * fz
    for i in range(3):
        rate = 0.5 * (before[10 + i] + x[10 + i]) + imu.gyro_bias[i] + imu.gyro_noise * noise[first + i]
        imu.gyro_sum[i] += min(max(rate, -GYRO_RANGE), GYRO_RANGE)
        force = ax if i == 0 else ay if i == 1 else az
        force += imu.accel_bias[i] + imu.accel_noise * noise[first + 3 + i]
        imu.accel_sum[i] += min(max(force, -ACCEL_RANGE), ACCEL_RANGE)


@kernel
def walk_biases(imu, noise, first):
    """One tick of the biases' random walks; six draws from `first`."""
    for i in range(3):
        imu.gyro_bias[i] += imu.gyro_walk * noise[first + i]
        imu.accel_bias[i] += imu.accel_walk * noise[first + 3 + i]
