"""The vehicle's own recordings: written by the driver, offered by FTP and the log protocol.

`FlightLog` writes what crosses the vehicle's seam, and the physics' truth, into one MCAP file (docs/recording.md says
what is in it). `Folder` shows a folder of such files to the core, which opens nothing itself.
"""

import json
import time
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from fakevehicle.config import VehicleConfig
from fakevehicle.files import Entry, parts
from fakevehicle.sensorlog import SensorLog
from fakevehicle.vehicle import TICK_US, Vehicle
from fakevehicle.vocabulary import Truth
from logs import schema
from logs.container import Attachment
from logs.errors import RecordingError
from logs.parameters import params_file
from logs.parts import Rotation
from logs.recorder import Recorder
from logs.rows import shortest
from wire.datagram import Datagram

TRUTH_US = 20_000
"""The truth is recorded this often."""
SUFFIX = ".mcap"
AUTOPILOT = 1
"""Component id (MAV_COMP_ID_AUTOPILOT1)."""


class Folder:
    """The files in one folder on disk, read-only; folders in it, links and hidden files are not shown.

    Parameters
    ----------
    path : the folder; it may come into being later.
    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def listing(self, path: str) -> list[Entry] | None:
        """Its files, by name; None below it."""
        if parts(path) != []:
            return None
        found: list[Entry] = []
        try:
            for file in sorted(self._path.iterdir()):
                if self._shown(file):
                    status = file.stat()
                    found.append(Entry(file.name, status.st_size, time_unix_s=max(0, int(status.st_mtime))))
        except OSError:
            return found  # what was there to see
        return found

    def size(self, path: str) -> int | None:
        file = self._find(path)
        try:
            return None if file is None else file.stat().st_size
        except OSError:
            return None

    def read(self, path: str, offset: int, size: int) -> bytes | None:
        file = self._find(path)
        if file is None:
            return None
        try:
            with open(file, "rb") as opened:
                opened.seek(offset)
                return opened.read(size)
        except OSError:
            return None

    def _find(self, path: str) -> Path | None:
        names = parts(path)
        if names is None or len(names) != 1:
            return None
        file = self._path / names[0]
        try:
            return file if self._shown(file) else None
        except (OSError, ValueError):  # a name that no file can have
            return None

    @staticmethod
    def _shown(file: Path) -> bool:
        return not file.name.startswith(".") and file.is_file() and not file.is_symlink()


class FlightLog:
    """Records one vehicle, from its first tick to `close`.

    Parameters
    ----------
    folder : made when it is not there; the file is named after the time (UTC), and never overwrites another.
    config : of the vehicle; kept in the file's metadata.
    parameters : values that differ from the defaults; kept too.
    started_unix_s : names the file [s].
    threaded : a thread writes; False: the caller does, and the same flight gives the same bytes.
    sensors : record what the estimator takes and makes of it too, 25 kB a second.
    rotation : when a part of the recording ends.

    Raises
    ------
    RecordingError : the folder or file cannot be made.
    """

    def __init__(
        self,
        folder: Path,
        config: VehicleConfig,
        parameters: dict[str, float],
        *,
        started_unix_s: float,
        threaded: bool = True,
        sensors: bool = False,
        rotation: Rotation | None = None,
    ) -> None:
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise RecordingError(folder, f"cannot make the folder: {error.strerror or error}") from error
        self._tick = 0
        self._recorder = Recorder(
            _unused(folder, time.strftime("%Y-%m-%d_%H-%M-%S", time.gmtime(started_unix_s))),
            metadata={
                "vehicle": {"config": json.dumps(asdict(config), default=_plain), "parameters": json.dumps(parameters)}
            },
            attachments=[parameters_of(Vehicle(config, parameters))],
            threaded=threaded,
            rotation=rotation,
        )
        self._now_us = 0
        self._sensors = SensorLog(self._keep, TICK_US) if sensors else None

    @property
    def path(self) -> Path:
        """The file."""
        return self._recorder.path

    def tick(self, now_us: int, inputs: Sequence[Datagram], outputs: Sequence[Datagram], truth: Truth | None) -> None:
        """Record one tick: what it took and gave, and the truth after it where it is given."""
        recorder, tick, now_ns = self._recorder, self._tick, now_us * 1000
        for item in inputs:
            recorder.datagram(item.link, "rx", item.data, log_time_ns=now_ns, now_us=now_us, tick=tick, peer=item.peer)
        for item in outputs:
            recorder.datagram(item.link, "tx", item.data, log_time_ns=now_ns, now_us=now_us, tick=tick, peer=item.peer)
        if truth is not None:
            topic = schema.TOPICS[schema.Truth]
            recorder.message(topic, to_record(truth), log_time_ns=now_ns, now_us=now_us, tick=tick)
        self._tick += 1

    def look(self, vehicle: Vehicle, now_us: int) -> None:
        """Record the estimator's seam, if that is wanted, after `tick`."""
        if self._sensors is not None:
            self._now_us = now_us
            stack = vehicle.stack
            self._sensors.tick(stack.now_us, stack.estimator, vehicle.parameters)

    def _keep(self, record: schema.Record) -> None:
        at_us = self._now_us
        topic = schema.TOPICS[type(record)]
        self._recorder.message(topic, record, log_time_ns=at_us * 1000, now_us=at_us, tick=self._tick)

    def close(self) -> None:
        """Write what is waiting; may be called twice.

        Raises
        ------
        RecordingError : the disk failed on the way; what went in until then is readable.
        """
        if self._sensors is not None:
            self._sensors.flush()
        self._recorder.close()


def parameters_of(vehicle: Vehicle) -> Attachment:
    """All parameters of a vehicle, as they stand at the start of a recording."""
    told, system = vehicle.told_parameters, vehicle.config.system_id
    values = {(system, AUTOPILOT, name): (shortest(told[name]), told.describe(name).type.value) for name in told}
    return params_file(values)


def to_record(truth: Truth) -> schema.Truth:
    """The physics' truth as the record that keeps it."""
    return schema.Truth(
        position_n=tuple(truth.position_n.tolist()),
        velocity_n=tuple(truth.velocity_n.tolist()),
        acceleration_n=tuple(truth.acceleration_n.tolist()),
        q_nb=tuple(truth.q_nb.tolist()),
        omega_b=tuple(truth.omega_b.tolist()),
        rotor_speed=tuple(truth.rotor_speed.tolist()),
        wind_n=tuple(truth.wind_n.tolist()),
        on_ground=bool(truth.on_ground),
    )


def _unused(folder: Path, stem: str) -> Path:
    """A file name that is free: the stem, or the stem and a number."""
    path = folder / f"{stem}{SUFFIX}"
    number = 1
    while path.exists():
        number += 1
        path = folder / f"{stem}_{number}{SUFFIX}"
    return path


def _plain(value: object) -> object:
    """For JSON: arrays as lists, anything else as its text."""
    return value.tolist() if isinstance(value, np.ndarray) else str(value)
