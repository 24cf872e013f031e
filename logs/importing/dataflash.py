"""ArduPilot's .BIN as recordings, read by pymavlink's DFReader.

Every kind of message becomes ``/ardupilot/<NAME>``, with the log's own names; values are in the units that DFReader
gives (degrees, metres: its multipliers applied). Times are Unix time where the log has GPS time, from the boot on else.
"""

from pathlib import Path
from typing import Any

from logs.errors import RecordingError
from logs.export import unfinished
from logs.importing import Imported
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
    from pymavlink.DFReader import DFReader_binary

    with open(source, "rb") as file:
        if file.read(2) != b"\xa3\x95":
            raise RecordingError(source, "it does not begin as a .BIN does: no ArduPilot log")
    try:
        reader = DFReader_binary(str(source), zero_time_base=False)
    except Exception as error:  # it raises what its parsing happens to raise
        raise RecordingError(source, f"pymavlink cannot read it: {error or type(error).__name__}") from error
    done = Imported(target)
    try:
        about = {"of": source.name, "format": "dataflash"}
        with unfinished(target, force) as temporary, Foreign(temporary, "ardupilot", about) as foreign:
            _copy(reader, foreign, done)
            if not done.messages:
                raise RecordingError(source, "there is nothing in it")
    finally:
        reader.data_map.close()
        reader.filehandle.close()
    return done


def _copy(reader: Any, foreign: Foreign, done: Imported) -> None:
    declared: dict[str, str] = {}  # name -> the letters it was declared with
    unlike = 0
    while (message := reader.recv_msg()) is not None:
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
        time_ns = max(0, round(message._timestamp * 1e6)) * 1000
        foreign.add(f"/ardupilot/{name}", done.messages, time_ns, values)
        done.messages += 1
    if unlike:
        done.told.append(f"{unlike} messages whose kind the log declares a second time, otherwise")


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
