"""What is flown now, for those who look ahead on it and plan it again: the mission, an errand, or a detour.

An errand is flown instead of the mission, by order; a detour instead of either, by what is seen, to where it should
stand: out of the way of what comes at a vehicle at rest and back, or back to where the mission waits. What is below
stands meanwhile, and nothing of that is a jump.
"""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from companion.legs import Leg, rest_at, vector
from companion.mission import Mission
from companion.pace import paced
from companion.seam import FloatArray, Flown, PlanWanted
from companion.walk import Walk

DETOURS = 3_000_000
"""Their goals are numbered from here; nobody plans them on the ground."""
LOOK_S = 0.05
"""Spacing of the looks at when a leg passes its points [s]."""
AT_REST = 1e-3
"""[m/s]"""


@dataclass(slots=True)
class FlownWay:
    """Walks, one on top of the other: the topmost is flown.

    Attributes
    ----------
    mission : what to fly.
    seed : for the planner; the leg of step k is planned with seed + k.
    stopped : keep it at rest on its path, whatever is ordered: safety's word, not a person's.
    blocked : keep it at rest likewise: something is seen on its path.
    """

    mission: Mission
    seed: int
    stopped: bool = False
    blocked: bool = False
    _main: Walk = field(init=False)
    _errand: Walk | None = None  # what is flown instead of the mission
    _detour: Walk | None = None  # flown instead of either, until it is where that stands
    _paused: bool = False
    _asked: PlanWanted | None = None  # of an errand
    _requests: int = 0

    def flown(self, now_us: int) -> Flown | None:
        """The planned trajectory that is flown at its own pace, if one is."""
        walk, seconds = self._top, self._top.seconds(now_us)
        planned = walk.leg.planned
        if planned is None or walk.entered_us is None or not walk.pace.running(now_us):
            return None
        if self._paused and self._detour is None:
            return None
        if seconds < 0.0 or (seconds >= planned.duration and not walk.open_ended):
            return None
        start_us = now_us - round(walk.pace.at(now_us).us - walk.entered_us)
        return Flown(planned, start_us, not walk.open_ended)

    def aim(self) -> PlanWanted | None:
        """What the leg under way was planned for: its goal, limits and radius."""
        return self._top.leg.wanted

    def follow(self, now_us: int, flown: Flown) -> None:
        """Fly this from now on instead of the planned leg; only while `flown` is not None."""
        walk = self._top
        if walk.leg.planned is flown.trajectory:
            return
        walk.leg.planned, walk.open_ended = flown.trajectory, not flown.to_goal
        walk.entered_us = round(walk.pace.at(now_us).us) - (now_us - flown.start_us)

    def ahead(self, now_us: int, seconds: float, every_s: float) -> FloatArray | None:
        """Where it leads (m, 3) from now on at full pace, where nobody plans it again: on a circle, or past points.

        None elsewhere. The first point is where it is now; after the leg's end it stands.
        """
        walk = self._top
        replanned = walk.leg.planned is not None and not (walk.leg.wanted is not None and walk.leg.wanted.via_m)
        begun = walk.leg.planned.duration if replanned and walk.leg.planned is not None else 0.0
        here = walk.seconds(now_us)
        if walk.entered_us is None or not walk.leg.paths or here < begun or walk.open_ended:
            return None
        return np.array([walk.motion(here + every_s * k).position for k in range(round(seconds / every_s) + 1)])

    def leads_on(self, now_us: int) -> bool:
        """Whether a leg that is planned again and again is under way, or will be as soon as it is not `stopped`."""
        walk, leg = self._top, self._top.leg
        if leg.planned is None or leg.wanted is None or leg.wanted.via_m:
            return False
        waits = self._detour is None and (self._paused or self.blocked)
        return not waits and (walk.open_ended or walk.seconds(now_us) < leg.planned.duration)

    @property
    def away(self) -> bool:
        """Whether it is on a detour."""
        return self._detour is not None

    def standing(self, now_us: int) -> FloatArray | None:
        """Where it stands (3,), to go on from there when the time comes; None while it moves, or is told to plan."""
        walk = self._below
        if self._detour is not None or self.stopped or walk.entered_us is None or self._asked is not None:
            return None
        ways = sum(float(path.duration) for path in walk.leg.paths)
        if not walk.pace.still(now_us) and (walk.open_ended or walk.seconds(now_us) < ways):
            return None
        return self._waiting_at(now_us)

    def detour(self, now_us: int, here: FloatArray, skip_s: float = 0.0) -> bool:
        """From rest at `here` (3,) to where it should stand, by what is seen; False as long as that still moves.

        With `skip_s` it is to go on from farther along its path [s], and not to fly what is before that.
        """
        walk = self._below
        state = paced(walk.motion(walk.seconds(now_us)), walk.pace.at(now_us))
        if float(np.linalg.norm(state.velocity)) > AT_REST or self._asked is not None:
            return False
        if walk.entered_us is not None:
            walk.entered_us -= round(skip_s * 1e6)
        self._requests += 1
        goal = self._waiting_at(now_us)
        wanted = self._wanted(DETOURS + self._requests, here, goal)
        self._detour = Walk([Leg(self._main.leg.step, goal, wanted, rest_at(here))], entered_us=now_us, open_ended=True)
        return True

    def by_places(self, now_us: int) -> bool:
        """Fly to the points on the way that are ahead one by one, planned by what is seen; False without any points."""
        leg, here = self._top.leg, self._top.seconds(now_us)
        if leg.wanted is None or leg.planned is None or not leg.wanted.via_m:
            return False
        times = np.linspace(0.0, leg.planned.duration, 1 + math.ceil(leg.planned.duration / LOOK_S))
        track = leg.planned.position(times)
        passes = [times[int(np.argmin(((track - point) ** 2).sum(axis=1)))] for point in leg.wanted.via_m]
        goal, *leg.rest = [*(p for p, at in zip(leg.wanted.via_m, passes, strict=True) if at > here), leg.wanted.goal_m]
        leg.wanted = replace(leg.wanted, goal_m=goal, via_m=())
        return True

    def leave_out_place(self) -> bool:
        """Let the leg lead to the place after its goal; False where there is none."""
        leg = self._top.leg
        if leg.wanted is None or not leg.rest:
            return False
        leg.wanted = replace(leg.wanted, goal_m=leg.rest.pop(0))
        return True

    @property
    def _top(self) -> Walk:
        """What is flown."""
        return self._below if self._detour is None else self._detour

    @property
    def _below(self) -> Walk:
        """What would be flown without a detour."""
        return self._main if self._errand is None else self._errand

    def _waiting_at(self, now_us: int) -> FloatArray:
        return self._below.motion(self._below.seconds(now_us)).position

    def _wanted(self, request_id: int, here: FloatArray, goal: FloatArray) -> PlanWanted:
        return PlanWanted(
            request_id=request_id,
            start_m=vector(here),
            goal_m=vector(goal),
            limits=self.mission.planner_limits(),
            radius=self.mission.planner_radius(),
            seed=self.seed,
            method=self.mission.method,
        )
