"""What a flight was told before it began, out of its recording: the mission's keys and the companion's configuration.

Keys are those of `companion rerun --set`: `limits.speed`, `steps.1.goto.north`, `seed`.
"""

import hashlib
import json
from collections.abc import Iterator, Mapping
from typing import Any

from companion.errors import CompanionError, MissionError
from companion.yamlfile import read_yaml
from logs.reader import Recording

MISSION_ATTACHMENT = "mission.yaml"
CONFIG_METADATA, CONFIG_KEY = "companion.config", "config"
MOST_BYTES = 1_000_000

Settings = Mapping[str, Any]


def settings_of(recording: Recording) -> Settings:
    """Every key with its value; of a mission in another form than YAML or JSON only that it is another one."""
    found: dict[str, Any] = {}
    attached = recording.attachments.get(MISSION_ATTACHMENT)
    if attached is not None:
        try:
            document, _ = read_yaml(
                attached.data, MISSION_ATTACHMENT, MissionError, most_bytes=MOST_BYTES, expected="a mission"
            )
            found.update(_flat(document))
        except CompanionError:
            found["mission"] = f"sha256 {hashlib.sha256(attached.data).hexdigest()}"
    try:
        config = json.loads(recording.metadata.get(CONFIG_METADATA, {}).get(CONFIG_KEY, "{}"))
    except ValueError:  # written by somebody else
        config = {}
    found.update(_flat(config if isinstance(config, dict) else {}))
    return found


def differing(left: Settings, right: Settings) -> dict[str, tuple[Any, Any]]:
    """The keys whose values are not the same, with both; None where one has none."""
    names = sorted(left.keys() | right.keys())
    pairs = {name: (left.get(name), right.get(name)) for name in names}
    return {name: pair for name, pair in pairs.items() if pair[0] != pair[1]}


def _flat(value: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """Mappings and lists taken apart, but for lists of nothing but plain values."""
    if isinstance(value, dict):
        parts = [(str(key), item) for key, item in value.items()]
    elif isinstance(value, list) and any(isinstance(item, dict | list) for item in value):
        parts = [(str(number), item) for number, item in enumerate(value)]
    else:
        yield name, value
        return
    for key, item in parts:
        yield from _flat(item, f"{name}.{key}" if name else key)
