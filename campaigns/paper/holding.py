"""Fig. 6: what the printed gains do in a steady wind, beside our presets.

The paper says nothing of the loop or the units of its five gains; we take them for the velocity loops, where all five
have a meaning that flies (`fakevehicle.control.gains.PAPER_GAINS`). The vehicle climbs and holds its place, estimator
and default sensors in the loop. The offset is how far over ground the mean place of the truth is from the one asked
for: what the sensors' noise adds has no part in a mean.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from campaigns.tuning.statistics import mean
from companion.testing.flight import fly
from companion.testing.spec import FlightSpec
from fakevehicle.control.gains import PRESETS

WIND = 8.0
"""From the south, steady [m/s]."""
PLACE = (10.0, 10.0)
"""North and east [m]."""
MISSION = f"""\
name: hold
vehicle:
  start: {{{{north: {PLACE[0]:g}, east: {PLACE[1]:g}}}}}
world:
  bounds: {{{{north: [0, 20], east: [0, 20], altitude: [0, 8]}}}}
steps:
  - takeoff: {{{{altitude: 3}}}}
  - hold: {{{{seconds: {{seconds:g}}}}}}
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
    settled = track.position_m[len(track.position_m) // 2 :, :2]
    offset = float(np.linalg.norm(settled.mean(axis=0) - PLACE))
    return row | {"offset_m": offset, "largest_m": float(track.error.max())}


def items(flights: int, seconds: float) -> list[Hold]:
    """Every preset, with the same seeds."""
    return [Hold(gains, seed, seconds) for gains in PRESETS for seed in range(1, flights + 1)]


def by_gains(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """One row a preset: the mean offset of the flights that ended well with its interval, and that of each by seed."""
    made = []
    for gains in PRESETS:
        mine = [row for row in rows if row["gains"] == gains]
        good = {row["seed"]: row["offset_m"] for row in mine if row["ok"] and row["offset_m"] is not None}
        told = mean(np.array(list(good.values())))
        made.append(
            {
                "gains": gains,
                "flights": len(mine),
                "ok": len(good),
                "offset_m": told.mean if good else None,
                "offset_half": told.half if len(good) > 1 else None,
                "offsets": {str(seed): offset for seed, offset in good.items()},
                "largest_m": max((row["largest_m"] for row in mine if row["largest_m"] is not None), default=None),
            }
        )
    return made
