"""`companion simulate`: mission in, lockstep flight, verdict out."""

import time
from contextlib import ExitStack
from pathlib import Path

from rich.console import Console

from companion.cli import flight_show, show
from companion.cli.many import simulate_many
from companion.cli.operator import STOPPED, Operator
from companion.cli.vehicle import LINK, build_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.lockstep import fly_lockstep
from companion.drivers.planning import InlinePlanning
from companion.drivers.provenance import conclude
from companion.drivers.recording import RecordingTap, header, total
from companion.drivers.tick import Tap
from companion.fleet.missions import has_vehicles, split
from companion.missionfile import parse_mission, read_mission_file
from companion.testing.taps import surroundings
from companion.verdict import FlightMeter, judge
from fakevehicle.config import Autopilot
from fakevehicle.recordings import parameters_of
from fakevehicle.vehicle import Vehicle
from logs.errors import RecordingError
from logs.parts import Rotation
from logs.recorder import Recorder
from planner import warm_up

LIMIT_S = 3600.0
"""Simulated time, holds apart, after which a flight that does not end is ended."""


def simulate_mission(
    path: Path, seed: int, record: Path | None, autopilot: Autopilot, as_json: bool, rotation: Rotation | None = None
) -> int:
    """Fly `path` in lockstep; `rotation` says when a part of the recording ends. Returns the exit code."""
    out = show.console()
    data = read_mission_file(path)
    if has_vehicles(data):
        return simulate_many(split(data, str(path)), seed, record, autopilot, as_json, rotation)
    mission = parse_mission(data, str(path))
    companion = Companion(mission, CompanionConfig(seed=seed))
    planning = InlinePlanning(mission.planner_world())
    with show.working(out, "preparing kernels (compiled the first time)"):
        build_vehicle(mission, seed, autopilot).step(Vehicle.TICK_US, [])  # one step of a twin, thrown away
        warm_up()
    vehicle = build_vehicle(mission, seed, autopilot)
    meter = FlightMeter(companion)
    operator = Operator()
    with ExitStack() as stack:
        stack.enter_context(operator.listening())
        recorder = None
        if record is not None:
            start = header(companion, data)
            start["attachments"].append(parameters_of(vehicle))
            recorder = stack.enter_context(Recorder(record, threaded=False, rotation=rotation, **start))
        recording = RecordingTap(companion, recorder, lambda text: out.print(show.plain(text), soft_wrap=True))
        taps: list[Tap] = [meter, recording, stack.enter_context(flight_show.ProgressLine(companion, meter, out))]
        around = surroundings(companion, vehicle)
        taps += [] if around is None else [around]
        wall, cpu = time.perf_counter(), time.process_time()
        limit_s = LIMIT_S + sum(step.hold.seconds for step in mission.steps if step.hold is not None)
        end_us = fly_lockstep(
            companion, vehicle, LINK, planning, taps, limit_s=limit_s, operator=operator, stop=operator.stop
        )
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        if not companion.over:
            late = f"not over after {limit_s:g} s of simulated time"
            companion.failure = STOPPED if operator.stop() else companion.failure or late
        if recorder is not None:
            conclude(recorder, companion, meter, None if around is None else around.least)
            try:
                recorder.close()
            except RecordingError as error:  # the flight went on without it; the verdict must not
                companion.failure = companion.failure or str(error)
    verdict = judge(companion, meter, None if around is None else around.least)
    simulated_s, sha256 = end_us / 1e6, recording.outputs.hexdigest()
    result = {
        **flight_show.verdict_json(verdict),
        "recording": None if record is None else str(record),
        "messages_recorded": 0 if recorder is None else total(recorder.counters),
        "speedup": simulated_s / wall,
        "cpu_ms_per_sim_s": 1e3 * cpu / simulated_s,
        "outputs_sha256": sha256,
    }
    if as_json:
        show.print_json(result)
    else:
        speed = f"{result['speedup']:.0f} x real time, {result['cpu_ms_per_sim_s']:.1f} ms of CPU a simulated second"
        details = {"speed": speed, "outputs": f"sha256 {sha256}"}
        if record is not None:
            details |= {"messages": str(result["messages_recorded"]), "recording": str(record)}
        flight_show.print_verdict(verdict, mission.expect, details, Console())
    return 0 if verdict.ok else 1
