"""Worlds, grids and clouds in files: what goes out comes back; what is wrong is said in one line."""

import pickle
import struct
import zipfile
from pathlib import Path

import numpy as np
import pytest

from planner import Box, Cylinder, PointCloud, Prism, Sphere, VoxelGrid, World
from planner.errors import WorldFileError
from planner.files import load_world, read_points, read_voxels, save_world
from planner.pcd import read_pcd, write_pcd

RNG = np.random.default_rng(1)
SOLIDS = [
    Box((1, 2, 0), (3, 4.5, 2)),
    Cylinder((5, 5), 0.4, (0, 4)),
    Sphere((3, 4, 2), 0.1),
    Prism([(1, 1), (2, 1), (1.2, 1.3), (1, 2)], (0, 0.1)),
]
BOUNDS = ((0, 0, 0), (20, 20, 4))
GOOD = """\
bounds: {lower: [0, 0, 0], upper: [20, 20, 4]}
obstacles:
  - box: {lower: [9, 6, 0], upper: [10, 15, 4]}
  - prism: {corners: [[12, 3], [14, 3], [13, 6]], z: [0, 4]}
  - voxels: {file: map.npz}
  - cloud: {file: scan.pcd, resolution: 0.2}
"""
PCD = """\
# .PCD v.7 - Point Cloud Data file format
VERSION .7
FIELDS x y z rgb
SIZE 4 4 4 4
TYPE F F F U
COUNT 1 1 1 1
WIDTH 2
HEIGHT 1
VIEWPOINT 0 0 0 1 0 0 0
POINTS 2
DATA ascii
0.5 0.25 1 4210752
nan nan nan 0
"""


def test_a_world_written_and_read_is_the_same_world(tmp_path: Path) -> None:
    grid = VoxelGrid(RNG.random((5, 4, 3)) < 0.3, (0.1, 0.2, -1), 0.1)
    cloud = PointCloud(RNG.normal((5, 5, 1), 1, (100, 3)), 0.1, (0, 0, 0))
    world = World(BOUNDS, [*SOLIDS, grid])
    save_world(world, tmp_path / "one.yaml")
    assert load_world(tmp_path / "one.yaml") == world
    world = World(BOUNDS, [cloud, *SOLIDS])
    save_world(world, tmp_path / "other.yaml")
    assert load_world(tmp_path / "other.yaml") == world
    assert (tmp_path / "other-0.pcd").exists()


def test_a_world_written_by_hand_is_read_with_the_files_beside_it(tmp_path: Path) -> None:
    write_good(tmp_path)
    world = load_world(tmp_path / "world.yaml")
    assert [type(o) for o in world.obstacles] == [Box, Prism, VoxelGrid, PointCloud]
    assert isinstance(world.obstacles[3], PointCloud)
    np.testing.assert_allclose(world.obstacles[3].points, [[0.5, 0.25, 1]])
    assert world.obstacles[3].resolution == 0.2


@pytest.mark.parametrize(
    "words", ["1 2 3 1 0 0 0", "0 0 1.5 1 0 0 0", "0 0 0 0.707 0 0 0.707", "0 0 0 1", "0 0 0 nan 0 0 0", "here", ""]
)
def test_a_cloud_told_from_a_sensor_somewhere_else_is_refused_with_what_to_do(tmp_path: Path, words: str) -> None:
    (tmp_path / "scan.pcd").write_text(PCD.replace("VIEWPOINT 0 0 0 1 0 0 0", f"VIEWPOINT {words}"))
    with pytest.raises(WorldFileError, match=r"VIEWPOINT: found .*, expected 0 0 0 1 0 0 0") as caught:
        read_pcd(tmp_path / "scan.pcd")
    assert "map's frame" in str(caught.value)


