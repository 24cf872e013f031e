# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""Rotor forces and torques in the body frame.

    f_i = a_i (-k G Omega_i^2 e3 - c_d Omega_i v_perp,i)    v_perp,i: in-plane part of v_air + omega x r_i
    M   = sum r_i x f_i - sum s_i kappa a_i k G Omega_i^2 e3

a_i is what is left of a rotor, 1 of a whole one: a torn blade gives less of everything.

G is the ground effect of Cheeseman & Bennett (1955), 1/(1 - (R/4z)^2), z the rotor's height, clipped at z = R/2.
"""

from fakevehicle.jit import kernel


@kernel
def add_rotors(x, u, v, w, body):
    """Sum over the rotors.

    Parameters
    ----------
    x : (17,) state (`dynamics`).
    u, v, w : airspeed of the centre of mass in b [m/s].
    body : record of `airframe.BODY`.

    Returns
    -------
    fx, fy, fz, mx, my, mz : force [N] and torque [N m] in b.
    """
    wx, wy, wz = x[10], x[11], x[12]
    height = max(body.ground - x[2] - body.rotor_position[0, 2], 0.5 * body.radius)
    ratio = body.radius / (4.0 * height)
    k = body.k / (1.0 - ratio * ratio)
    fx, fy, fz, mx, my, mz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(4):
        speed = x[13 + i]
        rx, ry, rz = body.rotor_position[i, 0], body.rotor_position[i, 1], body.rotor_position[i, 2]
        left = body.effect[i]
        thrust = left * k * speed * speed
        drag = left * body.c_d * speed
        gx = -drag * (u + wy * rz - wz * ry)
        gy = -drag * (v + wz * rx - wx * rz)
        gz = -thrust
        fx += gx
        fy += gy
        fz += gz
        mx += ry * gz - rz * gy
        my += rz * gx - rx * gz
        mz += rx * gy - ry * gx - body.spin[i] * body.kappa * thrust
    return fx, fy, fz, mx, my, mz
