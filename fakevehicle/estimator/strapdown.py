# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""The nominal state and how the IMU carries it on: kernels.

Nominal state (16,): position_n 0:3, velocity_n 3:6, q_nb (wxyz) 6:10, gyro bias 10:13, accelerometer bias 13:16.
Error state (15,): dtheta 0:3 (in b), dv 3:6, dp 6:9, db_g 9:12, db_a 12:15 (Sola 2017, Quaternion kinematics for the
error-state Kalman filter, ch. 5-6). With the tick's delta angle dT and delta velocity dV (biases removed):

    F_tt = I - [dT]x      F_tbg = -I dt        F_vt = -R [dV]x      F_vba = -R dt
    F_pv = I dt           F_pt = dt/2 F_vt     F_pba = dt/2 F_vba
"""

import math

import numpy as np

from fakevehicle.jit import kernel

NOMINAL, ERROR = 16, 15


@kernel
def turn(q, x, y, z):
    """q <- q * Exp(x, y, z) in place, normalised; the rotation vector is in b [rad]. `q` is (4,) wxyz."""
    angle = math.sqrt(x * x + y * y + z * z)
    s = 0.5 - angle * angle / 48.0 if angle < 1e-4 else math.sin(0.5 * angle) / angle
    c = math.cos(0.5 * angle)
    x, y, z = s * x, s * y, s * z
    w0, x0, y0, z0 = q[0], q[1], q[2], q[3]
    w1 = w0 * c - x0 * x - y0 * y - z0 * z
    x1 = w0 * x + x0 * c + y0 * z - z0 * y
    y1 = w0 * y - x0 * z + y0 * c + z0 * x
    z1 = w0 * z + x0 * y - y0 * x + z0 * c
    n = 1.0 / math.sqrt(w1 * w1 + x1 * x1 + y1 * y1 + z1 * z1)
    q[0], q[1], q[2], q[3] = w1 * n, x1 * n, y1 * n, z1 * n


@kernel
def matrix(q):
    """R_nb of a wxyz quaternion as nine numbers, row by row."""
    w, x, y, z = q[0], q[1], q[2], q[3]
    return (
        1 - 2 * (y * y + z * z),
        2 * (x * y - w * z),
        2 * (x * z + w * y),
        2 * (x * y + w * z),
        1 - 2 * (x * x + z * z),
        2 * (y * z - w * x),
        2 * (x * z - w * y),
        2 * (y * z + w * x),
        1 - 2 * (x * x + y * y),
    )


@kernel
def propagate(nominal, samples, first, count, dt, gravity, noise, F, Q, felt):
    """Carry the nominal state over `count` IMU samples; write the transition and the process noise of its error.

    The nominal state takes every sample; F and Q are of the whole interval T = count dt, with dT and R dV summed.

    Parameters
    ----------
    nominal : (16,) in place.
    samples : (n, 6) ring of mean gyro [rad/s] and specific force [m/s^2] of a tick, biases still in.
    first, count : the rows to take, wrapping round.
    dt : of one sample [s].  gravity : [m/s^2].
    noise : (4,) 1 sigma of gyro and accelerometer samples, and of the biases' rates [rad/s^2], [m/s^3].
    F, Q : (15, 15), written; entries that never change are left alone.
    felt : (7,) specific force in b with its bias removed, smoothed, 0:3, mean acceleration_n 3:6 [m/s^2], in place;
        6 is the smoothing's time constant [s].
    """
    n = samples.shape[0]
    q = nominal[6:10]
    r = matrix(q)  # at the start of the interval
    ax, ay, az = 0.0, 0.0, 0.0  # dT of the interval
    sx, sy, sz = 0.0, 0.0, 0.0  # R dV of the interval, in n
    share = min(1.0, dt / felt[6])
    for k in range(count):
        imu = samples[(first + k) % n]
        tx, ty, tz = (imu[0] - nominal[10]) * dt, (imu[1] - nominal[11]) * dt, (imu[2] - nominal[12]) * dt
        fx, fy, fz = imu[3] - nominal[13], imu[4] - nominal[14], imu[5] - nominal[15]
        felt[0] += share * (fx - felt[0])
        felt[1] += share * (fy - felt[1])
        felt[2] += share * (fz - felt[2])
        vx, vy, vz = fx * dt, fy * dt, fz * dt
        # body turned while it was pushed: dV + 1/2 dT x dV
        ux, uy, uz = vx + 0.5 * (ty * vz - tz * vy), vy + 0.5 * (tz * vx - tx * vz), vz + 0.5 * (tx * vy - ty * vx)
        m = matrix(q)
        dx = m[0] * ux + m[1] * uy + m[2] * uz
        dy = m[3] * ux + m[4] * uy + m[5] * uz
        dz = m[6] * ux + m[7] * uy + m[8] * uz
        sx, sy, sz = sx + dx, sy + dy, sz + dz
        dz += gravity * dt
        nominal[0] += dt * (nominal[3] + 0.5 * dx)
        nominal[1] += dt * (nominal[4] + 0.5 * dy)
        nominal[2] += dt * (nominal[5] + 0.5 * dz)
        nominal[3] += dx
        nominal[4] += dy
        nominal[5] += dz
        ax, ay, az = ax + tx, ay + ty, az + tz
        turn(q, tx, ty, tz)
    T = count * dt
    half = 0.5 * T
    felt[3], felt[4], felt[5] = sx / T, sy / T, sz / T + gravity
    for j in range(3):
        a, b, c = r[j], r[3 + j], r[6 + j]  # column j of R
        # -R [dV]x = -[R dV]x R
        F[3, j] = sz * b - sy * c
        F[4, j] = sx * c - sz * a
        F[5, j] = sy * a - sx * b
        for i in range(3):
            F[3 + i, 12 + j] = -T * r[3 * i + j]
            F[6 + i, j] = half * F[3 + i, j]
            F[6 + i, 12 + j] = half * F[3 + i, 12 + j]
        F[6 + j, 3 + j] = T
        F[j, 9 + j] = -T
    F[0, 1], F[0, 2], F[1, 2] = az, -ay, ax
    F[1, 0], F[2, 0], F[2, 1] = -az, ay, -ax
    s_v = noise[1] * noise[1] * dt  # spectral density of the accelerometer's noise [(m/s^2)^2/Hz]
    for i in range(3):
        Q[i, i] = noise[0] * noise[0] * dt * T
        Q[3 + i, 3 + i] = s_v * T
        Q[3 + i, 6 + i] = s_v * T * T / 2.0
        Q[6 + i, 3 + i] = s_v * T * T / 2.0
        Q[6 + i, 6 + i] = s_v * T * T * T / 3.0
        Q[9 + i, 9 + i] = noise[2] * noise[2] * dt * T
        Q[12 + i, 12 + i] = noise[3] * noise[3] * dt * T


@kernel
def seen_from_body(q, vector_n, out):
    """R^T v: a vector in n, (3,), as the body sees it, into `out`."""
    m = matrix(q)
    for i in range(3):
        out[i] = m[i] * vector_n[0] + m[3 + i] * vector_n[1] + m[6 + i] * vector_n[2]


@kernel
def field_in_body(nominal, field_n, field_b, y, H):
    """Innovation (3,) of a magnetometer and its Jacobian (3, 15), both written: h = R^T m_n, H = [h]x in dtheta."""
    h = np.empty(3)
    seen_from_body(nominal[6:10], field_n, h)
    for i in range(3):
        y[i] = field_b[i] - h[i]
    H[0, 1], H[0, 2] = -h[2], h[1]
    H[1, 0], H[1, 2] = h[2], -h[0]
    H[2, 0], H[2, 1] = -h[1], h[0]


@kernel
def dip_and_strength(nominal, field_b):
    """Down component and norm of a magnetic field in b, (3,) [gauss], at the believed attitude."""
    m = matrix(nominal[6:10])
    x, y, z = field_b[0], field_b[1], field_b[2]
    return m[6] * x + m[7] * y + m[8] * z, math.sqrt(x * x + y * y + z * z)


@kernel
def stacked(y, H, R, y2, H2, R2):
    """Two measurements of one moment, with independent noise, as one: (y, H, R)."""
    m, n = y.shape[0], y2.shape[0]
    both, rows, noise = np.empty(m + n), np.empty((m + n, H.shape[1])), np.zeros((m + n, m + n))
    both[:m], both[m:] = y, y2
    rows[:m], rows[m:] = H, H2
    noise[:m, :m], noise[m:, m:] = R, R2
    return both, rows, noise


@kernel
def normalised_innovation_squared(P, H, R, y):
    """NIS = y^T (H P H^T + R)^-1 y by Cholesky's factor: S = L L^T, NIS = |L^-1 y|^2.

    Parameters
    ----------
    P : (15, 15).  H : (m, 15).  R : (m, m).  y : (m,), m <= 3.
    """
    m = y.shape[0]
    L = np.zeros((3, 3))
    w = np.zeros(3)
    nis = 0.0
    for i in range(m):
        for j in range(i + 1):
            total = R[i, j]
            for a in range(15):
                if H[i, a] != 0.0:
                    for b in range(15):
                        total += H[i, a] * P[a, b] * H[j, b]
            for k in range(j):
                total -= L[i, k] * L[j, k]
            L[i, j] = math.sqrt(total) if i == j else total / L[j, j]
        w[i] = y[i]
        for k in range(i):
            w[i] -= L[i, k] * w[k]
        w[i] /= L[i, i]
        nis += w[i] * w[i]
    return nis


@kernel
def inverse(S):
    """S^-1 of a symmetric positive-definite (m, m) matrix, by Gauss and Jordan: such a matrix needs no pivots."""
    m = S.shape[0]
    left, right = S.copy(), np.zeros((m, m))
    for k in range(m):
        right[k, k] = 1.0
    for k in range(m):
        share = 1.0 / left[k, k]
        for j in range(m):
            left[k, j] *= share
            right[k, j] *= share
        for i in range(m):
            if i != k:
                part = left[i, k]
                for j in range(m):
                    left[i, j] -= part * left[k, j]
                    right[i, j] -= part * right[k, j]
    return right


@kernel
def inject(nominal, error, P, scratch):
    """Move the estimated error into the nominal state and turn P with it: P <- G P G^T, G = I - [dtheta/2]x.

    Parameters
    ----------
    nominal : (16,), error : (15,), P : (15, 15), all in place; the error is zero afterwards.
    scratch : (15, 15).
    """
    x, y, z = 0.5 * error[0], 0.5 * error[1], 0.5 * error[2]
    for i in range(3):
        nominal[i] += error[6 + i]
        nominal[3 + i] += error[3 + i]
        nominal[10 + i] += error[9 + i]
        nominal[13 + i] += error[12 + i]
    turn(nominal[6:10], error[0], error[1], error[2])
    for j in range(15):
        a, b, c = P[0, j], P[1, j], P[2, j]
        scratch[0, j] = a + z * b - y * c
        scratch[1, j] = b - z * a + x * c
        scratch[2, j] = c + y * a - x * b
        for i in range(3, 15):
            scratch[i, j] = P[i, j]
    for i in range(15):
        a, b, c = scratch[i, 0], scratch[i, 1], scratch[i, 2]
        scratch[i, 0] = a + z * b - y * c
        scratch[i, 1] = b - z * a + x * c
        scratch[i, 2] = c + y * a - x * b
    for i in range(15):
        for j in range(15):
            P[i, j] = 0.5 * (scratch[i, j] + scratch[j, i])
        error[i] = 0.0


@kernel
def shift_output(out, ring, position_n, velocity_n, yaw):
    """Move the output and all of its past at once: a reset.

    Parameters
    ----------
    out : (>= 10,) and ring : (n, 10), position, velocity, q_nb, in place.
    position_n, velocity_n : (3,) to add.  yaw : turn about the down axis [rad].
    """
    c, s = math.cos(0.5 * yaw), math.sin(0.5 * yaw)
    for k in range(ring.shape[0] + 1):
        row = ring[k] if k < ring.shape[0] else out[:10]
        for i in range(3):
            row[i] += position_n[i]
            row[3 + i] += velocity_n[i]
        w, x, y, z = row[6], row[7], row[8], row[9]  # (c, 0, 0, s) * q
        row[6], row[7], row[8], row[9] = c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w
