"""The bundled vehicle, set up as a mission asks: in this process for lockstep, as a process of its own over UDP."""

import math
import subprocess
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from companion.errors import CompanionError
from companion.mission import Mission
from companion.seam import Vector
from fakevehicle.config import Autopilot, LinkConfig, VehicleConfig, zurich
from fakevehicle.faults import parse_fault
from fakevehicle.physics.wind import Gust
from fakevehicle.scenario import world_text
from fakevehicle.sensors.obstacles import World as Seen
from fakevehicle.vehicle import Vehicle
from planner.worlds import Box, Cylinder, Prism, Sphere

LINK = "onboard"
"""The vehicle's name for its link to the companion."""


def seen_world(mission: Mission) -> Seen | None:
    """The mission's obstacles as the vehicle's sensors see them, from where it starts; None: there are none.

    Of a prism they see the sides only; voxels and clouds are not handed over.
    """
    start = mission.vehicle.start
    north, east = start.north, start.east
    boxes: list[tuple[float, ...]] = []
    spheres: list[tuple[float, ...]] = []
    cylinders: list[tuple[float, ...]] = []
    walls: list[tuple[float, ...]] = []
    for obstacle in mission.whole_world().obstacles:
        match obstacle:
            case Box(lower, upper):
                low, high = (lower[0] - north, lower[1] - east, lower[2]), (upper[0] - north, upper[1] - east, upper[2])
                boxes.append((*low, *high))
            case Sphere(centre, radius):
                spheres.append((centre[0] - north, centre[1] - east, centre[2], radius))
            case Cylinder(middle, radius, z):
                cylinders.append((middle[0] - north, middle[1] - east, radius, *z))
            case Prism(corners, z):
                ends = [(n - north, e - east) for n, e in corners]
                walls += [(*a, *b, *z) for a, b in zip(ends, [*ends[1:], ends[0]], strict=True)]
            case _:
                pass
    if not (boxes or spheres or cylinders or walls):
        return None
    return Seen(
        boxes=np.array(boxes).reshape(-1, 6),
        spheres=np.array(spheres).reshape(-1, 4),
        cylinders=np.array(cylinders).reshape(-1, 5),
        walls=np.array(walls).reshape(-1, 6),
    )


def build_vehicle(
    mission: Mission,
    seed: int,
    autopilot: Autopilot = "px4",
    *,
    faults: Iterable[str] = (),
    gusts: Sequence[Gust] = (),
    wind: Vector | None = None,
    parameters: Mapping[str, float] | None = None,
) -> Vehicle:
    """The vehicle in memory, standing where the mission starts, in its wind.

    Parameters
    ----------
    faults : as `fakevehicle.faults.parse_fault` reads them.
    wind : north, east, down [m/s]; None: the mission's.
    parameters : of the vehicle, where they differ from its defaults.
    """
    blowing = (mission.wind.north, mission.wind.east, mission.wind.down) if wind is None else wind
    config = VehicleConfig(
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
def running_vehicle(mission: Mission, url: str, seed: int, log: Path) -> Iterator[subprocess.Popen[bytes]]:
    """The vehicle as a process of its own, calling `url`; what it prints goes to `log`. Ended at the end."""
    home, wind = zurich(), mission.wind
    place = f"{math.degrees(home.latitude):.7f},{math.degrees(home.longitude):.7f},{home.altitude:g}"
    command = [
        *(sys.executable, "-m", "fakevehicle", "--connect", url, "--seed", str(seed)),
        *("--home", f"{place},{mission.vehicle.start.heading_deg:g}"),
        *("--wind", f"{wind.north:g},{wind.east:g},{wind.down:g}"),
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
            command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT, start_new_session=True
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
