"""`companion fly` and `companion demo`: a mission over UDP, recorded, judged at the end."""

import re
import signal
import subprocess
import time
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import asdict
from datetime import UTC, datetime
from importlib import resources
from pathlib import Path
from types import FrameType

import numpy as np
from rich.console import Console

from companion.cli import show
from companion.core import VEHICLE_LINK, Companion, CompanionConfig
from companion.drivers.planning import WorkerPlanning
from companion.drivers.realtime import fly_realtime
from companion.drivers.recording import RecordingTap, header, total
from companion.drivers.tick import Tap
from companion.errors import CompanionError
from companion.mission import Mission, parse_mission, read_mission_file
from companion.seam import OperatorCommand
from companion.verdict import FlightMeter, judge
from logs.errors import RecordingError
from logs.recorder import Recorder
from wire.endpoint import Endpoint
from wire.udp import UdpLink


class Operator:
    """Ctrl-C: the first one asks to land, the second one stops."""

    def __init__(self) -> None:
        self.asked = 0
        self._told = 0

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Catch SIGINT and SIGTERM as long as this lasts."""

        def hear(number: int, frame: FrameType | None) -> None:
            self.asked += 1

        before = {s: signal.signal(s, hear) for s in (signal.SIGINT, signal.SIGTERM)}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    def __call__(self, now_us: int) -> OperatorCommand | None:
        if self.asked == 0 or self._told:
            return None
        self._told = 1
        return OperatorCommand.LAND

    def stop(self) -> bool:
        return self.asked > 1


def fly_demo(record: Path, outs: list[str], seed: int, as_json: bool) -> int:
    """The embedded default: the bundled vehicle as its own process, on a port the system chooses."""
    from companion.cli.vehicle import start_vehicle, stop_vehicle

    data = (resources.files("missions") / "l_shape.yaml").read_bytes()
    mission = parse_mission(data, "missions/l_shape.yaml")
    file = recording_file(record, mission)
    with UdpLink(VEHICLE_LINK, Endpoint.parse("udpin:127.0.0.1:0")) as free:
        host, port = free.local_address
    vehicle = start_vehicle(mission, f"udpout:{host}:{port}", seed, _vehicle_log(file))
    try:
        endpoints = {VEHICLE_LINK: Endpoint("udpin", host, port)} | ground_endpoints(outs)
        config = CompanionConfig(seed=seed, ground_links=tuple(endpoints)[1:])
        return _fly(mission, data, endpoints, file, config, as_json, watch=vehicle)
    finally:
        stop_vehicle(vehicle)


def fly_mission(
    path: Path,
    master: str,
    outs: list[str],
    record: Path,
    seed: int,
    system_id: int | None,
    wait_s: float,
    as_json: bool,
) -> int:
    """Fly `path` on whatever answers at `master`; returns the exit code."""
    data = read_mission_file(path)
    mission = parse_mission(data, str(path))
    endpoints = {VEHICLE_LINK: Endpoint.parse(master)} | ground_endpoints(outs)
    config = CompanionConfig(
        seed=seed,
        system_id=system_id,
        ground_links=tuple(endpoints)[1:],
        speaks_first=endpoints[VEHICLE_LINK].kind == "udpout",
        wait_vehicle_s=wait_s,
    )
    return _fly(mission, data, endpoints, recording_file(record, mission), config, as_json)


def ground_endpoints(outs: list[str]) -> dict[str, Endpoint]:
    """The ground stations' links by name."""
    return {f"out{k}": Endpoint.parse(url) for k, url in enumerate(outs)}


def recording_file(directory: Path, mission: Mission) -> Path:
    """A file name in `directory` (made if need be) that says what and when, and is not taken."""
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CompanionError(f"{directory}: cannot make the directory: {error.strerror or error}") from error
    slug = re.sub(r"[^a-z0-9]+", "-", mission.name.lower()).strip("-") or "mission"
    return directory / f"{slug}-{datetime.now(UTC):%Y%m%dT%H%M%S_%fZ}.mcap"


