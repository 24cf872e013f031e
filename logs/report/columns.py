"""Columns of numbers: MAVLink payloads as structured arrays, and columns made short without losing an extreme.

A payload is a packed little-endian struct, so any number of them side by side is a NumPy array, and a field of all of
them is one slice: nothing is decoded message by message.
"""

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wire.dialect import mavlink

FloatArray = NDArray[np.float64]
Rows = NDArray[np.void]

MOST_POINTS = 45_000
"""A series on the page has at most this many."""
MOST_ROWS = 1 << 18
"""Messages of one kind that are kept, 87 minutes at 50 Hz; of more, those that hold an extreme."""
_BLOCK = 64

_TYPES = {
    "uint8_t": "u1", "uint16_t": "<u2", "uint32_t": "<u4", "uint64_t": "<u8", "int8_t": "i1", "int16_t": "<i2",
    "int32_t": "<i4", "int64_t": "<i8", "float": "<f4", "double": "<f8",
}  # fmt: skip


@cache
def payload_type(message_id: int) -> np.dtype[np.void]:
    """The structured type of a message's payload, extensions and all."""
    definition = mavlink.mavlink_map[message_id]
    types = dict(zip(definition.fieldnames, definition.fieldtypes, strict=True))
    entries: list[Any] = []
    # pymavlink keeps array_lengths in wire order; fieldnames and fieldtypes in the order of the definition.
    for name, length in zip(definition.ordered_fieldnames, definition.array_lengths, strict=True):
        if types[name] == "char":
            entries.append((name, f"S{length or 1}"))
        else:
            entries.append((name, _TYPES[types[name]], (length,)) if length else (name, _TYPES[types[name]]))
    return np.dtype(entries)


class Stream:
    """All messages of one kind from one sender: when each was [ns], in which tick, and its payload."""

    def __init__(self, message_id: int) -> None:
        payload = payload_type(message_id)
        self.type = np.dtype([("t", "<i8"), ("tick", "<i8"), ("m", payload)])
        self._size = payload.itemsize
        self._data = bytearray()
        self._count = 0
        self.thinned = False

    def __len__(self) -> int:
        return self._count

    def add(self, t_ns: int, tick: int, payload: bytes) -> None:
        """Take one more; a payload cut short by MAVLink 2 is filled with zeros again."""
        if len(payload) != self._size:
            payload = payload.ljust(self._size, b"\0")[: self._size]
        self._data += t_ns.to_bytes(8, "little", signed=True) + tick.to_bytes(8, "little") + payload
        self._count += 1
        if self._count > MOST_ROWS:
            rows = self.rows()
            kept = rows[_extremes(rows)].tobytes()
            self._data, self.thinned = bytearray(kept), True
            self._count = len(kept) // self.type.itemsize

    def rows(self) -> Rows:
        """Every message kept: fields ``t``, ``tick`` and, under ``m``, the message's own."""
        return np.frombuffer(bytes(self._data), self.type)


def _extremes(rows: Rows) -> NDArray[np.intp]:
    """Of each block of rows the first, and where its first 15 numeric fields are least and greatest."""
    numbers = [rows["m"][name] for name in rows["m"].dtype.names or () if "time" not in name]
    numeric = [column for column in numbers if column.ndim == 1 and column.dtype.kind in "fiu"][:15]
    whole = len(rows) // _BLOCK * _BLOCK
    first = np.arange(0, whole, _BLOCK)
    found = [first, np.arange(whole, len(rows))]
    for column in numeric:
        blocks = column[:whole].reshape(-1, _BLOCK)
        found += [first + blocks.argmin(axis=1), first + blocks.argmax(axis=1)]
    return np.unique(np.concatenate(found))  # 31 of 64 rows at most


def short(t: FloatArray, *columns: FloatArray, most: int = MOST_POINTS) -> tuple[FloatArray, ...]:
    """Times and columns of at most about `most` points: of each stretch of time those where a column is least or most.

    Gaps (NaN) between points stay gaps.
    """
    if len(t) <= most:
        return (t, *columns)
    stretches = max(1, most // (2 * len(columns)))
    edges = np.linspace(0, len(t), stretches + 1).astype(np.intp)[:-1]
    kept = [np.array([0, len(t) - 1])]
    for column in columns:
        for worst, reduce in ((np.inf, np.minimum), (-np.inf, np.maximum)):
            filled = np.where(np.isfinite(column), column, worst)
            extreme = np.repeat(reduce.reduceat(filled, edges), np.diff([*edges, len(t)]))
            hits = np.flatnonzero(filled == extreme)
            stretch = np.searchsorted(edges, hits, side="right")
            kept.append(hits[np.unique(stretch, return_index=True)[1]])
        missing = np.flatnonzero(np.isnan(column))
        kept.append(missing[: most // 4])
    index = np.unique(np.concatenate(kept))
    return (t[index], *(column[index] for column in columns))


def with_gaps(t: FloatArray, columns: Sequence[FloatArray], gap_s: float) -> tuple[FloatArray, list[FloatArray]]:
    """A NaN put in wherever a stream paused for longer than `gap_s`, so that no line is drawn across."""
    after = np.flatnonzero(np.diff(t) > gap_s)
    if not len(after):
        return t, list(columns)
    middle = (t[after] + t[after + 1]) / 2
    return np.insert(t, after + 1, middle), [np.insert(c, after + 1, np.nan) for c in columns]


def pause_s(t: FloatArray) -> float:
    """What counts as a pause of a stream: ten times its usual spacing, and at least a second."""
    return max(1.0, 10 * float(np.median(np.diff(t)))) if len(t) > 2 else np.inf


def percentiles(values: FloatArray, wanted: Sequence[float]) -> list[float]:
    """Of the finite values; NaN where there are none."""
    finite = values[np.isfinite(values)]
    return [float(q) for q in np.percentile(finite, wanted)] if len(finite) else [np.nan] * len(wanted)
