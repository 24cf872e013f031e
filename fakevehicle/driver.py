"""Runs a vehicle against real sockets and the monotonic clock, in one thread.

Every tick has an absolute deadline, `deadline += period`. When the process was held up, the missed ticks are run at
once, one after the other, each with what has arrived by then: a simulator must not lose simulated time. That burst is
bounded: what lies more than `MAX_BACKLOG_S` of wall time behind is never caught up, the deadlines are moved instead,
and simulated time stays behind the wall clock from there on. Late ticks and that slip are counted.
"""

import gc
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from fakevehicle.config import Profile
from fakevehicle.vehicle import TICK_US, Vehicle
from wire.datagram import Address, Datagram
from wire.endpoint import Endpoint
from wire.udp import UdpLink, wait

LONGEST_SLEEP_S = 0.1
"""However slow the simulation, whether to stop is asked at least this often."""
MAX_BACKLOG_S = 0.25


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


PX4_LINKS = (
    LinkPlan("gcs", "gcs", Endpoint("udpout", "127.0.0.1", 14550), ("127.0.0.1", 18570)),
    LinkPlan("onboard", "onboard", Endpoint("udpout", "127.0.0.1", 14540), ("127.0.0.1", 14580)),
)
"""The ports of PX4's first instance: it sends unsolicited to both."""


@dataclass(slots=True)
class DriverCounters:
    """How well it kept time.

    Attributes
    ----------
    ticks : run.
    late : ticks that began more than one period after their deadline.
    slipped_s : wall time given up [s], see the module's text.
    """

    ticks: int = 0
    late: int = 0
    slipped_s: float = 0.0


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


def run(
    vehicle: Vehicle,
    links: dict[str, UdpLink],
    *,
    speed: float,
    stopped: Callable[[], bool],
    watch: Callable[[int], None],
) -> DriverCounters:
    """Fly until `stopped` says so.

    Parameters
    ----------
    vehicle : a fresh one; its time starts at zero.
    links : open sockets, by the vehicle's link names.
    speed : simulated seconds in one second of wall time, > 0.
    stopped : asked before every tick.
    watch : called after every tick with its now_us, to log what happened.
    """
    counters = DriverCounters()
    period_s = TICK_US * 1e-6 / speed
    now_us = 0
    gc.collect()
    gc.freeze()  # what exists now stays; collections in flight need not look at it
    deadline_s = time.monotonic()
    while not stopped():
        behind_s = time.monotonic() - deadline_s
        if behind_s < -LONGEST_SLEEP_S:
            wait((), LONGEST_SLEEP_S)
            continue
        if behind_s < 0.0:
            wait((), -behind_s)
        elif behind_s > period_s:
            counters.late += 1
            if behind_s > MAX_BACKLOG_S:
                counters.slipped_s += behind_s - MAX_BACKLOG_S
                deadline_s += behind_s - MAX_BACKLOG_S
        inputs = [
            Datagram(name, received.data, received.peer) for name, link in links.items() for received in link.receive()
        ]
        for datagram in vehicle.step(now_us, inputs):
            links[datagram.link].send(datagram)
        watch(now_us)
        counters.ticks += 1
        now_us += TICK_US
        deadline_s += period_s
    return counters
