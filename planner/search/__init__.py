"""Optimisers. Each is ask/tell: it proposes candidates and is told their costs; it never calls the cost itself.

`minimize` runs one of them on any function. `Haoaroa`, `Aoa` and `Roa` are the optimisers, `Mode` says which reading of
each; `functions` holds nine functions with known minima. Candidates are rows (n_pop, n_dim), dimensionless. Chance
comes from the numpy Generator passed in, and budgets count evaluations.
"""

from planner.search.aoa import Aoa
from planner.search.asktell import AskTell, Best, Mode
from planner.search.functions import BENCHMARKS, Benchmark
from planner.search.haoaroa import Haoaroa
from planner.search.hybrids import HaoaroaCanonical, HaoaroaLiteral
from planner.search.minimize import SEARCHES, minimize
from planner.search.roa import Roa

__all__ = [
    "BENCHMARKS",
    "SEARCHES",
    "Aoa",
    "AskTell",
    "Benchmark",
    "Best",
    "Haoaroa",
    "HaoaroaCanonical",
    "HaoaroaLiteral",
    "Mode",
    "Roa",
    "minimize",
]
