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
from contextlib import suppress
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from mcap.exceptions import McapError
from mcap.reader import NonSeekingReader
from websockets.sync.client import connect

from companion.drivers.rerun import rerun
from logs import schema
from logs.reader import Recording
from logs.recorder import Recorder
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


def test_two_services_wait_for_their_vehicles_fly_tell_each_other_and_land_on_sigterm(tmp_path: Path) -> None:
    masters, fleet = (free_port(), free_port()), (free_port(), free_port())
    services = []
    for k in range(2):
        folder = tmp_path / str(k + 1)
        folder.mkdir()
        (folder / "hop.yaml").write_text(HOP.replace("  - land", "  - hold: {seconds: 60}\n  - land"))
        others = f'listen: "udpin:127.0.0.1:{fleet[k]}", others: ["udpout:127.0.0.1:{fleet[1 - k]}"]'
        text = f"master: udpin:127.0.0.1:{masters[k]}\nmission: hop.yaml\nautostart: true\nlive: 0\n"
        services.append(Running(folder, f"{text}fleet: {{number: {k + 1}, {others}}}"))
    first, second = services
    try:
        first.wait(lambda: first.get("/ready") == (503, {"ok": False, "reason": "the vehicle is not heard"}))
        assert first.get("/health") == (200, {"ok": True, "reason": None})  # nobody restarts it for that
        assert first.get("/state.json")[1]["state"] == "idle"
        with (
            VehicleProcess("--connect", f"udpout:127.0.0.1:{masters[0]}"),
            VehicleProcess("--connect", f"udpout:127.0.0.1:{masters[1]}"),
        ):
            first.wait(lambda: first.get("/ready")[0] == 200)
            first.wait(lambda: (first.get("/state.json")[1].get("flight") or {}).get("phase") == "flying")
            first.wait(lambda: "vehicle 2 is heard" in first.said)
            second.wait(lambda: "vehicle 1" in (second.get("/state.json")[1].get("fleet") or {}))
            address = next(text for text in first.said if "live page is at" in text).rpartition(" ")[2]
            with urllib.request.urlopen(address, timeout=5) as page:
                assert b"data-live=" in page.read()
            bare = first.get("/state.json")[1]["live"]
            assert address.startswith(f"{bare}?token=")
            url = urlsplit(address)
            token = parse_qs(url.query)["token"][0]
            with urllib.request.urlopen(f"http://127.0.0.1:{first.port}/", timeout=5) as page:
                assert token not in page.read().decode() + json.dumps(first.get("/state.json")[1])
            with connect(f"ws://{url.netloc}/live?{url.query}", origin=f"http://{url.netloc}", max_size=None) as live:
                assert json.loads(live.recv(timeout=5))["header"]["phase"] == "flying"
                live.send(json.dumps({"order": "hold", "values": [], "token": token}))
                answers = (json.loads(live.recv(timeout=5)).get("answer") for _ in range(100))
                assert next(answer for answer in answers if answer)["ok"]
            for service in services:
                service.process.send_signal(signal.SIGTERM)
            assert [service.process.wait(60) for service in services] == [0, 0]
    finally:
        for service in services:
            service.process.kill()
            service.process.wait(10)
    assert "landing -> done (disarmed)" in first.said
    assert first.said[-1] == "stopped"
    (recording,) = (tmp_path / "1" / "recordings").iterdir()
    again = rerun(Recording(recording))
    assert again.comparison.first is None, again.comparison


def test_a_service_recovers_what_an_earlier_one_left_unfinished(tmp_path: Path) -> None:
    (tmp_path / "recordings").mkdir()
    path = tmp_path / "recordings" / "hop.mcap"
    with Recorder(tmp_path / "whole.mcap", metadata={}, threaded=False) as recorder:
        for tick in range(100):
            note = schema.Note(6, "FLYING", str(tick))
            at_us = (tick + 1) * 20_000
            recorder.message("/companion/note", note, log_time_ns=at_us * 1000, now_us=at_us, tick=tick)
        path.write_bytes((tmp_path / "whole.mcap").read_bytes())  # as a killed process leaves it
    written = 0
    with path.open("rb") as file, suppress(McapError):  # a plain reader gets so far, and then raises
        for _ in NonSeekingReader(file).iter_messages(log_time_order=False):
            written += 1
    assert written > 50
    service = Running(tmp_path, f"master: udpin:127.0.0.1:{free_port()}")
    try:
        service.wait(lambda: service.get("/health")[0] == 200)
        service.wait(
            lambda: any(f"{path.name}: recovered {written} messages; nothing is lost" in text for text in service.said)
        )
        service.process.send_signal(signal.SIGTERM)
        assert service.process.wait(60) == 0
    finally:
        service.process.kill()
        service.process.wait(10)
    assert Recording.open(path).complete
    assert len(list(Recording.open(path).messages())) == written
