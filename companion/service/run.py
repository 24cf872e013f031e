"""`companion run`: the loop that goes from mission to mission.

    idle            the vehicle is heard or waited for, ground stations are served; a flight begins when it is asked for
                    (MISSION_START) or by itself (`autostart`)
    preparing       the workers that plan are started and their kernels compiled; idle goes on meanwhile
    flying          one `Companion`, recorded, until it is over; then idle again

It ends by a signal only. The first lands what flies and then ends; the second ends at once.
"""

import gc
import time
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import asdict
from datetime import UTC, datetime
from importlib import metadata
from typing import Any, Protocol

import numpy as np

from companion.config import ServiceConfig
from companion.core import Companion, CompanionConfig
from companion.drivers.planning import WorkerPlanning
from companion.drivers.realtime import Pace, fly_realtime
from companion.drivers.recording import RecordingTap, header
from companion.drivers.tick import Tap, Tick
from companion.errors import CompanionError
from companion.geodesy import Geodetic
from companion.ground.station import GroundStation, plan_file
from companion.phases import AIRBORNE
from companion.planfiles.items import Item
from companion.seam import Level, Note, Order, PlanReady, PlanWanted, ReplanReady, ReplanWanted
from companion.service.http import Board, served
from companion.service.idle import Idle
from companion.service.jsonlog import LEVELS, Log, LogTap
from companion.service.queue import Missions, Ready, make_room, recording_file
from companion.service.snapshot import VERDICT_KEYS, fleet_state, flight_state, idle_state, vehicle_state, verdict_state
from companion.vehiclelink import VEHICLE_LINK
from companion.verdict import FlightMeter, judge
from logs.errors import LogsError, RecordingError
from logs.recorder import Recorder
from wire.endpoint import Endpoint
from wire.udp import UdpLink

EVERY = 25
"""Ticks between two states put up."""
MOST_NOTES = 50
LOOK_S = 2.0
"""How often the files are looked at again while there is no mission."""


class Signals(Protocol):
    """Who asks the service to end: `companion.cli.operator.Operator`."""

    asked: int

    def __call__(self, now_us: int) -> Order | None: ...

    def stop(self) -> bool: ...


class _NothingPlanned:
    """Nobody plans between flights."""

    def submit(self, wanted: PlanWanted | ReplanWanted) -> None:
        pass

    def ready(self) -> list[PlanReady | ReplanReady]:
        return []

    def close(self) -> None:
        pass


