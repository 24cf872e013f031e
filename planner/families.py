"""Families of seeded worlds to measure planners on, and to fly: the way is blocked, each family in its own manner.

    scenario = make("maze", seed=7)
    plan(scenario.world, scenario.start, scenario.goal, limits, RADIUS)

All are 20 x 20 x 4 m with full-height obstacles, from the west (low x) to the east. Those of FAMILIES with no more to
say start at (1, ~10, 1.5) and end at (19, ~10, 1.5). Same family and seed: same world, on every machine.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from planner.worlds import Box, Cylinder, Obstacle, Point, World

BoolArray = NDArray[np.bool_]

SIZE, HEIGHT = 20.0, 4.0
BOUNDS: tuple[Point, Point] = ((0.0, 0.0, 0.0), (SIZE, SIZE, HEIGHT))
RADIUS = 0.3
"""For which the worlds are made [m]: every gap of the families is passable with it, and gaps that are shut are shut."""
FLIGHT_LEVEL = 1.5
"""z of starts and goals [m]."""

MAZES = ("perfect", "loops", "closed")
"""Kinds of maze: exactly one way between any two places; some walls taken down; start and goal walled apart."""
SHARES = (0.5, 0.3, 0.2)
CELLS = (8, 12)
"""Cells of a maze along a side: at least the first, less than the second."""
THICKNESS = (0.1, 0.3)
"""Of a maze's walls [m]; its corridors are then 1.5 to 2.4 m wide."""


@dataclass(frozen=True, slots=True)
class Scenario:
    """A world and a question about it."""

    world: World
    start: Point  # [m]
    goal: Point  # [m]
    closed: bool = False  # start and goal are walled apart on purpose


def _wall(x0: float, y0: float, x1: float, y1: float) -> Box:
    return Box((x0, y0, 0.0), (x1, y1, HEIGHT))


def gap(rng: np.random.Generator) -> list[Obstacle]:
    """A wall with one gap of 1.4 m."""
    y = rng.uniform(4.0, 16.0)
    return [_wall(9.75, 0.0, 10.25, y - 0.7), _wall(9.75, y + 0.7, 10.25, SIZE)]


def l_shape(rng: np.random.Generator) -> list[Obstacle]:
    """Two arms that meet at a right angle, across the line and back toward the start."""
    dx, dy = rng.uniform(-1.0, 1.0, 2)
    return [_wall(9.5 + dx, 6.0 + dy, 10.5 + dx, 14.0 + dy), _wall(5.0 + dx, 13.0 + dy, 9.5 + dx, 14.0 + dy)]


def h_shape(rng: np.random.Generator) -> list[Obstacle]:
    """Two bars along the way joined by a bar across it."""
    dx, dy = rng.uniform(-1.0, 1.0, 2)
    bars = [_wall(6.0 + dx, y + dy, 14.0 + dx, y + 1.0 + dy) for y in (5.5, 13.5)]
    return [*bars, _wall(9.5 + dx, 6.5 + dy, 10.5 + dx, 13.5 + dy)]


def u_shape(rng: np.random.Generator) -> list[Obstacle]:
    """A pocket open toward the start."""
    dx, dy = rng.uniform(-1.0, 1.0, 2)
    arms = [_wall(6.0 + dx, y + dy, 12.0 + dx, y + 1.0 + dy) for y in (6.0, 13.0)]
    return [*arms, _wall(11.0 + dx, 7.0 + dy, 12.0 + dx, 13.0 + dy)]


def omega(rng: np.random.Generator) -> list[Obstacle]:
    """A ring of radius 4 m made of posts, open at the start's side, with a neck."""
    dx, dy = rng.uniform(-1.0, 1.0, 2)
    angles = np.linspace(-math.pi + 0.35, math.pi - 0.35, 42)
    ring = [Cylinder((10 + dx + 4 * math.cos(a), 10 + dy + 4 * math.sin(a)), 0.4, (0, HEIGHT)) for a in angles]
    neck = [_wall(4.0 + dx, y + dy, 6.2 + dx, y + 0.5 + dy) for y in (8.4, 11.1)]
    return [*ring, *neck]


def forest(rng: np.random.Generator) -> list[Obstacle]:
    """Fifty trees, every gap between two of them passable."""
    trees: list[tuple[float, float, float]] = []
    while len(trees) < 50:
        x, y, r = rng.uniform(2.5, 17.5), rng.uniform(0.5, 19.5), rng.uniform(0.25, 0.6)
        if all(math.hypot(x - a, y - b) > r + s + 2 * RADIUS + 0.2 for a, b, s in trees):
            trees.append((x, y, r))
    return [Cylinder((x, y), r, (0.0, HEIGHT)) for x, y, r in trees]


