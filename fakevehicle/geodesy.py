"""Local NED and WGS-84: the local tangent plane with the ellipsoid's radii of curvature at its origin.

    north = (M + h) dlat,    east = (N + h) cos(lat) dlon,    down = -dh
    M = a (1 - e^2) / w^3,   N = a / w,   w = sqrt(1 - e^2 sin^2 lat)

(Groves, Principles of GNSS, 2nd ed., eq. 2.105-2.111). Good to a centimetre within a kilometre of the origin.
"""

import math

import numpy as np

from fakevehicle.vocabulary import FloatArray, Geodetic

SEMI_MAJOR = 6_378_137.0
ECCENTRICITY_SQUARED = 6.69437999014e-3


def _radii(origin: Geodetic) -> tuple[float, float]:
    """Metres per radian of latitude and of longitude at a point."""
    w = math.sqrt(1.0 - ECCENTRICITY_SQUARED * math.sin(origin.latitude) ** 2)
    meridian = SEMI_MAJOR * (1.0 - ECCENTRICITY_SQUARED) / w**3 + origin.altitude
    normal = SEMI_MAJOR / w + origin.altitude
    return meridian, normal * math.cos(origin.latitude)


def to_local(point: Geodetic, origin: Geodetic) -> FloatArray:
    """Position of a point in local NED of `origin`, (3,) [m]."""
    north, east = _radii(origin)
    turn = math.remainder(point.longitude - origin.longitude, 2.0 * math.pi)
    return np.array(
        [(point.latitude - origin.latitude) * north, turn * east, origin.altitude - point.altitude], dtype=float
    )


def to_geodetic(position_n: FloatArray, origin: Geodetic) -> Geodetic:
    """Inverse of `to_local`: the point at (3,) local NED [m] of `origin`."""
    north, east = _radii(origin)
    return Geodetic(
        latitude=origin.latitude + float(position_n[0]) / north,
        longitude=math.remainder(origin.longitude + float(position_n[1]) / east, 2.0 * math.pi),
        altitude=origin.altitude - float(position_n[2]),
    )
