"""`companion replay`: recorded traffic once more; the vehicle's to a ground station, and its answers."""

import gc
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from itertools import islice
from pathlib import Path
from typing import Any

from rich.console import Console

from companion.cli import show
from companion.cli.keys import HELP, keyboard
from companion.cli.operator import Operator
from companion.drivers.recording import MISSION_ATTACHMENT
from companion.drivers.worldfiles import recorded_mission
from companion.errors import CompanionError
from companion.geodesy import Geodetic, to_geodetic
from companion.planfiles import is_plan_file, read
from companion.planfiles.items import Item, ItemFlaw
from companion.planfiles.writing import from_steps
from logs.answering import Answering
from logs.errors import RecordingError
from logs.reader import Recording
from logs.replay_driver import Progress, replay
from logs.selection import Selection
from logs.wire_replay import Due, paced, repeated, sent_traffic, vehicle_links, vehicle_traffic
from wire.dialect import mavlink
from wire.endpoint import Endpoint
from wire.udp import UdpLink

TELL_S, LIVE_S = 0.1, 0.005
"""How often a person is told how far it is, and the live page (a tenth as often, while it is busy)."""
MOST_KEPT = 300_000
"""Datagrams read before the replay begins, about 60 MB; of more each is read a little before its time."""


def replay_log(
    path: Path,
    to: str,
    rate: float,
    as_json: bool,
    *,
    wanted: Selection | None = None,
    link_name: str | None = None,
    rounds: int | None = 1,
    answer: bool = True,
    to_a_vehicle: bool = False,
    live: int | None = None,
) -> int:
    """Replay `path` to `to`. Returns the exit code.

    Parameters
    ----------
    wanted : which datagrams; None: all.
    link_name : of the links on which an autopilot was heard; None: the first.
    rounds : how many times; None: until it is ended.
    answer : whether a ground station's questions are answered from the recording.
    to_a_vehicle : send what was sent to the vehicle, and nothing else.
    live : port of a live page that shows it, 0 for one that is free; None: there is none.
    """
    out = show.console()
    wanted = wanted or Selection()
    endpoint = Endpoint.parse(to)
    recording = Recording.open(path)
    name = _link(recording, link_name)
    first = next(recording.messages(), None)
    origin_ns = 0 if first is None else first.log_time_ns
    traffic = sent_traffic if to_a_vehicle else vehicle_traffic

    def again() -> Iterator[Due]:
        return paced(traffic(recording, name, wanted), rate, origin_ns)

    kept = list(islice(again(), MOST_KEPT + 1))
    total = len(kept) if len(kept) <= MOST_KEPT else sum(1 for _ in again())
    if not total:
        raise RecordingError(path, f"nothing of link {name} is left to replay by what is asked for")
    source: Callable[[], Iterator[Due]] = kept.__iter__ if total <= MOST_KEPT else again
    answering = Answering(recording.messages(), name, _mission(recording)) if answer and not to_a_vehicle else None
    operator = Operator()
    tell = _teller(out, rate, total)
    with ExitStack() as stack:
        link = stack.enter_context(UdpLink("ground", endpoint))
        stack.enter_context(operator.listening())
        keys = stack.enter_context(keyboard())
        if live is not None:
            tell = _shown(stack, live, recording, tell, out)
        where = f"{endpoint}" if endpoint.kind == "udpout" else f"whoever calls {endpoint}"
        what = "WHAT WAS SENT TO THE VEHICLE" if to_a_vehicle else "the vehicle's traffic"
        text = f"replaying {what}, {total} datagrams, to {where} at rate {rate:g}"
        out.print(show.plain(f"{text}{f' ({HELP})' if keys.there else ''}"), soft_wrap=True)
        gc.collect()
        gc.freeze()  # what is here now stays: no collection on the way walks through it again
        end = replay(
            source() if rounds == 1 else repeated(source, rounds),
            link,
            tell,
            progress_s=TELL_S if live is None else LIVE_S,
            stop=lambda: operator.asked > 0,
            keys=keys,
            answering=answering,
        )
        gc.unfreeze()
        if out.is_terminal:
            out.file.write("\r\x1b[2K")
    expected = None if rounds is None else total * rounds
    ok = end.counters.send_errors == 0 and (end.datagrams == expected or end.ended)
    result = {
        "ok": ok,
        "recording": str(path),
        "to": str(endpoint),
        "link": name,
        "rate": rate,
        "datagrams": end.datagrams,
        "of": expected,
        "ended_early": end.ended,
        "answers": end.answers,
        "duration_s": end.elapsed_s,
        "spacing_error_p99_ms": end.spacing_error_p99_s * 1e3,
        "send_errors": end.counters.send_errors,
        "refused": end.counters.refused,
    }
    if as_json:
        show.print_json(result)
    else:
        nobody = f"; {end.counters.refused} refused: nobody listens there" if end.counters.refused else ""
        answers = f", {end.answers} answers" if end.answers else ""
        of = "" if expected is None else f" of {expected}"
        spacing = f", spacing right to {end.spacing_error_p99_s * 1e3:.2f} ms (p99)"
        out.print(f"{end.datagrams}{of} datagrams in {end.elapsed_s:.1f} s{spacing}{answers}{nobody}")
    return 0 if ok else 1


