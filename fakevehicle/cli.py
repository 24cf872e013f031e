"""The command line of the simulated vehicle: options into a configuration, then the driver until Ctrl-C."""

import math
import os
import signal
import sys
import threading
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, NoReturn, cast, get_args

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from fakevehicle.airframe import load_airframe
from fakevehicle.config import MAX_LINKS, Autopilot, Gains, LinkConfig, VehicleConfig
from fakevehicle.driver import DriverCounters, LinkPlan, Seat, open_links, px4_links, run
from fakevehicle.errors import AirframeError, ParameterFileError, ScenarioError, VehicleError
from fakevehicle.faults import parse_fault
from fakevehicle.geodesy import to_geodetic
from fakevehicle.overrides import known_parameters, parameters_of
from fakevehicle.param_file import ParameterFile
from fakevehicle.recordings import FlightLog, Folder
from fakevehicle.scenario import Scenario, load_scenario
from fakevehicle.vehicle import TICK_US, Vehicle
from fakevehicle.vocabulary import FloatArray, Geodetic
from logs.errors import RecordingError
from logs.parts import Rotation, rotation_of
from logs.recovery import recover_unfinished
from wire.endpoint import Endpoint
from wire.errors import EndpointError, LinkError
from wire.udp import UdpLink

REHEARSAL_TICKS = 1000
"""Ticks a throw-away vehicle is run, so that every kernel is compiled before the clock starts."""

STRONGEST_WIND = 60.0
"""Of --wind [m/s]; a hurricane."""
SLOWEST, FASTEST = 0.01, 1000.0
"""Of --speed; how fast it really gets is the machine's to say."""
MOST_VEHICLES = 100
SPACING = 3.0
"""Several vehicles stand in a row to the east, this far apart [m]."""

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)


def main() -> None:
    """The console script."""
    app()


@app.command()
def fly(
    connect: Annotated[
        list[str] | None,
        typer.Option("--connect", metavar="URL", help="A link for a companion: udpout:HOST:PORT or udpin:HOST:PORT."),
    ] = None,
    autopilot: Annotated[str, typer.Option(metavar="px4|ardupilot", help="Whose MAVLink behaviour it shows.")] = "px4",
    gains: Annotated[
        str,
        typer.Option(metavar="|".join(get_args(Gains)), help="Ours, the paper's, or a special case."),
    ] = "default",
    airframe: Annotated[str, typer.Option(help="A shipped airframe, or a YAML file.")] = "x500",
    home: Annotated[
        str, typer.Option(metavar="LAT,LON,ALT,HEADING", help="Degrees, metres above sea level, degrees.")
    ] = "47.397742,8.545594,488,0",
    wind: Annotated[
        str, typer.Option(metavar="N,E,D", help="Where the air moves to: north, east, down, m/s.")
    ] = "0,0,0",
    seed: Annotated[int, typer.Option(help="Of every random number.")] = 1,
    param: Annotated[list[str] | None, typer.Option("--param", metavar="NAME=VALUE", help="Set a parameter.")] = None,
    params: Annotated[
        list[Path] | None,
        typer.Option("--params", metavar="FILE", help="Parameters from a .params or .parm file; --param goes over it."),
    ] = None,
    fault: Annotated[
        list[str] | None,
        typer.Option(metavar="SENSOR:KIND[=NUMBERS][@START[-END]]", help="Something fails, as in gps:off@20-40 (s)."),
    ] = None,
    scenario: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Faults, gusts and a world of obstacles, as YAML.")
    ] = None,
    speed: Annotated[
        float, typer.Option(help="Simulated seconds in one second; a companion in real time needs 1.")
    ] = 1.0,
    count: Annotated[
        int, typer.Option(help="How many vehicles: system ids, ports and seeds count up, 3 m apart to the east.")
    ] = 1,
    instance: Annotated[
        int, typer.Option(help="Number of the first one, as PX4 counts them: system id instance + 1, ports + instance.")
    ] = 0,
    record: Annotated[
        Path | None,
        typer.Option(metavar="FOLDER", help="Record everything and the truth (MCAP); also offered as logs."),
    ] = None,
    record_sensors: Annotated[
        bool, typer.Option("--record-sensors", help="With --record: what the estimator takes, for companion rerun.")
    ] = False,
    rotate_size: Annotated[
        float | None, typer.Option(metavar="MB", help="With --record: begin a new part of this size.", min=0.1)
    ] = None,
    rotate_time: Annotated[
        float | None, typer.Option(metavar="S", help="With --record: begin a new part this often.", min=1.0)
    ] = None,
    until_stdin_ends: Annotated[
        bool, typer.Option("--until-stdin-ends", help="End when standard input does: with the process that began it.")
    ] = False,
    list_params: Annotated[
        bool, typer.Option("--list-params", help="Print every parameter with range, unit and meaning, and end.")
    ] = False,
) -> None:
    """A simulated quadrotor that speaks MAVLink over UDP, as PX4 or ArduPilot does.

    Without --connect it sends to 127.0.0.1:14550 (ground station) and 127.0.0.1:14540 (companion), as PX4 does.
    """
    if list_params:
        _list_parameters(_autopilot(autopilot))
        return
    started_s = time.time()
    try:
        if not 1 <= count <= MOST_VEHICLES:
            raise ValueError(f"--count {count}: expected 1 to {MOST_VEHICLES}")
        if not 0 <= instance <= 255 - count:
            raise ValueError(f"--instance {instance}: expected 0 to {255 - count}")
        if not SLOWEST <= speed <= FASTEST:
            raise ValueError(f"--speed {speed:g}: expected {SLOWEST:g} to {FASTEST:g}")
        for option, given in (
            ("--record-sensors", record_sensors),
            ("--rotate-size", rotate_size is not None),
            ("--rotate-time", rotate_time is not None),
        ):
            if given and record is None:
                raise ValueError(f"{option}: expected --record FOLDER with it")
        place, heading = _home(home)
        kind = _autopilot(autopilot)
        parameters, loaded = _parameters(params or [], param or [], kind)
        load_airframe(airframe)
        events = Scenario() if scenario is None else load_scenario(scenario)
        faults = (*events.faults, *(parse_fault(text) for text in fault or []))
        crew: list[_Plan] = []
        for i in range(count):
            plans = _plans(connect or [], instance + i, i)
            config = VehicleConfig(
                airframe=airframe,
                home=to_geodetic(np.array([0.0, SPACING * i, 0.0]), place) if i else place,
                heading=heading,
                wind_n=_wind(wind),
                seed=seed + i,
                links=tuple(LinkConfig(plan.name, plan.profile) for plan in plans),
                system_id=instance + i + 1,
                start_unix_us=round(started_s * 1e6),
                instance=instance + i,
                autopilot=kind,
                gains=_gains(gains),
                faults=faults,
                gusts=events.gusts,
                world=events.world,
            )
            folder = record if record is None or count == 1 else record / str(config.system_id)
            crew.append(_Plan(config, parameters, plans, folder, record_sensors, rotation_of(rotate_size, rotate_time)))
    except AirframeError as error:
        _fail(f"--airframe {airframe}: {error}", 2)
    except (ValueError, EndpointError, ScenarioError, ParameterFileError) as error:
        _fail(str(error), 2)
    for file in loaded:
        _say(file.summary())
    links: list[dict[str, UdpLink]] = []
    try:
        for one in crew:
            links.append(open_links(one.links))
        counters = _fly(crew, links, speed, started_s, until_stdin_ends)
    except (LinkError, RecordingError, VehicleError) as error:
        _fail(str(error), 1)
    finally:
        for opened in links:
            for link in opened.values():
                link.close()
    late = f", {counters.late} late" if counters.late else ""
    slipped = f", {counters.slipped_s:.2f} s slower than asked" if counters.slipped_s else ""
    _say(f"stopped after {counters.ticks * TICK_US * 1e-6:.1f} s ({counters.ticks} ticks{late}{slipped})")


