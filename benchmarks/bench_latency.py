"""Setpoints over UDP by the clock: `python -m benchmarks.bench_latency [flights] [mission ...] [--any-core] [--first]`.

The companion with its writer thread, its planning workers and the bundled vehicle share one core (`--any-core`: as many
as there are), in real time, on both flavours. `--first`: they are served before other people's processes, on a machine
that is not ours alone (Linux, as root). docs/benchmarks.md says what is measured.
"""

import gc
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from companion.cli.vehicle import running_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.planning import WorkerPlanning
from companion.drivers.realtime import fly_realtime
from companion.drivers.recording import RecordingTap, header
from companion.drivers.tick import Tap, Tick
from companion.missionfile import parse_mission
from companion.seam import Reference, ReplanReady, ReplanWanted
from companion.vehiclelink import VEHICLE_LINK
from companion.verdict import FlightMeter, Verdict, judge
from fakevehicle.config import Autopilot
from logs.recorder import Recorder
from wire.datagram import Datagram
from wire.endpoint import Endpoint
from wire.udp import UdpLink

MISSIONS = ("missions/l_shape_unknown.yaml", "missions/movers.yaml")
STATES = {(32).to_bytes(3, "little"): "LOCAL_POSITION_NED", (30).to_bytes(3, "little"): "ATTITUDE"}

HEAD = (
    "| flight | setpoints | replans | gap p50 | p99 | max | position p50 | p99 | max | attitude p50 | p99 | max "
    "| age p50 | p99 | max | answer | late ticks | as expected |"
)


@dataclass
class Timing:
    """A tap: when setpoints left, and how old the state was that they were computed with.

    Attributes
    ----------
    sent_us : of each setpoint.
    latency_ms : by message, from its arrival in the kernel to the setpoint of the tick that took it, and nothing newer.
    age_ms : of the newest LOCAL_POSITION_NED at each setpoint, be it in its first or not.
    answers_ms : from a question of the replanning's to its answer, both as the core sees them.
    """

    sent_us: list[int] = field(default_factory=list)
    latency_ms: dict[str, list[float]] = field(default_factory=lambda: {name: [] for name in STATES.values()})
    age_ms: list[float] = field(default_factory=list)
    answers_ms: list[float] = field(default_factory=list)
    _asked: dict[int, int] = field(default_factory=dict)
    _newest_us: int | None = None

    def __call__(self, tick: Tick) -> None:
        new: dict[str, int] = {}
        for at_us, item in tick.inputs:
            if isinstance(item, Datagram) and item.link == VEHICLE_LINK and item.data[:1] == b"\xfd":
                name = STATES.get(item.data[7:10])
                if name is not None:
                    new[name] = at_us
            elif isinstance(item, ReplanReady) and item.request_id in self._asked:
                self.answers_ms.append((tick.now_us - self._asked.pop(item.request_id)) / 1e3)
        self._newest_us = new.get("LOCAL_POSITION_NED", self._newest_us)
        for output in tick.outputs:
            if isinstance(output, ReplanWanted):
                self._asked[output.request_id] = tick.now_us
            elif isinstance(output, Reference):
                self.sent_us.append(tick.sent_us)
                for name, at_us in new.items():
                    self.latency_ms[name].append((tick.sent_us - at_us) / 1e3)
                if self._newest_us is not None:
                    self.age_ms.append((tick.sent_us - self._newest_us) / 1e3)

    @property
    def gaps_ms(self) -> np.ndarray:
        return np.diff(np.array(self.sent_us)) / 1e3


@dataclass(frozen=True, slots=True)
class Flown:
    """One flight."""

    timing: Timing
    verdict: Verdict
    replans: int
    late: int  # answers of the replanning's that came after their moment
    late_ticks: int
    worst_joint: float


@contextmanager
def one_core() -> Iterator[None]:
    """This process and whatever it starts share the last core."""
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(cores)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, cores)


