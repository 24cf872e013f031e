"""Voxels and clouds: exact distances at the corners, bounds that never exceed the truth, gaps that truly fit.

The oracles are scipy's distance transform and the distance to every single cube, which share no code with the planner.
"""

import pickle

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt

from planner import Box, Limits, PointCloud, Sphere, StartInCollision, VoxelGrid, World, plan
from planner.bspline import clamped_knots, evaluate
from planner.certificate import certify
from planner.cost import SplineCost
from planner.distance import nearest_solid
from planner.esdf import signed_distances
from planner.field import field_bound, field_distance, interpolate

LIMITS = Limits(3.0, 6.0, 60.0)
WALLS = ((-5.0, -5.0, -5.0), (5.0, 5.0, 5.0))


def to_cubes(points: np.ndarray, occupied: np.ndarray, origin: np.ndarray, h: float) -> np.ndarray:
    """Distance of each point to the nearest of the solid cubes, one by one."""
    low = origin + h * np.argwhere(occupied)
    least = np.full(len(points), np.inf)
    for corner in low:
        gap = np.maximum(np.maximum(corner - points, points - corner - h), 0.0)
        least = np.minimum(least, np.linalg.norm(gap, axis=1))
    return least


def random_grid(seed: int, share: float = 0.03, shape: tuple[int, int, int] = (14, 11, 9), h: float = 0.3) -> VoxelGrid:
    rng = np.random.default_rng(seed)
    occupied = rng.random(shape) < share
    occupied[3:7, 2:6, 1:5] = True  # something with an inside
    return VoxelGrid(occupied, tuple(rng.uniform(-3, 0, 3)), h)


