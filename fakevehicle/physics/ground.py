# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""The ground: a flat plane, four feet on springs, Coulomb friction that really holds.

A vehicle that leans further than `LEANING` may also touch it with its rotors' hubs, four more points on such springs:
it comes to lie on its side or its back, and not in the ground.

Normal force of a foot at depth d: N = max(0, k d + c d'). Along the plane each foot hangs on a spring between itself
and its anchor, the point where it holds; when that spring would pull harder than mu N the foot slips and the anchor
follows. A smoothed Coulomb law would creep; this one stands still.
"""

import math

from fakevehicle.jit import kernel

FEET, POINTS = 4, 8
"""The feet come first; the points after them are the rotors' hubs."""
LEANING = 0.9
"""Cosine of the tilt below which the hubs are looked at."""


@kernel
def points(x, anchor):
    """How many points of the vehicle may touch the ground as it stands now; as many as have an anchor at most."""
    level = 1.0 - 2.0 * (x[7] * x[7] + x[8] * x[8])
    return FEET if level > LEANING else anchor.shape[0]


@kernel
def foot_force(x, i, anchor, body):
    """Force of the ground on foot (or hub) `i` in n and where it is.

    Returns
    -------
    fx, fy, fz : [N] in n (z down: a push up is negative).
    rx, ry, rz : the foot relative to the centre of mass, in n [m].
    slip : share of the tangential force that friction lets through, 1 when the foot holds, < 1 when it slips,
           negative when the foot is in the air.
    """
    qw, qx, qy, qz = x[6], x[7], x[8], x[9]
    bx, by, bz = body.contact[i, 0], body.contact[i, 1], body.contact[i, 2]
    rx = (1 - 2 * (qy * qy + qz * qz)) * bx + 2 * (qx * qy - qw * qz) * by + 2 * (qx * qz + qw * qy) * bz
    ry = 2 * (qx * qy + qw * qz) * bx + (1 - 2 * (qx * qx + qz * qz)) * by + 2 * (qy * qz - qw * qx) * bz
    rz = 2 * (qx * qz - qw * qy) * bx + 2 * (qy * qz + qw * qx) * by + (1 - 2 * (qx * qx + qy * qy)) * bz
    depth = x[2] + rz - body.ground
    if depth <= 0.0:
        return 0.0, 0.0, 0.0, rx, ry, rz, -1.0
    # velocity of the foot in n: v + R (omega x r_b)
    cx, cy, cz = x[11] * bz - x[12] * by, x[12] * bx - x[10] * bz, x[10] * by - x[11] * bx
    vx = x[3] + (1 - 2 * (qy * qy + qz * qz)) * cx + 2 * (qx * qy - qw * qz) * cy + 2 * (qx * qz + qw * qy) * cz
    vy = x[4] + 2 * (qx * qy + qw * qz) * cx + (1 - 2 * (qx * qx + qz * qz)) * cy + 2 * (qy * qz - qw * qx) * cz
    vz = x[5] + 2 * (qx * qz - qw * qy) * cx + 2 * (qy * qz + qw * qx) * cy + (1 - 2 * (qx * qx + qy * qy)) * cz
    normal = max(0.0, body.stiffness * depth + body.damping * vz)
    fx = -body.stiffness * (x[0] + rx - anchor[i, 0]) - body.damping * vx
    fy = -body.stiffness * (x[1] + ry - anchor[i, 1]) - body.damping * vy
    pull = math.sqrt(fx * fx + fy * fy)
    hold = body.friction * normal
    slip = 1.0
    if pull > hold:
        slip = hold / pull
        fx *= slip
        fy *= slip
    return fx, fy, -normal, rx, ry, rz, slip


@kernel
def add_contact(x, anchor, body):
    """Ground force in n [N] and its torque in b [N m], summed over the feet: fx, fy, fz, tx, ty, tz."""
    fx, fy, fz, mx, my, mz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(points(x, anchor)):
        gx, gy, gz, rx, ry, rz, slip = foot_force(x, i, anchor, body)
        if slip >= 0.0:
            fx += gx
            fy += gy
            fz += gz
            mx += ry * gz - rz * gy
            my += rz * gx - rx * gz
            mz += rx * gy - ry * gx
    qw, qx, qy, qz = x[6], x[7], x[8], x[9]
    tx = (1 - 2 * (qy * qy + qz * qz)) * mx + 2 * (qx * qy + qw * qz) * my + 2 * (qx * qz - qw * qy) * mz
    ty = 2 * (qx * qy - qw * qz) * mx + (1 - 2 * (qx * qx + qz * qz)) * my + 2 * (qy * qz + qw * qx) * mz
    tz = 2 * (qx * qz + qw * qy) * mx + 2 * (qy * qz - qw * qx) * my + (1 - 2 * (qx * qx + qy * qy)) * mz
    return fx, fy, fz, tx, ty, tz


@kernel
def settle(x, anchor, body):
    """Move the anchors of feet that slip or hang in the air, after every step. Returns whether any foot touches."""
    touches = False
    for i in range(points(x, anchor)):
        fx, fy, _, rx, ry, _, slip = foot_force(x, i, anchor, body)
        if slip < 0.0:
            anchor[i, 0] = x[0] + rx
            anchor[i, 1] = x[1] + ry
        else:
            touches = True
            if slip < 1.0:  # the spring gives way until it pulls just mu N
                anchor[i, 0] = x[0] + rx + fx / body.stiffness
                anchor[i, 1] = x[1] + ry + fy / body.stiffness
    return touches
