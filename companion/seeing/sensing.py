"""From obstacle messages to scans: rays from where the vehicle was, in the mission frame.

OBSTACLE_DISTANCE is a ring of up to 72 rays [cm]: 65535 is not known, max_distance + 1 free as far as it sees, less
than min_distance too near to tell, which counts as taken there. `increment_f`, when not zero, stands for `increment`.
Body frames turn with the whole attitude, so the ring tilts with the vehicle; a sender that leaves the frame at 0 (real
ones do) means the body's, too (https://mavlink.io/en/messages/common.html#OBSTACLE_DISTANCE).
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from companion.seam import FloatArray
from wire.dialect import mavlink

RING = mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE
POINT = mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE_3D
RANGE = mavlink.MAVLINK_MSG_ID_DISTANCE_SENSOR
SECTORS = 72
UNKNOWN = 65535

_RING = mavlink.MAVLink_obstacle_distance_message.unpacker
_POINT = mavlink.MAVLink_obstacle_distance_3d_message.unpacker
_RANGE = mavlink.MAVLink_distance_sensor_message.unpacker
_LEVEL_YAW = {rotation: math.radians(45.0 * rotation) for rotation in range(8)}
"""MAV_SENSOR_ROTATION_NONE, YAW_45 ... YAW_315: the rangefinders that look around; others look up or down."""


@dataclass(frozen=True, slots=True)
class Scan:
    """Rays from one place.

    Attributes
    ----------
    stamp_us : the sender's clock when it looked; 0: it does not say.
    position_m : (3,) where the rays begin, in the mission frame [m].
    directions : (k, 3) unit vectors, in the mission frame.
    distance : (k,) [m]; infinity is free as far as it sees, NaN not known.
    maximum : as far as it sees [m].
    """

    stamp_us: int
    position_m: FloatArray
    directions: FloatArray
    distance: FloatArray
    maximum: float


def without(scan: Scan, rays: NDArray[np.int64]) -> Scan:
    """The same, with nothing known of some rays (by their numbers)."""
    if not len(rays):
        return scan
    distance = scan.distance.copy()
    distance[rays] = math.nan
    return Scan(scan.stamp_us, scan.position_m, scan.directions, distance, scan.maximum)


def rotation(roll: float, pitch: float, yaw: float) -> FloatArray:
    """R_nb (3, 3) of aerospace angles [rad]: yaw about down, then pitch, then roll."""
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def stamp_of(message_id: int, payload: bytes) -> int:
    """When the sender looked, by its clock [us]: OBSTACLE_DISTANCE's time_usec, the others' time_boot_ms."""
    if message_id == RING:
        return int.from_bytes(payload[:8].ljust(8, b"\0"), "little")
    return 1000 * int.from_bytes(payload[:4].ljust(4, b"\0"), "little")


def scan_of(message_id: int, payload: bytes, position_m: FloatArray, R_nb: FloatArray) -> Scan | None:
    """The scan that a message tells of, seen from a place and attitude; None when there is none in it."""
    match message_id:
        case mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE:
            return ring(payload, position_m, R_nb)
        case mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE_3D:
            return point(payload, position_m, R_nb)
        case mavlink.MAVLINK_MSG_ID_DISTANCE_SENSOR:
            return rangefinder(payload, position_m, R_nb)
    return None


def ring(payload: bytes, position_m: FloatArray, R_nb: FloatArray) -> Scan | None:
    """An OBSTACLE_DISTANCE; None when its sectors have no width or nothing is known in any of them."""
    fields = _unpacked(_RING, payload)
    low, high, _, increment, increment_f, offset, frame = fields[SECTORS + 1 :]
    width = increment_f if increment_f != 0.0 else float(increment)
    if not (math.isfinite(width) and width != 0.0 and math.isfinite(offset)) or not 0 < high < UNKNOWN:
        return None
    count = min(SECTORS, max(1, round(360.0 / abs(width))))
    said = np.array(fields[1 : 1 + count], dtype=np.float64)
    known = said != UNKNOWN
    if not known.any():
        return None
    distance = np.maximum(said, low) / 100.0
    distance[said > high] = math.inf
    distance[~known] = math.nan
    bearing = np.radians(offset + width * np.arange(count))
    directions = np.column_stack((np.cos(bearing), np.sin(bearing), np.zeros(count)))
    if frame == mavlink.MAV_FRAME_LOCAL_FRD:  # level, ahead is where the nose points
        directions = directions @ rotation(0.0, 0.0, math.atan2(R_nb[1, 0], R_nb[0, 0])).T
    elif frame != mavlink.MAV_FRAME_LOCAL_NED:
        directions = directions @ R_nb.T
    return Scan(stamp_of(RING, payload), position_m, directions, distance, high / 100.0)


def point(payload: bytes, position_m: FloatArray, R_nb: FloatArray) -> Scan | None:
    """An OBSTACLE_DISTANCE_3D: one point, in the body's frame or in local NED; None when it is none."""
    _, x, y, z, low, high, _, _, frame = _unpacked(_POINT, payload)
    offset = np.array([x, y, z])
    distance = float(np.linalg.norm(offset))
    if not (math.isfinite(distance) and 0.0 < distance <= high and low >= 0.0):
        return None
    direction = offset / distance
    if frame != mavlink.MAV_FRAME_LOCAL_NED:
        direction = R_nb @ direction
    stamp = stamp_of(POINT, payload)
    return Scan(stamp, position_m, direction[None], np.array([max(distance, low)]), float(high))


def rangefinder(payload: bytes, position_m: FloatArray, R_nb: FloatArray) -> Scan | None:
    """A DISTANCE_SENSOR that looks around; None for one that looks up or down."""
    fields = _unpacked(_RANGE, payload)
    low, high, said, orientation = fields[1], fields[2], fields[3], fields[6]
    yaw = _LEVEL_YAW.get(orientation)
    if yaw is None or not high > 0:
        return None
    direction = R_nb @ np.array([math.cos(yaw), math.sin(yaw), 0.0])
    distance = math.inf if said > high else max(said, low) / 100.0
    return Scan(stamp_of(RANGE, payload), position_m, direction[None], np.array([distance]), high / 100.0)


def _unpacked(struct: Any, payload: bytes) -> Any:
    return struct.unpack(payload[: struct.size].ljust(struct.size, b"\0"))
