"""One plan, from the world to a proved trajectory.

    method -> shapes -> timing -> proof -> the first that is proved

A method (`shape` has HAOAROA's, `baselines` its rivals') finds curves in space; timing and proof are the same for all.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from planner import errors
from planner.bspline import FloatArray
from planner.certificate import Certificate, certify, end_needed
from planner.distance import nearest_exact
from planner.guide import guide
from planner.limits import Limits
from planner.query import Query
from planner.shape import Effort, Shape, haoaroa
from planner.stopwatch import Stopwatch
from planner.timing import Motion, timings, within
from planner.trajectory import Trajectory
from planner.worlds import KINDS, Box, Point, World, as_point

Finder = Callable[[Query, Effort], Iterator[Shape]]
"""A method: hands over shapes, most promising first, and counts what they took. The first whose timed form is proved
becomes the plan, else the last; a method that wants no unproved plan raises NoPathFound in the end."""
FINDERS: dict[str, Finder] = {"haoaroa": haoaroa}
METHODS = tuple(FINDERS)


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
    query, effort = Query(world, np.array(a), np.array(b), limits, float(radius), seed), Effort()
    made: Plan | None = None
    for shape in FINDERS[method](query, effort):
        made = finish(query, shape, effort, method, watch)
        if made.certified:
            break
    assert made is not None, f"{method} hands over a shape or raises"
    return made


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
    nearest, row = nearest_exact(world.scene, *point, 2.0 * need)
    if nearest < need:
        index = world.owners[row]
        kind = KINDS[type(world.obstacles[index])]
        raise collision(point, index, kind, nearest, radius, need - radius)


def finish(query: Query, shape: Shape, effort: Effort, method: str, watch: Stopwatch) -> Plan:
    """Time a shape, prove what can be proved about it, and report."""
    world, radius = query.world, query.radius
    made: tuple[Motion, Certificate] | None = None
    for motion in timings(shape.control_points, shape.knots, query.limits):
        proof = certify(motion.control_points, motion.knots, world, radius)
        if not proof.certified:  # its least distance took too many pieces; the radius took few
            proof = certify(motion.control_points, motion.knots, world, radius, full=False)
        if proof.certified or made is None:
            made = motion, proof
        if proof.certified:
            break
    assert made is not None, "a shape at rest at both ends can be flown slowly"
    motion, proof = made
    trajectory = Trajectory(motion.control_points, motion.knots)
    measures = trajectory.measures()
    report = Report(
        evaluations=effort.evaluations,
        iterations=effort.iterations,
        seeds_tried=effort.tried,
        seeds_certified=effort.certified,
        guided=effort.guided,
        stretch=shape.stretch,
        smoothness=shape.smoothness,
        obstacle=shape.obstacle,
        curvature_max=measures.curvature_max,
        jerk_integral=measures.jerk_integral,
    )
    return Plan(
        trajectory=trajectory,
        length=measures.length,
        clearance=proof.obstacle_distance - radius,
        certified=proof.certified and within(motion.control_points, motion.knots, query.limits),
        cpu_ms=watch.elapsed_ms(),
        method=method,
        report=report,
    )
