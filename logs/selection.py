"""Which messages of a recording are wanted: by topic, message name, sender, link and time."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase

from logs.reader import ChannelInfo, RecordedMessage
from logs.rows import sender
from wire.dialect import mavlink
from wire.framing import Framer

_BEHIND_NS = 5_000_000_000
"""How far log times may run backwards [ns]; what is later than the end by more ends the reading."""


@dataclass(frozen=True, slots=True)
class Selection:
    """What is wanted. All that is given must be true of a message; of the values of one of them any will do.

    Attributes
    ----------
    topics : patterns such as ``/mavlink/1/*``.
    names : message names such as ``ATTITUDE``. A datagram is wanted, whole, for any packet in it.
    systems : system ids of senders.
    links : names of links; only raw datagrams have one.
    start_s, duration_s : from this long after the recording's first message, for so long [s].
    """

    topics: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    systems: tuple[int, ...] = ()
    links: tuple[str, ...] = ()
    start_s: float = 0.0
    duration_s: float | None = None

    def __post_init__(self) -> None:
        if not 0.0 <= self.start_s < float("inf"):
            raise ValueError(f"start is {self.start_s}; expected a time in seconds, not less than 0")
        if self.duration_s is not None and not 0.0 < self.duration_s < float("inf"):
            raise ValueError(f"duration is {self.duration_s}; expected a time in seconds, more than 0")


def selected(messages: Iterable[RecordedMessage], wanted: Selection) -> Iterator[RecordedMessage]:
    """The wanted ones among all messages of a recording, from its first on, in order."""
    chosen: dict[ChannelInfo, bool | None] = {}
    framer = Framer()
    first_ns = last_ns = 0
    started = False
    for message in messages:
        if not started:
            started = True
            first_ns = message.log_time_ns + round(wanted.start_s * 1e9)
            last_ns = 1 << 64 if wanted.duration_s is None else first_ns + round(wanted.duration_s * 1e9)
        if message.log_time_ns > last_ns + _BEHIND_NS:
            return
        if not first_ns <= message.log_time_ns <= last_ns:
            continue
        channel = message.channel
        if channel not in chosen:
            chosen[channel] = _channel_wanted(channel, wanted)
        verdict = chosen[channel]
        if verdict is None:
            verdict = _datagram_wanted(framer, message.data, wanted)
        if verdict:
            yield message


def _channel_wanted(channel: ChannelInfo, wanted: Selection) -> bool | None:
    """Whether a channel is wanted; None: each of its datagrams is to be asked."""
    if wanted.topics and not any(fnmatchcase(channel.topic, pattern) for pattern in wanted.topics):
        return False
    if wanted.links and channel.link not in wanted.links:
        return False
    if not wanted.names and not wanted.systems:
        return True
    if channel.direction is not None:
        return None
    if wanted.systems and sender(channel.topic)[0] not in wanted.systems:
        return False
    return not wanted.names or channel.schema.rpartition(".")[2] in wanted.names


def _datagram_wanted(framer: Framer, data: bytes, wanted: Selection) -> bool:
    for packet in framer.packets(data):
        if wanted.systems and packet.system_id not in wanted.systems:
            continue
        definition = mavlink.mavlink_map.get(packet.message_id)
        if not wanted.names or (definition is not None and definition.msgname in wanted.names):
            return True
    return False
