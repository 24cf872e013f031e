"""The clock a path is walked by: it can be slowed to a stop and let run again, and nothing of that is a jump.

With the path's own time s(t) a curve p(s) is flown as p(s(t)); position stays on the proved curve whatever s does, and

    v = p' ds,    a = p'' ds^2 + p' dds        (chain rule; ds = ds/dt)

A ramp lasts T and takes ds from one to zero (or back) along 3 u^2 - 2 u^3, u = t/T, so ds and dds are continuous, and
it costs T/2 of path time: at 3 m/s and T = 1 s the vehicle stops within 1.5 m.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

import numpy as np

from companion.profile import MotionState
from planner import Limits

RAMPS_US = (300_000, 500_000, 700_000, 850_000, 1_000_000, 1_200_000, 1_500_000, 2_000_000, 3_000_000)
"""Durations of a ramp that are tried, shortest first; even numbers, so that half of one is whole."""
EXCESS, JERK_EXCESS = 1.05, 1.5
"""Where the path itself does what it may, a ramp on top asks for so many times the acceleration and the jerk."""
LOOKS = 60
"""Points of a ramp at which its acceleration is looked at."""


class _Kind(Enum):
    RUNNING = "running"
    STOPPING = "stopping"
    STARTING = "starting"


class PathTime(NamedTuple):
    """Where on the path's clock it is, and how fast that runs."""

    us: float  # [us]
    rate: float  # ds/dt, 0 to 1
    change: float  # d2s/dt2 [1/s]


@dataclass(slots=True)
class Pace:
    """From the flight's clock to the path's. Runs as one with it until `stop` is called."""

    _kind: _Kind = _Kind.RUNNING
    _since_us: int = 0
    _path_us: int = 0  # the path's time at `_since_us`
    _ramp_us: int = 0

    def at(self, now_us: int) -> PathTime:
        t = now_us - self._since_us
        if self._kind is _Kind.RUNNING:
            return PathTime(self._path_us + t, 1.0, 0.0)
        T = self._ramp_us
        if t >= T:
            over = t - T if self._kind is _Kind.STARTING else 0
            return PathTime(self._path_us + T // 2 + over, float(self._kind is _Kind.STARTING), 0.0)
        u = t / T
        gone = u**3 * (1.0 - 0.5 * u)  # integral of 3 u^2 - 2 u^3
        rate, change = u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / (T * 1e-6)
        if self._kind is _Kind.STARTING:
            return PathTime(self._path_us + T * gone, rate, change)
        return PathTime(self._path_us + T * (u - gone), 1.0 - rate, -change)

    def running(self, now_us: int) -> bool:
        """Whether path and flight go at one pace."""
        return self._kind is not _Kind.STOPPING and now_us - self._since_us >= self._ramp_us

    def still(self, now_us: int) -> bool:
        """Whether the path's clock stands."""
        return self._kind is _Kind.STOPPING and now_us - self._since_us >= self._ramp_us

    def stop(self, now_us: int, ramp_us: int) -> None:
        """Begin to slow down; only while `running`."""
        self._change(now_us, _Kind.STOPPING, ramp_us)

    def go(self, now_us: int, ramp_us: int) -> None:
        """Begin to run again; only while `still`."""
        self._change(now_us, _Kind.STARTING, ramp_us)

    def _change(self, now_us: int, kind: _Kind, ramp_us: int) -> None:
        self._path_us = round(self.at(now_us).us)
        self._kind, self._since_us, self._ramp_us = kind, now_us, ramp_us


def paced(state: MotionState, time: PathTime) -> MotionState:
    """The motion over the flight's time of a `state` over the path's."""
    if time.rate == 1.0 and time.change == 0.0:
        return state
    acceleration = time.rate**2 * state.acceleration + time.change * state.velocity
    return MotionState(state.position, time.rate * state.velocity, acceleration)


def stop_us(motion: Callable[[float], MotionState], path_s: float, limits: Limits) -> int:
    """The shortest ramp [us] to a stop, from `path_s` on a path, within the limits; 0: none is at this moment."""
    return _ramp(motion, path_s, limits, Pace.stop)


def go_us(motion: Callable[[float], MotionState], path_s: float, limits: Limits) -> int:
    """The shortest ramp [us] from a stop at `path_s`; as `stop_us`."""
    return _ramp(motion, path_s, limits, Pace.go)


def _ramp(
    motion: Callable[[float], MotionState], path_s: float, limits: Limits, how: Callable[[Pace, int, int], None]
) -> int:
    for ramp_us in RAMPS_US:
        pace = Pace()
        how(pace, 0, ramp_us)
        times = [pace.at(k * ramp_us // LOOKS) for k in range(LOOKS + 1)]
        hard = np.array([paced(motion(path_s + time.us * 1e-6), time).acceleration for time in times])
        rough = np.diff(hard, axis=0) / (ramp_us * 1e-6 / LOOKS)
        within = float(np.linalg.norm(hard, axis=1).max()) <= EXCESS * limits.acceleration
        if within and float(np.linalg.norm(rough, axis=1).max()) <= JERK_EXCESS * limits.jerk:
            return ramp_us
    return 0
