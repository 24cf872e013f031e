"""A recording on the live page, as far as it has been replayed: a re-run of it at the replay's pace, in a thread.

A fresh companion is given the recorded inputs up to the place the replay has come to, and the page looks on as it does
in flight (`liveflight`). A place that goes back begins anew: the next round of a loop.
"""

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from companion.drivers.realtime import SWITCH_S
from companion.drivers.rerun import fresh_companion, ticked
from companion.errors import CompanionError
from companion.service.feed import Feed
from companion.service.live import served_live
from companion.service.liveflight import LiveFlight
from companion.verdict import FlightMeter, judge
from logs.errors import LogsError
from logs.reader import Recording
from logs.table import ticks

LOOK_S, AFTER_S = 0.02, 0.5
BACK_S = 1.0
"""A place so much before the one before is another round [s]."""


class LiveReplay:
    """Parameters
    ----------
    recording : of a companion.
    feed : where it is shown.

    Attributes
    ----------
    at_s : how far the replay is, since the recording's first message [s]; set by whoever replays.

    Raises
    ------
    RerunError : not a recording of a companion.
    """

    def __init__(self, recording: Recording, feed: Feed) -> None:
        self.at_s = 0.0
        self._recording, self._feed = recording, feed
        first = next(recording.messages(), None)
        self._origin_us = 0 if first is None else first.log_time_ns // 1000
        self._closing, self._ended = threading.Event(), threading.Event()
        self._companion = fresh_companion(recording)
        self._shown = self._begun()
        self._thread = threading.Thread(target=self._run, name="live replay", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Show what the companion did yet after the last datagram, and end; may be called twice."""
        if self._closing.is_set():
            return
        self.at_s += AFTER_S
        self._ended.wait(AFTER_S)
        self._closing.set()
        self._thread.join(2.0)

    def _begun(self) -> LiveFlight:
        self._meter = FlightMeter(self._companion)
        facts = {"replay of": str(self._recording.path)}
        return LiveFlight(self._feed, self._companion, self._meter, facts, orders=False)

    def _run(self) -> None:
        try:
            while not self._closing.is_set():
                done = self._round()
                while done and not self._closing.wait(LOOK_S) and self.at_s > BACK_S:
                    pass
                self._companion = fresh_companion(self._recording)
                if not self._closing.is_set():
                    self._shown = self._begun()
        except (CompanionError, LogsError) as error:  # the replay goes on; the page says how far it can be shown
            self._feed.header(failure=f"not shown further: {error}")

    def _round(self) -> bool:
        """Until the end (True), or until the replay has gone back."""
        seen_s = 0.0
        self._ended.clear()
        for row in ticks(self._recording):
            due_s = (row.now_us - self._origin_us) / 1e6
            while self.at_s < due_s:
                if self.at_s < seen_s - BACK_S or self._closing.wait(LOOK_S):
                    return False
                seen_s = max(seen_s, self.at_s)
            tick = ticked(self._companion, row)
            self._meter(tick)
            self._shown(tick)
        self._shown.end(judge(self._companion, self._meter))
        self._ended.set()
        return True


@contextmanager
def replayed_live(recording: Recording, port: int) -> Iterator[tuple[LiveReplay, str]]:
    """Serve the live page of a replay as long as this lasts; yields what to tell its place, and the address."""
    feed, before_s = Feed(), sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_S)  # the replay's own times come first
    shown = LiveReplay(recording, feed)
    try:
        with served_live(port, feed) as address:
            try:
                yield shown, address
            finally:
                shown.close()
    finally:
        shown.close()
        sys.setswitchinterval(before_s)
