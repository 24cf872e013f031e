"""A flight as the live page shows it: a tap that puts 20 moments a second up, and the orders that come back.

It costs the flight loop some tens of microseconds a moment; what is dear (a plan's curve, JSON) is done by those who
look on, if there are any.
"""

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Literal

import numpy as np

from companion.core import Companion
from companion.drivers.tick import Tick
from companion.geofence import Area
from companion.mission import Mission, Obstacle
from companion.phases import OVER, Phase
from companion.seam import Level, Note, Order, PlanReady, Reference, ReplanReady
from companion.service.feed import NOTHING, Answer, Asked, Feed, Way
from companion.service.live import SOURCE
from companion.verdict import FlightMeter, Verdict, checks
from logs.report import contract
from planner import PointCloud, Trajectory, VoxelGrid

EVERY_US = 50_000
WAY_POINTS, MOST_CELLS = 61, 20_000
NAN = math.nan
NOT_PLACED = (Phase.CONNECTING, Phase.PREPARING)
"""The mission frame is fixed when they are left."""


class LiveFlight:
    """A tap, and the operator at the page.

    Parameters
    ----------
    feed : where it goes; a flight begins in it with this object.
    facts : of the header.
    orders : whether pages may give some.
    """

    def __init__(
        self,
        feed: Feed,
        companion: Companion,
        meter: FlightMeter,
        facts: Mapping[str, str] | None = None,
        *,
        orders: bool = True,
    ) -> None:
        self._feed, self._companion, self._meter = feed, companion, meter
        self._phase = companion.phase
        self._began_us: int | None = None
        self._due_us = 0
        self._reference: Reference | None = None
        self._referred_us = 0
        self._asked: Asked | None = None
        told = tuple(facts.items()) if facts else ()
        mission = companion.mission
        header = contract.Header(
            mission.name, phase=companion.phase.value, facts=(("seed", companion.config.seed), *told)
        )
        feed.begin(header, scene_of(mission), orders=orders)

    def operator(self, at_hand: Callable[[int], Order | None]) -> Callable[[int], Order | None]:
        """Whoever is at hand, and when there is nobody, a page; one order a tick."""

        def ask(now_us: int) -> Order | None:
            order = at_hand(now_us)
            if order is not None:
                return order
            self._asked = self._feed.take_order()
            return None if self._asked is None else self._asked.order

        return ask

    def __call__(self, tick: Tick) -> None:
        now_us = tick.now_us
        if self._began_us is None:
            self._began_us = self._due_us = now_us
        t = (now_us - self._began_us) / 1e6
        for _, item in tick.inputs:
            if isinstance(item, PlanReady) and item.trajectory is not None:
                self._feed.way(Way(t, partial(_curve, item.trajectory), "plan"))
            elif isinstance(item, ReplanReady) and item.flown is not None:
                self._feed.way(Way(t, partial(_curve, item.flown.trajectory), item.kind))
        refused = ""
        for output in tick.outputs:
            if isinstance(output, Reference):
                self._reference, self._referred_us = output, now_us
            elif isinstance(output, Note):
                self._feed.event(contract.Event(t, _kind(output.text), output.level.value, output.text))
                if self._asked is not None and output.level is Level.WARNING:
                    refused = refused or output.text.partition(f"{self._asked.order.name} ({SOURCE}): ")[2]
        if self._asked is not None:
            asked, self._asked = self._asked, None
            asked.answer(Answer(asked.order.name, not refused, refused or "told to the flight"))
        phase = self._companion.phase
        if phase is not self._phase:
            self._phase = phase
            self._feed.header(phase=phase.value, failure=self._companion.failure)
        if now_us >= self._due_us or phase in OVER:
            self._due_us = max(self._due_us + EVERY_US, now_us)
            self._feed.sample(self._row(t, now_us))

    def _row(self, t: float, now_us: int) -> tuple[float, ...]:
        """The moment, in the order of `feed.COLUMNS`."""
        companion, meter = self._companion, self._meter
        said, link = companion.telemetry, companion.link
        fresh = self._reference if now_us - self._referred_us <= 2 * companion.TICK_US else None
        rn, re, ru = (NAN, NAN, NAN) if fresh is None else _up(fresh.position_m.tolist())
        n = e = u = level = climb = roll = pitch = yaw = NAN
        if said.position_us is not None and self._phase not in NOT_PLACED:
            n, e, u = _up((said.position_n - companion.origin_n).tolist())
            v = said.velocity_n.tolist()
            level, climb = math.hypot(v[0], v[1]), -v[2]
        if said.attitude_us is not None:
            roll, pitch, yaw = said.roll, said.pitch, said.yaw
        sender = link.framer.senders.get((link.system_id or 0, 1))
        battery = NAN if said.battery is None else 100.0 * said.battery
        return (
            t,
            *(n, e, u, roll, pitch, yaw),
            *(rn, re, ru),
            NAN if fresh is None else meter.tracking_error_now,
            *(u, ru),
            *(level, climb),
            *(math.degrees(roll), math.degrees(pitch)),
            NAN if fresh is None else meter.setpoint_rate_now,
            NAN if link.heard_us is None else (now_us - link.heard_us) / 1e3,
            NAN if sender is None else float(sender.lost),
            battery,
        )

    def end(self, verdict: Verdict) -> None:
        """The flight is over and judged."""
        failure = verdict.failure or "; ".join(verdict.failed_expectations)
        found = checks(verdict, self._companion.mission.expect)
        self._feed.header(
            ok=verdict.ok,
            phase=verdict.phase,
            failure=failure,
            duration_s=verdict.duration_s,
            checks=tuple(contract.Check(c.name, c.value, c.expected, c.ok) for c in found),
        )
        self._feed.end()


