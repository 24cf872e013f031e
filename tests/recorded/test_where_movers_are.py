"""GIVEN what a real autopilot tells of itself, WHEN somebody tells where on earth he is, THEN he is placed there."""

import math

import numpy as np
import pytest

from companion.hooks import Pose
from companion.missionfile import parse_mission
from companion.seeing.sight import Sight
from tests.recorded.streams import Listener
from wire.datagram import Datagram
from wire.dialect import mavlink
from wire.framing import Framer

MISSION = b"""\
name: movers on earth
vehicle: {start: {north: 0, east: 0}}
world: {bounds: {north: [-500, 500], east: [-500, 500], altitude: [0, 100]}}
steps: [{takeoff: {altitude: 2}}, land]
sensing: {use: true}
"""
STREAMS = ("arducopter-guided-circle-streams.tlog.gz", "arducopter-services-streams.tlog.gz")
AWAY = 0.0004
"""[deg]: about 45 m north and 37 m west."""
ADDRESS = 0xABCDEF


def ecef(latitude, longitude, altitude):
    """WGS 84, closed form; latitude and longitude in degrees."""
    a, f = 6378137.0, 1.0 / 298.257223563
    e2, la, lo = f * (2.0 - f), math.radians(latitude), math.radians(longitude)
    n = a / math.sqrt(1.0 - e2 * math.sin(la) ** 2)
    flat = (n + altitude) * math.cos(la)
    return np.array([flat * math.cos(lo), flat * math.sin(lo), (n * (1.0 - e2) + altitude) * math.sin(la)])


def ned_at(origin, place):
    """North, east, down [m] of a place, from an origin: both latitude, longitude [deg], altitude [m]."""
    la, lo = math.radians(origin[0]), math.radians(origin[1])
    turn = np.array(
        [
            [-math.sin(la) * math.cos(lo), -math.sin(la) * math.sin(lo), math.cos(la)],
            [-math.sin(lo), math.cos(lo), 0.0],
            [-math.cos(la) * math.cos(lo), -math.cos(la) * math.sin(lo), -math.sin(la)],
        ]
    )
    return turn @ (ecef(*place) - ecef(*origin))


def adsb(place):
    """Somebody at latitude, longitude, altitude, at rest, as a receiver beside the autopilot tells it."""
    flags = mavlink.ADSB_FLAGS_VALID_COORDS | mavlink.ADSB_FLAGS_VALID_ALTITUDE
    message = mavlink.MAVLink_adsb_vehicle_message(
        ADDRESS, round(place[0] * 1e7), round(place[1] * 1e7), 1, round(place[2] * 1e3), 0, 0, 0, b"", 0, 0, flags, 0
    )
    (packet,) = Framer().packets(bytes(message.pack(mavlink.MAVLink(None, srcSystem=1, srcComponent=156))))
    return packet


class Seer(Listener):
    """Ears with a sight, whose mission frame is the vehicle's local frame; each global position is checked."""

    def __init__(self, name, number):
        super().__init__(name, number)
        self.sight = Sight(parse_mission(MISSION, "movers.yaml"))
        self.sight.begin()
        self.errors = []

    def _hear(self, now_us, data):
        for packet, obeyed in self.link.packets(now_us, Datagram("autopilot", data, ("vehicle", 1))):
            if not obeyed:
                continue
            t = self.telemetry
            t.take(now_us, packet, self.link.decoder)
            pose = Pose(now_us, t.position_n, t.velocity_n, t.roll, t.pitch, t.yaw)
            self.sight.take(packet, pose)
            if packet.message_id == mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT and t.origin_e7 is not None:
                self._check(pose)
        self.telemetry.acks.clear()
        self.telemetry.texts.clear()

    def _check(self, pose):
        lat, lon, alt = self.telemetry.origin_e7
        origin = (lat * 1e-7, lon * 1e-7, alt * 1e-3)
        place = (origin[0] + AWAY, origin[1] - AWAY, origin[2] + 12.0)
        self.sight.take(adsb(place), pose)
        for track in self.sight.tracks.movers():
            self.errors.append(float(np.linalg.norm(np.array(track.centre) - ned_at(origin, place))))


@pytest.mark.parametrize("name", STREAMS)
def test_somebody_who_tells_where_he_is_is_placed_within_half_a_metre_of_where_the_earth_has_him(name):
    seer = Seer(name, 3).until(1000.0)
    assert len(seer.errors) > 300
    assert max(seer.errors) < 0.5
