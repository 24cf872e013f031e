"""MAVProxy on a pseudo-terminal flies the ArduPilot flavour: mode, arm, takeoff, parameters, mission load, land.

MAVProxy is no dependency. It is looked for on the PATH and in the environment variable MAVPROXY; without it the test is
skipped.
"""

import contextlib
import os
import pty
import re
import select
import shutil
import signal
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from vehicle_process import VehicleProcess, free_port

MAVPROXY = os.environ.get("MAVPROXY") or shutil.which("mavproxy.py")
pytestmark = [
    pytest.mark.udp,
    pytest.mark.slow,
    pytest.mark.skipif(MAVPROXY is None, reason="MAVProxy is not installed (set MAVPROXY to its mavproxy.py)"),
]
MODULES = "log,wp,rally,fence,param,mode,misc,arm,cmdlong,link,ftp,output"
HOME = "-35.363261,149.165230,584,0"
MISSION = """QGC WPL 110
0\t1\t0\t16\t0\t0\t0\t0\t-35.363261\t149.165230\t584\t1
1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t5\t1
2\t0\t3\t16\t0\t0\t0\t0\t-35.363171\t149.165230\t5\t1
3\t0\t3\t20\t0\t0\t0\t0\t0\t0\t0\t1
"""


class Console:
    """MAVProxy's command line: types, and reads until something appears."""

    def __init__(self, port: int, folder: Path) -> None:
        self.heard = ""
        self.pid, self._terminal = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            environment = {**os.environ, "HOME": str(folder), "TERM": "dumb"}
            master, modules = f"--master=udpin:127.0.0.1:{port}", f"--default-modules={MODULES}"
            os.execve(str(MAVPROXY), [str(MAVPROXY), master, f"--state-basedir={folder}", modules], environment)

    def type(self, line: str) -> None:
        self.heard = ""
        os.write(self._terminal, (line + "\n").encode())

    def until(self, pattern: str, seconds: float) -> None:
        """Read until a regular expression is found; a failure shows what was said instead."""
        end = time.monotonic() + seconds
        while not re.search(pattern, self.heard):
            assert time.monotonic() < end, f"no {pattern!r} within {seconds} s of {self.heard[-1500:]!r}"
            if select.select([self._terminal], [], [], 0.2)[0]:
                self.heard += os.read(self._terminal, 4096).decode(errors="replace")

    def close(self) -> None:
        os.kill(self.pid, signal.SIGTERM)
        end = time.monotonic() + 5.0
        while time.monotonic() < end:
            if os.waitpid(self.pid, os.WNOHANG)[0]:
                break
            if select.select([self._terminal], [], [], 0.1)[0]:
                with contextlib.suppress(OSError):
                    os.read(self._terminal, 4096)
        else:
            os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
        os.close(self._terminal)


@pytest.fixture
def console(tmp_path: Path) -> Iterator[Console]:
    port = free_port()
    (tmp_path / "mission.txt").write_text(MISSION)
    arguments = ("--autopilot", "ardupilot", "--connect", f"udpout:127.0.0.1:{port}", "--home", HOME)
    with VehicleProcess(*arguments):
        console = Console(port, tmp_path)
        try:
            yield console
        finally:
            console.close()


def test_mavproxy_loads_a_mission_sets_a_parameter_and_flies(console: Console) -> None:
    console.until(r"Received \d+ parameters", 30)
    console.until("using GPS", 15)
    console.type("param set LAND_SPEED 100")
    time.sleep(2.0)  # it is sent by a thread of its own
    console.type("param fetch LAND_SPEED")
    console.until(r"LAND_SPEED\s*=\s*100", 5)
    console.type("wp load mission.txt")
    console.until(r"Sent all 4", 10)
    console.type("wp list")
    console.until(r"Requesting 4 waypoints", 5)
    console.type("mode guided")
    console.until("GUIDED>", 5)
    console.type("arm throttle")
    console.until("ARMED", 5)
    console.type("takeoff 5")
    console.until(r"Got COMMAND_ACK: NAV_TAKEOFF: ACCEPTED", 5)
    time.sleep(6.0)
    console.type("mode land")
    console.until("LAND>", 5)
    console.until("DISARMED", 30)
