"""The proof that there is no way: given where there is none by construction, never where scipy's labels show one."""

import math

import numpy as np
import pytest
from scipy.ndimage import label

from planner import Box, Cylinder, Prism, Sphere, VoxelGrid, World
from planner.enclosure import PITCHES, apart, blocked, parts, subdivided
from planner.families import MAZES, maze

BOUNDS = ((0, 0, 0), (12, 8, 3))
START, GOAL = np.array([1.0, 4.0, 1.5]), np.array([11.0, 4.0, 1.5])


def wall(x: float, low: float, high: float, thickness: float = 0.2, top: float = 3.0, bottom: float = 0.0) -> Box:
    return Box((x, low, bottom), (x + thickness, high, top))


@pytest.mark.parametrize("radius", [0.0, 0.05, 0.3])
@pytest.mark.parametrize("thickness", [5e-4, 0.05, 1.0])
def test_a_wall_across_the_map_is_a_proof_however_thin(radius: float, thickness: float) -> None:
    assert apart(World(BOUNDS, [wall(6, 0, 8, thickness)]), START, GOAL, radius, PITCHES[:1])


@pytest.mark.parametrize(
    ("door", "proved"),
    [
        ([wall(6, 0, 3.71), wall(6, 4.29, 8)], True),
        ([wall(6, 0, 3.69), wall(6, 4.31, 8)], False),
        ([wall(6, 0, 8, top=2.45)], True),
        ([wall(6, 0, 8, top=2.39)], False),
        ([wall(6, 0, 8, top=1.7, bottom=0.5), wall(6, 0, 8, top=3, bottom=2.28)], True),
    ],
)
def test_doors_and_slits_are_shut_when_they_are_narrower_than_the_vehicle(door: list[Box], proved: bool) -> None:
    assert apart(World(BOUNDS, door), START, GOAL, 0.3, PITCHES) == proved


def test_boxes_that_touch_close_a_wall_for_a_vehicle_of_no_size() -> None:
    assert apart(World(BOUNDS, [wall(6, 0, 3.3), wall(6, 3.3, 8)]), START, GOAL, 0.0, PITCHES[:1])


@pytest.mark.parametrize("posts", [20, 23, 26, 42])
def test_a_ring_of_posts_is_closed_although_no_two_of_them_touch(posts: int) -> None:
    angles = np.linspace(0.0, 2 * math.pi, posts, endpoint=False)
    ring = [Cylinder((6 + 3 * math.cos(a), 4 + 3 * math.sin(a)), 0.15, (0, 3)) for a in angles]
    between = 2 * 3 * math.sin(math.pi / posts) - 2 * 0.15
    assert apart(World(BOUNDS, ring), START, np.array([6.0, 4, 1.5]), 0.3, PITCHES) == (between < 0.57)


def test_spheres_close_a_tube() -> None:
    balls = [Sphere((6, y, z), 0.5) for y in np.arange(0, 8.1, 0.8) for z in np.arange(0, 3.1, 0.8)]
    assert apart(World(BOUNDS, balls), START, GOAL, 0.3, PITCHES)
    assert not apart(World(BOUNDS, [b for b in balls if b.centre[1] != 4.0]), START, GOAL, 0.3, PITCHES)


def test_prisms_close_a_wall_askew_and_a_notched_one_is_not_taken_for_its_hull() -> None:
    askew = Prism(((4.0, -1.0), (4.2, -1.0), (8.2, 9.0), (8.0, 9.0)), (-1, 4))
    assert apart(World(BOUNDS, [askew]), START, GOAL, 0.3, PITCHES)
    cup = ((5.0, 2.5), (8.0, 2.5), (8.0, 5.5), (5.0, 5.5), (5.0, 5.3), (7.8, 5.3), (7.8, 2.7), (5.0, 2.7))
    middle = np.array([6.5, 4.0, 1.5])
    assert not apart(World(BOUNDS, [Prism(cup, (-1, 4))]), START, middle, 0.3, PITCHES)
    lid = Box((4.8, 2.5, -1), (5.0, 5.5, 4))
    assert apart(World(BOUNDS, [Prism(cup, (-1, 4)), lid]), START, middle, 0.3, PITCHES)


def test_voxels_close_a_wall_and_a_hole_in_it_opens_it() -> None:
    voxels = np.zeros((60, 40, 15), dtype=bool)  # of 0.2 m
    voxels[30] = True
    world = World(BOUNDS, [VoxelGrid(voxels, (0, 0, 0), 0.2)])
    assert apart(world, START, GOAL, 0.3, PITCHES)
    voxels[30, 18:22, 5:9] = False
    world = World(BOUNDS, [VoxelGrid(voxels, (0, 0, 0), 0.2)])
    assert not apart(world, START, GOAL, 0.3, PITCHES)


@pytest.mark.parametrize("seed", range(30))
def test_a_maze_is_proved_closed_if_and_only_if_it_is(seed: int) -> None:
    kind = MAZES[seed % 3]
    scenario = maze(np.random.default_rng(seed), kind)
    start, goal = np.array(scenario.start), np.array(scenario.goal)
    assert apart(scenario.world, start, goal, 0.3, PITCHES[:5]) == (kind == "closed")


