"""The paper's claims as rows: what it says, the figures it printed, and a rule that gives the verdict from our results.

No verdict is written by hand. `reproduced` and `not reproduced` come from what was measured here, `impossible` from
arithmetic on what is printed, and `not testable` from what a test would need and the paper does not tell. Sentences are
templates: every figure in them is the paper's (`printed`) or the rule's (`figures`).
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from campaigns.paper import controllers, equations, printed
from campaigns.paper.printed import PLACES

Results = Mapping[str, Any]
Figures = dict[str, Any]


class Verdict(StrEnum):
    """What came of a claim."""

    REPRODUCED = "reproduced"
    NOT = "not reproduced"
    IMPOSSIBLE = "impossible"
    UNTESTABLE = "not testable"


@dataclass(frozen=True, slots=True)
class Finding:
    """What a rule says: a verdict, figures, and a sentence with them."""

    verdict: Verdict
    why: str
    figures: Figures


@dataclass(frozen=True, slots=True)
class Claim:
    """One claim: where it stands, what it says in our words, figures in it, and the rule."""

    place: str
    says: str
    rule: Callable[[Results], Finding]
    printed: Figures


def judge(results: Results) -> list[dict[str, Any]]:
    """A row a claim, in order: place, says, verdict, why, and the figures of both sentences."""
    rows = []
    for claim in CLAIMS:
        found = claim.rule(results)
        rows.append(
            {
                "place": PLACES[claim.place],
                "says": claim.says.format(**claim.printed),
                "printed": claim.printed,
                "verdict": found.verdict.value,
                "why": found.why.format(**found.figures),
                "figures": found.figures,
            }
        )
    return rows


def held(fact: bool) -> Verdict:
    """Of a claim that a measurement can bear out."""
    return Verdict.REPRODUCED if fact else Verdict.NOT


def refuted(fact: bool) -> Verdict:
    """Of a claim that arithmetic can refute: impossible when it does."""
    return Verdict.IMPOSSIBLE if fact else Verdict.REPRODUCED


# ---- planners -------------------------------------------------------------------------------------------------------

RIVALS = tuple(m for m in printed.METHODS if m != "haoaroa")


_TIMES = " {#_ratio:%} ({#_low:%} to {#_high:%})"


def pair(results: Results, column: str, method: str, rival: str) -> Mapping[str, Any]:
    """The row of `pairs.all_pairs`."""
    return next(
        row for row in results["pairs"] if (row["column"], row["method"], row["rival"]) == (column, method, rival)
    )


def clearly(row: Mapping[str, Any]) -> bool:
    """Whether the method has less than its rival beyond chance."""
    return row["low"] is not None and row["low"] > 1.0


def ahead(
    column: str, rivals: tuple[str, ...], sentence: str, method: str = "haoaroa", form: str = ".3g"
) -> Callable[[Results], Finding]:
    """A rule: the method has less of a column than each rival, each ratio with its interval above one."""

    def rule(results: Results) -> Finding:
        rows = [pair(results, column, method, rival) for rival in rivals]
        figures: Figures = {"n": max(row["n"] for row in rows), "beaten": sum(map(clearly, rows)), "of": len(rows)}
        told = []
        for rival, row in zip(rivals, rows, strict=True):
            figures |= {f"{rival}_{name}": row[name] for name in ("ratio", "low", "high")}
            times = _TIMES.replace("#", rival).replace("%", form) if row["low"] is not None else " -"
            told.append(printed.METHODS[rival] + times)
        return Finding(held(all(map(clearly, rows))), sentence + ": " + ", ".join(told), figures)

    return rule


def astar_shortest(results: Results) -> Finding:
    """Whether A* has the shortest plan in most worlds."""
    shortest, worlds = results["shortest"], sum(results["shortest"].values())
    figures = {"astar": shortest["astar"] + shortest["jps"], "haoaroa": shortest["haoaroa"], "worlds": worlds}
    return Finding(
        held(2 * figures["astar"] > worlds),
        "A*, or JPS with the same length, is shortest in {astar} of {worlds} worlds, HAOAROA in {haoaroa}",
        figures,
    )


def same_grid(results: Results) -> Finding:
    """Both are exact on one grid: unless their lengths are equal, one is not what its name says."""
    row = pair(results, "length_m", "astar", "jps")
    figures = {"largest": row["largest"], "n": row["n"]}
    equal = row["largest"] is not None and row["largest"] < 1e-6
    return Finding(
        Verdict.IMPOSSIBLE if equal else held(clearly(row)),
        "both find a shortest way on their grid, so on one grid the lengths are equal: here the largest difference "
        "in {n} worlds is {largest:.1g} m",
        figures,
    )


def all_certified(results: Results) -> Finding:
    """Whether every method's plan is proved clear in all worlds named."""
    rows = [row for row in results["planners"] if row["family"] in ("L", "H")]
    figures = {"certified": sum(row["certified"] for row in rows), "plans": sum(row["worlds"] for row in rows)}
    return Finding(
        held(figures["certified"] == figures["plans"]),
        "{certified} of {plans} plans on L and H worlds are proved clear along the whole curve",
        figures,
    )


