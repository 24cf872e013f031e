"""The ways round, when bows do not find one: A* on a lattice of the free space, pulled taut, one for each side.

The lightest way comes first; each further one is searched with the ways already found made BURDEN times as long, and
counts only when it passes some obstacle on another side than all of them. Two ways are taken to pass alike when two can
go along them and never lose sight of each other: the one can then be drawn across to the other through free space. (The
visibility deformation of Jaillet & Simeon, IJRR 2008. Zhou, Gao, Pan & Shen, ICRA 2020, let both go evenly; on long
ways round corners they would lose each other.) What a way leads to is a guess for the spline: it is proved or refused
like any other curve.
"""

import math
from dataclasses import dataclass

import numpy as np

from planner.bspline import FloatArray
from planner.distance import Scene
from planner.jit import kernel
from planner.lattice import BUFFER, DEEPEST, SLACK, Lattice, astar, build_lattice, burden_along, free
from planner.surroundings import places
from planner.worlds import Box, Cylinder, Obstacle, Prism, World

WIDTHS = (4.0, 2.0, 1.0, 0.5, 0.25, 0.125)
"""Distances between lattice points tried in turn [m]: those that give the place they are laid over FEWEST_POINTS to
MOST_POINTS; a larger one gets wider ones. In a large map that is the question's surroundings first (see `places`)."""
FEWEST_POINTS, MOST_POINTS = 5_000, 2_000_000
STOREYS = 2.0
"""Up and down the points of all but the finest lattice are this many times as far apart. Where all that is solid stands
from the bottom of the map to its top, three storeys do."""
BURDEN = 9.0
"""What the length of a way that was found counts for in the search for the next."""
PLACES = 60
"""Along a way, at which two that pass alike see each other."""


@dataclass(frozen=True, slots=True)
class Guide:
    """A way from start to goal."""

    path: FloatArray  # (m, 3) its corners [m]; m = 0 when the lattice shows none
    width: float  # of the finest lattice looked at [m]

    @property
    def length(self) -> float:
        """[m], inf when there is no way."""
        if not len(self.path):
            return math.inf
        return float(np.linalg.norm(np.diff(self.path, axis=0), axis=1).sum())


@kernel
def pull_taut(scene: Scene, radius: float, path: FloatArray) -> FloatArray:
    """The corners (m, 3) left when every point that the one after next can be seen past is dropped."""
    kept, gaps = np.empty_like(path), np.empty((2, DEEPEST))
    kept[0] = path[0]
    count, i, last = 1, 0, path.shape[0] - 1
    while i < last:
        j = i + 1
        while j < last and free(scene, radius, path[i], path[j + 1], 0.0, 0.0, gaps):
            j += 1
        kept[count] = path[j]
        count += 1
        i = j
    return kept[:count].copy()


@kernel
def alike(scene: Scene, radius: float, a: FloatArray, b: FloatArray) -> bool:
    """Whether two can go along a (k, 3) and b (k, 3), from the first to the last point, and never lose sight of each
    other. A search in depth over the pairs of places, both going on at once if they can."""
    k = a.shape[0]
    gaps, seen = np.empty((2, DEEPEST)), np.zeros((k, k), dtype=np.uint8)
    stack, top = np.empty((3 * k * k, 2), dtype=np.int64), 0
    stack[0, 0], stack[0, 1] = 0, 0
    while top >= 0:
        i, j = stack[top, 0], stack[top, 1]
        top -= 1
        if i >= k or j >= k or seen[i, j]:
            continue
        seen[i, j] = 1
        if not free(scene, radius, a[i], b[j], 0.0, 0.0, gaps):
            continue
        if i == k - 1 and j == k - 1:
            return True
        stack[top + 1, 0], stack[top + 1, 1] = i + 1, j
        stack[top + 2, 0], stack[top + 2, 1] = i, j + 1
        stack[top + 3, 0], stack[top + 3, 1] = i + 1, j + 1
        top += 3
    return False


def spread(path: FloatArray, count: int) -> FloatArray:
    """`count` points (count, 3) evenly along a polyline (m, 3), its ends left out."""
    s = np.concatenate([[0.0], np.cumsum(np.sqrt(((path[1:] - path[:-1]) ** 2).sum(axis=1)))])
    where = np.arange(1, count + 1) / (count + 1) * s[-1]
    return np.stack([np.interp(where, s, path[:, a]) for a in range(3)], axis=1)


