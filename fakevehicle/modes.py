"""Flight modes and what may change them, as two tables.

Theory of operation
-------------------
The vehicle is in one `Mode`. Things happen to it, each an `Event`: somebody asks for a mode, to arm or to disarm; or
the vehicle itself notices something (the takeoff height is reached, a failsafe wants it on the ground). Two tables say
what follows, and nothing else decides:

- `GUARDS[event]`: conditions that must hold, in order; the first one that does not refuses the event with its reason.
- `TRANSITIONS[event][mode]`: the mode afterwards, or one of the `Special` outcomes: STAY (nothing changes), DENY (the
  event is refused in this mode), RESUME (back to OFFBOARD, if it was a lost stream that led here).

An event that is refused changes nothing. What a failsafe wants is an event too (`failsafes.py` says which): the table
never lets one undo what a more severe one began. Rule 1: this file knows no MAVLink message; which number stands for
which mode is the flavours' business. Rule 2: it keeps no state; `supervisor.py` does.

Where we follow PX4 v1.16 and where we are kinder
-------------------------------------------------
- OFFBOARD is accepted after one setpoint (MAVSDK asks 7 ms after its first). While disarmed it is accepted without
  any, as PX4 does; arming then waits for the stream.
- A lost stream (COM_OF_LOSS_T) leads to COM_OBL_RC_ACT; setpoints that return bring OFFBOARD back by themselves while
  the vehicle still flies, as PX4 was measured to do. Any mode asked for in between ends that.
- After a landing in LAND, RTL, TAKEOFF or MISSION the mode becomes Hold. PX4 would go back to the mode before, often
  OFFBOARD, in which nobody can arm without a stream.
- Modes that need sticks (POSITION, ALTITUDE, STABILIZED) fly as Hold without them. PX4 would sink at 0.7 m/s.
- AUTO.READY is flown and shown as Hold.

GUIDED and BRAKE are ArduPilot's. GUIDED takes off, flies setpoints and goes to places in one mode and never fails for
want of a stream; BRAKE is a Hold under its own name.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum


class Mode(Enum):
    """A flight mode; the value is what people call it."""

    HOLD = "Hold"
    POSITION = "Position"
    ALTITUDE = "Altitude"
    STABILIZED = "Stabilized"
    BRAKE = "Brake"
    GUIDED = "Guided"
    TAKEOFF = "Takeoff"
    LAND = "Land"
    RTL = "RTL"
    MISSION = "Mission"
    OFFBOARD = "Offboard"

    @property
    def title(self) -> str:
        """What people call it."""
        return self.value


class Event(Enum):
    """What can happen. The first group is asked for by peers, the second is noticed by the vehicle."""

    ASK_HOLD = "hold"
    ASK_POSITION = "position mode"
    ASK_ALTITUDE = "altitude mode"
    ASK_STABILIZED = "stabilized mode"
    ASK_BRAKE = "brake"
    ASK_GUIDED = "guided mode"
    ASK_TAKEOFF = "takeoff"
    ASK_LAND = "land"
    ASK_RTL = "return"
    ASK_MISSION = "mission"
    ASK_OFFBOARD = "offboard"
    ASK_GOTO = "goto"
    ASK_ARM = "arm"
    ASK_DISARM = "disarm"
    ASK_KILL = "kill"

    TAKEOFF_DONE = "takeoff height reached"
    MISSION_DONE = "mission finished"
    MISSION_RTL = "mission returns"
    STREAM_BACK = "setpoints returned"
    FAIL_HOLD = "failsafe holds"
    FAIL_RTL = "failsafe returns"
    FAIL_LAND = "failsafe lands"
    DISARMED = "motors stopped"


class Special(Enum):
    """Outcomes that are not simply a mode; see the theory of operation."""

    STAY = "stay"
    DENY = "deny"
    RESUME = "resume"


class Refusal(Enum):
    """Every reason for which something that was asked for is not done; the value tells it to people.

    The first group comes from the guards below, the second from what a command asks for. Which MAV_RESULT stands for
    which is a matter of the autopilot's flavour.
    """

    NO_ATTITUDE = "attitude not known yet"
    NO_VELOCITY = "velocity not known yet"
    NO_POSITION = "position not known yet"
    NO_ALTITUDE = "altitude not known yet"
    NO_HOME = "home not known yet"
    NO_MISSION = "no mission is loaded"
    NO_STREAM = "no setpoints are arriving"
    NO_OFFBOARD_STREAM = "no offboard setpoints"
    NOT_ARMED = "not armed"
    NOT_FLYING = "not flying"
    NOT_LANDED = "not landed"
    NOT_ARMABLE_MODE = "ask for Hold first"
    BATTERY_LOW = "battery too low"
    OUTSIDE_FENCE = "outside the fence"
    LEANING = "leaning too far"
    MISSION_TOO_FAR = "a place of the mission is too far away"
    BELOW = "that altitude is below the vehicle"


Outcome = Mode | Special

_STAY, _DENY, _RESUME = Special.STAY, Special.DENY, Special.RESUME


def _but(usual: Outcome, exceptions: Mapping[Mode, Outcome] | None = None) -> Mapping[Mode, Outcome]:
    """One row: the usual outcome, and the modes in which it is another."""
    return {mode: (exceptions or {}).get(mode, usual) for mode in Mode}


TRANSITIONS: Mapping[Event, Mapping[Mode, Outcome]] = {
    Event.ASK_HOLD: _but(Mode.HOLD),
    Event.ASK_POSITION: _but(Mode.POSITION),
    Event.ASK_ALTITUDE: _but(Mode.ALTITUDE),
    Event.ASK_STABILIZED: _but(Mode.STABILIZED),
    Event.ASK_BRAKE: _but(Mode.BRAKE),
    Event.ASK_GUIDED: _but(Mode.GUIDED),
    Event.ASK_TAKEOFF: _but(Mode.TAKEOFF, {Mode.GUIDED: Mode.GUIDED}),
    Event.ASK_LAND: _but(Mode.LAND),
    Event.ASK_RTL: _but(Mode.RTL),
    Event.ASK_MISSION: _but(Mode.MISSION),
    Event.ASK_OFFBOARD: _but(Mode.OFFBOARD),
    Event.ASK_GOTO: _but(Mode.HOLD, {Mode.GUIDED: Mode.GUIDED}),
    Event.ASK_ARM: _but(_STAY, {Mode.LAND: _DENY, Mode.RTL: _DENY}),
    Event.ASK_DISARM: _but(_STAY),
    Event.ASK_KILL: _but(_STAY),
    Event.TAKEOFF_DONE: _but(_STAY, {Mode.TAKEOFF: Mode.HOLD}),
    Event.MISSION_DONE: _but(_STAY, {Mode.MISSION: Mode.HOLD}),
    Event.MISSION_RTL: _but(_STAY, {Mode.MISSION: Mode.RTL}),
    Event.STREAM_BACK: _but(_STAY, {Mode.HOLD: _RESUME, Mode.LAND: _RESUME, Mode.RTL: _RESUME}),
    Event.FAIL_HOLD: _but(Mode.HOLD, {Mode.LAND: _STAY, Mode.RTL: _STAY, Mode.HOLD: _STAY}),
    Event.FAIL_RTL: _but(Mode.RTL, {Mode.LAND: _STAY, Mode.RTL: _STAY}),
    Event.FAIL_LAND: _but(Mode.LAND, {Mode.LAND: _STAY}),
    Event.DISARMED: _but(
        _STAY, {Mode.TAKEOFF: Mode.HOLD, Mode.LAND: Mode.HOLD, Mode.RTL: Mode.HOLD, Mode.MISSION: Mode.HOLD}
    ),
}


@dataclass(frozen=True, slots=True)
class Conditions:
    """What the guards look at, all from the vehicle's own estimate."""

    armed: bool
    airborne: bool
    attitude_valid: bool
    velocity_valid: bool
    position_valid: bool
    altitude_valid: bool
    home_known: bool
    setpoints_fresh: bool
    mode: Mode
    mission_loaded: bool = False
    battery_good: bool = True
    fence_kept: bool = True
    upright: bool = True


