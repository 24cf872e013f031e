"""`companion fly` of a mission with `vehicles:`: a bundled vehicle and a companion for each, as processes, over UDP.

Each companion is what `companion fly` is for one vehicle: its own sockets, planning workers, recording and verdict.
They tell each other what they fly over loopback, and begin together once the slowest has its kernels. This process
starts and ends them, hands on Ctrl-C, and looks afterwards at how near they came.
"""

import os
import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from itertools import combinations
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console

from companion.cli import flight_show, show
from companion.cli.flown import Flown, fly_recorded, vehicle_log
from companion.cli.many import tell_many
from companion.cli.operator import STOPPED, Operator
from companion.cli.vehicle import running_vehicle
from companion.core import Companion, CompanionConfig
from companion.errors import CompanionError, MissionError
from companion.fleet.member import FLEET_LINK
from companion.fleet.missions import Part
from companion.missionfile import parse_mission
from companion.seam import FloatArray
from companion.service.queue import recording_file
from companion.testing.many import ManyResult
from companion.vehiclelink import VEHICLE_LINK
from companion.verdict import FlightMeter
from fakevehicle.config import Autopilot
from logs.errors import LogsError
from logs.parts import Rotation
from wire.endpoint import Endpoint
from wire.errors import WireError
from wire.udp import UdpLink

MOST = 8
"""Vehicles: each is four processes."""
STEP_US = 20_000
"""Between two looks at how near they were."""
WAIT_S = 0.05
WARM = "warm"
"""What a companion's process says once its kernels are compiled."""


@dataclass(frozen=True, slots=True)
class _Job:
    """What one companion's process is told."""

    name: str
    data: bytes
    file: str  # the mission's, for the maps that it names
    endpoints: dict[str, Endpoint]
    recording: Path
    config: CompanionConfig
    rotation: Rotation | None


def fly_several(
    parts: list[Part],
    path: Path,
    seed: int,
    record: Path,
    autopilot: Autopilot,
    as_json: bool,
    rotation: Rotation | None = None,
) -> int:
    """Fly the parts of a mission file on bundled vehicles; returns the exit code.

    All is well when every flight ends as its mission expects and no two hulls have touched.
    """
    if len(parts) > MOST:
        wanted = f"expected at most {MOST} over UDP: companion simulate flies more"
        raise MissionError(str(path), [f"vehicles: found {len(parts)}, {wanted}"])
    jobs, operator, out = _jobs(parts, path, seed, record, rotation), Operator(), show.console()
    with ExitStack() as stack:
        stack.enter_context(operator.listening())
        for k, (part, job) in enumerate(zip(parts, jobs, strict=True)):
            there = job.endpoints[VEHICLE_LINK]
            url, log = f"udpout:{there.host}:{there.port}", vehicle_log(job.recording)
            stack.enter_context(running_vehicle(part.mission, url, seed + k, log, autopilot))
        out.print(f"{len(parts)} bundled vehicles, a companion each; recordings in {record}")
        ended = _all(jobs, operator, stack)
    flown = [end for end in ended if isinstance(end, Flown)]
    failures = [f"{job.name}: {end}" for job, end in zip(jobs, ended, strict=True) if isinstance(end, str)]
    if len(flown) < len(parts):
        raise CompanionError("; ".join([STOPPED] if operator.asked else failures))
    least, nearest = nearest_pair([end.path for end in flown])
    verdicts = tuple(end.verdict for end in flown)
    result = ManyResult(verdicts, least, nearest, 0, max(v.duration_s for v in verdicts))
    told = [STOPPED] if operator.stop() else []
    return tell_many(parts, result, told, seed, record, {"recordings": [str(job.recording) for job in jobs]}, as_json)


def nearest_pair(paths: Sequence[FloatArray]) -> tuple[float, tuple[int, int, float]]:
    """Least distance of two centres [m], inf: never two in the air; and which two, from 1, and when.

    Parameters
    ----------
    paths : of each, (n, 4) when [us] and where [m].

    Returns
    -------
    Distance [m]; numbers of the two; when [s], counted from the first takeoff.
    """
    least, nearest = np.inf, (0, 0, 0.0)
    began_us = min((path[0, 0] for path in paths if len(path)), default=0.0)
    for (i, a), (k, b) in combinations(enumerate(paths), 2):
        if not len(a) or not len(b):
            continue
        at_us = np.arange(max(a[0, 0], b[0, 0]), min(a[-1, 0], b[-1, 0]), STEP_US)
        if len(at_us):
            apart = _places(a, at_us) - _places(b, at_us)
            distance = np.linalg.norm(apart, axis=1)
            if distance.min() < least:
                least = float(distance.min())
                nearest = (i + 1, k + 1, float(at_us[distance.argmin()] - began_us) / 1e6)
    return float(least), nearest


