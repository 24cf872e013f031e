"""An MCAP file being written: chunks of messages, each put to the file in one piece.

The format is https://mcap.dev/spec and the records are those of the `mcap` package; only the writing is ours, for
two reasons. A message costs 0.7 us here and 3.3 us through `mcap.writer` (one core, 60 B messages), and messages are
what a recording has most of. And a chunk with its indexes reaches the file by one write that is taken back if it fails,
with an end behind it that the next chunk takes the place of: whatever becomes of us, others read the file to its end.

Nothing is written that was not passed in, no clock is read: the same calls give the same bytes.
"""

import struct
import zlib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Literal, Protocol

import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import Attachment as McapAttachment
from mcap.records import (
    AttachmentIndex,
    Channel,
    Chunk,
    ChunkIndex,
    DataEnd,
    Footer,
    Header,
    McapRecord,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)

MAGIC = b"\x89MCAP0\r\n"
CHUNK_BYTES = 1024 * 1024
"""A chunk ends at this size even if nobody asks for a flush."""
LIBRARY = "mavlink-companion"
PROFILE = "mavlink"

Direction = Literal["rx", "tx"]
"""Which way a datagram went: to us, or from us."""

_MESSAGE = struct.Struct("<BQHIQQ")
_MESSAGE_FIXED = 22  # bytes of a message record between its length and its data
_INDEX = struct.Struct("<BQHI")


@dataclass(frozen=True, slots=True)
class Attachment:
    """A file kept inside the recording: the mission, a world."""

    name: str
    media_type: str
    data: bytes


class Output(Protocol):
    """An unbuffered binary file (`open(path, "xb", buffering=0)`) or anything that behaves like one."""

    def write(self, data: memoryview, /) -> int | None: ...

    def truncate(self, size: int, /) -> int: ...

    def seek(self, offset: int, /) -> int: ...


class Summary:
    """What stands at the end of a file: declarations, statistics, and where everything is."""

    def __init__(self) -> None:
        self.schemas: list[Schema] = []
        self.channels: list[Channel] = []
        self.counts: dict[int, int] = {}  # channel -> messages
        self._chunks: list[ChunkIndex] = []
        self._attachments: list[AttachmentIndex] = []
        self._metadata: list[MetadataIndex] = []
        self._start_ns: int | None = None
        self.end_ns = 0

    @property
    def messages(self) -> int:
        return sum(self.counts.values())

    def add_metadata(self, name: str, offset: int, length: int) -> None:
        """A metadata record of `length` bytes stands at `offset`."""
        self._metadata.append(MetadataIndex(offset=offset, length=length, name=name))

    def add_attachment(self, record: McapAttachment, offset: int, length: int) -> None:
        """An attachment record of `length` bytes stands at `offset`."""
        self._attachments.append(
            AttachmentIndex(
                offset=offset,
                length=length,
                create_time=record.create_time,
                log_time=record.log_time,
                data_size=len(record.data),
                name=record.name,
                media_type=record.media_type,
            )
        )

    def add_chunk(self, index: ChunkIndex, counts: Mapping[int, int]) -> None:
        """A chunk with so many messages of each channel stands where `index` says."""
        self._chunks.append(index)
        for channel_id, count in counts.items():
            self.counts[channel_id] = self.counts.get(channel_id, 0) + count
        if counts:
            self.span(index.message_start_time, index.message_end_time)

    def span(self, first_ns: int, last_ns: int) -> None:
        """There are messages of these log times."""
        self._start_ns = first_ns if self._start_ns is None else min(self._start_ns, first_ns)
        self.end_ns = max(self.end_ns, last_ns)

    def tail(self, data_crc: int, position: int) -> bytes:
        """The end of a file whose data section, with this checksum, ends at `position`: DataEnd to the magic."""
        data_end = bytes_of(DataEnd(data_crc))
        statistics = Statistics(
            message_count=self.messages,
            schema_count=len(self.schemas),
            channel_count=len(self.channels),
            attachment_count=len(self._attachments),
            metadata_count=len(self._metadata),
            chunk_count=len(self._chunks),
            message_start_time=self._start_ns or 0,
            message_end_time=self.end_ns,
            channel_message_counts={channel: count for channel, count in self.counts.items() if count},
        )
        groups: list[tuple[Opcode, list[bytes]]] = [
            (Opcode.SCHEMA, [bytes_of(record) for record in self.schemas]),
            (Opcode.CHANNEL, [bytes_of(record) for record in self.channels]),
            (Opcode.STATISTICS, [bytes_of(statistics)]),
            (Opcode.CHUNK_INDEX, [bytes_of(record) for record in self._chunks]),
            (Opcode.ATTACHMENT_INDEX, [bytes_of(record) for record in self._attachments]),
            (Opcode.METADATA_INDEX, [bytes_of(record) for record in self._metadata]),
        ]
        summary_start = position = position + len(data_end)
        summary, offsets = b"", b""
        for opcode, records in groups:
            group = b"".join(records)
            if group:
                offsets += bytes_of(SummaryOffset(group_opcode=opcode, group_start=position, group_length=len(group)))
            summary += group
            position += len(group)
        return data_end + _footed(summary + offsets, summary_start, position)


