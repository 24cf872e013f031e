"""`companion log cat | filter | diff | export | import`: what is in recordings, and what becomes of them elsewhere."""

import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rich.console import Console

from companion.cli import show
from companion.recordedsettings import differing, settings_of
from logs.diff import Diff, diff
from logs.export import Exported
from logs.export.csv import to_csv
from logs.export.json_lines import line, to_json
from logs.export.parquet import to_parquet
from logs.export.tlog import to_tlog
from logs.filter import filtered
from logs.importing import import_log
from logs.reader import Recording
from logs.rows import Row, rows
from logs.selection import Selection, nothing_left, selected

DIFFERENT = 3
"""Exit code of two recordings that differ."""
MOST_SHOWN = 30
Differing = Mapping[str, tuple[Any, Any]]
"""Keys of mission and configuration, with the value in either."""
EXPORTS = {"tlog": (to_tlog, ".tlog"), "csv": (to_csv, ".csv"), "parquet": (to_parquet, ".parquet")}
EXPORTS |= {"json": (to_json, ".jsonl")}


def cat(path: Path, wanted: Selection, limit: int | None, as_json: bool) -> int:
    """Print decoded messages, one a line; with `as_json` an object a line."""
    recording = Recording.open(path)
    first = next(recording.messages(), None)
    start_ns = 0 if first is None else first.log_time_ns
    printed = 0
    try:
        for row in rows(recording, selected(recording.messages(), wanted)):
            if limit is not None and printed >= limit:
                break
            sys.stdout.write(line(row) if as_json else _line(row, start_ns))
            printed += 1
        sys.stdout.flush()
    except BrokenPipeError:  # `| head` has seen enough; what is still to be flushed at the end goes nowhere
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    if not printed:
        raise nothing_left(recording, wanted)
    _tell_problem(recording)
    return 0


def filter_log(path: Path, target: Path, wanted: Selection, force: bool, as_json: bool) -> int:
    """Write a smaller recording."""
    recording = Recording.open(path)
    with show.working(show.console(), "filtering"):
        done = filtered(recording, target, wanted, force)
    return _told(done, as_json, "messages")


def export_log(path: Path, to: str, target: Path | None, wanted: Selection, force: bool, as_json: bool) -> int:
    """Write a recording in a format of others."""
    export, ending = EXPORTS[to]
    target = target or path.with_suffix(ending)
    recording = Recording.open(path)
    with show.working(show.console(), "exporting"):
        done = export(recording, target, wanted, force)
    return _told(done, as_json, "packets" if to == "tlog" else "messages")


def import_file(source: Path, target: Path | None, force: bool, as_json: bool) -> int:
    """Make a recording of a log of others."""
    with show.working(show.console(), "importing"):
        done = import_log(source, target or source.with_suffix(".mcap"), force)
    if as_json:
        show.print_json({"ok": True, "path": str(done.path), "messages": done.messages, "told": done.told})
        return 0
    what = "packets" if source.suffix.lower() == ".tlog" else "messages"
    Console().print(show.plain(f"{done.path}: {done.messages} {what}"), soft_wrap=True)
    for text in done.told:
        show.console().print(show.plain(text), soft_wrap=True)
    return 0


def diff_logs(left: Path, right: Path, wanted: Selection, ignore: list[str], tolerance: float, as_json: bool) -> int:
    """Tell how two recordings differ; exit code 0 when they do not, 3 when they do."""
    one, other = Recording.open(left), Recording.open(right)
    with show.working(show.console(), "comparing"):
        found = diff(one, other, wanted, ignore=ignore, tolerance=tolerance)
        settings = differing(settings_of(one), settings_of(other)) if wanted == Selection() else {}
    if not found.compared and not found.counts and not settings:
        raise nothing_left(one, wanted)
    for recording in (one, other):
        _tell_problem(recording)
    if as_json:
        show.print_json(_diff_json(found, settings, left, right))
    else:
        _print_diff(found, settings, left, right, Console())
    return 0 if found.same and not settings else DIFFERENT


def _tell_problem(recording: Recording) -> None:
    if recording.problem:
        show.console().print(show.plain(f"{recording.path}: not complete: {recording.problem}"), soft_wrap=True)


