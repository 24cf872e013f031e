"""What viewers are shown of a flight: a tick and the companion's state as `logs.mirrors` takes them.

Little is done here, since it is the flight loop that pays for it: what is at hand is handed on, at the rates below, and
the recorder's thread makes messages of it. The world is turned into shapes before the flight.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from companion.core import Companion
from companion.drivers.tick import Tick
from companion.geofence import Geofence, Outline
from companion.mission import Mission, solid_of
from companion.phases import Phase
from companion.seam import Note, PlanReady, Reference, ReplanReady
from companion.seeing.sight import Sight
from logs.mirrors import Body, Fix, Mirror, Plan, Said, Scene
from logs.scenery import MOST_ENTITIES, Ball, Cells, Cube, Cylinder, Entity, Prism, runs_of
from logs.schema import Tracking
from planner import PointCloud
from planner import worlds as planned
from planner.voxels import VoxelGrid

BODY_US = 35_000
FIX_US = 190_000
SCENE_US = 1_000_000
"""Shortest times between two of a kind: 25, 5 and 1 a second, for ticks of 20 ms that may come a little early."""
MOVER_LIFETIME_S = 3.0
PLANS = (PlanReady, ReplanReady)
NOT_PLACED = (Phase.CONNECTING, Phase.PREPARING)
"""The mission frame is fixed when they are left."""
SOLID, HIDDEN, LATER = (0.55, 0.62, 0.70, 0.85), (0.90, 0.55, 0.20, 0.60), (0.90, 0.55, 0.20, 0.35)
SEEN, MOVING, FENCE, BOUNDS = (
    (0.95, 0.80, 0.20, 0.60),
    (0.85, 0.25, 0.60, 0.90),
    (0.85, 0.2, 0.2, 1.0),
    (0.5, 0.5, 0.5, 0.5),
)


class Mirroring:
    """Looks at every tick and gives what viewers should be told of it."""

    def __init__(self, companion: Companion) -> None:
        self._companion = companion
        self._world: Scene | None = Scene(world_entities(companion.mission), key="world")
        self._position_us: int | None = None
        self._global_e7: tuple[int, int, int] | None = None
        self._body_us = self._fix_us = self._scene_us = -(1 << 62)
        self._map_version, self._tracks_version, self._movers = 0, 0, 0
        self._placed = False

    def __call__(self, tick: Tick) -> Iterator[Mirror | Tracking]:
        """In the order in which they should be told."""
        if self._world is not None:
            yield self._world
            self._world = None
        for _, item in tick.inputs:
            if isinstance(item, PLANS):
                yield from _plan(item)
        yield from self._vehicle(tick)
        if tick.now_us - self._scene_us >= SCENE_US:
            yield from self._seen(tick.now_us)
        for output in tick.outputs:
            if isinstance(output, Note):
                who, said, text = output.text.partition(": ")
                words = (text, who) if said and who == "vehicle" else (output.text, "companion")
                yield Said(output.level.value, *words)

    def _vehicle(self, tick: Tick) -> Iterator[Mirror | Tracking]:
        now_us, companion, told = tick.now_us, self._companion, self._companion.telemetry
        self._placed = self._placed or companion.phase not in NOT_PLACED
        if told.position_us != self._position_us and now_us - self._body_us >= BODY_US and self._placed:
            place = (told.position_n - companion.origin_n).tolist()
            angles = (told.roll, told.pitch, told.yaw)
            if told.position_us is not None and all(map(math.isfinite, (*place, *angles))):
                yield Body(told.position_us * 1000, (place[0], place[1], place[2]), *angles)
                yield from _tracking(tick, place, told.position_us)
            self._body_us, self._position_us = now_us, told.position_us
        if told.global_e7 != self._global_e7 and now_us - self._fix_us >= FIX_US:
            self._fix_us, self._global_e7 = now_us, told.global_e7
            if told.global_e7 is not None:
                latitude, longitude, altitude = told.global_e7
                yield Fix(latitude * 1e-7, longitude * 1e-7, altitude * 1e-3)

    def _seen(self, now_us: int) -> Iterator[Mirror]:
        """The map and what moves, where either has changed."""
        sight = self._companion.seeing
        if not isinstance(sight, Sight):
            return
        if sight.map.version != self._map_version:
            self._scene_us, self._map_version = now_us, sight.map.version
            view = sight.map.view()
            cells = Cells(view.runs, view.origin, view.resolution)
            yield Scene([Entity("seen", "cells", [cells], SEEN)], key="seen")
        if sight.tracks.version != self._tracks_version:
            self._scene_us, self._tracks_version = now_us, sight.tracks.version
            movers = sight.tracks.movers()
            gone = [f"mover/{k}" for k in range(len(movers), self._movers)]
            self._movers = len(movers)
            balls = (Ball(m.centre, m.radius, m.velocity) for m in movers)
            yield Scene(
                [Entity(f"mover/{k}", "mover", [b], MOVING, {}, MOVER_LIFETIME_S) for k, b in enumerate(balls)], gone
            )


def _tracking(tick: Tick, place: Sequence[float], position_us: int) -> Iterator[Tracking]:
    """How far a position is from the tick's reference, which is taken back to when the position was told."""
    for output in tick.outputs:
        if isinstance(output, Reference):
            age_s = (tick.now_us - position_us) * 1e-6
            pairs = zip(output.position_m.tolist(), output.velocity_m.tolist(), place, strict=True)
            north, east, down = (wanted - speed * age_s - here for wanted, speed, here in pairs)
            yield Tracking(math.sqrt(north * north + east * east + down * down), north, east, down)


