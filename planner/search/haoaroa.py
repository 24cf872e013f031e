"""HAOAROA: Archimedes exploration, then rider exploitation, with the gradient as buoyancy. Ask/tell.

Legend (n_pop candidates of dimension n_dim, iteration t of T):
    x, v          positions and velocities        x_best, g_best   best of each candidate, best of all
    s             each candidate's own step length along the gradient (lambda_p of Eq. 44 and beta_p of Eq. 48)
    g             gradient divided by its largest component
    den, vol, acc density, volume, acceleration of the Archimedes Optimization Algorithm (Hashim 2021), without gradient
    w = 0.8 -> 0.4;  TF = exp((t - T)/T);  d = exp((T - t)/T) - t/T;  c1 = 2.0, c2 = 1.5;  r in U(0, 1), fresh each time

The paper's Eq. 43-49 (a tag stands below its formula; the text names most of them one too low) are not an algorithm
yet: Eq. 45, F = -grad J, makes the buoyancy step P + lambda F of Eq. 44 plain gradient descent; Eq. 46 only says again
that J is length + smoothness + obstacles; Eq. 47 is the first half of Eq. 48; both gradients of Eq. 49 are gradients of
the one J; and lambda, gamma, beta, alpha_1, alpha_2 are never given. No equation of the paper explores: the way toward
a random candidate is taken from Hashim 2021, as are TF and d. This is the reading computed here:

    TF <= 1/2:  v = w v + 0.3 r d (x_rand - x)                           - s g     Hashim 2021; -s g is Eq. 44 with 45
    else:       v = w v + (c1 r1 (x_best - x) + c2 r2 (leader - x)) / 2  - s g     Eq. 48, of which 47 is the first half
    x = x + v, clipped to the bounds, where a clipped component loses its velocity        Eq. 49: both in one update
    s grows by 1.2 when the cost fell and shrinks to 0.7 of itself when it did not

`leader` is where the four rider groups (Binu & Kariyappa 2019) differ; the original multiplies the leader's
coordinates, which favours the origin, so each is restated by differences (shift invariant: moving the map moves the
answer with it):
    bypass     a random mix of two other riders' bests     follower    g_best, on coordinates that open with t/T
    overtaker  g_best and as far again beyond it, by r     attacker    g_best

Without a gradient the buoyancy is AOA's own, from den, vol and acc, in its shift-invariant form (X_rand - x, X_best -
x). Density, volume and acceleration are dimensionless: they only weigh differences of positions.

This is the mode shift_invariant; `hybrids` has the equations as printed, and the two parents one after the other.

Every random number of an iteration comes from one block `uniforms` (n_pop, draws), so that `tell` and a fused loop
which calls `move` itself (see `planner.descent`) make the same moves from the same generator.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner.jit import kernel
from planner.search.asktell import ITERATIONS, POPULATION, AskTell, Best

FloatArray = NDArray[np.float64]

C1, C2 = 2.0, 1.5
# Hashim 2021, C4 of 0.5..2. Its C3 = 2 makes tau = min(C3 TF, 1) one wherever it stands, since TF > 1/2 there.
_AOA_C1, _AOA_C2, _AOA_C4 = 2.0, 6.0, 0.5
_GROUPS = 4
_EXTRA = 8  # uniforms a candidate takes besides two a coordinate


class Population(NamedTuple):
    """Arrays of the whole population; the kernels write into them."""

    positions: FloatArray  # (n_pop, n_dim)
    velocities: FloatArray  # (n_pop, n_dim)
    gradients: FloatArray  # (n_pop, n_dim) zero where none was told
    costs: FloatArray  # (n_pop,) at the positions
    previous: FloatArray  # (n_pop,) at the positions before
    best_positions: FloatArray  # (n_pop, n_dim)
    best_costs: FloatArray  # (n_pop,)
    steps: FloatArray  # (n_pop,) s
    traits: FloatArray  # (n_pop, 3) den, vol, acc normalised to [0.1, 1]
    lower: FloatArray  # (n_dim,)
    upper: FloatArray  # (n_dim,)


def draws(n_dim: int) -> int:
    """How many uniform numbers one candidate takes an iteration."""
    return 2 * n_dim + _EXTRA


@kernel
def remember(p: Population) -> None:
    """Keep each candidate's best and adapt its step, once `costs` and `gradients` are filled in."""
    for i in range(p.costs.shape[0]):
        if p.costs[i] < p.best_costs[i]:  # J of Eq. 46; the better one is kept (the text below Eq. 47)
            p.best_costs[i] = p.costs[i]
            p.best_positions[i, :] = p.positions[i]
        p.steps[i] *= 1.2 if p.costs[i] < p.previous[i] else 0.7
        p.previous[i] = p.costs[i]


@kernel
def move_traits(p: Population, explore: bool, best: int, uniforms: FloatArray) -> None:
    """AOA's density, volume and acceleration; collisions with a random material, later with the best."""
    n_pop = p.costs.shape[0]
    raw = np.empty(n_pop)
    for i in range(n_pop):
        u = uniforms[i]
        other = int(u[5] * n_pop) if explore else best
        den, vol = p.traits[i, 0], p.traits[i, 1]
        den += u[6] * (p.traits[best, 0] - den)
        vol += u[7] * (p.traits[best, 1] - vol)
        raw[i] = (p.traits[other, 0] + p.traits[other, 1] * p.traits[other, 2]) / (den * vol)
        p.traits[i, 0], p.traits[i, 1] = den, vol
    low, high = raw.min(), raw.max()
    for i in range(n_pop):
        p.traits[i, 2] = 0.1 + 0.9 * (raw[i] - low) / (high - low) if high > low else 1.0


