"""Table 1: the nine functions as they are measured here, beside what the paper's text says of them."""

from typing import Any

import numpy as np

from campaigns.paper.printed import WORDS
from campaigns.paper.search import DIMENSION
from planner.search import BENCHMARKS

FORMULAS = {
    "sphere": "x^2 + y^2",
    "rosenbrock": "100*(y - x^2)^2 + (1 - x)^2",
    "rastrigin": "20 + x^2 + y^2 - 10*cos(2*pi*x) - 10*cos(2*pi*y)",
    "griewank": "1 + (x^2 + y^2)/4000 - cos(x)*cos(y/sqrt(2))",
    "ackley": "20 + e - 20*exp(-0.2*sqrt((x^2 + y^2)/2)) - exp((cos(2*pi*x) + cos(2*pi*y))/2)",
    "michalewicz": "-sin(x)*sin(x^2/pi)^20 - sin(y)*sin(2*y^2/pi)^20",
    "himmelblau": "(x^2 + y - 11)^2 + (x + y^2 - 7)^2",
    "booth": "(x + 2*y - 7)^2 + (2*x + y - 5)^2",
    "beale": "(1.5 - x + x*y)^2 + (2.25 - x + x*y^2)^2 + (2.625 - x + x*y^3)^2",
}
"""At d = 2."""


def table() -> list[dict[str, Any]]:
    """A row a function: formula, domain, minimum at d = 2 and where it is."""
    return [
        {
            "function": function.name,
            "formula": FORMULAS[function.name],
            "lower": function.lower,
            "upper": function.upper,
            "minimum": function.minimum(DIMENSION),
            "at": [[float(v) + 0.0 for v in np.round(p, 6)] for p in function.best_points(DIMENSION)],
            "says": WORDS[function.name],
        }
        for function in BENCHMARKS
    ]
