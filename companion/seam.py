"""What crosses the seam of `Companion.step`: its inputs and outputs.

In:  `Datagram | PlanReady | OperatorCommand`.  Out: `Datagram | PlanWanted | Reference | Note`.
Slow work is an output and an input: `PlanWanted` leaves, a driver plans wherever it likes, `PlanReady` comes back and
is recorded, so that a re-run feeds the recorded plan and never plans again.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from planner import Limits, Trajectory
from wire.datagram import Datagram

FloatArray = NDArray[np.float64]
Vector = tuple[float, float, float]


class Level(Enum):
    """How much a note matters; the values are MAV_SEVERITY's."""

    ERROR = 3
    WARNING = 4
    INFO = 6


@dataclass(frozen=True, slots=True)
class PlanWanted:
    """Please plan this, in the mission frame (NED, [m])."""

    request_id: int
    start_m: Vector
    goal_m: Vector
    limits: Limits
    radius: float  # [m] the curve keeps this far from every obstacle
    seed: int
    method: str


@dataclass(frozen=True, slots=True)
class PlanReady:
    """The answer to one `PlanWanted`: a trajectory, or the reason why there is none."""

    request_id: int
    trajectory: Trajectory | None
    error: str = ""  # name of the planner's error type
    text: str = ""  # what it said
    length: float = float("nan")  # [m]
    clearance: float = float("nan")  # [m] proved, beyond the radius
    certified: bool = False
    cpu_ms: float = float("nan")
    method: str = ""


class OperatorCommand(Enum):
    """What the person at the keyboard asks for."""

    LAND = "land"


@dataclass(frozen=True, slots=True)
class Reference:
    """Where the vehicle should be now: what the setpoint of this tick was made from, in the mission frame."""

    position_m: FloatArray  # (3,) [m]
    velocity_m: FloatArray  # (3,) [m/s]
    acceleration_m: FloatArray  # (3,) [m/s^2]
    yaw: float  # [rad]


@dataclass(frozen=True, slots=True)
class Note:
    """Something worth telling a person and keeping in the recording."""

    level: Level
    text: str


Input = Datagram | PlanReady | OperatorCommand
Output = Datagram | PlanWanted | Reference | Note
