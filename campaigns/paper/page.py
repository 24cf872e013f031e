"""The page, from the results and nothing else: no text here has a digit in it, so every figure is out of them."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from campaigns.paper.gain_rules import TUNERS, nothing_cheaper, unchanged
from campaigns.paper.verdicts import Verdict

Results = Mapping[str, Any]
NONE, ENDLESS = "-", "∞"


def page(results: Results, figures: str) -> str:
    """The whole page as markdown.

    Parameters
    ----------
    figures : folder of the pictures, as seen from the page.
    """
    parts = (head, verdicts, functions, planners, searches, gains, sizes)
    return "\n".join(line for part in parts for line in (*part(results, figures), "")).rstrip("\n") + "\n"


def head(results: Results, figures: str) -> Iterator[str]:
    """What this is."""
    made = results["made"]
    of = "".join(f", {name} {made[name]}" for name in ("version", "revision") if made[name])
    yield "# The paper, run again"
    yield ""
    yield (
        "What the paper on HAOAROA and the FOPID-TID controller claims, beside what this repository measures. "
        f"Written by `companion paper{' --quick' if made['size'] == 'quick' else ''}`{of}; every figure is in "
        f"[results.json]({figures}/results.json), and each verdict is computed by a rule "
        "(`campaigns/paper/claims.py`), but where too little is told for a test. The paper gives no code, no worlds, "
        "no vehicle and no units, so what is run here is our reading of it: [planner.md](planner.md), "
        "[search.md](search.md), [tuning.md](tuning.md)."
    )


def verdicts(results: Results, figures: str) -> Iterator[str]:
    """Every claim with its verdict."""
    claims = results["claims"]
    counts = results["verdicts"]
    yield "## Verdicts"
    yield ""
    yield (
        f"Of {counts['claims']} claims "
        + ", ".join(f"{counts[v]} {'is' if counts[v] == 1 else 'are'} {v}" for v in Verdict)
        + "."
    )
    yield (
        "*Impossible* follows by arithmetic from what is printed. Behind a figure, in brackets or after ±, is its "
        f"confidence interval of {results['setup']['percentile']} %; a method is ahead where the interval of its "
        "ratio leaves one out, or that of its difference zero."
    )
    yield ""
    rows = ((c["place"], c["says"], f"**{c['verdict']}**", c["why"]) for c in claims)
    yield from table(("where", "the paper says, in our words", "verdict", "why"), rows)


def functions(results: Results, figures: str) -> Iterator[str]:
    """Table 1."""
    yield f"## {results['paper']['places']['functions']}: the functions"
    yield ""
    yield (
        f"At d = {results['setup']['dimension']}. Formulas and domains are the usual ones: the paper's own are in a "
        "table that its text does not hold. Its section on them calls the algorithm under test HWOAGWO, which is "
        "another one."
    )
    yield ""
    rows = (
        (
            row["function"],
            f"`{row['formula']}`",
            f"[{row['lower']:.4g}, {row['upper']:.4g}]",
            f"{row['minimum']:.7g}",
            ", ".join(f"({x:.4g}, {y:.4g})" for x, y in row["at"]),
            row["says"],
        )
        for row in results["functions"]
    )
    yield from table(("function", "formula", "each coordinate", "minimum", "at", "the paper's text says"), rows)


def planners(results: Results, figures: str) -> Iterator[str]:
    """Table 2 and Fig. 5, parts A to D."""
    paper, setup = results["paper"], results["setup"]
    worlds = max(row["worlds"] for row in results["planners"])
    percentile = f"p{setup['percentile']}"
    yield f"## {paper['places']['planners']} and {paper['places']['paths']}: planners, planned and flown"
    yield ""
    yield (
        f"Every method plans and flies {worlds} worlds of each family, the same ones: a hull of {setup['hull']:.2f} "
        f"m keeps {setup['clearance']:.1f} m from obstacles. Medians over the worlds where the plan is proved clear. "
        "Length, jerk and curvature are the plan's: smoothness is the integral of jerk squared, and ∞ stands for a "
        "stop with a turn on the spot. Tracking error and clearance are flown, by the simulator's truth, with "
        "vehicle and estimator in the loop, in still air. The paper has one number a method, for a world it does "
        "not give."
    )
    yield ""
    yield (
        f"*HAOAROA* is in this table the planner of this repository: a search of {setup['planner_iterations']} "
        f"iterations with population {setup['population']}, a descent by gradient from the best "
        f"{setup['planner_elites']}, and a proof that the curve is clear. The paper's is the search alone, with "
        f"{setup['printed_iterations']} iterations: its lengths and times are not those of what is judged here."
    )
    yield ""
    heads = ("family", "method", "paper m", "proved", "length m", "∫ jerk² dt m²/s⁵", "curvature per m", "CPU ms")
    planned = (
        (
            row["family"],
            paper["methods"][row["method"]],
            f"{paper['lengths'][row['method']]:.1f}",
            f"{row['certified']}/{row['worlds']}",
            number(row["length_m"], ".2f"),
            number(row["jerk_integral"], ".0f"),
            number(row["curvature_max"], ".2f", ENDLESS),
            number(row["cpu_ms"], ".1f"),
        )
        for row in results["planners"]
    )
    yield from table(heads, planned)
    yield ""
    wins = ", ".join(f"{paper['methods'][m]} {n}" for m, n in results["shortest"].items() if n)
    yield f"Shortest plan, in how many worlds (A\\* and JPS are equally long and counted for A\\*): {starred(wins)}."
    yield ""
    yield from picture(figures, "paths", "every method's path round the L and the H, from above")
    yield from picture(figures, "lengths", "lengths by family, one dot a method, and the printed ones")
    heads = ("family", "method", "flown well", "error RMS m", f"{percentile} m", "largest m", "clearance m", "least m")
    flown = (
        (
            row["family"],
            paper["methods"][row["method"]],
            f"{row['flown_ok']}/{row['certified']}",
            number(row["tracking_rms_m"], ".3f"),
            number(row["tracking_percentile_m"], ".3f"),
            number(row["tracking_max_m"], ".2f"),
            number(row["min_clearance_m"], ".2f"),
            number(row["least_clearance_m"], ".2f"),
        )
        for row in results["planners"]
    )
    yield (
        "Flown: tracking error and clearance of the hull; medians, *largest* and *least* are those of all flights, and "
        "claims are judged on those flown well. "
        "*Flown well* is what ended as its mission expects (`companion worlds` writes them): there, without touching "
        "anything, and within the bounds on error and clearance, which some stops at the corners of a polyline miss."
    )
    yield ""
    yield from table(heads, flown)
    yield ""
    yield from picture(figures, "worlds", "HAOAROA's plan and its flight in four worlds")


def searches(results: Results, figures: str) -> Iterator[str]:
    """Table 3 and Fig. 5, parts E and F."""
    setup, paper = results["setup"], results["paper"]
    every = results["searches"]
    runs, evaluations = max(row["runs"] for row in every), max(row["evaluations"] for row in every)
    names = [row["function"] for row in results["functions"]]
    yield f"## {paper['places']['searches']}: searches"
    yield ""
    yield (
        f"Population {setup['population']}, at most {evaluations} evaluations, {runs} runs, d = "
        f"{setup['dimension']}; runs that end within {setup['target']:.0e} of f\\*, and the median of f - f\\*. "
        "*Moved* is the same function with its minimum moved within the same domain: an algorithm that is drawn to "
        "the origin loses there what it won before. *Literal* is what is printed, *canonical* the original "
        "algorithms as they are usually run; with neither, *shift-invariant*, products of coordinates are products of "
        "differences. Which of the three the paper ran it does not tell: a claim is reproduced when it holds in any, "
        "on plain functions ([search.md](search.md))."
    )
    yield ""
    rows = (
        (
            row["contender"],
            where(row),
            *(
                f"{cell['reached']}/{cell['runs']} ({cell['median']:.0e})"
                for cell in (row["by_function"][name] for name in names)
            ),
            f"{row['cpu_ms']:.0f}",
        )
        for row in results["by_contender"]
    )
    yield from table(("algorithm", "minimum", *names, "CPU ms"), rows)
    yield ""
    yield from picture(figures, "landscapes", "five landscapes, plain and moved, with the optima that HAOAROA found")
    told = {row["contender"] for row in every if " " not in row["contender"]}
    full = (
        (row["function"], where(row), row["contender"], *five(row), f"{row['reached']}/{row['runs']}")
        for row in every
        if row["contender"] in told
    )
    yield from folded(
        "Ours in full: f - f*",
        table(("function", "minimum", "algorithm", "best", "worst", "mean", "median", "std", "reached"), full),
    )
    printed = (
        (
            row["function"],
            row["contender"],
            *five(row),
            f"{row['least_mean']:.2e}",
            f"{row['least_std']:.2e}",
            f"{' and '.join(row['wrong'])} cannot be" if row["wrong"] else "can be",
        )
        for row in paper["table"]
    )
    yield (
        "The printed rows for AOA and ROA, and the least mean and std that their own best and worst leave possible: "
        "of n runs one is the worst, and the others lie as far below the mean together as it lies above, so std is "
        "at least worst less mean over the root of how many others there are, and the mean at least that of the "
        "worst and otherwise nothing but the best."
    )
    yield ""
    heads = ("function", "algorithm", "best", "worst", "mean", "median", "std", "least mean", "least std", "")
    yield from folded("The paper's, with its arithmetic", table(heads, printed))


def gains(results: Results, figures: str) -> Iterator[str]:
    """Fig. 6, the laws and the optimisers."""
    paper, laws, tuners = results["paper"], results["laws"], results["optimisers"]
    yield f"## {paper['places']['gains']}: gains and laws"
    yield ""
    yield (
        f"Each law is tuned with {laws['budget']} evaluations of the same cost, population {laws['population']}, by "
        "HAOAROA, from its own preset, and then flown on seeds that no tuning has seen: a figure of eight, RMS over "
        "ground of truth less setpoint, mean and its interval. *Against it* is FOPID-TID's RMS relative to that "
        "law's, seed by seed; *estimator* is the RMS of truth less estimate, *loops* that of estimate less setpoint, "
        "and "
        f"*cost* that of the tuning, in units of the preset `{laws['unit']}`."
    )
    yield ""
    rows = (
        (
            row["law"],
            row["wind"],
            f"{row['seeds']}",
            f"{number(row['rms_m'], '.4f')} ± {number(row['rms_m_half'], '.4f')}",
            number(row["estimator_m"], ".4f"),
            number(row["loops_m"], ".4f"),
            number(row["largest_m"], ".2f"),
            "" if "change_percent" not in row else between(row["change_percent"], row["change_percent_half"], ".1f"),
            f"{laws['costs'][row['law']]:.3f}",
        )
        for row in laws["rows"]
    )
    heads = ("law", "wind", "seeds", "RMS m", "estimator m", "loops m", "largest m", "FOPID-TID against it %", "cost")
    yield from table(heads, rows)
    yield ""
    if same := unchanged(results):
        yield f"Tuning left the velocity loops' gains as the law's preset has them: {', '.join(same)}."
        yield ""
    yield from picture(figures, "controllers", "RMS of each law, and the optimisers' lowest costs")
    yield (
        f"Optimisers on FOPID-TID's gains, {tuners['budget']} evaluations each, population {tuners['population']}; "
        f"the lowest cost, in units of what the preset `{laws['unit']}` costs:"
    )
    yield ""
    cells = (
        (
            TUNERS[r["optimiser"]],
            f"{r['runs']}",
            f"{r['cost']:.4f}",
            f"{r['least']:.4f}",
            f"{r['greatest']:.4f}",
            f"{r['begun']:.4f}",
        )
        for r in tuners["rows"]
    )
    yield from table(("optimiser", "runs", "mean", "least", "greatest", "begun with"), cells)
    yield ""
    if nothing_cheaper(results):
        yield "No run of any optimiser found gains that cost less than those that all begin with."
        yield ""
    symbols = paper["symbols"]
    heads = ("gains of the velocity loops", *(symbols.get(term, "Kt") for term in next(iter(laws["gains"].values()))))
    tuned = [(name, *(f"{v:.4g}" for v in values.values())) for name, values in laws["gains"].items()]
    terms = list(next(iter(laws["gains"].values())))
    printed = ("the paper", *(number(paper["gains"].get(term), ".4f") for term in terms))
    yield from table(heads, [printed, *tuned])
    yield ""
    yield (
        "The paper ties Kp to pitch, Ki to roll and Kd to yaw, and gives neither units nor the structure of a loop. "
        "All five are read here as gains of the velocity loops, and held against our presets at one place in "
        f"{results['wind']:.0f} m/s of steady wind, by the truth:"
    )
    yield ""
    held = (
        (
            row["gains"],
            f"{row['ok']}/{row['flights']}",
            f"{number(row['offset_m'], '.3f')} ± {number(row['offset_half'], '.3f')}",
            number(row["largest_m"], ".2f"),
        )
        for row in results["holds"]
    )
    yield from table(("gains", "flights that end well", "their offset, second half, mean m", "largest m"), held)
    yield ""
    yield from picture(figures, "gains", "radar of the gains, and the offset in a steady wind")


def sizes(results: Results, figures: str) -> Iterator[str]:
    """How much was run."""
    yield "## Sizes"
    yield ""
    yield f"This page is of the size *{results['made']['size']}*; both run everything, and only the counts differ."
    yield ""
    columns = results["sizes"]
    rows = ((MEANING[key], *(f"{size[key]:g}" for size in columns)) for key in MEANING)
    yield from table(("", *(size["name"] for size in columns)), rows)


MEANING = {
    "worlds": "worlds of each family, planned and flown by every method",
    "repeats": "plans of each, for the CPU time",
    "searches": "runs of each algorithm on each function",
    "iterations": "iterations of a run",
    "holds": "flights in steady wind for each set of gains",
    "hold_s": "seconds of each",
    "eight_s": "seconds of the figure of eight that tunings fly, in calm and in gusts",
    "step_m": "metres of the step beside it",
    "train": "seeds of an evaluation",
    "laws_budget": "evaluations that tune a law",
    "unseen": "unseen seeds for each law and wind",
    "optimisers_budget": "evaluations of an optimiser",
    "optimiser_seeds": "runs of an optimiser",
}


def where(row: Mapping[str, Any]) -> str:
    """Whether a function's minimum was moved."""
    return "moved" if row["moved"] else "plain"


