"""A mission file with `vehicles:`: one world, several vehicles, each with a start and steps of its own.

Each vehicle's part is a mission of its own, in the same frame, and is written as a mission file, which is what a
recording of its flight holds.
"""

from copy import deepcopy
from dataclasses import dataclass
from typing import Any

import yaml

from companion.errors import MissionError
from companion.mission import Mission
from companion.missionfile import MAX_FILE_BYTES, parse_mission
from companion.yamlfile import read_yaml

MOST_VEHICLES = 32
KEYS = ("name", "start", "steps")


@dataclass(frozen=True, slots=True)
class Part:
    """One vehicle of a mission: its name, the mission file of its part, and that mission."""

    name: str
    data: bytes
    mission: Mission


def has_vehicles(data: bytes) -> bool:
    """Whether a mission file is one of several vehicles."""
    return any(line.startswith(b"vehicles:") for line in data.splitlines())


def split(data: bytes, file: str) -> list[Part]:
    """The parts of a mission file with `vehicles`, in its order; the earlier has the right of way.

    Raises
    ------
    MissionError : it is not a mission; what is wrong in one vehicle's part is told by its name.
    """
    document, _ = read_yaml(data, file, MissionError, most_bytes=MAX_FILE_BYTES, expected="a mapping with vehicles")
    entries = document.get("vehicles")
    if not isinstance(entries, list) or not 1 <= len(entries) <= MOST_VEHICLES:
        raise MissionError(file, [f"vehicles: expected a list of 1 to {MOST_VEHICLES}"])
    if "steps" in document:
        raise MissionError(file, ["steps: found beside vehicles, expected steps in each of them"])
    parts: list[Part] = []
    for k, entry in enumerate(entries):
        where = f"vehicles.{k}"
        if not isinstance(entry, dict) or set(entry) - set(KEYS) or not {"start", "steps"} <= set(entry):
            raise MissionError(file, [f"{where}: expected a mapping with start, steps and perhaps name"])
        name = str(entry.get("name", k + 1))
        if name in (part.name for part in parts):
            raise MissionError(file, [f"{where}.name: found {name!r} twice, expected names that differ"])
        parts.append(_part(document, entry, name, f"{file}: {where} ({name})"))
    _apart(parts, file)
    return parts


def _part(document: dict[str, Any], entry: dict[str, Any], name: str, where: str) -> Part:
    """One vehicle's mission; its lines are not those of the file."""
    own = deepcopy({key: value for key, value in document.items() if key != "vehicles"})
    vehicle = own.get("vehicle")
    own["vehicle"] = {**(vehicle if isinstance(vehicle, dict) else {}), "start": entry["start"]}
    own["steps"] = entry["steps"]
    data = yaml.safe_dump(own, sort_keys=False).encode()
    try:
        return Part(name, data, parse_mission(data, where))
    except MissionError as error:
        problems = [p.split(": ", 1)[1] if p.startswith("line ") else p for p in error.problems]
        raise MissionError(where, problems) from error


def _apart(parts: list[Part], file: str) -> None:
    """Nobody starts inside another."""
    for k, part in enumerate(parts):
        for other in parts[:k]:
            north, east = (a - b for a, b in zip(part.mission.start_m()[:2], other.mission.start_m()[:2], strict=True))
            least = part.mission.vehicle.radius + other.mission.vehicle.radius
            if north * north + east * east < least * least:
                raise MissionError(
                    file, [f"vehicles: {other.name} and {part.name} start nearer than {least:g} m to each other"]
                )
