"""`companion replay`: recorded traffic once more; the vehicle's to a ground station, and its answers."""

import gc
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path

from rich.console import Console

from companion.cli import show
from companion.cli.keys import HELP, keyboard
from companion.cli.operator import Operator
from companion.drivers.missionitems import mission_items
from logs.answering import Answering
from logs.errors import RecordingError
from logs.parameters import ATTACHMENT as PARAMETERS
from logs.reader import Recording
from logs.replay_driver import Progress, replay
from logs.selection import Selection, nothing_left
from logs.wire_replay import Due, paced, repeated, sent_traffic, vehicle_link, vehicle_links, vehicle_traffic
from wire.endpoint import Endpoint
from wire.udp import UdpLink

TELL_S, LIVE_S = 0.1, 0.005
"""How often a person is told how far it is, and the live page (a tenth as often, while it is busy)."""
MOST_KEPT = 300_000
"""Datagrams read before the replay begins, about 60 MB; of more each is read a little before its time."""

Teller = Callable[[Progress], None]


@dataclass(frozen=True, slots=True)
class Asked:
    """What of a recording is replayed, and how.

    Attributes
    ----------
    rate : 1 is real time.
    wanted : which datagrams.
    link_name : of the links on which an autopilot was heard; None: the first.
    rounds : how many times; None: until it is ended.
    answer : whether a ground station's questions are answered from the recording.
    to_a_vehicle : send what was sent to the vehicle, and nothing else.
    live : port of a live page that shows it, 0 for one that is free; None: there is none.
    """

    rate: float = 1.0
    wanted: Selection = field(default_factory=Selection)
    link_name: str | None = None
    rounds: int | None = 1
    answer: bool = True
    to_a_vehicle: bool = False
    live: int | None = None


def replay_log(path: Path, to: str, asked: Asked, as_json: bool) -> int:
    """Replay `path` to `to`. Returns the exit code."""
    out = show.console()
    endpoint = Endpoint.parse(to)
    recording = Recording.open(path)
    with show.working(out, "reading"):
        traffic = _Traffic(recording, asked)
        answers = asked.answer and not asked.to_a_vehicle
        answering = answers_from(recording, traffic.link) if answers else None
    if recording.problem:
        out.print(show.plain(f"{path}: not complete: {recording.problem}"), soft_wrap=True)
    end = _send(recording, traffic, endpoint, asked, answering, out)
    expected = None if asked.rounds is None else traffic.total * asked.rounds
    ok = end.counters.send_errors == 0 and (end.datagrams == expected or end.ended)
    if not as_json:
        _print(end, expected, out)
        return 0 if ok else 1
    p99_s = end.spacing_error_p99_s
    show.print_json(
        {
            "ok": ok,
            "recording": str(path),
            "problem": recording.problem,
            "to": str(endpoint),
            "link": traffic.link,
            "rate": asked.rate,
            "datagrams": end.datagrams,
            "of": expected,
            "ended_early": end.ended,
            "answers": end.answers,
            "duration_s": end.elapsed_s,
            "spacing_error_p99_ms": None if p99_s is None else p99_s * 1e3,
            "send_errors": end.counters.send_errors,
            "refused": end.counters.refused,
        }
    )
    return 0 if ok else 1


def answers_from(recording: Recording, link: str) -> Answering:
    """What a ground station is answered from."""
    attached = recording.attachments.get(PARAMETERS)
    file = attached.data if attached is not None else b""
    return Answering(recording.messages(), link, mission_items(recording), file)


class _Traffic:
    """The datagrams to send, read beforehand where they are not too many.

    Attributes
    ----------
    link : they were recorded on. total : of one round.
    """

    def __init__(self, recording: Recording, asked: Asked) -> None:
        self.link = _link(recording, asked.link_name)
        self._recording, self._asked = recording, asked
        first = next(recording.messages(), None)
        self._origin_ns = 0 if first is None else first.log_time_ns
        kept = list(islice(self._read(), MOST_KEPT + 1))
        self._kept = kept if len(kept) <= MOST_KEPT else None
        self.total = len(kept) if self._kept is not None else sum(1 for _ in self._read())
        if not self.total:
            raise nothing_left(recording, asked.wanted, f"datagram of link {self.link}")

    def rounds(self) -> Iterable[Due]:
        """All of it, as often as was asked for."""
        return self._once() if self._asked.rounds == 1 else repeated(self._once, self._asked.rounds)

    def _once(self) -> Iterable[Due]:
        return self._read() if self._kept is None else self._kept

    def _read(self) -> Iterator[Due]:
        of = sent_traffic if self._asked.to_a_vehicle else vehicle_traffic
        return paced(of(self._recording, self.link, self._asked.wanted), self._asked.rate, self._origin_ns)


