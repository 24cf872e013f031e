"""Planning in flight, the companion's half: when to ask, what to take, and what to fly when there is no answer.

    boundary k      what was asked at boundary k - 1 is due. Its answer is held against the newest map (`guard`) and
                    flown from the boundary on; then the next question goes out, about boundary k + 1
    no answer, one that nothing proves, or one that the guard refuses
                    the stop that came with the answer before is flown: it begins at this very boundary
    at a stop       a plan from scratch is asked for beside the other questions, from where the stop ends

So what planning takes is part of the plan: a question is asked a whole period ahead of its switch, and every answer
brings the stop for the case that the next one does not come. Boundaries are `period_us` apart; after `LATE` answers in
a row that came too late the period doubles, up to `LONGEST_US`. A late answer is counted and dropped.

Nothing here plans: `drivers.desk` does, in line or in a process of its own.
"""

import math
from dataclasses import replace

import numpy as np

from companion.column import climb_crossed_s
from companion.hooks import Pose
from companion.itinerary import Itinerary
from companion.mission import Mission
from companion.motion import end_us, state_at
from companion.seam import Flown, Level, Note, PlanWanted, ReplanReady, ReplanWanted
from companion.seeing.sight import Sight
from companion.ways import Ways

PERIOD_US, LONGEST_US = 100_000, 400_000
DRIFT_M, DRIFT_US = 0.5, 300_000
"""Farther than this from what is flown for this long, and planning begins anew from where the vehicle is."""
RESTING_US = 500_000
"""Between two questions of a vehicle that rests where nothing moves."""
LATE = 3
LADDER = (1.0, 0.85, 0.7)
"""Parts of the radius with which a plan from scratch is tried in turn, where noise has put cells within the radius."""
TIGHTEST = 0.03
"""Hull to what is seen, at least [m]; the guard keeps the same."""
ELSEWHERE = 1e-3
"""A way that ends so far from the goal does not lead to it [m]."""
AWAY_SPARE = 0.1
"""What a step out of the radius may come nearer than where it begins, by the newest map [m]."""
FORGIVEN, RECENT_US = 1, 2_000_000
"""How often on a leg, when nothing on the ladder leads on, what was not seen so lately is forgotten."""
AGAIN_US, AGAIN_LATER_US = 500_000, 1_500_000
"""Between two plans from scratch; and how much more when the ladder has been climbed in vain."""
PATIENCE_US = 1_000_000
"""At a stop for so long, and it is told that there is no way on."""