def _shown(
    stack: ExitStack, port: int, recording: Recording, tell: Callable[[Progress], None], out: Console
) -> Callable[[Progress], None]:
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


def _link(recording: Recording, name: str | None) -> str:
    """The link to replay: one with an autopilot, so that nobody's commands are taken for telemetry."""
    links = vehicle_links(recording)
    if name is None:
        return links[0]
    if name not in links:
        reason = (
            f"no autopilot was heard on link {name!r} (it was on: {', '.join(links)}); only such a link is replayed"
        )
        raise RecordingError(recording.path, reason)
    return name


def _teller(out: Console, rate: float, total: int) -> Callable[[Progress], None]:
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


def _mission(recording: Recording) -> list[Any]:
    """The attached mission as a ground station reads it; empty where it has none, or no place on the earth."""
    attached = recording.attachments.get(MISSION_ATTACHMENT)
    if attached is None:
        return []
    try:
        items = _items(attached.data, recording)
    except (CompanionError, ItemFlaw):  # written by another version, or beyond what items say
        return []
    return [_item(number, item) for number, item in enumerate(items)]


def _items(data: bytes, recording: Recording) -> list[Item]:
    if is_plan_file(data, MISSION_ATTACHMENT):
        return list(read(data, MISSION_ATTACHMENT).items)
    mission = recorded_mission(recording, data, MISSION_ATTACHMENT)
    north, east, _ = mission.start_m()
    origin = mission.geodetic_origin()
    if origin is None:  # the mission's frame is the vehicle's, moved so that it stands where the mission says
        home = _home(recording)
        if home is None:
            return []
        origin = Geodetic(*to_geodetic(home, -north, -east), home.altitude)
    return from_steps(mission.steps, origin, (north, east))[0]


def _home(recording: Recording) -> Geodetic | None:
    """Where the vehicle said that its home is."""
    for message in recording.messages():
        if message.channel.schema == "mavlink.HOME_POSITION":
            home = recording.decode(message)
            return Geodetic(home.latitude / 1e7, home.longitude / 1e7, home.altitude / 1e3)
    return None


def _item(number: int, item: Item) -> Any:
    p1, p2, p3, p4, latitude, longitude, altitude = item.params
    x, y = (round(degrees * 1e7) if degrees == degrees else 0 for degrees in (latitude, longitude))
    frame, follows = item.frame, int(item.follows)
    return mavlink.MAVLink_mission_item_int_message(
        0, 0, number, frame, item.command, int(number == 0), follows, p1, p2, p3, p4, x, y, altitude
    )
