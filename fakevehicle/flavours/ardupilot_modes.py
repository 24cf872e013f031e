"""ArduCopter's modes: one table of what each is called, what it needs, and which of ours flies it.

Numbers are ArduCopter's (mode.h), names as AVAILABLE_MODES gives them. Whoever is disarmed may choose any mode; in the
air a mode that needs a position is refused without one. Arming is for the modes a pilot starts in, not for automatic
ones. Modes that need sticks fly as Hold here: ArduCopter's LOITER without sticks sinks to the ground.
"""

from dataclasses import dataclass

from fakevehicle.modes import Event, Mode, Refusal
from wire.dialect import mavlink

STABILIZE, ALT_HOLD, AUTO, GUIDED, LOITER, RTL, LAND, BRAKE = 0, 2, 3, 4, 5, 6, 9, 17


@dataclass(frozen=True, slots=True)
class ArduMode:
    """One mode.

    Attributes
    ----------
    number, name : as ArduCopter has them.
    event, mode : how to ask the supervisor for it, and what it then flies.
    armable : whether the motors may be started in it.
    needs_position : whether it is refused in the air without one.
    standard : MAV_STANDARD_MODE.
    """

    number: int
    name: str
    event: Event
    mode: Mode
    armable: bool
    needs_position: bool
    standard: int = mavlink.MAV_STANDARD_MODE_NON_STANDARD


_m = mavlink
MODES = (
    ArduMode(AUTO, "AUTO", Event.ASK_MISSION, Mode.MISSION, False, True, _m.MAV_STANDARD_MODE_MISSION),
    ArduMode(STABILIZE, "STABILIZE", Event.ASK_STABILIZED, Mode.STABILIZED, True, False),
    ArduMode(ALT_HOLD, "ALT_HOLD", Event.ASK_ALTITUDE, Mode.ALTITUDE, True, False, _m.MAV_STANDARD_MODE_ALTITUDE_HOLD),
    ArduMode(LOITER, "LOITER", Event.ASK_POSITION, Mode.POSITION, True, True, _m.MAV_STANDARD_MODE_POSITION_HOLD),
    ArduMode(GUIDED, "GUIDED", Event.ASK_GUIDED, Mode.GUIDED, True, True),
    ArduMode(LAND, "LAND", Event.ASK_LAND, Mode.LAND, False, False, _m.MAV_STANDARD_MODE_LAND),
    ArduMode(RTL, "RTL", Event.ASK_RTL, Mode.RTL, False, True, _m.MAV_STANDARD_MODE_SAFE_RECOVERY),
    ArduMode(BRAKE, "BRAKE", Event.ASK_BRAKE, Mode.BRAKE, False, True),
)
"""In the order in which AVAILABLE_MODES counts them."""

BY_ATTITUDE = (STABILIZE, ALT_HOLD)
"""Modes whose heartbeat has no guided flag: they hold no place."""
BY_NUMBER = {mode.number: mode for mode in MODES}

ARMING_WORDS = {
    Refusal.NO_ATTITUDE: "EKF attitude is bad",
    Refusal.NO_VELOCITY: "Need Velocity Estimate",
    Refusal.NO_POSITION: "Need Position Estimate",
    Refusal.NO_ALTITUDE: "Need Alt Estimate",
    Refusal.NO_HOME: "AHRS: waiting for home",
    Refusal.BATTERY_LOW: "Battery 1 below minimum arming capacity",
    Refusal.OUTSIDE_FENCE: "Vehicle breaching Fence",
    Refusal.LEANING: "Leaning",
}
"""ArduPilot's words for what keeps it from arming; others are put as everywhere."""
