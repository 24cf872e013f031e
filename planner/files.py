"""Worlds in files: YAML for bounds and obstacles, `.npz` and `.pcd` beside it for voxels and clouds.

    bounds: {lower: [0, 0, 0], upper: [20, 20, 4]}
    obstacles:
      - box: {lower: [9, 6, 0], upper: [10, 15, 4]}
      - cylinder: {centre: [5, 5], radius: 0.4, z: [0, 4]}
      - sphere: {centre: [3, 4, 2], radius: 0.5}
      - prism: {corners: [[12, 3], [14, 3], [13, 6]], z: [0, 4]}
      - voxels: {file: map.npz}                       arrays occupied (nx, ny, nz), origin (3,), resolution
      - cloud: {file: scan.pcd, resolution: 0.1}      or an .npz with points (n, 3)

Metres, in the world's own frame. A cloud's `resolution` and `origin` stand in the YAML, else in its .npz; the default
is DEFAULT_RESOLUTION at the frame's origin. Files are looked for beside the YAML. Nothing in a file is executed: YAML
is read safely and without aliases, arrays without pickles.
"""

import math
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray

from planner.errors import WorldFileError
from planner.pcd import MOST_FILE_BYTES, read_pcd, write_pcd
from planner.voxels import MOST_POINTS, MOST_VOXELS, PointCloud, VoxelGrid
from planner.worlds import Box, Cylinder, Obstacle, Prism, Sphere, World

MOST_YAML_BYTES = 10_000_000
MOST_OBSTACLES = 100_000
DEFAULT_RESOLUTION = 0.1
"""Edge of a cloud's voxels where nothing says it [m]."""
Array = NDArray[Any]


def load_world(path: str | Path) -> World:
    """The world that a YAML file describes.

    Raises
    ------
    WorldFileError : the file or one that it names cannot be read or does not say what it must; the message is one line:
        file, field, found, expected.
    """
    file = str(path)
    try:
        with Path(path).open("rb") as stream:
            data = stream.read(MOST_YAML_BYTES + 1)
    except OSError as error:
        raise WorldFileError(file, "file", error.strerror or str(error), "a file that can be read") from error
    if len(data) > MOST_YAML_BYTES:
        raise WorldFileError(file, "file", f"more than {MOST_YAML_BYTES} bytes", "fewer")
    try:
        document = yaml.load(data, Loader=_Loader)  # a SafeLoader
    except (yaml.YAMLError, UnicodeDecodeError, RecursionError, ValueError) as error:
        raise WorldFileError(file, "file", " ".join(str(error).split())[:160], "YAML, no aliases in it") from error
    top = _Entry(file, "world", document).mapping(required=("bounds",), optional=("obstacles",))
    bounds = top["bounds"].mapping(required=("lower", "upper"))
    listed = top["obstacles"].sequence(most=MOST_OBSTACLES) if "obstacles" in top else []
    obstacles = [_obstacle(entry, Path(path).parent) for entry in listed]
    try:
        return World((bounds["lower"].numbers(3), bounds["upper"].numbers(3)), obstacles)  # type: ignore[arg-type]
    except ValueError as error:
        raise WorldFileError(file, "world", str(error), "a world") from error


def save_world(world: World, path: str | Path) -> None:
    """Write a world as YAML that `load_world` reads to an equal one; voxels and clouds go into files beside it.

    Those are named after the YAML file and the obstacle's number: world-3.npz, world-4.pcd. OSError if one cannot be
    written.
    """
    path = Path(path)
    obstacles: list[dict[str, Any]] = []
    for index, o in enumerate(world.obstacles):
        match o:
            case Box():
                obstacles.append({"box": {"lower": list(o.lower), "upper": list(o.upper)}})
            case Cylinder():
                obstacles.append({"cylinder": {"centre": list(o.centre), "radius": o.radius, "z": list(o.z)}})
            case Sphere():
                obstacles.append({"sphere": {"centre": list(o.centre), "radius": o.radius}})
            case Prism():
                obstacles.append({"prism": {"corners": [list(corner) for corner in o.corners], "z": list(o.z)}})
            case VoxelGrid():
                beside = path.with_name(f"{path.stem}-{index}.npz")
                np.savez_compressed(
                    beside, occupied=o.occupied, origin=np.array(o.origin), resolution=np.array(o.resolution)
                )
                obstacles.append({"voxels": {"file": beside.name}})
            case PointCloud():
                beside = path.with_name(f"{path.stem}-{index}.pcd")
                write_pcd(beside, o.points)
                entry = {"file": beside.name, "resolution": o.resolution, "origin": list(o.origin)}
                obstacles.append({"cloud": entry})
    low, high = world.bounds
    document = {"bounds": {"lower": list(low), "upper": list(high)}, "obstacles": obstacles}
    path.write_text(yaml.safe_dump(document, sort_keys=False, default_flow_style=None, width=120), encoding="utf-8")


