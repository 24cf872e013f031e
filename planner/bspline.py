"""Clamped B-splines: knots, values, derivatives, hulls.

The paper's Eq. 21 is de Boor's recursion, and Eq. 35 the curve it spans; both are printed with slips, so what is used
is (Piegl & Tiller, The NURBS Book, 2nd ed., ch. 2 and 3):

    N_{i,0}(u) = 1 on [u_i, u_{i+1}), 0 elsewhere
    N_{i,p}(u) = (u - u_i)/(u_{i+p} - u_i) N_{i,p-1}(u) + (u_{i+p+1} - u)/(u_{i+p+1} - u_{i+1}) N_{i+1,p-1}(u)
    C(u)       = sum_i N_{i,p}(u) P_i                                                        Eq. 35, its sum restored

n control points of degree p take n + p + 1 knots: ten cubic ones take 14, [0 x4, 1/7 .. 6/7, 1 x4], where the paper
prints 16. Neighbouring pieces share p control points, not two.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planner.errors import KnotError
from planner.jit import kernel

FloatArray = NDArray[np.float64]

DEGREE = 3


def clamped_knots(n: int, duration: float = 1.0, degree: int = DEGREE) -> FloatArray:
    """Knots of a clamped spline on [0, duration] with evenly spaced interior knots.

    Parameters
    ----------
    n : int             Number of control points, at least degree + 1.
    duration : float    End of the parameter's range [s].

    Returns
    -------
    (n + degree + 1,)   [s].

    Raises
    ------
    KnotError : too few control points, or a duration that is not finite and positive.
    """
    if n < degree + 1:
        raise KnotError(f"degree {degree} needs at least {degree + 1} control points, found {n}")
    if not (np.isfinite(duration) and duration > 0):
        raise KnotError(f"duration: expected a finite number above 0, found {duration}")
    spans = n - degree
    inner = np.arange(spans + 1) * (duration / spans)
    inner[-1] = duration
    return np.concatenate([np.zeros(degree), inner, np.full(degree, duration)])


def check_knots(knots: FloatArray, n: int, degree: int = DEGREE) -> None:
    """Raise KnotError unless `knots` clamps a spline of n control points with simple interior knots."""
    if knots.shape != (n + degree + 1,):
        raise KnotError(f"{n} control points of degree {degree} take {n + degree + 1} knots, found shape {knots.shape}")
    if n < degree + 1:
        raise KnotError(f"degree {degree} needs at least {degree + 1} control points, found {n}")
    if not np.isfinite(knots).all():
        raise KnotError("knots: expected finite numbers")
    if (knots[: degree + 1] != knots[0]).any() or (knots[-degree - 1 :] != knots[-1]).any():
        raise KnotError(f"a clamped spline of degree {degree} repeats its first and its last knot {degree + 1} times")
    if (np.diff(knots[degree:-degree]) <= 0).any():
        raise KnotError("knots: expected interior knots that increase")


def evaluate(
    control_points: FloatArray, knots: FloatArray, t: ArrayLike, degree: int = DEGREE, derivative: int = 0
) -> FloatArray:
    """A spline's value or derivative by de Boor's algorithm.

    Parameters
    ----------
    control_points : (n, d)   P_i [m].
    knots : (n + p + 1,)      clamped [s].
    t : scalar or (m,)        clamped to the knots' range [s]; at a knot the piece to its right counts.
    derivative : int          order; above the degree the result is zero.

    Returns
    -------
    (d,) or (m, d)            [m/s^derivative].

    Raises
    ------
    KnotError : an interior knot repeats too often for this derivative.
    """
    times = np.asarray(t, dtype=np.float64)
    if derivative > degree:
        return np.zeros((*times.shape, control_points.shape[1]))
    for _ in range(derivative):
        control_points = derivative_control_points(control_points, knots, degree)
        knots, degree = knots[1:-1], degree - 1
    u = np.minimum(np.maximum(times.reshape(-1), knots[degree]), knots[-degree - 1])
    k = np.minimum(np.maximum(knots.searchsorted(u, side="right") - 1, degree), len(control_points) - 1)
    d = control_points[k[:, None] + np.arange(-degree, 1)]  # (m, p + 1, d): the points this piece is made of
    for r in range(1, degree + 1):
        for j in range(degree, r - 1, -1):
            left, right = knots[k - degree + j], knots[k + 1 + j - r]
            alpha = ((u - left) / (right - left))[:, None]
            d[:, j] = (1.0 - alpha) * d[:, j - 1] + alpha * d[:, j]
    value: FloatArray = d[:, degree].reshape(*times.shape, -1)
    return value


def derivative_control_points(control_points: FloatArray, knots: FloatArray, degree: int) -> FloatArray:
    """Control points of the first derivative of a B-spline.

    The derivative of a degree-p spline has degree p - 1 and the same knots less the first and the last
    (Piegl & Tiller, sec. 3.3):

        Q_i = p (P_{i+1} - P_i) / (u_{i+p+1} - u_{i+1})

    The derivative stays inside the hull of the Q_i, so a bound on every |Q_i| bounds it everywhere between samples.
    `limits.derivative_bounds` rests on this.

    Parameters
    ----------
    control_points : (n, d)   P_i [m].
    knots : (n + p + 1,)      clamped, non-decreasing [s].
    degree : int              p >= 1.

    Returns
    -------
    (n - 1, d)                Q_i [m/s].

    Raises
    ------
    KnotError : an interior knot repeats more than p times.
    """
    n = len(control_points)
    spacing = knots[degree + 1 : degree + n] - knots[1:n]
    if (spacing <= 0).any():
        raise KnotError(f"an interior knot repeats more than {degree} times")
    return degree * (control_points[1:] - control_points[:-1]) / spacing[:, None]


def end_control_points(
    position: FloatArray, velocity: FloatArray, acceleration: FloatArray, knots: FloatArray
) -> FloatArray:
    """The first three control points (3, 3) [m] of a clamped cubic that starts in a given state.

    With d_0, d_1 the first two spans, and from `derivative_control_points` V_0 = 3 (P_1 - P_0)/d_0, V_1 = 3 (P_2 -
    P_1)/(d_0 + d_1), A_0 = 2 (V_1 - V_0)/d_0. At the other end: the time reversed, that is velocity negated, knots
    counted from the end, and the points in reverse.
    """
    d0, d1 = knots[4] - knots[3], knots[5] - knots[4]
    first = position + velocity * (d0 / 3.0)
    return np.array([position, first, first + (velocity + acceleration * (d0 / 2.0)) * ((d0 + d1) / 3.0)])


def basis(knots: FloatArray, n: int, t: ArrayLike, degree: int = DEGREE, derivative: int = 0) -> FloatArray:
    """Every basis function at every time: row j holds N_i(t_j), so that `basis @ P` is the curve.

    Returns
    -------
    (m, n)   each row sums to 1 (to 0 for a derivative).
    """
    return evaluate(np.eye(n), knots, np.atleast_1d(np.asarray(t, dtype=np.float64)), degree, derivative)


def gram_matrix(knots: FloatArray, n: int, derivative: int, degree: int = DEGREE) -> FloatArray:
    """Q_ij = int N_i^(k) N_j^(k) du, so that the integral of |C^(k)|^2 is trace(P^T Q P) (the corrected Eq. 38).

    Exact: on each piece the integrand is a polynomial that Gauss-Legendre with p + 1 - k nodes integrates.
    """
    nodes, weights = np.polynomial.legendre.leggauss(degree + 1 - derivative)
    breaks = np.unique(knots)
    half = np.diff(breaks)[:, None] / 2
    u = (breaks[:-1, None] + half * (1 + nodes)).ravel()
    b = basis(knots, n, u, degree, derivative)
    q: FloatArray = (b.T * (half * weights).ravel()) @ b
    return q


@kernel
def refine(control_points: FloatArray, knots: FloatArray, finer: FloatArray) -> FloatArray:
    """Control points of the same cubic curve, or of a part of it, on other knots.

    A control point is the curve's blossom at its three inner knots, P_i = f(u_{i+1}, u_{i+2}, u_{i+3}) (Ramshaw), taken
    on a piece of the old spline that the new point has a hand in.

    Parameters
    ----------
    control_points : (n, 3)
    knots : (n + 4,)          clamped, interior knots simple.
    finer : (m + 4,)          clamped within the old range, every old knot inside its own range among them.

    Returns
    -------
    (m, 3)
    """
    n, m = control_points.shape[0], finer.shape[0] - 4
    points = np.empty((m, 3))
    d = np.empty(4)
    for i in range(m):
        j = i
        while j < i + 3 and not finer[j] < finer[j + 1]:
            j += 1
        k = 3
        while k < n - 1 and knots[k + 1] <= finer[j]:
            k += 1
        for axis in range(3):
            for q in range(4):
                d[q] = control_points[k - 3 + q, axis]
            for r in range(1, 4):
                u = finer[i + r]
                for q in range(3, r - 1, -1):
                    left, right = knots[k - 3 + q], knots[k + 1 + q - r]
                    alpha = (u - left) / (right - left)
                    d[q] = (1.0 - alpha) * d[q - 1] + alpha * d[q]
            points[i, axis] = d[3]
    return points


@kernel
def bezier_pieces(control_points: FloatArray, knots: FloatArray) -> FloatArray:
    """The same cubic curve as Bezier pieces, one per span.

    A Bezier point of the piece on [a, b] is the blossom f(a, a, a), f(a, a, b), f(a, b, b), f(b, b, b); each is three
    rounds of de Boor's recursion with one argument a round (Ramshaw's multi-affine form).

    Parameters
    ----------
    control_points : (n, 3)
    knots : (n + 4,)          clamped, interior knots simple.

    Returns
    -------
    (n - 3, 4, 3)
    """
    n = control_points.shape[0]
    pieces = np.empty((n - 3, 4, 3))
    d = np.empty(4)
    for k in range(3, n):
        for c in range(4):
            for axis in range(3):
                for j in range(4):
                    d[j] = control_points[k - 3 + j, axis]
                for r in range(1, 4):
                    u = knots[k + 1] if r > 3 - c else knots[k]  # the last c of the three arguments are b
                    for j in range(3, r - 1, -1):
                        left, right = knots[k - 3 + j], knots[k + 1 + j - r]
                        alpha = (u - left) / (right - left)
                        d[j] = (1.0 - alpha) * d[j - 1] + alpha * d[j]
                pieces[k - 3, c, axis] = d[3]
    return pieces


def span_hulls(control_points: FloatArray, degree: int = DEGREE) -> tuple[FloatArray, FloatArray]:
    """A ball around each span: centre (n - p, d) and radius (n - p,), in the control points' unit.

    The span on [u_i, u_{i+1}] lies in the hull of its p + 1 control points; the ball around their mean that reaches the
    farthest of them contains that hull.
    """
    windows = np.lib.stride_tricks.sliding_window_view(control_points, degree + 1, axis=0)  # (n - p, d, p + 1)
    centres = windows.mean(axis=2)
    radii = np.sqrt(((windows - centres[:, :, None]) ** 2).sum(axis=1)).max(axis=1)
    return centres, radii
