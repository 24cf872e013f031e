"""All of the paper, in order: stages, results, verdicts, pictures, page."""

import json
from collections.abc import Callable
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import Any

from campaigns.executors import Executor
from campaigns.paper import controllers, figures, functions, holding, printed, search, worlds
from campaigns.paper.claims import judge
from campaigns.paper.page import page
from campaigns.paper.pairs import all_pairs
from campaigns.paper.sizes import FULL, QUICK, Sizes
from campaigns.paper.stages import Kept, Progress, Result, Stage, run, whole, write
from campaigns.paper.verdicts import Verdict
from campaigns.tuning.compare import LAWS
from companion.cli.worlds import CLEARANCE, VEHICLE_RADIUS
from companion.drivers.provenance import revision, version
from fakevehicle.control.gains import PARAMETERS, PRESETS
from planner import shape

PAGE, FIGURES, RESULTS, WORK = "paper.md", "paper", "results.json", "work"
FLYING = ("planner", "companion", "fakevehicle", "wire")
"""Packages whose sources decide a flight."""
PERCENTILE = 95
EACH_S = 0.16
"""One flight of a tuning, roughly [s of CPU]."""
PAIRED = ("length_m", "jerk_integral", "cpu_ms", "tracking_percentile_m")


def stages(sizes: Sizes) -> dict[str, Stage]:
    """What is done one item at a time."""
    searches = search.items(sizes.searches, printed.POPULATION, sizes.iterations)
    return {
        "worlds": Stage(
            "worlds", worlds.course, tuple(worlds.items(sizes.families, sizes.worlds, sizes.repeats)), FLYING
        ),
        "searches": Stage("searches", search.search, tuple(searches), ("planner.search",)),
        "holds": Stage("holds", holding.hold, tuple(holding.items(sizes.holds, sizes.hold_s)), FLYING),
    }


def tunings(sizes: Sizes) -> dict[str, Stage]:
    """What is one item and many flights of its own."""
    courses = controllers.Courses(sizes.eight_s, sizes.step_m, sizes.train)
    laws = controllers.Laws(courses, sizes.laws_budget, sizes.unseen)
    alone = replace(courses, train=1)  # what is compared is the searches: many runs rather than many flights
    optimisers = controllers.Optimisers(alone, sizes.optimisers_budget, sizes.optimiser_seeds)
    packages = ("fakevehicle", "campaigns.tuning", "planner.search")
    return {
        "laws": Stage("laws", controllers.laws, (laws,), packages),
        "optimisers": Stage("optimisers", controllers.optimisers, (optimisers,), packages),
    }


def evaluations(sizes: Sizes) -> dict[str, int]:
    """Of a tuning, how many evaluations it has."""
    return {
        "laws": len(LAWS) * sizes.laws_budget,
        "optimisers": len(controllers.tuners()) * sizes.optimiser_seeds * sizes.optimisers_budget,
    }


def costs(sizes: Sizes) -> dict[str, tuple[int, float]]:
    """Of each stage its items, and what one of them takes, roughly [s of CPU]; for the time that is left."""
    many = {name: len(stage.items) for name, stage in stages(sizes).items()}
    each = sizes.searches * sizes.iterations
    judged = len(LAWS) * sizes.unseen
    of_laws, of_optimisers = evaluations(sizes)["laws"], evaluations(sizes)["optimisers"]
    flights = 2 * (1 + (sizes.step_m > 0.0)) * sizes.train
    return {
        "worlds": (many["worlds"], 0.7),
        "searches": (many["searches"], 6e-5 * each),
        "holds": (many["holds"], 0.4 + 0.03 * sizes.hold_s),
        "laws": (of_laws, EACH_S * flights * (1.0 + judged / sizes.train / of_laws)),
        "optimisers": (of_optimisers, flights * EACH_S),
    }


