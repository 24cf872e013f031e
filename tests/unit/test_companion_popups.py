"""What a mission says of things that appear and move: read strictly, handed to the vehicle from where it starts."""

import numpy as np
import pytest

from companion.cli.vehicle import seen_world
from companion.errors import MissionError
from companion.missionfile import parse_mission

MISSION = """\
name: w
vehicle: {{start: {{north: 2, east: 3}}}}
world:
  bounds: {{north: [0, 20], east: [0, 10], altitude: [0, 5]}}
{}
steps: [{{takeoff: {{altitude: 2}}}}, land]
"""
MOVER = "  movers: [{sphere: {north: 5, east: 4, altitude: 1.5, radius: 0.4}, velocity: {north: 1, up: 0.5}}]"


def mission(world: str):
    return parse_mission(MISSION.format(world).encode(), "w.yaml")


def test_movers_and_pop_ups_are_seen_from_where_the_vehicle_starts_and_not_planned_for() -> None:
    popups = """
  popups:
    - {at: 12, box: {north: [6, 7], east: [3, 5], altitude: [0, 4]}}
    - {within: 5, sphere: {north: 9, east: 9, altitude: 2, radius: 1}}"""
    read = mission(MOVER + popups)
    seen = seen_world(read)
    assert seen is not None
    assert read.planner_world().obstacles == ()
    assert [(p.at_us, p.within) for p in seen.popups] == [(12_000_000, None), (None, 5.0)]
    np.testing.assert_allclose(seen.popups[0].solids.boxes, [[4, 0, -4, 5, 2, 0]])
    np.testing.assert_allclose(seen.popups[1].solids.spheres, [[7, 6, -2, 1]])
    assert seen.movers is not None
    np.testing.assert_allclose(seen.movers.balls, [[3, 1, -1.5, 1, 0, -0.5, 0.4]])
    np.testing.assert_allclose([seen.movers.low_n, seen.movers.high_n], [[-2, -3, -5], [18, 7, 0]])


@pytest.mark.parametrize(
    ("world", "said"),
    [
        ("  popups: [{box: {north: [6, 7], east: [3, 5], altitude: [0, 4]}}]", "expected exactly one of at, within"),
        ("  popups: [{at: 3, voxels: map.npz}]", "expected a box, cylinder, sphere or prism"),
        (MOVER.replace("east: 4", "east: 9.7"), "mover 0: found east 9.7"),
        (MOVER.replace("up: 0.5", "down: 0.5"), "down"),
    ],
)
def test_what_cannot_appear_or_move_is_refused_with_its_line(world: str, said: str) -> None:
    with pytest.raises(MissionError, match=said) as refused:
        mission(world)
    assert "line" in str(refused.value)