class Replanning:
    """The replanning of one flight.

    Parameters
    ----------
    mission, itinerary : what is flown.
    sight : what is seen.
    seed : for plans from scratch.

    Attributes
    ----------
    trouble : why the vehicle stands at a stop on the way; empty otherwise.
    asked, late, refused : questions, answers that came too late, answers that the guard refused.
    switches, stops, scratch : new ways on that were flown, stops that were flown, plans from scratch among the former.
    drifts : starts anew from where the vehicle was, since it was elsewhere than it should be.
    """

    def __init__(self, mission: Mission, itinerary: Itinerary, sight: Sight, seed: int) -> None:
        self.trouble = ""
        self.asked = self.late = self.refused = self.switches = self.stops = self.scratch = 0
        self.drifts = 0
        self._mission, self._itinerary, self._sight, self._seed = mission, itinerary, sight, seed
        self._hull = mission.vehicle.radius + TIGHTEST
        self._ways = Ways(sight, self._hull, mission.planner_limits())
        self._said: list[Note] = []
        self._period_us = self._asked_period_us = PERIOD_US
        self._requests = 0
        self._aim: PlanWanted | None = None  # the leg that is replanned; None: none is
        self._due_us = 0  # the next boundary
        self._pending: int | None = None  # the question under way
        self._answer: ReplanReady | None = None
        self._backup: Flown | None = None  # begins at the next boundary
        self._fresh = True
        self._map_told = -1  # version of the map the desk has
        self._in_a_row = 0
        self._cold: ReplanWanted | None = None  # the plan from scratch under way
        self._cold_answer: ReplanReady | None = None
        self._cold_us = 0
        self._rung = 0
        self._stopped_us = 0
        self._on_track_us = 0
        self._lost = False
        self._forgiven = 0  # times the map was cut down to what is in sight, on this leg

    @property
    def worst_joint(self) -> float:
        """The greatest jump of a switch [m], [m/s], [m/s^2]."""
        return self._ways.worst_joint

    def take(self, ready: ReplanReady, flight_us: int) -> None:
        """An answer; what was not asked for, or is too late, is dropped."""
        if self._cold is not None and ready.request_id == self._cold.request_id:
            self._cold_answer = ready
        elif ready.request_id == self._pending and self._answer is None:
            self._answer = ready
        else:
            self.late += self._aim is not None

    def in_the_way(self, flight_us: int) -> str:
        """What is about to cross the climb, before anything has left the ground; or nothing."""
        crossed_s = climb_crossed_s(self._mission, self._sight.tracks, flight_us)
        return "" if crossed_s == math.inf else f"something crosses the climb in {crossed_s:.1f} s"

    def lost(self) -> None:
        """The vehicle stands elsewhere than what is flown says: begin anew from where it is at the next step."""
        self._lost = True

    def take_said(self) -> list[Note]:
        """What people should know; each is told once."""
        said, self._said = self._said, []
        return said

    def step(self, flight_us: int, pose: Pose) -> list[ReplanWanted]:
        """Once a tick while FLYING: the questions to ask now."""
        flown, aim = self._itinerary.flown(flight_us), self._itinerary.aim()
        if flown is None or aim is None or aim.via_m:
            self._forget()
            return []
        if aim is not self._aim:
            self._forget()
            self._aim, self._due_us, self._on_track_us = aim, flight_us, flight_us
            self._ways.limits = aim.limits
            self._sight.jumped, self._forgiven = False, 0
            flown = self._turned(flight_us, flown)
        flown = self._where_it_is(flight_us, pose, flown)
        scratch = self._cold_answer
        if scratch is not None and scratch.flown is not None and not flown.to_goal and flight_us >= end_us(flown):
            self._due_us = min(self._due_us, flight_us)  # at rest, with a way on: no need to wait
        if flight_us < self._due_us:
            return []
        boundary = self._due_us
        flown = self._decide(boundary, flown)
        self._itinerary.follow(flight_us, flown)
        resting = not flown.to_goal and boundary >= end_us(flown) and not len(self._sight.tracks)
        period_us = max(RESTING_US, self._period_us) if resting else self._period_us
        self._fresh |= period_us != self._asked_period_us
        self._asked_period_us = period_us
        self._due_us = boundary + period_us
        if self._due_us <= flight_us:  # whole periods without a tick: they are over
            boundary, self._due_us = flight_us, flight_us + period_us
            self._fresh, self._backup = True, None
        wanted = [self._question(boundary, flown)]
        wanted += self._from_scratch(flight_us, flown)
        return wanted

    # ---- what to fly --------------------------------------------------------------------------------------------

    def _where_it_is(self, flight_us: int, pose: Pose, flown: Flown) -> Flown:
        """What is flown; a stop from where the vehicle is, when that is not where it should be, or the frame moved."""
        error = float(np.linalg.norm(pose.position_m - state_at(flown, flight_us).position))
        if error <= DRIFT_M:
            self._on_track_us = flight_us
        jumped, self._sight.jumped = self._sight.jumped, False
        lost, self._lost = self._lost, False
        if not (jumped or lost) and flight_us - self._on_track_us <= DRIFT_US:
            return flown
        stop = self._ways.stop_from(flight_us, np.array([pose.position_m, pose.velocity_m, np.zeros(3)]))
        if stop is None:
            return flown
        what = "the vehicle's origin moved" if jumped else f"{error:.1f} m from what is flown"
        self._tell(Level.WARNING, f"{what}: stopping where it is, planning anew")
        self._itinerary.follow(flight_us, stop)
        self._pending = self._answer = self._backup = self._cold = self._cold_answer = None
        self._fresh, self._due_us, self._on_track_us = True, flight_us, flight_us
        self.drifts += 1
        return stop

    def _turned(self, flight_us: int, flown: Flown) -> Flown:
        """What is flown; the quickest stop instead, where that leads elsewhere than the leg does now."""
        stop = self._ways.quickest_stop(flight_us, flown) if flown.to_goal and not self._ends_at_goal(flown) else None
        if stop is None:
            return flown
        self._itinerary.follow(flight_us, stop)
        return stop

    def _ends_at_goal(self, flown: Flown) -> bool:
        assert self._aim is not None
        return math.dist(flown.trajectory.position(flown.trajectory.duration), self._aim.goal_m) <= ELSEWHERE

    def _decide(self, boundary: int, flown: Flown) -> Flown:
        """What is flown from this boundary on."""
        answer, pending, backup = self._answer, self._pending, self._backup
        self._answer = self._pending = self._backup = None
        scratch = self._take_scratch(boundary, flown)
        if scratch is not None:
            return scratch
        if pending is None:
            return flown  # nothing was asked yet
        why = ""
        if answer is None:
            self._in_a_row += 1
            self._fresh = True
            why = "no answer in time"
            if self._in_a_row >= LATE and self._period_us < LONGEST_US:
                self._in_a_row, self._period_us = 0, min(2 * self._period_us, LONGEST_US)
                self._tell(Level.WARNING, f"planning takes too long: asked every {self._period_us / 1e3:.0f} ms now")
        else:
            self._in_a_row = 0
            chosen = flown if answer.flown is None else answer.flown
            if not answer.certified:
                why = answer.reason or answer.kind
            elif not self._ways.passes(chosen, boundary, self._period_us):
                self.refused += 1
                why = "what is seen now is in the way of the answer"
            elif self._ways.joins(flown, chosen):
                return self._taken(flown, chosen, answer)
            else:
                why = "the answer does not join what is flown"
        self._fresh = True
        least = answer.flown if answer is not None and not answer.certified else None
        return self._stop(boundary, flown, backup, least, why)

    def _taken(self, flown: Flown, chosen: Flown, answer: ReplanReady) -> Flown:
        self._backup = answer.backup
        if chosen is not flown:
            self.switches += chosen.to_goal
            self.stops += not chosen.to_goal
            if not chosen.to_goal and flown.to_goal:
                self._tell(Level.WARNING, f"no way on is proved: {answer.reason}")
        return chosen

    def _stop(self, boundary: int, flown: Flown, backup: Flown | None, least: Flown | None, why: str) -> Flown:
        """What is flown without an answer: one more period of the same, if a stop after it is clear, or a stop."""
        if flown.to_goal:
            self._backup = self._ways.stop_after(boundary, flown, self._period_us)
            if self._backup is not None:
                return flown
        stop = self._ways.without_answer(boundary, flown, backup, least)
        if stop is not flown:
            self.stops += 1
            if flown.to_goal:
                self._tell(Level.WARNING, f"stopping: {why}")
        return stop

    # ---- what to ask --------------------------------------------------------------------------------------------

    def _question(self, boundary: int, flown: Flown) -> ReplanWanted:
        assert self._aim is not None
        self._requests += 1
        self.asked += 1
        self._pending = self._requests
        view = self._sight.map.view()
        new = view.version != self._map_told or self._fresh
        wanted = ReplanWanted(
            request_id=self._requests,
            now_us=boundary,
            switch_us=boundary + self._asked_period_us,
            period_us=self._asked_period_us,
            goal_m=self._aim.goal_m,
            limits=self._aim.limits,
            radius=self._radius,
            seed=self._seed,
            flown=flown,
            fresh=self._fresh,
            map=view if new else None,
            movers=self._sight.tracks.movers(),
        )
        self._map_told, self._fresh = view.version, False
        return wanted

    @property
    def _radius(self) -> float:
        return max(LADDER[self._rung] * self._mission.seen_radius(), self._hull)

    def _from_scratch(self, flight_us: int, flown: Flown) -> list[ReplanWanted]:
        """At a stop, or on the way to one: ask for a plan from where it ends."""
        if flown.to_goal:
            self._stopped_us, self.trouble = 0, ""
            self._cold = self._cold_answer = None
            return []
        self._stopped_us = self._stopped_us or flight_us
        if flight_us - self._stopped_us > PATIENCE_US and not self.trouble:
            self.trouble = "no way on is proved"
        if self._cold is not None or flight_us < self._cold_us or self._ends_at_goal(flown):
            return []
        self._requests += 1
        view = self._sight.map.view()
        rest = Flown(flown.trajectory, flown.start_us, to_goal=False)
        self._cold = ReplanWanted(
            request_id=self._requests,
            now_us=flight_us,
            switch_us=end_us(flown),
            period_us=self._period_us,
            goal_m=self._aim.goal_m if self._aim is not None else (0.0, 0.0, 0.0),
            limits=self._aim.limits if self._aim is not None else self._mission.planner_limits(),
            radius=self._radius,
            seed=self._seed + self._requests,
            flown=rest,
            fresh=True,
            map=view,
            movers=(),
            cold=True,
        )
        return [self._cold]

    def _take_scratch(self, boundary: int, flown: Flown) -> Flown | None:
        """The plan from scratch, flown from this boundary on, once the vehicle rests where it begins."""
        answer = self._cold_answer
        if answer is None or flown.to_goal:
            return None
        if answer.flown is None:
            self._cold = self._cold_answer = None
            self._cold_us = boundary + AGAIN_US
            tight = self._radius <= self._hull
            self._rung = 0 if tight or self._rung + 1 == len(LADDER) else self._rung + 1
            self._cold_us += 0 if self._rung else AGAIN_LATER_US
            vain = self._rung == 0 and boundary - self._stopped_us > PATIENCE_US
            if vain and self._itinerary.leave_out_place():
                self._tell(Level.WARNING, f"a point on the way is left out: {answer.reason}")
            elif vain and self._forgiven < FORGIVEN:
                self._forgiven += 1
                self._sight.map.forget_unseen(boundary - RECENT_US)
                self._tell(Level.WARNING, "no way with all that was seen: looking again at what is out of sight")
            self._fresh = True
            if answer.reason != self.trouble and self.trouble:
                self.trouble = answer.reason
                self._tell(Level.WARNING, f"no way on: {answer.reason}")
            return None
        if boundary < end_us(flown):
            return None
        self._cold = self._cold_answer = None
        self._cold_us = boundary + AGAIN_US
        chosen = replace(answer.flown, start_us=boundary)
        if not self._ways.joins(flown, chosen):
            return None
        if not chosen.to_goal:  # a step out of the radius of what is near
            self._cold_us = boundary
            near = min(self._hull, answer.clearance - AWAY_SPARE)
            if self._ways.clear(chosen, boundary, radius=near) < math.inf:
                return None
            self._fresh = True
            return chosen
        if not self._ways.passes(chosen, boundary, self._period_us):
            return None
        self._fresh, self._backup = True, None
        self.switches += 1
        self.scratch += 1
        return chosen

    def _forget(self) -> None:
        """No leg is replanned: what is under way is about nothing any more."""
        self._aim = self._pending = self._answer = self._backup = None
        self._cold = self._cold_answer = None
        self._fresh, self._map_told, self._rung, self._stopped_us, self.trouble = True, -1, 0, 0, ""
        self._cold_us = 0

    def _tell(self, level: Level, text: str) -> None:
        if len(self._said) < 8:
            self._said.append(Note(level, text))
