"""Chunks of an MCAP file, unpacked piece by piece and never kept: what they hold, and whether they are whole.

What a length claims is never believed: a chunk is read as far as it unpacks, up to `MOST_UNPACKED`.
"""

import struct
import zlib
from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO
from mmap import mmap

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import EndOfFile
from mcap.opcode import Opcode
from mcap.records import Channel, Schema

try:
    import lz4.frame as lz4
except ImportError:  # the mcap package brings it, but only other writers' files need it
    lz4 = None

MOST_UNPACKED = 256 * 1024 * 1024
"""A chunk that unpacks to more is damage; ours end at 1 MiB."""
RECORD = struct.Struct("<BQ")
MESSAGE = struct.Struct("<HIQQ")
CHUNK = struct.Struct("<QQQII")
"""Of a chunk record, what stands before the name of its compression: times, size, checksum, length of the name."""
_PIECE = 256 * 1024
_ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"

Buffer = bytes | mmap


@dataclass(slots=True)
class Unpacked:
    """What stands in a chunk, as far as it can be told.

    Attributes
    ----------
    index : channel -> log time [ns], offset, log time, ... of its messages; empty once it need not be written again.
    counts : channel -> messages. first_ns, last_ns : of the log times; zeros without a message.
    size : of the whole records in it [bytes].
    whole : whether that is everything, with the right checksum.
    stated : whether the chunk says of its sizes, times and compression what is true.
    """

    index: dict[int, "array[int]"] = field(default_factory=dict)
    counts: dict[int, int] = field(default_factory=dict)
    first_ns: int = 0
    last_ns: int = 0
    schemas: list[Schema] = field(default_factory=list)
    channels: list[Channel] = field(default_factory=list)
    size: int = 0
    whole: bool = False
    stated: bool = False

    def sum_up(self) -> None:
        """Take counts and times from the index."""
        self.counts = {channel: len(entries) // 2 for channel, entries in self.index.items()}
        times = [(min(entries[0::2]), max(entries[0::2])) for entries in self.index.values()]
        self.first_ns = min((time[0] for time in times), default=0)
        self.last_ns = max((time[1] for time in times), default=0)


def unpack_pieces(data: Buffer, start: int, end: int) -> Iterator[bytes]:
    """The content of the chunk record from `start`, piece by piece, as far as it unpacks."""
    body = start + RECORD.size
    if body + CHUNK.size > end:
        return
    name_length = CHUNK.unpack_from(data, body)[4]
    at = body + CHUNK.size
    if name_length > 8 or at + name_length + 8 > end:
        return
    compression = data[at : at + name_length]
    at += name_length + 8
    total = 0
    try:
        if compression == b"zstd" or data[at : at + 4] == _ZSTD_MAGIC:
            unpacker = zstandard.ZstdDecompressor(max_window_size=1 << 27).decompressobj()
            step = 4096  # so that what one call gives is bounded too: zstd packs at most some thousandfold
        elif compression == b"lz4" and lz4 is not None:
            unpacker = lz4.LZ4FrameDecompressor()
            step = 4096
        elif not compression:
            unpacker, step = None, _PIECE
        else:
            return
        for position in range(at, end, step):
            piece = data[position : min(position + step, end)]
            if unpacker is not None:
                if getattr(unpacker, "eof", False):
                    return
                piece = unpacker.decompress(piece)
            total += len(piece)
            if total > MOST_UNPACKED:
                return
            if piece:
                yield piece
    except (zstandard.ZstdError, RuntimeError, MemoryError):
        return


def unpack(data: Buffer, start: int, end: int) -> Unpacked:
    """Walk the records in a chunk that begins at `start`; `end` of it or of the file."""
    found, rest, crc, total = Unpacked(), bytearray(), 0, 0
    body = start + RECORD.size
    if body + CHUNK.size > end:
        return found
    first_ns, last_ns, size, stated, name_length = CHUNK.unpack_from(data, body)
    good = True
    for piece in unpack_pieces(data, start, end):
        crc = zlib.crc32(piece, crc)
        total += len(piece)
        if good:
            rest += piece
            good, used = _walk(rest, found)
            del rest[:used]
    found.sum_up()
    found.whole = good and not rest and (stated == crc if stated else total == size)
    if found.whole:
        at = body + CHUNK.size + name_length
        true = (found.first_ns, found.last_ns, total, end - at - 8)
        found.stated = (first_ns, last_ns, size, int.from_bytes(data[at : at + 8], "little")) == true
        found.stated = found.stated and data[at - name_length : at] in (b"zstd", b"lz4", b"")
    return found


def _walk(records: bytearray, found: Unpacked) -> tuple[bool, int]:
    """Take the whole records at the front; False when one cannot be what it says, and how many bytes were taken."""
    position, size, base, index = 0, len(records), found.size, found.index
    unpack_record, unpack_message = RECORD.unpack_from, MESSAGE.unpack_from
    good = True
    while position + 9 <= size:
        opcode, length = unpack_record(records, position)
        end = position + 9 + length
        if end > size:
            good = length <= MOST_UNPACKED
            break
        if opcode == 5 and length >= 22:
            channel, _, log_ns, _ = unpack_message(records, position + 9)
            entries = index.get(channel)
            if entries is None:
                entries = index[channel] = array("Q")
            entries.append(log_ns)
            entries.append(base + position)
        else:
            try:
                if opcode == Opcode.SCHEMA:
                    found.schemas.append(whole(Schema, bytes(records[position + 9 : end])))
                elif opcode == Opcode.CHANNEL:
                    found.channels.append(whole(Channel, bytes(records[position + 9 : end])))
                elif opcode < 0x80:
                    raise ValueError("no record of a chunk")
            except (ValueError, struct.error, EndOfFile):
                good = False
                break
        position = end
    found.size = base + position
    return good, position


def records_of(data: Buffer, start: int, end: int, size: int) -> Iterator[tuple[bytes, int | None, int]]:
    """The records in the first `size` bytes of a chunk; of a message channel and log time [ns], of a channel its id."""
    rest, left = bytearray(), size
    for part in unpack_pieces(data, start, end):
        rest += part[:left]
        left -= min(left, len(part))
        position = 0
        while position + RECORD.size <= len(rest):
            opcode, length = RECORD.unpack_from(rest, position)
            stop = position + RECORD.size + length
            if stop > len(rest):
                break
            channel: int | None = None
            log_ns = 0
            if opcode == Opcode.MESSAGE:
                channel, _, log_ns, _ = MESSAGE.unpack_from(rest, position + RECORD.size)
            elif opcode == Opcode.CHANNEL:
                channel = int.from_bytes(rest[position + RECORD.size : position + RECORD.size + 2], "little")
            yield bytes(rest[position:stop]), channel, log_ns
            position = stop
        del rest[:position]


def whole(kind, body: bytes):  # type: ignore[no-untyped-def]  # the mcap package has no types
    """A record that takes up all of `body`; ValueError otherwise."""
    stream = ReadDataStream(BytesIO(body))
    record = kind.read(stream)
    if stream.count != len(body):
        raise ValueError(f"{len(body) - stream.count} bytes behind the record")
    return record
