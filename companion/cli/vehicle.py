"""The bundled vehicle, set up as a mission asks: in this process for lockstep, as a process of its own over UDP."""

import math
import subprocess
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from companion.errors import CompanionError
from companion.geodesy import to_geodetic
from companion.mission import Mission, solid_of
from companion.seam import Vector
from fakevehicle.config import Autopilot, LinkConfig, VehicleConfig, zurich
from fakevehicle.faults import parse_fault
from fakevehicle.physics.wind import Gust
from fakevehicle.scenario import world_text
from fakevehicle.sensors.movers import Movers, PopUp
from fakevehicle.sensors.obstacles import World as Seen
from fakevehicle.vehicle import Vehicle
from fakevehicle.vocabulary import Geodetic
from planner.worlds import Box, Cylinder, Prism, Sphere

LINK = "onboard"
"""The vehicle's name for its link to the companion."""
KINDS = ("boxes", "spheres", "cylinders", "walls")
"""Of solids, as the vehicle's sensors know them."""


def seen_world(mission: Mission) -> Seen | None:
    """What the vehicle's sensors see of the mission's world, from where it starts; None: it needs none.

    Obstacles, hidden ones too, pop-ups and movers. Of a prism they see the sides only; voxels and clouds are not handed
    over.
    """
    start = mission.vehicle.start
    seen = _solids(mission.whole_world().obstacles, start.north, start.east)
    popups = tuple(
        PopUp(_solids([solid_of(p)], start.north, start.east), None if p.at is None else round(1e6 * p.at), p.within)
        for p in mission.world.popups
    )
    movers = _movers(mission) if mission.world.movers else None
    if not mission.senses() and movers is None and not popups and not any(len(getattr(seen, k)) for k in KINDS):
        return None
    return replace(seen, movers=movers, popups=popups)


def _solids(obstacles: Iterable[object], north: float, east: float) -> Seen:
    """The planner's solids, moved from the mission frame to one whose origin is at (north, east)."""
    rows: dict[str, list[tuple[float, ...]]] = {kind: [] for kind in KINDS}
    for obstacle in obstacles:
        match obstacle:
            case Box(lower, upper):
                low, high = (lower[0] - north, lower[1] - east, lower[2]), (upper[0] - north, upper[1] - east, upper[2])
                rows["boxes"].append((*low, *high))
            case Sphere(centre, radius):
                rows["spheres"].append((centre[0] - north, centre[1] - east, centre[2], radius))
            case Cylinder(middle, radius, z):
                rows["cylinders"].append((middle[0] - north, middle[1] - east, radius, *z))
            case Prism(corners, z):
                ends = [(n - north, e - east) for n, e in corners]
                rows["walls"] += [(*a, *b, *z) for a, b in zip(ends, [*ends[1:], ends[0]], strict=True)]
            case _:
                pass
    return Seen(
        boxes=np.array(rows["boxes"]).reshape(-1, 6),
        spheres=np.array(rows["spheres"]).reshape(-1, 4),
        cylinders=np.array(rows["cylinders"]).reshape(-1, 5),
        walls=np.array(rows["walls"]).reshape(-1, 6),
    )


def home_of(mission: Mission) -> Geodetic:
    """Where on the earth the vehicle stands: by the mission's origin, where it has one."""
    origin = mission.geodetic_origin()
    if origin is None:
        return zurich()
    latitude, longitude = to_geodetic(origin, *mission.start_m()[:2])
    return Geodetic(math.radians(latitude), math.radians(longitude), origin.altitude)


def _movers(mission: Mission) -> Movers:
    """The mission's movers and the block that reflects them, from where the vehicle starts."""
    start, (low, high) = mission.start_m(), mission.whole_world().bounds
    balls = [
        (m.sphere.north, m.sphere.east, -m.sphere.altitude, v.north, v.east, -v.up, m.sphere.radius)
        for m in mission.world.movers
        for v in (m.velocity,)
    ]
    here = np.array(start)
    return Movers(np.array(balls) - np.array([*start, 0, 0, 0, 0]), np.array(low) - here, np.array(high) - here)


def build_vehicle(
    mission: Mission,
    seed: int,
    autopilot: Autopilot = "px4",
    *,
    faults: Iterable[str] = (),
    gusts: Sequence[Gust] = (),
    wind: Vector | None = None,
    parameters: Mapping[str, float] | None = None,
    airframe: str = "x500",
) -> Vehicle:
    """The vehicle in memory, standing where the mission starts, in its wind.

    Parameters
    ----------
    faults : as `fakevehicle.faults.parse_fault` reads them.
    wind : north, east, down [m/s]; None: the mission's.
    parameters : of the vehicle, where they differ from its defaults.
    airframe : of a shipped one the name, else the path of a YAML file.
    """
    blowing = (mission.wind.north, mission.wind.east, mission.wind.down) if wind is None else wind
    config = VehicleConfig(
        airframe=airframe,
        home=home_of(mission),
        heading=mission.heading(),
        wind_n=np.array(blowing),
        seed=seed,
        links=(LinkConfig(LINK, "onboard"),),
        autopilot=autopilot,
        faults=tuple(parse_fault(text) for text in faults),
        gusts=tuple(gusts),
        world=seen_world(mission),
    )
    return Vehicle(config, parameters)


@contextmanager
def running_vehicle(
    mission: Mission, url: str, seed: int, log: Path, autopilot: Autopilot = "px4"
) -> Iterator[subprocess.Popen[bytes]]:
    """The vehicle as a process of its own, calling `url`; what it prints goes to `log`. Ended at the end."""
    home, wind = home_of(mission), mission.wind
    place = f"{math.degrees(home.latitude):.7f},{math.degrees(home.longitude):.7f},{home.altitude:g}"
    command = [
        *(sys.executable, "-m", "fakevehicle", "--connect", url, "--seed", str(seed), "--autopilot", autopilot),
        *("--home", f"{place},{mission.vehicle.start.heading_deg:g}"),
        *("--wind", f"{wind.north:g},{wind.east:g},{wind.down:g}"),
        "--until-stdin-ends",  # should we be killed, so is it
    ]
    world, scenario = seen_world(mission), log.with_suffix(".scenario.yaml")
    try:
        out = log.open("wb")
        if world is not None:
            scenario.write_text(world_text(world), encoding="utf-8")
            command += ["--scenario", str(scenario)]
    except OSError as error:
        raise CompanionError(f"{log}: cannot be written: {error.strerror or error}") from error
    with out:
        # A session of its own, so that Ctrl-C lands the flight instead of killing the vehicle under it.
        process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=out, stderr=subprocess.STDOUT, start_new_session=True
        )
    try:
        yield process
    finally:
        process.terminate()
        try:
            process.wait(timeout=5)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
