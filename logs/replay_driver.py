"""Send a paced replay over UDP, in real time."""

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from logs.wire_replay import Due
from wire.datagram import Datagram
from wire.udp import LinkCounters, UdpLink, wait


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a replay is: replay time [s], datagrams due so far, and what the socket counted."""

    elapsed_s: float
    datagrams: int
    counters: LinkCounters


def replay(
    traffic: Iterable[Due],
    link: UdpLink,
    progress: Callable[[Progress], None] = lambda _: None,
    *,
    progress_s: float = 0.5,
    stop: Callable[[], bool] = lambda: False,
) -> Progress:
    """Send every datagram at its time to every peer of the link. What peers answer is read and thrown away.

    A ``udpin`` link has no peer until one writes: the replay waits for the first.

    Parameters
    ----------
    traffic : as `wire_replay.paced` gives it.
    progress : called about every `progress_s`, and at the end.
    stop : asked before every datagram and while waiting; True ends the replay.
    """
    while not link.peers and not stop():
        wait([link], 0.1)
        link.receive()
    started_s = reported_s = time.monotonic()
    sent = 0
    for due in traffic:
        deadline_s = started_s + due.due_s
        while (left_s := deadline_s - time.monotonic()) > 0.0 and not stop():
            if wait([link], min(left_s, 0.1)):
                link.receive()
        if stop():
            break
        link.send(Datagram(link.name, due.data))
        sent += 1
        now_s = time.monotonic()
        if now_s - reported_s >= progress_s:
            reported_s = now_s
            progress(Progress(now_s - started_s, sent, link.counters))
    end = Progress(time.monotonic() - started_s, sent, link.counters)
    progress(end)
    return end
