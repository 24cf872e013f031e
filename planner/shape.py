"""From a query to a curve in space: what every method hands over, and HAOAROA's own way there.

    fan of bows -> HAOAROA on the spline's cost -> L-BFGS on the distinct best -> certificate

When none of the fan can be proved, a search graph gives the way round and the same polish follows it, more closely from
try to try.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from planner import errors
from planner.bspline import DEGREE, FloatArray, clamped_knots, evaluate
from planner.certificate import certify, end_needed, needed
from planner.cost import FIXED, SAMPLES, Grid, SplineCost, build_grid
from planner.descent import polish, search
from planner.guide import guide
from planner.query import Query
from planner.search.asktell import POPULATION
from planner.search.haoaroa import Haoaroa
from planner.seeds import along_path, fan

SPACING = 1.4
"""Aimed distance between control points [m]."""
FEWEST, MOST, MOST_GUIDED = 16, 120, 400
"""Control points of a plan; along a guide there may be more, since a polish costs less than a search."""
ITERATIONS = 15
"""Of HAOAROA: four of exploration, the rest of exploitation. It has to find the right side of the obstacles, not the
minimum: the polish is the better finisher. On each family of benchmark worlds 12, 15, 20 and 30 iterations end in mean
lengths within 0.4 %.
"""
ELITES = 4
NEAREST = 0.25
"""Least reach c of the obstacles' hinge [m]. Crossing a sheet costs k c^2/2 (see `cost`): with less, a detour around
one would not pay. Nor is c less than the way between two samples, so that no sheet stands between them unseen.
"""
STEP = 0.5
"""Along a guide a step of the polish is at most this much of the reach, lest the curve jump to a sheet's other side."""
STIFFER = (1.0, 4.0, 32.0)
"""Factors on the obstacle weight, tried in turn until a curve is proved."""


@dataclass(slots=True)
class Effort:
    """What finding a shape took, counted as it goes."""

    evaluations: int = 0  # of the cost with its gradient
    iterations: int = 0  # of the search
    tried: int = 0  # curves polished and put to the proof
    certified: int = 0
    guided: bool = False  # whether the search graph had to help


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """A curve in space: what a method hands over to be timed and proved."""

    control_points: FloatArray  # (n, 3) [m]
    knots: FloatArray  # (n + 4,) clamped on [0, 1]
    stretch: float  # J_stretch [m]
    smoothness: float  # J_smooth [m]
    obstacle: float  # J_obstacle, at its first weight [m]

    @property
    def value(self) -> float:
        """What proved shapes are ranked by: stretch + smoothness [m]."""
        return self.stretch + self.smoothness


class Try(NamedTuple):
    """How a guide is followed."""

    spacing: float  # aimed distance between control points [m]
    softest: float  # bound on the rounding of corners [m] (see `cost`)
    buffer: float  # most that the hinge reaches beyond the radius [m]


TRIES = (
    Try(SPACING, np.inf, np.inf),
    Try(SPACING, 1.5, np.inf),  # mazes
    Try(SPACING / 2.0, 0.75, np.inf),
    Try(SPACING / 4.0, 0.4, 0.1),  # slits, where a wide hinge pushes from both sides alike
    Try(SPACING / 8.0, 0.4, 0.1),
)
"""Ways to follow a guide, in turn, until a curve is proved."""


def haoaroa(query: Query, effort: Effort) -> Iterator[Shape]:
    """Shapes that are proved to keep the radius, best first of the fan, then along guides.

    Raises
    ------
    NoPathFound : when asked for more than could be proved within the budget.
    """
    return _Search(query, effort).shapes()


