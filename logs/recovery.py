"""Making a recording whole that was not closed, was cut short or damaged.

In place, and so that it can be killed at any moment and begun again:
- what is missing is only the end (a crash, a full disk): the end is written over what hangs behind the last whole
  record and holds nothing, then the file is cut there
- something in the middle is damaged, or there is something to be kept of a chunk that is cut off: everything whole is
  copied to a file beside, which then takes its place; with no room for it, what is of a chunk cut off is given up

Only what proves itself is kept (`logs.scan`), so nothing wrong is read from a recovered file, and never less than a
reader would have got that goes from front to back and checks. A file that somebody writes is left alone: a recorder
holds a lock on it.
"""

import errno
import mmap
import os
import stat
import zlib
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from mcap.opcode import Opcode
from mcap.records import Channel, Header, Metadata, Schema

from logs.container import LIBRARY, MAGIC, PROFILE, Summary, bare_tail, bytes_of, chunk_of, indexes_of
from logs.errors import RecordingError
from logs.lock import lock
from logs.reader import RECOVERY
from logs.scan import MOST_TRIED, Piece, Scan, chunk_stated, message_at, read_attachment, read_metadata, scan
from logs.unpack import records_of

SUFFIX = ".recovering"
_BLOCK = 1024 * 1024
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT)


@dataclass(frozen=True, slots=True)
class Recovered:
    """What became of a file.

    Attributes
    ----------
    path : the file. changed : False: it was whole, and was not touched.
    messages, chunks : in it now.
    lost_bytes : of data that could not be kept; messages of a torn chunk that could be are not in it.
    problem : what was wrong; empty where nothing was.
    lossy : something that had reached the disk is not in the file, or not sure to be what was written.
    """

    path: Path
    changed: bool
    messages: int
    chunks: int
    lost_bytes: int
    problem: str
    lossy: bool

    def __str__(self) -> str:
        if not self.changed:
            return f"{self.path}: whole, {self.messages} messages; nothing was done"
        loss = f"{self.lost_bytes} bytes are lost" if self.lossy else "nothing is lost of what was written"
        return f"{self.path}: recovered {self.messages} messages; {loss} ({self.problem})"


def recover(path: Path) -> Recovered:
    """Make a recording whole, in place.

    Raises
    ------
    RecordingError    It is no MCAP file, holds nothing, is being written by somebody, or the disk cannot take it; the
        file then holds what it held.
    """
    try:
        with open(path, "r+b") as file:
            if lock(file) is False:
                raise RecordingError(path, "it is being written; nothing was done")
            return _recover(path, file)
    except OSError as error:
        raise RecordingError(path, f"cannot recover: {error.strerror or error}") from error


def is_unfinished(path: Path) -> bool:
    """Whether a file is one of our recordings and does not end as a closed one does, with a summary.

    Raises
    ------
    OSError    It cannot be read.
    """
    with open(path, "rb") as file:
        head = file.read(256)
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - len(MAGIC) - 29))
        tail = file.read()
    footer = tail.startswith(b"\x02\x14\0\0\0\0\0\0\0") and tail.endswith(MAGIC)
    return head.startswith(MAGIC) and LIBRARY.encode() in head and not (footer and tail[9:17] != bytes(8))


def recover_unfinished(folder: Path, pattern: str = "*.mcap") -> list[Recovered | RecordingError]:
    """Recover every recording of ours in a folder that was not closed and that nobody writes.

    Returns
    -------
    What became of each, and why one could not be recovered. Files that are finished, being written, or somebody else's
    are passed over without a word, and all where the file system has no locks.
    """
    done: list[Recovered | RecordingError] = []
    for path in sorted(folder.glob(pattern)):
        try:
            if not path.is_file() or not is_unfinished(path):
                continue
            with open(path, "rb") as file:
                if not lock(file):
                    continue  # written, or there is no telling: then it is for a person to ask for
            outcome = recover(path)
            if outcome.changed:
                done.append(outcome)
        except RecordingError as error:
            done.append(error)
        except OSError as error:
            done.append(RecordingError(path, f"cannot be read: {error.strerror or error}"))
    return done


