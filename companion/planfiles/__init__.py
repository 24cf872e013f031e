"""Plan files of ground stations: QGroundControl's `.plan` and `QGC WPL 110`, read and written.

`is_plan_file` tells by the content; `read` gives a `document.Plan`, and `document.mission_document` what a mission file
would say. `reading` says what each item means, `writing` the way back. Latitude and longitude in degrees, altitudes in
metres.
"""

from companion.errors import MissionError
from companion.planfiles.document import Plan
from companion.planfiles.qgc import read_plan
from companion.planfiles.wpl import MAGIC, read_wpl

NAMES = (".plan", ".waypoints")

__all__ = ["Plan", "is_plan_file", "read"]


def is_plan_file(data: bytes, file: str = "") -> bool:
    """Whether a file's bytes are one of the formats of ground stations, rather than YAML; its name helps in doubt."""
    head = data[:200].removeprefix(b"\xef\xbb\xbf").lstrip()
    if head.startswith(MAGIC[:7].encode()) or (head.startswith(b"{") and b'"fileType"' in data):
        return True
    return file.endswith(NAMES)


def read(data: bytes, file: str) -> Plan:
    """The plan of a file's bytes.

    Raises
    ------
    MissionError : it cannot be read.
    """
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise MissionError(file, [f"byte {error.start}: not UTF-8 text"]) from error
    is_wpl = text.lstrip().startswith(MAGIC[:7]) or file.endswith(".waypoints")
    return read_wpl(text, file) if is_wpl else read_plan(text, file)
