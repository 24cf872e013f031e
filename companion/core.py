"""The companion as a step machine: `Companion.step(now_us, inputs) -> outputs`.

One tick, in this order:
1. read the flight's clock, which runs at the vehicle's pace;
2. take the inputs: telemetry and sensors from the vehicle, plans, ground stations, the operator; look at what was seen;
3. look at what happened and move to the next phase at most once (`phases.py` is the table; in the air `safety.py` says
   what counts as trouble and what it leads to);
4. do the phase's work: ask, wait, or walk the mission's steps; ask for another plan;
5. stream: HEARTBEAT at 1 Hz, and in the phases and on the autopilots that want them a setpoint every tick.

Two clocks: `now_us` is the driver's, for silence, repeats and HEARTBEAT; `flight_us` is the vehicle's, for everything
that is flown. In lockstep they are the same.

No clock, no socket, no randomness, no logging: the same inputs at the same `now_us` give the same outputs, which makes
a recording a table and a re-run a loop. Nothing a peer sends raises; it becomes a counter, a note or nothing. Here is
the order of a tick, whole; what each phase does in it is in `onground`, `inflight` and `entering`.
"""

import math
from collections.abc import Callable, Iterable
from typing import Any

from companion.entering import Entering
from companion.fleet.member import FLEET_LINK, Member
from companion.flightstate import BEFORE_FLIGHT
from companion.flightstate import CompanionConfig as CompanionConfig
from companion.hooks import NothingSeen
from companion.inflight import InFlight
from companion.onground import OnTheGround
from companion.phases import AIRBORNE, OVER, STREAMING, Event, Phase, after
from companion.safety import Action
from companion.seam import Input, Level, Note, Order, Output, PlanReady, Reference, ReplanReady
from companion.vehiclelink import VEHICLE_LINK
from companion.watching import Watching
from wire.datagram import Datagram
from wire.dialect import mavlink

HEARTBEAT_US = 1_000_000
HEARS_US = 500_000
"""A vehicle that streams is not silent for longer."""
STREAM_BEFORE_ASKING_US = 500_000
"""PX4 wants a proof of life of setpoints before it accepts OFFBOARD."""


