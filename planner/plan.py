"""One plan, from the world to a proved trajectory.

    fan of bows -> HAOAROA on the spline's cost -> L-BFGS on the distinct best -> certificate -> best -> timing -> proof

When none of the fan can be proved, a search graph gives the way round and the same polish follows it, more closely from
try to try. The result is certified or it is not a result: `NoPathFound` is raised instead, and says what the graph
shows.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from planner import errors
from planner.bspline import DEGREE, FloatArray, clamped_knots, derivative_control_points, evaluate
from planner.certificate import certify, end_needed, needed
from planner.cost import FIXED, SAMPLES, Grid, SplineCost, build_grid
from planner.descent import polish, search
from planner.distance import nearest_solid
from planner.guide import guide
from planner.limits import Limits
from planner.search.asktell import POPULATION
from planner.search.haoaroa import Haoaroa
from planner.seeds import along_path, fan
from planner.stopwatch import Stopwatch
from planner.timing import uniform_scaling, within
from planner.trajectory import Trajectory
from planner.worlds import Box, Point, World, as_point

METHODS = ("haoaroa",)
SPACING = 1.4
"""Aimed distance between control points [m]."""
FEWEST, MOST, MOST_GUIDED = 16, 120, 400
"""Control points of a plan; along a guide there may be more, since a polish costs less than a search."""
ITERATIONS = 15
"""Of HAOAROA: four of exploration, the rest of exploitation. It has to find the right side of the obstacles, not the
minimum: the polish is the better finisher. On each family of benchmark worlds 12, 15, 20 and 30 iterations end in mean
lengths within 0.4 %.
"""
ELITES = 4
NEAREST = 0.25
"""Least reach c of the obstacles' hinge [m]. Crossing a sheet costs k c^2/2 (see `cost`): with less, a detour around
one would not pay. Nor is c less than the way between two samples, so that no sheet stands between them unseen.
"""
STEP = 0.5
"""Along a guide a step of the polish is at most this much of the reach, lest the curve jump to a sheet's other side."""
STIFFER = (1.0, 4.0, 32.0)
"""Factors on the obstacle weight, tried in turn until a curve is proved."""


class Try(NamedTuple):
    """How a guide is followed."""

    spacing: float  # aimed distance between control points [m]
    softest: float  # bound on the rounding of corners [m] (see `cost`)
    buffer: float  # most that the hinge reaches beyond the radius [m]


TRIES = (
    Try(SPACING, np.inf, np.inf),
    Try(SPACING, 1.5, np.inf),  # mazes
    Try(SPACING / 2.0, 0.75, np.inf),
    Try(SPACING / 4.0, 0.4, 0.1),  # slits, where a wide hinge pushes from both sides alike
    Try(SPACING / 8.0, 0.4, 0.1),
)
"""Ways to follow a guide, in turn, until a curve is proved."""


@dataclass(frozen=True, slots=True)
class Report:
    """How a plan came about and what it is like."""

    evaluations: int  # of the cost with its gradient
    iterations: int  # of the search
    seeds_tried: int  # curves polished and put to the proof
    seeds_certified: int
    guided: bool  # whether the search graph had to help
    stretch: float  # J_stretch [m]
    smoothness: float  # J_smooth [m]
    obstacle: float  # J_obstacle, at its first weight [m]
    curvature_max: float  # of the shape, sampled [1/m]
    jerk_integral: float  # int |jerk|^2 dt, exact [m^2/s^5]


@dataclass(frozen=True, slots=True)
class Plan:
    """A trajectory, at rest at both ends, and what was proved about it."""

    trajectory: Trajectory
    length: float  # [m]
    clearance: (
        float  # proved lower bound on the distance to the nearest obstacle, minus the radius [m]; inf without any
    )
    certified: bool  # the whole curve keeps the radius from obstacles and walls, and the limits hold everywhere
    cpu_ms: float  # CPU time of this thread [ms]; the one number here that differs from run to run
    method: str
    report: Report


