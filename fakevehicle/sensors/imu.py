# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""Gyro and accelerometer at 1 kHz: white noise, a bias that walks, saturation.

    gyro  = omega_b + b_g + n_g          accel = R^T (v' - g e3) + b_a + n_a

The specific force of a substep is taken from the change of velocity over it, turned by the attitude in its middle, so
that summing the samples gives back the true change. Noise parameters are those of the 250 Hz mean of four samples.
Biases walk, and when asked for they wander too (bias instability, a first-order Gauss-Markov process, `Instability`).

Rotors shake the frame: each adds, at its own frequency, a circling force of out-of-balance blades (x and y) and at
twice that one along z from two blades passing the arm. Sizes are given at hover and grow with the square of the speed.

Faults act on the samples before they are clipped: see `set_faults`.
"""

import math
from typing import Any

import numpy as np

from fakevehicle.faults import FaultKind, FaultSchedule, Sensor, spread
from fakevehicle.jit import kernel
from fakevehicle.vocabulary import FloatArray

Record = np.ndarray[Any, np.dtype[np.void]]

IMU = np.dtype(
    [
        ("gyro_noise", "f8"),  # 1 sigma of one 1 kHz sample [rad/s]
        ("accel_noise", "f8"),  # [m/s^2]
        ("gyro_walk", "f8"),  # 1 sigma of the bias's step per tick [rad/s]
        ("accel_walk", "f8"),
        ("gyro_bias", "f8", (3,)),
        ("accel_bias", "f8", (3,)),
        ("gyro_sample", "f8", (3,)),  # newest 1 kHz sample
        ("gyro_sum", "f8", (3,)),
        ("accel_sum", "f8", (3,)),
        ("rates", "f8", (3,)),  # newest samples of the sums
        ("forces", "f8", (3,)),
        ("vibration", "f8"),  # amplitude in the rotors' plane at 1 rad/s of one rotor [m/s^2 / (rad/s)^2]
        ("phase", "f8", (4,)),  # of each rotor [rad]
        ("faulty", "i8"),  # whether anything below is at work
        ("stuck", "i8", (2,)),  # gyro, accelerometer: 1 gives the last sample for ever
        ("late", "i8", (2,)),  # samples by which they are late
        ("offset", "f8", (6,)),  # fault's bias of gyro and accelerometer
        ("held", "f8", (9,)),  # what came out last: gyro sample, gyro and force of the sums
        ("past", "f8", (64, 9)),  # what should have come out since the fault began
        ("filled", "i8", (2,)),  # rows of it in use: of the gyro sample, of the sums
    ]
)
GYRO_RANGE = math.radians(2000.0)
ACCEL_RANGE = 16.0 * 9.80665
DRAWS = 6
"""Normal draws of one substep; a tick needs six more for the bias walks."""
LONGEST_DELAY = 63
"""A sample can be late by as many substeps."""


@kernel
def disturb(imu, row, first, device, turn):
    """Three numbers of `imu.held[first:]` become what the faulty `device` (0 gyro, 1 accelerometer) says.

    Parameters
    ----------
    row : (3,) what it should say, in place.
    first : where in `held` and `past`.
    turn : samples so far of this kind since the fault began.
    """
    for i in range(3):
        true = row[i] + imu.offset[3 * device + i]
        imu.past[turn % 64, first + i] = true
        late = min(imu.late[device], turn)
        said = imu.past[(turn - late) % 64, first + i]
        if imu.stuck[device] != 0:
            said = imu.held[first + i]
        imu.held[first + i] = said
        row[i] = said


@kernel
def read_gyro(x, imu, noise, first):
    """The gyro sample at the beginning of a substep, into `imu.gyro_sample`; noise draws first..first+2."""
    for i in range(3):
        imu.gyro_sample[i] = x[10 + i] + imu.gyro_bias[i] + imu.gyro_noise * noise[first + i]
    if imu.faulty != 0:
        disturb(imu, imu.gyro_sample, 0, 0, imu.filled[0])
        imu.filled[0] += 1
    for i in range(3):
        imu.gyro_sample[i] = min(max(imu.gyro_sample[i], -GYRO_RANGE), GYRO_RANGE)


@kernel
def integrate_imu(before, x, gravity, dt, imu, noise, first):
    """Add one substep to the tick's sums.

    Parameters
    ----------
    before, x : (17,) state at the substep's beginning and end.
    gravity : [m/s^2].
    dt : length of the substep [s].
    noise, first : normal draws and where this substep's six begin (the gyro's three are the ones `read_gyro` used).
    """
    fx, fy, fz = (x[3] - before[3]) / dt, (x[4] - before[4]) / dt, (x[5] - before[5]) / dt - gravity
    qw, qx, qy, qz = before[6] + x[6], before[7] + x[7], before[8] + x[8], before[9] + x[9]
    n = 1.0 / math.sqrt(qw * qw + qx * qx + qy * qy + qz * qz)
    qw, qx, qy, qz = qw * n, qx * n, qy * n, qz * n
    ax = (1 - 2 * (qy * qy + qz * qz)) * fx + 2 * (qx * qy + qw * qz) * fy + 2 * (qx * qz - qw * qy) * fz
    ay = 2 * (qx * qy - qw * qz) * fx + (1 - 2 * (qx * qx + qz * qz)) * fy + 2 * (qy * qz + qw * qx) * fz
    az = 2 * (qx * qz + qw * qy) * fx + 2 * (qy * qz - qw * qx) * fy + (1 - 2 * (qx * qx + qy * qy)) * fz
    if imu.vibration > 0.0:
        for i in range(4):
            phase = imu.phase[i] + dt * x[13 + i]
            imu.phase[i] = phase % (2.0 * math.pi)
            size = imu.vibration * x[13 + i] * x[13 + i]
            c, s = math.cos(phase), math.sin(phase)
            ax += size * c
            ay += size * s
            az += 2.0 * size * s * c
    rates, forces = imu.rates, imu.forces
    for i in range(3):
        rates[i] = 0.5 * (before[10 + i] + x[10 + i]) + imu.gyro_bias[i] + imu.gyro_noise * noise[first + i]
        force = ax if i == 0 else ay if i == 1 else az
        forces[i] = force + (imu.accel_bias[i] + imu.accel_noise * noise[first + 3 + i])
    if imu.faulty != 0:
        disturb(imu, rates, 3, 0, imu.filled[1])
        disturb(imu, forces, 6, 1, imu.filled[1])
        imu.filled[1] += 1
    for i in range(3):
        imu.gyro_sum[i] += min(max(rates[i], -GYRO_RANGE), GYRO_RANGE)
        imu.accel_sum[i] += min(max(forces[i], -ACCEL_RANGE), ACCEL_RANGE)


@kernel
def walk_biases(imu, noise, first):
    """One tick of the biases' random walks; six draws from `first`."""
    for i in range(3):
        imu.gyro_bias[i] += imu.gyro_walk * noise[first + i]
        imu.accel_bias[i] += imu.accel_walk * noise[first + 3 + i]


