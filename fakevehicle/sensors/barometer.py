"""A barometer: pressure of the standard atmosphere at the vehicle's altitude, white noise and a slow drift.

    p = p0 (1 - L h / T0)^(g M / (R L))        (ICAO standard atmosphere, Doc 7488, below 11 km)

Noise and drift are given in metres of altitude. The drift is a first-order Gauss-Markov process: it starts at zero (the
zero is taken at power-up anyway) and forgets with `DRIFT_TIME`.
"""

import math

import numpy as np

from fakevehicle.vocabulary import BaroSample

P0, T0, LAPSE, EXPONENT = 101_325.0, 288.15, 0.0065, 5.255_876
DRIFT_TIME = 300.0


def pressure_at(altitude: float) -> float:
    """Pressure of the standard atmosphere [Pa] at an altitude above mean sea level [m]."""
    return P0 * float((1.0 - LAPSE * altitude / T0) ** EXPONENT)


def altitude_of(pressure: float) -> float:
    """Inverse of `pressure_at`."""
    return T0 / LAPSE * float(1.0 - (pressure / P0) ** (1.0 / EXPONENT))


class Barometer:
    """Pressure, and the altitude it stands for.

    Parameters
    ----------
    rng : source of its noise.
    noise, drift : 1 sigma of white noise and of the drift in the long run [m].
    """

    def __init__(self, rng: np.random.Generator, noise: float, drift: float) -> None:
        self._rng = rng
        self.noise, self.drift = noise, drift
        self._offset = 0.0

    def measure(self, now_us: int, altitude: float, dt: float) -> BaroSample:
        """A sample of truth's altitude above mean sea level [m], `dt` seconds after the last one. Two draws."""
        white, walk = self._rng.standard_normal(2).tolist()
        keep = math.exp(-dt / DRIFT_TIME)
        self._offset = keep * self._offset + self.drift * math.sqrt(1.0 - keep * keep) * walk
        pressure = pressure_at(altitude + self._offset + self.noise * white)
        return BaroSample(now_us, altitude_of(pressure), pressure, T0 - LAPSE * altitude - 273.15)
