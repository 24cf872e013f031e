"""What a person wants to be otherwise in a re-run: `key=value`, of the mission or of the companion's configuration.

A key of the configuration is one word (`seed=2`), one of the mission goes down from its top (`limits.speed=2`,
`steps.1.goto.north=12`, counted from 0). The changed mission is checked as any mission is.
"""

from collections.abc import Iterable, Mapping
from dataclasses import asdict, fields
from typing import Any

import yaml
from pydantic import TypeAdapter, ValidationError

from companion.core import CompanionConfig
from companion.errors import CompanionError, RerunError
from companion.mission import Mission
from companion.missionfile import EXPECTED, MAX_FILE_BYTES
from companion.planfiles import is_plan_file
from companion.yamlfile import read_yaml

Changes = Mapping[str, Any]
CONFIG_KEYS = tuple(entry.name for entry in fields(CompanionConfig))


def changes_of(texts: Iterable[str]) -> dict[str, Any]:
    """`key=value` texts as a mapping; values as YAML has them.

    Raises
    ------
    RerunError : a text without a key or a value, or a key twice.
    """
    changes: dict[str, Any] = {}
    for text in texts:
        key, equals, value = text.partition("=")
        if not equals or not key.strip() or key.strip() in changes:
            again = "a second one" if key.strip() in changes else repr(text)
            raise RerunError(f"--set: found {again}, expected KEY=VALUE, such as limits.speed=2, and each key once")
        try:
            changes[key.strip()] = yaml.safe_load(value)
        except yaml.YAMLError as error:
            raise RerunError(f"--set {key}: found {value!r}, expected a value as YAML has them") from error
    return changes


def changed_config(config: CompanionConfig, changes: Changes) -> CompanionConfig:
    """The configuration with those of the changes that are its.

    Raises
    ------
    RerunError : a value is not of the key's kind.
    """
    values = asdict(config) | {key: value for key, value in changes.items() if key in CONFIG_KEYS}
    try:
        return TypeAdapter(CompanionConfig).validate_python(values)
    except ValidationError as error:
        found = error.errors()[0]
        key = ".".join(str(part) for part in found["loc"])
        raise RerunError(f"--set {key}: found {found['input']!r}, expected {_expected(found['msg'])}") from error


def changed_mission(data: bytes, changes: Changes, file: str) -> bytes:
    """The mission's file with those of the changes that are its; the same bytes when none is.

    Raises
    ------
    RerunError : a key leads nowhere.
    """
    own = {key: value for key, value in changes.items() if key not in CONFIG_KEYS}
    if not own:
        return data
    if is_plan_file(data, file):
        raise RerunError(f"--set {next(iter(own))}: the mission is a ground station's plan, which has no such keys")
    document, _ = read_yaml(data, file, _failed, most_bytes=MAX_FILE_BYTES, expected=EXPECTED)
    for key, value in own.items():
        _put(document, key, value)
    text: str = yaml.safe_dump(document, sort_keys=False, allow_unicode=True)
    return text.encode()


def _put(document: dict[Any, Any], key: str, value: Any) -> None:
    """Put a value where a key leads; mappings on the way are made, entries of lists are not."""
    *way, last = key.split(".")
    if (way or [last])[0] not in Mission.model_fields:
        known = ", ".join((*CONFIG_KEYS, *Mission.model_fields))
        raise RerunError(f"--set {key}: found an unknown key, expected one that begins with one of {known}")
    place: Any = document
    for name in way:
        if isinstance(place, dict):
            if place.get(name) is None:
                place[name] = {}
            place = place[name]
        else:
            place = _entry(place, name, key)[int(name)]
    if isinstance(place, dict):
        place[last] = value
    else:
        _entry(place, last, key)[int(last)] = value


def _entry(place: Any, name: str, key: str) -> list[Any]:
    """The list that has an entry of that number."""
    if not isinstance(place, list):
        raise RerunError(f"--set {key}: found {place!r} where {name} should be in it, expected a mapping or a list")
    if not name.isascii() or not name.isdigit() or int(name) >= len(place):
        raise RerunError(f"--set {key}: found {name!r}, expected the number of one of {len(place)} entries, from 0")
    return place


def _expected(message: str) -> str:
    return message.removeprefix("Input should be ").split(", unable")[0]


def _failed(file: str, problems: list[str]) -> CompanionError:
    return RerunError(f"{file}: {problems[0]}")