class Companion(OnTheGround, InFlight, Entering, Watching):
    """One flight of one mission.

    What it consists of is in `flightstate`; what a phase watches for in `onground` and `inflight`, what it begins with
    in `entering`.
    """

    TICK_US = 20_000  # 50 Hz

    # ---- one tick -----------------------------------------------------------------------------------------------

    def step(self, now_us: int, inputs: Iterable[Input]) -> list[Output]:
        """Take what arrived since the last tick and say what leaves now.

        Parameters
        ----------
        now_us : the driver's clock [us], never running backwards.
        inputs : in the order of their arrival.

        Returns
        -------
        Datagrams to send, plans wanted, the reference flown (where a setpoint leaves), and notes, in order.
        """
        if self._started_us is None:
            self._started_us = self._entered_us = self._heartbeat_due_us = self._last_us = now_us
        out: list[Output] = []
        self._flight_us = flight_us = self.clock.at(now_us, slowly=self.phase in AIRBORNE)
        for item in inputs:
            self._take(now_us, item, out)
        self.seeing.step(flight_us)
        self._report_texts(now_us, out)
        if self.phase not in OVER:
            self._asking.take_answers(now_us, self.telemetry, self.link.target)
            self._look_after_streams(now_us, out)
            self.telemetry.acks.clear()
            event = self._event(now_us, out)
            if event is not None:
                self._move(now_us, event, out)
            self._work(now_us, out)
        if self.fleet is not None:
            out.extend(self._told_to_others(self.fleet, now_us, flight_us))
        climbs = self.phase is Phase.TAKING_OFF
        if self.lookout is not None and climbs:
            out.extend(self.lookout.step(flight_us, climbing=True))
        if self.phase is Phase.FLYING:
            out.extend(self.replanning.step(flight_us, self._carried_on(now_us)))
            out.extend(self.replanning.take_said())
            out.extend([] if self.lookout is None else self.lookout.step(flight_us))
        self._stream(now_us, out)
        out.extend(self.ground.step(now_us))
        self._last_us = now_us
        return out

    def _told_to_others(self, fleet: Member, now_us: int, flight_us: int) -> list[Datagram | Note]:
        flown = self.itinerary.flown(flight_us) if self.phase is Phase.FLYING else None
        aim = None if flown is None else self.itinerary.aim()
        yields = aim is not None and not aim.via_m
        return fleet.step(now_us, self.pose(flight_us), flown, airborne=self.phase in AIRBORNE, yields=yields)

    # ---- 2. inputs ----------------------------------------------------------------------------------------------

    def _take(self, now_us: int, item: Input, out: list[Output]) -> None:
        match item:
            case Datagram(link=link) if link == VEHICLE_LINK:
                for packet, obeyed in self.link.packets(now_us, item):
                    if obeyed:
                        self._hear(now_us, packet)
                    if type(self.seeing) is not NothingSeen:
                        self.seeing.take(packet, self.pose(self._flight_us))
                if self.link.impostor:
                    out.append(Note(Level.WARNING, self.link.impostor))
                    self.link.impostor = ""
                out.extend(self.router.route(now_us, item, self.link.system_id, self.link.peer))
            case Datagram(link=link) if link in self.config.ground_links:
                out.extend(self.ground.take(now_us, item, lambda order: self._ordered(now_us, order, out)))
                routed = self.router.route(now_us, item, self.link.system_id, self.link.peer)
                out.extend(d for d in routed if d.link != VEHICLE_LINK or self.link.may_speak)
            case Datagram(link=link) if link in self.config.sensor_links:
                for packet in self._sensed.packets(item.data):
                    if packet.system_id == self.link.system_id:
                        self.seeing.take(packet, self.pose(self._flight_us))
            case Datagram(link=link) if self.fleet is not None and link.startswith(FLEET_LINK):
                self.fleet.take(now_us, item)
            case ReplanReady():
                self.replanning.take(item, self._flight_us)
            case PlanReady():
                self._take_plan(item, out)
            case Order():
                reason = self.obey(now_us, item)
                by = f" ({item.source})" if item.source else ""
                told = Note(Level.WARNING, f"{item.name}{by}: {reason}") if reason else Note(Level.INFO, item.name + by)
                out.extend([told] if reason or item.name != "land" else [])

    def _ordered(self, now_us: int, order: Order, out: list[Output]) -> str:
        """An order of a ground station's; what is refused it is told itself."""
        reason = self.obey(now_us, order)
        if not reason:
            out.append(Note(Level.INFO, f"{order.name} ({order.source})"))
        return reason

    def _hear(self, now_us: int, packet: Any) -> None:
        """One packet of the autopilot's."""
        self._streams.heard(packet.message_id)
        boots, stamp = self.telemetry.boots, self.telemetry.boot_ms
        self.telemetry.take(now_us, packet, self.link.decoder)
        if self.telemetry.boots != boots:
            self.clock.forget()
        elif self.telemetry.boot_ms is not None and self.telemetry.boot_ms != stamp:
            self.clock.heard(now_us, self.telemetry.boot_ms)

    def _take_plan(self, ready: PlanReady, out: list[Output]) -> None:
        if self.rejoin.take(ready) or self.itinerary.answer(self._flight_us, ready):
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

    def _report_texts(self, now_us: int, out: list[Output]) -> None:
        for severity, text in self.telemetry.texts:
            level = Level.ERROR if severity <= 3 else Level.WARNING if severity == 4 else Level.INFO
            out.append(Note(level, f"vehicle: {text}"))
            if severity <= mavlink.MAV_SEVERITY_NOTICE:
                self._warned = (now_us, text)
        self.telemetry.texts.clear()

    def _look_after_streams(self, now_us: int, out: list[Output]) -> None:
        """In the air, ask again for what does not come; and see whether a vehicle that misses setpoints hears us."""
        if self.phase in AIRBORNE:
            hears = now_us - (self.link.heard_us or 0) < HEARS_US
            probes = self.phase is Phase.REJOINING and self.autopilot.lost_our_stream(self.telemetry)
            message = self._streams.ask(now_us, self.telemetry.acks, self.link.target, hears, probes)
            out.extend([] if message is None else [self.link.pack(message)])

    # ---- 3. what happened ---------------------------------------------------------------------------------------

    def _event(self, now_us: int, out: list[Output]) -> Event | None:
        """The one event of this tick, most urgent first."""
        if self.phase in AIRBORNE or self.phase is Phase.HANDED_OVER:
            acting = self.safety.step(now_us, self._watch(now_us))
            if acting is not None:
                rule, reason = acting
                if rule.name == "landed":
                    return rule.event
                if rule.action in (Action.FAIL, Action.HAND_OVER, Action.LAND, Action.GO_HOME, Action.RETURN):
                    self._blame(reason)
                if rule.action is Action.RETURN:
                    self._returning_us = now_us
                    self._no_way_home = self.itinerary.order(self._flight_us, Order("return"))
                level = Level.ERROR if rule.action in (Action.FAIL, Action.HAND_OVER, Action.LAND) else Level.WARNING
                out.append(Note(level, f"{reason} ({rule.action.value})"))
                self._going_home = rule.action is Action.GO_HOME
                return rule.event
        elif self.phase not in (Phase.CONNECTING, Phase.DISARMING):
            event = self._lost_on_the_ground(now_us, out)
            if event is not None:
                return event
        land_asked, self._land_asked = self._land_asked, False
        if land_asked and (self.phase is not Phase.LANDING or self._going_home):
            self._blame("cancelled by the operator")
            if self.phase in AIRBORNE:
                out.append(Note(Level.WARNING, "the operator asks to land; asking again stops without landing"))
            return Event.LAND_ASKED
        return WATCH[self.phase](self, now_us, out)

    def _nothing(self, now_us: int, out: list[Output]) -> Event | None:
        return None

    # ---- 4. the work of a phase ---------------------------------------------------------------------------------

    def _move(self, now_us: int, event: Event, out: list[Output]) -> None:
        """Walk the table and do what entering a phase asks for."""
        before, self.phase = self.phase, after(self.phase, event)
        if self.phase is before:
            if event is Event.LAND_ASKED and before is Phase.LANDING:
                self._going_home, self._landed_instead = False, True
                self._mode_before = self.telemetry.custom_mode
                self._asking.forget()
                self._asking.question = self._way_down()
            return
        self._entered_us = now_us
        self._asking.forget()
        self._streams.forget()
        self._mode_before = self.telemetry.custom_mode
        from_hold = before is Phase.REJOINING and self.phase in (Phase.LANDING, Phase.LINK_LOST)
        self._held = self.rejoin.hold(self.itinerary.yaw) if from_hold else None
        bad = self.phase in (Phase.FAILED, Phase.HANDED_OVER)
        text = f"{before.value} -> {self.phase.value}" + (f": {self.failure}" if bad else f" ({event.value})")
        out.append(Note(Level.ERROR if bad else Level.INFO, text))
        self._enter(now_us, event, out)

    def _work(self, now_us: int, out: list[Output]) -> None:
        """Keep the command under way going; in PREPARING the next of the queue, in ENGAGING the mode."""
        if self.phase is Phase.PREPARING and self._asking.question is None and self._preparation is not None:
            self._asking.question = self._preparation.next()
        streamed = now_us - self._streaming_us >= STREAM_BEFORE_ASKING_US or not self.autopilot.streams_on_ground
        if self.phase is Phase.ENGAGING and self._asking.question is None and streamed:
            self._asking.question = self.autopilot.take_control()
        message = self._asking.message(now_us, self.link.target)
        out.extend([] if message is None else [self.link.pack(message)])

    # ---- 5. streams ---------------------------------------------------------------------------------------------

    def _stream(self, now_us: int, out: list[Output]) -> None:
        if self.link.may_speak and now_us >= self._heartbeat_due_us:
            self._heartbeat_due_us += HEARTBEAT_US * ((now_us - self._heartbeat_due_us) // HEARTBEAT_US + 1)
            beat = self.link.heartbeat(
                mavlink.MAV_STATE_ACTIVE if self.phase in STREAMING else mavlink.MAV_STATE_STANDBY
            )
            out.append(beat)
            out.extend(Datagram(ground, beat.data) for ground in self.config.ground_links)
        if not self._takes_setpoints():
            return
        time_boot_ms = (now_us - (self._started_us or 0)) // 1000
        wanted, setpoints = self._asked_for(now_us), self.setpoints
        drifted, self._drifts = self.replanning.drifts != self._drifts, self.replanning.drifts
        anew = drifted or self.phase is Phase.REJOINING or self.phase in BEFORE_FLIGHT
        message, told = setpoints.next(wanted, self._flight_us, anew, self.origin_n, time_boot_ms, self.link.target)
        out.extend(told)
        if message is not None and setpoints.reference is not None:
            out.append(setpoints.reference)
            out.append(self.link.pack(message))

    def _takes_setpoints(self) -> bool:
        """Whether a setpoint is wanted in this phase by this autopilot."""
        autopilot = self.autopilot
        match self.phase:
            case Phase.PLANNING | Phase.ENGAGING | Phase.ARMING | Phase.DISARMING:
                return autopilot.streams_on_ground
            case Phase.TAKING_OFF:
                return not autopilot.takes_off_itself
            case Phase.LINK_LOST | Phase.REJOINING if autopilot.takes_off_itself:  # one would end its climb
                climbs = self.telemetry.landed_state == mavlink.MAV_LANDED_STATE_TAKEOFF
                return not climbs and not (self.phase is Phase.LINK_LOST and self.itinerary.index == 0)
            case Phase.LANDING:
                return autopilot.streams_until_landing and not self._came_down
            case phase:
                return phase in STREAMING

    def _asked_for(self, now_us: int) -> Reference:
        """The reference of this tick, in a phase that takes setpoints."""
        if self.phase is Phase.REJOINING:
            return self.rejoin.hold(self.itinerary.yaw)
        if self._held is not None:
            return self._held
        if self.phase in (Phase.FLYING, Phase.LINK_LOST, Phase.LANDING) and self.rejoin.under_way(self._flight_us):
            return self.rejoin.reference(self._flight_us, self.itinerary.yaw)
        return self.itinerary.reference(self._flight_us)  # while landing it goes on to the end of its step, as planned


WATCH: dict[Phase, Callable[[Companion, int, list[Output]], Event | None]] = {
    Phase.CONNECTING: Companion._connecting,
    Phase.PREPARING: Companion._preparing,
    Phase.PLANNING: Companion._planning,
    Phase.ENGAGING: Companion._engaging,
    Phase.ARMING: Companion._arming,
    Phase.DISARMING: Companion._disarming,
    Phase.TAKING_OFF: Companion._taking_off,
    Phase.FLYING: Companion._flying,
    Phase.LINK_LOST: Companion._link_lost,
    Phase.REJOINING: Companion._rejoining,
    Phase.LANDING: Companion._landing,
    Phase.DONE: Companion._nothing,
    Phase.FAILED: Companion._nothing,
    Phase.HANDED_OVER: Companion._handed_over,
}
"""What each phase watches for."""
