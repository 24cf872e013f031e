"""Can the mission that is loaded be flown from this home? Looked at as a whole, before it begins and while it is flown.

Every place of it has to be where the fence, if it holds anybody, lets the vehicle be, and within `FARTHEST_PLACE` of
home, and the first one after the takeoff within MIS_DIST_1WP: a plan made for another field is the usual reason for one
that is not.
"""

import math

from fakevehicle.fence import FenceMonitor
from fakevehicle.modes import Refusal
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.places import Places
from fakevehicle.plans import PlanStore
from fakevehicle.vocabulary import FloatArray
from fakevehicle.waypoints import extent_of
from wire.dialect import mavlink

PARAMETERS: tuple[Parameter, ...] = (
    Parameter("MIS_DIST_1WP", 10_000.0, 0.0, 100_000.0, "m", "Farthest first place of a mission from home; 0: any"),
)
FARTHEST_PLACE = 100_000.0
"""Of any place of a mission from home [m]; the local frame is flat."""
LIMITS = ("GF_MAX_HOR_DIST", "GF_MAX_VER_DIST", "MIS_DIST_1WP")


class MissionCheck:
    """Judges the loaded mission; worked out once for what is loaded, since a look a tick must cost nothing."""

    def __init__(self, store: PlanStore, parameters: ParameterSet, places: Places, fence: FenceMonitor) -> None:
        self._store = store
        self._parameters = parameters
        self._places = places
        self._fence = fence
        self._key: tuple[float, ...] = ()
        self._refusal: Refusal | None = None

    def refusal(self, home_n: FloatArray) -> Refusal | None:
        """Why the mission cannot be flown, None when it can.

        `home_n`, (3,) local NED [m], is what heights and distances count from, and what an item leaves open.
        """
        p, fence = self._parameters, self._fence
        key = (self._store.version, fence.holding, *(p[name] for name in LIMITS), *home_n.tolist())
        if key != self._key:
            self._key, self._refusal = key, self._judged(home_n)
        return self._refusal

    def _judged(self, home_n: FloatArray) -> Refusal | None:
        first = float(self._parameters["MIS_DIST_1WP"]) or math.inf
        limit = min(first, FARTHEST_PLACE)
        for item in self._store.mission:
            points = extent_of(item, self._places, home_n)
            if any(math.dist(point[:2], home_n[:2]) > limit for point in points):
                return Refusal.MISSION_TOO_FAR
            if self._fence.holding and any(self._fence.breach_at(point, home_n) is not None for point in points):
                return Refusal.OUTSIDE_FENCE
            if item.has_place and item.command != mavlink.MAV_CMD_NAV_TAKEOFF and points:
                limit = FARTHEST_PLACE
        return None
