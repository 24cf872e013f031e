"""One flight of each campaign of `benchmarks.bench_flights`, so that the campaigns stay flyable."""

import pytest

from benchmarks.bench_flights import FAMILIES, TRACKING_M, known_specs, movers_text
from companion.testing.flight import fly
from companion.testing.spec import FlightSpec
from fakevehicle.config import Autopilot


def test_twenty_movers_that_cross_are_not_touched() -> None:
    result = fly(FlightSpec(movers_text(3).encode(), seed=3))
    assert result.ok, result.story
    assert result.min_clearance_m > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_a_known_world_of_each_family_is_flown_as_closely_as_it_must(family: str) -> None:
    autopilot: Autopilot = "ardupilot" if FAMILIES.index(family) % 2 else "px4"
    result = fly(known_specs(family, autopilot, 1)[0])
    assert result.ok, result.story
    assert result.verdict.tracking_error_p95_m <= TRACKING_M
