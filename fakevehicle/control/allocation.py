# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""From three torques and a thrust to four rotor speeds, giving up the least important axis first.

Rotor thrusts are linear in the demand, T_i = mix_i . (tau_x, tau_y, tau_z, T), and each must lie in [T_min, T_max].
Priority: roll and pitch, then total thrust, then yaw. A demand that every rotor can meet is met as it is; that is
almost always so. Otherwise, with r_i what rotor i gives for roll and pitch and c_i > 0 its share of the thrust (1/4
where the centre of mass is in the middle), T_i = c_i T + s r_i is within the limits for some T when for all i and j

    T_min/c_i - T_max/c_j <= s (r_i/c_i - r_j/c_j)

so s is the largest up to 1 that is, T the nearest that s leaves, and yaw gets the largest share that both leave.
T_max is what the rotors reach on the voltage there is, as far as the mixer's speeds are raised against it (`boost`).
(The paper's equation 24 has one sign pattern for three axes and cannot be inverted; `Airframe.allocation` is the
standard one.)
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
    command : (4,) rotor speeds, written [rad/s]; not raised by `boost` yet.
    pushed : (4,) achieved less demanded (tau_x, tau_y, tau_z, T), written; zero on an axis that got what it wanted.

    Returns
    -------
    True when something had to be given up.
    """
    mix = body.mix
    top = body.speed_max / body.boost
    low, high = body.k * body.speed_idle * body.speed_idle, body.k * top * top
    fits = True
    for i in range(4):
        part = mix[i, 3] * thrust + (mix[i, 0] * torque_x + mix[i, 1] * torque_y) + mix[i, 2] * torque_z
        fits = fits and low <= part <= high
        command[i] = part
    tilt_share, yaw_share, total = 1.0, 1.0, thrust
    if not fits:
        tilt_share, total, yaw_share = give_up(mix, low, high, torque_x, torque_y, torque_z, thrust)
        for i in range(4):
            tilt = tilt_share * (mix[i, 0] * torque_x + mix[i, 1] * torque_y)
            command[i] = min(max(mix[i, 3] * total + tilt + yaw_share * mix[i, 2] * torque_z, low), high)
    for i in range(4):
        command[i] = math.sqrt(command[i] / body.k)
    pushed[0] = (tilt_share - 1.0) * torque_x
    pushed[1] = (tilt_share - 1.0) * torque_y
    pushed[2] = (yaw_share - 1.0) * torque_z
    pushed[3] = total - thrust
    return tilt_share < 1.0 or yaw_share < 1.0 or total != thrust


@kernel
def give_up(mix, low, high, torque_x, torque_y, torque_z, thrust):
    """What is kept of a demand that does not fit: share of roll and pitch, thrust [N], share of yaw.

    Parameters
    ----------
    mix : (4, 4) of `airframe.BODY`.
    low, high : T_min and T_max [N].
    torque_x, torque_y, torque_z, thrust : as of `allocate`.
    """
    tilt_share = 1.0
    for i in range(4):
        steep = (mix[i, 0] * torque_x + mix[i, 1] * torque_y) / mix[i, 3]
        for j in range(4):
            spread = (mix[j, 0] * torque_x + mix[j, 1] * torque_y) / mix[j, 3] - steep
            room = high / mix[j, 3] - low / mix[i, 3]
            if spread > room:
                tilt_share = min(tilt_share, max(room, 0.0) / spread)
    least, most = -math.inf, math.inf
    for i in range(4):
        tilt = tilt_share * (mix[i, 0] * torque_x + mix[i, 1] * torque_y)
        least = max(least, (low - tilt) / mix[i, 3])
        most = min(most, (high - tilt) / mix[i, 3])
    total = min(max(thrust, least), most)
    yaw_share = 1.0
    for i in range(4):
        base = mix[i, 3] * total + tilt_share * (mix[i, 0] * torque_x + mix[i, 1] * torque_y)
        yaw = mix[i, 2] * torque_z
        if yaw > 0.0 and base + yaw > high:
            yaw_share = min(yaw_share, max(high - base, 0.0) / yaw)
        elif yaw < 0.0 and base + yaw < low:
            yaw_share = min(yaw_share, max(base - low, 0.0) / -yaw)
    return tilt_share, total, yaw_share
