"""Setpoints never wait for a plan: a whole flight over UDP with a planner that never rests beside it."""

import subprocess
import sys

import numpy as np
import pytest

from companion.core import Companion, CompanionConfig
from companion.drivers.planning import WorkerPlanning
from companion.drivers.realtime import fly_realtime
from companion.missionfile import parse_mission
from companion.seam import PlanReady, PlanWanted
from companion.vehiclelink import VEHICLE_LINK
from companion.verdict import FlightMeter, judge
from tests.conftest import HOP
from wire.endpoint import Endpoint
from wire.udp import UdpLink


class Restless(WorkerPlanning):
    """Hands back the first answer to each request, and then asks the worker for the same again, without end."""

    plans = 0

    def __init__(self, world) -> None:
        super().__init__(world)
        self.wanted: list[PlanWanted] = []
        self.told: set[int] = set()

    def submit(self, wanted: PlanWanted) -> None:
        self.wanted.append(wanted)
        for _ in range(8):  # several under way, so that the worker has one whenever it looks
            super().submit(wanted)

    def ready(self) -> list[PlanReady]:
        answers = super().ready()
        self.plans += len(answers)
        for _ in answers:
            super().submit(self.wanted[0])
        first = [a for a in answers if a.request_id not in self.told]
        self.told.update(a.request_id for a in answers)
        return first[:1]


@pytest.mark.soak
@pytest.mark.udp
def test_setpoints_leave_at_50_hz_with_a_p99_gap_under_30_ms_while_plans_are_computed_all_the_time():
    mission = parse_mission(HOP.encode(), "hop.yaml")
    companion = Companion(mission, CompanionConfig(seed=1))
    meter, planning = FlightMeter(companion), Restless(mission.planner_world())
    with UdpLink(VEHICLE_LINK, Endpoint.parse("udpin:127.0.0.1:0")) as link:
        host, port = link.local_address
        command = [sys.executable, "-m", "fakevehicle", "--connect", f"udpout:{host}:{port}", "--seed", "1"]
        vehicle = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            fly_realtime(companion, {VEHICLE_LINK: link}, planning, [meter], operator=lambda now_us: None)
        finally:
            vehicle.terminate()
            vehicle.wait(timeout=10)
            planning.close()
    verdict, gaps = judge(companion, meter), meter.setpoint_gaps_ms()
    assert verdict.ok, verdict.failure
    assert planning.plans > 500
    assert 1e3 / gaps.mean() == pytest.approx(50.0, abs=0.2)
    assert np.percentile(gaps, 99) < 30.0, f"worst gaps {np.sort(gaps)[-5:]} ms"
    print(f"{planning.plans} plans, gap p99 {np.percentile(gaps, 99):.2f} ms, worst {gaps.max():.2f} ms")
