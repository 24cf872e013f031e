"""The command line of the simulated vehicle: options into a configuration, then the driver until Ctrl-C."""

import difflib
import math
import signal
import sys
import time
from typing import Annotated, NoReturn

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from fakevehicle.airframe import load_airframe
from fakevehicle.config import MAX_LINKS, LinkConfig, VehicleConfig
from fakevehicle.driver import PX4_LINKS, DriverCounters, LinkPlan, open_links, run
from fakevehicle.errors import AirframeError, VehicleError
from fakevehicle.vehicle import PARAMETERS, TICK_US, Vehicle
from fakevehicle.vocabulary import FloatArray, Geodetic
from wire.endpoint import Endpoint
from wire.errors import EndpointError, LinkError
from wire.udp import UdpLink

REHEARSAL_TICKS = 1000
"""Ticks a throw-away vehicle is run, so that every kernel is compiled before the clock starts."""

STRONGEST_WIND = 60.0
"""Of --wind [m/s]; a hurricane."""
SLOWEST, FASTEST = 0.01, 1000.0
"""Of --speed; how fast it really gets is the machine's to say."""

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
    airframe: Annotated[str, typer.Option(help="A shipped airframe, or a YAML file.")] = "x500",
    home: Annotated[
        str, typer.Option(metavar="LAT,LON,ALT,HEADING", help="Degrees, metres above sea level, degrees.")
    ] = "47.397742,8.545594,488,0",
    wind: Annotated[
        str, typer.Option(metavar="N,E,D", help="Where the air moves to: north, east, down, m/s.")
    ] = "0,0,0",
    seed: Annotated[int, typer.Option(help="Of every random number.")] = 1,
    param: Annotated[list[str] | None, typer.Option("--param", metavar="NAME=VALUE", help="Set a parameter.")] = None,
    speed: Annotated[
        float, typer.Option(help="Simulated seconds in one second; a companion in real time needs 1.")
    ] = 1.0,
    list_params: Annotated[
        bool, typer.Option("--list-params", help="Print every parameter with range, unit and meaning, and end.")
    ] = False,
) -> None:
    """A simulated PX4 quadrotor that speaks MAVLink over UDP.

    Without --connect it sends to 127.0.0.1:14550 (ground station) and 127.0.0.1:14540 (companion), as PX4 does.
    """
    if list_params:
        _list_parameters()
        return
    try:
        plans = _plans(connect or [])
        if not SLOWEST <= speed <= FASTEST:
            raise ValueError(f"--speed {speed:g}: expected {SLOWEST:g} to {FASTEST:g}")
        place, heading = _home(home)
        config = VehicleConfig(
            airframe=airframe,
            home=place,
            heading=heading,
            wind_n=_wind(wind),
            seed=seed,
            links=tuple(LinkConfig(plan.name, plan.profile) for plan in plans),
            start_unix_us=time.time_ns() // 1000,
        )
        parameters = dict(_parameter(text) for text in param or [])
        load_airframe(airframe)
    except AirframeError as error:
        _fail(f"--airframe {airframe}: {error}", 2)
    except (ValueError, EndpointError) as error:
        _fail(str(error), 2)
    try:
        links = open_links(plans)
    except LinkError as error:
        _fail(str(error), 1)
    try:
        counters = _fly(config, parameters, plans, links, speed)
    except VehicleError as error:
        _fail(str(error), 1)
    finally:
        for link in links.values():
            link.close()
    late = f", {counters.late} late" if counters.late else ""
    slipped = f", {counters.slipped_s:.2f} s slower than asked" if counters.slipped_s else ""
    _say(f"stopped after {counters.ticks * TICK_US * 1e-6:.1f} s ({counters.ticks} ticks{late}{slipped})")


def _fly(
    config: VehicleConfig,
    parameters: dict[str, float],
    plans: list[LinkPlan],
    links: dict[str, UdpLink],
    speed: float,
) -> DriverCounters:
    """Warm up, say that it is ready, and run until a signal."""
    signals: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _frame: signals.append(number))
    began = time.monotonic()
    with Console(stderr=True).status("compiling the flight code (the first time takes a while)"):
        rehearsal = Vehicle(config, parameters)
        for tick in range(REHEARSAL_TICKS):
            if signals:
                return DriverCounters()
            rehearsal.step(tick * TICK_US, [])
        vehicle = Vehicle(config, parameters)
    where = ", ".join(f"{plan.name} {_route(plan, links[plan.name])}" for plan in plans)
    h = config.home
    place = f"{math.degrees(h.latitude):.7f},{math.degrees(h.longitude):.7f},{h.altitude:g} m"
    _say(f"ready in {time.monotonic() - began:.1f} s: system {config.system_id}, home {place}; links: {where}")
    flying = vehicle.flying
    shown = (flying.mode, flying.armed)

    def watch(now_us: int) -> None:
        nonlocal shown
        for text in vehicle.take_texts():
            _say(f"[{now_us * 1e-6:9.3f}] {text}")
        if (flying.mode, flying.armed) != shown:
            shown = (flying.mode, flying.armed)
            _say(f"[{now_us * 1e-6:9.3f}] {flying.mode.title}, {'armed' if flying.armed else 'disarmed'}")

    return run(vehicle, links, speed=speed, stopped=lambda: bool(signals), watch=watch)


def _plans(urls: list[str]) -> list[LinkPlan]:
    """The links to open: PX4's own two, or one for each URL."""
    if not urls:
        return list(PX4_LINKS)
    if len(urls) > MAX_LINKS:
        raise ValueError(f"{len(urls)} times --connect: expected at most {MAX_LINKS}")
    names = ["onboard"] + [f"onboard{i}" for i in range(2, len(urls) + 1)]
    return [LinkPlan(name, "onboard", Endpoint.parse(url)) for name, url in zip(names, urls, strict=True)]


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


def _parameter(text: str) -> tuple[str, float]:
    """Name and value; the name must exist."""
    name, separator, value = text.partition("=")
    known = {p.name: p for p in PARAMETERS}
    if not separator:
        raise ValueError(f"--param {text}: expected NAME=VALUE")
    if name not in known:
        near = difflib.get_close_matches(name, known, n=1)
        raise ValueError(f"--param {text}: no parameter {name}" + (f", did you mean {near[0]}?" if near else ""))
    try:
        return name, float(known[name].coerced(float(value)))
    except ValueError as error:
        raise ValueError(f"--param {text}: {error}") from error


def _list_parameters() -> None:
    """A table of every parameter."""
    table = Table("parameter", "default", "range", "unit", "meaning")
    for p in sorted(PARAMETERS, key=lambda p: p.name):
        table.add_row(p.name, f"{p.default:g}", f"{p.minimum:g}..{p.maximum:g}", p.unit, p.description)
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
