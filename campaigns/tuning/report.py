"""What a tuning leaves behind: the parameter file, result.json, tables for people, and two pictures."""

import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from campaigns.tuning.cost import FlightFigures, course_name
from campaigns.tuning.courses import HEIGHT, START_S, TICK_S, Eight, Flown, Step, eight, fly
from campaigns.tuning.journal import write_whole
from campaigns.tuning.spec import Spec
from campaigns.tuning.statistics import Interval, change, mean
from campaigns.tuning.tune import Found, Judged
from companion.errors import CompanionError
from fakevehicle.control.gains import PRESETS
from fakevehicle.flight import PARAMETERS
from fakevehicle.params import ParameterSet
from fakevehicle.vocabulary import FloatArray

PARAMS, RESULT, CONVERGENCE, BEFORE_AFTER = "result.params", "result.json", "convergence.png", "before_after.png"
LARGER = 10
"""Times, by which errors are drawn larger over ground, where they would not be seen."""
BEFORE, AFTER = "#8a8f98", "#0b6fb8"


@dataclass(frozen=True, slots=True)
class Row:
    """One course in one wind, before and after, RMS over ground [m]."""

    course: str
    wind: str
    unseen: bool
    before: Interval
    after: Interval
    change: Interval
    control: tuple[float, float]  # what the loops leave, before and after: estimate to setpoint
    estimator: float  # truth to estimate, after
    largest: float  # after, in space
    lost: int  # flights, after


def rows(before: Judged, after: Judged) -> list[Row]:
    """A row for each course and wind."""
    found = []
    for course, wind in dict.fromkeys((f.course, f.wind) for f in before.flights):
        was, now = _of(before.flights, course, wind), _of(after.flights, course, wind)
        x, y = (np.array([math.inf if f.lost else f.rms for f in flights]) for flights in (was, now))
        found.append(
            Row(
                course=course,
                wind=wind,
                unseen=after.unseen,
                before=mean(x),
                after=mean(y),
                change=change(y, x),
                control=(_rms([f.control for f in was]), _rms([f.control for f in now])),
                estimator=_rms([f.estimator for f in now]),
                largest=max(math.inf if f.lost else f.largest for f in now),
                lost=sum(bool(f.lost) for f in now),
            )
        )
    return found


def parameter_file(spec: Spec, found: Found) -> str:
    """Every parameter of the loops that is not the default, and all that was searched, to the last bit."""
    values = ParameterSet(PARAMETERS, {**spec.fixed(), **found.values})
    kept = [name for name in dict.fromkeys((*PRESETS[spec.base], *_searched(spec)))]
    lines = [f"# {_line(spec.name)}: {found.method}, {len(found.history)} evaluations, cost {found.cost:.4f}"]
    lines += [f"# in units of {spec.unit or spec.base}; fakevehicle --params this-file"]
    lines += [f"{name:<16} {values[name]!r}" for name in sorted(kept)]
    return "\n".join(lines) + "\n"


def result(spec: Spec, found: Found, table: Sequence[Row]) -> dict[str, Any]:
    """What result.json says; the same for the same specification and versions."""
    best = np.minimum.accumulate(np.concatenate([[found.base_cost], found.history]))
    return {
        "name": spec.name,
        "method": found.method,
        "digest": spec.digest(),
        "evaluations": len(found.history),
        "cost": found.cost,
        "base_cost": found.base_cost,
        "values": found.values,
        "parts": asdict(found.parts),
        "base_parts": asdict(found.base),
        "best_so_far": best.tolist(),
        "rows": [asdict(row) for row in table],
    }


def write(spec: Spec, found: Found, table: Sequence[Row], folder: Path) -> None:
    """Write all four files.

    Raises
    ------
    CompanionError : the disk is full or gone.
    """
    try:
        write_whole(folder / PARAMS, parameter_file(spec, found))
        write_whole(folder / RESULT, json.dumps(_finite(result(spec, found, table)), indent=1) + "\n")
        _convergence(found, folder / CONVERGENCE)
        _before_after(spec, found, table, folder / BEFORE_AFTER)
    except OSError as error:
        raise CompanionError(f"{folder}: {error.strerror or error}") from error


def _searched(spec: Spec) -> list[str]:
    return [name for first, span in spec.parameters.items() for name in (first, *span.also)]


def _of(flights: Sequence[FlightFigures], course: str, wind: str) -> list[FlightFigures]:
    return [f for f in flights if f.course == course and f.wind == wind]


def _rms(values: Sequence[float]) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def _line(text: str) -> str:
    """On one line, and without what a file of parameters or a plot would take for something else."""
    return " ".join(text.split()).replace("$", "")