def make_paper(sizes: Sizes, out: Path, executor: Executor, progress: Progress) -> dict[str, Any]:
    """Do all of it into a folder, going on with what is there; returns the results.

    Parameters
    ----------
    out : gets the page, its pictures and results in a folder of their own, and the work that is kept.

    Raises
    ------
    CompanionError : an item failed, or the folder cannot be written.
    """
    kept = Kept(out / WORK)
    rows = {name: run(stage, kept, executor, progress) for name, stage in stages(sizes).items()}
    for name, stage in tunings(sizes).items():
        work = _with(stage.work, executor, kept.file(stage, stage.items[0]).with_suffix(""), progress.done)
        rows[name] = whole(stage, work, evaluations(sizes)[name], kept, progress)
    results = assembled(sizes, rows)
    write(out / FIGURES / RESULTS, json.dumps(results, indent=1, allow_nan=False, ensure_ascii=False) + "\n")
    figures.draw(results, rows, out / FIGURES)
    write(out / PAGE, page(results, FIGURES))
    return results


def assembled(sizes: Sizes, rows: dict[str, Any]) -> dict[str, Any]:
    """Everything that the page tells, from the stages' rows."""
    results: dict[str, Any] = {
        "made": {"version": version(), "revision": revision(Path(__file__).resolve().parents[2]), "size": sizes.name},
        "sizes": [asdict(one) for one in dict.fromkeys((sizes, FULL, QUICK))],
        "paper": {
            "places": printed.PLACES,
            "methods": printed.METHODS,
            "lengths": printed.LENGTHS,
            "gains": printed.GAINS,
            "symbols": printed.SYMBOLS,
            "table": [
                {"function": c.function, "contender": c.contender, **asdict(c.spread), "wrong": c.wrong}
                | {"least_mean": c.spread.least_mean(printed.RUNS), "least_std": c.spread.least_std(printed.RUNS)}
                for c in printed.CLAIMS
            ],
        },
        "setup": {
            "population": printed.POPULATION,
            "dimension": search.DIMENSION,
            "target": search.TARGET,
            "percentile": PERCENTILE,
            "hull": VEHICLE_RADIUS,
            "clearance": CLEARANCE[sizes.families[0]],
            "planner_iterations": shape.ITERATIONS,
            "planner_elites": shape.ELITES,
            "printed_iterations": printed.PLANNER_ITERATIONS,
        },
        "wind": holding.WIND,
        "functions": functions.table(),
        "planners": worlds.by_method(rows["worlds"]),
        "pairs": all_pairs(rows["worlds"], PAIRED, tuple(printed.METHODS)),
        "shortest": worlds.shortest(rows["worlds"]),
        "searches": [{k: v for k, v in row.items() if k != "points"} for row in rows["searches"]],
        "by_contender": search.by_contender(rows["searches"]),
        "holds": holding.by_gains(rows["holds"]),
        "laws": rows["laws"] | {"presets": _presets(rows["laws"]["gains"])},
        "optimisers": rows["optimisers"],
    }
    claims = results["claims"] = judge(results)
    counts = {verdict.value: sum(claim["verdict"] == verdict for claim in claims) for verdict in Verdict}
    results["verdicts"] = {"claims": len(claims), **counts}
    return results


def _presets(tuned: dict[str, dict[str, float]]) -> dict[str, dict[str, float]]:
    """What the tuning of each law began with, of the gains that are told."""
    defaults = {parameter.name: parameter.default for parameter in PARAMETERS}
    presets = {law: {**defaults, **PRESETS[LAWS[law][0]]} for law in tuned}
    return {law: {term: float(presets[law][f"FT_VXY_{term}"]) for term in tuned[law]} for law in tuned}


def _with(
    work: Callable[..., Result], executor: Executor, folder: Path, done: Callable[[], None]
) -> Callable[[Any], Result]:
    """Of a tuning's work what is left to be given is its item."""

    def say(who: str, count: int, cost: float) -> None:
        done()

    return partial(work, executor=executor, folder=folder, say=say)
