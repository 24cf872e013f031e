"""From a route and a state in flight to a proved trajectory, in one compiled call.

    seed along the route -> L-BFGS on the motion's cost -> exact limits, solids, walls and movers
        -> a limit is passed: more time; something is too near: stiffer hinges; and again, a few rounds

L-BFGS as in `descent`, with the inverse of the energy's banded matrix as the initial metric (banded Cholesky; Golub &
Van Loan, Matrix Computations, 4th ed., sec. 4.3.5).
"""

import math
from typing import NamedTuple

import numpy as np

from planner.bspline import FloatArray, bezier_pieces
from planner.certificate import prove
from planner.descent import ARMIJO, MEMORY
from planner.distance import Scene, solid_distance
from planner.jit import kernel, leaf
from planner.movers import prove_movers
from planner.timed import FIXED, SAMPLES, SLACK, Timed, derivative_norms, pin, span_basis, span_of, timed_cost, timed_of

ROUNDS = 6
EVALUATIONS = 40
"""Most evaluations of the cost in a round."""
TOLERANCE = 2e-4
"""Part of the cost that a step gains when the descent is at its end."""
STIFFER = 4.0
LONGEST_STEP = 0.5
"""Of a control point's coordinate in one step of the descent [m]."""
ROOM = 0.5
"""How far a control point may move before solids that were left out matter [m]; the proof sees all of them."""
JOINING = 1.2
"""In which a seed comes back to its route [s]."""
BUMP = 0.5
"""Half width of a seed's bump [s]."""
SHORTEST = 0.02
"""Of the first span, where a state close to the limits asks for a short one [s]."""
ROUNDING = 1e-12


class Ask(NamedTuple):
    """What a warm plan is to keep to."""

    scene: Scene
    walls: FloatArray  # (2, 3) [m]
    movers: FloatArray  # (k, movers.WIDTH)
    limits: FloatArray  # (3,)
    need: float  # distance from solids and walls that is proved, margins included [m]
    mover_need: float  # likewise from movers
    reach: float  # where the hinge of solids begins [m]
    mover_reach: float  # where that of movers begins [m]


class Found(NamedTuple):
    """What came of it."""

    points: FloatArray  # (n, 3) [m]
    knots: FloatArray  # (n + 4,) [s]
    still: bool  # solids, walls and limits are proved
    clear: bool  # and movers too
    distance: float  # least distance to a mover seen on samples [m]
    mover: int  # which one, -1 without any
    time: float  # when [s], movers' clock; where solids are in the way, when these are nearest
    evaluations: int


@kernel
def factor(knots: FloatArray, f: int, limits: FloatArray) -> FloatArray:
    """Banded Cholesky factor (f, 3) of the energy's second derivative: L[i, b] = L_{i, i-b}."""
    band = np.zeros((f, 3))
    even = 2.0 / limits[0] ** 2
    smooth = even * (limits[0] / limits[1]) ** 2
    s = np.empty(3)
    for i in range(knots.shape[0] - 5):  # V_i
        d = (knots[i + 4] - knots[i + 1]) / 3.0
        s[0], s[1] = -1.0 / d, 1.0 / d
        for j in range(2):
            for k in range(j + 1):
                row = i + j - FIXED
                if i + k - FIXED >= 0 and row < f:
                    band[row, j - k] += even * d * s[j] * s[k]
    for i in range(knots.shape[0] - 6):  # A_i
        d = (knots[i + 4] - knots[i + 2]) / 2.0
        d0, d1 = (knots[i + 4] - knots[i + 1]) / 3.0, (knots[i + 5] - knots[i + 2]) / 3.0
        s[0], s[1], s[2] = 1.0 / (d0 * d), -1.0 / (d0 * d) - 1.0 / (d1 * d), 1.0 / (d1 * d)
        for j in range(3):
            for k in range(j + 1):
                row = i + j - FIXED
                if i + k - FIXED >= 0 and row < f:
                    band[row, j - k] += smooth * d * s[j] * s[k]
    for i in range(f):
        for b in range(min(i, 2), -1, -1):
            value = band[i, b]
            for q in range(b + 1, min(i, 2) + 1):
                value -= band[i, q] * band[i - b, q - b]
            band[i, b] = math.sqrt(value) if b == 0 else value / band[i - b, 0]
    return band