def flown_clear(results: Results) -> Finding:
    """Whether every flight of HAOAROA's plans kept clear and met its mission's expectations."""
    rows = [row for row in results["planners"] if row["method"] == "haoaroa"]
    figures = {
        "flown": sum(row["flown_ok"] for row in rows),
        "worlds": sum(row["worlds"] for row in rows),
        "least": min((row["least_clearance_m"] for row in rows if row["least_clearance_m"] is not None), default=None),
    }
    good = figures["flown"] == figures["worlds"] and figures["least"] is not None and figures["least"] > 0.0
    return Finding(
        held(good),
        "{flown} of {worlds} flights end as their missions expect; the hull never comes nearer than {least:.2f} m"
        if figures["least"] is not None
        else "{flown} of {worlds} flights",
        figures,
    )


def corners(results: Results) -> Finding:
    """Whether A*'s and JPS's ways turn on the spot, and HAOAROA's never."""
    by = {(row["family"], row["method"]): row for row in results["planners"] if row["certified"]}
    families = {row["family"] for row in results["planners"]}
    ours = [by[f, "haoaroa"]["curvature_max"] for f in families if (f, "haoaroa") in by]
    stops = [f for f in families if all((f, m) in by and by[f, m]["curvature_max"] is None for m in ("astar", "jps"))]
    smooth = len(ours) == len(families) and None not in ours
    figures = {"stops": len(stops), "of": len(families), "curvature": max(ours) if smooth else None}
    return Finding(
        held(smooth and len(stops) == len(families)),
        "A* and JPS stop and turn on the spot in {stops} of {of} families of worlds"
        + ("; HAOAROA's median curvature is at most {curvature:.2f} per metre" if smooth else ""),
        figures,
    )


PERIOD_MS = 20.0
"""Between two setpoints of the companion, at 50 Hz [ms]."""


def real_time(results: Results) -> Finding:
    """The conclusion's own doubt: too dear for real time; judged by the period of setpoints."""
    slowest = max(row["cpu_ms"] for row in results["planners"] if row["method"] == "haoaroa" and row["cpu_ms"])
    figures = {"ms": slowest, "period": PERIOD_MS}
    return Finding(
        held(slowest > PERIOD_MS),
        "a plan takes {ms:.1f} ms of CPU at the median of the slowest family, and setpoints are {period:.0f} ms apart",
        figures,
    )


# ---- searches -------------------------------------------------------------------------------------------------------


def searches(results: Results, contender: str, moved: bool) -> list[Mapping[str, Any]]:
    """The rows of one contender on plain or on moved functions."""
    return [row for row in results["searches"] if row["contender"] == contender and row["moved"] is moved]


