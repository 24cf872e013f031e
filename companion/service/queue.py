"""Which mission comes next: a file, the files of a folder by name, or what a ground station has put there."""

import re
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from companion.errors import CompanionError, MissionError
from companion.fleet.missions import has_vehicles, split
from companion.mission import Mission
from companion.missionfile import parse_mission, read_mission_file

ENDINGS = (".yaml", ".yml", ".plan", ".waypoints")
MOST_FILES = 1000


@dataclass(frozen=True, slots=True)
class Ready:
    """A mission that can be flown: its name for people, the bytes of its file, and what they say."""

    file: str
    data: bytes
    mission: Mission


class Missions:
    """The missions of a service, one after another.

    Parameters
    ----------
    file, folder : one mission, again and again when it is asked for; or each of a folder once, in the order of names.
    number : of a file with several vehicles, which is ours; 0: none.

    Attributes
    ----------
    ready : the next mission; None: there is none, and `why_not` says why.
    """

    UPLOADED = "uploaded.plan"

    def __init__(self, file: Path | None = None, folder: Path | None = None, number: int = 0) -> None:
        self._file, self._folder, self._number = file, folder, number
        self._flown: set[str] = set()
        self._uploaded: Ready | None = None
        self._refusal = ""  # why what was uploaded cannot be flown
        self._seen = b""  # the bytes that `ready` was read from
        self.ready: Ready | None = None
        self.why_not = "there is no mission"

    def look(self, anew: bool = False) -> None:
        """Read what comes next; `why_not` tells of a file that is none. What was uploaded stays until it is cleared.

        A file whose bytes are as they were is not parsed again, unless it is looked at `anew`: the files of voxels and
        clouds that it names may be others now.
        """
        if self._uploaded is not None or self._refusal:  # and no file instead of a plan that cannot be flown
            self.ready, self.why_not = self._uploaded, self._refusal
            return
        try:
            path = self._file if self._folder is None else self._next()
        except OSError as error:
            self.ready, self.why_not = None, f"{self._folder}: cannot be read: {error.strerror or error}"
            return
        if path is None:
            self.ready, self.why_not = None, "there is no mission" if self._folder is None else "no mission is left"
            return
        try:
            data = read_mission_file(path)
            as_it_was = self.ready is not None and self.ready.file == str(path) and data == self._seen
            if anew or not as_it_was:
                self.ready, self.why_not, self._seen = self._read(str(path), data), "", data
        except MissionError as error:
            self.ready, self.why_not = None, error.args[0].splitlines()[0]

    def _read(self, file: str, data: bytes) -> Ready:
        if not has_vehicles(data):
            return Ready(file, data, parse_mission(data, file))
        parts = split(data, file)
        if not 1 <= self._number <= len(parts):
            raise MissionError(file, [f"vehicles: found {len(parts)}, expected fleet.number to say which is ours"])
        part = parts[self._number - 1]
        return Ready(file, part.data, part.mission)

    def upload(self, data: bytes | None) -> None:
        """A ground station's plan comes next, before what the files say; None: it was cleared."""
        self._uploaded, self._refusal = None, ""
        if data is not None:
            try:
                self._uploaded = Ready(self.UPLOADED, data, parse_mission(data, self.UPLOADED))
            except MissionError as error:
                self._refusal = error.args[0].splitlines()[0]
        self.look()

    def done(self) -> None:
        """The mission that was ready has been flown."""
        if self.ready is not None:
            self._flown.add(self.ready.file)
        self.look()

    def _next(self) -> Path | None:
        assert self._folder is not None
        found = sorted(p for p in self._folder.iterdir() if p.suffix in ENDINGS and p.is_file())[:MOST_FILES]
        return next((path for path in found if str(path) not in self._flown), None)


def recording_file(directory: Path, mission: Mission) -> Path:
    """A file name in `directory` (made if need be) that says what and when, and is not taken.

    Raises
    ------
    CompanionError : the directory cannot be made.
    """
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CompanionError(f"{directory}: cannot make the directory: {error.strerror or error}") from error
    slug = re.sub(r"[^a-z0-9]+", "-", mission.name.lower()).strip("-") or "mission"
    return directory / f"{slug}-{datetime.now(UTC):%Y%m%dT%H%M%S_%fZ}.mcap"


_OURS = re.compile(r"[a-z0-9-]+-\d{8}T\d{6}_\d{6}Z(\.part\d{4})?\.mcap")


def make_room(directory: Path, most_mb: float) -> list[Path]:
    """Remove the oldest of our recordings until the rest takes less than `most_mb`; says which."""
    found = []
    for path in directory.glob("*.mcap") if directory.is_dir() else ():
        if _OURS.fullmatch(path.name):
            status = path.stat()
            found.append((status.st_mtime, status.st_size, path))
    found.sort()
    total, removed = sum(size for _, size, _ in found), []
    for _, size, path in found:
        if total < most_mb * 1e6:
            break
        path.unlink(missing_ok=True)
        total -= size
        removed.append(path)
    return removed