@leaf
def solve(band: FloatArray, q: FloatArray) -> None:
    """q (3 f,) <- (L L^T)^-1 q for each coordinate, in place."""
    f = band.shape[0]
    for i in range(f):
        for c in range(3):
            value = q[3 * i + c]
            for b in range(1, min(i, 2) + 1):
                value -= band[i, b] * q[3 * (i - b) + c]
            q[3 * i + c] = value / band[i, 0]
    for i in range(f - 1, -1, -1):
        for c in range(3):
            value = q[3 * i + c]
            for b in range(1, min(f - 1 - i, 2) + 1):
                value -= band[i + b, b] * q[3 * (i + b) + c]
            q[3 * i + c] = value / band[i, 0]


@kernel
def descend(x: FloatArray, band: FloatArray, m: Timed, most: int) -> int:
    """L-BFGS from x (3 f,), in place; evaluations made, about `most` of them at most."""
    n = x.size
    S, Y, rho, alpha = np.empty((MEMORY, n)), np.empty((MEMORY, n)), np.empty(MEMORY), np.empty(MEMORY)
    g, g_new, x_new, p = np.empty(n), np.empty(n), np.empty(n), np.empty(n)
    cost = timed_cost(x, g, m)
    evaluations, count, idle = 1, 0, 0
    while evaluations < most:
        p[:] = g
        held = min(count, MEMORY)
        for j in range(held):
            r = (count - 1 - j) % MEMORY
            dot = 0.0
            for k in range(n):
                dot += S[r, k] * p[k]
            alpha[r] = rho[r] * dot
            for k in range(n):
                p[k] -= alpha[r] * Y[r, k]
        solve(band, p)
        for j in range(held - 1, -1, -1):
            r = (count - 1 - j) % MEMORY
            dot = 0.0
            for k in range(n):
                dot += Y[r, k] * p[k]
            for k in range(n):
                p[k] += (alpha[r] - rho[r] * dot) * S[r, k]
        slope, largest = 0.0, 0.0
        for k in range(n):
            slope -= g[k] * p[k]
            largest = max(largest, abs(p[k]))
        if not slope < 0.0:
            if count == 0:
                break
            count = 0
            continue
        step = min(1.0, LONGEST_STEP / largest)
        while True:
            for k in range(n):
                x_new[k] = x[k] - step * p[k]
            cost_new = timed_cost(x_new, g_new, m)
            evaluations += 1
            if cost_new <= cost + ARMIJO * step * slope or evaluations >= most:
                break
            step *= max(0.1, min(0.5, -0.5 * slope * step / (cost_new - cost - slope * step)))
        if cost_new >= cost:
            break
        sy = 0.0
        for k in range(n):
            sy += (x_new[k] - x[k]) * (g_new[k] - g[k])
        if sy > 1e-12:
            r = count % MEMORY
            for k in range(n):
                S[r, k], Y[r, k] = x_new[k] - x[k], g_new[k] - g[k]
            rho[r] = 1.0 / sy
            count += 1
        idle = idle + 1 if cost - cost_new < TOLERANCE * cost else 0
        cost = cost_new
        x[:], g[:] = x_new, g_new
        if idle == 2:
            break
    return evaluations


@leaf
def route_state(points: FloatArray, knots: FloatArray, t: float, state: FloatArray, row: FloatArray) -> None:
    """Write the spline's position, velocity and acceleration at t into state (3, 3); row (3, 4) is scratch."""
    t = min(max(t, knots[3]), knots[-4])
    k = span_of(knots, t)
    span_basis(knots, k, t, row)
    for d in range(3):
        for c in range(3):
            value = 0.0
            for q in range(4):
                value += row[d, q] * points[k - 3 + q, c]
            state[d, c] = value