def zero_everywhere(results: Results) -> Finding:
    """Nine zeros as values of nine functions, one of which has another minimum."""
    figures = dict(equations.michalewicz())
    return Finding(
        refuted(figures["minimum"] != printed.HAOAROA_TOLD),
        "Michalewicz's minimum at two dimensions is {minimum:.6f}, and {greatest:.0f} is the highest value it has: "
        "of f itself the row is the worst result there is",
        figures,
    )


def ackley_zero(results: Results) -> Finding:
    """An exact zero of Ackley's function in binary64."""
    figures = dict(equations.ackley())
    return Finding(
        refuted(figures["at_minimum"] != 0.0),
        "added up as it is written, its formula gives {at_minimum:.2g} at its minimum in double precision",
        figures,
    )


def all_reached(results: Results) -> Finding:
    """HAOAROA on all nine, every run, bare and with the polish that is no part of it."""
    bare, polished = searches(results, "HAOAROA", False), searches(results, "HAOAROA + polish", False)
    figures = {
        "bare": sum(row["reached"] for row in bare),
        "runs": sum(row["runs"] for row in bare),
        "exact": sum(row["exact"] for row in bare),
        "polished": sum(row["reached"] for row in polished),
    }
    return Finding(
        held(figures["exact"] == figures["runs"]),
        "{exact} of {runs} runs end at f* exactly, {bare} near enough; with a polish by gradient, which is no part "
        "of it, {polished}",
        figures,
    )


def beats_parents(results: Results) -> Finding:
    """Whether HAOAROA's mean is below AOA's and ROA's on every function, plain and moved."""
    figures: Figures = {"functions": 0}
    for moved, name in ((False, "plain"), (True, "moved")):
        ours = {row["function"]: row["mean"] for row in searches(results, "HAOAROA", moved)}
        parents = [searches(results, who, moved) for who in ("AOA", "ROA")]
        least = {k: min(row["mean"] for rows in parents for row in rows if row["function"] == k) for k in ours}
        figures |= {"functions": len(ours), name: sum(ours[k] < least[k] for k in ours)}
    return Finding(
        held(figures["plain"] == figures["moved"] == figures["functions"]),
        "by the mean it is ahead of both on {plain} of {functions} functions, and on {moved} when the minima are moved",
        figures,
    )


def parents_miss(results: Results) -> Finding:
    """Whether AOA and ROA, as they were published, never end at f* exactly."""
    rows = [row for who in ("AOA", "ROA") for row in searches(results, f"{who} canonical", False)]
    rows += [row for who in ("AOA", "ROA") for row in searches(results, f"{who} literal", False)]
    exact = [row for row in rows if row["best"] == 0.0]
    figures = {
        "hits": len({row["function"] for row in exact}),
        "of": len({row["function"] for row in rows}),
        "moved": sum(
            row["best"] == 0.0 for who in ("AOA", "ROA") for row in searches(results, f"{who} canonical", True)
        ),
    }
    why = "as published, one of the two hits f* exactly on {hits} of {of} functions"
    origin = ", since both are drawn to the origin; with the minima moved, on {moved}"
    return Finding(held(not exact), why + (origin if exact else ""), figures)


def table_3(results: Results) -> Finding:
    """The arithmetic of the printed rows for AOA and ROA."""
    figures = dict(equations.table_3()) | {"runs": printed.RUNS}
    return Finding(
        refuted(figures["std"] > 0),
        "no {runs} numbers have such a worst, mean and std in {std} of {rows} rows (std is too small by up to a "
        "factor of {factor:.0f}), nor such a mean in {mean}; {below_best} mean is below its own best",
        figures,
    )


def optima_found(results: Results) -> Finding:
    """The red circles of Fig. 5 F."""
    rows = [row for row in searches(results, "HAOAROA", False) if row["function"] in printed.LANDSCAPES]
    figures = {
        "at": sum(row["at_minimum"] for row in rows),
        "runs": sum(row["runs"] for row in rows),
        "missed": sum(row["at_minimum"] < row["runs"] for row in rows),
        "functions": len(rows),
    }
    return Finding(
        held(figures["at"] == figures["runs"]),
        "{at} of {runs} runs end at a minimiser; some miss it on {missed} of {functions} functions",
        figures,
    )


