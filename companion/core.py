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
a recording a table and a re-run a loop. Nothing a peer sends raises; it becomes a counter, a note or nothing. One file
on purpose: the order of a tick is what one wants to see whole.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from companion.asking import Asking
from companion.autopilots import AUTOPILOTS
from companion.autopilots.base import Autopilot
from companion.autopilots.px4 import Px4
from companion.commands import Command, Outcome
from companion.fleet.member import FLEET_LINK, Member
from companion.geodesy import Geodetic, to_local
from companion.ground.progress import Course
from companion.ground.router import Router
from companion.ground.station import GroundStation
from companion.hooks import Ground, NobodyAsks, NothingReplanned, NothingSeen, Pose, Replanning, Seeing
from companion.itinerary import Itinerary
from companion.lookout import Lookout
from companion.mission import Mission
from companion.phases import AIRBORNE, OVER, STREAMING, Event, Phase, after
from companion.preparation import Preparation
from companion.rejoin import SAME_PLACE, Rejoin
from companion.replanning import Replanning as Replanned
from companion.safety import Action, Safety, Watch
from companion.seam import Input, Level, Note, Order, Output, PlanReady, Reference, ReplanReady
from companion.seeing.sight import Sight
from companion.setpoints import SetpointStream
from companion.streams import Streams
from companion.telemetry import Telemetry
from companion.vehicleclock import VehicleClock
from companion.vehiclelink import VEHICLE_LINK, VehicleLink
from wire.datagram import Datagram
from wire.dialect import mavlink
from wire.framing import Framer

HEARTBEAT_US = 1_000_000
HEARS_US = 500_000
"""A vehicle that streams is not silent for longer."""
VEHICLE_SILENT_US = 3_000_000
BEFORE_FLIGHT = (Phase.CONNECTING, Phase.PREPARING, Phase.PLANNING, Phase.ENGAGING, Phase.ARMING)
"""Phases in which giving up costs nothing."""
START_SLACK = 3.0
"""How far from where its file says a vehicle may stand, where the mission's place on the earth is known [m]."""
ARMED_ELSEWHERE = "somebody else armed the vehicle: it is not taken over"
INTERRUPTED = (Phase.TAKING_OFF, Phase.REJOINING, Phase.LINK_LOST)
"""Phases after which the mission is flown (again): what is ordered meanwhile is kept."""
KEPT = ("hold", "goto", "return", "resume")
PLACED_HZ = {mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 5.0}
"""Where a mission, or a ground station's order, names places on the earth."""
CLIMBS = (mavlink.MAV_LANDED_STATE_TAKEOFF, mavlink.MAV_LANDED_STATE_IN_AIR)
DISARMED_SURE_US = 1_200_000
"""A HEARTBEAT that comes so long after the last word to arm says what became of it."""
DISARM_AGAIN_US = 2_000_000
GIVE_UP_US = 60_000_000
MOVING = AIRBORNE - {Phase.LANDING}
STREAM_BEFORE_ASKING_US = 500_000
"""PX4 wants a proof of life of setpoints before it accepts OFFBOARD."""
LISTEN_US = 500_000
"""Before a flight that goes by what is seen, movers are listened to for so long at least."""
HOME_PLAN_US = 30_000_000
"""So long a plan of the way home is waited for, the stop before it included."""
PACE_WAIT_US = 4_000_000
"""So long a ready vehicle is waited for until its pace has been measured."""
ESTIMATOR_FRESH_US = 2_000_000
"""What was said of the estimator before that is not held against it."""
POSITION_LATE_US = 60_000
POSITION_FRESH_US = 200_000
"""A way back begins where the vehicle is now, not where it was before it fell silent."""
TEXT_FRESH_US = 3_000_000
"""A warning of the vehicle's that is no older belongs to the mode it took."""


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
    sensor_links: tuple[str, ...] = ()  # of sensors that do not speak through the autopilot
    fleet_number: int = 0  # ours among several vehicles; 0: there are no others
    fleet_calls: int = 0  # links that call the others


