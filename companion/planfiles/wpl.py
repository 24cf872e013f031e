"""`QGC WPL 110`: a line an item, twelve columns between tabs; what MAVProxy, Mission Planner and others keep.

Columns: index, current, frame, command, p1 to p4, x, y, z, autocontinue (https://mavlink.io/en/file_formats/). Item 0
is home: its altitude is above the sea whatever its frame. A file that begins with another command than a waypoint has
no home, and its first place on the earth stands for it. Lines that begin with # are comments.
"""

import math
from collections.abc import Sequence

from companion.errors import MissionError
from companion.geodesy import Geodetic
from companion.planfiles.document import Plan
from companion.planfiles.items import GLOBAL, MOST_ITEMS, Item
from wire.dialect import mavlink

MAGIC = "QGC WPL 110"
COLUMNS = 12


def read_wpl(text: str, file: str) -> Plan:
    """The plan of a file's text.

    Raises
    ------
    MissionError : it is not one; every bad line is told.
    """
    lines = text.splitlines()
    if not lines or lines[0].strip() != MAGIC:
        raise MissionError(file, [f"line 1: found {(lines or [''])[0].strip()[:40]!r}, expected {MAGIC!r}"])
    items: list[Item] = []
    problems: list[str] = []
    for number, line in enumerate(lines[1:], start=2):
        if not line.strip() or line.startswith("#"):
            continue
        columns = line.split()
        found = _item(columns)
        if isinstance(found, str):
            problems.append(f"line {number}: {found}")
            continue
        if int(columns[0]) != len(items):
            problems.append(f"line {number}: found index {columns[0]}, expected {len(items)}")
        items.append(found)
        if len(problems) > 20 or len(items) > MOST_ITEMS + 1:
            problems.append(f"line {number}: expected at most {MOST_ITEMS} items and home")
            break
    if problems:
        raise MissionError(file, problems)
    if not items:
        raise MissionError(file, ["line 1: found no items, expected home and at least one more"])
    if items[0].command in (mavlink.MAV_CMD_NAV_WAYPOINT, 0):
        home, items = items[0], items[1:]
        if any(home.params[4:6]):
            return Plan(items, Geodetic(*home.params[4:]), first=1, home_item=home)
        return Plan(items, _first_place(items), first=1, home_item=home)  # a home that was never set
    return Plan(items, _first_place(items))


def _first_place(items: Sequence[Item]) -> Geodetic | None:
    """The first place on the earth that is told."""
    place = next((i.params for i in items if i.frame in GLOBAL and any(i.params[4:6])), None)
    return None if place is None else Geodetic(place[4], place[5])


def write_wpl(items: Sequence[Item], home: Geodetic) -> str:
    """A file's text; numbers are as short as they can be and read back as they are. A NaN is written as 0."""
    rows = [Item(mavlink.MAV_CMD_NAV_WAYPOINT, mavlink.MAV_FRAME_GLOBAL, (0.0, 0.0, 0.0, 0.0, *home)), *items]
    lines = [MAGIC]
    for index, item in enumerate(rows):
        numbers = [f"{0.0 if math.isnan(p) else p:.9g}" for p in item.params[:4]]
        numbers += [f"{0.0 if math.isnan(p) else p:.9f}".rstrip("0").rstrip(".") for p in item.params[4:]]
        follows = str(item.extra.get("autocontinue", int(item.follows)))
        lines.append(
            "\t".join([str(index), str(int(index == 0)), str(item.frame), str(item.command), *numbers, follows])
        )
    return "\n".join(lines) + "\n"


def _item(columns: list[str]) -> Item | str:
    """One line, or what is wrong with it."""
    if len(columns) != COLUMNS:
        return f"found {len(columns)} columns, expected {COLUMNS}"
    try:
        index, current, frame, command, follows = (int(columns[k]) for k in (0, 1, 2, 3, 11))
    except ValueError:
        return "found a word, expected whole numbers in columns 1 to 4 and 12"
    try:
        p1, p2, p3, p4, x, y, z = (float(column) for column in columns[4:11])
    except ValueError:
        return "found a word, expected numbers in columns 5 to 11"
    if min(index, current, frame, command, follows) < 0 or not all(map(math.isfinite, (x, y, z))):
        return "found a negative or infinite number where there can be none"
    if command > 65_535 or frame > 255:
        return "found a number too large for a command or a frame, expected at most 65535 and 255"
    return Item(command, frame, (p1, p2, p3, p4, x, y, z), {"autocontinue": follows})