@contextmanager
def before_others(vehicle: int) -> Iterator[None]:
    """Let the kernel serve our session and the vehicle's before other people's; only on Linux, as root."""
    ours = Path("/proc/self/autogroup")
    try:
        for session in (ours, Path(f"/proc/{vehicle}/autogroup")):
            with suppress(OSError):
                session.write_text("-20")
        yield
    finally:
        with suppress(OSError):
            ours.write_text("0")


def fly(
    data: bytes, autopilot: Autopilot, folder: Path, *, seed: int = 1, record: bool = True, first: bool = False
) -> Flown:
    """Fly a mission file over loopback, as `companion demo` does."""
    mission = parse_mission(data, "bench.yaml")
    companion, timing = Companion(mission, CompanionConfig(seed=seed)), Timing()
    meter = FlightMeter(companion)
    with ExitStack() as stack:
        planning = WorkerPlanning(mission.planner_world(), replans=mission.senses())
        stack.callback(planning.close)
        while not planning.warmed():
            time.sleep(0.1)
        mission.planner_world().distance(np.zeros((1, 3)))
        link = stack.enter_context(UdpLink(VEHICLE_LINK, Endpoint.parse("udpin:127.0.0.1:0")))
        host, port = link.local_address
        url, log = f"udpout:{host}:{port}", folder / "vehicle.log"
        vehicle = stack.enter_context(running_vehicle(mission, url, seed, log, autopilot))
        if first:
            stack.enter_context(before_others(vehicle.pid))
        file = folder / f"{time.monotonic_ns()}.mcap"
        recorder = stack.enter_context(Recorder(file, threaded=True, **header(companion, data)))
        taps: list[Tap] = [meter, RecordingTap(companion, recorder), timing]
        gc.collect()
        gc.freeze()
        rate = lambda: companion.clock.rate  # noqa: E731  as `companion fly` has it
        pace = fly_realtime(companion, {VEHICLE_LINK: link}, planning, taps, operator=lambda now_us: None, rate=rate)
        gc.unfreeze()
    asked, late, joint = 0, 0, 0.0
    if mission.senses():
        replanning = companion.replanning
        asked, late, joint = replanning.asked, replanning.late, replanning.worst_joint  # type: ignore[attr-defined]
    return Flown(timing, judge(companion, meter), asked, late, pace.late, joint)


def three(values: list[float] | np.ndarray) -> str:
    """p50, p99 and the greatest."""
    return f"{np.percentile(values, 50):.2f} | {np.percentile(values, 99):.2f} | {np.max(values):.2f}"


def row(name: str, f: Flown) -> str:
    t, v = f.timing, f.verdict
    failed = "; ".join([v.failure] * bool(v.failure) + v.failed_expectations)
    answers = f"{np.median(t.answers_ms):.0f}" if t.answers_ms else "-"
    latencies = " | ".join(three(t.latency_ms[name]) for name in STATES.values())
    columns = [name, str(len(t.sent_us)), f"{f.replans}, {f.late} late", three(t.gaps_ms), latencies, three(t.age_ms)]
    return "| " + " | ".join([*columns, answers, str(f.late_ticks), failed or "yes"]) + " |"


def main() -> None:
    words = [word for word in sys.argv[1:] if not word.startswith("--")]
    flights = int(words[0]) if words else 3
    print(HEAD)
    print("|---" * HEAD.count(" |") + "|")
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        if "--any-core" not in sys.argv:
            stack.enter_context(one_core())
        for path in words[1:] or MISSIONS:
            for autopilot in ("px4", "ardupilot"):
                for k in range(flights):
                    f = fly(
                        Path(path).read_bytes(),
                        autopilot,
                        folder,
                        record="--no-record" not in sys.argv,
                        first="--first" in sys.argv,
                    )
                    load = f"load {os.getloadavg()[0]:.1f}"
                    print(row(f"{Path(path).stem}, {autopilot}, {k}, {load}", f), flush=True)


if __name__ == "__main__":
    main()
