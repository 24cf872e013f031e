"""ArduPilot's .BIN as recordings, read by pymavlink's DFReader.

Every kind of message becomes ``/ardupilot/<NAME>``, with the log's own names; values are in the units that DFReader
gives (degrees, metres: its multipliers applied). Times are Unix time where the log has GPS time, from the boot on else.
"""

from contextlib import suppress
from pathlib import Path
from typing import Any

from logs.errors import RecordingError
from logs.export import unfinished
from logs.importing import Imported, in_a_line
from logs.importing.foreign import Foreign

_STRINGS, _FLOATS, _DOUBLES = "nNZ", "fg", "dcCeEL"
_LIST = "a"
"""Letters of the formats: https://ardupilot.org/copter/docs/logmessages.html and `DFReader.FORMAT_TO_STRUCT`."""


def import_dataflash(source: Path, target: Path, force: bool = False) -> Imported:
    """Make a recording of an ArduPilot log.

    Raises
    ------
    RecordingError    It is no such log, or `target` cannot be written.
    """
    with open(source, "rb") as file:
        if file.read(2) != b"\xa3\x95":
            raise RecordingError(source, "it does not begin as a .BIN does: no ArduPilot log")
    done = Imported(target)
    kind = _reader()
    reader = kind.__new__(kind)  # so that what it opens can be closed if its beginning fails
    try:
        try:
            reader.__init__(str(source), zero_time_base=False)
        except Exception as error:  # it raises what its parsing happens to raise
            raise RecordingError(source, f"pymavlink cannot read it: {in_a_line(error)}") from error
        about = {"of": source.name, "format": "dataflash"}
        with unfinished(target, force) as temporary, Foreign(temporary, "ardupilot", about) as foreign:
            _copy(reader, foreign, done)
            if not done.messages:
                raise RecordingError(source, "there is nothing in it")
    finally:
        for name in ("filehandle", "data_map"):
            with suppress(AttributeError, BufferError):  # what it has not opened, and what it still holds on to
                getattr(reader, name).close()
    return done


def _reader() -> Any:
    """pymavlink's reader, which goes round for ever over a message that says it is no longer than its header."""
    from pymavlink.DFReader import DFReader_binary

    class Onward(DFReader_binary):  # type: ignore[misc]
        def _parse_next(self) -> Any:
            before = self.offset
            message = super()._parse_next()
            if message is not None and self.offset <= before:
                raise ValueError(f"the message at byte {before} has no length")
            return message

    return Onward


def _copy(reader: Any, foreign: Foreign, done: Imported) -> None:
    declared: dict[str, str] = {}  # name -> the letters it was declared with
    unlike, time_s = 0, 0.0
    while (message := _next(reader, done)) is not None:
        name = message.get_type()
        letters = message.fmt.format
        if name not in declared:
            fields = [(column, _kind(c), c == _LIST) for column, c in zip(message.fmt.columns, letters, strict=False)]
            foreign.declare(f"/ardupilot/{name}", name, fields)
            declared[name] = letters
        if declared[name] != letters:
            unlike += 1
            continue
        values = [_value(getattr(message, c), letter) for c, letter in zip(message.fmt.columns, letters, strict=False)]
        time_s = getattr(message, "_timestamp", time_s)  # before the first time there is none
        foreign.add(f"/ardupilot/{name}", done.messages, round(time_s * 1e6) * 1000, values)
        done.messages += 1
    if unlike:
        done.told.append(f"{unlike} messages whose kind the log declares a second time, otherwise")


def _next(reader: Any, done: Imported) -> Any:
    """The next message; None at the end, or where pymavlink does not know any further."""
    try:
        return reader.recv_msg()
    except Exception as error:  # it raises what its parsing happens to raise
        done.told.append(f"pymavlink cannot read it to its end: {in_a_line(error)}")
        return None


def _kind(letter: str) -> str:
    if letter in _STRINGS:
        return "str"
    if letter in _FLOATS:
        return "float"
    return "double" if letter in _DOUBLES else "uint" if letter == "Q" else "int"


def _value(value: Any, letter: str) -> Any:
    if letter in _STRINGS:
        return value.decode("ascii", "replace") if isinstance(value, bytes) else str(value)
    if letter in _FLOATS or letter in _DOUBLES:
        return float(value)
    return list(value) if letter == _LIST else int(value)
