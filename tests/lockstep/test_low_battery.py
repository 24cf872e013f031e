"""What a battery that runs low on the way, or is low at the beginning, makes of a whole flight."""

from pathlib import Path

import pytest

from companion.testing.flight import fly
from companion.testing.spec import FlightSpec

L_SHAPE = Path(__file__).parents[2] / "missions" / "l_shape.yaml"


@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
def test_a_battery_that_runs_low_on_the_way_brings_the_vehicle_home_round_the_wall(autopilot: str) -> None:
    result = fly(FlightSpec(L_SHAPE, autopilot=autopilot, faults=("battery:bias=0,0,-0.87@13",)))
    assert result.phase == "done", result.story
    assert result.failure == "battery at 12%: returning"
    assert result.said("return on a planned way")
    assert result.min_clearance_m is not None
    assert result.min_clearance_m > 0.4


def test_no_flight_begins_with_a_low_battery() -> None:
    result = fly(FlightSpec(L_SHAPE, faults=("battery:bias=0,0,-0.95",)))
    assert result.phase == "failed", result.story
    assert result.failure.startswith("the vehicle is not ready after 120 s: battery at 5%")
    assert not result.said("Armed")
