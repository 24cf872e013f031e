"""Parameters as the vehicle told them, what changed on the way, and in what they differ from another recording's."""

import json
import struct
from collections.abc import Mapping

import numpy as np

from logs.report import contract as c
from logs.report.flight import Flight
from logs.report.part import Part, TableRows
from wire.dialect import mavlink

Values = dict[str, float]
_INTEGERS = {1: "B", 2: "b", 3: "H", 4: "h", 5: "I", 6: "i"}
"""MAV_PARAM_TYPE of what PX4 packs into the float's four bytes."""


def parameters_of(flight: Flight, metadata: Mapping[str, Mapping[str, str]]) -> tuple[Values, TableRows]:
    """Name and last value of each, and (time [s], name, before, after) of what changed on the way.

    Of a bundled vehicle's own recording those of its metadata come first: what is not its default.
    """
    values: Values = {}
    try:
        told = json.loads(metadata.get("vehicle", {}).get("parameters", "{}"))
        values.update({str(name): float(value) for name, value in told.items()})
    except (ValueError, TypeError, AttributeError):
        pass
    changed: TableRows = []
    rows = flight.traffic.told(22)
    beats = flight.traffic.told(0)
    packed = len(beats) > 0 and beats["m"]["autopilot"][0] == mavlink.MAV_AUTOPILOT_PX4
    told_here: set[str] = set()
    for t, m in zip(flight.times(rows), rows["m"], strict=True):
        name = m["param_id"].decode("ascii", "replace")
        value = _value(m, packed)
        if name == "_HASH_CHECK":
            continue
        if name in told_here and values[name] != value and len(changed) < 1000:
            changed.append([round(float(t), 2), name, values[name], value])
        values[name] = value
        told_here.add(name)
    return values, changed


def _value(m: np.void, packed: bool) -> float:
    kind = int(m["param_type"])
    if packed and kind in _INTEGERS:
        return float(struct.unpack_from("<" + _INTEGERS[kind], np.float32(m["param_value"]).tobytes())[0])
    return float(f"{float(m['param_value']):.7g}")


def parameters_part(values: Values, changed: TableRows, other: tuple[str, Values] | None) -> Part:
    """Tables: changed on the way, differing from another recording, all."""
    part = Part()
    if changed:
        heads = ("at [s]", "name", "before", "after")
        part.tables.append(c.Table("parameters", "Changed on the way", heads, changed))
    if other is not None:
        name, others = other
        rows: TableRows = [[n, values.get(n), others.get(n)] for n in sorted(values.keys() | others.keys())]
        differing = [entry for entry in rows if entry[1] != entry[2]]
        title = f"Different from {name}" if differing else f"Nothing differs from {name}"
        part.tables.append(c.Table("parameters", title, ("name", "here", "there"), differing))
    if values:
        every: TableRows = [[name, value] for name, value in sorted(values.items())]
        part.tables.append(c.Table("parameters", f"All {len(every)} told", ("name", "value"), every))
    if part.empty:
        part.missing = "no parameter was told"
    return part
