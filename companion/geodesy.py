"""Small-area geodesy: degrees of latitude and longitude to metres north and east and back, on the WGS-84 ellipsoid."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

SEMI_MAJOR_AXIS = 6_378_137.0  # [m] WGS-84 (NIMA TR8350.2)
ECCENTRICITY_SQUARED = 6.694379990141e-3  # WGS-84


class Geodetic(NamedTuple):
    """A place on the earth."""

    latitude: float  # [deg]
    longitude: float  # [deg]
    altitude: float = 0.0  # above mean sea level [m]


class Radii(NamedTuple):
    """Metres a radian of latitude and of longitude at one place."""

    north: float
    east: float


def radii(latitude_deg: float) -> Radii:
    """The meridian radius of curvature, and the prime-vertical one times the cosine of the latitude [m].

    Groves, Principles of GNSS, Inertial, and Multisensor Integrated Navigation Systems, 2nd ed., eq. 2.105, 2.106:

        M = a (1 - e^2) / (1 - e^2 sin^2 phi)^(3/2),   N = a / sqrt(1 - e^2 sin^2 phi)
    """
    phi = math.radians(latitude_deg)
    root = math.sqrt(1.0 - ECCENTRICITY_SQUARED * math.sin(phi) ** 2)
    meridian = SEMI_MAJOR_AXIS * (1.0 - ECCENTRICITY_SQUARED) / root**3
    return Radii(meridian, SEMI_MAJOR_AXIS / root * math.cos(phi))


def local_ned(latitude_e7: FloatArray, longitude_e7: FloatArray, altitude_mm: FloatArray) -> FloatArray:
    """Positions relative to the first one, on the plane tangent there.

    north = M dphi, east = N cos(phi) dlambda, with the `radii` of the first.

    Parameters
    ----------
    latitude_e7, longitude_e7 : (n,) [deg * 1e7], as MAVLink has them.
    altitude_mm : (n,) above mean sea level [mm].

    Returns
    -------
    (n, 3) NED [m]; better than 1 mm within 1 km.
    """
    metres = radii(float(latitude_e7[0]) * 1e-7)
    turn = longitude_e7 - longitude_e7[0]
    turn = (turn + 1.8e9) % 3.6e9 - 1.8e9  # the short way across the date line
    return np.column_stack(
        (
            np.radians((latitude_e7 - latitude_e7[0]) * 1e-7) * metres.north,
            np.radians(turn * 1e-7) * metres.east,
            -(altitude_mm - altitude_mm[0]) * 1e-3,
        )
    )


def to_local(origin: Geodetic, latitude: float, longitude: float) -> tuple[float, float]:
    """North and east [m] of a place [deg], on the plane tangent at the origin."""
    metres = radii(origin.latitude)
    turn = (longitude - origin.longitude + 180.0) % 360.0 - 180.0
    return math.radians(latitude - origin.latitude) * metres.north, math.radians(turn) * metres.east


def to_geodetic(origin: Geodetic, north: float, east: float) -> tuple[float, float]:
    """Latitude and longitude [deg] of a point of the plane tangent at the origin: `to_local` backwards."""
    metres = radii(origin.latitude)
    longitude = origin.longitude + math.degrees(east / metres.east)
    return origin.latitude + math.degrees(north / metres.north), (longitude + 180.0) % 360.0 - 180.0
