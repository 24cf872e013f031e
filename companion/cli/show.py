"""What a person sees: a progress line while it flies, a verdict table at the end, or one JSON object."""

import json
import math
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from rich.console import Console
from rich.status import Status
from rich.table import Table

from companion.core import Companion
from companion.drivers.tick import Tick
from companion.phases import Phase
from companion.seam import Level, Note
from companion.verdict import FlightMeter, Verdict

STYLES = {Level.ERROR: "bold red", Level.WARNING: "yellow", Level.INFO: "dim"}


def console() -> Console:
    """Progress and notes go to stderr; stdout is for results."""
    return Console(stderr=True, highlight=False)


@contextmanager
def working(out: Console, what: str) -> Iterator[Status | None]:
    """A spinner on a terminal; one plain line elsewhere."""
    if out.is_terminal:
        with out.status(what) as status:
            yield status
    else:
        out.print(what)
        yield None


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
        if not math.isnan(meter.tracking_error_now):
            parts.append(f"error {meter.tracking_error_now:.2f} m")
            parts.append(f"setpoints {meter.setpoint_rate_now:.1f} Hz")
        return "  ".join(parts)


def plain(text: str) -> str:
    """Text from a peer, with nothing that the terminal or the markup would obey."""
    return "".join(c if c.isprintable() else "?" for c in text).replace("[", "\\[")


def print_verdict(verdict: Verdict, extra: Mapping[str, Any], out: Console) -> None:
    """The table at the end of a flight."""
    table = Table(title=f"{verdict.mission}: {'PASS' if verdict.ok else 'FAIL'}", title_style=_style(verdict.ok))
    table.add_column("measured")
    table.add_column("value", justify="right")
    table.add_column("expected", justify="right")
    rows = [
        ("phase", verdict.phase, "done"),
        ("flight time", _number(verdict.duration_s, "s", 1), extra.get("expect_duration", "")),
        ("path length", _number(verdict.path_length_m, "m", 2), ""),
        *_error_rows(verdict, extra),
        ("least clearance of the hull", _number(verdict.min_clearance_m, "m", 3), extra.get("expect_clearance", "")),
        ("setpoint rate", _number(verdict.setpoint_rate_hz, "Hz", 2), ""),
        ("setpoint gap p99", _number(verdict.setpoint_gap_p99_ms, "ms", 1), extra.get("expect_gap", "")),
        ("setpoint gap worst", _number(verdict.setpoint_gap_max_ms, "ms", 1), ""),
        *[(name, str(value), "") for name, value in extra.get("rows", [])],
    ]
    for row in rows:
        table.add_row(*row)
    out.print(table)
    for problem in ([verdict.failure] if verdict.failure else []) + verdict.failed_expectations:
        out.print(f"[bold red]✗[/bold red] {plain(problem)}", soft_wrap=True)


def _error_rows(verdict: Verdict, extra: Mapping[str, Any]) -> list[tuple[str, str, str]]:
    def three(p50: float | None, p95: float | None, most: float | None) -> str:
        return "-" if p50 is None or p95 is None or most is None else f"{p50:.3f} / {p95:.3f} / {most:.3f} m"

    rows = [
        (
            "tracking error against the estimate, p50 / p95 / max",
            three(verdict.estimate_error_p50_m, verdict.estimate_error_p95_m, verdict.estimate_error_max_m),
            "",
        )
    ]
    if verdict.tracking_error_source == "truth":
        found = three(verdict.tracking_error_p50_m, verdict.tracking_error_p95_m, verdict.tracking_error_max_m)
        rows.append(("tracking error against truth, p50 / p95 / max", found, ""))
    label, column, expected = rows[-1]
    rows[-1] = (label, column, extra.get("expect_tracking", expected))
    return rows


def expectations(mission: Any) -> dict[str, str]:
    """The verdict table's third column."""
    expect = mission.expect
    shown = {
        "expect_tracking": (expect.tracking_error_p95_m, "p95 ≤ {:g} m"),
        "expect_clearance": (expect.min_clearance_m, "≥ {:g} m"),
        "expect_duration": (expect.duration_max_s, "≤ {:g} s"),
        "expect_gap": (expect.setpoint_gap_p99_ms, "≤ {:g} ms"),
    }
    return {key: text.format(value) for key, (value, text) in shown.items() if value is not None}


def print_json(value: Mapping[str, Any]) -> None:
    """Exactly one JSON object on stdout; a number that JSON cannot hold becomes null."""
    json.dump({key: _json_value(item) for key, item in value.items()}, sys.stdout, indent=2, allow_nan=False)
    sys.stdout.write("\n")


def verdict_json(verdict: Verdict) -> dict[str, Any]:
    """The verdict's fields as JSON has them (without the track)."""
    names = [name for name in Verdict.__dataclass_fields__ if name != "track"]
    return {name: getattr(verdict, name) for name in names}


def _json_value(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, 6) if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _json_value(item) for key, item in value.items()}
    return [_json_value(item) for item in value] if isinstance(value, list | tuple) else value


def _number(value: float | None, unit: str, digits: int) -> str:
    return "-" if value is None else f"{value:.{digits}f} {unit}"


def _style(ok: bool) -> str:
    return "bold green" if ok else "bold red"
