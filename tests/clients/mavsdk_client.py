"""MAVSDK's asyncio API (package mavsdk-grpc) against the vehicle's process: both end with the test.

`make test-clients` flies the same tests once more with what that API was before, `mavsdk<4`, under the present name.
"""

import asyncio
import os
import subprocess
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

import mavsdk_grpc
from mavsdk_grpc import System
from vehicle_process import VehicleProcess, free_port

SERVER = Path(mavsdk_grpc.__file__).parent / "bin" / "mavsdk_server"
T = TypeVar("T")


@asynccontextmanager
async def flown(*arguments: str) -> AsyncIterator[tuple[Any, VehicleProcess]]:
    """A `System` that is connected to a vehicle which calls it, and the vehicle.

    MAVSDK's own starter would leave its server behind when a test is ended; so the server is started here.
    """
    port, grpc = free_port(), free_port()
    with (
        TemporaryDirectory() as home,  # where it would remember what it has fetched
        VehicleProcess("--connect", f"udpout:127.0.0.1:{port}", *arguments) as vehicle,
    ):
        server = subprocess.Popen(
            [SERVER, "-p", str(grpc), f"udpin://127.0.0.1:{port}"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "HOME": home, "XDG_CACHE_HOME": home},
        )
        try:
            system = System(mavsdk_server_address="localhost", port=grpc)
            await asyncio.wait_for(system.connect(), 20)
            await until(system.core.connection_state(), lambda state: state.is_connected, 20)
            yield system, vehicle
        finally:
            server.kill()
            server.wait()


async def until(stream: AsyncIterator[T], wanted: Callable[[T], bool], seconds: float) -> T:
    """The first value of a stream that is as wanted."""

    async def find() -> T:
        async for value in stream:
            if wanted(value):
                return value
        raise AssertionError("the stream ended")

    return await asyncio.wait_for(find(), seconds)


async def first(stream: AsyncIterator[T], seconds: float = 4.0) -> T:
    """A stream's first value."""
    return await until(stream, lambda _: True, seconds)


async def last(stream: AsyncIterator[T], seconds: float = 30.0) -> T:
    """A stream's last value."""

    async def exhaust() -> T:
        newest: list[T] = []
        async for value in stream:
            newest = [value]
        return newest[0]

    return await asyncio.wait_for(exhaust(), seconds)


async def listed(system: Any, folder: str) -> list[str]:
    """The names in a folder of the vehicle's; `mavsdk<4` tells folders from files."""
    found = await system.ftp.list_directory(folder)
    return [entry.name for entry in found.entries] if hasattr(found, "entries") else [*found.dirs, *found.files]


async def ready(system: Any) -> None:
    """Healthy and armable."""
    await until(system.telemetry.health_all_ok(), bool, 30)


def fly(story: Callable[[Any, VehicleProcess], Awaitable[None]], *arguments: str) -> None:
    """Run one test's story."""

    async def run() -> None:
        async with flown(*arguments) as (system, vehicle):
            await story(system, vehicle)

    asyncio.run(run())
