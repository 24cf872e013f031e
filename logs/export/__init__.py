"""Recordings in the formats of others: .tlog, CSV, Parquet, lines of JSON.

    tlog     one file: every packet that crossed the vehicle's link, or of what is selected
    csv      a folder, a file a topic; arrays as columns, NaN as `nan`, 64-bit integers exact
    parquet  a folder, a file a topic, typed columns (wants the package pyarrow)
    json     one file, an object a line; NaN and infinities as null, 64-bit integers exact

What is written appears under its name when it is whole; until then it has `.unfinished` behind it.
"""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from logs.errors import RecordingError
from logs.reader import Recording


@dataclass(slots=True)
class Exported:
    """What an export wrote: messages or packets in all, of each topic, and what it left out, in words."""

    path: Path
    messages: int = 0
    topics: dict[str, int] = field(default_factory=dict)
    left_out: list[str] = field(default_factory=list)

    def count(self, topic: str) -> None:
        """One message more."""
        self.messages += 1
        self.topics[topic] = self.topics.get(topic, 0) + 1


def begun(recording: Recording, path: Path) -> Exported:
    """An export with nothing in it yet; it says what the recording itself has lost."""
    problem = recording.problem
    return Exported(path, left_out=[f"what the recording has lost: {problem}"] if problem else [])


@contextmanager
def unfinished(path: Path, force: bool, folder: bool = False) -> Iterator[Path]:
    """Where to write until it is whole; it then takes its name, and goes away if it does not become whole.

    Raises
    ------
    RecordingError    `path` is there already and is not to be replaced; or it cannot be written.
    """
    if path.exists() and not force:
        raise RecordingError(path, "is there already; --force replaces it")
    if path.exists() and path.is_dir() != folder:
        raise RecordingError(path, f"is {'a folder' if path.is_dir() else 'no folder'} and is not replaced")
    temporary = path.with_name(f"{path.name}.unfinished")
    try:
        _remove(temporary)
        if folder:
            temporary.mkdir(parents=True)
        else:
            temporary.parent.mkdir(parents=True, exist_ok=True)
        yield temporary
        if folder and path.exists():
            _remove(path)
        temporary.replace(path)
    except OSError as error:
        raise RecordingError(path, f"cannot be written: {error.strerror or error}") from error
    finally:
        _remove(temporary)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def file_name(topic: str) -> str:
    """A topic as the name of a file, without its ending: ``mavlink_1_1_ATTITUDE``."""
    return "".join(c if c.isalnum() or c in "-." else "_" for c in topic.strip("/")).lstrip(".") or "_"


class FileNames:
    """A name of its own for every topic, also where two topics are alike to a file system."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def of(self, topic: str) -> str:
        """A name that was not given before."""
        name = base = file_name(topic)[:200]
        number = 1
        while name.lower() in self._taken:
            number += 1
            name = f"{base}_{number}"
        self._taken.add(name.lower())
        return name