def plan(
    world: World,
    start: Sequence[float] | FloatArray,
    goal: Sequence[float] | FloatArray,
    limits: Limits,
    radius: float,
    seed: int = 0,
    method: str = "haoaroa",
) -> Plan:
    """Plan from rest at `start` to rest at `goal`.

    Parameters
    ----------
    world : World
    start, goal : (3,)      in the world's frame [m].
    limits : Limits         Euclidean norms of velocity, acceleration and jerk.
    radius : float          distance that the curve keeps from obstacles and from the walls of the map [m].
    seed : int              same arguments and seed: same plan, `cpu_ms` apart.
    method : str            one of METHODS.

    Raises
    ------
    ValueError : an unknown method, a radius that is not finite and at least 0, or a point that is not three numbers.
    StartInCollision, GoalInCollision, StartOutOfBounds, GoalOutOfBounds : which obstacle or wall, and by how much; an
        end at the radius exactly is refused too, since rounding leaves nothing to prove it by.
    NoPathFound : nothing could be proved within the budget.
    """
    watch = Stopwatch()
    if method not in METHODS:
        raise ValueError(f"method: expected one of {', '.join(METHODS)}, found {method!r}")
    if not (np.isfinite(radius) and radius >= 0.0):
        raise ValueError(f"radius: expected a finite number of at least 0 m, found {radius}")
    a, b = as_point("start", start), as_point("goal", goal)
    check_endpoint(world, a, radius, errors.StartInCollision, errors.StartOutOfBounds)
    check_endpoint(world, b, radius, errors.GoalInCollision, errors.GoalOutOfBounds)
    return _Search(world, np.array(a), np.array(b), limits, float(radius), seed).run(method, watch)


def warm_up() -> None:
    """Compile every kernel, so that the next plan is fast: about ten seconds after a fresh installation, else none."""
    world = World(bounds=((0.0, 0.0, 0.0), (6.0, 6.0, 1.0)), obstacles=[Box((2.0, 1.0, 0.0), (3.0, 4.0, 1.0))])
    ends = np.array([[0.5, 3.0, 0.5], [5.5, 3.0, 0.5]])
    guide(world, ends[0], ends[1], 0.1)
    world.distance(ends)
    plan(world, ends[0], ends[1], Limits(1.0, 1.0, 10.0), 0.1)


def check_endpoint(
    world: World,
    point: Point,
    radius: float,
    collision: type[errors.StartInCollision] | type[errors.GoalInCollision],
    outside: type[errors.StartOutOfBounds] | type[errors.GoalOutOfBounds],
) -> None:
    """Raise `outside` or `collision` unless the point keeps what a proof needs from every wall and obstacle."""
    need = end_needed(world, radius)
    low, high = world.bounds
    ways = [(point[i] - low[i], i, "lower", low[i]) for i in range(3)]
    ways += [(high[i] - point[i], i, "upper", high[i]) for i in range(3)]
    distance, axis, side, bound = min(ways)
    if distance < need:
        raise outside(point, axis, side, bound, distance, radius, need - radius)
    nearest, index = nearest_solid(world.solids, *point)
    if nearest < need:
        kind = type(world.obstacles[index]).__name__.lower()
        raise collision(point, index, kind, nearest, radius, need - radius)


@dataclass(frozen=True, slots=True)
class _Proved:
    points: FloatArray
    x: FloatArray
    cost: SplineCost
    value: float  # stretch + smoothness [m]


