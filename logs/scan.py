"""What of an MCAP file is whole: every record that proves itself, whatever stands between them.

A chunk proves itself by its checksum, an attachment by its own, metadata by lengths that fit to the byte. Where
something does not, the scan looks for the next record that does: nothing behind damage is given up. A chunk that the
end of the file cuts off still has whole messages in front, as far as it can be unpacked (`logs.unpack`).
"""

import re
import struct
import zlib
from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from io import BytesIO
from typing import Literal

from mcap.data_stream import ReadDataStream
from mcap.exceptions import EndOfFile
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, ChunkIndex, Footer, Header, Metadata, Schema

from logs.container import LIBRARY, MAGIC
from logs.unpack import CHUNK, MESSAGE, RECORD, Buffer, Unpacked, unpack, whole

MOST_TRIED = 16
"""Times the file's size; checksums of more bytes than that are not taken, and what is not proved by then is lost."""
_PIECE = 256 * 1024
_START = re.compile(rb"[\x06\x09\x0c\x0f](?=.{5}\x00\x00\x00)", re.DOTALL)
"""Chunk, attachment, metadata, end of the data; no record is a terabyte long."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A record of the data section that has proved itself, or a cut-off chunk with something in it.

    Attributes
    ----------
    kind : "torn" is a cut-off chunk; "message" and "other" are what a foreign writer put between the chunks.
    start, end : in the file; of a chunk without its message indexes, which end at `index_end`.
    unpacked : of a chunk.
    indexes : of a chunk, channel -> where its message index stands; None: not as they must be.
    schemas, channels : declared here.
    """

    kind: Literal["header", "metadata", "attachment", "chunk", "torn", "message", "other"]
    start: int
    end: int
    unpacked: Unpacked | None = None
    index_end: int = 0
    indexes: dict[int, int] | None = None
    schemas: Sequence[Schema] = ()
    channels: Sequence[Channel] = ()


@dataclass(slots=True)
class Scan:
    """The outcome.

    Attributes
    ----------
    size : of the file. data_end : where its data section ends, be it by its own word or because nothing follows.
    lost : (start, end) of bytes of the data section that are not part of anything.
    schemas, channels : declared anywhere, the summary included.
    problem : why the file is not whole; empty if it is.
    damaged : whether something is not what was written, rather than only missing at the end.
    tried : bytes of chunks and attachments whose checksums were taken.
    """

    size: int
    data_end: int = 0
    lost: list[tuple[int, int]] = field(default_factory=list)
    schemas: dict[int, Schema] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    problem: str = ""
    damaged: bool = False
    tried: int = 0


def scan(data: Buffer, found: Scan) -> Iterator[Piece]:
    """The whole records of the data section, in order; fills `found` on the way.

    Parameters
    ----------
    data : the file, which begins with the magic.
    found : a fresh one; complete when the iterator ends.
    """
    size, position = len(data), len(MAGIC)
    summary_at = _read_summary(data, found)
    foreign, ended, crc, index_bytes = False, False, zlib.crc32(MAGIC), 0
    while position < size and not ended:
        piece = None
        opcode, length = _head(data, position)
        end = position + RECORD.size + length
        if opcode == Opcode.DATA_END and length == 4 and end <= size:
            ended = True
            found.data_end = position
            written = int.from_bytes(data[end - 4 : end], "little")
            if written not in (0, crc) and not found.problem:
                found.problem, found.damaged = "the checksum of its data is wrong", True
            break
        if end <= size:
            piece = _proved(data, opcode, position, end, foreign, found)
        if piece is None and opcode == Opcode.CHUNK:
            piece = _proved_inside(data, position, found)
        if piece is not None:
            if piece.kind == "header":
                foreign = _header(data, piece).library != LIBRARY
            next_at = piece.index_end or piece.end
            crc = _crc32(data, position, next_at, crc)
            index_bytes = 0
            if piece.unpacked is not None and piece.indexes is None:
                index_bytes = sum(15 + 16 * n for n in piece.unpacked.counts.values()) + piece.end - next_at
            yield piece
            position = next_at
            continue
        go_on = _next(data, position + 1, summary_at, found)
        torn = unpack(data, position, size) if go_on is None and opcode == Opcode.CHUNK else None
        if not found.problem:
            at = f"byte {position}"
            cut = end > size and go_on is None
            found.problem = f"it ends inside a record that begins at {at}" if cut else f"damaged at {at}"
            found.damaged = not cut
        if torn is not None and torn.index:
            _declare(torn, found)
            yield Piece("torn", position, size, torn, schemas=torn.schemas, channels=torn.channels)
        if go_on is None:
            found.data_end = position
            if _is_data(opcode, end > size):
                found.lost.append((position, size))
            return
        if go_on - position > index_bytes:  # otherwise it was no more than message indexes, which are made again
            found.lost.append((position, go_on))
        position, index_bytes = go_on, 0
    if not ended:
        found.data_end = position
        found.problem = found.problem or f"it ends at byte {size} without a footer"
    elif not found.problem and summary_at != found.data_end + 13:
        found.problem = "its summary is cut off or damaged"
    elif not found.problem and not foreign and summary_at == size - len(MAGIC) - 29:
        found.problem = f"it ends at byte {size} without a summary"


