"""What a good motion is: the cost of a cubic spline over time, among solids at rest and movers.

The knots are fixed and uneven if need be; the control points P_3 .. P_{n-4} are free, the first and the last three hold
the states at both ends. With the control points of the derivatives, whose norms `limits.derivative_bounds` proves,

    V_i = 3 (P_{i+1} - P_i)/(u_{i+4} - u_{i+1}),  A_i = 2 (V_{i+1} - V_i)/(u_{i+4} - u_{i+2}),
    J_i = (A_{i+1} - A_i)/(u_{i+4} - u_{i+3})

and m_i, the integral of the basis function that each belongs to,

    J = sum m_i |V_i|^2/v^2 + tau^2 sum m_i |A_i|^2/v^2                      [s]   evenness and smoothness
      + k/c^2 int sum_o h(c - d_o(C(t))) dt                                  [s]   solids and walls, h as in `cost`
      + k_m/c_m^2 int sum_o h(c_m - d_o(C(t), t)) dt                         [s]   movers, each where it is by then
      + LIMIT sum m_i (|V_i|^2/(s v)^2 - 1)_+^2, likewise A and J            [s]   limits, s = SLACK

A norm squared is convex, so the first line bounds int |C'|^2/v^2 + tau^2 |C''|^2/v^2 dt from above (Jensen), the time
domain's form of J_stretch + J_smooth in `cost`, with tau = v/a as there. Its matrix has two bands beside the diagonal.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner.bspline import FloatArray
from planner.cost import hinge
from planner.distance import PRISM, SPHERE, Scene, beyond, plain_distance, prism_distance, solid_distance
from planner.field import interpolate
from planner.jit import kernel, leaf
from planner.movers import mover_distance

SAMPLES = 4
"""Of the hinges in each span: 0.2 m apart at 3 m/s and 0.25 s a span."""
FIXED = 3
"""Control points that a state at an end takes."""
LIMIT, SLACK = 30.0, 0.985
"""Weight of the limits and the part of each that the hinge leaves: a hinge is always overstepped a little."""
STATIC, MOVING = 30.0, 12.0
"""k and k_m."""

IntArray = NDArray[np.int64]


class Timed(NamedTuple):
    """Everything the cost reads, and its scratch."""

    knots: FloatArray  # (n + 4,) [s]
    points: FloatArray  # (n, 3) scratch; its ends hold the fixed control points [m]
    slopes: FloatArray  # (n, 3) scratch
    v: FloatArray  # (n - 1, 3) scratch
    a: FloatArray  # (n - 2, 3) scratch
    gv: FloatArray  # (n - 1, 3) scratch
    ga: FloatArray  # (n - 2, 3) scratch
    basis: FloatArray  # (spans, SAMPLES, 4)
    times: FloatArray  # (spans, SAMPLES) on the movers' clock [s]
    scene: Scene
    starts: IntArray  # (spans + 1,) solids near span i: items[starts[i] : starts[i + 1]]
    items: IntArray
    walls: FloatArray  # (2, 3) [m]
    movers: FloatArray  # (k, movers.WIDTH)
    limits: FloatArray  # (3,) speed, acceleration, jerk
    reach: float  # c [m]
    mover_reach: float  # c_m [m]
    weights: FloatArray  # (3,) k/c^2 and k_m/c_m^2 [1/m^3], LIMIT; stiffened as need be


@leaf
def span_of(knots: FloatArray, t: float) -> int:
    """k with knots[k] <= t < knots[k + 1]; the first or last span for what lies outside."""
    low, high = 3, knots.shape[0] - 4
    while high - low > 1:
        middle = (low + high) // 2
        if knots[middle] <= t:
            low = middle
        else:
            high = middle
    return low


@leaf
def span_basis(u: FloatArray, k: int, t: float, out: FloatArray) -> None:
    """Write N_{k-3} .. N_k at t into out (3, 4): values, first and second derivatives (Piegl & Tiller, sec. 2.5)."""
    h = u[k + 1] - u[k]
    l1, l2, r1, r2 = u[k + 1] - u[k - 1], u[k + 1] - u[k - 2], u[k + 2] - u[k], u[k + 3] - u[k]
    m = u[k + 2] - u[k - 1]
    a, b = (u[k + 1] - t) / h, (t - u[k]) / h  # degree 1
    q0 = (u[k + 1] - t) / l1 * a  # degree 2
    q1 = (t - u[k - 1]) / l1 * a + (u[k + 2] - t) / r1 * b
    q2 = (t - u[k]) / r1 * b
    out[0, 0] = (u[k + 1] - t) / l2 * q0
    out[0, 1] = (t - u[k - 2]) / l2 * q0 + (u[k + 2] - t) / m * q1
    out[0, 2] = (t - u[k - 1]) / m * q1 + (u[k + 3] - t) / r2 * q2
    out[0, 3] = (t - u[k]) / r2 * q2
    e0, e1, e2 = 3.0 * q0 / l2, 3.0 * q1 / m, 3.0 * q2 / r2
    out[1, 0], out[1, 1], out[1, 2], out[1, 3] = -e0, e0 - e1, e1 - e2, e2
    f0, f1 = 2.0 * a / l1, 2.0 * b / r1  # slopes of degree 2
    e0, e1, e2 = -3.0 * f0 / l2, 3.0 * (f0 - f1) / m, 3.0 * f1 / r2
    out[2, 0], out[2, 1], out[2, 2], out[2, 3] = -e0, e0 - e1, e1 - e2, e2


@leaf
def pin(points: FloatArray, knots: FloatArray, start: FloatArray, end: FloatArray) -> None:
    """Set the first and last three control points so that the ends have those states (3, 3): rows p, v, a."""
    n = points.shape[0]
    h1, h2 = knots[4] - knots[3], knots[5] - knots[3]
    e1, e2 = knots[n] - knots[n - 1], knots[n] - knots[n - 2]
    for i in range(3):
        points[0, i] = start[0, i]
        points[1, i] = points[0, i] + start[1, i] * h1 / 3.0
        points[2, i] = points[1, i] + (start[1, i] + start[2, i] * h1 / 2.0) * h2 / 3.0
        points[n - 1, i] = end[0, i]
        points[n - 2, i] = points[n - 1, i] - end[1, i] * e1 / 3.0
        points[n - 3, i] = points[n - 2, i] - (end[1, i] - end[2, i] * e1 / 2.0) * e2 / 3.0


@kernel
def derivative_norms(points: FloatArray, u: FloatArray) -> tuple[float, float, float]:
    """Largest |V_i|, |A_i| and |J_i|."""
    n = points.shape[0]
    v, a = np.empty((n - 1, 3)), np.empty((n - 2, 3))
    speed, acceleration, jerk = 0.0, 0.0, 0.0
    for i in range(n - 1):
        w = 3.0 / (u[i + 4] - u[i + 1])
        s = 0.0
        for c in range(3):
            v[i, c] = w * (points[i + 1, c] - points[i, c])
            s += v[i, c] * v[i, c]
        speed = max(speed, s)
    for i in range(n - 2):
        w = 2.0 / (u[i + 4] - u[i + 2])
        s = 0.0
        for c in range(3):
            a[i, c] = w * (v[i + 1, c] - v[i, c])
            s += a[i, c] * a[i, c]
        acceleration = max(acceleration, s)
    for i in range(n - 3):
        w = 1.0 / (u[i + 4] - u[i + 3])
        s = 0.0
        for c in range(3):
            s += (w * (a[i + 1, c] - a[i, c])) ** 2
        jerk = max(jerk, s)
    return math.sqrt(speed), math.sqrt(acceleration), math.sqrt(jerk)


@leaf
def _limit(x: float, y: float, z: float, weight: float, most: float) -> tuple[float, float]:
    """(term, factor on the vector that makes its gradient) of one derivative control point."""
    e = (x * x + y * y + z * z) / (SLACK * most) ** 2 - 1.0
    if e <= 0.0:
        return 0.0, 0.0
    return weight * e * e, 4.0 * weight * e / (SLACK * most) ** 2


@leaf
def add_motion(m: Timed) -> float:
    """Energy and limits of m.points, gradient added to m.slopes."""
    u, p, v, a, gv, ga, g = m.knots, m.points, m.v, m.a, m.gv, m.ga, m.slopes
    n = p.shape[0]
    top, push, snap, stiff = m.limits[0], m.limits[1], m.limits[2], m.weights[2]
    even = 1.0 / top**2
    smooth = (top / push) ** 2 * even
    cost = 0.0
    for i in range(n - 1):
        d = (u[i + 4] - u[i + 1]) / 3.0
        x, y, z = (p[i + 1, 0] - p[i, 0]) / d, (p[i + 1, 1] - p[i, 1]) / d, (p[i + 1, 2] - p[i, 2]) / d
        term, factor = _limit(x, y, z, stiff * d, top)
        cost += term + even * d * (x * x + y * y + z * z)
        factor += 2.0 * even * d
        v[i, 0], v[i, 1], v[i, 2] = x, y, z
        gv[i, 0], gv[i, 1], gv[i, 2] = factor * x, factor * y, factor * z
    for i in range(n - 2):
        d = (u[i + 4] - u[i + 2]) / 2.0
        x, y, z = (v[i + 1, 0] - v[i, 0]) / d, (v[i + 1, 1] - v[i, 1]) / d, (v[i + 1, 2] - v[i, 2]) / d
        term, factor = _limit(x, y, z, stiff * d, push)
        cost += term + smooth * d * (x * x + y * y + z * z)
        factor += 2.0 * smooth * d
        a[i, 0], a[i, 1], a[i, 2] = x, y, z
        ga[i, 0], ga[i, 1], ga[i, 2] = factor * x, factor * y, factor * z
    for i in range(n - 3):
        d = u[i + 4] - u[i + 3]
        x, y, z = (a[i + 1, 0] - a[i, 0]) / d, (a[i + 1, 1] - a[i, 1]) / d, (a[i + 1, 2] - a[i, 2]) / d
        term, factor = _limit(x, y, z, stiff * d, snap)
        if factor > 0.0:
            cost += term
            factor /= d
            for c in range(3):
                s = factor * (x, y, z)[c]
                ga[i + 1, c] += s
                ga[i, c] -= s
    for i in range(n - 2):
        w = 2.0 / (u[i + 4] - u[i + 2])
        for c in range(3):
            gv[i + 1, c] += w * ga[i, c]
            gv[i, c] -= w * ga[i, c]
    for i in range(n - 1):
        w = 3.0 / (u[i + 4] - u[i + 1])
        for c in range(3):
            g[i + 1, c] += w * gv[i, c]
            g[i, c] -= w * gv[i, c]
    return cost


@leaf
def add_hinges(m: Timed) -> float:
    """Solids, walls and movers along m.points, gradient added to m.slopes."""
    p, g, b, u, starts, items, movers = m.points, m.slopes, m.basis, m.knots, m.starts, m.items, m.movers
    solids, edges, distances = m.scene.solids, m.scene.edges, m.scene.field.distances
    corner, resolution, voxels = m.scene.field.origin, m.scene.field.resolution, distances.size > 0
    c, cm, k_static, k_moving = m.reach, m.mover_reach, m.weights[0], m.weights[1]
    x0, y0, z0, x1, y1, z1 = m.walls[0, 0], m.walls[0, 1], m.walls[0, 2], m.walls[1, 0], m.walls[1, 1], m.walls[1, 2]
    total = 0.0
    for span in range(b.shape[0]):
        first, end = starts[span], starts[span + 1]
        dt = (u[span + 4] - u[span + 3]) / SAMPLES
        ks, km = k_static * dt, k_moving * dt
        for s in range(SAMPLES):
            b0, b1, b2, b3 = b[span, s, 0], b[span, s, 1], b[span, s, 2], b[span, s, 3]
            x = b0 * p[span, 0] + b1 * p[span + 1, 0] + b2 * p[span + 2, 0] + b3 * p[span + 3, 0]
            y = b0 * p[span, 1] + b1 * p[span + 1, 1] + b2 * p[span + 2, 1] + b3 * p[span + 3, 1]
            z = b0 * p[span, 2] + b1 * p[span + 1, 2] + b2 * p[span + 2, 2] + b3 * p[span + 3, 2]
            fx, fy, fz = 0.0, 0.0, 0.0
            for item in range(first, end):
                o = items[item]
                if solids[o, 0] < PRISM:
                    if beyond(solids, o, x, y, c):
                        continue
                    d, gx, gy, gz = plain_distance(solids, o, x, y, z)
                else:
                    d, gx, gy, gz = prism_distance(solids, edges, o, x, y, z)
                if d < c:
                    h, dh = hinge(c - d, c)
                    total += ks * h
                    fx -= ks * dh * gx
                    fy -= ks * dh * gy
                    fz -= ks * dh * gz
            if voxels:  # they count as one solid
                d, gx, gy, gz = interpolate(distances, corner[0], corner[1], corner[2], resolution, c, x, y, z)
                if d < c:
                    h, dh = hinge(c - d, c)
                    total += ks * h
                    fx -= ks * dh * gx
                    fy -= ks * dh * gy
                    fz -= ks * dh * gz
            t = m.times[span, s]
            for k in range(movers.shape[0]):
                if t > movers[k, 12]:
                    continue
                since = t - movers[k, 11]
                if movers[k, 0] == SPHERE:
                    ex = x - movers[k, 1] - movers[k, 7] * since
                    ey = y - movers[k, 2] - movers[k, 8] * since
                    ez = z - movers[k, 3] - movers[k, 9] * since
                    near = cm + movers[k, 4] + movers[k, 10] * abs(since)
                    if ex * ex + ey * ey + ez * ez >= near * near:
                        continue
                d, gx, gy, gz = mover_distance(movers, k, t, x, y, z)
                if d < cm:
                    h, dh = hinge(cm - d, cm)
                    total += km * h
                    fx -= km * dh * gx
                    fy -= km * dh * gy
                    fz -= km * dh * gz
            if x < x0 + c:
                h, dh = hinge(x0 + c - x, c)
                total += ks * h
                fx -= ks * dh
            if x > x1 - c:
                h, dh = hinge(x - x1 + c, c)
                total += ks * h
                fx += ks * dh
            if y < y0 + c:
                h, dh = hinge(y0 + c - y, c)
                total += ks * h
                fy -= ks * dh
            if y > y1 - c:
                h, dh = hinge(y - y1 + c, c)
                total += ks * h
                fy += ks * dh
            if z < z0 + c:
                h, dh = hinge(z0 + c - z, c)
                total += ks * h
                fz -= ks * dh
            if z > z1 - c:
                h, dh = hinge(z - z1 + c, c)
                total += ks * h
                fz += ks * dh
            if fx != 0.0 or fy != 0.0 or fz != 0.0:
                for q in range(4):
                    w = b[span, s, q]
                    g[span + q, 0] += w * fx
                    g[span + q, 1] += w * fy
                    g[span + q, 2] += w * fz
    return total


@leaf
def timed_cost(x: FloatArray, gradient: FloatArray, m: Timed) -> float:
    """J [s] at the free control points x (3 f,) with its gradient written (3 f,)."""
    p, g = m.points, m.slopes
    f = p.shape[0] - 2 * FIXED
    for i in range(f):
        for c in range(3):
            p[FIXED + i, c] = x[3 * i + c]
    g[:, :] = 0.0
    motion: float = add_motion(m)
    hinges: float = add_hinges(m)
    for i in range(f):
        for c in range(3):
            gradient[3 * i + c] = g[FIXED + i, c]
    return motion + hinges


@kernel
def near_spans(points: FloatArray, scene: Scene, reach: float) -> tuple[IntArray, IntArray]:
    """Solids within `reach` of the ball around each span's control points, as lists (starts, items)."""
    solids, edges = scene.solids, scene.edges
    spans = points.shape[0] - 3
    starts, items, count = np.zeros(spans + 1, dtype=np.int64), np.empty(64, dtype=np.int64), 0
    for span in range(spans):
        cx, cy, cz = 0.0, 0.0, 0.0
        for q in range(4):
            cx += 0.25 * points[span + q, 0]
            cy += 0.25 * points[span + q, 1]
            cz += 0.25 * points[span + q, 2]
        ball = 0.0
        for q in range(4):
            x, y, z = points[span + q, 0] - cx, points[span + q, 1] - cy, points[span + q, 2] - cz
            ball = max(ball, x * x + y * y + z * z)
        ball = math.sqrt(ball) + reach
        for k in range(solids.shape[0]):
            d, _, _, _ = solid_distance(solids, edges, k, cx, cy, cz)
            if d < ball:
                if count == items.shape[0]:
                    items = np.append(items, np.empty_like(items))
                items[count] = k
                count += 1
        starts[span + 1] = count
    return starts, items


