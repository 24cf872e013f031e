"""The folder of a campaign.

    sweep.yaml       the sweep, as it was given
    campaign.json    name, versions, and the ids of all runs in their order
    missions/        the missions that are flown, each once, by digest
    runs/ID/         result.json: what was flown, its row, its cost, a digest of the versions that flew it; flight.mcap
                     where a recording is kept
    runs.parquet, costs.parquet

A run is made in a folder with a name of its own, beside the others, which gets its final name when everything is in it
and on the disk. So there is no half of a run, whatever happens, and what has its final name is never written again:
two commands may fly the same run, and the first is kept. One that is damaged nevertheless loses its name first, and is
removed then. What the disk does not let us read is not damaged: nothing is removed for it.
"""

import json
import os
import platform
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from campaigns.errors import CampaignError
from campaigns.executors.versions import digest, versions
from campaigns.flying import Flown, Row
from campaigns.runs import Run, Squall
from campaigns.sweep import Sweep
from campaigns.table import COST_COLUMNS, whole
from companion.drivers.provenance import revision, version
from companion.testing.wire import LinkFaults

RESULT, RECORDING, CAMPAIGN = "result.json", "flight.mcap", "campaign.json"
_ID = re.compile(r"[0-9a-f]{8,64}")
_PARTIAL = re.compile(r"\.(?P<host>.+)\.(?P<pid>\d+)\.(?P<what>[0-9a-z]+)")


@dataclass(frozen=True, slots=True)
class Stored:
    """A run that is done: what was flown, its row, its cost, and the digest of the versions that flew it."""

    run: dict[str, Any]
    row: Row
    cost: dict[str, Any]
    versions: str


