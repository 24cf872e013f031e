"""Real time: the same core over UDP sockets and the monotonic clock, in one thread.

Absolute deadlines, soon after the vehicle's positions come (`beat`): the driver receives until the next one, steps,
sends, and hands the tick to the taps. A late tick is counted and never made up by a burst. `now_us` is microseconds
since the epoch as of the start, advanced by the monotonic clock, so that a step of the wall clock cannot bend a flight.

Another thread of this process, a recorder's say, gives the interpreter back within `SWITCH_S`, not Python's 5 ms.
"""

import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from companion.drivers.beat import Beat, tells_position
from companion.drivers.planning import Planning
from companion.drivers.tick import Tap, Tick
from companion.seam import Input, Order, Output, PlanWanted, ReplanWanted
from companion.vehiclelink import VEHICLE_LINK
from wire.datagram import Datagram
from wire.udp import UdpLink, wait


@dataclass(frozen=True, slots=True)
class Pace:
    """How well the driver kept time."""

    ticks: int
    late: int  # ticks that began more than half a period after their deadline
    missed: int  # periods without a tick, since the one before took too long


class Core(Protocol):
    """What is driven: a `Companion`, or what stands in for it between flights."""

    TICK_US: int

    @property
    def over(self) -> bool: ...

    def step(self, now_us: int, inputs: Sequence[Input]) -> list[Output]: ...


SHORTEST_TICK_NS = 2_000_000
SWITCH_S = 0.0005


def tick_ns(tick_us: int, rate: float) -> int:
    """Our time between two ticks [ns]: for a vehicle `rate` times as fast as we are, 50 Hz of its own time."""
    return max(SHORTEST_TICK_NS, round(tick_us * 1000 / max(1.0, rate)))


def fly_realtime(
    companion: Core,
    links: Mapping[str, UdpLink],
    planning: Planning,
    taps: Sequence[Tap],
    *,
    operator: Callable[[int], Order | None],
    stop: Callable[[], bool] = lambda: False,
    rate: Callable[[], float] = lambda: 1.0,
) -> Pace:
    """Fly until the companion is done or `stop` says so (asked once a tick); `rate`: the vehicle's pace."""
    before_s = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_S)
    try:
        return _fly(companion, links, planning, taps, operator, stop, rate)
    finally:
        sys.setswitchinterval(before_s)


def _fly(
    companion: Core,
    links: Mapping[str, UdpLink],
    planning: Planning,
    taps: Sequence[Tap],
    operator: Callable[[int], Order | None],
    stop: Callable[[], bool],
    rate: Callable[[], float],
) -> Pace:
    epoch_ns = time.time_ns() - time.monotonic_ns()
    names = {id(link): name for name, link in links.items()}
    sockets = list(links.values())
    period_ns, index, late = tick_ns(companion.TICK_US, rate()), 0, 0
    beat = Beat(time.monotonic_ns(), period_ns)
    while not companion.over and not stop():
        inputs: list[tuple[int, Input]] = []
        left_ns = 1
        while left_ns > 0:  # once more when it is due: what came while this process waited for its turn
            left_ns = beat.deadline_ns - time.monotonic_ns()
            for link in wait(sockets, left_ns / 1e9):
                name = names[id(link)]
                for got in link.receive():
                    if name == VEHICLE_LINK and tells_position(got.data):
                        beat.heard(got.received_ns)
                    inputs.append(((got.received_ns + epoch_ns) // 1000, Datagram(name, got.data, got.peer)))
        started_ns = time.monotonic_ns()
        overdue_ns = started_ns - beat.deadline_ns
        late += overdue_ns > period_ns // 2
        now_us = (started_ns + epoch_ns) // 1000
        inputs.extend((now_us, ready) for ready in planning.ready())
        asked = operator(now_us)
        if asked is not None:
            inputs.append((now_us, asked))
        outputs = companion.step(now_us, [item for _, item in inputs])
        for output in outputs:
            if isinstance(output, Datagram):
                links[output.link].send(output)
            elif isinstance(output, PlanWanted | ReplanWanted):
                planning.submit(output)
        tick = Tick(index, now_us, inputs, outputs, (time.monotonic_ns() + epoch_ns) // 1000)
        for tap in taps:
            tap(tick)
        index += 1
        period_ns = tick_ns(companion.TICK_US, rate())
        beat.next(time.monotonic_ns(), period_ns)
    return Pace(index, late, beat.missed)
