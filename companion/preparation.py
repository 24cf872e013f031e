"""Getting a vehicle ready on the ground: its streams, its parameters, and the reasons for which it is waited for."""

from dataclasses import dataclass, field
from typing import Any

from companion.autopilots.base import Autopilot
from companion.commands import Command, Outcome, ParameterWrite
from companion.seam import Level, Note
from companion.streams import Streams
from companion.telemetry import Telemetry
from companion.vehiclelink import AUTOPILOT_COMPONENT
from wire.dialect import mavlink

PARAMETER_WAIT_US, PARAMETER_REPEAT_US = 2_000_000, 500_000


@dataclass(slots=True)
class Preparation:
    """What is still to be asked of a vehicle, one thing after the other.

    Attributes
    ----------
    reasons : why it is not ready; empty when it is, as far as it says itself.
    """

    autopilot: Autopilot
    telemetry: Telemetry
    began_us: int
    streams: Streams
    queue: list[Command | ParameterWrite] = field(init=False)
    reasons: tuple[str, ...] = ("not asked yet",)
    _parameters_due_us: int = 0
    _judged: bool = False

    def __post_init__(self) -> None:
        self.queue = [*self.streams.requests()]
        self.telemetry.parameters = {name: b"" for name in self.autopilot.parameters_wanted()}

    def next(self) -> Command | ParameterWrite | None:
        """What to ask now that nothing else is under way."""
        return self.queue.pop(0) if self.queue else None

    def over(self, command: Command | ParameterWrite) -> Note | None:
        """What to tell of something that was asked and is answered or given up: nothing ends the flight."""
        if isinstance(command, Command):
            self.streams.over(command)
        if command.outcome is not Outcome.ACCEPTED:
            spare = isinstance(command, Command) and command.spare
            return Note(Level.INFO if spare else Level.WARNING, command.failure())
        if isinstance(command, ParameterWrite):
            return Note(Level.INFO, f"{command.name} set to {command.shown}")
        return None

    def look(self, now_us: int, also: tuple[str, ...]) -> Note | None:
        """Judge what is known, once a tick; `also` are reasons to wait that are not the autopilot's."""
        if not self._judged and not self._unread(now_us):
            self._judged = True
            for wish in self.autopilot.parameters_to_set(self.telemetry):
                self.queue.append(ParameterWrite(wish.name, wish.value, wish.kind, wish.shown))
        reasons = (*self.autopilot.not_ready(now_us, self.telemetry), *also)
        self.queue.extend(self.streams.missing(now_us, hears=not self.queue))
        if reasons == self.reasons:
            return None
        self.reasons = reasons
        return Note(Level.INFO, "vehicle ready" if not reasons else f"waiting: {', '.join(reasons)}")

    def done(self, now_us: int) -> bool:
        """Whether it is ready and there is nothing left to ask."""
        return not self.reasons and not self.queue and not self._unread(now_us)

    def reads(self, now_us: int, target: int) -> list[Any]:
        """PARAM_REQUEST_READ of what has not been told yet, again and again for a while."""
        if now_us < self._parameters_due_us or not self._unread(now_us):
            return []
        self._parameters_due_us = now_us + PARAMETER_REPEAT_US
        return [
            mavlink.MAVLink_param_request_read_message(target, AUTOPILOT_COMPONENT, name.encode(), -1)
            for name, raw in self.telemetry.parameters.items()
            if not raw
        ]

    def _unread(self, now_us: int) -> bool:
        waits = now_us - self.began_us < PARAMETER_WAIT_US
        return waits and any(not raw for raw in self.telemetry.parameters.values())