def escapes(results: Results) -> Finding:
    """The updates as they are printed, on the function with the many minima."""
    (row,) = [row for row in searches(results, "HAOAROA literal", False) if row["function"] == "rastrigin"]
    figures = {"reached": row["reached"], "runs": row["runs"], "median": row["median"]}
    return Finding(
        held(row["reached"] == row["runs"]),
        "as printed they are gradient descent and a pull to the best, and explore nothing: {reached} of {runs} runs "
        "reach Rastrigin's minimum, the median ends {median:.2g} above it",
        figures,
    )


# ---- equations ------------------------------------------------------------------------------------------------------


def of_equations(
    figures: Callable[[], Mapping[str, Any]], wrong: Callable[[Mapping[str, Any]], bool], why: str
) -> Callable[[Results], Finding]:
    """A rule from an equation alone."""

    def rule(results: Results) -> Finding:
        found = dict(figures())
        return Finding(refuted(wrong(found)), why, found)

    return rule


# ---- gains ----------------------------------------------------------------------------------------------------------


def gains_hold(results: Results) -> Finding:
    """Whether the printed gains leave no more offset in a steady wind than a PID."""
    by = {row["gains"]: row for row in results["holds"]}
    figures = {"paper": by["paper"]["offset_m"], "pid": by["pid"]["offset_m"], "wind": results["wind"]}
    known = figures["paper"] is not None and figures["pid"] is not None
    return Finding(
        held(known and figures["paper"] <= figures["pid"]),
        "taken for the velocity loops, in {wind:.0f} m/s of steady wind they leave {paper:.2f} m of offset, and a "
        "PID {pid:.2f} m"
        if known
        else "not every set of gains flew",
        figures,
    )


def laws_compared(results: Results) -> Finding:
    """Whether the tuned FOPID-TID has less RMS than each other law in every wind, beyond chance."""
    rows = [row for row in results["laws"]["rows"] if row.get("change_percent") is not None]
    better = [row["change_percent"] + row["change_percent_half"] < 0.0 for row in rows]
    wanted = [row for row in results["laws"]["rows"] if row["law"] != controllers.TUNED]
    figures: Figures = {"better": sum(better), "of": len(wanted), "seeds": wanted[0]["seeds"]}
    told = []
    for k, row in enumerate(row for row in rows if row["law"] == "PID"):
        figures |= {
            f"change_{k}": row["change_percent"],
            f"half_{k}": row["change_percent_half"],
            f"wind_{k}": row["wind"],
        }
        told.append("{change_#:+.1f} ± {half_#:.1f} % ({wind_#})".replace("#", f"{k}"))
    return Finding(
        held(figures["better"] == figures["of"]),
        "tuned alike and flown on {seeds} unseen seeds, its error is clearly less in {better} of {of} comparisons "
        "with PID, "
        "FOPID and TID; against the PID " + ", ".join(told),
        figures,
    )


def best_tuner(results: Results) -> Finding:
    """Whether HAOAROA's mean cost is the lowest of all optimisers at equal budgets."""
    costs = {row["optimiser"]: row["cost"] for row in results["optimisers"]["rows"]}
    best = min(costs, key=lambda name: costs[name])
    figures: Figures = {
        **{f"cost_{name}": cost for name, cost in costs.items()},
        "budget": results["optimisers"]["budget"],
    }
    told = ", ".join(TUNERS[name] + " {cost_#:.3f}".replace("#", name) for name in costs)
    alone = sum(cost == costs[best] for cost in costs.values()) == 1
    return Finding(held(best == "haoaroa" and alone), "mean cost after {budget} evaluations each: " + told, figures)


TUNERS = {"haoaroa": "HAOAROA", "aoa": "AOA", "roa": "ROA", "de": "differential evolution", "cma": "CMA-ES"}


