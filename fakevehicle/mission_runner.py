"""Flies the stored mission, item by item.

Each item goes through the phases CLIMB (only from the ground), TRAVEL, STAY and, for a landing, SINK; commands that are
no places (speed, turn, jump) are done at once, one a tick. Every leg ends at rest: PX4 would round the corners. The
first place of a vehicle that stands is reached by climbing to MIS_TAKEOFF_ALT first, if the mission has no takeoff.

A mission that is left (Hold, or anything else) goes on at the item where it was, and one that is finished begins anew.
"""

import math
from enum import Enum

from fakevehicle.course import Course
from fakevehicle.modes import Event
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.places import Places
from fakevehicle.plans import RELATIVE_FRAMES, PlanItem, PlanStore
from fakevehicle.vocabulary import FloatArray, Geodetic, Glance, Setpoint
from wire.dialect import mavlink

_m = mavlink
PARAMETERS: tuple[Parameter, ...] = (
    Parameter("NAV_ACC_RAD", 1.0, 0.1, 50.0, "m", "How near a waypoint counts as reached, if it does not say"),
)
CLIMBED = 0.5
"""How near a takeoff's top counts as reached [m]."""
CLIMB_PATIENCE_S = 3.0
"""A climb that ends this long after its time, wherever it got to."""
LONGEST_TURN_LEG = 1.0
"""A leg shorter than this over ground [m] does not turn the nose."""


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


def target_of(item: PlanItem, places: Places, home_z: float, here_n: FloatArray) -> FloatArray | None:
    """The point an item names, (3,) local NED [m]; what it leaves open stays as it is in `here_n`.

    None before the first fix, which gives local coordinates their meaning.
    """
    origin = places.origin
    if origin is None:
        return None
    target_n = here_n.copy()
    latitude, longitude, altitude = item.params[4:]
    if item.has_place:
        place = places.local(Geodetic(math.radians(latitude), math.radians(longitude), origin.altitude))
        if place is None:
            return None
        target_n[:2] = place[:2]
    if not math.isnan(altitude):
        target_n[2] = (home_z if item.frame in RELATIVE_FRAMES else origin.altitude) - altitude
    return target_n


class MissionRunner:
    """Progress through the mission.

    Attributes
    ----------
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
        self._interrupted = False
        self._phase, self._stay_until_us = _Phase.START, 0

    def leave(self) -> None:
        """Another mode is entered."""
        self._active = False

    def set_current(self, index: int) -> None:
        """Go on with another item; jumps count anew."""
        self._index = index
        self._phase, self._stay_until_us = _Phase.START, 0
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
                if item.params[0] in (0.0, 1.0) and item.params[1] > 0.0:
                    self._course.cruise = item.params[1]
                self._done()
            case _m.MAV_CMD_CONDITION_YAW:
                self._turn(now_us, item)
            case _m.MAV_CMD_NAV_DELAY | _m.MAV_CMD_CONDITION_DELAY:
                self._stay(now_us, max(item.params[0], 0.0))
            case _:
                return self._go(now_us, item, glance, airborne, home_n)
        return self._course.setpoint(now_us) if airborne else None

    def _go(
        self, now_us: int, item: PlanItem, glance: Glance, airborne: bool, home_n: FloatArray
    ) -> Setpoint | Event | None:
        """An item with a place: climb, travel, stay, sink."""
        course, landing = self._course, item.command == _m.MAV_CMD_NAV_LAND
        if self._phase is _Phase.SINK:
            if airborne:
                return course.descend(now_us, glance, float(home_n[2]))
            self._done()
            return None
        if self._phase is _Phase.START and not self._set_out(now_us, item, airborne, home_n):
            return course.setpoint(now_us) if airborne else None
        late_s = course.late_s(now_us)
        away = math.dist((glance.x, glance.y, glance.z), course.anchor_n) if late_s >= 0.0 else math.inf
        if self._phase is _Phase.CLIMB and airborne and late_s >= 0.0 and (away < CLIMBED or late_s > CLIMB_PATIENCE_S):
            self._travel(now_us, item, home_n)
        elif self._phase is _Phase.TRAVEL and late_s >= 0.0 and away < self._radius(item):
            self._phase = _Phase.SINK if landing else _Phase.STAY
            self._stay_until_us = 0
        if self._phase is _Phase.STAY:
            self._stay(now_us, _stay_s(item))
        return course.setpoint(now_us)

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
        start_n = course.anchor_n
        target_n = target_of(item, self._places, float(home_n[2]), start_n)
        if target_n is None:
            target_n = start_n
        if item.command == _m.MAV_CMD_NAV_LAND:
            target_n[2] = start_n[2]  # over the place first; its altitude is the ground's
        course.leg_to(now_us, target_n)
        north, east = (target_n - start_n)[:2].tolist()
        if math.isfinite(item.params[3]):
            course.turn_to(now_us, math.radians(item.params[3]))
        elif math.hypot(north, east) > LONGEST_TURN_LEG:
            course.turn_to(now_us, math.atan2(east, north))
        self._phase = _Phase.TRAVEL

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
        here, times = self._index, item.params[1]
        done = self._jumps.get(here, 0)
        if times < 0.0 or done < times:
            self._jumps[here] = done + 1
            self._note_reached()
            self._index, self._phase, self._stay_until_us = int(item.params[0]), _Phase.START, 0
        else:
            self._done()

    def _done(self) -> None:
        self._note_reached()
        self._index += 1
        self._phase, self._stay_until_us = _Phase.START, 0

    def _note_reached(self) -> None:
        self.reached = self._index
        self.reached_count += 1

    def _refresh(self) -> None:
        """Begin with the first item of a mission that has just been loaded."""
        if self._store.mission is not self._plan:
            self._plan = self._store.mission
            self.set_current(0)
            self._started, self.reached = False, None


def _stay_s(item: PlanItem) -> float:
    """How long an item stays at its place [s]."""
    if item.command == _m.MAV_CMD_NAV_LOITER_UNLIM:
        return math.inf
    timed = item.command in (_m.MAV_CMD_NAV_WAYPOINT, _m.MAV_CMD_NAV_LOITER_TIME)
    return item.params[0] if timed and item.params[0] > 0.0 else 0.0