@pytest.mark.parametrize("line", ["VIEWPOINT 0 0 0 -1 0 0 0\n", "VIEWPOINT 0.0 0.0 0.0 1.0 0.0 0.0 0.0\n", ""])
def test_a_cloud_told_from_the_origin_is_read(tmp_path: Path, line: str) -> None:
    (tmp_path / "scan.pcd").write_text(PCD.replace("VIEWPOINT 0 0 0 1 0 0 0\n", line))
    np.testing.assert_allclose(read_pcd(tmp_path / "scan.pcd"), [[0.5, 0.25, 1]])


def write_good(folder: Path) -> None:
    (folder / "world.yaml").write_text(GOOD)
    (folder / "scan.pcd").write_text(PCD)
    np.savez(folder / "map.npz", occupied=np.ones((2, 2, 2), np.uint8), origin=[0, 0, 0.0], resolution=0.2)


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("bounds:", "bound:", "world: found the key 'bound', expected only bounds, obstacles"),
        ("lower: [0, 0, 0], ", "", "world.bounds.lower: found nothing, expected a value"),
        ("[0, 0, 0]", "[0, 0]", "world.bounds.lower: found a list of 2, expected a list of 3 numbers"),
        ("[0, 0, 0]", "[0, 0, no]", "world.bounds.lower.2: found False, expected a finite number"),
        ("[0, 0, 0]", "[0, 0, .nan]", "world.bounds.lower.2: found nan, expected a finite number"),
        ("[0, 0, 0]", "[30, 0, 0]", "world: found bounds: expected low < high"),
        ("box:", "cone:", "world.obstacles.0: found the key 'cone', expected only box, cylinder"),
        ("- box: {lower: [9, 6, 0], upper: [10, 15, 4]}", "- box", "obstacles.0: found 'box', expected a mapping with"),
        ("- box: {lower: [9, 6, 0], upper: [10, 15, 4]}", "- {}", "found a mapping with no keys, expected exactly one"),
        ("[10, 15, 4]", "[8, 15, 4]", "world.obstacles.0.box: found box: expected lower < upper"),
        ("[13, 6]", "[13, 3]", "world.obstacles.1.prism: found prism: expected edges that do not meet"),
        ("map.npz", "gone.npz", "gone.npz: file: found No such file or directory, expected a file that can be read"),
        ("scan.pcd", "scan.ply", "scan.ply: file: found suffix '.ply', expected .pcd or .npz"),
        ("0.2}", "-1}", "world.obstacles.3.cloud: found cloud resolution: expected a finite number above 0, found -1"),
        ("0.2}", "0.3}", "world: found obstacles 2 and 3: expected voxels of one size, found 0.2 m and 0.3 m"),
        ("obstacles:", "obstacles: &a [*a]\nmore:", "line 2: an alias (*name), expected YAML, no aliases in it"),
        ("obstacles:", "bounds: 3\nobstacles:", "file: found line 2: bounds twice"),
        ("bounds:", "\tbounds:", "expected YAML"),
        (GOOD, "", "world: found None, expected a mapping with bounds, obstacles"),
        (GOOD, "!!python/object/apply:os.system [ls]", "expected YAML"),
    ],
)
def test_a_world_that_is_none_is_said_in_one_line(tmp_path: Path, old: str, new: str, line: str) -> None:
    write_good(tmp_path)
    assert old in GOOD
    (tmp_path / "world.yaml").write_text(GOOD.replace(old, new, 1))
    with pytest.raises(WorldFileError) as caught:
        load_world(tmp_path / "world.yaml")
    assert line in str(caught.value)
    assert str(tmp_path) in str(caught.value)
    assert "\n" not in str(caught.value)
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)


def test_files_that_are_too_large_or_not_there_are_refused(tmp_path: Path) -> None:
    with pytest.raises(WorldFileError, match="No such file"):
        load_world(tmp_path / "world.yaml")
    (tmp_path / "world.yaml").write_bytes(b" " * 10_000_001)
    with pytest.raises(WorldFileError, match="more than 10000000 bytes"):
        load_world(tmp_path / "world.yaml")


