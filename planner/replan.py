"""Planning in flight: what to fly from a moment ahead on, decided once a tick.

    what is flown -> proved against what is seen now, and calm?  keep it; now and then try a quicker way on
        -> warm plans from the flown state: straight on, past the trouble on its other sides, slower;
           a cold plan when goal or world have changed and none of these is proved
        -> none proved: stop ahead, or get out of the way         (FASTER: Tordesillas et al. 2019)
        -> none proved: what keeps farthest from the movers, and it is told that this is not proved

`Replanner` owns no clock and does no I/O: times come in as seconds of any one clock. A decision taken at `now` applies
from `now + latency` on, when its trajectory begins with the position, velocity and acceleration of the one flown until
then. Everything is counted, nothing timed: same inputs, same decisions.
"""

import enum
import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from planner.backup import dash, escape
from planner.bspline import FloatArray
from planner.certificate import end_needed, needed
from planner.checks import as_kind, as_number
from planner.errors import EndpointError, GoalInCollision, GoalOutOfBounds, PlannerError
from planner.limits import Limits
from planner.movers import UNTIL, Mover, MovingSphere, rounding, table
from planner.plan import check_endpoint, plan
from planner.trajectory import Trajectory
from planner.warm import ROUNDS, Ask, Found, judge, warm
from planner.worlds import Cylinder, World, as_point