def _is_data(opcode: int, cut: bool) -> bool:
    """Whether what stands there was data: not an index or a summary cut off, which can be made again."""
    made_again = (Opcode.MESSAGE_INDEX, Opcode.DATA_END, Opcode.STATISTICS, Opcode.SUMMARY_OFFSET, Opcode.FOOTER)
    return not (cut and opcode in made_again)


def _head(data: Buffer, position: int) -> tuple[int, int]:
    """Kind and length of the record there; of one too short for that, a length that goes beyond the file."""
    if position + RECORD.size > len(data):
        return data[position], 1 << 62
    opcode, length = RECORD.unpack_from(data, position)
    return opcode, length


def _proved(data: Buffer, opcode: int, start: int, end: int, foreign: bool, found: Scan) -> Piece | None:
    """The record from `start` to `end`, if it is one beyond doubt."""
    body = start + RECORD.size
    try:
        if opcode == Opcode.CHUNK:
            if not _may_try(data, start, end, found):
                return None
            unpacked = unpack(data, start, end)
            if not unpacked.whole:
                return None
            _declare(unpacked, found)
            indexes, index_end = _indexes(data, end, unpacked)
            if indexes is not None and unpacked.stated:
                unpacked.index = {}
            return Piece("chunk", start, end, unpacked, index_end, indexes, unpacked.schemas, unpacked.channels)
        if opcode == Opcode.HEADER and start == len(MAGIC):
            stop = _string(data, body, end)  # profile, then the library
            return Piece("header", start, end) if stop > 0 and _string(data, stop, end) == end else None
        if opcode == Opcode.METADATA:
            return Piece("metadata", start, end) if _fits(data, body, end) else None
        if opcode == Opcode.ATTACHMENT:
            return Piece("attachment", start, end) if _fits_attachment(data, body, end, found) else None
        if foreign:
            return _proved_foreign(data, opcode, start, end, found)
    except (ValueError, struct.error, EndOfFile):
        pass
    return None


def _proved_inside(data: Buffer, start: int, found: Scan) -> Piece | None:
    """A chunk whose own length is wrong, if the length of what is packed in it is right."""
    body = start + RECORD.size
    if body + CHUNK.size + 16 > len(data):
        return None
    at = body + CHUNK.size + CHUNK.unpack_from(data, body)[4]
    end = at + 8 + int.from_bytes(data[at : at + 8], "little")
    if end > len(data) or not _plausible(data, Opcode.CHUNK, start, end):
        return None
    piece = _proved(data, Opcode.CHUNK, start, end, False, found)
    if piece is not None and piece.unpacked is not None:
        piece.unpacked.stated = False
    return piece


