"""A rangefinder that looks down along z_b: the ground, and what stands on it.

Above level ground at height h a beam tilted by theta is h / cos(theta) long. Noise is `NOISE` plus a share of the
distance, as of a small lidar (Benewake TFmini-S: 1 % above 6 m).
"""

import math

import numpy as np

from fakevehicle.faults import Channel
from fakevehicle.sensors.obstacles import Nearby, World
from fakevehicle.vocabulary import FloatArray, RangeSample

MINIMUM = 0.05
NOISE, SHARE = 0.02, 0.005
"""1 sigma: [m], and of the distance."""


class Rangefinder:
    """Distance along z_b.

    Parameters
    ----------
    world : what stands on the ground; None: nothing.
    ground : down coordinate of the ground in truth's n [m].
    rng : of its noise.
    channel : its faults.

    Attributes
    ----------
    maximum : its reach [m].
    """

    def __init__(self, world: World | None, ground: float, rng: np.random.Generator, channel: Channel) -> None:
        self._nearby = None if world is None else Nearby(world)
        self._ground, self._rng, self._channel = ground, rng, channel
        self.maximum = 20.0

    def measure(self, now_us: int, position_n: FloatArray, q_nb: FloatArray) -> RangeSample | None:
        """A sample at truth's position and attitude; None: nothing comes. One draw."""
        w, x, y, z = q_nb.tolist()
        down = (2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y))  # z_b in n
        height = max(self._ground - float(position_n[2]), 0.0)
        distance = height / down[2] if down[2] > 1e-3 else math.inf
        if self._nearby is not None:
            near = self._nearby.at(now_us, position_n, self.maximum)
            distance = min(distance, float(near.cast(position_n, np.array([down]), self.maximum)[0]))
        draw = self._rng.standard_normal()
        if math.isfinite(distance):
            distance += math.hypot(NOISE, SHARE * distance) * draw
        said = self._channel.through(now_us, np.array([distance]))
        if said is None:
            return None
        distance = float(said[0])
        within = distance <= self.maximum
        return RangeSample(now_us, max(distance, MINIMUM) if within else math.nan, MINIMUM, self.maximum)
