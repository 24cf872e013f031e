"""Rules on planners: lengths, smoothness, time, and what became of the flights."""

from collections.abc import Mapping
from typing import Any

from campaigns.paper import printed
from campaigns.paper.verdicts import Figures, Finding, Results, Rule, Verdict, held

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


def ahead(column: str, rivals: tuple[str, ...], sentence: str, method: str = "haoaroa", form: str = ".3g") -> Rule:
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


def faster_grids(results: Results) -> Finding:
    """A* and JPS against HAOAROA: both have less CPU time."""
    rows = [pair(results, "cpu_ms", rival, "haoaroa") for rival in ("astar", "jps")]
    by = {m: [r["cpu_ms"] for r in results["planners"] if r["method"] == m] for m in ("haoaroa", "astar", "jps")}
    figures = {m: max(v for v in values if v is not None) for m, values in by.items()}
    return Finding(
        held(all(map(clearly, rows))),
        "median CPU time of the slowest family: A* {astar:.1f} ms, JPS {jps:.1f} ms, HAOAROA {haoaroa:.1f} ms",
        figures,
    )
