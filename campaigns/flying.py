"""A run becomes a row: flown in lockstep by companion and bundled vehicle, measured by the truth.

The same run gives the same row, to the last digit, in any process of any machine of one kind; what it cost is told
apart. Nothing is written but the recording that is asked for.
"""

import math
import platform
import shutil
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from campaigns.executors.base import told
from campaigns.runs import Run, digest_of
from companion.testing.flight import fly
from companion.testing.spec import FlightResult
from logs.errors import LogsError

Row = dict[str, Any]
"""A line of the table: columns by name, None where there is nothing."""

FLOWN, INFRASTRUCTURE = "flown", "infrastructure"
"""Of `status`: it came to an end, well or not; or whoever flew it did."""
FIGURES = (
    *("simulated_s", "duration_s", "path_length_m"),
    *("tracking_rms_m", "tracking_p50_m", "tracking_p95_m", "tracking_max_m"),
    *("estimate_p95_m", "min_clearance_m", "setpoint_rate_hz", "setpoint_gap_max_ms"),
)


@dataclass(frozen=True, slots=True)
class Flown:
    """What came of a run: its row, and what it cost [s], where."""

    row: Row
    cpu_s: float
    wall_s: float
    host: str


def fly_run(run: Run) -> Flown:
    """Fly it.

    Raises
    ------
    OSError, MemoryError : of the machine, on which a file that the run needs may not be, or be another one. Whatever
        else goes wrong is a result.
    """
    return _flown(run, None)


def fly_recorded(run: Run, file: Path) -> Flown:
    """The same flight, recorded.

    Raises
    ------
    OSError, MemoryError, LogsError : of the machine, such as a full disk.
    """
    return _flown(run, file)


def record_run(item: tuple[Run, Path]) -> Flown:
    """The same for an executor; the file is alone in its folder, whatever one who died over it has left there."""
    run, file = item
    shutil.rmtree(file.parent, ignore_errors=True)
    file.parent.mkdir(parents=True)
    return fly_recorded(run, file)


def row_of(run: Run, result: FlightResult) -> Row:
    """The figures of a flight."""
    verdict, figures = result.verdict, dict.fromkeys(FIGURES)
    if verdict is not None:
        figures |= {
            "simulated_s": result.simulated_s,
            "duration_s": verdict.duration_s,
            "path_length_m": verdict.path_length_m,
            "tracking_rms_m": _rms(result),
            "tracking_p50_m": verdict.tracking_error_p50_m,
            "tracking_p95_m": verdict.tracking_error_p95_m,
            "tracking_max_m": verdict.tracking_error_max_m,
            "estimate_p95_m": verdict.estimate_error_p95_m,
            "min_clearance_m": result.min_clearance_m,
            "setpoint_rate_hz": verdict.setpoint_rate_hz,
            "setpoint_gap_max_ms": verdict.setpoint_gap_max_ms,
        }
    return {
        **run.columns(),
        "status": FLOWN,
        "ok": result.ok,
        "phase": result.phase,
        "failure": result.failure,
        "cause": result.cause,
        **{name: _finite(value) for name, value in figures.items()},
        "innovation": result.innovation,
    }


def lost_row(run: Run, why: str) -> Row:
    """Of a run that nobody could fly."""
    empty = {"phase": "", "failure": "", "cause": why, **dict.fromkeys(FIGURES), "innovation": ""}
    return {**run.columns(), "status": INFRASTRUCTURE, "ok": False, **empty}


def _flown(run: Run, record: Path | None) -> Flown:
    for path, digest in run.files().items():
        if digest_of(path) != digest:
            raise OSError(f"{path}: is not the file that the sweep was read with")
    wall, cpu = time.perf_counter(), time.process_time()
    try:
        result = fly(run.spec(record))
    except (OSError, MemoryError, LogsError):
        raise
    except Exception as error:  # a fault of ours: the same flight would meet it again
        result = FlightResult(run.spec(), ok=False, cause=told(error))
    return Flown(
        row=row_of(run, result),
        cpu_s=time.process_time() - cpu,
        wall_s=time.perf_counter() - wall,
        host=platform.node(),
    )


def _rms(result: FlightResult) -> float | None:
    """Root of the mean square of the tracking error [m]; None of a flight so long that not all of it is kept."""
    track = None if result.verdict is None else result.verdict.track
    if track is None or track.counted.error.count or not len(track.error):
        return None
    return float(np.sqrt(np.mean(np.square(track.error))))


def _finite(value: float | None) -> float | None:
    return None if value is None or not math.isfinite(value) else float(value)