def _plan(ready: PlanReady | ReplanReady) -> Iterator[Plan]:
    if isinstance(ready, PlanReady):
        if ready.trajectory is not None and ready.certified:
            yield Plan(ready.trajectory.control_points, ready.trajectory.knots, afresh=False)
    elif ready.flown is not None:
        yield Plan(ready.flown.trajectory.control_points, ready.flown.trajectory.knots, afresh=True)


def world_entities(mission: Mission) -> list[Entity]:
    """What a mission tells of its world: bounds, obstacles, what will appear, the fence."""
    (low, high), world = mission.whole_world().bounds, mission.world
    found = [Entity("bounds", "bounds", [Cube(low, high)], BOUNDS, edges_only=True)]
    for index, obstacle in enumerate(world.obstacles[:MOST_ENTITIES]):
        colour, more = (HIDDEN, {"hidden": "yes"}) if obstacle.hidden else (SOLID, {})
        kind, shape = _shape(mission.solid(index))
        found.append(Entity(f"obstacle/{index}", kind, [shape], colour, more))
    for index, popup in enumerate(world.popups):
        kind, shape = _shape(solid_of(popup))
        when = f"after {popup.at:g} s" if popup.at is not None else f"within {popup.within:g} m"
        found.append(Entity(f"popup/{index}", kind, [shape], LATER, {"hidden": "yes", "appears": when}))
    fence = mission.geofence()
    return found if fence is None else [*found, *_fence(fence, (low[2], high[2]))]


def _shape(solid: Any) -> tuple[str, Cube | Cylinder | Ball | Prism | Cells]:
    match solid:
        case planned.Box():
            return "box", Cube(solid.lower, solid.upper)
        case planned.Cylinder():
            return "cylinder", Cylinder(solid.centre, solid.radius, solid.z)
        case planned.Sphere():
            return "sphere", Ball(solid.centre, solid.radius)
        case planned.Prism():
            return "prism", Prism(tuple(solid.corners), solid.z)
        case VoxelGrid():
            return "cells", Cells(runs_of(np.argwhere(solid.occupied)), solid.origin, solid.resolution)
        case PointCloud():
            cells = np.floor((solid.points - np.asarray(solid.origin)) / solid.resolution).astype(np.int64)
            return "cells", Cells(runs_of(cells), solid.origin, solid.resolution)
    raise TypeError(f"no shape for {solid!r}")


def _fence(fence: Geofence, z: tuple[float, float]) -> list[Entity]:
    """Each area from the ground, or the bottom of the world, to the ceiling."""
    high = fence.ceiling if math.isfinite(fence.ceiling) else max(-z[0], 1.0)
    span = (-high, min(0.0, z[1]))
    areas: list[tuple[str, Outline]] = [("stay in", outline) for outline in fence.include]
    areas += [("stay in", _ring(*circle)) for circle in fence.within]
    areas += [("stay out", outline) for outline in fence.exclude]
    areas += [("stay out", _ring(*circle)) for circle in fence.circles]
    return [
        Entity(f"fence/{k}", "fence", [Prism(outline, span)], FENCE, {"rule": rule}, edges_only=True)
        for k, (rule, outline) in enumerate(areas)
    ]


def _ring(north: float, east: float, radius: float) -> Outline:
    turns = [2.0 * math.pi * k / 32 for k in range(32)]
    return tuple((north + radius * math.cos(a), east + radius * math.sin(a)) for a in turns)