def _proved_foreign(data: Buffer, opcode: int, start: int, end: int, found: Scan) -> Piece | None:
    """What only other writers put between chunks: declarations, single messages, stray indexes, private records."""
    body = start + RECORD.size
    if opcode == Opcode.SCHEMA:
        schema = whole(Schema, bytes(data[body:end]))
        found.schemas[schema.id] = schema
        return Piece("other", start, end, schemas=(schema,))
    elif opcode == Opcode.CHANNEL:
        channel = whole(Channel, bytes(data[body:end]))
        found.channels[channel.id] = channel
        return Piece("other", start, end, channels=(channel,))
    elif opcode == Opcode.MESSAGE:
        known = end - body >= MESSAGE.size and MESSAGE.unpack_from(data, body)[0] in found.channels
        return Piece("message", start, end) if known else None
    elif opcode < 0x80 and opcode != Opcode.MESSAGE_INDEX:
        return None
    return Piece("other", start, end)


def _declare(unpacked: Unpacked, found: Scan) -> None:
    for schema in unpacked.schemas:
        found.schemas[schema.id] = schema
    for channel in unpacked.channels:
        found.channels[channel.id] = channel


def _may_try(data: Buffer, start: int, end: int, found: Scan) -> bool:
    """Whether a checksum over these bytes may be taken: a file made of records in records must not take for ever."""
    found.tried += end - start
    return found.tried <= MOST_TRIED * len(data)


def _next(data: Buffer, position: int, summary_at: int, found: Scan) -> int | None:
    """Where the next record stands that proves itself, or the data ends; None: nowhere."""
    limit, ours = summary_at or len(data), Scan(0, tried=found.tried)
    place = _search(data, position, limit, summary_at, ours)
    found.tried = ours.tried
    return place


def _search(data: Buffer, position: int, limit: int, summary_at: int, ours: Scan) -> int | None:
    for match in _START.finditer(data, position, limit):
        start = match.start()
        opcode, length = _head(data, start)
        end = start + RECORD.size + length
        if end > limit:
            continue
        if opcode == Opcode.DATA_END:
            if length == 4 and (end == summary_at or data[end : end + 1] in (b"\x02", b"\x03")):
                return start
        elif _plausible(data, opcode, start, end) and _proved(data, opcode, start, end, False, ours) is not None:
            return start
    return None


def _plausible(data: Buffer, opcode: int, start: int, end: int) -> bool:
    """A look before the checksum is taken, so that damage costs no more time than size."""
    body = start + RECORD.size
    if opcode == Opcode.CHUNK:
        if end - body < CHUNK.size + 8:
            return False
        *_, length = CHUNK.unpack_from(data, body)
        at = body + CHUNK.size + length
        stated = int.from_bytes(data[at : at + 8], "little")
        return bool(length <= 8 and at + 8 <= end and stated == end - at - 8)
    if opcode == Opcode.ATTACHMENT:
        return end - body >= 36 and data[end - 4 : end] != bytes(4)
    return True


def _read_summary(data: Buffer, found: Scan) -> int:
    """Declarations from the summary, if it is whole to the end of the file; where the data's end stands before it."""
    footer_at = len(data) - len(MAGIC) - 29
    if footer_at < len(MAGIC) or data[-len(MAGIC) :] != MAGIC or _head(data, footer_at) != (Opcode.FOOTER, 20):
        return 0
    footer = Footer.read(ReadDataStream(BytesIO(data[footer_at + 9 : footer_at + 29])))
    start = footer.summary_start or footer_at
    if not len(MAGIC) + 13 <= start <= footer_at:
        return 0
    if footer.summary_crc not in (0, _crc32(data, start, footer_at + 25, 0)):
        return 0
    position = start
    try:
        while position < footer_at:
            opcode, length = _head(data, position)
            end = position + RECORD.size + length
            if end > footer_at:
                return 0
            if opcode == Opcode.SCHEMA:
                schema = whole(Schema, bytes(data[position + 9 : end]))
                found.schemas[schema.id] = schema
            elif opcode == Opcode.CHANNEL:
                channel = whole(Channel, bytes(data[position + 9 : end]))
                found.channels[channel.id] = channel
            position = end
    except (ValueError, struct.error, EndOfFile):
        return 0
    return start