class _Search:
    """One plan's working state."""

    def __init__(
        self, world: World, start: FloatArray, goal: FloatArray, limits: Limits, radius: float, seed: int
    ) -> None:
        self.world, self.start, self.goal, self.limits, self.radius = world, start, goal, limits, radius
        self.generator = np.random.default_rng(seed)
        # Half a margin outside the ends' own bounds: provable, and lower < upper even where the map is 2 radius wide.
        room = (needed(world, radius) + end_needed(world, radius)) / 2.0
        self.lower, self.upper = world.walls[0] + room, world.walls[1] - room
        self.evaluations = self.iterations = self.tried = self.certified = 0
        self.guided = False
        self.grid: Grid | None = None  # for the widest reach so far
        self.grid_reach = 0.0
        self.refused: list[FloatArray] = []

    def run(self, method: str, watch: Stopwatch) -> Plan:
        distance = float(np.linalg.norm(self.goal - self.start))
        cost = self.spline_cost(distance, Try(SPACING, np.inf, np.inf), MOST)
        found = self.prove_all(self.search(cost), cost)
        made = self.finish_best(found, method, watch)
        if made is not None:
            return made
        self.guided = True
        way = guide(self.world, self.start, self.goal, self.radius)
        for how in TRIES if len(way.path) else ():
            cost = self.spline_cost(way.length, how, MOST_GUIDED)
            made = self.finish_best(self.follow(along_path(way.path, cost.n), cost), method, watch)
            if made is not None:
                return made
        raise errors.NoPathFound(self.tried, self.evaluations, self.shortfall(), self.radius, way.length, way.width)

    def finish_best(self, found: list[_Proved], method: str, watch: Stopwatch) -> Plan | None:
        """The plan from the best of the proved curves whose timed form is proved too, as in practice the first is."""
        for best in sorted(found, key=lambda p: p.value):
            made = self.finish(best, method, watch)
            if made.certified:
                return made
        return None

    def spline_cost(self, length: float, how: Try, most: int) -> SplineCost:
        n = int(np.clip(round(length / how.spacing) + DEGREE, FEWEST, most))
        wanted = max(self.radius + max(0.05, 0.4 * self.radius), NEAREST)
        reach = max(min(wanted, self.radius + how.buffer), length / ((n - DEGREE) * SAMPLES))
        if reach > self.grid_reach:
            self.grid, self.grid_reach = build_grid(self.world, reach), reach
        return SplineCost(
            self.world,
            self.start,
            self.goal,
            n,
            self.limits,
            reach,
            length=length,
            softest=how.softest,
            grid=self.grid,
        )

    def search(self, cost: SplineCost) -> Iterator[FloatArray]:
        """HAOAROA from the fan; the best of each candidate, best first, those near a better one left out."""
        seeds = fan(self.start, self.goal, self.lower, self.upper, cost.n, POPULATION, self.generator)
        f = cost.n - 2 * FIXED
        optimiser = Haoaroa(
            np.tile(self.lower, f),
            np.tile(self.upper, f),
            self.generator,
            initial=seeds,
            budget=POPULATION * ITERATIONS,
            step=0.02 * cost.distance,
        )
        search(optimiser, cost)
        self.evaluations += optimiser.evaluations
        self.iterations += optimiser.iteration
        order = np.argsort(optimiser.population.best_costs, kind="stable")
        ranked = optimiser.population.best_positions[order]
        for i in range(len(ranked)):
            if i == 0 or (np.abs(ranked[:i] - ranked[i]).max(axis=1) > cost.reach).all():
                yield ranked[i].copy()

    def prove_all(self, seeds: Iterable[FloatArray], cost: SplineCost) -> list[_Proved]:
        """Polish the seeds, most promising first, and keep what can be proved; stop after ELITES once something is."""
        found: list[_Proved] = []
        for k, seed in enumerate(seeds):
            if k >= ELITES and found:
                break
            self.tried += 1
            x = seed
            for factor in STIFFER:
                x, evaluations = polish(cost, x, factor)
                self.evaluations += evaluations
                x = self.inside(x)
                points = cost.control_points(x)
                if certify(points, cost.knots, self.world, self.radius, full=False).certified:
                    self.certified += 1
                    found.append(_Proved(points, x, cost, cost.stretch(x) + cost.smoothness(x)))
                    break
            else:
                self.refused.append(points)
        return found

    def follow(self, x: FloatArray, cost: SplineCost) -> list[_Proved]:
        """Polish a guide's seed, obstacles at their stiffest first, so that it stays on the guide's side of them."""
        found: list[_Proved] = []
        self.tried += 1
        for factor in STIFFER[::-1]:
            x, evaluations = polish(cost, x, factor, longest=STEP * cost.reach)
            self.evaluations += evaluations
            x = self.inside(x)
            points = cost.control_points(x)
            if certify(points, cost.knots, self.world, self.radius, full=False).certified:
                found.append(_Proved(points, x, cost, cost.stretch(x) + cost.smoothness(x)))
            elif not found:
                self.refused.append(points)
            else:
                break
        self.certified += bool(found)
        return found

    def inside(self, x: FloatArray) -> FloatArray:
        """The free control points moved into the map: their hull then keeps the radius from its walls."""
        held: FloatArray = np.clip(x.reshape(-1, 3), self.lower, self.upper).ravel()
        return held

    def shortfall(self) -> float:
        """By how much the best of the unproved curves misses the radius on samples [m], for the error."""
        least = np.inf
        for points in self.refused:
            samples = evaluate(points, clamped_knots(len(points)), np.linspace(0.0, 1.0, 20 * len(points)))
            nearest = min(self.world.distance(samples).min(), self.world.wall_distance(samples).min())
            least = min(least, max(self.radius - float(nearest), 0.0))
        return float(least)

    def finish(self, best: _Proved, method: str, watch: Stopwatch) -> Plan:
        knots = uniform_scaling(best.points, self.limits)
        trajectory = Trajectory(best.points, knots)
        proof = certify(best.points, knots, self.world, self.radius)
        if not proof.certified:  # its least distance took too many pieces; the radius took few
            proof = certify(best.points, knots, self.world, self.radius, full=False)
        terms = best.cost.terms(best.x)
        report = Report(
            evaluations=self.evaluations,
            iterations=self.iterations,
            seeds_tried=self.tried,
            seeds_certified=self.certified,
            guided=self.guided,
            stretch=terms.stretch,
            smoothness=terms.smoothness,
            obstacle=terms.obstacle,
            curvature_max=curvature_max(trajectory),
            jerk_integral=jerk_integral(trajectory),
        )
        return Plan(
            trajectory=trajectory,
            length=trajectory.length,
            clearance=proof.obstacle_distance - self.radius,
            certified=proof.certified and within(best.points, knots, self.limits),
            cpu_ms=watch.elapsed_ms(),
            method=method,
            report=report,
        )


def curvature_max(trajectory: Trajectory) -> float:
    """Largest |C' x C''| / |C'|^3 [1/m] on eight samples a span, where the speed is above 1 % of its peak."""
    spans = len(trajectory.control_points) - DEGREE
    t = (np.arange(8 * spans) + 0.5) / (8 * spans) * trajectory.duration
    v, a = trajectory.velocity(t), trajectory.acceleration(t)
    speed = np.linalg.norm(v, axis=1)
    moving = speed > 0.01 * speed.max(initial=0.0)
    if not moving.any():
        return 0.0
    (vx, vy, vz), (ax, ay, az) = v[moving].T, a[moving].T
    turning = np.sqrt((vy * az - vz * ay) ** 2 + (vz * ax - vx * az) ** 2 + (vx * ay - vy * ax) ** 2)
    return float((turning / speed[moving] ** 3).max())


def jerk_integral(trajectory: Trajectory) -> float:
    """int |jerk|^2 dt [m^2/s^5]; exact, since the jerk is constant on each span."""
    points, knots = trajectory.control_points, trajectory.knots
    for degree in (3, 2, 1):
        points, knots = derivative_control_points(points, knots, degree), knots[1:-1]
    return float((np.diff(knots) * (points**2).sum(axis=1)).sum())
