"""`companion log ...`: looking into recordings."""

import json
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

from rich.console import Console
from rich.table import Table

from companion.cli import show
from logs.errors import RecordingError
from logs.info import RecordingInfo, info
from logs.parts import later_parts
from logs.recovery import recover

EARLIEST_NS = 10**18
"""Times from then on (2001) are on the calendar [ns]; others count from a boot, or from a simulation's beginning."""
LOSSY = 3
"""Exit code of a recovery that could not keep everything."""


def show_info(path: Path, as_json: bool) -> int:
    """What the recording at `path` holds; exit code 0 whether or not it was closed properly."""
    found = info(path)
    if as_json:
        show.print_json(_json(found))
    else:
        _print(found, Console())
    return 0


def recover_logs(paths: list[Path], as_json: bool) -> int:
    """Make recordings whole, in place, each with its later parts, of which the last is the one that was not closed.

    Exit code 0 when nothing was lost, 3 when something was, 1 for one refused.
    """
    out, results, code = Console(), [], 0
    for path in dict.fromkeys(part for first in paths for part in (first, *later_parts(first))):
        try:
            done = recover(path)
        except RecordingError as error:
            code = 1
            results.append({"path": str(path), "ok": False, "failure": error.reason})
            if not as_json:
                out.print(show.plain(str(error)), soft_wrap=True)
            continue
        code = code or (LOSSY if done.lossy else 0)
        results.append(
            {
                "path": str(path),
                "ok": not done.lossy,
                "failure": None,
                "changed": done.changed,
                "messages": done.messages,
                "chunks": done.chunks,
                "lost_bytes": done.lost_bytes,
                "problem": done.problem,
            }
        )
        if not as_json:
            out.print(show.plain(str(done)), soft_wrap=True)
    if as_json:
        show.print_json({"ok": code == 0, "recordings": results})
    return code


def _json(found: RecordingInfo) -> dict[str, object]:
    links = {
        link.name: {
            "rx_datagrams": link.rx_datagrams,
            "rx_bytes": link.rx_bytes,
            "tx_datagrams": link.tx_datagrams,
            "tx_bytes": link.tx_bytes,
        }
        for link in found.links
    }
    topics = {t.topic: {"schema": t.schema, "count": t.count, "rate_hz": t.rate_hz} for t in found.topics}
    return {
        "ok": True,
        "path": str(found.path),
        "size_bytes": found.size_bytes,
        "parts": found.parts,
        "gaps": list(found.gaps),
        "complete": found.complete,
        "problem": found.problem,
        "library": found.library,
        "start_ns": found.start_ns,
        "duration_s": found.duration_s,
        "messages": found.messages,
        "links": links,
        "topics": topics,
        "metadata": {name: dict(values) for name, values in found.metadata.items()},
        "attachments": dict(found.attachments),
    }


def _print(found: RecordingInfo, out: Console) -> None:
    state = "complete" if found.complete else f"[yellow]not complete: {show.plain(found.problem)}[/yellow]"
    parts = f" in {found.parts} parts" if found.parts > 1 else ""
    about = f"{found.size_bytes / 1e6:.2f} MB{parts}, {found.duration_s:.2f} s, {state}"
    out.print(f"[bold]{show.plain(str(found.path))}[/bold]  {about}", soft_wrap=True)
    for text in _about(found):
        out.print(show.plain(text), soft_wrap=True)
    links = Table(title="links", title_justify="left")
    for column in ("link", "received", "bytes", "sent", "bytes"):
        links.add_column(column, justify="left" if column == "link" else "right")
    for link in found.links:
        numbers = (link.rx_datagrams, link.rx_bytes, link.tx_datagrams, link.tx_bytes)
        links.add_row(show.plain(link.name), *map(str, numbers))
    if found.links:
        out.print(links)
    topics = Table(title="topics", title_justify="left")
    topics.add_column("topic", no_wrap=True, overflow="ignore")
    topics.add_column("messages", justify="right")
    topics.add_column("Hz", justify="right")
    for topic in found.topics:
        topics.add_row(show.plain(topic.topic), str(topic.count), f"{topic.rate_hz:.1f}")
    out.print(topics)


def _about(found: RecordingInfo) -> Iterator[str]:
    """Whose recording it is and of what, as far as its tables say."""
    began = f", begun {datetime.fromtimestamp(found.start_ns / 1e9, UTC):%Y-%m-%d %H:%M:%S} UTC"
    yield f"{found.messages} messages, written by {found.library}{began if found.start_ns > EARLIEST_NS else ''}"
    run, outcome = found.metadata.get("run"), found.metadata.get("outcome", {}).get("json")
    if run is not None:
        flight = ", ".join(f"{name} {run[name]}" for name in ("mission", "seed", "version", "revision") if name in run)
        yield f"{flight}{_verdict(outcome)}"
    for table, how in (("import", "made of"), ("filter", "filtered from"), ("recovery", "recovered")):
        values = found.metadata.get(table)
        if values is not None:
            told = ", ".join(f"{name} {value}" for name, value in values.items() if name != "of")
            yield " ".join(text for text in (how, values.get("of", ""), f"({told})" if told else "") if text)
    for name, size in found.attachments.items():
        yield f"attachment {name} ({size} bytes)"


def _verdict(outcome: str | None) -> str:
    """Of the flight, by the table `outcome`; nothing where there is none, or another's."""
    try:
        ok = json.loads(outcome or "null")["ok"]
    except (ValueError, TypeError, KeyError):
        return ""
    return ": PASS" if ok else ": FAIL"
