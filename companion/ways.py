"""Ways that may be flown next, held against what is seen now: stops, how long one is clear, what joins without a jump.

Nothing is decided here about when; `replanning` asks at its boundaries.
"""

import math

import numpy as np

from companion.guard import clear_for
from companion.motion import JOINT, end_us, joint, state_at
from companion.seam import FloatArray, Flown
from companion.seeing.sight import Sight
from planner import Limits, MovingSphere, Trajectory
from planner.backup import dash

STANDING_US = 1_000_000
"""For so long after its end a way is to be clear as well: the vehicle stands there."""


class Ways:
    """Parameters
    ----------
    sight : what is seen.
    hull : distance to be kept from it, at least [m].

    Attributes
    ----------
    limits : of the leg that is flown.
    worst_joint : the greatest jump of two ways that were joined [m], [m/s], [m/s^2].
    """

    def __init__(self, sight: Sight, hull: float, limits: Limits) -> None:
        self.limits, self.worst_joint = limits, 0.0
        self._sight, self._hull = sight, hull

    def clear(
        self,
        flown: Flown,
        from_us: int,
        until_us: int | None = None,
        radius: float | None = None,
        movers: tuple[MovingSphere, ...] | None = None,
    ) -> float:
        """For how long [s] from a time on a way keeps its distance; inf: to its end, and a while after that."""
        until = max(end_us(flown), from_us) + STANDING_US if until_us is None else until_us
        keep = self._hull if radius is None else radius
        movers = self._sight.tracks.movers() if movers is None else movers
        return clear_for(flown, from_us, until, self._sight.map, movers, keep)

    def passes(self, chosen: Flown, boundary: int, period_us: int) -> bool:
        """Whether an answer may be flown: clear for as long as the next answer and a stop take."""
        limits = self.limits
        ahead_s = 2e-6 * period_us + limits.speed / limits.acceleration + limits.acceleration / limits.jerk
        return self.clear(chosen, boundary, boundary + round(ahead_s * 1e6)) == math.inf

    def joins(self, flown: Flown, successor: Flown) -> bool:
        """Whether a way begins where what is flown is then, as fast, and as it accelerates."""
        if successor is flown:
            return True
        jump = joint(flown, successor)
        if jump <= JOINT:
            self.worst_joint = max(self.worst_joint, jump)
            return True
        return False

    def quickest_stop(self, begin_us: int, flown: Flown) -> Flown | None:
        """The quickest stop, straight on, from what is flown at a time."""
        s = state_at(flown, begin_us)
        return self.stop_from(begin_us, np.array([s.position, s.velocity, s.acceleration]))

    def stop_from(self, begin_us: int, state: FloatArray) -> Flown | None:
        """The quickest stop, straight on, from a state (3, 3); None where it takes too long."""
        limits = self.limits
        points, knots = dash(state, np.zeros(3), 0, np.array([limits.speed, limits.acceleration, limits.jerk]))
        return Flown(Trajectory(points, knots), begin_us, to_goal=False) if len(points) else None

    def stop_after(self, boundary: int, flown: Flown, period_us: int) -> Flown | None:
        """A stop after one more period without an answer, when both that period and the stop are clear."""
        later = boundary + period_us
        stop = self.quickest_stop(later, flown)
        if stop is None or self.clear(flown, boundary, later + period_us) < math.inf:
            return None
        return stop if self.clear(stop, later) == math.inf else None

    def without_answer(self, boundary: int, flown: Flown, backup: Flown | None, least: Flown | None) -> Flown:
        """What to fly where nothing is proved: a stop that is clear (the one kept ready, the quickest, the planner's).

        Where none is, and at rest, it is the planner's least bad, which keeps farthest from what moves, if what stands
        is not in its way; else what is clear longest.
        """
        lasts = self.clear(flown, boundary)
        if not flown.to_goal and least is not None and self.joins(flown, least):
            passes = self.clear(least, boundary, movers=()) == math.inf
            if passes and self.clear(least, boundary) >= lasts:
                return least
        if not flown.to_goal and lasts == math.inf:
            return flown
        ways = (backup, self.quickest_stop(boundary, flown), least)
        found = [stop for stop in ways if stop is not None and self.joins(flown, stop)]
        if not found:
            return flown
        stop = max(found, key=lambda stop: self.clear(stop, boundary))
        passes = least in found and self.clear(least, boundary, movers=()) == math.inf
        if passes and least is not None and self.clear(stop, boundary) < math.inf:
            return least
        return flown if self.clear(stop, boundary) <= lasts and not flown.to_goal else stop
