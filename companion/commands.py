"""One COMMAND_LONG at a time: sent, repeated until it is answered, and given up after a while.

UDP loses datagrams and autopilots are sometimes busy, so a command is sent again each 0.5 s with `confirmation` counted
up, as the MAVLink command protocol asks; IN_PROGRESS and TEMPORARILY_REJECTED keep it alive. An acknowledgement names
nothing but the command, so one that is addressed to somebody else is not ours, and no two of a kind are under way.
A parameter is written likewise, and its echo is the answer.
"""

import struct
from dataclasses import dataclass
from enum import Enum

from companion.telemetry import Ack
from wire.dialect import mavlink

REPEAT_US = 500_000
TRIES = 10


class Outcome(Enum):
    PENDING = "pending"
    ACCEPTED = "accepted"
    REFUSED = "refused"
    UNANSWERED = "unanswered"


@dataclass(slots=True, kw_only=True)
class Repeated:
    """What is sent again until it is answered."""

    outcome: Outcome = Outcome.PENDING
    sent: int = 0
    _next_us: int = 0

    def due(self, now_us: int) -> bool:
        """Whether it should be sent now; counts the tries and gives up after `TRIES`."""
        if self.outcome is not Outcome.PENDING or now_us < self._next_us:
            return False
        if self.sent >= TRIES:
            self.outcome = Outcome.UNANSWERED
            return False
        self.sent += 1
        self._next_us = now_us + REPEAT_US
        return True


@dataclass(slots=True)
class Command(Repeated):
    """A command on its way.

    Attributes
    ----------
    command : MAV_CMD.
    parameters : up to seven, the rest are 0.
    what : what it is for, for people ("arm", "switch to OFFBOARD").
    spare : it can be done without: a refusal is worth knowing, and no more.
    """

    command: int
    parameters: tuple[float, ...]
    what: str
    spare: bool = False
    result: int | None = None  # MAV_RESULT of the last answer
    answered_us: int = 0  # when it was accepted

    def answered(self, ack: Ack, now_us: int = 0) -> None:
        """Take an acknowledgement; one for another command, or from before it was sent, changes nothing."""
        if ack.command != self.command or self.outcome is not Outcome.PENDING or self.sent == 0:
            return
        self.result = ack.result
        if ack.result == mavlink.MAV_RESULT_ACCEPTED:
            self.outcome, self.answered_us = Outcome.ACCEPTED, now_us
        elif ack.result not in (mavlink.MAV_RESULT_IN_PROGRESS, mavlink.MAV_RESULT_TEMPORARILY_REJECTED):
            self.outcome = Outcome.REFUSED

    def message(self, target_system: int) -> mavlink.MAVLink_command_long_message:
        values = (*self.parameters, *[0.0] * (7 - len(self.parameters)))
        confirmation = min(max(self.sent - 1, 0), 255)
        return mavlink.MAVLink_command_long_message(target_system, 1, self.command, confirmation, *values)

    def failure(self) -> str:
        """Why it failed, in one clause."""
        if self.outcome is Outcome.UNANSWERED:
            last = "" if self.result is None else f" (last answer {_result_name(self.result)})"
            return f"no acceptance of '{self.what}' after {self.sent} tries{last}"
        return f"the vehicle refused to {self.what}: {_result_name(self.result or 0)}"


def is_for(ack: Ack, system_id: int, component_id: int) -> bool:
    """Whether an acknowledgement is for us; older senders leave the target 0, everybody."""
    return ack.target_system in (0, system_id) and ack.target_component in (0, component_id)


@dataclass(slots=True)
class ParameterWrite(Repeated):
    """A PARAM_SET on its way; done when the vehicle tells the value that was written.

    Attributes
    ----------
    name, value, kind : as PARAM_SET has them; the value as its float field carries it.
    shown : the value, for people.
    """

    name: str
    value: float
    kind: int
    shown: str

    def echoed(self, raw: bytes) -> None:
        """Take what the vehicle says the parameter is: the four bytes of param_value."""
        if self.sent and raw == struct.pack("<f", self.value):
            self.outcome = Outcome.ACCEPTED

    def message(self, target_system: int) -> mavlink.MAVLink_param_set_message:
        return mavlink.MAVLink_param_set_message(target_system, 1, self.name.encode(), self.value, self.kind)

    def failure(self) -> str:
        return f"{self.name} was not set to {self.shown}: no echo after {self.sent} tries"


def _result_name(result: int) -> str:
    entry = mavlink.enums["MAV_RESULT"].get(result)
    return entry.name if entry is not None else f"result {result}"