@dataclass(frozen=True, slots=True)
class Guard:
    """A condition and what to tell people when it does not hold."""

    holds: Callable[[Conditions], bool]
    reason: Refusal


_ATTITUDE = Guard(lambda c: c.attitude_valid, Refusal.NO_ATTITUDE)
_VELOCITY = Guard(lambda c: c.velocity_valid, Refusal.NO_VELOCITY)
_POSITION = Guard(lambda c: c.position_valid, Refusal.NO_POSITION)
_ALTITUDE = Guard(lambda c: c.altitude_valid, Refusal.NO_ALTITUDE)
_HOME = Guard(lambda c: c.home_known, Refusal.NO_HOME)
_FLYING = Guard(lambda c: c.armed and c.airborne, Refusal.NOT_FLYING)
_STREAM_IF_ARMED = Guard(lambda c: c.setpoints_fresh or not c.armed, Refusal.NO_STREAM)
_STREAM_IN_OFFBOARD = Guard(lambda c: c.setpoints_fresh or c.mode is not Mode.OFFBOARD, Refusal.NO_OFFBOARD_STREAM)
_LANDED = Guard(lambda c: not (c.armed and c.airborne), Refusal.NOT_LANDED)
_MISSION = Guard(lambda c: c.mission_loaded, Refusal.NO_MISSION)
_MISSION_IN_MISSION = Guard(lambda c: c.mission_loaded or c.mode is not Mode.MISSION, Refusal.NO_MISSION)
_BATTERY = Guard(lambda c: c.battery_good, Refusal.BATTERY_LOW)
_UPRIGHT = Guard(lambda c: c.upright, Refusal.LEANING)
_FENCE = Guard(lambda c: c.fence_kept, Refusal.OUTSIDE_FENCE)