@pytest.mark.parametrize("seed", range(16))
def test_nothing_is_proved_closed_that_a_fine_grid_shows_open(seed: int) -> None:
    rng = np.random.default_rng(seed)
    size, radius, step = np.array([6.0, 5.0, 3.0]), float(rng.choice([0.0, 0.1, 0.3])), 0.1
    solids: list[Box | Cylinder | Sphere] = []
    for _ in range(rng.integers(5, 30)):
        c = size * rng.random(3)
        kind = rng.integers(3)
        if kind == 0:
            half = size * rng.uniform(0.02, 0.5, 3)
            half[rng.integers(3)] = 0.03
            solids.append(Box(tuple(c - half), tuple(c + half)))
        elif kind == 1:
            solids.append(Cylinder((c[0], c[1]), rng.uniform(0.1, 0.8), (c[2] - 2, c[2] + 2)))
        else:
            solids.append(Sphere(tuple(c), rng.uniform(0.1, 1.0)))
    axes = [np.arange(step / 2, s, step) for s in size]
    p = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    least = np.minimum(p, size - p).min(axis=1)
    for o in solids:
        if isinstance(o, Box):
            q = np.maximum(np.array(o.lower) - p, p - np.array(o.upper))
            d = np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0)
        elif isinstance(o, Cylinder):
            r = np.hypot(p[:, 0] - o.centre[0], p[:, 1] - o.centre[1]) - o.radius
            z = np.maximum(o.z[0] - p[:, 2], p[:, 2] - o.z[1])
            d = np.hypot(np.maximum(r, 0), np.maximum(z, 0)) + np.minimum(np.maximum(r, z), 0)
        else:
            d = np.linalg.norm(p - o.centre, axis=1) - o.radius
        least = np.minimum(least, d)
    # Neighbours that keep half a step more than the radius are joined by a segment that keeps it: truly open.
    groups = label((least >= radius + step / 2).reshape([len(a) for a in axes]))[0].ravel()
    free = np.flatnonzero(groups)
    world = World(((0, 0, 0), tuple(size)), solids)
    for a, b in rng.choice(free, (5, 2)) if len(free) else []:
        proved = apart(world, p[a], p[b], radius, PITCHES[:5])
        assert not (proved and groups[a] == groups[b])


@pytest.mark.parametrize(("need", "shut"), [(0.69, False), (0.70, False), (0.85, False), (0.87, True)])
def test_a_cell_whose_corners_are_near_to_different_solids_is_shut_only_if_all_of_it_is_near_to_its_middle(
    need: float, shut: bool
) -> None:
    """A unit cube: a grain in its middle, one out beyond each corner. The middles of its edges are 0.707 from the one
    and farther from the others."""
    corners = np.array([[c & 1, (c >> 1) & 1, c >> 2] for c in range(8)], dtype=float)
    beyond = 0.5 + (corners - 0.5) * (1.0 + 2.0 * 0.68 / math.sqrt(3.0))
    grains = [Sphere((0.5, 0.5, 0.5), 1e-3), *(Sphere(tuple(p), 1e-3) for p in beyond)]
    world = World(((-5, -5, -5), (5, 5, 5)), grains)
    nearest = np.arange(1, 9)
    assert (np.linalg.norm(corners - beyond, axis=1) - 1e-3 < need).all()
    assert blocked(world.scene, corners, nearest, need) == shut
    edge = np.array([0.5, 0.0, 0.0])
    least = min(float(np.linalg.norm(edge - g.centre)) - g.radius for g in grains)
    assert not (blocked(world.scene, corners, nearest, need) and least >= need)


@pytest.mark.parametrize("seed", range(4))
def test_no_point_of_a_shut_cell_keeps_the_distance(seed: int) -> None:
    rng = np.random.default_rng(seed)
    inside = np.stack(np.meshgrid(*[np.linspace(0.0, 1.0, 15)] * 3, indexing="ij"), -1).reshape(-1, 3)
    unit = np.array([[c & 1, (c >> 1) & 1, c >> 2] for c in range(8)], dtype=float)
    shut = 0
    for _ in range(300):
        size = rng.uniform(0.2, 1.0, 3)
        centres = np.concatenate(
            [size * rng.uniform(0.3, 0.7, (1, 3)), size * unit + rng.normal(scale=0.2, size=(8, 3))]
        )
        world = World(((-5, -5, -5), (5, 5, 5)), [Sphere(tuple(p), 1e-3) for p in centres])
        away = np.linalg.norm((size * unit)[:, None] - centres, axis=2) - 1e-3
        need = float(away.min(axis=1).max()) + rng.uniform(1e-3, 0.3)
        if blocked(world.scene, size * unit, away.argmin(axis=1), need):
            shut += 1
            p = size * inside
            assert (np.linalg.norm(p[:, None] - centres, axis=2).min(axis=1) - 1e-3).max() < need
    assert shut > 10


def test_planes_are_as_near_as_asked_and_keep_those_there_were() -> None:
    planes = np.array([-50.0, 0.0, 0.3, 2.0, 2.05, 90.0])
    for pitch in (math.inf, 1.0, 0.25):
        found = subdivided(planes, pitch, np.array([0.0, 2.05]))
        assert np.isin(planes, found).all()
        inside = found[(found >= 0.0) & (found <= 2.05)]
        assert np.diff(inside).max() <= min(pitch, 1.7) + 1e-12
        assert len(found) == len(inside) + 2 == parts(planes, pitch, np.array([0.0, 2.05])).sum() + 1
