"""Where each automatic mode flies: takeoff, landing, return, mission and holding, all along one `Course`."""

import math

import numpy as np

from fakevehicle.course import Course
from fakevehicle.guidance import return_height
from fakevehicle.mission_runner import MissionRunner
from fakevehicle.modes import Event, Mode
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.places import Places
from fakevehicle.plans import PlanStore
from fakevehicle.vocabulary import FloatArray, Glance, Setpoint
from fakevehicle.waypoints import rim_of, target_of

ARRIVED = 0.3
"""Height error [m] within which a takeoff is done."""
RETURN_ARRIVED = 2.0
"""Distance [m] from the end of a return's leg at which the next one begins."""
TAKEOFF_PATIENCE_S = 3.0
"""A takeoff that ends this long after its leg, wherever it got to [s]."""

PARAMETERS: tuple[Parameter, ...] = (
    Parameter("MIS_TAKEOFF_ALT", 2.5, 0.5, 100.0, "m", "Height of a takeoff for which no altitude is given"),
    Parameter("RTL_RETURN_ALT", 30.0, 0.0, 150.0, "m", "Highest height above home of a return"),
)


class Navigator:
    """Flies the modes that need no setpoints from outside.

    Attributes
    ----------
    course : the way that is flown.
    runner : the mission's progress.
    takeoff_z : the down coordinate that TAKEOFF climbs to [m]; None: MIS_TAKEOFF_ALT above the ground.
    """

    def __init__(self, store: PlanStore, parameters: ParameterSet, places: Places) -> None:
        self._store = store
        self._parameters = parameters
        self._places = places
        self.course = Course(parameters)
        self.runner = MissionRunner(store, parameters, places, self.course)
        self._mode: Mode | None = None
        self.takeoff_z: float | None = None
        self._climbing = False  # a takeoff's leg is flown
        self._descending = False  # a return has arrived over its end
        self._returning_to: FloatArray | None = None

    @property
    def descending(self) -> bool:
        """Whether a return or a mission is on its way to the ground."""
        return self._descending or self.runner.sinking

    @property
    def climbing(self) -> bool:
        """Whether a takeoff is under way."""
        return self._climbing or self.runner.climbing

    def begin(self, mode: Mode, glance: Glance | None, airborne: bool) -> None:
        """Enter a mode: brake to a stop from here, unless the mode says otherwise."""
        if mode is not self._mode:
            self.takeoff_z = None
        self._mode, self._climbing, self._descending, self._returning_to = mode, False, False, None
        self.runner.leave()
        self.course.cruise = None
        self.course.look_at(None)
        if glance is not None:
            self.course.stop(glance, airborne)
        if mode is Mode.MISSION:
            self.runner.begin()

    def take_off(self, now_us: int, z: float | None, home_n: FloatArray | None) -> None:
        """Climb to a down coordinate [m], or to MIS_TAKEOFF_ALT above the ground when it is None."""
        course = self.course
        if z is None:
            ground = float(course.anchor_n[2]) if home_n is None else float(home_n[2])
            z = ground - self._parameters["MIS_TAKEOFF_ALT"]
        top_n = course.anchor_n.copy()
        top_n[2] = min(z, float(top_n[2]))
        course.leg_to(now_us, top_n, float(self._parameters["MPC_TKO_SPEED"]))
        self._climbing = True

    def go_to(self, now_us: int, position_n: FloatArray, yaw: float, speed: float | None) -> None:
        """Fly to a point, (3,) [m], and stay; yaw [rad] or NaN for the present one; speed [m/s] or None."""
        self._climbing = False
        self.course.cruise = speed
        self.course.leg_to(now_us, position_n)
        if not math.isnan(yaw):
            self.course.turn_to(now_us, yaw)

    def orbit(
        self, now_us: int, centre_n: FloatArray, radius: float, speed: float | None, turns: float, *, facing: bool
    ) -> None:
        """Fly to a circle about a point, (3,) [m], and round it: clockwise, or with `radius` below zero the other way.

        `facing` points the nose to the centre.
        """
        self._climbing = False
        course = self.course
        course.cruise = speed
        course.leg_to(now_us, rim_of(centre_n, abs(radius), course.anchor_n))
        course.turn_about(now_us, centre_n, turns, radius > 0.0)
        if facing:
            course.look_at(centre_n)

    def look_at(self, place_n: FloatArray | None) -> None:
        """Point the nose at a place, (3,) [m], or no longer; a mission that is left and goes on remembers it."""
        self.course.look_at(place_n)
        if self._mode is Mode.MISSION:
            self.runner.looks_at = place_n

    def setpoint(
        self, mode: Mode, now_us: int, glance: Glance, airborne: bool, flown: bool, home_n: FloatArray
    ) -> Setpoint | Event | None:
        """Where to be now; None to idle on the ground; or what happened.

        Parameters
        ----------
        mode : what is flown, OFFBOARD excepted.
        flown : whether it has been in the air since it was armed.
        home_n : (3,) [m].
        """
        if mode is Mode.TAKEOFF and not self._climbing and (airborne or not flown):
            self.take_off(now_us, self.takeoff_z, home_n)
        if self._climbing:
            return self._climb(mode, now_us, glance, airborne, flown)
        if mode is Mode.MISSION:
            return self.runner.step(now_us, glance, airborne, home_n)
        if not airborne:
            return None
        if mode is Mode.LAND:
            return self.course.descend(now_us, glance, float(home_n[2]))
        if mode is Mode.RTL:
            return self._return(now_us, glance, home_n)
        return self.course.setpoint(now_us)

    def _climb(self, mode: Mode, now_us: int, glance: Glance, airborne: bool, flown: bool) -> Setpoint | Event | None:
        course = self.course
        if flown and not airborne:
            return None  # it came down again: wait to be disarmed
        late_s = course.late_s(now_us)
        if late_s >= 0.0 and airborne:
            arrived = abs(glance.z - float(course.anchor_n[2])) < ARRIVED
            if arrived or late_s > TAKEOFF_PATIENCE_S:
                self._climbing = False
                if not arrived:
                    course.stop(glance, moving=True)
                return Event.TAKEOFF_DONE
        return course.setpoint(now_us)

    def _return(self, now_us: int, glance: Glance, home_n: FloatArray) -> Setpoint:
        """Climb, fly to the nearest of home and the rally points, sink: each leg from the end of the one before."""
        course = self.course
        if self._descending:
            return course.descend(now_us, glance, float(home_n[2]))
        end_n = self._returning_to
        if end_n is None:
            end_n = self._returning_to = self._nearest_end(glance, home_n)
            distance = math.dist(end_n[:2], course.anchor_n[:2])
            height = return_height(
                float(home_n[2] - course.anchor_n[2]), distance, float(self._parameters["RTL_RETURN_ALT"])
            )
            course.leg_to(now_us, np.array([*course.anchor_n[:2], home_n[2] - height]))
        here = (glance.x, glance.y, glance.z)
        if course.late_s(now_us) >= 0.0 and math.dist(here, course.anchor_n) < RETURN_ARRIVED:
            over_end_n = np.array([end_n[0], end_n[1], course.anchor_n[2]])
            if math.dist(over_end_n, course.anchor_n) < 1e-6:
                self._descending = True
                return course.descend(now_us, glance, float(home_n[2]))
            course.leg_to(now_us, over_end_n)
        return course.setpoint(now_us)

    def _nearest_end(self, glance: Glance, home_n: FloatArray) -> FloatArray:
        ends = [home_n]
        for item in self._store.rally:
            point_n = target_of(item, self._places, float(home_n[2]), home_n)
            if point_n is not None:
                ends.append(point_n)
        return min(ends, key=lambda end_n: math.dist(end_n[:2], (glance.x, glance.y)))
