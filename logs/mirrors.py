"""A flight in the well-known Foxglove schemas, so that viewers show it with no plug-in.

    /map/position       LocationFix       where the vehicle says it is on the earth
    /vehicle/pose, /tf  PoseInFrame, FrameTransform   where it says it is in the mission frame, and how it is turned
    /vehicle/path       PosesInFrame      the path flown so far, in at most `MOST_PATH` points
    /plan/path          PosesInFrame      what is planned to be flown
    /scene/obstacles    SceneUpdate       what is told of the world, the fence, what was seen, what moves
    /log                Log               notes, and what the vehicle says in words

Frames: what is north-east-down elsewhere stands here as viewers have it. `mission` is east-north-up from the mission's
origin; `vehicle` is forward-left-up. Yaw counts from the east, counter-clockwise.

Mirrors hold nothing that is not elsewhere in the recording in other words; a re-run takes no notice of them. What is
put in is cheap; messages are made of it where the file is written (`Mirrors.messages`).
"""

import math
import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from logs.foxglove import CLASSES, timestamp
from logs.scenery import FRAME, Entity, scene_update

BODY_FRAME = "vehicle"
MOST_PATH = 200
"""Points of the path flown; of a longer path every other one is left out, again and again."""
PATH_STEP = 0.1
"""Between two points of the path, at first [m]."""
PATH_NS = 1_000_000_000
MOST_SAMPLES = 100
"""Points of one planned curve."""
SAMPLE_S = 0.2
MOST_PLANNED = 1000
"""Points of all planned curves that follow each other."""
JOINED = 0.5
"""A plan that begins so near to where the one before ends goes on from it [m]."""

SCHEMAS: Final = {
    "/map/position": "LocationFix",
    "/vehicle/pose": "PoseInFrame",
    "/tf": "FrameTransform",
    "/vehicle/path": "PosesInFrame",
    "/plan/path": "PosesInFrame",
    "/scene/obstacles": "SceneUpdate",
    "/log": "Log",
}
"""Topics, and their schemas without the package."""

Point = tuple[float, float, float]
FloatArray = NDArray[np.float64]
Message = tuple[str, bytes]
"""Topic and protobuf bytes."""


@dataclass(frozen=True, slots=True)
class Body:
    """Where the vehicle was at a time [ns]: NED in the mission frame [m], and its attitude [rad]."""

    time_ns: int
    position: Point
    roll: float
    pitch: float
    yaw: float


@dataclass(frozen=True, slots=True)
class Fix:
    """A place on the earth [deg], [m] above mean sea level."""

    latitude: float
    longitude: float
    altitude: float


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """A clamped cubic B-spline over time to be flown: control points (n, 3) NED [m], knots (n + 4,) [s].

    `afresh`: it takes the place of what was planned; otherwise it may go on from it.
    """

    control_points: FloatArray
    knots: FloatArray
    afresh: bool


@dataclass(frozen=True, slots=True)
class Scene:
    """Things that are there now. What has the same `key` is told again at the start of every part; empty: it is not."""

    entities: Sequence[Entity]
    gone: Sequence[str] = ()
    key: str = ""


@dataclass(frozen=True, slots=True)
class Said:
    """Words; `level` is a MAV_SEVERITY."""

    level: int
    text: str
    who: str = "companion"


Mirror = Body | Fix | Plan | Scene | Said


class Mirrors:
    """Makes messages of what is put in; remembers the path, the plan, and what every part begins with."""

    def __init__(self) -> None:
        self._path: list[Point] = []
        self._spacing = PATH_STEP
        self._path_due_ns, self._path_told = -1, 0
        self._length = 0  # points ever put into the path
        self._planned: list[FloatArray] = []
        self._standing: dict[str, Message] = {}

    def messages(self, mirror: Mirror, log_ns: int) -> Iterator[Message]:
        """The messages that a mirror is told by; `log_ns` is when it is so."""
        match mirror:
            case Body():
                yield from self._body(mirror)
            case Fix():
                yield "/map/position", _bytes("LocationFix", log_ns, frame_id=FRAME, **_fix(mirror))
            case Plan():
                self._plan(mirror)
                points = np.vstack(self._planned)
                yield self._keep("plan", ("/plan/path", _poses(log_ns, points)))
            case Scene():
                message = "/scene/obstacles", scene_update(mirror.entities, mirror.gone, log_ns)
                yield self._keep(mirror.key, message)
            case Said():
                level = _LEVELS[min(max(mirror.level, 0), 7)]
                yield "/log", _bytes("Log", log_ns, level=level, message=mirror.text, name=mirror.who)

    def standing(self) -> list[Message]:
        """What a new part begins with, so that it can be looked at by itself."""
        return list(self._standing.values())

    def _keep(self, key: str, message: Message) -> Message:
        if key:
            self._standing[key] = message
        return message

    def _body(self, body: Body) -> Iterator[Message]:
        time, (n, e, d) = _time(body.time_ns), body.position
        at = _VECTOR.pack(9, e, 17, n, 25, -d)
        x, y, z, w = attitude(body.roll, body.pitch, body.yaw)
        turned = _TURN.pack(9, x, 17, y, 25, z, 33, w)
        yield "/vehicle/pose", b"".join((time, _IN_FRAME, b"\x1a\x43\x0a\x1b", at, b"\x12\x24", turned))
        yield "/tf", b"".join((time, _IN_FRAME, _OF_BODY, b"\x22\x1b", at, b"\x2a\x24", turned))
        path = self._path
        if not path or math.dist(path[-1], body.position) >= self._spacing:
            path.append(body.position)
            self._length += 1
            if len(path) > MOST_PATH:
                del path[1:-1:2]
                self._spacing *= 2.0
        if self._length > self._path_told and body.time_ns >= self._path_due_ns:
            self._path_due_ns, self._path_told = body.time_ns + PATH_NS, self._length
            yield "/vehicle/path", _poses(body.time_ns, path)

    def _plan(self, plan: Plan) -> None:
        points = sampled(plan.control_points, plan.knots)
        before = self._planned
        if plan.afresh or not before or math.dist(before[-1][-1], points[0]) > JOINED:
            before.clear()
        before.append(points)
        while len(before) > 1 and sum(map(len, before)) > MOST_PLANNED:
            del before[0]


