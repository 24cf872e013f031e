"""Tracking with the estimator in the loop: `python -m benchmarks.bench_tracking [seeds]`.

A figure of eight of amplitudes 4 x 2 m, x = 4 sin a, y = 2 sin 2a, its speed at the crossing 3 or 5 m/s, flown for
24 s after a gentle start; calm, or in 8 m/s of wind with Dryden turbulence for that wind (MIL-F-8785C). Setpoints of
position, velocity and acceleration come every tick (4 ms), and truth is held against the setpoint of the same moment:
`campaigns.tuning.courses` has the flights (heights there are from the barometer's zero; its drift of 0.1 m is a part of
the height's error). Receivers of 0.05 m and 0.4 m (and 0.1 m/s), 112 ms late, with the estimator told of each. Every
loop law gets the same flights.
"""

import math
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from campaigns.tuning import courses
from campaigns.tuning.courses import Eight, Wind
from fakevehicle.control.gains import PRESETS
from fakevehicle.flight import PARAMETERS
from fakevehicle.params import ParameterSet

FIRST_UNSEEN = 1000
"""Seeds from here on were used by no tuning."""
WIND = 8.0


@dataclass(frozen=True)
class Case:
    """Conditions of a flight."""

    gps: float  # [m]
    speed: float  # at the crossing [m/s]
    gusts: bool


CASES = tuple(Case(gps, speed, gusts) for gps in (0.05, 0.4) for gusts in (False, True) for speed in (3.0, 5.0))


def fly(case: Case, seed: int, overrides: dict[str, float]) -> NDArray[np.float64]:
    """Errors (n, 3) [m], truth less setpoint in NED, every tick of the eight at full speed."""
    told = max(case.gps, 0.05)
    parameters = ParameterSet(
        PARAMETERS,
        {
            "SIM_GPS_P_NOISE": case.gps,
            "EKF2_GPS_P_NOISE": told,
            "SIM_GPS_V_NOISE": 0.1,
            "EKF2_GPS_V_NOISE": 0.1,
            **overrides,
        },
    )
    wind = Wind(WIND, WIND) if case.gusts else Wind()
    flown = courses.fly(Eight(case.speed), wind, seed, parameters)
    if flown.lost:
        raise SystemExit(f"{case}, seed {seed}: {flown.lost}")
    return flown.error_n


def summary(case: Case, seed: int, overrides: dict[str, float]) -> tuple[float, float, float, float]:
    """RMS of the horizontal distance, of the height error and of the distance in space, and the largest of that [m]."""
    e = fly(case, seed, overrides)
    level = (e[:, :2] ** 2).sum(axis=1)
    space = (e**2).sum(axis=1)
    return math.sqrt(level.mean()), math.sqrt((e[:, 2] ** 2).mean()), math.sqrt(space.mean()), math.sqrt(space.max())


def main() -> None:
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    laws = sys.argv[2:] or ["default", "pid"]
    print(f"RMS between truth and setpoint, mean of {seeds} unseen seeds +- 1.96 standard errors\n")
    print("| GPS m | wind | m/s | law | horizontal m | worst seed | height m | in space m | largest error m |")
    print("|---|---|---|---|---|---|---|---|---|")
    with ProcessPoolExecutor(2) as pool:
        for case in CASES:
            for law in laws:
                numbers = range(FIRST_UNSEEN, FIRST_UNSEEN + seeds)
                runs = np.array(list(pool.map(summary, [case] * seeds, numbers, [dict(PRESETS[law])] * seeds)))
                spread = 1.96 * runs[:, 0].std(ddof=1) / math.sqrt(seeds) if seeds > 1 else math.nan
                print(
                    f"| {case.gps} | {'8 m/s, gusts' if case.gusts else 'calm'} | {case.speed:g} | {law} "
                    f"| {runs[:, 0].mean():.3f} +- {spread:.3f} | {runs[:, 0].max():.3f} | {runs[:, 1].mean():.3f} "
                    f"| {runs[:, 2].mean():.3f} | {runs[:, 3].max():.2f} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
