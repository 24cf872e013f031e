"""Obstacles that move: predicted at constant velocity, their size growing with what is not known, proved to be missed.

A mover at constant velocity w is a solid at rest in its own frame, and there the vehicle flies C(t) - w (t - t_0). That
is a cubic spline on the same knots, since t itself is one, with the Greville abscissae as control points (by Marsden's
identity: de Boor, A Practical Guide to Splines, ch. IX),

    t = sum_i N_i(t) xi_i,  xi_i = (u_{i+1} + u_{i+2} + u_{i+3})/3,  so  C(t) - w (t - t_0)  has  P_i - w (xi_i - t_0).

A Bezier piece on [a, b] is the special case xi = a, (2a + b)/3, (a + 2b)/3, b. On such a piece the mover is nowhere
larger than at the end that lies farther from t_0, so a bound on the distance to a solid of that size at rest holds for
all of the piece; it is the one of `certificate`, and an undecided piece is halved, which halves its time too.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from planner.bspline import DEGREE, FloatArray, bezier_pieces
from planner.certificate import MARGIN
from planner.distance import BOX, SPHERE
from planner.jit import kernel, leaf
from planner.worlds import Point, as_point

MOST_MOVERS = 10_000
"""Movers that one question may name."""
FASTEST, LONGEST = 1e4, 1e6
"""Bounds on a mover's speed and growth [m/s] and on its size [m]: far above any, and products stay exact enough."""
MOST_PIECES = 20_000
"""That a trajectory may be cut into for the proof against one mover, those that it has already apart."""
DEEPEST = 40
SAMPLES = 6
"""Looks at each span before its proof, so that what is hit is soon known."""

KIND, CENTRE, HALF, VELOCITY, GROWTH, STAMP, UNTIL = 0, 1, 4, 7, 10, 11, 12
"""Columns of the table that kernels read; a sphere's radius stands in HALF alone."""
WIDTH = 13


def _number(name: str, value: float, most: float, least: float = 0.0) -> float:
    if not least <= value <= most:
        raise ValueError(f"{name}: expected a number from {least:g} to {most:g}, found {value}")
    return float(value)


def _moving(self: "MovingSphere | MovingBox") -> None:
    object.__setattr__(self, "velocity", as_point("mover velocity", self.velocity))
    for axis in range(3):
        _number("mover velocity", abs(self.velocity[axis]), FASTEST)
    object.__setattr__(self, "growth", _number("mover growth", self.growth, FASTEST))
    object.__setattr__(self, "stamp", _number("mover stamp", self.stamp, np.finfo(np.float64).max, -np.inf))
    if not (math.isfinite(self.stamp) and self.until >= self.stamp):
        raise ValueError(f"mover until: expected at least its stamp {self.stamp}, found {self.until}")
    object.__setattr__(self, "until", float(self.until))


@dataclass(frozen=True, slots=True)
class MovingSphere:
    """A ball seen at `stamp`, predicted to go on at `velocity`.

    Its radius is radius + growth |t - stamp|: growth [m/s] is how fast the prediction loses track. After `until`
    nothing is predicted, and nothing is claimed. Times are those of the trajectory, or of the clock that its start is
    told in.

    Raises
    ------
    ValueError : a number that is not finite, negative, or beyond FASTEST or LONGEST; `until` before `stamp`.
    """

    centre: Point  # at `stamp` [m]
    velocity: Point  # [m/s]
    radius: float  # [m]
    growth: float = 0.0  # [m/s]
    stamp: float = 0.0  # [s]
    until: float = math.inf  # [s]

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre", as_point("mover centre", self.centre))
        object.__setattr__(self, "radius", _number("mover radius", self.radius, LONGEST))
        _moving(self)

    def packed(self) -> tuple[float, ...]:
        """The row that the kernels read."""
        size = (self.radius, 0.0, 0.0)
        return (SPHERE, *self.centre, *size, *self.velocity, self.growth, self.stamp, self.until)


