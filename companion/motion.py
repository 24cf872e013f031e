"""Trajectories on the flight clock: where they are at a time, when they end, and whether one takes over without a jump.

Times are integers [us]. A trajectory stands before its start and after its end.
"""

import numpy as np

from companion.seam import Flown
from planner.trajectory import State

JOINT = 1e-6
"""What a switch may jump by [m], [m/s], [m/s^2]: rounding, no more."""


def state_at(flown: Flown, flight_us: int) -> State:
    """Where it is at a time."""
    return flown.trajectory.state((flight_us - flown.start_us) / 1e6)


def end_us(flown: Flown) -> int:
    """When it is over."""
    return flown.start_us + round(flown.trajectory.duration * 1e6)


def joint(flown: Flown, successor: Flown) -> float:
    """The greatest jump in position, velocity or acceleration when the successor takes over at its start."""
    here, there = state_at(flown, successor.start_us), successor.trajectory.state(0.0)
    return max(
        float(np.abs(there.position - here.position).max()),
        float(np.abs(there.velocity - here.velocity).max()),
        float(np.abs(there.acceleration - here.acceleration).max()),
    )
