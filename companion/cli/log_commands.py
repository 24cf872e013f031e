"""`companion log`: what can be done with recordings, and what is asked for on the command line."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from companion.cli.options import (
    Duration,
    Force,
    Json,
    LogFile,
    Messages,
    Start,
    Systems,
    Topics,
    selection,
)

log_app = typer.Typer(help="Look into recordings.", no_args_is_help=True)


@log_app.command("info")
def log_info(log: LogFile, json: Json = False) -> None:
    """What a recording holds."""
    from companion.cli.log import show_info

    raise typer.Exit(show_info(log, json))


@log_app.command("recover")
def log_recover(
    logs: Annotated[list[Path], typer.Argument(metavar="LOG...", help="Recordings (MCAP).")], json: Json = False
) -> None:
    """Make recordings with all their parts whole: not closed, cut short or damaged (exit 3: something is lost)."""
    from companion.cli.log import recover_logs

    raise typer.Exit(recover_logs(logs, json))


@log_app.command("cat")
def log_cat(
    log: LogFile,
    topic: Topics = None,
    message: Messages = None,
    sysid: Systems = None,
    start: Start = 0.0,
    duration: Duration = None,
    limit: Annotated[int | None, typer.Option("--limit", "-n", metavar="N", help="Stop after so many.", min=1)] = None,
    json: Annotated[bool, typer.Option("--json", help="Print a JSON object a line.")] = False,
) -> None:
    """Print decoded messages, one a line."""
    from companion.cli.lookup import cat

    raise typer.Exit(cat(log, selection(topic, message, sysid, start, duration), limit, json))


@log_app.command("filter")
def log_filter(
    log: LogFile,
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The smaller recording.")],
    topic: Topics = None,
    message: Messages = None,
    sysid: Systems = None,
    start: Start = 0.0,
    duration: Duration = None,
    force: Force = False,
    json: Json = False,
) -> None:
    """Write a smaller recording: some topics, messages, senders, or a stretch of time."""
    from companion.cli.lookup import filter_log

    raise typer.Exit(filter_log(log, output, selection(topic, message, sysid, start, duration), force, json))


@log_app.command("diff")
def log_diff(
    log: LogFile,
    other: Annotated[Path, typer.Argument(metavar="LOG2", help="Recording (MCAP).")],
    topic: Topics = None,
    message: Messages = None,
    sysid: Systems = None,
    start: Start = 0.0,
    duration: Duration = None,
    ignore: Annotated[
        list[str] | None, typer.Option("--ignore", metavar="FIELD", help="Leave out a field, e.g. time_boot_ms.")
    ] = None,
    tolerance: Annotated[
        float, typer.Option(help="Numbers this near are the same, absolutely or relatively.", min=0.0, max=1e30)
    ] = 0.0,
    json: Json = False,
) -> None:
    """Compare two recordings: parameters, events, and where their messages part (exit 3: they differ)."""
    from companion.cli.lookup import diff_logs

    wanted = selection(topic, message, sysid, start, duration)
    raise typer.Exit(diff_logs(log, other, wanted, ignore or [], tolerance, json))


@log_app.command("export")
def log_export(
    log: LogFile,
    to: Annotated[Literal["tlog", "csv", "parquet", "json"], typer.Option("--to", help="The format.")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="PATH", help="File or folder (default: beside LOG).")
    ] = None,
    topic: Topics = None,
    message: Messages = None,
    sysid: Systems = None,
    start: Start = 0.0,
    duration: Duration = None,
    force: Force = False,
    json: Json = False,
) -> None:
    """Write a recording as .tlog, as CSV or Parquet (a folder, a file a topic), or as lines of JSON."""
    from companion.cli.lookup import export_log

    raise typer.Exit(export_log(log, to, output, selection(topic, message, sysid, start, duration), force, json))


@log_app.command("import")
def log_import(
    source: Annotated[Path, typer.Argument(metavar="FILE", help=".tlog, PX4's .ulg, or ArduPilot's .BIN.")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="LOG", help="The recording (default: beside FILE).")
    ] = None,
    force: Force = False,
    json: Json = False,
) -> None:
    """Make a recording of another program's log."""
    from companion.cli.lookup import import_file

    raise typer.Exit(import_file(source, output, force, json))