def test_ascii_and_binary_clouds_agree_whatever_other_fields_there_are(tmp_path: Path) -> None:
    points = RNG.normal(size=(50, 3)).astype(np.float32)
    head = "VERSION 0.7\nFIELDS intensity x normal y z\nSIZE 2 4 4 4 8\nTYPE U F F F F\nCOUNT 1 1 3 1 1\n"
    head += "WIDTH 10\nHEIGHT 5\n"
    body = b"".join(struct.pack("<Hf3ffd", i, p[0], 7.0, 8.0, 9.0, p[1], float(p[2])) for i, p in enumerate(points))
    (tmp_path / "binary.pcd").write_bytes(head.encode() + b"POINTS 50\nDATA binary\n" + body)
    rows = "\n".join(f"{i} {float(p[0])!r} 7 8 9 {float(p[1])!r} {float(p[2])!r}" for i, p in enumerate(points))
    (tmp_path / "ascii.pcd").write_text(f"{head}POINTS 50\nDATA ascii\n{rows}\n")
    np.testing.assert_array_equal(read_pcd(tmp_path / "binary.pcd"), points)
    np.testing.assert_array_equal(read_pcd(tmp_path / "ascii.pcd"), points)
    write_pcd(tmp_path / "own.pcd", points.astype(np.float64))
    np.testing.assert_array_equal(read_points(tmp_path / "own.pcd")[0], points)
    write_pcd(tmp_path / "none.pcd", np.empty((0, 3)))
    assert read_pcd(tmp_path / "none.pcd").shape == (0, 3)


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("DATA ascii", "DATA binary_compressed", "DATA: found binary_compressed, expected ascii or binary"),
        ("VERSION .7", "VERSION 1.0", "VERSION: found 1.0, expected 0.7"),
        ("VERSION .7", "ply", "first line: found 'ply', expected VERSION"),
        ("FIELDS x y z rgb", "FIELDS x y w rgb", "FIELDS: found x y w rgb, expected z once, with COUNT 1"),
        ("FIELDS x y z rgb", "FIELDS x y", "FIELDS: found 2 of them"),
        ("SIZE 4 4 4 4", "SIZE 4 4 4", "SIZE: found 3 values, expected 4, as many as FIELDS"),
        ("SIZE 4 4 4 4", "SIZE 4 4 2 4", "SIZE and TYPE of z: found 2 F"),
        ("SIZE 4 4 4 4\n", "", "SIZE: found nothing, expected a line of the header"),
        ("COUNT 1 1 1 1", "COUNT 1 1 1 999999999", "COUNT: found 999999999, expected a whole number of 1 to 4096"),
        ("WIDTH 2", "WIDTH 99999999999", "WIDTH: found 99999999999, expected a whole number of 0 to 20000000"),
        ("WIDTH 2", "WIDTH 2\nWIDTH 2", "WIDTH: found it twice, expected it once"),
        ("HEIGHT 1", "HEIGHT -1", "HEIGHT: found -1"),
        ("HEIGHT 1", "HEIGHT 20000000", "WIDTH and HEIGHT: found 2 and 20000000, expected at most 20000000 points"),
        ("POINTS 2", "POINTS 3", "POINTS: found 3, expected 2, which is WIDTH times HEIGHT"),
        ("WIDTH 2\nHEIGHT 1", "WIDTH 3\nHEIGHT 1", "POINTS: found 2, expected 3"),
        ("nan nan nan 0\n", "", "DATA: found 1 rows of 4, expected 2 rows of 4 numbers"),
        ("nan nan nan 0", "nan nan 0", "DATA: found"),
        ("nan nan nan 0", "what is this now", "DATA: found"),
        ("DATA ascii\n", "", "expected one within the first 8192 bytes"),
    ],
)
def test_a_cloud_that_is_none_is_said_in_one_line(tmp_path: Path, old: str, new: str, line: str) -> None:
    assert old in PCD
    (tmp_path / "scan.pcd").write_text(PCD.replace(old, new, 1))
    with pytest.raises(WorldFileError) as caught:
        read_pcd(tmp_path / "scan.pcd")
    assert line in str(caught.value)
    assert str(caught.value).startswith(f"{tmp_path / 'scan.pcd'}: ")
    assert "\n" not in str(caught.value)


