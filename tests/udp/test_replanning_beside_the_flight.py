"""What is seen is planned for in processes of their own: setpoints leave evenly, all of it on one core."""

import os
import time
from pathlib import Path

import numpy as np
import pytest

from companion.cli.vehicle import running_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.planning import WorkerPlanning
from companion.drivers.realtime import fly_realtime
from companion.missionfile import parse_mission
from companion.seam import ReplanReady, ReplanWanted
from companion.vehiclelink import VEHICLE_LINK
from companion.verdict import FlightMeter, judge
from tests.conftest import HOP
from wire.endpoint import Endpoint
from wire.udp import UdpLink

UNKNOWN = HOP.replace("cylinder: {", "{cylinder: {").replace("[0, 4]}\nsteps", "[0, 4]}, hidden: true}\nsteps")
UNKNOWN += "sensing: {clearance: 0.3}\n"


@pytest.fixture
def one_core():
    """This process and whatever it starts share a core."""
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(cores)})
    yield
    os.sched_setaffinity(0, cores)


@pytest.mark.soak
@pytest.mark.udp
def test_setpoints_leave_at_50_hz_while_replanning_at_10_hz_on_the_vehicles_own_core(one_core, tmp_path: Path):
    mission = parse_mission(UNKNOWN.encode(), "unknown.yaml")
    assert not mission.planner_world().obstacles
    companion = Companion(mission, CompanionConfig(seed=1))
    meter, planning = FlightMeter(companion), WorkerPlanning(mission.planner_world(), replans=True)
    asked, waited = {}, []

    def tap(tick):
        for _, item in tick.inputs:
            if isinstance(item, ReplanReady) and item.request_id in asked:
                waited.append((tick.now_us - asked[item.request_id]) / 1e3)
        asked.update((o.request_id, tick.now_us) for o in tick.outputs if isinstance(o, ReplanWanted) and not o.cold)

    try:
        while not planning.warmed():
            time.sleep(0.1)
        with UdpLink(VEHICLE_LINK, Endpoint.parse("udpin:127.0.0.1:0")) as link:
            host, port = link.local_address
            with running_vehicle(mission, f"udpout:{host}:{port}", 1, tmp_path / "vehicle.log"):
                fly_realtime(companion, {VEHICLE_LINK: link}, planning, [meter, tap], operator=lambda now_us: None)
    finally:
        planning.close()
    verdict, gaps, replanning = judge(companion, meter), meter.setpoint_gaps_ms(), companion.replanning
    print(f"gap p99 {np.percentile(gaps, 99):.2f} ms, worst {gaps.max():.2f} ms; {len(waited)} answers after "
          f"{np.median(waited):.1f} ms, worst {max(waited):.1f} ms; {replanning.late} late")  # fmt: skip
    assert verdict.ok, verdict.failure
    assert verdict.min_clearance_m > 0.0
    assert replanning.asked > 20
    assert replanning.late <= 0.1 * replanning.asked
    assert np.percentile(gaps, 99) <= 30.0, f"worst gaps {np.sort(gaps)[-5:]} ms"
    assert gaps.max() <= 100.0
