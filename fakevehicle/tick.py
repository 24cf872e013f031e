# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""One tick of the vehicle without its estimator: 4 ms of loops, physics and IMU in a single compiled call.

Order: outer loops once on the newest estimate; then four times: gyro sample, rate loop and mixer, one RK4 step of 1 ms
under those rotor commands, feet, IMU sums; then wind and IMU biases move on.
"""

import math

from fakevehicle.control.cascade import outer_loops, rate_loop
from fakevehicle.jit import kernel
from fakevehicle.physics.dynamics import step
from fakevehicle.physics.ground import settle
from fakevehicle.physics.wind import gust_step
from fakevehicle.sensors.imu import integrate_imu, read_gyro, walk_biases

SUBSTEPS = 4
DT = 0.001
RESTING, IDLE, FLYING = 0, 1, 2
"""What the motors do: nothing, turn slowly, obey the loops."""
DRAWS = 4 * 6 + 6 + 3
"""Normal draws one tick takes: IMU noise, bias walks, gusts."""


@kernel
def advance(
    motors,
    setpoint,
    nav,
    bias,
    noise,
    x,
    work,
    anchor,
    wind,
    turbulence,
    body_,
    gains_,
    status_,
    bank,
    coefficients,
    states,
    imu_,
):
    """Advance everything by one tick.

    Parameters
    ----------
    motors : RESTING, IDLE or FLYING.
    setpoint : (11,) and nav : (16,), see `control.cascade`.
    bias : (3,) gyro bias the estimator believes in [rad/s].
    noise : (DRAWS,) standard normal draws.
    x : (17,) state, in place.  work : (6, 17) scratch.  anchor : (4, 3) feet.
    wind : (3, 3) steady wind, gust, their sum [m/s].  turbulence : W20 [m/s], 0 is calm.
    body_, gains_, status_, imu_ : (1,) of `airframe.BODY`, `cascade.GAINS`, `cascade.LOOPS`, `imu.IMU`.
    bank, coefficients, states : of the `LoopBank`.

    Returns
    -------
    Whether a foot touches the ground.
    """
    body, gains, status, imu = body_[0], gains_[0], status_[0], imu_[0]
    if motors == FLYING:
        outer_loops(setpoint, nav, gains, status, body, bank, coefficients, states, SUBSTEPS * DT)
    else:
        speed = body.speed_idle if motors == IDLE else 0.0
        for i in range(4):
            status.command[i] = speed
    for i in range(3):
        imu.gyro_sum[i] = 0.0
        imu.accel_sum[i] = 0.0
    touches = False
    before = work[5]
    for k in range(SUBSTEPS):
        read_gyro(x, imu, noise, 6 * k)
        g = imu.gyro_sample
        if motors == FLYING:
            rate_loop(g[0] - bias[0], g[1] - bias[1], g[2] - bias[2], status, body, bank, coefficients, states)
        else:
            for i in range(3):
                status.gyro[i] += status.gyro_gain * (g[i] - bias[i] - status.gyro[i])
        for i in range(17):
            before[i] = x[i]
        step(x, status.command, wind[2], anchor, body, DT, work)
        if x[2] > body.ground - 2.0 * abs(body.contact[0, 2]) - 0.5:
            touches = settle(x, anchor, body)
        integrate_imu(before, x, body.gravity, DT, imu, noise, 6 * k)
    walk_biases(imu, noise, 6 * SUBSTEPS)
    if turbulence > 0.0:
        ax, ay, az = x[3] - wind[0, 0], x[4] - wind[0, 1], x[5] - wind[0, 2]
        airspeed = math.sqrt(ax * ax + ay * ay + az * az)
        gust_step(wind[1], turbulence, body.ground - x[2], airspeed, SUBSTEPS * DT, noise[6 * SUBSTEPS + 6 :])
    else:
        for i in range(3):
            wind[1, i] = 0.0
    for i in range(3):
        wind[2, i] = wind[0, i] + wind[1, i]
    return touches
