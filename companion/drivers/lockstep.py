"""Lockstep: companion and vehicle joined in memory, no clock, no socket, as fast as the CPU allows."""

from collections.abc import Callable, Sequence
from typing import Protocol

from companion.core import Companion
from companion.drivers.planning import Planning
from companion.drivers.tick import Tap, Tick
from companion.fleet.member import FLEET_LINK
from companion.seam import Input, Order, Output, PlanWanted, ReplanWanted
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
    pair = Pair(companion, vehicle, vehicle_link, planning, taps, operator, wire)
    now_us = 0
    while not companion.over and now_us < limit_s * 1e6 and not stop():
        pair.tick(now_us, [])
        now_us += companion.TICK_US
    return now_us


class Pair:
    """A companion and its vehicle, joined; parameters as in `fly_lockstep`."""

    def __init__(
        self,
        companion: Companion,
        vehicle: VehicleCore,
        vehicle_link: str,
        planning: Planning,
        taps: Sequence[Tap],
        operator: Callable[[int], Order | None] = lambda now_us: None,
        wire: Wire | None = None,
    ) -> None:
        if companion.TICK_US % vehicle.TICK_US:
            raise ValueError(
                f"vehicle tick {vehicle.TICK_US} us does not divide the companion's {companion.TICK_US} us"
            )
        self.companion, self.vehicle = companion, vehicle
        self._vehicle_link, self._planning, self._taps = vehicle_link, planning, taps
        self._operator, self._wire = operator, wire
        self._to_vehicle: list[Datagram] = []
        self._index = 0

    def tick(self, now_us: int, others: Sequence[Datagram]) -> list[Output]:
        """Go on by one tick of the companion from `now_us`; what it gives, and `others` is what it hears beside."""
        companion, vehicle, wire = self.companion, self.vehicle, self._wire
        inputs: list[tuple[int, Input]] = []
        for _ in range(companion.TICK_US // vehicle.TICK_US):
            now_us += vehicle.TICK_US
            if wire is not None:
                self._to_vehicle = wire.to_vehicle(now_us, self._to_vehicle)
            sent, self._to_vehicle = vehicle.step(now_us, self._to_vehicle), []
            if wire is not None:
                sent = wire.to_companion(now_us, sent)
            inputs.extend((now_us, Datagram(VEHICLE_LINK, d.data, VEHICLE_ADDRESS)) for d in sent)
        inputs.extend((now_us, datagram) for datagram in others)
        inputs.extend((now_us, ready) for ready in self._planning.ready())
        asked = self._operator(now_us)
        if asked is not None:
            inputs.append((now_us, asked))
        outputs = companion.step(now_us, [item for _, item in inputs])
        for output in outputs:
            if isinstance(output, Datagram) and output.link == VEHICLE_LINK:
                self._to_vehicle.append(Datagram(self._vehicle_link, output.data, COMPANION_ADDRESS))
            elif isinstance(output, PlanWanted | ReplanWanted):
                self._planning.submit(output)
        tick = Tick(self._index, now_us, inputs, outputs, now_us)
        for tap in self._taps:
            tap(tick)
        self._index += 1
        return outputs


def fly_lockstep_many(
    pairs: Sequence[Pair],
    *,
    limit_s: float,
    look: Callable[[int], None] = lambda now_us: None,
    stop: Callable[[], bool] = lambda: False,
    carried: Callable[[int, int, int], bool] = lambda now_us, sender, hearer: True,
) -> int:
    """Fly several at once; what one says on the fleet's link all others hear a tick later.

    Who is done stands where it is. `look` is called after every tick; `carried` is asked whether what one says reaches
    another (both as indices).

    Returns
    -------
    The simulated time at the end [us].
    """
    now_us = 0
    heard: list[list[Datagram]] = [[] for _ in pairs]
    while not all(pair.companion.over for pair in pairs) and now_us < limit_s * 1e6 and not stop():
        told: list[list[Datagram]] = [[] for _ in pairs]
        for i, pair in enumerate(pairs):
            if pair.companion.over:
                continue
            for output in pair.tick(now_us, heard[i]):
                if isinstance(output, Datagram) and output.link == FLEET_LINK:
                    word = Datagram(FLEET_LINK, output.data, (f"vehicle {i}", 0))
                    for k, others in enumerate(told):
                        others.extend([word] if k != i and carried(now_us, i, k) else [])
        heard = told
        now_us += pairs[0].companion.TICK_US
        look(now_us)
    return now_us