def read_voxels(path: str | Path) -> VoxelGrid:
    """The grid in an .npz file: occupied (nx, ny, nz) bool or whole numbers of 0 and 1, origin (3,), resolution.

    Raises
    ------
    WorldFileError : as `load_world`.
    """
    file = str(path)
    found = _arrays(path, {"occupied": ("bui", 3, MOST_VOXELS), "origin": ("fiu", 1, 3), "resolution": ("fiu", 0, 1)})
    occupied = found["occupied"]
    if occupied.dtype != np.bool_:
        if occupied.size and (occupied.min() < 0 or occupied.max() > 1):
            raise WorldFileError(file, "occupied", f"numbers up to {occupied.max()}", "0 and 1")
        occupied = occupied.astype(np.bool_)
    try:
        return VoxelGrid(occupied, tuple(found["origin"].tolist()), float(found["resolution"]))
    except ValueError as error:
        raise WorldFileError(file, "voxels", str(error), "a grid") from error


def read_points(path: str | Path) -> tuple[Array, float | None, tuple[float, ...] | None]:
    """Points (n, 3), and resolution [m] and origin (3,) where the file says them, of a .pcd or .npz file.

    Raises
    ------
    WorldFileError : as `load_world`.
    """
    match Path(path).suffix.lower():
        case ".pcd":
            return read_pcd(path), None, None
        case ".npz":
            wanted = {"points": ("fiu", 2, 3 * MOST_POINTS), "resolution": ("fiu", 0, 1), "origin": ("fiu", 1, 3)}
            found = _arrays(path, wanted, optional=("resolution", "origin"))
            if found["points"].shape[1] != 3:
                raise WorldFileError(str(path), "points", f"an array {found['points'].shape}", "one (n, 3)")
            points = np.asarray(found["points"], dtype=np.float64)
            resolution = float(found["resolution"]) if "resolution" in found else None
            origin = tuple(found["origin"].tolist()) if "origin" in found else None
            return points[~np.isnan(points).any(axis=1)], resolution, origin
        case other:
            raise WorldFileError(str(path), "file", f"suffix {other!r}", ".pcd or .npz")


def _obstacle(entry: "_Entry", beside: Path) -> Obstacle:
    shapes = entry.mapping(optional=("box", "cylinder", "sphere", "prism", "voxels", "cloud"))
    if len(shapes) != 1:
        raise entry.wrong("exactly one of box, cylinder, sphere, prism, voxels, cloud")
    kind, shape = next(iter(shapes.items()))
    if kind == "voxels":
        return read_voxels(beside / shape.mapping(required=("file",))["file"].text())
    if kind == "cloud":
        keys = shape.mapping(required=("file",), optional=("resolution", "origin"))
        points, resolution, origin = read_points(beside / keys["file"].text())
        if "resolution" in keys:
            resolution = keys["resolution"].number()
        if "origin" in keys:
            origin = keys["origin"].numbers(3)
        size = DEFAULT_RESOLUTION if resolution is None else resolution
        return shape.built(lambda: PointCloud(points, size, origin or (0.0, 0.0, 0.0)))  # type: ignore[arg-type]
    if kind == "prism":
        keys = shape.mapping(required=("corners", "z"))
        corners = [corner.numbers(2) for corner in keys["corners"].sequence(most=MOST_OBSTACLES)]
        return shape.built(lambda: Prism(corners, keys["z"].numbers(2)))  # type: ignore[arg-type]
    if kind == "box":
        keys = shape.mapping(required=("lower", "upper"))
        return shape.built(lambda: Box(keys["lower"].numbers(3), keys["upper"].numbers(3)))  # type: ignore[arg-type]
    if kind == "cylinder":
        keys = shape.mapping(required=("centre", "radius", "z"))
        centre, radius, z = keys["centre"].numbers(2), keys["radius"].number(), keys["z"].numbers(2)
        return shape.built(lambda: Cylinder(centre, radius, z))  # type: ignore[arg-type]
    keys = shape.mapping(required=("centre", "radius"))
    return shape.built(lambda: Sphere(keys["centre"].numbers(3), keys["radius"].number()))  # type: ignore[arg-type]


