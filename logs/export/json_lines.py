"""Lines of JSON, an object a message: topic, name, system, component, log_time_ns, and the fields in `values`.

NaN and infinities are null, since JSON has neither. Integers are exact, 64-bit ones too: a reader that keeps numbers as
doubles (JavaScript's `JSON.parse`) rounds those above 2^53, log times among them; Python, jq 1.7, DuckDB do not.
"""

import json
from pathlib import Path

from logs.export import Exported, begun, unfinished
from logs.export.tables import jsonable
from logs.reader import Recording
from logs.rows import Row, rows
from logs.selection import Selection, nothing_left, selected


def to_json(recording: Recording, path: Path, wanted: Selection, force: bool = False) -> Exported:
    """Write every selected decoded message.

    Raises
    ------
    RecordingError    It cannot be written, or nothing is selected.
    """
    done = begun(recording, path)
    with unfinished(path, force) as temporary:
        with open(temporary, "w", encoding="utf-8") as file:
            for row in rows(recording, selected(recording.messages(), wanted)):
                file.write(line(row))
                done.count(row.topic)
        if not done.messages:
            raise nothing_left(recording, wanted)
    return done


def line(row: Row) -> str:
    """One message, with the end of the line."""
    value = {
        "topic": row.topic,
        "name": row.name,
        "system": row.system,
        "component": row.component,
        "log_time_ns": row.log_time_ns,
        "values": jsonable(row.values),
    }
    return json.dumps(value, separators=(",", ":"), allow_nan=False) + "\n"
