"""A flight in real time that a fault of ours does not end in the air.

What only looks on (recorder, verdict, page, log) is left out for the rest of the flight once it has failed. When the
companion itself or its driver fails, `LastResort` lands the vehicle. Either is told with its traceback, and either
makes the flight a failure.
"""

import gc
import traceback
from collections.abc import Callable, Mapping, Sequence

from companion.core import Companion
from companion.drivers.planning import Planning
from companion.drivers.realtime import Pace, fly_realtime
from companion.drivers.tick import Tap, Tick
from companion.lastresort import LastResort
from companion.phases import AIRBORNE, Phase
from companion.seam import Order, PlanReady, PlanWanted, ReplanReady, ReplanWanted
from wire.udp import UdpLink

Told = Callable[[str, str], None]
"""Takes a fault of ours in one line, and its traceback."""
OURS = AIRBORNE | {Phase.ARMING, Phase.DISARMING}
"""Phases in which the vehicle is in the air by our doing, or may be armed by it."""


class NothingPlanned:
    """Nobody plans."""

    def submit(self, wanted: PlanWanted | ReplanWanted) -> None:
        pass

    def ready(self) -> list[PlanReady | ReplanReady]:
        return []

    def close(self) -> None:
        pass


class Guarded:
    """A tap that is left out once it has failed.

    Attributes
    ----------
    fault : why; empty while it has not.
    """

    def __init__(self, tap: Tap, told: Told) -> None:
        self._tap, self._told = tap, told
        self.fault = ""

    def __call__(self, tick: Tick) -> None:
        if self.fault:
            return
        try:
            self._tap(tick)
        except Exception as error:
            name = getattr(self._tap, "__qualname__", type(self._tap).__qualname__)
            self.fault = f"{name} failed and is left out: {_named(error)}"
            self._told(self.fault, traceback.format_exc())


def fly_guarded(
    companion: Companion,
    links: Mapping[str, UdpLink],
    planning: Planning,
    taps: Sequence[Tap],
    *,
    operator: Callable[[int], Order | None],
    stop: Callable[[], bool],
    told: Told,
) -> Pace:
    """Fly as `fly_realtime`; a fault of ours is told, ends in a landing, and is the companion's `failure`."""
    guarded = [Guarded(tap, told) for tap in taps]
    gc.collect()
    gc.freeze()  # what is here now stays: no collection in flight walks through it again
    try:
        rate = lambda: companion.clock.rate  # noqa: E731  as the vehicle's time runs
        pace = fly_realtime(companion, links, planning, guarded, operator=operator, stop=stop, rate=rate)
    except Exception as error:
        pace = _land(companion, links, guarded, stop, error, told)
    finally:
        gc.unfreeze()
    companion.failure = companion.failure or next((tap.fault for tap in guarded if tap.fault), "")
    return pace


def _land(
    companion: Companion,
    links: Mapping[str, UdpLink],
    taps: Sequence[Tap],
    stop: Callable[[], bool],
    error: Exception,
    told: Told,
) -> Pace:
    """Land by `LastResort` if the vehicle is in our hands; the flight has failed either way."""
    fault, phase = f"a fault of the companion's own: {_named(error)}", companion.phase
    companion.phase, companion.failure = Phase.FAILED, fault
    told(fault, "".join(traceback.format_exception(error)))
    if phase not in OURS:
        return Pace(0, 0, 0)
    resort = LastResort(companion.link, companion.autopilot, companion.telemetry, companion.config.ground_links)
    pace = fly_realtime(resort, links, NothingPlanned(), taps, operator=lambda now_us: None, stop=stop)
    companion.failure = f"{fault}; the vehicle was told to land: {resort.end or 'stopped before it had'}"
    return pace


def _named(error: Exception) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())[:200]}"
