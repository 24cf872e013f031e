"""A scripted flight of a mission with `vehicles`: all of them in one lockstep, one result."""

import time

from companion.fleet.missions import split
from companion.testing.many import ManyResult, fly_many
from companion.testing.spec import AIRFRAME, FlightResult, FlightSpec

ALONE = ("wind", "gusts", "faults", "parameters", "link", "reboot_s")
"""What can be asked for of one vehicle only, as an airframe can."""


def fly_together(spec: FlightSpec, data: bytes) -> FlightResult:
    """Fly every vehicle of a mission file.

    Raises
    ------
    MissionError : it is none.
    ValueError : the spec asks for what is there for one vehicle only.
    """
    asked = [name for name in ALONE if getattr(spec, name)]
    asked += ["airframe"] if spec.airframe != AIRFRAME else []
    if asked:
        raise ValueError(f"{asked[0]}: found with a mission of several vehicles, expected with one vehicle only")
    parts, cpu = split(data, spec.file), time.process_time()
    result = fly_many(parts, spec.seed, spec.autopilot, record=spec.record, limit_s=spec.limit_s)
    least = parts[0].mission.vehicle.radius + max(part.mission.vehicle.radius for part in parts[1:] or parts)
    cause = _cause(result, [part.name for part in parts], least)
    clearances = [v.min_clearance_m for v in result.verdicts if v.min_clearance_m is not None]
    worst = next((v for v in result.verdicts if not v.ok), result.verdicts[0])
    return FlightResult(
        spec=spec,
        ok=not cause,
        cause=cause,
        phase=worst.phase,
        failure=worst.failure,
        verdict=worst,
        min_clearance_m=min([result.separation_m - least, *clearances]),
        simulated_s=result.simulated_s,
        cpu_s=time.process_time() - cpu,
        recording=spec.record,
    )


def _cause(result: ManyResult, names: list[str], least: float) -> str:
    """Two that touched, or the first that did not end as its part expects."""
    if result.separation_m < least:
        a, b, at_s = result.nearest
        return f"{names[a - 1]} and {names[b - 1]} touched at {at_s:.2f} s"
    for name, verdict in zip(names, result.verdicts, strict=True):
        if not verdict.ok:
            expected = verdict.failed_expectations[0] if verdict.failed_expectations else f"ended {verdict.phase}"
            return f"{name}: {verdict.failure or expected}"
    return ""
