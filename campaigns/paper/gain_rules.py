"""Rules on gains, control laws and what tunes them."""

from campaigns.paper import controllers
from campaigns.paper.verdicts import Figures, Finding, Results, held

TUNERS = {"haoaroa": "HAOAROA", "aoa": "AOA", "roa": "ROA", "de": "differential evolution", "cma": "CMA-ES"}


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
    rows = [row for row in results["laws"]["rows"] if row.get("change_percent_half") is not None]
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
    ours = [row for row in results["laws"]["rows"] if row["law"] == controllers.TUNED][-1]
    figures |= {"rms": ours["rms_m"], "estimator": ours["estimator_m"], "wind": ours["wind"]}
    share = "; of its {rms:.3f} m ({wind}) the estimator alone errs by {estimator:.3f} m, which no law can mend"
    return Finding(
        held(figures["better"] == figures["of"]),
        "tuned alike and flown on {seeds} unseen seeds, its error is clearly less in {better} of {of} comparisons with "
        "PID, FOPID and TID; against the PID " + ", ".join(told) + (share if ours["rms_m"] is not None else ""),
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
