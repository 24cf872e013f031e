"""What one autopilot's behaviour on MAVLink consists of, where it differs from another's.

A flavour is a service like the others, except that its routes, commands and messages replace those of the services
below it. Beside that it decides what no single message does: the streams a link starts with, which changes are told at
once and in which order, how refusals and notes are put, and what parameters are called.

The flying is underneath, the same for all: a flavour steers it through the supervisor's `ask`, `offboard` and the like,
as any peer's wish, and never through a door of its own.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from fakevehicle.codec import Message
from fakevehicle.config import Profile
from fakevehicle.flight import FlightStack
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.places import Places
from fakevehicle.services.commands import Commands
from fakevehicle.services.missions import MissionHabits
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import Command, Service, Verdict
from fakevehicle.services.setpoints import Setpoints
from fakevehicle.services.streams import Streams
from fakevehicle.services.telemetry import Telemetry
from fakevehicle.supervisor import Supervisor
from wire.dialect import mavlink

Said = tuple[int, str]
"""(MAV_SEVERITY, text) of a STATUSTEXT."""


@dataclass(frozen=True, slots=True)
class Parts:
    """The vehicle's rooms that a flavour looks into."""

    stack: FlightStack
    supervisor: Supervisor
    parameters: ParameterSet
    places: Places
    outbox: Outbox
    telemetry: Telemetry
    streams: Streams
    setpoints: Setpoints
    commands: Commands


@dataclass(frozen=True, slots=True)
class ModeInfo:
    """One mode as AVAILABLE_MODES tells it: name, HEARTBEAT's custom mode, MAV_STANDARD_MODE."""

    name: str
    custom_mode: int
    standard: int


class Flavour(Service):
    """PX4's way wherever a flavour does not say otherwise.

    Attributes
    ----------
    parameters : parameters that only this flavour has.
    defaults : values of the others that differ from their own defaults, by name.
    bytewise : whether integers travel as their bytes inside a parameter's float, or as the float nearest to them.
    habits : how it speaks the mission protocol.
    texts_first : whether notes are told before the HEARTBEAT of a new mode.
    software : AUTOPILOT_VERSION.flight_sw_version of the autopilot that is imitated, for clients that go by it.
    parts : the vehicle's rooms, from `attach` on.
    """

    parameters: tuple[Parameter, ...] = ()
    defaults: Mapping[str, float] = {}
    bytewise = True
    texts_first = True
    software: int = 0
    habits = MissionHabits()
    parts: Parts

    def attach(self, parts: Parts) -> None:
        """The vehicle stands: here are its rooms."""
        self.parts = parts

    def modes(self) -> tuple[ModeInfo, ...]:
        """Every mode, in the order in which AVAILABLE_MODES counts them."""
        raise NotImplementedError

    def available_mode(self, index: int) -> Message | None:
        """AVAILABLE_MODES of one mode, counted from 1; None past the end."""
        modes = self.modes()
        if not 1 <= index <= len(modes):
            return None
        mode = modes[index - 1]
        return mavlink.MAVLink_available_modes_message(
            len(modes), index, mode.standard, mode.custom_mode, 0, mode.name.encode("ascii")
        )

    def available_modes_monitor(self) -> Message:
        """The list of modes never changes."""
        return mavlink.MAVLink_available_modes_monitor_message(0)

    def rates(self, profile: Profile) -> Mapping[int, float]:
        """The streams a link starts with: message id to rate [Hz]."""
        raise NotImplementedError

    def look(self, now_us: int) -> None:
        """At 50 Hz, after the supervisor has looked: what follows from what it noticed."""

    def state(self) -> object:
        """Whatever a change of which is told at once."""
        raise NotImplementedError

    def announcement(self) -> tuple[Message, ...]:
        """What is then told, to everybody."""
        raise NotImplementedError

    def noted(self, severity: int, text: str) -> Said | None:
        """How a note of the supervisor's is put; None: it is kept to itself."""
        return severity, text

    def judged(self, command: Command, title: str, verdict: Verdict) -> tuple[int, tuple[Said, ...]]:
        """MAV_RESULT of a command, and the texts that explain a refusal."""
        if not verdict.reason:
            return verdict.result, ()
        return verdict.result, ((mavlink.MAV_SEVERITY_CRITICAL, f"{title} denied: {verdict.reason}"),)

    def acknowledged(self, sender: Sender) -> None:
        """A command's ACK has just been sent: whatever is to follow it."""

    def named(self, parameters: ParameterSet) -> ParameterSet:
        """The parameters under the names this flavour gives them."""
        return parameters
