"""The families of worlds: repeatable, as wide as they say, open or shut as they say (by scipy's labels on a grid)."""

import numpy as np
import pytest
from scipy.ndimage import label

from planner import Box, Cylinder, World
from planner.families import FAMILIES, HEIGHT, MAZES, RADIUS, SIZE, Scenario, make, maze


def clear_of(world: World, x: np.ndarray, y: np.ndarray, radius: float) -> np.ndarray:
    """Where an upright cylinder of that radius fits among full-height boxes and posts."""
    least = np.minimum.reduce([x, y, SIZE - x, SIZE - y])
    for o in world.obstacles:
        if isinstance(o, Box):
            qx, qy = (np.maximum(np.maximum(o.lower[a] - v, v - o.upper[a]), 0) for a, v in ((0, x), (1, y)))
            least = np.minimum(least, np.hypot(qx, qy))
        elif isinstance(o, Cylinder):
            least = np.minimum(least, np.hypot(x - o.centre[0], y - o.centre[1]) - o.radius)
    return least > radius


def joined(scenario: Scenario, radius: float, step: float = 0.05) -> bool:
    axis = np.arange(step / 2, SIZE, step)
    x, y = np.meshgrid(axis, axis, indexing="ij")
    groups, _ = label(clear_of(scenario.world, x, y, radius))
    at = [groups[tuple((np.array(end[:2]) / step).astype(int))] for end in (scenario.start, scenario.goal)]
    return bool(at[0] == at[1] > 0)


@pytest.mark.parametrize("family", FAMILIES)
def test_the_same_seed_makes_the_same_world_and_another_seed_another(family: str) -> None:
    assert make(family, 3) == make(family, 3)
    assert make(family, 3).world != make(family, 4).world


@pytest.mark.parametrize("family", FAMILIES)
def test_every_world_has_the_stated_size_and_obstacles_of_full_height(family: str) -> None:
    scenario = make(family, 11)
    assert scenario.world.bounds == ((0, 0, 0), (SIZE, SIZE, HEIGHT))
    for o in scenario.world.obstacles:
        low, high = (o.lower[2], o.upper[2]) if isinstance(o, Box) else o.z
        assert (low, high) == (0, HEIGHT)


@pytest.mark.parametrize("family", [name for name in FAMILIES if name != "maze"])
@pytest.mark.parametrize("seed", range(4))
def test_there_is_a_way_for_the_radius_that_the_worlds_are_made_for(family: str, seed: int) -> None:
    assert joined(make(family, seed), RADIUS)


@pytest.mark.parametrize("kind", MAZES)
@pytest.mark.parametrize("seed", range(5))
def test_a_maze_is_open_unless_it_is_closed_on_purpose(kind: str, seed: int) -> None:
    scenario = maze(np.random.default_rng(seed), kind)
    assert joined(scenario, RADIUS + 0.1) == (kind != "closed")
    assert joined(scenario, 0.05) == (kind != "closed")


def test_perfect_mazes_are_trees_of_corridors_and_looped_ones_are_not() -> None:
    """In a tree of corridors the walls hang together with the map's edge: the solid part is one piece."""
    pieces: dict[str, list[int]] = {"perfect": [], "loops": []}
    axis = np.arange(-0.025, SIZE + 0.05, 0.05)
    x, y = np.meshgrid(axis, axis, indexing="ij")
    for kind, counts in pieces.items():
        for seed in range(5):
            solid = ~clear_of(maze(np.random.default_rng(seed), kind).world, x, y, 0.0)
            counts.append(label(solid, structure=np.ones((3, 3)))[1])
    assert pieces["perfect"] == [1] * 5
    assert sum(pieces["loops"]) > 10


def test_mazes_of_every_kind_are_drawn() -> None:
    shut = [not joined(make("maze", seed), RADIUS, step=0.1) for seed in range(20)]
    assert 1 <= sum(shut) <= 10


def test_misuse_is_a_value_error_that_names_what_exists() -> None:
    with pytest.raises(ValueError, match="expected one of gap, L, H, U, Omega, forest, maze, found 'spiral'"):
        make("spiral", 0)
    with pytest.raises(ValueError, match="at least 0"):
        make("gap", -1)
    with pytest.raises(ValueError, match="expected one of perfect, loops, closed"):
        maze(np.random.default_rng(0), "round")
