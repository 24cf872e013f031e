"""The files of one recording, one after another: FLIGHT.mcap, FLIGHT.part0002.mcap, FLIGHT.part0003.mcap ...

The names sort as the parts follow. Each part is a recording of its own: it begins with the tables and files the first
began with, and declares its channels anew. Its table `part` says which one it is, of what, why it was begun, and what
is missing between it and the one before.
"""

import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from logs import schema
from logs.container import Attachment, Container
from logs.errors import RecordingError
from logs.lock import lock

PART = "part"
"""Name of the table."""
MOST_PARTS = 9999
"""The names of more would not sort; the last part grows."""


@dataclass(frozen=True, slots=True)
class Rotation:
    """When a part ends and the next begins: at this size [bytes], after this time [s]; None: never for that reason."""

    size_bytes: int | None = None
    seconds: float | None = None

    def __post_init__(self) -> None:
        for value in (self.size_bytes, self.seconds):
            if value is not None and not value > 0:
                raise ValueError(f"found {value}, expected more than zero")


def rotation_of(size_mb: float | None, seconds: float | None) -> Rotation | None:
    """When a part ends, as people say it; None: never."""
    if size_mb is None and seconds is None:
        return None
    return Rotation(None if size_mb is None else round(size_mb * 1e6), seconds)


@dataclass(frozen=True, slots=True)
class Room:
    """Bounds on the free space of the disk [bytes], and as shares of the disk where that is small.

    Attributes
    ----------
    warn : below it there is a notice. raw_only : packets are not decoded any more. stop : nothing is recorded.
    """

    warn: int = 256_000_000
    raw_only: int = 64_000_000
    stop: int = 16_000_000

    def of_disk(self, total: int) -> "Room":
        """The bounds on a disk of this size."""
        return Room(min(self.warn, total // 2), min(self.raw_only, total // 5), min(self.stop, total // 20))


@dataclass(frozen=True, slots=True)
class Gap:
    """What is missing between two parts: why, between which log times [ns], and how many datagrams and records."""

    reason: str
    from_ns: int
    to_ns: int = 0
    missing: int = 0


class Parts:
    """Opens one part after another.

    Parameters
    ----------
    path : the first; none of them is ever written over.
    metadata, attachments : what each begins with.
    numbered : whether the first says too that it is one; later ones do.

    Attributes
    ----------
    paths : the parts so far.
    container : of the part being written; None between two.
    """

    def __init__(
        self,
        path: Path,
        metadata: Mapping[str, Mapping[str, str]],
        attachments: Sequence[Attachment],
        numbered: bool,
    ) -> None:
        self.paths: list[Path] = []
        self.container: Container | None = None
        self._file: BinaryIO | None = None
        self._first, self._metadata, self._attachments = path, metadata, attachments
        refuse_beside_parts(path)
        try:
            self._open(path, self._part(1, "the flight began", None) if numbered else {})
        except FileExistsError:
            raise RecordingError(path, "the file exists already; a recording is never overwritten") from None
        except OSError as error:
            reason = error.strerror or error
            raise RecordingError(path, f"cannot make the file: {reason}") from error

    @property
    def number(self) -> int:
        """Of the newest part, from 1."""
        return len(self.paths)

    def attach(self, attachment: Attachment) -> None:
        """Put a file in place of the one of its name, or beside the others, from the next part on."""
        self._attachments = [*(a for a in self._attachments if a.name != attachment.name), attachment]

    def begin(self, why: str, gap: Gap | None = None) -> Container:
        """Open the next part.

        Raises
        ------
        OSError    The disk cannot take it; nothing is left of it.
        """
        number = self.number + 1
        self._open(part_path(self._first, number), self._part(number, why, gap))
        assert self.container is not None
        return self.container

    @property
    def descriptor(self) -> int:
        """Of the file that is being written."""
        assert self._file is not None
        return self._file.fileno()

    def close(self) -> None:
        """Leave the present part as it is.

        Raises
        ------
        OSError    What was written did not all reach the disk; it is closed all the same.
        """
        file, self._file, self.container = self._file, None, None
        if file is not None:
            file.close()

    def withdraw(self) -> None:
        """Take the newest part away again, which is not the first."""
        path = self.paths.pop()
        with suppress(OSError):
            self.close()
        with suppress(OSError):
            path.unlink()

    def disk(self) -> tuple[int, int]:
        """Bytes free for us, and in all, on the disk of the recording."""
        about = os.statvfs(self._first.parent)
        return about.f_bavail * about.f_frsize, about.f_blocks * about.f_frsize

    def _part(self, number: int, why: str, gap: Gap | None) -> dict[str, str]:
        values = {"number": str(number), "of": self._first.name, "begun": why}
        if gap is not None:
            values |= {
                "gap": gap.reason,
                "gap_from_ns": str(gap.from_ns),
                "gap_to_ns": str(gap.to_ns),
                "gap_missing": str(gap.missing),
            }
        return values

    def _open(self, path: Path, part: Mapping[str, str]) -> None:
        file = open(path, "xb", buffering=0)  # noqa: SIM115  closed by `close`
        try:
            lock(file)  # for as long as this process lives: nobody recovers what is still being written
            container = Container(file)
            container.add_metadata("schema", {"version": str(schema.SCHEMA_VERSION), "dialect": "all"})
            if part:
                container.add_metadata(PART, part)
            for name, values in self._metadata.items():
                container.add_metadata(name, values)
            for attachment in self._attachments:
                container.add_attachment(attachment.name, attachment.media_type, attachment.data)
        except OSError:
            with suppress(OSError):
                file.close()
            path.unlink(missing_ok=True)
            raise
        self._file, self.container = file, container
        self.paths.append(path)


def part_path(first: Path, number: int) -> Path:
    """The name of a part."""
    return first if number == 1 else first.with_name(f"{first.stem}.part{number:04d}{first.suffix}")


def later_parts(first: Path) -> list[Path]:
    """The parts behind the first that are there, in order."""
    pattern = f"{_literal(first.stem)}.part[0-9][0-9][0-9][0-9]{_literal(first.suffix)}"
    return sorted(first.parent.glob(pattern))


def refuse_beside_parts(path: Path) -> None:
    """Raise `RecordingError` where a file of this name would be read as the first part of another recording."""
    others = [part.name for part in later_parts(path)]
    if others:
        more = f" and {len(others) - 3} more" if len(others) > 3 else ""
        names = ", ".join(others[:3]) + more
        verb, what = ("is", "a part") if len(others) == 1 else ("are", "parts")
        raise RecordingError(path, f"{names} {verb} there already, {what} of another recording of this name")


def number_of(first: Path, path: Path) -> int:
    """Which part of the recording that begins with `first` a file is, by its name."""
    return 1 if path == first else int(path.name[len(first.stem) + 5 : len(first.stem) + 9])


def _literal(text: str) -> str:
    """Text as a pattern that only it fits."""
    return "".join(f"[{c}]" if c in "[]*?" else c for c in text)
