"""What differs between autopilots, one module each: readiness, streams, modes, arming, landing. No I/O, no clock."""

from companion.autopilots.ardupilot import ArduPilot
from companion.autopilots.base import Autopilot
from companion.autopilots.px4 import Px4
from wire.dialect import mavlink

AUTOPILOTS: dict[int, Autopilot] = {
    mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA: ArduPilot(),
    mavlink.MAV_AUTOPILOT_PX4: Px4(),
}
"""By the number in HEARTBEAT."""