def _link(recording: Recording, name: str | None) -> str:
    """The link to replay: one with an autopilot, so that nobody's commands are taken for telemetry."""
    if name is None:
        return vehicle_link(recording)
    links = vehicle_links(recording)
    if name not in links:
        reason = (
            f"no autopilot was heard on link {name!r} (it was on: {', '.join(links)}); only such a link is replayed"
        )
        raise RecordingError(recording.path, reason)
    return name


def _send(
    recording: Recording,
    traffic: _Traffic,
    endpoint: Endpoint,
    asked: Asked,
    answering: Answering | None,
    out: Console,
) -> Progress:
    """Open the link and what shows it, and replay."""
    operator = Operator()
    tell = _teller(out, asked.rate, traffic.total)
    with ExitStack() as stack:
        link = stack.enter_context(UdpLink("ground", endpoint))
        stack.enter_context(operator.listening())
        keys = stack.enter_context(keyboard())
        if asked.live is not None:
            tell = _shown(stack, asked.live, recording, tell, out)
        where = f"{endpoint}" if endpoint.kind == "udpout" else f"whoever calls {endpoint}"
        what = "WHAT WAS SENT TO THE VEHICLE" if asked.to_a_vehicle else "the vehicle's traffic"
        text = f"replaying {what}, {traffic.total} datagrams, to {where} at rate {asked.rate:g}"
        out.print(show.plain(f"{text}{f' ({HELP})' if keys.there else ''}"), soft_wrap=True)
        stack.enter_context(_without_collections())
        end = replay(
            traffic.rounds(),
            link,
            tell,
            progress_s=TELL_S if asked.live is None else LIVE_S,
            stop=lambda: operator.asked > 0,
            keys=keys,
            answering=answering,
        )
    if out.is_terminal:
        out.file.write("\r\x1b[2K")
    return end


@contextmanager
def _without_collections() -> Iterator[None]:
    """What is here now stays: no garbage collection on the way walks through it again."""
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()


def _shown(stack: ExitStack, port: int, recording: Recording, tell: Teller, out: Console) -> Teller:
    """Serve the live page until the stack is left; what is told then is told to it too."""
    from companion.service.livereplay import replayed_live

    shown, address = stack.enter_context(replayed_live(recording, port))
    out.print(f"live page: {address}", highlight=False, soft_wrap=True)

    last_s = -TELL_S

    def told(progress: Progress) -> None:
        nonlocal last_s
        shown.at_s = progress.at_s
        if progress.elapsed_s - last_s >= TELL_S or progress.paused:
            last_s = progress.elapsed_s
            tell(progress)

    return told


def _teller(out: Console, rate: float, total: int) -> Teller:
    """Keeps one line up to date on a terminal; nothing elsewhere. No thread draws it, which would cost us our time."""

    def tell(progress: Progress) -> None:
        if not out.is_terminal:
            return
        state = "paused" if progress.paused else f"rate {rate:g}"
        asked = f"  {progress.answers} answers" if progress.answers else ""
        text = f"{progress.at_s:8.2f} s  {state}  {progress.datagrams} of {total} datagrams{asked}"
        out.file.write(f"\r\x1b[2K{text[: out.width - 1]}")
        out.file.flush()

    return tell


def _print(end: Progress, expected: int | None, out: Console) -> None:
    """What came of it, in a line."""
    of = "" if expected is None else f" of {expected}"
    p99_s = end.spacing_error_p99_s
    spacing = "" if p99_s is None else f", spacing right to {p99_s * 1e3:.2f} ms (p99)"
    answers = f", {end.answers} answers" if end.answers else ""
    nobody = f"; {end.counters.refused} refused: nobody listens there" if end.counters.refused else ""
    text = f"{end.datagrams}{of} datagrams in {end.elapsed_s:.1f} s{spacing}{answers}{nobody}"
    out.print(text, soft_wrap=True)
