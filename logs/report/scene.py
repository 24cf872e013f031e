"""The flight in space: path, truth, reference, plans, what moved, and where it came nearest to something."""

import math
from collections.abc import Sequence

import numpy as np
from scipy.interpolate import BSpline

from logs.report import contract as c
from logs.report.columns import FloatArray, short
from logs.report.flight import Flight, Motion, on_the_map
from logs.report.part import Surroundings
from logs.report.tracking import off_reference
from logs.schema import PlanReady, ReplanReady, ReplanWanted

MOST_PLANS = 300
"""Ways shown; of more the first of each stretch of time."""
PLAN_POINTS = 40
MOST_MOVERS = 400
MOST_SHAPES = 2000
NEARBY_M = 200.0
"""Who never comes so near is not shown."""
UNTOLD_M = 0.5
"""Radius of what nobody tells the size of."""
LOST_S = 2.0
"""A ball not told of for so long is another one when it is told of again."""
NEAR_M = 1.5
"""A ball this near to where one was expected is that one."""


def scene_of(flight: Flight, around: Surroundings) -> tuple[c.Scene, Motion, FloatArray]:
    """The scene; and along the flight (by truth where it is told) what the clearance was (n,) [m]."""
    motion = flight.truth if len(flight.truth.t) else flight.flown
    aloft = flight.when(motion, flight.aloft)
    movers = _movers(flight)
    clearance = _clearance(aloft, around, movers)
    least = None
    if np.isfinite(clearance).any():
        k = int(np.nanargmin(clearance))
        place = aloft.position[k] * [1.0, 1.0, -1.0]
        least = (float(aloft.t[k]), (float(place[0]), float(place[1]), float(place[2])), float(clearance[k]))
    scene = c.Scene(
        path=_path(flight),
        obstacles=(*around.obstacles, *mirrored(flight, seen_only=bool(around.obstacles or around.bounds))),
        bounds=around.bounds,
        fence=around.fence,
        truth=_track(flight.truth) if len(flight.truth.t) else None,
        reference=_track(flight.reference) if len(flight.reference.t) else None,
        plans=_plans(flight),
        movers=tuple(movers),
        least=least,
    )
    return scene, aloft, clearance


def _track(motion: Motion) -> c.Track:
    t, n, e, u = short(motion.t, motion.position[:, 0], motion.position[:, 1], -motion.position[:, 2])
    return c.Track(t, n, e, u)


def _path(flight: Flight) -> c.Track:
    """Where it flew by its own word, with attitude and error where they are known."""
    motion, a = flight.flown, flight.attitude
    if not len(motion.t):
        motion = flight.truth
    error = np.full(len(motion.t), np.nan)
    if flight.tracked is not None and len(flight.reference.t):
        inside = (motion.t >= flight.tracked[0]) & (motion.t <= flight.tracked[1])
        error = np.where(inside, np.linalg.norm(off_reference(flight, motion), axis=1), np.nan)
    columns = [motion.position[:, 0], motion.position[:, 1], -motion.position[:, 2]]
    if len(a):
        columns += [np.interp(motion.t, a[:, 0], np.unwrap(a[:, k])) for k in (1, 2, 3)]
    t, n, e, u, *rest = short(motion.t, *columns, error)
    angles = rest[:3] if len(a) else [None, None, None]
    known = rest[-1] if np.isfinite(rest[-1]).any() else None
    return c.Track(t, n, e, u, angles[0], angles[1], angles[2], known)


