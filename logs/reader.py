"""Reading recordings, whole or cut short.

A recording is read from front to back, record by record, and every checksum is checked on the way. One that ends
early (a crash, a full disk, a copy that broke off) gives what its whole chunks hold; `Recording.complete` and
`Recording.problem` say so. Nothing here needs the index at the end of the file, and nothing here writes.
"""

import struct
import zlib
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO, Literal

import zstandard
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from mcap.data_stream import ReadDataStream
from mcap.exceptions import EndOfFile
from mcap.opcode import Opcode
from mcap.records import Attachment as McapAttachment
from mcap.records import Channel, Chunk, DataEnd, Footer, Header, Metadata, Schema

from logs import schema
from logs.container import LIBRARY, MAGIC, Attachment, Direction
from logs.errors import RecordingError, SchemaVersionError
from logs.parts import PART, later_parts, number_of
from wire.datagram import Address

_RECORD = struct.Struct("<BQ")
_MESSAGE = struct.Struct("<HIQQ")
_MAX_CHUNK = 256 * 1024 * 1024  # a chunk that claims to be larger is damage; ours end at 1 MiB

RECOVERY, FILTER = "recovery", "filter"
"""Names of the tables that say a file was recovered, or filtered from another."""

Order = Literal["file", "time"]


@dataclass(frozen=True, slots=True)
class ChannelInfo:
    """A channel as declared in the file.

    Attributes
    ----------
    topic, encoding : such as ``/mavlink/raw/autopilot/rx`` and ``mavlink``.
    schema : full protobuf name; empty where there is none.
    link, direction, peer : of a raw channel; empty, None, None otherwise.
    """

    topic: str
    encoding: str
    schema: str
    link: str = ""
    direction: Direction | None = None
    peer: Address | None = None


@dataclass(frozen=True, slots=True)
class RecordedMessage:
    """One message: where it was recorded, when it happened [ns], its tick's time [ns] and index, and its bytes."""

    channel: ChannelInfo
    log_time_ns: int
    publish_time_ns: int
    tick: int
    data: bytes


