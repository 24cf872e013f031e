"""Places on the globe, and points of two local frames: the estimator's (first fix) and truth's (home)."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import numpy as np

from fakevehicle.geodesy import to_geodetic, to_local
from fakevehicle.vocabulary import FloatArray, Geodetic

PlaceE7 = tuple[int, int, int]
"""Latitude and longitude [deg e7], altitude above mean sea level [mm], as MAVLink packs them."""


class Places:
    """Converts both ways.

    Parameters
    ----------
    origin : gives the estimator's origin, None before the first fix.
    home : where the simulator stands at (0, 0, 0) of its truth.
    """

    def __init__(self, origin: Callable[[], Geodetic | None], home: Geodetic) -> None:
        self._origin = origin
        self._truth_scale = self._scale = _Scale.of(home)

    @property
    def origin(self) -> Geodetic | None:
        """Where the estimator's local (0, 0, 0) is."""
        return self._origin()

    def local(self, place: Geodetic) -> FloatArray | None:
        """(3,) local NED of the estimator [m]; None before the first fix."""
        origin = self._origin()
        return None if origin is None else to_local(place, origin)

    def e7(self, position_n: FloatArray) -> PlaceE7 | None:
        """The place of a point in the estimator's frame, (3,) [m]; None before the first fix."""
        origin = self._origin()
        if origin is None:
            return None
        if origin is not self._scale.origin:
            self._scale = _Scale.of(origin)
        return self._scale.packed(position_n)

    def truth_e7(self, position_n: FloatArray) -> PlaceE7:
        """The place of a point in truth's frame, (3,) [m]."""
        return self._truth_scale.packed(position_n)


@dataclass(frozen=True, slots=True)
class _Scale:
    """`to_geodetic` of one origin in MAVLink's units: it is linear, so two points are enough to know it."""

    origin: Geodetic
    latitude_e7: float
    longitude_e7: float
    north_e7: float  # [deg e7 / m]
    east_e7: float

    @classmethod
    def of(cls, origin: Geodetic) -> Self:
        away = to_geodetic(np.array([1000.0, 1000.0, 0.0]), origin)
        turn = math.remainder(away.longitude - origin.longitude, 2.0 * math.pi)
        return cls(
            origin,
            math.degrees(origin.latitude) * 1e7,
            math.degrees(origin.longitude) * 1e7,
            math.degrees(away.latitude - origin.latitude) * 1e4,
            math.degrees(turn) * 1e4,
        )

    def packed(self, position_n: FloatArray) -> PlaceE7:
        north, east, down = position_n.tolist()
        longitude = round(self.longitude_e7 + self.east_e7 * east)
        if not -HALF_TURN_E7 <= longitude < HALF_TURN_E7:
            longitude = (longitude + HALF_TURN_E7) % (2 * HALF_TURN_E7) - HALF_TURN_E7
        return round(self.latitude_e7 + self.north_e7 * north), longitude, round((self.origin.altitude - down) * 1e3)


HALF_TURN_E7 = 1_800_000_000