def _finite(value: Any) -> Any:
    """JSON has no infinity: null."""
    if isinstance(value, dict):
        return {k: _finite(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(v) for v in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _convergence(found: Found, path: Path) -> None:
    """Every evaluation, and the lowest so far."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 4.5), layout="constrained")
    axes = figure.subplots()
    n = np.arange(1, len(found.history) + 1)
    best = np.minimum(np.minimum.accumulate(found.history), found.base_cost)
    top = max(found.base_cost, float(best[0])) * 1.6
    shown = found.history <= top
    axes.plot(n[shown], found.history[shown], ".", color=BEFORE, markersize=4, label="evaluation")
    above = int((~shown).sum())
    if above:
        label = f"above, {above} of {len(n)}"
        axes.plot(n[~shown], np.full(above, top), "|", color="#c0392b", markersize=6, label=label, clip_on=False)
    axes.plot(n, best, color=AFTER, linewidth=2, label="lowest so far")
    axes.axhline(found.base_cost, color="black", linewidth=0.8, linestyle="--", label="base")
    axes.set(xlabel="evaluations", ylabel="cost", ylim=(0.95 * best[-1], 1.01 * top), xlim=(0, len(n) + 1))
    axes.set_title(f"{found.method}: cost {found.base_cost:.3f} to {found.cost:.3f}")
    axes.grid(alpha=0.3)
    figure.legend(loc="outside lower center", ncols=4, frameon=False)
    figure.savefig(path, dpi=110)


def _before_after(spec: Spec, found: Found, table: Sequence[Row], path: Path) -> None:
    """The first unseen seed flown before and after in the last of the winds, and RMS of all unseen seeds."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.0, 7.5), layout="constrained")
    (over, time), (step, bars) = figure.subplots(2, 2)
    seed = spec.seeds(unseen=True)[0]
    flown = spec.flown()
    followed = next((pair for pair in reversed(flown) if not isinstance(pair[0], Step)), None)
    jumped = next((pair for pair in reversed(flown) if isinstance(pair[0], Step)), None)
    for values, colour, label, width in (({}, BEFORE, "before", 2.4), (found.values, AFTER, "after", 1.1)):
        overrides = {**spec.fixed(), **values}
        if followed is not None:
            f = fly(*followed, seed, ParameterSet(PARAMETERS, overrides), spec.airframe)
            meant = _meant(f)
            if not values:
                over.plot(meant[:, 1], meant[:, 0], color="black", linewidth=0.8, linestyle="--", label="meant")
            drawn = meant + LARGER * f.error_n
            over.plot(drawn[:, 1], drawn[:, 0], color=colour, linewidth=width, label=label)
            t = TICK_S * np.arange(len(f.error_n))
            time.plot(t, np.hypot(*f.error_n[:, :2].T), color=colour, linewidth=width, label=label)
            over.set_title(f"{course_name(f)}, the error drawn {LARGER} times larger")
        if jumped is not None:
            f = fly(*jumped, seed, ParameterSet(PARAMETERS, overrides), spec.airframe)
            metres = f.course.metres if isinstance(f.course, Step) else 0.0
            step.plot(TICK_S * np.arange(len(f.error_n)), metres + f.error_n[:, 0], color=colour, lw=width, label=label)
            step.set_title(course_name(f))
    over.set(xlabel="east, m", ylabel="north, m", aspect="equal")
    time.set(xlabel="s", ylabel="distance to the setpoint, m", title="error over ground", ylim=(0, None))
    step.set(xlabel="s after the step", ylabel="north, m")
    for axes, missing in ((over, followed is None), (time, followed is None), (step, jumped is None)):
        axes.set_axis_off() if missing else axes.grid(alpha=0.3)
    for axes in (time, step):
        axes.legend(loc="best")
    over.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), frameon=False)
    unseen = [row for row in table if row.unseen]
    at = np.arange(len(unseen))
    for shift, name, colour in ((-0.2, "before", BEFORE), (0.2, "after", AFTER)):
        told: list[Interval] = [getattr(row, name) for row in unseen]
        bars.bar(at + shift, [v.mean for v in told], 0.38, yerr=[v.half for v in told], color=colour, label=name)
    bars.set_xticks(at, [f"{row.course}\n{row.wind}" for row in unseen], fontsize=8)
    bars.set(ylabel="RMS over ground, m", title=f"{spec.test} unseen seeds, 95 % intervals")
    bars.margins(y=0.2)
    bars.legend(loc="upper left", ncols=2)
    bars.grid(axis="y", alpha=0.3)
    figure.suptitle(_line(spec.name))
    figure.savefig(path, dpi=110)


def _meant(f: Flown) -> FloatArray:
    """(n, 3) where it was meant to be, from the crossing of the eight [m]."""
    meant: FloatArray = np.zeros_like(f.error_n) + np.array([0.0, 0.0, -HEIGHT])
    if isinstance(f.course, Eight):
        first = round(START_S / TICK_S) + 1
        for k in range(len(meant)):
            meant[k] = eight(f.course.speed, (first + k) * TICK_S)[0]
    return meant