class _Entry:
    """A value of a YAML file that knows where it stands."""

    def __init__(self, file: str, where: str, value: Any) -> None:
        self.file, self.where, self.value = file, where, value

    def wrong(self, expected: str) -> WorldFileError:
        value = self.value
        if isinstance(value, dict):
            found = "a mapping with " + (", ".join(str(key)[:20] for key in list(value)[:6]) or "no keys")
        else:
            found = f"a list of {len(value)}" if isinstance(value, list) else repr(value)[:60]
        return WorldFileError(self.file, self.where, found, expected)

    def mapping(self, required: tuple[str, ...] = (), optional: tuple[str, ...] = ()) -> "dict[str, _Entry]":
        known = ", ".join((*required, *optional))
        if not isinstance(self.value, dict):
            raise self.wrong(f"a mapping with {known}")
        for key in self.value:
            if key not in required and key not in optional:
                raise WorldFileError(self.file, self.where, f"the key {str(key)[:40]!r}", f"only {known}")
        for key in required:
            if key not in self.value:
                raise WorldFileError(self.file, f"{self.where}.{key}", "nothing", "a value")
        return {key: _Entry(self.file, f"{self.where}.{key}", value) for key, value in self.value.items()}

    def sequence(self, most: int) -> "list[_Entry]":
        if not isinstance(self.value, list) or len(self.value) > most:
            raise self.wrong(f"a list of at most {most}")
        return [_Entry(self.file, f"{self.where}.{i}", value) for i, value in enumerate(self.value)]

    def number(self) -> float:
        if isinstance(self.value, bool) or not isinstance(self.value, int | float) or not math.isfinite(self.value):
            raise self.wrong("a finite number")
        return float(self.value)

    def numbers(self, count: int) -> tuple[float, ...]:
        if not isinstance(self.value, list) or len(self.value) != count:
            raise self.wrong(f"a list of {count} numbers")
        return tuple(entry.number() for entry in self.sequence(count))

    def text(self) -> str:
        if not isinstance(self.value, str) or not self.value or "\0" in self.value:
            raise self.wrong("the name of a file")
        return self.value

    def built(self, build: Callable[[], Obstacle]) -> Obstacle:
        try:
            return build()
        except ValueError as error:
            raise WorldFileError(self.file, self.where, str(error), "an obstacle that can be") from error


class _Loader(yaml.SafeLoader):
    """Safe, and without aliases (a few bytes of them can stand for any amount) and repeated keys."""

    def compose_node(self, parent: Any, index: Any) -> Any:
        if self.check_event(yaml.AliasEvent):
            event: Any = self.peek_event()  # type: ignore[no-untyped-call]
            raise yaml.YAMLError(f"line {event.start_mark.line + 1}: an alias (*name)")
        return super().compose_node(parent, index)

    def construct_mapping(self, node: Any, deep: bool = False) -> Any:
        seen = set()
        for key, _ in node.value:
            if key.value in seen:
                raise yaml.YAMLError(f"line {key.start_mark.line + 1}: {str(key.value)[:40]} twice")
            seen.add(key.value if isinstance(key.value, str) else None)
        return super().construct_mapping(node, deep)


def _arrays(
    path: str | Path, wanted: dict[str, tuple[str, int, int]], optional: tuple[str, ...] = ()
) -> dict[str, Array]:
    """Arrays of an .npz file by name: (kinds of number, dimensions, most elements), checked before they are read."""
    file, found = str(path), {}
    try:
        if Path(path).stat().st_size > MOST_FILE_BYTES:
            raise WorldFileError(file, "file", f"more than {MOST_FILE_BYTES} bytes", "fewer")
        with zipfile.ZipFile(path) as archive:
            names = set(archive.namelist())
            for name, (kinds, dimensions, most) in wanted.items():
                if f"{name}.npy" not in names:
                    if name in optional:
                        continue
                    raise WorldFileError(file, name, "no such array", f"one among {', '.join(wanted)}")
                with archive.open(f"{name}.npy") as member:
                    version = np.lib.format.read_magic(member)
                    read = (
                        np.lib.format.read_array_header_1_0
                        if version == (1, 0)
                        else np.lib.format.read_array_header_2_0
                    )
                    shape, _, kind = read(member)
                if kind.kind not in kinds or len(shape) != dimensions or math.prod(shape) > most:
                    expected = f"{dimensions} dimensions and at most {most} elements of kind {' or '.join(kinds)}"
                    raise WorldFileError(file, name, f"{kind} {shape}", expected)
                with archive.open(f"{name}.npy") as member:
                    found[name] = np.lib.format.read_array(member, allow_pickle=False)
    except OSError as error:
        raise WorldFileError(file, "file", error.strerror or str(error), "a file that can be read") from error
    except (zipfile.BadZipFile, zlib.error, ValueError, EOFError, RuntimeError) as error:  # Runtime: encrypted
        raise WorldFileError(file, "file", " ".join(str(error).split())[:120], "an .npz that is whole") from error
    return found
