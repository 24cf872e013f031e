"""What the vehicle sees, put together: messages in, a map and tracks out.

A scan is placed where the vehicle was when the sensor looked: half a second of poses is kept, by the vehicle's own
time since boot. A sender whose clock is another (Unix time, or none) is placed where the vehicle is now. Hits on what
the mission says already, and on what moves, stay out of the map.
"""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from companion.fields import boot_ms
from companion.geodesy import Geodetic, to_local
from companion.hooks import Pose
from companion.mission import Mission, Sensing
from companion.seam import FloatArray, Vector
from companion.seeing.rollingmap import RollingMap
from companion.seeing.sensing import POINT, RANGE, RING, Scan, rotation, scan_of, stamp_of
from companion.seeing.tracks import Tracks
from wire.dialect import mavlink
from wire.framing import Packet

POSES = 32
LATEST_MS = 500
"""A scan older than this, by the vehicle's clock, has another clock."""
KNOWN = 0.35
"""Hits this near to a solid that the mission tells of are that solid [m]."""
GROUND = 0.2
"""Hits this little above the ground are the ground [m]."""
JUMP = 0.5
"""A position that jumps by more than this between two messages has another origin [m]."""

MOVERS_HZ = 100.0
"""ADSB_VEHICLE tells of one mover after the other [Hz]."""

_POSITION = mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED
_ATTITUDE = mavlink.MAVLINK_MSG_ID_ATTITUDE
_GLOBAL = mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT
_ADSB = mavlink.MAVLINK_MSG_ID_ADSB_VEHICLE
_GLOBAL_STRUCT = mavlink.MAVLink_global_position_int_message.unpacker
_ADSB_STRUCT = mavlink.MAVLink_adsb_vehicle_message.unpacker
_SCANS = frozenset((RING, POINT, RANGE))
_PLACED = mavlink.ADSB_FLAGS_VALID_COORDS | mavlink.ADSB_FLAGS_VALID_ALTITUDE


@dataclass(frozen=True, slots=True)
class _At:
    boot_ms: int
    pose: Pose


@dataclass(frozen=True, slots=True)
class _Anchor:
    place: Geodetic
    position_m: FloatArray


