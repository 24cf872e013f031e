"""One front for five optimisers: candidates in the unit cube, evaluated a whole population at a time.

    haoaroa, aoa, roa   `planner.search`, ask/tell, without gradients, shift-invariant
    de                  scipy's differential evolution: best1bin, mutation dithered from 0.5 to 1, recombination 0.7,
                        updated by whole generations, no polish
    cma                 CMA-ES by the `cmaes` package (Nomura & Shibata 2024), sigma 0.25 of the ranges at first; when
                        it has converged it begins again at a random place

All are given the same number of evaluations, the same population and the same first candidate, which the first three
and de put in the place of one of their random ones, and about which cma begins. Chance comes from the seed alone, and
a search sees nothing but costs: the same costs, the same search.
"""

from collections.abc import Callable, Iterable
from importlib.util import find_spec
from typing import Any, Literal, get_args

import numpy as np
from scipy.optimize import Bounds, differential_evolution

from companion.errors import CompanionError
from fakevehicle.vocabulary import FloatArray
from planner.search import Aoa, Haoaroa, Roa

Method = Literal["haoaroa", "aoa", "roa", "de", "cma"]
METHODS: tuple[str, ...] = get_args(Method)
Evaluate = Callable[[FloatArray], FloatArray]
"""Costs (m,) of candidates (m, n_dim), finite."""
SIGMA = 0.25
_ASK_TELL = {"haoaroa": Haoaroa, "aoa": Aoa, "roa": Roa}


def search(method: str, evaluate: Evaluate, start: FloatArray, *, budget: int, population: int, seed: int) -> int:
    """Spend a budget; what is found is for `evaluate` to remember.

    Parameters
    ----------
    start : (n_dim,) the first candidate, in 0..1.
    budget : evaluations; the last population is the last one that fits.

    Returns
    -------
    Evaluations made: the same for every method.

    Raises
    ------
    ValueError : no such method, or a budget that does not pay for one population.
    CompanionError : `cma`, and the package is not there.
    """
    available(method)
    rounds = budget // population
    if rounds < 1:
        raise ValueError(f"budget: found {budget}, expected at least the population, {population}")
    generator = np.random.default_rng(seed)
    if method == "de":
        _evolve(evaluate, start, rounds, population, generator)
    elif method == "cma":
        _adapt(evaluate, start, rounds, population, generator)
    else:
        zero, one = np.zeros(len(start)), np.ones(len(start))
        own = _ASK_TELL[method](zero, one, generator, start[None], population, budget)
        while not own.done:
            own.tell(evaluate(own.ask()))
    return rounds * population


def available(method: str) -> None:
    """Nothing when a method is there; raises as `search`."""
    if method not in METHODS:
        raise ValueError(f"method: found {method!r}, expected one of {', '.join(METHODS)}")
    if method == "cma" and find_spec("cmaes") is None:
        raise CompanionError("method cma needs the package cmaes: pip install 'mavlink-companion[tune]'")


def _evolve(evaluate: Evaluate, start: FloatArray, rounds: int, population: int, generator: Any) -> None:
    """scipy's loop; `workers` is where it hands over a whole generation."""
    first = generator.random((population, len(start)))
    first[0] = start

    def whole(_: object, candidates: Iterable[FloatArray]) -> FloatArray:
        rows = np.array(list(candidates))
        return evaluate(rows) if len(rows) else np.empty(0)

    if rounds == 1:
        evaluate(first)
        return
    differential_evolution(
        float,  # never called: `whole` stands in
        Bounds(np.zeros(len(start)), np.ones(len(start))),
        maxiter=rounds - 1,
        tol=0.0,
        rng=generator,
        init=first,
        polish=False,
        updating="deferred",
        workers=whole,
    )


def _adapt(evaluate: Evaluate, start: FloatArray, rounds: int, population: int, generator: Any) -> None:
    from cmaes import CMA  # an optional extra

    bounds = np.stack([np.zeros(len(start)), np.ones(len(start))], axis=1)
    mean, own = start, None
    for _ in range(rounds):
        if own is None:
            child = int(generator.integers(2**31))
            own = CMA(mean=mean, sigma=SIGMA, bounds=bounds, seed=child, population_size=population)
        rows = np.array([own.ask() for _ in range(population)])
        own.tell(list(zip(rows, evaluate(rows).tolist(), strict=True)))
        if own.should_stop():
            own, mean = None, generator.random(len(start))
