"""Where each mode wants to fly: legs and setpoints, in the estimator's local NED frame.

A `Leg` is a straight line flown with a trapezoidal speed profile, in closed form: at time tau after its start, with
distance d, acceleration a, speeds v0 and v1 at its ends and v = min(v_max, sqrt(a d + (v0^2 + v1^2) / 2)) between,

    s = v0 tau + a tau^2 / 2               while speeding up,      t1 = (v - v0)/a
    s = v tau - (v - v0) t1 / 2            at constant speed,      until t2 = d/v + (v0^2 + v1^2 - 2 v0 v) / (2 a v)
    s = d - v1 rest - a rest^2 / 2         while slowing down,     rest = t2 + (v - v1)/a - tau
"""

import math
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from fakevehicle.vocabulary import FloatArray, Setpoint, unused, unused_attitude

_NO_RATE, _NO_ATTITUDE = unused(), unused_attitude()


@dataclass(frozen=True, slots=True)
class Leg:
    """A straight line, from rest to rest unless it says otherwise.

    Attributes
    ----------
    start_us : when it begins [us].
    start_n, end_n : (3,) local NED [m].
    speed : highest speed [m/s], > 0.
    acceleration : [m/s^2], > 0.
    entry, leave : speeds at the ends [m/s], at most `speed`, and apart by no more than the length allows.
    length : distance between the ends [m].
    top : highest speed that is reached [m/s].
    level_s : when it begins to slow down [s] after its start.
    duration_s : time from end to end [s].
    direction_n : (3,) of unit length, from start to end; zero for a leg of no length.
    """

    start_us: int
    start_n: FloatArray
    end_n: FloatArray
    speed: float
    acceleration: float
    entry: float = 0.0
    leave: float = 0.0

    length: float = field(init=False)
    top: float = field(init=False)
    level_s: float = field(init=False)
    duration_s: float = field(init=False)
    direction_n: FloatArray = field(init=False)

    def __post_init__(self) -> None:
        length = math.dist(self.start_n, self.end_n)
        a, v0, v1 = self.acceleration, self.entry, self.leave
        top = max(min(self.speed, math.sqrt(a * length + 0.5 * (v0 * v0 + v1 * v1))), v0, v1)
        put = partial(object.__setattr__, self)  # once, here: a setpoint is made of them at every tick
        put("length", length)
        put("top", top)
        put("level_s", length / top + (v0 * v0 + v1 * v1 - 2.0 * v0 * top) / (2.0 * a * top) if length else 0.0)
        put("duration_s", self.level_s + (top - v1) / a if length else 0.0)
        put("direction_n", (self.end_n - self.start_n) / length if length else np.zeros(3))

    def setpoint(self, now_us: int, yaw: float) -> Setpoint:
        """Position, velocity and acceleration at `now_us`, at the nearer end outside the leg's time."""
        tau = (now_us - self.start_us) * 1e-6
        if not self.length or (tau >= self.duration_s and not self.leave):
            return still(self.end_n, yaw)
        s, ds, dds = self._along(min(max(tau, 0.0), self.duration_s))
        e = self.direction_n
        return Setpoint(self.start_n + s * e, ds * e, dds * e, yaw, math.nan, _NO_ATTITUDE, _NO_RATE)

    def at(self, now_us: int) -> tuple[float, float, float]:
        """Way from the start [m], speed [m/s] and acceleration along it [m/s^2] at `now_us`."""
        tau = min(max((now_us - self.start_us) * 1e-6, 0.0), self.duration_s)
        return self._along(tau) if self.length else (0.0, 0.0, 0.0)

    def _along(self, tau: float) -> tuple[float, float, float]:
        """Way, speed and acceleration `tau` [s] after the start."""
        a, top = self.acceleration, self.top
        t1 = (top - self.entry) / a
        if tau < t1:
            return self.entry * tau + 0.5 * a * tau * tau, self.entry + a * tau, a
        if tau < self.level_s:
            return top * tau - 0.5 * (top - self.entry) * t1, top, 0.0
        rest = self.duration_s - tau
        return self.length - self.leave * rest - 0.5 * a * rest * rest, self.leave + a * rest, -a