@dataclass(frozen=True, slots=True)
class MovingBox:
    """An axis-aligned box seen at `stamp`; like MovingSphere, each half extent growing with `growth`.

    Raises
    ------
    ValueError : as MovingSphere; lower < upper fails on an axis.
    """

    lower: Point  # at `stamp` [m]
    upper: Point
    velocity: Point  # [m/s]
    growth: float = 0.0  # [m/s]
    stamp: float = 0.0  # [s]
    until: float = math.inf  # [s]

    def __post_init__(self) -> None:
        object.__setattr__(self, "lower", as_point("mover lower", self.lower))
        object.__setattr__(self, "upper", as_point("mover upper", self.upper))
        for a, b in zip(self.lower, self.upper, strict=True):
            if not a < b <= a + 2.0 * LONGEST:
                raise ValueError(f"mover box: expected lower < upper on every axis, found {self.lower}, {self.upper}")
        _moving(self)

    def packed(self) -> tuple[float, ...]:
        """The row that the kernels read."""
        centre = tuple((a + b) / 2 for a, b in zip(self.lower, self.upper, strict=True))
        half = tuple((b - a) / 2 for a, b in zip(self.lower, self.upper, strict=True))
        return (BOX, *centre, *half, *self.velocity, self.growth, self.stamp, self.until)


Mover = MovingSphere | MovingBox


def table(movers: Sequence[Mover] | None) -> FloatArray:
    """Movers as the kernels read them, (k, WIDTH); None is none.

    Raises
    ------
    ValueError : more than MOST_MOVERS of them, or something else than a mover (its index is named).
    TypeError : no sequence.
    """
    if movers is None:
        movers = ()
    if not isinstance(movers, Sequence):
        raise TypeError(f"movers: expected a sequence of MovingSphere and MovingBox, found {movers!r}")
    if len(movers) > MOST_MOVERS:
        raise ValueError(f"movers: expected at most {MOST_MOVERS}, found {len(movers)}")
    for index, mover in enumerate(movers):
        if not isinstance(mover, MovingSphere | MovingBox):
            raise ValueError(f"mover {index}: expected a MovingSphere or a MovingBox, found {mover!r}")
    return np.array([mover.packed() for mover in movers], dtype=np.float64).reshape(-1, WIDTH)


@leaf
def grown_distance(
    m: FloatArray, k: int, grown: float, x: float, y: float, z: float
) -> tuple[float, float, float, float]:
    """(d, gx, gy, gz): signed distance to mover k, grown by `grown` [m], from a point (x, y, z) relative to its centre.

    Convex, with a unit subgradient, like `distance.solid_distance`.
    """
    if m[k, 0] == SPHERE:
        r = math.sqrt(x * x + y * y + z * z)
        if r > 0.0:
            return r - m[k, 4] - grown, x / r, y / r, z / r
        return -m[k, 4] - grown, 1.0, 0.0, 0.0
    sx, sy, sz = math.copysign(1.0, x), math.copysign(1.0, y), math.copysign(1.0, z)
    qx, qy, qz = abs(x) - m[k, 4] - grown, abs(y) - m[k, 5] - grown, abs(z) - m[k, 6] - grown
    if qx <= 0.0 and qy <= 0.0 and qz <= 0.0:
        if qx >= qy and qx >= qz:
            return qx, sx, 0.0, 0.0
        if qy >= qz:
            return qy, 0.0, sy, 0.0
        return qz, 0.0, 0.0, sz
    qx, qy, qz = max(qx, 0.0), max(qy, 0.0), max(qz, 0.0)
    d = math.sqrt(qx * qx + qy * qy + qz * qz)
    return d, sx * qx / d, sy * qy / d, sz * qz / d


@leaf
def mover_distance(m: FloatArray, k: int, t: float, x: float, y: float, z: float) -> tuple[float, float, float, float]:
    """(d, gx, gy, gz) of a point to mover k as predicted for time t."""
    s = t - m[k, 11]
    dx, dy, dz = x - m[k, 1] - m[k, 7] * s, y - m[k, 2] - m[k, 8] * s, z - m[k, 3] - m[k, 9] * s
    d, gx, gy, gz = grown_distance(m, k, m[k, 10] * abs(s), dx, dy, dz)
    return d, gx, gy, gz


