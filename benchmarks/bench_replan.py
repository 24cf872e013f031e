"""Planning in flight: `python -m benchmarks.bench_replan [runs] [movers]`.

Warm plans in the forests of `bench_planner`: at a moment of the flight a new tree stands near the way, or the goal has
moved by up to a metre. What is timed is the whole step: the check of what is flown, the plan and its proofs, the
trajectory, and the stop kept ready.

Flights among moving obstacles, in a 20 x 20 x 4 m arena with ten trees: balls of 0.3 to 0.5 m at 2 m/s that bounce off
walls and trees and take a new course now and then. The planner sees their place and velocity at 50 Hz and knows nothing
of what they will do. The vehicle (radius 0.3 m, limits 3/6/60) follows its trajectory exactly. Touching is looked for
every 5 ms.
"""

import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

import numpy as np

from benchmarks.bench_planner import world_of
from planner import Cylinder, Limits, World, plan, replan, warm_up
from planner.movers import MovingSphere
from planner.replan import Kind, Replanner, Settings

BOUNDS = ((0.0, 0.0, 0.0), (20.0, 20.0, 4.0))
LIMITS, RADIUS = Limits(3.0, 6.0, 60.0), 0.3
START, GOAL = np.array([1.0, 10.0, 1.5]), np.array([19.0, 10.0, 1.5])
TREES, SPEED, TICK, FINE = 10, 2.0, 0.02, 0.005
GROWTH = 0.4
"""What the planner assumes of a mover's uncertainty [m/s]."""
TURNS = 5.0
"""Mean time between a ball's changes of course, walls and trees apart [s]."""
LATEST = 30.0


class Balls:
    """The truth: balls that nobody has told the planner about."""

    def __init__(self, rng: np.random.Generator, count: int, trees: np.ndarray, turns: float) -> None:
        self.rng, self.trees, self.turns = rng, trees, turns
        self.radius = rng.uniform(0.3, 0.5, count)
        self.velocity = np.array([self.course() for _ in range(count)]).reshape(count, 3)
        self.position = np.empty((count, 3))
        for i in range(count):
            while True:
                r = self.radius[i]
                p = rng.uniform([r, r, r], [20.0 - r, 20.0 - r, 4.0 - r])
                clear = np.hypot(*(p[:2] - trees[:, :2]).T) > trees[:, 2] + r
                if clear.all() and min(np.linalg.norm(p - START), np.linalg.norm(p - GOAL)) > 3.0:
                    break
            self.position[i] = p

    def course(self) -> np.ndarray:
        v = self.rng.normal(size=3)
        return SPEED * v / np.linalg.norm(v)

    def advance(self, dt: float) -> None:
        p, v, r = self.position, self.velocity, self.radius
        p += v * dt
        for a, high in enumerate(BOUNDS[1]):
            low_hit, high_hit = p[:, a] < r, p[:, a] > high - r
            v[low_hit, a] = np.abs(v[low_hit, a])
            v[high_hit, a] = -np.abs(v[high_hit, a])
        for x, y, radius in self.trees:
            d = p[:, :2] - (x, y)
            far = np.hypot(d[:, 0], d[:, 1])
            for i in np.flatnonzero(far < radius + r):
                n = d[i] / far[i]
                along = v[i, :2] @ n
                if along < 0.0:
                    v[i, :2] -= 2.0 * along * n
        for i in np.flatnonzero(self.rng.random(len(p)) < dt / self.turns):
            v[i] = self.course()

    def gap(self, place: np.ndarray) -> tuple[float, int]:
        """Distance from the vehicle's hull to the nearest ball's, and which."""
        gaps = np.linalg.norm(self.position - place, axis=1) - self.radius - RADIUS
        return (float(gaps.min()), int(gaps.argmin())) if len(gaps) else (np.inf, -1)


@dataclass
class Run:
    seed: int
    outcome: str
    time: float
    closest: float
    milliseconds: list[float]
    kinds: dict[str, int]
    backups: int
    story: str = ""


