"""What a set of gains costs: four parts of whole flights, each in units of what the base has.

    tracking    RMS over the flights of the RMS distance over ground, truth to setpoint; of a step from SETTLED_S on [m]
    overshoot   largest way beyond the end of a step, along it, mean over the steps; 0 without steps [m]
    activity    RMS of the rate at which the rotors' speeds change [rad/s^2]
    margin      largest sensitivity Ms of the linear model (`margin`), of the worse loop

    cost = sum w_i part_i/base_i / sum w_i

so the base itself costs 1 and 0.9 is a tenth better. Beyond a bound on activity or margin, BEYOND times the share that
it is beyond comes on top, so that laws tuned at equal bounds are equal there. A flight that is lost, by divergence, on
the ground, or far off, costs LOST and more the earlier it ends, however good the others are: large, and finite, so that
a search can go on.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from campaigns.tuning.courses import TICK_S, Eight, Flown, Step, fly
from campaigns.tuning.margin import margins
from campaigns.tuning.spec import Spec
from fakevehicle.airframe import load_airframe
from fakevehicle.flight import PARAMETERS
from fakevehicle.params import ParameterSet
from fakevehicle.vocabulary import FloatArray

SETTLED_S = 2.5
LOST = 100.0
BEYOND = 10.0
"""What it costs to be beyond a bound by as much as the bound."""
FLOORS = {"tracking": 1e-3, "overshoot": 0.01, "activity": 1.0, "margin": 1.0}
"""A base is not taken for better than this, so that a part that it has not can be weighed."""


@dataclass(frozen=True, slots=True)
class Parts:
    """Of one candidate; `lost` is empty, or why a flight was."""

    tracking: float
    overshoot: float
    activity: float
    margin: float
    lost: str = ""
    share: float = 1.0  # flown of all flights


@dataclass(frozen=True, slots=True)
class FlightFigures:
    """One flight, for people and for statistics: over ground, in m."""

    course: str
    wind: str
    seed: int
    rms: float  # truth to setpoint
    control: float  # estimate to setpoint: what the loops leave
    estimator: float  # truth to estimate: what no loop can mend
    largest: float  # truth to setpoint in space; of a step, once it has settled
    overshoot: float
    activity: float
    lost: str


def parts(flown: Sequence[Flown], ms: float) -> Parts:
    """The parts of a candidate whose flights these are, with the margin of its gains."""
    lost = next((f.lost for f in flown if f.lost), "")
    share = float(np.mean([f.share for f in flown]))
    if lost:
        return Parts(math.inf, math.inf, math.inf, ms, lost, share)
    steps = [overshoot(f) for f in flown if isinstance(f.course, Step)]
    return Parts(
        tracking=math.sqrt(np.mean([level(counted(f)) ** 2 for f in flown])),
        overshoot=float(np.mean(steps)) if steps else 0.0,
        activity=math.sqrt(np.mean([activity(f) ** 2 for f in flown])),
        margin=ms,
        share=share,
    )


def score(
    found: Parts, base: Parts, weights: Mapping[str, float], bounds: Mapping[str, float | None] | None = None
) -> float:
    """The cost of `found`; 1 for the base itself, unless a floor is in force or it is beyond a bound."""
    if found.lost:
        return LOST * (2.0 - found.share)
    total = 0.0
    for name, weight in weights.items():
        unit = max(getattr(base, name), FLOORS[name])
        total += weight * getattr(found, name) / unit
    beyond = [float(getattr(found, name)) / most - 1.0 for name, most in (bounds or {}).items() if most is not None]
    return min(total / sum(weights.values()) + BEYOND * sum(max(b, 0.0) for b in beyond), LOST)


def evaluate(task: tuple[Spec, dict[str, float]]) -> Parts:
    """Fly all training flights of a candidate's parameters; ends with the first that is lost."""
    spec, values = task
    body = load_airframe(spec.airframe)
    overrides = {**spec.fixed(), **values}
    flown: list[Flown] = []
    ms = margins(body, ParameterSet(PARAMETERS, overrides)).ms
    todo = [(course, wind, seed) for seed in spec.seeds(unseen=False) for course, wind in spec.flown()]
    for course, wind, seed in todo:
        flown.append(fly(course, wind, seed, ParameterSet(PARAMETERS, overrides), spec.airframe))
        if flown[-1].lost:
            done = sum(f.share for f in flown) / len(todo)
            return Parts(math.inf, math.inf, math.inf, ms, flown[-1].lost, done)
    return parts(flown, ms)


def judge(task: tuple[Spec, dict[str, float], bool, int]) -> list[FlightFigures]:
    """Fly every course and wind with one seed; the task is spec, parameters, unseen, and which of the seeds."""
    spec, values, unseen, k = task
    overrides = {**spec.fixed(), **values}
    seed = spec.seeds(unseen)[k]
    found = []
    for course, wind in spec.flown():
        f = fly(course, wind, seed, ParameterSet(PARAMETERS, overrides), spec.airframe)
        rows = counted(f)
        own = f.belief_n[len(f.belief_n) - len(rows) :]
        found.append(
            FlightFigures(
                course=course_name(f),
                wind=wind_name(wind.mean, wind.gusts, wind.squall),
                seed=seed,
                rms=level(rows),
                control=level(own),
                estimator=level(rows - own),
                largest=float(np.linalg.norm(rows, axis=1).max()) if len(rows) else math.inf,
                overshoot=overshoot(f) if isinstance(f.course, Step) else 0.0,
                activity=activity(f),
                lost=f.lost,
            )
        )
    return found


def counted(flown: Flown) -> FloatArray:
    """The rows of `error_n` that tracking is judged by: of a step those after SETTLED_S."""
    return flown.error_n[round(SETTLED_S / TICK_S) :] if isinstance(flown.course, Step) else flown.error_n


def level(rows: FloatArray) -> float:
    """RMS length over ground of rows (n, 3) [m]; inf of none."""
    return math.sqrt((rows[:, :2] ** 2).sum(axis=1).mean()) if len(rows) else math.inf


def overshoot(flown: Flown) -> float:
    """How far truth went beyond the end of a step, which goes north [m]."""
    return max(float(flown.error_n[:, 0].max()), 0.0) if len(flown.error_n) else math.inf


def activity(flown: Flown) -> float:
    """RMS rate of change of the rotors' speeds [rad/s^2]."""
    steps = np.diff(flown.rotor_speed, axis=0)
    return float(np.sqrt((steps**2).mean())) / TICK_S if len(steps) else math.inf


def course_name(flown: Flown) -> str:
    """For people."""
    course = flown.course
    if isinstance(course, Eight):
        return f"eight {course.speed:g} m/s"
    return f"step {course.metres:g} m" if isinstance(course, Step) else "hover"


def wind_name(mean: float, gusts: float, squall: float) -> str:
    """For people."""
    words = [f"{mean:g} m/s"] if mean else []
    words += [f"gusts {gusts:g}"] if gusts else []
    words += [f"squall {squall:g}"] if squall else []
    return ", ".join(words) or "calm"