class Instability:
    """Bias instability: first-order Gauss-Markov wander of the biases, added to them in steps of `period_s`.

    Parameters
    ----------
    rng : of its own.
    period_s : spacing of `step` [s].

    Attributes
    ----------
    gyro, accel : 1 sigma in the long run [rad/s], [m/s^2].
    """

    TIME = 200.0
    """In which it forgets [s]."""

    def __init__(self, rng: np.random.Generator, period_s: float) -> None:
        self._rng, self._keep = rng, math.exp(-period_s / self.TIME)
        self.gyro = self.accel = 0.0
        self._wandered: FloatArray = np.zeros(6)

    def step(self, imu: Record) -> None:
        """Move the biases of the (1,) record of `IMU` on. Six draws, none while both are 0."""
        if self.gyro == 0.0 and self.accel == 0.0:
            return
        share = math.sqrt(1.0 - self._keep * self._keep)
        wandered = self._keep * self._wandered + share * self._rng.standard_normal(6)
        moved = wandered - self._wandered
        self._wandered = wandered
        imu["gyro_bias"][0] += self.gyro * moved[:3]
        imu["accel_bias"][0] += self.accel * moved[3:]


def set_faults(imu: Record, schedule: FaultSchedule, now_us: int, noises: tuple[float, float]) -> None:
    """Tell the (1,) record of `IMU` which faults of gyro and accelerometer hold from now on.

    OFF and STUCK are one: a driver that gets nothing goes on with the last sample. NOISE makes the white noise larger.

    Parameters
    ----------
    noises : 1 sigma of the healthy gyro's and accelerometer's 1 kHz samples.
    """
    record, faulty = imu[0], False
    record["stuck"] = record["late"] = 0
    record["offset"] = 0.0
    for device, sensor, name in ((0, Sensor.GYRO, "gyro_noise"), (1, Sensor.ACCEL, "accel_noise")):
        noise = noises[device]
        for fault in schedule.active(sensor, now_us):
            faulty = True
            match fault.kind:
                case FaultKind.OFF | FaultKind.STUCK:
                    record["stuck"][device] = 1
                case FaultKind.BIAS:
                    record["offset"][3 * device : 3 * device + 3] += spread(fault.magnitude, 3)
                case FaultKind.NOISE:
                    noise = math.hypot(noise, 2.0 * fault.magnitude[0])  # as that of a 250 Hz sample is given
                case FaultKind.DELAY:
                    record["late"][device] = min(round(1e3 * fault.magnitude[0]), LONGEST_DELAY)
        record[name] = noise
    if not faulty:
        record["filled"] = 0
    elif not record["faulty"]:  # what is held until something comes: the newest samples
        record["held"][:3], record["held"][3:6], record["held"][6:] = (
            record["gyro_sample"],
            record["rates"],
            record["forces"],
        )
    record["faulty"] = faulty
