"""The voxel and cloud files that a mission's world names: into a recording, and out of it again.

A mission file names them and does not hold them. Without them a recording could be run again, or its world drawn, only
where they still are, and as they were.
"""

import tempfile
from collections.abc import Iterable
from pathlib import Path

from companion.mission import Mission
from companion.missionfile import parse_mission
from logs.container import Attachment
from logs.reader import Recording

PREFIX = "world/"


def world_attachments(mission: Mission) -> list[Attachment]:
    """Each file, under the name that the mission has for it; great ones are left out (`Mission.map_files`)."""
    return [Attachment(PREFIX + name, "application/octet-stream", data) for name, data in mission.map_files.items()]


def recorded_mission(recording: Recording, data: bytes, file: str) -> Mission:
    """The mission in `data`, its world's files out of a recording; what is not in there is looked for beside it.

    Raises
    ------
    MissionError : as `parse_mission`.
    """
    with tempfile.TemporaryDirectory(prefix="companion-world-") as folder:
        return parse_mission(data, file, _unpacked(recording.attachments.values(), Path(folder)))


def _unpacked(attachments: Iterable[Attachment], folder: Path) -> dict[str, Path]:
    """The files by the mission's names; in the folder they have numbers, since a name may lead anywhere."""
    found: dict[str, Path] = {}
    for number, attachment in enumerate(attachments):
        if attachment.name.startswith(PREFIX):
            name = attachment.name.removeprefix(PREFIX)
            found[name] = folder / f"{number}{'.pcd' if name.lower().endswith('.pcd') else '.npz'}"
            found[name].write_bytes(attachment.data)
    return found
