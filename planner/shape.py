"""From a query to a curve in space: what every method hands over, and HAOAROA's own way there.

    fan of bows -> HAOAROA on the spline's cost -> L-BFGS on the distinct best -> certificate

When none of the fan can be proved, it is asked whether there is a way at all (`enclosure`); if so, a search graph gives
those that pass the obstacles differently (`guide`), and the same polish follows them, more closely from try to try.
"""

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from planner import errors
from planner.bspline import DEGREE, FloatArray, bezier_pieces, clamped_knots
from planner.certificate import certify, end_needed, needed
from planner.cost import FIXED, SAMPLES, SplineCost
from planner.descent import polish, search
from planner.enclosure import PITCHES, apart
from planner.guide import Guide, Guides, guide
from planner.nearby import Grid, IntArray, build_grid
from planner.query import Query
from planner.search.asktell import POPULATION
from planner.search.haoaroa import Haoaroa
from planner.seeds import along_path, fan, fan_through, swerve

SPACING = 1.4
"""Aimed distance between control points [m]."""
FEWEST, MOST, MOST_GUIDED = 16, 120, 400
"""Control points of a plan; along a guide there may be more, since a polish costs less than a search."""
LEG = 4
"""Spans between two via points at least."""
ITERATIONS = 10
"""Of HAOAROA: three of exploration, the rest of exploitation. It has to find the right side of the obstacles, not the
minimum: the polish is the better finisher, so six candidates polished after ten iterations come out shorter (in forests
by 1 % of the median) than four after fifteen, in the same time; eight gain no more than 0.1 %.
"""
ELITES = 6
NEAREST = 0.25
"""Least reach c of the obstacles' hinge [m]. Crossing a sheet costs k c^2/2 (see `cost`): with less, a detour around
one would not pay. Nor is c less than the way between two samples, so that no sheet stands between them unseen.
"""
STEP = 0.5
"""Along a guide a step of the polish is at most this much of the reach, lest the curve jump to a sheet's other side."""
STIFFER = (1.0, 4.0, 32.0)
"""Factors on the obstacle weight, tried in turn until a curve is proved."""
HOPELESS = 2
"""When so many of the fan's best lead right through a solid, the search graph is asked."""
SIDES = 3
"""Ways past the obstacles that are followed on one lattice when the first cannot be proved."""
WORTH = 1.1
"""How much longer than a way that is proved another may be to be followed too: its curve may be the shorter."""
LATTICES = 2
"""Lattices that show a way, and whose ways are followed."""


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
    duration: float | None = None  # what the ends' points are set out for [s]; None: at rest at both ends
    via_knots: IntArray | None = None  # (m,) knots, in spans from the start, where the via points are passed
    turns_on_spot: bool = False  # whether it stops at a corner and goes on another way: curvature without bound

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
    Try(SPACING, 0.7, np.inf),  # of the fan too; softer curves are up to 0.5 % longer, and take longer to fly
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
    return Search(query, effort).shapes()


