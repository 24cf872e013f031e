"""What a person sees of a flight: a line of progress and notes while it flies, and the verdict's table at its end."""

import math
from collections.abc import Mapping
from typing import Any

from rich.console import Console
from rich.status import Status
from rich.table import Table

from companion.cli.show import plain
from companion.core import Companion
from companion.drivers.tick import Tick
from companion.mission import Expect
from companion.phases import STREAMING, Phase
from companion.seam import Level, Note
from companion.verdict import FlightMeter, Verdict

STYLES = {Level.ERROR: "bold red", Level.WARNING: "yellow", Level.INFO: "dim"}


class ProgressLine:
    """A tap: prints notes as they come and keeps one line up to date (only on a terminal)."""

    def __init__(self, companion: Companion, meter: FlightMeter, out: Console, every: int = 10) -> None:
        self._companion, self._meter, self._out, self._every = companion, meter, out, every
        self._status: Status | None = None

    def __enter__(self) -> "ProgressLine":
        if self._out.is_terminal:
            self._status = self._out.status("starting")
            self._status.start()
        return self

    def __exit__(self, *exception: object) -> None:
        if self._status is not None:
            self._status.stop()

    def __call__(self, tick: Tick) -> None:
        for output in tick.outputs:
            if isinstance(output, Note):
                time_s = f"{self._meter.duration_s:7.2f} s"
                self._out.print(f"[dim]{time_s}[/dim]  [{STYLES[output.level]}]{plain(output.text)}[/]", soft_wrap=True)
        if self._status is not None and tick.index % self._every == 0:
            self._status.update(self.line())

    def line(self) -> str:
        """Phase, step, distance to go, tracking error, setpoint rate."""
        companion, meter = self._companion, self._meter
        parts = [companion.phase.value]
        if companion.phase is Phase.FLYING:
            here = companion.telemetry.position_n - companion.origin_n
            parts.append(f"step {companion.itinerary.index} {companion.itinerary.step.kind}")
            parts.append(f"{companion.itinerary.remaining(here):5.1f} m to go")
        if companion.phase in STREAMING - {Phase.LANDING} and not math.isnan(meter.tracking_error_now):
            parts.append(f"error {meter.tracking_error_now:.2f} m")
            parts.append(f"setpoints {meter.setpoint_rate_now:.1f} Hz")
        return "  ".join(parts)


class NamedNotes:
    """A tap: prints notes as they come with the name of who says them, where several fly at once."""

    def __init__(self, name: str, meter: FlightMeter, out: Console) -> None:
        self._name, self._meter, self._out = name, meter, out

    def __enter__(self) -> "NamedNotes":
        return self

    def __exit__(self, *exception: object) -> None:
        """Nothing to give back."""

    def __call__(self, tick: Tick) -> None:
        for output in tick.outputs:
            if isinstance(output, Note):
                head = f"[dim]{self._meter.duration_s:7.2f} s[/dim]  {plain(self._name)}: "
                self._out.print(f"{head}[{STYLES[output.level]}]{plain(output.text)}[/]", soft_wrap=True)


def print_verdict(verdict: Verdict, expect: Expect, details: Mapping[str, str], out: Console) -> None:
    """The table at the end of a flight, what went wrong, and details a line each."""
    table = Table(title=f"{plain(verdict.mission)}: {'PASS' if verdict.ok else 'FAIL'}", title_style=_style(verdict.ok))
    table.add_column("measured")
    table.add_column("value", justify="right")
    table.add_column("expected", justify="right")
    clearance, gap = _bound("≥", expect.min_clearance_m, "m"), _bound("≤", expect.setpoint_gap_p99_ms, "ms")
    estimate = (verdict.estimate_error_p50_m, verdict.estimate_error_p95_m, verdict.estimate_error_max_m)
    rows = [
        ("phase", verdict.phase, "done"),
        ("flight time", _number(verdict.duration_s, "s", 1), _bound("≤", expect.duration_max_s, "s")),
        ("path length", _number(verdict.path_length_m, "m", 2), ""),
        ("error to estimate, p50/p95/max", _three(estimate), ""),
        ("least clearance of the hull", _number(verdict.min_clearance_m, "m", 3), clearance),
        ("setpoint rate", _number(verdict.setpoint_rate_hz, "Hz", 2), ""),
        ("setpoint gap, p99", _number(verdict.setpoint_gap_p99_ms, "ms", 1), gap),
        ("setpoint gap, worst", _number(verdict.setpoint_gap_max_ms, "ms", 1), ""),
    ]
    judged = _bound("p95 ≤", expect.tracking_error_p95_m, "m")
    if verdict.tracking_error_source == "truth":
        truth = (verdict.tracking_error_p50_m, verdict.tracking_error_p95_m, verdict.tracking_error_max_m)
        rows.insert(4, ("error to truth, p50/p95/max", _three(truth), judged))
    else:
        rows[3] = (*rows[3][:2], judged)
    for row in rows:
        table.add_row(*row)
    out.print(table)
    for name, value in details.items():
        out.print(f"[dim]{name:>10}[/dim]  {plain(value)}", soft_wrap=True)
    for problem in ([verdict.failure] if verdict.failure else []) + verdict.failed_expectations:
        out.print(f"[bold red]✗[/bold red] {plain(problem)}", soft_wrap=True)


def verdict_json(verdict: Verdict) -> dict[str, Any]:
    """The verdict's fields as JSON has them (without the track)."""
    names = [name for name in Verdict.__dataclass_fields__ if name != "track"]
    return {name: getattr(verdict, name) for name in names}


def _bound(sign: str, value: float | None, unit: str) -> str:
    return "" if value is None else f"{sign} {value:g} {unit}"


def _three(values: tuple[float | None, float | None, float | None]) -> str:
    p50, p95, most = values
    return "-" if p50 is None or p95 is None or most is None else f"{p50:.3f} / {p95:.3f} / {most:.3f} m"


def _number(value: float | None, unit: str, digits: int) -> str:
    return "-" if value is None else f"{value:.{digits}f} {unit}"


def _style(ok: bool) -> str:
    return "bold green" if ok else "bold red"
