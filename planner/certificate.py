"""Proof that a whole curve keeps its distance, not only sampled points of it.

The curve is cut into Bezier pieces; a piece lies in the convex hull of its four control points b_k. With c its
middle point and d_o the signed distance to solid o, two lower bounds hold on all of the piece:

    d_o >= d_o(c) - max_k |b_k - c|              a signed distance is 1-Lipschitz
    d_o >= d_o(c) + min_k g . (b_k - c)          that of a convex solid is convex: a plane with normal g supports it

The second is exact to second order in the piece's size, so few cuts are needed. What is not convex, a notched prism or
the voxels of a field, has a third one, as good. The squared distance U^2 to any set is |p|^2 and a concave function (a
minimum of affine ones, see `field`), so at a point p = sum w_k b_k of the piece

    U(p)^2 >= sum w_k U(b_k)^2 - sum w_k |b_k - p|^2 >= min_k (U(b_k)^2 - |b_k - c|^2)

since the spread about the mean p is the least. Here any lower bound may stand for U(b_k). For voxels it is the field's
own bound, and where that does not do, the exact distance: what truly fits through a gap is proved to. Where the root is
below CANCEL of U the difference of squares has lost too many digits, and the bound is not used.

The walls of the map bound a hull by its corners. A piece that is not decided is halved (de Casteljau); a curve that
needs more than MOST_PIECES is not proved. Rounding moves no bound by more than some hundred units in the last place;
MARGIN times the largest coordinate is far above. So a curve is proved for a radius when its bounds reach `needed`, a
few margins more; an end of it has to stand off `end_needed`, a margin more again.
"""

import math
from dataclasses import dataclass

import numpy as np

from planner.bspline import FloatArray, bezier_pieces
from planner.distance import NOTCHED, PRISM, Scene, plain_distance, prism_distance
from planner.field import NEAR, Field, field_bound, field_distance
from planner.jit import kernel, leaf
from planner.worlds import World

MARGIN = 1e-11
"""Rounding margin as a fraction of the largest coordinate (double precision carries 1.1e-16)."""
CANCEL = 1e-3
"""Least share of U that the root of U^2 - |b - c|^2 may be: rounding then grows a thousandfold, still below MARGIN."""
MOST_PIECES = 20_000
DEEPEST = 40
TOLERANCE = 1e-3
"""How far below the truth a proved distance may be [m]."""


@dataclass(frozen=True, slots=True)
class Certificate:
    """What was proved about a curve. Bounds are lower bounds everywhere on it, the rounding margin taken off."""

    certified: bool  # radius kept from every solid and every wall
    obstacle_distance: float  # [m] inf in an empty world, -inf when not proved
    wall_distance: float  # [m]
    pieces: int


@leaf
def _notched_low(solids: FloatArray, edges: FloatArray, o: int, b: FloatArray, c: FloatArray) -> float:
    """The third bound for solid o on a piece b (4, 3) with middle c (3,); -inf where it says nothing."""
    least, most = np.inf, 0.0
    for k in range(4):
        d, _, _, _ = prism_distance(solids, edges, o, b[k, 0], b[k, 1], b[k, 2])
        square = max(d, 0.0) ** 2
        least, most = min(least, square - _square(b, k, c)), max(most, square)
    return math.sqrt(least) if least > CANCEL**2 * most else -np.inf


@leaf
def _field_low(field: Field, b: FloatArray, c: FloatArray, enough: float, exact: float) -> float:
    """The third bound for a field's voxels; distances below `exact` are looked up where they have to be."""
    least, most = np.inf, 0.0
    for k in range(4):
        spread = _square(b, k, c)
        d = field_distance(field, b[k, 0], b[k, 1], b[k, 2], min(math.sqrt(enough * enough + spread), exact))
        square = max(d, 0.0) ** 2
        least, most = min(least, square - spread), max(most, square)
    return math.sqrt(least) if least > CANCEL**2 * most else -np.inf


@leaf
def _square(b: FloatArray, k: int, c: FloatArray) -> float:
    """|b_k - c|^2."""
    x, y, z = b[k, 0] - c[0], b[k, 1] - c[1], b[k, 2] - c[2]
    square: float = x * x + y * y + z * z
    return square


