"""Fig. 6: control laws tuned alike and flown on seeds that none of them has seen, and optimisers at equal budgets.

`campaigns.tuning.compare` does the work; here it becomes rows.
"""

import math
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from campaigns.executors import Executor
from campaigns.tuning.compare import CONDITIONS, LAWS, UNIT, Say, compare_controllers, compare_optimisers, law_spec
from campaigns.tuning.cost import FlightFigures
from campaigns.tuning.optimisers import METHODS
from campaigns.tuning.statistics import Interval
from fakevehicle.control.gains import PARAMETERS, PRESETS

POPULATION = 20
"""The paper's."""
FEWEST = 5
"""Candidates, of differential evolution."""
SPEED = 5.0
"""Of the figure of eight [m/s]."""
METHOD = "haoaroa"
"""By which laws are tuned: the paper's own."""
TUNED = "FOPID-TID"
SHOWN = ("KP", "KT", "KI", "KD", "LAMBDA", "MU")
"""Of a velocity loop's parameters, those that are drawn beside the paper's five."""


@dataclass(frozen=True, slots=True)
class Courses:
    """What tunings fly, each in calm and in gusts; as in `sizes`."""

    eight_s: float
    step_m: float
    train: int

    def conditions(self) -> dict[str, object]:
        """As `compare_controllers` takes them."""
        eight = {"eight": {"speed": SPEED, "seconds": self.eight_s}}
        step = [{"step": {"metres": self.step_m}}] if self.step_m > 0.0 else []
        return {**CONDITIONS, "courses": [eight, *step], "train": self.train}


@dataclass(frozen=True, slots=True)
class Laws:
    """All laws, each tuned with so many evaluations and judged on so many seeds."""

    courses: Courses
    budget: int
    unseen: int


@dataclass(frozen=True, slots=True)
class Optimisers:
    """Every optimiser on the first law, so many evaluations and seeds of chance."""

    courses: Courses
    budget: int
    seeds: int


def tuners() -> tuple[str, ...]:
    """The optimisers that are here: CMA-ES comes by an extra."""
    return tuple(method for method in METHODS if method != "cma" or find_spec("cmaes") is not None)


def population(budget: int) -> int:
    """Candidates at a time: the paper's, or fewer for four rounds of them, and as many as every optimiser wants."""
    return max(FEWEST, min(POPULATION, budget // 4))


def laws(item: Laws, executor: Executor, folder: Path, say: Say) -> dict[str, Any]:
    """Tune and judge every law: rows for each law and wind, and the gains of the velocity loops.

    `change_percent` is FOPID-TID's RMS against that row's, seed by seed: below zero it is the better one.
    """
    compared = compare_controllers(
        budget=item.budget,
        seeds=item.unseen,
        population=population(item.budget),
        method=METHOD,
        conditions=item.courses.conditions(),
        executor=executor,
        folder=folder,
        say=say,
    )
    rows = []
    for name, law in compared.laws.items():
        for wind in compared.winds:
            row = {"law": name, "wind": wind, "seeds": item.unseen, "largest_m": _finite(law.largest(wind))}
            row |= _told("rms_m", compared.rms(name, wind)) | _shares(law.flights, wind)
            row |= {} if name == TUNED else _told("change_percent", compared.change(TUNED, wind, name), 100.0)
            rows.append(row)
    defaults = {parameter.name: parameter.default for parameter in PARAMETERS}
    gains = {}
    for name, law in compared.laws.items():
        values = {**defaults, **PRESETS[LAWS[name][0]], **law.found.values}
        gains[name] = {term: float(values[f"FT_VXY_{term}"]) for term in SHOWN}
    return {
        "budget": item.budget,
        "population": population(item.budget),
        "winds": list(compared.winds),
        "unit": UNIT,
        "rows": rows,
        "gains": gains,
        "costs": {name: law.found.cost for name, law in compared.laws.items()},
    }


def optimisers(item: Optimisers, executor: Executor, folder: Path, say: Say) -> dict[str, Any]:
    """Run every optimiser: its lowest costs with mean and extremes, the mean trace, and what all of them began with."""
    spec = law_spec(
        TUNED,
        budget=item.budget,
        population=population(item.budget),
        search_seed=1,
        seeds=2,
        conditions=item.courses.conditions(),
    )
    seeds = tuple(range(1, item.seeds + 1))
    found = compare_optimisers(spec, seeds=seeds, executor=executor, folder=folder, methods=tuners(), say=say)
    rows = [
        {
            "optimiser": name,
            "runs": len(trace),
            "cost": float(trace[:, -1].mean()),
            "least": float(trace[:, -1].min()),
            "greatest": float(trace[:, -1].max()),
            "begun": float(trace[0, 0]),
            "costs": [float(v) for v in trace[:, -1]],
            "trace": [round(float(v), 6) for v in np.asarray(trace).mean(axis=0)],
        }
        for name, trace in found.traces.items()
    ]
    return {"budget": item.budget, "population": population(item.budget), "rows": rows}


def _shares(flights: list[FlightFigures], wind: str) -> dict[str, float | None]:
    """RMS over the eights in a wind of what the loops leave, and of what the estimator errs by."""
    mine = [f for f in flights if f.wind == wind and f.course.startswith("eight") and not f.lost]
    control, estimator = (np.array([getattr(f, part) for f in mine]) for part in ("control", "estimator"))
    return {
        "loops_m": float(np.sqrt((control**2).mean())) if mine else None,
        "estimator_m": float(np.sqrt((estimator**2).mean())) if mine else None,
    }


def _told(name: str, value: Interval, unit: float = 1.0) -> dict[str, float | None]:
    """A mean and its half width; None where a flight was lost, or one seed has none."""
    return {name: _finite(unit * value.mean), f"{name}_half": _finite(unit * value.half)}


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