class Service:
    """A companion that is left running.

    Parameters
    ----------
    config : what it is told.
    signals : who may ask it to end.
    log : where entries go.
    """

    def __init__(self, config: ServiceConfig, signals: Signals, log: Log) -> None:
        self._config, self._signals, self._log = config, signals, log
        self._endpoints = {VEHICLE_LINK: Endpoint.parse(config.master)} | config.endpoints()
        self._endpoints |= config.sensor_endpoints() | config.fleet_endpoints()
        self._fleet = config.fleet is not None
        number = 0 if config.fleet is None else config.fleet.number
        self._core = CompanionConfig(
            seed=config.seed,
            system_id=config.system_id,
            ground_links=tuple(config.endpoints()),
            sensor_links=tuple(config.sensor_endpoints()),
            speaks_first=self._endpoints[VEHICLE_LINK].kind == "udpout",
            fleet_number=number,
            fleet_calls=0 if config.fleet is None else len(config.fleet.others),
        )
        self._missions = Missions(config.mission, config.missions_dir, number)
        self._idle = Idle(self._core)
        self._board = Board()
        self._began_s = time.monotonic()
        self._notes: deque[dict[str, str]] = deque(maxlen=MOST_NOTES)
        self._last_flight: dict[str, Any] | None = None
        self._flights = 0
        self._state = "starting"
        self._links: Mapping[str, UdpLink] = {}
        self._uploads = 0  # plans of ground stations taken so far
        self._plan: list[Item] | None = None  # one that waits for the vehicle's place
        self._phase: Callable[[], str] = lambda: self._state
        self._version = _version()

    def run(self) -> int:
        """Run until a signal ends it; returns the exit code.

        Raises
        ------
        LinkError : a port is taken.
        """
        page = self._config.page()
        with ExitStack() as stack:
            opened = {name: stack.enter_context(UdpLink(name, end)) for name, end in self._endpoints.items()}
            self._links = opened
            if page is not None:
                host, port = stack.enter_context(served(page, self._board))
                self._say(Level.INFO, f"the page is at http://{host}:{port}/")
            self._say(Level.INFO, f"listening to the vehicle at {self._config.master}")
            code = 0
            while not self._signals.asked:
                ready = self._wait()
                if ready is None:
                    break
                try:
                    code = self._fly(ready)
                except (CompanionError, LogsError) as error:  # before it began: no room for a recording, say
                    self._say(Level.ERROR, f"{ready.mission.name}: not flown: {error}")
                    self._last_flight = {**dict.fromkeys(VERDICT_KEYS), "mission": ready.mission.name, "ok": False}
                    self._last_flight["failure"] = str(error)
            self._say(Level.INFO, "stopped" if not code else "stopped in flight without landing")
        return code

    # ---- between flights ----------------------------------------------------------------------------------------

    def _wait(self) -> Ready | None:
        """Look on until a flight shall begin; None: the service shall end."""
        self._state = "idle"
        while not self._signals.asked:
            self._take_upload()
            if self._missions.ready is None and self._plan is None:
                before = self._missions.why_not
                self._missions.look()
                if self._missions.why_not not in (before, ""):
                    self._say(Level.WARNING, self._missions.why_not)
            ready = self._missions.ready
            self._idle.mission = "" if ready is None else ready.mission.name
            self._idle.why_not = self._missions.why_not
            self._idle.autostart = self._config.autostart and ready is not None and self._may_go_on(ready)
            self._drive_idle(self._something_new(ready))
            if self._idle.start_asked and ready is not None:
                self._idle.start_asked = False
                return ready
        return None

    def _something_new(self, ready: Ready | None) -> Callable[[], bool]:
        """Tells when there is something else to look at than the vehicle."""
        until_s = time.monotonic() + LOOK_S
        missions = self._idle.station.missions
        return lambda: (
            missions.uploads != self._uploads
            or (self._plan is not None and self._place() is not None)
            or (ready is None and time.monotonic() > until_s)
        )

    def _take_upload(self) -> None:
        """A plan that a ground station has put here, as soon as it is known where the vehicle stands."""
        missions = self._idle.station.missions
        if missions.uploads != self._uploads:
            self._uploads, self._plan = missions.uploads, list(missions.items) or None
            self._missions.upload(None)
            count = len(missions.items)
            self._say(Level.INFO, f"a plan of {count} items was uploaded" if count else "the plan was cleared")
        place = self._place()
        self._idle.place_wanted = self._plan is not None
        if self._plan is None:
            return
        if place is None:
            self._missions.ready, self._missions.why_not = None, "where the vehicle stands is not known yet"
            return
        self._missions.upload(plan_file(self._plan, place))
        self._plan = None
        if self._missions.ready is None:
            self._say(Level.WARNING, self._missions.why_not)

    def _place(self) -> Geodetic | None:
        """Where on the earth the vehicle stands."""
        place = self._idle.telemetry.global_e7
        return None if place is None else Geodetic(place[0] * 1e-7, place[1] * 1e-7, place[2] * 1e-3)

    def _may_go_on(self, ready: Ready) -> bool:
        """Whether it may begin by itself: one file is flown once so, and nothing uploaded, nor after a failure."""
        last = self._last_flight
        if ready.file == Missions.UPLOADED:
            return False
        return last is None or (last["ok"] and self._config.missions_dir is not None)

    def _drive_idle(self, enough: Callable[[], bool]) -> None:
        self._phase = lambda: self._state
        taps: list[Tap] = [LogTap(self._log, self._phase), self._keep_notes, self._show_idle]
        stop = lambda: bool(self._signals.asked) or enough()  # noqa: E731  two conditions, once
        fly_realtime(self._idle, self._links, _NothingPlanned(), taps, operator=lambda now_us: None, stop=stop)

    # ---- one flight ---------------------------------------------------------------------------------------------

    def _fly(self, ready: Ready) -> int:
        """Fly a mission; 0, or 1 when it was stopped in the air."""
        mission = ready.mission
        self._state = "preparing"
        self._say(Level.INFO, f"preparing to fly {mission.name} ({ready.file})")
        planning = WorkerPlanning(mission.planner_world(), replans=mission.senses() or self._fleet)
        with ExitStack() as stack:
            stack.callback(planning.close)
            self._idle.mission, self._idle.why_not, self._idle.autostart = mission.name, "a flight is prepared", False
            mission.planner_world().distance(np.zeros((1, 3)))
            self._idle.preparing, self._idle.cancelled = True, False
            self._drive_idle(lambda: planning.warmed() or self._idle.cancelled)
            self._idle.preparing = False
            if self._signals.asked or self._idle.cancelled:
                self._say(Level.WARNING, f"{mission.name}: cancelled before it began")
                self._config = self._config.model_copy(update={"autostart": False})
                return 0
            companion = Companion(mission, self._core)
            meter = FlightMeter(companion)
            if self._config.record_max_mb is not None:
                for removed in make_room(self._config.record, self._config.record_max_mb):
                    self._say(Level.INFO, f"removed {removed} to make room")
            file = recording_file(self._config.record, mission)
            urls = {name: str(endpoint) for name, endpoint in self._endpoints.items()}
            start = header(companion, ready.data, endpoints=urls, clock={"epoch": "unix"})
            recorder = stack.enter_context(Recorder(file, threaded=True, **start))
            self._state = "flying"
            self._phase = lambda: companion.phase.value
            show = lambda tick: self._show_flight(tick, companion, meter)  # noqa: E731  a tap
            log = LogTap(self._log, self._phase)
            taps: list[Tap] = [meter, RecordingTap(companion, recorder), log, self._keep_notes, show]
            gc.collect()
            gc.freeze()  # what is here now stays: no collection in flight walks through it again
            signals = self._signals
            rate = lambda: companion.clock.rate  # noqa: E731  as the vehicle's time runs
            pace = fly_realtime(companion, self._links, planning, taps, operator=signals, stop=signals.stop, rate=rate)
            gc.unfreeze()
            self._close(recorder, pace)
        left = companion.phase in AIRBORNE and not companion.over
        if left:
            companion.failure = companion.failure or "stopped without landing"
        verdict = judge(companion, meter)
        self._flights += 1
        self._last_flight = verdict_state(verdict, str(file))
        outcome = "flown as expected" if verdict.ok else self._last_flight["failure"] or f"ended {verdict.phase}"
        level = Level.INFO if verdict.ok else Level.WARNING
        self._say(level, f"{mission.name}: {outcome}", flight=self._last_flight)
        self._missions.done()
        if isinstance(companion.ground, GroundStation) and companion.ground.missions.uploads:
            here = self._idle.station.missions  # a plan that came in flight
            here.items, here.uploads = companion.ground.missions.items, here.uploads + 1
        return int(left)

    def _close(self, recorder: Recorder, pace: Pace) -> None:
        recorder.metadata("pace", {key: str(value) for key, value in asdict(pace).items()})
        try:
            recorder.close()
        except RecordingError as error:
            self._say(Level.ERROR, str(error))

    # ---- what is told -------------------------------------------------------------------------------------------

    def _say(self, level: Level, text: str, **more: Any) -> None:
        self._log.write(level, self._phase(), text, **more)
        self._note(level, text)

    def _note(self, level: Level, text: str) -> None:
        at = datetime.fromtimestamp(time.time(), UTC).isoformat(timespec="milliseconds")
        self._notes.append({"time": at.replace("+00:00", "Z"), "level": LEVELS[level], "text": text[:500]})

    def _keep_notes(self, tick: Tick) -> None:
        for output in tick.outputs:
            if isinstance(output, Note):
                self._note(output.level, output.text)

    def _show_idle(self, tick: Tick) -> None:
        if tick.index % EVERY == 0:
            self._show(idle_state(tick.now_us, self._idle), None)

    def _show_flight(self, tick: Tick, companion: Companion, meter: FlightMeter) -> None:
        if tick.index % EVERY == 0:
            vehicle = vehicle_state(tick.now_us, companion.link, companion.telemetry)
            self._show(vehicle, flight_state(companion, meter), fleet_state(tick.now_us, companion))

    def _show(
        self, vehicle: dict[str, Any], flight: dict[str, Any] | None, fleet: dict[str, Any] | None = None
    ) -> None:
        ready = self._missions.ready
        links = {name: _link_words(link) for name, link in self._links.items()}
        self._board.put(
            {
                "version": self._version,
                "state": self._state,
                "up_s": round(time.monotonic() - self._began_s, 1),
                "flights": self._flights,
                "mission": None if ready is None else ready.mission.name,
                "why_not": self._missions.why_not or None,
                "vehicle": vehicle,
                "flight": flight,
                "last_flight": self._last_flight,
                "fleet": fleet,
                "links": links,
                "notes": list(self._notes),
            }
        )


def _version() -> str | None:
    """Of this package; None where it runs from its sources, not installed."""
    try:
        return metadata.version("mavlink-companion")
    except metadata.PackageNotFoundError:
        return None


def _link_words(link: UdpLink) -> str:
    c = link.counters
    return f"{c.rx_datagrams} in, {c.tx_datagrams} out, {c.drops} dropped"
