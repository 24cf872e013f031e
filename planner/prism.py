"""Simple polygons: whether a list of corners is one, and the exact signed distance to it.

The nearest point of the outline is on an edge's inside or at a corner. On an edge's inside the signed distance is the
one to its line, whose outward normal is the gradient; at a corner the sign is the winding number's (Sunday 2001:
upward edges to the left of which the point lies, less the downward ones to the right), which errs only within rounding
of the outline.

An edge is one row of EDGE numbers: its first corner x y, its unit direction, its length. Edges run counter-clockwise,
so the outward normal of (ux, uy) is (uy, -ux).
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from planner.jit import leaf

FloatArray = NDArray[np.float64]

EDGE = 5
MOST_CORNERS = 1000
STRAIGHT = 1e-14
"""Sine of the inward bend that still counts as straight: far below what the proof's rounding margin covers."""


@leaf
def polygon_distance(edges: FloatArray, first: int, count: int, x: float, y: float) -> tuple[float, float, float]:
    """(d, gx, gy): signed distance [m] to the polygon of rows first .. first + count - 1, and unit gradient.

    Negative inside. For a convex polygon d is a convex function and the gradient a subgradient of it.
    """
    least, nearest, corner, winding = np.inf, first, False, 0
    side_of_nearest, vx, vy = 0.0, 0.0, 0.0
    for e in range(first, first + count):
        ux, uy, length = edges[e, 2], edges[e, 3], edges[e, 4]
        wx, wy = x - edges[e, 0], y - edges[e, 1]
        along, side = wx * ux + wy * uy, wx * uy - wy * ux  # side > 0: outward of this edge's line
        after = edges[e + 1, 1] if e + 1 < first + count else edges[first, 1]
        if wy >= 0.0:
            if after > y and side < 0.0:
                winding += 1
        elif after <= y and side > 0.0:
            winding -= 1
        if along <= 0.0:
            square = wx * wx + wy * wy
        elif along < length:
            square = side * side
        else:
            continue  # the next edge begins there
        if square < least:
            least, nearest, corner, side_of_nearest, vx, vy = square, e, along <= 0.0, side, wx, wy
    if corner:
        d = math.sqrt(least)
        if d > 0.0:
            sign = -1.0 if winding != 0 else 1.0
            return sign * d, sign * vx / d, sign * vy / d
    return side_of_nearest, edges[nearest, 3], -edges[nearest, 2]


def counter_clockwise(corners: Sequence[Sequence[float]]) -> FloatArray:
    """The corners (n, 2) of a simple polygon as an array that runs counter-clockwise.

    Raises
    ------
    ValueError : fewer than 3 or more than MOST_CORNERS corners, one that is not two finite numbers, two in a row that
        are the same, no area, or edges that touch or cross; the corners at fault are named.
    """
    count = len(corners)
    if not 3 <= count <= MOST_CORNERS:
        raise ValueError(f"prism corners: expected 3 to {MOST_CORNERS}, found {count}")
    for i, corner in enumerate(corners):
        if len(corner) != 2 or not all(math.isfinite(float(v)) for v in corner):
            raise ValueError(f"prism corner {i}: expected two finite numbers, found {tuple(corner)}")
    a = np.array(corners, dtype=np.float64)
    b = np.roll(a, -1, axis=0)
    same = np.flatnonzero((a == b).all(axis=1))
    if len(same):
        i = int(same[0])
        raise ValueError(
            f"prism corners {i} and {(i + 1) % count}: expected different points, found {tuple(a[i])} twice"
        )
    for i in range(count):
        j = _meets(a, b, i)
        if j is not None:
            raise ValueError(
                f"prism: expected edges that do not meet, found that corner {i} to {(i + 1) % count} "
                f"touches or crosses corner {j} to {(j + 1) % count}"
            )
    relative = a - a[0]
    area = 0.5 * float(_cross(relative, np.roll(relative, -1, axis=0)).sum())
    if area == 0.0:
        raise ValueError("prism: expected an area above 0 m^2, found 0")
    return a if area > 0.0 else np.ascontiguousarray(a[::-1])


def is_convex(corners: FloatArray) -> bool:
    """Whether a simple polygon (n, 2) that runs counter-clockwise bends inward nowhere."""
    edge = np.roll(corners, -1, axis=0) - corners
    following = np.roll(edge, -1, axis=0)
    size = np.linalg.norm(edge, axis=1) * np.linalg.norm(following, axis=1)
    return bool((_cross(edge, following) >= -STRAIGHT * size).all())


def edge_rows(corners: FloatArray) -> FloatArray:
    """The edges (n, EDGE) of a polygon (n, 2) that runs counter-clockwise, as `polygon_distance` reads them."""
    edge = np.roll(corners, -1, axis=0) - corners
    length = np.linalg.norm(edge, axis=1, keepdims=True)
    return np.concatenate([corners, edge / length, length], axis=1)


def _cross(u: FloatArray, v: FloatArray) -> FloatArray:
    product: FloatArray = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    return product


def _meets(a: FloatArray, b: FloatArray, i: int) -> int | None:
    """The first later edge a[j] to b[j] that edge i touches or crosses, the common corner of neighbours apart."""
    count, p, q = len(a), a[i], b[i]
    c, d = a[i + 1 :], b[i + 1 :]
    d1, d2 = _cross((q - p)[None], c - p), _cross((q - p)[None], d - p)
    d3, d4 = _cross(d - c, p - c), _cross(d - c, q - c)
    crossing = (np.sign(d1) * np.sign(d2) <= 0) & (np.sign(d3) * np.sign(d4) <= 0)
    overlapping = (np.maximum(c, d) >= np.minimum(p, q)).all(axis=1) & (np.minimum(c, d) <= np.maximum(p, q)).all(
        axis=1
    )
    meets = crossing & overlapping
    for k in np.flatnonzero(meets):
        j = i + 1 + int(k)
        if j == i + 1:  # shares q: they meet elsewhere only by folding straight back
            if not (d2[k] == 0.0 and (d[k] - q) @ (p - q) > 0.0):
                continue
        elif i == 0 and j == count - 1 and not (d1[k] == 0.0 and (c[k] - p) @ (q - p) > 0.0):  # likewise p
            continue
        return j
    return None
