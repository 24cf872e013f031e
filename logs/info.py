"""What is in a recording, at a glance."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from logs.reader import Recording


@dataclass(frozen=True, slots=True)
class TopicInfo:
    """A topic, its schema (or encoding), how many messages, and how many a second from its first to its last [1/s]."""

    topic: str
    schema: str
    count: int
    rate_hz: float


@dataclass(frozen=True, slots=True)
class LinkInfo:
    """Datagrams and bytes that crossed a link."""

    name: str
    rx_datagrams: int
    rx_bytes: int
    tx_datagrams: int
    tx_bytes: int


@dataclass(frozen=True, slots=True)
class RecordingInfo:
    """The answer to ``companion log info``.

    Attributes
    ----------
    size_bytes, parts : of all files of the recording together; gaps : what is missing between them.
    complete, problem : whether the file was closed properly, and if not, what is wrong.
    start_ns, end_ns, duration_s : first and last log time [ns], and between them [s].
    topics : by name; links : in order of first appearance.
    metadata : the tables of strings; attachments : name and size [bytes] of the files inside.
    """

    path: Path
    size_bytes: int
    parts: int
    gaps: tuple[str, ...]
    complete: bool
    problem: str
    library: str
    start_ns: int
    end_ns: int
    duration_s: float
    messages: int
    topics: tuple[TopicInfo, ...]
    links: tuple[LinkInfo, ...]
    metadata: Mapping[str, Mapping[str, str]]
    attachments: Mapping[str, int]


def info(path: Path) -> RecordingInfo:
    """Read a recording through once and sum it up.

    Raises
    ------
    RecordingError, SchemaVersionError    As `Recording.open`.
    """
    recording = Recording.open(path)
    counts: dict[str, int] = {}
    spans: dict[str, tuple[int, int]] = {}
    schemas: dict[str, str] = {}
    links: dict[str, list[int]] = {}
    start_ns, end_ns, total = 0, 0, 0
    for message in recording.messages():
        channel = message.channel
        counts[channel.topic] = counts.get(channel.topic, 0) + 1
        first_ns, last_ns = spans.get(channel.topic, (message.log_time_ns, message.log_time_ns))
        spans[channel.topic] = min(first_ns, message.log_time_ns), max(last_ns, message.log_time_ns)
        schemas[channel.topic] = channel.schema or channel.encoding
        if channel.direction is not None:
            sums = links.setdefault(channel.link, [0, 0, 0, 0])
            first = 0 if channel.direction == "rx" else 2
            sums[first] += 1
            sums[first + 1] += len(message.data)
        start_ns = message.log_time_ns if not total else min(start_ns, message.log_time_ns)
        end_ns = max(end_ns, message.log_time_ns)
        total += 1
    duration_s = (end_ns - start_ns) / 1e9
    return RecordingInfo(
        path=path,
        size_bytes=sum(part.stat().st_size for part in recording.paths),
        parts=len(recording.paths),
        gaps=recording.gaps,
        complete=recording.complete,
        problem=recording.problem,
        library=recording.library,
        start_ns=start_ns,
        end_ns=end_ns,
        duration_s=duration_s,
        messages=total,
        topics=tuple(
            TopicInfo(topic, schemas[topic], count, _rate_hz(count, *spans[topic]))
            for topic, count in sorted(counts.items())
        ),
        links=tuple(LinkInfo(name, *sums) for name, sums in links.items()),
        metadata=recording.metadata,
        attachments={name: len(attachment.data) for name, attachment in recording.attachments.items()},
    )


def _rate_hz(count: int, first_ns: int, last_ns: int) -> float:
    """Messages a second between the first and the last of them [1/s]."""
    return (count - 1) * 1e9 / (last_ns - first_ns) if last_ns > first_ns else 0.0