class _Search:
    """One search's working state."""

    def __init__(self, query: Query, effort: Effort) -> None:
        self.query, self.effort = query, effort
        self.world, self.radius = query.world, query.radius
        self.generator = np.random.default_rng(query.seed)
        # Half a margin outside the ends' own bounds: provable, and lower < upper even where the map is 2 radius wide.
        room = (needed(self.world, self.radius) + end_needed(self.world, self.radius)) / 2.0
        self.lower, self.upper = self.world.walls[0] + room, self.world.walls[1] - room
        self.grid: Grid | None = None  # for the widest reach so far
        self.grid_reach = 0.0
        self.refused: list[FloatArray] = []

    def shapes(self) -> Iterator[Shape]:
        query, effort = self.query, self.effort
        cost = self.spline_cost(query.distance, Try(SPACING, np.inf, np.inf), MOST)
        yield from sorted(self.prove_all(self.search(cost), cost), key=lambda shape: shape.value)
        effort.guided = True
        way = guide(self.world, query.start, query.goal, self.radius)
        for how in TRIES if len(way.path) else ():
            cost = self.spline_cost(way.length, how, MOST_GUIDED)
            yield from sorted(self.follow(along_path(way.path, cost.n), cost), key=lambda shape: shape.value)
        raise errors.NoPathFound(effort.tried, effort.evaluations, self.shortfall(), self.radius, way.length, way.width)

    def spline_cost(self, length: float, how: Try, most: int) -> SplineCost:
        n = int(np.clip(round(length / how.spacing) + DEGREE, FEWEST, most))
        wanted = max(self.radius + max(0.05, 0.4 * self.radius), NEAREST)
        reach = max(min(wanted, self.radius + how.buffer), length / ((n - DEGREE) * SAMPLES))
        if reach > self.grid_reach:
            self.grid, self.grid_reach = build_grid(self.world, reach), reach
        return SplineCost(
            self.world,
            self.query.start,
            self.query.goal,
            n,
            self.query.limits,
            reach,
            length=length,
            softest=how.softest,
            grid=self.grid,
        )

    def search(self, cost: SplineCost) -> Iterator[FloatArray]:
        """HAOAROA from the fan; the best of each candidate, best first, those near a better one left out."""
        query = self.query
        seeds = fan(query.start, query.goal, self.lower, self.upper, cost.n, POPULATION, self.generator)
        f = cost.n - 2 * FIXED
        optimiser = Haoaroa(
            np.tile(self.lower, f),
            np.tile(self.upper, f),
            self.generator,
            initial=seeds,
            budget=POPULATION * ITERATIONS,
            step=0.02 * cost.distance,
        )
        search(optimiser, cost)
        self.effort.evaluations += optimiser.evaluations
        self.effort.iterations += optimiser.iteration
        order = np.argsort(optimiser.population.best_costs, kind="stable")
        ranked = optimiser.population.best_positions[order]
        for i in range(len(ranked)):
            if i == 0 or (np.abs(ranked[:i] - ranked[i]).max(axis=1) > cost.reach).all():
                yield ranked[i].copy()

    def prove_all(self, seeds: Iterable[FloatArray], cost: SplineCost) -> list[Shape]:
        """Polish the seeds, most promising first, and keep what can be proved; stop after ELITES once something is."""
        found: list[Shape] = []
        for k, seed in enumerate(seeds):
            if k >= ELITES and found:
                break
            self.effort.tried += 1
            x = seed
            for factor in STIFFER:
                x, evaluations = polish(cost, x, factor)
                self.effort.evaluations += evaluations
                x = self.inside(x)
                if self.proved(cost, x):
                    self.effort.certified += 1
                    found.append(shape_of(cost, x))
                    break
            else:
                self.refused.append(cost.control_points(x))
        return found

    def follow(self, x: FloatArray, cost: SplineCost) -> list[Shape]:
        """Polish a guide's seed, obstacles at their stiffest first, so that it stays on the guide's side of them."""
        found: list[Shape] = []
        self.effort.tried += 1
        for factor in STIFFER[::-1]:
            x, evaluations = polish(cost, x, factor, longest=STEP * cost.reach)
            self.effort.evaluations += evaluations
            x = self.inside(x)
            if self.proved(cost, x):
                found.append(shape_of(cost, x))
            elif not found:
                self.refused.append(cost.control_points(x))
            else:
                break
        self.effort.certified += bool(found)
        return found

    def proved(self, cost: SplineCost, x: FloatArray) -> bool:
        return certify(cost.control_points(x), cost.knots, self.world, self.radius, full=False).certified

    def inside(self, x: FloatArray) -> FloatArray:
        """The free control points moved into the map: their hull then keeps the radius from its walls."""
        held: FloatArray = np.clip(x.reshape(-1, 3), self.lower, self.upper).ravel()
        return held

    def shortfall(self) -> float:
        """By how much the best of the unproved curves misses the radius on samples [m], for the error."""
        least = np.inf
        for points in self.refused:
            samples = evaluate(points, clamped_knots(len(points)), np.linspace(0.0, 1.0, 20 * len(points)))
            nearest = min(self.world.distance(samples).min(), self.world.wall_distance(samples).min())
            least = min(least, max(self.radius - float(nearest), 0.0))
        return float(least)


def shape_of(cost: SplineCost, x: FloatArray) -> Shape:
    """The curve of the free control points x (3 f,) and what it costs."""
    terms = cost.terms(x)
    return Shape(cost.control_points(x), cost.knots, terms.stretch, terms.smoothness, terms.obstacle)
