"""`companion`: the commands, and what becomes of errors.

Exit codes: 0 ok, 1 the flight or its input failed, 2 usage, 3 a verification failed. A known error is one clear line on
stderr without a traceback. Heavy imports happen inside the commands, so that `--help` answers at once.
"""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, NoReturn

import typer

if TYPE_CHECKING:
    from logs.selection import Selection

app = typer.Typer(
    name="companion",
    help="Plan collision-free trajectories, fly them over MAVLink, record everything.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
)
mission_app = typer.Typer(help="Missions and ground stations' plans.", no_args_is_help=True)
app.add_typer(mission_app, name="mission")
log_app = typer.Typer(help="Look into recordings.", no_args_is_help=True)
app.add_typer(log_app, name="log")

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


@app.command()
def demo(
    record: RecordDirectory = RECORDINGS,
    out: Outs = None,
    seed: Seed = 1,
    autopilot: Autopilot = "px4",
    rotate_size: RotateSize = None,
    rotate_time: RotateTime = None,
    live: Live = None,
    json: Json = False,
) -> None:
    """Fly the L-shaped wall with the bundled vehicle, over UDP, recorded. Needs nothing else."""
    from companion.cli.fly import fly_demo, rotation_of

    rotation = rotation_of(rotate_size, rotate_time)
    raise typer.Exit(fly_demo(record, out or [], seed, autopilot, json, rotation, live))


@app.command()
def fly(
    mission: MissionFile,
    master: Annotated[
        str | None, typer.Option(metavar="URL", help="Where the vehicle is, e.g. udpin:127.0.0.1:14540.")
    ] = None,
    out: Outs = None,
    record: RecordDirectory = RECORDINGS,
    seed: Seed = 1,
    system_id: Annotated[
        int | None, typer.Option(help="Obey only this vehicle (default: the first heard).", min=1, max=255)
    ] = None,
    wait: Annotated[
        float, typer.Option(help="How long to wait for the vehicle's first HEARTBEAT [s].", min=0.1, max=86_400.0)
    ] = 60.0,
    autopilot: Annotated[
        Literal["px4", "ardupilot"] | None, typer.Option(help="Of bundled vehicles, where the file has several.")
    ] = None,
    rotate_size: RotateSize = None,
    rotate_time: RotateTime = None,
    live: Live = None,
    json: Json = False,
) -> None:
    """Fly a mission on a vehicle behind a MAVLink/UDP endpoint, or one of several `vehicles` on bundled ones."""
    from companion.cli.fly import fly_mission, rotation_of

    rotation = rotation_of(rotate_size, rotate_time)
    outs = out or []
    more = (autopilot, json, rotation, live)
    raise typer.Exit(fly_mission(mission, master, outs, record, seed, system_id, wait, *more))


@app.command()
def run(
    config: Annotated[
        Path | None, typer.Option("--config", metavar="FILE", help="Configuration (YAML): docs/service.md.")
    ] = None,
) -> None:
    """Run as a service: mission after mission, until a signal lands what flies and ends it."""
    from companion.cli.run import run_service

    raise typer.Exit(run_service(config))


@app.command()
def simulate(
    mission: MissionFile,
    seed: Seed = 1,
    record: Annotated[Path | None, typer.Option("--record", metavar="FILE", help="Keep the recording here.")] = None,
    autopilot: Autopilot = "px4",
    json: Json = False,
) -> None:
    """Fly a mission in lockstep: same cores, no sockets, as fast as the CPU allows, repeatable to the byte."""
    from companion.cli.simulate import simulate_mission

    raise typer.Exit(simulate_mission(mission, seed, record, autopilot, json))


@app.command("test")
def missions(
    paths: Annotated[list[Path], typer.Argument(metavar="PATH...", help="Mission files, or folders of them.")],
    autopilot: Annotated[
        Literal["px4", "ardupilot", "both"], typer.Option(help="Whose behaviour the bundled vehicle shows.")
    ] = "px4",
    seeds: Annotated[int, typer.Option(help="Fly each with the seeds 1 to this.", min=1, max=10_000)] = 1,
    jobs: Annotated[int, typer.Option("-j", "--jobs", help="Processes.", min=1, max=64)] = 2,
    record: Annotated[
        Path, typer.Option("--record", metavar="DIR", help="Where recordings of flights that failed are kept.")
    ] = RECORDINGS / "failed",
    json: Json = False,
) -> None:
    """Fly mission files in lockstep, and hold each against what it expects; the first cause of a failure is named."""
    from companion.cli.test import fly_missions

    raise typer.Exit(fly_missions(paths, autopilot, seeds, jobs, record, json))


