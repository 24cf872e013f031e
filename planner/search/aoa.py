"""AOA, the Archimedes Optimization Algorithm of Hashim et al. Ask/tell.

F. A. Hashim, K. Hussain, E. H. Houssein, M. S. Mabrouk, W. Al-Atabany, "Archimedes optimization algorithm: a new
metaheuristic algorithm for solving optimization problems", Applied Intelligence 51 (2021) 1531-1551. Its equation
numbers stand on the lines (H4 is its Eq. 4), iteration t of T, materials i of n_pop, everything per coordinate:

    x = lb + r (ub - lb);  den = r;  vol = r;  acc = lb + r (ub - lb)                                        H4-H6
    den += r (den_best - den);  vol += r (vol_best - vol)                                                    H7
    TF = exp((t - T)/T);  d = exp((T - t)/T) - t/T                                                           H8, H9
    acc = (den_m + vol_m acc_m)/(den vol), m a random material early (H10), the best one late (H11)
    acc scaled to 0.1 .. 1 over the whole population                                                         H12
    early, TF <= 1/2:   x = x + C1 r acc d (x_rand - x)                                                      H13
    late:               x = x_best + F C2 r acc d (tau x_best - x),  tau = min(C3 TF, 1)                     H14
    F = +1 where 2 r - C4 <= 1/2, else -1                                                                    H15

The text is silent or ambiguous in a few places. How each mode reads it:

                        literal                canonical                         shift_invariant
    what is read        the printed equations  the authors' published program    the program, moved off the origin
    a worse move        is taken               is not (greedy)                   is not
    early ends at TF    0.5, both rules        0.45 for H10, 0.40 for H13        0.5, both rules
    r of H7             one a material         one an iteration                  one a material
    H10, H11            as above               divided by one r a material more  as above
    x_rand of H13       one a material         one a coordinate                  one a material
    F of H15            one a material         one a coordinate                  one a material
    acc at first (H6)   in the bounds          in the bounds                     0.1 .. 1
    tau, C3, C4         C3 = 1, C4 = 2         C3 = 1, C4 = 2                    tau = 1, C4 = 0.5

C3 = 1 and C4 = 2 are the authors' for benchmark functions. With them tau < 1 until the last iteration, so that H14 is
drawn to the origin of the coordinates, and F is always +1; and H6 makes accelerations depend on where the origin is.
The paper's own r in H13 and H14 is one a coordinate in all modes.

With gradients (told to `tell`), each material also steps down its own: x -= s g, the paper's Eq. 44 with 45.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planner.jit import kernel
from planner.search.asktell import ITERATIONS, POPULATION, AskTell, Best, Mode

FloatArray = NDArray[np.float64]

C1, C2 = 2.0, 6.0
_LITERAL, _CANONICAL, _INVARIANT = 0, 1, 2
_CODES = {Mode.LITERAL: _LITERAL, Mode.CANONICAL: _CANONICAL, Mode.SHIFT_INVARIANT: _INVARIANT}
_EXTRA = 5  # uniforms a material takes besides three a coordinate


class Materials(NamedTuple):
    """Arrays of the whole population; the kernels write into them."""

    positions: FloatArray  # (n_pop, n_dim) x, where each material is
    costs: FloatArray  # (n_pop,) there
    gradients: FloatArray  # (n_pop, n_dim) there, zero where none was told
    trials: FloatArray  # (n_pop, n_dim) where it would go: what is asked for
    trial_costs: FloatArray  # (n_pop,)
    trial_gradients: FloatArray  # (n_pop, n_dim)
    density: FloatArray  # (n_pop, n_dim) den
    volume: FloatArray  # (n_pop, n_dim) vol
    acceleration: FloatArray  # (n_pop, n_dim) acc, scaled
    best: FloatArray  # (4, n_dim) x, den, vol, acc of the best material when it was found
    best_cost: FloatArray  # (1,)
    steps: FloatArray  # (n_pop,) s
    lower: FloatArray  # (n_dim,)
    upper: FloatArray  # (n_dim,)


def draws(n_dim: int) -> int:
    """How many uniform numbers one material takes an iteration."""
    return 3 * n_dim + _EXTRA


@kernel
def keep(m: Materials, mode: int) -> None:
    """Take or refuse each trial and remember the best, once `trial_costs` and `trial_gradients` are filled in."""
    for i in range(m.costs.shape[0]):
        better = m.trial_costs[i] < m.costs[i]
        m.steps[i] *= 1.2 if better else 0.7
        if better or mode == _LITERAL:
            m.costs[i] = m.trial_costs[i]
            m.positions[i, :] = m.trials[i]
            m.gradients[i, :] = m.trial_gradients[i]
    top = int(np.argmin(m.costs))
    if m.costs[top] < m.best_cost[0]:
        m.best_cost[0] = m.costs[top]
        m.best[0, :] = m.positions[top]
        m.best[1, :] = m.density[top]
        m.best[2, :] = m.volume[top]
        m.best[3, :] = m.acceleration[top]


@kernel
def collide(m: Materials, TF: float, uniforms: FloatArray, mode: int) -> None:
    """Density, volume and acceleration, H7 and H10-H12."""
    n_pop, n_dim = m.positions.shape
    raw = np.empty((n_pop, n_dim))
    early = TF < 0.45 if mode == _CANONICAL else TF <= 0.5
    for i in range(n_pop):
        u = uniforms[i]
        r = uniforms[0, 0] if mode == _CANONICAL else u[0]
        other = int(u[1] * n_pop)
        more = 1.0 - u[2] if mode == _CANONICAL else 1.0
        for k in range(n_dim):
            m.density[i, k] += r * (m.best[1, k] - m.density[i, k])  # H7
            m.volume[i, k] += r * (m.best[2, k] - m.volume[i, k])
            if early:
                push = m.density[other, k] + m.volume[other, k] * m.acceleration[other, k]  # H10
            else:
                push = m.best[1, k] + m.best[2, k] * m.best[3, k]  # H11
            raw[i, k] = push / (more * m.density[i, k] * m.volume[i, k])
    low, high = raw.min(), raw.max()
    for i in range(n_pop):
        for k in range(n_dim):
            m.acceleration[i, k] = 0.1 + 0.9 * (raw[i, k] - low) / (high - low) if high > low else 1.0  # H12


@kernel
def move(
    m: Materials, t: int, last: int, uniforms: FloatArray, with_gradient: bool, mode: int, C3: float, C4: float
) -> None:
    """One iteration's trial of every material; t = 1 .. last. The one statement of the update rule."""
    n_pop, n_dim = m.positions.shape
    TF = math.exp((t - last) / last)  # H8
    d = math.exp((last - t) / last) - t / last  # H9
    collide(m, TF, uniforms, mode)
    early = TF < 0.4 if mode == _CANONICAL else TF <= 0.5
    tau = 1.0 if mode == _INVARIANT else min(C3 * TF, 1.0)
    for i in range(n_pop):
        u = uniforms[i]
        largest = np.abs(m.gradients[i]).max()
        for k in range(n_dim):
            r, r_other, r_flag = u[_EXTRA + 3 * k], u[_EXTRA + 3 * k + 1], u[_EXTRA + 3 * k + 2]
            if mode != _CANONICAL:
                r_other, r_flag = u[3], u[4]
            x = m.positions[i, k]
            if early:
                x_rand = m.positions[int(r_other * n_pop), k]
                x = x + C1 * r * m.acceleration[i, k] * d * (x_rand - x)  # H13
            else:
                F = 1.0 if 2.0 * r_flag - C4 <= 0.5 else -1.0  # H15
                x = m.best[0, k] + F * C2 * r * m.acceleration[i, k] * d * (tau * m.best[0, k] - x)  # H14
            if with_gradient and largest > 0.0:
                x -= m.steps[i] * m.gradients[i, k] / largest
            m.trials[i, k] = min(max(x, m.lower[k]), m.upper[k])