class Recording:
    """A recording opened for reading; it keeps the paths, not the files open.

    Attributes
    ----------
    path : the file, or the first of its parts. paths : all of them.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.paths = (path, *later_parts(path))
        self._types: dict[str, type[Any]] = {}
        self._schemas: dict[str, bytes] = {}

    @classmethod
    def open(cls, path: Path) -> "Recording":
        """Open a recording and read its header and tables. Of several parts the first stands for all.

        Raises
        ------
        RecordingError        No such file, empty, not an MCAP file, or nothing in it can be read.
        SchemaVersionError    Written by a newer version.
        """
        recording = cls(path)
        version = recording.metadata.get("schema", {}).get("version", "1")
        if not version.isdecimal() or int(version) > schema.SCHEMA_VERSION:
            raise SchemaVersionError(path, version, schema.SCHEMA_VERSION)
        return recording

    @property
    def complete(self) -> bool:
        """Whether the file was closed properly and every checksum in it is right."""
        return not self.problem

    @property
    def problem(self) -> str:
        """Why the recording is not complete; empty if it is."""
        return self._overview.problem

    @property
    def recovered(self) -> bool:
        """Whether its end was made anew (`logs.recovery`): then its last tick may be cut off, complete as it is."""
        return RECOVERY in self.metadata

    @property
    def may_lack(self) -> int:
        """Of how many ticks at its end a part may be missing, though nothing was lost before.

        Of one that ends early the last; of one that was filtered the last three: what one tick sends and the next takes
        in may be on both sides of the time where it ends.
        """
        if FILTER in self.metadata:
            return 3
        return int(self.recovered or not self.complete)

    @property
    def gaps(self) -> tuple[str, ...]:
        """What is missing between its parts, in words."""
        return self._overview.gaps

    @property
    def library(self) -> str:
        """Who wrote the file, by its own header."""
        return self._overview.library

    @property
    def metadata(self) -> Mapping[str, Mapping[str, str]]:
        """The tables of strings, by name; of several parts, as the last says that has it."""
        return self._overview.metadata

    @property
    def attachments(self) -> Mapping[str, Attachment]:
        """The files kept inside, by name."""
        return self._overview.attachments

    def messages(self, topics: Collection[str] | None = None, order: Order = "file") -> Iterator[RecordedMessage]:
        """The messages, or those of some topics.

        Parameters
        ----------
        topics : exact topics wanted; None for all.
        order : "file": as they crossed the seam. "time": by log time (sorted in memory), equal times as in the file.
        """
        found = (item for item in self._scan() if isinstance(item, RecordedMessage))
        if topics is not None:
            wanted = frozenset(topics)
            found = (message for message in found if message.channel.topic in wanted)
        return found if order == "file" else iter(sorted(found, key=lambda message: message.log_time_ns))

    def decode(self, message: RecordedMessage) -> Any:
        """The protobuf message in a recorded message, by the descriptor in the file; None for a raw one.

        Raises
        ------
        RecordingError    The bytes do not fit their own schema.
        """
        name = message.channel.schema
        if not name:
            return None
        kind = self._types.get(name)
        try:
            if kind is None:
                kind = self._types[name] = _message_class(name, self._schemas[name])
            decoded = kind()
            decoded.ParseFromString(message.data)
        except Exception as error:  # DecodeError, KeyError, TypeError: protobuf has no common root for them
            raise RecordingError(self.path, f"a message of {message.channel.topic} is no {name}: {error}") from error
        return decoded

    def descriptor_set(self, schema_name: str) -> bytes:
        """The serialized FileDescriptorSet of a schema that a message read so far has.

        Raises
        ------
        KeyError    No message read so far has it.
        """
        return self._schemas[schema_name]

    @cached_property
    def _overview(self) -> "_Overview":
        """One pass over everything but the messages' insides."""
        overview = _Overview("", {}, {}, "")
        for item in self._scan(messages=False):
            match item:
                case Metadata(name=name, metadata=values) if name == PART and "gap" in values:
                    missing = f"{values.get('gap_missing', '?')} entries are missing before part {values.get('number')}"
                    overview.gaps += (f"{missing}: {values['gap']}",)
                    overview.problem = overview.problem or overview.gaps[-1]
                    overview.metadata[name] = values
                case Header(library=library):
                    overview.library = library
                case Metadata(name=name, metadata=values):
                    overview.metadata[name] = values
                case McapAttachment(name=name, media_type=media_type, data=data):
                    overview.attachments[name] = Attachment(name, media_type, data)
                case _Problem(text=text):
                    overview.problem = overview.problem or text
                case _:
                    pass
        return overview

    def _scan(self, messages: bool = True) -> Iterator[Any]:
        """Every record in the order of the parts; a `_Problem` where one ends that should not end there."""
        for number, path in enumerate(self.paths, start=1):
            expected = number_of(self.path, path)
            if number > 1 and expected != number_of(self.path, self.paths[number - 2]) + 1:
                yield _Problem(f"the part before {path.name} is not there")
            try:
                with open(path, "rb") as file:
                    for item in self._scan_file(path, file, messages):
                        yield _Problem(f"{path.name}: {item.text}") if number > 1 and type(item) is _Problem else item
            except OSError as error:
                raise RecordingError(path, f"cannot read the file: {error.strerror or error}") from error
            except RecordingError as error:
                if number == 1:
                    raise
                yield _Problem(str(error))

    def _scan_file(self, path: Path, file: BinaryIO, messages: bool) -> Iterator[Any]:
        magic = file.read(len(MAGIC))
        if not magic:
            raise RecordingError(path, "the file is empty")
        if magic != MAGIC:
            raise RecordingError(path, f"not an MCAP file (it begins with {magic!r})")
        size = file.seek(0, 2)
        position = file.seek(len(MAGIC))
        channels: dict[int, ChannelInfo] = {}
        schemas: dict[int, str] = {}
        summary = ours = False
        crc = zlib.crc32(magic)  # of everything so far; from DataEnd on, of the summary
        while True:
            head = file.read(_RECORD.size)
            if len(head) < _RECORD.size:
                yield _Problem(f"it ends at byte {size} without a footer: not closed, or cut short")
                return
            opcode, length = _RECORD.unpack(head)
            if position + _RECORD.size + length > size:
                yield _Problem(f"it ends inside a record that begins at byte {position}: not closed, or cut short")
                return
            body = file.read(length)
            try:
                if opcode == Opcode.CHUNK:
                    yield from self._chunk(_open_chunk(body), channels, schemas, messages)
                elif opcode == Opcode.DATA_END:
                    _check(DataEnd.read(ReadDataStream(BytesIO(body))).data_section_crc, crc, "the data section")
                elif opcode == Opcode.FOOTER:
                    _check(
                        Footer.read(ReadDataStream(BytesIO(body))).summary_crc,
                        zlib.crc32(head + body[:-4], crc),
                        "the summary",
                    )
                    if ours and body[:8] == bytes(8):
                        yield _Problem(f"it ends at byte {position} without a summary: not closed")
                        return
                    if file.read(len(MAGIC)) != MAGIC:
                        yield _Problem("the mark at its end is missing: cut short")
                    return
                elif opcode in _TOP_LEVEL:
                    record = _TOP_LEVEL[opcode](ReadDataStream(BytesIO(body)))
                    ours = ours or (isinstance(record, Header) and record.library == LIBRARY)
                    yield record
                elif opcode == Opcode.MESSAGE:
                    raise ValueError("a message outside a chunk")
                elif not summary and opcode == Opcode.MESSAGE_INDEX:
                    _check_index(body)
                elif not summary:
                    raise ValueError(f"a record of kind {opcode}, which no recording has between its chunks")
            except (ValueError, struct.error, EndOfFile, zstandard.ZstdError, KeyError) as error:
                yield _Problem(f"damaged at byte {position}: {error}")
                return
            summary = summary or opcode == Opcode.DATA_END
            crc = 0 if opcode == Opcode.DATA_END else zlib.crc32(body, zlib.crc32(head, crc))
            position += _RECORD.size + length

    def _chunk(
        self, records: bytes, channels: dict[int, ChannelInfo], schemas: dict[int, str], messages: bool
    ) -> Iterator[Any]:
        """Declarations and messages of one chunk."""
        position, end = 0, len(records)
        while position < end:
            opcode, length = _RECORD.unpack_from(records, position)
            position += _RECORD.size
            if opcode == Opcode.MESSAGE:
                if messages:
                    channel, tick, log_ns, publish_ns = _MESSAGE.unpack_from(records, position)
                    data = records[position + _MESSAGE.size : position + length]
                    yield RecordedMessage(channels[channel], log_ns, publish_ns, tick, data)
            elif opcode == Opcode.SCHEMA:
                declared = Schema.read(ReadDataStream(BytesIO(records[position : position + length])))
                schemas[declared.id] = declared.name
                self._schemas[declared.name] = declared.data
            elif opcode == Opcode.CHANNEL:
                found = Channel.read(ReadDataStream(BytesIO(records[position : position + length])))
                channels[found.id] = _channel_info(found, schemas.get(found.schema_id, ""))
            position += length


