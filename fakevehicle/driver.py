"""Runs vehicles against real sockets and the monotonic clock, in one thread.

The process wakes for the tick in which a position is told, for every fifth at least, and whenever a datagram comes in,
and runs what is due; a datagram is heard by the tick in which it came. A tick's work costs up to three times as much
when the caches have gone cold in a sleep, and no client notices other telemetry that is 16 ms late (its stamps are
right), but an answer that is, and a position that comes now early and now late. Every tick has an absolute deadline,
`deadline += period`. When the process was held up, the missed ticks are run at once, one after the other: a simulator
must not lose simulated time. That burst is bounded: what lies more than `MAX_BACKLOG_S` of wall time behind is never
caught up, the deadlines are moved instead, and simulated time stays behind the wall clock from there on. Late ticks and
that slip are counted.

Several vehicles share the thread and the clock: all of them step in every tick. Sleeping and looking at the sockets is
paid once a wake, whatever the number of vehicles and links.
"""

import gc
import time
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

from fakevehicle.config import Profile
from fakevehicle.recordings import TRUTH_US, FlightLog
from fakevehicle.vehicle import TICK_US, Vehicle
from wire.datagram import Address, Datagram
from wire.endpoint import Endpoint
from wire.udp import UdpLink, wait

LONGEST_SLEEP_S = 0.1
"""However slow the simulation, whether to stop is asked at least this often."""
MAX_BACKLOG_S = 0.25
TICKS_A_WAKE = 5
"""Ticks run in one go when nothing comes in: not more than a position at 50 Hz leaves between two."""


@dataclass(frozen=True, slots=True)
class LinkPlan:
    """One link of the vehicle before its socket is open.

    Attributes
    ----------
    name, profile : as in `LinkConfig`.
    endpoint : where to listen, or whom to call.
    local : our own address, for a link that calls from a fixed port.
    """

    name: str
    profile: Profile
    endpoint: Endpoint
    local: Address | None = None


PX4_GCS, PX4_OFFBOARD = (14550, 18570), (14540, 14580)
"""Ports of PX4's first instance, called and own: it sends unsolicited to both."""
PX4_LAST_OWN_PORT = 9
"""Instances behind this one all call its companion's port, 14549, so that none calls the ground station's."""


def px4_links(instance: int) -> tuple[LinkPlan, ...]:
    """The links of PX4's instance `instance`, from 0: all call one ground station, each its own companion.

    18570+i -> 14550 and 14580+i -> 14540+i, as PX4's start script has them (ROMFS/.../px4-rc.mavlink).
    """
    (gcs, gcs_local), (offboard, offboard_local) = PX4_GCS, PX4_OFFBOARD
    host = "127.0.0.1"
    return (
        LinkPlan("gcs", "gcs", Endpoint("udpout", host, gcs), (host, gcs_local + instance)),
        LinkPlan(
            "onboard",
            "onboard",
            Endpoint("udpout", host, offboard + min(instance, PX4_LAST_OWN_PORT)),
            (host, offboard_local + instance),
        ),
    )


@dataclass(slots=True)
class DriverCounters:
    """How well it kept time.

    Attributes
    ----------
    ticks : run.
    late : ticks that began more than the time of a whole wake after the latest moment for them.
    slipped_s : wall time given up [s], see the module's text.
    """

    ticks: int = 0
    late: int = 0
    slipped_s: float = 0.0


@dataclass(slots=True)
class Seat:
    """One vehicle with its open sockets.

    Attributes
    ----------
    vehicle : a fresh one; its time starts at zero.
    links : by the vehicle's link names.
    watch : called after every tick with its now_us, to log what happened.
    log : what it is recorded into; None: it is not.
    """

    vehicle: Vehicle
    links: dict[str, UdpLink]
    watch: Callable[[int], None]
    log: FlightLog | None = None

    def step(self, now_us: int, ready: Collection[UdpLink]) -> None:
        """One tick: take, step, send, record."""
        inputs: list[Datagram] = []
        if ready:
            for name, link in self.links.items():
                if link in ready:
                    inputs += [Datagram(name, received.data, received.peer) for received in link.receive()]
        outputs = self.vehicle.step(now_us, inputs)
        for datagram in outputs:
            self.links[datagram.link].send(datagram)
        if self.log is not None:
            truth = self.vehicle.truth if now_us % TRUTH_US == 0 else None
            self.log.tick(now_us, inputs, outputs, truth)
            self.log.look(self.vehicle, now_us)
        self.watch(now_us)


def open_links(plans: Sequence[LinkPlan]) -> dict[str, UdpLink]:
    """Open every socket, or none.

    Raises
    ------
    LinkError : a port is taken, a host unknown.
    """
    links: dict[str, UdpLink] = {}
    try:
        for plan in plans:
            links[plan.name] = UdpLink(plan.name, plan.endpoint, plan.local)
    except Exception:
        for link in links.values():
            link.close()
        raise
    return links


def run(seats: Sequence[Seat], *, speed: float, stopped: Callable[[], bool]) -> DriverCounters:
    """Fly until `stopped` says so.

    Parameters
    ----------
    seats : the vehicles; they step in this order.
    speed : simulated seconds in one second of wall time, > 0.
    stopped : asked before every tick.
    """
    counters = DriverCounters()
    period_s = TICK_US * 1e-6 / speed
    now_us = 0
    every_link = [link for seat in seats for link in seat.links.values()]
    gc.collect()
    gc.freeze()  # what exists now stays; collections in flight need not look at it
    deadline_s = time.monotonic()
    while not stopped():
        patience_s = _patience(seats, now_us) * period_s
        behind_s = time.monotonic() - deadline_s
        if behind_s < 0.0:  # the tick under way has been run already
            time.sleep(min(-behind_s, LONGEST_SLEEP_S))
            continue
        ready: Collection[UdpLink] = frozenset(wait(every_link, min(patience_s - behind_s, LONGEST_SLEEP_S)))
        behind_s = time.monotonic() - deadline_s
        if behind_s < patience_s and not ready:
            continue
        if behind_s > patience_s + TICKS_A_WAKE * period_s:
            counters.late += TICKS_A_WAKE
            if behind_s > MAX_BACKLOG_S:
                counters.slipped_s += behind_s - MAX_BACKLOG_S
                deadline_s += behind_s - MAX_BACKLOG_S
        due = min(int(behind_s / period_s) + 1, TICKS_A_WAKE)
        for left in range(due - 1, -1, -1):
            for seat in seats:
                seat.step(now_us, () if left else ready)
            counters.ticks += 1
            now_us += TICK_US
        deadline_s += due * period_s
    return counters


def _patience(seats: Sequence[Seat], now_us: int) -> int:
    """How many ticks the one at `now_us` may wait for those after it."""
    dues_us = (due_us for seat in seats if (due_us := seat.vehicle.position_due_us) is not None)
    return max(0, min((min(dues_us, default=now_us + TICKS_A_WAKE * TICK_US) - now_us) // TICK_US, TICKS_A_WAKE - 1))
