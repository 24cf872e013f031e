"""Logs of others as recordings: .tlog of ground stations, PX4's .ulg, ArduPilot's .BIN.

    .tlog   by our own reader; packets keep their bytes, so it replays, exports and compares as a flight of ours
    .ulg    by pyulog (https://github.com/PX4/pyulog), which is optional: `pip install mavlink-companion[ulog]`
    .BIN    by pymavlink's DFReader (https://github.com/ArduPilot/pymavlink), which is here anyway

What these hold beside packets becomes protobuf channels with the names that the log gives: ``/px4/<topic>/<instance>``,
``/ardupilot/<NAME>``. There is nothing in them to replay or to run again.
"""

import os
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path

from logs.errors import RecordingError

IMPORTED = (".tlog", ".ulg", ".bin")
"""Endings, in small letters."""


@dataclass(slots=True)
class Imported:
    """What became of a log: the recording, how many messages, and what is to be told of it."""

    path: Path
    messages: int = 0
    told: list[str] = field(default_factory=list)


def import_log(source: Path, target: Path, force: bool = False) -> Imported:
    """Make a recording of a log, by its ending.

    Raises
    ------
    RecordingError    It cannot be read or is no such log, a package is missing, `target` cannot be written, or parts of
        another recording of its name are there.
    """
    from logs.importing.dataflash import import_dataflash
    from logs.importing.tlog import import_tlog
    from logs.importing.ulog import import_ulog
    from logs.parts import refuse_beside_parts

    kinds = {".tlog": import_tlog, ".ulg": import_ulog, ".bin": import_dataflash}
    reader = kinds.get(source.suffix.lower())
    if reader is None:
        found = f"the ending {source.suffix!r}" if source.suffix else "no ending"
        raise RecordingError(source, f"found {found}, expected .tlog, .ulg or .BIN")
    if not source.is_file():
        raise RecordingError(source, "no such file")
    refuse_beside_parts(target)
    # The readers print what they think of a damaged file, byte by byte; what is to be told is in `Imported`. (One of
    # pymavlink's is in C: what it says still comes out on stderr.)
    with open(os.devnull, "w") as nothing, redirect_stdout(nothing), redirect_stderr(nothing):
        return reader(source, target, force)


def in_a_line(error: Exception) -> str:
    """What a reader of others says of a file, which may hold any of the file's bytes, as one short line."""
    text = "".join(c if c.isprintable() else " " for c in str(error))
    return " ".join(text.split())[:200] or type(error).__name__
