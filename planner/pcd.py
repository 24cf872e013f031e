"""Clouds in PCD files (Point Cloud Library, version 0.7 and before), `ascii` and `binary`.

A header of lines (VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, VIEWPOINT, POINTS, DATA), then the points. Only
the fields x, y and z are read. A point with a NaN is a pixel without return and left out, as is usual. VIEWPOINT
says where the sensor was and how it was turned; the format leaves open whether the points are told from there, so any
but the identity is refused. So is `binary_compressed`, by name.
"""

import io
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from planner.errors import WorldFileError
from planner.voxels import MOST_POINTS

FloatArray = NDArray[np.float64]

HEADER_BYTES = 8192
MOST_FILE_BYTES = 2_000_000_000
VERSIONS = ("0.7", ".7", "0.6", ".6", "0.5", ".5")
SIZES = {"F": (4, 8), "I": (1, 2, 4, 8), "U": (1, 2, 4, 8)}
MOST_FIELDS, MOST_COUNT = 64, 4096
IDENTITY = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
"""Of a VIEWPOINT: where, and a quaternion w x y z."""


def read_pcd(path: str | Path) -> FloatArray:
    """The points (n, 3) of a PCD file, in its own frame and unit.

    Raises
    ------
    WorldFileError : it cannot be read, or its header or data are not what they must be: which, found, expected.
    """
    file = str(path)
    try:
        with Path(path).open("rb") as stream:
            data = stream.read(MOST_FILE_BYTES + 1)
    except OSError as error:
        raise WorldFileError(file, "file", error.strerror or str(error), "a file that can be read") from error
    if len(data) > MOST_FILE_BYTES:
        raise WorldFileError(file, "file", f"more than {MOST_FILE_BYTES} bytes", "fewer")
    header, begin = _header(file, data)
    names = header["FIELDS"]
    if not 3 <= len(names) <= MOST_FIELDS:
        raise WorldFileError(file, "FIELDS", f"{len(names)} of them", f"x y z among at most {MOST_FIELDS}")
    sizes = [_whole(file, "SIZE", v, 8) for v in _many(file, header, "SIZE", len(names))]
    kinds = _many(file, header, "TYPE", len(names))
    counts = [_whole(file, "COUNT", v, MOST_COUNT) for v in header.get("COUNT", ["1"] * len(names))]
    if len(counts) != len(names):
        raise WorldFileError(file, "COUNT", f"{len(counts)} values", f"{len(names)}, as many as FIELDS")
    for name, size, kind in zip(names, sizes, kinds, strict=True):
        if size not in SIZES.get(kind, ()):
            raise WorldFileError(
                file, f"SIZE and TYPE of {name}", f"{size} {kind}", "F of 4 or 8, I or U of 1, 2, 4, 8"
            )
    places = []
    for axis in "xyz":
        if names.count(axis) != 1 or counts[names.index(axis)] != 1:
            raise WorldFileError(file, "FIELDS", " ".join(names), f"{axis} once, with COUNT 1")
        places.append(names.index(axis))
    if "VIEWPOINT" in header:
        _no_viewpoint(file, header["VIEWPOINT"])
    total = _points(file, header)
    encoding = " ".join(header["DATA"])
    if encoding == "ascii":
        columns = [sum(counts[:place]) for place in places]
        points = _ascii(file, data[begin:], columns, sum(counts), total)
    elif encoding == "binary":
        layout = [
            (f"f{i}", f"<{k.lower()}{s}", (c,)) for i, (k, s, c) in enumerate(zip(kinds, sizes, counts, strict=True))
        ]
        record = np.dtype(layout)
        if len(data) - begin < total * record.itemsize:
            found, wanted = len(data) - begin, total * record.itemsize
            raise WorldFileError(file, "DATA", f"{found} bytes", f"{wanted}: {total} points of {record.itemsize}")
        table = np.frombuffer(data, dtype=record, count=total, offset=begin)
        points = np.stack([table[f"f{place}"][:, 0].astype(np.float64) for place in places], axis=1)
    else:
        raise WorldFileError(file, "DATA", encoding, "ascii or binary")
    kept: FloatArray = points[~np.isnan(points).any(axis=1)]
    return kept


