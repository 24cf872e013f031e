"""Which messages of a recording are wanted: by topic, message name, sender, link and time."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from difflib import get_close_matches
from fnmatch import fnmatchcase

from logs.errors import RecordingError
from logs.reader import ChannelInfo, RecordedMessage, Recording
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
    names : message names such as ``ATTITUDE``, in capitals or not. A datagram is wanted, whole, for any packet in it.
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
        object.__setattr__(self, "names", tuple(name.upper() for name in self.names))
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


def datagrams(messages: Iterable[RecordedMessage], wanted: Selection) -> Iterator[RecordedMessage]:
    """The wanted ones among the raw datagrams, where topics name packets too: as `companion log info` lists them.

    A datagram goes whole for any packet in it, as with names: of `/mavlink/1/1/ATTITUDE` all that hold one.
    """
    framer = Framer()
    for message in selected(messages, replace(wanted, topics=())):
        if message.channel.direction is not None and (
            not wanted.topics or any(_like(topic, wanted.topics) for topic in _topics(framer, message))
        ):
            yield message


def name_of(channel: ChannelInfo) -> str:
    """The name of a channel's messages, such as ``ATTITUDE``; empty for raw datagrams."""
    return channel.schema.rpartition(".")[2]


def nothing_left(recording: Recording, wanted: Selection, what: str = "decoded message") -> RecordingError:
    """The error of a selection that leaves nothing: what of it the recording does not hold, and what may be meant."""
    channels = set(message.channel for message in recording.messages())
    topics = {channel.topic for channel in channels}
    names = {name_of(channel).upper() for channel in channels} - {""}
    if not any(system is not None for system, _ in map(sender, topics)):  # no packet was decoded: look into them
        framer = Framer()
        raw = (message for message in recording.messages() if message.channel.direction is not None)
        packets = {topic for message in raw for topic in _topics(framer, message)} - topics
        topics |= packets
        names |= {topic.rpartition("/")[2] for topic in packets}
    systems = {system for system, _ in map(sender, topics) if system is not None}
    told = []
    for name in wanted.names:
        if name not in names:
            near = get_close_matches(name, names, n=1)
            told.append(f"it holds no {name}{f' (did you mean {near[0]}?)' if near else ''}")
    told += [
        f"no topic is like {pattern!r}" for pattern in wanted.topics if not any(_like(t, (pattern,)) for t in topics)
    ]
    if wanted.systems and systems.isdisjoint(wanted.systems):
        told.append(
            f"nothing is of system {wanted.systems[0]} (systems: {', '.join(map(str, sorted(systems))) or 'none'})"
        )
    return RecordingError(recording.path, "; ".join([f"no {what} is left of what is asked for", *told]))


def _channel_wanted(channel: ChannelInfo, wanted: Selection) -> bool | None:
    """Whether a channel is wanted; None: each of its datagrams is to be asked."""
    if wanted.topics and not _like(channel.topic, wanted.topics):
        return False
    if wanted.links and channel.link not in wanted.links:
        return False
    if not wanted.names and not wanted.systems:
        return True
    if channel.direction is not None:
        return None
    if wanted.systems and sender(channel.topic)[0] not in wanted.systems:
        return False
    return not wanted.names or name_of(channel).upper() in wanted.names


def _datagram_wanted(framer: Framer, data: bytes, wanted: Selection) -> bool:
    for packet in framer.packets(data):
        if wanted.systems and packet.system_id not in wanted.systems:
            continue
        definition = mavlink.mavlink_map.get(packet.message_id)
        if not wanted.names or (definition is not None and definition.msgname in wanted.names):
            return True
    return False


def _like(topic: str, patterns: tuple[str, ...]) -> bool:
    return any(fnmatchcase(topic, pattern) for pattern in patterns)


def _topics(framer: Framer, message: RecordedMessage) -> Iterator[str]:
    """A datagram's own topic, and those its packets are decoded to."""
    yield message.channel.topic
    for packet in framer.packets(message.data):
        definition = mavlink.mavlink_map.get(packet.message_id)
        if definition is not None:
            yield f"/mavlink/{packet.system_id}/{packet.component_id}/{definition.msgname}"