def fly(seed: int, movers: int = 20, turns: float = TURNS, settings: Settings | None = None, tell: bool = False) -> Run:
    """One run from start to goal."""
    rng = np.random.default_rng([2024, seed])
    trees = np.array([[rng.uniform(3.0, 17.0), rng.uniform(1.0, 19.0), rng.uniform(0.25, 0.6)] for _ in range(TREES)])
    world = World(BOUNDS, [Cylinder((x, y), r, (0.0, 4.0)) for x, y, r in trees])
    balls = Balls(rng, movers, trees, turns)
    replanner = Replanner(world, LIMITS, RADIUS, plan(world, START, GOAL, LIMITS, RADIUS).trajectory, settings=settings)
    flown, kinds, spent, closest, backups = replanner.flight, {k.value: 0 for k in Kind}, [], np.inf, 0
    coming, log = [], []
    for tick in range(round(LATEST / TICK)):
        now = tick * TICK
        seen = [
            MovingSphere(tuple(p), tuple(v), r, GROWTH, now)
            for p, v, r in zip(balls.position.tolist(), balls.velocity.tolist(), balls.radius.tolist(), strict=True)
        ]
        before = time.thread_time()
        decision = replanner.step(now, seen)
        spent.append(1e3 * (time.thread_time() - before))
        kinds[decision.kind.value] += 1
        backups += decision.backup is not None
        if tell:
            log.append(f"{now:.2f} {decision.kind.value} {decision.clearance:.2f} m{decision.mover} {decision.reason}")
        if decision.kind is not Kind.KEEP:
            coming.append(decision.flight)
        for fine in range(round(TICK / FINE)):
            t = now + fine * FINE
            while coming and coming[0].start_s <= t + 1e-9:
                flown = coming.pop(0)
            place = flown.trajectory.position(t - flown.start_s)
            gap, who = balls.gap(place)
            closest = min(closest, gap)
            if gap < 0.0:
                story = f"ball {who} at {t:.2f} s, going {np.round(balls.velocity[who], 1)}, place {np.round(place, 1)}"
                return Run(seed, "touched", t, closest, spent, kinds, backups, "\n".join([*log[-60:], story]))
            assert world.distance(place[None])[0] >= RADIUS, "flown into a tree"
            if np.linalg.norm(place - GOAL) < 0.05 and t > flown.end_s - 0.05:
                return Run(seed, "reached", t, closest, spent, kinds, backups)
            balls.advance(FINE)
    return Run(seed, "timeout", LATEST, closest, spent, kinds, backups, "\n".join(log[-60:]))


def forests(worlds: int) -> None:
    """CPU time of one step after the world or the goal has changed."""
    print("| change | steps | warm, proved | from scratch | stop or nothing | warm ms median | p95 | all ms p95 |")
    print("|---|---|---|---|---|---|---|---|")
    for change in ("a new tree", "a goal moved"):
        warm, every, kinds = [], [], {"warm": 0, "cold": 0, "stop": 0}
        for seed in range(worlds):
            world, start, goal = world_of("forest", seed)
            trajectory = plan(world, start, goal, LIMITS, RADIUS, seed=seed).trajectory
            rng = np.random.default_rng([5, seed])
            for _ in range(4):
                at = rng.uniform(0.3, 0.7 * trajectory.duration)
                replanner = Replanner(world, LIMITS, RADIUS, trajectory)
                if change == "a new tree":
                    x, y, _ = trajectory.position(at + rng.uniform(0.8, 2.0)) + rng.uniform(-0.6, 0.6, 3)
                    if np.hypot(*(trajectory.position(at)[:2] - (x, y))) < 1.4:
                        continue
                    replanner.remap(World(BOUNDS, [*world.obstacles, Cylinder((x, y), 0.35, (0.0, 4.0))]))
                else:
                    aim = np.array(goal) + rng.uniform(-1.0, 0.0, 3)
                    if world.distance(aim[None])[0] < RADIUS + 0.05:
                        continue
                    replanner.retarget(aim)
                before = time.thread_time()
                decision = replanner.step(at)
                spent = 1e3 * (time.thread_time() - before)
                every.append(spent)
                if decision.reason == "planned from scratch":
                    kinds["cold"] += 1
                elif decision.kind in (Kind.SWITCH, Kind.KEEP) and decision.flight.to_goal:
                    kinds["warm"] += 1
                    warm.append(spent)
                else:
                    kinds["stop"] += 1
        print(
            f"| {change} | {len(every)} | {kinds['warm']} | {kinds['cold']} | {kinds['stop']} "
            f"| {np.median(warm):.2f} | {np.percentile(warm, 95):.2f} | {np.percentile(every, 95):.2f} |"
        )


def main() -> None:
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    movers = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    warm_up()
    replan.warm_up()
    forests(min(runs, 100))
    with ProcessPoolExecutor(2) as pool:
        results = list(pool.map(fly, range(runs), [movers] * runs, chunksize=5))
        alone = list(pool.map(fly, range(min(runs, 20)), [0] * min(runs, 20), chunksize=5))
    outcomes = [r.outcome for r in results]
    ms = np.concatenate([r.milliseconds for r in results])
    took = [r.time for r in results if r.outcome == "reached"]
    print(", ".join(f"{how} {outcomes.count(how)}" for how in ("reached", "touched", "timeout")))
    print(f"step CPU ms: median {np.median(ms):.3f}, p95 {np.percentile(ms, 95):.3f}, most {ms.max():.1f}")
    print(f"time to goal s: median {np.median(took):.2f}, without movers {np.median([r.time for r in alone]):.2f}")
    total = {k.value: sum(r.kinds[k.value] for r in results) for k in Kind}
    print(f"decisions: {total}; with a proved stop: {sum(r.backups for r in results) / sum(total.values()):.3f}")
    for r in results:
        if r.outcome != "reached":
            print(r.seed, r.outcome, f"{r.time:.2f}", r.story)


if __name__ == "__main__":
    main()
