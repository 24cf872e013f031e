"""The service's log: one line an entry on stderr, JSON for machines or plain text for people."""

import json
import sys
import time
from contextlib import suppress
from datetime import UTC, datetime
from typing import Any, Literal, TextIO

from companion.seam import Level

LEVELS = {Level.ERROR: "error", Level.WARNING: "warning", Level.INFO: "info"}
LONGEST = 2000
"""Characters of a text."""


class Log:
    """Writes entries; a reader that has gone away does not stop a flight.

    Parameters
    ----------
    form : `json`: an object a line with time, level, phase, text and what belongs to the entry; `text`: for people.
    """

    def __init__(self, form: Literal["json", "text"], stream: TextIO | None = None) -> None:
        self._form = form
        self._stream = sys.stderr if stream is None else stream

    def write(self, level: Level, phase: str, text: str, **more: Any) -> None:
        """One entry."""
        at = datetime.fromtimestamp(time.time(), UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")
        text = text[:LONGEST]
        if self._form == "json":
            line = json.dumps({"time": at, "level": LEVELS[level], "phase": phase, "text": text, **more})
        else:
            plain = "".join(c if c.isprintable() else "?" for c in text)
            line = f"{at} {LEVELS[level]:7} {phase:12} {plain}" + "".join(f" {k}={v}" for k, v in more.items())
        with suppress(OSError, ValueError):
            print(line, file=self._stream, flush=True)