@kernel
def timed_of(
    points: FloatArray,
    knots: FloatArray,
    begin: float,
    scene: Scene,
    walls: FloatArray,
    movers: FloatArray,
    limits: FloatArray,
    reach: float,
    mover_reach: float,
    room: float,
) -> Timed:
    """The cost around control points (n, 3), which become its scratch; solids farther than reach + room are left out.

    `begin` is the movers' clock [s] at knots[3].
    """
    n = points.shape[0]
    spans = n - 3
    basis, times, row = np.empty((spans, SAMPLES, 4)), np.empty((spans, SAMPLES)), np.empty((3, 4))
    for span in range(spans):
        a, b = knots[span + 3], knots[span + 4]
        for s in range(SAMPLES):
            t = a + (s + 0.5) / SAMPLES * (b - a)
            span_basis(knots, span + 3, t, row)
            times[span, s] = begin + t - knots[3]
            for q in range(4):
                basis[span, s, q] = row[0, q]
    starts, items = near_spans(points, scene, reach + room)
    return Timed(
        knots,
        points,
        np.empty((n, 3)),
        np.empty((n - 1, 3)),
        np.empty((n - 2, 3)),
        np.empty((n - 1, 3)),
        np.empty((n - 2, 3)),
        basis,
        times,
        scene,
        starts,
        items,
        walls,
        movers,
        limits,
        reach,
        mover_reach,
        np.array([STATIC / reach**2, MOVING / mover_reach**2, LIMIT]),
    )
