"""The file of a mission: read safely, checked once, every problem told at once. YAML, or a ground station's plan.

Each has its line: file, line, key, what was found and what was expected. The file is read with PyYAML's safe loader.
"""

import difflib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, get_args

import yaml
from pydantic import BaseModel, ValidationError

from companion.errors import MissionError
from companion.geodesy import Geodetic
from companion.mission import Mission
from companion.planfiles import is_plan_file, read
from companion.planfiles.document import ground_plan, mission_document, to_mission
from companion.planfiles.items import GroundPlan
from companion.shapes import ORIGIN, Origin
from companion.yamlfile import line_of, read_yaml, shown

MAX_FILE_BYTES = 1_000_000
"""A mission is written by people; beyond this it is something else."""
EXPECTED = "a mapping with name, vehicle, world, steps"
NO_MAPS: Mapping[str, Path] = {}


def load_mission(path: str | Path) -> Mission:
    """Read and check a mission file.

    Raises
    ------
    MissionError : the file is missing, too large, not YAML, or not a mission; every problem has its own line.
    """
    return parse_mission(read_mission_file(path), str(path))


def read_mission_file(path: str | Path) -> bytes:
    """The bytes of a mission file, as they go into the recording.

    Raises
    ------
    MissionError : it cannot be read or is too large.
    """
    try:
        with Path(path).open("rb") as file:
            return file.read(MAX_FILE_BYTES + 1)
    except OSError as error:
        raise MissionError(str(path), [f"cannot be read: {error.strerror or error}"]) from error


def parse_mission(data: bytes, file: str, maps: Mapping[str, Path] = NO_MAPS) -> Mission:
    """Check a mission given as the bytes of its file; `file` is its name in errors. Raises as `load_mission`.

    Files of voxels and clouds are looked for in the folder of `file`, but for those whose place `maps` tells.
    """
    if len(data) > MAX_FILE_BYTES:
        raise MissionError(file, [f"found more than {MAX_FILE_BYTES} bytes, expected a file that people write"])
    if is_plan_file(data, file):
        return _of_plan(data, file)
    document, node = read_yaml(data, file, MissionError, most_bytes=MAX_FILE_BYTES, expected=EXPECTED)
    if "vehicles" in document:
        where = f"line {line_of(node, ['vehicles'])}: vehicles"
        told = "found several vehicles, expected one: companion simulate, fly, run and test take such a file"
        raise MissionError(file, [f"{where}: {told}"])
    try:
        mission = Mission.model_validate(document, context={ORIGIN: _origin(document)})
    except ValidationError as error:
        raise MissionError(file, [_problem(item, node) for item in error.errors()]) from error
    found = mission.read_maps(Path(file).parent, maps)
    if found:
        raise MissionError(file, [f"line {line_of(node, k)}: {'.'.join(map(str, k))}: {text}" for k, text in found])
    return mission


def _of_plan(data: bytes, file: str) -> Mission:
    """The mission of a ground station's plan; problems name the key that a mission file would have."""
    plan = read(data, file)
    document = mission_document(plan, Path(file.rpartition(": ")[2]).stem[:100] or "plan", file)
    assert plan.home is not None
    try:
        mission = to_mission(document, plan.home)
    except ValidationError as error:
        raise MissionError(file, [_problem(item, None).partition(": ")[2] for item in error.errors()]) from error
    told = ground_plan(plan)
    mission.keep_ground_plan(told)
    found = mission.beyond_reach() or mission.beyond_the_fence()
    if found:
        raise MissionError(file, [f"{_plan_item(told, k)}{'.'.join(map(str, k))}: {text}" for k, text in found])
    return mission


def _plan_item(told: GroundPlan, keys: list[Any]) -> str:
    """Which item of a plan a step of the mission comes from, for people."""
    if keys[:1] != ["steps"]:
        return ""
    return f"item {told.current(keys[1])}: "


def _origin(document: dict[str, Any]) -> Geodetic | None:
    """What geodetic places are relative to, if the document says so rightly; what is wrong with it is told later."""
    try:
        return Origin.model_validate(document.get("origin")).geodetic()
    except ValidationError:
        return None


def _problem(item: Any, root: yaml.Node | None) -> str:
    """One pydantic error as `line N: key: found ..., expected ...`."""
    keys = [key for key in item["loc"]]
    line, key = line_of(root, keys), ".".join(str(k) for k in keys) or "mission"
    kind, message, context = item["type"], item["msg"].removeprefix("Value error, "), item.get("ctx", {})
    if kind == "missing":
        return f"line {line}: {key}: found nothing, expected a value"
    if kind == "extra_forbidden":
        near = difflib.get_close_matches(str(keys[-1]), all_keys(Mission), n=1)
        meant = f"; did you mean {near[0]}?" if near else ""
        return f"line {line}: {key}: found an unknown key, expected one of docs/mission.md{meant}"
    if kind == "model_type":
        return f"line {line}: {key}: found {shown(item['input'])}, expected a mapping"
    if kind == "literal_error":
        return f"line {line}: {key}: found {shown(item['input'])}, expected {context.get('expected')}"
    if kind == "value_error":
        return f"line {line}: {key}: {message}" + ("" if "found" in message else f", found {shown(item['input'])}")
    expected = message.removeprefix("Input should be ").split(", unable")[0]
    return f"line {line}: {key}: found {shown(item['input'])}, expected {expected}"


def all_keys(model: type[BaseModel]) -> set[str]:
    """Every key that the mission format knows, at any depth."""
    keys: set[str] = set()
    for name, entry in model.model_fields.items():
        keys.add(entry.alias or name)
        for kind in _parts(entry.annotation):
            if isinstance(kind, type) and issubclass(kind, BaseModel):
                keys |= all_keys(kind)
    return keys


def _parts(annotation: Any) -> list[Any]:
    """A type and everything it is made of: of `list[Area] | None` also Area."""
    return [annotation, *(part for inner in get_args(annotation) for part in _parts(inner))]
