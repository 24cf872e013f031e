"""Local metres from degrees, against the length of a degree as published."""

import numpy as np
import pytest

from companion.geodesy import local_ned

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
