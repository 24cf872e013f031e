"""Places on the globe, and points of two local frames: the estimator's (first fix) and truth's (home)."""

import math
from collections.abc import Callable

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
        self._home = home

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
        return None if origin is None else _packed(to_geodetic(position_n, origin))

    def truth_e7(self, position_n: FloatArray) -> PlaceE7:
        """The place of a point in truth's frame, (3,) [m]."""
        return _packed(to_geodetic(position_n, self._home))


def _packed(place: Geodetic) -> PlaceE7:
    return (
        round(math.degrees(place.latitude) * 1e7),
        round(math.degrees(place.longitude) * 1e7),
        round(place.altitude * 1e3),
    )
