"""What the core asks of an autopilot module."""

from dataclasses import dataclass
from typing import Protocol

from companion.commands import Command
from companion.safety import BATTERY_LOW
from companion.telemetry import Telemetry
from wire.dialect import mavlink


@dataclass(frozen=True, slots=True)
class ParameterWish:
    """A parameter that should have another value while we fly."""

    name: str
    value: float  # as the float field carries it
    kind: int  # MAV_PARAM_TYPE
    shown: str  # for people


class Autopilot(Protocol):
    """Everything the flight needs to know of one kind of autopilot; stateless."""

    name: str
    offboard_mode: str
    """What its people call the mode that follows our setpoints."""
    takes_off_itself: bool
    """It climbs by a command, and takes setpoints only after that; otherwise the climb is flown by setpoints."""
    streams_on_ground: bool
    """It wants setpoints before it gives the mode; otherwise it wants none before it is in the air."""
    streams_until_landing: bool
    """Setpoints go on until it says that it lands; otherwise they end when it is told to land."""

    def streams_hz(self) -> dict[int, float]:
        """What `Telemetry` reads, and how often a second; asked for again after every reboot."""
        ...

    def parameters_wanted(self) -> list[str]:
        """Names of parameters to read before flying."""
        ...

    def parameters_to_set(self, telemetry: Telemetry) -> list[ParameterWish]:
        """What must be another value before flying, judged by what was read."""
        ...

    def warnings(self, telemetry: Telemetry) -> list[str]:
        """What a person should know before this vehicle is armed."""
        ...

    def booting(self, telemetry: Telemetry) -> bool:
        """Whether HEARTBEAT says that it has only just started."""
        ...

    def not_ready(self, now_us: int, telemetry: Telemetry) -> list[str]:
        """Reasons why it cannot be armed yet; empty when it can."""
        ...

    def estimator_lost(self, telemetry: Telemetry) -> str:
        """Why its estimate is not one to fly by, or nothing."""
        ...

    def take_control(self) -> Command: ...

    def in_control(self, telemetry: Telemetry) -> bool: ...

    def arm(self) -> Command: ...

    def disarm(self) -> Command: ...

    def takeoff(self, height_m: float) -> Command | None:
        """To a height above where it stands; None: by setpoints."""
        ...

    def airborne(self, telemetry: Telemetry) -> bool:
        """Whether the takeoff is over and setpoints are obeyed."""
        ...

    def land(self) -> Command: ...

    def go_home(self) -> Command: ...

    def comes_down(self, telemetry: Telemetry) -> bool:
        """Whether it lands, or returns to land, by itself."""
        ...

    def lands(self, telemetry: Telemetry) -> bool:
        """Whether it lands where it is, by itself."""
        ...

    def lost_our_stream(self, telemetry: Telemetry) -> bool:
        """Whether it left our mode only since our setpoints stopped coming, and returns when they come again."""
        ...

    def mode_name(self, telemetry: Telemetry) -> str:
        """What its people call the mode it is in."""
        ...

    def failsafe(self, telemetry: Telemetry) -> str:
        """Which failsafe took the mode, if it says that one did; else nothing."""
        ...


SPARE = frozenset(
    {
        mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE,
        mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE_3D,
        mavlink.MAVLINK_MSG_ID_DISTANCE_SENSOR,
        mavlink.MAVLINK_MSG_ID_ADSB_VEHICLE,
        mavlink.MAVLINK_MSG_ID_HIL_STATE_QUATERNION,
    }
)
"""Messages that many a vehicle does not have: that it refuses one of them is no warning."""


def stream_requests(rates_hz: dict[int, float]) -> list[Command]:
    """One SET_MESSAGE_INTERVAL for each message id."""
    return [
        Command(
            mavlink.MAV_CMD_SET_MESSAGE_INTERVAL,
            (float(message_id), 1e6 / hz),
            f"stream {_message_name(message_id)} at {hz:g} Hz",
            spare=message_id in SPARE,
        )
        for message_id, hz in rates_hz.items()
    ]


POSITION_FRESH_US = 500_000
HEARTBEAT_FRESH_US = 3_000_000


def common_reasons(now_us: int, telemetry: Telemetry) -> list[str]:
    """Why any autopilot could not be armed yet, as far as MAVLink says it for all of them."""
    reasons = []
    if telemetry.heartbeat_us is not None and now_us - telemetry.heartbeat_us > HEARTBEAT_FRESH_US:
        reasons.append("no HEARTBEAT")
    if telemetry.position_us is None or now_us - telemetry.position_us > POSITION_FRESH_US:
        reasons.append("no local position")
    if telemetry.attitude_us is None:
        reasons.append("no attitude")
    if telemetry.armed:
        reasons.append("armed already")
    if telemetry.landed_state != mavlink.MAV_LANDED_STATE_ON_GROUND:
        reasons.append("not on the ground")
    if telemetry.battery is not None and telemetry.battery <= BATTERY_LOW:
        reasons.append(f"battery at {telemetry.battery:.0%}")
    reasons.extend(f"estimator rejects {name}" for name in telemetry.rejected)
    return reasons


def _message_name(message_id: int) -> str:
    return str(mavlink.mavlink_map[message_id].msgname)
