"""From a reference to the SET_POSITION_TARGET_LOCAL_NED that carries it; the only place that builds a type_mask."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from companion.geofence import Geofence
from companion.seam import Reference
from wire.dialect import mavlink

FloatArray = NDArray[np.float64]

IGNORE_POSITION = (
    mavlink.POSITION_TARGET_TYPEMASK_X_IGNORE
    | mavlink.POSITION_TARGET_TYPEMASK_Y_IGNORE
    | mavlink.POSITION_TARGET_TYPEMASK_Z_IGNORE
)
IGNORE_VELOCITY = (
    mavlink.POSITION_TARGET_TYPEMASK_VX_IGNORE
    | mavlink.POSITION_TARGET_TYPEMASK_VY_IGNORE
    | mavlink.POSITION_TARGET_TYPEMASK_VZ_IGNORE
)
IGNORE_ACCELERATION = (
    mavlink.POSITION_TARGET_TYPEMASK_AX_IGNORE
    | mavlink.POSITION_TARGET_TYPEMASK_AY_IGNORE
    | mavlink.POSITION_TARGET_TYPEMASK_AZ_IGNORE
)
IGNORE_YAW = mavlink.POSITION_TARGET_TYPEMASK_YAW_IGNORE
IGNORE_YAW_RATE = mavlink.POSITION_TARGET_TYPEMASK_YAW_RATE_IGNORE


def type_mask(*, position: bool, velocity: bool, acceleration: bool, yaw: bool, yaw_rate: bool) -> int:
    """POSITION_TARGET_TYPEMASK of the fields that are given; its bits mean *ignore*, and bit 9 (force) stays clear."""
    mask = 0
    mask |= 0 if position else IGNORE_POSITION
    mask |= 0 if velocity else IGNORE_VELOCITY
    mask |= 0 if acceleration else IGNORE_ACCELERATION
    mask |= 0 if yaw else IGNORE_YAW
    mask |= 0 if yaw_rate else IGNORE_YAW_RATE
    return mask


FARTHEST = 1e6
"""Nothing we ask for is larger than this in m, m/s, m/s^2 or rad."""

FULL = type_mask(position=True, velocity=True, acceleration=True, yaw=True, yaw_rate=False)
"""Position, velocity, acceleration and yaw: 0x800. Position alone would be input-shaped by the autopilot, and late."""


SPARE = 1.25
"""A reference may ask for so much more than its limits say: a stop begins with the speed the vehicle has."""


def flaw(reference: Reference, fence: Geofence | None, speed: float, acceleration: float) -> str:
    """Why a reference must not be sent, or nothing.

    Parameters
    ----------
    reference : where the vehicle should be, in the mission frame (NED).
    fence : where it may be; None: everywhere.
    speed, acceleration : the most that the mission allows [m/s], [m/s^2].
    """
    numbers = (*reference.position_m, *reference.velocity_m, *reference.acceleration_m, reference.yaw)
    if not all(abs(number) <= FARTHEST for number in numbers):  # false for NaN, too
        return "not a place to fly to"
    if fence is not None and fence.inside(reference.position_m) < 0.0:
        return "outside the fence"
    if math.hypot(*reference.velocity_m) > SPARE * speed:
        return f"faster than {speed:g} m/s"
    if math.hypot(*reference.acceleration_m) > SPARE * acceleration:
        return f"an acceleration above {acceleration:g} m/s^2"
    return ""


def setpoint_message(reference: Reference, origin_n: FloatArray, time_boot_ms: int, target_system: int) -> Any | None:
    """The setpoint of one tick.

    Parameters
    ----------
    reference : where the vehicle should be, in the mission frame (NED).
    origin_n : (3,) the mission frame's origin in the vehicle's local frame [m].
    time_boot_ms : our clock; autopilots do not interpret it.
    target_system : whom it is for (component 1).

    Returns
    -------
    The message, or None when a number is not finite or beyond `FARTHEST`: such a setpoint is never sent.
    """
    p = reference.position_m + origin_n
    v, a = reference.velocity_m, reference.acceleration_m
    if not all(abs(number) <= FARTHEST for number in (*p, *v, *a, reference.yaw)):  # false for NaN, too
        return None
    frame = mavlink.MAV_FRAME_LOCAL_NED
    return mavlink.MAVLink_set_position_target_local_ned_message(
        time_boot_ms & 0xFFFFFFFF, target_system, 1, frame, FULL, *p, *v, *a, reference.yaw, 0.0
    )
