"""Local metres from degrees, against the length of a degree as published."""

import numpy as np
import pytest

from companion.geodesy import Geodetic, local_ned, to_geodetic, to_local

DEGREE = 10_000_000


@pytest.mark.parametrize(
    # Lengths of one degree at 0, 45 and 60 degrees latitude [m] (WGS-84; Wikipedia "Geographic coordinate system").
    ("latitude", "meridian", "parallel"),
    [(0, 110_574, 111_320), (45, 111_132, 78_847), (60, 111_412, 55_800)],
)
def test_a_thousandth_of_a_degree_is_a_thousandth_of_its_published_length(latitude, meridian, parallel):
    lat = np.array([latitude * DEGREE, latitude * DEGREE + DEGREE // 1000], dtype=float)
    lon = np.array([8.5 * DEGREE, 8.5 * DEGREE + DEGREE // 1000])
    ned = local_ned(lat, lon, np.array([488_000.0, 489_500.0]))
    assert ned[1, 0] == pytest.approx(meridian / 1000, rel=1e-4)
    assert ned[1, 1] == pytest.approx(parallel / 1000, rel=1e-3)
    assert ned[1, 2] == pytest.approx(-1.5)


def test_the_date_line_is_a_short_step():
    ned = local_ned(np.zeros(2), np.array([1_799_999_990.0, -1_799_999_990.0]), np.zeros(2))
    assert ned[1, 1] == pytest.approx(0.2226, abs=1e-3)


@pytest.mark.parametrize("origin", [Geodetic(47.4, 8.5), Geodetic(-35.36, 149.17), Geodetic(0.0, 179.9999)])
def test_a_place_turned_into_metres_and_back_is_the_same(origin):
    for north, east in ((0.0, 0.0), (812.5, -433.25), (-5000.0, 7000.0)):
        latitude, longitude = to_geodetic(origin, north, east)
        assert -180.0 <= longitude <= 180.0
        assert to_local(origin, latitude, longitude) == pytest.approx((north, east), abs=1e-6)


def test_one_place_is_as_far_as_a_list_of_places_says():
    ends = np.array([473_977_420.0, 473_987_420.0]), np.array([85_455_940.0, 85_440_940.0])
    north, east, _ = local_ned(*ends, np.zeros(2))[1]
    there = to_local(Geodetic(47.3977420, 8.5455940), 47.3987420, 8.5440940)
    assert there == pytest.approx((north, east), abs=1e-6)
