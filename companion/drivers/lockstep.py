"""Lockstep: companion and vehicle joined in memory, no clock, no socket, as fast as the CPU allows."""

from collections.abc import Callable, Sequence
from typing import Protocol

from companion.core import Companion
from companion.drivers.planning import Planning
from companion.drivers.tick import Tap, Tick
from companion.seam import Input, Order, PlanWanted, ReplanWanted
from companion.vehiclelink import VEHICLE_LINK
from wire.datagram import Address, Datagram

VEHICLE_ADDRESS: Address = ("vehicle", 0)
COMPANION_ADDRESS: Address = ("companion", 0)


class VehicleCore(Protocol):
    """The other side: any step machine with a tick of its own that divides the companion's."""

    TICK_US: int

    def step(self, now_us: int, inputs: Sequence[Datagram]) -> list[Datagram]: ...


class Wire(Protocol):
    """What lies between the two; asked at every tick of the vehicle, with or without something to carry."""

    def to_vehicle(self, now_us: int, sent: Sequence[Datagram]) -> list[Datagram]:
        """What arrives at the vehicle now, when the companion has just sent this."""
        ...

    def to_companion(self, now_us: int, sent: Sequence[Datagram]) -> list[Datagram]:
        """What arrives at the companion now, when the vehicle has just sent this."""
        ...


def fly_lockstep(
    companion: Companion,
    vehicle: VehicleCore,
    vehicle_link: str,
    planning: Planning,
    taps: Sequence[Tap],
    *,
    limit_s: float,
    operator: Callable[[int], Order | None] = lambda now_us: None,
    stop: Callable[[], bool] = lambda: False,
    wire: Wire | None = None,
) -> int:
    """Fly until the companion is done, `limit_s` of simulated time have passed, or `stop` says so.

    Datagrams take one tick of the receiver to arrive, in both directions; nothing is lost unless `wire` loses it.

    Parameters
    ----------
    vehicle_link : the vehicle's name for its link to the companion.
    operator : asked once a tick for what the person at the keyboard wants.
    stop : asked once a tick; True ends the flight as it is.
    wire : what may go wrong on the way; None: nothing.

    Returns
    -------
    The simulated time at the end [us].
    """
    if companion.TICK_US % vehicle.TICK_US:
        raise ValueError(f"vehicle tick {vehicle.TICK_US} us does not divide the companion's {companion.TICK_US} us")
    now_us, index = 0, 0
    to_vehicle: list[Datagram] = []
    while not companion.over and now_us < limit_s * 1e6 and not stop():
        inputs: list[tuple[int, Input]] = []
        for _ in range(companion.TICK_US // vehicle.TICK_US):
            now_us += vehicle.TICK_US
            if wire is not None:
                to_vehicle = wire.to_vehicle(now_us, to_vehicle)
            sent, to_vehicle = vehicle.step(now_us, to_vehicle), []
            if wire is not None:
                sent = wire.to_companion(now_us, sent)
            inputs.extend((now_us, Datagram(VEHICLE_LINK, d.data, VEHICLE_ADDRESS)) for d in sent)
        inputs.extend((now_us, ready) for ready in planning.ready())
        asked = operator(now_us)
        if asked is not None:
            inputs.append((now_us, asked))
        outputs = companion.step(now_us, [item for _, item in inputs])
        for output in outputs:
            if isinstance(output, Datagram) and output.link == VEHICLE_LINK:
                to_vehicle.append(Datagram(vehicle_link, output.data, COMPANION_ADDRESS))
            elif isinstance(output, PlanWanted | ReplanWanted):
                planning.submit(output)
        tick = Tick(index, now_us, inputs, outputs, now_us)
        for tap in taps:
            tap(tick)
        index += 1
    return now_us
