"""Flies the stored mission, item by item.

Each item goes through the phases CLIMB (only from the ground), TRAVEL, then TURN for turns, STAY, and SINK for a
landing; commands that are no places (speed, turn, jump, what to look at) are done at once, one a tick. The first place
of a vehicle that stands is reached by climbing to MIS_TAKEOFF_ALT first, if the mission has no takeoff.

A waypoint that does not say how long to stay is passed: where the next place is known, the way there is rounded off
within CUT of the radius in which it counts as reached (`corner`), and it counts once the vehicle itself has been within
that radius. One that was missed, since wind or a weak motor kept the vehicle away, is flown back to and stopped at. Any
other leg ends at rest.

A mission that is left (Hold, or anything else) goes on at the item where it was, and one that is finished begins anew.
"""

import math
from enum import Enum

import numpy as np

from fakevehicle.corner import Corner
from fakevehicle.course import Course
from fakevehicle.modes import Event
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.places import Places
from fakevehicle.plans import COMMANDS, Kind, PlanItem, PlanStore
from fakevehicle.vocabulary import FloatArray, Glance, Setpoint
from fakevehicle.waypoints import PLACES, STOPS, aim_of, cruise_after, index_after, stay_s, target_of, turn_radius
from wire.dialect import mavlink

_m = mavlink
PARAMETERS: tuple[Parameter, ...] = (
    Parameter("NAV_ACC_RAD", 1.0, 0.1, 50.0, "m", "How near a waypoint counts as reached, if it does not say"),
)
CLIMBED = 0.5
"""How near a takeoff's top counts as reached [m]."""
CLIMB_PATIENCE_S = 3.0
"""A climb that ends this long after its time, wherever it got to."""
CUT = 0.6
"""Share of a waypoint's radius that the way may cut off; the rest is for the vehicle, which follows it."""
LEAST_RADIUS = 0.3
"""A waypoint that has to be reached nearer than this [m] is stopped at."""
MISSED_US = 1_000_000
"""How long after its corner a waypoint may still be reached [us]."""
FAR_AHEAD = 32
"""Items looked at for the next place."""
LONGEST_TURN_LEG = 1.0
"""A leg shorter than this over ground [m] does not turn the nose."""
_WITHOUT_YAW = (_m.MAV_CMD_NAV_LOITER_TURNS, _m.MAV_CMD_CONDITION_GATE)
"""Places whose fourth parameter is no heading."""


class MissionState(Enum):
    """MISSION_STATE."""

    NONE = 1
    NOT_STARTED = 2
    ACTIVE = 3
    PAUSED = 4
    COMPLETE = 5


class _Phase(Enum):
    START = 0
    CLIMB = 1
    TRAVEL = 2
    STAY = 3
    SINK = 4
    TURN = 5


