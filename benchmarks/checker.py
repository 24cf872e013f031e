"""A judge of trajectories that shares no code with the planner: dense samples, its own distances, finite differences.

The curve is evaluated by scipy's BSpline from control points and knots, reckoned from its first control point, so that
far maps cost its derivatives no digits. Distances are written for being read, not for speed: a box, a cylinder, a
sphere, a mover and a polygon prism by clamping to the solid, voxels and clouds by the exact distance to cubes. What is
no number is a violation.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.interpolate import BSpline
from scipy.spatial import cKDTree

from planner import (
    Box,
    Cylinder,
    Limits,
    MovingBox,
    MovingSphere,
    PointCloud,
    Prism,
    Sphere,
    Trajectory,
    VoxelGrid,
    World,
)

STEP = 1e-3
"""Between samples [s]; at 3 m/s the curve moves 3 mm."""
ROUNDING = 1e-7
NEAR, FINER, ROUNDS = 0.1, 50, 3
"""Where a curve comes within NEAR [m] of a via point, it is sampled FINER so many times in a row."""


@dataclass(frozen=True, slots=True)
class Asked:
    """What a trajectory was asked for besides keeping off solids; what is None is not checked."""

    start: Sequence[float] | np.ndarray | None = None  # (3,) [m]
    goal: Sequence[float] | np.ndarray | None = None  # (3,) [m]
    start_velocity: Sequence[float] | np.ndarray = (0.0, 0.0, 0.0)  # [m/s], checked if `start` is
    start_acceleration: Sequence[float] | np.ndarray = (0.0, 0.0, 0.0)  # [m/s^2]
    goal_velocity: Sequence[float] | np.ndarray = (0.0, 0.0, 0.0)  # [m/s], checked if `goal` is
    via: Sequence[Sequence[float]] | np.ndarray = ()  # (m, 3) passed in this order [m]
    movers: Sequence[MovingSphere | MovingBox] = field(default_factory=tuple)  # on the trajectory's time


@dataclass(frozen=True, slots=True)
class Findings:
    """What was measured on the samples; `violations` is empty for a good trajectory."""

    clearance: float  # least distance to a solid, wall or mover, minus the radius [m]
    from_obstacles: float  # the same, walls left out
    speed: float  # [m/s]
    acceleration: float  # [m/s^2]
    jerk: float  # [m/s^3]
    violations: tuple[str, ...]


def check(trajectory: Trajectory, world: World, limits: Limits, radius: float, asked: Asked | None = None) -> Findings:
    """Measure a trajectory against the world and the limits it was planned for, and what else was asked."""
    asked = asked or Asked()
    points, knots = np.array(trajectory.control_points), np.array(trajectory.knots)
    if not (np.isfinite(points).all() and np.isfinite(knots).all() and np.isfinite(radius) and knots[-1] > 0.0):
        return Findings(*[np.nan] * 5, ("not all of it are finite numbers",))
    origin, spline = points[0].copy(), BSpline(knots, points - points[0], 3)
    duration = float(knots[-1])
    t = np.linspace(0.0, duration, max(int(duration / STEP), 2000) + 1)
    relative, h = spline(t), t[1] - t[0]
    x = relative + origin
    derivative, peaks = relative, []
    for _ in range(3):  # a mean of the derivative over the samples' span: never above its maximum
        derivative = np.diff(derivative, axis=0) / h
        peaks.append(float(np.linalg.norm(derivative, axis=1).max()))
    low, high = np.array(world.bounds)
    gaps = {"a wall": float(min((x - low).min(), (high - x).min())), "a solid": distances(world, x)}
    gaps |= {f"mover {k}": mover_distance(mover, t, x) for k, mover in enumerate(asked.movers)}
    violations = [
        f"{radius - gap:.2e} m too near to {what}" for what, gap in gaps.items() if not gap - radius >= -ROUNDING
    ]
    for k, (name, peak) in enumerate(zip(("speed", "acceleration", "jerk"), peaks, strict=True)):
        limit = getattr(limits, name)
        noise = 2.0 ** (k + 1) * np.abs(relative).max() * 4e-16 / h ** (k + 1)  # of the differences
        if not peak <= limit * (1.0 + ROUNDING) + noise:
            violations.append(f"{name} {peak:.6g} above {limit:.6g}")
    violations += ends(spline, origin, limits, asked)
    violations += passing(spline, origin, t, relative, asked.via)
    obstacles = min(gap for what, gap in gaps.items() if what != "a wall")
    return Findings(min(gaps.values()) - radius, obstacles - radius, *peaks, tuple(violations))


def ends(spline: BSpline, origin: np.ndarray, limits: Limits, asked: Asked) -> list[str]:
    """What is wrong with the states at both ends."""
    T, still, wrong = float(spline.t[-1]), np.zeros(3), []
    wanted = []
    if asked.start is not None:
        first = np.array(asked.start, dtype=float) - origin, asked.start_velocity, asked.start_acceleration
        wanted.append(("start", 0.0, first))
    if asked.goal is not None:
        wanted.append(("goal", T, (np.array(asked.goal, dtype=float) - origin, asked.goal_velocity, still)))
    scales = (1.0, limits.speed, limits.acceleration)
    for name, at, state in wanted:
        for order, (value, scale) in enumerate(zip(state, scales, strict=True)):
            off = float(np.linalg.norm(spline(at, order) - np.array(value)))
            if not off <= ROUNDING * max(scale, 1.0):
                wrong.append(f"{name}: {('position', 'velocity', 'acceleration')[order]} off by {off:.2e}")
    return wrong


def passing(
    spline: BSpline, origin: np.ndarray, t: np.ndarray, x: np.ndarray, via: Sequence[Sequence[float]] | np.ndarray
) -> list[str]:
    """Via points that are not passed, or not in their order; x are the samples at t, reckoned from the origin."""
    last, wrong = 0.0, []
    for k, point in enumerate(via):
        p = np.array(point, dtype=float) - origin
        d = np.linalg.norm(x - p, axis=1)
        beside = np.concatenate([[np.inf], d, [np.inf]])
        dips = np.flatnonzero((d <= beside[:-2]) & (d <= beside[2:]) & (d < NEAR))
        least, passed = np.inf, None
        for i in dips:
            low, high = max(t[max(i - 1, 0)], last), t[min(i + 1, len(t) - 1)]
            for _ in range(ROUNDS if high > low else 0):
                fine = np.linspace(low, high, FINER)
                away = np.linalg.norm(spline(fine) - p, axis=1)
                j = int(away.argmin())
                low, high = fine[max(j - 1, 0)], fine[min(j + 1, FINER - 1)]
                least = min(least, float(away[j]))
            if high > low and away[j] <= 10.0 * ROUNDING:
                passed = float(fine[j])
                break
        if passed is None:
            wrong.append(f"via point {k}: missed by {min(least, float(d.min()) if not len(dips) else least):.2e} m")
        else:
            last = passed
    return wrong


def mover_distance(mover: MovingSphere | MovingBox, t: np.ndarray, x: np.ndarray) -> float:
    """Least signed distance of places x (m, 3) at times t (m,) to where a mover is by then, while it is predicted."""
    t, x = t[t <= mover.until], x[t <= mover.until]
    if not len(t):
        return np.inf
    since = t - mover.stamp
    there = x - since[:, None] * np.array(mover.velocity)  # in its own frame
    grown = mover.growth * np.abs(since)
    if isinstance(mover, MovingSphere):
        return float((np.linalg.norm(there - mover.centre, axis=1) - mover.radius - grown).min())
    beyond = np.maximum(np.array(mover.lower) - there, there - np.array(mover.upper)) - grown[:, None]
    return float(_outside_or_depth(beyond).min())


def _outside_or_depth(beyond: np.ndarray) -> np.ndarray:
    """Signed distance to a box from how far beyond its faces points are along each axis (..., 3)."""
    return np.linalg.norm(np.maximum(beyond, 0.0), axis=-1) + np.minimum(beyond.max(axis=-1), 0.0)


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
        return cubes_distance(np.argwhere(obstacle.occupied), np.array(obstacle.origin), obstacle.resolution, x)
    if isinstance(obstacle, PointCloud):
        places = np.floor((obstacle.points - np.array(obstacle.origin)) / obstacle.resolution)
        return cubes_distance(np.unique(places, axis=0), np.array(obstacle.origin), obstacle.resolution, x)
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


def cubes_distance(places: np.ndarray, origin: np.ndarray, edge: float, x: np.ndarray) -> np.ndarray:
    """Signed distance of points (m, 3) to the nearest of cubes (n, 3): exact, among those that can be it.

    Inside a cube it is minus the depth below that cube's nearest face. Reckoned from the cubes' own corner.
    """
    if not len(places):
        return np.full(len(x), np.inf)
    centres, x = (places + 0.5) * edge, x - origin
    tree = cKDTree(centres)
    nearest, _ = tree.query(x)
    least = np.empty(len(x))
    for i, (point, reach) in enumerate(zip(x, nearest, strict=True)):
        near = centres[tree.query_ball_point(point, reach + edge * np.sqrt(3.0))]
        least[i] = _outside_or_depth(np.abs(point - near) - edge / 2.0).min()
    return least