def widths(extent: FloatArray) -> list[float]:
    """The widths for a place of that extent (3,), coarsest first and at least one, whatever its size [m]."""
    fitting = [width for width in WIDTHS if FEWEST_POINTS <= _points(extent, width) <= MOST_POINTS]
    if not fitting and _points(extent, WIDTHS[-1]) < FEWEST_POINTS:
        return [WIDTHS[-1]]
    wider = WIDTHS[0]
    while not fitting:
        wider *= 1.25
        if _points(extent, wider) <= MOST_POINTS:
            fitting.append(wider)
    return fitting


def _points(extent: FloatArray, width: float) -> float:
    return float(np.prod(np.maximum(np.ceil(extent / width), 1.0) + 1.0))


def _stands(obstacle: Obstacle, low: float, high: float) -> bool:
    """Whether an obstacle is the same all the way from z = low to high."""
    if isinstance(obstacle, Box):
        return bool(obstacle.lower[2] <= low and high <= obstacle.upper[2])
    if isinstance(obstacle, Cylinder | Prism):
        return bool(obstacle.z[0] <= low and high <= obstacle.z[1])
    return False


class Guides:
    """The ways from start to goal that pass the obstacles differently, looked for one at a time.

    Parameters
    ----------
    start, goal : (3,)    in the map, keeping the radius [m].
    """

    def __init__(self, world: World, start: FloatArray, goal: FloatArray, radius: float) -> None:
        self.scene, self.radius, self.obstacles = world.scene, radius, world.obstacles
        self.ends = np.array([start, goal], dtype=np.float64)
        room = np.array([[radius], [-radius]])
        self.levels = [  # where each lattice lies, and its width
            (place, width) for place in places(world.walls + room, self.ends) for width in widths(place[1] - place[0])
        ]
        self.level = -1
        self.lattice: Lattice | None = None
        self.found: list[FloatArray] = []  # (PLACES, 3) along each way so far on this lattice

    @property
    def width(self) -> float:
        """Of the finest lattice looked at [m]."""
        return min(width for _, width in self.levels[: max(self.level, 0) + 1])

    @property
    def finest(self) -> bool:
        """Whether no further lattice is left."""
        return self.level == len(self.levels) - 1

    def refine(self) -> None:
        """Go on with the next lattice, all ways new on it; call it first of all."""
        self.level += 1
        self.found.clear()
        place, pitch = self.levels[self.level]
        (low, high), width = place, np.full(3, pitch)
        if all(_stands(obstacle, low[2], high[2]) for obstacle in self.obstacles):
            width[2] = max((high[2] - low[2]) / 2.0, 1e-9)
        elif self.level + 1 < len(self.levels) and self.levels[self.level + 1][0] is place:
            width[2] *= STOREYS
        self.lattice = build_lattice(low, high, self.ends, width)

    def another(self, longest: float = math.inf) -> Guide | None:
        """One more way on this lattice, no lattice path of it longer than `longest` [m]; None when the search ends with
        none that is new."""
        lattice = self.lattice
        assert lattice is not None, "refine comes first"
        nodes = astar(self.scene, lattice, self.radius + SLACK, longest)
        if not len(nodes):
            return None
        burden_along(lattice, nodes, BURDEN)
        points = lattice.origin + np.stack(np.unravel_index(nodes[1:-1], tuple(lattice.shape)), axis=1) * lattice.step
        whole = np.concatenate([self.ends[:1], points, self.ends[1:]])
        way = Guide(np.asarray(pull_taut(self.scene, self.radius + BUFFER / 2.0, whole)), self.width)
        along = spread(way.path, PLACES)
        if any(alike(self.scene, self.radius, along, other) for other in self.found):
            return None
        self.found.append(along)
        return way


def guide(world: World, start: FloatArray, goal: FloatArray, radius: float) -> Guide:
    """The way that the coarsest lattice with one shows.

    Parameters
    ----------
    start, goal : (3,)    in the map, keeping the radius [m].
    """
    guides, way = Guides(world, start, goal, radius), None
    while way is None and not guides.finest:
        guides.refine()
        way = guides.another()
    return Guide(np.empty((0, 3)), guides.width) if way is None else way
