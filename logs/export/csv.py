"""Comma-separated values: a folder with a file a topic.

The first column is `log_time_ns`, an exact integer; a float has as many digits as it needs to be read back the same;
NaN is `nan`, an infinity `inf`; booleans are 1 and 0; an empty cell is a list that is shorter than the longest.
"""

import csv
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from logs.export import Exported, FileNames, begun, unfinished
from logs.export.tables import Widths, cells, header
from logs.reader import Recording
from logs.rows import rows
from logs.selection import Selection, nothing_left, selected

MOST_OPEN = 400
"""Files open at once; those of further topics are opened for every line."""


def to_csv(recording: Recording, path: Path, wanted: Selection, force: bool = False) -> Exported:
    """Write every selected decoded topic into a file of its own in the folder `path`.

    Raises
    ------
    RecordingError    It cannot be written, or nothing is selected.
    """
    done = begun(recording, path)
    widths = Widths(recording, selected(recording.messages(), wanted))
    names, files = FileNames(), dict[str, Path]()
    writers: dict[str, Any] = {}
    with unfinished(path, force, folder=True) as folder, ExitStack() as stack:
        for row in rows(recording, selected(recording.messages(), wanted)):
            writer = writers.get(row.topic)
            once = ExitStack()
            if writer is None:
                new = row.topic not in files
                target = files.setdefault(row.topic, folder / f"{names.of(row.topic)}.csv" if new else folder)
                file = open(target, "a", newline="", encoding="utf-8")  # noqa: SIM115  closed by a stack
                writer = csv.writer(file, lineterminator="\n")
                if len(writers) < MOST_OPEN:
                    writers[row.topic] = writer
                    stack.push(file)
                else:
                    once.push(file)
                if new:
                    writer.writerow(header(row.topic, row.values, widths))
            with once:
                found = cells(row.topic, row.log_time_ns, row.values, widths)
                writer.writerow([int(cell) if cell is True or cell is False else cell for cell in found])
            done.count(row.topic)
        stack.close()
        if not done.messages:
            raise nothing_left(recording, wanted)
    return done
