"""The bundled vehicle, set up as a mission asks: in this process for lockstep, as a process of its own over UDP."""

import math
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from companion.errors import CompanionError
from companion.mission import Mission
from fakevehicle.config import LinkConfig, VehicleConfig, zurich
from fakevehicle.vehicle import Vehicle

LINK = "onboard"
"""The vehicle's name for its link to the companion."""


def build_vehicle(mission: Mission, seed: int) -> Vehicle:
    """The vehicle in memory, standing where the mission starts, in its wind."""
    wind = mission.wind
    config = VehicleConfig(
        heading=mission.heading(),
        wind_n=np.array([wind.north, wind.east, wind.down]),
        seed=seed,
        links=(LinkConfig(LINK, "onboard"),),
    )
    return Vehicle(config)


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
    try:
        out = log.open("wb")
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
