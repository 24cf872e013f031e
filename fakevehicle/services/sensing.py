"""What is around, on MAVLink: DISTANCE_SENSOR, OBSTACLE_DISTANCE, OBSTACLE_DISTANCE_3D, and ADSB_VEHICLE.

A distance that is not there is told as the messages want it: DISTANCE_SENSOR one centimetre past its reach,
OBSTACLE_DISTANCE likewise in each of its 72 sectors (65535 would mean that nobody looked).

What moves tells everybody where it is, as an aircraft with a transponder does: each ADSB_VEHICLE is of the next mover,
so that a stream of n times 5 Hz tells of n of them five times a second each.
"""

import math
from collections.abc import Callable, Mapping

import numpy as np

from fakevehicle.codec import Message
from fakevehicle.flight import FlightStack
from fakevehicle.places import Places
from fakevehicle.sensors.movers import Movers
from fakevehicle.sensors.obstacles import SECTORS
from fakevehicle.services.service import Builder, Service
from wire.dialect import mavlink

TOLD_SHARE, MOST_HZ = 0.5, 125.0
"""Each mover is told of half as often as the obstacle sensor's rounds, all of them together at most so often [Hz]."""
_PITCH_270 = 25  # MAV_SENSOR_ROTATION_PITCH_270: looking down
_OCTANTS = 8
FIRST_ADDRESS = 0xC00001
"""ICAO address of the first mover; the others count on from it."""
_ADSB_FLAGS = (
    mavlink.ADSB_FLAGS_VALID_COORDS
    | mavlink.ADSB_FLAGS_VALID_ALTITUDE
    | mavlink.ADSB_FLAGS_VALID_HEADING
    | mavlink.ADSB_FLAGS_VALID_VELOCITY
    | mavlink.ADSB_FLAGS_VALID_CALLSIGN
    | mavlink.ADSB_FLAGS_SIMULATED
    | mavlink.ADSB_FLAGS_VERTICAL_VELOCITY_VALID
)


def with_traffic(rates: Mapping[int, float], movers: Movers | None) -> Mapping[int, float]:
    """A profile's streams, with ADSB_VEHICLE where it tells of obstacles and something moves."""
    rounds = rates.get(mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE, 0.0)
    if movers is None or not len(movers) or not rounds:
        return rates
    return {**rates, mavlink.MAVLINK_MSG_ID_ADSB_VEHICLE: min(rounds * TOLD_SHARE * len(movers), MOST_HZ)}


class Sensing(Service):
    """Builders of the four messages.

    Parameters
    ----------
    stack : has the samples.
    movers : what flies about; None: nothing does.
    places : truth's frame on the globe; needed with movers.
    now : the time [us].
    """

    def __init__(
        self,
        stack: FlightStack,
        movers: Movers | None = None,
        places: Places | None = None,
        now: Callable[[], int] = lambda: 0,
    ) -> None:
        self._stack, self._movers, self._places, self._now = stack, movers, places, now
        self._octant = 0
        self._mover, self._told_us = -1, -1

    def builders(self) -> dict[int, Builder]:
        """By message id; all are silent without their sensor."""
        return {
            mavlink.MAVLINK_MSG_ID_DISTANCE_SENSOR: self.distance_sensor,
            mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE: self.obstacle_distance,
            mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE_3D: self.obstacle_distance_3d,
            mavlink.MAVLINK_MSG_ID_ADSB_VEHICLE: self.adsb_vehicle,
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

    def adsb_vehicle(self) -> Message | None:
        """The next mover, the same on all links at one time; None: nothing moves."""
        movers, places, now_us = self._movers, self._places, self._now()
        if movers is None or places is None or not len(movers):
            return None
        if now_us != self._told_us:
            self._mover, self._told_us = (self._mover + 1) % len(movers), now_us
        place, course = (rows[self._mover] for rows in movers.at(now_us))
        latitude_e7, longitude_e7, millimetres = places.truth_e7(place)
        north, east, down = course.tolist()
        return mavlink.MAVLink_adsb_vehicle_message(
            ICAO_address=FIRST_ADDRESS + self._mover,
            lat=latitude_e7,
            lon=longitude_e7,
            altitude_type=mavlink.ADSB_ALTITUDE_TYPE_GEOMETRIC,
            altitude=millimetres,
            heading=round(100.0 * math.degrees(math.atan2(east, north))) % 36000,
            hor_velocity=min(round(100.0 * math.hypot(north, east)), 0xFFFF),
            ver_velocity=max(-0x7FFF, min(round(-100.0 * down), 0x7FFF)),
            callsign=f"MOVER{self._mover}".encode(),
            emitter_type=mavlink.ADSB_EMITTER_TYPE_UAV,
            tslc=0,
            flags=_ADSB_FLAGS,
            squawk=0,
        )
