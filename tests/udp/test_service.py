"""The service as a process: started before its vehicle, watched over HTTP, ended by SIGTERM in the air."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import HOP
from tests.vehicle_process import VehicleProcess, free_port

pytestmark = pytest.mark.udp


def free_tcp_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


class Running:
    """A service in a process of its own."""

    def __init__(self, folder: Path, text: str) -> None:
        self.port, self.log = free_tcp_port(), folder / "log.jsonl"
        config = folder / "companion.yaml"
        config.write_text(f"{text}\nhttp: 127.0.0.1:{self.port}\nrecord: recordings\n")
        with self.log.open("wb") as log:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "companion", "run", "--config", str(config)],
                stderr=log,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
            )

    def get(self, path: str) -> tuple[int, dict[str, Any]]:
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{self.port}{path}", timeout=5) as answer:
                return answer.status, json.load(answer)
        except urllib.error.HTTPError as error:
            with error:
                return error.code, json.load(error)
        except OSError:
            return 0, {}

    def wait(self, so: Callable[[], bool], seconds: float = 90.0) -> None:
        end_s = time.monotonic() + seconds
        while not so():
            assert time.monotonic() < end_s, self.log.read_text()
            assert self.process.poll() is None, self.log.read_text()
            time.sleep(0.1)

    @property
    def said(self) -> list[str]:
        return [json.loads(line)["text"] for line in self.log.read_text().splitlines()]


def test_a_service_waits_for_its_vehicle_flies_and_lands_on_sigterm(tmp_path: Path) -> None:
    (tmp_path / "hop.yaml").write_text(HOP.replace("  - land", "  - hold: {seconds: 60}\n  - land"))
    link = free_port()
    service = Running(tmp_path, f"master: udpin:127.0.0.1:{link}\nmission: hop.yaml\nautostart: true")
    try:
        service.wait(lambda: service.get("/health") == (503, {"ok": False, "reason": "the vehicle is not heard"}))
        assert service.get("/state.json")[1]["state"] == "idle"
        with VehicleProcess("--connect", f"udpout:127.0.0.1:{link}"):
            service.wait(lambda: service.get("/health")[0] == 200)
            service.wait(lambda: (service.get("/state.json")[1].get("flight") or {}).get("phase") == "flying")
            service.process.send_signal(signal.SIGTERM)
            assert service.process.wait(40) == 0, service.log.read_text()
    finally:
        service.process.kill()
        service.process.wait(10)
    assert "landing -> done (disarmed)" in service.said
    assert service.said[-1] == "stopped"
    (recording,) = (tmp_path / "recordings").iterdir()
    done = subprocess.run(
        [sys.executable, "-m", "companion", "rerun", str(recording)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
