"""Wire replay: the vehicle's recorded traffic again, with its own spacing, for a ground station to look at.

Only what the vehicle sent is replayed. What was sent to it (setpoints, commands) stays in the file, unless
`sent_traffic` is asked for it by name, and then nothing else comes with it.
This is the pacing, without a socket or a clock; `logs.replay_driver` sends.
"""

from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from logs.errors import RecordingError
from logs.reader import RecordedMessage, Recording
from logs.secrets import carries_key
from logs.selection import Selection, datagrams
from wire.dialect import mavlink
from wire.framing import Framer, Packet

LEAST_GAP_S = 0.001
"""Between the end of a recording and its beginning again [s], at least."""


@dataclass(frozen=True, slots=True)
class Due:
    """A datagram and when to send it [s] after the start of the replay; `at_s`: where it is in the recording [s]."""

    due_s: float
    data: bytes
    at_s: float = 0.0


def vehicle_links(recording: Recording) -> tuple[str, ...]:
    """The links on which an autopilot's HEARTBEAT was received, in the order of the first.

    Raises
    ------
    RecordingError    No autopilot was heard on any link.
    """
    heard, others = _links(recording, first=False)
    if not heard:
        raise _nobody(recording, others)
    return heard


def vehicle_link(recording: Recording) -> str:
    """The link toward the vehicle: the first on which an autopilot's HEARTBEAT was received.

    Raises
    ------
    RecordingError    No autopilot was heard on any link.
    """
    heard, others = _links(recording, first=True)
    if not heard:
        raise _nobody(recording, others)
    return heard[0]


def _nobody(recording: Recording, others: Collection[str]) -> RecordingError:
    """The error where no autopilot was heard, and what the recording is instead."""
    if others:
        return RecordingError(recording.path, f"no autopilot was heard on any link (links: {', '.join(others)})")
    made = recording.metadata.get("import", {}).get("format")
    if not any(message.channel.direction for message in recording.messages()):
        of = f", made of a {made} log," if made else ""
        return RecordingError(recording.path, f"the recording{of} holds decoded messages only, no datagrams to send")
    return RecordingError(recording.path, "no autopilot was heard: nothing was received (a vehicle's own recording?)")


def _links(recording: Recording, first: bool) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Links with an autopilot, and all links something was received on; looked for no further than the `first`."""
    framer, decoder = Framer(), mavlink.MAVLink(None)
    heard: dict[str, None] = {}
    found: dict[str, None] = {}
    for message in recording.messages():
        link = message.channel.link
        if message.channel.direction != "rx" or link in found:
            continue
        heard[link] = None
        if any(is_autopilot(packet, decoder) for packet in framer.packets(message.data)):
            found[link] = None
        if first and found:
            break
    return tuple(found), tuple(heard)


def is_autopilot(packet: Packet, decoder: Any) -> bool:
    """Whether a packet is an autopilot's HEARTBEAT; `decoder` is a MAVLink of pymavlink's."""
    if packet.message_id != mavlink.MAVLINK_MSG_ID_HEARTBEAT or packet.component_id != 1:
        return False
    return bool(decoder.decode(bytearray(packet.raw)).autopilot != mavlink.MAV_AUTOPILOT_INVALID)


def vehicle_traffic(recording: Recording, link: str, wanted: Selection | None = None) -> Iterator[RecordedMessage]:
    """The datagrams received on a link, in order; nothing that was sent, and no SETUP_SIGNING (`logs.secrets`)."""
    return _traffic(recording, link, "rx", wanted)


def sent_traffic(recording: Recording, link: str, wanted: Selection | None = None) -> Iterator[RecordedMessage]:
    """The datagrams sent on a link, in order: setpoints and commands, which a vehicle would obey once more."""
    return _traffic(recording, link, "tx", wanted)


def _traffic(recording: Recording, link: str, direction: str, wanted: Selection | None) -> Iterator[RecordedMessage]:
    for message in datagrams(recording.messages(), wanted or Selection()):
        channel = message.channel
        if channel.direction == direction and channel.link == link and not carries_key(message.data):
            yield message


def paced(messages: Iterable[RecordedMessage], rate: float = 1.0, origin_ns: int | None = None) -> Iterator[Due]:
    """Give every datagram its time: the recorded spacing, divided by `rate`; never earlier than the one before.

    Parameters
    ----------
    origin_ns : log time from which `Due.at_s` counts [ns]; of the first datagram, if None.

    Raises
    ------
    ValueError    `rate` is not a positive number.
    """
    if not 0.0 < rate < float("inf"):
        raise ValueError(f"rate is {rate}; expected a positive number")
    return _paced(messages, rate, origin_ns)


def _paced(messages: Iterable[RecordedMessage], rate: float, origin_ns: int | None) -> Iterator[Due]:
    start_ns: int | None = None
    due_s = 0.0
    for message in messages:
        if start_ns is None:
            start_ns = message.log_time_ns
        due_s = max(due_s, (message.log_time_ns - start_ns) / 1e9 / rate)
        at_ns = message.log_time_ns - (start_ns if origin_ns is None else origin_ns)
        yield Due(due_s, message.data, at_ns / 1e9)


def repeated(again: Callable[[], Iterable[Due]], rounds: int | None = None) -> Iterator[Due]:
    """The same traffic again and again, `rounds` times or for ever; the mean spacing stands between two rounds."""
    base_s = 0.0
    done = 0
    while rounds is None or done < rounds:
        count, last_s = 0, 0.0
        for due in again():
            count += 1
            last_s = due.due_s
            yield replace(due, due_s=base_s + due.due_s)
        if not count:
            return
        base_s += last_s + max(LEAST_GAP_S, last_s / (count - 1) if count > 1 else 1.0)
        done += 1


class Pace:
    """When what is due is sent, with pauses and single steps; all times in [s] of one clock.

    Parameters
    ----------
    now_s : the replay starts.
    """

    def __init__(self, now_s: float) -> None:
        self._start_s = now_s  # when what is due at 0 is sent
        self._position_s = 0.0  # of the replay, while paused
        self._steps = 0
        self.paused = False

    def toggle(self, now_s: float) -> None:
        """Pause, or go on: the next datagram keeps its distance to the last."""
        if self.paused:
            self._start_s = now_s - self._position_s
        else:
            self._position_s = now_s - self._start_s
        self.paused = not self.paused
        self._steps = 0

    def step(self, now_s: float) -> None:
        """Send one datagram and stand still; pauses what runs."""
        if not self.paused:
            self.toggle(now_s)
        self._steps += 1

    def deadline(self, due: Due) -> float | None:
        """When it is to be sent; None: not as long as the replay stands still."""
        if not self.paused:
            return self._start_s + due.due_s
        return self._start_s if self._steps else None

    def sent(self, due: Due) -> None:
        """It was sent."""
        if self.paused and self._steps:
            self._steps -= 1
            self._position_s = max(self._position_s, due.due_s)
