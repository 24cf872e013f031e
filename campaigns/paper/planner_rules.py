"""Rules on planners: lengths, smoothness, time, and what became of the flights.

What a rule cannot know, since plans or flights are missing, it does not call reproduced.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from campaigns.paper import printed
from campaigns.paper.verdicts import Figures, Finding, Results, Rule, held

RIVALS = tuple(m for m in printed.METHODS if m != "haoaroa")
NEARLY = 1.02
"""A path is nearly as short when it is at most this many times as long."""
PERIOD_MS = 20.0
"""Between two setpoints of the companion, at 50 Hz [ms]."""

_TIMES = " {#_ratio:%} ({#_low:%} to {#_high:%})"


def pair(results: Results, column: str, method: str, rival: str) -> Mapping[str, Any]:
    """The row of `pairs.all_pairs`."""
    return next(
        row for row in results["pairs"] if (row["column"], row["method"], row["rival"]) == (column, method, rival)
    )


def clearly(row: Mapping[str, Any]) -> bool:
    """Whether the method has less than its rival beyond chance."""
    return row["low"] is not None and row["low"] > 1.0


def most(values: Iterable[float | None]) -> float | None:
    """The greatest that there is."""
    return max((value for value in values if value is not None), default=None)


def told(value: float | None, sentence: str) -> str:
    """A sentence with a value, or what stands for it when there is none."""
    return "-" if value is None else sentence


def of_this_planner(rule: Rule) -> Rule:
    """A rule whose sentence says what is judged under the name HAOAROA: this repository's planner."""

    def judged(results: Results) -> Finding:
        found, setup = rule(results), results["setup"]
        names = {"ours": setup["planner_iterations"], "theirs": setup["printed_iterations"]}
        why = " (HAOAROA is this planner: {ours} iterations and a descent by gradient, not {theirs} iterations alone)"
        return replace(found, why=found.why + why, figures=found.figures | names)

    return judged


def ahead(
    column: str,
    rivals: tuple[str, ...],
    sentence: str,
    method: str = "haoaroa",
    form: str = ".3g",
    places: str = "worlds",
) -> Rule:
    """A rule: the method has less of a column than each rival, each ratio with its interval above one."""

    def rule(results: Results) -> Finding:
        rows = [pair(results, column, method, rival) for rival in rivals]
        figures: Figures = {"n": max(row["n"] for row in rows), "beaten": sum(map(clearly, rows)), "of": len(rows)}
        alike = all(row["n"] == figures["n"] for row in rows)
        each = []
        for rival, row in zip(rivals, rows, strict=True):
            figures |= {f"{rival}_{name}": row[name] for name in ("n", "ratio", "low", "high")}
            times = _TIMES.replace("%", form) if row["low"] is not None else " -"
            count = "" if alike else " in {#_n}"
            each.append(printed.METHODS[rival] + (times + count).replace("#", rival))
        where = f" in {{n}} {places}" if alike else f" in {places}, so many each"
        return Finding(held(all(map(clearly, rows))), f"{sentence}{where}: " + ", ".join(each), figures)

    return rule


def astar_shortest(results: Results) -> Finding:
    """Whether A* has the shortest plan in most worlds, and HAOAROA one at most NEARLY times as long, beyond chance."""
    shortest, worlds = results["shortest"], sum(results["shortest"].values())
    row = pair(results, "length_m", "astar", "haoaroa")
    figures = {"astar": shortest["astar"] + shortest["jps"], "haoaroa": shortest["haoaroa"], "worlds": worlds}
    figures |= {name: row[name] for name in ("ratio", "low", "high")} | {"nearly": NEARLY}
    near = row["high"] is not None and row["high"] <= NEARLY
    length = told(row["high"], "{ratio:.4f} ({low:.4f} to {high:.4f})")
    return Finding(
        held(2 * figures["astar"] > worlds and near),
        "A*, or JPS with the same length, is shortest in {astar} of {worlds} worlds, HAOAROA in {haoaroa}; its length "
        f"over A*'s is {length}, and nearly as short is at most {{nearly}}",
        figures,
    )


def same_grid(results: Results) -> Finding:
    """Whether JPS's path is clearly longer; the paper tells neither a grid nor that both have the same one."""
    row = pair(results, "length_m", "astar", "jps")
    figures = {"largest": row["largest"], "n": row["n"]}
    difference = told(row["largest"], "{largest:.1g} m")
    return Finding(
        held(clearly(row)),
        "if both are exact on one grid they are equal, but the paper does not tell its grids; here the largest "
        f"difference in {{n}} worlds is {difference}",
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
    nearest = told(figures["least"], "{least:.2f} m")
    return Finding(
        held(good),
        f"{{flown}} of {{worlds}} flights end as their missions expect; the nearest that the hull comes is {nearest}",
        figures,
    )


def corners(results: Results) -> Finding:
    """Whether A*'s and JPS's ways turn on the spot, and HAOAROA's never."""
    by = {(row["family"], row["method"]): row for row in results["planners"] if row["certified"]}
    families = {row["family"] for row in results["planners"]}
    ours = [by[f, "haoaroa"]["curvature_max"] for f in families if (f, "haoaroa") in by]
    stops = [f for f in families if all((f, m) in by and by[f, m]["curvature_max"] is None for m in ("astar", "jps"))]
    smooth = 0 < len(ours) == len(families) and None not in ours
    figures = {"stops": len(stops), "of": len(families), "curvature": max(ours) if smooth else None}
    return Finding(
        held(smooth and len(stops) == len(families)),
        "A* and JPS stop and turn on the spot in {stops} of {of} families of worlds"
        + ("; HAOAROA's median curvature is at most {curvature:.2f} per metre" if smooth else ""),
        figures,
    )


def real_time(results: Results) -> Finding:
    """The conclusion's own doubt: too dear for real time; judged on this planner, by the period of setpoints."""
    slowest = most(row["cpu_ms"] for row in results["planners"] if row["method"] == "haoaroa")
    figures = {"ms": slowest, "period": PERIOD_MS}
    plan = told(slowest, "{ms:.1f} ms")
    return Finding(
        held(slowest is not None and slowest > PERIOD_MS),
        f"a plan takes {plan} of CPU at the median of the slowest family, and setpoints are {{period:.0f}} ms apart",
        figures,
    )


def faster_grids(results: Results) -> Finding:
    """A* and JPS against HAOAROA: both have less CPU time."""
    rows = [pair(results, "cpu_ms", rival, "haoaroa") for rival in ("astar", "jps")]
    figures: Figures = {
        method: most(row["cpu_ms"] for row in results["planners"] if row["method"] == method)
        for method in ("astar", "jps", "haoaroa")
    }
    each = [printed.METHODS[m] + " " + told(ms, "{#:.1f} ms".replace("#", m)) for m, ms in figures.items()]
    return Finding(held(all(map(clearly, rows))), "median CPU time of the slowest family: " + ", ".join(each), figures)
