"""ROA, the Rider Optimization Algorithm of Binu and Kariyappa. Ask/tell.

D. Binu, B. S. Kariyappa, "RideNN: A new rider optimization algorithm-based neural network for fault diagnosis in analog
circuits", IEEE Transactions on Instrumentation and Measurement 68 (2019) 2-26. Riders i of R in four groups of equal
size, coordinates j of Q, time t of T_off; L is the leading rider. The rules, under the names used on the lines:

    bypass      X_i = delta (beta X_eta + (1 - beta) X_xi),  eta, xi any two riders, beta one a coordinate
    follower    X_ik = X_Lk + cos(T_ik) X_Lk d_i     on selected coordinates k
    overtaker   X_ik = X_ik + I_i X_Lk               on selected coordinates k
    attacker    X_ij = X_Lj + cos(T_ij) X_Lj + d_i
    steering    T_i1 = 2 pi i/R,  T_ij = T_i,j-1 + 2 pi/Q;  later the angles of rider i + 1 after a success, else i - 1
    gear        E_i = 0;  later one up to 4 after a success, else one down to 0
    accelerator e_i = E_i/4;  brake K_i = 1 - E_i/4
    speed       v_i = (V_E + e_i V_max + (1 - K_i) V_max)/3,  V_E = V_max E_i/4,  V_max = (X_U - X_L)/T_off
    direction   I_i = 2/(1 - log S_i) - 1,  S_i the relative rate of success, 1 for the leader

With these three speeds equal, gear, accelerator and brake are one number: v_i = V_max E_i/4.

Readings, where the text does not decide:
    rate of success     the text has 1/(distance to the target), which is not known. Here S = (f_worst - f)/(f_worst -
                        f_best) among the riders of this iteration, kept from 0 by a millionth: I is in (-0.9, 1].
    distance d_i        what v_i covers in one iteration; one a coordinate where the bounds differ.
    follower's k        each coordinate is open with probability t/T_off.
    overtaker's k       those on which the rider is no farther from the leader than on the mean of its coordinates.
    group of rider i    i modulo 4.
    the leader          in `literal` the best rider of this iteration, in the other modes the best position so far.

`literal` and `canonical` differ in the leader alone: no program of the authors' was found to decide more. Both multiply
coordinates, so bypass riders shrink toward the origin, and followers, overtakers and attackers step in its direction.
`shift_invariant` puts X_L - X_i for X_L wherever it is a step, and makes the follower's d_i a share of V_max:
    bypass      X_i = X_i + delta (mix - X_i)               follower   X_ik = X_Lk + cos(T_ik) (X_Lk - X_ik) E_i/4
    overtaker   X_ik = X_ik + I_i (X_Lk - X_ik)             attacker   X_ij = X_Lj + cos(T_ij) (X_Lj - X_ij) + d_i

With gradients (told to `tell`), each rider also steps down its own: x -= s g, as in the paper's Eq. 48.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner.jit import kernel
from planner.search.asktell import ITERATIONS, POPULATION, AskTell, Best, Mode

FloatArray = NDArray[np.float64]

TOP_GEAR = 4.0
_GROUPS = 4
_LEAST_SUCCESS = 1e-6
_EXTRA = 3  # uniforms a rider takes besides one a coordinate


class Riders(NamedTuple):
    """Arrays of all riders; the kernels write into them."""

    positions: FloatArray  # (n_pop, n_dim)
    gradients: FloatArray  # (n_pop, n_dim) zero where none was told
    costs: FloatArray  # (n_pop,)
    previous: FloatArray  # (n_pop,) costs of the positions before
    angles: FloatArray  # (n_pop, n_dim) T [rad]
    gears: FloatArray  # (n_pop,) E, 0 .. 4
    leader: FloatArray  # (n_dim,) X_L
    best_position: FloatArray  # (n_dim,)
    best_cost: FloatArray  # (1,)
    steps: FloatArray  # (n_pop,) s
    lower: FloatArray  # (n_dim,)
    upper: FloatArray  # (n_dim,)


def draws(n_dim: int) -> int:
    """How many uniform numbers one rider takes an iteration."""
    return n_dim + _EXTRA


@kernel
def race(p: Riders, remembered: bool) -> None:
    """Who leads, who succeeded: once `costs` and `gradients` are filled in."""
    n_pop = p.costs.shape[0]
    top = int(np.argmin(p.costs))
    if p.costs[top] < p.best_cost[0]:
        p.best_cost[0] = p.costs[top]
        p.best_position[:] = p.positions[top]
    p.leader[:] = p.best_position if remembered else p.positions[top]
    before = p.angles.copy()
    for i in range(n_pop):
        success = p.costs[i] < p.previous[i]
        p.angles[i, :] = before[(i + 1) % n_pop] if success else before[(i - 1) % n_pop]  # steering
        p.gears[i] = min(p.gears[i] + 1.0, TOP_GEAR) if success else max(p.gears[i] - 1.0, 0.0)  # gear
        p.steps[i] *= 1.2 if success else 0.7
        p.previous[i] = p.costs[i]


@kernel
def direction(costs: FloatArray) -> FloatArray:
    """I of every rider (n_pop,), from the costs; riders without a finite cost have the least success."""
    best, worst = np.inf, -np.inf
    for cost in costs:
        if math.isfinite(cost):
            best, worst = min(best, cost), max(worst, cost)
    found = np.empty(costs.shape[0])
    for i in range(costs.shape[0]):
        success = (worst / 2 - costs[i] / 2) / (worst / 2 - best / 2) if worst > best else 1.0  # halves do not overflow
        success = max(success, _LEAST_SUCCESS) if math.isfinite(costs[i]) else _LEAST_SUCCESS
        found[i] = 2.0 / (1.0 - math.log(success)) - 1.0
    return found


@kernel
def move(p: Riders, t: int, last: int, uniforms: FloatArray, with_gradient: bool, invariant: bool) -> None:
    """One iteration's ride; t = 1 .. last. The one statement of the update rule."""
    n_pop, n_dim = p.positions.shape
    before = p.positions.copy()
    indicator = direction(p.costs)
    for i in range(n_pop):
        u = uniforms[i]
        x = before[i]
        eta, xi = before[int(u[0] * n_pop)], before[int(u[1] * n_pop)]
        delta, group = u[2], i % _GROUPS
        largest = np.abs(p.gradients[i]).max()
        away = np.abs(p.leader - x)
        for k in range(n_dim):
            step = p.leader[k] - x[k] if invariant else p.leader[k]
            d = (p.upper[k] - p.lower[k]) / last * p.gears[i] / TOP_GEAR  # accelerator, brake and speed, over one t
            beta = u[_EXTRA + k]
            goal = x[k]
            if group == 0:  # bypass
                mix = beta * eta[k] + (1.0 - beta) * xi[k]
                goal = x[k] + delta * (mix - x[k]) if invariant else delta * mix
            elif group == 1:  # follower
                if beta < t / last:
                    share = p.gears[i] / TOP_GEAR if invariant else d
                    goal = p.leader[k] + math.cos(p.angles[i, k]) * step * share
            elif group == 2:  # overtaker
                if away[k] <= away.mean():
                    goal = x[k] + indicator[i] * step
            else:  # attacker
                goal = p.leader[k] + math.cos(p.angles[i, k]) * step + d
            if with_gradient and largest > 0.0:
                goal -= p.steps[i] * p.gradients[i, k] / largest
            p.positions[i, k] = min(max(goal, p.lower[k]), p.upper[k])


