"""An MCAP file being written: chunks of messages, each put to the file in one piece.

The format is https://mcap.dev/spec and the records are those of the `mcap` package; only the writing is ours, for
two reasons. A message costs 0.7 us here and 3.3 us through `mcap.writer` (one core, 60 B messages), and messages are
what a recording has most of. And a chunk with its indexes reaches the file by one write that is taken back if it fails,
so the file always ends behind a whole chunk.

Nothing is written that was not passed in, no clock is read: the same calls give the same bytes.
"""

import struct
import zlib
from collections.abc import Mapping
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


class Container:
    """Writes one MCAP file: zstd chunks, CRCs, message indexes, statistics, summary.

    Parameters
    ----------
    output : an empty file; the caller closes it.

    Raises
    ------
    OSError    From every method that writes, when the file cannot take it; the file then ends behind the last piece
        that went in whole, and nothing more should be written.
    """

    def __init__(self, output: Output) -> None:
        self._output = output
        self._offset = 0
        self._crc = 0
        self._compressor = zstandard.ZstdCompressor(level=3)
        self._schemas: list[Schema] = []
        self._channels: list[Channel] = []
        self._chunks: list[ChunkIndex] = []
        self._attachments: list[AttachmentIndex] = []
        self._metadata: list[MetadataIndex] = []
        self._counts: dict[int, int] = {}
        self._start_ns: int | None = None
        self._end_ns = 0
        self._parts: list[bytes] = []  # of the open chunk
        self._size = 0
        self._index: dict[int, list[int]] = {}  # channel -> [log time, offset in chunk, log time, ...]
        self._write(MAGIC + _bytes_of(Header(PROFILE, LIBRARY)))

    def add_metadata(self, name: str, values: Mapping[str, str]) -> None:
        """Write a named table of strings now, behind the chunk in progress."""
        self.flush()
        data = _bytes_of(Metadata(name=name, metadata=dict(values)))
        self._metadata.append(MetadataIndex(offset=self._offset, length=len(data), name=name))
        self._write(data)

    def add_attachment(self, name: str, media_type: str, data: bytes) -> None:
        """Write a named file now, behind the chunk in progress."""
        self.flush()
        record = _bytes_of(McapAttachment(create_time=0, log_time=0, name=name, media_type=media_type, data=data))
        self._attachments.append(
            AttachmentIndex(
                offset=self._offset,
                length=len(record),
                create_time=0,
                log_time=0,
                data_size=len(data),
                name=name,
                media_type=media_type,
            )
        )
        self._write(record)

    def add_schema(self, name: str, encoding: str, data: bytes) -> int:
        """Declare a schema; returns its id, from 1."""
        schema_id = len(self._schemas) + 1
        schema = Schema(id=schema_id, name=name, encoding=encoding, data=data)
        self._schemas.append(schema)
        self._into_chunk(_bytes_of(schema))
        return schema_id

    def add_channel(self, topic: str, encoding: str, schema_id: int, metadata: Mapping[str, str]) -> int:
        """Declare a channel; returns its id, from 1. Schema 0 is none."""
        channel_id = len(self._channels) + 1
        channel = Channel(
            id=channel_id,
            topic=topic,
            message_encoding=encoding,
            schema_id=schema_id,
            metadata=dict(metadata),
        )
        self._channels.append(channel)
        self._counts[channel_id] = 0
        self._into_chunk(_bytes_of(channel))
        return channel_id

    def add_message(self, channel_id: int, sequence: int, log_ns: int, publish_ns: int, data: bytes) -> None:
        """Append a message to the chunk in progress. Times in [ns], sequence modulo 2^32."""
        index = self._index.get(channel_id)
        if index is None:
            index = self._index[channel_id] = []
        index += (log_ns, self._size)
        length = _MESSAGE_FIXED + len(data)
        self._parts += (_MESSAGE.pack(5, length, channel_id, sequence & 0xFFFFFFFF, log_ns, publish_ns), data)
        self._size += 9 + length
        if self._size >= CHUNK_BYTES:
            self.flush()

    def flush(self) -> None:
        """End the chunk in progress and put it to the file; without a message in it, nothing happens."""
        if not self._index:
            return
        records = b"".join(self._parts)
        compressed = self._compressor.compress(records)
        times = [(min(entries[0::2]), max(entries[0::2])) for entries in self._index.values()]
        first, last = min(time[0] for time in times), max(time[1] for time in times)
        chunk = _bytes_of(
            Chunk(
                compression="zstd",
                data=compressed,
                message_start_time=first,
                message_end_time=last,
                uncompressed_crc=zlib.crc32(records),
                uncompressed_size=len(records),
            )
        )
        pieces, offset, offsets = [chunk], self._offset + len(chunk), {}
        for channel_id, entries in self._index.items():
            offsets[channel_id] = offset
            payload = struct.pack(f"<{len(entries)}Q", *entries)
            pieces.append(_INDEX.pack(Opcode.MESSAGE_INDEX, 6 + len(payload), channel_id, len(payload)) + payload)
            offset += len(pieces[-1])
        summary = ChunkIndex(
            message_start_time=first,
            message_end_time=last,
            chunk_start_offset=self._offset,
            chunk_length=len(chunk),
            message_index_offsets=offsets,
            message_index_length=offset - self._offset - len(chunk),
            compression="zstd",
            compressed_size=len(compressed),
            uncompressed_size=len(records),
        )
        self._write(b"".join(pieces))
        self._chunks.append(summary)
        for channel_id, entries in self._index.items():
            self._counts[channel_id] += len(entries) // 2
        self._start_ns = first if self._start_ns is None else min(self._start_ns, first)
        self._end_ns = max(self._end_ns, last)
        self._parts, self._size, self._index = [], 0, {}

    def finish(self) -> None:
        """Write the last chunk, the summary and the footer; the file is then complete."""
        self.flush()
        self._write(_bytes_of(DataEnd(self._crc)))
        statistics = Statistics(
            message_count=sum(self._counts.values()),
            schema_count=len(self._schemas),
            channel_count=len(self._channels),
            attachment_count=len(self._attachments),
            metadata_count=len(self._metadata),
            chunk_count=len(self._chunks),
            message_start_time=self._start_ns or 0,
            message_end_time=self._end_ns,
            channel_message_counts={channel: count for channel, count in self._counts.items() if count},
        )
        groups: list[tuple[Opcode, list[bytes]]] = [
            (Opcode.SCHEMA, [_bytes_of(record) for record in self._schemas]),
            (Opcode.CHANNEL, [_bytes_of(record) for record in self._channels]),
            (Opcode.STATISTICS, [_bytes_of(statistics)]),
            (Opcode.CHUNK_INDEX, [_bytes_of(record) for record in self._chunks]),
            (Opcode.ATTACHMENT_INDEX, [_bytes_of(record) for record in self._attachments]),
            (Opcode.METADATA_INDEX, [_bytes_of(record) for record in self._metadata]),
        ]
        summary_start = position = self._offset
        summary, offsets = b"", b""
        for opcode, records in groups:
            group = b"".join(records)
            if group:
                offsets += _bytes_of(SummaryOffset(group_opcode=opcode, group_start=position, group_length=len(group)))
            summary += group
            position += len(group)
        tail = summary + offsets
        # The summary's CRC covers the footer too, up to the CRC itself.
        crc = zlib.crc32(tail + struct.pack("<BQQQ", Opcode.FOOTER, 20, summary_start, position))
        footer = Footer(summary_start=summary_start, summary_offset_start=position, summary_crc=crc)
        self._write(tail + _bytes_of(footer) + MAGIC)

    def _into_chunk(self, record: bytes) -> None:
        self._parts.append(record)
        self._size += len(record)

    def _write(self, data: bytes) -> None:
        """Put a piece to the file, whole or not at all."""
        rest = memoryview(data)
        try:
            while rest:
                rest = rest[self._output.write(rest) or 0 :]
        except OSError:
            self._output.truncate(self._offset)
            self._output.seek(self._offset)
            raise
        self._offset += len(data)
        self._crc = zlib.crc32(data, self._crc)


def _bytes_of(record: McapRecord) -> bytes:
    """A record as it stands in the file."""
    builder = RecordBuilder()
    record.write(builder)
    data: bytes = builder.end()
    return data
