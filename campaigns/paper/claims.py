"""The paper's claims as rows: what it says, the figures it printed, and a rule that gives the verdict from our results.

Rules compute the verdicts (`planner_rules`, `search_rules`, `gain_rules`, `verdicts`), each of which can come out
either way but for `needs`, which says what a test would need. Sentences are templates: every figure in them is the
paper's (`printed`) or the rule's (`Finding.figures`).
"""

from dataclasses import dataclass
from typing import Any

from campaigns.paper import equations, printed
from campaigns.paper.gain_rules import best_tuner, gains_hold, laws_compared
from campaigns.paper.planner_rules import (
    RIVALS,
    ahead,
    all_certified,
    astar_shortest,
    corners,
    faster_grids,
    flown_clear,
    of_this_planner,
    real_time,
    same_grid,
)
from campaigns.paper.printed import PLACES
from campaigns.paper.search_rules import (
    all_reached,
    beats_parents,
    escapes,
    optima_found,
    parents_miss,
    table_3,
    zero_everywhere,
)
from campaigns.paper.verdicts import Figures, Results, Rule, needs, of_equations


@dataclass(frozen=True, slots=True)
class Claim:
    """One claim: where it stands, what it says in our words, figures in it, and the rule."""

    place: str
    says: str
    rule: Rule
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


LENGTHS_TOLD = ", ".join(printed.METHODS[m] + " {#:.1f} m".replace("#", m) for m in RIVALS)

CLAIMS: tuple[Claim, ...] = (
    Claim(
        "planners",
        "HAOAROA's paths are the shortest: {haoaroa:.1f} m; " + LENGTHS_TOLD,
        of_this_planner(ahead("length_m", RIVALS, "length over HAOAROA's", form=".4f")),
        dict(printed.LENGTHS),
    ),
    Claim(
        "lengths",
        "A* usually has the shortest path, HAOAROA nearly as short a one",
        of_this_planner(astar_shortest),
        {},
    ),
    Claim(
        "planners",
        "JPS's path is longer than A*'s, {jps:.1f} m and {astar:.1f} m",
        same_grid,
        {k: printed.LENGTHS[k] for k in ("jps", "astar")},
    ),
    Claim(
        "lengths",
        "L-BSGF and Bezier pay for smoothness with longer paths than A*'s",
        ahead("length_m", ("lbsgf", "bezier"), "length over A*'s", "astar", ".4f"),
        {},
    ),
    Claim(
        "planners",
        "HAOAROA's paths are smoother than A*'s and JPS's",
        ahead("jerk_integral", ("astar", "jps"), "∫ jerk² dt over HAOAROA's"),
        {},
    ),
    Claim(
        "planners",
        "HAOAROA's paths are the smoothest of all",
        ahead("jerk_integral", RIVALS, "∫ jerk² dt over HAOAROA's"),
        {},
    ),
    Claim("paths", "A* and JPS turn sharply at corners, HAOAROA does not", corners, {}),
    Claim("paths", "all five methods find their way round the L and the H", all_certified, {}),
    Claim("worlds", "HAOAROA flies L, H, U and Omega worlds safely", flown_clear, {}),
    Claim(
        "planners",
        "flights of HAOAROA's paths are the steadiest",
        ahead("tracking_percentile_m", RIVALS, "tracking error over HAOAROA's", places="flights that ended well"),
        {},
    ),
    Claim(
        "planners",
        "A* and JPS take less computing time than HAOAROA",
        of_this_planner(faster_grids),
        {},
    ),
    Claim(
        "conclusion", "HAOAROA costs so much computing that real-time use is in doubt", of_this_planner(real_time), {}
    ),
    Claim(
        "searches",
        "HAOAROA ends at {zero:.0f} on all nine functions, best, worst, mean, median and std",
        zero_everywhere,
        {"zero": printed.HAOAROA_TOLD},
    ),
    Claim("searches", "HAOAROA finds the minimum of every function in every run", all_reached, {}),
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
            lambda f: f["least"] > 1e-9,
            "thrust and weight have the same sign: whatever the thrust, it accelerates by {least:.2f} m/s² at least, "
            "and cannot hover",
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
