"""What does not stand still: balls that fly about, and solids that are suddenly there.

Frame: truth's n, local NED from home. A ball keeps its course until it meets a wall of the block it is in, and is
reflected there; solids and vehicles do not stop it. Where it is at a time has a closed form, so that nothing is stepped
and every sensor sees the same: an axis's way u = p - low + v t, folded at the walls, is a triangle wave of period
2 (high - low).
"""

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from fakevehicle.vocabulary import FloatArray

if TYPE_CHECKING:
    from fakevehicle.sensors.obstacles import World

MOST = 1000
"""Balls, and pop-ups, of one world."""


def _nowhere() -> FloatArray:
    return np.full(3, np.inf)


@dataclass(frozen=True, slots=True)
class Movers:
    """Balls with a course each [m, m/s].

    Attributes
    ----------
    balls : (n, 7) centre at now_us = 0, velocity, radius.
    low_n, high_n : (3,) corners of the block whose walls reflect them; infinite: there are none.

    Raises
    ------
    ValueError : a shape is wrong, a number is not finite, there are too many, or a ball begins outside its block.
    """

    balls: FloatArray
    low_n: FloatArray = field(default_factory=lambda: -_nowhere())
    high_n: FloatArray = field(default_factory=_nowhere)

    def __post_init__(self) -> None:
        balls = np.array(self.balls, dtype=float)
        if balls.ndim != 2 or balls.shape[1] != 7 or not np.isfinite(balls).all() or len(balls) > MOST:
            raise ValueError(f"movers of shape {balls.shape}: expected (n, 7) finite numbers, n at most {MOST}")
        if (balls[:, 6] <= 0.0).any():
            raise ValueError("movers: a radius is not above 0")
        low, high = np.array(self.low_n, dtype=float), np.array(self.high_n, dtype=float)
        if low.shape != (3,) or high.shape != (3,) or np.isnan([low, high]).any():
            raise ValueError("movers: expected three numbers for each corner of the block")
        radius = balls[:, 6:7]
        outside = (balls[:, :3] < low + radius) | (balls[:, :3] > high - radius)
        if outside.any():
            raise ValueError(f"mover {int(np.flatnonzero(outside.any(axis=1))[0])} begins outside its block")
        for name, value in (("balls", balls), ("low_n", low), ("high_n", high)):
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.balls)

    def at(self, now_us: int) -> tuple[FloatArray, FloatArray]:
        """Centres and velocities, (n, 3) each."""
        start, course, radius = self.balls[:, :3], self.balls[:, 3:6], self.balls[:, 6:7]
        gone = start + course * (now_us * 1e-6)
        low, span = self.low_n + radius, self.high_n - self.low_n - 2.0 * radius
        folding = np.isfinite(span) & (span > 0.0)
        lower, width = np.where(folding, low, 0.0), np.where(folding, span, 1.0)
        way = np.mod(gone - lower, 2.0 * width)
        forth = way <= width
        place = np.where(folding, lower + np.where(forth, way, 2.0 * width - way), gone)
        return place, np.where(folding & ~forth, -course, course)

    def spheres(self, now_us: int) -> FloatArray:
        """(n, 4) centres and radii, as `World` has them."""
        return np.hstack([self.at(now_us)[0], self.balls[:, 6:7]])


@dataclass(frozen=True, slots=True)
class PopUp:
    """Solids that are not there at first, and stay once they are.

    Attributes
    ----------
    solids : what appears.
    at_us : when [us]; None: no time makes it appear.
    within : when the vehicle is so near to one of them [m]; None: no nearness does.

    Raises
    ------
    ValueError : neither is given, or one cannot be.
    """

    solids: "World"
    at_us: int | None = None
    within: float | None = None

    def __post_init__(self) -> None:
        if (self.at_us is None) == (self.within is None):
            raise ValueError("a pop-up needs either a time or a nearness")
        if self.at_us is not None and self.at_us < 0:
            raise ValueError(f"pop-up at {self.at_us * 1e-6:g} s, expected 0 or more")
        if self.within is not None and not 0.0 < self.within < math.inf:
            raise ValueError(f"pop-up within {self.within:g} m, expected more than 0")
        if self.solids.popups or self.solids.movers is not None:
            raise ValueError("a pop-up is of solids that stand still and are there at once")

    def appears(self, now_us: int, position_n: FloatArray) -> bool:
        """Whether it is there from now on, with the vehicle at a point."""
        if self.at_us is not None:
            return now_us >= self.at_us
        assert self.within is not None
        return self.solids.gap(position_n) <= self.within
