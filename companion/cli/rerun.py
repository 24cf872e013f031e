"""`companion rerun`: is a recording what this companion would do again?"""

import time
from pathlib import Path

from rich.console import Console
from rich.table import Table

from companion.cli import show
from companion.drivers.rerun import rerun
from logs.reader import Recording

DIFFERENT = 3
"""Exit code of a failed verification."""


def rerun_log(path: Path, as_json: bool) -> int:
    """Re-run `path`; exit code 0 when every output is the same and the recording is whole, 3 otherwise."""
    out = show.console()
    recording = Recording.open(path)
    wall = time.perf_counter()
    with show.working(out, "re-running"):
        done = rerun(recording)
    wall = time.perf_counter() - wall
    comparison = done.comparison
    first = "" if comparison.first is None else comparison.first.text
    if not first and recording.problem:
        first = f"tick {done.ticks}: nothing can be compared from here on: {recording.problem}"
    ok = comparison.first is None and recording.complete
    result = {
        "ok": ok,
        "mission": done.companion.mission.name,
        "seed": done.companion.config.seed,
        "recording": str(path),
        "complete": recording.complete,
        "problem": recording.problem,
        "ticks": done.ticks,
        "outputs": comparison.outputs,
        "equal": comparison.equal,
        "first_difference": first or None,
        "differences": dict(comparison.kinds),
        "speedup": done.simulated_s / wall,
    }
    if as_json:
        show.print_json(result)
        return 0 if ok else DIFFERENT
    screen = Console()
    screen.print(
        f"{done.ticks} ticks, {comparison.equal} of {comparison.outputs} outputs the same, "
        f"{result['speedup']:.0f} x real time"
    )
    if first:
        screen.print(f"[bold red]first difference:[/] {show.plain(first)}", soft_wrap=True)
        table = Table("what differs", "times")
        for kind, count in comparison.kinds.items():
            table.add_row(show.plain(kind), str(count))
        screen.print(table)
    return 0 if ok else DIFFERENT
