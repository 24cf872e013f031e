"""Movers that tell nothing of themselves: small things in the rings of the obstacle sensor, followed from scan to scan.

    cluster   neighbouring hits of a ring that are near to one another, together small, with something farther (or
              nothing) on either side: a thing that stands by itself, not a piece of wall behind something
    track     a Kalman filter of place and velocity over ground, of constant velocity and white acceleration; across the
              ray a ring is known as finely as its sectors are wide, along it much better
    mover     a track seen in `CONFIRMED` scans that has gone `MOVED` and whose speed is surely not nothing

    x = [north east v_north v_east],  F = [I dt I; 0 I],  Q = q [dt^3/3 dt^2/2; dt^2/2 dt] (x) I,  H = [I 0]

(Bar-Shalom, Li & Kirubarajan, Estimation with Applications to Tracking and Navigation, 2001, 6.2.2.) Nothing is known
of what a thing does in height: it is held to stay in that of its hits. What a mover was taken for before it was one,
cells of the map along its way, is forgotten.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from companion.seam import FloatArray, Vector
from companion.seeing.rollingmap import RollingMap
from companion.seeing.sensing import Scan
from companion.seeing.tracks import Tracks

SEEN = 0x2000000
"""Added to a track's number it is its address, beyond ADSB_VEHICLE's and the fleet's."""
TOGETHER, WIDEST = 0.5, 1.4
"""Hits so near to the next are of one thing, and a thing is no wider [m]."""
BEHIND = 0.6
"""What is beside a thing is so much farther [m]."""
FARTHEST = 12.0
"""Beyond it a ring is too coarse [m]."""
MOST, MOST_WAKE = 32, 20
SPARE = 0.3
"""Added to the radius of what tells of neither its size nor its height [m]."""
AROUND = 0.2
"""Cells this near to where a mover was are of its wake [m]."""
ALONG, SWAY = 0.12, 0.5
"""1 sigma of a place along the ray [m]; white acceleration [m/s^2/sqrt(Hz)]."""
FASTEST = 3.0
"""1 sigma of a speed that is not known yet [m/s]."""
GATE = 13.8
"""Of the squared Mahalanobis distance, two dimensions: 0.1 % of what belongs lies outside."""
CONFIRMED, SURELY, MOVED = 5, 2.5, 0.4
"""Scans, of its own sigma a speed, and how far from where it was seen first [m]: the end of a wall must not do."""
SLOWEST = 0.4
"""What is slower stands [m/s]."""
DOUBTED_US, LOST_US = 350_000, 1_000_000
"""Unseen for so long it is forgotten: before it is a mover, and after."""


@dataclass(slots=True)
class _Thing:
    number: int
    x: FloatArray  # (4,)
    P: FloatArray  # (4, 4)
    z: float
    at_us: int  # of x
    seen_us: int
    since_us: int  # when it was seen first
    began: FloatArray  # (2,) where
    seen: int = 1
    moves: bool = False
    wake: list[FloatArray] = field(default_factory=list)  # (2,) where it was seen before it was taken to move

    def ahead(self, at_us: int) -> None:
        """Carry it on to a time."""
        dt = (at_us - self.at_us) / 1e6
        if dt <= 0.0:
            return
        F = np.eye(4)
        F[0, 2] = F[1, 3] = dt
        q = SWAY**2
        Q = np.zeros((4, 4))
        for i in (0, 1):
            Q[i, i], Q[i, i + 2], Q[i + 2, i], Q[i + 2, i + 2] = q * dt**3 / 3, q * dt**2 / 2, q * dt**2 / 2, q * dt
        self.x, self.P, self.at_us = F @ self.x, F @ self.P @ F.T + Q, at_us

    def off(self, place: FloatArray, R: FloatArray) -> float:
        """The squared Mahalanobis distance of a place."""
        gap = place - self.x[:2]
        return float(gap @ np.linalg.solve(self.P[:2, :2] + R, gap))

    def see(self, place: FloatArray, R: FloatArray, z: float) -> None:
        """Take in a place."""
        K = self.P[:, :2] @ np.linalg.inv(self.P[:2, :2] + R)
        self.x = self.x + K @ (place - self.x[:2])
        self.P = self.P - K @ self.P[:2, :]
        self.z += 0.3 * (z - self.z)
        self.seen, self.seen_us = self.seen + 1, self.at_us

    def judge(self) -> None:
        """Whether it moves."""
        v = self.x[2:]
        speed = float(np.hypot(v[0], v[1]))
        if self.moves or speed < 1e-6:
            self.moves = self.moves and speed > 0.5 * SLOWEST
            return
        sigma = math.sqrt(float(v @ self.P[2:, 2:] @ v)) / speed
        away = float(np.hypot(*(self.x[:2] - self.began)))
        self.moves = self.seen >= CONFIRMED and speed > max(SLOWEST, SURELY * sigma) and away > MOVED


