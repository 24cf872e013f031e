"""What every MAVLink microservice offers the vehicle: routes, commands, messages, and something to do each tick.

The vehicle keeps a list of services and asks each of them once, at the start; nothing else knows who is there. Two
services that claim the same message or command are our own mistake, and an error at the start (`merged`).
"""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TypeVar

from fakevehicle.codec import Message
from fakevehicle.modes import Refusal
from fakevehicle.services.outbox import Sender
from wire.dialect import mavlink

Handler = Callable[[Sender, Message, int], None]
"""Takes one message that is addressed to us: who sent it, the message, and the time [us]."""
Builder = Callable[[], Message | None]
"""Makes one message of what is true now; None while there is nothing to say."""


@dataclass(frozen=True, slots=True)
class Command:
    """A command in SI-neutral form.

    Attributes
    ----------
    command : MAV_CMD.
    params : the first four, and the seventh at index 4: what both messages have alike. NaN: not given.
    latitude_deg, longitude_deg : parameters 5 and 6 as a place, [deg]; NaN: not given.
    frame : MAV_FRAME; COMMAND_LONG has none and means GLOBAL.
    """

    command: int
    params: tuple[float, float, float, float, float]
    latitude_deg: float = math.nan
    longitude_deg: float = math.nan
    frame: int = mavlink.MAV_FRAME_GLOBAL


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of a command: MAV_RESULT, and the reason where it was refused."""

    result: int
    reason: str = ""


ACCEPTED = Verdict(mavlink.MAV_RESULT_ACCEPTED)


def denied(reason: str) -> Verdict:
    """The parameters forbid it."""
    return Verdict(mavlink.MAV_RESULT_DENIED, reason)


def judged(refusal: Refusal | None) -> Verdict:
    """What the supervisor said."""
    return ACCEPTED if refusal is None else Verdict(mavlink.MAV_RESULT_TEMPORARILY_REJECTED, refusal.value)


@dataclass(frozen=True, slots=True)
class CommandSpec:
    """Who carries a command out, what people call it, and the numbers of the parameters it understands."""

    carry_out: Callable[[Sender, Command, int], Verdict]
    title: str
    understood: tuple[int, ...] = ()


class Service:
    """A microservice that takes, carries out, builds and does nothing: those that do override what they need."""

    def routes(self) -> Mapping[int, Handler]:
        """By message id: what it takes."""
        return {}

    def commands(self) -> Mapping[int, CommandSpec]:
        """By MAV_CMD: what it carries out."""
        return {}

    def builders(self) -> Mapping[int, Builder]:
        """By message id: what it can stream, or send on request."""
        return {}

    def step(self, now_us: int) -> None:
        """Once a tick, after the flight stack."""


_Entry = TypeVar("_Entry")


def merged(what: str, tables: Iterable[Mapping[int, _Entry]]) -> dict[int, _Entry]:
    """One table of several.

    Raises
    ------
    ValueError : a number is claimed twice; the message names `what` and the number.
    """
    whole: dict[int, _Entry] = {}
    for table in tables:
        for number, entry in table.items():
            if number in whole:
                raise ValueError(f"{what} {number} is claimed by two services")
            whole[number] = entry
    return whole
