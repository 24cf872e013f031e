"""Flight modes and what may change them, as two tables.

Theory of operation
-------------------
The vehicle is in one `Mode`. Things happen to it, each an `Event`: somebody asks for a mode, to arm or to disarm; or
the vehicle itself notices something (the takeoff height is reached, the setpoint stream has stopped). Two tables say
what follows, and nothing else decides:

- `GUARDS[event]`: conditions that must hold, in order; the first one that does not refuses the event with its reason.
- `TRANSITIONS[event][mode]`: the mode afterwards, or one of the `Special` outcomes: STAY (nothing changes), DENY (the
  event is refused in this mode), FAILSAFE (to the mode that COM_OBL_RC_ACT names, while the asked-for mode stays
  OFFBOARD), RESUME (back to OFFBOARD, if it was a lost stream that led here).

An event that is refused changes nothing. Rule 1: this file knows no MAVLink message, only the mode numbers that PX4
puts into them. Rule 2: it keeps no state; `supervisor.py` does.

Where we follow PX4 v1.16 and where we are kinder
-------------------------------------------------
- OFFBOARD is accepted after one setpoint (MAVSDK asks 7 ms after its first). While disarmed it is accepted without
  any, as PX4 does; arming then waits for the stream.
- A lost stream (COM_OF_LOSS_T) leads to COM_OBL_RC_ACT; setpoints that return bring OFFBOARD back by themselves while
  the vehicle still flies, as PX4 was measured to do. Any mode asked for in between ends that.
- After a landing in LAND, RTL or TAKEOFF the mode becomes Hold. PX4 would go back to the mode before, often OFFBOARD,
  in which nobody can arm without a stream.
- Position mode without sticks flies as Hold. PX4 would sink at 0.7 m/s with the sticks unknown.
- AUTO.READY is flown and shown as Hold.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum

MAIN_POSITION = 3
MAIN_AUTO = 4
MAIN_OFFBOARD = 6
AUTO_READY = 1
AUTO_TAKEOFF = 2
AUTO_HOLD = 3
AUTO_MISSION = 4
AUTO_RTL = 5
AUTO_LAND = 6


class Mode(Enum):
    """A flight mode; the value is PX4's (main mode, sub mode), as px4_custom_mode.h numbers them."""

    HOLD = (MAIN_AUTO, AUTO_HOLD)
    POSITION = (MAIN_POSITION, 0)
    TAKEOFF = (MAIN_AUTO, AUTO_TAKEOFF)
    LAND = (MAIN_AUTO, AUTO_LAND)
    RTL = (MAIN_AUTO, AUTO_RTL)
    OFFBOARD = (MAIN_OFFBOARD, 0)

    @property
    def custom_mode(self) -> int:
        """HEARTBEAT.custom_mode: main << 16 | sub << 24."""
        main, sub = self.value
        return main << 16 | sub << 24

    @property
    def automatic(self) -> bool:
        """Whether the vehicle itself decides where to fly (MAV_MODE_FLAG_AUTO_ENABLED)."""
        return bool(self.value[0] == MAIN_AUTO)

    @property
    def title(self) -> str:
        """What people call it."""
        return "RTL" if self is Mode.RTL else self.name.capitalize()


class Event(Enum):
    """What can happen. The first group is asked for by peers, the second is noticed by the vehicle."""

    ASK_HOLD = "hold"
    ASK_POSITION = "position mode"
    ASK_TAKEOFF = "takeoff"
    ASK_LAND = "land"
    ASK_RTL = "return"
    ASK_OFFBOARD = "offboard"
    ASK_GOTO = "goto"
    ASK_ARM = "arm"
    ASK_DISARM = "disarm"
    ASK_KILL = "kill"

    TAKEOFF_DONE = "takeoff height reached"
    STREAM_LOST = "setpoints stopped"
    STREAM_BACK = "setpoints returned"
    DISARMED = "motors stopped"


class Special(Enum):
    """Outcomes that are not simply a mode; see the theory of operation."""

    STAY = "stay"
    DENY = "deny"
    FAILSAFE = "failsafe"
    RESUME = "resume"


Outcome = Mode | Special

