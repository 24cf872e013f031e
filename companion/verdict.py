"""How the flight went: what `FlightMeter` measured, held against the mission's `expect`, as one table, `Verdict`."""

import math
from dataclasses import dataclass, field

from companion.core import Companion
from companion.meter import FlightMeter, Track, least_clearance
from companion.mission import Expect, Mission
from companion.phases import Phase

__all__ = ["Check", "FlightMeter", "Track", "Verdict", "checks", "failed_expectations", "judge", "least_clearance"]


@dataclass(frozen=True, slots=True)
class Verdict:
    """The flight in numbers, and whether that is what the mission expects. None: not known."""

    ok: bool
    mission: str
    seed: int
    phase: str
    failure: str
    failed_expectations: list[str]
    duration_s: float
    path_length_m: float | None
    tracking_error_p50_m: float | None
    tracking_error_p95_m: float | None
    tracking_error_max_m: float | None
    tracking_error_source: str | None  # "truth" or "estimate"
    estimate_error_p50_m: float | None
    estimate_error_p95_m: float | None
    estimate_error_max_m: float | None
    min_clearance_m: float | None
    setpoint_rate_hz: float | None
    setpoint_gap_p99_ms: float | None
    setpoint_gap_max_ms: float | None
    track: Track | None = field(repr=False)


def judge(companion: Companion, meter: FlightMeter, beside_m: float | None = None) -> Verdict:
    """Measure a flight and hold it against `mission.expect`.

    Parameters
    ----------
    beside_m : least clearance to what appears and moves, from somebody who sees it [m]; None: nobody does.
    """
    mission = companion.mission
    truth, estimate = meter.truth_track(), meter.estimate_track()
    track = truth if truth is not None else estimate
    flown, believed = _three(track), _three(estimate)
    gap_p99, gap_max, gap_mean = meter.setpoint_gap_ms() or (None, None, None)
    beside = _least(mission, track) if track else None
    numbers: dict[str, float | None] = {
        "tracking_error_p95_m": flown[1],
        "min_clearance_m": min((m for m in (beside, beside_m) if m is not None), default=None),
        "duration_max_s": meter.duration_s,
        "setpoint_gap_p99_ms": gap_p99,
        "setpoint_gap_max_ms": gap_max,
    }
    wanted = mission.expect.phase
    failed = failed_expectations(mission, numbers)
    if numbers["min_clearance_m"] is not None and numbers["min_clearance_m"] < 0.0:
        failed.append(f"the hull was {-numbers['min_clearance_m']:.3f} m inside an obstacle")
    if companion.phase.value != wanted and wanted != Phase.DONE.value:
        failed.insert(0, f"phase: found {companion.phase.value}, expected {wanted}")
    return Verdict(
        ok=companion.phase.value == wanted and not failed and not (companion.failure and wanted == Phase.DONE.value),
        mission=mission.name,
        seed=companion.config.seed,
        phase=companion.phase.value,
        failure=companion.failure,
        failed_expectations=failed,
        duration_s=meter.duration_s,
        path_length_m=track.length() if track else None,
        tracking_error_p50_m=flown[0],
        tracking_error_p95_m=flown[1],
        tracking_error_max_m=flown[2],
        tracking_error_source=None if track is None else "truth" if truth is not None else "estimate",
        estimate_error_p50_m=believed[0],
        estimate_error_p95_m=believed[1],
        estimate_error_max_m=believed[2],
        min_clearance_m=numbers["min_clearance_m"],
        setpoint_rate_hz=1e3 / gap_mean if gap_mean else None,
        setpoint_gap_p99_ms=numbers["setpoint_gap_p99_ms"],
        setpoint_gap_max_ms=numbers["setpoint_gap_max_ms"],
        track=track,
    )


@dataclass(frozen=True, slots=True)
class Check:
    """One expectation: its name, what was found, how it was judged (such as ``<= 0.35``), and whether it is met."""

    name: str
    value: float | str | None
    expected: str
    ok: bool


def checks(verdict: Verdict, expect: Expect) -> list[Check]:
    """Every expectation of a mission and what came of it."""
    found = [Check("phase", verdict.phase, expect.phase, verdict.phase == expect.phase)]
    for name, bound in expect.model_dump(exclude_none=True, exclude={"phase"}).items():
        value: float | None = verdict.duration_s if name == "duration_max_s" else getattr(verdict, name)
        at_least = name == "min_clearance_m"
        met = value is not None and (value >= bound if at_least else value <= bound)
        found.append(Check(name, value, f"{'>=' if at_least else '<='} {bound:g}", met))
    return found


def failed_expectations(mission: Mission, numbers: dict[str, float | None]) -> list[str]:
    """One line for each expectation that is not met: name, found, expected."""
    failed = []
    for name, bound in mission.expect.model_dump(exclude_none=True, exclude={"phase"}).items():
        value = numbers[name]
        at_least = name == "min_clearance_m"
        sign = "at least" if at_least else "at most"
        if value is None:
            failed.append(f"{name}: not measured, expected {sign} {bound:g}")
        elif value < bound if at_least else value > bound:
            failed.append(f"{name}: found {value:.3f}, expected {sign} {bound:g}")
    return failed


def _least(mission: Mission, track: Track) -> float | None:
    """Least clearance [m] of a track, kept or not."""
    kept = least_clearance(mission, track.aloft_m) if len(track.aloft_m) else None
    counted = track.counted.clearance_m
    if kept is None:
        return None if math.isinf(counted) else counted
    return min(kept, counted)


def _three(track: Track | None) -> tuple[float | None, float | None, float | None]:
    """Median, 95th percentile and maximum of the tracking error [m]."""
    if track is None:
        return None, None, None
    p50, p95 = track.percentiles([50.0, 95.0])
    return p50, p95, track.greatest()
