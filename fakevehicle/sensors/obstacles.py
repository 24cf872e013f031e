# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""What the obstacle sensor and the rangefinder can see: the solids of the mission's world, by rays.

Frame: truth's n, local NED from home. The ground is not among them. The sensor is a lidar of three rings: one level
with the body, one tilted up, one down, 72 directions each, as OBSTACLE_DISTANCE has them (0 ahead, clockwise).

A ray o + t d meets a box between its slabs, a sphere and an upright cylinder where a quadratic says, and a wall where
it crosses its vertical plane within its length and height; from within a solid the distance is 0. Of a large world
only what is near is asked (`Nearby`), and of each kind at most the nearest `MOST_NEAR`. What moves or appears in flight
(`movers`) is added to that for each round.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from fakevehicle.faults import Channel
from fakevehicle.jit import kernel
from fakevehicle.sensors.movers import MOST, Movers, PopUp
from fakevehicle.vocabulary import FloatArray, ObstacleScan

SECTORS = 72
ELEVATIONS = (0.0, math.radians(15.0), math.radians(-15.0))
"""Of the rings; the level one comes first."""
MINIMUM, MAXIMUM = 0.2, 25.0
"""Reach of the sensor [m]."""
NOISE = 0.03
"""1 sigma of a distance [m]."""
MOST_NEAR = 300
"""Solids of a kind that a ray is tried against."""
STRIDE = 5.0
"""What is near is looked up again after this way [m]."""


@kernel
def cast_rays(boxes, spheres, cylinders, walls, origin, directions, reach, out):
    """Distance to the nearest solid along each ray.

    Parameters
    ----------
    boxes, spheres, cylinders, walls : as in `World`.
    origin : (3,) where the rays begin.  directions : (m, 3) unit vectors.
    reach : longest distance [m].
    out : (m,) written; infinity where nothing is within reach.
    """
    for r in range(directions.shape[0]):
        nearest = reach
        hit = False
        for b in range(boxes.shape[0]):
            enter, leave = 0.0, nearest
            for i in range(3):
                o, d, low, high = origin[i], directions[r, i], boxes[b, i], boxes[b, 3 + i]
                if d == 0.0:
                    if o < low or o > high:
                        leave = -1.0
                else:
                    one, other = (low - o) / d, (high - o) / d
                    enter, leave = max(enter, min(one, other)), min(leave, max(one, other))
            if enter <= leave:
                nearest, hit = enter, True
        for s in range(spheres.shape[0]):
            x, y, z = origin[0] - spheres[s, 0], origin[1] - spheres[s, 1], origin[2] - spheres[s, 2]
            along = x * directions[r, 0] + y * directions[r, 1] + z * directions[r, 2]
            apart = x * x + y * y + z * z - spheres[s, 3] ** 2
            root = along * along - apart
            if apart <= 0.0:
                nearest, hit = 0.0, True
            elif root >= 0.0 and -along - math.sqrt(root) >= 0.0:
                t = -along - math.sqrt(root)
                if t <= nearest:
                    nearest, hit = t, True
        for c in range(cylinders.shape[0]):
            x, y, z = origin[0] - cylinders[c, 0], origin[1] - cylinders[c, 1], origin[2]
            dx, dy, dz = directions[r, 0], directions[r, 1], directions[r, 2]
            enter, leave = 0.0, nearest
            flat, along, apart = dx * dx + dy * dy, x * dx + y * dy, x * x + y * y - cylinders[c, 2] ** 2
            if flat == 0.0:
                if apart > 0.0:
                    leave = -1.0
            else:
                root = along * along - flat * apart
                if root < 0.0:
                    leave = -1.0
                else:
                    enter = max(enter, (-along - math.sqrt(root)) / flat)
                    leave = min(leave, (-along + math.sqrt(root)) / flat)
            if dz == 0.0:
                if z < cylinders[c, 3] or z > cylinders[c, 4]:
                    leave = -1.0
            else:
                one, other = (cylinders[c, 3] - z) / dz, (cylinders[c, 4] - z) / dz
                enter, leave = max(enter, min(one, other)), min(leave, max(one, other))
            if enter <= leave:
                nearest, hit = enter, True
        for w in range(walls.shape[0]):
            ex, ey = walls[w, 2] - walls[w, 0], walls[w, 3] - walls[w, 1]
            across = directions[r, 0] * ey - directions[r, 1] * ex
            if across != 0.0:
                x, y = walls[w, 0] - origin[0], walls[w, 1] - origin[1]
                t = (x * ey - y * ex) / across
                share = (x * directions[r, 1] - y * directions[r, 0]) / across
                z = origin[2] + t * directions[r, 2]
                if 0.0 <= t <= nearest and 0.0 <= share <= 1.0 and walls[w, 4] <= z <= walls[w, 5]:
                    nearest, hit = t, True
        out[r] = nearest if hit else math.inf


