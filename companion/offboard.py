"""From a reference to the SET_POSITION_TARGET_LOCAL_NED that carries it; the only place that builds a type_mask."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

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
