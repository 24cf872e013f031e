"""The companion as a step machine: `Companion.step(now_us, inputs) -> outputs`.

One tick, in this order:
1. take the inputs: telemetry from the vehicle, plans, the operator; forward what ground stations and vehicle say to
   each other;
2. look at what happened and move to the next phase at most once (`phases.py` is the table);
3. do the phase's work: ask, wait, or walk the mission's steps;
4. stream: HEARTBEAT at 1 Hz, a setpoint every tick from PLANNING on.

No clock, no socket, no randomness, no logging: the same inputs at the same `now_us` give the same outputs, which makes
a recording a table and a re-run a loop. Nothing a peer sends raises; it becomes a counter, a note or nothing. One file
on purpose: the order of a tick is what one wants to see whole.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from companion.autopilots.base import Autopilot
from companion.autopilots.px4 import Px4
from companion.commands import Command, Outcome
from companion.hooks import Ground, NobodyAsks, NothingReplanned, NothingSeen, Pose, Replanning, Seeing
from companion.itinerary import Itinerary
from companion.mission import Mission
from companion.offboard import setpoint_message
from companion.phases import OVER, STREAMING, Event, Phase, after
from companion.replanning import Replanning as Replanned
from companion.seam import Input, Level, Note, Order, Output, PlanReady, ReplanReady
from companion.seeing.sight import Sight
from companion.telemetry import Telemetry
from companion.vehiclelink import AUTOPILOT_COMPONENT, VEHICLE_LINK, VehicleLink
from wire.datagram import Datagram
from wire.dialect import mavlink

HEARTBEAT_US = 1_000_000
VEHICLE_SILENT_US = 3_000_000
POSITION_SILENT_US = 1_000_000
ASTRAY_M, ASTRAY_US = 2.0, 1_000_000
"""Farther than this from the reference for this long, and the flight lands: no plan vouches for such a place."""
BEFORE_FLIGHT = (Phase.CONNECTING, Phase.PREPARING, Phase.PLANNING, Phase.ENGAGING, Phase.ARMING)
"""Phases in which giving up costs nothing."""
PARAMETER_WAIT_US = 2_000_000
STREAM_BEFORE_ASKING_US = 500_000
"""PX4 wants a proof of life of setpoints before it accepts OFFBOARD."""


@dataclass(frozen=True, slots=True)
class CompanionConfig:
    """What a flight needs to know beside the mission; kept in the recording, so that a re-run has it too."""

    seed: int = 0
    system_id: int | None = None  # obey only this vehicle; None: the first autopilot heard
    ground_links: tuple[str, ...] = ()
    speaks_first: bool = False  # the vehicle waits to be called (a udpout link) rather than calling us
    wait_vehicle_s: float = 60.0
    wait_ready_s: float = 120.0
    wait_plan_s: float = 60.0


class Companion:
    """One flight of one mission.

    Attributes
    ----------
    phase : where the flight is (`phases.Phase`).
    failure : why it is FAILED or HANDED_OVER, in one line; empty otherwise.
    link, telemetry, itinerary : for progress lines; read only.
    """

    TICK_US = 20_000  # 50 Hz

    def __init__(self, mission: Mission, config: CompanionConfig) -> None:
        self.mission = mission
        self.config = config
        self.phase = Phase.CONNECTING
        self.failure = ""
        self.telemetry = Telemetry()
        self.itinerary = Itinerary(mission, config.seed)
        self.autopilot: Autopilot = Px4()
        self.origin_n = np.zeros(3)  # the mission frame's origin in the vehicle's local frame, fixed on the ground
        self.link = VehicleLink(config.system_id, config.speaks_first)
        self.seeing: Seeing = NothingSeen()
        self.replanning: Replanning = NothingReplanned()
        self.ground: Ground = NobodyAsks()
        if mission.senses():
            sight = Sight(mission)
            self.seeing, self.replanning = sight, Replanned(mission, self.itinerary, sight, config.seed)
        self._started_us: int | None = None
        self._entered_us = 0
        self._streaming_us = 0
        self._on_track_us = 0
        self._heartbeat_due_us = 0
        self._command: Command | None = None
        self._queue: list[Command] = []
        self._land_asked = False
        self._plan_refusal = ""
        self._was_landing = False
        self._withheld = False
        self._readiness: tuple[str, ...] = ()

    # ---- one tick -----------------------------------------------------------------------------------------------

    def step(self, now_us: int, inputs: Iterable[Input]) -> list[Output]:
        """Take what arrived since the last tick and say what leaves now.

        Parameters
        ----------
        now_us : the driver's clock [us], never running backwards.
        inputs : in the order of their arrival.

        Returns
        -------
        Datagrams to send, plans wanted, the reference flown (in STREAMING phases), and notes, in order.
        """
        if self._started_us is None:
            self._started_us = self._entered_us = self._heartbeat_due_us = now_us
        out: list[Output] = []
        for item in inputs:
            self._take(now_us, item, out)
        flight_us = now_us
        out.extend(self.ground.step(now_us))
        self.seeing.step(flight_us)
        self._report_texts(out)
        if self.phase not in OVER:
            self._answer_command()
            event = self._event(now_us, out)
            if event is not None:
                self._move(now_us, event, out)
            self._work(now_us, out)
        if self.phase is Phase.FLYING:
            out.extend(self.replanning.step(flight_us, self.pose(flight_us)))
            out.extend(self.replanning.take_said())
        self._stream(now_us, out)
        return out

    @property
    def over(self) -> bool:
        """Whether the companion has nothing more to do."""
        return self.phase in OVER

    def pose(self, flight_us: int) -> Pose:
        """Where the vehicle says it is, in the mission frame."""
        t = self.telemetry
        return Pose(flight_us, t.position_n - self.origin_n, t.velocity_n, t.roll, t.pitch, t.yaw)

    # ---- 1. inputs ----------------------------------------------------------------------------------------------

    def _take(self, now_us: int, item: Input, out: list[Output]) -> None:
        match item:
            case Datagram(link=link, data=data) if link == VEHICLE_LINK:
                for packet, obeyed in self.link.packets(now_us, item):
                    if obeyed:
                        self.telemetry.take(now_us, packet, self.link.decoder)
                    self.seeing.take(now_us, packet, self.pose(now_us))
                if self.link.impostor:
                    out.append(Note(Level.WARNING, self.link.impostor))
                    self.link.impostor = ""
                out.extend(Datagram(ground, data) for ground in self.config.ground_links)
            case Datagram(link=link, data=data) if link in self.config.ground_links:
                out.extend(self.ground.take(now_us, item, lambda order: self.obey(now_us, order)))
                if self.link.may_speak:
                    out.append(Datagram(VEHICLE_LINK, data, self.link.peer))
            case ReplanReady():
                self.replanning.take(item, now_us)
            case PlanReady():
                self._take_plan(now_us, item, out)
            case Order():
                reason = self.obey(now_us, item)
                by = f" ({item.source})" if item.source else ""
                told = Note(Level.WARNING, f"{item.name}{by}: {reason}") if reason else Note(Level.INFO, item.name + by)
                out.extend([told] if reason or item.name != "land" else [])

    def obey(self, now_us: int, order: Order) -> str:
        """Carry out an order: why it cannot be done, or nothing."""
        if order.name == "land" or (order.name == "abort" and self.phase in BEFORE_FLIGHT):
            self._land_asked = True
            return ""
        if self.phase is not Phase.FLYING:
            return f"not while {self.phase.value}"
        return self.itinerary.order(now_us, order)

    def _take_plan(self, now_us: int, ready: PlanReady, out: list[Output]) -> None:
        if self.itinerary.answer(now_us, ready):
            return
        if self.phase is not Phase.PLANNING or not self.itinerary.wants(ready.request_id):
            return  # an answer to nothing that was asked
        leg = f"step {ready.request_id}"
        if ready.trajectory is None or not ready.certified:
            self._plan_refusal = f"{leg}: {ready.text or ready.error or 'not certified'}"
            return
        self.itinerary.take(ready.request_id, ready.trajectory)
        duration = ready.trajectory.duration
        how = ready.method + ("" if math.isnan(ready.cpu_ms) else f", {ready.cpu_ms:.1f} ms")
        spare = f"{ready.clearance:.2f} m clear beyond what is kept"
        text = f"{leg} planned: {ready.length:.2f} m in {duration:.2f} s, {spare} ({how})"
        out.append(Note(Level.INFO, text))

    def _report_texts(self, out: list[Output]) -> None:
        for severity, text in self.telemetry.texts:
            level = Level.ERROR if severity <= 3 else Level.WARNING if severity == 4 else Level.INFO
            out.append(Note(level, f"vehicle: {text}"))
        self.telemetry.texts.clear()

    def _answer_command(self) -> None:
        for ack in self.telemetry.acks:
            if self._command is not None:
                self._command.answered(ack)
        self.telemetry.acks.clear()

    # ---- 2. what happened ---------------------------------------------------------------------------------------

    def _event(self, now_us: int, out: list[Output]) -> Event | None:
        """The one event of this tick, most urgent first."""
        if self.link.heard_us is not None and now_us - self.link.heard_us > VEHICLE_SILENT_US:
            self._blame(f"nothing heard from the vehicle for {(now_us - self.link.heard_us) / 1e6:.1f} s")
            return Event.VEHICLE_SILENT
        if self._land_asked and self.phase is not Phase.LANDING:
            self._land_asked = False
            self._blame("cancelled by the operator")
            if self.phase is Phase.FLYING:
                out.append(Note(Level.WARNING, "the operator asks to land; asking again stops without landing"))
            return Event.LAND_ASKED
        return WATCH[self.phase](self, now_us, out)

    def _connecting(self, now_us: int, out: list[Output]) -> Event | None:
        if self.telemetry.heartbeat_us is not None:
            if self.telemetry.autopilot != mavlink.MAV_AUTOPILOT_PX4:
                return self._refused(f"autopilot type {self.telemetry.autopilot} found, expected PX4 (12)")
            return Event.VEHICLE_HEARD
        if now_us - self._entered_us > self.config.wait_vehicle_s * 1e6:
            return self._refused(f"no HEARTBEAT from a vehicle in {self.config.wait_vehicle_s:g} s")
        return None

    def _preparing(self, now_us: int, out: list[Output]) -> Event | None:
        waited_us = now_us - self._entered_us
        if self._command is not None and self._command.outcome is not Outcome.PENDING:
            if self._command.outcome is not Outcome.ACCEPTED:
                out.append(Note(Level.WARNING, self._command.failure()))
            self._command = None
        unread = any(not raw for raw in self.telemetry.parameters.values()) and waited_us < PARAMETER_WAIT_US
        reasons = tuple(self.autopilot.not_ready(now_us, self.telemetry))
        if reasons != self._readiness:
            self._readiness = reasons
            out.append(Note(Level.INFO, "vehicle ready" if not reasons else f"waiting: {', '.join(reasons)}"))
        if not reasons and not self._queue and self._command is None and not unread:
            return Event.READY
        if waited_us > self.config.wait_ready_s * 1e6:
            return self._refused(f"the vehicle is not ready after {waited_us / 1e6:.0f} s: {', '.join(reasons)}")
        return None

    def _planning(self, now_us: int, out: list[Output]) -> Event | None:
        if self._plan_refusal:
            return self._refused(f"no plan: {self._plan_refusal}")
        if self.itinerary.planned():
            return Event.PLANS_READY
        if now_us - self._entered_us > self.config.wait_plan_s * 1e6:
            return self._refused(f"no plan after {self.config.wait_plan_s:g} s")
        return None

    def _engaging(self, now_us: int, out: list[Output]) -> Event | None:
        if self._command_failed():
            return Event.REFUSED
        return Event.MODE_CONFIRMED if self.autopilot.in_control(self.telemetry) else None

    def _arming(self, now_us: int, out: list[Output]) -> Event | None:
        if self._command_failed():
            return Event.REFUSED
        if not self.autopilot.in_control(self.telemetry):
            self.failure = f"the vehicle left {self.autopilot.offboard_mode} before it armed"
            return Event.MODE_LOST
        return Event.ARMED if self.telemetry.armed else None

    def _flying(self, now_us: int, out: list[Output]) -> Event | None:
        if not self.telemetry.armed:
            self.failure = f"the vehicle disarmed in step {self.itinerary.index} ({self.itinerary.step.kind})"
            return Event.DISARMED
        if not self.autopilot.in_control(self.telemetry):
            self.failure = f"the vehicle left {self.autopilot.offboard_mode}; it is not fought for"
            return Event.MODE_LOST
        astray = self._astray(now_us)
        if astray:
            self.failure = astray
            return Event.ASTRAY
        if self.itinerary.advance(now_us):
            out.append(Note(Level.INFO, f"step {self.itinerary.index}: {self.itinerary.step.kind}"))
        out.extend(self.itinerary.take_said())
        if self.itinerary.cut_short:
            self._blame(self.itinerary.cut_short)
        return Event.STEPS_DONE if self.itinerary.finished() else None

    def _astray(self, now_us: int) -> str:
        """Why the vehicle can no longer be trusted to be where the plan is safe, or nothing."""
        telemetry = self.telemetry
        if now_us - (telemetry.position_us or 0) > POSITION_SILENT_US:
            return f"no position from the vehicle for {POSITION_SILENT_US / 1e6:g} s: landing"
        here = telemetry.position_n - self.origin_n
        error = float(np.linalg.norm(here - self.itinerary.reference(now_us).position_m))
        if error <= ASTRAY_M:
            self._on_track_us = now_us
        if now_us - self._on_track_us <= ASTRAY_US:
            return ""
        return f"the vehicle is {error:.1f} m from its reference for {ASTRAY_US / 1e6:g} s: landing"

    def _landing(self, now_us: int, out: list[Output]) -> Event | None:
        if not self.telemetry.armed:
            return Event.DISARMED
        landing = self.autopilot.is_landing(self.telemetry)
        if self._was_landing and not landing:
            self.failure = "the vehicle stopped landing; it is not fought for"
            return Event.MODE_LOST
        self._was_landing = landing
        if self._command is not None and self._command.outcome in (Outcome.REFUSED, Outcome.UNANSWERED):
            out.append(Note(Level.ERROR, f"{self._command.failure()}; asking again"))
            self._command = self.autopilot.land()
        return None

    def _handed_over(self, now_us: int, out: list[Output]) -> Event | None:
        return None if self.telemetry.armed else Event.DISARMED

    def _nothing(self, now_us: int, out: list[Output]) -> Event | None:
        return None

    def _blame(self, why: str) -> None:
        """Keep the reason; what follows from an earlier trouble does not replace it."""
        self.failure = self.failure or why

    def _refused(self, why: str) -> Event:
        self.failure = why
        return Event.REFUSED

    def _command_failed(self) -> bool:
        """Whether the command under way has come to nothing; `failure` then says how."""
        command = self._command
        if command is None or command.outcome in (Outcome.PENDING, Outcome.ACCEPTED):
            return False
        self.failure = command.failure()
        return True

    # ---- 3. the work of a phase ---------------------------------------------------------------------------------

    def _move(self, now_us: int, event: Event, out: list[Output]) -> None:
        """Walk the table and do what entering a phase asks for."""
        before, self.phase = self.phase, after(self.phase, event)
        if self.phase is before:
            return
        if before is Phase.ARMING and self.phase is Phase.FAILED and event in (Event.LAND_ASKED, Event.REFUSED):
            out.append(self.link.pack(self.autopilot.disarm().message(self.link.target)))  # it may arm after all
        self._entered_us, self._command = now_us, None
        bad = self.phase in (Phase.FAILED, Phase.HANDED_OVER)
        text = f"{before.value} -> {self.phase.value}" + (f": {self.failure}" if bad else f" ({event.value})")
        out.append(Note(Level.ERROR if bad else Level.INFO, text))
        match self.phase:
            case Phase.PREPARING:
                self._queue = self.autopilot.stream_requests()
                self.telemetry.parameters = {name: b"" for name in self.autopilot.parameters_wanted()}
                self._read_parameters(out)
            case Phase.PLANNING:
                self.origin_n = self.telemetry.position_n - np.array(self.mission.start_m())
                self.itinerary.yaw = self.telemetry.yaw
                self.seeing.begin()
                self._streaming_us = now_us
                out.extend(Note(Level.WARNING, text) for text in self.autopilot.warnings(self.telemetry))
                self._plan_refusal = self.itinerary.obstruction()
                out.extend([] if self._plan_refusal else self.itinerary.wanted())
            case Phase.ARMING:
                self._command = self.autopilot.arm()
            case Phase.FLYING:
                self._on_track_us = now_us
                self.itinerary.begin(now_us)
            case Phase.LANDING:
                self._command = self.autopilot.land()

    def _work(self, now_us: int, out: list[Output]) -> None:
        """Keep the command under way going; in PREPARING the next of the queue, in ENGAGING the mode."""
        if self.phase is Phase.PREPARING and self._command is None and self._queue:
            self._command = self._queue.pop(0)
        streamed = now_us - self._streaming_us >= STREAM_BEFORE_ASKING_US
        if self.phase is Phase.ENGAGING and self._command is None and streamed:
            self._command = self.autopilot.take_control()
        if self._command is not None and self._command.due(now_us):
            out.append(self.link.pack(self._command.message(self.link.target)))

    def _read_parameters(self, out: list[Output]) -> None:
        for name in self.telemetry.parameters:
            request = mavlink.MAVLink_param_request_read_message(
                self.link.target, AUTOPILOT_COMPONENT, name.encode(), -1
            )
            out.append(self.link.pack(request))

    # ---- 4. streams ---------------------------------------------------------------------------------------------

    def _stream(self, now_us: int, out: list[Output]) -> None:
        if self.link.may_speak and now_us >= self._heartbeat_due_us:
            self._heartbeat_due_us += HEARTBEAT_US * ((now_us - self._heartbeat_due_us) // HEARTBEAT_US + 1)
            beat = self.link.pack(self._heartbeat())
            out.append(beat)
            out.extend(Datagram(ground, beat.data) for ground in self.config.ground_links)
        if self.phase not in STREAMING or self._was_landing:
            return
        reference = self.itinerary.reference(now_us)  # while landing it goes on to the end of its step, as planned
        time_boot_ms = (now_us - (self._started_us or 0)) // 1000
        message = setpoint_message(reference, self.origin_n, time_boot_ms, self.link.target)
        if message is None:
            if not self._withheld:
                out.append(Note(Level.ERROR, "the setpoint is not a place to fly to: none is sent"))
            self._withheld = True
            return
        self._withheld = False
        out.append(reference)
        out.append(self.link.pack(message))

    def _heartbeat(self) -> Any:
        state = mavlink.MAV_STATE_ACTIVE if self.phase in STREAMING else mavlink.MAV_STATE_STANDBY
        kind = mavlink.MAV_TYPE_ONBOARD_CONTROLLER
        return mavlink.MAVLink_heartbeat_message(kind, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, state, 3)


WATCH: dict[Phase, Callable[[Companion, int, list[Output]], Event | None]] = {
    Phase.CONNECTING: Companion._connecting,
    Phase.PREPARING: Companion._preparing,
    Phase.PLANNING: Companion._planning,
    Phase.ENGAGING: Companion._engaging,
    Phase.ARMING: Companion._arming,
    Phase.FLYING: Companion._flying,
    Phase.LANDING: Companion._landing,
    Phase.DONE: Companion._nothing,
    Phase.FAILED: Companion._nothing,
    Phase.HANDED_OVER: Companion._handed_over,
}
"""What each phase watches for."""
