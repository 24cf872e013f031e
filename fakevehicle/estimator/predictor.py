# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""The output predictor: from the filter's delayed state to the newest IMU sample, inside the compiled tick.

Two rings hold what has happened since the filter's horizon, one row a tick: IMU samples and outputs. When the filter
has moved, the difference between it and the output of the same moment is taken, and a share of it is added to every
output since, so that it dies away with a time constant and never swings. Attitude differs by a turn in n,

    q_filter = Exp(e) q_past      =>      q <- Exp(share e) q      for every row since,

one quaternion for all of them. A change of velocity has moved the later positions too, by its age.
"""

import math

import numpy as np

from fakevehicle.estimator.strapdown import NOMINAL, matrix, turn
from fakevehicle.jit import kernel

OUTPUT = 16
"""An output as numbers: position 0:3, velocity 3:6, q_nb 6:10, omega_b 10:13, acceleration_n 13:16."""
SPARE = 3
"""Rows of the rings beyond the horizon's age: how many ticks the filter may fall behind it."""

PREDICTOR = np.dtype(
    [
        ("nominal", "f8", (NOMINAL,)),  # the filter at its horizon; biases are used before the filter runs, as zeros
        ("out", "f8", (OUTPUT,)),  # at the newest IMU sample
        ("shares", "f8", (3,)),  # of the difference in position, velocity and attitude, a correction
        ("running", "i8"),  # whether there is a filter yet
        ("moved", "i8"),  # whether it has moved since the last correction
        ("newest", "i8"),  # row of the newest sample and output
        ("horizon", "i8"),  # row of the output at the filter's time
    ]
)


@kernel
def correct(p, ring, dt):
    """Pull every output since the horizon towards the filter.

    Parameters
    ----------
    p : record of `PREDICTOR`.
    ring : (n, 10) outputs, position, velocity, q_nb; rows `horizon` to `newest`, in place.
    dt : spacing of the rows [s].
    """
    n = ring.shape[0]
    nominal, past = p.nominal, ring[p.horizon]
    px, py, pz = (
        p.shares[0] * (nominal[0] - past[0]),
        p.shares[0] * (nominal[1] - past[1]),
        p.shares[0] * (nominal[2] - past[2]),
    )
    vx, vy, vz = (
        p.shares[1] * (nominal[3] - past[3]),
        p.shares[1] * (nominal[4] - past[4]),
        p.shares[1] * (nominal[5] - past[5]),
    )
    # q_filter * q_past^-1: a small turn e in n, of which half is the vector part
    w0, x0, y0, z0 = nominal[6], nominal[7], nominal[8], nominal[9]
    w1, x1, y1, z1 = past[6], -past[7], -past[8], -past[9]
    ew = w0 * w1 - x0 * x1 - y0 * y1 - z0 * z1
    share = p.shares[2] if ew >= 0.0 else -p.shares[2]
    ex = share * (w0 * x1 + x0 * w1 + y0 * z1 - z0 * y1)
    ey = share * (w0 * y1 - x0 * z1 + y0 * w1 + z0 * x1)
    ez = share * (w0 * z1 + x0 * y1 - y0 * x1 + z0 * w1)
    c = math.sqrt(max(0.0, 1.0 - ex * ex - ey * ey - ez * ez))
    row, age = p.horizon, 0.0
    while True:
        r = ring[row]
        r[0] += px + age * vx
        r[1] += py + age * vy
        r[2] += pz + age * vz
        r[3] += vx
        r[4] += vy
        r[5] += vz
        w, x, y, z = r[6], r[7], r[8], r[9]
        r[6] = c * w - ex * x - ey * y - ez * z
        r[7] = c * x + ex * w + ey * z - ez * y
        r[8] = c * y + ey * w + ez * x - ex * z
        r[9] = c * z + ez * w + ex * y - ey * x
        if row == p.newest:
            break
        row = row + 1 if row + 1 < n else 0
        age += dt


@kernel
def advance_output(p, imu, ring, rate_x, rate_y, rate_z, force_x, force_y, force_z, dt, gravity):
    """Take in one IMU sample: into its ring, and into the output.

    Parameters
    ----------
    p : record of `PREDICTOR`.
    imu : (n, 6) and ring : (n, 10), the two rings, in place.
    rate_x .. force_z : mean of the tick, biases still in [rad/s], [m/s^2].
    dt : [s].  gravity : [m/s^2].
    """
    if p.moved != 0:
        p.moved = 0
        correct(p, ring, dt)
    last = p.newest
    newest = last + 1 if last + 1 < ring.shape[0] else 0
    p.newest = newest
    sample = imu[newest]
    sample[0], sample[1], sample[2] = rate_x, rate_y, rate_z
    sample[3], sample[4], sample[5] = force_x, force_y, force_z
    if p.running == 0:
        return
    out, nominal, before = p.out, p.nominal, ring[last]
    for i in range(10):
        out[i] = before[i]
    tx, ty, tz = (rate_x - nominal[10]) * dt, (rate_y - nominal[11]) * dt, (rate_z - nominal[12]) * dt
    vx, vy, vz = (force_x - nominal[13]) * dt, (force_y - nominal[14]) * dt, (force_z - nominal[15]) * dt
    # body turned while it was pushed: dV + 1/2 dT x dV
    ux, uy, uz = vx + 0.5 * (ty * vz - tz * vy), vy + 0.5 * (tz * vx - tx * vz), vz + 0.5 * (tx * vy - ty * vx)
    q = out[6:10]
    m = matrix(q)
    for i in range(3):
        dv = m[3 * i] * ux + m[3 * i + 1] * uy + m[3 * i + 2] * uz
        if i == 2:
            dv += gravity * dt
        out[i] += dt * out[3 + i] + 0.5 * dt * dv
        out[3 + i] += dv
        out[13 + i] = dv / dt
    out[10], out[11], out[12] = tx / dt, ty / dt, tz / dt
    turn(q, tx, ty, tz)
    after = ring[newest]
    for i in range(10):
        after[i] = out[i]


@kernel
def advance_alone(predictor_, imu, ring, sample, dt, gravity):
    """`advance_output` without a vehicle around it: `predictor_` is a (1,) array of `PREDICTOR` seen as f8."""
    p = predictor_.view(PREDICTOR)[0]
    x = sample
    advance_output(p, imu, ring, x[0], x[1], x[2], x[3], x[4], x[5], dt, gravity)
