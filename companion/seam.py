"""What crosses the seam of `Companion.step`: its inputs and outputs.

In:  `Datagram | PlanReady | ReplanReady | Order`.  Out: `Datagram | PlanWanted | ReplanWanted | Reference | Note`.
Slow work is an output and an input: `PlanWanted` leaves, a driver plans wherever it likes, `PlanReady` comes back and
is recorded, so that a re-run feeds the recorded plan and never plans again. `ReplanWanted` and `ReplanReady` are the
same for a flight under way: the question names the moment from which its answer will be flown, so that what planning
takes is part of the plan.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from planner import Limits, MovingSphere, Trajectory
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
    via_m: tuple[Vector, ...] = ()  # points on the way


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


@dataclass(frozen=True, slots=True)
class Flown:
    """A trajectory and when it begins, in the mission frame."""

    trajectory: Trajectory
    start_us: int  # on the flight clock [us]
    to_goal: bool = True  # else to a stop


@dataclass(frozen=True, slots=True)
class MapView:
    """The cells that are taken, as upright runs; what is known beforehand is not among them."""

    origin: Vector  # corner of cell (0, 0, 0) [m]
    resolution: float  # edge of a cell [m]
    runs: NDArray[np.int16]  # (n, 4) i, j, first k, one past the last k
    version: int  # counts changes


@dataclass(frozen=True, slots=True)
class ReplanWanted:
    """Please look at what is flown again, in the mission frame; times are the flight clock's."""

    request_id: int
    now_us: int
    switch_us: int  # the answer is flown from then on
    period_us: int  # the next question's switch comes so much later; the answer's backup begins there
    goal_m: Vector
    limits: Limits
    radius: float  # [m] kept from every obstacle and mover
    seed: int
    flown: Flown
    fresh: bool  # begin anew with `flown`; else it is what the answer before said
    map: MapView | None  # None: as in the question before
    movers: tuple[MovingSphere, ...]  # stamps in seconds of the flight clock
    cold: bool = False  # a plan from scratch, from where `flown` is at `switch_us`; the question stands by itself


@dataclass(frozen=True, slots=True)
class ReplanReady:
    """What to fly from the question's `switch_us` on."""

    request_id: int
    kind: str  # keep, switch, backup or none, as `planner.replan.Kind`; failed: no answer, `reason` says why
    flown: Flown | None  # None: what was flown, and when there is no answer
    certified: bool
    clearance: float  # to the nearest mover, less the radius [m]; inf without any
    backup: Flown | None  # a proved stop from the next question's switch on
    reason: str
    cpu_ms: float = float("nan")


@dataclass(frozen=True, slots=True)
class Order:
    """What a person asks for: at the keyboard, or from a ground station.

    Names are land, hold, resume, return, abort, start and goto, which alone has values: north, east, altitude [m] in
    the mission frame.
    """

    name: str
    values: tuple[float, ...] = ()
    source: str = ""  # who, for people


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


Input = Datagram | PlanReady | ReplanReady | Order
Output = Datagram | PlanWanted | ReplanWanted | Reference | Note
