"""Fig. 6: what the printed gains do in a steady wind, beside our presets.

The paper says nothing of the loop or the units of its five gains; we take them for the velocity loops, where all five
have a meaning that flies (`fakevehicle.control.gains.PAPER_GAINS`). The vehicle climbs and holds its place; the offset
is that of the truth from the place asked for, with estimator and default sensors in the loop.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from companion.testing.flight import fly
from companion.testing.spec import FlightSpec
from fakevehicle.control.gains import PRESETS

WIND = 8.0
"""From the south, steady [m/s]."""
MISSION = """\
name: hold
vehicle:
  start: {{north: 10, east: 10}}
world:
  bounds: {{north: [0, 20], east: [0, 20], altitude: [0, 8]}}
steps:
  - takeoff: {{altitude: 3}}
  - hold: {{seconds: {seconds:g}}}
  - land
"""


@dataclass(frozen=True, slots=True)
class Hold:
    """One flight with one set of gains."""

    gains: str
    seed: int
    seconds: float


def hold(item: Hold) -> dict[str, Any]:
    """Fly it; the offset over the last half of the hold, when whatever fades has had its time."""
    spec = FlightSpec(
        MISSION.format(seconds=item.seconds).encode(),
        seed=item.seed,
        wind=(WIND, 0.0, 0.0),
        parameters=tuple(PRESETS[item.gains].items()),
    )
    result = fly(spec)
    track = None if result.verdict is None else result.verdict.track
    row: dict[str, Any] = {"gains": item.gains, "seed": item.seed, "ok": result.ok, "cause": result.cause}
    if track is None or not len(track.error):
        return row | {"offset_m": None, "largest_m": None}
    settled = track.error[len(track.error) // 2 :]
    return row | {"offset_m": float(np.median(settled)), "largest_m": float(track.error.max())}


def items(flights: int, seconds: float) -> list[Hold]:
    """Every preset, with the same seeds."""
    return [Hold(gains, seed, seconds) for gains in PRESETS for seed in range(1, flights + 1)]


def by_gains(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """One row a preset."""
    made = []
    for gains in PRESETS:
        mine = [row for row in rows if row["gains"] == gains and row["offset_m"] is not None]
        made.append(
            {
                "gains": gains,
                "flights": sum(row["gains"] == gains for row in rows),
                "ok": sum(row["ok"] for row in mine),
                "offset_m": float(np.median([row["offset_m"] for row in mine])) if mine else None,
                "largest_m": max((row["largest_m"] for row in mine), default=None),
            }
        )
    return made