def _recover(path: Path, file: BinaryIO) -> Recovered:
    size = file.seek(0, os.SEEK_END)
    if not size:
        raise RecordingError(path, "the file is empty")
    with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        if data[: len(MAGIC)] != MAGIC:
            raise RecordingError(path, f"not an MCAP file (it begins with {data[: len(MAGIC)]!r})")
        found = Scan(size)
        pieces = list(scan(data, found))
        if found.tried > MOST_TRIED * size:
            found.problem += f"; what checksums over {MOST_TRIED} times its size had not proved was given up"
        for channel in list(found.channels.values()):
            if channel.schema_id and channel.schema_id not in found.schemas:
                del found.channels[channel.id]  # what it says cannot be told any more
        if not any(piece.kind != "header" for piece in pieces):
            raise RecordingError(path, f"there is nothing in it: {found.problem or 'no message, no attachment'}")
        fresh = _made_anew(pieces, found)
        kept = _whole_in_front(pieces, fresh)
        outcome = _outcome(path, pieces, found)
        if not outcome.changed:
            return outcome
        if kept is None:
            try:
                _copy(path, data, pieces, found, fresh, outcome)
            except OSError as error:
                if error.errno not in _NO_ROOM or pieces[-1].kind != "torn":
                    raise
                pieces = _without_torn(pieces, found)
                kept = _whole_in_front(pieces, _made_anew(pieces, found)) if len(pieces) > 1 else None
                if kept is None:
                    raise
                outcome = _outcome(path, pieces, found)
            else:
                return outcome
        end: list[bytes] = []
        crc = _rewrite(data, pieces, found, fresh, kept, end.append, outcome)
    _write_over(file, kept, (b"".join(end), bare_tail(crc)))
    return outcome


def _outcome(path: Path, pieces: Sequence[Piece], found: Scan) -> Recovered:
    messages = chunks = unsaid = 0
    for piece in pieces:
        if piece.unpacked is not None:
            chunks += 1
            for channel, count in piece.unpacked.counts.items():
                if channel in found.channels:
                    messages += count
                else:
                    unsaid += count  # of a channel whose declaration is lost: nobody could tell what they are
        messages += piece.kind == "message"
    lost = sum(end - start for start, end in found.lost)
    # Damage that cost nothing: a message index that can be made again. Any other may be in what has no checksum.
    harmless = any(piece.kind == "chunk" and piece.indexes is None for piece in pieces)
    lossy = lost > 0 or unsaid > 0 or (found.damaged and not harmless)
    return Recovered(path, bool(found.problem), messages, chunks, lost, found.problem, lossy)


def _made_anew(pieces: Sequence[Piece], found: Scan) -> dict[int, list[bytes]]:
    """The pieces whose chunk cannot stay as it is, by number, and what is to be declared first in it.

    A chunk that is torn, one that says something wrong of itself, and one with messages or channels that rest on what
    was declared in what is lost.
    """
    fresh: dict[int, list[bytes]] = {}
    schemas: set[int] = {0}
    channels: set[int] = set()
    for number, piece in enumerate(pieces):
        schemas.update(schema.id for schema in piece.schemas)
        channels.update(channel.id for channel in piece.channels)
        if piece.unpacked is None:
            continue
        missing = piece.unpacked.counts.keys() - channels
        used = {channel.schema_id for channel in piece.channels}
        used |= {found.channels[channel].schema_id for channel in missing & found.channels.keys()}
        if missing or used - schemas or piece.kind == "torn" or not piece.unpacked.stated:
            declared: list[Schema | Channel] = [found.schemas[k] for k in sorted(used - schemas) if k in found.schemas]
            declared += [found.channels[k] for k in sorted(missing) if k in found.channels]
            fresh[number] = [bytes_of(record) for record in declared]
            schemas |= used & found.schemas.keys()
            channels |= missing & found.channels.keys()
    return fresh


def _whole_in_front(pieces: Sequence[Piece], fresh: Mapping[int, list[bytes]]) -> int | None:
    """Up to where the file may stay as it is, so that only its end is written; None: it must be copied."""
    position, last = len(MAGIC), len(pieces) - 1
    if pieces[0].kind != "header":
        return None
    for number, piece in enumerate(pieces):
        if piece.start != position:
            return None
        position = piece.index_end or piece.end
        if number in fresh:
            return None
        if piece.kind == "chunk" and piece.indexes is None:
            return piece.end if number == last else None
    return position


def _without_torn(pieces: list[Piece], found: Scan) -> list[Piece]:
    """All but the last, which is cut off, and only what they declare."""
    pieces = pieces[:-1]
    found.schemas = {schema.id: schema for piece in pieces for schema in piece.schemas}
    found.channels = {channel.id: channel for piece in pieces for channel in piece.channels}
    found.problem += "; with no room for a copy, the whole messages at its end were given up"
    return pieces