def _fly(
    mission: Mission,
    data: bytes,
    endpoints: Mapping[str, Endpoint],
    file: Path,
    config: CompanionConfig,
    as_json: bool,
    watch: "subprocess.Popen[bytes] | None" = None,
) -> int:
    """Prepare, fly, close everything properly, judge; returns the exit code."""
    out = show.console()
    companion, operator = Companion(mission, config), Operator()
    meter = FlightMeter(companion)
    with ExitStack() as stack:
        stack.enter_context(operator.listening())
        with _open(endpoints):
            pass  # a busy port is told before the kernels are compiled
        planning = WorkerPlanning(mission.planner_world())
        stack.callback(planning.close)
        if not _warm(mission, planning, operator, out):
            raise CompanionError("stopped before the flight began")
        links = stack.enter_context(_open(endpoints))  # afresh: what came in meanwhile is old
        urls = {name: str(endpoint) for name, endpoint in endpoints.items()}
        start = header(companion, data, endpoints=urls, clock={"epoch": "unix"})
        recorder = stack.enter_context(Recorder(file, threaded=True, **start))
        progress = stack.enter_context(show.ProgressLine(companion, meter, out))
        taps: list[Tap] = [meter, RecordingTap(companion, recorder), progress]
        stop = lambda: operator.stop() or _ended(watch)  # noqa: E731  two conditions, once
        pace = fly_realtime(companion, links, planning, taps, operator=operator, stop=stop)
        if not companion.over:
            companion.failure = _why_stopped(watch, file) + (f" ({companion.failure})" if companion.failure else "")
        recorder.metadata("sockets", {key: str(value) for key, value in _sockets(links)})
        try:
            recorder.close()
        except RecordingError as error:  # the flight went on without it; the verdict must not
            companion.failure = companion.failure or str(error)
        kernel_drops = sum(link.counters.drops for link in links.values())
    verdict, counters = judge(companion, meter), recorder.counters
    losses = {
        "kernel_drops": kernel_drops,
        "recorder_drops": counters.dropped_raw + counters.dropped_decoded,
        "sequence_gaps": sum(s.lost for s in companion.framer.senders.values()),
        "late_ticks": pace.late,
        "missed_ticks": pace.missed,
    }
    numbers = {"recording": str(file), "messages_recorded": total(counters), **losses}
    if as_json:
        show.print_json({**show.verdict_json(verdict), **numbers})
    else:
        shown = ", ".join(f"{value} {name.replace('_', ' ')}" for name, value in losses.items())
        details = {"messages": str(total(counters)), "losses": shown, "recording": str(file)}
        show.print_verdict(verdict, mission.expect, details, Console())
    return 0 if verdict.ok else 1


@contextmanager
def _open(endpoints: Mapping[str, Endpoint]) -> Iterator[dict[str, UdpLink]]:
    """All links, closed again at the end."""
    with ExitStack() as stack:
        yield {name: stack.enter_context(UdpLink(name, endpoint)) for name, endpoint in endpoints.items()}


def _warm(mission: Mission, planning: WorkerPlanning, operator: Operator, out: Console) -> bool:
    """Wait for the worker's kernels and load what this process needs of them; False when the operator gave up."""
    with show.working(out, "preparing kernels (compiled the first time)"):
        while not planning.warmed():
            if operator.asked:
                return False
            time.sleep(0.05)
        mission.planner_world().distance(np.zeros((1, 3)))
    return not operator.asked


def _sockets(links: Mapping[str, UdpLink]) -> Iterator[tuple[str, int]]:
    """The links' own counters, for the recording."""
    for name, link in links.items():
        for key, value in asdict(link.counters).items():
            yield f"{name}.{key}", value


def _ended(process: "subprocess.Popen[bytes] | None") -> bool:
    return process is not None and process.poll() is not None


def _why_stopped(process: "subprocess.Popen[bytes] | None", file: Path) -> str:
    if process is not None and process.poll() is not None:
        return f"the vehicle process ended with exit code {process.returncode}: see {_vehicle_log(file)}"
    return "stopped by the operator without landing"


def _vehicle_log(file: Path) -> Path:
    """Where the demo keeps what its vehicle printed."""
    return file.with_suffix(".vehicle.log")
