"""`companion run`: the loop that goes from mission to mission.

    idle            the vehicle is heard or waited for, ground stations are served; a flight begins when it is asked for
                    (MISSION_START) or by itself (`autostart`)
    preparing       the workers that plan are started and their kernels compiled; idle goes on meanwhile
    flying          one `Companion`, recorded, until it is over; then idle again

It ends by a signal only. The first lands what flies and then ends; the second ends at once.
"""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import asdict
from typing import Protocol

import numpy as np

from companion.config import ServiceConfig
from companion.core import Companion, CompanionConfig
from companion.drivers.flight import NothingPlanned, fly_guarded
from companion.drivers.planning import WorkerPlanning
from companion.drivers.provenance import conclude
from companion.drivers.realtime import fly_realtime
from companion.drivers.recording import RecordingTap, header, socket_losses, unix_clock
from companion.drivers.tick import Tap
from companion.errors import CompanionError
from companion.ground.station import GroundStation
from companion.phases import AIRBORNE
from companion.seam import Level, Order
from companion.service.choice import Choice
from companion.service.feed import Feed
from companion.service.http import served
from companion.service.idle import Idle
from companion.service.jsonlog import Log
from companion.service.live import served_live
from companion.service.liveflight import LiveFlight
from companion.service.queue import Ready, make_room, recording_file
from companion.service.snapshot import VERDICT_KEYS
from companion.service.systemd import Systemd
from companion.service.telling import Telling
from companion.vehiclelink import VEHICLE_LINK
from companion.verdict import FlightMeter, judge
from logs.errors import LogsError, RecordingError
from logs.recorder import Recorder
from logs.recovery import recover_unfinished
from wire.endpoint import Endpoint
from wire.udp import UdpLink


class Signals(Protocol):
    """Who asks the service to end: `companion.cli.operator.Operator`."""

    asked: int

    def __call__(self, now_us: int) -> Order | None: ...

    def stop(self) -> bool: ...


