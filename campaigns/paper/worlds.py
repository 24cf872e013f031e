"""Table 2 and Fig. 5: every method on L, H, U and Omega worlds, planned and flown, vehicle and estimator in the loop.

The question asked of a planner is that of the mission which is then flown: hull 0.35 m, 0.4 m of clearance beyond it,
3 m/s, 6 m/s^2, 60 m/s^3. Length and smoothness are the plan's; tracking error and clearance are the flight's, by the
simulator's truth. Smoothness is the integral of jerk squared over time [m^2/s^5], exact, and the largest curvature
[1/m], which is infinite where a method stops and turns on the spot.
"""

import math
from dataclasses import dataclass
from statistics import median
from typing import Any

import numpy as np

from campaigns.paper.printed import METHODS
from companion.cli.worlds import mission_text
from companion.drivers.planning import make_plan
from companion.itinerary import Itinerary
from companion.missionfile import parse_mission
from companion.testing.flight import fly
from companion.testing.spec import FlightSpec
from companion.verdict import Verdict
from planner import PlannerError
from planner.bspline import FloatArray
from planner.families import make

SHOWN = 0
"""Seed of the worlds that are drawn."""
POINTS = 200
"""Of a path that is drawn."""


@dataclass(frozen=True, slots=True)
class Course:
    """One method in one world; the seed is the world's, the planner's and the sensors'."""

    family: str
    seed: int
    method: str
    repeats: int


def mission(family: str, seed: int, method: str) -> bytes:
    """The mission file of a world, planned by a method."""
    text = mission_text(family, seed, make(family, seed))
    return text.replace("\nsteps:\n", f"\nmethod: {method}\nsteps:\n", 1).encode()


def course(item: Course) -> dict[str, Any]:
    """Plan and fly one; what is not certified is not flown. No value: None; an infinite curvature, too."""
    row: dict[str, Any] = {"family": item.family, "seed": item.seed, "method": item.method, "certified": False}
    data = mission(item.family, item.seed, item.method)
    asked = parse_mission(data, f"{item.family} {item.seed}")
    world = asked.planner_world()
    (wanted,) = Itinerary(asked, item.seed).wanted()
    try:
        make_plan(world, wanted)  # compiles
        plans = [make_plan(world, wanted) for _ in range(item.repeats)]
    except PlannerError as error:
        return row | {"cause": str(error), "flown": False}
    made = plans[0]
    curvature = made.report.curvature_max
    row |= {
        "certified": made.certified,
        "length_m": made.length,
        "jerk_integral": made.report.jerk_integral,
        "curvature_max": curvature if math.isfinite(curvature) else None,
        "duration_s": made.trajectory.duration,
        "cpu_ms": median(p.cpu_ms for p in plans),
        "spare_m": made.clearance if made.certified else None,
    }
    result = fly(FlightSpec(data, seed=item.seed)) if made.certified else None
    verdict = None if result is None else result.verdict
    row |= {
        "flown": result is not None,
        "flown_ok": result is not None and result.ok,
        "cause": "" if result is None else result.cause,
        **_flown(verdict),
    }
    if item.seed == SHOWN:
        row["path"] = _thinned(made.trajectory.position(np.linspace(0.0, made.trajectory.duration, POINTS)))
        row["track"] = [] if verdict is None or verdict.track is None else _thinned(verdict.track.position_m)
    return row


def _flown(verdict: Verdict | None) -> dict[str, float | None]:
    """A flight's figures."""
    track = None if verdict is None else verdict.track
    if verdict is None or track is None:
        return dict.fromkeys(("tracking_rms_m", "tracking_percentile_m", "tracking_max_m", "min_clearance_m"))
    return {
        "tracking_rms_m": float(np.sqrt((track.error**2).mean())),
        "tracking_percentile_m": verdict.tracking_error_p95_m,
        "tracking_max_m": verdict.tracking_error_max_m,
        "min_clearance_m": verdict.min_clearance_m,
    }


def _thinned(points: FloatArray) -> list[list[float]]:
    """At most POINTS of the points (n, 3), to the millimetre."""
    every = np.linspace(0, len(points) - 1, min(POINTS, len(points))).round().astype(int)
    return [[round(float(v), 3) for v in point] for point in points[every]]


def items(families: tuple[str, ...], worlds: int, repeats: int) -> list[Course]:
    """Every method in every world."""
    return [
        Course(family, seed, method, repeats) for family in families for seed in range(worlds) for method in METHODS
    ]


COLUMNS = (
    "length_m",
    "jerk_integral",
    "duration_s",
    "cpu_ms",
    "tracking_rms_m",
    "tracking_percentile_m",
    "min_clearance_m",
)
"""Of which medians are told, over the worlds where the method is certified."""


def by_method(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """One row a family and method: medians, and the worst of all flights."""
    made = []
    for family in dict.fromkeys(row["family"] for row in rows):
        for method in METHODS:
            mine = [row for row in rows if row["family"] == family and row["method"] == method]
            good = [row for row in mine if row["certified"]]
            flown = [row for row in good if row["tracking_percentile_m"] is not None]
            made.append(
                {
                    "family": family,
                    "method": method,
                    "worlds": len(mine),
                    "certified": len(good),
                    "flown_ok": sum(row["flown_ok"] for row in good),
                    "curvature_max": _median([row["curvature_max"] for row in good]),
                    **{name: _median([row[name] for row in good]) for name in COLUMNS},
                    "tracking_max_m": max((row["tracking_max_m"] for row in flown), default=None),
                    "least_clearance_m": min((row["min_clearance_m"] for row in flown), default=None),
                }
            )
    return made


def _median(values: list[float | None]) -> float | None:
    """Of numbers, None being infinite; None when there is none, or it is infinite."""
    middle = median(math.inf if v is None else v for v in values) if values else math.inf
    return middle if math.isfinite(middle) else None


def shortest(rows: list[dict[str, Any]]) -> dict[str, int]:
    """In how many worlds each method has the shortest certified plan; of equal ones (1e-6 m) the one told first."""
    wins = dict.fromkeys(METHODS, 0)
    for family, seed in {(row["family"], row["seed"]): None for row in rows}:
        here = [r for r in rows if r["family"] == family and r["seed"] == seed and r["certified"]]
        if here:
            wins[min(here, key=lambda r: round(float(r["length_m"]), 6))["method"]] += 1
    return wins
