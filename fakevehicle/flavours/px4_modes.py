"""PX4's numbers for the modes (px4_custom_mode.h), and which event asks for each.

PX4 has no GUIDED and no BRAKE. AUTO.READY is flown and shown as Hold.
"""

from collections.abc import Mapping

from fakevehicle.modes import Event, Mode

MAIN_ALTITUDE = 2
MAIN_POSITION = 3
MAIN_AUTO = 4
MAIN_OFFBOARD = 6
MAIN_STABILIZED = 7
AUTO_READY = 1
AUTO_TAKEOFF = 2
AUTO_HOLD = 3
AUTO_MISSION = 4
AUTO_RTL = 5
AUTO_LAND = 6

PX4_NUMBERS: Mapping[Mode, tuple[int, int]] = {
    Mode.HOLD: (MAIN_AUTO, AUTO_HOLD),
    Mode.POSITION: (MAIN_POSITION, 0),
    Mode.ALTITUDE: (MAIN_ALTITUDE, 0),
    Mode.STABILIZED: (MAIN_STABILIZED, 0),
    Mode.TAKEOFF: (MAIN_AUTO, AUTO_TAKEOFF),
    Mode.LAND: (MAIN_AUTO, AUTO_LAND),
    Mode.RTL: (MAIN_AUTO, AUTO_RTL),
    Mode.MISSION: (MAIN_AUTO, AUTO_MISSION),
    Mode.OFFBOARD: (MAIN_OFFBOARD, 0),
}
"""(main mode, sub mode)."""

_ASKED: Mapping[tuple[int, int], Event] = {
    (MAIN_ALTITUDE, 0): Event.ASK_ALTITUDE,
    (MAIN_POSITION, 0): Event.ASK_POSITION,
    (MAIN_OFFBOARD, 0): Event.ASK_OFFBOARD,
    (MAIN_STABILIZED, 0): Event.ASK_STABILIZED,
    (MAIN_AUTO, AUTO_READY): Event.ASK_HOLD,
    (MAIN_AUTO, AUTO_HOLD): Event.ASK_HOLD,
    (MAIN_AUTO, AUTO_TAKEOFF): Event.ASK_TAKEOFF,
    (MAIN_AUTO, AUTO_MISSION): Event.ASK_MISSION,
    (MAIN_AUTO, AUTO_RTL): Event.ASK_RTL,
    (MAIN_AUTO, AUTO_LAND): Event.ASK_LAND,
}


def custom_mode(mode: Mode) -> int:
    """HEARTBEAT.custom_mode: main << 16 | sub << 24; 0 for a mode PX4 does not have."""
    main, sub = PX4_NUMBERS.get(mode, (0, 0))
    return main << 16 | sub << 24


def automatic(mode: Mode) -> bool:
    """Whether the vehicle itself decides where to fly (MAV_MODE_FLAG_AUTO_ENABLED)."""
    return PX4_NUMBERS.get(mode, (0, 0))[0] == MAIN_AUTO


def event_for_custom_mode(main: int, sub: int) -> Event | None:
    """The event that asks for a (main, sub) mode; None for a mode this vehicle does not have."""
    return _ASKED.get((main, sub if main == MAIN_AUTO else 0))
