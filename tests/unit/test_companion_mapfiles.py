"""Prisms, voxels and clouds in a mission: altitude turned into down, files found, missed or changed."""

import hashlib
from pathlib import Path

import numpy as np
import pytest

from companion.errors import MissionError
from companion.missionfile import load_mission
from planner import PointCloud, Prism, VoxelGrid
from planner.pcd import write_pcd

MISSION = """\
name: survey
vehicle:
  start: {north: 1, east: 2}
world:
  bounds: {north: [0, 20], east: [0, 20], altitude: [0, 4]}
  obstacles:
    - OBSTACLE
steps:
  - takeoff: {altitude: 1.5}
  - land
"""
PRISM = (
    "prism: {corners: [{north: 2, east: 3}, {north: 6, east: 3}, {north: 6, east: 4}, {north: 3, east: 4}, "
    "{north: 3, east: 9}, {north: 2, east: 9}], altitude: [1, 3]}"
)


def mission_with(folder: Path, obstacle: str) -> Path:
    path = folder / "survey.yaml"
    path.write_text(MISSION.replace("OBSTACLE", obstacle))
    return path


def problems(folder: Path, obstacle: str) -> list[str]:
    with pytest.raises(MissionError) as caught:
        load_mission(mission_with(folder, obstacle))
    return caught.value.problems


def write_grid(folder: Path) -> None:
    """One voxel of 0.5 m: its first column 2.0 to 2.5, its second 5.0 to 5.5, its third 1.0 to 1.5."""
    occupied = np.zeros((6, 12, 4), dtype=bool)
    occupied[4, 10, 2] = True
    np.savez(folder / "map.npz", occupied=occupied, origin=np.zeros(3), resolution=0.5)


def test_a_prism_stands_where_its_corners_say_with_altitude_turned_into_down(tmp_path: Path) -> None:
    world = load_mission(mission_with(tmp_path, PRISM)).planner_world()
    assert world.obstacles == (Prism([(2, 3), (6, 3), (6, 4), (3, 4), (3, 9), (2, 9)], (-3, -1)),)
    found = world.distance(np.array([[2.5, 8.0, -2.0], [2.5, 8.0, -3.25], [2.5, 8.0, 0.0], [7.0, 3.5, -2.0]]))
    np.testing.assert_allclose(found, [-0.5, 0.25, 1.0, 1.0])


@pytest.mark.parametrize(
    ("axes", "middle"),
    [
        ("", (2.25, 5.25, -1.25)),
        (", axes: north east altitude", (2.25, 5.25, -1.25)),
        (", axes: east north altitude", (5.25, 2.25, -1.25)),
        (", axes: north east down", (2.25, 5.25, 1.25)),
        (", axes: east north down", (5.25, 2.25, 1.25)),
    ],
)
def test_a_voxel_and_a_point_stand_where_the_axes_of_their_file_put_them(
    tmp_path: Path, axes: str, middle: tuple[float, float, float]
) -> None:
    write_grid(tmp_path)
    write_pcd(tmp_path / "scan.pcd", np.array([[2.25, 5.25, 1.25]]))
    ways = np.array([[0.75, 0, 0], [0, 0.75, 0], [0, 0, 0.75], [0, 0, -0.75], [-1.25, 0, 0], [0, -1.25, 0]])
    aside = np.array(middle) + ways
    for kind in (f"voxels: {{file: map.npz{axes}}}", f"cloud: {{file: scan.pcd, resolution: 0.5{axes}}}"):
        world = load_mission(mission_with(tmp_path, kind)).planner_world()
        np.testing.assert_allclose(world.distance(aside), [0.5, 0.5, 0.5, 0.5, 1.0, 1.0], atol=1e-9)
        assert world.distance(np.array([middle]))[0] <= 0


def test_a_bare_name_is_a_file_beside_the_mission_and_the_world_is_built_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_grid(tmp_path)
    write_pcd(tmp_path / "scan.pcd", np.array([[2.25, 5.25, 1.25]]))
    monkeypatch.chdir("/")
    mission = load_mission(mission_with(tmp_path, "voxels: map.npz"))
    assert isinstance(mission.planner_world().obstacles[0], VoxelGrid)
    assert mission.planner_world() is mission.planner_world()
    cloud = load_mission(mission_with(tmp_path, "cloud: scan.pcd")).planner_world().obstacles[0]
    assert isinstance(cloud, PointCloud)
    assert cloud.resolution == 0.1


@pytest.mark.parametrize(
    ("obstacle", "words"),
    [
        ("voxels: gone.npz", "line 7: world.obstacles.0.voxels: {}/gone.npz: file: found No such file or directory"),
        ("cloud: gone.pcd", "line 7: world.obstacles.0.cloud: {}/gone.pcd: file: found No such file or directory"),
        ("cloud: map.npz", "line 7: world.obstacles.0.cloud: {}/map.npz: points: found no such array"),
        ("cloud: {{file: map.txt}}", "{}/map.txt: file: found suffix '.txt', expected .pcd or .npz"),
        ("voxels: {{file: map.npz, sha256: " + 64 * "a" + "}}", "expected " + 64 * "a" + ": the file has changed"),
        ("voxels: {{file: map.npz, sha256: abc}}", "world.obstacles.0.voxels.sha256: found 'abc'"),
        ("voxels: {{file: map.npz, axes: up}}", "world.obstacles.0.voxels.axes: found 'up', expected 'north east alt"),
        ("voxels: 3", "world.obstacles.0.voxels: found 3, expected a mapping"),
        ("cloud: {{file: scan.pcd, resolution: 0}}", "world.obstacles.0.cloud.resolution: found 0"),
        (PRISM.replace("{north: 2, east: 9}", "{north: 6, east: 3}"), "touches or crosses"),
        ("prism: {{corners: [], altitude: [0, 1]}}", "world.obstacles.0.prism.corners: found a list of 0"),
        ("voxels: map.npz\n    - cloud: {{file: scan.pcd, resolution: 0.2}}", "world.obstacles: obstacles 0 and 1: "),
        ("voxels: map.npz\n" + 16 * "    - voxels: map.npz\n", "found 17 voxel and cloud files, expected at most 16"),
    ],
)
def test_what_is_wrong_with_a_map_file_is_said_with_its_line(tmp_path: Path, obstacle: str, words: str) -> None:
    write_grid(tmp_path)
    write_pcd(tmp_path / "scan.pcd", np.array([[2.25, 5.25, 1.25]]))
    found = problems(tmp_path, obstacle.replace("{{", "{").replace("}}", "}"))
    assert any(words.format(tmp_path) in line for line in found), found


def test_a_file_with_the_bytes_that_the_mission_names_is_taken(tmp_path: Path) -> None:
    write_grid(tmp_path)
    digest = hashlib.sha256((tmp_path / "map.npz").read_bytes()).hexdigest()
    assert load_mission(mission_with(tmp_path, f"voxels: {{file: map.npz, sha256: {digest}}}")).planner_world()
