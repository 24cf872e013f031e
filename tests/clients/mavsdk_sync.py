"""MAVSDK's current Python API (PyPI, 4.x) against the vehicle's process: both end with the block."""

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from mavsdk import ComponentType, Configuration, Mavsdk
from mavsdk.plugins.mission import MissionItem
from mavsdk.plugins.telemetry import Telemetry
from vehicle_process import VehicleProcess, free_port

LATITUDE, LONGITUDE = 47.397742, 8.545594
"""Where a vehicle stands that is told nothing else."""
NORTH, EAST = 1.0 / 111_180.0, 1.0 / 75_500.0
"""A metre in degrees there."""


@contextmanager
def connected(*arguments: str) -> Iterator[Any]:
    """MAVSDK's view of a vehicle that calls it.

    Parameters
    ----------
    arguments : more of the vehicle's command line.
    """
    port = free_port()
    with VehicleProcess("--connect", f"udpout:127.0.0.1:{port}", *arguments) as vehicle:
        client = Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION))
        try:
            client.add_any_connection(f"udpin://127.0.0.1:{port}")
            found = client.first_autopilot(20.0)
            assert found is not None, vehicle.log
            yield found
        finally:
            client.destroy()


def until(condition: Callable[[], object], seconds: float, what: str) -> None:
    """Wait for a condition."""
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, f"{what}: not within {seconds} s"
        time.sleep(0.02)


def healthy(system: Any) -> Telemetry:
    """The system's telemetry, once it says that all is well."""
    telemetry = Telemetry(system)
    until(telemetry.health_all_ok, 20, "health")
    return telemetry


def answers(call: Callable[[], Any]) -> bool:
    """Whether MAVSDK has an answer yet; it raises until the first one is in."""
    try:
        call()
    except Exception:
        return False
    return True


def place(
    north: float, east: float, up: float, *, through: bool, stay: float = math.nan, photo: bool = False
) -> MissionItem:
    """A mission item so many metres from home, at 5 m/s; with a photo of what is below, it asks gimbal and camera."""
    nan, nothing = math.nan, MissionItem.VehicleAction.NONE
    camera = MissionItem.CameraAction.TAKE_PHOTO if photo else MissionItem.CameraAction.NONE
    pitch = -90.0 if photo else nan
    latitude, longitude = LATITUDE + north * NORTH, LONGITUDE + east * EAST
    return MissionItem(latitude, longitude, up, 5.0, through, pitch, nan, camera, stay, nan, nan, nan, nan, nothing)
