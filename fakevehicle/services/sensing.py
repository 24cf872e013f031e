"""What rangefinder and obstacle sensor see, on MAVLink: DISTANCE_SENSOR, OBSTACLE_DISTANCE, OBSTACLE_DISTANCE_3D.

A distance that is not there is told as the messages want it: DISTANCE_SENSOR one centimetre past its reach,
OBSTACLE_DISTANCE likewise in each of its 72 sectors (65535 would mean that nobody looked).
"""

import math

import numpy as np

from fakevehicle.codec import Message
from fakevehicle.flight import FlightStack
from fakevehicle.sensors.obstacles import SECTORS
from fakevehicle.services.service import Builder, Service
from wire.dialect import mavlink

_PITCH_270 = 25  # MAV_SENSOR_ROTATION_PITCH_270: looking down
_OCTANTS = 8


class Sensing(Service):
    """Builders of the three messages.

    Parameters
    ----------
    stack : has the samples.
    """

    def __init__(self, stack: FlightStack) -> None:
        self._stack = stack
        self._octant = 0

    def builders(self) -> dict[int, Builder]:
        """By message id; all are silent without their sensor."""
        return {
            mavlink.MAVLINK_MSG_ID_DISTANCE_SENSOR: self.distance_sensor,
            mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE: self.obstacle_distance,
            mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE_3D: self.obstacle_distance_3d,
        }

    def distance_sensor(self) -> Message | None:
        """The rangefinder's newest sample."""
        sample = self._stack.range
        if sample is None:
            return None
        far = math.isnan(sample.distance)
        return mavlink.MAVLink_distance_sensor_message(
            time_boot_ms=sample.now_us // 1000 & 0xFFFFFFFF,
            min_distance=round(100 * sample.minimum),
            max_distance=round(100 * sample.maximum),
            current_distance=round(100 * sample.maximum) + 1 if far else round(100 * sample.distance),
            type=mavlink.MAV_DISTANCE_SENSOR_LASER,
            id=0,
            orientation=_PITCH_270,
            covariance=255,
            signal_quality=1 if far else 100,
        )

    def obstacle_distance(self) -> Message | None:
        """The level ring of the newest round, clockwise from the nose."""
        scan = self._stack.obstacles
        if scan is None:
            return None
        past = round(100 * scan.maximum) + 1
        level = 100.0 * scan.distance[:SECTORS]
        return mavlink.MAVLink_obstacle_distance_message(
            time_usec=scan.now_us,
            sensor_type=mavlink.MAV_DISTANCE_SENSOR_LASER,
            distances=[past if math.isnan(d) else round(d) for d in level.tolist()],
            increment=360 // SECTORS,
            min_distance=round(100 * scan.minimum),
            max_distance=past - 1,
            increment_f=0,
            angle_offset=0,
            frame=mavlink.MAV_FRAME_BODY_FRD,
        )

    def obstacle_distance_3d(self) -> Message | None:
        """The nearest point of all rings in one eighth of the way round, another eighth each time."""
        scan = self._stack.obstacles
        if scan is None:
            return None
        for _ in range(_OCTANTS):
            octant, self._octant = self._octant, (self._octant + 1) % _OCTANTS
            wide = SECTORS // _OCTANTS
            rows = np.arange(octant * wide, (octant + 1) * wide)
            rows = np.concatenate([rows + ring for ring in range(0, len(scan.distance), SECTORS)])
            seen = rows[np.isfinite(scan.distance[rows])]
            if len(seen):
                nearest = seen[np.argmin(scan.distance[seen])]
                x, y, z = (scan.distance[nearest] * scan.directions_b[nearest]).tolist()
                return mavlink.MAVLink_obstacle_distance_3d_message(
                    time_boot_ms=scan.now_us // 1000 & 0xFFFFFFFF,
                    sensor_type=mavlink.MAV_DISTANCE_SENSOR_LASER,
                    frame=mavlink.MAV_FRAME_BODY_FRD,
                    obstacle_id=octant,
                    x=x,
                    y=y,
                    z=z,
                    min_distance=scan.minimum,
                    max_distance=scan.maximum,
                )
        return None
