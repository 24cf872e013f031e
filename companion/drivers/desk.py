"""Answering `ReplanWanted`: the desk that keeps a `planner.replan.Replanner` and the world it plans in.

The world is what the mission says and the cells that are taken now, around the vehicle. One desk answers in
turn; it is used in line by a lockstep, and in a process of its own over UDP. A plan from scratch (`cold`) may take a
second, so over UDP another desk, in another process, answers those.

Times are told to the planner from the first question on, so that what a float loses does not grow with the epoch.
"""

import math
from dataclasses import replace

import numpy as np

from companion.seam import FloatArray, Flown, MapView, ReplanReady, ReplanWanted
from planner import MovingSphere, PlannerError, PointCloud, VoxelGrid, World, plan
from planner.errors import EndpointError, StartInCollision
from planner.replan import Flight, Kind, Replanner, Settings
from planner.voxels import MARGIN

CROP, FAR_CROP = 9.0, 15.0
"""Cells farther than this from the vehicle are left out [m], where time is short and where it is not."""
AWAY, AWAY_DIRECTIONS, AWAY_SPARE = (0.1, 0.2, 0.3, 0.45, 0.6), 16, 0.03
"""A vehicle that rests too near to something steps out of it: how far [m], in how many directions, to spare [m]."""
RIM = int(MARGIN)
"""Free cells kept around the taken ones: outside its lattice a field tells less."""


class ReplanDesk:
    """Parameters
    ----------
    world : what is known beforehand.
    """

    def __init__(self, world: World) -> None:
        self._known = world
        self._world = world
        self._replanner: Replanner | None = None
        self._goal: tuple[float, float, float] | None = None
        self._base_us = 0

    def answer(self, wanted: ReplanWanted) -> ReplanReady:
        """What to fly; a planner's refusal is an answer too."""
        try:
            if wanted.map is not None:
                reach = FAR_CROP if wanted.cold else CROP
                self._world = with_cells(self._known, wanted.map, _place(wanted), reach)
            return self._from_scratch(wanted) if wanted.cold else self._decide(wanted)
        except (PlannerError, ValueError) as error:
            reason = f"{type(error).__name__}: {error}"
            return ReplanReady(wanted.request_id, "failed", None, False, float("nan"), None, reason)

    def _decide(self, wanted: ReplanWanted) -> ReplanReady:
        replanner = self._replanner
        if wanted.fresh or replanner is None:
            replanner = self._anew(wanted)
        elif wanted.map is not None:
            replanner.remap(self._world)
        said = ""
        if wanted.goal_m != self._goal:
            try:
                replanner.retarget(wanted.goal_m)
                self._goal = wanted.goal_m
            except EndpointError as error:
                said = str(error)
        before = replanner.flight
        decision = replanner.step(self._seconds(wanted.now_us), [self._moved(m) for m in wanted.movers])
        flight = decision.flight
        leads = flight.to_goal and self._goal == wanted.goal_m  # else to where it led before: a stop
        flown = None if flight.trajectory is before.trajectory else replace(self._flown(flight), to_goal=leads)
        return ReplanReady(
            request_id=wanted.request_id,
            kind=decision.kind.value,
            flown=flown,
            certified=decision.certified and decision.kind is not Kind.NONE,
            clearance=decision.clearance,
            backup=None if decision.backup is None else self._flown(decision.backup),
            reason=f"{decision.reason}; {said}" if said else decision.reason,
        )

    def _anew(self, wanted: ReplanWanted) -> Replanner:
        """A replanner that begins with what is flown; one at a stop keeps its way to the goal."""
        old, goal = self._replanner, self._goal
        settings = Settings(
            latency_s=(wanted.switch_us - wanted.now_us) / 1e6, period_s=wanted.period_us / 1e6, cold=False
        )
        keeps = old is not None and not wanted.flown.to_goal and goal == wanted.goal_m and old.limits == wanted.limits
        if old is not None and keeps and old.radius == wanted.radius and old.settings == settings:
            old.remap(self._world)
            old.flight = Flight(wanted.flown.trajectory, self._seconds(wanted.flown.start_us), to_goal=False)
            return old
        self._base_us = wanted.now_us
        flown, start_s = wanted.flown, self._seconds(wanted.flown.start_us)
        replanner = Replanner(self._world, wanted.limits, wanted.radius, flown.trajectory, start_s, settings)
        replanner.flight = Flight(flown.trajectory, start_s, flown.to_goal)
        self._replanner = replanner
        self._goal = wanted.goal_m if flown.to_goal else None
        return replanner

    def _from_scratch(self, wanted: ReplanWanted) -> ReplanReady:
        s = wanted.flown.trajectory.state((wanted.switch_us - wanted.flown.start_us) / 1e6)
        try:
            made = plan(self._world, s.position, wanted.goal_m, wanted.limits, wanted.radius, seed=wanted.seed)
        except StartInCollision:
            away = self._retreat(wanted, s.position)
            if away is None:
                raise
            return away
        if not made.certified:
            raise ValueError("what was found is not proved")
        flown = Flown(made.trajectory, wanted.switch_us)
        return ReplanReady(wanted.request_id, Kind.SWITCH.value, flown, True, made.clearance, None, "from scratch")

    def _retreat(self, wanted: ReplanWanted, start: FloatArray) -> ReplanReady | None:
        """A little way straight out of the radius of what is near, never nearer to anything on it; None without one.

        The nearest of some places around that keep the radius, level with the start.
        """
        world, radius = self._world, wanted.radius + AWAY_SPARE
        share = np.linspace(0.0, 1.0, 11)[:, None]
        here = float(world.distance(start[None])[0])
        for step in AWAY:
            for k in range(AWAY_DIRECTIONS):
                angle = 2.0 * math.pi * k / AWAY_DIRECTIONS
                end = start + step * np.array([math.cos(angle), math.sin(angle), 0.0])
                distance = world.distance(start + share * (end - start))
                if distance[-1] < radius or distance.min() < here - 0.01 or world.wall_distance(end[None])[0] < radius:
                    continue
                made = plan(World(world.bounds, ()), start, end, wanted.limits, 0.0)
                flown = Flown(made.trajectory, wanted.switch_us, to_goal=False)
                return ReplanReady(wanted.request_id, Kind.BACKUP.value, flown, True, here, None, "out of the radius")
        return None

    def _seconds(self, at_us: int) -> float:
        return (at_us - self._base_us) / 1e6

    def _moved(self, mover: MovingSphere) -> MovingSphere:
        base_s = self._base_us / 1e6
        return replace(mover, stamp=mover.stamp - base_s, until=mover.until - base_s)

    def _flown(self, flight: Flight) -> Flown:
        return Flown(flight.trajectory, self._base_us + round(flight.start_s * 1e6), flight.to_goal)


