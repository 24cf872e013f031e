"""The wind a hovering vehicle tells, against the simulator's."""

import math

import numpy as np
import pytest
from vehicle_pilot import ACCEPTED, Pilot

from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle

NAN = math.nan


@pytest.mark.parametrize(
    ("wind_n", "seed"), [((0.0, 0.0, 0.0), 1), ((4.0, -2.0, 0.0), 2), ((0.0, 5.0, 0.0), 3), ((-7.0, 0.0, 0.0), 4)]
)
def test_the_wind_told_in_flight_is_the_winds_within_three_of_its_sigmas(
    wind_n: tuple[float, float, float], seed: int
) -> None:
    config = VehicleConfig(links=(LinkConfig("onboard"),), wind_n=np.array(wind_n), seed=seed)
    pilot = Pilot(Vehicle(config, {"SIM_WIND_GUST": 1.0}))
    pilot.run(8.0)
    assert not pilot.of("WIND_COV")  # nothing is known before the flight
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, 0, 0, 0, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.run(25.0)
    told = pilot.last("WIND_COV")
    off = math.hypot(told.wind_x - wind_n[0], told.wind_y - wind_n[1])
    assert off < 3.0 * told.horiz_accuracy
    assert told.horiz_accuracy < 0.8 + 0.45 * math.hypot(*wind_n)