@app.command()
def plan(
    mission: MissionFile,
    seed: Seed = 1,
    plot: Annotated[Path | None, typer.Option("--plot", metavar="FILE.png", help="Draw the plan.")] = None,
    compare: Annotated[
        bool, typer.Option("--compare", help="Plan by every method, and set them side by side.")
    ] = False,
    json: Json = False,
) -> None:
    """Plan every leg of a mission without flying it."""
    if compare:
        from companion.cli.compare import compare_methods

        raise typer.Exit(compare_methods(mission, seed, plot, json))
    from companion.cli.plan import plan_mission

    raise typer.Exit(plan_mission(mission, seed, plot, json))


@app.command()
def worlds(
    family: Annotated[str, typer.Argument(help="gap, L, H, U, Omega, forest or maze.")],
    seed: Annotated[int, typer.Option(help="Seed of the world.", min=0, max=2**31 - 1)] = 1,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="Write here instead of to stdout.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it exists.")] = False,
) -> None:
    """Write a world of one of the benchmark families as a mission file."""
    from companion.cli.worlds import write_world

    raise typer.Exit(write_world(family, seed, output, force))


@mission_app.command("convert")
def mission_convert(
    source: Annotated[Path, typer.Argument(metavar="IN", help="YAML mission, QGroundControl .plan, or QGC WPL 110.")],
    target: Annotated[Path, typer.Argument(metavar="OUT", help="Its ending says how: .yaml, .plan, .waypoints.")],
    force: Annotated[bool, typer.Option("--force", help="Replace OUT if it exists.")] = False,
) -> None:
    """Write a mission in another format; what that format cannot say is told."""
    from companion.cli.convert import convert_mission

    raise typer.Exit(convert_mission(source, target, force))


@app.command()
def replay(
    log: LogFile,
    to: Annotated[str, typer.Option(metavar="URL", help="Ground station, e.g. udpout:127.0.0.1:14550.")],
    rate: Annotated[float, typer.Option("-r", "--rate", help="Speed, 1 is real time.", min=0.001, max=1000.0)] = 1.0,
    start: Start = 0.0,
    duration: Duration = None,
    topic: Topics = None,
    message: Messages = None,
    sysid: Systems = None,
    endpoint: Annotated[
        str | None, typer.Option("--endpoint", metavar="NAME", help="Link to replay (default: the vehicle's).")
    ] = None,
    loop: Annotated[bool, typer.Option("--loop", help="Again and again, until it is ended.")] = False,
    answer: Annotated[
        bool, typer.Option(help="Answer a ground station that asks for parameters and the mission.")
    ] = True,
    to_a_vehicle: Annotated[
        bool,
        typer.Option(
            "--send-recorded-commands-to-a-vehicle",
            help="Send what was sent to the vehicle, setpoints and commands, and nothing else: IT WILL OBEY.",
        ),
    ] = False,
    live: Live = None,
    json: Json = False,
) -> None:
    """Send a recording's vehicle traffic to a ground station, with its original spacing.

    At a terminal space pauses, the right arrow sends one datagram, q ends.
    """
    from companion.cli.replay import replay_log

    wanted = _selection(topic, message, sysid, start, duration)
    rounds = None if loop else 1
    code = replay_log(
        *(log, to, rate, json),
        wanted=wanted,
        link_name=endpoint,
        rounds=rounds,
        answer=answer,
        to_a_vehicle=to_a_vehicle,
        live=live,
    )
    raise typer.Exit(code)


@app.command()
def rerun(
    log: LogFile,
    sets: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="With this changed, such as limits.speed=2 or seed=3."),
    ] = None,
    estimator: Annotated[
        bool,
        typer.Option("--estimator", help="The bundled vehicle's estimator, on what its --record-sensors recorded."),
    ] = False,
    json: Json = False,
) -> None:
    """Feed a recording's inputs to a fresh companion and compare every output, bit for bit (exit 3: they differ).

    With --set what differs is listed by message and field, and is no failure.
    """
    from companion.cli.rerun import rerun_log

    raise typer.Exit(rerun_log(log, json, sets or [], estimator))