class Aoa(AskTell):
    """Ask/tell AOA. `ask` gives trials (n_pop, n_dim), `tell` takes their costs and, if known, gradients.

    Parameters
    ----------
    mode : Mode         see the module.
    C3, C4 : float      of H14 and H15; each mode's own where not given.
    Others and errors as `AskTell`.
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
        C3: float | None = None,
        C4: float | None = None,
    ) -> None:
        super().__init__(lower, upper, generator, initial, population, budget, step)
        invariant = mode is Mode.SHIFT_INVARIANT
        self.C3 = 1.0 if C3 is None else float(C3)
        self.C4 = (0.5 if invariant else 2.0) if C4 is None else float(C4)
        self._mode = _CODES[mode]
        shape = self.first.shape
        density, volume, r = 1.0 - generator.random((3, *shape))  # H5, in (0, 1]: they are divisors
        self.population = Materials(
            positions=self.first.copy(),
            costs=np.full(population, np.inf),
            gradients=np.zeros(shape),
            trials=self.first.copy(),
            trial_costs=np.full(population, np.inf),
            trial_gradients=np.zeros(shape),
            density=density,
            volume=volume,
            acceleration=0.1 + 0.9 * r if invariant else self.lower + r * (self.upper - self.lower),  # H6
            best=np.array([self.first[0], density[0], volume[0], r[0]]),
            best_cost=np.full(1, np.inf),
            steps=self.steps / 1.2,  # the first evaluation improves on infinity
            lower=self.lower,
            upper=self.upper,
        )

    def ask(self) -> FloatArray:
        """The trials to evaluate (n_pop, n_dim), a copy."""
        return self.population.trials.copy()

    def _move(self, costs: FloatArray, gradients: FloatArray | None) -> None:
        m = self.population
        m.trial_costs[:] = costs
        m.trial_gradients[:] = 0.0 if gradients is None else gradients
        keep(m, self._mode)
        n_pop, n_dim = m.positions.shape
        uniforms = self.generator.random((n_pop, draws(n_dim)))
        move(m, self.iteration + 1, self.iterations, uniforms, gradients is not None, self._mode, self.C3, self.C4)

    @property
    def best(self) -> Best:
        """The best material so far; its cost is inf before the first `tell`."""
        return Best(self.population.best[0].copy(), float(self.population.best_cost[0]))