class MissionRunner:
    """Progress through the mission.

    Attributes
    ----------
    looks_at : (3,) what the mission wants looked at [m].
    notes : texts for people since somebody last emptied the list.
    current : index of the item that is flown or comes next; as many as there are items when it is complete.
    reached : the newest item that was reached, None before the first; `reached_count` counts them.
    """

    def __init__(self, store: PlanStore, parameters: ParameterSet, places: Places, course: Course) -> None:
        self._store = store
        self._parameters = parameters
        self._places = places
        self._course = course
        self._plan = store.mission
        self._index = 0
        self._active = self._started = False
        self._interrupted = False  # on the way, somebody has named another item
        self._phase = _Phase.START
        self._stay_until_us = 0
        self._jumps: dict[int, int] = {}
        self._place_n: FloatArray = np.zeros(3)  # of the item that is flown, or was last
        self._corner: Corner | None = None  # by which it is passed
        self._passing = False  # the item before was passed: its corner leads to this one
        self._missed = -1  # the item that was to be passed and was not reached
        self.looks_at: FloatArray | None = None
        self._lacking: set[str] = set()  # what people have been told of
        self.notes: list[str] = []
        self.reached: int | None = None
        self.reached_count = 0

    @property
    def current(self) -> int:
        """The item that is flown or comes next; the last one when all are done."""
        self._refresh()
        return min(self._index, max(len(self._store.mission) - 1, 0))

    @property
    def state(self) -> MissionState:
        """As MISSION_CURRENT tells it."""
        self._refresh()
        if not self._store.mission:
            return MissionState.NONE
        if self._index >= len(self._store.mission):
            return MissionState.COMPLETE
        if not self._started:
            return MissionState.NOT_STARTED
        return MissionState.ACTIVE if self._active else MissionState.PAUSED

    @property
    def sinking(self) -> bool:
        """Whether it is in the last part of a landing."""
        return self._active and self._phase is _Phase.SINK

    @property
    def climbing(self) -> bool:
        """Whether it takes off."""
        return self._active and self._phase is _Phase.CLIMB

    def begin(self) -> None:
        """MISSION mode is entered: go on where it was left, or anew when it was complete."""
        self._refresh()
        if self._index >= len(self._store.mission):
            self.set_current(0)
        self._active = True
        self._interrupted = self._passing = False
        self._phase, self._stay_until_us, self._corner = _Phase.START, 0, None
        self._course.look_at(self.looks_at)

    def leave(self) -> None:
        """Another mode is entered."""
        self._active = False

    def set_current(self, index: int) -> None:
        """Go on with another item; jumps count anew."""
        self._index = index
        self._phase, self._stay_until_us, self._corner = _Phase.START, 0, None
        self._passing, self._missed = False, -1
        self._jumps.clear()
        self._interrupted = self._active

    def step(self, now_us: int, glance: Glance, airborne: bool, home_n: FloatArray) -> Setpoint | Event | None:
        """One tick in MISSION mode, armed.

        Returns
        -------
        Where to fly; None to stand with idling motors; or what the mission wants to become.
        """
        self._refresh()
        if self._interrupted:
            self._interrupted = False
            self._course.stop(glance, airborne)
        items = self._store.mission
        if self._index >= len(items):
            return Event.MISSION_DONE if airborne else None
        self._started = True
        item = items[self._index]
        match item.command:
            case _m.MAV_CMD_NAV_RETURN_TO_LAUNCH:
                self._done()
                return Event.MISSION_RTL if airborne else None
            case _m.MAV_CMD_DO_JUMP:
                self._jump(item)
            case _m.MAV_CMD_DO_CHANGE_SPEED:
                self._course.cruise = cruise_after(item, self._course.cruise)
                self._done()
            case _m.MAV_CMD_DO_SET_ROI | _m.MAV_CMD_DO_SET_ROI_LOCATION | _m.MAV_CMD_DO_SET_ROI_NONE:
                self._look_at(item, home_n)
            case _m.MAV_CMD_CONDITION_YAW:
                self._turn(now_us, item)
            case _m.MAV_CMD_NAV_DELAY | _m.MAV_CMD_CONDITION_DELAY:
                self._stay(now_us, max(item.params[0], 0.0))
            case _ if item.command not in PLACES:
                self._pass_over(item)
            case _:
                return self._go(now_us, item, glance, airborne, home_n)
        return self._course.setpoint(now_us) if airborne else None

    def _go(
        self, now_us: int, item: PlanItem, glance: Glance, airborne: bool, home_n: FloatArray
    ) -> Setpoint | Event | None:
        """An item with a place: climb, travel, turn, stay, sink."""
        course, landing = self._course, item.command == _m.MAV_CMD_NAV_LAND
        if self._phase is _Phase.SINK:
            if airborne:
                return course.descend(now_us, glance, float(home_n[2]))
            self._done()
            return None
        if self._phase is _Phase.START and not self._set_out(now_us, item, airborne, home_n):
            return course.setpoint(now_us) if airborne else None
        if self._corner is not None:
            self._pass(now_us, item, glance, self._corner)
            return course.setpoint(now_us)
        late_s = course.late_s(now_us)
        away = math.dist((glance.x, glance.y, glance.z), course.anchor_n) if late_s >= 0.0 else math.inf
        if self._phase is _Phase.CLIMB and airborne and late_s >= 0.0 and (away < CLIMBED or late_s > CLIMB_PATIENCE_S):
            self._travel(now_us, item, home_n)
        elif self._phase is _Phase.TRAVEL and late_s >= 0.0 and away < self._radius(item):
            self._phase = _Phase.SINK if landing else _Phase.STAY
            self._stay_until_us = 0
            if item.command == _m.MAV_CMD_NAV_LOITER_TURNS:
                self._turn_about(now_us, item, home_n)
        elif self._phase is _Phase.TURN and late_s >= 0.0:
            course.look_at(self.looks_at)
            self._done()
        if self._phase is _Phase.STAY:
            self._stay(now_us, stay_s(item))
        return course.setpoint(now_us)

    def _pass(self, now_us: int, item: PlanItem, glance: Glance, corner: Corner) -> None:
        """Once the corner is behind, the item is done; if the vehicle was not near enough, fly back to it."""
        if now_us < corner.middle_us:
            return
        if math.dist((glance.x, glance.y, glance.z), self._place_n) < self._radius(item):
            self._done()
            self._passing = True
        elif now_us > corner.end_us + MISSED_US:
            self._missed = self._index
            self._phase, self._corner = _Phase.START, None
            self._course.stop(glance, moving=True)

    def _set_out(self, now_us: int, item: PlanItem, airborne: bool, home_n: FloatArray) -> bool:
        """Begin an item; False when there is nothing to fly for it."""
        course = self._course
        if airborne:
            self._travel(now_us, item, home_n)
            return True
        if item.command == _m.MAV_CMD_NAV_LAND:
            self._done()  # it stands already
            return False
        top_n = course.anchor_n.copy()
        top_n[2] = float(home_n[2]) - self._parameters["MIS_TAKEOFF_ALT"]
        if item.command == _m.MAV_CMD_NAV_TAKEOFF:
            target_n = target_of(item, self._places, float(home_n[2]), top_n)
            top_n[2] = top_n[2] if target_n is None else target_n[2]
        top_n[2] = min(top_n[2], course.anchor_n[2] - CLIMBED)
        course.leg_to(now_us, top_n, float(self._parameters["MPC_TKO_SPEED"]))
        self._phase = _Phase.CLIMB
        return True

    def _travel(self, now_us: int, item: PlanItem, home_n: FloatArray) -> None:
        course = self._course
        came_n = self._place_n if self._passing else course.anchor_n
        aim_n = aim_of(item, self._places, float(home_n[2]), came_n)
        if self._passing and not np.array_equal(aim_n, course.anchor_n) and course.late_s(now_us) < 0.0:
            return  # the plan has changed meanwhile: first come to rest where the way leads
        if not self._passing or not np.array_equal(aim_n, course.anchor_n):
            course.leg_to(now_us, aim_n)
        self._passing = False
        north, east = (aim_n - came_n)[:2].tolist()
        if item.command not in _WITHOUT_YAW and math.isfinite(item.params[3]):
            course.turn_to(now_us, math.radians(item.params[3]))
        elif math.hypot(north, east) > LONGEST_TURN_LEG:
            course.turn_to(now_us, math.atan2(east, north))
        self._place_n, self._phase = aim_n, _Phase.TRAVEL
        following = self._following() if self._passes(item) else None
        if following is not None:
            ahead, cruise = following
            self._corner = course.round_to(
                now_us, aim_of(ahead, self._places, float(home_n[2]), aim_n), cruise, CUT * self._radius(item)
            )

    def _passes(self, item: PlanItem) -> bool:
        """Whether an item's place is passed without a stop."""
        passed = item.command in (_m.MAV_CMD_NAV_WAYPOINT, _m.MAV_CMD_CONDITION_GATE) and stay_s(item) == 0.0
        return passed and self._index != self._missed and self._radius(item) >= LEAST_RADIUS

    def _following(self) -> tuple[PlanItem, float | None] | None:
        """The next item with a place and the cruise speed there; None when something is done at rest before it."""
        items, index, cruise, jumped = self._store.mission, self._index + 1, self._course.cruise, dict(self._jumps)
        for _ in range(FAR_AHEAD):
            if index >= len(items) or items[index].command in STOPS:
                return None
            item = items[index]
            if item.command in PLACES:
                return item, cruise
            cruise = cruise_after(item, cruise)
            index = index_after(item, index, jumped)
        return None

    def _turn_about(self, now_us: int, item: PlanItem, home_n: FloatArray) -> None:
        """Begin the turns, the nose to their centre unless there is something else to look at."""
        centre_n = target_of(item, self._places, float(home_n[2]), self._place_n)
        turns = item.params[0] if item.params[0] > 0.0 else 0.0
        if centre_n is None or turns == 0.0:
            return
        if not item.has_place:
            centre_n = self._place_n - (turn_radius(item), 0.0, 0.0)
        self._course.turn_about(now_us, centre_n, turns, not item.params[2] < 0.0)
        if self.looks_at is None:
            self._course.look_at(centre_n)
        self._phase = _Phase.TURN

    def _look_at(self, item: PlanItem, home_n: FloatArray) -> None:
        """Point the nose at a place from now on, or no longer."""
        nothing = item.command == _m.MAV_CMD_DO_SET_ROI_NONE or (
            item.command == _m.MAV_CMD_DO_SET_ROI and item.params[0] == _m.MAV_ROI_NONE
        )
        self.looks_at = None if nothing else target_of(item, self._places, float(home_n[2]), home_n)
        self._course.look_at(self.looks_at)
        self._done()

    def _pass_over(self, item: PlanItem) -> None:
        """What this vehicle has no device for; told once a mission and device."""
        what = COMMANDS[Kind.MISSION][item.command].lacking
        if what is not None and what not in self._lacking:
            self._lacking.add(what)
            self.notes.append(f"Mission items for a {what} are passed over: there is none")
        self._done()

    def _radius(self, item: PlanItem) -> float:
        asked = item.params[1] if item.command == _m.MAV_CMD_NAV_WAYPOINT else math.nan
        return asked if asked > 0.0 else float(self._parameters["NAV_ACC_RAD"])

    def _stay(self, now_us: int, seconds: float) -> None:
        """Wait here, then the item is done."""
        if math.isinf(seconds):
            return
        if self._stay_until_us == 0:
            self._stay_until_us = now_us + round(seconds * 1e6)
        if now_us >= self._stay_until_us:
            self._done()

    def _turn(self, now_us: int, item: PlanItem) -> None:
        degrees, relative = item.params[0], item.params[3] == 1.0
        if math.isfinite(degrees):
            sign = -1.0 if relative and item.params[2] < 0.0 else 1.0
            base = self._course.yaw(now_us) if relative else 0.0
            self._course.turn_to(now_us, base + sign * math.radians(degrees))
        self._done()

    def _jump(self, item: PlanItem) -> None:
        """Back, as often as it says (-1: always); then on."""
        self._note_reached()
        self._index = index_after(item, self._index, self._jumps)
        self._phase, self._stay_until_us = _Phase.START, 0

    def _done(self) -> None:
        self._note_reached()
        self._index += 1
        self._phase, self._stay_until_us, self._corner = _Phase.START, 0, None

    def _note_reached(self) -> None:
        self.reached = self._index
        self.reached_count += 1

    def _refresh(self) -> None:
        """Begin with the first item of a mission that has just been loaded."""
        if self._store.mission is not self._plan:
            self._plan = self._store.mission
            self.set_current(0)
            self._started, self.reached = False, None
            self.looks_at = None
            self._lacking.clear()
            if self._active:
                self._course.look_at(None)