def _line(row: Row, start_ns: int) -> str:
    """A message as people read it."""
    who = "" if row.system is None else f"{row.system}/{row.component} "
    values = "  ".join(f"{name}={_shown(value)}" for name, value in row.values.items())
    return f"{(row.log_time_ns - start_ns) / 1e9:10.3f}  {who}{row.name}  {values}\n"


def _shown(value: Any) -> str:
    if isinstance(value, str):
        return '"' + "".join(c if c.isprintable() else "?" for c in value) + '"'
    if isinstance(value, list):
        return f"[{', '.join(_shown(item) for item in value)}]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{name}: {_shown(item)}" for name, item in value.items()) + "}"
    return value.hex() if isinstance(value, bytes) else str(value)


def _told(done: Exported, as_json: bool, what: str) -> int:
    if as_json:
        about = {"ok": True, "path": str(done.path), what: done.messages, "topics": done.topics}
        show.print_json({**about, "left_out": done.left_out})
        return 0
    topics = f"{len(done.topics)} topic{'' if len(done.topics) == 1 else 's'}"
    Console().print(show.plain(f"{done.path}: {done.messages} {what} of {topics}"), soft_wrap=True)
    for text in done.left_out:
        show.console().print(show.plain(f"left out: {text}"), soft_wrap=True)
    return 0


def _diff_json(found: Diff, settings: Differing, left: Path, right: Path) -> dict[str, Any]:
    fields = [
        {
            "topic": item.topic,
            "field": item.name,
            "count": item.count,
            "largest": item.largest,
            "first_s": item.first_ns / 1e9,
            "left": item.left,
            "right": item.right,
        }
        for item in found.fields
    ]
    return {
        "ok": found.same and not settings,
        "left": str(left),
        "right": str(right),
        "compared": found.compared,
        "equal": found.equal,
        "settings": [{"name": name, "left": pair[0], "right": pair[1]} for name, pair in settings.items()],
        "parameters": [
            {"system": system, "component": component, "name": name, "left": values[0], "right": values[1]}
            for (system, component, name), values in found.parameters.items()
        ],
        "events": [{"in": item.side, "time_s": item.time_ns / 1e9, "text": item.text} for item in found.events],
        "counts": {topic: list(pair) for topic, pair in found.counts.items()},
        "first": fields[0] if fields else None,
        "fields": fields,
    }


def _print_diff(found: Diff, settings: Differing, left: Path, right: Path, out: Console) -> None:
    def say(text: str) -> None:
        out.print(show.plain(text), soft_wrap=True, highlight=False)

    def some(title: str, texts: list[str]) -> None:
        if texts:
            say(f"{title}:")
            for text in texts[:MOST_SHOWN]:
                say(f"  {text}")
            if len(texts) > MOST_SHOWN:
                say(f"  and {len(texts) - MOST_SHOWN} more (--json has them all)")

    say(f"< {left}")
    say(f"> {right}")
    some(
        "mission and configuration",
        [f"{name}: {_value(one)} | {_value(other)}" for name, (one, other) in settings.items()],
    )
    some(
        "parameters",
        [
            f"{name} ({system}/{component}): {_value(values[0])} | {_value(values[1])}"
            for (system, component, name), values in found.parameters.items()
        ],
    )
    some("events", [f"{'<' if e.side == 'left' else '>'} {e.time_ns / 1e9:8.2f} s  {e.text}" for e in found.events])
    some("numbers of messages", [f"{topic}: {pair[0]} | {pair[1]}" for topic, pair in found.counts.items()])
    first = found.first
    if first is not None:
        values = f"{_value(first.left)} | {_value(first.right)}"
        say(f"they part at {first.first_ns / 1e9:.3f} s: {first.topic} {first.name}: {values}")
    some(
        "fields that differ, the earliest first",
        [
            f"{f.first_ns / 1e9:8.3f} s  {f.topic} {f.name}: {f.count} times"
            + ("" if f.largest is None else f", by {f.largest:.6g} at most")
            for f in found.fields
        ],
    )
    say(
        "no difference"
        if found.same and not settings
        else f"{found.equal} of {found.compared} pairs of messages are the same"
    )


def _value(value: Any) -> str:
    if value is None:
        return "none"
    text = _shown(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