class Roa(AskTell):
    """Ask/tell ROA. `ask` gives the riders (n_pop, n_dim), `tell` takes their costs and, if known, gradients.

    `mode` as in the module; all else, errors included, as `AskTell`.
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
        mode: Mode = Mode.SHIFT_INVARIANT,
    ) -> None:
        super().__init__(lower, upper, generator, initial, population, budget, step)
        self._mode = mode
        n_pop, n_dim = self.first.shape
        first_angle = 2.0 * np.pi * np.arange(1, n_pop + 1) / n_pop
        angles = first_angle[:, None] + 2.0 * np.pi * np.arange(n_dim) / n_dim
        self.population = Riders(
            positions=self.first.copy(),
            gradients=np.zeros(self.first.shape),
            costs=np.full(population, np.inf),
            previous=np.full(population, np.inf),
            angles=np.mod(angles, 2.0 * np.pi),
            gears=np.full(population, 0.0),
            leader=self.first[0].copy(),
            best_position=self.first[0].copy(),
            best_cost=np.full(1, np.inf),
            steps=self.steps / 1.2,  # the first evaluation improves on infinity
            lower=self.lower,
            upper=self.upper,
        )

    def ask(self) -> FloatArray:
        """The riders to evaluate (n_pop, n_dim), a copy."""
        return self.population.positions.copy()

    def _move(self, costs: FloatArray, gradients: FloatArray | None) -> None:
        p = self.population
        p.costs[:] = costs
        p.gradients[:] = 0.0 if gradients is None else gradients
        race(p, self._mode is not Mode.LITERAL)
        uniforms = self.generator.random((len(costs), draws(len(self.lower))))
        invariant = self._mode is Mode.SHIFT_INVARIANT
        move(p, self.iteration + 1, self.iterations, uniforms, gradients is not None, invariant)

    @property
    def best(self) -> Best:
        """The best rider so far; its cost is inf before the first `tell`."""
        return Best(self.population.best_position.copy(), float(self.population.best_cost[0]))