def _plans(flight: Flight) -> tuple[c.Way, ...]:
    ways: list[c.Way] = []
    records = flight.traffic.records
    for t, _, plan in records.get(PlanReady, []):
        curve = curve_of(plan.control_points, plan.knots, 2 * PLAN_POINTS) if plan.ok else None
        if curve is not None:
            ways.append(c.Way(flight.s(t), curve))
    ways = ways[:MOST_PLANS]
    again = [(t, r) for t, _, r in records.get(ReplanReady, []) if r.kind in ("switch", "backup") and r.knots]
    every = max(1, -(-len(again) // MOST_PLANS))
    for t, replan in again[::every]:
        curve = curve_of(replan.control_points, replan.knots, PLAN_POINTS)
        if curve is not None:
            ways.append(c.Way(flight.s(t), curve, "switch" if replan.kind == "switch" else "backup"))
    return tuple(sorted(ways, key=lambda way: way.t))


def curve_of(points: Sequence[float], knots: Sequence[float], count: int) -> FloatArray | None:
    """(count, 3) north, east, up along a cubic B-spline of NED control points; None where they make none."""
    if len(knots) < 8 or len(points) != 3 * (len(knots) - 4) or not np.isfinite([*points, *knots]).all():
        return None
    if (np.diff(knots) < 0).any() or knots[-4] <= knots[3]:
        return None
    spline = BSpline(np.array(knots), np.array(points).reshape(-1, 3), 3)
    curve: FloatArray = spline(np.linspace(knots[3], knots[-4], count)) * [1.0, 1.0, -1.0]
    return curve


def _movers(flight: Flight) -> list[c.Mover]:
    """What moves: as it told of itself, else as the planner reckoned with it."""
    return _told_movers(flight) or _reckoned_movers(flight)


def _told_movers(flight: Flight) -> list[c.Mover]:
    """Aircraft near the path by their ADSB_VEHICLE; as great as the planner took them to be."""
    rows = flight.traffic.told(246)
    m = rows["m"]
    known = (m["flags"] & 3) == 3  # ADSB_FLAGS_VALID_COORDS and ADSB_FLAGS_VALID_ALTITUDE
    rows, m = rows[known], m[known]
    if not len(rows) or not len(flight.flown.t):
        return []
    places = on_the_map(flight, m["lat"] / 1e7, m["lon"] / 1e7, m["altitude"] / 1e3)
    if places is None:
        return []
    wanted = [w.movers for _, _, w in flight.traffic.records.get(ReplanWanted, [])]
    radii = [movers[k + 6] for movers in wanted for k in range(0, len(movers) - 9, 10)]
    radius = float(np.median(radii)) if radii else UNTOLD_M
    t = flight.times(rows)
    movers = []
    for address in np.unique(m["ICAO_address"])[:MOST_MOVERS]:
        its = m["ICAO_address"] == address
        away = np.linalg.norm(places[its] - flight.flown.at(t[its]), axis=1)
        if its.sum() < 2 or not (away < NEARBY_M).any():
            continue
        name = m["callsign"][its][0].decode("ascii", "replace").strip() or f"{address:06x}"
        place = places[its]
        track = short(t[its], place[:, 0], place[:, 1], -place[:, 2], most=5000)
        movers.append(c.Mover(name, radius, c.Track(*track)))
    return movers


def _reckoned_movers(flight: Flight) -> list[c.Mover]:
    """Balls the planner reckoned with, put together by where each was expected."""
    tracks: list[list[tuple[float, float, float, float, float]]] = []  # t, n, e, d, radius
    velocity: list[tuple[float, float, float]] = []
    for t_ns, _, wanted in flight.traffic.records.get(ReplanWanted, []):
        t, now_s = flight.s(t_ns), wanted.now_us / 1e6
        there = [(i, tracks[i][-1]) for i in range(len(tracks)) if t - tracks[i][-1][0] < LOST_S]
        taken: set[int] = set()
        for k in range(0, len(wanted.movers) - 9, 10):
            x, y, z, u, v, w, radius, _, stamp, _ = wanted.movers[k : k + 10]
            age = now_s - stamp if abs(now_s - stamp) < LOST_S else 0.0
            centre = (x + u * age, y + v * age, z + w * age)
            best, nearest = -1, NEAR_M
            for i, last in there:
                ahead = t - last[0]
                expected = [p + q * ahead for p, q in zip(last[1:4], velocity[i], strict=True)]
                gap = math.dist(expected, centre)
                if i not in taken and gap < nearest:
                    best, nearest = i, gap
            if best < 0:
                if len(tracks) >= MOST_MOVERS:
                    continue
                best = len(tracks)
                tracks.append([])
                velocity.append((u, v, w))
            taken.add(best)
            velocity[best] = (u, v, w)
            tracks[best].append((t, *centre, radius))
    movers = []
    for i, track in enumerate(tracks):
        if len(track) > 1:
            rows = np.array(track)
            times, n, e, u = short(rows[:, 0], rows[:, 1], rows[:, 2], -rows[:, 3], most=5000)
            movers.append(c.Mover(f"mover {i + 1}", float(np.median(rows[:, 4])), c.Track(times, n, e, u)))
    return movers


def _clearance(motion: Motion, around: Surroundings, movers: list[c.Mover]) -> FloatArray:
    """Distance of the hull to the nearest obstacle or ball at each sample; NaN where there is none."""
    found = np.full(len(motion.t), np.inf)
    if not len(motion.t):
        return found
    if around.clearance is not None:
        found = np.minimum(found, around.clearance(motion.position))
    for mover in movers if around.radius else []:
        track = mover.track
        place = [np.interp(motion.t, np.asarray(track.t), np.asarray(column), left=np.nan, right=np.nan)
                 for column in (track.n, track.e, track.u)]  # fmt: skip
        gap = np.linalg.norm(np.stack(place, axis=1) - motion.position * [1.0, 1.0, -1.0], axis=1)
        found = np.fmin(found, gap - mover.radius - around.radius)
    return np.where(np.isfinite(found), found, np.nan)


def mirrored(flight: Flight, seen_only: bool = False) -> tuple[c.Json, ...]:
    """What stands about by the recording's SceneUpdates (east, north, up), each thing as it was last told.

    `seen_only`: what the vehicle saw on its way; for where the mission itself tells the rest.
    """
    solids: dict[str, list[c.Json]] = {}
    for _, update in flight.traffic.mirrors:
        for entity in update.entities:
            kind = next((pair.value for pair in entity.metadata if pair.key == "kind"), "")
            if kind in ("mover", "bounds", "fence") or (seen_only and entity.id != "seen"):
                continue
            shapes: list[c.Json] = []
            for cube in entity.cubes:
                p, s = cube.pose.position, cube.size
                low = (p.y - s.y / 2, p.x - s.x / 2, p.z - s.z / 2)
                shapes.append(c.box(low, (p.y + s.y / 2, p.x + s.x / 2, p.z + s.z / 2), entity.id))
            for cylinder in entity.cylinders:
                p, s = cylinder.pose.position, cylinder.size
                shapes.append(c.cylinder((p.y, p.x, p.z - s.z / 2), s.x / 2, s.z, entity.id))
            for ball in entity.spheres:
                p = ball.pose.position
                shapes.append(c.sphere((p.y, p.x, p.z), ball.size.x / 2, entity.id))
            solids[entity.id] = shapes[:MOST_SHAPES]
    return tuple(shape for shapes in solids.values() for shape in shapes)[: 10 * MOST_SHAPES]
