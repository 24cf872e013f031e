"""What the core asks of an autopilot module."""

from typing import Protocol

from companion.commands import Command
from companion.telemetry import Telemetry


class Autopilot(Protocol):
    """Everything the flight needs to know of one kind of autopilot; stateless."""

    name: str
    offboard_mode: str
    """What its people call the mode that follows our setpoints."""

    def stream_requests(self) -> list[Command]:
        """SET_MESSAGE_INTERVAL for what `Telemetry` reads."""
        ...

    def parameters_wanted(self) -> list[str]:
        """Names of parameters to read before flying."""
        ...

    def warnings(self, telemetry: Telemetry) -> list[str]:
        """What a person should know before this vehicle is armed."""
        ...

    def not_ready(self, now_us: int, telemetry: Telemetry) -> list[str]:
        """Reasons why it cannot be armed yet; empty when it can."""
        ...

    def take_control(self) -> Command: ...

    def in_control(self, telemetry: Telemetry) -> bool: ...

    def arm(self) -> Command: ...

    def disarm(self) -> Command: ...

    def land(self) -> Command: ...

    def is_landing(self, telemetry: Telemetry) -> bool: ...