class Service:
    """A companion that is left running.

    Parameters
    ----------
    config : what it is told.
    signals : who may ask it to end.
    log : where entries go.
    systemd : told that the loop turns; None: nobody is.
    """

    def __init__(self, config: ServiceConfig, signals: Signals, log: Log, systemd: Systemd | None = None) -> None:
        self._config, self._signals = config, signals
        self._systemd = Systemd({}) if systemd is None else systemd
        self._endpoints = {VEHICLE_LINK: Endpoint.parse(config.master)} | config.endpoints()
        self._endpoints |= config.sensor_endpoints() | config.fleet_endpoints()
        self._core = CompanionConfig(
            seed=config.seed,
            system_id=config.system_id,
            ground_links=tuple(config.endpoints()),
            sensor_links=tuple(config.sensor_endpoints()),
            speaks_first=self._endpoints[VEHICLE_LINK].kind == "udpout",
            fleet_number=0 if config.fleet is None else config.fleet.number,
            fleet_calls=0 if config.fleet is None else len(config.fleet.others),
        )
        self._idle, self._telling = Idle(self._core), Telling(log)
        self._choice = Choice(config, self._idle, self._telling)
        self._feed: Feed | None = None

    def run(self) -> int:
        """Run until a signal ends it; returns the exit code.

        Raises
        ------
        LinkError : a port is taken.
        """
        page, telling = self._config.page(), self._telling
        with ExitStack() as stack:
            telling.links = {name: stack.enter_context(UdpLink(name, end)) for name, end in self._endpoints.items()}
            if page is not None:
                host, port = stack.enter_context(served(page, telling.board))
                telling.say(Level.INFO, f"the page is at http://{host}:{port}/")
            if self._config.live is not None:
                self._feed = Feed()
                address = stack.enter_context(served_live(self._config.live, self._feed))
                # not said: notes are on the page, which anybody on this machine may read, and the token gives orders
                telling.log.write(Level.INFO, telling.state, f"the live page is at {address}")
                telling.live = address.partition("?")[0]
            telling.say(Level.INFO, f"listening to the vehicle at {self._config.master}")
            for recovered in recover_unfinished(self._config.record):
                telling.say(Level.WARNING, str(recovered))
            code = 0
            self._systemd.ready()
            while not self._signals.asked:
                ready = self._wait()
                if ready is None:
                    break
                try:
                    code = self._fly(ready)
                except (CompanionError, LogsError) as error:  # before it began: no room for a recording, say
                    telling.say(Level.ERROR, f"{ready.mission.name}: not flown: {error}")
                    failed = {"mission": ready.mission.name, "ok": False, "failure": str(error)}
                    telling.last_flight = dict.fromkeys(VERDICT_KEYS) | failed
            self._systemd.stopping()
            telling.say(Level.INFO, "stopped" if not code else "stopped in flight without landing")
        return code

    def _wait(self) -> Ready | None:
        """Look on until a flight shall begin; None: the service shall end."""
        self._telling.state = "idle"
        while not self._signals.asked:
            self._choice.look()
            self._drive_idle(self._choice.stale())
            if self._idle.start_asked:
                self._idle.start_asked = False
                return self._choice.ready
        return None

    def _drive_idle(self, enough: Callable[[], bool]) -> None:
        """Look on until a flight shall begin, or it is `enough`."""
        idle, telling = self._idle, self._telling
        telling.phase = lambda: telling.state
        self._systemd.status(f"{telling.state}: {idle.mission or 'no mission'}")
        taps: list[Tap] = [
            self._systemd,
            telling.hear,
            lambda tick: telling.show_idle(tick, idle, self._choice.missions),
        ]
        stop = lambda: bool(self._signals.asked) or enough()  # noqa: E731  two conditions, once
        fly_realtime(idle, telling.links, NothingPlanned(), taps, operator=lambda now_us: None, stop=stop)

    def _prepared(self, ready: Ready, planning: WorkerPlanning) -> bool:
        """Wait for the workers' kernels, looking on; False when the flight was called off meanwhile."""
        idle, mission = self._idle, ready.mission
        idle.mission, idle.why_not, idle.autostart = mission.name, "a flight is prepared", False
        mission.planner_world().distance(np.zeros((1, 3)))
        idle.preparing, idle.cancelled = True, False
        self._drive_idle(lambda: planning.warmed() or idle.cancelled)
        idle.preparing = False
        return not self._signals.asked and not idle.cancelled

    def _fly(self, ready: Ready) -> int:
        """Fly a mission; 0, or 1 when it was stopped in the air."""
        mission, telling, signals = ready.mission, self._telling, self._signals
        telling.state = "preparing"
        telling.say(Level.INFO, f"preparing to fly {mission.name} ({ready.file})")
        planning = WorkerPlanning(mission.planner_world(), replans=mission.senses() or self._config.fleet is not None)
        with ExitStack() as stack:
            stack.callback(planning.close)
            if not self._prepared(ready, planning):
                telling.say(Level.WARNING, f"{mission.name}: cancelled before it began")
                self._choice.called_off()
                return 0
            companion = Companion(mission, self._core)
            meter = FlightMeter(companion)
            if self._config.record_max_mb is not None:
                for removed in make_room(self._config.record, self._config.record_max_mb):
                    telling.say(Level.INFO, f"removed {removed} to make room")
            file = recording_file(self._config.record, mission)
            urls = {name: str(endpoint) for name, endpoint in self._endpoints.items()}
            start = header(companion, ready.data, endpoints=urls, clock=unix_clock())
            start |= {"rotation": self._config.rotation(), "losses": socket_losses(telling.links)}
            recorder = stack.enter_context(Recorder(file, threaded=True, **start))
            recording = RecordingTap(companion, recorder, lambda text: telling.say(Level.WARNING, text))
            telling.state = "flying"
            telling.phase = lambda: companion.phase.value
            self._systemd.status(f"flying {mission.name}")
            show = lambda tick: telling.show_flight(tick, companion, meter, self._choice.missions)  # noqa: E731  a tap
            taps: list[Tap] = [self._systemd, meter, recording, telling.hear, show]
            ask: Callable[[int], Order | None] = signals
            live = None
            if self._feed is not None:
                live = LiveFlight(self._feed, companion, meter, {"recording": str(file)})
                taps, ask = [*taps, live], live.operator(signals)
            pace = fly_guarded(
                companion,
                telling.links,
                planning,
                taps,
                operator=ask,
                stop=signals.stop,
                told=lambda text, trace: telling.say(Level.ERROR, text, traceback=trace),
            )
            left = companion.phase in AIRBORNE and not companion.over
            if left:
                companion.failure = companion.failure or "stopped without landing"
            conclude(recorder, companion, meter)
            recorder.metadata("pace", {key: str(value) for key, value in asdict(pace).items()})
            try:
                recorder.close()
            except RecordingError as error:
                telling.say(Level.ERROR, str(error))
        verdict = judge(companion, meter)
        if live is not None:
            live.end(verdict)
        telling.judged(verdict, file)
        self._choice.flown(companion.ground if isinstance(companion.ground, GroundStation) else None)
        return int(left)