class Store:
    """A campaign's folder, opened.

    Attributes
    ----------
    folder : where it is.
    name, run_ids : of the campaign; the ids in their order.
    unreadable : results that were found damaged; their runs are not done.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.told = _campaign(folder)
        self.name: str = self.told["name"]
        self.run_ids: list[str] = self.told["run_ids"]
        self.unreadable: list[str] = []

    @property
    def runs(self) -> Path:
        return self.folder / "runs"

    def done(self) -> set[str]:
        """Ids of the runs that are done, as far as their names tell.

        Raises
        ------
        CampaignError : the folder cannot be read.
        """
        try:
            return {name for name in os.listdir(self.runs) if _ID.fullmatch(name)}.intersection(self.run_ids)
        except FileNotFoundError:
            return set()
        except OSError as error:
            raise _unread(self.runs, error) from error

    def read(self, run_id: str) -> Stored | None:
        """A run that is done; None when it is not, or its result is damaged, or missing in its folder.

        Raises
        ------
        CampaignError : the disk does not let it be read, which says nothing about the result.
        """
        path = self.runs / run_id / RESULT
        try:
            return _stored(run_id, json.loads(path.read_bytes()))
        except FileNotFoundError:
            if not path.parent.exists():
                return None
        except OSError as error:
            raise _unread(path, error) from error
        except (ValueError, KeyError, TypeError):
            pass
        self.unreadable.append(run_id)
        return None

    def stored(self) -> Iterator[Stored]:
        """Every run that is done, in the order of the campaign; raises as `read` does."""
        done = self.done()
        for run_id in self.run_ids:
            if run_id in done and (found := self.read(run_id)) is not None:
                yield found

    def rows(self) -> list[Row]:
        """Their rows, with `recording`: where the run's is kept, from the folder; empty where none is."""
        return [{**found.row, "recording": self.recording(found.row["run_id"])} for found in self.stored()]

    def recording(self, run_id: str) -> str:
        """Where its recording is kept, relative to the folder; empty: there is none. A folder of several vehicles'."""
        path = self.runs / run_id / RECORDING
        return path.relative_to(self.folder).as_posix() if path.exists() else ""

    def complete(self, run: Run, flown: Flown, attempts: int) -> None:
        """Keep what came of a run.

        Raises
        ------
        CampaignError : it cannot be written; what is there stays whole.
        """
        cost = {"run_id": run.run_id, "cpu_s": flown.cpu_s, "wall_s": flown.wall_s, "host": flown.host}
        told = {"run": _told(run), "row": flown.row, "cost": {**cost, "attempts": attempts}, "versions": digest()}
        with self.writing():
            self._keep_mission(run)
            partial = self._partial(run.run_id)
            try:
                partial.mkdir(parents=True, exist_ok=True)
                _write(partial / RESULT, json.dumps(told, allow_nan=False).encode())
                with suppress(FileExistsError):
                    _rename(partial, self.runs / run.run_id)
            finally:
                shutil.rmtree(partial, ignore_errors=True)

    def discard_damaged(self) -> None:
        """Remove the results that were found damaged, so that their runs are flown again.

        Raises
        ------
        CampaignError : they cannot be.
        """
        with self.writing():
            for run_id in set(self.unreadable):
                aside = self._partial(f"damaged{run_id}")  # whoever dies over it leaves no run's name
                with suppress(FileNotFoundError):  # another command was first
                    os.rename(self.runs / run_id, aside)
                shutil.rmtree(aside, ignore_errors=True)
        self.unreadable.clear()

    def place_for_recording(self, run_id: str) -> Path:
        """A file to record a run to, in a folder of its own, which is to be made."""
        return self._partial(run_id) / RECORDING

    def end_recording(self, run_id: str, keep: bool) -> None:
        """Make what was recorded the run's recording, or drop it.

        Raises
        ------
        CampaignError : it is not there, or cannot be moved.
        """
        partial = self._partial(run_id)
        try:
            with self.writing():
                if keep and not self.recording(run_id):
                    os.replace(partial / RECORDING, self.runs / run_id / RECORDING)
        finally:
            shutil.rmtree(partial, ignore_errors=True)

    def run(self, run_id: str) -> Run:
        """A run that is done, as it was flown.

        Raises
        ------
        CampaignError : there is none of that id, or what is kept of it is damaged.
        """
        found = self.read(run_id)
        if found is None:
            raise CampaignError(f"{self.folder}: found no result of a run {run_id}")
        try:
            data = (self.folder / "missions" / f"{found.row['mission_sha']}.yaml").read_bytes()
            return _run(found.run, data)
        except (OSError, KeyError, TypeError, ValueError) as error:
            raise CampaignError(f"{self.folder}: run {run_id}: what was flown cannot be read: {error}") from error

    def whole_id(self, beginning: str) -> str:
        """The one run that is done whose id begins so.

        Raises
        ------
        CampaignError : there is none, or several.
        """
        found = sorted(run_id for run_id in self.done() if run_id.startswith(beginning))
        if len(found) != 1 or not beginning:
            many = f"{len(found)} runs that are done begin" if found else "no run that is done begins"
            raise CampaignError(f"{self.folder}: {many} with {beginning!r}, expected the id of one")
        return found[0]

    def clear_partial(self) -> None:
        """Remove what this process, and processes of this machine that are no more, left unfinished."""
        for path in self.runs.glob(".*"):
            match = _PARTIAL.fullmatch(path.name)
            if match is None or match["host"] != platform.node():
                continue
            pid = int(match["pid"])
            if pid == os.getpid() or not _lives(pid):
                shutil.rmtree(path, ignore_errors=True)

    @contextmanager
    def writing(self) -> Iterator[None]:
        """Turn what a disk says into one line.

        Raises
        ------
        CampaignError : it cannot be written.
        """
        try:
            yield
        except OSError as error:
            safe = f"{len(self.done())} of {len(self.run_ids)} runs are safe in it"
            why = os.strerror(error.errno) if error.errno else str(error)
            raise CampaignError(f"{self.folder}: cannot be written: {why}; {safe}") from error

    def _partial(self, what: str) -> Path:
        return self.runs / f".{platform.node()}.{os.getpid()}.{what}"

    def _keep_mission(self, run: Run) -> None:
        path = self.folder / "missions" / f"{run.mission_sha}.yaml"
        if not path.exists():
            _replace(path, run.data)


