"""What the vehicle sees, put together: messages in, a map and tracks out.

A scan is placed where the vehicle was when the sensor looked: half a second of poses is kept, by the vehicle's own
time since boot. A sender whose clock is another (Unix time, or none) is placed where the vehicle is now. Hits on what
the mission says already, and on what moves, stay out of the map. What is kept bears the flight's time
(`Pose.flight_us`), in which everything is flown, whatever the vehicle's pace.
"""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from companion.fields import boot_ms
from companion.geodesy import Geodetic, to_local
from companion.hooks import Pose
from companion.mission import Mission, Sensing
from companion.seam import FloatArray, Vector
from companion.seeing.following import SEEN, Following
from companion.seeing.rollingmap import RollingMap
from companion.seeing.sensing import POINT, RANGE, RING, rotation, scan_of, stamp_of, without
from companion.seeing.tracks import Tracks
from wire.dialect import mavlink
from wire.framing import Packet

POSES = 64
LATEST_MS = 500
"""A scan older than this, by the vehicle's clock, has another clock."""
CARRIED_MS, ANCHOR_CARRIED_MS = 100, 500
"""A position is carried on by its velocity for so long at most: for a scan, and to say where on earth the frame is."""
BACK_MS = 1_000
"""A time since boot that goes back by less is a packet that came late, or twice."""
KNOWN = 0.35
"""Hits this near to a solid that the mission tells of are that solid [m]."""
GROUND = 0.2
"""Hits this little above the ground are the ground [m]."""
JUMP = 0.5
"""A position that jumps by more than this between two messages has another origin [m]."""

SCANS_HZ = 10.0
SILENT_SCANS = 6
"""So many scans in a row that do not come are no loss any more: of a link that loses 30 % it is one row in 1400."""
SILENT_US = round(1e6 * SILENT_SCANS / SCANS_HZ)
MOVERS_HZ = 100.0
"""ADSB_VEHICLE tells of one mover after the other [Hz]."""

