"""What tests of the paper share: an executor in this process, made-up rows of all stages, the numbers of a page."""

import json
import re
from bisect import bisect_left
from collections.abc import Callable, Mapping
from functools import cache
from itertools import count, product
from typing import Any

import numpy as np

from campaigns.executors.base import Outcome, answer
from campaigns.paper import page, printed, run, search
from campaigns.paper.sizes import Sizes
from fakevehicle.control.gains import PRESETS
from planner.search import BENCHMARKS

SMALL = Sizes(
    name="small",
    families=("L", "H"),
    worlds=1,
    repeats=1,
    searches=1,
    iterations=10,
    holds=1,
    hold_s=1.0,
    laws_budget=5,
    eight_s=1.0,
    step_m=0.0,
    train=1,
    unseen=2,
    optimisers_budget=5,
    optimiser_seeds=1,
)
LAWS, WINDS = ("FOPID-TID", "PID", "FOPID", "TID"), ("calm", "8 m/s, gusts 8")
RUNS, SEEDS = 5, 4
"""Of the searches, and of whatever else has seeds, in rows that are made up."""


class Here:
    """An executor in this process that counts what it was given."""

    def __init__(self) -> None:
        self.given: list[object] = []

    def map(self, work, items, *, timeout_s=None, retries=0):
        for item in items:
            self.given.append(item)
            done = answer(work, item)
            yield Outcome(item, done.result, done.error)

    def close(self) -> None:
        """Nothing to end."""


class Silent:
    """Progress that nobody sees."""

    def begin(self, stage: str, items: int, kept: int) -> None: ...

    def done(self) -> None: ...


# ---- rows of every stage, made up -----------------------------------------------------------------------------------


def results_of(**changed: Any) -> dict[str, Any]:
    """Everything that the page tells, as read from a file, from rows that are made up, some of them changed."""
    return json.loads(_plain() if not changed else _text(changed))


@cache
def _plain() -> str:
    return _text({})


def _text(changed: Mapping[str, Any]) -> str:
    return json.dumps(run.assembled(SMALL, {name: rows() for name, rows in ROWS.items()} | changed), allow_nan=False)


def chance(seed: int) -> Callable[[], float]:
    """Figures that no other result has."""
    generator = np.random.default_rng(seed)
    return lambda: float(generator.uniform(0.02, 0.2))


def course_rows() -> list[dict[str, Any]]:
    """Every method in some worlds, planned and flown well."""
    figure, plan = chance(1), ("length_m", "jerk_integral", "duration_s", "cpu_ms", "curvature_max")
    flight = ("tracking_rms_m", "tracking_percentile_m", "tracking_max_m", "min_clearance_m")
    return [
        {"family": family, "seed": seed, "method": method, "certified": True, "flown": True, "flown_ok": True}
        | {name: figure() for name in (*plan, *flight)}
        for family, seed, method in product(SMALL.families, range(SEEDS), printed.METHODS)
    ]


def search_rows() -> list[dict[str, Any]]:
    """Every contender on every function; none is exact in all runs, and HAOAROA is not ahead."""
    figure = chance(2)
    names = ("best", "worst", "mean", "median", "std", "cpu_ms")
    return [
        {"function": function.name, "moved": moved, "contender": who.name, "runs": RUNS, "evaluations": 200}
        | {"reached": 3, "exact": 1, "at_minimum": RUNS, "points": [[0.0, 0.0]] * RUNS}
        | {name: figure() for name in names}
        | {"mean": figure() + (who.method == "haoaroa")}
        for function in BENCHMARKS
        for moved in (False, True)
        for who in (*search.CONTENDERS, *search.OTHERS)
    ]


def hold_rows() -> list[dict[str, Any]]:
    """Every set of gains with every seed, held well."""
    figure = chance(3)
    return [
        {"gains": gains, "seed": seed, "ok": True, "cause": "", "offset_m": figure(), "largest_m": figure()}
        for gains in PRESETS
        for seed in range(1, SEEDS + 1)
    ]


def law_rows() -> dict[str, Any]:
    """Laws, tuned and judged."""
    figure = chance(4)
    rows = [
        {"law": law, "wind": wind, "seeds": SEEDS, "largest_m": figure(), "rms_m": figure(), "rms_m_half": figure()}
        | {"estimator_m": figure(), "loops_m": figure()}
        | ({} if law == "FOPID-TID" else {"change_percent": -100 * figure(), "change_percent_half": 100 * figure()})
        for law in LAWS
        for wind in WINDS
    ]
    gains = {law: {term: figure() for term in ("KP", "KT", "KI", "KD", "LAMBDA", "MU")} for law in LAWS}
    told = {"budget": 5, "population": 5, "winds": list(WINDS), "unit": "pid", "rows": rows, "gains": gains}
    return told | {"costs": {law: figure() for law in LAWS}}


def optimiser_rows() -> dict[str, Any]:
    """Optimisers, all of which found something cheaper."""
    figure, rows = chance(5), []
    for name in ("haoaroa", "aoa", "roa", "de", "cma"):
        costs = [figure() for _ in range(SEEDS)]
        row = {"optimiser": name, "runs": SEEDS, "begun": 0.9876, "costs": costs, "trace": [figure()] * 5}
        rows.append(row | {"cost": float(np.mean(costs)), "least": min(costs), "greatest": max(costs)})
    return {"budget": 5, "population": 5, "rows": rows}


ROWS: Mapping[str, Callable[[], Any]] = {
    "worlds": course_rows,
    "searches": search_rows,
    "holds": hold_rows,
    "laws": law_rows,
    "optimisers": optimiser_rows,
}


# ---- the numbers of a page ------------------------------------------------------------------------------------------


def strange_numbers(results: dict[str, Any]) -> list[str]:
    """The numbers of a page that are not its results'.

    The page is made once more, from results in which every number is another, of six digits and to be found there only
    once, and no text has a digit: whatever is then no rounding of one of those stands in the page itself.
    """
    known: list[float] = []
    fresh = (100_003.0 + 97 * k for k in count())

    def replaced(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {key: replaced(inner) for key, inner in value.items()}
        if isinstance(value, list | tuple):
            return [replaced(inner) for inner in value]
        if isinstance(value, str):
            return re.sub(r"\d", "", value)
        if isinstance(value, bool) or value is None:
            return value
        known.append(next(fresh))
        return int(known[-1]) if isinstance(value, int) else known[-1]

    text = page.page(replaced(results), "paper")
    strange = []
    for token in re.findall(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?", text):
        mantissa, _, exponent = token.partition("e")
        reach = 0.5 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2])) * (1.0 + 1e-6)
        at = bisect_left(known, float(token) - reach)
        if at == len(known) or known[at] > float(token) + reach:
            strange.append(token)
    return strange
