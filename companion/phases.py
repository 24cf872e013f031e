"""Flight phases, as a table.

Theory of operation
-------------------
A flight is in exactly one phase. Each tick `Companion.step` looks at the telemetry, the plans and the operator and
names at most one event; `TRANSITIONS[phase, event]` is the next phase, and a pair that is not in the table changes
nothing. What is *done* in a phase (which command is repeated, which reference is flown) is in `core.py`, and what
counts as trouble in `safety.py`; this file does not know.

    CONNECTING --vehicle heard--> PREPARING --ready--> PLANNING --plans ready--> ENGAGING --mode confirmed--> ARMING
    ARMING --armed--> TAKING_OFF --airborne--> FLYING --steps done--> LANDING --disarmed--> DONE

Before the takeoff nothing has left the ground: a refusal ends in FAILED (by DISARMING, if it may have armed), and a
vehicle that falls silent or boots again is waited for in CONNECTING. In the air the only way out is down: an operator
who asks to land gets a landing, and so does a vehicle that the safety table no longer trusts. A vehicle that falls
silent in the air is LINK_LOST: we go on speaking to it. Whoever must fly on from where the vehicle happens to be (after
a silence, a lost setpoint stream, a stalled companion, a pilot who gives it back) is REJOINING: it holds there until
there is a proved way back to the mission. A pilot or a failsafe who takes the mode is never fought (HANDED_OVER: we
look on, forward and record until the vehicle disarms). A vehicle that boots again in the air is FAILED: nothing is sent
to it any more.
"""

from enum import Enum


class Phase(Enum):
    CONNECTING = "connecting"  # no HEARTBEAT yet, or not any more
    PREPARING = "preparing"  # streams and parameters asked for; waiting until the vehicle says it could arm
    PLANNING = "planning"  # every leg is planned before anything moves
    ENGAGING = "engaging"  # asking for the mode that obeys our setpoints
    ARMING = "arming"
    DISARMING = "disarming"  # called off while it may have armed: told so until it says that it is disarmed
    TAKING_OFF = "taking off"  # by setpoints or by the vehicle itself
    FLYING = "flying"  # the mission's steps after the takeoff
    LINK_LOST = "link lost"  # nothing is heard in the air
    REJOINING = "rejoining"  # heard again: holding where it is until there is a way back
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
    AIRBORNE = "airborne"
    STEPS_DONE = "steps done"
    DISARMED = "disarmed"
    REFUSED = "refused"  # a command denied, no plan, or a time-out on the ground
    LAND_ASKED = "land asked"  # by the operator, or by the safety table
    HOME_ASKED = "home asked"  # by the safety table: to be flown on a planned way
    INTERRUPTED = "interrupted"  # our setpoints did not reach it, or it stands elsewhere than they say
    REJOINED = "rejoined"
    MODE_LOST = "mode lost"  # the vehicle left our mode and we did not ask for it
    GIVEN_BACK = "given back"  # the operator asks to go on after a hand-over
    VEHICLE_SILENT = "vehicle silent"
    REBOOTED = "rebooted"
    GIVEN_UP = "given up"  # silent for too long


_ON_THE_GROUND = (Phase.PREPARING, Phase.PLANNING, Phase.ENGAGING, Phase.ARMING)
_IN_THE_AIR = (Phase.TAKING_OFF, Phase.FLYING, Phase.REJOINING)

