"""A flight in real time that a fault of ours does not end in the air.

What only looks on (recorder, verdict, page, log) is left out for the rest of the flight once it has failed. When the
companion itself or its driver fails, `LastResort` lands the vehicle. Either is told with its traceback, and either
makes the flight a failure. The tick that failed is handed to the taps with what it was given, so that a re-run of the
recording comes to the same fault; the landing's ticks are counted on from it.
"""

import gc
import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from companion.core import Companion
from companion.drivers.planning import Planning
from companion.drivers.realtime import Pace, fly_realtime
from companion.drivers.tick import Tap, Tick
from companion.lastresort import LastResort
from companion.phases import AIRBORNE, Phase
from companion.seam import Input, Order, Output, PlanReady, PlanWanted, ReplanReady, ReplanWanted
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


class _Kept:
    """A companion whose tick is known when it fails; a tap that counts.

    Attributes
    ----------
    count : ticks that the taps have seen.
    failed : when, and with what, the tick was begun that failed; None: none did.
    """

    def __init__(self, companion: Companion) -> None:
        self.TICK_US, self._companion = companion.TICK_US, companion
        self.count = 0
        self.failed: tuple[int, Sequence[Input]] | None = None

    @property
    def over(self) -> bool:
        return self._companion.over

    def step(self, now_us: int, inputs: Sequence[Input]) -> list[Output]:
        try:
            return self._companion.step(now_us, inputs)
        except Exception:
            self.failed = now_us, inputs
            raise

    def __call__(self, tick: Tick) -> None:
        self.count += 1


class _CountedOn:
    """A tap whose ticks are numbered from another number than 0."""

    def __init__(self, tap: Tap, first: int) -> None:
        self._tap, self._first = tap, first

    def __call__(self, tick: Tick) -> None:
        self._tap(replace(tick, index=tick.index + self._first))


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
    guarded, kept = [Guarded(tap, told) for tap in taps], _Kept(companion)
    gc.collect()
    gc.freeze()  # what is here now stays: no collection in flight walks through it again
    try:
        rate = lambda: companion.clock.rate  # noqa: E731  as the vehicle's time runs
        taps = [kept, *guarded]
        pace = fly_realtime(kept, links, planning, taps, operator=operator, stop=stop, rate=rate)
    except Exception as error:
        pace = _land(companion, kept, links, guarded, stop, error, told)
    finally:
        gc.unfreeze()
    companion.failure = companion.failure or next((tap.fault for tap in guarded if tap.fault), "")
    return pace


def _land(
    companion: Companion,
    kept: _Kept,
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
    if kept.failed is not None:
        now_us, inputs = kept.failed
        tick = Tick(kept.count, now_us, [(now_us, item) for item in inputs], [], now_us)
        for tap in (kept, *taps):
            tap(tick)
    if phase not in OURS:
        return Pace(0, 0, 0)
    resort = LastResort(companion.link, companion.autopilot, companion.telemetry, companion.config.ground_links)
    after = [_CountedOn(tap, kept.count) for tap in taps]
    pace = fly_realtime(resort, links, NothingPlanned(), after, operator=lambda now_us: None, stop=stop)
    companion.failure = f"{fault}; the vehicle was told to land: {resort.end or 'stopped before it had'}"
    return pace


def _named(error: Exception) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())[:200]}"
