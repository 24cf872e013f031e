"""One flight over UDP, recorded and judged at the end: what `companion fly` and `companion demo` have in common."""

import subprocess
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console

from companion.cli import flight_show, show
from companion.cli.operator import STOPPED, Operator
from companion.core import Companion, CompanionConfig
from companion.drivers.flight import fly_guarded
from companion.drivers.planning import WorkerPlanning
from companion.drivers.provenance import conclude
from companion.drivers.recording import RecordingTap, header, socket_losses, total, unix_clock
from companion.drivers.tick import Tap
from companion.errors import CompanionError
from companion.mission import Expect, Mission
from companion.seam import FloatArray, Order
from companion.verdict import FlightMeter, Verdict, judge
from logs.container import Attachment
from logs.errors import RecordingError
from logs.parts import Rotation
from logs.recorder import Recorder
from logs.recovery import recover_unfinished
from wire.endpoint import Endpoint
from wire.udp import UdpLink

if TYPE_CHECKING:
    from companion.service.liveflight import LiveFlight

Progress = Callable[[Companion, FlightMeter, Console], AbstractContextManager[Tap]]


@dataclass(frozen=True, slots=True)
class Flown:
    """A flight that is over.

    Attributes
    ----------
    path : (n, 4) when [us since 1970] and where in the mission frame [m] it was, from the takeoff until it disarmed.
    """

    verdict: Verdict
    expect: Expect
    recording: Path
    messages: int
    losses: dict[str, int]
    path: FloatArray

    def tell(self, as_json: bool, page: Path | None = None) -> int:
        """Print what came of it, and where its `page` is if there is one; returns the exit code."""
        report = {} if page is None else {"report": str(page)}
        if as_json:
            numbers = {"recording": str(self.recording), **report, "messages_recorded": self.messages, **self.losses}
            show.print_json({**flight_show.verdict_json(self.verdict), **numbers})
        else:
            shown = ", ".join(f"{value} {name.replace('_', ' ')}" for name, value in self.losses.items())
            details = {"messages": str(self.messages), "losses": shown, "recording": str(self.recording), **report}
            flight_show.print_verdict(self.verdict, self.expect, details, Console())
        return 0 if self.verdict.ok else 1


def fly_recorded(
    mission: Mission,
    data: bytes,
    endpoints: Mapping[str, Endpoint],
    file: Path,
    config: CompanionConfig,
    operator: Operator,
    *,
    rotation: Rotation | None = None,
    known: Sequence[Attachment] = (),
    live: int | None = None,
    watch: "subprocess.Popen[bytes] | None" = None,
    progress: Progress = flight_show.ProgressLine,
    go: Callable[[], bool] = lambda: True,
) -> Flown:
    """Prepare, fly, close everything properly, judge.

    Parameters
    ----------
    rotation : when a part of the recording ends.
    known : more that the recording holds, such as the vehicle's parameters.
    live : port of the live page, 0 for one that is free; None: there is none.
    watch : a process whose end is the flight's.
    progress : what a person sees of it.
    go : asked once when all is prepared; False: it is not flown.
    """
    out = show.console()
    for recovered in recover_unfinished(file.parent):
        out.print(show.plain(str(recovered)), soft_wrap=True)
    companion = Companion(mission, config)
    meter = FlightMeter(companion)
    with ExitStack() as stack:
        with _open(endpoints):
            pass  # a busy port is told before the kernels are compiled
        planning = WorkerPlanning(mission.planner_world(), replans=mission.senses() or config.fleet_number > 0)
        stack.callback(planning.close)
        if not _warm(mission, planning, operator, out) or not go():
            raise CompanionError("stopped before the flight began")
        links = stack.enter_context(_open(endpoints))  # afresh: what came in meanwhile is old
        urls = {name: str(endpoint) for name, endpoint in endpoints.items()}
        start = header(companion, data, endpoints=urls, clock=unix_clock())
        start["attachments"] += known
        start |= {"rotation": rotation, "losses": socket_losses(links)}
        recorder = stack.enter_context(Recorder(file, threaded=True, **start))
        notice = lambda text: out.print(show.plain(text), soft_wrap=True)  # noqa: E731  once
        taps: list[Tap] = [meter, RecordingTap(companion, recorder, notice)]
        shown: LiveFlight | None = None
        ask: Callable[[int], Order | None] = operator
        if live is not None:
            shown = _live(stack, live, companion, meter, file, out)
            taps, ask = [*taps, shown], shown.operator(operator)
        taps.append(stack.enter_context(progress(companion, meter, out)))
        stop = lambda: operator.stop() or _ended(watch)  # noqa: E731  two conditions, once
        told = lambda text, trace: out.print(f"{text}\n{trace}", markup=False, soft_wrap=True)  # noqa: E731  once
        pace = fly_guarded(companion, links, planning, taps, operator=ask, stop=stop, told=told)
        if not companion.over:
            companion.failure = _why_stopped(watch, file) + (f" ({companion.failure})" if companion.failure else "")
        conclude(recorder, companion, meter)
        recorder.metadata("sockets", {key: str(value) for key, value in _sockets(links)})
        try:
            recorder.close()
        except RecordingError as error:  # the flight went on without it; the verdict must not
            companion.failure = companion.failure or str(error)
        kernel_drops = sum(link.counters.drops for link in links.values())
        verdict = judge(companion, meter)
        if shown is not None:
            shown.end(verdict)
    counters = recorder.counters
    losses = {
        "kernel_drops": kernel_drops,
        "recorder_drops": counters.dropped_raw + counters.dropped_decoded,
        "sequence_gaps": sum(s.lost for s in companion.link.framer.senders.values()),
        "late_ticks": pace.late,
        "missed_ticks": pace.missed,
    }
    return Flown(verdict, mission.expect, file, total(counters), losses, meter.aloft_path())


def _live(
    stack: ExitStack, port: int, companion: Companion, meter: FlightMeter, file: Path, out: Console
) -> "LiveFlight":
    """Serve the live page until the stack is left, and tell where; what feeds it."""
    from companion.service.feed import Feed
    from companion.service.live import served_live
    from companion.service.liveflight import LiveFlight

    feed = Feed()
    shown = LiveFlight(feed, companion, meter, {"recording": str(file)})
    address = stack.enter_context(served_live(port, feed))
    out.print(f"live page: {address}", highlight=False, soft_wrap=True)
    return shown


@contextmanager
def _open(endpoints: Mapping[str, Endpoint]) -> Iterator[dict[str, UdpLink]]:
    """All links, closed again at the end."""
    with ExitStack() as stack:
        yield {name: stack.enter_context(UdpLink(name, endpoint)) for name, endpoint in endpoints.items()}


def _warm(mission: Mission, planning: WorkerPlanning, operator: Operator, out: Console) -> bool:
    """Wait for the worker's kernels and load what this process needs of them; False when the operator gave up."""
    began_s = time.monotonic()
    with show.waiting(out, "preparing kernels (compiled the first time, in about a minute)") as so_far:
        while not planning.warmed():
            if operator.asked:
                return False
            so_far(time.monotonic() - began_s)
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
        return f"the vehicle process ended with exit code {process.returncode}: see {vehicle_log(file)}"
    return STOPPED


def vehicle_log(file: Path) -> Path:
    """Where the demo keeps what its vehicle printed."""
    return file.with_suffix(".vehicle.log")