@kernel
def prove(
    pieces: FloatArray, scene: Scene, walls: FloatArray, need: float, tolerance: float
) -> tuple[float, float, int]:
    """(bound on the distance to solids, bound on the distance to walls, pieces looked at).

    A piece is done when its bounds prove `need` and that to solids comes within `tolerance` of the least distance seen
    on the curve itself. Gives up, with both bounds -inf, at the first point of the curve that is nearer than `need`.
    """
    solids, edges, voxels = scene.solids, scene.edges, scene.field.distances.size > 0
    exact = max(2.0 * need, NEAR * scene.field.resolution)  # beyond, a field's own bound has to do
    stack = np.empty((DEEPEST + 1, 4, 3))
    depth = np.empty(DEEPEST + 1, dtype=np.int64)
    seen, wall_seen = np.inf, np.inf
    bound, wall_bound = np.inf, np.inf
    looked = 0
    c = np.empty(3)
    for piece in range(pieces.shape[0]):  # points on the curve, so that few pieces are cut finer than they need to be
        x, y, z = pieces[piece, 0, 0], pieces[piece, 0, 1], pieces[piece, 0, 2]
        for o in range(solids.shape[0]):
            if solids[o, 0] < PRISM:
                d, _, _, _ = plain_distance(solids, o, x, y, z)
            else:
                d, _, _, _ = prism_distance(solids, edges, o, x, y, z)
            seen = min(seen, d)
        if voxels:
            seen = min(seen, field_distance(scene.field, x, y, z, min(seen, exact)))
    for first in range(pieces.shape[0]):
        stack[0] = pieces[first]
        depth[0] = 0
        top = 1
        while top > 0:
            top -= 1
            b = stack[top]
            looked += 1
            wall_low, reach = np.inf, 0.0
            for a in range(3):
                c[a] = (b[0, a] + 3.0 * (b[1, a] + b[2, a]) + b[3, a]) / 8.0
                wall_seen = min(wall_seen, min(c[a] - walls[0, a], walls[1, a] - c[a]))
                for k in range(4):
                    wall_low = min(wall_low, min(b[k, a] - walls[0, a], walls[1, a] - b[k, a]))
            for k in range(4):
                e0, e1, e2 = b[k, 0] - c[0], b[k, 1] - c[1], b[k, 2] - c[2]
                reach = max(reach, e0 * e0 + e1 * e1 + e2 * e2)
            reach = math.sqrt(reach)
            low = np.inf
            for o in range(solids.shape[0]):
                if solids[o, 0] < PRISM:
                    d, g0, g1, g2 = plain_distance(solids, o, c[0], c[1], c[2])
                else:
                    d, g0, g1, g2 = prism_distance(solids, edges, o, c[0], c[1], c[2])
                seen = min(seen, d)
                if d - reach >= low:
                    continue
                if solids[o, 0] == NOTCHED:
                    low = min(low, max(d - reach, _notched_low(solids, edges, o, b, c)))
                    continue
                plane = 0.0
                for k in range(4):
                    plane = min(plane, g0 * (b[k, 0] - c[0]) + g1 * (b[k, 1] - c[1]) + g2 * (b[k, 2] - c[2]))
                low = min(low, d + max(plane, -reach))
            if voxels:
                d = field_bound(scene.field, c[0], c[1], c[2])
                if d - reach < min(low, max(need, seen - tolerance)):
                    d = field_distance(scene.field, c[0], c[1], c[2], exact)
                    seen = min(seen, d)
                    enough = max(need, seen - tolerance)
                    if seen >= need and d - reach < min(low, enough):
                        d = max(d, reach + _field_low(scene.field, b, c, enough, exact))
                low = min(low, d - reach)
            if seen < need or wall_seen < need:
                return -np.inf, -np.inf, looked
            if low >= max(need, seen - tolerance) and wall_low >= need:
                bound, wall_bound = min(bound, low), min(wall_bound, wall_low)
                continue
            if depth[top] >= DEEPEST - 1 or looked >= MOST_PIECES:
                return -np.inf, -np.inf, looked
            for a in range(3):  # de Casteljau at one half; the left half replaces b on the stack
                b0, b1, b2, b3 = b[0, a], b[1, a], b[2, a], b[3, a]
                m0, m1, m2 = 0.5 * (b0 + b1), 0.5 * (b1 + b2), 0.5 * (b2 + b3)
                n0, n1 = 0.5 * (m0 + m1), 0.5 * (m1 + m2)
                mid = 0.5 * (n0 + n1)
                right = stack[top + 1]
                right[0, a], right[1, a], right[2, a], right[3, a] = mid, n1, m2, b3
                b[1, a], b[2, a], b[3, a] = m0, n0, mid
            depth[top] += 1
            depth[top + 1] = depth[top]
            top += 2
    return bound, wall_bound, looked


def margin(world: World) -> float:
    """What rounding may cost in a world [m]: MARGIN times its largest coordinate, and never less than MARGIN."""
    return MARGIN * max(1.0, world.largest)


def needed(world: World, radius: float) -> float:
    """The computed distance that proves the radius [m]."""
    return radius + 2.0 * margin(world)


def end_needed(world: World, radius: float) -> float:
    """The distance at which an end of a curve can be told to be proved for the radius [m]: a margin above `needed`."""
    return radius + 3.0 * margin(world)


def certify(
    control_points: FloatArray, knots: FloatArray, world: World, radius: float, full: bool = True
) -> Certificate:
    """Prove that a cubic curve keeps `radius` from every solid and every wall, or say that it is not proved.

    Parameters
    ----------
    control_points : (n, 3)   [m].
    knots : (n + 4,)          clamped.
    radius : float            [m].
    full : bool               True finds the least distance to TOLERANCE; False stops at the radius.
    """
    pieces = bezier_pieces(control_points, knots)
    tolerance = TOLERANCE if full else np.inf
    low, wall, looked = prove(pieces, world.scene, world.walls, needed(world, radius), tolerance)
    low, wall = low - margin(world), wall - margin(world)
    return Certificate(bool(low >= radius and wall >= radius), low, wall, looked)
