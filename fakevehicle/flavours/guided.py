"""ArduCopter's reading of setpoints: whole groups or nothing, and a stop for everything else.

A group (position, velocity, acceleration) counts only when none of its axes is to be ignored. What may be asked for:

    position                          flown to; never times out
    position, velocity (accel.)       followed; the point goes on at that velocity until GUID_TIMEOUT, then rests
    velocity (accel.)                 flown until GUID_TIMEOUT, then a stop
    acceleration                      likewise
    anything else                     a stop: no group at all, position with acceleration alone, forces, other frames,
                                      a number that is none

Frames: LOCAL_NED; LOCAL_OFFSET_NED adds the vehicle's position; BODY_NED and BODY_OFFSET_NED are turned by the heading
at the time of arrival and added to its position. (GCS_MAVLink_Copter.cpp, handle_message_set_position_target_local_ned;
each case is in the recorded flights.) Nothing here knows the vehicle: it is arithmetic on what it is told.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from fakevehicle.vocabulary import FloatArray, Setpoint
from wire.dialect import mavlink

POSITION, VELOCITY, ACCELERATION = 0x007, 0x038, 0x1C0
FORCE, IGNORE_YAW, IGNORE_YAW_RATE = 0x200, 0x400, 0x800
BODY = (mavlink.MAV_FRAME_BODY_NED, mavlink.MAV_FRAME_BODY_OFFSET_NED)
OFFSET = (mavlink.MAV_FRAME_LOCAL_OFFSET_NED, *BODY)
FRAMES = (mavlink.MAV_FRAME_LOCAL_NED, *OFFSET)
LARGEST = 1e5
"""Nothing in a setpoint is larger than this [m, m/s, m/s^2, rad]."""


@dataclass(frozen=True, slots=True)
class Wanted:
    """One message's numbers as sent: (3,) each [m, m/s, m/s^2], yaw [rad], yaw rate [rad/s]; and what to ignore."""

    type_mask: int
    frame: int
    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    yaw: float
    yaw_rate: float


def stop() -> Setpoint:
    """Stand still in the air."""
    return Setpoint(velocity_n=np.zeros(3))


def setpoint_of(wanted: Wanted, here_n: FloatArray, heading: float) -> Setpoint | None:
    """What is to be flown; None: a stop.

    Parameters
    ----------
    wanted : the message.
    here_n : (3,) where the vehicle is, local NED [m].
    heading : its heading [rad].
    """
    mask = wanted.type_mask
    position, velocity, acceleration = (not mask & group for group in (POSITION, VELOCITY, ACCELERATION))
    if wanted.frame not in FRAMES or (mask & FORCE and acceleration):
        return None
    if not (velocity or position or acceleration) or (position and acceleration and not velocity):
        return None
    asked = [wanted.position] * position + [wanted.velocity] * velocity + [wanted.acceleration] * acceleration
    turns = [v for v, bit in ((wanted.yaw, IGNORE_YAW), (wanted.yaw_rate, IGNORE_YAW_RATE)) if not mask & bit]
    numbers = np.concatenate([*asked, turns])
    if not np.all(np.abs(numbers) <= LARGEST):  # NaN is not below anything
        return None
    c, s = (math.cos(heading), math.sin(heading)) if wanted.frame in BODY else (1.0, 0.0)
    R_nb = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    offset_n = here_n if wanted.frame in OFFSET else np.zeros(3)
    none = np.full(3, math.nan)
    yaw = math.nan if mask & IGNORE_YAW else wanted.yaw + (heading if wanted.frame in BODY else 0.0)
    return Setpoint(
        position_n=R_nb @ wanted.position + offset_n if position else none,
        velocity_n=R_nb @ wanted.velocity if velocity else none,
        acceleration_n=R_nb @ wanted.acceleration if acceleration else none,
        yaw=yaw,
        yaw_rate=math.nan if mask & IGNORE_YAW_RATE else wanted.yaw_rate,
    )


def carried_on(asked: Setpoint, age_s: float, timeout_s: float) -> Setpoint | None:
    """A setpoint with position and velocity `age_s` after it came: the point has gone on, and rests after `timeout_s`.

    None: it has no such pair, and stays what it is.
    """
    if math.isnan(float(asked.position_n[0])) or math.isnan(float(asked.velocity_n[0])):
        return None
    moved_n = asked.position_n + asked.velocity_n * min(age_s, timeout_s)
    if age_s < timeout_s:
        return replace(asked, position_n=moved_n)
    return replace(asked, position_n=moved_n, velocity_n=np.zeros(3), acceleration_n=np.zeros(3), yaw_rate=math.nan)
