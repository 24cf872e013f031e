"""The mission's steps, walked by the clock: which reference is flown now.

Legs are planned before anything moves (`wanted`); takeoff is a straight climb, hold keeps the last point, and land is
where this file ends: the vehicle lands by itself. Everything here is in the mission frame (NED).

Orders in flight (`order`) never jump. `hold` slows the walk to rest on the very path that is proved clear, `resume`
lets it go on. `goto` and `return` come to rest likewise and then fly an errand: one leg, planned from there, while the
mission waits below it; `resume` first plans the way back to where the mission was left, `skip` to where another step
begins.

What is flown now, for those who look ahead on it and plan it again, is `flownway`'s.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from companion.flownway import FlownWay
from companion.legs import Leg, circle_flaw, column_flaw, lay_out, place, radius_of, rest_at, vector
from companion.pace import paced
from companion.profile import Circle, Turn
from companion.seam import FloatArray, Level, Note, Order, PlanReady, PlanWanted, Reference
from companion.steps import Step
from companion.walk import Walk
from planner import Limits, Trajectory

SPOOL_UP_S = 1.0
"""Between the word that it is armed and the first climb: PX4 spools its motors up for COM_SPOOLUP_TIME, 1 s."""
ERRANDS = 1_000_000
"""Plans of errands are numbered from here, those of steps by their step."""
HERE = 1e-3
"""A place nearer than this needs no plan [m]."""


@dataclass(slots=True)
class Itinerary(FlownWay):
    """Where the flight is in its steps.

    Attributes
    ----------
    mission, seed, stopped, blocked : of `FlownWay`.
    yaw : where the nose points [rad], until a step turns it.
    refused : why the way that an order needed last was not planned; empty otherwise.
    cut_short : by which order the mission did not go to its end; empty otherwise.
    skipped : how often a step was gone on with by order, and which it was last.
    """

    yaw: float = 0.0
    _start: FloatArray = field(init=False)  # (3,) where the flight begins
    _next: Order | None = None  # to be carried out as soon as it is at rest
    _purpose: Order | None = None  # of the errand, until it is there
    _landing: bool = False  # an order ends the flight here
    refused: str = ""
    cut_short: str = ""
    skipped: tuple[int, int] = (0, 0)
    _ways: dict[int, tuple[PlanWanted | None, Trajectory]] = field(default_factory=dict)  # of legs, as first planned
    _said: list[PlanWanted | Note] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.stand(np.array(self.mission.start_m()))

    @property
    def start_m(self) -> FloatArray:
        """Where the flight begins (3,)."""
        return self._start

    def stand(self, start_m: FloatArray) -> None:
        """Lay the steps out from where the vehicle stands (3,); before `wanted`."""
        self._start = start_m
        self._main = Walk(lay_out(self.mission, self.seed, vector(start_m)))

    # ---- on the ground ------------------------------------------------------------------------------------------

    def wanted(self) -> list[PlanWanted]:
        """One request a leg, from where the step before ends; `request_id` is the step's index."""
        return [leg.wanted for leg in self._main.legs if leg.wanted is not None]

    def wants(self, request_id: int) -> bool:
        """Whether this is the number of a leg of the mission."""
        return 0 <= request_id < len(self._main.legs) and self._main.legs[request_id].wanted is not None

    def take(self, request_id: int, trajectory: Trajectory) -> None:
        """Keep the trajectory of one leg."""
        leg = self._main.legs[request_id]
        leg.planned = trajectory
        self._ways[request_id] = (leg.wanted, trajectory)

    def planned(self) -> bool:
        """Whether every leg has its trajectory."""
        return all(leg.ready for leg in self._main.legs)

    def obstruction(self) -> str:
        """Why the climb, an orbit or the landing cannot be flown, or nothing; legs are the planner's to refuse."""
        world, radius, legs = self.mission.planner_world(), self.mission.planner_radius(), self._main.legs
        fence = self.mission.geofence()
        for what, top in (("the climb", legs[0].end), ("the landing", legs[-1].end)):
            flaw = "" if fence is None else fence.told(top, radius)
            flaw = flaw or column_flaw(world, top, radius)
            if flaw:
                return f"{what} at {place(top)} is {flaw}"
        for i, leg in enumerate(legs):
            circle = leg.then[-1] if leg.then else None
            flaw = circle_flaw(world, circle, radius_of(self.mission, leg.step)) if isinstance(circle, Circle) else ""
            if flaw:
                return f"the orbit of step {i} is {flaw}"
        return ""

    # ---- in the air ---------------------------------------------------------------------------------------------

    @property
    def index(self) -> int:
        return self._main.index

    @property
    def step(self) -> Step:
        return self._main.leg.step

    def begin(self, now_us: int) -> None:
        """Start walking: the takeoff begins after the motors have spooled up."""
        self._main.entered_us = now_us + round(SPOOL_UP_S * 1e6)

    def airborne(self, now_us: int) -> None:
        """Start walking with the takeoff done by somebody else: the step after it begins."""
        self._main.index, self._main.entered_us = 1, round(self._main.pace.at(now_us).us)
        self._enter()

    def climb(self, now_us: int) -> bool:
        """Walk the takeoff, and wait at its top until `airborne`: whether it is there."""
        self._follow_orders(now_us)
        walk = self._main
        if walk.entered_us is None or walk.index > 0:
            return walk.index > 0
        return walk.pace.at(now_us).us >= walk.entered_us + round(walk.duration() * 1e6)

    def advance(self, now_us: int) -> bool:
        """Move on from every step whose time is over; True when the step changed."""
        self._follow_orders(now_us)
        if self._detour is not None and self._detour.seconds(now_us) >= self._detour.duration():
            self._come_back(now_us)
        before, walk = self._main.index, self._main
        while self._top is walk and walk.entered_us is not None and self.step.land is None:
            duration = walk.duration()
            if math.isinf(duration):
                break
            end_us = walk.entered_us + round(duration * 1e6)
            if walk.pace.at(now_us).us < end_us:
                break
            if walk.leg.rest and walk.leg.planned is not None:
                here = walk.leg.planned.position(walk.leg.planned.duration)
                walk.leg.planned, walk.open_ended, walk.entered_us = rest_at(here), True, end_us
                self.leave_out_place()
                break
            if walk.released:  # at an order, not by the clock
                end_us = round(walk.pace.at(now_us).us)
            self._leave()
            walk.index, walk.entered_us = walk.index + 1, end_us
            self._enter()
        return walk.index != before

    def finished(self) -> bool:
        """Whether only landing is left."""
        return self._detour is None and (self._landing or (self._errand is None and self.step.land is not None))

    def reference(self, now_us: int) -> Reference:
        """Where the vehicle should be at `now_us`."""
        walk, turn = self._top, self._below.turn
        time, seconds = walk.pace.at(now_us), walk.seconds(now_us)
        state = paced(walk.motion(seconds), time)
        yaw = self.yaw if turn is None else turn.yaw(self._below.seconds(now_us))
        return Reference(state.position, state.velocity, state.acceleration, yaw)

    def remaining(self, position_m: FloatArray) -> float:
        """Straight distance [m] to where the current step ends."""
        return float(np.linalg.norm(self._top.leg.end - position_m))

    def heed(self, battery: float | None) -> None:
        """What a step may wait for: what is left in the battery (0..1), where it is known."""
        wait = self.step.wait
        if wait is not None and wait.percent is not None and battery is not None:
            self._main.released = self._main.released or 100.0 * battery >= wait.percent

    def next_way(self, seconds: float, every_s: float) -> FloatArray | None:
        """Where the next step that moves leads (m, 3) in its first seconds; None where that is the landing."""
        legs = self._main.legs[self.index + 1 :]
        leg = next((leg for leg in legs if leg.paths or leg.step.land is not None), None)
        if leg is None or not leg.paths:
            return None
        walk = Walk([leg])
        return np.array([walk.motion(every_s * k).position for k in range(round(seconds / every_s) + 1)])

    def heed_movers(self, clear: bool) -> None:
        """A step may wait until nothing moves across the way of the next."""
        if self.step.wait is not None and self.step.wait.for_ == "movers clear":
            self._main.released = clear

    def release(self) -> None:
        """What the step waits for has happened."""
        if self.step.wait is not None:
            self._main.released = True

    def take_said(self) -> list[PlanWanted | Note]:
        """Plans that an order needs, and what people should know; each is told once."""
        said, self._said = self._said, []
        return said

    # ---- orders -------------------------------------------------------------------------------------------------

    def order(self, now_us: int, order: Order) -> str:
        """Carry out an order while flying: why it cannot be done, or nothing."""
        if order.name in ("resume", "start"):
            return self._resume(now_us)
        if order.name == "hold" and self._paused and self._next is None:
            return "it holds already"
        if order.name == "hold":
            self._pause(None)
        elif order.name in ("goto", "return"):
            goal = self._goal(now_us, order)
            flaw = self._goal_flaw(goal, lands=order.name == "return")
            if flaw:
                return f"{place(goal)} is {flaw}"
            self._pause(order)
        elif order.name == "skip":
            found = order.values[0] if order.values else math.nan
            if found not in range(1, len(self._main.legs)):
                return f"found step {found:g}, expected 1 to {len(self._main.legs) - 1}: it is in the air already"
            self._pause(order)
        elif order.name == "abort":
            self._pause(order)
        else:
            return f"{order.name} is nothing that can be ordered in flight"
        return ""

    @property
    def holding(self) -> bool:
        """Whether an order keeps the mission from going on."""
        return self._paused or self._errand is not None

    @property
    def homeward(self) -> bool:
        """Whether it is about to return, returns, or has done so, by an order."""
        orders = (self._next, self._purpose)
        return self._landing or any(order is not None and order.name == "return" for order in orders)

    @property
    def under_way(self) -> bool:
        """Whether an order is flown."""
        return self._purpose is not None

    def answer(self, now_us: int, ready: PlanReady) -> bool:
        """Take the plan of an errand; False when it is not one that was asked for."""
        asked, order = self._asked, self._next
        if asked is None or order is None or ready.request_id != asked.request_id:
            return False
        self._asked = self._next = None
        if ready.trajectory is None or not ready.certified:
            self.refused = reason = ready.text or ready.error or "not certified"
            self._said.append(Note(Level.WARNING, f"{order.name}: {reason}: holding"))
            return True
        leg = Leg(self.step, np.array(asked.goal_m), asked, ready.trajectory)
        self._errand, self._purpose = Walk([leg], entered_us=now_us), order
        self._paused = False
        return True

    def _come_back(self, now_us: int) -> None:
        """A detour is where the rest stands: a step whose time has passed meanwhile ends now, and not before."""
        self._detour = None
        walk = self._main
        if self._errand is None and walk.entered_us is not None:
            late = walk.pace.at(now_us).us - (walk.entered_us + walk.duration() * 1e6)
            walk.entered_us += max(0, math.ceil(late)) if math.isfinite(late) else 0

    def _enter(self) -> None:
        step, walk = self.step, self._main
        walk.released = walk.open_ended = False
        if step.yaw is not None:
            walk.turn = Turn.within(self.yaw, math.radians(step.yaw.heading_deg), math.radians(step.yaw.rate_deg))

    def _leave(self) -> None:
        if self._main.turn is not None:
            self.yaw, self._main.turn = self._main.turn.yaw(math.inf), None

    def _pause(self, then: Order | None) -> None:
        """Come to rest; `then` is carried out there."""
        self._paused, self._next, self._asked = True, then, None

    def _resume(self, now_us: int) -> str:
        if self._errand is not None and self._arrived(now_us):
            self._pause(Order("resume"))  # plan the way back to where the mission was left
        elif self._paused:
            self._paused, self._next, self._asked = False, None, None
        elif self._errand is None and self.step.wait is not None:
            self.release()
        else:
            return "nothing is held"
        return ""

    def _arrived(self, now_us: int) -> bool:
        """Whether the errand is where it was sent."""
        return self._errand is not None and self._errand.seconds(now_us) >= self._errand.duration()

    def _follow_orders(self, now_us: int) -> None:
        """Bring the pace to what is ordered, and begin what waits for rest."""
        away, walk = self._detour is not None, self._top
        paused = self.stopped or (not away and (self._paused or self.blocked))
        if walk.entered_us is None:
            return
        changes = walk.pace.running(now_us) if paused else walk.pace.still(now_us)
        walk.patient_us = walk.patient_us if changes else None
        if away:
            if changes:
                walk.change_pace(now_us, self._limits(walk))
        elif self._arrived(now_us) and self._purpose is not None and not paused:
            order, self._purpose = self._purpose, None
            self._arrive(now_us, order)
        elif changes:
            walk.change_pace(now_us, self._limits(walk))
        elif self._paused and walk.pace.still(now_us) and self._next is not None and self._asked is None:
            self._run(now_us, self._next)

    def _run(self, now_us: int, order: Order) -> None:
        """At rest: ask for the plan of an errand, or end the flight."""
        here = self.reference(now_us).position_m
        if order.name == "abort":
            self._next = None
            flaw = column_flaw(self.mission.planner_world(), here, self.mission.vehicle.radius)
            if flaw:
                self._said.append(Note(Level.WARNING, f"abort: no landing, since {place(here)} is {flaw}: holding"))
            else:
                self._end("abort")
            return
        goal = self._goal(now_us, order)
        if float(np.linalg.norm(goal - here)) < HERE:
            self._next = None
            self._arrive(now_us, order)
            return
        self._requests += 1
        self._asked = self._wanted(ERRANDS + self._requests, here, goal)
        self._said.append(self._asked)

    def _arrive(self, now_us: int, order: Order) -> None:
        """An errand is where it was sent."""
        if order.name == "goto":
            here = place(self.reference(now_us).position_m)
            self._said.append(Note(Level.INFO, f"at {here}, holding until ordered on"))
        elif order.name == "return":
            self._end("return")
        else:  # back where the mission was left, or is to go on
            if order.name == "skip":
                self._skip(now_us, int(order.values[0]))
            self._errand, self._paused = None, False

    def _skip(self, now_us: int, index: int) -> None:
        """Go on with a step, at whose beginning it stands."""
        walk, self.yaw = self._main, self.reference(now_us).yaw
        walk.index, walk.entered_us, walk.turn = index, round(walk.pace.at(now_us).us), None
        if index in self._ways:  # as from its beginning, whatever it became when it was flown before
            walk.leg.wanted, walk.leg.planned = self._ways[index]
            walk.leg.rest = []
        self.skipped = (self.skipped[0] + 1, index)
        self._enter()
        self._said.append(Note(Level.INFO, f"step {index}: {self.step.kind}, as ordered"))

    def _end(self, order: str) -> None:
        self._landing, self.cut_short = True, f"cut short in step {self.index} by the order to {order}"

    def _goal(self, now_us: int, order: Order) -> FloatArray:
        if order.name == "goto":
            north, east, altitude = order.values if len(order.values) == 3 else (math.nan,) * 3
            return np.array([north, east, -altitude])
        if order.name == "return":
            return np.array([self._start[0], self._start[1], self.reference(now_us).position_m[2]])
        if order.name == "skip":
            return self._main.legs[int(order.values[0]) - 1].end
        return self._main.motion(self._main.seconds(now_us)).position

    def _goal_flaw(self, goal: FloatArray, lands: bool) -> str:
        """Why one cannot go to a place, or nothing."""
        if not np.isfinite(goal).all():
            return "not a place"
        radius, fence, world = self.mission.planner_radius(), self.mission.geofence(), self.mission.planner_world()
        if fence is not None and (flaw := fence.told(goal, radius)):
            return flaw
        for what, distance in (("the bounds", world.wall_distance), ("an obstacle", world.distance)):
            lack = radius - float(distance(goal[None])[0])
            if lack > 0.0:
                return f"{lack:.2f} m too near {what} (it keeps {radius:g} m)"
        return column_flaw(world, goal, radius) if lands else ""

    def _limits(self, walk: Walk) -> Limits:
        return walk.leg.wanted.limits if walk.leg.wanted is not None else self.mission.planner_limits()
