"""What one companion tells the others: where it is, and what it is about to fly; one datagram.

    magic "CFS1", length, crc32 of the rest, then `_HEAD`, then n control points (3 x float32) and n + 4 knots (float64)

All little endian, at most `LARGEST` bytes; a trajectory that does not fit is left out, and what is left says where the
vehicle is and how it goes. Places are in the sender's mission frame; `frame` and `origin` say which that is.
"""

import math
from dataclasses import dataclass
from struct import Struct
from zlib import crc32

import numpy as np

from companion.geodesy import Geodetic
from companion.seam import Flown, Vector
from planner import Trajectory
from planner.errors import PlannerError

MAGIC = b"CFS1"
LARGEST = 4096
_FRONT = Struct("<4sHI")  # magic, length of the whole, crc32 of what follows
_HEAD = Struct("<BBIqI3d3f3ffqH")
YIELDS, TO_GOAL = 1, 2
FARTHEST, FASTEST = 1e5, 200.0
"""Places and speeds beyond these are nobody's [m], [m/s]."""
LONGEST_S, SHORTEST_S = 1e6, 1e-6
"""Of a trajectory, and between two of its knots."""


@dataclass(frozen=True, slots=True)
class Shared:
    """One vehicle, as it tells the others."""

    sender: int  # 1 to 250; the lower has the right of way
    sequence: int  # counts up
    stamp_us: int  # the sender's clock, which `flown` is told in, too [us]
    position_m: Vector  # at the stamp, in its mission frame, NED [m]
    velocity: Vector  # [m/s]
    radius: float  # of its hull [m]
    yields: bool  # it flies round others; else it goes on as it does
    flown: Flown | None = None
    frame: int = 0  # the same number is the same mission frame
    origin: Geodetic | None = None  # where on the earth that frame is, if that is known


def pack(shared: Shared) -> bytes:
    """The datagram of it."""
    s, nowhere = shared, Geodetic(math.nan, math.nan, math.nan)
    origin = nowhere if s.origin is None else s.origin
    points, knots, start_us, flags = b"", b"", 0, YIELDS * s.yields
    count = 0
    if s.flown is not None:
        trajectory = s.flown.trajectory
        points = trajectory.control_points.astype("<f4").tobytes()
        knots = trajectory.knots.astype("<f8").tobytes()
        if _FRONT.size + _HEAD.size + len(points) + len(knots) > LARGEST:
            points = knots = b""
        else:
            count, start_us = len(trajectory.control_points), s.flown.start_us
            flags |= TO_GOAL * s.flown.to_goal
    head = _HEAD.pack(
        s.sender,
        flags,
        s.sequence & 0xFFFFFFFF,
        s.stamp_us,
        s.frame,
        *origin,
        *s.position_m,
        *s.velocity,
        s.radius,
        start_us,
        count,
    )
    body = head + points + knots
    return _FRONT.pack(MAGIC, _FRONT.size + len(body), crc32(body)) + body


def unpack(data: bytes) -> Shared | None:
    """What a datagram tells; None for rubbish. Never raises."""
    if len(data) < _FRONT.size + _HEAD.size or len(data) > LARGEST:
        return None
    magic, length, check = _FRONT.unpack_from(data)
    body = data[_FRONT.size :]
    if magic != MAGIC or length != len(data) or crc32(body) != check:
        return None
    sender, flags, sequence, stamp_us, frame, lat, lon, alt, *numbers, start_us, count = _HEAD.unpack_from(body)
    rest = body[_HEAD.size :]
    if len(rest) != (12 * count + 8 * (count + 4) if count else 0) or 0 < count < 4:
        return None
    if not all(map(math.isfinite, numbers)):
        return None
    position, velocity, radius = tuple(numbers[:3]), tuple(numbers[3:6]), numbers[6]
    if max(map(abs, position)) > FARTHEST or max(map(abs, velocity)) > FASTEST or not 0.0 < radius <= 100.0:
        return None
    if not 1 <= sender <= 250:
        return None
    flown = None
    if count:
        points = np.frombuffer(rest, dtype="<f4", count=3 * count).astype(np.float64).reshape(-1, 3)
        knots = np.frombuffer(rest, dtype="<f8", offset=12 * count).astype(np.float64)
        if not (np.abs(points).max() <= FARTHEST and np.isfinite(knots).all() and knots[-1] <= LONGEST_S):
            return None
        if knots[:4].any() or (knots[-4:] != knots[-1]).any() or not (np.diff(knots[3:-3]) >= SHORTEST_S).all():
            return None
        speeds = 3.0 * np.diff(points, axis=0) / (knots[4:-1] - knots[1:-4])[:, None]  # their hull holds every velocity
        if not np.abs(speeds).max() <= FASTEST:
            return None
        try:
            trajectory = Trajectory(points, knots)
        except (ValueError, PlannerError):
            return None
        flown = Flown(trajectory, start_us, bool(flags & TO_GOAL))
    known = all(map(math.isfinite, (lat, lon, alt))) and abs(lat) <= 90.0 and abs(lon) <= 180.0
    return Shared(
        sender=sender,
        sequence=sequence,
        stamp_us=stamp_us,
        position_m=(position[0], position[1], position[2]),
        velocity=(velocity[0], velocity[1], velocity[2]),
        radius=radius,
        yields=bool(flags & YIELDS),
        flown=flown,
        frame=frame,
        origin=Geodetic(lat, lon, alt) if known else None,
    )
