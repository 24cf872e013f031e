"""Controllers tuned alike, and optimisers at equal budgets.

`compare_controllers`: the four laws are special cases of one (see `fakevehicle.control.fopid_tid`). Each is tuned with
the same cost, courses, seeds, optimiser, budget and population, from its own preset; besides its own terms in velocity
and rate loops each may tune what they share, the position and attitude gains. All are judged on the same unseen seeds,
so that two laws are compared flight by flight. Costs are in units of the preset `UNIT`'s parts for all four.

`compare_optimisers`: one specification, the same budget, several seeds of each search.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from campaigns.executors import Executor
from campaigns.tuning.cost import FlightFigures
from campaigns.tuning.journal import Journal
from campaigns.tuning.optimisers import METHODS
from campaigns.tuning.spec import Spec
from campaigns.tuning.statistics import Interval, change, mean
from campaigns.tuning.tune import Found, find, judged
from fakevehicle.vocabulary import FloatArray

Say = Callable[[str, int, float], None]
"""Told who searches, how many evaluations are done, and the lowest cost so far."""

SHARED: Mapping[str, object] = {
    "MPC_XY_P": {"low": 0.8, "high": 4.0},
    "MC_ROLL_P": {"low": 4.0, "high": 16.0, "also": ["MC_PITCH_P"]},
    "FT_VXY_KI": {"low": 0.3, "high": 20.0, "log": True},
    "FT_VXY_KD": {"low": 0.0, "high": 0.8},
    "FT_RXY_KI": {"low": 2.0, "high": 60.0, "log": True},
    "FT_RXY_KD": {"low": 0.0, "high": 0.8},
}
_PROPORTIONAL = {
    "FT_VXY_KP": {"low": 1.0, "high": 12.0, "log": True},
    "FT_RXY_KP": {"low": 8.0, "high": 45.0, "log": True},
}
_TILT = {
    "FT_VXY_KT": {"low": 0.0, "high": 12.0},
    "FT_VXY_TILTN": {"low": 1.5, "high": 8.0},
    "FT_RXY_KT": {"low": 0.0, "high": 40.0},
}
_ORDERS = {
    "FT_VXY_LAMBDA": {"low": 0.6, "high": 1.0},
    "FT_VXY_MU": {"low": 0.4, "high": 1.0},
    "FT_RXY_LAMBDA": {"low": 0.6, "high": 1.0},
    "FT_RXY_MU": {"low": 0.4, "high": 1.0},
}
LAWS: Mapping[str, tuple[str, Mapping[str, object]]] = {
    "FOPID-TID": ("default", {**SHARED, **_PROPORTIONAL, **_TILT, **_ORDERS}),
    "PID": ("pid", {**SHARED, **_PROPORTIONAL}),
    "FOPID": ("fopid", {**SHARED, **_PROPORTIONAL, **_ORDERS}),
    "TID": ("tid", {**SHARED, **_TILT, "FT_RXY_KP": _PROPORTIONAL["FT_RXY_KP"]}),
}
"""Of each law its preset and what is searched. TID keeps the rate loops' proportional term: with the tilt term alone,
which lags by 90/n degrees, they do not hold the attitude."""
UNIT = "pid"
CONDITIONS: Mapping[str, object] = {
    "set": {"SIM_GPS_P_NOISE": 0.05, "EKF2_GPS_P_NOISE": 0.05, "SIM_GPS_V_NOISE": 0.1, "EKF2_GPS_V_NOISE": 0.1},
    "courses": [{"eight": {"speed": 5.0, "seconds": 12.0}}, {"step": {"metres": 3.0}}],
    "winds": ["calm", {"mean": 8.0, "gusts": 8.0}],
}
"""What every law is tuned and judged in, unless told otherwise: a receiver of 0.05 m, as in docs/benchmarks.md."""


@dataclass(frozen=True, slots=True)
class Law:
    """One law, tuned and judged.

    Attributes
    ----------
    found : what its search came to.
    flights : on the unseen seeds.
    """

    name: str
    found: Found
    flights: list[FlightFigures] = field(repr=False)

    def rms(self, wind: str, course: str = "eight") -> FloatArray:
        """(n_seeds,) RMS distance over ground of each unseen seed in a wind, on courses of this kind [m]."""
        return _each_seed(self.flights, wind, course, "rms")

    def largest(self, wind: str) -> float:
        """Largest distance in space on any course in a wind [m]; inf when a flight was lost."""
        return max((np.inf if f.lost else f.largest) for f in self.flights if f.wind == wind)


@dataclass(frozen=True, slots=True)
class Controllers:
    """Laws compared; `winds` by name, calm first."""

    laws: dict[str, Law]
    winds: tuple[str, ...]

    def rms(self, law: str, wind: str) -> Interval:
        """Mean RMS on the eights with its 95 % interval [m]."""
        return mean(self.laws[law].rms(wind))

    def change(self, law: str, wind: str, against: str = "PID") -> Interval:
        """Relative change of the mean RMS against another law, by pairs of flights; -0.15: 15 % lower."""
        return change(self.laws[law].rms(wind), self.laws[against].rms(wind))


@dataclass(frozen=True, slots=True)
class Optimisers:
    """Lowest cost after every evaluation, (n_seeds, budget), for each method."""

    traces: dict[str, FloatArray]

    def final(self, method: str) -> FloatArray:
        """(n_seeds,) the lowest costs at the end."""
        return self.traces[method][:, -1]


def law_spec(
    law: str,
    *,
    budget: int,
    population: int,
    search_seed: int,
    seeds: int,
    conditions: Mapping[str, object] | None = None,
) -> Spec:
    """The specification that a law is tuned by."""
    base, parameters = LAWS[law]
    return Spec.model_validate(
        {
            "name": law,
            "base": base,
            "unit": UNIT,
            "parameters": parameters,
            "test": seeds,
            "search": {"budget": budget, "population": population, "seed": search_seed},
            **(CONDITIONS if conditions is None else conditions),
        }
    )


def compare_controllers(
    *,
    budget: int,
    seeds: int,
    executor: Executor,
    folder: Path | None = None,
    method: str = "cma",
    population: int = 20,
    search_seed: int = 1,
    laws: Sequence[str] = tuple(LAWS),
    conditions: Mapping[str, object] | None = None,
    say: Say | None = None,
) -> Controllers:
    """Tune each law with `budget` evaluations and judge it on `seeds` unseen seeds.

    Parameters
    ----------
    executor : flies; what is found does not depend on it.
    folder : keeps the evaluations, one folder a law, and goes on with them; None: nothing is kept.
    laws : keys of `LAWS`.
    conditions : keys of a specification in place of `CONDITIONS`.

    Raises
    ------
    CompanionError : as `tune.find`, `tune.judged` and `Journal`.
    """
    compared: dict[str, Law] = {}
    for law in laws:
        spec = law_spec(
            law, budget=budget, population=population, search_seed=search_seed, seeds=seeds, conditions=conditions
        )
        found = _find(spec, law, method, executor, folder, say)
        compared[law] = Law(law, found, judged(spec, found.values, executor, unseen=True).flights)
    winds = dict.fromkeys(f.wind for law in compared.values() for f in law.flights)
    return Controllers(compared, tuple(winds))


def compare_optimisers(
    spec: Spec,
    *,
    seeds: Sequence[int],
    executor: Executor,
    folder: Path | None = None,
    methods: Sequence[str] = METHODS,
    say: Say | None = None,
) -> Optimisers:
    """Search `spec` by each method with each of the `seeds` of chance, at the budget of the specification.

    Raises
    ------
    CompanionError : as `tune.find` and `Journal`.
    """
    traces: dict[str, FloatArray] = {}
    for method in methods:
        rows = []
        for seed in seeds:
            one = spec.model_copy(update={"search": spec.search.model_copy(update={"seed": seed})})
            found = _find(one, f"{method} {seed}", method, executor, folder, say)
            rows.append(np.minimum(np.minimum.accumulate(found.history), found.base_cost))
        traces[method] = np.array(rows)
    return Optimisers(traces)


def _find(spec: Spec, who: str, method: str, executor: Executor, folder: Path | None, say: Say | None) -> Found:
    journal = None
    if folder is not None:
        journal = Journal(folder / who.lower().replace(" ", "-"), about(spec, method), resume=True)
    return find(
        spec, method, executor, journal=journal, progress=None if say is None else lambda n, cost: say(who, n, cost)
    )


def about(spec: Spec, method: str) -> dict[str, object]:
    """What a folder of evaluations belongs to."""
    return {"method": method, **spec.model_dump(mode="json", exclude={"name", "test"})}


def _each_seed(flights: Sequence[FlightFigures], wind: str, course: str, what: str) -> FloatArray:
    """(n_seeds,) RMS over the flights of each seed in a wind on courses of a kind."""
    rows: dict[int, list[float]] = {}
    for f in flights:
        if f.wind == wind and f.course.startswith(course):
            rows.setdefault(f.seed, []).append(np.inf if f.lost else getattr(f, what))
    return np.array([np.sqrt(np.mean(np.square(values))) for values in rows.values()])
