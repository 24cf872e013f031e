"""`companion test`: fly mission files in lockstep, and hold each against what it expects."""

import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal, get_args

from rich.console import Console

from companion.cli import show
from companion.testing.campaign import fly_all
from companion.testing.flight import fly
from companion.testing.spec import FlightResult, FlightSpec
from fakevehicle.config import Autopilot

SUFFIXES = (".yaml", ".yml")
MOST_FLIGHTS = 100_000


def fly_missions(
    paths: Sequence[Path], autopilot: Autopilot | Literal["both"], seeds: int, jobs: int, keep: Path, as_json: bool
) -> int:
    """Fly every mission file with every autopilot and seed; returns the exit code.

    Parameters
    ----------
    paths : mission files, and folders whose mission files (not those of folders in them) are flown.
    autopilot : flavour of the bundled vehicle, or both one after the other.
    seeds : how many, from 1 on.
    jobs : processes.
    keep : where recordings of flights that failed are kept: flown once more for it, they are the same.
    """
    out = show.console()
    flavours: tuple[Autopilot, ...] = get_args(Autopilot) if autopilot == "both" else (autopilot,)
    files = list(mission_files(paths))
    if not files:
        print(f"companion: no mission file (*.yaml) in {', '.join(map(str, paths))}", file=sys.stderr)
        return 2
    specs = [FlightSpec(f, autopilot=a, seed=s) for f in files for a in flavours for s in range(1, seeds + 1)]
    if len(specs) > MOST_FLIGHTS:
        print(f"companion: {len(specs)} flights, expected at most {MOST_FLIGHTS}", file=sys.stderr)
        return 2
    started = time.perf_counter()
    results = []
    for result in fly_all(specs, min(jobs, len(specs))):
        kept = result if result.ok else _recorded(result, keep)
        results.append(kept)
        out.print(_line(kept), soft_wrap=True)
    passed = sum(result.ok for result in results)
    if as_json:
        whole = {"ok": passed == len(results), "passed": passed, "failed": len(results) - passed}
        show.print_json({**whole, "results": [_json(result) for result in results]})
    else:
        took = time.perf_counter() - started
        Console().print(f"{passed} passed, {len(results) - passed} failed in {took:.1f} s")
    return 0 if passed == len(results) else 1


def mission_files(paths: Sequence[Path]) -> Iterator[Path]:
    """The mission files that are meant, those of a folder in the order of their names."""
    for path in paths:
        if path.is_dir():
            yield from sorted(file for file in path.iterdir() if file.suffix in SUFFIXES and file.is_file())
        else:
            yield path


def _recorded(result: FlightResult, keep: Path) -> FlightResult:
    """The same flight with its recording kept; a mission that is none has nothing to record."""
    spec = result.spec
    if result.verdict is None:
        return result
    name = f"{Path(spec.file).stem}-{spec.autopilot}-{spec.seed}"
    number = next(n for n in range(1, MOST_FLIGHTS) if not (keep / f"{name}.{n}.mcap").exists())
    return fly(replace(spec, record=keep / f"{name}.{number}.mcap"))


def _line(result: FlightResult) -> str:
    spec, good = result.spec, result.ok
    word = "[green]ok  [/green]" if good else "[bold red]FAIL[/bold red]"
    name = f"{show.plain(Path(spec.file).name)} {spec.autopilot} seed {spec.seed}"
    if not good:
        kept = "" if result.recording is None else f"  [dim]{show.plain(str(result.recording))}[/dim]"
        return f"{word}  {name}: {show.plain(result.cause)}{kept}"
    p95 = None if result.verdict is None else result.verdict.tracking_error_p95_m
    error = "" if p95 is None else f", p95 {p95:.2f} m"
    clear = "" if result.min_clearance_m is None else f", clear {result.min_clearance_m:.2f} m"
    return f"{word}  {name}  [dim]{result.simulated_s:.1f} s{error}{clear}[/dim]"


def _json(result: FlightResult) -> dict[str, Any]:
    spec = result.spec
    return {
        "mission": spec.file,
        "autopilot": spec.autopilot,
        "seed": spec.seed,
        "ok": result.ok,
        "cause": result.cause,
        "seconds": result.simulated_s,
        "recording": None if result.recording is None else str(result.recording),
    }
