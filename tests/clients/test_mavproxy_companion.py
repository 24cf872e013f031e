"""MAVProxy gives the companion a plan of its own: `wp load` to component 191, past the vehicle's own mission."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from test_mavproxy import HOME, MAVPROXY, MISSION, Console
from vehicle_process import VehicleProcess, free_port

pytestmark = [
    pytest.mark.udp,
    pytest.mark.slow,
    pytest.mark.skipif(MAVPROXY is None, reason="MAVProxy is not installed (set MAVPROXY to its mavproxy.py)"),
]


FENCE = """QGC WPL 110
0\t0\t0\t5001\t4\t0\t0\t0\t-35.364\t149.164\t0\t1
1\t0\t0\t5001\t4\t0\t0\t0\t-35.362\t149.164\t0\t1
2\t0\t0\t5001\t4\t0\t0\t0\t-35.362\t149.167\t0\t1
3\t0\t0\t5001\t4\t0\t0\t0\t-35.364\t149.167\t0\t1
4\t0\t0\t5004\t5\t0\t0\t0\t-35.3635\t149.1655\t0\t1
"""


def test_a_plan_and_a_fence_reach_the_companion_and_leave_the_vehicles_own_alone(tmp_path: Path) -> None:
    link, out = free_port(), free_port()
    config = tmp_path / "companion.yaml"
    config.write_text(
        f"master: udpin:127.0.0.1:{link}\nout: ['udpout:127.0.0.1:{out}']\nhttp: null\nrecord: {tmp_path}\nlog: text\n"
    )
    (tmp_path / "mission.txt").write_text(MISSION)
    (tmp_path / "fence.txt").write_text(FENCE)
    with (tmp_path / "log").open("wb") as log:
        service = subprocess.Popen(
            [sys.executable, "-m", "companion", "run", "--config", str(config)],
            stderr=log,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        )
    console = None
    try:
        vehicle = ("--connect", f"udpout:127.0.0.1:{link}", "--autopilot", "ardupilot", "--home", HOME)
        with VehicleProcess(*vehicle):
            console = Console(out, tmp_path)
            console.until(r"Mode STABILIZE[\s\S]*Received \d+ parameters", 40)
            console.type("set target_component 191")
            console.type("wp load mission.txt")
            console.until(r"Sent all 4", 15)
            console.type("wp list")
            console.until(r"Requesting 4 waypoints[\s\S]*-35\.363171", 15)
            console.type("wp set 2")
            console.until(r"DO_SET_MISSION_CURRENT refused: no plan", 5)
            console.type("fence load fence.txt")
            console.until(r"Sent all 5", 15)
            console.type("fence list")
            console.until(r"Requesting 5[\s\S]*-35\.3635", 15)
            console.type("set target_component 1")
            console.type("wp list")
            console.until(r"Requesting 0 waypoints", 15)
            told = (tmp_path / "log").read_text()
            assert "a plan of 4 items was uploaded" in told
            assert "with a fence of 5 items" in told
    finally:
        if console is not None:
            console.close()
        service.terminate()
        service.wait(20)
