"""What is called certified, judged by `checker`: `python -m benchmarks.bench_certificates [share of the worlds]`.

Families, mazes, cluttered rooms with thin sheets, prisms, voxels, clouds, moving starts, via points, movers, and boxes
and voxels thousands of kilometres from the origin; every certified trajectory is sampled each millisecond, its ends,
its via points and what moves included. One line a kind, and every violation in full. Exit code 1 when there is any.
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from benchmarks.bench_planner import LIMITS, cluttered
from benchmarks.checker import Asked, check
from planner import (
    Box,
    Limits,
    MovingBox,
    MovingSphere,
    PlannerError,
    PointCloud,
    Prism,
    VoxelGrid,
    World,
    plan,
)
from planner.families import BOUNDS, FAMILIES, HEIGHT, RADIUS, make


@dataclass(slots=True)
class Tally:
    """Of one kind of question."""

    certified: int = 0
    refused: int = 0
    clearance: float = np.inf  # least one measured beyond the radius [m]
    shares: np.ndarray = field(default_factory=lambda: np.zeros(3))  # largest part of each limit that was used
    violations: list[str] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Question:
    """One plan to make."""

    kind: str
    seed: int
    world: World
    start: np.ndarray
    goal: np.ndarray
    limits: Limits
    radius: float
    more: dict[str, Any]


def questions(share: float) -> Iterator[Question]:
    """About 3000 at a share of 1."""

    def seeds(count: int) -> range:
        return range(max(1, round(count * share)))

    nothing: dict[str, Any] = {}
    for family in FAMILIES:
        for seed in seeds(300 if family == "maze" else 60):
            s = make(family, seed)
            yield Question(family, seed, s.world, np.array(s.start), np.array(s.goal), LIMITS, RADIUS, nothing)
    for radius in (0.0, 0.05, 0.3, 0.6):
        for seed in seeds(300):
            room = cluttered(seed, radius)
            if room is not None:
                yield Question("clutter", seed, *room, LIMITS, radius, nothing)
    for seed in seeds(200):
        rng = np.random.default_rng([31, seed])
        limits = Limits(*np.exp(rng.uniform(np.log([0.3, 0.5, 2.0]), np.log([15.0, 30.0, 500.0]))))
        prisms = [_prism(rng) for _ in range(12)]
        yield Question("prisms", seed, World(BOUNDS, prisms), *_ends(rng), limits, RADIUS, nothing)
    for seed in seeds(40):
        rng = np.random.default_rng([32, seed])
        occupied = rng.random((60, 80, 16)) < 0.003
        grid = VoxelGrid(occupied, (4.0, 2.0, 0.0), 0.2)
        yield Question("voxels", seed, World(BOUNDS, [grid]), *_ends(rng), LIMITS, 0.15, nothing)
    for seed in seeds(300):
        s, rng = make(("forest", "L", "Omega")[seed % 3], seed), np.random.default_rng([33, seed])
        more = {"start_velocity": _within(rng, 2.5), "start_acceleration": _within(rng, 4.0)}
        if seed % 2:
            more["goal_velocity"] = _within(rng, 1.5)
        yield Question("moving ends", seed, s.world, np.array(s.start), np.array(s.goal), LIMITS, RADIUS, more)
    for seed in seeds(150):
        s, rng = make("forest", 1000 + seed), np.random.default_rng([34, seed])
        points = rng.uniform([4.0, 3.0, 0.8], [16.0, 17.0, 3.2], (40, 3))
        clear = points[s.world.distance(points) > RADIUS + 0.1][:2]
        yield Question("via", seed, s.world, np.array(s.start), np.array(s.goal), LIMITS, RADIUS, {"via": clear})
    for seed in seeds(40):
        rng = np.random.default_rng([35, seed])
        cloud = PointCloud(rng.uniform([4.0, 2.0, 0.0], [16.0, 18.0, 4.0], (150, 3)), 0.2)
        yield Question("clouds", seed, World(BOUNDS, [cloud]), *_ends(rng), LIMITS, 0.15, nothing)
    for seed in seeds(100):
        rng = np.random.default_rng([36, seed])
        s = make("forest", 2000 + seed)
        movers = {"movers": [_mover(rng) for _ in range(int(rng.integers(1, 7)))]}
        yield Question("movers", seed, s.world, np.array(s.start), np.array(s.goal), LIMITS, RADIUS, movers)
    for seed in seeds(100):
        rng = np.random.default_rng([37, seed])
        corner = rng.choice([-1.0, 1.0], 3) * (5e6, rng.uniform(4e6, 5e6), 100.0)
        boxes = [_box(rng, corner) for _ in range(12)]
        far = World((tuple(corner), tuple(corner + np.array(BOUNDS[1]))), boxes)
        yield Question("far boxes", seed, far, *(corner + end for end in _ends(rng)), LIMITS, RADIUS, nothing)
    for seed in seeds(40):
        rng = np.random.default_rng([38, seed])
        corner = np.array([rng.uniform(2e5, 8e5), rng.uniform(1e6, 9e6), rng.uniform(0.0, 2e3)])  # UTM
        grid = VoxelGrid(rng.random((60, 80, 16)) < 0.003, tuple(corner + np.array([4.0, 2.0, 0.0])), 0.2)
        far = World((tuple(corner), tuple(corner + np.array(BOUNDS[1]))), [grid])
        yield Question("far voxels", seed, far, *(corner + end for end in _ends(rng)), LIMITS, 0.15, nothing)


def _prism(rng: np.random.Generator) -> Prism:
    """A star of 3 to 8 corners, often not convex."""
    n = int(rng.integers(3, 9))
    angles = 2.0 * np.pi * (np.arange(n) + rng.uniform(0.0, 0.8, n)) / n
    reach = rng.uniform(0.4, 2.0, n)
    centre = rng.uniform([4.0, 2.0], [16.0, 18.0])
    corners = centre + reach[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    top = float(rng.choice([HEIGHT, rng.uniform(1.0, 3.5)]))
    return Prism(tuple(map(tuple, corners.tolist())), (0.0, top))


def _box(rng: np.random.Generator, corner: np.ndarray) -> Box:
    """A block, a slab or a thin sheet."""
    size = rng.uniform(0.2, 2.0, 3)
    size[rng.integers(3)] = float(rng.choice([1e-3, 0.1, 4.0]))
    low = corner + rng.uniform([4.0, 2.0, 0.0], [14.0, 16.0, 3.0])
    return Box(tuple(low), tuple(low + size))


def _mover(rng: np.random.Generator) -> MovingSphere | MovingBox:
    """Some come fast, grow, are seen before or after the start, or are predicted for a while only."""
    centre = rng.uniform([4.0, 2.0, 0.5], [16.0, 18.0, 3.5])
    stamp = float(rng.choice([0.0, 0.0, -2.0, 3.0]))
    common = {
        "velocity": tuple(rng.normal(size=3) * (2.0, 2.0, 0.3) * float(rng.choice([0.0, 0.5, 1.0, 5.0]))),
        "growth": float(rng.choice([0.0, 0.0, 0.1])),
        "stamp": stamp,
        "until": float(rng.choice([np.inf, stamp + 4.0])),
    }
    if rng.random() < 0.5:
        return MovingSphere(tuple(centre), radius=float(rng.choice([0.0, 0.3, 0.6])), **common)
    return MovingBox(tuple(centre), tuple(centre + rng.uniform(0.01, 0.8, 3)), **common)


def _ends(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    y = rng.uniform(4.0, 16.0, 2)
    return np.array([1.0, y[0], 1.5]), np.array([19.0, y[1], 1.5])


def _within(rng: np.random.Generator, most: float) -> np.ndarray:
    v = rng.normal(size=3) * [1.0, 1.0, 0.4]
    return v / np.linalg.norm(v) * rng.uniform(0.0, most)


def judge(share: float) -> dict[str, Tally]:
    """Plan every question and check what is certified."""
    tallies: dict[str, Tally] = {}
    for q in questions(share):
        tally = tallies.setdefault(q.kind, Tally())
        try:
            p = plan(q.world, q.start, q.goal, q.limits, q.radius, q.seed, **q.more)
        except PlannerError:
            tally.refused += 1
            continue
        tally.certified += p.certified
        found = check(p.trajectory, q.world, q.limits, q.radius, Asked(q.start, q.goal, **q.more))
        used = (found.speed / q.limits.speed, found.acceleration / q.limits.acceleration, found.jerk / q.limits.jerk)
        tally.clearance, tally.shares = min(tally.clearance, found.clearance), np.maximum(tally.shares, used)
        wrong = list(found.violations) if p.certified else ["handed over without a certificate"]
        if not found.from_obstacles >= p.clearance - 1e-7:
            wrong.append(f"clearance {found.from_obstacles:.6f} m, {p.clearance:.6f} m claimed")
        tally.violations += [f"{q.kind} {q.seed}: {text}" for text in wrong]
    return tallies


def main() -> None:
    share = float(sys.argv[1]) if __name__ == "__main__" and len(sys.argv) > 1 else 1.0
    tallies = judge(share)
    print("\n| worlds | certified | refused | violations | least clearance m | speed, acceleration, jerk used % |")
    print("|---|---|---|---|---|---|")
    for kind, t in tallies.items():
        used = ", ".join(f"{100.0 * s:.2f}" for s in t.shares)
        print(f"| {kind} | {t.certified} | {t.refused} | {len(t.violations)} | {t.clearance:.6f} | {used} |")
    violations = [line for t in tallies.values() for line in t.violations]
    certified = sum(t.certified for t in tallies.values())
    print(f"\n{certified} certified trajectories checked, {len(violations)} violations")
    for line in violations[:50]:
        print(line)
    if violations:
        sys.exit(1)


if __name__ == "__main__":
    main()
