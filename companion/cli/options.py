"""Options and arguments that several commands have, each written once."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

if TYPE_CHECKING:
    from logs.selection import Selection

MissionFile = Annotated[Path, typer.Argument(metavar="MISSION", help="Mission file (YAML).")]
LogFile = Annotated[Path, typer.Argument(metavar="LOG", help="Recording (MCAP).")]
Seed = Annotated[
    int, typer.Option(help="Seed of everything random: planner, and simulated sensors.", min=0, max=2**31 - 1)
]
Json = Annotated[bool, typer.Option("--json", help="Print exactly one JSON object on stdout.")]
Autopilot = Annotated[Literal["px4", "ardupilot"], typer.Option(help="Whose behaviour the bundled vehicle shows.")]
RecordDirectory = Annotated[Path, typer.Option("--record", metavar="DIR", help="Directory for the recording.")]
Outs = Annotated[list[str] | None, typer.Option("--out", metavar="URL", help="Forward to and from a ground station.")]
RotateSize = Annotated[
    float | None, typer.Option("--rotate-size", metavar="MB", help="Begin a new part of this size.", min=0.1)
]
RotateTime = Annotated[
    float | None, typer.Option("--rotate-time", metavar="S", help="Begin a new part this often.", min=1.0)
]

Topics = Annotated[
    list[str] | None, typer.Option("--topic", metavar="PATTERN", help="Only topics like this, e.g. '/mavlink/1/*'.")
]
Messages = Annotated[
    list[str] | None, typer.Option("--message", metavar="NAME", help="Only messages of this name, e.g. ATTITUDE.")
]
Systems = Annotated[
    list[int] | None, typer.Option("--sysid", metavar="ID", help="Only what this system sent.", min=0, max=255)
]
Force = Annotated[bool, typer.Option("--force", help="Replace what is there.")]
Start = Annotated[float, typer.Option("--start", metavar="S", help="Begin so long after the first message.", min=0.0)]
Duration = Annotated[
    float | None, typer.Option("--duration", metavar="S", help="End so long after that (default: at the end).")
]
LIVE, LIVE_PORT = "--live", "8790"
Live = Annotated[
    int | None,
    typer.Option(
        LIVE,
        metavar="[PORT]",
        help=f"Show it as it happens on a page of this machine, at port {LIVE_PORT} or this one (0: any).",
        min=0,
        max=65535,
    ),
]

RECORDINGS = Path("recordings")


def selection(
    topics: list[str] | None,
    names: list[str] | None,
    systems: list[int] | None,
    start_s: float,
    duration_s: float | None,
) -> "Selection":
    """The messages asked for; a stretch of time that is none is wrong usage."""
    from logs.selection import Selection

    try:
        return Selection(tuple(topics or ()), tuple(names or ()), tuple(systems or ()), (), start_s, duration_s)
    except ValueError as error:
        raise typer.BadParameter(str(error)) from error
