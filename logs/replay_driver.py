"""Send a paced replay over UDP, in real time.

Every datagram has an absolute deadline; the last `SPIN_S` before it are spent looking at the clock, since a sleeping
process wakes late. Datagrams are read ahead of their time, while there is nothing else to do.
"""

import time
from array import array
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Literal

from logs.answering import Answering
from logs.wire_replay import Due, Pace
from wire.datagram import Datagram
from wire.udp import LinkCounters, UdpLink, wait

SPIN_S = 0.0003
"""Before a deadline the clock is watched for so long [s] instead of sleeping."""
AHEAD = 256
"""Datagrams read ahead at most."""
LEISURE_S = 0.005
"""There is time to read ahead when the next deadline is further away than this [s]."""
TELLING_S = 0.001
"""Progress is told when nothing is due within this [s], unless it would be long ago."""
MAX_SPACINGS = 1_000_000
"""So many spacings are measured at most."""

Key = Literal["pause", "step", "quit"]


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a replay is.

    Attributes
    ----------
    elapsed_s : real time since it began [s]. at_s : place in the recording [s].
    datagrams : sent so far. answers : what was answered beside them.
    counters : what the socket counted.
    paused : it stands still. ended : by whom it was asked to end, False if the traffic did.
    spacing_error_p99_s : of the differences between the times of two successive datagrams, as they were sent and as
        they should have been, 99 of 100 are smaller [s]; only at the end, and without those a person paused. None
        where there were no two.
    """

    elapsed_s: float
    datagrams: int
    counters: LinkCounters
    at_s: float = 0.0
    answers: int = 0
    paused: bool = False
    ended: bool = False
    spacing_error_p99_s: float | None = None


def replay(
    traffic: Iterable[Due],
    link: UdpLink,
    progress: Callable[[Progress], None] = lambda _: None,
    *,
    progress_s: float = 0.5,
    stop: Callable[[], bool] = lambda: False,
    keys: Callable[[], Iterable[Key]] = lambda: (),
    answering: Answering | None = None,
) -> Progress:
    """Send every datagram at its time to every peer of the link.

    A ``udpin`` link has no peer until one writes: the replay waits for the first.

    Parameters
    ----------
    traffic : as `wire_replay.paced` gives it.
    progress : called about every `progress_s`, and at the end.
    stop : asked before every datagram and while waiting; True ends the replay.
    keys : what a person has pressed since it was asked last.
    answering : answers what peers ask; without it, that is read and thrown away.
    """
    running = _Replay(link, progress, progress_s, stop, keys, answering)
    return running.run(traffic)


class _Replay:
    def __init__(
        self,
        link: UdpLink,
        progress: Callable[[Progress], None],
        progress_s: float,
        stop: Callable[[], bool],
        keys: Callable[[], Iterable[Key]],
        answering: Answering | None,
    ) -> None:
        self._link, self._tell, self._tell_every_s, self._stop = link, progress, progress_s, stop
        self._keys, self._answering = keys, answering
        self._sent = self._answers = 0
        self._at_s = 0.0
        self._ended = False
        self._started_s = self._told_s = time.monotonic()
        self._pace = Pace(self._started_s)
        self._running = False
        self._spacings = array("d")
        self._last: tuple[float, float] | None = None  # sent and due, of the datagram before; None after a pause

    def run(self, traffic: Iterable[Due]) -> Progress:
        while not self._link.peers and not self._over():
            wait([self._link], 0.1)
            self._listen()
        self._started_s = self._told_s = time.monotonic()
        self._pace, self._running = Pace(self._started_s), True
        ahead: deque[Due] = deque()
        source = iter(traffic)
        more = True
        while not self._over():
            if not ahead:
                following = next(source, None) if more else None
                if following is None:
                    break
                ahead.append(following)
            left_s = self._left_s(ahead[0])
            if left_s <= 0.0:
                self._send(ahead.popleft())
            elif left_s > LEISURE_S and more and len(ahead) < AHEAD:
                following = next(source, None)
                more = following is not None
                if following is not None:
                    ahead.append(following)
            elif left_s > SPIN_S:
                self._idle(left_s - SPIN_S)
            else:
                deadline_s = time.monotonic() + left_s
                while time.monotonic() < deadline_s:
                    pass
            if left_s > TELLING_S or time.monotonic() - self._told_s > 4 * self._tell_every_s:
                self._progress()
        self._finish_answers()
        end = self._now(self._p99_s())
        self._tell(end)
        return end

    def _over(self) -> bool:
        for key in self._keys():
            now_s = time.monotonic()
            if key == "quit":
                self._ended = True
            elif self._running:  # before it runs there is nothing to hold
                if key == "pause":
                    self._pace.toggle(now_s)
                else:
                    self._pace.step(now_s)
                self._last = None
                self._told_s = 0.0  # tell at once
        self._ended = self._ended or self._stop()
        return self._ended

    def _left_s(self, due: Due) -> float:
        deadline_s = self._pace.deadline(due)
        return 3600.0 if deadline_s is None else deadline_s - time.monotonic()

    def _send(self, due: Due) -> None:
        now_s = time.monotonic()
        self._link.send(Datagram(self._link.name, due.data))
        self._sent += 1
        self._at_s = due.at_s
        self._pace.sent(due)
        if self._pace.paused:
            self._last = None
            self._told_s = 0.0
            return
        if self._last is not None and len(self._spacings) < MAX_SPACINGS:
            self._spacings.append(abs(now_s - self._last[0] - (due.due_s - self._last[1])))
        self._last = now_s, due.due_s

    def _idle(self, left_s: float) -> None:
        """Wait for a question, at most so long."""
        pending = self._answering is not None and self._answering.pending
        if wait([self._link], min(left_s, 0.002 if pending else 0.05)) or pending:
            self._listen()

    def _listen(self) -> None:
        received = self._link.receive()
        if self._answering is None:
            return
        now_us = time.monotonic_ns() // 1000
        for item in received:
            self._answering.receive(item.data, item.peer, now_us)
        for data, peer in self._answering.take(now_us):
            self._link.send(Datagram(self._link.name, data, peer))
            self._answers += 1

    def _finish_answers(self) -> None:
        """What was asked before the end is answered to its end, within a second."""
        until_s = time.monotonic() + 1.0
        while self._answering is not None and self._answering.pending and time.monotonic() < until_s:
            time.sleep(0.002)
            self._listen()

    def _progress(self) -> None:
        now_s = time.monotonic()
        if now_s - self._told_s >= self._tell_every_s:
            self._told_s = now_s
            self._tell(self._now())

    def _now(self, p99_s: float | None = None) -> Progress:
        return Progress(
            time.monotonic() - self._started_s,
            self._sent,
            self._link.counters,
            self._at_s,
            self._answers,
            self._pace.paused,
            self._ended,
            p99_s,
        )

    def _p99_s(self) -> float | None:
        ordered = sorted(self._spacings)
        return ordered[len(ordered) * 99 // 100] if ordered else None
