"""A judge of trajectories that shares no code with the planner: dense samples, its own distances, finite differences.

The curve is evaluated by scipy's BSpline from control points and knots. Distances are written for being read, not for
speed: a box, a cylinder, a sphere and a polygon prism by clamping to the solid, voxels by the exact distance to cubes.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline
from scipy.spatial import cKDTree

from planner import Box, Cylinder, Limits, Prism, Sphere, Trajectory, VoxelGrid, World

STEP = 1e-3
"""Between samples [s]; at 3 m/s the curve moves 3 mm."""
ROUNDING = 1e-7


@dataclass(frozen=True, slots=True)
class Findings:
    """What was measured on the samples; `violations` is empty for a good trajectory."""

    clearance: float  # least distance to a solid or wall, minus the radius [m]
    speed: float  # [m/s]
    acceleration: float  # [m/s^2]
    jerk: float  # [m/s^3]
    violations: tuple[str, ...]


def check(trajectory: Trajectory, world: World, limits: Limits, radius: float) -> Findings:
    """Measure a trajectory against the world and the limits it was planned for."""
    spline = BSpline(trajectory.knots, trajectory.control_points, 3)
    duration = float(trajectory.knots[-1])
    t = np.linspace(0.0, duration, max(int(duration / STEP), 2000) + 1)
    x, h = spline(t), t[1] - t[0]
    derivative, peaks = x, []
    for _ in range(3):  # a mean of the derivative over the samples' span: never above its maximum
        derivative = np.diff(derivative, axis=0) / h
        peaks.append(float(np.linalg.norm(derivative, axis=1).max()))
    low, high = np.array(world.bounds)
    clearance = min(float((x - low).min()), float((high - x).min()), distances(world, x)) - radius
    violations = []
    if clearance < -ROUNDING:
        violations.append(f"{-clearance:.2e} m too near")
    for k, (name, peak) in enumerate(zip(("speed", "acceleration", "jerk"), peaks, strict=True)):
        limit = getattr(limits, name)
        noise = 2.0 ** (k + 1) * np.abs(x).max() * 4e-16 / h ** (k + 1)  # of the differences
        if peak > limit * (1.0 + ROUNDING) + noise:
            violations.append(f"{name} {peak:.6g} above {limit:.6g}")
    return Findings(clearance, *peaks, tuple(violations))


def distances(world: World, x: np.ndarray) -> float:
    """Least signed distance of points (m, 3) to any obstacle [m]."""
    least = np.inf
    for obstacle in world.obstacles:
        least = min(least, float(_distance(obstacle, x).min()))
    return least


def _distance(obstacle: object, x: np.ndarray) -> np.ndarray:
    if isinstance(obstacle, Sphere):
        return np.linalg.norm(x - obstacle.centre, axis=1) - obstacle.radius
    if isinstance(obstacle, Box):
        outside = x - np.clip(x, obstacle.lower, obstacle.upper)
        depth = np.minimum(x - obstacle.lower, np.array(obstacle.upper) - x).min(axis=1)
        return np.where(depth > 0.0, -depth, np.linalg.norm(outside, axis=1))
    if isinstance(obstacle, Cylinder):
        across = np.linalg.norm(x[:, :2] - obstacle.centre, axis=1) - obstacle.radius
        return _upright(across, x[:, 2], obstacle.z)
    if isinstance(obstacle, Prism):
        return _upright(_polygon(np.array(obstacle.corners), x[:, :2]), x[:, 2], obstacle.z)
    if isinstance(obstacle, VoxelGrid):
        return cubes_distance(obstacle.occupied, np.array(obstacle.origin), obstacle.resolution, x)
    raise TypeError(f"no distance to a {type(obstacle).__name__} here")


def _upright(across: np.ndarray, z: np.ndarray, caps: tuple[float, float]) -> np.ndarray:
    """A solid between two heights from its outline's signed distance."""
    along = np.maximum(caps[0] - z, z - caps[1])
    outside = np.hypot(np.maximum(across, 0.0), np.maximum(along, 0.0))
    return np.where((across < 0.0) & (along < 0.0), np.maximum(across, along), outside)


def _polygon(corners: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Signed distance in the plane: the nearest edge, and inside by the even-odd rule."""
    a, b = corners, np.roll(corners, -1, axis=0)
    least, crossings = np.full(len(x), np.inf), np.zeros(len(x), dtype=int)
    for p, q in zip(a, b, strict=True):
        s = np.clip(((x - p) @ (q - p)) / ((q - p) @ (q - p)), 0.0, 1.0)
        least = np.minimum(least, np.linalg.norm(x - (p + s[:, None] * (q - p)), axis=1))
        spans = (p[1] > x[:, 1]) != (q[1] > x[:, 1])
        with np.errstate(divide="ignore", invalid="ignore"):
            crossings += spans & (x[:, 0] < p[0] + (x[:, 1] - p[1]) * (q[0] - p[0]) / (q[1] - p[1]))
    return np.where(crossings % 2 == 1, -least, least)


def cubes_distance(occupied: np.ndarray, origin: np.ndarray, edge: float, x: np.ndarray) -> np.ndarray:
    """Distance of points (m, 3) to the nearest occupied cube, 0 inside: exact, among the cubes that can be it."""
    centres = origin + (np.argwhere(occupied) + 0.5) * edge
    tree = cKDTree(centres)
    nearest, _ = tree.query(x)
    least = np.empty(len(x))
    for i, (point, reach) in enumerate(zip(x, nearest, strict=True)):
        near = centres[tree.query_ball_point(point, reach + edge * np.sqrt(3.0))]
        least[i] = np.linalg.norm(np.maximum(np.abs(point - near) - edge / 2.0, 0.0), axis=1).min()
    return least
