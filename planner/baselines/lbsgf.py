"""L-BSGF, "Laplacian-based spline gradient flow": our reading, since nothing in reach defines it.

The flow dP/dt = -K^-1 grad J(P) of the control points P on HAOAROA's cost, where K = tridiag(-1, 2, -1) is the discrete
Laplacian of the control polygon with fixed ends. K^-1 spreads a push on one point along the whole curve, as CHOMP's
covariant gradient does (Ratliff, Zucker, Bagnell & Srinivasa, ICRA 2009). Euler's steps, whose length grows by GROW
when the cost falls and is cut to SHRINK of itself, the step taken back, when it does not.

It descends, no more: so each of HAOAROA's seeds flows for itself, STEPS evaluations long, and what they come to is put
to the proof, the cheapest first.
"""

from collections.abc import Iterator

import numpy as np

from planner.bspline import FloatArray
from planner.cost import Problem, cost_gradient
from planner.jit import kernel
from planner.query import Query
from planner.search.asktell import ITERATIONS
from planner.shape import ELITES, Effort, Search, Shape

STEPS = ITERATIONS
"""Evaluations for each seed: with 20 seeds, the budget of 20 x 100."""
GROW, SHRINK = 1.5, 0.4
FIRST = 0.2
"""The first step moves some coordinate this far [m], and none goes farther than LONGEST at once [m]."""
LONGEST = 0.7


def inverse_laplacian(f: int) -> FloatArray:
    """K^-1 (f, f) of K = tridiag(-1, 2, -1): min(i, j) (f + 1 - max(i, j))/(f + 1), i and j counted from 1."""
    i = np.arange(1, f + 1)
    found: FloatArray = np.minimum(i[:, None], i) * (f + 1 - np.maximum(i[:, None], i)) / (f + 1)
    return found


@kernel
def flow(x: FloatArray, inverse: FloatArray, problem: Problem, most: int) -> float:
    """Flow from x (3 f,), in place, for `most` evaluations. The cost reached [m]."""
    n, f = x.size, inverse.shape[0]
    g, g_new, x_new, p = np.empty(n), np.empty(n), np.empty(n), np.empty(n)
    cost = cost_gradient(x, g, problem)
    step, fresh = 0.0, True
    for _ in range(most - 1):
        if fresh:
            largest = 0.0
            for i in range(f):
                a0, a1, a2 = 0.0, 0.0, 0.0
                for j in range(f):
                    a0 += inverse[i, j] * g[3 * j]
                    a1 += inverse[i, j] * g[3 * j + 1]
                    a2 += inverse[i, j] * g[3 * j + 2]
                p[3 * i], p[3 * i + 1], p[3 * i + 2] = a0, a1, a2
                largest = max(largest, abs(a0), abs(a1), abs(a2))
            if not largest > 0.0:
                break
            step = FIRST / largest if step == 0.0 else min(step * GROW, LONGEST / largest)
        for k in range(n):
            x_new[k] = x[k] - step * p[k]
        cost_new = cost_gradient(x_new, g_new, problem)
        fresh = cost_new < cost
        if fresh:
            cost = cost_new
            x[:], g[:] = x_new, g_new
        else:
            step *= SHRINK
    return cost


def find_lbsgf(query: Query, effort: Effort) -> Iterator[Shape]:
    """The curves that the flow comes to, cheapest first, ELITES at most."""
    work = Search(query, effort)
    cost = work.first_cost()
    inverse = inverse_laplacian(cost.size // 3)
    reached = []
    for seed in work.seeds(cost):
        x = np.array(seed)
        reached.append((flow(x, inverse, cost.problem, STEPS), x))
        effort.evaluations += STEPS
    effort.iterations += STEPS
    for _, x in sorted(reached, key=lambda pair: pair[0])[:ELITES]:
        effort.tried += 1
        yield work.shape_of(cost, work.inside(cost, x))
