"""Where the filter starts: a second at rest gives tilt (accelerometer), yaw (magnetometer), height zero and origin.

At rest the specific force is -g e3 seen from b, so with u = -f/|f| roll = atan2(u_y, u_z), pitch = atan2(-u_x, |u_yz|).
Turned level by these, the field's horizontal part points `declination` east of north.
"""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from fakevehicle.vocabulary import FloatArray, Geodetic

ALIGN_US = 1_000_000
"""How long the vehicle must stand before the filter starts [us]."""

MOST = 250
"""Newest samples of each sensor that count when another keeps the start waiting."""


@dataclass(frozen=True, slots=True)
class Start:
    """What a second at rest tells.

    Attributes
    ----------
    q_nb : (4,) wxyz.
    origin : mean of the fixes.  fixes : how many.
    height_zero : mean altitude of the barometer [m].  zero_samples : how many.
    mag_samples : how many the yaw stands on.
    """

    q_nb: FloatArray
    origin: Geodetic
    fixes: int
    height_zero: float
    zero_samples: int
    mag_samples: int


class Alignment:
    """Collects samples until there are enough.

    Parameters
    ----------
    field_n : (3,) magnetic field at the place [gauss].
    period_us : spacing of IMU samples [us].
    """

    def __init__(self, field_n: FloatArray, period_us: int) -> None:
        self._field_n = field_n
        self._needed = -(-ALIGN_US // period_us)
        self._imu: FloatArray = np.zeros(6)
        self._count = 0
        self.fixes: deque[Geodetic] = deque(maxlen=MOST)
        self.heights: deque[float] = deque(maxlen=MOST)
        self.fields: deque[FloatArray] = deque(maxlen=MOST)

    def step(self, newest: FloatArray) -> Start | None:
        """Take one IMU sample (6,): body rate and specific force; the start, once there is enough of everything."""
        self._imu += newest
        self._count += 1
        if self._count < self._needed or not (self.fixes and self.heights and self.fields):
            return None
        up = -self._imu[3:] / np.linalg.norm(self._imu[3:])
        roll = math.atan2(up[1], up[2])
        pitch = math.atan2(-up[0], math.hypot(up[1], up[2]))
        cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
        x, y, z = np.mean(self.fields, axis=0).tolist()
        level_x, level_y = cp * x + sp * (sr * y + cr * z), cr * y - sr * z
        yaw = math.atan2(-level_y, level_x) + math.atan2(self._field_n[1], self._field_n[0])
        cr, sr, cp, sp = math.cos(roll / 2), math.sin(roll / 2), math.cos(pitch / 2), math.sin(pitch / 2)
        cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
        first, n = self.fixes[0], len(self.fixes)
        turns = [math.remainder(f.longitude - first.longitude, 2.0 * math.pi) for f in self.fixes]
        return Start(
            q_nb=np.array(
                [
                    cr * cp * cy + sr * sp * sy,
                    sr * cp * cy - cr * sp * sy,
                    cr * sp * cy + sr * cp * sy,
                    cr * cp * sy - sr * sp * cy,
                ]
            ),
            origin=Geodetic(
                sum(f.latitude for f in self.fixes) / n,
                math.remainder(first.longitude + sum(turns) / n, 2.0 * math.pi),
                sum(f.altitude for f in self.fixes) / n,
            ),
            fixes=n,
            height_zero=float(np.mean(self.heights)),
            zero_samples=len(self.heights),
            mag_samples=len(self.fields),
        )
