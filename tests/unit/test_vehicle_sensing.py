"""What the vehicle tells of its surroundings, and the scenario files that put something there."""

import math
from pathlib import Path

import numpy as np
import pytest

from companion.cli.vehicle import seen_world
from companion.missionfile import parse_mission
from fakevehicle.airframe import load_airframe
from fakevehicle.errors import ScenarioError
from fakevehicle.faults import parse_fault
from fakevehicle.flight import PARAMETERS, FlightStack
from fakevehicle.params import ParameterSet
from fakevehicle.scenario import load_scenario, world_text
from fakevehicle.sensors.obstacles import World
from fakevehicle.services.sensing import Sensing
from fakevehicle.vocabulary import Geodetic
from wire.dialect import mavlink

HOME = Geodetic(math.radians(47.397742), math.radians(8.545594), 488.0)
BLOCK = World(boxes=np.array([[4.0, -2.0, -3.0, 5.0, 2.0, 1.0]]))


def stack(world: World | None = None, **parameters: float) -> FlightStack:
    made = FlightStack(
        airframe=load_airframe("x500"),
        parameters=ParameterSet(PARAMETERS, parameters),
        home=HOME,
        heading=0.0,
        wind_n=np.zeros(3),
        seed=1,
        world=world,
    )
    for k in range(1, 101):
        made.tick(4000 * k, None, False)
    return made


def test_without_a_world_and_a_rangefinder_nothing_is_told() -> None:
    sensing = Sensing(stack(SIM_RNG_MAX=0))
    assert all(builder() is None for builder in sensing.builders().values())


def test_standing_on_the_ground_the_rangefinder_tells_a_hand_s_breadth_downwards() -> None:
    told = Sensing(stack()).distance_sensor()
    assert told is not None
    assert 5 <= told.current_distance < 40  # [cm]
    assert told.orientation == 25  # down
    assert (told.min_distance, told.max_distance) == (5, 2000)


def test_a_block_ahead_is_told_in_the_sectors_ahead_and_nowhere_else() -> None:
    told = Sensing(stack(BLOCK)).obstacle_distance()
    assert told is not None
    assert told.frame == mavlink.MAV_FRAME_BODY_FRD
    assert (told.increment, told.angle_offset, len(told.distances)) == (5, 0, 72)
    ahead = [sector for sector, cm in enumerate(told.distances) if cm <= told.max_distance]
    assert ahead == [*range(6), *range(67, 72)]  # 2 m aside at 4 m: 26.6 deg to each side
    assert told.distances[0] == pytest.approx(400, abs=15)
    assert set(told.distances) - {told.distances[s] for s in ahead} == {told.max_distance + 1}
    told.pack(mavlink.MAVLink(None))  # fits into the message


def test_the_nearest_points_around_come_one_after_another_in_the_body_s_frame() -> None:
    sensing = Sensing(stack(BLOCK))
    points = [sensing.obstacle_distance_3d() for _ in range(4)]
    for point in points:
        assert point is not None
        assert point.obstacle_id in (0, 7)  # the two eighths beside the nose
        assert point.x == pytest.approx(4.0, abs=0.2)
        assert abs(point.y) <= 2.1


def test_a_mission_s_obstacles_are_seen_from_where_the_vehicle_starts() -> None:
    text = """\
name: w
vehicle: {start: {north: 2, east: 3}}
world:
  bounds: {north: [0, 20], east: [0, 20], altitude: [0, 6]}
  obstacles:
    - box: {north: [5, 6], east: [7, 8], altitude: [0, 4]}
    - sphere: {north: 10, east: 10, altitude: 2, radius: 1}
    - cylinder: {north: 12, east: 3, radius: 0.5, altitude: [1, 3]}
    - prism: {corners: [{north: 15, east: 15}, {north: 17, east: 15}, {north: 15, east: 17}], altitude: [0, 2]}
steps: [{takeoff: {altitude: 1.5}}, land]
"""
    world = seen_world(parse_mission(text.encode(), "w.yaml"))
    assert world is not None
    np.testing.assert_allclose(world.boxes, [[3, 4, -4, 4, 5, 0]])
    np.testing.assert_allclose(world.spheres, [[8, 7, -2, 1]])
    np.testing.assert_allclose(world.cylinders, [[10, 0, 0.5, -3, -1]])
    assert world.walls.shape == (3, 6)
    np.testing.assert_allclose(world.walls[:, 4:], [[-2, 0]] * 3)


def test_a_world_written_as_a_scenario_is_read_as_it_was(tmp_path: Path) -> None:
    file = tmp_path / "s.yaml"
    file.write_text(world_text(BLOCK), encoding="utf-8")
    world = load_scenario(file).world
    assert world is not None
    np.testing.assert_array_equal(world.boxes, BLOCK.boxes)
    assert len(world.walls) == 0


def test_a_scenario_brings_faults_and_gusts(tmp_path: Path) -> None:
    file = tmp_path / "s.yaml"
    file.write_text('faults: ["gps:off@20-40"]\ngusts: [{at: 15, hold: 3, velocity: [0, 6, 0]}]\n', encoding="utf-8")
    scenario = load_scenario(file)
    assert scenario.faults == (parse_fault("gps:off@20-40"),)
    assert (scenario.gusts[0].start_us, scenario.gusts[0].hold_s) == (15_000_000, 3.0)
    assert scenario.world is None


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("faults: [gps:gone]", "expected one of gyro"),
        ("gusts: [{at: -1, velocity: [0, 0, 0]}]", "gusts.0.at"),
        ("world: {boxes: [[1, 2, 3]]}", "world.boxes: a row of 3 numbers, expected 6"),
        ("world: {spheres: [[0, 0, .nan, 1]]}", "world.spheres.0.2"),
        ("walls: []", "walls"),
        ("faults: [", "s.yaml"),
        ("- 1", "dictionary"),
    ],
)
def test_a_scenario_that_cannot_be_is_refused_with_file_and_place(tmp_path: Path, text: str, complaint: str) -> None:
    file = tmp_path / "s.yaml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ScenarioError, match=complaint) as caught:
        load_scenario(file)
    assert str(caught.value).startswith(str(file))
    with pytest.raises(ScenarioError, match="No such file"):
        load_scenario(tmp_path / "none.yaml")
