"""What a flight is made of, and what is remembered of it from one tick to the next."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from companion.asking import Asking
from companion.autopilots.base import Autopilot
from companion.autopilots.px4 import Px4
from companion.commands import Command
from companion.fleet.member import Member
from companion.geodesy import Geodetic, to_local
from companion.ground.progress import Course
from companion.ground.router import Router
from companion.ground.station import GroundStation
from companion.hooks import Ground, NobodyAsks, NothingReplanned, NothingSeen, Pose, Replanning, Seeing
from companion.itinerary import Itinerary
from companion.lookout import Lookout
from companion.mission import Mission
from companion.phases import OVER, Event, Phase
from companion.preparation import Preparation
from companion.rejoin import Rejoin
from companion.replanning import Replanning as Replanned
from companion.safety import Safety
from companion.seam import Order, Reference
from companion.seeing.sight import Sight
from companion.setpoints import SetpointStream
from companion.streams import Streams
from companion.telemetry import Telemetry
from companion.vehicleclock import VehicleClock
from companion.vehiclelink import VehicleLink
from wire.dialect import mavlink
from wire.framing import Framer

BEFORE_FLIGHT = (Phase.CONNECTING, Phase.PREPARING, Phase.PLANNING, Phase.ENGAGING, Phase.ARMING)
"""Phases in which giving up costs nothing."""
VEHICLE_SILENT_US = 3_000_000
CLIMBS = (mavlink.MAV_LANDED_STATE_TAKEOFF, mavlink.MAV_LANDED_STATE_IN_AIR)
POSITION_LATE_US = 60_000


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


class FlightState:
    """All that the core knows between two ticks: what each of its parts is, and a few words they share.

    Attributes
    ----------
    phase : where the flight is (`phases.Phase`).
    failure : why it is FAILED or HANDED_OVER, in one line; empty otherwise.
    link, telemetry, itinerary, clock, autopilot : for progress lines; read only.
    seeing, replanning, ground : plugged in by whoever builds the companion (`hooks`).
    """

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

    def _way_down(self) -> Command:
        return self.autopilot.go_home() if self._going_home else self.autopilot.land()