def with_cells(known: World, seen: MapView, centre: FloatArray, reach: float) -> World:
    """The known world and the taken cells within `reach` of a point [m] in the plane, as one.

    Where the known world has voxels itself, the cells are put on their lattice, each covering what it touches.
    """
    if not len(seen.runs):
        return known
    origin, size = np.array(seen.origin), seen.resolution
    low, high = np.array(known.bounds)
    lattice = next((o for o in known.obstacles if isinstance(o, VoxelGrid | PointCloud)), None)
    base, edge = (origin, size) if lattice is None else (np.array(lattice.origin), lattice.resolution)
    runs = seen.runs.astype(np.float64)
    corners = [origin + size * np.column_stack((runs[:, 0], runs[:, 1], runs[:, 2]))]
    corners.append(origin + size * np.column_stack((runs[:, 0] + 1.0, runs[:, 1] + 1.0, runs[:, 3])))
    near = np.abs(0.5 * (corners[0] + corners[1]) - centre)[:, :2].max(axis=1) <= reach
    near &= (corners[0][:, :2] < high[:2]).all(axis=1) & (corners[1][:, :2] > low[:2]).all(axis=1)
    near &= (corners[0][:, 2] < high[2]) & (corners[1][:, 2] > low[2])
    if not near.any():
        return known
    first = np.floor((np.maximum(corners[0][near], low) - base) / edge + 1e-6).astype(np.int64)
    last = np.ceil((np.minimum(corners[1][near], high) - base) / edge - 1e-6).astype(np.int64)
    rim = np.array([RIM, RIM, 0 if (first[:, 2] == first[0, 2]).all() else RIM])
    least = first.min(axis=0) - rim
    occupied = np.zeros(tuple((last.max(axis=0) + rim - least).tolist()), dtype=np.bool_)
    for (i, j, k), (i1, j1, k1) in zip((first - least).tolist(), (last - least).tolist(), strict=True):
        occupied[i:i1, j:j1, k:k1] = True
    x, y, z = (base + edge * least).tolist()
    return World(known.bounds, (*known.obstacles, VoxelGrid(occupied, (x, y, z), edge)))


def _place(wanted: ReplanWanted) -> FloatArray:
    at = (wanted.switch_us - wanted.flown.start_us) / 1e6
    place: FloatArray = wanted.flown.trajectory.position(at)
    return place
