"""A magnetometer: the local field seen from the body, with hard iron and white noise.

The field is Zurich's (IGRF-13 for 2025: declination 3.4 deg east, inclination 63.3 deg, 0.484 gauss) wherever home is,
unless parameters say otherwise; the estimator knows it, as a real one does from its table of the earth's field, but has
a declination of its own. The rotation is written here and not
taken from the estimator, which would then agree with any mistake in it:

    R^T m = m - 2 w (u x m) + 2 u x (u x m),      q = (w, u)
"""

import math

import numpy as np

from fakevehicle.vocabulary import FloatArray, MagSample

DECLINATION, INCLINATION, STRENGTH = math.radians(3.4), math.radians(63.3), 0.484


def field_n(declination: float = DECLINATION, inclination: float = INCLINATION) -> FloatArray:
    """The magnetic field in n, (3,) [gauss]; angles in radians, east and down."""
    flat = STRENGTH * math.cos(inclination)
    return np.array([flat * math.cos(declination), flat * math.sin(declination), STRENGTH * math.sin(inclination)])


class Magnetometer:
    """Three axes of the field in b.

    Parameters
    ----------
    rng : source of its noise.
    noise : 1 sigma an axis [gauss].

    Attributes
    ----------
    field_n : (3,) the earth's field [gauss].
    hard_iron_b : (3,) what magnetised parts of the vehicle add [gauss].
    """

    def __init__(self, rng: np.random.Generator, noise: float) -> None:
        self._rng, self.noise = rng, noise
        self.field_n = field_n()
        self.hard_iron_b: FloatArray = np.zeros(3)

    def measure(self, now_us: int, q_nb: FloatArray) -> MagSample:
        """A sample at truth's attitude (wxyz). Three draws."""
        w, x, y, z = q_nb.tolist()  # plain floats: ten times as fast as numpy on three
        a, b, c = self.field_n.tolist()
        i, j, k = y * c - z * b, z * a - x * c, x * b - y * a  # u x m
        seen = np.array(
            [
                a - 2.0 * (w * i - (y * k - z * j)),
                b - 2.0 * (w * j - (z * i - x * k)),
                c - 2.0 * (w * k - (x * j - y * i)),
            ]
        )
        return MagSample(now_us, seen + self.hard_iron_b + self.noise * self._rng.standard_normal(3))