def needs(*wanted: str) -> Callable[[Results], Finding]:
    """A rule: not testable, as long as anything that a test needs is not told.

    Raises
    ------
    ValueError : everything is told: then there is a test to be written.
    """
    missing = [name for name in wanted if name not in printed.TOLD]
    if not missing:
        raise ValueError(f"{', '.join(wanted)}: told, so there is something to test")

    def rule(results: Results) -> Finding:
        return Finding(Verdict.UNTESTABLE, "not told: " + ", ".join(missing), {})

    return rule


LENGTHS_TOLD = ", ".join(printed.METHODS[m] + " {#:.1f} m".replace("#", m) for m in RIVALS)

CLAIMS: tuple[Claim, ...] = (
    Claim(
        "planners",
        "HAOAROA's paths are the shortest: {haoaroa:.1f} m; " + LENGTHS_TOLD,
        ahead("length_m", RIVALS, "length over HAOAROA's in {n} worlds", form=".4f"),
        dict(printed.LENGTHS),
    ),
    Claim("lengths", "A* usually has the shortest path, HAOAROA nearly as short a one", astar_shortest, {}),
    Claim(
        "planners",
        "JPS's path is longer than A*'s, {jps:.1f} m and {astar:.1f} m",
        same_grid,
        {k: printed.LENGTHS[k] for k in ("jps", "astar")},
    ),
    Claim(
        "lengths",
        "L-BSGF and Bezier pay for smoothness with longer paths than A*'s",
        lambda results: _longer_than_astar(results),
        {},
    ),
    Claim(
        "planners",
        "HAOAROA's paths are smoother than A*'s and JPS's",
        ahead("jerk_integral", ("astar", "jps"), "∫ jerk² dt over HAOAROA's in {n} worlds"),
        {},
    ),
    Claim(
        "planners",
        "HAOAROA's paths are the smoothest of all",
        ahead("jerk_integral", RIVALS, "∫ jerk² dt over HAOAROA's in {n} worlds"),
        {},
    ),
    Claim("paths", "A* and JPS turn sharply at corners, HAOAROA does not", corners, {}),
    Claim("paths", "all five methods find their way round the L and the H", all_certified, {}),
    Claim("worlds", "HAOAROA flies L, H, U and Omega worlds safely", flown_clear, {}),
    Claim(
        "planners",
        "flights of HAOAROA's paths are the steadiest",
        ahead("tracking_percentile_m", RIVALS, "tracking error over HAOAROA's in {n} flights"),
        {},
    ),
    Claim(
        "planners",
        "A* and JPS take less computing time than HAOAROA",
        lambda results: _faster_grids(results),
        {},
    ),
    Claim("conclusion", "HAOAROA costs so much computing that real-time use is in doubt", real_time, {}),
    Claim(
        "searches",
        "HAOAROA ends at {zero:.0f} on all nine functions, best, worst, mean, median and std",
        zero_everywhere,
        {"zero": printed.HAOAROA_TOLD},
    ),
    Claim("searches", "on Ackley's function that zero is exact", ackley_zero, {}),
    Claim("searches", "HAOAROA finds the minimum of every function exactly, in every run", all_reached, {}),
    Claim("searches", "HAOAROA is better than AOA and ROA on every function", beats_parents, {}),
    Claim("searches", "AOA and ROA never end at a minimum exactly", parents_miss, {}),
    Claim("searches", "best, worst, mean and std of AOA and ROA over {runs} runs", table_3, {"runs": printed.RUNS}),
    Claim("landscapes", "HAOAROA's optimum is the global one on five landscapes", optima_found, {}),
    Claim("updates", "exploration by buoyancy and exploitation by riders escape local minima", escapes, {}),
    Claim(
        "gains",
        "Kp {KP}, Ki {KI}, Kd {KD}, λ {LAMBDA} and μ {MU} remove steady-state errors well",
        gains_hold,
        dict(printed.GAINS),
    ),
    Claim(
        "gains",
        "they better the base methods by {KP} %, {KI} %, {KD} %, {LAMBDA} % and {MU} %",
        needs("the tuned gains", "the base methods' gains", "the loop and its units", "the measure", "the vehicle"),
        dict(printed.IMPROVEMENTS),
    ),
    Claim("gains", "the tuned FOPID-TID controls better than traditional laws", laws_compared, {}),
    Claim("discussion", "HAOAROA converges to the best gains", best_tuner, {}),
    Claim(
        "derivatives",
        "the four slopes are the derivatives of the basis",
        of_equations(
            equations.slopes,
            lambda f: f["right"] < f["of"],
            "{right} of {of} are; the largest error on a segment is {largest:.2g}",
        ),
        {},
    ),
    Claim(
        "clamped",
        "a clamped vector of {told} knots for {points} control points",
        of_equations(
            equations.knots,
            lambda f: f["printed"] != f["needed"] or f["first"] != f["order"] or f["last"] != f["order"],
            "{printed} are printed, {needed} are needed; the first is there {first} times and the last {last}, both "
            "must be {order}",
        ),
        {"told": printed.KNOTS_TOLD, "points": printed.CONTROL_POINTS},
    ),
    Claim(
        "mixer",
        "four rotors give thrust, roll, pitch and yaw",
        of_equations(
            equations.mixer,
            lambda f: f["rank"] < f["wanted"],
            "the map has rank {rank}, and {wanted} are wanted: roll, pitch and yaw are one and the same pattern of "
            "signs",
        ),
        {},
    ),
    Claim(
        "dynamics",
        "the vertical dynamics of the vehicle",
        of_equations(
            equations.hover,
            lambda f: f["best"] < 0.0,
            "thrust and weight have the same sign: the greatest upward acceleration is {best:.2f} m/s², with no "
            "thrust; it cannot hover",
        ),
        {},
    ),
    Claim(
        "length_cost",
        "a cost whose minimum is the shortest path",
        of_equations(
            equations.length_cost,
            lambda f: f["cost_spread"] < 1e-9 < f["length_spread"],
            "it is the way from end to end: {curves} curves with the same ends differ by {length_spread:.1f} m in "
            "length and by {cost_spread:.0f} in cost",
        ),
        {},
    ),
    Claim(
        "obstacle_cost",
        "a cost that keeps away from obstacles",
        of_equations(
            equations.obstacle_cost,
            lambda f: f["least_at"] == 0.0 and f["lowest_negative"] < -1.0,
            "with a weight above zero it is least {least_at:.0f} m from the obstacle's centre, with one below it has "
            "no minimum",
        ),
        {},
    ),
    Claim(
        "law",
        "the control law adds λ and μ to its output",
        of_equations(
            equations.law_at_rest,
            lambda f: f["u"] != 0.0,
            "then u is {u:.4f} when there is no error at all: it never rests",
        ),
        {},
    ),
    Claim(
        "introduction",
        "paths are adapted in real time to obstacles that move",
        needs("an experiment with anything that moves", "its figures"),
        {},
    ),
)


def _longer_than_astar(results: Results) -> Finding:
    """L-BSGF and Bezier against A*: A* has less length than both."""
    return ahead("length_m", ("lbsgf", "bezier"), "length over A*'s in {n} worlds", "astar", ".4f")(results)


def _faster_grids(results: Results) -> Finding:
    """A* and JPS against HAOAROA: both have less CPU time."""
    rows = [pair(results, "cpu_ms", rival, "haoaroa") for rival in ("astar", "jps")]
    by = {m: [r["cpu_ms"] for r in results["planners"] if r["method"] == m] for m in ("haoaroa", "astar", "jps")}
    figures = {m: max(v for v in values if v is not None) for m, values in by.items()}
    return Finding(
        held(all(map(clearly, rows))),
        "median CPU time of the slowest family: A* {astar:.1f} ms, JPS {jps:.1f} ms, HAOAROA {haoaroa:.1f} ms",
        figures,
    )
