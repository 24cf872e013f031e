"""Legs, walked one after the other by a clock of their own."""

import math
from dataclasses import dataclass, field

import numpy as np

from companion.legs import Leg, Path
from companion.pace import Pace
from companion.profile import MotionState, Turn

ZERO = np.zeros(3)


@dataclass(slots=True)
class Walk:
    """Legs, walked one after the other by a clock of their own."""

    legs: list[Leg]
    index: int = 0
    pace: Pace = field(default_factory=Pace)
    entered_us: int | None = None  # on the path's clock
    turn: Turn | None = None  # of a yaw step
    released: bool = False  # the wait is over
    open_ended: bool = False  # what is flown leads to a stop, not to the leg's end

    @property
    def leg(self) -> Leg:
        return self.legs[self.index]

    def seconds(self, now_us: int) -> float:
        """How long it is in its leg [s]."""
        return 0.0 if self.entered_us is None else (self.pace.at(now_us).us - self.entered_us) / 1e6

    def duration(self) -> float:
        """Of the leg [s]."""
        moving = sum(float(path.duration) for path in self.leg.paths) + (self.turn.duration if self.turn else 0.0)
        if self.open_ended:
            return math.inf
        return moving + (0.0 if self.released else self.leg.seconds)

    def motion(self, t: float) -> MotionState:
        """Where the leg is at its time t [s]."""
        for path in self.leg.paths[:-1]:
            if t < path.duration:
                return _state(path, t)
            t -= path.duration
        return _state(self.leg.paths[-1], t) if self.leg.paths else MotionState(self.leg.end, ZERO, ZERO)


def _state(path: Path, t: float) -> MotionState:
    state = path.state(t)
    return MotionState(state.position, state.velocity, state.acceleration)
