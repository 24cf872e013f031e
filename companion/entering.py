"""What entering a phase asks for."""

import numpy as np

from companion.flightstate import FlightState
from companion.geodesy import to_local
from companion.phases import Event, Phase
from companion.preparation import Preparation
from companion.seam import Level, Note, Output
from companion.streams import Streams
from wire.dialect import mavlink

START_SLACK = 3.0
"""How far from where its file says a vehicle may stand, where the mission's place on the earth is known [m]."""
PLACED_HZ = {mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 5.0}
"""Where a mission, or a ground station's order, names places on the earth."""


class Entering(FlightState):
    """Begins phases."""

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
