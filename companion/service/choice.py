"""What is flown next: the files' mission or a ground station's plan, as it is at the moment when a start is asked."""

import time
from collections.abc import Callable

from companion.config import ServiceConfig
from companion.geodesy import Geodetic
from companion.ground.station import GroundStation, plan_file
from companion.seam import Level
from companion.service.idle import Idle
from companion.service.queue import Missions, Ready
from companion.service.telling import Telling

LOOK_S = 2.0
"""How often the files are looked at again while nothing is flown."""


class Choice:
    """Keeps `Missions` at what files and ground stations say now, and tells the idle companion of it.

    Attributes
    ----------
    missions : what comes next.
    """

    def __init__(self, config: ServiceConfig, idle: Idle, telling: Telling) -> None:
        number = 0 if config.fleet is None else config.fleet.number
        self.missions = Missions(config.mission, config.missions_dir, number)
        self._autostart = config.autostart
        self._held_back = False
        self._one_by_one = config.missions_dir is not None
        self._idle, self._telling = idle, telling
        self._uploads = 0  # plans of ground stations taken so far
        self._plan = False  # a plan waits for the vehicle's place
        self._look_s = 0.0
        idle.look = lambda: self.look(anew=True)

    @property
    def ready(self) -> Ready | None:
        """The next mission, if there is one."""
        return self.missions.ready

    def look(self, anew: bool = False) -> None:
        """Read again what comes next, and tell of a file that has become none."""
        before = self.missions.why_not
        self._take_upload()
        if not self._plan:
            self.missions.look(anew)
            self._heed_fence()
        self._look_s = time.monotonic() + LOOK_S
        if self.missions.why_not not in (before, ""):
            self._telling.say(Level.WARNING, self.missions.why_not)
        ready = self.missions.ready
        self._idle.mission = "" if ready is None else ready.mission.name
        self._idle.why_not = self.missions.why_not
        self._idle.autostart = self._autostart and ready is not None and self._may_go_on(ready)

    def stale(self) -> Callable[[], bool]:
        """Tells when it is time to look again."""
        missions = self._idle.station.missions
        return lambda: (
            missions.uploads != self._uploads
            or (self._plan and self._place() is not None)
            or time.monotonic() > self._look_s
        )

    def called_off(self) -> None:
        """A flight was called off before it began: whoever did so also says when the next begins."""
        self._held_back = True

    def flown(self, station: GroundStation | None) -> None:
        """A flight is over; `station` answered in it, and may have been given a plan."""
        self.missions.done()
        self._held_back = False
        if station is not None:
            self._idle.station.after(station)

    def _take_upload(self) -> None:
        """A plan that a ground station has put here, as soon as it is known where the vehicle stands."""
        missions = self._idle.station.missions
        if missions.uploads != self._uploads:
            self._uploads, self._plan = missions.uploads, bool(missions.items)
            self.missions.upload(None)
            count, fence = len(missions.items), len(missions.fence)
            text = f"a plan of {count} items was uploaded" if count else "the plan was cleared"
            self._telling.say(Level.INFO, text + (f", with a fence of {fence} items" if fence else ""))
        place = self._place()
        self._idle.place_wanted = self._plan
        if not self._plan:
            return
        if place is None:
            self.missions.ready, self.missions.why_not = None, "where the vehicle stands is not known yet"
            return
        self.missions.upload(plan_file(self._idle.station.missions, place))
        self._plan = False

    def _heed_fence(self) -> None:
        """A fence that a ground station keeps here is none of a mission file's: nothing is flown past it."""
        ready = self.missions.ready
        if ready is not None and ready.file != Missions.UPLOADED and self._idle.station.missions.fence:
            self.missions.ready = None
            self.missions.why_not = f"a fence was uploaded, {ready.file} was not: upload a mission, or clear the fence"

    def _place(self) -> Geodetic | None:
        """Where on the earth the vehicle stands."""
        place = self._idle.telemetry.global_e7
        return None if place is None else Geodetic(place[0] * 1e-7, place[1] * 1e-7, place[2] * 1e-3)

    def _may_go_on(self, ready: Ready) -> bool:
        """Whether it may begin by itself: a file is flown once so; nothing uploaded, nor after a failure."""
        last = self._telling.last_flight
        if ready.file == Missions.UPLOADED or self._held_back:
            return False
        return last is None or (last["ok"] and self._one_by_one)
