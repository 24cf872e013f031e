"""Small-area geodesy: degrees of latitude and longitude to metres north and east, on the WGS-84 ellipsoid."""

import math

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

SEMI_MAJOR_AXIS = 6_378_137.0  # [m] WGS-84 (NIMA TR8350.2)
ECCENTRICITY_SQUARED = 6.694379990141e-3  # WGS-84


def local_ned(latitude_e7: FloatArray, longitude_e7: FloatArray, altitude_mm: FloatArray) -> FloatArray:
    """Positions relative to the first one, on the plane tangent there.

    north = M dphi, east = N cos(phi) dlambda, with the meridian and prime-vertical radii of curvature (Groves,
    Principles of GNSS, Inertial, and Multisensor Integrated Navigation Systems, 2nd ed., eq. 2.105, 2.106):

        M = a (1 - e^2) / (1 - e^2 sin^2 phi)^(3/2),   N = a / sqrt(1 - e^2 sin^2 phi)

    Parameters
    ----------
    latitude_e7, longitude_e7 : (n,) [deg * 1e7], as MAVLink has them.
    altitude_mm : (n,) above mean sea level [mm].

    Returns
    -------
    (n, 3) NED [m]; better than 1 mm within 1 km.
    """
    phi = math.radians(float(latitude_e7[0]) * 1e-7)
    root = math.sqrt(1.0 - ECCENTRICITY_SQUARED * math.sin(phi) ** 2)
    meridian = SEMI_MAJOR_AXIS * (1.0 - ECCENTRICITY_SQUARED) / root**3
    prime_vertical = SEMI_MAJOR_AXIS / root
    turn = longitude_e7 - longitude_e7[0]
    turn = (turn + 1.8e9) % 3.6e9 - 1.8e9  # the short way across the date line
    return np.column_stack(
        (
            np.radians((latitude_e7 - latitude_e7[0]) * 1e-7) * meridian,
            np.radians(turn * 1e-7) * prime_vertical * math.cos(phi),
            -(altitude_mm - altitude_mm[0]) * 1e-3,
        )
    )
