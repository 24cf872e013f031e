"""Legs, walked one after the other by a clock of their own."""

import math
from dataclasses import dataclass, field

import numpy as np

from companion.legs import Leg, Path
from companion.pace import RAMPS_US, Pace, go_us, stop_us
from companion.profile import MotionState, Turn
from planner import Limits

ZERO = np.zeros(3)
PATIENCE_US = 500_000


@dataclass(slots=True)
class Walk:
    """Legs, walked one after the other by a clock of their own."""

    legs: list[Leg]
    index: int = 0
    pace: Pace = field(default_factory=Pace)
    entered_us: int | None = None  # on the path's clock
    turn: Turn | None = None  # of a yaw step
    released: bool = False  # the wait is over
    patient_us: int | None = None  # since when it waits for a moment at which its pace can change within the limits
    open_ended: bool = False  # what is flown leads to a stop, not to the leg's end

    @property
    def leg(self) -> Leg:
        return self.legs[self.index]

    def seconds(self, now_us: int) -> float:
        """How long it is in its leg [s]."""
        return 0.0 if self.entered_us is None else (self.pace.at(now_us).us - self.entered_us) / 1e6

    def change_pace(self, now_us: int, limits: Limits) -> None:
        """Begin to stop if it runs, to run if it stands: at once, or within `PATIENCE_US` where the path is gentler."""
        stops = self.pace.running(now_us)
        ramp = (stop_us if stops else go_us)(self.motion, self.seconds(now_us), limits)
        self.patient_us = now_us if self.patient_us is None else self.patient_us
        if not ramp and now_us - self.patient_us < PATIENCE_US:
            return
        self.patient_us = None
        (self.pace.stop if stops else self.pace.go)(now_us, ramp or RAMPS_US[-1])

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
