"""Rules on the searches on functions."""

from collections.abc import Mapping
from typing import Any

from campaigns.paper import equations, printed
from campaigns.paper.verdicts import Figures, Finding, Results, held, refuted


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
