"""What follows from equations as they are printed: each function returns figures, `claims` draws the conclusion.

Equations are taken from `printed`; where the paper leaves a sign or a factor open, every choice is tried.
"""

import math
from collections.abc import Mapping

import numpy as np

from campaigns.paper import printed
from planner.search import BENCHMARKS

Figures = Mapping[str, float]


def mixer() -> Figures:
    """Eq. 24: rank of the map from squared rotor speeds to thrust and moments; factors of rows do not change it."""
    return {"rank": int(np.linalg.matrix_rank(np.array(printed.MIXER, dtype=float))), "wanted": len(printed.MIXER)}


def hover(mass: float = 2.0, gravity: float = 9.81) -> Figures:
    """Eq. 25, third line, level and at rest, without T: the least vertical acceleration [m/s^2] of any thrust >= 0.

    As printed z'' = (-U1 cos cos - m g)/m: thrust and weight have one sign, so the best thrust is none. Which way z
    points does not matter.
    """
    thrusts = np.linspace(0.0, 10.0, 1001) * mass * gravity
    thrust, weight = printed.VERTICAL
    return {"least": float(np.abs((thrust * thrusts + weight * mass * gravity) / mass).min())}


def slopes() -> Figures:
    """Eq. 6 against the derivatives of Eq. 2: how many of the four are right, and the largest error on [0, 1]."""
    s = np.linspace(0.0, 1.0, 1001)
    wrong = [
        float(np.abs(np.polynomial.Polynomial(f).deriv()(s) / 6.0 - np.polynomial.Polynomial(v)(s)).max())
        for f, v in zip(printed.BASIS, printed.SLOPES, strict=True)
    ]
    return {"right": sum(e < 1e-12 for e in wrong), "of": len(wrong), "largest": max(wrong)}


def length_cost(seed: int = 0) -> Figures:
    """Eq. 37: the cost's spread over curves with the same ends, and the spread of their lengths [m].

    The integral of C' is C(1) - C(0); that of its norm is the length.
    """
    generator = np.random.default_rng(seed)
    t = np.linspace(0.0, 1.0, 2001)
    costs, lengths = [], []
    for _ in range(20):
        bow = generator.normal(0.0, 3.0, (2, 2))
        curve = np.stack([t, np.zeros_like(t)], axis=1) + t[:, None] * (1 - t[:, None]) * (bow[0] + bow[1] * t[:, None])
        steps = np.diff(curve, axis=0)
        lengths.append(float(np.linalg.norm(steps, axis=1).sum()))
        costs.append(lengths[-1] if printed.NORM_INSIDE else float(np.linalg.norm(steps.sum(axis=0))))
    return {"curves": len(costs), "cost_spread": float(np.ptp(costs)), "length_spread": float(np.ptp(lengths))}


def obstacle_cost() -> Figures:
    """Eq. 39 for a point: where on a line from 0 to 5 m its value is least, for weights above and below 0 [m]."""
    away = np.linspace(0.0, 5.0, 501)
    with np.errstate(divide="ignore"):
        cost = away**printed.OBSTACLE_POWER
    return {"least_at": float(away[np.argmin(cost)]), "lowest_negative": float(-cost.max())}


def law_at_rest() -> Figures:
    """Algorithm 1, steps 13 and 18: u at no error, no integral and no derivative; it adds both orders to u."""
    terms = [printed.GAINS[k] * 0.0 for k in ("KP", "KI", "KD")]
    return {"u": math.fsum([*terms, printed.GAINS["LAMBDA"], printed.GAINS["MU"]])}


def knots() -> Figures:
    """Fig. 1: knots printed, told and needed; and how many the ends of the vector repeat."""
    u = printed.KNOTS
    return {
        "printed": len(u),
        "told": printed.KNOTS_TOLD,
        "needed": printed.CONTROL_POINTS + printed.ORDER,
        "first": u.count(u[0]),
        "last": u.count(u[-1]),
        "order": printed.ORDER,
    }


def table_3() -> Figures:
    """Table 3's rows for AOA and ROA: how many have a std or a mean that no 20 numbers can have."""
    wrong = [claim.wrong for claim in printed.CLAIMS]
    factor = max(c.spread.least_std(printed.RUNS) / c.spread.std for c in printed.CLAIMS)
    return {
        "rows": len(wrong),
        "std": sum("std" in names for names in wrong),
        "mean": sum("mean" in names for names in wrong),
        "factor": factor,
        "below_best": sum(c.spread.mean < c.spread.best for c in printed.CLAIMS),
    }


def michalewicz() -> Figures:
    """Its minimum at d = 2, its greatest value on its domain, and the least that AOA and ROA are said to reach."""
    function = next(b for b in BENCHMARKS if b.name == "michalewicz")
    axis = np.linspace(function.lower, function.upper, 1001)
    grid = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
    told = min(claim.spread.best for claim in printed.CLAIMS if claim.function == function.name)
    return {"minimum": function.minimum(2), "greatest": float(function(grid).max()) + 0.0, "told": told}
