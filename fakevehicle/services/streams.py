"""Telemetry streams: which message goes out on which link how often, and MESSAGE_INTERVAL's two commands.

Every link has its own table, started from its profile. A stream's due time advances by its interval, so that rates hold
on average although a tick is 4 ms; a stream that fell behind skips what it missed. All begin together, so that what is
told in one tick is told of one estimate.
"""

from collections.abc import Callable, Mapping, Sequence
from heapq import heapify, heappop, heappush

from fakevehicle.codec import Message
from fakevehicle.config import LinkConfig, Profile
from fakevehicle.services.outbox import Outbox
from fakevehicle.services.service import Builder, Service
from wire.dialect import mavlink

SHORTEST_US = 4_000
"""One tick: no stream can be faster."""
LONGEST_US = 3_600_000_000
TOGETHER_US = 20_000
"""A stream asked for at a multiple of this begins with the next one, and so keeps step with the others."""


class Streams(Service):
    """The schedule of all links.

    Parameters
    ----------
    outbox : where messages go.
    links : names and profiles.
    rates : the streams a profile starts with, message id to rate [Hz].

    Attributes
    ----------
    table : builders of all services, by message id; set by the vehicle once all of them stand.
    """

    def __init__(
        self, outbox: Outbox, links: Sequence[LinkConfig], rates: Callable[[Profile], Mapping[int, float]]
    ) -> None:
        self._outbox = outbox
        self.table: Mapping[int, Builder] = {}
        self._rates = {link.name: rates(link.profile) for link in links}
        self._intervals_us: dict[str, dict[int, int]] = {}
        self._queues: dict[str, list[tuple[int, int]]] = {}  # heaps of (due_us, message id)
        self._next_us = 0  # when the first of all is due
        for link in links:
            intervals = {number: round(1e6 / rate) for number, rate in self._rates[link.name].items()}
            self._intervals_us[link.name] = intervals
            self._queues[link.name] = [(0, number) for number in sorted(intervals)]

    def knows(self, message_id: int) -> bool:
        """Whether the vehicle has this message at all."""
        return message_id in self.table

    def build(self, message_id: int) -> Message | None:
        """One message now; None when there is no such message, or nothing to say in it yet."""
        builder = self.table.get(message_id)
        return None if builder is None else builder()

    def interval_us(self, link: str, message_id: int) -> int:
        """Interval on one link [us]; -1 switched off, 0 not a message of this vehicle."""
        if message_id not in self.table:
            return 0
        return self._intervals_us[link].get(message_id, -1)

    def set_interval(self, link: str, message_id: int, interval_us: int, now_us: int) -> bool:
        """Set one link's interval [us]: below 0 off, 0 the profile's own. False: the vehicle has no such message.

        HEARTBEAT cannot be switched off.
        """
        if message_id not in self.table:
            return False
        if interval_us == 0 or (interval_us < 0 and message_id == mavlink.MAVLINK_MSG_ID_HEARTBEAT):
            rate = self._rates[link].get(message_id, 0.0)
            interval_us = round(1e6 / rate) if rate else -1
        queue = self._queues[link] = [entry for entry in self._queues[link] if entry[1] != message_id]
        if interval_us < 0:
            self._intervals_us[link].pop(message_id, None)
        else:
            self._intervals_us[link][message_id] = min(max(interval_us, SHORTEST_US), LONGEST_US)
            together = self._intervals_us[link][message_id] % TOGETHER_US == 0
            due_us = -(-now_us // TOGETHER_US) * TOGETHER_US if together else now_us
            queue.append((due_us, message_id))
            self._next_us = min(self._next_us, due_us)
        heapify(queue)
        return True

    def due_us(self, message_id: int) -> int | None:
        """When a message goes out next on any link [us]; None where no link has it."""
        return min(
            (due for queue in self._queues.values() for due, number in queue if number == message_id), default=None
        )

    def step(self, now_us: int) -> None:
        """Send what is due."""
        if now_us < self._next_us:
            return
        for link, queue in self._queues.items():
            intervals_us = self._intervals_us[link]
            while queue and queue[0][0] <= now_us:
                due_us, number = heappop(queue)
                builder = self.table.get(number)
                message = builder() if builder is not None else None
                if message is not None:
                    self._outbox.broadcast(link, message)
                interval_us = intervals_us[number]
                due_us += interval_us
                heappush(queue, (due_us if due_us > now_us else now_us + interval_us, number))
        self._next_us = min((queue[0][0] for queue in self._queues.values() if queue), default=now_us)
