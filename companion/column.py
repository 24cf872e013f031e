"""The column of a climb or a landing: what moves is to be out of it for as long as the vehicle is."""

import math

import numpy as np

from companion.mission import Mission
from companion.seam import FloatArray
from companion.seeing.tracks import Tracks

COLUMN_S, COLUMN_GROWTH = 3.0, 0.1
"""Beside climb or descent itself its column is to be clear for so long [s]; a mover's uncertainty there [m/s]."""
DESCENT = 0.5
"""A slow landing [m/s]."""


def climb_crossed_s(mission: Mission, tracks: Tracks, flight_us: int) -> float:
    """As `crossed_s`, for the climb."""
    climb = mission.steps[0].takeoff
    top = 0.0 if climb is None else climb.altitude
    north, east, _ = mission.start_m()
    return crossed_s(mission, tracks, flight_us, north, east, -top, top / mission.limits.climb)


def landing_crossed_s(mission: Mission, tracks: Tracks, flight_us: int, place: FloatArray) -> float:
    """As `crossed_s`, for the landing from a place (3,)."""
    north, east, top = place.tolist()
    return crossed_s(mission, tracks, flight_us, north, east, top, -top / DESCENT)


def crossed_s(
    mission: Mission, tracks: Tracks, flight_us: int, north: float, east: float, top: float, takes_s: float
) -> float:
    """When a mover comes too near to the column from the height `top` (down) to the ground [s]; inf: not soon.

    The world's bounds are walls: what gets to one is taken to come back from it.
    """
    low, high = mission.planner_world().walls
    ahead = np.arange(0.0, COLUMN_S + takes_s, 0.1)
    soonest = math.inf
    for mover in tracks.movers():
        age = flight_us / 1e6 - mover.stamp + ahead
        straight = np.array(mover.centre) + age[:, None] * np.array(mover.velocity)
        for way in (straight, _folded(straight, low + mover.radius, high - mover.radius)):
            foot = np.column_stack((np.full((len(way), 1), north), np.full(len(way), east), way[:, 2].clip(top, 0.0)))
            near = mission.seen_radius() + mover.radius + COLUMN_GROWTH * ahead
            met = np.flatnonzero(((way - foot) ** 2).sum(axis=1) < near**2)
            soonest = min(soonest, float(ahead[met[0]]) if len(met) else math.inf)
    return soonest


def _folded(points: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Places (m, 3) on a straight way, reflected by the walls of a block; as they are where the block has no room."""
    room = high - low
    with np.errstate(invalid="ignore", divide="ignore"):
        u = np.abs((points - low) % (2.0 * room))
    folded: FloatArray = np.where(room > 0.0, low + np.minimum(u, 2.0 * room - u), points)
    return folded
