# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""How the loops hang together: position -> velocity -> attitude (250 Hz) -> body rates (1 kHz) -> mixer.

    v_sp = v_ff + P_p e,  e = p_sp - p                   sideways no faster than can be braked, below; limited in speed
    u_ff = a_ff (1 + T s (1 + 1/LEAD))/(1 + T s/LEAD)    ahead by the T that attitude takes to follow
    a_sp = FOPID-TID(v_sp, v; u_ff)                      limited in tilt, then by what the rotors can lift
    thrust direction -z_b = (a_sp - g e3)/|.|, yaw from the setpoint  =>  q_sp;  T = m (g e3 - a_sp) . z_b
    omega_sp = P_q * (tilt error, then yaw error) + yaw-rate feed-forward
    tau = J FOPID-TID(omega_sp, omega) + omega x J omega

Far from the place, P_p e would ask for more braking than the tilt allows, and pass by. From |e| = a/P_p^2 on, where its
slope is that of a constant deceleration a, sqrt(2 a (|e| - a/(2 P_p^2))) takes its place: v^2/2 falls by a per metre.

The attitude law is the reduced one (Brescianini, Hehn & D'Andrea 2013): tilt is corrected along the shortest turn, the
rest of the error is a turn about z_b and gets its own, smaller gain.

A reset of the estimate (`Resets`) is no motion, so the loops must not answer it with one. What they see is the estimate
less the jumps (`shift`), which fade: velocity and yaw with `FADE` seconds, position no faster than `RETURN` m/s. What
is followed stays where it is in the world, and the vehicle goes back to it without a jerk.
"""

import math

import numpy as np

from fakevehicle.control.allocation import allocate
from fakevehicle.control.attitude import follow_attitude
from fakevehicle.control.fopid_tid import fopid_step
from fakevehicle.jit import kernel

VELOCITY, RATE = 0, 3
"""First loop of the bank for velocity (n, e, d) and for body rates (x, y, z)."""

SETPOINT = 19
"""A setpoint as numbers: position 0:3, velocity 3:6, acceleration 6:9, yaw 9, yaw rate 10, attitude 11:15 (wxyz), body
rate 15:18, thrust 18 (0..1 of the maximum); NaN is "not asked for". With a thrust `attitude` follows the last eight."""
NAVIGATION = 16
"""An estimate as numbers: position 0:3, velocity 3:6, q_nb 6:10, omega_b 10:13, acceleration 13:16."""
FADE, RETURN = 1.5, 1.0
"""Time constant [s] and highest speed [m/s] at which a reset fades out of what the loops see."""

LEAD = 4.0
"""By how much a sudden change of the acceleration asked for may overshoot on its way to the attitude loop."""

GAINS = np.dtype(
    [
        ("position_p", "f8", (3,)),
        ("attitude_p", "f8", (3,)),
        ("rate_max", "f8", (3,)),
        ("lead", "f8"),  # T [s]
        ("brake", "f8"),  # a, sideways [m/s^2]
        ("speed_xy", "f8"),
        ("speed_up", "f8"),
        ("speed_down", "f8"),
        ("tan_tilt", "f8"),
        ("thrust_min", "f8"),  # [N]
        ("thrust_max", "f8"),  # [N]
        ("thrust_full", "f8"),  # [N], all rotors at full speed
    ]
)
LOOPS = np.dtype(
    [
        ("yaw", "f8"),  # the yaw that is held [rad]
        ("followed", "f8", (SETPOINT,)),
        ("asked", "f8", (2,)),  # what the lead's low pass remembers of the acceleration asked for; NaN: nothing yet
        ("ahead", "f8", (3,)),  # the acceleration asked for, with the lead [m/s^2]
        ("q_sp", "f8", (4,)),
        ("rate_sp", "f8", (3,)),
        ("thrust", "f8"),  # demanded [N]
        ("pushed_a", "f8", (3,)),  # acceleration achieved less demanded, of the last tick [m/s^2]
        ("pushed_m", "f8", (4,)),  # the mixer's, of the last substep
        ("command", "f8", (4,)),  # rotor speeds [rad/s]
        ("saturated", "f8"),
        ("gyro_gain", "f8"),  # low pass of the gyro: y += gain (x - y)
        ("gyro", "f8", (3,)),
        ("shift", "f8", (7,)),  # jumps of the estimate that the loops do not see yet: position, velocity, yaw
    ]
)


@kernel
def outer_loops(setpoint, nav, gains, status, body, bank, coefficients, states, period):
    """Position, velocity and attitude loops: from a setpoint and an estimate to body rates and thrust in `status`.

    An axis with no position, velocity or acceleration asked for stands still (velocity zero). Where only acceleration
    is asked for the velocity loop rests, and the trim it had found (its integral and tilt terms) goes on being added.

    Parameters
    ----------
    setpoint : (SETPOINT,) in the estimator's frame.
    nav : (NAVIGATION,) the estimate.
    gains, status, body : records of `GAINS`, `LOOPS` and `airframe.BODY`.
    bank, coefficients, states : of a `fopid_tid.LoopBank` with three velocity and three rate loops.
    period : [s].
    """
    if not math.isnan(setpoint[18]):
        follow_attitude(setpoint, nav, gains, status)
        return
    g = body.gravity
    acc0, acc1, acc2 = 0.0, 0.0, 0.0
    sp, shift, asked, ahead = status.followed, status.shift, status.asked, status.ahead
    smooth = period / (period + gains.lead / LEAD)  # backward Euler: exactly T ahead of a ramp
    fade = period / FADE
    for i in range(7):
        lost = fade * shift[i]
        if i < 3:
            lost = min(max(lost, -RETURN * period), RETURN * period)
        shift[i] -= lost
    # position -> velocity
    far = math.hypot(setpoint[0] - nav[0] + shift[0], setpoint[1] - nav[1] + shift[1])
    linear = gains.brake / gains.position_p[0] ** 2 if gains.position_p[0] > 0.0 else math.inf
    brake = 1.0  # NaN compares false: no place, or a place on one axis only, is followed linearly
    if far > linear:
        brake = math.sqrt(2.0 * gains.brake * (far - 0.5 * linear)) / (gains.position_p[0] * far)
    bound = 2.0 * gains.thrust_max / body.mass  # of what the lead looks at
    for i in range(3):
        p, v, a = setpoint[i], setpoint[3 + i], setpoint[6 + i]
        if not math.isnan(p):
            sp[i] = p
            asks = gains.position_p[i] * (p - nav[i] + shift[i])
            sp[3 + i] = (0.0 if math.isnan(v) else v) + (brake * asks if i < 2 else asks)
        elif not math.isnan(v):
            sp[i], sp[3 + i] = math.nan, v
        else:
            sp[i], sp[3 + i] = math.nan, (0.0 if math.isnan(a) else math.nan)
        sp[6 + i] = 0.0 if math.isnan(a) else a
        ahead[i] = sp[6 + i]
        if i < 2:  # height is thrust's, which hardly lags
            if math.isnan(a):
                asked[i] = math.nan  # so that there is no jump when something is asked for again
            else:
                held = min(max(a, -bound), bound)
                if math.isnan(asked[i]):
                    asked[i] = held
                asked[i] += smooth * (held - asked[i])
                ahead[i] += LEAD * (held - asked[i])
    speed = math.hypot(sp[3], sp[4])
    if speed > gains.speed_xy:  # NaN compares false
        sp[3] *= gains.speed_xy / speed
        sp[4] *= gains.speed_xy / speed
    if not math.isnan(sp[5]):
        sp[5] = min(max(sp[5], -gains.speed_up), gains.speed_down)
    # velocity -> acceleration
    for i in range(3):
        j = VELOCITY + i
        if math.isnan(sp[3 + i]):
            a = ahead[i] + bank[j].integral + bank[j].kt * bank[j].t_out  # all of the trim, the tilt term's too
        else:
            a = fopid_step(
                bank, coefficients, states, j, sp[3 + i], nav[3 + i] - shift[3 + i], ahead[i], status.pushed_a[i]
            )
        if i == 0:
            acc0 = a
        elif i == 1:
            acc1 = a
        else:
            acc2 = a
    # limits: height before place, both before speed of turning
    most = gains.thrust_max / body.mass
    lift = min(max(g - acc2, gains.thrust_min / body.mass), 0.95 * most)
    side = math.hypot(acc0, acc1)
    allowed = min(gains.tan_tilt * max(lift, 0.6 * g), math.sqrt(most * most - lift * lift))
    share = allowed / side if side > allowed else 1.0
    status.pushed_a[0] = (share - 1.0) * acc0
    status.pushed_a[1] = (share - 1.0) * acc1
    status.pushed_a[2] = (g - lift) - acc2
    if status.pushed_a[2] == 0.0:  # what the mixer kept for roll and pitch; more thrust is less z
        status.pushed_a[2] = -status.pushed_m[3] / body.mass
    if abs(status.pushed_a[2]) < 1e-9:
        status.pushed_a[2] = 0.0
    acc0 *= share
    acc1 *= share
    # acceleration -> attitude; z_b = -(a_sp - g e3)/|.|
    # with little thrust the same sideways wish would mean a large tilt: wrong in a fast descent, fatal on the ground
    carried = max(lift, 0.6 * g)
    norm = math.sqrt(acc0 * acc0 + acc1 * acc1 + carried * carried)
    zx, zy, zz = -acc0 / norm, -acc1 / norm, carried / norm
    rate = setpoint[10]
    if not math.isnan(setpoint[9]):
        status.yaw = setpoint[9]
    elif not math.isnan(rate):
        turned = status.yaw + rate * period
        status.yaw = math.atan2(math.sin(turned), math.cos(turned))
    sp[9], sp[10] = status.yaw, (0.0 if math.isnan(rate) else rate)
    cy, sy = math.cos(status.yaw), math.sin(status.yaw)
    yx, yy, yz = -zz * sy, zz * cy, zx * sy - zy * cy  # y_b ~ z_b x (cos, sin, 0)
    n = 1.0 / math.sqrt(yx * yx + yy * yy + yz * yz)
    yx, yy, yz = yx * n, yy * n, yz * n
    xx, xy, xz = yy * zz - yz * zy, yz * zx - yx * zz, yx * zy - yy * zx
    # matrix (columns x, y, z) -> quaternion; the tilt limit and a level start keep 1 + trace away from 0 only up to a
    # yaw of 180 deg, so take the largest of the four (Shepperd 1978)
    trace = xx + yy + zz
    if trace > 0.0:
        s = 2.0 * math.sqrt(1.0 + trace)
        dw, dx, dy, dz = 0.25 * s, (yz - zy) / s, (zx - xz) / s, (xy - yx) / s
    elif xx > yy and xx > zz:
        s = 2.0 * math.sqrt(1.0 + xx - yy - zz)
        dw, dx, dy, dz = (yz - zy) / s, 0.25 * s, (xy + yx) / s, (zx + xz) / s
    elif yy > zz:
        s = 2.0 * math.sqrt(1.0 + yy - xx - zz)
        dw, dx, dy, dz = (zx - xz) / s, (xy + yx) / s, 0.25 * s, (yz + zy) / s
    else:
        s = 2.0 * math.sqrt(1.0 + zz - xx - yy)
        dw, dx, dy, dz = (xy - yx) / s, (zx + xz) / s, (yz + zy) / s, 0.25 * s
    status.q_sp[0], status.q_sp[1], status.q_sp[2], status.q_sp[3] = dw, dx, dy, dz
    # attitude error: z_sp seen from b gives the tilt, what remains is a turn about z_b
    qw, qx, qy, qz = nav[6], nav[7], nav[8], nav[9]
    bx = (1 - 2 * (qy * qy + qz * qz)) * zx + 2 * (qx * qy + qw * qz) * zy + 2 * (qx * qz - qw * qy) * zz
    by = 2 * (qx * qy - qw * qz) * zx + (1 - 2 * (qx * qx + qz * qz)) * zy + 2 * (qy * qz + qw * qx) * zz
    ux, uy = 2 * (qx * qz + qw * qy), 2 * (qy * qz - qw * qx)  # z_b now, in n
    uz = 1 - 2 * (qx * qx + qy * qy)
    bz = ux * zx + uy * zy + uz * zz
    half = math.sqrt(max(0.5 * (1.0 + bz), 1e-12))  # cos of half the tilt error
    tx, ty = -by / (2.0 * half), bx / (2.0 * half)  # (z x z_sp) / (2 cos(theta/2)): axis times sin(theta/2)
    # q_red = q * (half, tx, ty, 0);  q_mix = q_red^-1 * q_sp = (cos psi/2, 0, 0, sin psi/2)
    rw, rx = qw * half - qx * tx - qy * ty, qx * half + qw * tx - qz * ty
    ry, rz = qy * half + qw * ty + qz * tx, qz * half + qx * ty - qy * tx
    mw = rw * dw + rx * dx + ry * dy + rz * dz
    mz = rw * dz - rx * dy + ry * dx - rz * dw
    psi = 2.0 * math.atan2(mz, mw) + shift[6]
    if psi > math.pi:
        psi -= 2.0 * math.pi
    elif psi < -math.pi:
        psi += 2.0 * math.pi
    # R^T e3, the axis the yaw rate turns about
    ex, ey, ez = 2 * (qx * qz - qw * qy), 2 * (qy * qz + qw * qx), uz
    turn = sp[10]
    status.rate_sp[0] = 2.0 * gains.attitude_p[0] * tx + ex * turn
    status.rate_sp[1] = 2.0 * gains.attitude_p[1] * ty + ey * turn
    status.rate_sp[2] = gains.attitude_p[2] * psi + ez * turn
    for i in range(3):
        status.rate_sp[i] = min(max(status.rate_sp[i], -gains.rate_max[i]), gains.rate_max[i])
    # thrust along the body as it stands: what gives the wanted lift at this tilt
    along = lift * uz - acc0 * ux - acc1 * uy
    status.thrust = min(max(body.mass * along, gains.thrust_min), gains.thrust_max)


@kernel
def rate_loop(gyro_x, gyro_y, gyro_z, status, body, bank, coefficients, states):
    """Body rates to rotor speeds, written into `status.command`; once a substep.

    Parameters
    ----------
    gyro_x, gyro_y, gyro_z : one gyro sample with its bias removed [rad/s].
    """
    f = status.gyro
    gain = status.gyro_gain
    f[0] += gain * (gyro_x - f[0])
    f[1] += gain * (gyro_y - f[1])
    f[2] += gain * (gyro_z - f[2])
    jx, jy, jz = body.inertia[0], body.inertia[1], body.inertia[2]
    m = status.pushed_m
    ax = fopid_step(bank, coefficients, states, RATE, status.rate_sp[0], f[0], 0.0, m[0] / jx)
    ay = fopid_step(bank, coefficients, states, RATE + 1, status.rate_sp[1], f[1], 0.0, m[1] / jy)
    az = fopid_step(bank, coefficients, states, RATE + 2, status.rate_sp[2], f[2], 0.0, m[2] / jz)
    tx = jx * ax + (jz - jy) * f[1] * f[2]
    ty = jy * ay + (jx - jz) * f[0] * f[2]
    tz = jz * az + (jy - jx) * f[0] * f[1]
    lost = allocate(body, tx, ty, tz, status.thrust, status.command, m)
    status.saturated = 1.0 if lost else 0.0
