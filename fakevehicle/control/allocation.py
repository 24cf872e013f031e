# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""From three torques and a thrust to four rotor speeds, giving up the least important axis first.

Rotor thrusts are linear in the demand, T_i = mix_i . (tau_x, tau_y, tau_z, T), and each must lie in [T_min, T_max].
Priority: roll and pitch, then total thrust, then yaw. (The paper's equation 24 has one sign pattern for three axes and
cannot be inverted; `Airframe.allocation` is the standard one.)
"""

import math

from fakevehicle.jit import kernel


@kernel
def allocate(body, torque_x, torque_y, torque_z, thrust, command, pushed):
    """Rotor speed setpoints that come as close to the demand as the rotors allow.

    Parameters
    ----------
    body : record of `airframe.BODY`.
    torque_x, torque_y, torque_z : in b [N m].
    thrust : total, along -z_b [N].
    command : (4,) rotor speeds, written [rad/s].
    pushed : (4,) achieved less demanded (tau_x, tau_y, tau_z, T), written; zero on an axis that got what it wanted.

    Returns
    -------
    True when something had to be given up.
    """
    low = body.k * body.speed_idle * body.speed_idle
    high = body.k * body.speed_max * body.speed_max
    room = high - low
    # roll and pitch: their spread must fit between T_min and T_max
    least, most = 0.0, 0.0
    for i in range(4):
        part = body.mix[i, 0] * torque_x + body.mix[i, 1] * torque_y
        least = min(least, part)
        most = max(most, part)
    tilt_share = 1.0
    if most - least > room:
        tilt_share = room / (most - least)
    least *= tilt_share
    most *= tilt_share
    # thrust: the common part must leave room for them
    common = body.mix[0, 3] * thrust
    common_sat = min(max(common, low - least), high - most)
    # yaw: whatever is left
    yaw_share = 1.0
    for i in range(4):
        base = common_sat + tilt_share * (body.mix[i, 0] * torque_x + body.mix[i, 1] * torque_y)
        yaw = body.mix[i, 2] * torque_z
        if yaw > 0.0 and base + yaw > high:
            yaw_share = min(yaw_share, max(high - base, 0.0) / yaw)
        elif yaw < 0.0 and base + yaw < low:
            yaw_share = min(yaw_share, max(base - low, 0.0) / -yaw)
    for i in range(4):
        part = common_sat + tilt_share * (body.mix[i, 0] * torque_x + body.mix[i, 1] * torque_y)
        part += yaw_share * body.mix[i, 2] * torque_z
        command[i] = math.sqrt(min(max(part, low), high) / body.k)
    pushed[0] = (tilt_share - 1.0) * torque_x
    pushed[1] = (tilt_share - 1.0) * torque_y
    pushed[2] = (yaw_share - 1.0) * torque_z
    pushed[3] = (common_sat - common) / body.mix[0, 3] if common_sat != common else 0.0
    return tilt_share < 1.0 or yaw_share < 1.0 or common_sat != common
