"""`minimize`: any function, bounds, one of the optimisers, and scipy's OptimizeResult.

    result = minimize(lambda x: ((x - 1) ** 2).sum(), bounds=[(-5, 5)] * 3)

The search takes most of the budget. What is left polishes: L-BFGS-B (Byrd, Lu, Nocedal and Zhu 1995, scipy's) descends
from the distinct best candidates, and then about the best point found, which is displaced at random and replaced when
the descent ends lower (monotonic basin hopping, Leary 2000). Three displacements in four reach just out of the valley:
the reach grows when a descent comes back, and shrinks when it does not. The fourth goes anywhere. The polish is no part
of the algorithms; `polish=0` leaves it out. Every evaluation counts, the ones that go into differences too.
"""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planner.search.aoa import Aoa
from planner.search.asktell import FEWEST, POPULATION, AskTell, Mode
from planner.search.evaluator import Evaluator, Over
from planner.search.haoaroa import Haoaroa
from planner.search.hybrids import HaoaroaCanonical, HaoaroaLiteral
from planner.search.roa import Roa

if TYPE_CHECKING:
    from scipy.optimize import OptimizeResult  # costs half a second to import: brought in where it is used

FloatArray = NDArray[np.float64]

SEARCHES = ("haoaroa", "aoa", "roa")
ITERATIONS = 1000
POLISH = 0.3
"""Share of the budget that polishes."""
ELITES = 5
_APART = 1e-3  # candidates nearer than this to a better one, in widths, are not polished for themselves
_ANYWHERE = 0.25  # share of the descents that begin at a point taken from the whole bounds
_REACH, _SHORTEST, _LONGEST = (
    1e-2,
    1e-4,
    0.5,
)  # standard deviation of a displacement at first, and its bounds, in widths
_GROW, _SHRINK = 1.25, 0.9
_BACK = 0.1  # a descent that ends nearer than this share of the reach to where it was displaced from has come back
_UNIT = 1e-3  # of widths: L-BFGS-B's first step from a candidate
_LARGEST = 1e150
_LOOSE, _TIGHT = 1e-6, 1e-15  # what a step must gain for L-BFGS-B to go on, relative to the cost


class _Stopped(Exception):
    """By the callback."""


