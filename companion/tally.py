"""What is kept of a flight of any length: rows in a buffer, and what was counted of those that left it.

A flight of minutes is kept whole and measured exactly. Of a longer one the oldest rows are counted into a `Tally` and
dropped, so that hours need no more memory than minutes. What is counted exactly then: how many, the sum, the greatest.
A percentile is read from classes of equal width, and is off by no more than one of them.
"""

import math
from array import array

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


class Rows:
    """Rows of equal width, appended at the end and dropped at the beginning.

    Parameters
    ----------
    width : numbers a row, as float64: 2^53 us after 1970 is the year 2255.
    """

    def __init__(self, width: int) -> None:
        self._width, self._data = width, array("d")

    def __len__(self) -> int:
        return len(self._data) // self._width

    def append(self, row: tuple[float, ...]) -> None:
        """One more row."""
        self._data.extend(row)

    def last(self, count: int = 1) -> FloatArray:
        """(count or fewer, width) the newest rows."""
        return np.array(self._data[-count * self._width :]).reshape(-1, self._width)

    def all(self) -> FloatArray:
        """(n, width) every row, a copy."""
        return np.array(self._data).reshape(-1, self._width)

    def take(self, count: int) -> FloatArray:
        """(count, width) the oldest rows, which are dropped."""
        taken = np.array(self._data[: count * self._width]).reshape(-1, self._width)
        del self._data[: count * self._width]
        return taken


class Tally:
    """Counts values; what is less than 0 is in the first class.

    Parameters
    ----------
    width : of a class, in the values' unit.
    classes : so many; what is greater than all of them is in the last one.
    """

    def __init__(self, width: float, classes: int) -> None:
        self._width = width
        self._counts = np.zeros(classes, dtype=np.int64)
        self.count, self.total, self.greatest = 0, 0.0, -math.inf

    def add(self, values: FloatArray) -> None:
        """Count some values."""
        if len(values):
            self.count += len(values)
            self.total += float(values.sum())
            self.greatest = max(self.greatest, float(values.max()))
            self._counts += self._classed(values)

    def percentiles(self, wanted: list[float], kept: FloatArray) -> list[float]:
        """Of what was counted and of `kept` beside it: exact while nothing was counted, else to a class's width.

        A value in the last class, which is open, is told as the greatest that was counted.
        """
        if not self.count:
            return [float(x) for x in np.percentile(kept, wanted)]
        counts = np.cumsum(self._counts + self._classed(kept))
        greatest, found = max(self.greatest, float(kept.max()) if len(kept) else -math.inf), []
        for percent in wanted:
            rank = percent / 100 * (counts[-1] - 1) + 1  # of the value, counted from 1, as NumPy's linear method has it
            k = int(np.searchsorted(counts, rank))
            middle = (k + 0.5) * self._width if k < len(counts) - 1 else math.inf
            found.append(min(middle, greatest))
        return found

    def _classed(self, values: FloatArray) -> NDArray[np.int64]:
        index = np.clip(values / self._width, 0, len(self._counts) - 1).astype(np.int64)
        counted: NDArray[np.int64] = np.bincount(index, minlength=len(self._counts)).astype(np.int64)
        return counted


class PathLength:
    """Length [m] of the path through places, thinned to steps of 0.1 m so that noise does not add to it."""

    STEP = 0.1

    def __init__(self) -> None:
        self._total = 0.0
        self._here: FloatArray | None = None
        self._last: FloatArray | None = None

    def copy(self) -> "PathLength":
        """Another that goes on from here."""
        other = PathLength()
        other._total, other._here, other._last = self._total, self._here, self._last
        return other

    def add(self, position_m: FloatArray) -> None:
        """Go on through (n, 3) places."""
        here = position_m[0] if self._here is None else self._here
        for there in position_m:
            step = float(np.linalg.norm(there - here))
            if step >= self.STEP:
                self._total, here = self._total + step, there
        self._here, self._last = here, position_m[-1]

    def length(self) -> float:
        """To the last place."""
        if self._here is None or self._last is None:
            return 0.0
        return self._total + float(np.linalg.norm(self._last - self._here))
