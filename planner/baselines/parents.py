"""AOA and ROA alone: HAOAROA's two parents on its own cost, from its own seeds.

Population 20, 20 x 100 evaluations, shift-invariant mode, neither a gradient nor a polish: what each of them brings. A
whole population is evaluated in one compiled call. The best curve ever told is handed over; whether it is clear is for
the proof to say.
"""

from collections.abc import Iterator

import numpy as np

from planner.bspline import FloatArray
from planner.cost import Problem, cost_gradient
from planner.jit import kernel
from planner.query import Query
from planner.search.aoa import Aoa
from planner.search.asktell import ITERATIONS, POPULATION
from planner.search.roa import Roa
from planner.shape import Effort, Search, Shape

BUDGET = POPULATION * ITERATIONS
"""Evaluations."""


@kernel
def costs_of(candidates: FloatArray, costs: FloatArray, problem: Problem) -> None:
    """Write the cost [m] of every candidate (n_pop, 3 f) into `costs` (n_pop,); with via points, move them onto those.

    The gradient comes with the cost, and is dropped.
    """
    gradient = np.empty(candidates.shape[1])
    for i in range(candidates.shape[0]):
        costs[i] = cost_gradient(candidates[i], gradient, problem)


def descend(optimiser: Aoa | Roa, problem: Problem) -> None:
    """Ask and tell until the budget is spent."""
    costs = np.empty(len(optimiser.steps))
    while not optimiser.done:
        costs_of(optimiser.ask(), costs, problem)
        optimiser.tell(costs)


def _parent(kind: type[Aoa] | type[Roa], query: Query, effort: Effort) -> Iterator[Shape]:
    work = Search(query, effort)
    cost = work.first_cost()
    seeds = work.seeds(cost)
    f = cost.size // 3
    optimiser = kind(np.tile(work.lower, f), np.tile(work.upper, f), work.generator, initial=seeds, budget=BUDGET)
    descend(optimiser, cost.problem)
    effort.evaluations += optimiser.evaluations
    effort.iterations += optimiser.iteration
    effort.tried += 1
    yield work.shape_of(cost, work.inside(cost, optimiser.best.position))


def find_aoa(query: Query, effort: Effort) -> Iterator[Shape]:
    """The best curve that AOA alone finds."""
    return _parent(Aoa, query, effort)


def find_roa(query: Query, effort: Effort) -> Iterator[Shape]:
    """The best curve that ROA alone finds."""
    return _parent(Roa, query, effort)
