"""Rules on the searches on functions.

The paper's algorithms are run in three readings, and every rule asks the same ones of every algorithm: what is printed,
its sources' own algorithms, and ours. Which of them the paper ran it does not tell, so a claim is reproduced when it
holds in any, on the functions as they are; what moving the minima does is told beside.
"""

from collections.abc import Callable, Mapping
from typing import Any

from campaigns.paper import equations, printed
from campaigns.paper.verdicts import Figures, Finding, Results, held, refuted

READINGS = {"literal": "literal", "canonical": "canonical", "ours": "shift-invariant"}
"""Each reading and its name in sentences."""
PARENTS = ("AOA", "ROA")
FIVE = ("best", "worst", "mean", "median", "std")

Row = Mapping[str, Any]


def searches(results: Results, algorithm: str, reading: str, moved: bool) -> list[Row]:
    """The rows of one algorithm in one reading on plain or on moved functions."""
    contender = algorithm if reading == "ours" else f"{algorithm} {reading}"
    return [row for row in results["searches"] if row["contender"] == contender and row["moved"] is moved]


def by_reading(
    count: Callable[[str, bool], int], form: str, enough: Callable[[int], bool], of: int
) -> tuple[bool, str, Figures]:
    """Whether a count is enough in any reading; and every reading's, plain and moved, as a sentence with figures.

    Parameters
    ----------
    count : of a reading, plain or moved.
    form : of one reading, with `#` for its key.
    """
    figures: Figures = {"of": of}
    for reading in READINGS:
        figures |= {f"{reading}_plain": count(reading, False), f"{reading}_moved": count(reading, True)}
    told = ", ".join(f"{name} {form.replace('#', reading)}" for reading, name in READINGS.items())
    return any(enough(figures[f"{reading}_plain"]) for reading in READINGS), told, figures


PLAIN_MOVED = "{#_plain} and {#_moved}"


def zero_everywhere(results: Results) -> Finding:
    """All five numbers zero on all nine; and that this cannot be said of f itself, but of f - f*, it can."""

    def zeros(reading: str, moved: bool) -> int:
        return sum(
            all(row[name] == printed.HAOAROA_TOLD for name in FIVE)
            for row in searches(results, "HAOAROA", reading, moved)
        )

    of = len(searches(results, "HAOAROA", "ours", False))
    good, told, figures = by_reading(zeros, PLAIN_MOVED, lambda n: n == of, of)
    why = f"of f - f*: functions of {{of}} on which all five are zero, plain and moved: {told}"
    values = equations.michalewicz()
    if values["told"] > values["greatest"]:
        figures |= values
        why += (
            "; of f itself Michalewicz's could not be, with a minimum of {minimum:.6f}, but then the rows of AOA and "
            "ROA, from {told:.2e} up, could not either: f is nowhere above {greatest:.0f}"
        )
    return Finding(held(good), why, figures)


def all_reached(results: Results) -> Finding:
    """HAOAROA near enough on all nine in every run; also with the polish that is no part of it."""

    def reached(reading: str, moved: bool) -> int:
        return sum(row["reached"] for row in searches(results, "HAOAROA", reading, moved))

    of = sum(row["runs"] for row in searches(results, "HAOAROA", "ours", False))
    good, told, figures = by_reading(reached, PLAIN_MOVED, lambda n: n == of, of)
    figures |= {
        "target": results["setup"]["target"],
        "polished": sum(row["reached"] for row in searches(results, "HAOAROA + polish", "ours", False)),
    }
    why = (
        f"runs of {{of}} that end within {{target:.0e}} of f*, plain and moved: {told}; with a polish by gradient, "
        "which is no part of it, {polished} of the plain ones"
    )
    return Finding(held(good), why, figures)


def beats_parents(results: Results) -> Finding:
    """Whether HAOAROA's mean is below AOA's and ROA's of the same reading on every function."""

    def ahead(reading: str, moved: bool) -> int:
        ours = {row["function"]: row["mean"] for row in searches(results, "HAOAROA", reading, moved)}
        rows = [row for who in PARENTS for row in searches(results, who, reading, moved)]
        return sum(all(mean < row["mean"] for row in rows if row["function"] == name) for name, mean in ours.items())

    of = len(searches(results, "HAOAROA", "ours", False))
    good, told, figures = by_reading(ahead, PLAIN_MOVED, lambda n: n == of, of)
    why = f"functions of {{of}} on which its mean is below both, plain and moved, all three in one reading: {told}"
    return Finding(held(good), why, figures)


def parents_miss(results: Results) -> Finding:
    """Whether no run of AOA and ROA ends at f* exactly; HAOAROA's are counted alike and told beside."""

    def exact(who: tuple[str, ...]) -> Callable[[str, bool], int]:
        return lambda reading, moved: sum(row["exact"] for w in who for row in searches(results, w, reading, moved))

    of = sum(row["runs"] for who in PARENTS for row in searches(results, who, "ours", False))
    good, told, figures = by_reading(exact(PARENTS), PLAIN_MOVED, lambda n: n == 0, of)
    _, beside, ours = by_reading(exact(("HAOAROA",)), "{haoaroa_#_plain} and {haoaroa_#_moved}", lambda n: n == 0, 0)
    figures |= {f"haoaroa_{name}": count for name, count in ours.items()}
    figures["haoaroa_of"] = sum(row["runs"] for row in searches(results, "HAOAROA", "ours", False))
    why = (
        f"their runs of {{of}} that end at f* exactly, plain and moved: {told}; HAOAROA's of {{haoaroa_of}}, counted "
        f"alike: {beside}"
    )
    return Finding(held(good), why, figures)


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

    def there(reading: str, moved: bool) -> int:
        rows = searches(results, "HAOAROA", reading, moved)
        return sum(row["at_minimum"] for row in rows if row["function"] in printed.LANDSCAPES)

    rows = [row for row in searches(results, "HAOAROA", "ours", False) if row["function"] in printed.LANDSCAPES]
    of = sum(row["runs"] for row in rows)
    good, told, figures = by_reading(there, PLAIN_MOVED, lambda n: n == of, of)
    return Finding(held(good), f"runs of {{of}} that end at a minimiser, plain and moved: {told}", figures)


def escapes(results: Results) -> Finding:
    """The updates as they are printed, on the function with the many minima: at the least one, plain and moved."""
    plain, moved = (
        next(row for row in searches(results, "HAOAROA", "literal", m) if row["function"] == "rastrigin")
        for m in (False, True)
    )
    figures = {
        "plain": plain["at_minimum"],
        "moved": moved["at_minimum"],
        "runs": plain["runs"],
        "median": plain["median"],
    }
    good = all(row["at_minimum"] == row["runs"] for row in (plain, moved))
    why = (
        "as printed, {plain} of {runs} runs end at Rastrigin's minimiser, {moved} with the minimum moved; the median "
        "ends {median:.2g} above the minimum"
    )
    doubt = "; the updates are a descent by gradient and a pull to the best, neither of which leaves a minimum"
    return Finding(held(good), why + ("" if good else doubt), figures)