@dataclass(slots=True)
class _Overview:
    library: str
    metadata: dict[str, dict[str, str]]
    attachments: dict[str, Attachment]
    problem: str
    gaps: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class _Problem:
    text: str


_TOP_LEVEL: dict[int, Any] = {
    Opcode.HEADER: Header.read,
    Opcode.METADATA: Metadata.read,
    Opcode.ATTACHMENT: McapAttachment.read,
}


def _check_index(body: bytes) -> None:
    """A message index, by its lengths: a chunk whose kind was damaged must not be passed over as one."""
    if len(body) < 6 or struct.unpack_from("<I", body, 2)[0] != len(body) - 6:
        raise ValueError("a message index of the wrong length")


def _check(written: int, found: int, what: str) -> None:
    """Compare a checksum; zero means none was written."""
    if written and written != found:
        raise ValueError(f"the checksum of {what} is wrong")


def _open_chunk(body: bytes) -> bytes:
    """The records in a chunk, its checksum checked."""
    chunk = Chunk.read(ReadDataStream(BytesIO(body)))
    if chunk.uncompressed_size > _MAX_CHUNK:
        raise ValueError(f"a chunk claims {chunk.uncompressed_size} bytes")
    if chunk.compression == "zstd":
        records: bytes = zstandard.decompress(chunk.data, max_output_size=chunk.uncompressed_size)
    elif not chunk.compression:
        records = chunk.data
    else:
        raise ValueError(f"chunk compression {chunk.compression!r}; expected zstd or none")
    _check(chunk.uncompressed_crc, zlib.crc32(records), "a chunk")
    return records


def _channel_info(channel: Channel, schema_name: str) -> ChannelInfo:
    """What a channel record says, with the raw channels' metadata read."""
    metadata = channel.metadata
    direction: Direction | None = None
    if metadata.get("direction") in ("rx", "tx"):
        direction = "rx" if metadata["direction"] == "rx" else "tx"
    peer: Address | None = None
    if metadata.get("peer_port", "").isdecimal():
        peer = (metadata.get("peer_host", ""), int(metadata["peer_port"]))
    return ChannelInfo(
        topic=channel.topic,
        encoding=channel.message_encoding,
        schema=schema_name,
        link=metadata.get("link", ""),
        direction=direction,
        peer=peer,
    )


def _message_class(name: str, descriptor_set: bytes) -> type[Any]:
    """A protobuf class from a serialized FileDescriptorSet without dependencies among its files."""
    pool = descriptor_pool.DescriptorPool()
    for file in descriptor_pb2.FileDescriptorSet.FromString(descriptor_set).file:
        pool.Add(file)
    kind: type[Any] = message_factory.GetMessageClass(pool.FindMessageTypeByName(name))
    return kind
