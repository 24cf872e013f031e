"""Every mission file we ship is flown, and holds what it expects."""

from pathlib import Path

import pytest

from companion.cli.test import mission_files
from companion.testing.flight import fly
from companion.testing.spec import FlightSpec
from companion.testing.wire import LinkFaults

MISSIONS = list(mission_files([Path(__file__).parents[2] / "missions"]))


@pytest.mark.slow
@pytest.mark.parametrize("file", MISSIONS, ids=lambda file: file.name)
def test_a_mission_file_holds_what_it_expects_with_the_other_autopilot(file: Path) -> None:
    result = fly(FlightSpec(file, autopilot="ardupilot", seed=2))
    assert result.ok, f"{result.cause}\n{result.story}"


def test_what_moves_is_not_touched() -> None:
    result = fly(FlightSpec(MISSIONS[0].parent / "movers.yaml"))
    assert result.ok, f"{result.cause}\n{result.story}"
    assert result.verdict.min_clearance_m == result.min_clearance_m > 0.0


def test_what_is_there_for_one_vehicle_is_refused_for_several() -> None:
    with pytest.raises(ValueError, match="link: found with a mission of several vehicles"):
        fly(FlightSpec(MISSIONS[0].parent / "swap.yaml", link=LinkFaults(loss=0.1)))
