"""A GNSS receiver: 10 fixes a second, white noise on position and velocity, each fix late.

Vertical errors are 1.5 times the horizontal ones, as the geometry of satellites above the horizon gives.
"""

from collections import deque

import numpy as np

from fakevehicle.geodesy import to_geodetic
from fakevehicle.vocabulary import FloatArray, Geodetic, GpsSample

VERTICAL = 1.5


class GpsReceiver:
    """Fixes of a moving antenna.

    Parameters
    ----------
    home : where truth's local frame begins.
    rng : source of its noise.
    delay_us : from a fix being true to its arrival [us].
    position_noise, velocity_noise : 1 sigma horizontally [m], [m/s].
    """

    def __init__(
        self, home: Geodetic, rng: np.random.Generator, delay_us: int, position_noise: float, velocity_noise: float
    ) -> None:
        self._home, self._rng, self._delay_us = home, rng, delay_us
        self.position_noise, self.velocity_noise = position_noise, velocity_noise
        self._under_way: deque[tuple[int, int, Geodetic, FloatArray]] = deque()

    def measure(self, now_us: int, position_n: FloatArray, velocity_n: FloatArray) -> None:
        """Take a fix now, from truth; it will arrive later. Six draws."""
        draws = self._rng.standard_normal(6)
        draws[2] *= VERTICAL
        draws[5] *= VERTICAL
        place = to_geodetic(position_n + self.position_noise * draws[:3], self._home)
        self._under_way.append((now_us + self._delay_us, now_us, place, velocity_n + self.velocity_noise * draws[3:]))

    def arrived(self, now_us: int) -> GpsSample | None:
        """The fix that comes out of the receiver at this tick, if one does."""
        if not self._under_way or self._under_way[0][0] > now_us:
            return None
        _, measured_us, place, velocity_n = self._under_way.popleft()
        return GpsSample(
            now_us=now_us,
            measured_us=measured_us,
            position=place,
            velocity_n=velocity_n,
            eph=self.position_noise,
            epv=VERTICAL * self.position_noise,
            speed_accuracy=self.velocity_noise,
            fix_type=3,
            satellites=14,
        )