def some_points(grid: VoxelGrid, seed: int, count: int = 600) -> np.ndarray:
    """In and around the grid, among them corners, faces and voxels' centres."""
    rng = np.random.default_rng(seed)
    size = np.array(grid.occupied.shape)
    places = rng.uniform(-4, size + 4, (count, 3))
    places[: count // 6] = np.round(places[: count // 6])
    places[count // 6 : count // 3, 0] = np.round(places[count // 6 : count // 3, 0])
    places[count // 3 : count // 2] = np.floor(places[count // 3 : count // 2]) + 0.5
    return np.array(grid.origin) + grid.resolution * places


def bounds(grid: VoxelGrid, points: np.ndarray) -> np.ndarray:
    return np.array([field_bound(grid.field, *p) for p in points])


@pytest.mark.parametrize("share", [0.0005, 0.02, 0.5, 1.0])
def test_the_distances_at_the_corners_are_those_of_an_exact_transform(share: float) -> None:
    occupied = np.random.default_rng(1).random((17, 12, 8)) < share
    occupied[5, 6, 7] = True
    padded = np.pad(occupied, 1)
    around = sum(
        padded[a : a + 18, b : b + 13, c : c + 9].astype(int) for a in (0, 1) for b in (0, 1) for c in (0, 1)
    )  # occupied voxels of the eight about a corner
    expected = 0.25 * (distance_transform_edt(around == 0) - distance_transform_edt(around == 8))
    np.testing.assert_allclose(signed_distances(occupied, 0.25), expected, rtol=1e-7, atol=0)


def test_at_every_corner_outside_the_distance_is_that_to_the_nearest_cube() -> None:
    grid = random_grid(2)
    corners = np.stack(np.meshgrid(*(np.arange(n + 1) for n in grid.occupied.shape), indexing="ij"), -1).reshape(-1, 3)
    truth = to_cubes(np.array(grid.origin) + grid.resolution * corners, grid.occupied, np.array(grid.origin), 0.3)
    np.testing.assert_allclose(np.maximum(grid.field.distances.ravel(), 0.0), truth, rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_the_bound_never_exceeds_the_truth_and_is_close_to_it(seed: int) -> None:
    grid = random_grid(seed, share=0.01 * seed)
    points = some_points(grid, seed)
    truth = to_cubes(points, grid.occupied, np.array(grid.origin), grid.resolution)
    found = bounds(grid, points)
    assert (found <= truth + 1e-12).all()
    places = (points - grid.origin) / grid.resolution
    within = (truth > 0) & ((places >= 0) & (places <= grid.occupied.shape)).all(axis=1)
    assert (truth - found)[within].max() <= 0.95 * grid.resolution
    assert np.median((truth - found)[within]) <= 0.15 * grid.resolution


def test_inside_a_solid_the_bound_is_at_least_as_deep_as_the_truth() -> None:
    occupied = np.zeros((12, 12, 12), dtype=bool)
    occupied[2:10, 3:9, 1:11] = True
    grid = VoxelGrid(occupied, (0, 0, 0), 0.5)
    points = np.random.default_rng(3).uniform((1.0, 1.5, 0.5), (5.0, 4.5, 5.5), (400, 3))
    depth = np.minimum(points - (1.0, 1.5, 0.5), np.array((5.0, 4.5, 5.5)) - points).min(axis=1)
    assert (bounds(grid, points) <= -depth + 1e-12).all()


@pytest.mark.parametrize("seed", range(3))
def test_the_distance_looked_up_is_exact_up_to_where_it_was_asked_for(seed: int) -> None:
    grid = random_grid(10 + seed, share=0.02 * seed)
    points = some_points(grid, seed, 300)
    truth = to_cubes(points, grid.occupied, np.array(grid.origin), grid.resolution)
    most = 0.9
    found = np.array([field_distance(grid.field, *p, most) for p in points])
    free = truth > 1e-9
    near = free & (truth < most - 1e-9)
    np.testing.assert_allclose(found[near], truth[near], atol=1e-9)
    far = free & (truth > most + 1e-9)
    assert near.any()
    assert far.any()
    assert (found[far] >= most - 1e-9).all()
    assert (found[far] <= truth[far] + 1e-12).all()
    assert (found[~free] <= 1e-12).all()


def test_the_interpolated_value_is_continuous_within_the_lattice_across_its_sides_and_beyond() -> None:
    grid = random_grid(4)
    rng = np.random.default_rng(4)
    start, way = rng.uniform(-4, 3, (40, 3)), rng.normal(size=(40, 3))
    fine = np.linspace(0.0, 1.0, 2000)
    d, o = grid.field.distances, grid.field.origin
    for a, w in zip(start, 4 * way / np.linalg.norm(way, axis=1, keepdims=True), strict=True):
        values = np.array([interpolate(d, *o, grid.resolution, np.inf, *(a + s * w))[0] for s in fine])
        assert np.abs(np.diff(values)).max() < 1.8 * 4 / 1999  # |gradient| <= sqrt 3


def test_the_interpolated_gradient_is_the_central_difference() -> None:
    grid = random_grid(5)
    d, o, h = grid.field.distances, grid.field.origin, 1e-6
    inner = np.random.default_rng(5).uniform(0.1, 0.9, (200, 3)) + np.random.default_rng(6).integers(-3, 16, (200, 3))
    for p in o + grid.resolution * inner:  # not on a side of a cell, where the gradient may jump
        _, *gradient = interpolate(d, *o, grid.resolution, np.inf, *p)
        numeric = [
            (
                interpolate(d, *o, grid.resolution, np.inf, *(p + h * e))[0]
                - interpolate(d, *o, grid.resolution, np.inf, *(p - h * e))[0]
            )
            / (2 * h)
            for e in np.eye(3)
        ]
        np.testing.assert_allclose(gradient, numeric, atol=1e-6)


def test_the_cost_near_voxels_has_the_gradient_that_it_says() -> None:
    grid = random_grid(6)
    world = World(WALLS, [grid, Sphere((2, 2, 2), 1)])
    cost = SplineCost(world, np.array([-4.0, -4, -4]), np.array([4.0, 4, 4]), 16, LIMITS, 0.8)
    line = np.linspace(-3, 3, 10)[:, None] * np.ones(3)
    x = (line + np.random.default_rng(7).normal(0, 0.8, (10, 3))).ravel()
    value, gradient = cost(x)
    assert value > cost.terms(x).obstacle > 0
    for way in np.random.default_rng(8).normal(size=(10, x.size)):
        numeric = (cost(x + 1e-7 * way)[0] - cost(x - 1e-7 * way)[0]) / 2e-7
        assert gradient @ way == pytest.approx(numeric, rel=1e-4, abs=1e-3)


def test_a_far_value_is_left_out_only_where_no_corner_of_its_cell_is_near() -> None:
    grid = random_grid(7)
    d, o = grid.field.distances, grid.field.origin
    for p in some_points(grid, 7, 300):
        full = interpolate(d, *o, grid.resolution, np.inf, *p)
        short = interpolate(d, *o, grid.resolution, 0.5, *p)
        assert short == full or (full[0] > 0.5 and short[0] == np.inf)


def voxelised(box: Box, h: float) -> VoxelGrid:
    low = np.array(box.lower)
    shape = np.round((np.array(box.upper) - low) / h).astype(int)
    return VoxelGrid(np.ones(shape, dtype=bool), tuple(low), h)


def test_a_robot_passes_a_gap_between_voxels_that_it_truly_fits_through() -> None:
    # The gap is 0.7 m, the robot 0.69 m wide: 5 mm a side, where the coarse bound alone loses 7.
    boxes = [Box((4.0, -4, -2), (4.5, 0.0, 2)), Box((4.0, 0.7, -2), (4.5, 4, 2))]
    world = World(((0, -4, -2), (9, 4, 2)), [voxelised(box, 0.1) for box in boxes])
    points = np.linspace((1.0, 0.35, 0.05), (8.0, 0.35, 0.05), 12)
    proof = certify(points, clamped_knots(12), world, 0.345)
    assert proof.certified
    assert proof.obstacle_distance == pytest.approx(0.35, abs=1.1e-3)
    assert field_bound(world.scene.field, 4.25, 0.35, 0.05) < 0.3  # what the corners alone would have said
    assert nearest_solid(world.scene, 4.25, 0.35, 0.05)[0] == pytest.approx(0.35)
    assert not certify(points, clamped_knots(12), world, 0.3501).certified


@pytest.mark.parametrize("seed", range(6))
def test_no_curve_is_proved_for_more_than_its_samples_keep_from_the_cubes(seed: int) -> None:
    grid = random_grid(20 + seed, share=0.004)
    world = World(WALLS, [grid])
    rng = np.random.default_rng(seed)
    proved = 0
    for _ in range(12):
        points, knots = rng.uniform(-3.5, 3.5, (9, 3)), clamped_knots(9)
        samples = evaluate(points, knots, np.linspace(0, 1, 20_000))
        truth = to_cubes(samples, grid.occupied, np.array(grid.origin), grid.resolution).min()
        proof = certify(points, knots, world, max(0.9 * truth, 1e-3), full=True)
        assert proof.obstacle_distance <= truth + 1e-9
        if truth > 0.02:
            assert proof.certified
            assert proof.obstacle_distance >= truth - 3e-3  # TOLERANCE, and what lies between samples
            proved += 1
    assert proved >= 3


def test_a_point_blocks_the_voxel_that_it_is_in() -> None:
    cloud = PointCloud(np.array([[0.05, 0.05, 0.05], [0.31, -0.01, 0.95]]), 0.1)
    world = World(WALLS, [cloud])
    found = world.distance(np.array([[0.05, 0.05, 0.3], [0.35, 0.15, 0.95], [0.35, -0.25, 0.95], [0.05, 0.05, 0.02]]))
    np.testing.assert_allclose(found[:3], [0.2, 0.15, 0.15], atol=1e-9)
    assert found[3] <= 0


def test_a_lone_voxel_is_seen_from_far_outside_its_lattice() -> None:
    world = World(WALLS, [PointCloud(np.array([[0.05, 0.05, 0.05]]), 0.1)])
    found = world.distance(np.array([[3.1, 4.1, 0.05], [-0.3, 0.05, 0.05]]))
    assert 4.0 < found[0] <= 5.0
    assert found[1] == pytest.approx(0.3)


@pytest.mark.parametrize("h", [0.05, 0.1, 0.2, 0.3])
@pytest.mark.parametrize("offset", [5e5, 5.4e6, -1e7])
def test_in_a_far_corner_of_the_frame_distances_outside_the_lattice_are_not_above_the_truth(
    offset: float, h: float
) -> None:
    rng = np.random.default_rng(int(1000 * h))
    origin = np.array([offset, -offset, 100.0])
    for _ in range(60):
        shape = rng.integers(1, 14, 3)
        world = World((tuple(origin - 20), tuple(origin + 20)), [VoxelGrid(np.ones(shape, bool), tuple(origin), h)])
        points = origin + rng.uniform(-1.0, shape * h + 1.0, (40, 3))
        nearest = np.clip(points - origin, 0.0, shape * h)  # differences of near numbers are exact
        truth = np.linalg.norm(points - origin - nearest, axis=1)
        outside = truth > 0.0
        distance = world.distance(points)[outside]
        assert (distance <= truth[outside] + 1e-8).all(), "a voxel was looked past"


def test_distances_of_a_mixed_world_are_the_least_of_all_its_obstacles() -> None:
    grid, ball = random_grid(8), Sphere((2, -2, 1), 0.7)
    points = np.random.default_rng(9).uniform(-5, 5, (500, 3))
    cubes = to_cubes(points, grid.occupied, np.array(grid.origin), grid.resolution)
    expected = np.minimum(cubes, np.linalg.norm(points - ball.centre, axis=1) - 0.7)
    found = World(WALLS, [grid, ball]).distance(points)
    outside = expected > 0
    near = outside & (expected < 8 * grid.resolution)
    np.testing.assert_allclose(found[near], expected[near], atol=1e-9)
    assert (found[outside] <= expected[outside] + 1e-12).all()


def test_fields_of_one_lattice_are_merged_and_others_refused() -> None:
    a, b = PointCloud(np.array([[0.05, 0, 0]]), 0.1), PointCloud(np.array([[2.05, 1, -1]]), 0.1)
    points = np.random.default_rng(10).uniform(-3, 3, (200, 3))
    each = np.minimum(World(WALLS, [a]).distance(points), World(WALLS, [b]).distance(points))
    both = World(WALLS, [a, Sphere((0, 4, 0), 0.1), b]).scene.field
    bound = np.array([field_distance(both, *p, 0.8) for p in points])
    np.testing.assert_allclose(np.minimum(bound, 0.75), np.minimum(each, 0.75), atol=1e-9)
    with pytest.raises(ValueError, match=r"obstacles 0 and 2: expected voxels of one size, found 0.1 m and 0.2 m"):
        World(WALLS, [a, Sphere((0, 4, 0), 0.1), PointCloud(b.points, 0.2)])
    with pytest.raises(ValueError, match=r"obstacles 0 and 1: expected voxels of one lattice, .*19.500, 10.000"):
        World(WALLS, [a, PointCloud(b.points, 0.1, origin=(0.05, 0, 0))])
    far = PointCloud(np.array([[4000.05, 4000.0, 4000.0]]), 0.1)
    with pytest.raises(ValueError, match=r"obstacles 0, 1: expected at most 40000000 voxels"):
        World(WALLS, [a, far])


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: VoxelGrid(np.zeros((2, 2)), (0, 0, 0), 0.1), "bool array"),
        (lambda: VoxelGrid(np.zeros((2, 2, 2)), (0, 0, 0), 0.1), "bool array"),
        (lambda: VoxelGrid(np.zeros((2, 0, 2), bool), (0, 0, 0), 0.1), "voxels: expected 1 to"),
        (lambda: VoxelGrid(np.zeros((2, 2, 2), bool), (0, np.nan, 0), 0.1), "voxels origin"),
        (lambda: VoxelGrid(np.zeros((2, 2, 2), bool), (0, 0, 0), 0.0), "voxels resolution"),
        (lambda: PointCloud(np.zeros((5, 2)), 0.1), r"\(n, 3\), found float64 \(5, 2\)"),
        (lambda: PointCloud(np.array([[0, 0, 0], [1, np.inf, 0]]), 0.1), "cloud point 1"),
        (lambda: PointCloud(np.array([[0, 0, 0], [1e6, 1e6, 1e6]]), 0.1), "crop it or take larger voxels"),
        (lambda: PointCloud(np.zeros((1, 3)), -1.0), "cloud resolution"),
    ],
)
def test_what_is_no_grid_or_cloud_is_refused_where_it_is_built(build: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        build()  # type: ignore[operator]


def test_empty_grids_and_clouds_are_free_space() -> None:
    grid, cloud = VoxelGrid(np.zeros((3, 3, 3), bool), (0, 0, 0), 0.5), PointCloud(np.empty((0, 3)), 0.5)
    assert World(WALLS, [grid, cloud]).distance(np.zeros((1, 3)))[0] == np.inf


def test_a_world_of_voxels_survives_pickling_and_equals_itself() -> None:
    points = np.random.default_rng(12).uniform(-5, 5, (50, 3))
    cloud = PointCloud(points, 0.3, (0, 0, 0.1))
    for one, other in ((random_grid(11), random_grid(12)), (cloud, PointCloud(points[:49], 0.3, (0, 0, 0.1)))):
        world = World(WALLS, [one])
        copy = pickle.loads(pickle.dumps(world))
        assert copy == world
        assert copy != World(WALLS, [other])
        assert hash(copy.obstacles[0]) == hash(one)
        np.testing.assert_array_equal(copy.distance(points), world.distance(points))


def test_a_start_among_voxels_is_refused_by_its_true_distance() -> None:
    world = World(((0, -4, -2), (9, 4, 2)), [Sphere((8, 3, 0), 0.1), voxelised(Box((4.0, -4, -2), (4.5, 4, 2)), 0.1)])
    with pytest.raises(StartInCollision, match=r"0.250 m from obstacle 1 \(voxel grid\)"):
        plan(world, (3.75, 0.05, 0.05), (1, 0, 0), LIMITS, 0.3)
    p = plan(world, (3.699, 0.05, 0.05), (1, 0, 0), LIMITS, 0.3)  # where the coarse bound says 0.294
    assert p.certified


def test_a_plan_around_a_cloud_keeps_its_radius_from_every_blocked_voxel() -> None:
    rng = np.random.default_rng(13)
    cloud = PointCloud(np.concatenate([rng.normal((5, y, 1.5), (0.3, 0.6, 1.0), (300, 3)) for y in (3, 5, 7.5)]), 0.15)
    world = World(((0, 0, 0), (10, 10, 3)), [cloud])
    p = plan(world, (1, 5, 1.5), (9, 5, 1.5), LIMITS, 0.3)
    assert p.certified
    blocked = np.unique(np.floor(cloud.points / 0.15), axis=0)
    grid = np.zeros((blocked.max(axis=0) - blocked.min(axis=0) + 1).astype(int), dtype=bool)
    grid[tuple((blocked - blocked.min(axis=0)).astype(int).T)] = True
    samples = p.trajectory.position(np.linspace(0, p.trajectory.duration, 1500))
    truth = to_cubes(samples, grid, 0.15 * blocked.min(axis=0), 0.15).min()
    assert 0.3 + p.clearance <= truth + 1e-9
    assert truth <= 0.3 + p.clearance + 5e-3
