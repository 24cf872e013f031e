"""`companion`: the commands, and what becomes of errors.

Exit codes: 0 ok, 1 the flight or its input failed, 2 usage, 3 a verification failed,
130 a campaign was ended before its end. A known error is one clear line on
stderr without a traceback. Heavy imports happen inside the commands, so that `--help` answers at once.
"""

import sys
from pathlib import Path
from typing import Annotated, Any, Literal, NoReturn

import typer

from companion.cli.campaign_commands import campaign_app
from companion.cli.log_commands import log_app
from companion.cli.options import (
    LIVE,
    LIVE_PORT,
    RECORDINGS,
    Autopilot,
    Duration,
    Force,
    Json,
    Live,
    LogFile,
    Messages,
    MissionFile,
    Outs,
    RecordDirectory,
    RotateSize,
    RotateTime,
    Seed,
    Start,
    Systems,
    Topics,
    selection,
)

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
app.add_typer(log_app, name="log")
app.add_typer(campaign_app, name="campaign")


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
    from companion.cli.fly import fly_demo
    from logs.parts import rotation_of

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
    from companion.cli.fly import fly_mission
    from logs.parts import rotation_of

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
    rotate_size: RotateSize = None,
    rotate_time: RotateTime = None,
    json: Json = False,
) -> None:
    """Fly a mission in lockstep: same cores, no sockets, as fast as the CPU allows, repeatable to the byte."""
    from companion.cli.simulate import simulate_mission
    from logs.parts import rotation_of

    rotation = rotation_of(rotate_size, rotate_time)
    raise typer.Exit(simulate_mission(mission, seed, record, autopilot, json, rotation))


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
    force: Force = False,
) -> None:
    """Write a world of one of the benchmark families as a mission file."""
    from companion.cli.worlds import write_world

    raise typer.Exit(write_world(family, seed, output, force))


@mission_app.command("convert")
def mission_convert(
    source: Annotated[Path, typer.Argument(metavar="IN", help="YAML mission, QGroundControl .plan, or QGC WPL 110.")],
    target: Annotated[Path, typer.Argument(metavar="OUT", help="Its ending says how: .yaml, .plan, .waypoints.")],
    force: Force = False,
    json: Json = False,
) -> None:
    """Write a mission in another format; what that format cannot say is told."""
    from companion.cli.convert import convert_mission

    raise typer.Exit(convert_mission(source, target, force, json))


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
    from companion.cli.replay import Asked, replay_log

    wanted = selection(topic, message, sysid, start, duration)
    asked = Asked(rate, wanted, endpoint, None if loop else 1, answer, to_a_vehicle, live)
    raise typer.Exit(replay_log(log, to, asked, json))


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
def tune(
    spec: Annotated[Path, typer.Argument(metavar="SPEC", help="What to tune (YAML): docs/tuning.md.")],
    method: Annotated[
        Literal["haoaroa", "aoa", "roa", "de", "cma"], typer.Option(help="Optimiser; cma wants the extra `tune`.")
    ] = "haoaroa",
    jobs: Annotated[int, typer.Option("-j", "--jobs", help="Processes.", min=1, max=64)] = 2,
    out: Annotated[
        Path | None, typer.Option("--out", metavar="DIR", help="Folder of the result (default: tunings/SPEC-METHOD).")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Go on with the evaluations in the folder.")] = False,
    json: Json = False,
) -> None:
    """Find gains by whole flights, and judge them on seeds that the search has not seen."""
    from companion.cli.tune import tune_gains

    raise typer.Exit(tune_gains(spec, method, jobs, out, resume, json))


@app.command()
def paper(
    quick: Annotated[bool, typer.Option("--quick", help="All of it in minutes, with fewer worlds and runs.")] = False,
    out: Annotated[
        Path, typer.Option("--out", metavar="DIR", help="Folder of the page, its pictures and the work that is kept.")
    ] = Path("paper"),
    jobs: Annotated[int, typer.Option("-j", "--jobs", help="Processes.", min=1, max=64)] = 2,
    json: Json = False,
) -> None:
    """Make the paper's tables and figures again, each claim with a verdict. Goes on where it was interrupted."""
    from companion.cli.paper import make

    raise typer.Exit(make(quick, out, jobs, json))


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


FLIGHT_KEYS = (
    *("mission", "seed", "duration_s", "path_length_m", "tracking_error_p95_m", "min_clearance_m"),
    *("setpoint_rate_hz", "setpoint_gap_max_ms", "recording"),
)
"""What the JSON of a flight always has; null where an error came first."""

INTERRUPTED = 130
"""What the command-line library ends with on Ctrl-C where no flight listens for it."""
UsageError = typer.BadParameter.__mro__[1]
"""Its root of wrong usage, which it does not tell by name."""


def main() -> None:
    """Console script: a known error is one line on stderr (and a JSON object, if asked for) and exit code 1 or 2."""
    try:
        code = app(with_live_port(sys.argv[1:]), prog_name="companion", standalone_mode=False)
    except typer.Abort:
        code = INTERRUPTED
    except Exception as error:
        if isinstance(error, UsageError):
            _wrong_usage(error)
        if not isinstance(error, _known_errors()):
            raise
        _fail(str(error), _exit_code(error))
    if code == INTERRUPTED:
        _fail("interrupted", 1)
    sys.exit(code)


def _wrong_usage(error: Any) -> NoReturn:
    """What the command-line library says of it, in one line; nothing more where it has shown the help instead."""
    text = " ".join(error.format_message().split()).replace("Value error, ", "").removeprefix("Invalid value: ")
    command = "companion" if error.ctx is None else error.ctx.command_path
    if not text:
        sys.exit(2)
    _fail(f"{text[0].lower()}{text[1:].rstrip('.')}; see {command} --help", 2)


def with_live_port(arguments: list[str]) -> list[str]:
    """The arguments with a port behind every `--live` that has none: an option's value cannot be left out."""
    given: list[str] = []
    for at, word in enumerate(arguments):
        bare = word == LIVE and not (at + 1 < len(arguments) and arguments[at + 1].lstrip("-").isdigit())
        given += [word, LIVE_PORT] if bare else [word]
    return given


def _fail(text: str, code: int) -> NoReturn:
    shown = "".join(c if c.isprintable() or c == "\n" else "?" for c in text)  # it may quote a file
    print(f"companion: {shown}", file=sys.stderr)
    if "--json" in sys.argv:
        from companion.cli.show import print_json

        flight = sys.argv[1] in ("demo", "fly", "simulate")
        print_json({"ok": False, "failure": text, **dict.fromkeys(FLIGHT_KEYS if flight else ())})
    sys.exit(code)


def _exit_code(error: Exception) -> int:
    from campaigns.errors import AddressError, CampaignInterrupted
    from wire.errors import EndpointError

    if isinstance(error, CampaignInterrupted):
        return INTERRUPTED
    return 2 if isinstance(error, EndpointError | AddressError) else 1


def _known_errors() -> tuple[type[Exception], ...]:
    from campaigns.errors import CampaignError
    from companion.errors import CompanionError
    from fakevehicle.errors import VehicleError
    from logs.errors import LogsError
    from planner.errors import PlannerError
    from wire.errors import WireError

    return (CampaignError, CompanionError, LogsError, PlannerError, VehicleError, WireError)
