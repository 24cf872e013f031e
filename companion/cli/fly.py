"""`companion fly` and `companion demo`: a mission over UDP, recorded, judged at the end."""

import re
import signal
import subprocess
import time
from collections.abc import Iterator
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
from companion.mission import Mission, parse_mission, read_mission_file
from companion.seam import OperatorCommand
from companion.verdict import FlightMeter, judge
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

    source = resources.files("missions") / "l_shape.yaml"
    data = source.read_bytes()
    mission = parse_mission(data, "missions/l_shape.yaml")
    record.mkdir(parents=True, exist_ok=True)
    file = recording_file(record, mission)
    with UdpLink(VEHICLE_LINK, Endpoint.parse("udpin:127.0.0.1:0")) as link:
        host, port = link.local_address
        vehicle = start_vehicle(mission, f"udpout:{host}:{port}", seed, _vehicle_log(file))
        try:
            config = CompanionConfig(seed=seed, ground_links=ground_links(outs))
            return _fly(mission, data, link, outs, file, config, as_json, watch=vehicle)
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
    endpoint = Endpoint.parse(master)
    config = CompanionConfig(
        seed=seed,
        system_id=system_id,
        ground_links=ground_links(outs),
        speaks_first=endpoint.kind == "udpout",
        wait_vehicle_s=wait_s,
    )
    with UdpLink(VEHICLE_LINK, endpoint) as link:
        record.mkdir(parents=True, exist_ok=True)
        return _fly(mission, data, link, outs, recording_file(record, mission), config, as_json)


def ground_links(outs: list[str]) -> tuple[str, ...]:
    """Names of the ground stations' links."""
    return tuple(f"out{k}" for k in range(len(outs)))


def recording_file(directory: Path, mission: Mission) -> Path:
    """A file name that says what and when, and is not taken."""
    slug = re.sub(r"[^a-z0-9]+", "-", mission.name.lower()).strip("-") or "mission"
    return directory / f"{slug}-{datetime.now(UTC):%Y%m%dT%H%M%S_%fZ}.mcap"


def _fly(
    mission: Mission,
    data: bytes,
    master: UdpLink,
    outs: list[str],
    file: Path,
    config: CompanionConfig,
    as_json: bool,
    watch: "subprocess.Popen[bytes] | None" = None,
) -> int:
    """Open what is needed, fly, close everything properly, judge."""
    out = show.console()
    companion = Companion(mission, config)
    meter = FlightMeter(companion)
    operator = Operator()
    with ExitStack() as stack:
        links = {VEHICLE_LINK: master}
        for name, url in zip(config.ground_links, outs, strict=True):
            links[name] = stack.enter_context(UdpLink(name, Endpoint.parse(url)))
        stack.enter_context(operator.listening())
        planning = WorkerPlanning(mission.planner_world())
        stack.callback(planning.close)
        with show.working(out, "compiling kernels (only the first time)"):
            mission.planner_world().distance(np.zeros((1, 3)))
            while not planning.warmed() and not operator.asked:
                time.sleep(0.05)
        endpoints = {name: str(link.endpoint) for name, link in links.items()}
        recorder = stack.enter_context(
            Recorder(file, threaded=True, **header(companion, data, endpoints=endpoints, clock={"epoch": "unix"}))
        )
        progress = stack.enter_context(show.ProgressLine(companion, meter, out))
        taps: list[Tap] = [meter, RecordingTap(companion, recorder), progress]
        pace = fly_realtime(
            companion, links, planning, taps, operator=operator, stop=lambda: operator.stop() or _ended(watch)
        )
        recorder.metadata("sockets", {k: str(v) for name, link in links.items() for k, v in _socket(name, link)})
    if not companion.over:
        companion.failure = companion.failure or _why_stopped(watch, file)
    verdict = judge(companion, meter)
    counters = recorder.counters
    drops = {
        "kernel_drops": sum(link.counters.drops for link in links.values()),
        "recorder_drops": counters.dropped_raw + counters.dropped_decoded,
        "sequence_gaps": sum(s.lost for s in companion.framer.senders.values()),
        "late_ticks": pace.late,
    }
    result = {
        **show.verdict_json(verdict),
        "recording": str(file),
        "messages_recorded": total(counters),
        **drops,
    }
    if as_json:
        show.print_json(result)
    else:
        shown = ", ".join(f"{value} {name.replace('_', ' ')}" for name, value in drops.items())
        details = {"messages": str(total(counters)), "losses": shown, "recording": str(file)}
        show.print_verdict(verdict, mission.expect, details, Console())
    return 0 if verdict.ok else 1


def _socket(name: str, link: UdpLink) -> list[tuple[str, int]]:
    """A link's own counters, for the recording."""
    return [(f"{name}.{key}", value) for key, value in asdict(link.counters).items()]


def _ended(process: "subprocess.Popen[bytes] | None") -> bool:
    return process is not None and process.poll() is not None


def _why_stopped(process: "subprocess.Popen[bytes] | None", file: Path) -> str:
    if process is not None and process.poll() is not None:
        return f"the vehicle process ended with exit code {process.returncode}: see {_vehicle_log(file)}"
    return "stopped by the operator"


def _vehicle_log(file: Path) -> Path:
    """Where the demo keeps what its vehicle printed."""
    return file.with_suffix(".vehicle.log")