@leaf
def nearest_mover(pieces: FloatArray, times: FloatArray, m: FloatArray) -> tuple[float, int, float]:
    """(least distance, its mover, its time) on SAMPLES points of each Bezier piece; (inf, -1, 0) without any."""
    least, index, when = np.inf, -1, 0.0
    for piece in range(pieces.shape[0]):
        a, b = times[piece], times[piece + 1]
        for j in range(SAMPLES):
            s = (j + 0.5) / SAMPLES
            r, t = 1.0 - s, a + s * (b - a)
            w0, w1, w2, w3 = r * r * r, 3.0 * r * r * s, 3.0 * r * s * s, s * s * s
            q = pieces[piece]
            x = w0 * q[0, 0] + w1 * q[1, 0] + w2 * q[2, 0] + w3 * q[3, 0]
            y = w0 * q[0, 1] + w1 * q[1, 1] + w2 * q[2, 1] + w3 * q[3, 1]
            z = w0 * q[0, 2] + w1 * q[1, 2] + w2 * q[2, 2] + w3 * q[3, 2]
            for k in range(m.shape[0]):
                if t > m[k, 12]:
                    continue
                d, _, _, _ = mover_distance(m, k, t, x, y, z)
                if d < least:
                    least, index, when = d, k, t
    return least, index, when


@kernel
def prove_movers(
    pieces: FloatArray, times: FloatArray, m: FloatArray, need: float, tolerance: float
) -> tuple[float, float, int, float]:
    """(bound on the distance to every mover, least distance seen, which mover's, when).

    pieces (p, 4, 3) [m] are flown between times (p + 1,) [s]. The bound is -inf when `need` is not proved; it comes
    within `tolerance` of the least distance seen.
    """
    stack = np.empty((DEEPEST + 1, 4, 3))
    depth = np.empty(DEEPEST + 1, dtype=np.int64)
    begin, end = np.empty(DEEPEST + 1), np.empty(DEEPEST + 1)
    e = np.empty((4, 3))
    seen, index, when = nearest_mover(pieces, times, m)
    bound = np.inf
    if seen < need:
        return -np.inf, seen, index, when
    for k in range(m.shape[0]):
        wx, wy, wz, stamp, until = m[k, 7], m[k, 8], m[k, 9], m[k, 11], m[k, 12]
        cuts = 0  # counted for each mover, so that it does not matter how many others there are and in which order
        for first in range(pieces.shape[0]):
            if times[first] > until:
                break
            stack[0] = pieces[first]
            depth[0], begin[0], end[0] = 0, times[first], times[first + 1]
            top = 1
            while top > 0:
                top -= 1
                a, b, q = begin[top], end[top], stack[top]
                if a > until:
                    continue
                for j in range(4):  # the mover's own frame: xi of a Bezier piece
                    s = a + (b - a) * (j / 3.0) - stamp
                    e[j, 0] = q[j, 0] - m[k, 1] - wx * s
                    e[j, 1] = q[j, 1] - m[k, 2] - wy * s
                    e[j, 2] = q[j, 2] - m[k, 3] - wz * s
                cx = (e[0, 0] + 3.0 * (e[1, 0] + e[2, 0]) + e[3, 0]) / 8.0
                cy = (e[0, 1] + 3.0 * (e[1, 1] + e[2, 1]) + e[3, 1]) / 8.0
                cz = (e[0, 2] + 3.0 * (e[1, 2] + e[2, 2]) + e[3, 2]) / 8.0
                grown = m[k, 10] * max(abs(a - stamp), abs(b - stamp))
                d, gx, gy, gz = grown_distance(m, k, grown, cx, cy, cz)
                reach, plane = 0.0, 0.0
                for j in range(4):
                    x, y, z = e[j, 0] - cx, e[j, 1] - cy, e[j, 2] - cz
                    reach = max(reach, x * x + y * y + z * z)
                    plane = min(plane, gx * x + gy * y + gz * z)
                low = d + max(plane, -math.sqrt(reach))
                middle = 0.5 * (a + b)
                at = middle if middle <= until else a
                if middle <= until:
                    d, _, _, _ = grown_distance(m, k, m[k, 10] * abs(middle - stamp), cx, cy, cz)
                else:  # the prediction ends within the piece, and holds where this begins
                    d, _, _, _ = mover_distance(m, k, a, q[0, 0], q[0, 1], q[0, 2])
                if d < seen:
                    seen, index, when = d, k, at
                if d < need:
                    return -np.inf, seen, index, when
                if low >= max(need, seen - tolerance):
                    bound = min(bound, low)
                    continue
                if depth[top] >= DEEPEST - 1 or cuts >= MOST_PIECES:
                    return -np.inf, seen, k, at
                cuts += 1
                right = stack[top + 1]
                for i in range(3):  # de Casteljau at one half; the left half replaces q on the stack
                    b0, b1, b2, b3 = q[0, i], q[1, i], q[2, i], q[3, i]
                    m0, m1, m2 = 0.5 * (b0 + b1), 0.5 * (b1 + b2), 0.5 * (b2 + b3)
                    n0, n1 = 0.5 * (m0 + m1), 0.5 * (m1 + m2)
                    mid = 0.5 * (n0 + n1)
                    right[0, i], right[1, i], right[2, i], right[3, i] = mid, n1, m2, b3
                    q[1, i], q[2, i], q[3, i] = m0, n0, mid
                begin[top + 1], end[top + 1], end[top] = middle, b, middle
                depth[top] += 1
                depth[top + 1] = depth[top]
                top += 2
    return bound, seen, index, when


