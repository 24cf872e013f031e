"""`companion simulate` of a mission with `vehicles:`: all in one lockstep; and what is told of several flights."""

import math
import time
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from companion.cli import flight_show, show
from companion.cli.operator import STOPPED, Operator
from companion.fleet.missions import Part
from companion.testing.many import ManyResult, fly_many
from fakevehicle.config import Autopilot
from logs.parts import Rotation
from planner import replan, warm_up


def simulate_many(
    parts: list[Part],
    seed: int,
    record: Path | None,
    autopilot: Autopilot,
    as_json: bool,
    rotation: Rotation | None = None,
) -> int:
    """Fly the parts of a mission; `record` is a folder. Returns the exit code.

    All is well when every flight ends as its mission expects and no two hulls have touched.
    """
    out = show.console()
    with show.working(out, "preparing kernels (compiled the first time)"):
        warm_up()
        replan.warm_up()
    operator = Operator()
    wall = time.perf_counter()
    with operator.listening(), show.working(out, f"flying {len(parts)} vehicles"):
        result = fly_many(parts, seed, autopilot, record=record, rotation=rotation, stop=lambda: operator.asked > 0)
    wall = time.perf_counter() - wall
    more = {"simulated_s": result.simulated_s, "speedup": result.simulated_s / wall}
    return tell_many(parts, result, [STOPPED] if operator.asked else [], seed, record, more, as_json)


def tell_many(
    parts: list[Part],
    result: ManyResult,
    failures: list[str],
    seed: int,
    record: Path | None,
    more: dict[str, Any],
    as_json: bool,
) -> int:
    """Print what came of flights of several; returns the exit code.

    Parameters
    ----------
    failures : what went wrong beside what the verdicts say.
    more : for the JSON object.
    """
    touching = max(2 * part.mission.vehicle.radius for part in parts)
    separation = result.separation_m if math.isfinite(result.separation_m) else None
    first, second, at_s = result.nearest
    for part, verdict in zip(parts, result.verdicts, strict=True):
        failures += [f"{part.name}: {text}" for text in (verdict.failure, *verdict.failed_expectations) if text]
    if separation is not None and separation < touching:
        names = f"{parts[first - 1].name} and {parts[second - 1].name}"
        failures.append(f"{names} came within {separation:.2f} m at {at_s:.1f} s, expected at least {touching:.2f} m")
    ok = not failures and all(verdict.ok for verdict in result.verdicts)
    if as_json:
        verdicts = [
            {"vehicle": part.name, **flight_show.verdict_json(verdict)}
            for part, verdict in zip(parts, result.verdicts, strict=True)
        ]
        show.print_json(
            {
                "ok": ok,
                "mission": parts[0].mission.name,
                "seed": seed,
                "failure": failures[0] if failures else "",
                "separation_m": separation,
                **more,
                "recording": None if record is None else str(record),
                "vehicles": verdicts,
            }
        )
        return 0 if ok else 1
    table = Table(title=f"{show.plain(parts[0].mission.name)}: {'PASS' if ok else 'FAIL'}")
    for column in ("vehicle", "phase", "flight time", "path", "error p95"):
        table.add_column(column, justify="left" if column in ("vehicle", "phase") else "right")
    for part, v in zip(parts, result.verdicts, strict=True):
        length = "-" if v.path_length_m is None else f"{v.path_length_m:.2f} m"
        error = "-" if v.tracking_error_p95_m is None else f"{v.tracking_error_p95_m:.3f} m"
        table.add_row(show.plain(part.name), v.phase, f"{v.duration_s:.1f} s", length, error)
    console = Console()
    console.print(table)
    if separation is not None:
        pair = f"{parts[first - 1].name} and {parts[second - 1].name} at {at_s:.1f} s"
        console.print(f"least separation of two centres {separation:.2f} m ({show.plain(pair)})", soft_wrap=True)
    for text in failures:
        console.print(f"[bold red]✗[/bold red] {show.plain(text)}", soft_wrap=True)
    return 0 if ok else 1