def write_pcd(path: str | Path, points: FloatArray) -> None:
    """Write points (n, 3) as binary float64; OSError if the file cannot be written."""
    count = len(points)
    header = (
        "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n"
        f"WIDTH {count}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\nDATA binary\n"
    )
    Path(path).write_bytes(header.encode() + np.ascontiguousarray(points, dtype="<f8").tobytes())


def _header(file: str, data: bytes) -> tuple[dict[str, list[str]], int]:
    """The header's entries by their names, and where the data begin."""
    found: dict[str, list[str]] = {}
    begin = 0
    while "DATA" not in found:
        end = data.find(b"\n", begin, HEADER_BYTES)
        if end < 0:
            raise WorldFileError(file, "DATA", "no such line", f"one within the first {HEADER_BYTES} bytes")
        words = data[begin:end].decode("ascii", "replace").split("#")[0].split()
        begin = end + 1
        if not words:
            continue
        key, values = words[0], words[1:]
        if key in found:
            raise WorldFileError(file, key, "it twice", "it once")
        if "VERSION" not in found and key != "VERSION":
            raise WorldFileError(file, "first line", repr(key[:20]), "VERSION: this is no PCD file")
        found[key] = values
    if " ".join(found["VERSION"]) not in VERSIONS:
        raise WorldFileError(file, "VERSION", " ".join(found["VERSION"])[:20] or "nothing", "0.7")
    for key in ("FIELDS", "SIZE", "TYPE", "WIDTH", "HEIGHT"):
        if not found.get(key):
            raise WorldFileError(file, key, "nothing", "a line of the header")
    return found, begin


def _many(file: str, header: dict[str, list[str]], key: str, count: int) -> list[str]:
    if len(header[key]) != count:
        raise WorldFileError(file, key, f"{len(header[key])} values", f"{count}, as many as FIELDS")
    return header[key]


def _whole(file: str, key: str, text: str, most: int, least: int = 1) -> int:
    number = int(text) if text.isascii() and text.isdigit() and len(text) <= 18 else -1
    if not least <= number <= most:
        raise WorldFileError(file, key, text[:20], f"a whole number of {least} to {most}")
    return number


def _no_viewpoint(file: str, words: list[str]) -> None:
    """Refuse a sensor that was not at the origin of the points' frame, or turned in it."""
    try:
        same = tuple(float(word) for word in words) in (IDENTITY, tuple(-v for v in IDENTITY))
    except ValueError:
        same = False
    if not same:
        raise WorldFileError(
            file, "VIEWPOINT", " ".join(words)[:80] or "nothing", "0 0 0 1 0 0 0: move the points into the map's frame"
        )


def _points(file: str, header: dict[str, list[str]]) -> int:
    width = _whole(file, "WIDTH", " ".join(header["WIDTH"]), MOST_POINTS, 0)
    height = _whole(file, "HEIGHT", " ".join(header["HEIGHT"]), MOST_POINTS, 0)
    total = width * height
    if total > MOST_POINTS:
        raise WorldFileError(file, "WIDTH and HEIGHT", f"{width} and {height}", f"at most {MOST_POINTS} points")
    declared = " ".join(header.get("POINTS", [str(total)]))
    if declared != str(total):
        raise WorldFileError(file, "POINTS", declared[:20], f"{total}, which is WIDTH times HEIGHT")
    return total


def _ascii(file: str, text: bytes, columns: list[int], width: int, total: int) -> FloatArray:
    try:
        rows = (
            np.loadtxt(io.BytesIO(text), dtype=np.float64, ndmin=2, max_rows=total) if total else np.empty((0, width))
        )
    except ValueError as error:
        raise WorldFileError(file, "DATA", " ".join(str(error).split())[:100], f"rows of {width} numbers") from error
    if rows.shape != (total, width):
        raise WorldFileError(file, "DATA", f"{len(rows)} rows of {rows.shape[1]}", f"{total} rows of {width} numbers")
    return np.asarray(rows[:, columns])