TRANSITIONS: dict[tuple[Phase, Event], Phase] = {
    (Phase.CONNECTING, Event.VEHICLE_HEARD): Phase.PREPARING,
    (Phase.CONNECTING, Event.REFUSED): Phase.FAILED,
    (Phase.CONNECTING, Event.LAND_ASKED): Phase.FAILED,
    (Phase.PREPARING, Event.READY): Phase.PLANNING,
    (Phase.PLANNING, Event.PLANS_READY): Phase.ENGAGING,
    (Phase.ENGAGING, Event.MODE_CONFIRMED): Phase.ARMING,
    (Phase.ARMING, Event.ARMED): Phase.TAKING_OFF,
    (Phase.ARMING, Event.MODE_LOST): Phase.FAILED,
    **{(phase, Event.REFUSED): Phase.FAILED for phase in _ON_THE_GROUND},
    **{(phase, Event.LAND_ASKED): Phase.FAILED for phase in _ON_THE_GROUND},
    (Phase.ARMING, Event.REFUSED): Phase.DISARMING,  # its word may come late, or not reach us
    (Phase.ARMING, Event.LAND_ASKED): Phase.DISARMING,
    **{(phase, Event.VEHICLE_SILENT): Phase.CONNECTING for phase in _ON_THE_GROUND},
    **{(phase, Event.REBOOTED): Phase.CONNECTING for phase in _ON_THE_GROUND},
    (Phase.ARMING, Event.VEHICLE_SILENT): Phase.DISARMING,  # it may have armed: not to be begun anew
    (Phase.DISARMING, Event.DISARMED): Phase.FAILED,
    (Phase.DISARMING, Event.MODE_LOST): Phase.FAILED,  # whoever took it has it
    (Phase.DISARMING, Event.REBOOTED): Phase.FAILED,
    (Phase.DISARMING, Event.GIVEN_UP): Phase.FAILED,
    (Phase.DISARMING, Event.AIRBORNE): Phase.LANDING,  # it flies after all
    (Phase.TAKING_OFF, Event.AIRBORNE): Phase.FLYING,
    (Phase.TAKING_OFF, Event.REFUSED): Phase.DISARMING,
    (Phase.FLYING, Event.STEPS_DONE): Phase.LANDING,
    (Phase.FLYING, Event.HOME_ASKED): Phase.FLYING,  # the itinerary knows the way
    (Phase.LANDING, Event.LAND_ASKED): Phase.LANDING,  # here, instead of where it was about to
    **{(phase, Event.LAND_ASKED): Phase.LANDING for phase in (*_IN_THE_AIR, Phase.LINK_LOST)},
    **{(phase, Event.MODE_LOST): Phase.HANDED_OVER for phase in (*_IN_THE_AIR, Phase.LINK_LOST)},
    **{(phase, Event.DISARMED): Phase.FAILED for phase in (*_IN_THE_AIR, Phase.LINK_LOST)},
    **{(phase, Event.REBOOTED): Phase.FAILED for phase in (*_IN_THE_AIR, Phase.LINK_LOST)},
    **{(phase, Event.VEHICLE_SILENT): Phase.LINK_LOST for phase in _IN_THE_AIR},
    (Phase.TAKING_OFF, Event.INTERRUPTED): Phase.REJOINING,
    (Phase.FLYING, Event.INTERRUPTED): Phase.REJOINING,
    (Phase.LINK_LOST, Event.VEHICLE_HEARD): Phase.REJOINING,
    (Phase.LINK_LOST, Event.GIVEN_UP): Phase.FAILED,
    (Phase.REJOINING, Event.REJOINED): Phase.FLYING,
    (Phase.LANDING, Event.DISARMED): Phase.DONE,
    (Phase.LANDING, Event.MODE_LOST): Phase.HANDED_OVER,
    (Phase.LANDING, Event.REBOOTED): Phase.FAILED,
    (Phase.LANDING, Event.GIVEN_UP): Phase.FAILED,
    (Phase.HANDED_OVER, Event.DISARMED): Phase.FAILED,
    (Phase.HANDED_OVER, Event.GIVEN_UP): Phase.FAILED,
    (Phase.HANDED_OVER, Event.REBOOTED): Phase.FAILED,
    (Phase.HANDED_OVER, Event.LAND_ASKED): Phase.FAILED,
    (Phase.HANDED_OVER, Event.GIVEN_BACK): Phase.REJOINING,
}

STREAMING = frozenset(
    {
        Phase.PLANNING,
        Phase.ENGAGING,
        Phase.ARMING,
        Phase.DISARMING,
        Phase.TAKING_OFF,
        Phase.FLYING,
        Phase.LINK_LOST,
        Phase.REJOINING,
        Phase.LANDING,
    }
)
"""Phases in which a setpoint leaves every tick, as far as the autopilot takes setpoints in them."""

AIRBORNE = frozenset({Phase.TAKING_OFF, Phase.FLYING, Phase.LINK_LOST, Phase.REJOINING, Phase.LANDING})
"""Phases in which we fly the vehicle, and it is armed."""

OVER = frozenset({Phase.DONE, Phase.FAILED})
"""Phases in which the companion has nothing more to do."""


def after(phase: Phase, event: Event) -> Phase:
    """The phase that follows; the same one where the table names no other."""
    return TRANSITIONS.get((phase, event), phase)