SPAN, STOPPING_SPAN = 0.25, 0.16
"""Aimed spans of a warm plan and of a stop [s]."""
FEWEST, MOST = 5, 40
"""Spans of a warm plan."""
WINDOW, TAIL = 8.0, 2.0
"""A route that goes on for more than WINDOW + TAIL [s] is planned anew for WINDOW, then followed as it is."""
BUFFER = 0.12
"""How far beyond the radius the hinge of solids begins [m]."""
SIDESTEP = 0.9
"""By how much a seed is pushed aside to pass something on another side [m]."""
AMPLE = 1.03
"""Of the remaining time, what a way on that has to be found is given: a route is often as fast as the limits let it."""
BETTER = 0.02
"""How much farther from movers [m] a plan must keep to be worth a switch."""
LOOK = 2.0
"""How far ahead the vehicle's place on its route is looked for, when it has left it [s]."""
STILL = 1e-6
"""Norms of the velocity [m/s] and acceleration [m/s^2] that count as rest."""
_STILL = np.zeros(3)
_DIRECTIONS = np.array([(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if x or y or z], float)
_DIRECTIONS /= np.linalg.norm(_DIRECTIONS, axis=1)[:, None]


class Kind(enum.Enum):
    """What to do."""

    KEEP = "keep"  # fly on
    SWITCH = "switch"  # to a trajectory to the goal, proved
    BACKUP = "backup"  # to a stop, proved
    NONE = "none"  # nothing is proved: the least bad


@dataclass(frozen=True, slots=True)
class Flight:
    """A trajectory and when it begins."""

    trajectory: Trajectory
    start_s: float  # on the clock of whoever asks [s]
    to_goal: bool = True  # else to a stop, or to a goal that is no longer one

    @property
    def end_s(self) -> float:
        """When it ends [s]; from then on the vehicle stands."""
        return self.start_s + self.trajectory.duration


@dataclass(frozen=True, slots=True)
class Decision:
    """What to fly from `flight.start_s` on; until then, what was flown."""

    kind: Kind
    flight: Flight
    certified: bool  # proved: clear of solids, within the limits, and clear of movers as far as they are predicted
    clearance: float  # least distance to a predicted mover on samples, less the radius [m]; inf without any
    mover: int  # which one, -1 without any
    reason: str  # why; and what is wrong with the goal, when the world has changed so
    backup: Flight | None  # a proved stop that can be flown from the next tick's switch on, when there is one
    evaluations: int  # of the cost


@dataclass(frozen=True, slots=True)
class Settings:
    """How a Replanner decides.

    Raises
    ------
    ValueError : a time or a distance that is not positive (latency and comfort may be 0), or `hurry` not below 1.
    """

    latency_s: float = 0.02  # from a decision to its switch
    period_s: float = 0.02  # from tick to tick
    horizon_s: float = 2.0  # how far ahead movers are predicted
    comfort: float = (
        1.5  # a mover that passes nearer than this beyond the radius is given a wider berth, if it can be [m]
    )
    hurry: float = 0.96  # what part of the remaining time is tried when there is nothing else to do
    patience: int = 5  # ticks between two such tries; doubled after each in vain, up to sixteen-fold
    stranded: int = 50  # ticks without a way to the goal after which a cold plan is made, and after each as many more
    cold: bool = True  # whether it makes cold plans itself; else somebody beside it does, and `step` stays short

    def __post_init__(self) -> None:
        for name in ("period_s", "horizon_s", "hurry", "patience", "stranded"):
            if not 0.0 < getattr(self, name) < np.inf:
                raise ValueError(f"{name}: expected a finite number above 0, found {getattr(self, name)}")
        for name in ("latency_s", "comfort"):
            if not 0.0 <= getattr(self, name) < np.inf:
                raise ValueError(f"{name}: expected a finite number of at least 0, found {getattr(self, name)}")
        if not self.hurry < 1.0:
            raise ValueError(f"hurry: expected less than 1, found {self.hurry}")


class _Moment(NamedTuple):
    """What one step starts from."""

    ask: Ask
    switch: float  # when what is decided begins [s]
    at: float  # the same in the flown trajectory's time [s]
    state: FloatArray  # (3, 3) position, velocity, acceleration then


@dataclass(slots=True)
class _Ahead:
    """The part of the route that is planned anew."""

    last: float  # where it ends, in the route's time [s]
    end: FloatArray  # (3, 3) state there
    tail: Trajectory | None  # what follows it, None at the goal


@dataclass(slots=True)
class _Pace:
    """When to try to be quicker."""

    pause: int
    waited: int = 0


class Replanner:
    """Keeps a proved trajectory to the goal, and a proved stop, as long as there are any.

    Parameters
    ----------
    world, limits, radius       as in `plan`.
    trajectory : Trajectory     to rest at the goal; flown from `start_s` [s] on.
    settings : Settings

    Raises
    ------
    ValueError : a radius that is not finite and at least 0, a start that is not finite, or a trajectory that does not
        end at rest: the vehicle is taken to stand there afterwards.
    TypeError : a world, limits, a radius or a trajectory of another type.

    After a step `flight` is what to fly from `flight.start_s` on, `backup` the stop kept ready.
    """

    def __init__(
        self,
        world: World,
        limits: Limits,
        radius: float,
        trajectory: Trajectory,
        start_s: float = 0.0,
        settings: Settings | None = None,
    ) -> None:
        as_kind("world", world, World)
        as_kind("limits", limits, Limits)
        as_kind("trajectory", trajectory, Trajectory)
        if not np.isfinite(start_s):
            raise ValueError(f"start: expected a finite number of seconds, found {start_s}")
        end = trajectory.state(trajectory.duration)
        speed, push = float(np.linalg.norm(end.velocity)), float(np.linalg.norm(end.acceleration))
        if not (speed <= STILL and push <= STILL):
            raise ValueError(f"trajectory: expected rest at its end, found {speed:.3g} m/s and {push:.3g} m/s^2")
        self.world, self.limits, self.radius = world, limits, as_number("radius", radius, "m")
        self.settings = settings or Settings()
        self.flight = Flight(trajectory, start_s)
        self.goal = trajectory.position(trajectory.duration)
        self.backup: Flight | None = None
        self._route, self._route_at = trajectory, 0.0  # the way to the goal, and where on it the vehicle is [s]
        self._ahead: _Ahead | None = None
        self._limits = np.array([limits.speed, limits.acceleration, limits.jerk])
        self._pace = _Pace(self.settings.patience)
        self._off = 0  # steps without a way to the goal
        self._changed = False  # goal or world, since the last proved way
        self._covered = ""  # what is wrong with the goal since the world has changed
        self._evaluations = 0

    def retarget(self, goal: Sequence[float] | FloatArray) -> None:
        """Another goal, from the next step on.

        Raises
        ------
        GoalInCollision, GoalOutOfBounds, ValueError : as `plan`; the goal is then the one it was.
        """
        point = as_point("goal", goal)
        check_endpoint(self.world, point, self.radius, GoalInCollision, GoalOutOfBounds)
        self.goal = np.array(point)
        self._covered = ""
        self._changed = True
        self.flight = replace(self.flight, to_goal=False)

    def remap(self, world: World) -> None:
        """Another world, from the next step on.

        It is taken in any case, since it is what there is. When the goal is too near to an obstacle or a wall of it,
        every decision's `reason` says so, and by how much, until the goal or the world is another again.
        """
        as_kind("world", world, World)
        self.world = world
        self._changed = True
        self._covered = ""
        x, y, z = self.goal.tolist()
        try:
            check_endpoint(world, (x, y, z), self.radius, GoalInCollision, GoalOutOfBounds)
        except EndpointError as error:
            self._covered = str(error)

    def step(self, now_s: float, movers: Sequence[Mover] = ()) -> Decision:
        """Decide at `now_s` what to fly from `now_s + latency` on.

        Parameters
        ----------
        now_s : float               not before the last step [s].
        movers : sequence of Mover  as seen, their stamps on the same clock.

        Raises
        ------
        ValueError : a time that is not finite, or what `movers.table` refuses.
        """
        if not np.isfinite(now_s):
            raise ValueError(f"now: expected a finite number of seconds, found {now_s}")
        flight = self.flight
        switch = max(now_s + self.settings.latency_s, flight.start_s)
        at = min(switch - flight.start_s, flight.trajectory.duration)
        s = flight.trajectory.state(at)
        state = np.array([s.position, s.velocity, s.acceleration])
        if flight.to_goal or flight.trajectory is self._route:  # the goal may be another by now
            self._route, self._route_at = flight.trajectory, at
        else:
            self._route_at = self._nearest_on_route(state[0])
        self._ahead = None
        self._evaluations = 0
        decision = self._decide(_Moment(self._ask(movers, switch), switch, at, state))
        self.flight, self.backup = decision.flight, decision.backup
        if self.flight.to_goal:
            self._off, self._changed = 0, self._changed and not decision.certified
        else:
            self._off += 1
        return decision

    def _ask(self, movers: Sequence[Mover], switch: float) -> Ask:
        world, radius, settings = self.world, self.radius, self.settings
        seen = table(movers)
        seen[:, UNTIL] = np.minimum(seen[:, UNTIL], switch + settings.horizon_s)
        slack = rounding(world.walls, seen, switch + settings.horizon_s)
        reach = max(end_needed(world, radius) + BUFFER, 0.25)
        mover_reach = max(radius + settings.comfort, 0.25)
        return Ask(
            world.scene,
            world.walls,
            seen,
            self._limits,
            needed(world, radius),
            radius + 2.0 * slack,
            reach,
            mover_reach,
        )

    def _decide(self, m: _Moment) -> Decision:
        flight, settings = self.flight, self.settings
        points, knots = flight.trajectory.control_points, flight.trajectory.knots
        free, within, passed, distance, mover, _ = judge(m.ask, points, knots, m.at, m.switch, settings.horizon_s)
        good = free and within and passed
        fine = good and flight.to_goal
        clearance = distance - self.radius
        remaining = max(self._route.duration - self._route_at, 0.0)
        if fine and clearance >= settings.comfort:
            quicker = self._hurry(m, remaining)
            if quicker is not None:
                return quicker
            return self._made(m, Kind.KEEP, flight, True, clearance, mover, "clear")
        best: Found | None = None
        for found, why in self._ways_on(m, remaining if fine else AMPLE * remaining):
            if found.clear:
                if fine and found.distance <= distance + BETTER:
                    break  # no better than what is flown
                return self._switch(m, Kind.SWITCH, found, True, why)
            if found.still and (best is None or found.distance > best.distance):
                best = found
            if fine:
                break  # one look is enough: what is flown is proved
        if fine:
            return self._made(m, Kind.KEEP, flight, True, clearance, mover, "nothing keeps farther off")
        if settings.cold and (self._changed or (self._off + 1) % settings.stranded == 0):
            cold = self._cold(m)
            if cold is not None:
                return cold
        if good:
            return self._made(m, Kind.KEEP, flight, True, clearance, mover, "no way on from here is proved yet")
        for found, why in self._stops(m.ask, flight, m.state, m.switch, self.radius + settings.comfort):
            if found.clear:
                return self._switch(m, Kind.BACKUP, found, False, why)
            if found.still and (best is None or found.distance > best.distance):
                best = found
        if best is not None and (best.distance > distance or not (free and within)):
            goes_on = bool(np.abs(best.points[-1] - self.goal).max() < 1e-9)
            return self._switch(m, Kind.NONE, best, goes_on, "nothing is proved; this keeps farthest off")
        return self._made(m, Kind.NONE, flight, False, clearance, mover, "nothing is proved, nothing keeps farther off")

    def _switch(self, m: _Moment, kind: Kind, found: Found, to_goal: bool, why: str) -> Decision:
        new = Flight(Trajectory(found.points, found.knots), m.switch, to_goal)
        clearance = found.distance - self.radius
        return self._made(m, kind, new, kind is not Kind.NONE, clearance, found.mover, why)

    def _made(
        self, m: _Moment, kind: Kind, flight: Flight, certified: bool, clearance: float, mover: int, why: str
    ) -> Decision:
        """The decision, with the stop that can be flown from the next tick's switch on."""
        backup = None
        if certified:
            after = m.switch + self.settings.period_s
            s = flight.trajectory.state(after - flight.start_s)
            state = np.array([s.position, s.velocity, s.acceleration])
            stops = itertools.chain(self._straight(m.ask, state, after), self._stops(m.ask, flight, state, after))
            for found, _ in stops:
                if found.clear:
                    backup = Flight(Trajectory(found.points, found.knots), after, to_goal=False)
                    break
        reason = f"{why}; {self._covered}" if self._covered else why
        return Decision(kind, flight, certified, clearance, int(mover), reason, backup, self._evaluations)

    def _fly(
        self, m: _Moment, remaining: float, bump: FloatArray = _STILL, bump_at: float = 0.0, rounds: int = ROUNDS
    ) -> Found:
        """A warm plan along the route that takes about `remaining` [s] to its end."""
        if self._ahead is None:
            self._ahead = self._cut()
        ahead, route, hold = self._ahead, self._route, self.settings.horizon_s
        duration = remaining - (route.duration - ahead.last)
        spans = min(max(round(duration / SPAN), FEWEST), MOST)
        points, knots = route.control_points, route.knots
        first, last, end = self._route_at, ahead.last, ahead.end
        found: Found = warm(
            m.ask, m.state, end, points, knots, first, last, duration, spans, m.switch, hold, bump, bump_at, rounds
        )
        self._evaluations += found.evaluations
        if ahead.tail is not None and found.still:
            whole = Trajectory(found.points, found.knots).then(ahead.tail)
            free, within, passed, distance, mover, when = judge(
                m.ask, whole.control_points, whole.knots, 0.0, m.switch, hold
            )
            still = free and within
            found = Found(
                whole.control_points,
                whole.knots,
                still,
                still and passed,
                distance,
                mover,
                when,
                found.evaluations,
            )
        return found

    def _cut(self) -> _Ahead:
        route = self._route
        if self._changed or route.duration - self._route_at <= WINDOW + TAIL:
            return _Ahead(route.duration, np.array([self.goal, _STILL, _STILL]), None)
        last = self._route_at + WINDOW
        s = route.state(last)
        return _Ahead(last, np.array([s.position, s.velocity, s.acceleration]), route.after(last))

    def _hurry(self, m: _Moment, remaining: float) -> Decision | None:
        """A quicker way on, tried now and then."""
        pace, patience = self._pace, self.settings.patience
        pace.waited += 1
        if pace.waited < pace.pause or remaining < 1.0:
            return None
        pace.waited = 0
        found = self._fly(m, self.settings.hurry * remaining, rounds=2)
        saved = remaining - float(found.knots[-1])
        if not found.clear or found.distance - self.radius < self.settings.comfort or saved < 0.01 * remaining:
            pace.pause = min(2 * pace.pause, 16 * patience)
            return None
        pace.pause = patience
        return self._switch(m, Kind.SWITCH, found, True, f"saves {saved:.2f} s")

    def _ways_on(self, m: _Moment, remaining: float) -> Iterator[tuple[Found, str]]:
        """Ways on to the goal, the likeliest first."""
        if not self.flight.to_goal:
            remaining += 0.3
        left = float(np.linalg.norm(self.goal - m.state[0]))
        duration = max(remaining, left / self.limits.speed, 1.0)
        first = self._fly(m, duration)
        yield first, "on along the way"
        along = m.state[1] if np.abs(m.state[1]).max() > 0.3 else self.goal - m.state[0]
        size = float(np.hypot(along[0], along[1]))
        level = np.array([-along[1], along[0], 0.0]) / size if size > 1e-6 else np.array([1.0, 0.0, 0.0])
        up = np.array([0.0, 0.0, 1.0])
        when = min(max(first.time - m.switch, 0.3), max(duration - 0.5, 0.3))
        for side, why in ((level, "on one side"), (-level, "on the other side"), (up, "above"), (-up, "below")):
            yield self._fly(m, duration, SIDESTEP * side, when, 3), why
        yield self._fly(m, duration + 0.5, rounds=3), "slower"
        yield self._fly(m, duration + 1.2, rounds=3), "much slower"

    def _cold(self, m: _Moment) -> Decision | None:
        """A plan from scratch, from the state at the switch; a new route when it is not clear of movers."""
        p, v, a = m.state
        try:
            made = plan(self.world, p, self.goal, self.limits, self.radius, start_velocity=v, start_acceleration=a)
        except (PlannerError, ValueError):
            return None
        trajectory = made.trajectory
        if not made.certified:
            return None
        free, within, passed, distance, mover, _ = judge(
            m.ask, trajectory.control_points, trajectory.knots, 0.0, m.switch, self.settings.horizon_s
        )
        if free and within and passed:
            flight = Flight(trajectory, m.switch)
            return self._made(m, Kind.SWITCH, flight, True, distance - self.radius, mover, "planned from scratch")
        self._route, self._route_at = trajectory, 0.0
        self._changed = False
        return None

    def _straight(self, ask: Ask, state: FloatArray, begin: float) -> Iterator[tuple[Found, str]]:
        """The quickest stop, straight on: the cheapest to find and to prove."""
        points, knots = dash(state, _STILL, 0, self._limits)
        if len(points):
            free, within, passed, distance, mover, when = judge(ask, points, knots, 0.0, begin, self.settings.horizon_s)
            still = free and within
            yield Found(points, knots, still, still and passed, distance, mover, when, 0), "straight stop"

    def _stops(
        self, ask: Ask, flight: Flight, state: FloatArray, begin: float, enough: float = 0.0
    ) -> Iterator[tuple[Found, str]]:
        """Ways to rest from a state at the time `begin`: along what is flown, then straight on or aside."""
        trajectory, limits, hold = flight.trajectory, self.limits, self.settings.horizon_s
        first = min(max(begin - flight.start_s, 0.0), trajectory.duration)
        speed, push = float(np.linalg.norm(state[1])), float(np.linalg.norm(state[2]))
        time = 1.15 * speed / limits.acceleration + (2.0 * limits.acceleration + push) / limits.jerk + 0.2
        last = min(first + 0.5 * time, trajectory.duration)
        low, high = self.world.walls[0] + ask.need, self.world.walls[1] - ask.need
        end = np.array([np.minimum(np.maximum(trajectory.position(last), low), high), _STILL, _STILL])
        spans = min(max(round(time / STOPPING_SPAN), FEWEST), MOST)
        points, knots = trajectory.control_points, trajectory.knots
        found = warm(ask, state, end, points, knots, first, last, time, spans, begin, hold, _STILL, 0.0, 3)
        self._evaluations += found.evaluations
        yield found, "stop ahead"
        yield escape(ask, state, begin, hold, _DIRECTIONS, enough), "get out of the way"

    def _nearest_on_route(self, place: FloatArray) -> float:
        """The time of the route's nearest point, a little ahead of where the vehicle was on it [s]."""
        t = np.linspace(self._route_at, min(self._route_at + LOOK, self._route.duration), 21)
        return float(t[int(np.argmin(((self._route.position(t) - place) ** 2).sum(axis=1)))])


def warm_up() -> None:
    """Compile what planning in flight needs beyond `plan.warm_up`: half a minute once, then none."""
    world = World(((0.0, 0.0, 0.0), (6.0, 6.0, 2.0)), [Cylinder((3.0, 3.0), 0.3, (0.0, 2.0))])
    limits = Limits(2.0, 4.0, 40.0)
    replanner = Replanner(world, limits, 0.2, plan(world, (0.5, 3.0, 1.0), (5.5, 3.0, 1.0), limits, 0.2).trajectory)
    for tick in range(3):
        replanner.step(0.1 * tick, [MovingSphere((3.0, 4.0, 1.0), (0.0, -0.5, 0.0), 0.3, stamp=0.1 * tick)])
    replanner.remap(world)
    replanner.retarget((5.4, 3.1, 1.0))
    replanner.step(0.4)


__all__ = ["Decision", "Flight", "Kind", "Replanner", "Settings", "warm_up"]
