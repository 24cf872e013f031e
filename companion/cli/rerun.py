"""`companion rerun`: is a recording what this companion would do again?"""

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import typer
from rich.console import Console

from companion.cli import show
from companion.drivers.changes import changes_of
from companion.drivers.rerun import rerun
from companion.errors import RerunError
from logs.compare import Change, Comparison
from logs.reader import Recording

DIFFERENT = 3
"""Exit code of a failed verification."""


def rerun_log(path: Path, as_json: bool, sets: Sequence[str] = (), estimator: bool = False) -> int:
    """Re-run `path`, with what `sets` say changed: the companion, or the bundled vehicle's estimator.

    Exit code 0 when every output is the same and the recording is whole, 3 otherwise. With changes what differs is the
    answer, not a failure: 0 when the recording is whole.
    """
    out = show.console()
    try:
        changes = changes_of(sets)
    except RerunError as error:
        raise typer.BadParameter(str(error)) from error
    recording = Recording.open(path)
    wall = time.perf_counter()
    if estimator:
        from fakevehicle.estimator_rerun import rerun_estimator

        with show.working(out, "re-running the estimator"):
            estimated = rerun_estimator(recording, changes)
        speedup = estimated.simulated_s / (time.perf_counter() - wall)
        about = {"estimator": True, "set": dict(changes)}
        return tell(recording, about, estimated.ticks, estimated.comparison, speedup, as_json)
    with show.working(out, "re-running"):
        done = rerun(recording, changes=changes)
    wall = time.perf_counter() - wall
    about = {"mission": done.companion.mission.name, "seed": done.companion.config.seed, "set": dict(changes)}
    return tell(recording, about, done.ticks, done.comparison, done.simulated_s / wall, as_json)


def tell(
    recording: Recording, about: dict[str, Any], ticks: int, comparison: Comparison, speedup: float, as_json: bool
) -> int:
    """Print what came of a re-run; `about["set"]` says what was changed. Returns the exit code."""
    changed = bool(about["set"])
    first = "" if comparison.first is None else comparison.first.text
    if not first and recording.problem:
        first = f"tick {ticks}: nothing can be compared from here on: {recording.problem}"
    ok = (changed or comparison.first is None) and recording.complete
    if as_json:
        show.print_json(
            {
                "ok": ok,
                **about,
                "recording": str(recording.path),
                "complete": recording.complete,
                "problem": recording.problem,
                "ticks": ticks,
                "outputs": comparison.outputs,
                "equal": comparison.equal,
                "first_difference": first or None,
                "differences": dict(comparison.kinds),
                "changes": [_change_json(change) for change in comparison.changes],
                "speedup": speedup,
            }
        )
        return 0 if ok else DIFFERENT
    screen = Console()
    same = f"{comparison.equal} of {comparison.outputs} outputs the same"
    screen.print(f"{ticks} ticks, {same}, {speedup:.0f} x real time")
    if first:
        style = "bold" if changed else "bold red"
        screen.print(f"[{style}]first difference:[/] {show.plain(first)}", soft_wrap=True)
        for change in comparison.changes:
            screen.print(show.plain(f"{change.count:>7} x {_in_words(change)}"), soft_wrap=True, highlight=False)
    elif changed:
        screen.print("nothing that was sent or said depends on it")
    return 0 if ok else DIFFERENT


def _change_json(change: Change) -> dict[str, Any]:
    return {
        "what": change.kind,
        "times": change.count,
        "first_tick": change.tick,
        "recorded": change.recorded,
        "produced": change.produced,
        "largest": change.largest,
        "largest_tick": change.largest_tick,
    }


def _in_words(change: Change) -> str:
    """What differs, since when, from what to what (of lists the first numbers that do), and by how much at most."""
    text, recorded, produced = f"{change.kind} from tick {change.tick} on", change.recorded, change.produced
    if recorded is None and produced is None:
        return text
    if isinstance(recorded, list | tuple) and isinstance(produced, list | tuple) and len(recorded) == len(produced):
        recorded, produced = next(pair for pair in zip(recorded, produced, strict=True) if pair[0] != pair[1])
    text += f": {_short(recorded)} -> {_short(produced)}"
    return (
        text if change.largest is None else f"{text}, at most {change.largest:.4g} apart (tick {change.largest_tick})"
    )


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)[:60]
