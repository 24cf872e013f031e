"""Rules on gains, control laws and what tunes them."""

import math

import numpy as np
from scipy import stats

from campaigns.paper import controllers
from campaigns.paper.verdicts import Figures, Finding, Results, Verdict, held
from campaigns.tuning.statistics import CONFIDENCE, Interval, mean

TUNERS = {"haoaroa": "HAOAROA", "aoa": "AOA", "roa": "ROA", "de": "differential evolution", "cma": "CMA-ES"}
TRADITIONAL = "PID"
"""What is judged as the traditional law; the others are told beside."""


def gains_hold(results: Results) -> Finding:
    """Whether the printed gains leave no more offset in a steady wind than a PID, beyond chance, and never fail.

    By pairs of flights with one seed, of which both ended well.
    """
    by = {row["gains"]: row for row in results["holds"]}
    paper, pid = by["paper"], by["pid"]
    both = [seed for seed in paper["offsets"] if seed in pid["offsets"]]
    figures: Figures = {"n": len(both), "ok": paper["ok"], "flights": paper["flights"], "wind": results["wind"]}
    if len(both) < 2:
        return Finding(
            Verdict.NOT,
            "taken for the velocity loops, in {wind:.0f} m/s of steady wind {ok} of {flights} flights end well, which "
            "are too few beside a PID's",
            figures,
        )
    less = mean(np.array([paper["offsets"][seed] - pid["offsets"][seed] for seed in both]))
    figures |= {
        "paper": paper["offset_m"],
        "pid": pid["offset_m"],
        "difference": less.mean,
        "half": less.half,
    }
    return Finding(
        held(paper["ok"] == paper["flights"] and less.mean - less.half <= 0.0),
        "taken for the velocity loops, in {wind:.0f} m/s of steady wind they leave {paper:.2f} m of offset, and a PID "
        "{pid:.2f} m; on the same {n} seeds {difference:+.3f} ± {half:.3f} m; {ok} of {flights} flights end well",
        figures,
    )


def unchanged(results: Results) -> list[str]:
    """The laws whose velocity loops' gains are, tuned, still their preset's."""
    laws = results["laws"]
    return [law for law, gains in laws["gains"].items() if gains == laws["presets"][law]]


def laws_compared(results: Results) -> Finding:
    """Whether the tuned FOPID-TID has less RMS than the tuned PID in every wind, beyond chance.

    A law that loses a flight is worse than one that loses none. FOPID and TID are told, and decide nothing.
    """
    every = results["laws"]["rows"]
    ours = {row["wind"]: row for row in every if row["law"] == controllers.TUNED}
    better: dict[str, list[bool]] = {}
    for row in every:
        if row["law"] != controllers.TUNED:
            flew = ours[row["wind"]]["rms_m"] is not None
            lost, half = row["rms_m"] is None, row["change_percent_half"]
            clear = half is not None and row["change_percent"] + half < 0.0
            better.setdefault(row["law"], []).append(flew and (lost or clear))
    figures: Figures = {"seeds": every[0]["seeds"], "winds": len(ours), **{k: sum(v) for k, v in better.items()}}
    told = []
    for k, row in enumerate(row for row in every if row["law"] == TRADITIONAL):
        half = row["change_percent_half"]
        figures |= {f"change_{k}": row["change_percent"], f"half_{k}": half, f"wind_{k}": row["wind"]}
        told.append(("{change_#:+.1f} ± {half_#:.1f} %" if half is not None else "-").replace("#", f"{k}"))
        told[-1] += " ({wind_#})".replace("#", f"{k}")
    last = list(ours.values())[-1]
    figures |= {"rms": last["rms_m"], "estimator": last["estimator_m"], "wind": last["wind"]}
    others = ", ".join(f"{law} {{{law}}}" for law in better if law != TRADITIONAL)
    why = (
        f"tuned alike and flown on {{seeds}} unseen seeds, its error is clearly less than the {TRADITIONAL}'s in "
        f"{{{TRADITIONAL}}} of {{winds}} winds: " + ", ".join(told) + f"; than other laws', of as many: {others}"
    )
    if last["rms_m"] is not None:
        why += "; of its {rms:.3f} m ({wind}) the estimator alone errs by {estimator:.3f} m, which no law can mend"
    if controllers.TUNED in unchanged(results):
        why += "; tuning left its velocity loops' gains as its preset has them"
    return Finding(held(all(better[TRADITIONAL])), why, figures)


def welch(ours: list[float], theirs: list[float]) -> Interval:
    """Difference of two means of independent runs, ours less theirs (Welch, Biometrika 34, 1947, 28-35).

    The half width is nan where either has a single run.
    """
    difference = float(np.mean(ours) - np.mean(theirs))
    if min(len(ours), len(theirs)) < 2:
        return Interval(difference, math.nan)
    parts = [(float(np.var(x, ddof=1)) / len(x), len(x) - 1) for x in (ours, theirs)]
    variance = sum(part for part, _ in parts)
    if variance == 0.0:
        return Interval(difference, 0.0)
    freedom = variance**2 / sum(part**2 / n for part, n in parts)
    return Interval(difference, float(stats.t.ppf(0.5 + 0.5 * CONFIDENCE, freedom)) * math.sqrt(variance))


def nothing_cheaper(results: Results) -> bool:
    """Whether no run of any optimiser found less than all begin with."""
    return all(min(row["costs"]) >= row["begun"] for row in results["optimisers"]["rows"])


def best_tuner(results: Results) -> Finding:
    """Whether HAOAROA's mean cost is below that of every other optimiser at equal budgets, beyond chance."""
    rows = {row["optimiser"]: row for row in results["optimisers"]["rows"]}
    ours = rows["haoaroa"]
    against = {name: welch(ours["costs"], row["costs"]) for name, row in rows.items() if name != "haoaroa"}
    figures: Figures = {
        **{f"cost_{name}": row["cost"] for name, row in rows.items()},
        **{
            f"{what}_{name}": value
            for name, d in against.items()
            for what, value in zip(("less", "half"), d, strict=True)
        },
        "budget": results["optimisers"]["budget"],
        "runs": ours["runs"],
        "others": len(against),
        "worse": sum(d.mean + d.half < 0.0 for d in against.values()),
        "better": sum(d.mean - d.half > 0.0 for d in against.values()),
        "begun": ours["begun"],
        "cheaper": sum(min(row["costs"]) < row["begun"] for row in rows.values()),
        "optimisers": len(rows),
    }
    told = [TUNERS["haoaroa"] + " {cost_haoaroa:.3f}"]
    for name, difference in against.items():
        known = not math.isnan(difference.half)
        form = " {cost_#:.3f} ({less_#:+.3f} ± {half_#:.3f})" if known else " {cost_#:.3f}"
        figures |= {} if known else {f"half_{name}": None}
        told.append(TUNERS[name] + form.replace("#", name))
    why = (
        "mean of {runs} costs after {budget} evaluations each, in brackets HAOAROA's less it: "
        + ", ".join(told)
        + "; beyond chance HAOAROA is below {worse} of {others}, and {better} are below it; "
    )
    why += (
        "none found anything that costs less than the {begun:.3f} that all begin with"
        if nothing_cheaper(results)
        else "{cheaper} of {optimisers} found something that costs less than the {begun:.3f} that all begin with"
    )
    return Finding(held(figures["worse"] == len(against)), why, figures)
