"""Flight phases, as a table.

Theory of operation
-------------------
A flight is in exactly one phase. Each tick `Companion.step` looks at the telemetry, the plans and the operator and
names at most one event; `TRANSITIONS[phase, event]` is the next phase, and a pair that is not in the table changes
nothing. What is *done* in a phase (which command is repeated, which reference is flown) is in `core.py`; this file does
not know.

    CONNECTING --vehicle heard--> PREPARING --ready--> PLANNING --plans ready--> ENGAGING --mode confirmed--> ARMING
    ARMING --armed--> FLYING --steps done--> LANDING --disarmed--> DONE

From PLANNING on setpoints are streamed; before FLYING nothing has left the ground, so a refusal ends in FAILED. In the
air the only way out is down: an operator who asks to land gets a landing, and so does a vehicle that strays from its
reference. Two things end a flight without landing it: a pilot (or a failsafe) who takes the mode is never fought
(HANDED_OVER: we look on, forward and record until the vehicle disarms), and a vehicle that falls silent cannot be
helped (FAILED).
"""

from enum import Enum


class Phase(Enum):
    CONNECTING = "connecting"  # no HEARTBEAT yet
    PREPARING = "preparing"  # streams and parameters asked for; waiting until the vehicle says it could arm
    PLANNING = "planning"  # every leg is planned before anything moves; setpoints hold the place on the ground
    ENGAGING = "engaging"  # asking for the mode that obeys them
    ARMING = "arming"
    FLYING = "flying"  # the mission's steps, takeoff included
    LANDING = "landing"
    DONE = "done"  # landed and disarmed as planned
    FAILED = "failed"
    HANDED_OVER = "handed over"  # somebody else flies; we look on until it is over


class Event(Enum):
    VEHICLE_HEARD = "vehicle heard"
    READY = "ready"
    PLANS_READY = "plans ready"
    MODE_CONFIRMED = "mode confirmed"
    ARMED = "armed"
    STEPS_DONE = "steps done"
    DISARMED = "disarmed"
    REFUSED = "refused"  # a command denied, no plan, or a time-out on the ground
    LAND_ASKED = "land asked"  # by the operator
    ASTRAY = "astray"  # too far from the reference for too long, or the position is gone
    MODE_LOST = "mode lost"  # the vehicle left our mode and we did not ask for it
    VEHICLE_SILENT = "vehicle silent"


TRANSITIONS: dict[tuple[Phase, Event], Phase] = {
    (Phase.CONNECTING, Event.VEHICLE_HEARD): Phase.PREPARING,
    (Phase.CONNECTING, Event.REFUSED): Phase.FAILED,
    (Phase.CONNECTING, Event.LAND_ASKED): Phase.FAILED,
    (Phase.PREPARING, Event.READY): Phase.PLANNING,
    (Phase.PREPARING, Event.REFUSED): Phase.FAILED,
    (Phase.PREPARING, Event.LAND_ASKED): Phase.FAILED,
    (Phase.PREPARING, Event.VEHICLE_SILENT): Phase.FAILED,
    (Phase.PLANNING, Event.PLANS_READY): Phase.ENGAGING,
    (Phase.PLANNING, Event.REFUSED): Phase.FAILED,
    (Phase.PLANNING, Event.LAND_ASKED): Phase.FAILED,
    (Phase.PLANNING, Event.VEHICLE_SILENT): Phase.FAILED,
    (Phase.ENGAGING, Event.MODE_CONFIRMED): Phase.ARMING,
    (Phase.ENGAGING, Event.REFUSED): Phase.FAILED,
    (Phase.ENGAGING, Event.LAND_ASKED): Phase.FAILED,
    (Phase.ENGAGING, Event.VEHICLE_SILENT): Phase.FAILED,
    (Phase.ARMING, Event.ARMED): Phase.FLYING,
    (Phase.ARMING, Event.REFUSED): Phase.FAILED,
    (Phase.ARMING, Event.LAND_ASKED): Phase.FAILED,
    (Phase.ARMING, Event.MODE_LOST): Phase.FAILED,
    (Phase.ARMING, Event.VEHICLE_SILENT): Phase.FAILED,
    (Phase.FLYING, Event.STEPS_DONE): Phase.LANDING,
    (Phase.FLYING, Event.LAND_ASKED): Phase.LANDING,
    (Phase.FLYING, Event.ASTRAY): Phase.LANDING,
    (Phase.FLYING, Event.MODE_LOST): Phase.HANDED_OVER,
    (Phase.FLYING, Event.DISARMED): Phase.FAILED,
    (Phase.FLYING, Event.VEHICLE_SILENT): Phase.FAILED,
    (Phase.LANDING, Event.DISARMED): Phase.DONE,
    (Phase.LANDING, Event.MODE_LOST): Phase.HANDED_OVER,
    (Phase.LANDING, Event.VEHICLE_SILENT): Phase.FAILED,
    (Phase.HANDED_OVER, Event.DISARMED): Phase.FAILED,
    (Phase.HANDED_OVER, Event.VEHICLE_SILENT): Phase.FAILED,
    (Phase.HANDED_OVER, Event.LAND_ASKED): Phase.FAILED,
}

STREAMING = frozenset({Phase.PLANNING, Phase.ENGAGING, Phase.ARMING, Phase.FLYING, Phase.LANDING})
"""Phases in which a setpoint leaves every tick (in LANDING until the vehicle confirms that it lands by itself)."""

OVER = frozenset({Phase.DONE, Phase.FAILED})
"""Phases in which the companion has nothing more to do."""


def after(phase: Phase, event: Event) -> Phase:
    """The phase that follows; the same one where the table names no other."""
    return TRANSITIONS.get((phase, event), phase)
