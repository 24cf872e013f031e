"""What is watched for in each phase in the air, beside what the safety table names; and orders."""

import math

from companion.commands import Outcome
from companion.flightstate import BEFORE_FLIGHT, CLIMBS, VEHICLE_SILENT_US, FlightState
from companion.phases import Event, Phase
from companion.rejoin import SAME_PLACE
from companion.replanning import Replanning as Replanned
from companion.seam import Level, Note, Order, Output, Reference
from wire.dialect import mavlink

INTERRUPTED = (Phase.TAKING_OFF, Phase.REJOINING, Phase.LINK_LOST)
"""Phases after which the mission is flown (again): what is ordered meanwhile is kept."""
KEPT = ("hold", "goto", "return", "resume")
HOME_PLAN_US = 30_000_000
"""So long a plan of the way home is waited for, the stop before it included."""
POSITION_FRESH_US = 200_000
"""A way back begins where the vehicle is now, not where it was before it fell silent."""


class InFlight(FlightState):
    """One method a phase: the event of this tick, if there is one; and `obey`."""

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
