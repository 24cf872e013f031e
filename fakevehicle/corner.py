"""Places that are passed without a stop: two legs joined by a parabola.

The corner at b between the directions u (in) and w (out), unit vectors, begins d before b and ends d after it, and is
flown with the constant acceleration that turns v u into v w:

    T = 2 d / v,      a = v (w - u) / T = v^2 (w - u) / (2 d),      p(t) = b - d u + v u t + a t^2 / 2

so that p(T) = b + d w, and neither place nor velocity jumps. Its middle is its nearest point to b,
p(T/2) - b = d (w - u) / 4, and the speed in it is never above v. With the bend k = |w - u| and the radius r that may be
cut, d <= 4 r / k; with the acceleration A that there is, v^2 <= 2 d A / k.

What comes after the next place is not looked at: v is never more than what can be brought to rest there. So whatever is
decided later, the way that is flown can end at the end that has been told.
"""

import math
from dataclasses import dataclass

from fakevehicle.guidance import Leg
from fakevehicle.vocabulary import FloatArray, Setpoint

SLOWEST_PASS = 0.2
"""A corner that has to be flown slower than this [m/s] is not worth it: better stop."""


@dataclass(frozen=True, slots=True)
class Corner:
    """One turn at constant acceleration.

    Attributes
    ----------
    start_us : when it begins [us].
    start_n : (3,) where [m].
    velocity_n : (3,) there [m/s].
    acceleration_n : (3,) [m/s^2].
    duration_s : [s].
    middle_us, end_us : when it is nearest to the place it goes round, and when it ends [us].
    """

    start_us: int
    start_n: FloatArray
    velocity_n: FloatArray
    acceleration_n: FloatArray
    duration_s: float

    @property
    def middle_us(self) -> int:
        """When it is nearest to the place it goes round [us]."""
        return self.start_us + round(0.5e6 * self.duration_s)

    @property
    def end_us(self) -> int:
        """When it ends [us]."""
        return self.start_us + round(1e6 * self.duration_s)

    def setpoint(self, now_us: int, yaw: float) -> Setpoint:
        """Position, velocity and acceleration at `now_us`, within its time."""
        tau = min(max((now_us - self.start_us) * 1e-6, 0.0), self.duration_s)
        v, a = self.velocity_n, self.acceleration_n
        return Setpoint(self.start_n + tau * v + (0.5 * tau * tau) * a, v + tau * a, a, yaw)


def rounded(
    leg: Leg, now_us: int, next_n: FloatArray, speed: float, cut: float
) -> tuple[tuple[Leg, Corner, Leg], Corner] | None:
    """The way on from a leg that was to end at rest: round its end, and to rest at `next_n`.

    Parameters
    ----------
    leg : under way or still to come; its part before `now_us` stays as it is.
    next_n : (3,) [m].
    speed : highest on the way there [m/s].
    cut : how far from the leg's end the corner may pass [m].

    Returns
    -------
    The three pieces and the corner among them; None when there is no room for it.
    """
    acceleration, end_n = leg.acceleration, leg.end_n
    done, entry, _ = leg.at(now_us)
    left, ahead = leg.length - done, math.dist(end_n, next_n)
    if left <= 0.0 or ahead <= 0.0:
        return None
    u, w = leg.direction_n, (next_n - end_n) / ahead
    bend = math.dist(u, w)
    v = min(leg.speed, speed, math.sqrt(acceleration * ahead), math.sqrt(entry * entry + acceleration * left))
    room = min(0.5 * left, 0.5 * ahead)
    if bend > 0.0:
        room = min(room, 4.0 * cut / bend)
    d = 0.5 * v * v * bend / acceleration
    if d > room:
        d, v = room, math.sqrt(2.0 * room * acceleration / bend)
    if v < SLOWEST_PASS or entry * entry > v * v + 2.0 * acceleration * (left - d):
        return None
    begin_us = max(now_us, leg.start_us)
    first = Leg(begin_us, leg.start_n + done * u, end_n - d * u, leg.speed, acceleration, entry, v)
    lasts_s = 2.0 * d / v
    turn = (w - u) * (v / lasts_s) if lasts_s > 0.0 else 0.0 * u
    corner = Corner(begin_us + round(1e6 * first.duration_s), end_n - d * u, v * u, turn, lasts_s)
    return (first, corner, Leg(corner.end_us, end_n + d * w, next_n, speed, acceleration, v)), corner
