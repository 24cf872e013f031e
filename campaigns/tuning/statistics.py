"""Means of flights and what may be said of them: 95 % intervals by Student's t, of seeds that were drawn at random."""

import math
from typing import NamedTuple

import numpy as np
from scipy import stats

from fakevehicle.vocabulary import FloatArray

CONFIDENCE = 0.95


class Interval(NamedTuple):
    """A mean and the half width of its 95 % interval; nan of a single value, inf where a flight was lost."""

    mean: float
    half: float

    def told(self, unit: float, digits: int) -> str:
        """For people, in a unit of which `unit` make one."""
        half = f" ± {unit * self.half:.{digits}f}" if math.isfinite(self.half) else ""
        return f"{unit * self.mean:.{digits}f}{half}"


def mean(values: FloatArray) -> Interval:
    """Of independent values (n,)."""
    n = len(values)
    if n == 0 or not np.isfinite(values).all():
        return Interval(float("inf"), float("inf"))
    if n < 2:
        return Interval(float(values.mean()), float("nan"))
    t = float(stats.t.ppf(0.5 + 0.5 * CONFIDENCE, n - 1))
    return Interval(float(values.mean()), t * float(values.std(ddof=1)) / float(np.sqrt(n)))


def change(values: FloatArray, against: FloatArray) -> Interval:
    """Relative change of a mean, from pairs (n,) flown with the same seeds.

    The ratio r = mean(x)/mean(y) less 1; its variance is that of (x - r y)/mean(y), the linearised ratio of paired
    means (Cochran, Sampling Techniques, 3rd ed. 1977, eq. 6.13 without the finite population's correction).
    """
    below = float(against.mean())
    if not np.isfinite(values).all() or not np.isfinite(against).all():
        return Interval(float("inf"), float("inf"))
    ratio = float(values.mean()) / below
    return Interval(ratio - 1.0, mean((values - ratio * against) / below).half)