@dataclass(frozen=True, slots=True)
class MoverProof:
    """What was proved about a trajectory among movers."""

    certified: bool  # the radius is kept from every mover, as predicted, for as long as it is predicted
    distance: float  # lower bound [m], the rounding margin taken off; inf without movers, -inf when not proved
    mover: int  # index of the nearest one seen, -1 without any
    time: float  # when it is nearest, on the movers' clock [s]


def rounding(points: FloatArray, movers: FloatArray, latest: float) -> float:
    """What rounding may cost a distance to a mover [m]: MARGIN times the largest number on the way to it."""
    largest = float(np.abs(points).max())
    if len(movers):
        reach = np.abs(movers[:, VELOCITY : GROWTH + 1]).max() * np.abs(latest - movers[:, STAMP]).max()
        largest += float(np.abs(movers[:, CENTRE:VELOCITY]).max() + reach + np.abs(movers[:, STAMP]).max())
    return MARGIN * max(1.0, largest)


def certify_movers(
    control_points: FloatArray,
    knots: FloatArray,
    movers: FloatArray,
    radius: float,
    start: float = 0.0,
    hold: float = 0.0,
    tolerance: float = 1e-3,
) -> MoverProof:
    """Prove that a trajectory keeps `radius` from every mover over its duration, or say that it is not proved.

    Parameters
    ----------
    control_points, knots : (n, 3) [m], (n + 4,) [s]
    movers : (k, WIDTH)     of `table`.
    radius : float          [m].
    start : float           the movers' clock when the trajectory begins [s].
    hold : float            for how long after its end the vehicle stands there and is to be missed [s].
    tolerance : float       how far below the truth the proved distance may be [m].
    """
    pieces, times = bezier_pieces(control_points, knots), knots[DEGREE:-DEGREE] + start
    if hold > 0.0:
        pieces = np.concatenate([pieces, np.tile(control_points[-1], (1, 4, 1))])
        times = np.append(times, times[-1] + hold)
    margin = rounding(control_points, movers, float(times[-1]))
    need = radius + 2.0 * margin
    low, seen, mover, when = prove_movers(pieces, times, movers, need, tolerance)
    if low < need <= seen:  # how near it comes took too many pieces; whether it is too near may take few
        low, _, mover, when = prove_movers(pieces, times, movers, need, np.inf)
    return MoverProof(bool(low - margin >= radius), low - margin, int(mover), float(when))