def test_a_binary_cloud_that_ends_early_is_refused(tmp_path: Path) -> None:
    write_pcd(tmp_path / "scan.pcd", RNG.normal(size=(10, 3)))
    (tmp_path / "scan.pcd").write_bytes((tmp_path / "scan.pcd").read_bytes()[:-1])
    with pytest.raises(WorldFileError, match="DATA: found 239 bytes, expected 240: 10 points of 24"):
        read_pcd(tmp_path / "scan.pcd")


@pytest.mark.parametrize(
    ("arrays", "line"),
    [
        ({"origin": [0, 0, 0], "resolution": 0.1}, "occupied: found no such array"),
        ({"occupied": np.ones((2, 2)), "origin": [0, 0, 0], "resolution": 0.1}, "occupied: found float64 (2, 2)"),
        (
            {"occupied": np.full((2, 2, 2), 7), "origin": [0, 0, 0], "resolution": 0.1},
            "occupied: found numbers up to 7",
        ),
        ({"occupied": np.ones((2, 2, 2), bool), "origin": [0, 0], "resolution": 0.1}, "voxels origin: expected three"),
        ({"occupied": np.ones((2, 2, 2), bool), "origin": [0, 0, 0], "resolution": [0.1]}, "resolution: found float64"),
        ({"occupied": np.ones((2, 2, 2), bool), "origin": [0, 0, 0], "resolution": 0.0}, "voxels resolution"),
        ({"occupied": np.array([[[{}]]]), "origin": [0, 0, 0], "resolution": 0.1}, "occupied: found object (1, 1, 1)"),
    ],
)
def test_a_grid_that_is_none_is_said_in_one_line(tmp_path: Path, arrays: dict[str, object], line: str) -> None:
    np.savez(tmp_path / "map.npz", **arrays)  # type: ignore[arg-type]
    with pytest.raises(WorldFileError) as caught:
        read_voxels(tmp_path / "map.npz")
    assert line in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_grid_that_claims_to_be_huge_is_refused_before_it_is_unpacked(tmp_path: Path) -> None:
    huge = np.lib.stride_tricks.as_strided(np.zeros(1, bool), (10_000, 10_000, 10), (0, 0, 0))
    with zipfile.ZipFile(tmp_path / "map.npz", "w") as archive, archive.open("occupied.npy", "w") as member:
        np.lib.format.write_array_header_1_0(member, np.lib.format.header_data_from_array_1_0(huge))
    with pytest.raises(WorldFileError, match=r"occupied: found bool \(10000, 10000, 10\)"):
        read_voxels(tmp_path / "map.npz")


def test_an_npz_that_is_damaged_is_refused(tmp_path: Path) -> None:
    np.savez_compressed(tmp_path / "map.npz", occupied=RNG.random((9, 9, 9)) < 0.5, origin=[0, 0, 0], resolution=0.1)
    whole = (tmp_path / "map.npz").read_bytes()
    for cut in (b"", whole[:40], whole[: len(whole) // 2], whole[:60] + b"\xff" * 40 + whole[100:]):
        (tmp_path / "map.npz").write_bytes(cut)
        with pytest.raises(WorldFileError, match=r"map\.npz"):
            read_voxels(tmp_path / "map.npz")


def test_a_cloud_in_an_npz_brings_its_own_resolution(tmp_path: Path) -> None:
    points = np.array([[0.5, 0.5, 0.5], [np.nan, 0, 0]])
    np.savez(tmp_path / "scan.npz", points=points, resolution=0.25)
    (tmp_path / "world.yaml").write_text(
        "bounds: {lower: [0, 0, 0], upper: [1, 1, 1]}\nobstacles:\n  - cloud: {file: scan.npz}\n"
    )
    cloud = load_world(tmp_path / "world.yaml").obstacles[0]
    assert cloud == PointCloud(points[:1], 0.25)
