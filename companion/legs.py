"""A mission's steps laid out in space: where each begins and ends, what moves in between, what has to be planned."""

import math
from dataclasses import dataclass, field

import numpy as np

from companion.mission import Mission
from companion.profile import Circle, StraightMove
from companion.seam import FloatArray, PlanWanted, Vector
from companion.steps import Orbit, Step
from planner import Limits, Trajectory, World

COLUMN_STEP = 0.02
"""Spacing of the samples along climb, landing and circles [m]."""
NO_WAY = 1e-6
"""An orbit's circle nearer than this needs no leg that leads to it [m]."""
SAME = 1e-3
"""A place nearer than this to where one is already needs no way to it [m]."""

REST_S = 0.1
"""How long a trajectory at rest lasts [s]."""

Path = StraightMove | Circle | Trajectory


@dataclass(slots=True)
class Leg:
    """One step, as it is flown: its paths one after the other, then `seconds` at rest at its end.

    Attributes
    ----------
    step : of the mission.
    end : (3,) where it ends [m].
    wanted : the plan it needs; its trajectory goes before `then`.
    planned : that trajectory, once there is one.
    then : what needs no plan: a climb, a circle.
    seconds : [s]; inf: until somebody orders otherwise.
    rest : where it leads after its goal, place by place, once its points on the way are flown to one by one.
    """

    step: Step
    end: FloatArray
    wanted: PlanWanted | None = None
    planned: Trajectory | None = None
    then: list[Path] = field(default_factory=list)
    seconds: float = 0.0
    rest: list[Vector] = field(default_factory=list)

    @property
    def paths(self) -> list[Path]:
        return self.then if self.planned is None else [self.planned, *self.then]

    @property
    def ready(self) -> bool:
        """Whether it has the plan it needs."""
        return self.wanted is None or self.planned is not None


def lay_out(mission: Mission, seed: int, start_m: Vector) -> list[Leg]:
    """One leg a step, from where the step before ends, and a landing where the mission does not say it.

    The leg of step k is planned with `seed` + k under the number k.
    """
    legs: list[Leg] = []
    here, via = np.array(start_m), list[Vector]()
    for i, step in enumerate(mission.steps):
        limits, radius = limits_of(mission, step), radius_of(mission, step)
        leg = Leg(step, here)
        if step.takeoff is not None:
            climb = Limits(mission.limits.climb, limits.acceleration, limits.jerk)
            leg.end = np.array([here[0], here[1], -step.takeoff.altitude])
            leg.then = [StraightMove.within(here, leg.end, climb)]
        elif step.via is not None:
            via += [place.ned() for place in step.via]
        elif step.hold is not None:
            leg.seconds = step.hold.seconds
        elif step.wait is not None:
            leg.seconds = math.inf if step.wait.at_most is None else step.wait.at_most
        elif step.goto is not None or step.return_home is not None or step.orbit is not None:
            goal = _goal(step, here, start_m)
            if step.orbit is not None:
                circle = circle_of(step.orbit, here, limits)
                goal = circle.state(0.0).position
                leg.then = [circle]
            away = float(np.linalg.norm(goal - here))
            if step.orbit is None and not via and away < SAME:
                goal = here
            elif step.orbit is None or away > NO_WAY:
                leg.wanted = PlanWanted(
                    request_id=i,
                    start_m=vector(here),
                    goal_m=vector(goal),
                    limits=limits,
                    radius=radius,
                    seed=seed + i,
                    method=mission.method,
                    via_m=tuple(via),
                )
            leg.end, via = leg.then[-1].state(math.inf).position if leg.then else goal, []
        here = leg.end
        legs.append(leg)
    if mission.steps[-1].land is None:
        legs.append(Leg(Step.model_validate("land"), here))
    return legs


def limits_of(mission: Mission, step: Step) -> Limits:
    """What the way of a step may ask of the vehicle."""
    limits = mission.planner_limits()
    return limits if step.speed is None else Limits(step.speed, limits.acceleration, limits.jerk)


def radius_of(mission: Mission, step: Step) -> float:
    """Distance [m] that the way of a step keeps from obstacles."""
    return mission.planner_radius() if step.clearance is None else mission.vehicle.radius + step.clearance


def circle_of(orbit: Orbit, here: FloatArray, limits: Limits) -> Circle:
    """The orbit's circle, begun where it is nearest to `here`; from its centre, to the north."""
    centre = np.array(orbit.centre())
    outward = here[:2] - centre[:2]
    start = math.atan2(outward[1], outward[0]) if float(np.linalg.norm(outward)) > NO_WAY else 0.0
    angle = 2.0 * math.pi * orbit.turns * (1.0 if orbit.clockwise else -1.0)
    return Circle.within(centre, start, orbit.radius, angle, limits)


def column_flaw(world: World, top: FloatArray, radius: float) -> str:
    """Why one cannot go straight up or down between the ground and a point, or nothing.

    Samples every `COLUMN_STEP` prove the radius for all between, since a distance changes no faster than the point
    moves. From the map's walls the upper end keeps the radius; the ground is what the column leads to.
    """
    margin = float(world.wall_distance(top[None])[0]) - radius
    if margin < 0.0:
        return f"{-margin:.2f} m too near the bounds (it keeps {radius:g} m)"
    column = np.repeat(top[None], max(2, math.ceil(abs(top[2]) / COLUMN_STEP) + 1), axis=0)
    column[:, 2] = np.linspace(0.0, top[2], len(column))
    least = float(world.distance(column).min()) - abs(top[2]) / (len(column) - 1) / 2.0
    return f"{radius - least:.2f} m too near an obstacle (it keeps {radius:g} m)" if least < radius else ""


def circle_flaw(world: World, circle: Circle, radius: float) -> str:
    """Why a circle cannot be flown, or nothing; proved as `column_flaw`, from the walls too."""
    angle = min(abs(circle.angle), 2.0 * math.pi)
    count = max(2, math.ceil(angle * circle.radius / COLUMN_STEP) + 1)
    at = circle.start + math.copysign(1.0, circle.angle) * np.linspace(0.0, angle, count)
    ring = np.column_stack((np.cos(at), np.sin(at), np.zeros(count))) * circle.radius + circle.centre
    half = angle * circle.radius / (count - 1) / 2.0
    least = float(world.distance(ring).min()) - half
    if least < radius:
        return f"{radius - least:.2f} m too near an obstacle (it keeps {radius:g} m)"
    wall = float(world.wall_distance(ring).min()) - half
    return f"{radius - wall:.2f} m too near the bounds (it keeps {radius:g} m)" if wall < radius else ""


def place(point: FloatArray) -> str:
    """A point of the mission frame, for people."""
    return f"north {point[0]:g}, east {point[1]:g}, altitude {-point[2] + 0.0:g}"


def rest_at(place: FloatArray) -> Trajectory:
    """A moment at rest at a place (3,): what planning in flight may begin with."""
    return Trajectory(np.tile(place, (4, 1)), REST_S * np.array([0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]))


def vector(a: FloatArray) -> Vector:
    return (float(a[0]), float(a[1]), float(a[2]))


def _goal(step: Step, here: FloatArray, start_m: Vector) -> FloatArray:
    if step.goto is not None:
        return np.array(step.goto.ned())
    altitude = None if step.return_home is None else step.return_home.altitude
    return np.array([start_m[0], start_m[1], here[2] if altitude is None else -altitude])
