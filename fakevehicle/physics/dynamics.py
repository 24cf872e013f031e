# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""Rigid-body dynamics of a quadrotor with rotor lag.

State x (17,): position_n 0:3, velocity_n 3:6, q_nb (wxyz) 6:10, omega_b 10:13, rotor speeds Omega 13:17.

    p' = v                          v' = g e3 + R f / m
    q' = 1/2 q * [0, omega]         Omega_i' = (sag Omega_c,i - Omega_i) / tau_up|down
    J omega' = M - omega x (J omega + h e3) - h' e3,        h = sum J_r s_i Omega_i

with sag the battery's voltage over the one the motors' full speed belongs to, and f and M the forces and torques of
rotors, body drag and ground in the body frame. This is the Newton-Euler form with body rates (e.g. Mahony, Kumar &
Corke 2012, eq. 1-8). The paper's equations 24 to 26 print U2..U4 with one sign pattern (rank 2), give thrust and
gravity one sign in z, and use Euler rates for body rates; they are not used.
"""

import math

from fakevehicle.jit import kernel
from fakevehicle.physics.ground import add_contact
from fakevehicle.physics.rotors import add_rotors

P, V, Q, W, OM = 0, 3, 6, 10, 13
"""Offsets of position, velocity, attitude, body rate and rotor speed in the state."""
STATE = 17


@kernel
def derivative(x, command, wind_n, anchor, body, dx):
    """x' = f(x, u), written into `dx`.

    Parameters
    ----------
    x, dx : (17,) state and its derivative.
    command : (4,) rotor speed setpoints [rad/s].
    wind_n : (3,) velocity of the air over ground [m/s].
    anchor : (4 or 8, 3) where each foot, and each hub, holds the ground (`ground.add_contact`).
    body : record of `airframe.BODY`.
    """
    qw, qx, qy, qz = x[6], x[7], x[8], x[9]
    r00, r01, r02 = 1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy - qw * qz), 2 * (qx * qz + qw * qy)
    r10, r11, r12 = 2 * (qx * qy + qw * qz), 1 - 2 * (qx * qx + qz * qz), 2 * (qy * qz - qw * qx)
    r20, r21, r22 = 2 * (qx * qz - qw * qy), 2 * (qy * qz + qw * qx), 1 - 2 * (qx * qx + qy * qy)
    wx, wy, wz = x[10], x[11], x[12]
    ax, ay, az = x[3] - wind_n[0], x[4] - wind_n[1], x[5] - wind_n[2]  # airspeed v_air = v - wind
    u = r00 * ax + r10 * ay + r20 * az
    v = r01 * ax + r11 * ay + r21 * az
    w = r02 * ax + r12 * ay + r22 * az

    # f and M, body frame
    fx, fy, fz, mx, my, mz = add_rotors(x, u, v, w, body)
    half_rho = 0.5 * body.air_density
    fx -= half_rho * body.drag_area[0] * abs(u) * u
    fy -= half_rho * body.drag_area[1] * abs(v) * v
    fz -= half_rho * body.drag_area[2] * abs(w) * w
    if x[2] > body.ground - 2.0 * abs(body.contact[0, 2]) - 0.5:
        gx, gy, gz, tx, ty, tz = add_contact(x, anchor, body)  # force in n, torque in b
        fx += r00 * gx + r10 * gy + r20 * gz
        fy += r01 * gx + r11 * gy + r21 * gz
        fz += r02 * gx + r12 * gy + r22 * gz
        mx += tx
        my += ty
        mz += tz

    dx[0], dx[1], dx[2] = x[3], x[4], x[5]
    im = 1.0 / body.mass
    dx[3] = im * (r00 * fx + r01 * fy + r02 * fz)
    dx[4] = im * (r10 * fx + r11 * fy + r12 * fz)
    dx[5] = im * (r20 * fx + r21 * fy + r22 * fz) + body.gravity
    dx[6] = 0.5 * (-qx * wx - qy * wy - qz * wz)
    dx[7] = 0.5 * (qw * wx + qy * wz - qz * wy)
    dx[8] = 0.5 * (qw * wy - qx * wz + qz * wx)
    dx[9] = 0.5 * (qw * wz + qx * wy - qy * wx)
    h, h_dot = 0.0, 0.0
    for i in range(4):
        rise = body.sag * command[i] - x[13 + i]
        dx[13 + i] = rise / (body.tau_up if rise > 0.0 else body.tau_down)
        h += body.rotor_inertia * body.spin[i] * x[13 + i]
        h_dot += body.rotor_inertia * body.spin[i] * dx[13 + i]
    jx, jy, jz = body.inertia[0], body.inertia[1], body.inertia[2]
    hx, hy, hz = jx * wx, jy * wy, jz * wz + h
    dx[10] = (mx - (wy * hz - wz * hy)) / jx
    dx[11] = (my - (wz * hx - wx * hz)) / jy
    dx[12] = (mz - (wx * hy - wy * hx) - h_dot) / jz


@kernel
def step(x, command, wind_n, anchor, body, dt, work):
    """One classical Runge-Kutta step of `dt` seconds in place; the quaternion is normalised after it.

    Parameters
    ----------
    work : (5, 17) scratch.
    """
    half = 0.5 * dt
    xs = work[4]
    derivative(x, command, wind_n, anchor, body, work[0])
    for i in range(17):
        xs[i] = x[i] + half * work[0, i]
    derivative(xs, command, wind_n, anchor, body, work[1])
    for i in range(17):
        xs[i] = x[i] + half * work[1, i]
    derivative(xs, command, wind_n, anchor, body, work[2])
    for i in range(17):
        xs[i] = x[i] + dt * work[2, i]
    derivative(xs, command, wind_n, anchor, body, work[3])
    for i in range(17):
        x[i] += dt / 6.0 * (work[0, i] + 2.0 * (work[1, i] + work[2, i]) + work[3, i])
    n = 1.0 / math.sqrt(x[6] * x[6] + x[7] * x[7] + x[8] * x[8] + x[9] * x[9])
    for i in range(6, 10):
        x[i] *= n
