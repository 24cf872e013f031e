"""PX4's .ulg as recordings, read by pyulog.

Every logged topic becomes ``/px4/<topic>/<instance>``, with the log's own names and types; parameters, as they were at
the start and as they were changed, ``/px4/parameter``; messages ``/px4/log``. Times are the log's, from the boot on.
"""

import heapq
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from logs.errors import RecordingError
from logs.export import unfinished
from logs.importing import Imported, in_a_line
from logs.importing.foreign import Foreign

_ELEMENT = re.compile(r"(.+)\[(\d+)\]")
_Entry = tuple[int, int, str, list[Any]]  # time [us], number (so that nothing else is compared), topic, values


def import_ulog(source: Path, target: Path, force: bool = False) -> Imported:
    """Make a recording of a PX4 log.

    Raises
    ------
    RecordingError    pyulog is not installed, it is no such log, or `target` cannot be written.
    """
    try:
        from pyulog import ULog
    except ImportError as error:
        reason = "reading it wants the package pyulog: pip install 'mavlink-companion[ulog]'"
        raise RecordingError(source, reason) from error
    try:
        with open(source, "rb") as file:
            log = ULog(file, disable_str_exceptions=True)
    except Exception as error:  # it raises what its parsing happens to raise, TypeError for a wrong beginning
        raise RecordingError(source, f"pyulog cannot read it: {in_a_line(error)}") from error
    done = Imported(target)
    lost_ms = sum(dropout.duration for dropout in log.dropouts)
    about = {"of": source.name, "format": "ulog", "dropouts": str(len(log.dropouts)), "dropouts_ms": str(lost_ms)}
    if log.dropouts:
        done.told.append(f"{len(log.dropouts)} dropouts of {lost_ms} ms in all")
    if getattr(log, "file_corruption", False):
        done.told.append("parts of the file are damaged")
    with unfinished(target, force) as temporary, Foreign(temporary, "px4", about) as foreign:
        sources = [
            _parameters(log, foreign),
            _texts(log, foreign),
            *(_topic(data, order, foreign) for order, data in enumerate(log.data_list) if "timestamp" in data.data),
        ]
        for time_us, _, topic, values in heapq.merge(*sources, key=lambda entry: entry[0]):
            foreign.add(topic, done.messages, time_us * 1000, values)
            done.messages += 1
        if not done.messages:
            raise RecordingError(source, "there is nothing in it")
    return done


def _parameters(log: Any, foreign: Foreign) -> Iterator[_Entry]:
    topic = "/px4/parameter"
    foreign.declare(topic, "Parameter", [("name", "str", False), ("value", "double", False)])
    start = int(log.start_timestamp)
    for name in sorted(log.initial_parameters):
        yield from _parameter(start, topic, name, log.initial_parameters[name])
    for time_us, name, value in sorted(log.changed_parameters, key=lambda entry: int(entry[0])):
        yield from _parameter(int(time_us), topic, name, value)


def _parameter(time_us: int, topic: str, name: str, value: Any) -> Iterator[_Entry]:
    if isinstance(value, int | float):  # bytes, where its type is damaged
        yield time_us, 0, topic, [name, float(value)]


def _texts(log: Any, foreign: Foreign) -> Iterator[_Entry]:
    topic = "/px4/log"
    foreign.declare(topic, "LoggedMessage", [("level", "str", False), ("text", "str", False)])
    for message in sorted(log.logged_messages, key=lambda entry: int(entry.timestamp)):
        yield int(message.timestamp), 0, topic, [message.log_level_str(), message.message]


def _topic(data: Any, order: int, foreign: Foreign) -> Iterator[_Entry]:
    """One topic's messages; ``q[0]``, ``q[1]`` ... are one list."""
    topic = f"/px4/{data.name}/{data.multi_id}"
    groups: dict[str, list[str]] = {}
    for name in data.data:
        element = _ELEMENT.fullmatch(name)
        groups.setdefault(element[1] if element else name, []).append(name)
    fields, columns = [], []
    for name, members in groups.items():
        repeated = members != [name]
        members = sorted(members, key=lambda member: int(_ELEMENT.fullmatch(member)[2])) if repeated else members  # type: ignore[index]
        arrays = [data.data[member] for member in members]
        fields.append((name, _kind(arrays[0].dtype), repeated))
        columns.append((repeated, [array.tolist() for array in arrays]))
    foreign.declare(topic, data.name, fields)
    times = data.data["timestamp"].tolist()
    for number, time_us in enumerate(times):
        values = [
            [array[number] for array in arrays] if repeated else arrays[0][number] for repeated, arrays in columns
        ]
        yield int(time_us), order, topic, values


def _kind(dtype: Any) -> str:
    if dtype.kind == "f":
        return "float" if dtype.itemsize == 4 else "double"
    return {"u": "uint", "b": "bool"}.get(dtype.kind, "int")