def bare_tail(data_crc: int) -> bytes:
    """The shortest end there is, of 59 bytes: without a summary, which readers then make for themselves."""
    return bytes_of(DataEnd(data_crc)) + _footed(b"", 0, 0)


def _footed(summary: bytes, start: int, offset_start: int) -> bytes:
    # The summary's CRC covers the footer too, up to the CRC itself.
    crc = zlib.crc32(summary + struct.pack("<BQQQ", Opcode.FOOTER, 20, start, offset_start))
    footer = Footer(summary_start=start, summary_offset_start=offset_start, summary_crc=crc)
    return summary + bytes_of(footer) + MAGIC


def chunk_of(records: bytes, index: Mapping[int, Sequence[int]], offset: int) -> tuple[bytes, ChunkIndex]:
    """A chunk and its message indexes as they stand in the file at `offset`, and what the summary says of them.

    Parameters
    ----------
    records : the chunk's content.
    index : channel -> log time [ns], offset in `records`, log time, ... of its messages.
    """
    compressed = zstandard.ZstdCompressor(level=3).compress(records)
    times = [(min(entries[0::2]), max(entries[0::2])) for entries in index.values()]
    first, last = min((time[0] for time in times), default=0), max((time[1] for time in times), default=0)
    chunk = bytes_of(
        Chunk(
            compression="zstd",
            data=compressed,
            message_start_time=first,
            message_end_time=last,
            uncompressed_crc=zlib.crc32(records),
            uncompressed_size=len(records),
        )
    )
    indexes, offsets = indexes_of(index, offset + len(chunk))
    return chunk + indexes, ChunkIndex(
        message_start_time=first,
        message_end_time=last,
        chunk_start_offset=offset,
        chunk_length=len(chunk),
        message_index_offsets=offsets,
        message_index_length=len(indexes),
        compression="zstd",
        compressed_size=len(compressed),
        uncompressed_size=len(records),
    )


def indexes_of(index: Mapping[int, Sequence[int]], offset: int) -> tuple[bytes, dict[int, int]]:
    """The message indexes of a chunk that ends at `offset`, and where each channel's stands."""
    pieces, offsets = [], {}
    for channel_id, entries in index.items():
        offsets[channel_id] = offset
        payload = struct.pack(f"<{len(entries)}Q", *entries)
        pieces.append(_INDEX.pack(Opcode.MESSAGE_INDEX, 6 + len(payload), channel_id, len(payload)) + payload)
        offset += len(pieces[-1])
    return b"".join(pieces), offsets