@kernel
def fresh_knots(ask: Ask, state: FloatArray, spans: int, duration: float) -> FloatArray:
    """Even knots, the first span cut short where V_1 = v + a h/2 would pass the limit on speed."""
    even = duration / spans
    h, limit = even, ask.limits[0] ** 2 * SLACK
    while h > SHORTEST and 4.0 * h > even * 0.01:
        s = 0.0
        for c in range(3):
            s += (state[1, c] + state[2, c] * h / 2.0) ** 2
        if s <= limit:
            break
        h *= 0.7
    knots = np.zeros(spans + 7)
    for i in range(1, spans + 1):
        knots[i + 3] = h + (duration - h) * ((i - 1) / (spans - 1))
    knots[spans + 3 :] = duration
    return knots


@kernel
def judge(
    ask: Ask, points: FloatArray, knots: FloatArray, first: float, begin: float, hold: float
) -> tuple[bool, bool, bool, float, int, float]:
    """What is proved from the spline's time `first` on, which is `begin` on the movers' clock.

    (clear of solids and walls, within the limits, clear of movers; then the least distance to a mover seen on samples,
    [m], which one, and when). For `hold` [s] after its end the vehicle stands there.
    """
    speed, acceleration, jerk = derivative_norms(points, knots)
    within = over(ask, speed, acceleration, jerk) <= 1.0 - ROUNDING
    all_pieces = bezier_pieces(points, knots)
    spans = all_pieces.shape[0]
    first = min(max(first, knots[3]), knots[-4])
    k = span_of(knots, first) - 3
    pieces, times = np.empty((spans - k + 1, 4, 3)), np.empty(spans - k + 2)
    pieces[: spans - k] = all_pieces[k:]
    times[: spans - k + 1] = begin - first + knots[k + 3 : spans + 4]
    times[0] = begin
    cut = (first - knots[k + 3]) / (knots[k + 4] - knots[k + 3])
    for i in range(3):  # de Casteljau: the right part of the first piece
        for r in range(1, 4):
            for j in range(4 - r):
                pieces[0, j, i] += cut * (pieces[0, j + 1, i] - pieces[0, j, i])
    pieces[spans - k, :] = points[-1]
    times[spans - k + 1] = times[spans - k] + hold
    bound, wall, _ = prove(pieces, ask.scene, ask.walls, ask.need, np.inf)
    passed, distance, mover, when = prove_movers(pieces, times, ask.movers, ask.mover_need, np.inf)
    return bound >= ask.need and wall >= ask.need, within, passed >= ask.mover_need, distance, mover, when


@leaf
def nearest_still(m: Timed) -> float:
    """When, on the movers' clock, a sample of m.points is nearest to the solids of its span [s]."""
    least, when = np.inf, float(m.times[0, 0])
    for span in range(m.basis.shape[0]):
        for s in range(SAMPLES):
            x, y, z = 0.0, 0.0, 0.0
            for q in range(4):
                x += m.basis[span, s, q] * m.points[span + q, 0]
                y += m.basis[span, s, q] * m.points[span + q, 1]
                z += m.basis[span, s, q] * m.points[span + q, 2]
            for item in range(m.starts[span], m.starts[span + 1]):
                d, _, _, _ = solid_distance(m.scene.solids, m.scene.edges, m.items[item], x, y, z)
                if d < least:
                    least, when = d, m.times[span, s]
    return when


@leaf
def over(ask: Ask, speed: float, acceleration: float, jerk: float) -> float:
    """By what factor time has to be stretched for norms to come within the limits, below 1 when they are."""
    a, j = acceleration / ask.limits[1], jerk / ask.limits[2]
    result: float = max(speed / ask.limits[0], max(math.sqrt(a), j ** (1.0 / 3.0)))
    return result


