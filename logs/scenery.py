"""What stands and moves in a flight, as entities of a Foxglove scene.

Shapes come in the mission frame, north-east-down; a scene is east-north-up (`logs.mirrors`). Each entity says in its
metadata what it is (`kind`), so that a reader need not guess from triangles.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from logs.foxglove import CLASSES, Duration, timestamp

FRAME = "mission"
"""The fixed frame: east, north, up from the mission's origin [m]."""
MOST_CELLS = 1000
"""Boxes of one map; a map of more is told in coarser ones."""
MOST_ENTITIES = 2000
THICKNESS = 2.0  # of lines [pixels]

Point = tuple[float, float, float]
LongArray = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Cube:
    """A box between two corners, NED [m]."""

    low: Point
    high: Point


@dataclass(frozen=True, slots=True)
class Cylinder:
    """Upright; z down, low < high [m]."""

    centre: tuple[float, float]
    radius: float
    z: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Ball:
    """A sphere that may move; NED [m], [m/s]."""

    centre: Point
    radius: float
    velocity: Point = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Prism:
    """Upright over a polygon of (north, east); z down, low < high [m]. Drawn by its edges and sides."""

    outline: tuple[tuple[float, float], ...]
    z: tuple[float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Cells:
    """Cells of a map, as upright runs.

    Attributes
    ----------
    runs : (n, 4) i, j, first k, one past the last k.
    origin : corner of cell (0, 0, 0), NED [m]. resolution : edge of a cell [m].
    """

    runs: NDArray[Any]
    origin: Point
    resolution: float


@dataclass(frozen=True, slots=True)
class Entity:
    """One thing: its name, what it is, its shapes, its colour (red, green, blue, opacity), and more to be told.

    `lifetime_s`: it is gone so long after it was last told; 0: it stays.
    """

    id: str
    kind: str
    shapes: Sequence[Cube | Cylinder | Ball | Prism | Cells]
    colour: tuple[float, float, float, float]
    metadata: Mapping[str, str] = field(default_factory=dict)
    lifetime_s: float = 0.0
    edges_only: bool = False


def runs_of(cells: LongArray) -> LongArray:
    """(n, 4) upright runs of cells (m, 3) i, j, k."""
    if not len(cells):
        return np.zeros((0, 4), dtype=np.int64)
    cells = np.unique(cells, axis=0)  # by i, then j, then k
    first = np.append(True, (np.diff(cells[:, :2], axis=0) != 0).any(axis=1) | (np.diff(cells[:, 2]) != 1))
    last = np.append(first[1:], True)
    return np.column_stack([cells[first], cells[last, 2] + 1])


def boxes_of(cells: Cells, most: int = MOST_CELLS) -> tuple[LongArray, float]:
    """The same solid in few boxes.

    Returns
    -------
    boxes : (n, 6) first i, j, k and one past the last of each; n <= `most`.
    resolution : of their numbers [m]; doubled until there are few enough, so that they hold more than the cells.
    """
    runs, resolution = cells.runs.astype(np.int64), cells.resolution
    while True:
        boxes = np.column_stack([runs[:, :3], runs[:, :2] + 1, runs[:, 3]])
        boxes = _joined(_joined(boxes, 1), 0)
        if len(boxes) <= most or resolution > 1e4:
            return boxes[:most], resolution
        halved = np.column_stack([runs[:, :3] // 2, -(-runs[:, 3:] // 2)])
        runs, resolution = np.unique(halved, axis=0), 2.0 * resolution


def _joined(boxes: LongArray, axis: int) -> LongArray:
    """Boxes that follow each other along an axis and are else the same, as one."""
    if len(boxes) < 2:
        return boxes
    others = [k for k in range(6) if k not in (axis, axis + 3)]
    boxes = boxes[np.lexsort((boxes[:, axis], *(boxes[:, k] for k in others)))]
    same = (np.diff(boxes[:, others], axis=0) == 0).all(axis=1) & (boxes[1:, axis] == boxes[:-1, axis + 3])
    first = np.append(True, ~same)
    joined: LongArray = boxes[first].copy()
    joined[:, axis + 3] = boxes[np.append(first[1:], True), axis + 3]
    return joined


def vector(ned: Sequence[float], kind: str = "Vector3") -> Any:
    """A point or vector of the mission frame as the scene has it."""
    return CLASSES[kind](x=ned[1], y=ned[0], z=-ned[2])


def scene_update(entities: Sequence[Entity], gone: Sequence[str], ns: int) -> bytes:
    """A `foxglove.SceneUpdate` that adds or replaces entities, and takes away those of the names `gone`."""
    time = timestamp(ns)
    update = CLASSES["SceneUpdate"](
        deletions=[CLASSES["SceneEntityDeletion"](timestamp=time, id=name) for name in gone],
        entities=[_entity(entity, time) for entity in entities[:MOST_ENTITIES]],
    )
    data: bytes = update.SerializeToString(deterministic=True)
    return data


def _entity(entity: Entity, time: Any) -> Any:
    pair = CLASSES["KeyValuePair"]
    told = CLASSES["SceneEntity"](
        timestamp=time,
        frame_id=FRAME,
        id=entity.id,
        metadata=[pair(key=key, value=value) for key, value in {"kind": entity.kind, **entity.metadata}.items()],
    )
    if entity.lifetime_s > 0.0:
        told.lifetime.CopyFrom(Duration(seconds=int(entity.lifetime_s), nanos=int(entity.lifetime_s % 1.0 * 1e9)))
    colour = CLASSES["Color"](**dict(zip("rgba", entity.colour, strict=True)))
    for shape in entity.shapes:
        match shape:
            case Cube() if entity.edges_only:
                (n0, e0, _), (n1, e1, _) = shape.low, shape.high
                outline = ((n0, e0), (n1, e0), (n1, e1), (n0, e1))
                told.lines.extend(_edges(outline, (shape.low[2], shape.high[2]), colour))
            case Cube():
                told.cubes.append(_cube(shape.low, shape.high, colour))
            case Cylinder(centre=(n, e), radius=radius, z=(low, high)):
                size = CLASSES["Vector3"](x=2.0 * radius, y=2.0 * radius, z=high - low)
                pose = _pose((n, e, 0.5 * (low + high)))
                scale = {"bottom_scale": 1.0, "top_scale": 1.0}
                told.cylinders.append(CLASSES["CylinderPrimitive"](pose=pose, size=size, color=colour, **scale))
            case Ball():
                _ball(told, shape, colour)
            case Prism():
                told.lines.extend(_edges(shape.outline, shape.z, colour))
                if not entity.edges_only:
                    told.triangles.append(_sides(shape, colour))
            case Cells():
                boxes, edge = boxes_of(shape)
                places = np.asarray(shape.origin) + boxes.reshape(-1, 2, 3) * edge
                told.cubes.extend(_cube(low, high, colour) for low, high in places.tolist())
    return told


def _pose(ned: Sequence[float], turned: Any = None) -> Any:
    upright = CLASSES["Quaternion"](w=1.0) if turned is None else turned
    return CLASSES["Pose"](position=vector(ned), orientation=upright)


def _cube(low: Sequence[float], high: Sequence[float], colour: Any) -> Any:
    middle = [0.5 * (a + b) for a, b in zip(low, high, strict=True)]
    size = CLASSES["Vector3"](x=high[1] - low[1], y=high[0] - low[0], z=high[2] - low[2])
    return CLASSES["CubePrimitive"](pose=_pose(middle), size=size, color=colour)


def _ball(told: Any, ball: Ball, colour: Any) -> None:
    """A sphere, and an arrow where it will be in a second."""
    edge = 2.0 * ball.radius
    size = CLASSES["Vector3"](x=edge, y=edge, z=edge)
    told.spheres.append(CLASSES["SpherePrimitive"](pose=_pose(ball.centre), size=size, color=colour))
    east, north, up = ball.velocity[1], ball.velocity[0], -ball.velocity[2]
    speed = math.sqrt(east * east + north * north + up * up)
    if speed > 0.05:  # an arrow points along x: turn about z to its course, then about y to its climb
        half_z, half_y = 0.5 * math.atan2(north, east), -0.5 * math.asin(up / speed)
        cz, sz, cy, sy = math.cos(half_z), math.sin(half_z), math.cos(half_y), math.sin(half_y)
        turned = CLASSES["Quaternion"](w=cz * cy, x=-sz * sy, y=cz * sy, z=sz * cy)
        arrow = {"shaft_diameter": 0.1, "head_length": 0.2, "head_diameter": 0.25}
        pose = _pose(ball.centre, turned)
        told.arrows.append(CLASSES["ArrowPrimitive"](pose=pose, shaft_length=speed, color=colour, **arrow))


def _edges(outline: Sequence[tuple[float, float]], z: tuple[float, float], colour: Any) -> list[Any]:
    """The lower and the upper outline, and what joins their corners."""
    line, point = CLASSES["LinePrimitive"], CLASSES["Point3"]
    look = {"pose": _pose((0.0, 0.0, 0.0)), "thickness": THICKNESS, "scale_invariant": True, "color": colour}
    rings = [[point(x=e, y=n, z=-height) for n, e in outline] for height in z]
    loops = [line(type=1, points=ring, **look) for ring in rings]
    joined = [corner for pair in zip(*rings, strict=True) for corner in pair]
    return [*loops, line(type=2, points=joined, **look)]


def _sides(prism: Prism, colour: Any) -> Any:
    """Two triangles for each side; both ways round, so that they are seen from either side."""
    point, points = CLASSES["Point3"], []
    for (n0, e0), (n1, e1) in zip(prism.outline, (*prism.outline[1:], prism.outline[0]), strict=True):
        a, b, c, d = ((n0, e0, 0), (n1, e1, 0), (n1, e1, 1), (n0, e0, 1))
        points += [point(x=e, y=n, z=-prism.z[k]) for n, e, k in (a, b, c, a, c, d, a, c, b, a, d, c)]
    return CLASSES["TriangleListPrimitive"](pose=_pose((0.0, 0.0, 0.0)), points=points, color=colour)