class Following:
    """Attributes
    ----------
    count : of things that are followed.
    """

    def __init__(self, tracks: Tracks, seen_map: RollingMap, radius: float) -> None:
        self._tracks, self._map, self._radius = tracks, seen_map, radius
        self._things: list[_Thing] = []
        self._number = 0

    @property
    def count(self) -> int:
        return len(self._things)

    def forget(self) -> None:
        """Nothing is followed any more: the frame has moved."""
        for thing in self._things:
            self._tracks.drop(SEEN + thing.number)
        self._things.clear()

    def look(self, at_us: int, scan: Scan, unknown: FloatArray) -> None:
        """A ring: its `unknown` distances are of nothing that is known; what moves goes into the tracks."""
        for known in self._things:
            known.ahead(at_us)
        free = list(self._things)
        for place, R, z in clusters(scan, unknown, self._radius):
            near = [(thing.off(place, R), thing) for thing in free]
            off, thing = min(near, key=lambda pair: pair[0]) if near else (math.inf, None)
            if thing is not None and off < GATE:
                free.remove(thing)
                thing.see(place, R, z)
                thing.judge()
                thing.wake = [*thing.wake[1 - MOST_WAKE :], thing.x[:2].copy()]
                if thing.moves:  # what it has left in the map is not there any more
                    self._map.forget_around(np.array(thing.wake), self._radius + AROUND, thing.since_us)
                    thing.wake.clear()
            elif len(self._things) < MOST:
                self._number = self._number % 0xFFFFFF + 1
                P = np.zeros((4, 4))
                P[:2, :2], P[2, 2], P[3, 3] = R, FASTEST**2, FASTEST**2
                x = np.array([*place, 0.0, 0.0])
                self._things.append(_Thing(self._number, x, P, z, at_us, at_us, at_us, place))
        kept = []
        for thing in self._things:
            address = SEEN + thing.number
            if at_us - thing.seen_us <= (LOST_US if thing.moves else DOUBTED_US):
                kept.append(thing)
            else:
                thing.moves = False
            if not thing.moves:
                self._tracks.drop(address)
            elif thing.seen_us == at_us:
                place3: Vector = (float(thing.x[0]), float(thing.x[1]), thing.z)
                going: Vector = (float(thing.x[2]), float(thing.x[3]), 0.0)
                self._tracks.told(at_us, address, place3, going, self._radius + SPARE)
        self._things = kept


def clusters(scan: Scan, unknown: FloatArray, radius: float) -> list[tuple[FloatArray, FloatArray, float]]:
    """Things that stand by themselves in a ring: middle (2,) [m], its covariance (2, 2), height (down) [m].

    Parameters
    ----------
    unknown : (k,) distances as in the scan, NaN where the hit is on something known.
    radius : a thing is taken to be so large: its middle is behind what is seen of it.
    """
    said, n = scan.distance, len(scan.distance)
    hit = np.isfinite(said)
    if n < 8 or not hit.any():
        return []
    points = scan.position_m + scan.directions * np.where(hit, said, 0.0)[:, None]
    step = np.linalg.norm(points - np.roll(points, -1, axis=0), axis=1)
    joined = hit & np.roll(hit, -1) & (step < TOGETHER + 0.05 * np.where(hit, said, 0.0))  # i and i + 1
    first = np.flatnonzero(hit & ~np.roll(joined, 1))
    found = []
    wide = 2.0 * math.pi / n
    for i in first.tolist():
        length = 1
        while length < n and joined[(i + length - 1) % n]:
            length += 1
        mine = np.arange(i, i + length) % n
        before, beyond = float(said[i - 1]), float(said[(i + length) % n])
        nearest = float(said[mine].min())
        alone = before > said[mine[0]] + BEHIND and beyond > said[mine[-1]] + BEHIND  # False where not known
        extent = float(np.linalg.norm(points[mine[0]] - points[mine[-1]]))
        if not alone or nearest > FARTHEST or extent > WIDEST or np.isnan(unknown[mine]).any():
            continue
        middle = points[mine].mean(axis=0)
        along = middle[:2] - scan.position_m[:2]
        away = float(np.hypot(along[0], along[1]))
        if away < 0.1:
            continue
        along = along / away
        across = np.array([-along[1], along[0]])
        sigma = 0.05 + 0.35 * wide * away
        R = ALONG**2 * np.outer(along, along) + sigma**2 * np.outer(across, across)
        found.append((middle[:2] + 0.6 * radius * along, R, float(middle[2])))
    return found