def still(position_n: FloatArray, yaw: float) -> Setpoint:
    """Stay at a point.

    Parameters
    ----------
    position_n : (3,) local NED [m].
    yaw : [rad].
    """
    return Setpoint(position_n=position_n, velocity_n=np.zeros(3), acceleration_n=np.zeros(3), yaw=yaw)


def stopping_point(position_n: FloatArray, velocity_n: FloatArray, acceleration: float) -> FloatArray:
    """Where one comes to rest, slowing down at `acceleration` [m/s^2]: p + v |v| / (2 a), (3,) [m]."""
    return position_n + velocity_n * (math.sqrt(float(velocity_n @ velocity_n)) / (2.0 * acceleration))


def descent(position_n: FloatArray, speed: float, yaw: float) -> Setpoint:
    """Sink at `speed` [m/s] above a point of the ground, (3,) of which only north and east count."""
    return Setpoint(
        position_n=np.array([position_n[0], position_n[1], np.nan]),
        velocity_n=np.array([0.0, 0.0, speed]),
        acceleration_n=np.zeros(3),
        yaw=yaw,
    )


def landing_speed(height: float, land_speed: float, descend_speed: float) -> float:
    """Sink rate at a height above home [m/s]: `descend_speed` above 10 m, `land_speed` below 5 m, linear between.

    PX4 does the same with MPC_LAND_ALT1 and MPC_LAND_ALT2.
    """
    share = min(max((height - 5.0) / 5.0, 0.0), 1.0)
    return land_speed + share * max(descend_speed - land_speed, 0.0)


def return_height(height: float, distance: float, highest: float) -> float:
    """Height above home to fly back at [m]: within a cone of 45 degrees, never lower than now, at most `highest`."""
    return max(height, min(highest, distance))


def completed(asked: Setpoint) -> Setpoint:
    """The setpoint with something to follow on every axis: an axis nobody asked for stands still (velocity zero).

    One of attitude and thrust is complete as it is.
    """
    if not math.isnan(asked.thrust):
        return asked
    nothing = np.isnan(asked.position_n) & np.isnan(asked.velocity_n) & np.isnan(asked.acceleration_n)
    if not nothing.any():
        return asked
    velocity_n = np.where(nothing, 0.0, asked.velocity_n)
    return Setpoint(asked.position_n, velocity_n, asked.acceleration_n, asked.yaw, asked.yaw_rate)


def asks_to_climb(asked: Setpoint, height_n: float) -> bool:
    """Whether a setpoint wants a vehicle that stands at down coordinate `height_n` [m] to leave the ground."""
    if not math.isnan(asked.thrust):
        return asked.thrust > 0.0
    z, vz, az = float(asked.position_n[2]), float(asked.velocity_n[2]), float(asked.acceleration_n[2])
    if not math.isnan(z):
        return z < height_n - LIFT_OFF_MARGIN
    if not math.isnan(vz):
        return vz < -0.05
    return az < -0.05


def asks_to_sink(asked: Setpoint, height_n: float) -> bool:
    """Whether a setpoint wants a vehicle that flies at down coordinate `height_n` [m] to sink for a while yet."""
    z, vz = float(asked.position_n[2]), float(asked.velocity_n[2])
    if not math.isnan(z):
        return z > height_n + SINK_MARGIN
    return vz > SINK_MARGIN


SINK_MARGIN = 0.25
"""A setpoint this far below [m], or a speed of it [m/s], is clearly downwards; the slowest landing is at 0.3 m/s."""
LIFT_OFF_MARGIN = 0.1
"""A position setpoint this far above a standing vehicle [m] means: take off. Less may be the estimate's own noise."""