@dataclass(frozen=True, slots=True)
class World:
    """Solids in truth's n [m].

    Attributes
    ----------
    boxes : (n, 6) low and high corner.
    spheres : (n, 4) centre and radius.
    cylinders : (n, 5) centre of the axis north and east, radius, upper and lower end (down coordinates).
    walls : (n, 6) upright sides of prisms: one end north and east, the other, upper and lower edge.
    movers : balls that fly about; None: nothing does.
    popups : what appears in flight.

    Raises
    ------
    ValueError : an array is not of that shape, or not finite; too many pop-ups.
    """

    boxes: FloatArray = field(default_factory=lambda: np.zeros((0, 6)))
    spheres: FloatArray = field(default_factory=lambda: np.zeros((0, 4)))
    cylinders: FloatArray = field(default_factory=lambda: np.zeros((0, 5)))
    walls: FloatArray = field(default_factory=lambda: np.zeros((0, 6)))
    movers: Movers | None = None
    popups: tuple[PopUp, ...] = ()

    def __post_init__(self) -> None:
        for name, width in (("boxes", 6), ("spheres", 4), ("cylinders", 5), ("walls", 6)):
            array = np.ascontiguousarray(getattr(self, name), dtype=float)
            if array.ndim != 2 or array.shape[1] != width or not np.isfinite(array).all():
                raise ValueError(f"{name} of shape {array.shape}: expected (n, {width}) finite numbers")
            object.__setattr__(self, name, array)
        if len(self.popups) > MOST:
            raise ValueError(f"{len(self.popups)} pop-ups, expected at most {MOST}")

    def cast(self, origin_n: FloatArray, directions_n: FloatArray, range_max: float) -> FloatArray:
        """Distance to the nearest solid along rays, (m,) [m]; infinity where there is none within `range_max`.

        Parameters
        ----------
        origin_n : (3,) where they begin.
        directions_n : (m, 3) unit vectors.
        """
        out = np.empty(len(directions_n))
        cast_rays(
            self.boxes, self.spheres, self.cylinders, self.walls, origin_n, np.ascontiguousarray(directions_n),
            range_max, out,
        )  # fmt: skip
        return out

    def near(self, position_n: FloatArray, radius: float) -> "World":
        """The solids of which some part is within `radius` [m] of a point, at most the nearest `MOST_NEAR` a kind."""
        boxes, spheres, cylinders, walls = self._gaps(position_n)
        return World(
            _nearest(self.boxes, boxes, radius),
            _nearest(self.spheres, spheres, radius),
            _nearest(self.cylinders, cylinders, radius),
            _nearest(self.walls, walls, radius),
        )

    def gap(self, position_n: FloatArray) -> float:
        """Distance from a point, (3,), to the nearest solid [m]; infinite when there is none."""
        return min((float(gaps.min()) for gaps in self._gaps(position_n) if len(gaps)), default=math.inf)

    def with_more(self, other: "World") -> "World":
        """These solids and those."""
        return World(
            np.concatenate([self.boxes, other.boxes]),
            np.concatenate([self.spheres, other.spheres]),
            np.concatenate([self.cylinders, other.cylinders]),
            np.concatenate([self.walls, other.walls]),
            self.movers,
            self.popups,
        )

    def _gaps(self, position_n: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Distances from a point to each box, sphere, cylinder and (seen from above) wall [m]."""
        p, b, s, c, w = position_n, self.boxes, self.spheres, self.cylinders, self.walls
        gap = np.maximum(np.maximum(b[:, :3] - p, p - b[:, 3:]), 0.0)
        beside = np.maximum(np.hypot(c[:, 0] - p[0], c[:, 1] - p[1]) - c[:, 2], 0.0)
        end = np.maximum(np.maximum(c[:, 3] - p[2], p[2] - c[:, 4]), 0.0)
        along = w[:, 2:4] - w[:, 0:2]
        share = np.sum((p[:2] - w[:, 0:2]) * along, axis=1) / np.maximum(np.sum(along * along, axis=1), 1e-12)
        foot = w[:, 0:2] + np.clip(share, 0.0, 1.0)[:, None] * along
        return (
            np.linalg.norm(gap, axis=1),
            np.linalg.norm(s[:, :3] - p, axis=1) - s[:, 3],
            np.hypot(beside, end),
            np.hypot(foot[:, 0] - p[0], foot[:, 1] - p[1]),
        )


def _nearest(rows: FloatArray, distance: FloatArray, radius: float) -> FloatArray:
    """The rows within `radius`, in their order; the nearest of them when there are too many."""
    within = np.flatnonzero(distance <= radius)
    if len(within) > MOST_NEAR:
        within = np.sort(within[np.argpartition(distance[within], MOST_NEAR)[:MOST_NEAR]])
    return rows[within]


class Nearby:
    """The part of a world a sensor of some reach can see, looked up anew every `STRIDE` metres.

    Parameters
    ----------
    world : all of it.
    """

    def __init__(self, world: World) -> None:
        self._world, self._waiting = world, list(world.popups)
        self._part, self._centre_n, self._reach = World(), np.full(3, np.inf), 0.0

    def at(self, now_us: int, position_n: FloatArray, reach: float) -> World:
        """What can be within `reach` [m] of a point at `now_us`."""
        if self._waiting:
            self._look_for_popups(now_us, position_n)
        if reach != self._reach or not math.dist(position_n, self._centre_n) <= STRIDE:
            self._part = self._world.near(position_n, reach + STRIDE)
            self._centre_n, self._reach = position_n.copy(), reach
        movers = self._world.movers
        if movers is None:
            return self._part
        part, spheres = self._part, movers.spheres(now_us)
        near = _nearest(spheres, np.linalg.norm(spheres[:, :3] - position_n, axis=1) - spheres[:, 3], reach)
        return World(part.boxes, np.concatenate([part.spheres, near]), part.cylinders, part.walls)

    def _look_for_popups(self, now_us: int, position_n: FloatArray) -> None:
        there = [popup.appears(now_us, position_n) for popup in self._waiting]
        if not any(there):
            return
        for popup in (p for p, now in zip(self._waiting, there, strict=True) if now):
            self._world = self._world.with_more(popup.solids)
        self._waiting = [p for p, now in zip(self._waiting, there, strict=True) if not now]
        self._reach = 0.0  # what is near is looked up again


def _rings() -> FloatArray:
    bearing = np.arange(SECTORS) * (2.0 * math.pi / SECTORS)
    rings = [
        np.stack([math.cos(e) * np.cos(bearing), math.cos(e) * np.sin(bearing), np.full(SECTORS, -math.sin(e))], axis=1)
        for e in ELEVATIONS
    ]
    return np.concatenate(rings)


class ObstacleSensor:
    """Looks around ten times a second.

    Parameters
    ----------
    world : what there is to see.
    rng : of its noise.
    channel : its faults.
    """

    def __init__(self, world: World, rng: np.random.Generator, channel: Channel) -> None:
        self._nearby, self._rng, self._channel = Nearby(world), rng, channel
        self._directions_b = _rings()

    def measure(self, now_us: int, position_n: FloatArray, q_nb: FloatArray) -> ObstacleScan | None:
        """One round at truth's position and attitude; None: nothing comes. 216 draws."""
        w, x, y, z = q_nb.tolist()
        R_nb = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )
        distance = self._nearby.at(now_us, position_n, MAXIMUM).cast(position_n, self._directions_b @ R_nb.T, MAXIMUM)
        said = self._channel.through(now_us, distance + NOISE * self._rng.standard_normal(len(distance)))
        if said is None:
            return None
        said = np.where(said <= MAXIMUM, np.maximum(said, MINIMUM), np.nan)
        return ObstacleScan(now_us, self._directions_b, said, MINIMUM, MAXIMUM)
