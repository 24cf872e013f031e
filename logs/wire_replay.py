"""Wire replay: the vehicle's recorded traffic again, with its own spacing, for a ground station to look at.

Only what the vehicle sent is ever replayed. What the companion sent to it (setpoints, commands) stays in the file.
This is the pacing, without a socket or a clock; `logs.replay_driver` sends.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from logs.errors import RecordingError
from logs.reader import RecordedMessage, Recording
from logs.secrets import carries_key
from wire.dialect import mavlink
from wire.framing import Framer


@dataclass(frozen=True, slots=True)
class Due:
    """A datagram and when to send it [s] after the start of the replay."""

    due_s: float
    data: bytes


def vehicle_link(recording: Recording) -> str:
    """The link toward the vehicle: the first on which an autopilot's HEARTBEAT was received.

    Raises
    ------
    RecordingError    No autopilot was heard on any link.
    """
    framer, decoder = Framer(), mavlink.MAVLink(None)
    heard: dict[str, None] = {}
    for message in recording.messages():
        if message.channel.direction != "rx":
            continue
        heard[message.channel.link] = None
        for packet in framer.packets(message.data):
            if packet.message_id != mavlink.MAVLINK_MSG_ID_HEARTBEAT:
                continue
            heartbeat = decoder.decode(bytearray(packet.raw))
            if packet.component_id == 1 and heartbeat.autopilot != mavlink.MAV_AUTOPILOT_INVALID:
                return message.channel.link
    links = ", ".join(heard) or "nothing received at all"
    raise RecordingError(recording.path, f"no autopilot was heard on any link (links: {links})")


def vehicle_traffic(recording: Recording, link: str) -> Iterator[RecordedMessage]:
    """The datagrams received on a link, in order; nothing that was sent, and no SETUP_SIGNING (`logs.secrets`)."""
    messages = recording.messages(topics=(f"/mavlink/raw/{link}/rx",))
    return (message for message in messages if not carries_key(message.data))


def paced(messages: Iterable[RecordedMessage], rate: float = 1.0) -> Iterator[Due]:
    """Give every datagram its time: the recorded spacing, divided by `rate`; never earlier than the one before.

    Raises
    ------
    ValueError    `rate` is not a positive number.
    """
    if not 0.0 < rate < float("inf"):
        raise ValueError(f"rate is {rate}; expected a positive number")
    return _paced(messages, rate)


def _paced(messages: Iterable[RecordedMessage], rate: float) -> Iterator[Due]:
    start_ns: int | None = None
    due_s = 0.0
    for message in messages:
        if start_ns is None:
            start_ns = message.log_time_ns
        due_s = max(due_s, (message.log_time_ns - start_ns) / 1e9 / rate)
        yield Due(due_s, message.data)