class Companion:
    """One flight of one mission.

    Attributes
    ----------
    phase : where the flight is (`phases.Phase`).
    failure : why it is FAILED or HANDED_OVER, in one line; empty otherwise.
    link, telemetry, itinerary, clock, autopilot : for progress lines; read only.
    seeing, replanning, ground : plugged in by whoever builds the companion (`hooks`).
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
        self.clock = VehicleClock()
        self.safety = Safety()
        self.rejoin = Rejoin(mission, config.seed)
        self.seeing: Seeing = NothingSeen()
        self.replanning: Replanning = NothingReplanned()
        self.ground: Ground = NobodyAsks()
        self.lookout: Lookout | None = None
        if config.ground_links:
            known = (lambda: self.link.target), self.locate
            self.ground = GroundStation(*known, mission.ground_plan, self._course, config.ground_links)
        self.setpoints = SetpointStream(mission)
        self.router = Router(config.ground_links)
        self._sensed = Framer()
        self.fleet: Member | None = None
        if mission.senses() or config.fleet_number:
            sight = Sight(mission)
            if config.fleet_number:
                self.fleet = Member(config.fleet_number, mission, sight.tracks, config.fleet_calls)
            self.seeing, self.replanning = sight, Replanned(mission, self.itinerary, sight, config.seed)
            self.lookout = Lookout(mission, self.itinerary, sight)
        self._started_us: int | None = None
        self._last_us: int | None = None  # of the tick before
        self._flight_us = 0
        self._entered_us = 0
        self._streaming_us = 0
        self._heartbeat_due_us = 0
        self._boots = 1
        self._asking = Asking()
        self._mode_before = 0  # when the phase began
        self._held: Reference | None = None  # where a landing begins that comes from no path
        self._streams = Streams()
        self._preparation: Preparation | None = None  # of the vehicle that was heard last
        self._land_asked = False
        self._given_back = False
        self._plan_refusal = ""
        self._came_down = False
        self._going_home = False  # by the autopilot's own return
        self._landed_instead = False  # of that
        self._returning_us: int | None = None  # since when, on a planned way
        self._no_way_home = ""
        self._disarm_asked_us = 0
        self._drifts = 0  # that the setpoints have followed
        self._kept: Order | None = None  # until the mission is flown again
        takeoff = mission.steps[0].takeoff
        self._climb_s = 0.0 if takeoff is None else 2.0 * takeoff.altitude / mission.limits.climb
        self._holding = ""
        self._crossing = ""
        self._warned: tuple[int, str] | None = None  # when, what: the vehicle's last warning

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

    @property
    def over(self) -> bool:
        """Whether the companion has nothing more to do."""
        return self.phase in OVER

    def pose(self, flight_us: int) -> Pose:
        """Where the vehicle says it is, in the mission frame."""
        t = self.telemetry
        return Pose(flight_us, t.position_n - self.origin_n, t.velocity_n, t.roll, t.pitch, t.yaw)

    def locate(
        self, latitude: float, longitude: float, altitude: float, above_home: bool
    ) -> tuple[float, float, float] | None:
        """North, east and altitude [m] in the mission frame of a place on the earth [deg, m]; None before it is known.

        From where the vehicle says it is in both frames. Altitudes above home count from where the flight began.
        """
        t = self.telemetry
        if t.global_e7 is None or self.phase in BEFORE_FLIGHT:
            return None
        here, above_sea = t.position_n - self.origin_n, t.global_e7[2] * 1e-3
        north, east = to_local(Geodetic(t.global_e7[0] * 1e-7, t.global_e7[1] * 1e-7), latitude, longitude)
        high = altitude if above_home else altitude - above_sea - float(here[2])
        return float(here[0]) + north, float(here[1]) + east, high

    def _course(self) -> Course:
        """How far the flight is, for ground stations."""
        held = self.itinerary.holding or bool(self.safety.hold) or self.phase is Phase.REJOINING
        walked = self.itinerary
        return Course(self.phase, walked.index, held, whole=not walked.cut_short, skipped=walked.skipped)

    def _carried_on(self, now_us: int) -> Pose:
        """The pose, carried on at its velocity when it is late: what was said before a silence is no drift."""
        pose, age_us = self.pose(self._flight_us), now_us - (self.telemetry.position_us or now_us)
        if age_us <= POSITION_LATE_US:
            return pose
        return replace(pose, position_m=pose.position_m + pose.velocity_m * (age_us * 1e-6))

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

    def obey(self, now_us: int, order: Order) -> str:
        """Carry out an order: why it cannot be done, or nothing."""
        name, phase = order.name, self.phase
        if name == "land" and phase is Phase.HANDED_OVER and order.source:
            return "somebody else flies the vehicle: it is not landed from here"
        if name == "land" or (name == "abort" and phase in (*BEFORE_FLIGHT, *INTERRUPTED)):
            self._land_asked = True
            return ""
        if name == "resume" and phase is Phase.HANDED_OVER:
            if self.telemetry.landed_state == mavlink.MAV_LANDED_STATE_ON_GROUND:
                return "the vehicle stands on the ground"
            self._given_back = True
            return ""
        if phase in INTERRUPTED and name in KEPT:
            return self._keep(order)
        if phase is not Phase.FLYING:
            return f"not while {phase.value}"
        if self._returning_us is not None and name != "abort":
            return "it returns, since the battery is low"
        return self.itinerary.order(self._flight_us, order)

    def _keep(self, order: Order) -> str:
        """Carry it out once the mission is flown (again); the newest counts, and `resume` takes it back."""
        if order.name == "resume" and self._kept is None:
            return "nothing is held"
        self._kept = None if order.name == "resume" else order
        return ""

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

    def _lost_on_the_ground(self, now_us: int, out: list[Output]) -> Event | None:
        """Nothing has left the ground: a vehicle that is gone, or has booted again, is waited for."""
        if self.link.heard_us is not None and now_us - self.link.heard_us > VEHICLE_SILENT_US:
            silence = f"nothing heard from the vehicle for {(now_us - self.link.heard_us) / 1e6:.1f} s"
            if self.phase is Phase.ARMING:
                self._blame(silence)
            else:
                out.append(Note(Level.WARNING, f"{silence}: waiting for it"))
            return Event.VEHICLE_SILENT
        booted = self.telemetry.boots != self._boots
        if booted or (self.phase is not Phase.PREPARING and self.autopilot.booting(self.telemetry)):
            out.append(Note(Level.WARNING, "the vehicle booted again"))
            return Event.REBOOTED
        return None

    def _watch(self, now_us: int) -> Watch:
        """What the safety table looks at."""
        t, autopilot, came_down = self.telemetry, self.autopilot, self._came_down
        on_ground = t.landed_state == mavlink.MAV_LANDED_STATE_ON_GROUND
        booting = autopilot.booting(t) and not t.armed and not on_ground
        comes_down = autopilot.comes_down(t)
        self._came_down = self.phase is Phase.LANDING and (comes_down or came_down)
        text = ""
        if self._warned is not None and now_us - self._warned[0] <= TEXT_FRESH_US:
            text = f" ({self._warned[1]})"
        return Watch(
            fence_m=self.setpoints.fence_m,
            phase=self.phase,
            phase_s=(now_us - self._entered_us) / 1e6,
            takeoff_s=self._climb_s,
            silent_s=(now_us - (self.link.heard_us or 0)) / 1e6,
            position_s=(now_us - (t.position_us or 0)) / 1e6,
            heartbeat_s=(now_us - (t.heartbeat_us or 0)) / 1e6,
            mode_s=(now_us - t.mode_told_us) / 1e6,
            estimator_s=(now_us - (t.estimator_us or 0)) / 1e6,
            held=self.safety.hold,
            tick_gap_s=(now_us - (self._last_us or now_us)) / 1e6,
            rebooted=t.boots != self._boots or booting,
            disarmed=not t.armed and (t.arming_is_sure or (on_ground and self.phase not in MOVING)),
            in_control=autopilot.in_control(t),
            mode_sure=t.mode_is_sure,
            mode=autopilot.mode_name(t),
            last_text=text,
            stream_lost=autopilot.lost_our_stream(t),
            failsafe=autopilot.failsafe(t),
            answers_s=0.0 if self._streams.answered_us is None else (now_us - self._streams.answered_us) / 1e6,
            comes_down=comes_down,
            came_down=came_down,
            on_ground=on_ground,
            mode_asked=self.phase in (Phase.REJOINING, Phase.LANDING)
            and self._asking.open
            and t.custom_mode == self._mode_before,  # a third mode is somebody else's
            estimator=autopilot.estimator_lost(t) if now_us - (t.estimator_us or 0) < ESTIMATOR_FRESH_US else "",
            rejected=tuple(t.rejected),
            error_m=self.setpoints.error_m(t.position_n - self.origin_n),
            battery=t.battery,
            blind=self.seeing.trouble(self._flight_us),
            returning=self._returning_us is not None,
            no_way_home=self._no_way_home,
            going_home=self._going_home,
            jump=self.setpoints.jump,
            no_way=self.replanning.trouble or ("" if self.lookout is None else self.lookout.trouble),
        )

    def _connecting(self, now_us: int, out: list[Output]) -> Event | None:
        if self.telemetry.heartbeat_us is not None:
            autopilot = AUTOPILOTS.get(self.telemetry.autopilot)
            if autopilot is None:
                known = " or ".join(f"{a.name} ({number})" for number, a in AUTOPILOTS.items())
                return self._refused(f"autopilot type {self.telemetry.autopilot} found, expected {known}")
            self.autopilot = autopilot
            return Event.VEHICLE_HEARD
        if now_us - self._entered_us > self.config.wait_vehicle_s * 1e6:
            return self._refused(f"no HEARTBEAT from a vehicle in {self.config.wait_vehicle_s:g} s")
        return None

    def _preparing(self, now_us: int, out: list[Output]) -> Event | None:
        if self.telemetry.armed and self.telemetry.arming_is_sure:
            return self._refused(ARMED_ELSEWHERE)
        preparation, waited_us = self._preparation, now_us - self._entered_us
        assert preparation is not None
        question = self._asking.question
        if question is not None and question.outcome is not Outcome.PENDING:
            told = preparation.over(question)
            out.extend([] if told is None else [told])
            self._asking.question = None
        nowhere = self.mission.origin is not None and self.telemetry.global_e7 is None
        blind = self.seeing.trouble(self._flight_us)
        also = (*(("no global position",) if nowhere else ()), *((blind,) if blind else ()))
        told = preparation.look(now_us, also)
        out.extend([] if told is None else [told])
        out.extend(self.link.pack(message) for message in preparation.reads(now_us, self.link.target))
        paced = self.clock.known or waited_us > PACE_WAIT_US
        if preparation.done(now_us) and self._asking.question is None and paced:
            return Event.READY
        if waited_us > self.config.wait_ready_s * 1e6:
            reasons = ", ".join(preparation.reasons)
            return self._refused(f"the vehicle is not ready after {waited_us / 1e6:.0f} s: {reasons}")
        return None

    def _planning(self, now_us: int, out: list[Output]) -> Event | None:
        if self.telemetry.armed:
            return self._refused(ARMED_ELSEWHERE)
        if self._plan_refusal:
            return self._refused(f"no plan: {self._plan_refusal}")
        if self.itinerary.planned():
            return Event.PLANS_READY
        if now_us - self._entered_us > self.config.wait_plan_s * 1e6:
            return self._refused(f"no plan after {self.config.wait_plan_s:g} s")
        return None

    def _engaging(self, now_us: int, out: list[Output]) -> Event | None:
        if self.telemetry.armed:
            return self._refused(ARMED_ELSEWHERE)
        if self.autopilot.in_control(self.telemetry):
            if self.mission.senses() and now_us - self._entered_us < LISTEN_US:
                return None  # not everything that moves has told where it is yet
            crossing = self.seeing.trouble(self._flight_us) or self.replanning.in_the_way(self._flight_us)
            if crossing and now_us - self._entered_us < self.config.wait_ready_s * 1e6:
                if not self._crossing:
                    out.append(Note(Level.INFO, f"waiting on the ground: {crossing}"))
                self._crossing = crossing
                return None
            return self._refused(f"the climb is never seen clear: {crossing}") if crossing else Event.MODE_CONFIRMED
        return Event.REFUSED if self._command_failed(now_us, self.autopilot.take_control) else None

    def _arming(self, now_us: int, out: list[Output]) -> Event | None:
        in_control = self.autopilot.in_control(self.telemetry)
        if self.telemetry.armed and in_control:
            return Event.ARMED
        if not in_control and self.telemetry.mode_is_sure:
            self.failure = f"the vehicle left {self.autopilot.offboard_mode} before it armed"
            return Event.MODE_LOST
        return Event.REFUSED if self._command_failed(now_us, self.autopilot.arm) else None

    def _disarming(self, now_us: int, out: list[Output]) -> Event | None:
        """Ask until it says that it is disarmed; it flies after all, or somebody has it: not that."""
        t, since_us = self.telemetry, now_us - self._entered_us
        if t.boots != self._boots:
            return Event.REBOOTED
        if t.armed and t.landed_state in CLIMBS and self.autopilot.in_control(t):
            return Event.AIRBORNE
        if not self.autopilot.in_control(t) and t.mode_is_sure and not self.autopilot.lost_our_stream(t):
            return Event.MODE_LOST
        if not t.armed and (t.heartbeat_us or 0) - self._entered_us >= DISARMED_SURE_US:
            return Event.DISARMED
        if since_us > GIVE_UP_US:
            self.failure += "; it did not say that it is disarmed"
            return Event.GIVEN_UP
        question = self._asking.question
        spent = question is not None and question.outcome is not Outcome.PENDING
        if question is None or (spent and now_us - self._disarm_asked_us >= DISARM_AGAIN_US):
            self._asking.question, self._disarm_asked_us = self.autopilot.disarm(), now_us
        return None

    def _taking_off(self, now_us: int, out: list[Output]) -> Event | None:
        climbing = self.telemetry.landed_state in CLIMBS
        if self.autopilot.takes_off_itself:
            if self.autopilot.airborne(self.telemetry):
                return Event.AIRBORNE
            question = self._asking.question
            repeat_refused = question is not None and question.sent > 1 and question.outcome is Outcome.REFUSED
            if climbing or repeat_refused:  # it climbs already, be the answer to the first one lost
                self._asking.question = None
            return Event.REFUSED if self._command_failed(now_us, None) else None
        self._heed_hold(out)
        self.itinerary.stopped = bool(self.safety.hold)
        at_the_top = self.itinerary.climb(self._flight_us)
        return Event.AIRBORNE if at_the_top and self.autopilot.airborne(self.telemetry) else None

    def _heed_hold(self, out: list[Output]) -> None:
        """Tell why the mission's clock has to stand, and that it runs again."""
        if self.safety.hold != self._holding:
            text = f"holding: {self.safety.hold}" if self.safety.hold else f"no longer holding: {self._holding}"
            self._holding = self.safety.hold
            out.append(Note(Level.WARNING, text))

    def _flying(self, now_us: int, out: list[Output]) -> Event | None:
        self._heed_hold(out)
        kept, self._kept = self._kept, None
        if kept is not None:
            reason = self.obey(now_us, kept)
            text = f"{kept.name}, as ordered before" + (f": {reason}" if reason else "")
            out.append(Note(Level.WARNING if reason else Level.INFO, text))
        if self._returning_us is not None and not self._no_way_home:
            late = not self.itinerary.under_way and now_us - self._returning_us > HOME_PLAN_US
            if not self.itinerary.homeward:
                self._no_way_home = self.itinerary.refused or "the order to return was taken back"
            elif late and not self.itinerary.finished():
                self._no_way_home = f"none in {HOME_PLAN_US / 1e6:g} s"
        self.itinerary.stopped = bool(self.safety.hold) or self.rejoin.under_way(self._flight_us)
        self.itinerary.heed(self.telemetry.battery)
        if self.itinerary.advance(self._flight_us):
            out.append(Note(Level.INFO, f"step {self.itinerary.index}: {self.itinerary.step.kind}"))
        out.extend(self.itinerary.take_said())
        if self.itinerary.cut_short:
            self._blame(self.itinerary.cut_short)
        ours = self.autopilot.in_control(self.telemetry)  # else whoever took the mode is not told to land
        if not (ours and self.itinerary.finished()):
            return None
        return Event.STEPS_DONE if self.lookout is None or self.lookout.may_land(self._flight_us) else None

    def _link_lost(self, now_us: int, out: list[Output]) -> Event | None:
        self.itinerary.advance(self._flight_us)  # to its stop
        return Event.VEHICLE_HEARD if now_us - (self.link.heard_us or 0) < VEHICLE_SILENT_US else None

    def _rejoining(self, now_us: int, out: list[Output]) -> Event | None:
        in_control = self.autopilot.in_control(self.telemetry)
        if in_control:
            self._asking.question = None  # the mode that was asked for: who changes it now means it
        heard = self.telemetry.position_us is not None and now_us - self.telemetry.position_us < POSITION_FRESH_US
        flies = self.autopilot.airborne(self.telemetry) or not self.autopilot.takes_off_itself
        self.itinerary.advance(self._flight_us)  # to its stop
        stands = self.rejoin.settle(self.pose(self._flight_us), in_control and heard and flies)
        target = self.itinerary.reference(self._flight_us)
        if stands and self._by_sight(target):  # planned anew from here, not in the world as it was told
            here = self.rejoin.hold(self.itinerary.yaw).position_m
            if not self.itinerary.leads_on(self._flight_us) and not self.itinerary.detour(self._flight_us, here):
                return None  # it still comes to rest
            self.itinerary.stopped = False
            if self.itinerary.flown(self._flight_us) is None:
                return None  # the mission's clock starts again
            self.replanning.lost()
            return Event.REJOINED
        wanted = self.rejoin.wanted(target) if stands else None
        out.extend([] if wanted is None else [wanted])
        if self.rejoin.refusal:
            self._blame(f"no way back to the mission: {self.rejoin.refusal}")
            return Event.LAND_ASKED
        if not in_control and self._command_failed(now_us, None):
            return Event.MODE_LOST
        return Event.REJOINED if self.rejoin.ready and in_control else None

    def _by_sight(self, target: Reference) -> bool:
        """Whether the way back to where the mission waits is planned by what is seen."""
        away_m = math.dist(self.rejoin.hold(self.itinerary.yaw).position_m, target.position_m)
        leg = self.itinerary.leads_on(self._flight_us)
        return isinstance(self.replanning, Replanned) and (leg or away_m >= SAME_PLACE)

    def _landing(self, now_us: int, out: list[Output]) -> Event | None:
        command, told = self._asking.question, now_us - (self.telemetry.heartbeat_us or 0) <= VEHICLE_SILENT_US
        shown = self.autopilot.lands(self.telemetry) if self._landed_instead else self._came_down
        late = self._asking.no_effect(now_us) and told and not shown  # untold it may be a pilot's
        if command is not None and (command.outcome in (Outcome.REFUSED, Outcome.UNANSWERED) or late):
            why = "accepted, but it does not land" if late else command.failure()
            out.append(Note(Level.ERROR, f"{why}; asking again"))
            self._asking.question = self._way_down()
        return None

    def _handed_over(self, now_us: int, out: list[Output]) -> Event | None:
        given_back, self._given_back = self._given_back, False
        return Event.GIVEN_BACK if given_back else None

    def _nothing(self, now_us: int, out: list[Output]) -> Event | None:
        return None

    def _blame(self, why: str) -> None:
        """Keep the reason; what follows from an earlier trouble does not replace it."""
        self.failure = self.failure or why

    def _refused(self, why: str) -> Event:
        self.failure = why
        return Event.REFUSED

    def _command_failed(self, now_us: int, again: Callable[[], Command] | None) -> bool:
        """Whether the command under way has come to nothing; `failure` then says how."""
        why = self._asking.failure(now_us, again)
        self.failure = why or self.failure
        return bool(why)

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

    def _enter(self, now_us: int, event: Event, out: list[Output]) -> None:
        match self.phase:
            case Phase.CONNECTING:
                self.telemetry.forget()
                self.telemetry.heartbeat_us = None
                self.clock.forget()
            case Phase.PREPARING:
                self._boots = self.telemetry.boots
                placed = self.mission.origin is not None or bool(self.config.ground_links)
                tables = (self.autopilot.streams_hz(), self.seeing.streams_hz(), PLACED_HZ if placed else {})
                self._streams = Streams(*tables)
                self._preparation = Preparation(self.autopilot, self.telemetry, now_us, self._streams)
                out.extend(self.link.pack(m) for m in self._preparation.reads(now_us, self.link.target))
            case Phase.PLANNING:
                misplaced = self._fix_frame()
                self.itinerary.yaw = self.telemetry.yaw
                self.seeing.begin()
                self._streaming_us = now_us
                out.extend(Note(Level.WARNING, text) for text in self.autopilot.warnings(self.telemetry))
                self._plan_refusal = misplaced or self.itinerary.obstruction()
                out.extend([] if self._plan_refusal else self.itinerary.wanted())
            case Phase.ARMING:
                self._asking.question = self.autopilot.arm()
            case Phase.TAKING_OFF:
                takeoff = self.mission.steps[0].takeoff
                self._asking.question = self.autopilot.takeoff(takeoff.altitude) if takeoff is not None else None
                if not self.autopilot.takes_off_itself:
                    self.itinerary.begin(self._flight_us)
            case Phase.FLYING if event is Event.AIRBORNE:
                self.itinerary.airborne(self._flight_us)
                out.append(Note(Level.INFO, f"step {self.itinerary.index}: {self.itinerary.step.kind}"))
            case Phase.FLYING:
                self.rejoin.go(self._flight_us)
            case Phase.LINK_LOST:
                self.itinerary.stopped = True
            case Phase.REJOINING:
                self.itinerary.stopped = True
                if self.autopilot.takes_off_itself and self.itinerary.index == 0:
                    self.itinerary.airborne(self._flight_us)
                if event is Event.GIVEN_BACK:
                    self.failure = ""
                    self._asking.question = self.autopilot.take_control()
                self.rejoin.begin(self.pose(self._flight_us))
            case Phase.HANDED_OVER:
                self._kept = None
            case Phase.LANDING:
                self._came_down = self._landed_instead = False
                self._asking.question = self._way_down()

    def _fix_frame(self) -> str:
        """Fix the mission frame in the vehicle's local frame: why it cannot stand where it does, or nothing."""
        start, origin = np.array(self.mission.start_m()), self.mission.geodetic_origin()
        away = 0.0
        if origin is not None and self.telemetry.global_e7 is not None:
            latitude, longitude, _ = self.telemetry.global_e7
            stands = np.array([*to_local(origin, latitude * 1e-7, longitude * 1e-7), 0.0])
            away = float(np.linalg.norm(stands - start))
            self.itinerary.stand(stands)
        self.origin_n = self.telemetry.position_n - self.itinerary.start_m
        if away <= START_SLACK or self.mission.vehicle.start.anywhere:
            return ""
        return f"the vehicle stands {away:.1f} m from vehicle.start, expected within {START_SLACK:g} m"

    def _way_down(self) -> Command:
        return self.autopilot.go_home() if self._going_home else self.autopilot.land()

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