@dataclass(frozen=True, slots=True)
class _Plan:
    """One vehicle before anything of it is open."""

    config: VehicleConfig
    parameters: dict[str, float]
    links: list[LinkPlan]
    folder: Path | None
    sensors: bool
    rotation: Rotation | None


def _await_end_of_stdin(signals: list[int]) -> None:
    while os.read(0, 4096):  # not through sys.stdin, whose lock a thread must not hold when the process ends
        pass
    signals.append(0)


def _fly(
    crew: list[_Plan], links: list[dict[str, UdpLink]], speed: float, started_s: float, until_stdin_ends: bool
) -> DriverCounters:
    """Warm up, say that all are ready, and run until a signal, or until standard input ends where that is asked."""
    signals: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _frame: signals.append(number))
    if until_stdin_ends:
        threading.Thread(target=_await_end_of_stdin, args=(signals,), daemon=True).start()
    began = time.monotonic()
    with Console(stderr=True).status("compiling the flight code (the first time takes a while)"):
        rehearsal = Vehicle(crew[0].config, crew[0].parameters)
        for tick in range(REHEARSAL_TICKS):
            if signals:
                return DriverCounters()
            rehearsal.step(tick * TICK_US, [])
    seats: list[Seat] = []
    try:
        for one, opened in zip(crew, links, strict=True):
            seats.append(_seat(one, opened, started_s, f"{one.config.system_id}: " if len(crew) > 1 else ""))
        for one, seat in zip(crew, seats, strict=True):
            where = ", ".join(f"{plan.name} {_route(plan, seat.links[plan.name])}" for plan in one.links)
            h = one.config.home
            place = f"{math.degrees(h.latitude):.7f},{math.degrees(h.longitude):.7f},{h.altitude:g} m"
            into = f"; recording: {seat.log.path}" if seat.log is not None else ""
            _say(
                f"ready in {time.monotonic() - began:.1f} s: "
                f"system {one.config.system_id}, home {place}; links: {where}{into}"
            )
        return run(seats, speed=speed, stopped=lambda: bool(signals))
    finally:
        for seat in seats:
            if seat.log is not None:
                seat.log.close()


