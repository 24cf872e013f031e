"""Between flights: a step machine like the core that looks on, forwards, and answers ground stations.

It hears the vehicle, says HEARTBEAT once a second as the companion it is, and routes packets. The vehicle is sent
nothing else, unless a plan waits for the place where it stands: that is asked for once a second until it is told.
`over` turns true when a flight shall begin: a ground station or a person asks for it, or it begins by itself as soon as
a vehicle stands there (`autostart`).
"""

from collections.abc import Callable, Iterable
from typing import Any

from companion.autopilots import AUTOPILOTS
from companion.core import CompanionConfig
from companion.ground.router import Router
from companion.ground.station import GroundStation
from companion.seam import Input, Level, Note, Order, Output
from companion.telemetry import Telemetry
from companion.vehiclelink import AUTOPILOT_COMPONENT, VEHICLE_LINK, VehicleLink
from wire.datagram import Datagram
from wire.dialect import mavlink

HEARTBEAT_US = 1_000_000
SILENT_US = 3_000_000
SETTLE_US = 1_000_000
"""A vehicle is heard for so long before a flight begins by itself: it may be flown already."""


class Idle:
    """What the service does while it does not fly.

    Parameters
    ----------
    config : as a flight's.
    Attributes
    ----------
    mission : name of the mission that would be flown; empty: there is none.
    why_not : why none can begin now, whatever the vehicle does; empty: one can.
    autostart : begin as soon as a vehicle stands there.
    look : called before a start is granted or refused: what would be flown is looked at as it is now.
    start_asked : a flight shall begin.
    preparing : one is about to; `cancelled` says that somebody does not want it any more.
    place_wanted : a plan waits for where the vehicle stands.
    station : answers ground stations.
    link, telemetry, router : of the vehicle, and to it; read only.
    """

    TICK_US = 20_000

    def __init__(self, config: CompanionConfig) -> None:
        self.mission = ""
        self.why_not = ""
        self.autostart = False
        self.look: Callable[[], None] = lambda: None
        self.start_asked = False
        self.preparing = self.cancelled = self.place_wanted = False
        self.station = GroundStation(lambda: self.link.target, links=config.ground_links)
        self._config = config
        self.router = Router(config.ground_links)
        self.link, self.telemetry = VehicleLink(config.system_id, config.speaks_first), Telemetry()
        self._first_us: int | None = None
        self._heartbeat_due_us = 0
        self._heard = False

    @property
    def over(self) -> bool:
        """Whether a flight shall begin."""
        return self.start_asked

    @property
    def heard(self) -> bool:
        """Whether the vehicle is there."""
        return self._heard

    def step(self, now_us: int, inputs: Iterable[Input]) -> list[Output]:
        """As `Companion.step`."""
        out: list[Output] = []
        for item in inputs:
            self._take(now_us, item, out)
        out.extend(self.station.step(now_us))
        self._look(now_us, out)
        if not 0 < self._heartbeat_due_us - now_us <= HEARTBEAT_US:  # due, or the clock was set back between flights
            self._heartbeat_due_us = now_us + HEARTBEAT_US
            beat = self.link.heartbeat(mavlink.MAV_STATE_STANDBY)
            out.extend([beat] if self.link.may_speak else [])
            if self.place_wanted and self._heard and self.telemetry.global_e7 is None:
                out.append(self.link.pack(_where(self.link.target)))
            out.extend(Datagram(link, beat.data) for link in self._config.ground_links)
        if self.autostart and self._first_us is not None and now_us - self._first_us >= SETTLE_US:
            self.start_asked = self.start_asked or (not self._refusal() and not self._refusal_now())
        return out

    def obey(self, order: Order) -> str:
        """Carry out an order: why it cannot be done, or nothing."""
        if order.name in ("land", "abort", "return") and self.preparing:
            self.cancelled = True
            return ""
        if order.name != "start":
            return "there is no flight"
        reason = self._refusal_now()
        self.start_asked = self.start_asked or not reason
        return reason

    def _refusal_now(self) -> str:
        """`_refusal` of what would be flown as it is now."""
        if not self.preparing:
            self.look()
        return self._refusal()

    def _refusal(self) -> str:
        """Why no flight can begin now, or nothing."""
        if self.why_not or not self.mission:
            return self.why_not or "there is no mission"
        if not self._heard:
            return "the vehicle is not heard"
        return "the vehicle is armed: somebody else flies it" if self.telemetry.armed else ""

    def _take(self, now_us: int, item: Input, out: list[Output]) -> None:
        match item:
            case Datagram(link=link) if link == VEHICLE_LINK:
                for packet, obeyed in self.link.packets(now_us, item):
                    if obeyed:
                        self.telemetry.take(now_us, packet, self.link.decoder)
                out.extend(self.router.route(now_us, item, self.link.system_id, self.link.peer))
            case Datagram(link=link) if link in self._config.ground_links:
                out.extend(self.station.take(now_us, item, self.obey))
                routed = self.router.route(now_us, item, self.link.system_id, self.link.peer)
                out.extend(d for d in routed if d.link != VEHICLE_LINK or self.link.may_speak)
            case Order():
                reason = self.obey(item)
                out.extend([Note(Level.WARNING, f"{item.name}: {reason}")] if reason else [])

    def _look(self, now_us: int, out: list[Output]) -> None:
        """Whether the vehicle is there, what it says, and another that may have taken its place."""
        for severity, text in self.telemetry.texts:
            out.append(Note(Level.WARNING if severity <= 4 else Level.INFO, f"vehicle: {text}"))
        self.telemetry.texts.clear()
        self.telemetry.acks.clear()
        heard_us = self.link.heard_us
        heard = heard_us is not None and now_us - heard_us <= SILENT_US and self.telemetry.heartbeat_us is not None
        if heard and not self._heard:
            kind = AUTOPILOTS.get(self.telemetry.autopilot)
            name = f"autopilot type {self.telemetry.autopilot}" if kind is None else kind.name
            out.append(Note(Level.INFO, f"vehicle heard: system {self.link.system_id}, {name}"))
            self._first_us = now_us
        if self._heard and not heard:
            out.append(Note(Level.WARNING, f"nothing heard from the vehicle for {SILENT_US / 1e6:g} s"))
        if heard_us is not None and now_us - heard_us > SILENT_US:
            self._first_us = None
            self.link, self.telemetry = VehicleLink(self._config.system_id, self._config.speaks_first), Telemetry()
        self._heard = heard


def _where(system_id: int) -> Any:
    place, request = mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT, mavlink.MAV_CMD_REQUEST_MESSAGE
    return mavlink.MAVLink_command_long_message(system_id, AUTOPILOT_COMPONENT, request, 0, place, 0, 0, 0, 0, 0, 0)