class Sight:
    """Obstacles and movers, as the vehicle's system tells of them.

    Parameters
    ----------
    mission : its world is what is known beforehand; without `sensing` there are no obstacles but its, only tracks.

    Attributes
    ----------
    map, tracks : what stands and what moves, in the mission frame.
    scans : taken in so far.
    jumped : the estimator has moved its origin since this was last set to False; the map was emptied.
    """

    def __init__(self, mission: Mission) -> None:
        sensing = Sensing(use=False) if mission.sensing is None else mission.sensing
        world = mission.planner_world()
        (_, _, top), (_, _, bottom) = world.bounds
        column = math.inf if sensing.column == "full" else float(sensing.column)
        self.map = RollingMap(sensing.resolution, (top, bottom), column)
        self.tracks = Tracks()
        self.scans = 0
        self.jumped = False
        self._looks = sensing.use
        self._world = world if world.obstacles else None
        self._mover_radius = sensing.mover_radius
        self._hull = mission.vehicle.radius
        self._ground_z = bottom - GROUND
        self._poses: deque[_At] = deque(maxlen=POSES)
        self._anchor: _Anchor | None = None
        self._placed = False  # the mission frame is known

    def streams_hz(self) -> dict[int, float]:
        """What to ask the vehicle for; one that has no such sensor refuses, or stays silent."""
        if not self._looks:
            return {}
        return {RING: 10.0, _ADSB: MOVERS_HZ, _GLOBAL: 10.0}

    def begin(self) -> None:
        """The mission frame is fixed: what comes from now on counts."""
        self._placed = True
        self._poses.clear()
        self.map.shift()

    def take(self, now_us: int, packet: Packet, pose: Pose) -> bool:
        """One packet of the vehicle's system; `pose` is what telemetry says with it. Whether it told of something."""
        kind = packet.message_id
        if not self._placed or not self._looks:
            return False
        if kind in (_POSITION, _ATTITUDE):
            if packet.component_id == mavlink.MAV_COMP_ID_AUTOPILOT1:
                self._place(boot_ms(packet.payload), pose, kind == _POSITION)
            return False
        if kind in _SCANS:
            return self._look(now_us, packet)
        if kind == _ADSB:
            return self._hear(now_us, packet.payload)
        if kind == _GLOBAL and packet.component_id == mavlink.MAV_COMP_ID_AUTOPILOT1:
            self._anchor_at(packet.payload)
        return False

    def step(self, flight_us: int) -> None:
        """Forget what is too old."""
        self.map.decay(flight_us)
        self.tracks.forget(flight_us)

    def _place(self, ms: int, pose: Pose, fresh: bool) -> None:
        poses = self._poses
        if poses and fresh:
            before = poses[-1]
            passed = (ms - before.boot_ms) / 1e3
            meant = before.pose.position_m + passed * before.pose.velocity_m
            if 0.0 <= passed < 0.5 and math.dist(meant, pose.position_m) > JUMP:
                poses.clear()
                self.map.shift()
                self.jumped = True
        if poses and poses[-1].boot_ms == ms:
            poses.pop()
        poses.append(_At(ms, pose))

    def _look(self, now_us: int, packet: Packet) -> bool:
        if not self._poses:
            return False
        stamp_ms = stamp_of(packet.message_id, packet.payload) // 1000
        at = min(self._poses, key=lambda p: abs(p.boot_ms - stamp_ms))
        late = (stamp_ms - at.boot_ms) / 1e3
        if abs(stamp_ms - self._poses[-1].boot_ms) > LATEST_MS:
            at, late = self._poses[-1], 0.0
        pose = at.pose
        where = pose.position_m + min(max(late, -0.1), 0.1) * pose.velocity_m
        if not np.isfinite(where).all():
            return False
        scan = scan_of(packet.message_id, packet.payload, where, rotation(pose.roll, pose.pitch, pose.yaw))
        if scan is None:
            return False
        self.map.add(now_us, self._unknown(now_us, scan))
        self.map.here(self._poses[-1].pose.position_m, self._hull)
        self.scans += 1
        return True

    def _unknown(self, now_us: int, scan: Scan) -> Scan:
        """The scan, its hits on the ground, on known solids and on movers not known."""
        hit = np.flatnonzero(np.isfinite(scan.distance))
        if not len(hit):
            return scan
        points = scan.position_m + scan.directions[hit] * scan.distance[hit, None]
        known = points[:, 2] > self._ground_z
        if self._world is not None:
            known |= self._world.distance(points) < KNOWN
        if len(self.tracks):
            known |= self.tracks.near(now_us, points)
        if not known.any():
            return scan
        distance = scan.distance.copy()
        distance[hit[known]] = math.nan
        return Scan(scan.stamp_us, scan.position_m, scan.directions, distance, scan.maximum)

    def _anchor_at(self, payload: bytes) -> None:
        """Where the mission frame is on earth: a GLOBAL_POSITION_INT of the same moment as a pose says it."""
        ms, lat, lon, alt = _GLOBAL_STRUCT.unpack(payload[:28].ljust(28, b"\0"))[:4]
        at = next((p for p in reversed(self._poses) if p.boot_ms == ms), None)
        if at is not None:
            self._anchor = _Anchor(Geodetic(lat * 1e-7, lon * 1e-7, alt * 1e-3), at.pose.position_m)

    def _hear(self, now_us: int, payload: bytes) -> bool:
        size = _ADSB_STRUCT.size
        address, lat, lon, alt, heading, speed, climb, flags, *_ = _ADSB_STRUCT.unpack(
            payload[:size].ljust(size, b"\0")
        )
        anchor = self._anchor
        if anchor is None or flags & _PLACED != _PLACED:
            return False
        north, east = to_local(anchor.place, lat * 1e-7, lon * 1e-7)
        here = anchor.position_m
        place: Vector = (
            float(here[0]) + north,
            float(here[1]) + east,
            float(here[2]) - (alt * 1e-3 - anchor.place.altitude),
        )
        going = (0.0, 0.0, 0.0)
        if flags & mavlink.ADSB_FLAGS_VALID_VELOCITY and flags & mavlink.ADSB_FLAGS_VALID_HEADING:
            course, level = math.radians(heading * 1e-2), speed * 1e-2
            up = climb * 1e-2 if flags & mavlink.ADSB_FLAGS_VERTICAL_VELOCITY_VALID else 0.0
            going = (level * math.cos(course), level * math.sin(course), -up)
        if max(map(abs, place)) > 1e5 or max(map(abs, going)) > 1e3:
            return False
        self.tracks.told(now_us, address, place, going, self._mover_radius)
        return True
