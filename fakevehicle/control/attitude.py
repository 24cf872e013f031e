# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""Attitude, body rates and thrust asked for directly, past the position and velocity loops.

    q_e = q^-1 q_sp,    omega_sp = 2 P sgn(q_e,w) q_e,xyz + omega_ff

(the full attitude law of Brescianini, Hehn & D'Andrea 2013, eq. 20; the gains P are the cascade's, an axis each). With
rates alone there is no attitude error and omega_sp is what was asked for. Thrust is a share of what all rotors at full
speed give, whatever the tilt.
"""

import math

from fakevehicle.jit import kernel


@kernel
def follow_attitude(setpoint, nav, gains, status):
    """Write body rates and thrust into `status`, as `cascade.outer_loops` does.

    Parameters
    ----------
    setpoint : (SETPOINT,) of which attitude 11:15 (wxyz, NaN: not asked for), body rates 15:18 [rad/s] and thrust 18
        (0..1 of the maximum, a number) are followed.
    nav : (NAVIGATION,) the estimate.
    gains, status : records of `cascade.GAINS` and `cascade.LOOPS`.
    """
    sp = status.followed
    sp[0:11] = math.nan
    sp[11:19] = setpoint[11:19]
    status.asked[:] = math.nan
    status.shift[:] = 0.0
    qw, qx, qy, qz = nav[6], nav[7], nav[8], nav[9]
    dw, dx, dy, dz = qw, qx, qy, qz
    if not math.isnan(setpoint[11]):
        dw, dx, dy, dz = setpoint[11], setpoint[12], setpoint[13], setpoint[14]
    status.q_sp[0], status.q_sp[1], status.q_sp[2], status.q_sp[3] = dw, dx, dy, dz
    # q_e = q^-1 q_sp
    ew = qw * dw + qx * dx + qy * dy + qz * dz
    ex = qw * dx - qx * dw - qy * dz + qz * dy
    ey = qw * dy + qx * dz - qy * dw - qz * dx
    ez = qw * dz - qx * dy + qy * dx - qz * dw
    sign = 2.0 if ew >= 0.0 else -2.0
    error = (ex, ey, ez)
    for i in range(3):
        ahead = setpoint[15 + i]
        rate = sign * gains.attitude_p[i] * error[i] + (0.0 if math.isnan(ahead) else ahead)
        status.rate_sp[i] = min(max(rate, -gains.rate_max[i]), gains.rate_max[i])
    status.yaw = math.atan2(2.0 * (dw * dz + dx * dy), 1.0 - 2.0 * (dy * dy + dz * dz))  # held when this ends
    status.thrust = min(max(setpoint[18] * gains.thrust_full, gains.thrust_min), gains.thrust_max)
