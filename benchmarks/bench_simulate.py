"""Where a lockstep flight's time goes: `python -m benchmarks.bench_simulate [flights]`.

The same mission is run three ways, in turn, and the ratios are taken pair by pair: vehicle and companion with nothing
recorded, the same recorded, and a re-run of that recording (the companion alone).
"""

import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.table import Table

from companion.cli.vehicle import LINK, build_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.lockstep import fly_lockstep
from companion.drivers.planning import InlinePlanning
from companion.drivers.recording import RecordingTap, header
from companion.drivers.rerun import rerun
from companion.missionfile import parse_mission, read_mission_file
from logs.reader import Recording
from logs.recorder import Recorder

MISSION = Path(__file__).parent.parent / "missions" / "l_shape.yaml"


def flight(data: bytes, file: Path | None) -> float:
    """Fly once; the simulated time [s]."""
    mission = parse_mission(data, str(MISSION))
    companion = Companion(mission, CompanionConfig(seed=1))
    vehicle, planning = build_vehicle(mission, 1), InlinePlanning(mission.planner_world())
    if file is None:
        return fly_lockstep(companion, vehicle, LINK, planning, [], limit_s=120.0) / 1e6
    with Recorder(file, threaded=False, **header(companion, data)) as recorder:
        return (
            fly_lockstep(companion, vehicle, LINK, planning, [RecordingTap(companion, recorder)], limit_s=120.0) / 1e6
        )


def again(file: Path) -> float:
    """Re-run a recording; the simulated time [s]."""
    return rerun(Recording.open(file)).simulated_s


def cpu_ms_per_second(work: Callable[[], float]) -> float:
    """CPU time [ms] for one simulated second."""
    start = time.process_time()
    simulated_s = work()
    return 1e3 * (time.process_time() - start) / simulated_s


def main() -> None:
    flights = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    data = read_mission_file(MISSION)
    flight(data, None)  # kernels
    rows: dict[str, list[float]] = {
        "flight, nothing recorded": [],
        "flight, recorded": [],
        "re-run of the recording": [],
    }
    with tempfile.TemporaryDirectory() as scratch:
        for k in range(flights):
            file = Path(scratch) / f"{k}.mcap"
            works = (partial(flight, data, None), partial(flight, data, file), partial(again, file))
            for row, work in zip(rows.values(), works, strict=True):
                row.append(cpu_ms_per_second(work))
    base = next(iter(rows.values()))
    table = Table(
        "lockstep, L-shaped wall", "CPU ms per simulated s", "x real time", "ratio", title=f"{flights} flights"
    )
    for name, values in rows.items():
        ms = statistics.median(values)
        ratio = statistics.median([a / b for a, b in zip(values, base, strict=True)])
        table.add_row(name, f"{ms:.1f}", f"{1e3 / ms:.0f}", f"{ratio:.2f}")
    Console().print(table)


if __name__ == "__main__":
    main()