def maze(rng: np.random.Generator, kind: str | None = None) -> Scenario:
    """Corridors between thin walls, from a cell of the west column to one of the east column.

    A random walk that turns back where it is stuck opens a wall into each cell it visits (a "recursive backtracker"),
    so there is one way between any two. Loops: each wall left is then taken down with probability 0.15. Closed: one
    wall on the way is put up again.

    Parameters
    ----------
    kind : str | None    one of MAZES; drawn by SHARES when not given.

    Raises
    ------
    ValueError : an unknown kind.
    """
    if kind is not None and kind not in MAZES:
        raise ValueError(f"kind of maze: expected one of {', '.join(MAZES)}, found {kind!r}")
    kind = str(rng.choice(MAZES, p=SHARES)) if kind is None else kind
    nx, ny = (int(n) for n in rng.integers(*CELLS, 2))
    thickness = float(rng.uniform(*THICKNESS))
    first, last = (0, int(rng.integers(ny))), (nx - 1, int(rng.integers(ny)))
    walls, way = _carve(nx, ny, first, last, rng)
    if kind == "loops":
        for side in walls:
            side &= rng.random(side.shape) >= 0.15
    if kind == "closed":
        k = int(rng.integers(len(way) - 1))
        (i, j), (p, _) = sorted(way[k : k + 2])
        walls[0 if p > i else 1][i, j] = True
    dx, dy = SIZE / nx, SIZE / ny
    ends = [((i + 0.5) * dx, (j + 0.5) * dy, FLIGHT_LEVEL) for i, j in (first, last)]
    return Scenario(World(BOUNDS, _boxes(walls, dx, dy, thickness)), ends[0], ends[1], closed=kind == "closed")


def _carve(
    nx: int, ny: int, first: tuple[int, int], last: tuple[int, int], rng: np.random.Generator
) -> tuple[tuple[BoolArray, BoolArray], list[tuple[int, int]]]:
    """Walls east (nx - 1, ny) and north (nx, ny - 1) of the cells of a perfect maze, and the way from first to last."""
    east, north = np.ones((nx - 1, ny), dtype=bool), np.ones((nx, ny - 1), dtype=bool)
    stack, seen, way = [first], {first}, [first]
    while stack:
        i, j = stack[-1]
        around = [(i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)]
        fresh = [(p, q) for p, q in around if 0 <= p < nx and 0 <= q < ny and (p, q) not in seen]
        if not fresh:
            stack.pop()
            continue
        p, q = fresh[int(rng.integers(len(fresh)))]
        if p != i:
            east[min(i, p), j] = False
        else:
            north[i, min(j, q)] = False
        stack.append((p, q))
        seen.add((p, q))
        if (p, q) == last:
            way = stack.copy()
    return (east, north), way


def _boxes(walls: tuple[BoolArray, BoolArray], dx: float, dy: float, thickness: float) -> list[Obstacle]:
    """One box for each straight run of walls; runs overlap where they meet."""
    east, north = walls
    h = thickness / 2.0
    boxes: list[Obstacle] = []
    for i in range(east.shape[0]):
        for a, b in _runs(east[i]):
            boxes.append(_wall((i + 1) * dx - h, a * dy - h, (i + 1) * dx + h, b * dy + h))
    for j in range(north.shape[1]):
        for a, b in _runs(north[:, j]):
            boxes.append(_wall(a * dx - h, (j + 1) * dy - h, b * dx + h, (j + 1) * dy + h))
    return boxes


def _runs(row: BoolArray) -> list[tuple[int, int]]:
    """First and one past the last index of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], row.astype(np.int8), [0]])))
    return [(int(a), int(b)) for a, b in edges.reshape(-1, 2)]


def _across(
    obstacles: Callable[[np.random.Generator], list[Obstacle]],
) -> Callable[[np.random.Generator], Scenario]:
    def scenario(rng: np.random.Generator) -> Scenario:
        y0, y1 = SIZE / 2.0 + rng.uniform(-0.5, 0.5, 2)
        return Scenario(World(BOUNDS, obstacles(rng)), (1.0, float(y0), FLIGHT_LEVEL), (19.0, float(y1), FLIGHT_LEVEL))

    return scenario


FAMILIES: dict[str, Callable[[np.random.Generator], Scenario]] = {
    "gap": _across(gap),
    "L": _across(l_shape),
    "H": _across(h_shape),
    "U": _across(u_shape),
    "Omega": _across(omega),
    "forest": _across(forest),
    "maze": maze,
}


def make(family: str, seed: int) -> Scenario:
    """The scenario of a family and a seed.

    Raises
    ------
    ValueError : an unknown family, or a negative seed.
    """
    if family not in FAMILIES:
        raise ValueError(f"family: expected one of {', '.join(FAMILIES)}, found {family!r}")
    if seed < 0:
        raise ValueError(f"seed: expected at least 0, found {seed}")
    return FAMILIES[family](np.random.default_rng([seed, list(FAMILIES).index(family)]))
