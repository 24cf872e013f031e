"""A recording as a table of ticks: what a re-run feeds to a fresh core, and what it compares with.

Recorder and reader agree on one rule: `sequence` is the tick, and the order in the file is the order at the seam. So a
tick's inputs are its rx datagrams, `PlanReady` and `OperatorCommand` in file order; its outputs are its tx datagrams,
`PlanWanted`, `Note` and `Reference` in file order; its `Tick` record gives `now_us` and how many there must be of each.
"""

import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from logs import schema
from logs.errors import RecordingError
from logs.reader import RecordedMessage, Recording
from logs.secrets import masked
from wire.datagram import Datagram

Entry = Datagram | schema.Record
"""A datagram with its link and peer, or one of our records."""


@dataclass(slots=True)
class RecordedTick:
    """One row.

    Attributes
    ----------
    index : of the tick; now_us : the time the core was given [us].
    declared : its `Tick` record.
    inputs, outputs : (log time [ns], what), in the order of the seam.
    """

    index: int
    now_us: int
    declared: schema.Tick | None = None
    inputs: list[tuple[int, Entry]] = field(default_factory=list)
    outputs: list[tuple[int, Entry]] = field(default_factory=list)


def ticks(recording: Recording) -> Iterator[RecordedTick]:
    """The ticks of a recording, in order.

    Of a recording that ends early the last ticks are left out unless all that belongs to them is there
    (`Recording.may_lack`).

    Raises
    ------
    RecordingError    Ticks are missing, mixed up, or lack entries (the recorder dropped some): such a recording can
        be looked at, but not run again.
    """
    may_lack = recording.may_lack
    lacking: RecordingError | None = None
    for row in _rows(recording):
        if lacking is None:
            try:
                checked = _checked(recording, row)
            except RecordingError as error:
                lacking = error
            else:
                yield checked
                continue
        may_lack -= 1
        if may_lack < 0:
            raise lacking


def _rows(recording: Recording) -> Iterator[RecordedTick]:
    """The ticks as they are."""
    row: RecordedTick | None = None
    expected = 0
    for message in recording.messages():
        try:
            entry = entry_of(message)
        except ValueError as error:
            raise RecordingError(recording.path, f"tick {message.tick}: {error}") from error
        if entry is None:
            continue
        if row is None or message.tick != row.index:
            if row is not None:
                yield row
            if message.tick != expected:
                raise RecordingError(recording.path, f"tick {message.tick} follows where tick {expected} should be")
            row = RecordedTick(message.tick, message.publish_time_ns // 1000)
            expected += 1
        if isinstance(entry, schema.Tick):
            row.declared, row.now_us = entry, entry.now_us
        elif is_input(message):
            row.inputs.append((message.log_time_ns, entry))
        else:
            row.outputs.append((message.log_time_ns, entry))
    if row is not None:
        yield row


def inputs_digest(inputs: Iterable[Entry]) -> int:
    """CRC-32 over a tick's inputs in order: link and bytes of a datagram, schema name and bytes of a record.

    With it in every tick, a changed input is found even where it changes no output. Keys count as they are recorded.
    """
    crc = 0
    for entry in inputs:
        if isinstance(entry, Datagram):
            crc = zlib.crc32(masked(entry.data), zlib.crc32(entry.link.encode(), crc))
        else:
            crc = zlib.crc32(schema.encode(entry), zlib.crc32(schema.schema_name(type(entry)).encode(), crc))
    return crc


def entry_of(message: RecordedMessage) -> Entry | None:
    """The datagram or record in a message; None for a decoded copy of a packet, and for what did not cross the seam.

    Raises
    ------
    ValueError    A record's bytes do not fit its schema.
    """
    channel = message.channel
    if channel.direction is not None:
        return Datagram(channel.link, message.data, channel.peer)
    kind = schema.kind_of(channel.schema)
    return None if kind is None or kind in schema.ASIDE else schema.decode(kind, message.data)


def is_input(message: RecordedMessage) -> bool:
    """Whether a message went into the core rather than came out of it."""
    channel = message.channel
    return channel.direction == "rx" or schema.kind_of(channel.schema) in schema.INPUTS


def _checked(recording: Recording, row: RecordedTick) -> RecordedTick:
    """The row, if it holds all that its `Tick` record says."""
    declared = row.declared
    if declared is None:
        raise RecordingError(recording.path, f"tick {row.index} has no {schema.schema_name(schema.Tick)} record")
    found, said = (len(row.inputs), len(row.outputs)), (declared.inputs, declared.outputs)
    if found != said:
        raise RecordingError(
            recording.path,
            f"tick {row.index} has {found[0]} of {said[0]} inputs and {found[1]} of {said[1]} outputs: some were lost",
        )
    return row