@kernel
def warm(
    ask: Ask,
    state: FloatArray,
    end: FloatArray,
    route: FloatArray,
    route_knots: FloatArray,
    first: float,
    last: float,
    duration: float,
    spans: int,
    begin: float,
    hold: float,
    bump: FloatArray,
    bump_at: float,
    rounds: int,
) -> Found:
    """Fly from `state` to `end` (3, 3) in about `duration` [s], along the route between its times `first` and `last`.

    `begin` is the movers' clock at the state; for `hold` [s] after its end the vehicle stands there; the seed is pushed
    aside by `bump` (3,) [m] about `bump_at` [s] after the state.
    """
    n, f = spans + 3, spans + 3 - 2 * FIXED
    knots = fresh_knots(ask, state, spans, duration)
    points, here, row = np.empty((n, 3)), np.empty((3, 3)), np.empty((3, 4))
    gap, moved = np.empty(3), np.empty(3)
    route_state(route, route_knots, last, here, row)
    for c in range(3):
        moved[c] = end[0, c] - here[0, c]
    route_state(route, route_knots, first, here, row)
    for c in range(3):
        gap[c] = state[0, c] - here[0, c]
    pace, h = (last - first) / duration, duration / spans
    for i in range(FIXED, n - FIXED):
        xi = (knots[i + 1] + knots[i + 2] + knots[i + 3]) / 3.0
        route_state(route, route_knots, first + pace * xi, here, row)
        join = max(0.0, 1.0 - xi / JOINING) ** 2
        push = math.exp(-(((xi - bump_at) / BUMP) ** 2))
        lead = (xi / duration) ** 2
        for c in range(3):  # C - h^2/6 C'' at uniform knots: a quasi-interpolant, exact for cubics
            on = here[0, c] - h * h / 6.0 * pace * pace * here[2, c]
            points[i, c] = on + join * gap[c] + lead * moved[c] + push * bump[c]
    for i in range(FIXED, n - FIXED):
        for c in range(3):
            points[i, c] = min(max(points[i, c], ask.walls[0, c] + ask.need), ask.walls[1, c] - ask.need)
    pin(points, knots, state, end)
    m = timed_of(points, knots, begin, ask.scene, ask.walls, ask.movers, ask.limits, ask.reach, ask.mover_reach, ROOM)
    x = np.empty(3 * f)
    evaluations = 0
    still, clear, distance, mover, when = False, False, -np.inf, -1, 0.0
    for turn in range(rounds):
        for i in range(f):
            for c in range(3):
                x[3 * i + c] = points[FIXED + i, c]
        evaluations += descend(x, factor(knots, f, ask.limits), m, EVALUATIONS)
        for i in range(f):
            for c in range(3):
                points[FIXED + i, c] = x[3 * i + c]
        free, within, passed, distance, mover, when = judge(ask, points, knots, 0.0, begin, hold)
        still = within and free
        clear = still and passed
        if clear or turn == rounds - 1 or (turn >= 2 and not free):
            if not free:
                when = nearest_still(m)
            break
        if not free:
            m.weights[0] *= STIFFER
        if not passed:
            m.weights[1] *= STIFFER
        if not within:
            weights = m.weights
            speed, acceleration, jerk = derivative_norms(points, knots)
            duration *= min(max(1.02, 1.01 * over(ask, speed, acceleration, jerk)), 1.3)
            weights[2] *= 2.0
            knots = fresh_knots(ask, state, spans, duration)
            pin(points, knots, state, end)
            m = timed_of(
                points, knots, begin, ask.scene, ask.walls, ask.movers, ask.limits, ask.reach, ask.mover_reach, ROOM
            )
            m.weights[:] = weights
    return Found(points, knots, still, clear, distance, mover, when, evaluations)