def _seat(one: _Plan, links: dict[str, UdpLink], started_s: float, name: str) -> Seat:
    """A vehicle in its seat; what it says and does is printed, behind `name`."""
    files = log = None
    if one.folder is not None:
        files = Folder(one.folder)
        for recovered in recover_unfinished(one.folder):
            _say(str(recovered))
        log = FlightLog(
            *(one.folder, one.config, one.parameters),
            started_unix_s=started_s,
            sensors=one.sensors,
            rotation=one.rotation,
        )
    vehicle = Vehicle(one.config, one.parameters, files)
    shown = (vehicle.flying.mode, vehicle.flying.armed)

    def watch(now_us: int) -> None:
        nonlocal shown
        for text in vehicle.take_texts():
            _say(f"[{now_us * 1e-6:9.3f}] {name}{text}")
        flying = vehicle.flying  # another one after a reboot
        if (flying.mode, flying.armed) != shown:
            shown = (flying.mode, flying.armed)
            _say(f"[{now_us * 1e-6:9.3f}] {name}{flying.mode.title}, {'armed' if flying.armed else 'disarmed'}")

    return Seat(vehicle, links, watch, log)


def _plans(urls: list[str], instance: int, number: int) -> list[LinkPlan]:
    """The links to open: PX4's own two, or one for each URL.

    Of several vehicles each listens on a port of its own, counting up from the URL's; all call the same one.
    """
    if not urls:
        return list(px4_links(instance))
    if len(urls) > MAX_LINKS:
        raise ValueError(f"{len(urls)} times --connect: expected at most {MAX_LINKS}")
    names = ["onboard"] + [f"onboard{i}" for i in range(2, len(urls) + 1)]
    ends = [Endpoint.parse(url) for url in urls]
    moved = [replace(end, port=end.port + number) if end.kind == "udpin" and end.port else end for end in ends]
    return [LinkPlan(name, "onboard", end) for name, end in zip(names, moved, strict=True)]


def _numbers(option: str, text: str, names: str) -> list[float]:
    """Comma-separated finite numbers, as many as `names` has."""
    expected = names.split(",")
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != len(expected) or not all(math.isfinite(value) for value in values):
        raise ValueError(f"{option} {text}: expected {len(expected)} numbers {names}")
    return values


def _home(text: str) -> tuple[Geodetic, float]:
    """Place and heading [rad]."""
    latitude, longitude, altitude, heading = _numbers("--home", text, "LAT,LON,ALT,HEADING")
    if not (abs(latitude) <= 90.0 and abs(longitude) <= 180.0):
        raise ValueError(f"--home {text}: latitude or longitude is not on the globe")
    if not -500.0 <= altitude <= 10_000.0 or abs(heading) > 360.0:
        raise ValueError(f"--home {text}: expected an altitude of -500..10000 m and a heading of -360..360 degrees")
    return Geodetic(math.radians(latitude), math.radians(longitude), altitude), math.radians(heading)


def _wind(text: str) -> FloatArray:
    """(3,) [m/s]."""
    wind = np.array(_numbers("--wind", text, "N,E,D"))
    if np.abs(wind).max() > STRONGEST_WIND:
        raise ValueError(f"--wind {text}: expected at most {STRONGEST_WIND:g} m/s on an axis")
    return wind


def _autopilot(text: str) -> Autopilot:
    """One of the flavours."""
    known = {name: name for name in get_args(Autopilot)}
    if text not in known:
        _fail(f"--autopilot {text}: expected one of {', '.join(known)}", 2)
    return cast(Autopilot, known[text])


def _gains(text: str) -> Gains:
    """One of the presets."""
    known = {name: name for name in get_args(Gains)}
    if text not in known:
        raise ValueError(f"--gains {text}: expected one of {', '.join(known)}")
    return cast(Gains, known[text])


def _parameters(
    paths: list[Path], texts: list[str], autopilot: Autopilot
) -> tuple[dict[str, float], list[ParameterFile]]:
    try:
        return parameters_of(paths, texts, autopilot)
    except ValueError as error:
        raise ValueError(f"--param {error}") from error


def _list_parameters(autopilot: Autopilot) -> None:
    """A table of every parameter."""
    _, named = known_parameters(autopilot)
    table = Table("parameter", "default", "range", "unit", "meaning")
    for name in named:
        p = named.describe(name)
        table.add_row(p.name, f"{named[name]:g}", f"{p.minimum:g}..{p.maximum:g}", p.unit, p.description)
    Console().print(table)


def _route(plan: LinkPlan, link: UdpLink) -> str:
    """Where a link goes, for people."""
    host, port = link.local_address
    arrow = f" -> {plan.endpoint.host}:{plan.endpoint.port}" if plan.endpoint.kind == "udpout" else " (listening)"
    return f"{host}:{port}{arrow}"


def _say(line: str) -> None:
    """One line of the log, at once, also into a pipe."""
    print(line, flush=True)


def _fail(line: str, code: int) -> NoReturn:
    """One clear line, and out."""
    print(f"fakevehicle: {line}", file=sys.stderr)
    raise typer.Exit(code)