def five(row: Mapping[str, Any]) -> tuple[str, ...]:
    """The five numbers of a spread."""
    return tuple(f"{row[name]:.2e}" for name in ("best", "worst", "mean", "median", "std"))


def number(value: float | None, form: str, none: str = NONE) -> str:
    """A number, or what stands for none."""
    return none if value is None else format(value, form)


def between(mean: float | None, half: float | None, form: str) -> str:
    """A mean and the half of its interval."""
    return NONE if mean is None else f"{mean:+{form}} ± {number(half, form)}"


def table(heads: Iterable[str], rows: Iterable[Iterable[str]]) -> Iterator[str]:
    """Lines of a markdown table."""
    first = tuple(heads)
    yield "| " + " | ".join(first) + " |"
    yield "|" + "---|" * len(first)
    for row in rows:
        yield "| " + " | ".join(starred(cell).replace("|", "\\|") for cell in row) + " |"


def starred(text: str) -> str:
    """Stars that are no markup."""
    return text.replace("A*", "A\\*").replace("f*", "f\\*")


def folded(title: str, lines: Iterable[str]) -> Iterator[str]:
    """What is opened on demand."""
    yield f"<details><summary>{title}</summary>"
    yield ""
    yield from lines
    yield ""
    yield "</details>"
    yield ""


def picture(figures: str, name: str, what: str) -> Iterator[str]:
    """One picture."""
    yield f"![{what[0].upper()}{what[1:]}]({figures}/{name}.png)"
    yield ""
