"""How far a flight is in a ground station's plan, as ground stations are told.

In flight MISSION_CURRENT once a second and whenever it changes, MISSION_ITEM_REACHED once for each item, in their order
(https://mavlink.io/en/services/mission.html#monitoring-mission-progress). An item that is done on the spot, such as a
change of speed, is reached with the one before it; points that are passed with the place that they lead to.

Ground stations look at the vehicle's system rather than its component: what we tell they may take for the autopilot's
own mission. So nothing is told of a flight that flies no plan of theirs, and between flights changes only.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from companion.phases import OVER, Phase
from companion.planfiles.items import GroundPlan
from wire.dialect import mavlink

_m = mavlink
EVERY_US = 1_000_000
NONE = 65_535
"""A total that says there is no plan."""
IN_MISSION, SUSPENDED = 1, 2
"""mission_mode: the plan is what is flown, or something else is."""
MOST_AT_ONCE = 10
"""Items told of as reached in one tick."""
BEFORE = frozenset({Phase.CONNECTING, Phase.PREPARING, Phase.PLANNING, Phase.ENGAGING, Phase.ARMING})
"""Phases in which nothing of the plan is flown yet."""


@dataclass(frozen=True, slots=True)
class Course:
    """Where a flight is."""

    phase: Phase
    step: int  # of the mission's, counted from 0
    held: bool = False  # somebody or something keeps the mission from going on
    whole: bool = True  # no order cut it short
    skipped: tuple[int, int] = (0, 0)  # how often a step was gone on with by order, and which last


class Progress:
    """What is told.

    Parameters
    ----------
    plan : that is flown; None: none is.
    course : where the flight is; None: there is none.

    Attributes
    ----------
    complete : the plan was flown to its end.
    """

    def __init__(self, plan: GroundPlan | None = None, course: Callable[[], Course] | None = None) -> None:
        self.complete = False
        self._plan = GroundPlan() if plan is None else plan
        self._course = course if self._plan.items else None
        self._reached, self._skipped = self._plan.first, (0, 0)
        self._told: tuple[int, int, int, int] = (0, NONE, _m.MISSION_STATE_NO_MISSION, 0)
        self._due_us = 0
        self._ends = (self._plan.first, len(self._plan.items) - 1)

    def step(self, now_us: int, first: int, count: int) -> list[Any]:
        """Once a tick: what is to be told to everybody.

        Parameters
        ----------
        first, count : of the items that are kept, home left out: the number of the first, and how many there are.
        """
        found: list[Any] = []
        if self._course is None:
            self._ends = (first, first + count - 1)
            now = self._waiting(first, count)
        else:
            course = self._course()
            found += self._done(course)
            now = self._flown(course)
        if now != self._told or (self._course is not None and now_us >= self._due_us):
            self._told, self._due_us = now, now_us + EVERY_US
            found.append(self.message())
        return found

    def message(self) -> Any:
        """MISSION_CURRENT as it was told last."""
        return _m.MAVLink_mission_current_message(*self._told)

    @property
    def first(self) -> int:
        """Number of the plan's first item."""
        return self._ends[0]

    @property
    def last(self) -> int:
        """Number of the plan's last item."""
        return self._ends[1]

    def step_of(self, item: int) -> int | str:
        """The step that an item begins with, or why it cannot be gone on with."""
        if self._course is None:
            return "no plan of a ground station is flown"
        return self._plan.step_of(item)

    def _done(self, course: Course) -> list[Any]:
        """The items that were reached since the last tick."""
        if course.phase in BEFORE:
            return []
        self.complete = course.phase is Phase.DONE and course.whole
        if course.skipped != self._skipped:  # what was left out is not reached, what is flown again is reached again
            self._skipped, self._reached = course.skipped, self._plan.current(course.skipped[1])
        most = len(self._plan.items)
        upto = most if self.complete else min(self._plan.current(course.step), self._reached + MOST_AT_ONCE)
        reached, self._reached = self._reached, max(self._reached, upto)
        return [_m.MAVLink_mission_item_reached_message(k) for k in range(reached, self._reached)]

    def _waiting(self, first: int, count: int) -> tuple[int, int, int, int]:
        """seq, total, mission_state and mission_mode between flights."""
        if not count:
            return 0, NONE, _m.MISSION_STATE_NO_MISSION, 0
        state = _m.MISSION_STATE_COMPLETE if self.complete else _m.MISSION_STATE_NOT_STARTED
        return first + (count - 1) * self.complete, count, state, 0

    def _flown(self, course: Course) -> tuple[int, int, int, int]:
        """The same in flight."""
        first, last = self._plan.first, len(self._plan.items) - 1
        total = last + 1 - first
        if course.phase in BEFORE:
            return first, total, _m.MISSION_STATE_NOT_STARTED, 0
        if self.complete:
            return last, total, _m.MISSION_STATE_COMPLETE, 0
        left = course.phase in OVER or course.phase is Phase.HANDED_OVER
        paused = left or course.held or not course.whole
        state = _m.MISSION_STATE_PAUSED if paused else _m.MISSION_STATE_ACTIVE
        return min(self._plan.current(course.step), last), total, state, SUSPENDED if left else IN_MISSION