def open_store(folder: Path, sweep: Sweep, resume: bool) -> Store:
    """The folder of a sweep's campaign, made if it is not there.

    Parameters
    ----------
    resume : go on with what is there; else nothing may be done yet.

    Raises
    ------
    CampaignError : it holds something else, or this campaign while not to be resumed, or cannot be written.
    """
    try:
        there = sorted(os.listdir(folder)) if folder.exists() else []
    except OSError as error:
        raise CampaignError(f"{folder}: cannot be read: {error.strerror or error}") from error
    if CAMPAIGN not in there:
        if set(there) - {"sweep.yaml"}:
            raise CampaignError(f"{folder}: found {there[0]} and no campaign, expected a new or an empty folder")
        return _new(folder, sweep)
    store = Store(folder)
    if store.told["digest"] != sweep.digest:
        by = "" if store.told["version"] == version() else f", flown by version {store.told['version']}"
        raise CampaignError(f"{folder}: holds another campaign, {store.name!r}{by}: choose another --out")
    if store.done() and not resume:
        done = f"{len(store.done())} of {len(store.run_ids)} runs are done"
        raise CampaignError(f"{folder}: holds this campaign, {done}: --resume goes on with it, --out makes another")
    store.clear_partial()
    return store


def _new(folder: Path, sweep: Sweep) -> Store:
    told = {
        "name": sweep.name,
        "sweep": sweep.file,
        "digest": sweep.digest,
        "version": version(),
        "revision": revision(Path(__file__).resolve().parents[1]),
        "versions": versions(),
        "combinations": sweep.combinations,
        "run_ids": [run.run_id for run in sweep.runs],
    }
    try:
        (folder / "runs").mkdir(parents=True, exist_ok=True)
        _replace(folder / "sweep.yaml", sweep.data)
        _replace(folder / CAMPAIGN, json.dumps(told, indent=1).encode())
    except OSError as error:
        raise CampaignError(f"{folder}: cannot be written: {error.strerror or error}") from error
    return Store(folder)


def _campaign(folder: Path) -> dict[str, Any]:
    path = folder / CAMPAIGN
    try:
        told = json.loads(path.read_bytes())
    except OSError as error:
        raise CampaignError(f"{path}: cannot be read: {error.strerror or error}: no campaign") from error
    except ValueError as error:
        raise CampaignError(f"{path}: found no JSON ({error})") from error
    for key, kind in (("name", str), ("digest", str), ("version", str), ("run_ids", list)):
        if not isinstance(told, dict) or not isinstance(told.get(key), kind):
            raise CampaignError(f"{path}: {key}: found nothing, expected what a campaign writes")
    found: dict[str, Any] = told
    return found


def _unread(path: Path, error: OSError) -> CampaignError:
    why = os.strerror(error.errno) if error.errno else str(error)
    return CampaignError(f"{path}: cannot be read: {why}; it stays as it is")


def _stored(run_id: str, told: Any) -> Stored:
    """A result's JSON.

    Raises
    ------
    ValueError, KeyError, TypeError : it is not what is written for that run.
    """
    row, cost = {**told["row"]}, {**told["cost"]}
    if not cost.keys() >= COST_COLUMNS.keys():
        raise ValueError(f"{run_id}: found no whole cost")
    if not whole({**row, "recording": ""}) or row["run_id"] != run_id:
        raise ValueError(f"{run_id}: found another run's row, or one that is not whole")
    return Stored(told["run"], row, cost, str(told.get("versions", "")))


def _told(run: Run) -> dict[str, Any]:
    """A run as JSON; its mission is kept apart."""
    told = asdict(run)
    del told["data"]
    return told


def _run(told: dict[str, Any], data: bytes) -> Run:
    """Back from JSON, where a tuple is a list."""
    link = told["link"]
    if link is not None:
        link = LinkFaults(**{**link, "blackouts": tuple((start, end) for start, end in link["blackouts"])})
    plain = {name: tuple(value) if isinstance(value, list) else value for name, value in told.items()}
    return Run(
        **{
            **plain,
            "data": data,
            "link": link,
            "squalls": tuple(Squall(**{**s, "velocity": tuple(s["velocity"])}) for s in told["squalls"]),
            **{key: tuple((name, value) for name, value in told[key]) for key in ("parameters", "maps")},
        }
    )


def _replace(path: Path, data: bytes) -> None:
    """Write a file, whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        _write(partial, data)
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)


def _write(path: Path, data: bytes) -> None:
    """To the disk, so that a name given afterwards is never that of an empty file."""
    with path.open("wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def _rename(partial: Path, final: Path) -> None:
    """Give a folder its final name.

    Raises
    ------
    FileExistsError : somebody else was first.
    """
    try:
        os.rename(partial, final)
    except OSError:
        if final.is_dir():
            raise FileExistsError(str(final)) from None
        raise


def _lives(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True
