"""The words every room of the vehicle shares, with units beside the fields.

Frames: n is local NED with its origin at the estimator's (or, for truth, the home) reference point; b is body FRD.
Quaternions are wxyz and `q_nb` takes b-vectors to n. Angles in radians, everything else in SI.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def unused() -> FloatArray:
    """A (3,) vector of NaN: no axis of it is asked for."""
    return np.full(3, np.nan)


def unused_attitude() -> FloatArray:
    """A (4,) quaternion of NaN: no attitude is asked for."""
    return np.full(4, np.nan)


@dataclass(frozen=True, slots=True)
class Geodetic:
    """A point on or above the WGS-84 ellipsoid (altitude above mean sea level, as MAVLink has it)."""

    latitude: float  # [rad]
    longitude: float  # [rad]
    altitude: float  # [m] above mean sea level


@dataclass(frozen=True, slots=True)
class Setpoint:
    """What the control loops follow for one tick. NaN on an axis means: not asked for.

    Where position is given, velocity and acceleration are feed-forward. Where only velocity is given, position floats
    on that axis; where only acceleration is given, velocity floats too. Where `thrust` is given, it and the attitude or
    the body rates are followed instead, and the three vectors in n count for nothing.
    """

    position_n: FloatArray = field(default_factory=unused)  # (3,) [m]
    velocity_n: FloatArray = field(default_factory=unused)  # (3,) [m/s]
    acceleration_n: FloatArray = field(default_factory=unused)  # (3,) [m/s^2], gravity not included
    yaw: float = float("nan")  # [rad], NaN keeps the yaw there was
    yaw_rate: float = float("nan")  # [rad/s]
    attitude_q_nb: FloatArray = field(default_factory=unused_attitude)  # (4,) wxyz
    rate_b: FloatArray = field(default_factory=unused)  # (3,) [rad/s], feed-forward where an attitude is given
    thrust: float = float("nan")  # collective, 0..1 of the maximum


@dataclass(frozen=True, slots=True)
class Resets:
    """Jumps of the estimate that are no motion; the loops let them fade out of what they see.

    `count` says how many there were; the deltas are the newest one's, new less old. While a jump settles, further
    deltas come under the same count.
    """

    count: int = 0
    delta_position_n: FloatArray = field(default_factory=lambda: np.zeros(3))  # (3,) [m]
    delta_velocity_n: FloatArray = field(default_factory=lambda: np.zeros(3))  # (3,) [m/s]
    delta_yaw: float = 0.0  # [rad]


class Glance(NamedTuple):
    """The estimate in a few numbers, cheap enough for every tick: what guards, guidance and most telemetry need.

    A tuple, which is made four times as fast as a frozen dataclass.
    """

    now_us: int
    x: float  # [m] local NED
    y: float
    z: float
    vx: float  # [m/s]
    vy: float
    vz: float
    yaw: float  # [rad]
    thrust: float  # collective the loops ask for, 0..1 of the maximum
    attitude_valid: bool
    velocity_valid: bool
    position_valid: bool
    altitude_valid: bool
    resets: int  # `Resets.count`
    q_nb: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)  # wxyz
    omega_b: tuple[float, float, float] = (0.0, 0.0, 0.0)  # [rad/s], bias removed


@dataclass(frozen=True, slots=True)
class Estimate:
    """What the estimator believes at the newest IMU sample (output of the predictor, not of the delayed filter)."""

    now_us: int
    position_n: FloatArray  # (3,) [m] from `origin`
    velocity_n: FloatArray  # (3,) [m/s]
    acceleration_n: FloatArray  # (3,) [m/s^2], gravity removed
    q_nb: FloatArray  # (4,) wxyz
    omega_b: FloatArray  # (3,) [rad/s], bias removed
    gyro_bias: FloatArray  # (3,) [rad/s]
    accel_bias: FloatArray  # (3,) [m/s^2]
    covariance: FloatArray  # (15, 15) of [dtheta, dv, dp, db_g, db_a]
    test_ratio: dict[str, float]  # sqrt(NIS / gate), above 1 rejected: "gps_position", "gps_velocity", "baro", "mag"
    attitude_valid: bool
    velocity_valid: bool
    position_valid: bool
    altitude_valid: bool
    origin: Geodetic | None  # None until the first fix
    resets: Resets = field(default_factory=Resets)
    climb_valid: bool = False  # the vertical part of the velocity, where the rest is not
    silent: frozenset[str] = frozenset()  # of "gps", "baro", "mag", "imu": not heard, or not believed, lately


class Wind(NamedTuple):
    """The mean horizontal wind as the estimator knows it."""

    north: float  # [m/s], where the air moves to
    east: float
    scatter: float  # 1 sigma of single words about the mean, gusts and sensors' noise together [m/s]
    sigma: float  # of the mean [m/s]


@dataclass(frozen=True, slots=True)
class Truth:
    """What the physics knows; for recordings and tests, never for the loops. Position is from home."""

    now_us: int
    position_n: FloatArray  # (3,) [m]
    velocity_n: FloatArray  # (3,) [m/s]
    acceleration_n: FloatArray  # (3,) [m/s^2] kinematic
    q_nb: FloatArray  # (4,) wxyz
    omega_b: FloatArray  # (3,) [rad/s]
    rotor_speed: FloatArray  # (4,) [rad/s], PX4 order: front-right, rear-left, front-left, rear-right
    wind_n: FloatArray  # (3,) [m/s]
    on_ground: bool


@dataclass(frozen=True, slots=True)
class ImuSample:
    """Mean over one tick."""

    now_us: int
    omega_b: FloatArray  # (3,) [rad/s]
    specific_force_b: FloatArray  # (3,) [m/s^2]


@dataclass(frozen=True, slots=True)
class GpsSample:
    """One fix, as it arrives: `measured_us` is when it was true, `now_us` when it came out of the receiver."""

    now_us: int
    measured_us: int
    position: Geodetic
    velocity_n: FloatArray  # (3,) [m/s]
    eph: float  # [m] horizontal accuracy, 1 sigma
    epv: float  # [m]
    speed_accuracy: float  # [m/s]
    fix_type: int  # MAVLink GPS_FIX_TYPE
    satellites: int


@dataclass(frozen=True, slots=True)
class BaroSample:
    now_us: int
    altitude: float  # [m] above mean sea level, standard atmosphere
    pressure: float  # [Pa]
    temperature: float  # [degC]


@dataclass(frozen=True, slots=True)
class MagSample:
    now_us: int
    field_b: FloatArray  # (3,) [gauss]


@dataclass(frozen=True, slots=True)
class RangeSample:
    """What the downward rangefinder sees."""

    now_us: int
    distance: float  # [m] along z_b; NaN when nothing is within its reach
    minimum: float  # [m]
    maximum: float  # [m]


@dataclass(frozen=True, slots=True)
class ObstacleScan:
    """One round of the obstacle sensor: the nearest thing in each of m directions."""

    now_us: int
    directions_b: FloatArray  # (m, 3) unit vectors
    distance: FloatArray  # (m,) [m]; NaN where nothing is within reach
    minimum: float  # [m]
    maximum: float  # [m]


@dataclass(frozen=True, slots=True)
class ControlStatus:
    """What the loops did in the newest tick, for telemetry and land detection."""

    setpoint: Setpoint  # after defaults: what was really followed
    attitude_setpoint_q_nb: FloatArray  # (4,) wxyz
    rate_setpoint_b: FloatArray  # (3,) [rad/s]
    thrust: float  # collective, 0..1 of the maximum
    motor: FloatArray  # (4,) normalised motor commands 0..1, PX4 order
    saturated: bool  # the mixer had to give something up