@kernel
def move(p: Population, t: int, last: int, uniforms: FloatArray, with_gradient: bool) -> None:
    """One iteration's move of every candidate; t = 1 .. last. The one statement of the update rule."""
    n_pop, n_dim = p.positions.shape
    progress = t / last
    TF = math.exp(progress - 1.0)
    d = math.exp(1.0 - progress) - progress
    w = 0.8 - 0.4 * progress
    explore = TF <= 0.5
    best = int(np.argmin(p.best_costs))
    if not with_gradient:
        move_traits(p, explore, best, uniforms)
    for i in range(n_pop):
        u = uniforms[i]
        x, v, mine, leader = p.positions[i], p.velocities[i], p.best_positions[i], p.best_positions[best]
        random = p.positions[int(u[0] * n_pop)]
        mate_a, mate_b = p.best_positions[int(u[1] * n_pop)], p.best_positions[int(u[2] * n_pop)]
        largest = 0.0
        for k in range(n_dim):
            largest = max(largest, abs(p.gradients[i, k]))
        buoyant = p.steps[i] / largest if largest > 0.0 else 0.0
        group = i % _GROUPS
        sign = 1.0 if 2.0 * u[3] - _AOA_C4 <= 0.5 else -1.0  # AOA's direction flag F
        for k in range(n_dim):
            r1, r2 = u[_EXTRA + 2 * k], u[_EXTRA + 2 * k + 1]
            if explore:
                pull = 0.3 * r1 * d * (random[k] - x[k])  # AOA's exploration (Hashim 2021)
            else:
                if group == 0:  # bypass
                    goal = u[4] * mate_a[k] + (1.0 - u[4]) * mate_b[k]
                elif group == 1:  # follower
                    goal = leader[k] if r2 < progress else mine[k]
                elif group == 2:  # overtaker
                    goal = leader[k] + u[4] * (leader[k] - x[k])
                else:  # attacker
                    goal = leader[k]
                pull = 0.5 * (C1 * r1 * (mine[k] - x[k]) + C2 * r2 * (goal - x[k]))  # gamma term of Eq. 47, 48
            if with_gradient:
                # lambda F with F = -grad J (Eq. 44, 45); while exploiting the same is -beta grad J (Eq. 48)
                buoyancy = -buoyant * p.gradients[i, k]
            elif explore:
                buoyancy = _AOA_C1 * r2 * p.traits[i, 2] * d * (random[k] - x[k])
            else:
                buoyancy = sign * _AOA_C2 * r2 * p.traits[i, 2] * d * (leader[k] - x[k])
            v[k] = w * v[k] + pull + buoyancy
            x[k] += v[k]  # Eq. 49
            if x[k] < p.lower[k]:
                x[k], v[k] = p.lower[k], 0.0
            elif x[k] > p.upper[k]:
                x[k], v[k] = p.upper[k], 0.0


class Haoaroa(AskTell):
    """HAOAROA; parameters and errors as `AskTell`. `initial` are the first candidates of Eq. 43.

    Attributes
    ----------
    population : all that one iteration hands to the next.
    """

    def __init__(
        self,
        lower: FloatArray,
        upper: FloatArray,
        generator: np.random.Generator,
        initial: FloatArray | None = None,
        population: int = POPULATION,
        budget: int = POPULATION * ITERATIONS,
        step: float = 0.1,
    ) -> None:
        super().__init__(lower, upper, generator, initial, population, budget, step)
        shape = self.first.shape
        self.population = Population(
            positions=self.first,
            velocities=np.zeros(shape),
            gradients=np.zeros(shape),
            costs=np.full(population, np.inf),
            previous=np.full(population, np.inf),
            best_positions=self.first.copy(),
            best_costs=np.full(population, np.inf),
            steps=self.steps / 1.2,  # the first evaluation improves on infinity
            traits=0.1 + 0.9 * generator.random((population, 3)),
            lower=self.lower,
            upper=self.upper,
        )

    def uniforms(self, count: int) -> FloatArray:
        """Random numbers of the next `count` iterations, (count, n_pop, draws); they are then used up."""
        n_pop, n_dim = self.population.positions.shape
        return self.generator.random((count, n_pop, draws(n_dim)))

    def advance(self, iterations: int) -> None:
        """Count iterations that a fused loop has made on `population`."""
        self.iteration += iterations
        self.evaluations += iterations * len(self.population.costs)

    def ask(self) -> FloatArray:
        """The candidates to evaluate (n_pop, n_dim), a copy."""
        return self.population.positions.copy()

    def _move(self, costs: FloatArray, gradients: FloatArray | None) -> None:
        p = self.population
        p.costs[:] = costs
        p.gradients[:] = 0.0 if gradients is None else gradients
        remember(p)
        move(p, self.iteration + 1, self.iterations, self.uniforms(1)[0], gradients is not None)

    @property
    def best(self) -> Best:
        """The best candidate so far; its cost is inf before the first `tell`."""
        i = int(np.argmin(self.population.best_costs))
        return Best(self.population.best_positions[i].copy(), float(self.population.best_costs[i]))
