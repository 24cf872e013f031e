"""What a good curve is: short, smooth, clear (the paper's Eq. 36, its terms in computable form).

With u in [0, 1], D the length of the way (known roughly beforehand) and P the control points,

    J = J_stretch + J_smooth + J_obstacle                                                       [m]        Eq. 36
    J_stretch  = (1/D) int |C'|^2 du                = (1/D) tr(P^T S P),  S_ij = int N_i' N_j'             Eq. 37
    J_smooth   = (1/D) (tau/T)^2 int |C''|^2 du     = (1/D) (tau/T)^2 tr(P^T Q P),  Q_ij = int N_i'' N_j'' Eq. 38
    tau/T      = m / (D + m),  m = min(v^2/a, D)                                         v, a: the limits
    J_obstacle = k D/c^2 int sum_o h(c - d_o(C)) du                                                        Eq. 39
    h(e) = 0 for e <= 0;  e^3 for e <= c;  3 c e^2 - 3 c^2 e + c^3 beyond (twice continuously differentiable)

Where this leaves the printed equations:
- Eq. 37 prints the integral of C', which is C(1) - C(0). The length is the integral of |C'|; its square is at most
  int |C'|^2, with equality at constant speed. So the stretch has the shortest curves as minimisers, run at an even
  speed, which is what uniform knots want, and it is a quadratic form.
- Eq. 38 sums squares of single terms; the square of the sum is the quadratic form above. tau is the time to reach the
  top speed and T that of the fastest run over D, from rest to rest, that the limits allow: tau = v/a and T = D/v + tau
  when there is room to reach v, that is v^2/a <= D; else the top speed is sqrt(a D), tau = sqrt(D/a) and T = 2 tau.
  With m = tau times that speed, both are the line above. J_stretch + J_smooth is then int |v|^2 + tau^2 |a|^2 dt in
  other units, whose minimiser reaches its speed with the time constant tau. No weight is left to tune. A fast, weak
  vehicle would round off more than a maze lets pass: `softest` then bounds m, the way in which the speed may change.
- Eq. 39 grows with the distance from an obstacle, so minimising it attracts. A hinge on the signed distance d repels,
  inside c = radius + buffer only; walls of the map are obstacles with d = distance to the wall.

The integral of h is a midpoint rule with SAMPLES points a span. A grid of cells lists the solids within c of each cell,
so a sample looks at those alone, and a span about whose hull no cell lists any at none. The voxels of a field count as
one solid, with the interpolated distance.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from planner.bspline import DEGREE, FloatArray, basis, clamped_knots, gram_matrix
from planner.distance import PRISM, Scene, beyond, plain_distance, prism_distance
from planner.field import interpolate
from planner.jit import leaf
from planner.limits import Limits
from planner.nearby import Grid, IntArray, build_grid, cell_along
from planner.worlds import World

SAMPLES = 6
"""Samples of the obstacle term in each span, as few as do: of bare searches 77 % are proved with 4, 93 % with 5, 99 %
with 6, 98 % with 8."""
FIXED = 3
"""Control points pinned at each end: three equal ones are rest with zero acceleration (see `timing`)."""
WEIGHT = 50.0
"""k. Around a corner of radius R the pull of the stretch, 2/R, meets the push 3 k e^2/c^2: the curve is e = c
sqrt(2/(3 k R)) inside, a sixth of c at 0.45 m. With 30 every fourth best curve of a search lies just within the radius,
with 50 one of fifty; with 60 ways through forests come out 0.1 % longer still."""
SHORTEST = 0.1
"""Least D [m], so that a hop to the place one is at has a scale too."""


class Problem(NamedTuple):
    """Everything the kernel reads, and its scratch (so one problem serves one thread)."""

    energy: FloatArray  # (f, f) quadratic form of the free control points, banded [1/m]
    linear: FloatArray  # (f, 3) what the fixed ends add to half its gradient, reckoned from the origin
    constant: float  # [m]
    origin: FloatArray  # (3,) where energies are reckoned from, so that far maps (UTM) cancel no digits [m]
    relative: FloatArray  # (3 f,) scratch
    basis: FloatArray  # (spans, 4, SAMPLES)
    points: FloatArray  # (n, 3) scratch; its ends hold the fixed control points
    slopes: FloatArray  # (n, 3) scratch
    scene: Scene
    walls: FloatArray  # (2, 3)
    grid: Grid
    reach: float  # c [m]
    scale: float  # k D / (c^2 samples) [1/m^2]
    via: FloatArray  # (m, 3) points on the curve [m]
    via_at: IntArray  # (m,) the free control points that they determine


@dataclass(frozen=True, slots=True)
class CostTerms:
    """The three terms of Eq. 36 [m]."""

    stretch: float
    smoothness: float
    obstacle: float

    @property
    def total(self) -> float:
        return self.stretch + self.smoothness + self.obstacle


@leaf
def hinge(e: float, c: float) -> tuple[float, float]:
    """(h, dh/de) of the corrected Eq. 39; e > 0."""
    if e <= c:
        return e * e * e, 3.0 * e * e  # Eq. 39, its sign and shape mended
    return 3.0 * c * e * e - 3.0 * c * c * e + c * c * c, 6.0 * c * e - 3.0 * c * c


@leaf
def _between(v: float, low: float, high: float, c: float) -> tuple[float, float]:
    """(h, dh/dv) of the two walls across one axis, which are felt below `low` and above `high`."""
    h, slope = 0.0, 0.0
    if v < low:
        h, slope = hinge(low - v, c)
        slope = -slope
    if v > high:
        beyond, dh = hinge(v - high, c)
        h += beyond
        slope += dh
    return h, slope


@leaf
def add_energy(x: FloatArray, gradient: FloatArray, p: Problem) -> float:
    """Stretch and smoothness of the free control points x (3 f,), gradient written (3 f,)."""
    f, y = p.energy.shape[0], p.relative
    cost = p.constant
    for i in range(f):
        for a in range(3):
            y[3 * i + a] = x[3 * i + a] - p.origin[a]
    for i in range(f):
        a0, a1, a2 = p.linear[i, 0], p.linear[i, 1], p.linear[i, 2]
        b0, b1, b2 = a0, a1, a2
        for j in range(max(i - DEGREE, 0), min(i + DEGREE + 1, f)):
            m = p.energy[i, j]
            a0 += m * y[3 * j]
            a1 += m * y[3 * j + 1]
            a2 += m * y[3 * j + 2]
        cost += y[3 * i] * (a0 + b0) + y[3 * i + 1] * (a1 + b1) + y[3 * i + 2] * (a2 + b2)
        gradient[3 * i], gradient[3 * i + 1], gradient[3 * i + 2] = 2.0 * a0, 2.0 * a1, 2.0 * a2
    return cost


@leaf
def add_obstacles(x: FloatArray, gradient: FloatArray, p: Problem) -> float:
    """Obstacle term of the free control points x (3 f,), gradient added to (3 f,)."""
    # Everything by its own name: a field of a field, or a row of an array, costs more than the arithmetic on it.
    f, c, b, points, slopes = p.energy.shape[0], p.reach, p.basis, p.points, p.slopes
    solids, edges = p.scene.solids, p.scene.edges
    starts, items, sums, per_metre = p.grid.starts, p.grid.items, p.grid.sums, p.grid.per_metre
    nx, ny, nz = p.grid.shape[0], p.grid.shape[1], p.grid.shape[2]
    x0, y0, z0 = p.grid.origin[0], p.grid.origin[1], p.grid.origin[2]
    low_x, low_y, low_z = p.walls[0, 0] + c, p.walls[0, 1] + c, p.walls[0, 2] + c
    high_x, high_y, high_z = p.walls[1, 0] - c, p.walls[1, 1] - c, p.walls[1, 2] - c
    distances, resolution, corner = p.scene.field.distances, p.scene.field.resolution, p.scene.field.origin
    vx, vy, vz, voxels = corner[0], corner[1], corner[2], distances.size > 0
    for i in range(f):
        for a in range(3):
            points[FIXED + i, a] = x[3 * i + a]
    slopes[:, :] = 0.0
    total = 0.0
    for span in range(b.shape[0]):
        ax, bx, cx, ex = points[span, 0], points[span + 1, 0], points[span + 2, 0], points[span + 3, 0]
        ay, by, cy, ey = points[span, 1], points[span + 1, 1], points[span + 2, 1], points[span + 3, 1]
        az, bz, cz, ez = points[span, 2], points[span + 1, 2], points[span + 2, 2], points[span + 3, 2]
        x1, x2 = min(min(ax, bx), min(cx, ex)), max(max(ax, bx), max(cx, ex))
        y1, y2 = min(min(ay, by), min(cy, ey)), max(max(ay, by), max(cy, ey))
        z1, z2 = min(min(az, bz), min(cz, ez)), max(max(az, bz), max(cz, ez))
        near_wall = x1 < low_x or y1 < low_y or z1 < low_z or x2 > high_x or y2 > high_y or z2 > high_z
        if not near_wall and not voxels:  # a hull clear of everything is a span clear of it
            i1, i2 = cell_along(x1, x0, per_metre, nx), cell_along(x2, x0, per_metre, nx) + 1
            j1, j2 = cell_along(y1, y0, per_metre, ny), cell_along(y2, y0, per_metre, ny) + 1
            k1, k2 = cell_along(z1, z0, per_metre, nz), cell_along(z2, z0, per_metre, nz) + 1
            below = sums[i2, j2, k1] - sums[i1, j2, k1] - sums[i2, j1, k1] + sums[i1, j1, k1]
            if sums[i2, j2, k2] - sums[i1, j2, k2] - sums[i2, j1, k2] + sums[i1, j1, k2] == below:
                continue
        for s in range(SAMPLES):
            w0, w1, w2, w3 = b[span, 0, s], b[span, 1, s], b[span, 2, s], b[span, 3, s]
            px = w0 * ax + w1 * bx + w2 * cx + w3 * ex
            py = w0 * ay + w1 * by + w2 * cy + w3 * ey
            pz = w0 * az + w1 * bz + w2 * cz + w3 * ez
            ix, iy, iz = (
                cell_along(px, x0, per_metre, nx),
                cell_along(py, y0, per_metre, ny),
                cell_along(pz, z0, per_metre, nz),
            )
            cell = (ix * ny + iy) * nz + iz
            first, end = starts[cell], starts[cell + 1]
            if first == end and not near_wall and not voxels:
                continue
            fx, fy, fz = 0.0, 0.0, 0.0
            for item in range(first, end):
                k = items[item]
                if solids[k, 0] < PRISM:
                    if beyond(solids, k, px, py, c):  # as most listed ones are
                        continue
                    d, gx, gy, gz = plain_distance(solids, k, px, py, pz)
                else:
                    d, gx, gy, gz = prism_distance(solids, edges, k, px, py, pz)
                if d < c:
                    h, dh = hinge(c - d, c)  # Eq. 39, one solid
                    total += h
                    fx -= dh * gx
                    fy -= dh * gy
                    fz -= dh * gz
            if voxels:
                d, gx, gy, gz = interpolate(distances, vx, vy, vz, resolution, c, px, py, pz)
                if d < c:
                    h, dh = hinge(c - d, c)  # the voxels count as one solid
                    total += h
                    fx -= dh * gx
                    fy -= dh * gy
                    fz -= dh * gz
            if near_wall:
                hx, push_x = _between(px, low_x, high_x, c)
                hy, push_y = _between(py, low_y, high_y, c)
                hz, push_z = _between(pz, low_z, high_z, c)
                total += hx + hy + hz
                fx += push_x
                fy += push_y
                fz += push_z
            for q in range(4):
                slopes[span + q, 0] += b[span, q, s] * fx
                slopes[span + q, 1] += b[span, q, s] * fy
                slopes[span + q, 2] += b[span, q, s] * fz
    for i in range(f):
        for a in range(3):
            gradient[3 * i + a] += p.scale * slopes[FIXED + i, a]
    return p.scale * total


@leaf
def snap(x: FloatArray, p: Problem) -> None:
    """Move the control points that via points determine: even knots give C(u_k) = (P_{i-1} + 4 P_i + P_{i+1})/6."""
    f = p.energy.shape[0]
    for k in range(p.via_at.size):
        i = p.via_at[k]
        for a in range(3):
            before = x[3 * i - 3 + a] if i > 0 else p.points[FIXED - 1, a]
            after = x[3 * i + 3 + a] if i < f - 1 else p.points[FIXED + f, a]
            x[3 * i + a] = 1.5 * p.via[k, a] - 0.25 * (before + after)


@leaf
def cost_gradient(x: FloatArray, gradient: FloatArray, p: Problem) -> float:
    """J(x) [m] with its gradient [1] written into `gradient`; x (3 f,) are the free control points, row after row.

    With via points, x is moved onto them first, and the gradient is that by the other control points.
    """
    snap(x, p)
    energy: float = add_energy(x, gradient, p)
    obstacles: float = add_obstacles(x, gradient, p)
    f = p.energy.shape[0]
    for k in range(p.via_at.size):
        i = p.via_at[k]
        for a in range(3):
            if i > 0:
                gradient[3 * i - 3 + a] -= 0.25 * gradient[3 * i + a]
            if i < f - 1:
                gradient[3 * i + 3 + a] -= 0.25 * gradient[3 * i + a]
            gradient[3 * i + a] = 0.0
    return energy + obstacles


class SplineCost:
    """The cost of curves from `start` to `goal` with n control points.

    Parameters
    ----------
    world : World
    start, goal : (3,)    [m].
    n : int               control points, more than 2 FIXED.
    limits : Limits       speed and acceleration fix the weight of smoothness.
    reach : float         c, where the hinge begins [m]; positive.
    length : float        D, about how long the way will be [m]; the straight distance when not given.
    softest : float       bound on m, the way in which smoothness lets the speed change [m].
    grid : Grid           of `build_grid(world, c)` with at least this reach; built when not given.
    pinned : (6, 3)       the first and the last FIXED control points; at rest at both ends when not given [m].
    via : (m, 3)          points on the curve [m], at the knots `via_knots` (m,), counted in spans from the start: at
                          least 2 from each other and from the ends.
    """

    def __init__(
        self,
        world: World,
        start: FloatArray,
        goal: FloatArray,
        n: int,
        limits: Limits,
        reach: float,
        weight: float = WEIGHT,
        length: float | None = None,
        softest: float = np.inf,
        grid: Grid | None = None,
        pinned: FloatArray | None = None,
        via: FloatArray | None = None,
        via_knots: IntArray | None = None,
    ) -> None:
        if n <= 2 * FIXED:
            raise ValueError(f"control points: expected more than {2 * FIXED}, found {n}")
        if not reach > 0.0:
            raise ValueError(f"reach: expected above 0 m, found {reach}")
        self.n, self.size = n, 3 * (n - 2 * FIXED)
        self.world, self.reach, self.weight = world, reach, weight
        self.ends = np.array([start, goal], dtype=np.float64)
        shape = _Shape.of(n)
        self.knots = shape.knots  # (n + 4,) on [0, 1]
        self.way = float(np.linalg.norm(self.ends[1] - self.ends[0])) if length is None else length
        self.distance = max(self.way, SHORTEST)
        m = min(limits.speed**2 / limits.acceleration, self.distance, softest)
        self._stretch: FloatArray = shape.stretch / self.distance  # Eq. 37
        self._smooth: FloatArray = (m / (self.distance + m)) ** 2 * shape.smoothness / self.distance  # Eq. 38
        whole: FloatArray = self._stretch + self._smooth  # Eq. 36 without its obstacles
        self.pinned = np.repeat(self.ends, FIXED, axis=0) if pinned is None else pinned
        points: FloatArray = np.repeat(self.pinned[[0, -1]], (FIXED, n - FIXED), axis=0)
        points[:FIXED], points[n - FIXED :] = self.pinned[:FIXED], self.pinned[FIXED:]
        free = slice(FIXED, n - FIXED)
        ends: FloatArray = points - self.ends[0]
        ends[free] = 0.0
        linear: FloatArray = whole[free] @ ends
        spans = n - DEGREE
        self.problem = Problem(
            energy=np.ascontiguousarray(whole[free, free]),
            linear=linear,
            constant=float((ends * (whole @ ends)).sum()),
            origin=self.ends[0],
            relative=np.zeros(self.size),
            basis=shape.basis,
            points=points,
            slopes=np.zeros((n, 3)),
            scene=world.scene,
            walls=world.walls,
            grid=build_grid(world, reach) if grid is None else grid,
            reach=reach,
            scale=weight * self.distance / (reach**2 * spans * SAMPLES),  # Eq. 39's k and its du
            via=np.empty((0, 3)) if via is None else via,
            via_at=np.empty(0, dtype=np.int64) if via_knots is None else via_knots + 1 - FIXED,
        )
        self.inverse_energy = self._inverse_energy()

    def _inverse_energy(self) -> FloatArray:
        """Inverse (f, f) of the quadratic form on what is free; rows that via points determine are zero."""
        energy, at = self.problem.energy, self.problem.via_at
        if not at.size:
            return np.asarray(np.linalg.inv(energy), dtype=np.float64)
        f = len(energy)
        onto = np.eye(f)
        for i in at:
            onto[i, i] = 0.0
            onto[i, [j for j in (i - 1, i + 1) if 0 <= j < f]] = -0.25
        kept = np.setdiff1d(np.arange(f), at)
        onto = onto[:, kept]
        inverse = np.zeros((f, f))
        inverse[np.ix_(kept, kept)] = np.linalg.inv(onto.T @ energy @ onto)
        return inverse

    def snapped(self, x: FloatArray) -> FloatArray:
        """The free control points x (3 f,) with those that via points determine moved onto them."""
        moved = np.array(x, dtype=np.float64)
        snap(moved, self.problem)
        return moved

    def stiffened(self, factor: float) -> Problem:
        """The same problem with obstacles weighed `factor` times as much."""
        return self.problem._replace(scale=self.problem.scale * factor)

    def __call__(self, x: FloatArray) -> tuple[float, FloatArray]:
        """J [m] and its gradient (3 f,) at the free control points x (3 f,)."""
        gradient = np.empty(self.size)
        return float(cost_gradient(np.array(x, dtype=np.float64), gradient, self.problem)), gradient

    def control_points(self, x: FloatArray) -> FloatArray:
        """All control points (n, 3) [m] from the free ones (3 f,)."""
        points = np.empty((self.n, 3))
        points[:FIXED], points[self.n - FIXED :] = self.pinned[:FIXED], self.pinned[FIXED:]
        points[FIXED : self.n - FIXED] = np.asarray(x).reshape(-1, 3)
        return points

    def stretch(self, x: FloatArray) -> float:
        """J_stretch [m], from the quadratic form on all control points."""
        points = self.control_points(x) - self.ends[0]
        return float((points * (self._stretch @ points)).sum())

    def smoothness(self, x: FloatArray) -> float:
        """J_smooth [m], from the quadratic form on all control points."""
        points = self.control_points(x) - self.ends[0]
        return float((points * (self._smooth @ points)).sum())

    def energy(self, x: FloatArray) -> float:
        """J_stretch + J_smooth [m], the quicker way."""
        return float(add_energy(np.ascontiguousarray(x, dtype=np.float64), np.empty(self.size), self.problem))

    def obstacle(self, x: FloatArray) -> float:
        """J_obstacle [m]."""
        return float(add_obstacles(np.ascontiguousarray(x, dtype=np.float64), np.zeros(self.size), self.problem))

    def terms(self, x: FloatArray) -> CostTerms:
        """The three terms apart."""
        return CostTerms(self.stretch(x), self.smoothness(x), self.obstacle(x))


class _Shape:
    """What depends on the number of control points alone; kept, since most plans use the same few."""

    _kept: "dict[int, _Shape]" = {}  # noqa: RUF012 a cache of pure values, keyed by n

    def __init__(self, n: int) -> None:
        self.knots = knots = clamped_knots(n)
        spans = n - DEGREE
        u = (np.arange(spans * SAMPLES) + 0.5) / (spans * SAMPLES)
        full = basis(knots, n, u).reshape(spans, SAMPLES, n)
        self.basis: FloatArray = np.empty((spans, 4, SAMPLES))
        for span in range(spans):
            self.basis[span] = full[span, :, span : span + 4].T
        self.stretch: FloatArray = gram_matrix(knots, n, 1)
        self.smoothness: FloatArray = gram_matrix(knots, n, 2)

    @classmethod
    def of(cls, n: int) -> "_Shape":
        if n not in cls._kept:
            cls._kept[n] = cls(n)
        return cls._kept[n]
