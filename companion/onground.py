"""What is watched for in each phase before the takeoff."""

from companion.autopilots import AUTOPILOTS
from companion.commands import Outcome
from companion.flightstate import CLIMBS, VEHICLE_SILENT_US, FlightState
from companion.phases import Event, Phase
from companion.seam import Level, Note, Output

ARMED_ELSEWHERE = "somebody else armed the vehicle: it is not taken over"
LISTEN_US = 500_000
"""Before a flight that goes by what is seen, movers are listened to for so long at least."""
PACE_WAIT_US = 4_000_000
"""So long a ready vehicle is waited for until its pace has been measured."""
DISARMED_SURE_US = 1_200_000
"""A HEARTBEAT that comes so long after the last word to arm says what became of it."""
DISARM_AGAIN_US = 2_000_000
GIVE_UP_US = 60_000_000


class OnTheGround(FlightState):
    """One method a phase: the event of this tick, if there is one."""

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
