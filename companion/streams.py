"""The messages that are wanted of the vehicle, and asking again for those that do not come.

A request may be lost though an answer came: an acknowledgement names SET_MESSAGE_INTERVAL and not the message, and of a
doubled one the second looks like the answer to the next request. A vehicle may also forget its streams. So each kind
is counted, and asked for again when far fewer came than were asked for, less and less often; what was refused is not.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from companion.asking import Asking
from companion.autopilots.base import SPARE, stream_requests
from companion.commands import Command, Outcome
from companion.telemetry import Ack

WINDOW_US = 5_000_000
"""So long a kind is counted before it is judged."""
FAR_BELOW = 0.4
"""Of the rate that was asked: less than a link that loses a third of all, or a vehicle at half our pace, leaves."""
MOST_SPARE = 2
"""So often a message is asked for again that many a vehicle does not have."""
LONGEST = 16
"""Windows between two requests for the same, at most."""


@dataclass(slots=True)
class _Kind:
    hz: float
    came: int = 0
    again: int = 0  # how often it was asked for again
    wait: int = 0  # windows before that may be done again
    refused: bool = False


class Streams:
    """What is wanted of one vehicle, one request under way at a time.

    Parameters
    ----------
    tables : message id -> rate [Hz], of each who wants something; of several rates the greatest counts.

    Attributes
    ----------
    answered_us : when the vehicle last answered a request; None: not since `forget`.
    """

    def __init__(self, *tables: Mapping[int, float]) -> None:
        self._kinds: dict[int, _Kind] = {}
        for table in tables:
            for message_id, hz in table.items():
                kind = self._kinds.setdefault(message_id, _Kind(hz))
                kind.hz = max(kind.hz, hz)
        self._since_us: int | None = None
        self._asking = Asking()
        self._queue: list[Command] = []
        self.answered_us: int | None = None

    def requests(self) -> list[Command]:
        """All of them, as they are asked for at first."""
        return stream_requests({message_id: kind.hz for message_id, kind in self._kinds.items()})

    def heard(self, message_id: int) -> None:
        """One came."""
        kind = self._kinds.get(message_id)
        if kind is not None:
            kind.came += 1

    def over(self, command: Command) -> None:
        """What became of a request that others put."""
        if command.outcome is Outcome.REFUSED:
            self._kinds[int(command.parameters[0])].refused = True

    def missing(self, now_us: int, hears: bool = True) -> list[Command]:
        """Requests to put again now, once a window; there is nothing to count while it is not heard at all."""
        if self._since_us is None or not hears:
            self._begin(now_us)
        elif now_us - self._since_us >= WINDOW_US:
            seconds = (now_us - self._since_us) / 1e6
            again = {i: kind.hz for i, kind in self._kinds.items() if self._judge(i, kind, seconds)}
            self._begin(now_us)
            return stream_requests(again)
        return []

    def _begin(self, now_us: int) -> None:
        self._since_us = now_us
        for kind in self._kinds.values():
            kind.came = 0

    def _judge(self, message_id: int, kind: _Kind, seconds: float) -> bool:
        """Whether to ask for one again."""
        if kind.refused or kind.came >= FAR_BELOW * kind.hz * seconds:
            return False
        if kind.wait > 0 or (message_id in SPARE and kind.again >= MOST_SPARE):
            kind.wait -= 1
            return False
        kind.wait = min(2**kind.again, LONGEST) - 1
        kind.again += 1
        return True

    # ---- in the air ---------------------------------------------------------------------------------------------

    def forget(self) -> None:
        """Nothing is under way any more."""
        self._asking.forget()
        self._queue.clear()
        self.answered_us = None

    def ask(self, now_us: int, acks: list[Ack], target: int, hears: bool, probes: bool) -> object | None:
        """Once a tick: the request to send now, if one is due.

        `probes`: put a request even if nothing is missing, to see whether the vehicle hears us.
        """
        self._asking.take_acks(now_us, acks, target)
        question = self._asking.question
        if isinstance(question, Command) and question.outcome is not Outcome.PENDING:
            if question.outcome is not Outcome.UNANSWERED:
                self.answered_us = now_us
            self.over(question)
            self._asking.forget()
        self._queue.extend(self.missing(now_us, hears))
        if self._asking.question is None:
            if not self._queue and probes and self.answered_us is None:
                self._queue = self.requests()[:1]
            self._asking.question = self._queue.pop(0) if self._queue else None
        return self._asking.message(now_us, target)