class Container:
    """Writes one MCAP file: zstd chunks, CRCs, message indexes, statistics, summary.

    Parameters
    ----------
    output : an empty file; the caller closes it.

    Attributes
    ----------
    size : of the file so far, without the chunk in progress and the end [bytes].
    newest_ns : greatest log time in it; 0 without a message.

    Raises
    ------
    OSError    From every method that writes, when the file cannot take it; the file then ends behind the last piece
        that went in whole and a bare end, and nothing but `abandon` should be called.
    """

    def __init__(self, output: Output) -> None:
        self._output = output
        self.size = 0
        self._crc = 0
        self._summary = Summary()
        self._parts: list[bytes] = []  # of the open chunk
        self._open = 0  # its size
        self._index: dict[int, list[int]] = {}  # channel -> [log time, offset in chunk, log time, ...]
        self._write(MAGIC + bytes_of(Header(PROFILE, LIBRARY)))

    @property
    def newest_ns(self) -> int:
        return self._summary.end_ns

    def add_metadata(self, name: str, values: Mapping[str, str]) -> None:
        """Write a named table of strings now, behind the chunk in progress."""
        self.flush()
        data = bytes_of(Metadata(name=name, metadata=dict(values)))
        offset = self.size
        self._write(data)
        self._summary.add_metadata(name, offset, len(data))

    def add_attachment(self, name: str, media_type: str, data: bytes) -> None:
        """Write a named file now, behind the chunk in progress."""
        self.flush()
        attachment = McapAttachment(create_time=0, log_time=0, name=name, media_type=media_type, data=data)
        record = bytes_of(attachment)
        offset = self.size
        self._write(record)
        self._summary.add_attachment(attachment, offset, len(record))

    def add_schema(self, name: str, encoding: str, data: bytes) -> int:
        """Declare a schema; returns its id, from 1."""
        schema_id = len(self._summary.schemas) + 1
        schema = Schema(id=schema_id, name=name, encoding=encoding, data=data)
        self._summary.schemas.append(schema)
        self._into_chunk(bytes_of(schema))
        return schema_id

    def add_channel(self, topic: str, encoding: str, schema_id: int, metadata: Mapping[str, str]) -> int:
        """Declare a channel; returns its id, from 1. Schema 0 is none."""
        channel_id = len(self._summary.channels) + 1
        channel = Channel(
            id=channel_id,
            topic=topic,
            message_encoding=encoding,
            schema_id=schema_id,
            metadata=dict(metadata),
        )
        self._summary.channels.append(channel)
        self._into_chunk(bytes_of(channel))
        return channel_id

    def add_message(self, channel_id: int, sequence: int, log_ns: int, publish_ns: int, data: bytes) -> None:
        """Append a message to the chunk in progress. Times in [ns], sequence modulo 2^32."""
        index = self._index.get(channel_id)
        if index is None:
            index = self._index[channel_id] = []
        index += (log_ns, self._open)
        length = _MESSAGE_FIXED + len(data)
        self._parts += (_MESSAGE.pack(5, length, channel_id, sequence & 0xFFFFFFFF, log_ns, publish_ns), data)
        self._open += 9 + length
        if self._open >= CHUNK_BYTES:
            self.flush()

    def flush(self) -> None:
        """End the chunk in progress and put it to the file; without a message in it, nothing happens."""
        if not self._index:
            return
        data, index = chunk_of(b"".join(self._parts), self._index, self.size)
        self._write(data)
        self._summary.add_chunk(index, {channel: len(entries) // 2 for channel, entries in self._index.items()})
        self._parts, self._open, self._index = [], 0, {}

    def finish(self) -> None:
        """Write the last chunk, the summary and the footer; the file is then complete."""
        self.flush()
        self._write(self._summary.tail(self._crc, self.size), last=True)

    def abandon(self) -> dict[int, int]:
        """After an OSError: end the file with what is in it, as well as the disk allows.

        Returns
        -------
        How many messages of each channel are not in it: those of the chunk in progress.
        """
        lost = {channel: len(entries) // 2 for channel, entries in self._index.items()}
        self._parts, self._open, self._index = [], 0, {}
        with suppress(OSError):  # without a summary it is, then
            self._write(self._summary.tail(self._crc, self.size), last=True)
        return lost

    def _into_chunk(self, record: bytes) -> None:
        self._parts.append(record)
        self._open += len(record)

    def _write(self, data: bytes, last: bool = False) -> None:
        """Put a piece to the file, whole or not at all, and behind it an end that the next piece takes the place of.

        So the file is whole at any moment, but for its summary, and there is always room for its end.
        """
        crc = zlib.crc32(data, self._crc)
        rest = memoryview(data if last else data + bare_tail(crc))
        try:
            self._output.seek(self.size)
            while rest:
                rest = rest[self._output.write(rest) or 0 :]
        except OSError:
            self._take_back()
            raise
        self.size += len(data)
        self._crc = crc

    def _take_back(self) -> None:
        """Nothing stands behind the last whole piece but its end; the place for that was there before."""
        end = bare_tail(self._crc) if self.size else b""
        self._output.seek(self.size)
        rest = memoryview(end)
        with suppress(OSError):
            while rest:
                rest = rest[self._output.write(rest) or 0 :]
        self._output.truncate(self.size + len(end) - len(rest))


def bytes_of(record: McapRecord) -> bytes:
    """A record as it stands in the file."""
    builder = RecordBuilder()
    record.write(builder)
    data: bytes = builder.end()
    return data