class Search:
    """One search's working state; rivals that search on the same cost begin with it too."""

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
        self.shortest_way = math.inf  # of the search graph's [m]

    def shapes(self) -> Iterator[Shape]:
        query, effort = self.query, self.effort
        cost = self.first_cost()
        candidates = self.search(cost)
        yield from self.prove_all(itertools.islice(candidates, ELITES), cost, HOPELESS)
        if not query.guides:
            return
        effort.guided = True
        if len(query.via):
            yield from self.leg_by_leg()
        guides = Guides(self.world, query.start, query.goal, self.radius)
        yield from self.along_guides(guides)
        yield from self.prove_all(candidates, cost, POPULATION)
        raise self.no_path(guides, proved=False)

    def leg_by_leg(self) -> Iterator[Shape]:
        """Shapes that follow the search graph's way from via point to via point; NoPathFound when there are no more."""
        legs = []
        for a, b in itertools.pairwise(self.query.corners):
            legs.append(guide(self.world, a, b, self.radius))
            if not len(legs[-1].path):
                raise self.no_path(legs[-1], proved=apart(self.world, a, b, self.radius, PITCHES))
        way = Guide(np.concatenate([leg.path for leg in legs]), max(leg.width for leg in legs))
        self.shortest_way = way.length
        for how in TRIES:
            found = self.follow(way, how, [leg.length for leg in legs])
            yield from (shape for _, shape in sorted(found, key=lambda pair: pair[0]))
        raise self.no_path(way, proved=False)

    def along_guides(self, guides: Guides) -> Iterator[Shape]:
        """Shapes that follow ways of the search graph, best first, from the coarsest lattice that leads to one.

        Raises NoPathFound as soon as it is proved that there is none; the quick proofs are tried first.
        """
        self.look_for_proof(guides, 0, 1)
        followed = 0
        while not guides.finest and followed < LATTICES:
            guides.refine()
            first = guides.another()
            if first is not None:
                followed += 1
                self.shortest_way = min(self.shortest_way, first.length)
                yield from self.sides(guides, first)
            if guides.level == 0:
                self.look_for_proof(guides, 1, 5)
        self.look_for_proof(guides, 5, len(PITCHES))

    def sides(self, guides: Guides, first: Guide) -> list[Shape]:
        """What comes of the first way on this lattice and of those on other sides of the obstacles, best first."""
        ways, found = [first], list[tuple[float, Shape]]()
        for how in TRIES:
            for way in ways:
                found += self.follow(way, how)
            if found:
                break
            if how is TRIES[0]:
                others = (guides.another() for _ in range(SIDES - 1))
                ways += [way for way in others if way is not None]
        if found and len(ways) == 1:
            other = guides.another(WORTH * first.length)
            found += [] if other is None else self.follow(other, how)
        return [shape for _, shape in sorted(found, key=lambda pair: pair[0])]

    def look_for_proof(self, guides: Guides, first: int, last: int) -> None:
        if apart(self.world, self.query.start, self.query.goal, self.radius, PITCHES[first:last]):
            raise self.no_path(guides, proved=True)

    def no_path(self, guides: Guides | Guide, proved: bool) -> errors.NoPathFound:
        effort = self.effort
        tried, evaluations, lack = effort.tried, effort.evaluations, self.shortfall()
        return errors.NoPathFound(tried, evaluations, lack, self.radius, self.shortest_way, guides.width, proved=proved)

    def spline_cost(self, legs: Sequence[float], how: Try, most: int) -> SplineCost:
        length = sum(legs)
        fewest = max(FEWEST, LEG * len(legs) + DEGREE)
        n = int(np.clip(round(length / how.spacing) + DEGREE, fewest, max(most, fewest)))
        wanted = max(self.radius + max(0.05, 0.4 * self.radius), NEAREST)
        reach = max(min(wanted, self.radius + how.buffer), length / ((n - DEGREE) * SAMPLES))
        if reach > self.grid_reach:
            self.grid, self.grid_reach = build_grid(self.world, reach, self.query.corners), reach
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
            pinned=self.query.pinned(n, length),
            via=self.query.via,
            via_knots=knots_of_legs(legs, n - DEGREE),
        )

    def first_cost(self) -> SplineCost:
        """The cost that the fan's curves are judged by."""
        return self.spline_cost(self.query.legs, TRIES[0], MOST)

    def seeds(self, cost: SplineCost) -> FloatArray:
        """The fan (POPULATION, 3 f)."""
        query, f = self.query, cost.n - 2 * FIXED
        if len(query.via):
            at = cost.problem.via_at
            seeds = fan_through(query.corners, self.lower, self.upper, at, cost.n, POPULATION, self.generator)
        else:
            seeds = fan(query.start, query.goal, self.lower, self.upper, cost.n, POPULATION, self.generator)
        if query.moving:
            seeds = np.clip(seeds + swerve(query, cost.n, cost.way), np.tile(self.lower, f), np.tile(self.upper, f))
        return seeds

    def search(self, cost: SplineCost) -> Iterator[FloatArray]:
        """HAOAROA from the fan; the best of each candidate, best first, those near a better one left out."""
        seeds = self.seeds(cost)
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

    def prove_all(self, seeds: Iterable[FloatArray], cost: SplineCost, hopeless: int) -> Iterator[Shape]:
        """Polish seeds, most promising first; what can be proved, best first. Stop after ELITES once something is.

        A curve that leads right through a solid is given up: weighing obstacles more pushes it from both sides. When
        the first `hopeless` are such, so are the rest.
        """
        found: list[tuple[float, FloatArray]] = []
        through = 0
        for k, seed in enumerate(seeds):
            if (k >= ELITES and found) or (k == through == hopeless):
                break
            self.effort.tried += 1
            x = seed
            for factor in STIFFER:
                x, evaluations = polish(cost, x, factor)
                self.effort.evaluations += evaluations
                x = self.inside(cost, x)
                if self.proved(cost, x):
                    self.effort.certified += 1
                    found.append((cost.energy(x), x))
                    break
                inside = self.least_distance(cost.control_points(x), 4) < 0.0
                if inside or factor == STIFFER[-1]:
                    self.refused.append(cost.control_points(x))
                    through += inside
                    break
        for _, x in sorted(found, key=lambda pair: pair[0]):
            yield self.shape_of(cost, x)

    def follow(self, way: Guide, how: Try, legs: Sequence[float] | None = None) -> list[tuple[float, Shape]]:
        """Polish the curve along a way, obstacles at their stiffest first, so that it stays on the way's side of them.

        What is proved comes with its J_stretch + J_smooth in a scale common to all ways [m^2].
        """
        cost = self.spline_cost([way.length] if legs is None else legs, how, MOST_GUIDED)
        x = along_path(way.path, cost.n)
        found: list[tuple[float, Shape]] = []
        self.effort.tried += 1
        for factor in STIFFER[::-1]:
            x, evaluations = polish(cost, x, factor, longest=STEP * cost.reach)
            self.effort.evaluations += evaluations
            x = self.inside(cost, x)
            if self.proved(cost, x):
                shape = self.shape_of(cost, x)
                found.append((shape.value * cost.distance, shape))
            elif not found:
                self.refused.append(cost.control_points(x))
            else:
                break
        self.effort.certified += bool(found)
        return found

    def proved(self, cost: SplineCost, x: FloatArray) -> bool:
        return certify(cost.control_points(x), cost.knots, self.world, self.radius, full=False).certified

    def inside(self, cost: SplineCost, x: FloatArray) -> FloatArray:
        """The free control points moved into the map: their hull then keeps the radius from its walls."""
        held: FloatArray = np.clip(x.reshape(-1, 3), self.lower, self.upper).ravel()
        return cost.snapped(held) if len(self.query.via) else held

    def shape_of(self, cost: SplineCost, x: FloatArray) -> Shape:
        """The curve of the free control points x (3 f,), what it costs and how it meets the query."""
        terms, query = cost.terms(x), self.query
        return Shape(
            cost.control_points(x),
            cost.knots,
            terms.stretch,
            terms.smoothness,
            terms.obstacle,
            duration=query.duration(cost.way) if query.moving else None,
            via_knots=cost.problem.via_at + FIXED - 1 if len(query.via) else None,
        )

    def least_distance(self, points: FloatArray, count: int) -> float:
        """Of `count` samples a span of a curve to solids and walls [m]."""
        s = ((np.arange(count) + 0.5) / count)[:, None]
        bernstein = np.concatenate([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3], axis=1)
        samples = (bernstein @ bezier_pieces(points, clamped_knots(len(points)))).reshape(-1, 3)
        return float(min(self.world.distance(samples).min(), self.world.wall_distance(samples).min()))

    def shortfall(self) -> float:
        """By how much the best of the unproved curves misses the radius on samples [m], for the error."""
        least = [self.least_distance(points, 20) for points in self.refused]
        return max(self.radius - max(least), 0.0) if least else math.inf


def knots_of_legs(legs: Sequence[float], spans: int) -> IntArray:
    """Where via points are passed, in spans from the start (m,): by the legs' lengths, each at least LEG spans long."""
    shares = np.cumsum(legs)[:-1] / max(sum(legs), 1e-9)
    knots = np.round(shares * spans).astype(np.int64)
    for k in range(len(knots)):
        knots[k] = max(knots[k], LEG * (k + 1), knots[k - 1] + LEG if k else 0)
    for k in range(len(knots) - 1, -1, -1):
        knots[k] = min(knots[k], spans - LEG * (len(knots) - k), knots[k + 1] - LEG if k + 1 < len(knots) else spans)
    return knots