_H, _P, _T, _L, _R, _O = Mode.HOLD, Mode.POSITION, Mode.TAKEOFF, Mode.LAND, Mode.RTL, Mode.OFFBOARD
_STAY, _DENY, _FAILSAFE, _RESUME = Special.STAY, Special.DENY, Special.FAILSAFE, Special.RESUME
_COLUMNS = (_H, _P, _T, _L, _R, _O)
_ROWS: Mapping[Event, tuple[Outcome, ...]] = {
    # in:               Hold     Position Takeoff  Land     RTL      Offboard
    Event.ASK_HOLD: (_H, _H, _H, _H, _H, _H),
    Event.ASK_POSITION: (_P, _P, _P, _P, _P, _P),
    Event.ASK_TAKEOFF: (_T, _T, _T, _T, _T, _T),
    Event.ASK_LAND: (_L, _L, _L, _L, _L, _L),
    Event.ASK_RTL: (_R, _R, _R, _R, _R, _R),
    Event.ASK_OFFBOARD: (_O, _O, _O, _O, _O, _O),
    Event.ASK_GOTO: (_H, _H, _H, _H, _H, _H),
    Event.ASK_ARM: (_STAY, _STAY, _STAY, _DENY, _DENY, _STAY),
    Event.ASK_DISARM: (_STAY, _STAY, _STAY, _STAY, _STAY, _STAY),
    Event.ASK_KILL: (_STAY, _STAY, _STAY, _STAY, _STAY, _STAY),
    Event.TAKEOFF_DONE: (_STAY, _STAY, _H, _STAY, _STAY, _STAY),
    Event.STREAM_LOST: (_STAY, _STAY, _STAY, _STAY, _STAY, _FAILSAFE),
    Event.STREAM_BACK: (_RESUME, _STAY, _STAY, _RESUME, _RESUME, _STAY),
    Event.DISARMED: (_STAY, _STAY, _H, _H, _H, _STAY),
}
TRANSITIONS: Mapping[Event, Mapping[Mode, Outcome]] = {
    event: dict(zip(_COLUMNS, row, strict=True)) for event, row in _ROWS.items()
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


@dataclass(frozen=True, slots=True)
class Guard:
    """A condition and what to tell people when it does not hold."""

    holds: Callable[[Conditions], bool]
    reason: str


_ATTITUDE = Guard(lambda c: c.attitude_valid, "attitude not known yet")
_VELOCITY = Guard(lambda c: c.velocity_valid, "velocity not known yet")
_POSITION = Guard(lambda c: c.position_valid, "position not known yet")
_ALTITUDE = Guard(lambda c: c.altitude_valid, "altitude not known yet")
_HOME = Guard(lambda c: c.home_known, "home not known yet")
_FLYING = Guard(lambda c: c.armed and c.airborne, "not flying")
_STREAM_IF_ARMED = Guard(lambda c: c.setpoints_fresh or not c.armed, "no setpoints are arriving")
_STREAM_IN_OFFBOARD = Guard(lambda c: c.setpoints_fresh or c.mode is not Mode.OFFBOARD, "no offboard setpoints")
_LANDED = Guard(lambda c: not (c.armed and c.airborne), "not landed")

GUARDS: Mapping[Event, tuple[Guard, ...]] = {
    Event.ASK_HOLD: (_POSITION,),
    Event.ASK_POSITION: (_POSITION,),
    Event.ASK_TAKEOFF: (_POSITION, _ALTITUDE),
    Event.ASK_LAND: (_ATTITUDE,),
    Event.ASK_RTL: (_POSITION, _HOME),
    Event.ASK_OFFBOARD: (_STREAM_IF_ARMED,),
    Event.ASK_GOTO: (_FLYING, _POSITION),
    Event.ASK_ARM: (_ATTITUDE, _VELOCITY, _POSITION, _ALTITUDE, _HOME, _STREAM_IN_OFFBOARD),
    Event.ASK_DISARM: (_LANDED,),
    Event.ASK_KILL: (),
    Event.TAKEOFF_DONE: (),
    Event.STREAM_LOST: (),
    Event.STREAM_BACK: (),
    Event.DISARMED: (),
}


def refusal(event: Event, conditions: Conditions) -> str | None:
    """Why `event` is refused under `conditions`, in a few words; None when it is not."""
    for guard in GUARDS[event]:
        if not guard.holds(conditions):
            return guard.reason
    if TRANSITIONS[event][conditions.mode] is Special.DENY:
        return f"ask for Hold first, the mode is {conditions.mode.title}"
    return None


def event_for_custom_mode(main: int, sub: int) -> Event | None:
    """The event that asks for PX4's (main, sub) mode; None for a mode this vehicle does not have."""
    return _ASKED.get((main, sub if main == MAIN_AUTO else 0))


_ASKED = {
    (MAIN_POSITION, 0): Event.ASK_POSITION,
    (MAIN_OFFBOARD, 0): Event.ASK_OFFBOARD,
    (MAIN_AUTO, AUTO_READY): Event.ASK_HOLD,
    (MAIN_AUTO, AUTO_HOLD): Event.ASK_HOLD,
    (MAIN_AUTO, AUTO_TAKEOFF): Event.ASK_TAKEOFF,
    (MAIN_AUTO, AUTO_RTL): Event.ASK_RTL,
    (MAIN_AUTO, AUTO_LAND): Event.ASK_LAND,
}
