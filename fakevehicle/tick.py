# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""One tick of the vehicle, 4 ms of everything that happens at the IMU's rate or above, in a single compiled call.

Order: outer loops once on the newest output of the estimator; then four times: gyro sample, rate loop and mixer, one
RK4 step of 1 ms under those rotor commands, feet, IMU sums; then wind and IMU biases move on, and the estimator's
output is carried to the end of the tick. What is left for Python are the slow sensors and the filter.
"""

import math

import numpy as np

from fakevehicle.airframe import BODY
from fakevehicle.control.cascade import GAINS, LOOPS, SETPOINT, outer_loops, rate_loop
from fakevehicle.control.fopid_tid import LOOP
from fakevehicle.control.fractional import SECTIONS
from fakevehicle.estimator.predictor import PREDICTOR, advance_output
from fakevehicle.jit import kernel
from fakevehicle.physics.dynamics import STATE, step
from fakevehicle.physics.ground import POINTS, settle
from fakevehicle.physics.wind import TURBULENCE, scheduled, turbulence
from fakevehicle.sensors.imu import IMU, integrate_imu, read_gyro, walk_biases

SUBSTEPS = 4
DT = 0.001
RESTING, IDLE, FLYING = 0, 1, 2
"""What the motors do: nothing, turn slowly, obey the loops."""
DRAWS = 4 * 6 + 6
"""Normal draws one tick takes: IMU noise and bias walks."""
TOUCHES, DIVERGED = 1, 2
"""Bits of what `advance` gives back."""

WORLD = np.dtype(
    [
        ("x", "f8", (STATE,)),
        ("work", "f8", (6, STATE)),
        ("velocity_before", "f8", (3,)),  # at the beginning of the tick, in n [m/s]
        ("anchor", "f8", (POINTS, 3)),  # where each foot, or hub, holds the ground
        ("setpoint", "f8", (SETPOINT,)),
        ("thrust", "f8"),  # collective the loops ask for, or the turning motors give, 0..1 of the maximum
        ("effort", "f8"),  # mean of the rotors' (speed / full speed)^3
        ("steady", "f8", (3,)),  # wind without gusts [m/s]
        ("wind", "f8", (3,)),  # all of it
        ("along", "f8", (2,)),  # north and east of the mean wind's direction
        ("turbulence", "f8", (TURBULENCE,)),  # Dryden's states
        ("strength", "f8"),  # W20 [m/s], 0 is calm
    ]
)
"""The simulated world and what is asked of the vehicle in it; one record."""
LOOP_COUNT = 6
VEHICLE = np.dtype(
    [
        ("world", WORLD),
        ("body", BODY),
        ("gains", GAINS),
        ("status", LOOPS),
        ("imu", IMU),
        ("predictor", PREDICTOR),
        ("loops", LOOP, (LOOP_COUNT,)),
        ("coefficients", "f8", (3 * LOOP_COUNT, SECTIONS, 3)),
        ("states", "f8", (3 * LOOP_COUNT, SECTIONS)),
    ]
)
"""Everything a tick works on. Its parts are views for those who own them; the compiled call gets the whole as plain
numbers, since numba takes longer to look at six records than to fly a tick."""


@kernel
def advance(
    motors,
    now,
    row,
    noise_,
    gust_noise_,
    gusts,
    vehicle_,
    samples,
    outputs,
):
    """Advance everything by one tick.

    Parameters
    ----------
    motors : RESTING, IDLE or FLYING.
    now : the tick's end [s].
    noise_ : (n, DRAWS) and gust_noise_ : (n, TURBULENCE) standard normal draws, and which row of them is this tick's.
    gusts : (n, 6), see `wind.gust_table`.
    vehicle_ : a (1,) array of `VEHICLE` seen as f8.
    samples, outputs : the estimator's rings (`predictor`).

    Returns
    -------
    TOUCHES when a foot touches the ground, plus DIVERGED when the state is no longer finite.
    """
    vehicle = vehicle_.view(VEHICLE)[0]
    world, body, imu, predictor = vehicle.world, vehicle.body, vehicle.imu, vehicle.predictor
    gains, status = vehicle.gains, vehicle.status
    bank, coefficients, states = vehicle.loops, vehicle.coefficients, vehicle.states
    x, work, anchor, noise = world.x, world.work, world.anchor, noise_[row]
    bias = predictor.nominal[10:13]
    if motors == FLYING:
        for i in range(SETPOINT):
            if not math.isfinite(world.setpoint[i]):
                world.setpoint[i] = math.nan  # infinity asks for nothing
        outer_loops(world.setpoint, predictor.out, gains, status, body, bank, coefficients, states, SUBSTEPS * DT)
    else:
        speed = body.speed_idle if motors == IDLE else 0.0
        for i in range(4):
            status.command[i] = speed
    for i in range(3):
        imu.gyro_sum[i] = 0.0
        imu.accel_sum[i] = 0.0
        world.velocity_before[i] = x[3 + i]
    touches = False
    before = work[5]
    for k in range(SUBSTEPS):
        read_gyro(x, imu, noise, 6 * k)
        g = imu.gyro_sample
        if motors == FLYING:
            rate_loop(g[0] - bias[0], g[1] - bias[1], g[2] - bias[2], status, body, bank, coefficients, states)
            for i in range(4):
                status.command[i] = min(status.command[i] * body.boost, body.speed_max)
        else:
            for i in range(3):
                status.gyro[i] += status.gyro_gain * (g[i] - bias[i] - status.gyro[i])
        for i in range(STATE):
            before[i] = x[i]
        step(x, status.command, world.wind, anchor, body, DT, work)
        if x[2] > body.ground - 2.0 * abs(body.contact[0, 2]) - 0.5:
            touches = settle(x, anchor, body)
        integrate_imu(before, x, body.gravity, DT, imu, noise, 6 * k)
    walk_biases(imu, noise, 6 * SUBSTEPS)
    blow(world, body, gusts, gust_noise_[row], now)
    rates, forces = imu.gyro_sum, imu.accel_sum
    share = 1.0 / SUBSTEPS
    advance_output(
        predictor,
        samples,
        outputs,
        rates[0] * share,
        rates[1] * share,
        rates[2] * share,
        forces[0] * share,
        forces[1] * share,
        forces[2] * share,
        SUBSTEPS * DT,
        body.gravity,
    )
    told(motors, world, body, gains, status)
    flags = TOUCHES if touches else 0
    return flags if math.isfinite(x[0] + x[3] + x[6] + x[10]) else flags + DIVERGED


@kernel
def told(motors, world, body, gains, status):
    """What others want to know of the motors: `world.thrust` and `world.effort`."""
    squares, cubes = 0.0, 0.0
    for i in range(4):
        asked, turns = status.command[i] / body.speed_max, world.x[13 + i] / body.speed_max
        squares += asked * asked
        cubes += turns * turns * turns
    world.thrust = status.thrust / gains.thrust_full if motors == FLYING else 0.25 * squares
    world.effort = 0.25 * cubes


@kernel
def blow(world, body, gusts, noise, now):
    """The wind of the next tick: steady, scheduled and turbulent parts, into `world.wind`."""
    x, wind = world.x, world.wind
    for i in range(3):
        wind[i] = world.steady[i]
    if world.strength > 0.0:
        ax, ay, az = x[3] - wind[0], x[4] - wind[1], x[5] - wind[2]
        airspeed = math.sqrt(ax * ax + ay * ay + az * az)
        u, v, w = turbulence(world.turbulence, world.strength, body.ground - x[2], airspeed, SUBSTEPS * DT, noise)
        c, s = world.along[0], world.along[1]
        wind[0] += c * u - s * v
        wind[1] += s * u + c * v
        wind[2] += w
    else:
        for i in range(TURBULENCE):
            world.turbulence[i] = 0.0
    scheduled(gusts, now, wind)
