"""Nine functions with known minima on which optimisers are measured, plain and with the minimum moved.

They are the nine of the paper's Table 1, in its order. Where the paper's names leave a choice: a domain of [-5, 5] in
each coordinate, or the function's usual one. Every minimum is a closed form, but Michalewicz's, which is a sum of
one-dimensional minima and is computed here from them (d = 2: -1.801303, 5: -4.687658, 10: -9.660152).

A moved copy keeps its domain and takes f(x - o), with o = +-0.137 widths of the domain, the sign alternating from one
coordinate to the next (so +-1.37 on [-5, 5]). An optimiser that is drawn to the origin, or to the middle of the domain,
loses there what it won on the plain function. No copy has a lower minimum than the plain function: of eight functions
the minimum is global, and Michalewicz's terms are not negative in (-pi, 0) or (pi, 2 pi).

Points are rows: a function takes (n, d) and returns (n,), dimensionless.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

SHIFT = 0.137
"""How far a moved copy's minimum is moved, in widths of the domain."""
_ANY = (2, 10, 30)
_MICHALEWICZ_POWER = 20  # 2 m with the usual m = 10


@dataclass(frozen=True, slots=True)
class Benchmark:
    """A function, its domain, where it is least and how little it is there."""

    name: str
    function: Callable[[FloatArray], FloatArray]  # (n, d) to (n,)
    lower: float  # the same in each coordinate
    upper: float
    dimensions: tuple[int, ...]  # those it is measured in
    minimisers: Callable[[int], FloatArray]  # d to (k, d), all of them in the domain
    minimum: Callable[[int], float]  # d to f*
    shift: float = 0.0  # in widths of the domain

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values (n,) at the rows of x (n, d)."""
        return self.function(np.atleast_2d(x) - self.offset(np.shape(x)[-1]))

    def offset(self, dimension: int) -> FloatArray:
        """o (d,), by how much the minimum is moved."""
        signs = np.where(np.arange(dimension) % 2 == 0, 1.0, -1.0)
        return np.asarray(self.shift * (self.upper - self.lower) * signs, dtype=np.float64)

    def bounds(self, dimension: int) -> list[tuple[float, float]]:
        """The domain, as `minimize` takes it."""
        return [(self.lower, self.upper)] * dimension

    def best_points(self, dimension: int) -> FloatArray:
        """The minimisers that lie in the domain, moved with the function (k, d)."""
        points = self.minimisers(dimension) + self.offset(dimension)
        inside: FloatArray = points[((points >= self.lower) & (points <= self.upper)).all(axis=1)]
        return inside

    def shifted(self, shift: float = SHIFT) -> "Benchmark":
        """The copy with the minimum moved by `shift` widths of the domain."""
        return Benchmark(
            self.name, self.function, self.lower, self.upper, self.dimensions, self.minimisers, self.minimum, shift
        )


def sphere(x: FloatArray) -> FloatArray:
    """sum x_i^2."""
    return np.asarray((x**2).sum(axis=1))


def rosenbrock(x: FloatArray) -> FloatArray:
    """sum 100 (x_{i+1} - x_i^2)^2 + (1 - x_i)^2 (Rosenbrock 1960)."""
    a, b = x[:, :-1], x[:, 1:]
    return np.asarray((100.0 * (b - a**2) ** 2 + (1.0 - a) ** 2).sum(axis=1))


def rastrigin(x: FloatArray) -> FloatArray:
    """10 d + sum x_i^2 - 10 cos(2 pi x_i), as sum x_i^2 + 20 sin^2(pi x_i), which is exact near the minimum."""
    return np.asarray((x**2 + 20.0 * np.sin(np.pi * x) ** 2).sum(axis=1))


def griewank(x: FloatArray) -> FloatArray:
    """1 + sum x_i^2/4000 - prod cos(x_i/sqrt(i)) (Griewank 1981)."""
    i = np.arange(1, x.shape[1] + 1)
    return np.asarray(1.0 + (x**2).sum(axis=1) / 4000.0 - np.cos(x / np.sqrt(i)).prod(axis=1))


def ackley(x: FloatArray) -> FloatArray:
    """-20 exp(-0.2 rms x) - exp(mean cos(2 pi x_i)) + 20 + e (Ackley 1987).

    Added up in this order the function cannot fall below 4.4e-16 in binary64; the same in `expm1` can.
    """
    slope = -20.0 * np.expm1(-0.2 * np.sqrt((x**2).mean(axis=1)))
    wave = -np.e * np.expm1(-2.0 * (np.sin(np.pi * x) ** 2).mean(axis=1))
    return np.asarray(slope + wave)


def michalewicz(x: FloatArray) -> FloatArray:
    """-sum sin(x_i) sin^20(i x_i^2/pi) (Michalewicz 1992); never above 0 on [0, pi]^d."""
    i = np.arange(1, x.shape[1] + 1)
    return np.asarray(-(np.sin(x) * np.sin(i * x**2 / np.pi) ** _MICHALEWICZ_POWER).sum(axis=1))


def himmelblau(x: FloatArray) -> FloatArray:
    """(x^2 + y - 11)^2 + (x + y^2 - 7)^2 (Himmelblau 1972): four minima of 0."""
    return np.asarray((x[:, 0] ** 2 + x[:, 1] - 11.0) ** 2 + (x[:, 0] + x[:, 1] ** 2 - 7.0) ** 2)


def booth(x: FloatArray) -> FloatArray:
    """(x + 2 y - 7)^2 + (2 x + y - 5)^2."""
    return np.asarray((x[:, 0] + 2.0 * x[:, 1] - 7.0) ** 2 + (2.0 * x[:, 0] + x[:, 1] - 5.0) ** 2)


def beale(x: FloatArray) -> FloatArray:
    """(1.5 - x + x y)^2 + (2.25 - x + x y^2)^2 + (2.625 - x + x y^3)^2 (Beale 1958)."""
    a, b = x[:, 0], x[:, 1]
    return np.asarray(
        (1.5 - a + a * b) ** 2 + (2.25 - a + a * b**2) ** 2 + (2.625 - a + a * b**3) ** 2,
    )


def _michalewicz_point(dimension: int) -> FloatArray:
    """The minimiser (1, d): coordinate i is the least of its own term, found on a grid and then by halving it."""
    i = np.arange(1, dimension + 1)
    point = np.zeros(dimension)
    centre, width = np.full(dimension, np.pi / 2), np.full(dimension, np.pi / 2)
    steps = np.linspace(-1.0, 1.0, 40_001)[:, None]
    while width[0] > 1e-12:
        x = np.clip(centre + steps * width, 0.0, np.pi)
        term = -np.sin(x) * np.sin(i * x**2 / np.pi) ** _MICHALEWICZ_POWER
        point = x[term.argmin(axis=0), np.arange(dimension)]
        centre, width = point, width / 1000.0
        steps = np.linspace(-1.0, 1.0, 2_001)[:, None]
    return point[None, :]


def _himmelblau_points(_: int) -> FloatArray:
    """(3, 2), and the other three as roots: x = 7 - y^2 put into x^2 + y = 11 leaves y^4 - 14 y^2 + y + 38 = 0."""
    y = np.sort(np.roots([1.0, 0.0, -14.0, 1.0, 38.0]).real)
    for _ in range(3):  # Newton, to the last digit
        y -= (y**4 - 14.0 * y**2 + y + 38.0) / (4.0 * y**3 - 28.0 * y + 1.0)
    return np.stack([7.0 - y**2, y], axis=1)


def _zeros(dimension: int) -> FloatArray:
    return np.zeros((1, dimension))


def _zero(_: int) -> float:
    return 0.0


BENCHMARKS: tuple[Benchmark, ...] = (
    Benchmark("sphere", sphere, -5.0, 5.0, _ANY, _zeros, _zero),
    Benchmark("rosenbrock", rosenbrock, -5.0, 5.0, _ANY, lambda d: np.ones((1, d)), _zero),
    Benchmark("rastrigin", rastrigin, -5.0, 5.0, _ANY, _zeros, _zero),
    Benchmark("griewank", griewank, -600.0, 600.0, _ANY, _zeros, _zero),
    Benchmark("ackley", ackley, -32.0, 32.0, _ANY, _zeros, _zero),
    Benchmark(
        "michalewicz",
        michalewicz,
        0.0,
        float(np.pi),
        _ANY,
        _michalewicz_point,
        lambda d: float(michalewicz(_michalewicz_point(d))[0]),
    ),
    Benchmark("himmelblau", himmelblau, -5.0, 5.0, (2,), _himmelblau_points, _zero),
    Benchmark("booth", booth, -5.0, 5.0, (2,), lambda _: np.array([[1.0, 3.0]]), _zero),
    Benchmark("beale", beale, -4.5, 4.5, (2,), lambda _: np.array([[3.0, 0.5]]), _zero),
)
"""f1 to f9 of the paper, in its order."""
