"""Solids and their exact distances: hand-worked values, the eikonal equation, supporting planes."""

import math
import pickle

import numpy as np
import pytest

from planner import Box, Cylinder, Sphere, World

WALLS = ((-10.0, -10.0, -10.0), (10.0, 10.0, 10.0))
SOLIDS = [
    Box((-1.0, -2.0, -3.0), (1.0, 2.0, 3.0)),
    Cylinder(centre=(0.5, -0.5), radius=1.5, z=(-1.0, 2.0)),
    Sphere(centre=(0.0, 1.0, 0.0), radius=2.0),
]


def distance(solid: Box | Cylinder | Sphere, *points: tuple[float, float, float]) -> list[float]:
    return list(World(WALLS, [solid]).distance(np.array(points)))


def test_a_box_is_as_far_as_its_nearest_face_edge_or_corner() -> None:
    box = Box((0, 0, 0), (2, 2, 2))
    found = distance(box, (3, 1, 1), (3, 3, 1), (3, 3, 3), (1, 1, 0.25), (1, 1, 1))
    assert found == pytest.approx([1, math.sqrt(2), math.sqrt(3), -0.25, -1])


def test_a_cylinder_is_as_far_as_its_side_its_caps_or_its_rims() -> None:
    cylinder = Cylinder(centre=(0, 0), radius=1, z=(0, 4))
    found = distance(cylinder, (3, 0, 2), (0, 0, 5), (4, 0, 8), (0, 0.75, 2), (0, 0, 3.9), (0, 0, 2))
    assert found == pytest.approx([2, 1, 5, -0.25, -0.1, -1])


def test_a_sphere_is_as_far_as_its_centre_less_its_radius() -> None:
    assert distance(Sphere((1, 2, 3), 2), (1, 2, 3), (4, 6, 3)) == pytest.approx([-2, 3])


@pytest.mark.parametrize("solid", SOLIDS)
def test_the_gradient_is_the_central_difference_and_has_norm_one(solid: Box | Cylinder | Sphere) -> None:
    world = World(WALLS, [solid])
    points = np.random.default_rng(1).uniform(-4, 4, (300, 3))
    _, gradient = world.distance_gradient(points)
    h = 1e-6
    numeric = np.stack([(world.distance(points + h * e) - world.distance(points - h * e)) / (2 * h) for e in np.eye(3)])
    np.testing.assert_allclose(np.linalg.norm(gradient, axis=1), 1.0, atol=1e-12)
    agrees = np.abs(gradient - numeric.T).max(axis=1) < 1e-5
    assert agrees.mean() > 0.99  # a point may fall within h of a ridge, where there is no gradient


@pytest.mark.parametrize("solid", SOLIDS)
def test_every_gradient_supports_the_distance_from_below_everywhere(solid: Box | Cylinder | Sphere) -> None:
    world = World(WALLS, [solid])
    rng = np.random.default_rng(2)
    x, y = rng.uniform(-4, 4, (2, 500, 3))
    x[:20, :2] = [0.5, -0.5]  # on the cylinder's axis too
    d, g = world.distance_gradient(x)
    assert (world.distance(y) >= d + np.einsum("ij,ij->i", g, y - x) - 1e-12).all()


def test_a_world_is_as_far_as_its_nearest_obstacle_and_an_empty_one_infinitely() -> None:
    world = World(WALLS, [Sphere((0, 0, 0), 1), Sphere((5, 0, 0), 1)])
    assert world.distance(np.array([[3.5, 0, 0]])) == pytest.approx([0.5])
    assert world.distance(np.array([[0.0, 0, 0]]))[0] == -1.0
    assert World(WALLS).distance(np.zeros((1, 3)))[0] == math.inf


def test_the_walls_are_near_inside_and_negative_outside() -> None:
    assert World(WALLS).wall_distance(np.array([[9.0, 0, 0], [0, 0, 11.5]])) == pytest.approx([1.0, -1.5])


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: Box((0, 0, 0), (1, 0, 1)), "lower < upper"),
        (lambda: Cylinder((0, 0), 0.0, (0, 1)), "cylinder radius"),
        (lambda: Cylinder((0, 0), 1.0, (1, 0)), "low < high"),
        (lambda: Sphere((0, 0, math.nan), 1.0), "sphere centre"),
        (lambda: World(((0, 0, 0), (0, 1, 1))), "bounds"),
        (lambda: World(WALLS, [SOLIDS[0], "a tree"]), "obstacle 1"),
    ],
)
def test_a_shape_that_is_none_is_refused_where_it_is_built(build: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        build()  # type: ignore[operator]


def test_a_world_survives_pickling() -> None:
    world = World(WALLS, SOLIDS)
    copy = pickle.loads(pickle.dumps(world))
    assert copy == world
    np.testing.assert_array_equal(copy.scene.solids, world.scene.solids)
