"""Topics as tables: which columns each has. Nested messages are taken apart, lists become as many columns as the
longest has, and what is longer than `MOST_COLUMNS`, or a list of messages, is one cell of JSON."""

import json
import math
from collections.abc import Iterable
from typing import Any

from logs.reader import RecordedMessage, Recording
from logs.rows import flat, row
from logs.transcode import PACKAGE

MOST_COLUMNS = 128
"""Of one list: MAVLink's longest, but for bytes of files and logs, have 72."""


class Widths:
    """How long the lists of each topic are, found by a pass over what can differ.

    A packet's lists are as long as its message says; ours, and those of imported logs, are as long as they are.
    """

    def __init__(self, recording: Recording, messages: Iterable[RecordedMessage]) -> None:
        self._longest: dict[tuple[str, str], int] = {}
        seen: set[str] = set()
        for message in messages:
            channel = message.channel
            if not channel.schema or (channel.schema.startswith(f"{PACKAGE}.") and channel.topic in seen):
                continue
            seen.add(channel.topic)
            for name, value in flat(row(recording, message).values):
                if isinstance(value, list):
                    key = channel.topic, name
                    length = MOST_COLUMNS + 1 if _nested(value) else len(value)
                    self._longest[key] = max(self._longest.get(key, 0), length)

    def of(self, topic: str, name: str) -> int:
        """Columns of a list; 0: it is one cell."""
        longest = self._longest.get((topic, name), 0)
        return longest if longest <= MOST_COLUMNS else 0


def header(topic: str, values: dict[str, Any], widths: Widths) -> list[str]:
    """The names of a topic's columns: ``log_time_ns``, then fields, ``q[0]``, ``q[1]`` ..."""
    names = ["log_time_ns"]
    for name, value in flat(values):
        width = widths.of(topic, name) if isinstance(value, list) else 0
        names += [f"{name}[{index}]" for index in range(width)] if width else [name]
    return names


def cells(topic: str, log_time_ns: int, values: dict[str, Any], widths: Widths) -> list[Any]:
    """One message as cells, None where a list is shorter than its columns."""
    found: list[Any] = [log_time_ns]
    for name, value in flat(values):
        if not isinstance(value, list):
            found.append(value.hex() if isinstance(value, bytes) else value)
        elif width := widths.of(topic, name):
            found += value + [None] * (width - len(value))
        else:
            found.append(json.dumps(jsonable(value), separators=(",", ":")) if value else None)
    return found


def jsonable(value: Any) -> Any:
    """A value as JSON holds it: null for a number that JSON has not, bytes in hexadecimal."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {name: jsonable(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [jsonable(item) for item in value]
    return value.hex() if isinstance(value, bytes) else value


def _nested(value: list[Any]) -> bool:
    return any(isinstance(item, dict | list | bytes) for item in value)
