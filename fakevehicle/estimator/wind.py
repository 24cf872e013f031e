"""The wind as the estimator knows it: what GPS says over ground less what the rotors' drag says through the air.

    w = v_n - R (v_air),    v_air,xy = -f_xy / k,    v_air,z as the velocity has it

is watched while GPS is good and averaged; its scatter s (gusts, GPS noise) goes into the noise of the
airspeed that takes over when GPS is gone (`measurements.drag`). What the mean itself is wrong by stays wrong for as
long as GPS is gone: the n-th airspeed is taken with

    R = C (s^2 + floor^2) + n s^2 min(1, 2 T_gust / T_mean)

so that many of them together never claim to know more than the mean does.
"""

import math

import numpy as np

from fakevehicle.estimator.strapdown import matrix
from fakevehicle.vocabulary import FloatArray, Wind

SHARE, PERIOD_S = 0.003, 0.1
"""Of a new word in the average, and the spacing of words: a memory of 33 s, which is worth a mean over twice that."""
GUST_S = 5.0
"""Time in which a gust forgets near the ground [s]."""
ENOUGH = 30
"""Words before the average is used; the first `SKIP` are of the take-off and count for nothing."""
SKIP = 20
CORRELATION = 10.0
"""Neighbouring airspeeds, 0.2 s apart, share a gust of about 2 s: each is worth a tenth."""
FLOOR = 0.2
"""The airspeed is never trusted better than this [m/s]."""
MODEL = 0.3
"""Share of the wind by which it may be wrong: k leaves out the body's drag, which grows with the airspeed's square."""


class WindWatch:
    """Running mean of the horizontal wind.

    Attributes
    ----------
    wind_n : (3,) [m/s], its down component zero.
    """

    def __init__(self) -> None:
        self.wind_n: FloatArray = np.zeros(3)
        self._variance = 0.0
        self._words = 0

    @property
    def known(self) -> bool:
        """Whether there were enough words."""
        return self._words >= ENOUGH

    def sigma(self, n: int) -> float:
        """1 sigma [m/s] for `measurements.drag`, of the n-th since GPS was lost; five come a second."""
        return math.sqrt(CORRELATION * (self._variance + FLOOR**2) + n * self._stays())

    def told(self, offset: float) -> Wind | None:
        """The mean, for those who ask; None before it is known.

        Parameters
        ----------
        offset : 1 sigma of the airspeed by the accelerometer's bias, which the scatter does not show [m/s].
        """
        if not self.known:
            return None
        north, east, _ = self.wind_n.tolist()
        sigma = math.hypot(FLOOR, offset, MODEL * math.hypot(north, east), math.sqrt(self._stays()))
        return Wind(north, east, math.sqrt(self._variance), sigma)

    def _stays(self) -> float:
        """Variance of the mean [m^2/s^2]."""
        averaged_s = PERIOD_S * min(self._words - SKIP, 2.0 / SHARE)
        return self._variance * min(1.0, 2.0 * GUST_S / averaged_s)

    def note(self, nominal: FloatArray, felt_b: FloatArray, k: float) -> None:
        """Take in what one fix and the specific force (b, bias removed) say; parameters as in `measurements.drag`."""
        self._words += 1
        if self._words <= SKIP:
            return
        r = matrix(nominal[6:10])
        north, east, down = nominal[3:6].tolist()
        w_n, w_e = self.wind_n[0], self.wind_n[1]
        x, y = -felt_b[0] / k, -felt_b[1] / k
        z = r[2] * (north - w_n) + r[5] * (east - w_e) + r[8] * down
        gust_n = north - (r[0] * x + r[1] * y + r[2] * z) - w_n
        gust_e = east - (r[3] * x + r[4] * y + r[5] * z) - w_e
        share = max(SHARE, 1.0 / (self._words - SKIP))
        self.wind_n[0] += share * gust_n
        self.wind_n[1] += share * gust_e
        if self._words > SKIP + 1:
            self._variance += share * (0.5 * (gust_n * gust_n + gust_e * gust_e) - self._variance)