GUARDS: Mapping[Event, tuple[Guard, ...]] = {
    Event.ASK_HOLD: (_POSITION,),
    Event.ASK_POSITION: (_POSITION,),
    Event.ASK_ALTITUDE: (_ALTITUDE,),
    Event.ASK_STABILIZED: (_ATTITUDE,),
    Event.ASK_BRAKE: (_POSITION,),
    Event.ASK_GUIDED: (_POSITION,),
    Event.ASK_TAKEOFF: (_POSITION, _ALTITUDE),
    Event.ASK_LAND: (_ATTITUDE,),
    Event.ASK_RTL: (_POSITION, _HOME),
    Event.ASK_MISSION: (_MISSION, _POSITION, _HOME),
    Event.ASK_OFFBOARD: (_STREAM_IF_ARMED,),
    Event.ASK_GOTO: (_FLYING, _POSITION),
    Event.ASK_ARM: (
        _ATTITUDE,
        _UPRIGHT,
        _VELOCITY,
        _POSITION,
        _ALTITUDE,
        _HOME,
        _BATTERY,
        _FENCE,
        _STREAM_IN_OFFBOARD,
        _MISSION_IN_MISSION,
    ),
    Event.ASK_DISARM: (_LANDED,),
    Event.ASK_KILL: (),
    Event.TAKEOFF_DONE: (),
    Event.MISSION_DONE: (),
    Event.MISSION_RTL: (),
    Event.STREAM_BACK: (),
    Event.FAIL_HOLD: (),
    Event.FAIL_RTL: (),
    Event.FAIL_LAND: (),
    Event.DISARMED: (),
}


def refusal(event: Event, conditions: Conditions) -> Refusal | None:
    """Why `event` is refused under `conditions`; None when it is not."""
    for guard in GUARDS[event]:
        if not guard.holds(conditions):
            return guard.reason
    if TRANSITIONS[event][conditions.mode] is Special.DENY:
        return Refusal.NOT_ARMABLE_MODE
    return None
