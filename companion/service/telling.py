"""What the service tells: its log, the notes of late, and the state that the page is made from."""

import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import asdict
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path
from typing import Any

from companion.core import Companion
from companion.drivers.tick import Tick
from companion.ground.router import Router
from companion.seam import Level, Note
from companion.service.http import Board
from companion.service.idle import Idle
from companion.service.jsonlog import LEVELS, Log
from companion.service.queue import Missions
from companion.service.snapshot import (
    fleet_state,
    flight_state,
    idle_state,
    replanning_state,
    vehicle_state,
    verdict_state,
)
from companion.verdict import FlightMeter, Verdict
from wire.udp import UdpLink

EVERY = 25
"""Ticks between two states put up."""
MOST_NOTES = 50


class Telling:
    """Tells of the service.

    Attributes
    ----------
    state : what it does: starting, idle, preparing, flying.
    phase : gives the name that log entries carry; the state's unless a flight has one of its own.
    flights : how many were flown.
    last_flight : the verdict on the last one, as `/state.json` has it.
    links : open ones by name.
    board : where the state is put up.
    live : address of the live page, without its token; empty: there is none.
    """

    def __init__(self, log: Log) -> None:
        self.log, self.board = log, Board()
        self.state, self.flights, self.live = "starting", 0, ""
        self.last_flight: dict[str, Any] | None = None
        self.links: Mapping[str, UdpLink] = {}
        self.phase: Callable[[], str] = lambda: self.state
        self._notes: deque[dict[str, str]] = deque(maxlen=MOST_NOTES)
        self._began_s = time.monotonic()
        self._version = _version()

    def say(self, level: Level, text: str, **more: Any) -> None:
        """One entry of the log, and a note."""
        self.log.write(level, self.phase(), text, **more)
        self._note(level, text)

    def hear(self, tick: Tick) -> None:
        """A tap: logs what was noted, and keeps it for the page."""
        for output in tick.outputs:
            if isinstance(output, Note):
                self.say(output.level, output.text)

    def show_idle(self, tick: Tick, idle: Idle, missions: Missions) -> None:
        """Put up the state between flights."""
        if tick.index % EVERY == 0:
            self._show(missions, idle.router, idle_state(tick.now_us, idle))

    def show_flight(self, tick: Tick, companion: Companion, meter: FlightMeter, missions: Missions) -> None:
        """Put up the state in flight."""
        if tick.index % EVERY == 0:
            vehicle = vehicle_state(tick.now_us, companion.link, companion.telemetry)
            flight, fleet = flight_state(companion, meter), fleet_state(tick.now_us, companion)
            self._show(missions, companion.router, vehicle, flight, fleet, replanning_state(companion))

    def judged(self, verdict: Verdict, recording: Path) -> None:
        """A flight is over."""
        self.flights += 1
        self.last_flight = verdict_state(verdict, str(recording))
        outcome = "flown as expected" if verdict.ok else self.last_flight["failure"] or f"ended {verdict.phase}"
        level = Level.INFO if verdict.ok else Level.WARNING
        self.say(level, f"{verdict.mission}: {outcome}", flight=self.last_flight)

    def _note(self, level: Level, text: str) -> None:
        at = datetime.fromtimestamp(time.time(), UTC).isoformat(timespec="milliseconds")
        self._notes.append({"time": at.replace("+00:00", "Z"), "level": LEVELS[level], "text": text[:500]})

    def _show(
        self,
        missions: Missions,
        router: Router,
        vehicle: dict[str, Any],
        flight: dict[str, Any] | None = None,
        fleet: dict[str, Any] | None = None,
        replanning: dict[str, Any] | None = None,
    ) -> None:
        ready = missions.ready
        links = {name: _link_words(link) for name, link in self.links.items()}
        self.board.put(
            {
                "version": self._version,
                "state": self.state,
                "up_s": round(time.monotonic() - self._began_s, 1),
                "flights": self.flights,
                "mission": None if ready is None else ready.mission.name,
                "why_not": missions.why_not or None,
                "vehicle": vehicle,
                "flight": flight,
                "replanning": replanning,
                "last_flight": self.last_flight,
                "fleet": fleet,
                "links": links,
                "live": self.live or None,
                "routing": asdict(router.counters),
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
