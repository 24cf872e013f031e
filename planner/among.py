"""From a trajectory that is clear of solids to one that is clear of movers too.

    as it is -> planned anew in time, past the nearest mover on each side, slower -> after a wait

What arrives first of the proved ones is taken; a wait is tried when nothing else is proved, and only from rest: with an
interval of standing before it, a spline that begins at rest without acceleration has the same control points, the first
one repeated. (The piece that begins at rest is p_0 + c t^3; its blossom at arguments one of which is its own start is
p_0, so whatever knots stand before that, its first three control points are p_0.)
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from planner.bspline import DEGREE, FloatArray
from planner.certificate import certify, end_needed, needed
from planner.movers import MoverProof, certify_movers, rounding
from planner.query import Query
from planner.seeds import plane_frame
from planner.timing import within
from planner.trajectory import Trajectory
from planner.warm import ROUNDS, Ask, warm

SPAN, FEWEST, MOST = 0.25, 6, 200
"""Aimed span [s] and the numbers of spans."""
ASIDE = 1.0
"""How far a seed is pushed to a side [m]."""
SLOWER = (1.15, 1.4, 1.8)
WAITS = (0.5, 1.0, 2.0, 4.0, 8.0, 16.0)
"""[s]"""
BUFFER, BERTH = 0.12, 0.4
"""Where the hinges begin beyond the radius, for solids and for movers [m]."""


@dataclass(frozen=True, slots=True)
class Passage:
    """A trajectory among movers and what was proved about it."""

    trajectory: Trajectory
    certified: bool
    obstacle_distance: float  # proved, from solids [m]
    movers: MoverProof
    evaluations: int  # of the cost, in all


def wait(trajectory: Trajectory, seconds: float) -> Trajectory:
    """The same motion after standing at its start, which is at rest, for so long [s]."""
    points, knots = trajectory.control_points, trajectory.knots
    later = np.concatenate([np.zeros(DEGREE + 1), [seconds], knots[DEGREE + 1 :] + seconds])
    return Trajectory(np.concatenate([points[:1], points]), later)


def among(trajectory: Trajectory, query: Query, movers: FloatArray) -> Passage:
    """The earliest arrival that is proved, else the first that was looked at.

    Parameters
    ----------
    trajectory : Trajectory     clear of solids and within the limits.
    movers : (k, WIDTH)         of `movers.table`, on the trajectory's own time.
    """
    world, radius, limits = query.world, query.radius, query.limits
    best: Passage | None = None
    first: Passage | None = None
    evaluations = 0
    for made, spent in _ways(trajectory, query, movers):
        evaluations += spent
        if best is not None and made.duration >= best.trajectory.duration:
            continue
        points, knots = made.control_points, made.knots
        crowd = certify_movers(points, knots, movers, radius)
        if first is not None and not crowd.certified:
            continue
        still = certify(points, knots, world, radius)
        proved = crowd.certified and still.certified and within(points, knots, limits)
        found = Passage(made, proved, still.obstacle_distance, crowd, evaluations)
        first = first or found
        if proved:
            best = found
            if made is trajectory:
                break
    if best is None and _waits(query):
        for seconds in WAITS:
            made = wait(trajectory, seconds)
            crowd = certify_movers(made.control_points, made.knots, movers, radius)
            if crowd.certified:
                still = certify(made.control_points, made.knots, world, radius)
                if still.certified and within(made.control_points, made.knots, limits):
                    return Passage(made, True, still.obstacle_distance, crowd, evaluations)
    assert first is not None, "the trajectory itself comes first"
    return best or first


def tried_too(query: Query) -> tuple[str, ...]:
    """What `among` tries besides a trajectory as it is, in words."""
    anew = () if len(query.via) else ("on other sides", "slower")
    return (*anew, "later") if _waits(query) else anew


def _waits(query: Query) -> bool:
    """Whether one can stand at the start for a while."""
    return not (query.start_velocity.any() or query.start_acceleration.any())


def _ways(trajectory: Trajectory, query: Query, movers: FloatArray) -> Iterator[tuple[Trajectory, int]]:
    """Trajectories to try and the evaluations each took."""
    yield trajectory, 0
    if len(query.via):
        return  # what is planned anew in time would leave its via points
    world, radius, limits = query.world, query.radius, query.limits
    duration = trajectory.duration
    slack = rounding(world.walls, movers, 2.0 * duration)
    norms = np.array([limits.speed, limits.acceleration, limits.jerk])
    reach = max(end_needed(world, radius) + BUFFER, 0.25)
    need, berth = needed(world, radius), max(radius + BERTH, 0.25)
    ask = Ask(world.scene, world.walls, movers, norms, need, radius + 2.0 * slack, reach, berth)
    ends = [trajectory.state(t) for t in (0.0, duration)]
    start, end = (np.array([s.position, s.velocity, s.acceleration]) for s in ends)
    when = certify_movers(trajectory.control_points, trajectory.knots, movers, radius).time
    _, side, up = plane_frame(trajectory.position(when - 0.05), trajectory.position(when + 0.05))
    pushes = [(1.0, d) for d in (np.zeros(3), side, -side, up, -up)] + [(f, np.zeros(3)) for f in SLOWER]
    points, knots = trajectory.control_points, trajectory.knots
    for factor, push in pushes:
        longer = factor * duration
        spans = min(max(round(longer / SPAN), FEWEST), MOST)
        found = warm(ask, start, end, points, knots, 0.0, duration, longer, spans, 0.0, 0.0, ASIDE * push, when, ROUNDS)
        if found.clear:
            yield Trajectory(found.points, found.knots), found.evaluations