def _rewrite(
    data: mmap.mmap,
    pieces: Sequence[Piece],
    found: Scan,
    fresh: Mapping[int, list[bytes]],
    kept: int,
    put: Callable[[bytes], object],
    outcome: Recovered,
) -> int:
    """Put the whole file but for what stands before `kept`; returns the checksum of what stands before `kept`."""
    out = _Out(data, kept, put)
    summary, said = Summary(), False
    summary.schemas, summary.channels = list(found.schemas.values()), list(found.channels.values())
    if not kept:
        out.add(MAGIC)
        if pieces[0].kind != "header":
            out.add(bytes_of(Header(PROFILE, LIBRARY)))
    else:
        out.keep(0, len(MAGIC))
    for number, piece in enumerate(pieces):
        at = out.position
        if piece.unpacked is not None and number in fresh:
            records, index = _records(data, piece, fresh[number], found)
            block, chunk = chunk_of(records, index, at)
            out.add(block)
            summary.add_chunk(chunk, {channel: len(entries) // 2 for channel, entries in index.items()})
        elif piece.unpacked is not None:
            unpacked = piece.unpacked
            out.keep(piece.start, piece.end)
            indexes_at = out.position
            if piece.indexes is None:
                block, offsets = indexes_of(unpacked.index, indexes_at)
                out.add(block)
            else:
                out.keep(piece.end, piece.index_end)
                offsets = {channel: at + old - piece.start for channel, old in piece.indexes.items()}
            summary.add_chunk(
                chunk_stated(data, piece, at, offsets, out.position - indexes_at),
                unpacked.counts,
            )
        else:
            if piece.kind == "metadata":
                name = read_metadata(data, piece).name
                said = said or name == RECOVERY
                summary.add_metadata(name, at, piece.end - piece.start)
            elif piece.kind == "attachment":
                summary.add_attachment(read_attachment(data, piece), at, piece.end - piece.start)
            elif piece.kind == "message":
                channel, log_ns = message_at(data, piece)
                summary.counts[channel] = summary.counts.get(channel, 0) + 1
                summary.span(log_ns, log_ns)
            out.keep(piece.start, piece.end)
    if not said:
        record = bytes_of(Metadata(name=RECOVERY, metadata=_words(outcome)))
        summary.add_metadata(RECOVERY, out.position, len(record))
        out.add(record)
    out.put(summary.tail(out.crc, out.position))
    return out.crc_kept


class _Out:
    """Where the file is written to: what stands before `kept` is there already, and only counted."""

    def __init__(self, data: mmap.mmap, kept: int, put: Callable[[bytes], object]) -> None:
        self._data, self._kept, self.put = data, kept, put
        self.position = self.crc = self.crc_kept = 0

    def add(self, block: bytes) -> None:
        self.put(block)
        self.crc = zlib.crc32(block, self.crc)
        self.position += len(block)

    def keep(self, start: int, end: int) -> None:
        """What stands there in the old file."""
        for position in range(start, end, _BLOCK):
            block = self._data[position : min(position + _BLOCK, end)]
            if self.position >= self._kept:
                self.put(block)
            self.crc = zlib.crc32(block, self.crc)
            self.position += len(block)
            if self.position <= self._kept:
                self.crc_kept = self.crc


def _records(
    data: mmap.mmap, piece: Piece, declared: Sequence[bytes], found: Scan
) -> tuple[bytes, dict[int, list[int]]]:
    """The content of a chunk made anew: declarations that are missing, then its records without unknown channels'."""
    assert piece.unpacked is not None
    out = list(declared)
    size = sum(map(len, out))
    index: dict[int, list[int]] = {}
    for record, channel, log_ns in records_of(data, piece.start, piece.end, piece.unpacked.size):
        if channel is not None:
            if channel not in found.channels:
                continue
            if record[0] == Opcode.MESSAGE:
                index.setdefault(channel, []).extend((log_ns, size))
        out.append(record)
        size += len(record)
    return b"".join(out), index


def _words(outcome: Recovered) -> dict[str, str]:
    return {
        "problem": outcome.problem,
        "lost_bytes": str(outcome.lost_bytes),
        "lossy": "yes" if outcome.lossy else "no",
        "messages": str(outcome.messages),
    }


def _write_over(file: BinaryIO, kept: int, ends: Sequence[bytes]) -> None:
    """The new end over the old one; where the disk is too full for it, the shortest that does."""
    descriptor = file.fileno()
    for end in ends:
        try:
            position = 0
            while position < len(end):
                position += os.pwrite(descriptor, end[position:], kept + position)
            os.ftruncate(descriptor, kept + len(end))
            os.fsync(descriptor)
        except OSError as error:
            os.ftruncate(descriptor, kept)
            failure = error
        else:
            return
    raise failure


def _copy(
    path: Path,
    data: mmap.mmap,
    pieces: Sequence[Piece],
    found: Scan,
    fresh: Mapping[int, list[bytes]],
    outcome: Recovered,
) -> None:
    """Everything whole into a file beside, which then takes the place of this one."""
    beside = path.with_name(f".{path.name}{SUFFIX}")
    try:
        with open(beside, "wb") as file:
            lock(file)
            _rewrite(data, pieces, found, fresh, 0, file.write, outcome)
            file.flush()
            with suppress(OSError):  # a file system without
                os.fchmod(file.fileno(), stat.S_IMODE(path.stat().st_mode))
            os.fsync(file.fileno())
            os.replace(beside, path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)