def _header(data: Buffer, piece: Piece) -> Header:
    return whole(Header, bytes(data[piece.start + RECORD.size : piece.end]))


def chunk_stated(data: Buffer, piece: Piece, offset: int, offsets: dict[int, int], length: int) -> ChunkIndex:
    """What the summary says of a chunk as it stands, put at `offset`, with so many bytes of message indexes."""
    first_ns, last_ns, size, _, name_length = CHUNK.unpack_from(data, piece.start + RECORD.size)
    name_at = piece.start + RECORD.size + CHUNK.size
    return ChunkIndex(
        message_start_time=first_ns,
        message_end_time=last_ns,
        chunk_start_offset=offset,
        chunk_length=piece.end - piece.start,
        message_index_offsets=offsets,
        message_index_length=length,
        compression=bytes(data[name_at : name_at + name_length]).decode(),
        compressed_size=piece.end - name_at - name_length - 8,
        uncompressed_size=size,
    )


def message_at(data: Buffer, piece: Piece) -> tuple[int, int]:
    """Channel and log time [ns] of a message between the chunks."""
    channel, _, log_ns, _ = MESSAGE.unpack_from(data, piece.start + RECORD.size)
    return channel, log_ns


def read_metadata(data: Buffer, piece: Piece) -> Metadata:
    """The metadata record that stands there."""
    return whole(Metadata, bytes(data[piece.start + RECORD.size : piece.end]))


def read_attachment(data: Buffer, piece: Piece) -> Attachment:
    """The attachment record that stands there."""
    return Attachment.read(ReadDataStream(BytesIO(data[piece.start + RECORD.size : piece.end])))


def _fits(data: Buffer, position: int, end: int) -> bool:
    """Whether a metadata record's name and table fill it to the byte, in UTF-8."""
    name_end = _string(data, position, end)
    if name_end <= position + 4 or name_end + 4 > end:
        return False
    at, count = name_end + 4, 0
    if int.from_bytes(data[name_end:at], "little") != end - at:
        return False
    while at < end:
        at = _string(data, at, end)
        if at < 0:
            return False
        count += 1
    return count % 2 == 0


def _string(data: Buffer, position: int, end: int) -> int:
    """Where the string that begins there ends; -1: there is none."""
    at = position + 4
    if at > end:
        return -1
    stop = at + int.from_bytes(data[position:at], "little")
    if stop > end:
        return -1
    try:
        str(data[at:stop], "utf-8")
    except UnicodeDecodeError:
        return -1
    return stop


def _fits_attachment(data: Buffer, position: int, end: int, found: Scan) -> bool:
    """Whether an attachment's lengths fill it to the byte, and its checksum, if it has one, is right."""
    at = position + 16
    for _ in range(2):  # name, media type
        at = _string(data, at, end)
        if at < 0:
            return False
    if at + 12 > end or at + 12 + int.from_bytes(data[at : at + 8], "little") != end:
        return False
    stated = int.from_bytes(data[end - 4 : end], "little")
    return not stated or (_may_try(data, position, end, found) and stated == _crc32(data, position, end - 4, 0))


def _crc32(data: Buffer, start: int, end: int, crc: int) -> int:
    for position in range(start, end, _PIECE):
        crc = zlib.crc32(data[position : min(position + _PIECE, end)], crc)
    return crc


def _indexes(data: Buffer, position: int, unpacked: Unpacked) -> tuple[dict[int, int] | None, int]:
    """Where the message indexes behind a chunk stand, and where they end; None when they are not the chunk's."""
    offsets: dict[int, int] = {}
    size, good = len(data), True
    while position + 15 <= size and data[position] == Opcode.MESSAGE_INDEX:
        _, length = _head(data, position)
        end = position + RECORD.size + length
        if end > size or length < 6:
            return None, position
        channel, entries = struct.unpack_from("<HI", data, position + 9)
        wanted = unpacked.index.get(channel, array("Q"))
        good = good and entries == length - 6 and data[position + 15 : end] == wanted.tobytes()
        if wanted:
            offsets[channel] = position
        position = end
    return (offsets if good and len(offsets) == len(unpacked.index) else None), position