def attitude(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """Roll, pitch, yaw of forward-right-down in NED as the quaternion x, y, z, w of forward-left-up in ENU.

    Right becomes left and down becomes up, so pitch turns round; yaw counts from the east, the other way round. The
    quaternion of turns about z, then y, then x: Diebel, Representing Attitude, 2006, section 5.4.
    """
    r, p, y = 0.5 * roll, -0.5 * pitch, 0.5 * (0.5 * math.pi - yaw)
    cr, sr, cp, sp, cy, sy = math.cos(r), math.sin(r), math.cos(p), math.sin(p), math.cos(y), math.sin(y)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def sampled(control_points: FloatArray, knots: FloatArray) -> FloatArray:
    """(k, 3) points of a clamped cubic B-spline at even times, both ends among them; by de Boor's recursion."""
    points, u = np.asarray(control_points, dtype=np.float64), np.asarray(knots, dtype=np.float64)
    count = int(min(MOST_SAMPLES, max(2, math.ceil((u[-1] - u[0]) / SAMPLE_S) + 1)))
    t = np.linspace(u[0], u[-1], count)
    span = np.clip(np.searchsorted(u, t, side="right") - 1, 3, len(points) - 1)
    d = [points[span - 3 + k] for k in range(4)]
    for level in (1, 2, 3):
        for k in range(3, level - 1, -1):
            i = span - 3 + k
            a = ((t - u[i]) / (u[i + 4 - level] - u[i]))[:, None]
            d[k] = (1.0 - a) * d[k - 1] + a * d[k]
    return d[3]


_FIX_LOOK = {"color": CLASSES["Color"](r=0.29, g=0.72, b=0.48, a=1.0)}
_LEVELS = (5, 5, 5, 4, 3, 2, 2, 1)
"""foxglove.Log.Level of MAV_SEVERITY 0 .. 7: the three worst are fatal, notices are information."""


# What comes 25 times a second, or in hundreds, is put together by hand: 1 us, not 10. A tag is field << 3 | type.
_VECTOR, _TURN = struct.Struct("<BdBdBd"), struct.Struct("<BdBdBdBd")
_IN_FRAME = b"\x12" + bytes([len(FRAME)]) + FRAME.encode()  # frame_id, parent_frame_id: 2
_OF_BODY = b"\x1a" + bytes([len(BODY_FRAME)]) + BODY_FRAME.encode()  # child_frame_id: 3
_POSE = np.dtype(
    [
        ("head", "S5"),
        ("x", "<f8"),
        ("to_y", "u1"),
        ("y", "<f8"),
        ("to_z", "u1"),
        ("z", "<f8"),
        ("turn", "S3"),
        ("w", "<f8"),
    ]
)


def _time(ns: int) -> bytes:
    """A timestamp as the first field."""
    data: bytes = timestamp(ns).SerializeToString()
    return bytes([10, len(data)]) + data


def _fix(fix: Fix) -> dict[str, Any]:
    """Its fields; the colour is optional in the schema, but Rerun (0.41) takes no fix without one."""
    return _FIX_LOOK | {"latitude": fix.latitude, "longitude": fix.longitude, "altitude": fix.altitude}


def _poses(ns: int, points: FloatArray | Sequence[Point]) -> bytes:
    """Upright poses; to a millimetre and in numbers that end in zeros, so that they compress."""
    short = np.round(np.asarray(points) * 1024.0) / 1024.0
    poses = np.empty(len(short), dtype=_POSE)
    poses["head"], poses["x"], poses["y"], poses["z"] = b"\x1a\x28\x0a\x1b\x09", short[:, 1], short[:, 0], -short[:, 2]
    poses["to_y"], poses["to_z"], poses["turn"], poses["w"] = 17, 25, b"\x12\x09\x21", 1.0
    return _time(ns) + _IN_FRAME + poses.tobytes()


def _bytes(kind: str, ns: int, **values: Any) -> bytes:
    data: bytes = CLASSES[kind](timestamp=timestamp(ns), **values).SerializeToString(deterministic=True)
    return data
