"""One plan, from the world to a proved trajectory.

    method -> shapes -> timing -> proof -> the first that is proved

A method (`shape` has HAOAROA's, `baselines` its rivals') finds curves in space; timing and proof are the same for all.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from planner import errors
from planner.among import Passage, among, tried_too
from planner.baselines.bezier import find_bezier
from planner.baselines.lbsgf import find_lbsgf
from planner.baselines.parents import find_aoa, find_roa
from planner.baselines.polyline import find_astar, find_jps
from planner.bspline import FloatArray
from planner.certificate import Certificate, certify, end_needed
from planner.checks import as_kind, as_number, as_seed
from planner.distance import nearest_exact
from planner.enclosure import PITCHES, apart
from planner.guide import Guides
from planner.limits import Limits
from planner.movers import Mover, MoverProof, table
from planner.query import Query
from planner.shape import Effort, Shape, haoaroa
from planner.stopwatch import Stopwatch
from planner.timing import Motion, timings, within
from planner.trajectory import Trajectory
from planner.worlds import KINDS, Box, Point, VoxelGrid, World, as_point

Vector = Sequence[float] | FloatArray
Finder = Callable[[Query, Effort], Iterator[Shape]]
"""A method: hands over shapes, most promising first, and counts what they took. The first whose timed form is proved
becomes the plan, else the last; a method that wants no unproved plan raises NoPathFound in the end."""
FINDERS: dict[str, Finder] = {
    "haoaroa": haoaroa,
    "astar": find_astar,
    "jps": find_jps,
    "bezier": find_bezier,
    "lbsgf": find_lbsgf,
    "aoa": find_aoa,
    "roa": find_roa,
}
METHODS = tuple(FINDERS)
MOST_VIA = 25
PACES = ((1.0, False), (1.6, False), (2.5, False), (4.0, False), (1.0, True), (2.5, True))
"""With moving ends: what the guessed duration is multiplied by, and whether the search graph may help, in turn until a
curve can be flown. With more time the ends are longer.
"""
CURVES = 4
"""Looked at for each pace."""
HAIR = 1e-11
"""Of a limit, what a state at it is short of, so that rounding does not put it beyond."""
ALTERNATIVES = 6
"""Curves that are tried among movers."""


@dataclass(frozen=True, slots=True)
class Report:
    """How a plan came about and what it is like."""

    evaluations: int  # of the cost with its gradient
    iterations: int  # of the search
    seeds_tried: int  # curves polished and put to the proof
    seeds_certified: int
    guided: bool  # whether the search graph had to help
    stretch: float  # J_stretch [m]; NaN, as the next two, for methods that do not know the cost
    smoothness: float  # J_smooth [m]
    obstacle: float  # J_obstacle, at its first weight [m]
    curvature_max: float  # sampled [1/m]; inf where it stops and turns on the spot
    jerk_integral: float  # int |jerk|^2 dt, exact [m^2/s^5]


@dataclass(frozen=True, slots=True)
class Plan:
    """A trajectory and what was proved about it."""

    trajectory: Trajectory
    length: float  # [m]
    clearance: (
        float  # proved lower bound on the distance to any obstacle or mover, less the radius [m]; inf without any
    )
    certified: bool  # the whole curve keeps the radius from obstacles, walls and movers, and the limits hold everywhere
    cpu_ms: float  # CPU time of this thread [ms]; the one number here that differs from run to run
    method: str
    report: Report


def plan(
    world: World,
    start: Vector,
    goal: Vector,
    limits: Limits,
    radius: float,
    seed: int = 0,
    method: str = "haoaroa",
    *,
    start_velocity: Vector = (0.0, 0.0, 0.0),
    start_acceleration: Vector = (0.0, 0.0, 0.0),
    goal_velocity: Vector = (0.0, 0.0, 0.0),
    via: Sequence[Vector] | FloatArray | None = (),
    movers: Sequence[Mover] | None = (),
) -> Plan:
    """Plan from `start` to `goal`, from rest to rest unless told otherwise.

    Parameters
    ----------
    world : World
    start, goal : (3,)      in the world's frame [m].
    limits : Limits         Euclidean norms of velocity, acceleration and jerk.
    radius : float          distance that the curve keeps from obstacles and from the walls of the map [m].
    seed : int              same arguments and seed: same plan, `cpu_ms` apart.
    method : str            one of METHODS.
    start_velocity, start_acceleration : (3,)    at the start [m/s, m/s^2].
    goal_velocity : (3,)    at the goal, which is passed without acceleration [m/s].
    via : (m, 3)            points that the curve passes, in this order, MOST_VIA of them at most [m]; None is none.
    movers : sequence of MovingSphere or MovingBox    missed too while the trajectory lasts, each where it is predicted
        by then, in the trajectory's time; nothing is claimed about standing at the goal afterwards.

    Raises
    ------
    ValueError : an unknown method, a radius that is not finite and at least 0, a negative seed, a point that is not
        three finite numbers, or too many via points or movers.
    TypeError : a world, limits, a radius, a seed, via points or movers of another type.
    StateBeyondLimits : a velocity or an acceleration beyond its limit, and by how much.
    StartInCollision, GoalInCollision, StartOutOfBounds, GoalOutOfBounds : which obstacle or wall, and by how much; an
        end at the radius exactly is refused too, since rounding leaves nothing to prove it by.
    ViaInCollision, ViaOutOfBounds : the same of a via point, and which.
    NoPathFound : nothing could be proved within the budget; as NoTimingFound, curves there are, but the limits do not
        let them be flown from the velocity at the start or to that at the goal; as BlockedByMovers, trajectories there
        are, but none of them was proved to miss the movers.
    """
    watch = Stopwatch()
    if method not in METHODS:
        raise ValueError(f"method: expected one of {', '.join(METHODS)}, found {method!r}")
    as_kind("world", world, World)
    as_kind("limits", limits, Limits)
    radius, seed = as_number("radius", radius, "m"), as_seed("seed", seed)
    query = _asked(world, start, goal, limits, radius, seed, start_velocity, start_acceleration, goal_velocity, via)
    crowd = table(movers)
    effort, curves = Effort(), 0
    blocked: list[MoverProof] = []
    refusal: errors.NoPathFound | None = None
    made: Plan | None = None
    for pace, guides in PACES if query.moving else ((1.0, True),):
        try:
            for k, shape in enumerate(FINDERS[method](replace(query, pace=pace, guides=guides), effort)):
                curves += 1
                made = finish(query, shape, effort, method, watch) or made
                if made is not None and made.certified:
                    if not len(crowd):
                        return made
                    found = among(made.trajectory, query, crowd)
                    effort.evaluations += found.evaluations
                    if found.certified:
                        return _passing(made, found, effort, watch, query.radius)
                    blocked.append(found.movers)
                    made = None
                    if len(blocked) >= ALTERNATIVES:
                        break
                if query.moving and k + 1 >= CURVES:
                    break
        except errors.NoPathFound as error:
            refusal = error
            if error.proved:
                break
    if blocked:
        raise _blocked(blocked, effort, query)
    if made is not None and refusal is None:
        return made
    if curves and query.moving:
        speed, acceleration = np.linalg.norm(query.start_velocity), np.linalg.norm(query.start_acceleration)
        raise errors.NoTimingFound(curves, effort.evaluations, float(speed), float(acceleration), query.radius)
    assert refusal is not None, f"{method} hands over a shape or raises"
    raise refusal


def _asked(
    world: World,
    start: Vector,
    goal: Vector,
    limits: Limits,
    radius: float,
    seed: int,
    start_velocity: Vector,
    start_acceleration: Vector,
    goal_velocity: Vector,
    via: Sequence[Vector] | FloatArray | None,
) -> Query:
    """The arguments of `plan` in arrays, every end and via point and every state checked; raises as `plan`."""
    a, b = as_point("start", start), as_point("goal", goal)
    check_endpoint(world, a, radius, errors.StartInCollision, errors.StartOutOfBounds)
    check_endpoint(world, b, radius, errors.GoalInCollision, errors.GoalOutOfBounds)
    via = () if via is None else via
    if not isinstance(via, Sequence | np.ndarray) or isinstance(via, str):
        raise TypeError(f"via: expected a sequence of points, found {via!r}")
    if len(via) > MOST_VIA:
        raise ValueError(f"via: expected at most {MOST_VIA} points, found {len(via)}")
    through = [as_point(f"via point {index}", point) for index, point in enumerate(via)]
    for index, point in enumerate(through):
        check_endpoint(
            world,
            point,
            radius,
            partial(errors.ViaInCollision, index=index),
            partial(errors.ViaOutOfBounds, index=index),
        )
    return Query(
        world,
        np.array(a),
        np.array(b),
        limits,
        float(radius),
        seed,
        start_velocity=_state("start_velocity", start_velocity, limits.speed),
        start_acceleration=_state("start_acceleration", start_acceleration, limits.acceleration),
        goal_velocity=_state("goal_velocity", goal_velocity, limits.speed),
        via=np.array(through).reshape(-1, 3),
    )


def _passing(made: Plan, found: Passage, effort: Effort, watch: Stopwatch, radius: float) -> Plan:
    """The plan with the trajectory that misses the movers."""
    measures = found.trajectory.measures()
    report = replace(
        made.report,
        evaluations=effort.evaluations,
        curvature_max=measures.curvature_max,
        jerk_integral=measures.jerk_integral,
    )
    return replace(
        made,
        trajectory=found.trajectory,
        length=measures.length,
        clearance=min(found.obstacle_distance, found.movers.distance) - radius,
        cpu_ms=watch.elapsed_ms(),
        report=report,
    )


def _blocked(proofs: list[MoverProof], effort: Effort, query: Query) -> errors.BlockedByMovers:
    """Of the first trajectory: the shortest."""
    first = proofs[0]
    ways = tried_too(query)
    return errors.BlockedByMovers(len(proofs), effort.evaluations, first.mover, first.time, query.radius, ways)


def _state(name: str, value: Vector, limit: float) -> FloatArray:
    """A velocity or acceleration (3,) within its limit; one at the limit a hair below, which a proof needs."""
    vector = np.array(as_point(name, value))
    norm = float(np.linalg.norm(vector))
    if norm > limit * (1.0 + HAIR):
        raise errors.StateBeyondLimits(name, norm, limit)
    return vector * min(1.0, limit * (1.0 - HAIR) / norm) if norm > 0.0 else vector


def warm_up() -> None:
    """Compile every kernel, so that the next plan is fast: about ten seconds after a fresh installation, else none."""
    world = World(bounds=((0.0, 0.0, 0.0), (6.0, 6.0, 1.0)), obstacles=[Box((2.0, 1.0, 0.0), (3.0, 4.0, 1.0))])
    ends = np.array([[0.5, 3.0, 0.5], [5.5, 3.0, 0.5]])
    guides = Guides(world, ends[0], ends[1], 0.1)
    guides.refine()
    for _ in range(2):
        guides.another()
    apart(world, ends[0], ends[1], 0.1, PITCHES[:1])
    world.distance(ends)
    VoxelGrid(np.ones((1, 1, 1), dtype=np.bool_), (0.0, 0.0, 0.0), 1.0)  # builds a field
    plan(world, ends[0], ends[1], Limits(1.0, 1.0, 10.0), 0.1)


def check_endpoint(
    world: World,
    point: Point,
    radius: float,
    collision: Callable[..., errors.EndpointError],
    outside: Callable[..., errors.EndpointError],
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


def finish(query: Query, shape: Shape, effort: Effort, method: str, watch: Stopwatch) -> Plan | None:
    """Time a shape, prove what can be proved about it, and report; None when the limits cannot be kept on it."""
    world, radius = query.world, query.radius
    made: tuple[Motion, Certificate] | None = None
    knots, duration = shape.knots, shape.duration
    for motion in timings(shape.control_points, knots, query.limits, duration, query.via, shape.via_knots):
        proof = certify(motion.control_points, motion.knots, world, radius)
        if not proof.certified:  # its least distance took too many pieces; the radius took few
            proof = certify(motion.control_points, motion.knots, world, radius, full=False)
        if proof.certified or made is None:
            made = motion, proof
        if proof.certified:
            break
    if made is None:
        return None
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
        curvature_max=math.inf if shape.turns_on_spot else measures.curvature_max,
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
