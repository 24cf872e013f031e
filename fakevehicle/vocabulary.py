"""The words every room of the vehicle shares, with units beside the fields.

Frames: n is local NED with its origin at the estimator's (or, for truth, the home) reference point; b is body FRD.
Quaternions are wxyz and `q_nb` takes b-vectors to n. Angles in radians, everything else in SI.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def unused() -> FloatArray:
    """A (3,) vector of NaN: no axis of it is asked for."""
    return np.full(3, np.nan)


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
    on that axis; where only acceleration is given, velocity floats too.
    """

    position_n: FloatArray = field(default_factory=unused)  # (3,) [m]
    velocity_n: FloatArray = field(default_factory=unused)  # (3,) [m/s]
    acceleration_n: FloatArray = field(default_factory=unused)  # (3,) [m/s^2], gravity not included
    yaw: float = float("nan")  # [rad], NaN keeps the yaw there was
    yaw_rate: float = float("nan")  # [rad/s]


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
class ControlStatus:
    """What the loops did in the newest tick, for telemetry and land detection."""

    setpoint: Setpoint  # after defaults: what was really followed
    attitude_setpoint_q_nb: FloatArray  # (4,) wxyz
    rate_setpoint_b: FloatArray  # (3,) [rad/s]
    thrust: float  # collective, 0..1 of the maximum
    motor: FloatArray  # (4,) normalised motor commands 0..1, PX4 order
    saturated: bool  # the mixer had to give something up
