"""`companion fly` and `companion demo`: a mission over UDP, recorded, judged at the end."""

from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from companion.cli import show
from companion.cli.flown import fly_recorded, vehicle_log
from companion.cli.operator import Operator
from companion.core import CompanionConfig
from companion.fleet.missions import has_vehicles, split
from companion.missionfile import parse_mission, read_mission_file
from companion.service.queue import recording_file
from companion.vehiclelink import VEHICLE_LINK
from logs.errors import LogsError
from logs.parts import Rotation
from wire.endpoint import Endpoint
from wire.udp import UdpLink

if TYPE_CHECKING:
    from fakevehicle.config import Autopilot


def fly_demo(
    record: Path,
    outs: list[str],
    seed: int,
    autopilot: "Autopilot",
    as_json: bool,
    rotation: Rotation | None = None,
    live: int | None = None,
) -> int:
    """The embedded default: the bundled vehicle as its own process, on a port the system chooses."""
    from companion.cli.vehicle import build_vehicle, running_vehicle
    from fakevehicle.recordings import parameters_of

    data = (resources.files("missions") / "l_shape.yaml").read_bytes()
    mission = parse_mission(data, "missions/l_shape.yaml")
    file = recording_file(record, mission)
    with UdpLink(VEHICLE_LINK, Endpoint.parse("udpin:127.0.0.1:0")) as free:
        host, port = free.local_address
    endpoints = {VEHICLE_LINK: Endpoint("udpin", host, port)} | ground_endpoints(outs)
    config = CompanionConfig(seed=seed, ground_links=tuple(endpoints)[1:])
    operator, url = Operator(), f"udpout:{host}:{port}"
    known = [parameters_of(build_vehicle(mission, seed, autopilot))]
    with operator.listening(), running_vehicle(mission, url, seed, vehicle_log(file), autopilot) as vehicle:
        flown = fly_recorded(
            *(mission, data, endpoints, file, config, operator),
            rotation=rotation,
            known=known,
            live=live,
            watch=vehicle,
        )
    return flown.tell(as_json, page_beside(flown.recording))


def fly_mission(
    path: Path,
    master: str | None,
    outs: list[str],
    record: Path,
    seed: int,
    system_id: int | None,
    wait_s: float,
    autopilot: "Autopilot | None",
    as_json: bool,
    rotation: Rotation | None = None,
    live: int | None = None,
) -> int:
    """Fly `path` on whatever answers at `master`, or its several vehicles on bundled ones; returns the exit code."""
    data = read_mission_file(path)
    if has_vehicles(data):
        from companion.cli.several import fly_several

        if live is not None:
            raise typer.BadParameter("found with several vehicles, expected with one", param_hint="--live")
        if master is not None or outs or system_id is not None:
            several = "of a file with vehicles each is a bundled one, at a port of its own"
            raise typer.BadParameter(f"found with {path}, expected without: {several}", param_hint="--master")
        return fly_several(split(data, str(path)), path, seed, record, autopilot or "px4", as_json, rotation)
    if master is None:
        raise typer.BadParameter("found nothing, expected the URL where the vehicle is", param_hint="--master")
    if autopilot is not None:
        told = "found with one vehicle, which tells itself what it is, expected with a file of several"
        raise typer.BadParameter(told, param_hint="--autopilot")
    mission = parse_mission(data, str(path))
    endpoints = {VEHICLE_LINK: Endpoint.parse(master)} | ground_endpoints(outs)
    config = CompanionConfig(
        seed=seed,
        system_id=system_id,
        ground_links=tuple(endpoints)[1:],
        speaks_first=endpoints[VEHICLE_LINK].kind == "udpout",
        wait_vehicle_s=wait_s,
    )
    operator = Operator()
    with operator.listening():
        file = recording_file(record, mission)
        flown = fly_recorded(mission, data, endpoints, file, config, operator, rotation=rotation, live=live)
        return flown.tell(as_json)


def page_beside(recording: Path) -> Path | None:
    """Write a recording's page beside it; None: it could not be, which is told and is no fault of the flight."""
    from companion.cli.report import write_report

    page = recording.with_suffix(".html")
    try:
        write_report(recording, page)
    except LogsError as error:
        show.console().print(show.plain(str(error)), soft_wrap=True)
        return None
    return page


def ground_endpoints(outs: list[str]) -> dict[str, Endpoint]:
    """The ground stations' links by name."""
    return {f"out{k}": Endpoint.parse(url) for k, url in enumerate(outs)}