def scene_of(mission: Mission) -> contract.Scene:
    """What is known of the world beforehand, and what a person would want to see of it, in north, east, up."""
    bounds, fence = mission.world.bounds, mission.fence
    low = (bounds.north.low, bounds.east.low, bounds.altitude.low)
    high = (bounds.north.high, bounds.east.high, bounds.altitude.high)
    planned = mission.whole_world().obstacles  # the mission's own first, in its order
    obstacles = [_shown(obstacle, planned[k]) for k, obstacle in enumerate(mission.world.obstacles)]
    outline = None
    if fence is not None:
        outline = fence.include[0].outline() if fence.include else None
        obstacles += [_stay_out(area, fence.ceiling or bounds.altitude.high) for area in fence.exclude]
    return contract.Scene(NOTHING, tuple(obstacles), (low, high), outline, reference=NOTHING)


def _shown(obstacle: Obstacle, planned: object) -> contract.Json:
    """An obstacle as the page draws it."""
    label = "not told to the planner" if obstacle.hidden else ""
    if (box := obstacle.box) is not None:
        low = (box.north.low, box.east.low, box.altitude.low)
        return contract.box(low, (box.north.high, box.east.high, box.altitude.high), label)
    if (c := obstacle.cylinder) is not None:
        return contract.cylinder((c.north, c.east, c.altitude.low), c.radius, c.altitude.high - c.altitude.low, label)
    if (s := obstacle.sphere) is not None:
        return contract.sphere((s.north, s.east, s.altitude), s.radius, label)
    if (p := obstacle.prism) is not None:
        return contract.prism([(k.north, k.east) for k in p.corners], p.altitude.low, p.altitude.high, label)
    if isinstance(planned, VoxelGrid):
        cells = np.argwhere(planned.occupied)
    else:
        assert isinstance(planned, PointCloud)
        cells = np.unique(np.floor((planned.points - planned.origin) / planned.resolution).astype(np.int64), axis=0)
    cells = cells[:: max(1, -(-len(cells) // MOST_CELLS))]
    centres = (np.array(planned.origin) + planned.resolution * (cells + 0.5)) * (1.0, 1.0, -1.0)
    return contract.cells(planned.resolution, centres)


def _stay_out(area: Area, top: float) -> contract.Json:
    """An area of the fence that is flown round."""
    if (circle := area.circle) is not None:
        return contract.cylinder((circle.north, circle.east, 0.0), circle.radius, top, "fence: stay out")
    return contract.prism(area.outline(), 0.0, top, "fence: stay out")


def _curve(trajectory: Trajectory) -> list[list[float]]:
    """Points of a plan, north, east, up [m]."""
    at = np.linspace(0.0, trajectory.duration, WAY_POINTS)
    points: list[list[float]] = (trajectory.position(at) * (1.0, 1.0, -1.0)).tolist()
    return points


def _up(ned: list[float]) -> tuple[float, float, float]:
    return ned[0], ned[1], -ned[2]


def _kind(text: str) -> Literal["phase", "order", "text"]:
    """What a note is about, for the timeline's filter."""
    if " -> " in text.partition(" (")[0].partition(":")[0]:
        return "phase"
    if f" ({SOURCE})" in text:
        return "order"
    return "text"
