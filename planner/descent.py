"""Loops around the cost kernel: HAOAROA's iterations fused, and an L-BFGS polish.

Both only save the way through Python: the search moves by `search.haoaroa.move`, the one statement of its rule, and
takes its random numbers from the same generator in the same order as ask/tell would.

L-BFGS (Nocedal & Wright, Numerical Optimization, 2nd ed., alg. 7.4) with the inverse of the cost's quadratic part as
the initial metric, so that only obstacles are left to learn; backtracking to Armijo's condition (eq. 3.4).
"""

import numpy as np

from planner.bspline import FloatArray
from planner.cost import Problem, SplineCost, cost_gradient
from planner.jit import kernel
from planner.search.haoaroa import Haoaroa, Population, move, remember

BLOCK = 10
"""Iterations whose random numbers are drawn at once."""
MEMORY = 6
ARMIJO = 1e-4
LONGEST = 0.7
"""A step moves no control point coordinate farther than this [m], unless told otherwise: curves slide around obstacles,
they do not jump.
"""


@kernel
def iterate(p: Population, problem: Problem, first: int, last: int, uniforms: FloatArray) -> None:
    """HAOAROA iterations first, first + 1, ... of last, as many as there are blocks of uniforms (k, n_pop, draws)."""
    for k in range(uniforms.shape[0]):
        for i in range(p.costs.shape[0]):
            p.costs[i] = cost_gradient(p.positions[i], p.gradients[i], problem)
        remember(p)
        move(p, first + k, last, uniforms[k], True)


@kernel
def lbfgs(
    x: FloatArray, metric: FloatArray, problem: Problem, most: int, tolerance: float, longest: float
) -> tuple[float, int]:
    """Descend from x (3 f,), in place. (cost [m], evaluations made), at most about `most` of them.

    `metric` (f, f) is the inverse of the quadratic form, the same for each coordinate. Stops when two steps in a row
    gain less than `tolerance` of the cost.
    """
    n, f = x.size, metric.shape[0]
    S, Y, rho, alpha = np.empty((MEMORY, n)), np.empty((MEMORY, n)), np.empty(MEMORY), np.empty(MEMORY)
    g, g_new, x_new, p, q = np.empty(n), np.empty(n), np.empty(n), np.empty(n), np.empty(n)
    cost = cost_gradient(x, g, problem)
    evaluations, count, idle = 1, 0, 0
    while evaluations < most:
        q[:] = g
        held = min(count, MEMORY)
        for j in range(held):
            m = (count - 1 - j) % MEMORY
            alpha[m] = rho[m] * np.sum(S[m] * q)
            for k in range(n):
                q[k] -= alpha[m] * Y[m, k]
        for i in range(f):
            a0, a1, a2 = 0.0, 0.0, 0.0
            for j in range(f):
                a0 += metric[i, j] * q[3 * j]
                a1 += metric[i, j] * q[3 * j + 1]
                a2 += metric[i, j] * q[3 * j + 2]
            p[3 * i], p[3 * i + 1], p[3 * i + 2] = 0.5 * a0, 0.5 * a1, 0.5 * a2
        for j in range(held - 1, -1, -1):
            m = (count - 1 - j) % MEMORY
            beta = rho[m] * np.sum(Y[m] * p)
            for k in range(n):
                p[k] += (alpha[m] - beta) * S[m, k]
        slope, largest = 0.0, 0.0
        for k in range(n):
            slope -= g[k] * p[k]
            largest = max(largest, abs(p[k]))
        if not slope < 0.0:
            if count == 0:
                break
            count = 0  # the memory has gone bad: start again from the metric
            continue
        step = min(1.0, longest / largest)
        while True:
            for k in range(n):
                x_new[k] = x[k] - step * p[k]
            cost_new = cost_gradient(x_new, g_new, problem)
            evaluations += 1
            if cost_new <= cost + ARMIJO * step * slope or evaluations >= most:
                break
            step *= max(0.1, min(0.5, -0.5 * slope * step / (cost_new - cost - slope * step)))  # parabola's minimum
        if cost_new >= cost:
            break
        sy = np.sum((x_new - x) * (g_new - g))
        if sy > 1e-12:
            m = count % MEMORY
            S[m, :], Y[m, :], rho[m] = x_new - x, g_new - g, 1.0 / sy
            count += 1
        idle = idle + 1 if cost - cost_new < tolerance * cost else 0
        cost = cost_new
        x[:], g[:] = x_new, g_new
        if idle == 2:
            break
    return cost, evaluations


def search(optimiser: Haoaroa, cost: SplineCost) -> None:
    """Run an optimiser on a spline's cost until its budget is spent."""
    while not optimiser.done:
        count = min(BLOCK, optimiser.iterations - optimiser.iteration)
        uniforms = optimiser.uniforms(count)
        iterate(optimiser.population, cost.problem, optimiser.iteration + 1, optimiser.iterations, uniforms)
        optimiser.advance(count)


def polish(
    cost: SplineCost,
    x: FloatArray,
    factor: float = 1.0,
    most: int = 120,
    tolerance: float = 1e-5,
    longest: float = LONGEST,
) -> tuple[FloatArray, int]:
    """L-BFGS from x (3 f,), obstacles weighed `factor` times as much: the better point and the evaluations it took.

    With a tolerance of 1e-4 the answer depended on the rounding of a map's coordinates, by 2 cm of clearance.
    """
    better = np.array(x, dtype=np.float64)
    _, evaluations = lbfgs(better, cost.inverse_energy, cost.stiffened(factor), most, tolerance, longest)
    return better, evaluations