def minimize(
    fun: Callable[..., Any],
    bounds: Any,
    *,
    method: str = "haoaroa",
    mode: str = "shift_invariant",
    seed: int | np.random.Generator = 0,
    maxiter: int = ITERATIONS,
    budget: int | None = None,
    population: int = POPULATION,
    x0: ArrayLike | None = None,
    jac: Callable[..., Any] | bool | None = None,
    args: tuple[Any, ...] = (),
    vectorized: bool = False,
    polish: float = POLISH,
    step: float | None = None,
    callback: "Callable[[OptimizeResult], Any] | None" = None,
) -> "OptimizeResult":
    """Least value of a function within bounds.

    Parameters
    ----------
    fun : callable           fun(x, *args) -> float, x (n_dim,); a cost that is NaN or +inf is worse than any number.
    bounds : sequence        (low, high) of each coordinate, finite, low < high; or scipy's Bounds.
    method : str             "haoaroa", "aoa" or "roa".
    mode : str               "shift_invariant", "canonical" or "literal"; see `aoa`, `roa` and `hybrids`.
    seed : int or Generator  the only source of chance: the same seed, the same result.
    maxiter : int            most iterations of the search.
    budget : int             most evaluations of `fun`, polish included; population * maxiter if not given, of which the
                             search then has (1 - polish) maxiter iterations.
    population : int         candidates, at least 4.
    x0 : (n_dim,) or (m, n_dim)   where to begin, at most `population` rows, clipped to the bounds.
    jac : callable or True   jac(x, *args) -> (n_dim,), or True when fun returns cost and gradient. It steers search
                             and polish. Without it only the polish, and literal HAOAROA, take forward differences.
    vectorized : bool        fun takes (m, n_dim) and returns (m,).
    polish : float           share of the budget left to the polish, 0 (none) to below 1.
    step : float             first length of gradient steps, in units of x; a hundredth of the narrowest bounds if not
                             given.
    callback : callable      called after each iteration with an OptimizeResult of x, fun, nit and nfev so far; raising
                             StopIteration, or returning True, ends the search.

    Returns
    -------
    OptimizeResult           x, fun, nit, nfev, njev, success, status, message, and `search_fun`, the best cost before
                             the polish. success is false when no cost was a number (status 1), the function is
                             unbounded (2) or the callback stopped the search (99). There is no test of optimality:
                             success says that the budget was used as asked.

    Raises
    ------
    ValueError               bounds, x0, budget, names or shapes that do not fit; the message names the entry.
    """
    lower, upper = _bounds(bounds)
    total = _budget(budget, maxiter, population, polish)
    initial = _initial(x0, lower, population)
    if method not in SEARCHES:
        raise ValueError(f"method: expected one of {', '.join(SEARCHES)}, found {method!r}")
    if mode not in set(Mode):
        raise ValueError(f"mode: expected one of {', '.join(Mode)}, found {mode!r}")
    if step is not None and not (np.isfinite(step) and step > 0.0):
        raise ValueError(f"step: expected a finite number above 0, found {step!r}")
    if jac is not None and jac is not True and not callable(jac):
        raise ValueError(f"jac: expected a callable, True or None, found {jac!r}")
    if jac is True and vectorized:
        raise ValueError("jac: True means one point a call; give a callable beside a vectorized fun")

    generator = np.random.default_rng(seed)
    evaluator = Evaluator(fun, jac, args, vectorized, lower, upper, total)
    printed = method == "haoaroa" and mode == Mode.LITERAL
    each = 1 + len(lower) if printed and jac is None else 1  # evaluations a candidate
    iterations = min(maxiter, int(total * (1.0 - polish)) // (population * each))
    if iterations < 1:
        raise ValueError(
            f"budget: {total} evaluations do not pay for one iteration of {population * each} and the polish"
        )
    optimiser = _build(
        method,
        Mode(mode),
        lower=lower,
        upper=upper,
        generator=generator,
        initial=initial,
        population=population,
        budget=iterations * population,
        step=0.01 * float((upper - lower).min()) if step is None else float(step),
    )
    status, message, search_cost = 0, f"{iterations} iterations made and the budget used", np.inf
    try:
        slots = _search(optimiser, evaluator, printed or jac is not None, callback)
        search_cost = evaluator.cost
        if polish > 0.0 and np.isfinite(evaluator.cost):
            _polish(evaluator, _distinct(*slots, upper - lower), generator)
    except Over as over:
        if evaluator.cost == -np.inf:
            status, message, search_cost = 2, str(over), min(search_cost, evaluator.cost)
    except _Stopped:
        status, message, search_cost = 99, "stopped by the callback", evaluator.cost
    if status == 0 and not np.isfinite(evaluator.cost):
        status, message = 1, "no cost was a number"
    if evaluator.refused:
        message += f"; {evaluator.refused} costs were NaN or inf"
    return _result(
        evaluator,
        optimiser.iteration,
        njev=evaluator.njev,
        success=status == 0,
        status=status,
        message=message,
        search_fun=search_cost,
    )


def _result(evaluator: Evaluator, nit: int, **more: Any) -> "OptimizeResult":
    """What is known so far, as scipy gives it."""
    from scipy.optimize import OptimizeResult

    result = OptimizeResult()
    result.update(x=evaluator.x.copy(), fun=evaluator.cost, nit=nit, nfev=evaluator.nfev, **more)
    return result


def _bounds(bounds: Any) -> tuple[FloatArray, FloatArray]:
    pairs = list(zip(bounds.lb, bounds.ub, strict=True)) if hasattr(bounds, "lb") else list(bounds)
    if not pairs:
        raise ValueError("bounds: expected a (low, high) for each coordinate, found none")
    for i, pair in enumerate(pairs):
        try:
            low, high = (float(end) for end in pair)
        except (TypeError, ValueError):
            raise ValueError(f"bounds[{i}]: expected (low, high), found {pair!r}") from None
        if not (np.isfinite(high - low) and low < high):
            raise ValueError(f"bounds[{i}]: expected low < high with a finite width, found ({low:g}, {high:g})")
    table = np.array(pairs, dtype=np.float64)
    return table[:, 0].copy(), table[:, 1].copy()


def _budget(budget: int | None, maxiter: int, population: int, polish: float) -> int:
    if population < FEWEST:
        raise ValueError(f"population: expected at least {FEWEST}, found {population}")
    if maxiter < 1:
        raise ValueError(f"maxiter: expected at least 1, found {maxiter}")
    if not 0.0 <= polish < 1.0:
        raise ValueError(f"polish: expected 0 to below 1, found {polish}")
    if budget is not None and budget < population:
        raise ValueError(f"budget: expected at least one population of {population}, found {budget}")
    return population * maxiter if budget is None else int(budget)


def _initial(x0: ArrayLike | None, lower: FloatArray, population: int) -> FloatArray | None:
    if x0 is None:
        return None
    rows = np.atleast_2d(np.asarray(x0, dtype=np.float64))
    if rows.ndim != 2 or rows.shape[1] != len(lower) or len(rows) > population:
        raise ValueError(f"x0: expected up to {population} rows of {len(lower)}, found shape {np.shape(x0)}")
    if not np.isfinite(rows).all():
        raise ValueError(f"x0[{int(np.argmin(np.isfinite(rows).all(axis=1)))}]: expected finite numbers")
    return rows


def _build(method: str, mode: Mode, **common: Any) -> AskTell | Haoaroa:
    match method, mode:
        case "aoa", _:
            return Aoa(mode=mode, **common)
        case "roa", _:
            return Roa(mode=mode, **common)
        case _, Mode.LITERAL:
            return HaoaroaLiteral(**common)
        case _, Mode.CANONICAL:
            return HaoaroaCanonical(**common)
    return Haoaroa(**common)


def _search(
    optimiser: AskTell | Haoaroa,
    evaluator: Evaluator,
    with_gradient: bool,
    callback: "Callable[[OptimizeResult], Any] | None",
) -> tuple[FloatArray, FloatArray]:
    """Spend the optimiser's budget. The best point (n_pop, n_dim) and cost (n_pop,) of every candidate."""
    points = optimiser.ask()
    bests, best_costs = points.copy(), np.full(len(points), np.inf)
    while not optimiser.done:
        points = optimiser.ask()
        if with_gradient:
            costs, gradients = evaluator.costs_and_gradients(points)
            optimiser.tell(costs, gradients)
        else:
            costs = evaluator.costs(points)
            optimiser.tell(costs)
        better = costs < best_costs
        bests[better], best_costs[better] = points[better], costs[better]
        if callback is not None:
            try:
                stop = callback(_result(evaluator, optimiser.iteration)) is True
            except StopIteration:
                stop = True
            if stop:
                raise _Stopped
    return bests, best_costs


def _distinct(points: FloatArray, costs: FloatArray, widths: FloatArray) -> Iterator[FloatArray]:
    """The best candidates, none near a better one."""
    chosen: list[FloatArray] = []
    for i in np.argsort(costs, kind="stable"):
        apart = all(np.max(np.abs(points[i] - other) / widths) > _APART for other in chosen)
        if apart and len(chosen) < ELITES and np.isfinite(costs[i]):
            chosen.append(points[i])
            yield points[i]


def _polish(evaluator: Evaluator, starts: Iterator[FloatArray], generator: np.random.Generator) -> None:
    """Descend from `starts`, then from about the best, until the budget is spent (Over)."""
    widths = evaluator.upper - evaluator.lower
    for start in starts:
        _descend(evaluator, start, _UNIT, _TIGHT)
    reach = _REACH
    while True:  # every descent evaluates, so the budget ends this
        before, centre = evaluator.cost, evaluator.x
        if generator.random() < _ANYWHERE:
            _descend(evaluator, evaluator.lower + widths * generator.random(len(widths)), _REACH, _LOOSE)
        else:
            start = np.clip(
                centre + reach * widths * generator.standard_normal(len(widths)), evaluator.lower, evaluator.upper
            )
            end = _descend(evaluator, start, reach, _LOOSE)
            came_back = bool((np.abs(end - centre) < _BACK * reach * widths).all())
            reach = min(max(reach * (_GROW if came_back else _SHRINK), _SHORTEST), _LONGEST)
        if evaluator.cost < before:
            _descend(evaluator, evaluator.x, _UNIT, _TIGHT)


def _descend(evaluator: Evaluator, start: FloatArray, unit: float, tolerance: float) -> FloatArray:
    """L-BFGS-B from `start` to where it ends (n_dim,); the evaluator remembers the best it met.

    Coordinates are taken in `unit` widths: L-BFGS-B's first step is one long, and should not leave the valley.
    """
    from scipy.optimize import minimize as descend

    lower, widths = evaluator.lower, unit * (evaluator.upper - evaluator.lower)

    def cost(u: FloatArray) -> tuple[float, FloatArray]:
        point = np.clip(lower + u * widths, lower, evaluator.upper)
        values, gradients = evaluator.costs_and_gradients(point[None, :])
        slope = np.clip(gradients[0], -_LARGEST / widths, _LARGEST / widths) * widths
        return float(np.clip(values[0], -_LARGEST, _LARGEST)), slope  # L-BFGS-B asks for numbers it can square

    result = descend(
        cost,
        (start - lower) / widths,
        jac=True,
        method="L-BFGS-B",
        bounds=[(0.0, 1.0 / unit)] * len(start),
        options={"ftol": tolerance, "gtol": 1e-12, "maxiter": 200},
    )
    return np.asarray(lower + result.x * widths, dtype=np.float64)