def _places(path: FloatArray, at_us: FloatArray) -> FloatArray:
    return np.column_stack([np.interp(at_us, path[:, 0], path[:, k]) for k in (1, 2, 3)])


def _jobs(parts: list[Part], path: Path, seed: int, record: Path, rotation: Rotation | None) -> list[_Job]:
    """What each is told: its ports on loopback, the others', and its number."""
    count = len(parts)
    with ExitStack() as stack:
        free = [
            stack.enter_context(UdpLink(f"free{k}", Endpoint.parse("udpin:127.0.0.1:0"))).local_address
            for k in range(2 * count)
        ]
    jobs = []
    for k, part in enumerate(parts):
        ends = {VEHICLE_LINK: Endpoint("udpin", *free[k]), FLEET_LINK: Endpoint("udpin", *free[count + k])}
        others = [place for j, place in enumerate(free[count:]) if j != k]
        ends |= {f"{FLEET_LINK}{j}": Endpoint("udpout", *place) for j, place in enumerate(others)}
        config = CompanionConfig(seed=seed + k, fleet_number=k + 1, fleet_calls=count - 1)
        file = recording_file(record, part.mission)
        file = file.with_stem(f"{file.stem}-{k + 1}")
        jobs.append(_Job(part.name, part.data, str(path), ends, file, config, rotation))
    return jobs


def _all(jobs: list[_Job], operator: Operator, stack: ExitStack) -> list[Flown | str]:
    """Run every job in a process of its own, to its end; what came of each, or why nothing did."""
    spawn, pipes, processes = get_context("spawn"), [], []
    for job in jobs:
        ours, theirs = spawn.Pipe()
        process = spawn.Process(target=_one, args=(theirs, job), name=f"companion {job.name}")
        process.start()
        theirs.close()
        stack.callback(_end, process)
        pipes.append(ours)
        processes.append(process)
    ended: list[Flown | str | None] = [None] * len(jobs)
    warm, gone, handed_on = 0, False, 0
    while any(end is None for end in ended):
        time.sleep(WAIT_S)
        for k, pipe in enumerate(pipes):
            if ended[k] is None and pipe.poll():
                try:
                    got = pipe.recv()
                except EOFError:
                    got = "its process ended before the flight did"
                if isinstance(got, str) and got == WARM:
                    warm += 1
                else:
                    ended[k] = got
        if not gone and (warm == len(jobs) or any(end is not None for end in ended)):
            gone = True
            for pipe, end in zip(pipes, ended, strict=True):
                if end is None:
                    pipe.send(warm == len(jobs))
        while handed_on < operator.asked:
            handed_on += 1
            for process in processes:
                process.terminate()  # SIGTERM: the first lands it, the second ends it
    return [end for end in ended if end is not None]


def _end(process: SpawnProcess) -> None:
    process.join(5.0)
    if process.is_alive():
        process.kill()
        process.join()


def _one(pipe: "Connection[Any, Any]", job: _Job) -> None:
    """One companion, in a process of its own: says WARM, waits to be told to go, flies, and tells what came of it."""
    os.setsid()  # Ctrl-C is the other process's, which hands it on
    operator = Operator()

    def go() -> bool:
        pipe.send(WARM)
        while not pipe.poll(WAIT_S):
            if operator.asked:
                return False
        return bool(pipe.recv())

    def progress(companion: Companion, meter: FlightMeter, out: Console) -> flight_show.NamedNotes:
        return flight_show.NamedNotes(job.name, meter, out)

    with operator.listening():
        try:
            mission = parse_mission(job.data, str(Path(job.file).with_name(f"{Path(job.file).name}: {job.name}")))
            flown = fly_recorded(
                mission,
                job.data,
                job.endpoints,
                job.recording,
                job.config,
                operator,
                rotation=job.rotation,
                progress=progress,
                go=go,
            )
            pipe.send(replace(flown, verdict=replace(flown.verdict, track=None)))
        except (CompanionError, LogsError, WireError) as error:
            pipe.send(str(error))