ORIGIN, LEVEL = np.zeros(3), np.eye(3)

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
    placed_ms: int  # of the position in it: an attitude may be newer
    pose: Pose

    def position_m(self, ms: int, most_ms: int) -> FloatArray:
        """Where the vehicle was at a time since boot: the position carried on, or back, by its velocity."""
        late_ms = min(max(ms - self.placed_ms, -most_ms), most_ms)
        return self.pose.position_m + 1e-3 * late_ms * self.pose.velocity_m


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
        self._following = Following(self.tracks, self.map, sensing.mover_radius)
        self.scans = 0
        self.jumped = False
        self._looks = sensing.use
        self._world = world if world.obstacles else None
        self._mover_radius = sensing.mover_radius
        self._hull = mission.vehicle.radius
        self._ground_z = bottom - GROUND
        self._poses: deque[_At] = deque(maxlen=POSES)
        self._newest_ms: dict[int, int] = {}  # by kind
        self._anchor: _Anchor | None = None
        self._last: dict[tuple[int, int], bytes] = {}  # scan by kind and component
        self._heard_us: dict[int, int] = {}  # by kind, when something new was seen
        self._placed = False  # the mission frame is known

    def streams_hz(self) -> dict[int, float]:
        """What to ask the vehicle for; one that has no such sensor refuses, or stays silent."""
        if not self._looks:
            return {}
        return {RING: SCANS_HZ, POINT: SCANS_HZ, RANGE: SCANS_HZ, _ADSB: MOVERS_HZ, _GLOBAL: 10.0}

    def begin(self) -> None:
        """The mission frame is fixed: what comes from now on counts."""
        self._placed = True
        self._poses.clear()
        self._newest_ms.clear()
        self._anchor = None
        self._following.forget()
        self.map.shift()

    def take(self, packet: Packet, pose: Pose) -> bool:
        """One packet of the vehicle's system; `pose` is what telemetry says with it. Whether it told of something."""
        flight_us = pose.flight_us
        kind = packet.message_id
        if not self._looks or (kind in _SCANS and not self._is_new(flight_us, packet)) or not self._placed:
            return False
        if kind in (_POSITION, _ATTITUDE):
            if packet.component_id == mavlink.MAV_COMP_ID_AUTOPILOT1:
                self._place(kind, boot_ms(packet.payload), pose)
            return False
        if kind in _SCANS:
            return self._look(flight_us, packet)
        if kind == _ADSB:
            return self._hear(flight_us, packet.payload)
        if kind == _GLOBAL and packet.component_id == mavlink.MAV_COMP_ID_AUTOPILOT1:
            self._anchor_at(packet.payload)
        return False

    def step(self, flight_us: int) -> None:
        """Forget what is too old."""
        self.map.decay(flight_us)
        self.tracks.forget(flight_us)

    def trouble(self, flight_us: int) -> str:
        """Why it cannot be flown by what is seen; or nothing.

        Where there is a ring all round, only rings count: a single ray does not stand in for it.
        """
        if not self._looks:
            return ""
        if not self._heard_us:
            return "no scan from the obstacle sensor yet"
        last_us = self._heard_us.get(RING, max(self._heard_us.values()))
        return f"no scan from the obstacle sensor for {SILENT_US / 1e6:g} s" if flight_us - last_us > SILENT_US else ""

    def _is_new(self, flight_us: int, packet: Packet) -> bool:
        """Whether a scan is not the last one again: some senders repeat it when the sensor says nothing any more."""
        kind, payload, key = packet.message_id, packet.payload, (packet.message_id, packet.component_id)
        if self._last.get(key) == payload and stamp_of(kind, payload):
            return False
        self._last[key] = payload
        if scan_of(kind, payload, ORIGIN, LEVEL) is not None:
            self._heard_us[kind] = flight_us
        return True

    def _place(self, kind: int, ms: int, pose: Pose) -> None:
        poses, newest_ms = self._poses, self._newest_ms
        if -BACK_MS < ms - newest_ms.get(kind, -BACK_MS) <= 0:
            return  # overtaken, or doubled: telemetry has not taken it either
        newest_ms[kind] = ms
        if poses and kind == _POSITION:
            before = poses[-1]
            passed = (ms - before.placed_ms) / 1e3
            meant = before.pose.position_m + passed * before.pose.velocity_m
            if 0.0 <= passed < 0.5 and math.dist(meant, pose.position_m) > JUMP:
                poses.clear()
                self._anchor = None
                self._following.forget()
                self.map.shift()
                self.jumped = True
        if poses and poses[-1].boot_ms == ms:
            poses.pop()
        poses.append(_At(ms, newest_ms.get(_POSITION, ms), pose))

    def _near(self, ms: int) -> _At:
        """The pose kept that is nearest to a time since boot; there is one."""
        return min(self._poses, key=lambda p: abs(p.boot_ms - ms))

    def _look(self, flight_us: int, packet: Packet) -> bool:
        if not self._poses:
            return False
        ms, newest = stamp_of(packet.message_id, packet.payload) // 1000, self._poses[-1]
        in_time = abs(ms - newest.boot_ms) <= LATEST_MS  # else its clock is another
        at, ms = (self._near(ms), ms) if in_time else (newest, newest.placed_ms)
        pose, where = at.pose, at.position_m(ms, CARRIED_MS)
        if not np.isfinite(where).all():
            return False
        scan = scan_of(packet.message_id, packet.payload, where, rotation(pose.roll, pose.pitch, pose.yaw))
        if scan is None:
            return False
        hit = np.flatnonzero(np.isfinite(scan.distance))
        points = scan.position_m + scan.directions[hit] * scan.distance[hit, None]
        known = self._is_known(points)
        if packet.message_id == RING:
            told = known | self.tracks.near(flight_us, points, below=SEEN)
            late_us = 1000 * (newest.boot_ms - ms) if in_time else 0
            self._following.look(flight_us - late_us, scan, without(scan, hit[told]).distance)
        self.map.add(flight_us, without(scan, hit[known | self.tracks.near(flight_us, points)]))
        self.map.here(self._poses[-1].pose.position_m, self._hull)
        self.scans += 1
        return True

    def _is_known(self, points: FloatArray) -> NDArray[np.bool_]:
        """Which of points (m, 3) are of the ground, or of solids that the mission tells of."""
        known: NDArray[np.bool_] = points[:, 2] > self._ground_z
        if self._world is not None and len(points):
            known |= self._world.distance(points) < KNOWN
        return known

    def _anchor_at(self, payload: bytes) -> None:
        """Where the mission frame is on earth: where a GLOBAL_POSITION_INT and a pose of about that time say it is.

        Autopilots send the two at moments of their own (ArduCopter 42 ms apart, as recorded).
        """
        ms, lat, lon, alt = _GLOBAL_STRUCT.unpack(payload[:28].ljust(28, b"\0"))[:4]
        at = self._near(ms) if self._poses else None
        if at is None or abs(ms - at.placed_ms) > ANCHOR_CARRIED_MS:
            return
        where = at.position_m(ms, ANCHOR_CARRIED_MS)
        if np.isfinite(where).all():
            self._anchor = _Anchor(Geodetic(lat * 1e-7, lon * 1e-7, alt * 1e-3), where)

    def _hear(self, flight_us: int, payload: bytes) -> bool:
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
        self.tracks.told(flight_us, address, place, going, self._mover_radius)
        return True