@app.command()
def report(
    log: LogFile,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE.html", help="The page (default: beside the recording)."),
    ] = None,
    png: Annotated[
        Path | None, typer.Option("--png", metavar="DIR", help="Pictures too, one a section, into this folder.")
    ] = None,
    against: Annotated[
        Path | None, typer.Option("--against", metavar="LOG2", help="Compare the parameters with another recording's.")
    ] = None,
    json: Json = False,
) -> None:
    """Write a recording as one page that needs nothing else: verdict, 3D path, plots, timeline, parameters."""
    from companion.cli.report import report_log

    raise typer.Exit(report_log(log, output, png, against, json))


@log_app.command("info")
def log_info(log: LogFile, json: Json = False) -> None:
    """What a recording holds."""
    from companion.cli.log import show_info

    raise typer.Exit(show_info(log, json))


@log_app.command("recover")
def log_recover(
    logs: Annotated[list[Path], typer.Argument(metavar="LOG...", help="Recordings (MCAP).")], json: Json = False
) -> None:
    """Make recordings whole that were not closed, cut short or damaged, in place (exit 3: something is lost)."""
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

    raise typer.Exit(cat(log, _selection(topic, message, sysid, start, duration), limit, json))


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

    raise typer.Exit(filter_log(log, output, _selection(topic, message, sysid, start, duration), force, json))


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
    tolerance: Annotated[float, typer.Option(help="Numbers this near are the same, absolutely or relatively.")] = 0.0,
    json: Json = False,
) -> None:
    """Compare two recordings: parameters, events, and where their messages part (exit 3: they differ)."""
    from companion.cli.lookup import diff_logs

    wanted = _selection(topic, message, sysid, start, duration)
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

    raise typer.Exit(export_log(log, to, output, _selection(topic, message, sysid, start, duration), force, json))


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


def _selection(
    topics: list[str] | None,
    names: list[str] | None,
    systems: list[int] | None,
    start_s: float,
    duration_s: float | None,
) -> "Selection":
    from logs.selection import Selection

    try:
        return Selection(tuple(topics or ()), tuple(names or ()), tuple(systems or ()), (), start_s, duration_s)
    except ValueError as error:
        raise typer.BadParameter(str(error)) from error


FLIGHT_KEYS = (
    *("mission", "seed", "duration_s", "path_length_m", "tracking_error_p95_m", "min_clearance_m"),
    *("setpoint_rate_hz", "setpoint_gap_max_ms", "recording"),
)
"""What the JSON of a flight always has; null where an error came first."""

INTERRUPTED = 130
"""What the command-line library exits with on Ctrl-C where no flight listens for it."""


def main() -> None:
    """Console script: a known error is one line on stderr (and a JSON object, if asked for) and exit code 1."""
    try:
        app(with_live_port(sys.argv[1:]))
    except SystemExit as end:
        if end.code == INTERRUPTED:
            _fail("interrupted", 1)
        raise
    except Exception as error:
        if not isinstance(error, _known_errors()):
            raise
        _fail(str(error), 2 if type(error).__name__ == "EndpointError" else 1)


def with_live_port(arguments: list[str]) -> list[str]:
    """The arguments with a port behind every `--live` that has none: an option's value cannot be left out."""
    given: list[str] = []
    for at, word in enumerate(arguments):
        bare = word == LIVE and not (at + 1 < len(arguments) and arguments[at + 1].lstrip("-").isdigit())
        given += [word, LIVE_PORT] if bare else [word]
    return given


def _fail(text: str, code: int) -> NoReturn:
    print(f"companion: {text}", file=sys.stderr)
    if "--json" in sys.argv:
        from companion.cli.show import print_json

        flight = any(command in sys.argv for command in ("demo", "fly", "simulate"))
        print_json({"ok": False, "failure": text, **dict.fromkeys(FLIGHT_KEYS if flight else ())})
    sys.exit(code)


def _known_errors() -> tuple[type[Exception], ...]:
    from companion.errors import CompanionError
    from fakevehicle.errors import VehicleError
    from logs.errors import LogsError
    from planner.errors import PlannerError
    from wire.errors import WireError

    return (CompanionError, LogsError, PlannerError, VehicleError, WireError)
