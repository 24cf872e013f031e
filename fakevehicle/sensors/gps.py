"""A GNSS receiver: 10 fixes a second, white noise on position and velocity, each fix late.

Vertical errors are 1.5 times the horizontal ones, as the geometry of satellites above the horizon gives. On top of the
white noise, when asked for: a slow wander of the position (atmosphere and satellites' clocks, first-order Gauss-Markov
of `WANDER_TIME`), fixes that are lost, and glitches, a jump sideways for `GLITCH_S`, as of a reflected signal. These
draw from a generator of their own, so that the white noise is the same without them.
"""

import math
from collections import deque

import numpy as np

from fakevehicle.faults import Channel
from fakevehicle.geodesy import to_geodetic
from fakevehicle.vocabulary import FloatArray, Geodetic, GpsSample

VERTICAL = 1.5
WANDER_TIME = 100.0
"""Time in which the wander forgets [s]."""
GLITCH_S = 5.0
"""How long a glitch lasts [s]."""
SATELLITES, NO_FIX, FIX_3D = 14, 1, 3
MOST_UNDER_WAY = 64


class GpsReceiver:
    """Fixes of a moving antenna.

    Parameters
    ----------
    home : where truth's local frame begins.
    rng : source of its noise.
    delay_us : from a fix being true to its arrival [us].
    position_noise, velocity_noise : 1 sigma horizontally [m], [m/s].
    channel : its faults, of words of six: position_n [m] and velocity_n [m/s]. None: it has none.

    Attributes
    ----------
    wander : 1 sigma of the slow part of the position's error [m], horizontally.
    lost : share of the fixes that are lost.
    glitch, glitch_every_s : size [m] and mean spacing [s] of glitches; no size, no glitch.
    silent : whether nothing came out of the newest measurement (the receiver is off).
    """

    def __init__(
        self,
        home: Geodetic,
        rng: np.random.Generator,
        delay_us: int,
        position_noise: float,
        velocity_noise: float,
        channel: Channel | None = None,
    ) -> None:
        self._home, self._rng, self.delay_us = home, rng, delay_us
        self._rare = rng.spawn(1)[0]
        self._channel = channel
        self.position_noise, self.velocity_noise = position_noise, velocity_noise
        self.wander = self.lost = self.glitch = 0.0
        self.glitch_every_s = 60.0
        self.silent = False
        self._wandered: FloatArray = np.zeros(3)
        self._jump: FloatArray = np.zeros(3)
        self._glitch_until_us = 0
        self._measured_us = 0
        self._under_way: deque[tuple[int, int, Geodetic, FloatArray, int]] = deque(maxlen=MOST_UNDER_WAY)

    def measure(self, now_us: int, position_n: FloatArray, velocity_n: FloatArray) -> None:
        """Take a fix now, from truth; it will arrive later. Six draws."""
        draws = self._rng.standard_normal(6)
        draws[2] *= VERTICAL
        draws[5] *= VERTICAL
        place, velocity_n = position_n + self.position_noise * draws[:3], velocity_n + self.velocity_noise * draws[3:]
        fix = FIX_3D
        if self.wander > 0.0 or self.lost > 0.0 or self.glitch > 0.0:
            place += self._misled(now_us)
            fix = NO_FIX if self._rare.random() < self.lost else FIX_3D
        self._measured_us = now_us
        if self._channel is not None:
            word = self._channel.through(now_us, np.concatenate([place, velocity_n]))
            self.silent = word is None
            if word is None:
                return
            place, velocity_n = word[:3], word[3:]
        self._under_way.append((now_us + self.delay_us, now_us, to_geodetic(place, self._home), velocity_n, fix))

    def _misled(self, now_us: int) -> FloatArray:
        """Wander and glitch, (3,) [m]."""
        dt = (now_us - self._measured_us) * 1e-6
        keep = math.exp(-dt / WANDER_TIME)
        step = self.wander * math.sqrt(1.0 - keep * keep) * self._rare.standard_normal(3)
        step[2] *= VERTICAL
        self._wandered = keep * self._wandered + step
        if self.glitch > 0.0 and now_us >= self._glitch_until_us:
            self._jump = np.zeros(3)
            if self._rare.random() < dt / self.glitch_every_s:
                bearing = self._rare.uniform(0.0, 2.0 * math.pi)
                self._jump = self.glitch * np.array([math.cos(bearing), math.sin(bearing), 0.0])
                self._glitch_until_us = now_us + round(1e6 * GLITCH_S)
        return self._wandered + self._jump

    def arrived(self, now_us: int) -> GpsSample | None:
        """The fix that comes out of the receiver at this tick, if one does."""
        if not self._under_way or self._under_way[0][0] > now_us:
            return None
        _, measured_us, place, velocity_n, fix = self._under_way.popleft()
        return GpsSample(
            now_us=now_us,
            measured_us=measured_us,
            position=place,
            velocity_n=velocity_n,
            eph=self.position_noise,
            epv=VERTICAL * self.position_noise,
            speed_accuracy=self.velocity_noise,
            fix_type=fix,
            satellites=SATELLITES if fix == FIX_3D else 3,
        )
