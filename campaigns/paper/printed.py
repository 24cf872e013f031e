"""What the paper prints, as far as its text tells it: every figure that is held against ours stands here, once.

Its Tables 1 and 2 are known by their text only. Nothing here is a result of ours, and no verdict.
"""

from dataclasses import dataclass

from campaigns.paper.spread import Spread

PLACES = {
    "clamped": "Fig. 1",
    "derivatives": "Eq. 6",
    "mixer": "Eq. 24",
    "dynamics": "Eq. 25",
    "length_cost": "Eq. 37",
    "obstacle_cost": "Eq. 39",
    "law": "Algorithm 1, steps 13 and 18",
    "updates": "Eq. 43 to 49",
    "functions": "Table 1",
    "planners": "Table 2",
    "paths": "Fig. 5",
    "lengths": "Fig. 5, part D",
    "worlds": "Fig. 5, part C",
    "landscapes": "Fig. 5, part F",
    "gains": "Fig. 6",
    "searches": "Table 3",
    "discussion": "Results and discussion",
    "conclusion": "Conclusion",
    "introduction": "Introduction",
}
"""Names of the paper's parts."""

METHODS = {"haoaroa": "HAOAROA", "astar": "A*", "jps": "JPS", "lbsgf": "L-BSGF", "bezier": "Bezier"}
"""Those of its Table 2, in order of their printed lengths, by the planner's names."""
LENGTHS = {"haoaroa": 20.3, "astar": 20.5, "jps": 20.8, "lbsgf": 21.4, "bezier": 21.7}
"""Table 2 by its text [m]; the world, the start and the goal are not told."""

POPULATION, ITERATIONS, RUNS = 20, 1000, 20
"""Of the searches on functions."""
PLANNER_ITERATIONS = 100
"""Of the planner's search, with the same population."""

GAINS = {"KP": 1.3254, "KI": 0.4627, "KD": 0.1892, "LAMBDA": 0.3127, "MU": 0.3419}
"""The tuned gains of Fig. 6, named as the ends of our parameters' names; units and loop are not told."""
SYMBOLS = {"KP": "Kp", "KI": "Ki", "KD": "Kd", "LAMBDA": "λ", "MU": "μ"}
IMPROVEMENTS = {"KP": 10, "KI": 8, "KD": 12, "MU": 9, "LAMBDA": 13}
"""By how much each is said to better "base methods" [%]; neither those nor the measure are told."""

TOLD = frozenset({"the tuned gains", "the shares of improvement", "population and iterations"})
"""What is told of its experiments; see `claims.needs`."""

KNOTS = (0, 0, 0, 0, 0, 0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1, 1, 1)
KNOTS_TOLD, CONTROL_POINTS, ORDER = 14, 10, 4
"""Fig. 1: the vector, and what is said of it: clamped, by its first and last four."""

BASIS = ((1, -3, 3, -1), (4, 0, -6, 3), (1, 3, 3, -3), (0, 0, 0, 1))
"""Eq. 2, six times f1 to f4: coefficients of 1, s, s^2, s^3."""
SLOPES = ((-0.5, 1, -0.5), (0, -2, 1), (0.5, 1, -1), (0, 0, 0.5))
"""Eq. 6, v1 to v4: coefficients of 1, s, s^2; said to be the derivatives of f1 to f4."""

MIXER = ((1, 1, 1, 1), (1, -1, 1, -1), (1, -1, 1, -1), (1, -1, 1, -1))
"""Eq. 24, the signs of the four squared rotor speeds in thrust and the three moments; each row has a factor."""

VERTICAL = (-1, -1)
"""Eq. 25, third line: the signs of thrust and of weight in the vertical acceleration."""
NORM_INSIDE = False
"""Eq. 37, a length: whether the norm is taken of C' before its integral, or of the integral."""
OBSTACLE_POWER = 2
"""Eq. 39: of the distance from an obstacle's centre, times a weight."""

WORDS = {
    "sphere": "simple, unimodal, convex",
    "rosenbrock": "a narrow, curved valley",
    "rastrigin": "many local minima",
    "griewank": "periodic ripples, the minimum at the centre",
    "ackley": "flat far out, steep at the minimum",
    "michalewicz": "a further test of convergence and of many minima",
    "himmelblau": "a further test of convergence and of many minima",
    "booth": "a further test of convergence and of many minima",
    "beale": "a further test of convergence and of many minima",
}
"""What its text says of each function, in our words; formulas and domains are in a table that is not in it."""
LANDSCAPES = ("sphere", "rastrigin", "rosenbrock", "ackley", "griewank")
"""Those of Fig. 5."""

TABLE_3 = """
sphere       AOA  1.23e-10  5.68e-08  3.46e-09  2.35e-09  1.23e-09
sphere       ROA  2.35e-09  1.23e-06  7.89e-08  6.79e-08  4.57e-08
rosenbrock   AOA  2.57e-11  8.91e-09  4.57e-10  3.46e-10  1.79e-10
rosenbrock   ROA  4.68e-10  2.35e-08  1.23e-09  9.01e-10  3.46e-09
rastrigin    AOA  4.57e-08  9.88e-06  5.68e-07  4.57e-07  2.35e-07
rastrigin    ROA  9.88e-07  1.23e-04  1.57e-06  8.90e-07  7.89e-07
griewank     AOA  3.46e-07  7.65e-05  1.23e-06  8.90e-07  4.57e-07
griewank     ROA  6.54e-06  2.35e-04  5.68e-06  3.46e-06  1.23e-06
ackley       AOA  1.23e-05  5.68e-03  3.46e-04  2.35e-04  1.23e-03
ackley       ROA  3.46e-04  1.23e-02  9.88e-04  7.65e-04  3.46e-03
michalewicz  AOA  1.23e-08  4.57e-06  2.35e-07  1.23e-07  5.68e-08
michalewicz  ROA  2.35e-07  9.88e-05  1.57e-06  1.23e-06  2.35e-07
himmelblau   AOA  1.23e-06  3.46e-04  1.57e-05  9.01e-06  2.35e-05
himmelblau   ROA  1.57e-05  5.68e-03  2.35e-04  1.23e-04  4.57e-04
booth        AOA  2.35e-06  4.57e-04  1.23e-05  6.79e-06  2.35e-05
booth        ROA  5.68e-05  2.35e-03  1.23e-04  9.01e-05  3.46e-04
beale        AOA  1.23e-03  7.65e-02  2.35e-03  1.23e-03  5.68e-03
beale        ROA  3.46e-03  1.23e-01  4.57e-03  2.35e-03  1.23e-02
"""
"""Best, worst, mean, median, std, f1 to f9 in the order in which its text names them. For HAOAROA all 45 are 0."""
HAOAROA_TOLD = 0.0
TOLD_DIGITS = 0.01
"""Numbers of three digits may be off by this much, relatively."""


@dataclass(frozen=True, slots=True)
class Claim:
    """One row of the paper's Table 3."""

    function: str
    contender: str
    spread: Spread

    @property
    def wrong(self) -> list[str]:
        """Which of its numbers its own best and worst leave no room for."""
        s = self.spread
        least = (("mean", s.mean, s.least_mean(RUNS)), ("std", s.std, s.least_std(RUNS)))
        return [name for name, value, bound in least if value < bound * (1.0 - TOLD_DIGITS)]


CLAIMS = tuple(
    Claim(words[0], words[1], Spread(*map(float, words[2:]))) for words in map(str.split, TABLE_3.strip().splitlines())
)
