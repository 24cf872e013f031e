"""What systemd is told, at a socket that stands for its own."""

import os
import re
import socket
import subprocess
from collections.abc import Iterator
from pathlib import Path
from shutil import which

import pytest

from companion.cli.run import OUR_FAULT, run_service
from companion.config import load_config
from companion.drivers.tick import Tick
from companion.service.jsonlog import Log
from companion.service.loop import Service
from companion.service.systemd import Systemd

UNIT = Path("docs/deploy/companion.service")


def ticks(seconds: float) -> list[Tick]:
    return [Tick(k, k * 20_000, [], [], k * 20_000) for k in range(round(seconds * 50))]


class Listener:
    """systemd's end."""

    def __init__(self, address: str) -> None:
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(address)
        self.socket.setblocking(False)

    def heard(self) -> list[str]:
        found = []
        while True:
            try:
                found.append(self.socket.recv(4096).decode())
            except BlockingIOError:
                return found


@pytest.fixture
def listener(tmp_path: Path) -> Iterator[Listener]:
    listener = Listener(str(tmp_path / "notify"))
    yield listener
    listener.socket.close()


def environment(tmp_path: Path, **more: str) -> dict[str, str]:
    return {"NOTIFY_SOCKET": str(tmp_path / "notify"), **more}


def test_a_loop_that_turns_says_so_four_times_in_the_watchdogs_period(tmp_path: Path, listener: Listener) -> None:
    systemd = Systemd(environment(tmp_path, WATCHDOG_USEC="2000000"))
    heard = []
    for tick in ticks(10):
        systemd(tick)
        heard += listener.heard()
    assert heard == ["WATCHDOG=1"] * 20


@pytest.mark.parametrize("more", [{}, {"WATCHDOG_USEC": "2000000", "WATCHDOG_PID": "1"}, {"WATCHDOG_USEC": "soon"}])
def test_without_a_watchdog_for_this_process_nothing_is_said_of_the_loop(
    more: dict[str, str], tmp_path: Path, listener: Listener
) -> None:
    systemd = Systemd(environment(tmp_path, **more))
    systemd.ready()
    for tick in ticks(10):
        systemd(tick)
    assert listener.heard() == ["READY=1"]


def test_a_clock_that_is_set_back_between_flights_does_not_silence_the_loop(tmp_path: Path, listener: Listener) -> None:
    systemd = Systemd(environment(tmp_path, WATCHDOG_USEC="2000000"))
    for tick in (*ticks(10)[-1:], *ticks(1)):
        systemd(tick)
    assert len(listener.heard()) >= 3


def test_without_systemd_or_with_one_that_is_gone_nothing_happens(tmp_path: Path) -> None:
    for systemd in (Systemd({}), Systemd(environment(tmp_path, WATCHDOG_USEC="1"))):
        systemd.ready()
        systemd.status("idle")
        systemd.stopping()
        for tick in ticks(0.1):
            systemd(tick)


def test_an_abstract_socket_is_found_by_its_at_sign() -> None:
    name = f"companion-test-{os.getpid()}"
    listener = Listener("\0" + name)
    Systemd({"NOTIFY_SOCKET": "@" + name}).status("two\nlines")
    assert listener.heard() == ["STATUS=two lines"]
    listener.socket.close()


class Asked:
    """A person who lets the service look on for some ticks and then asks it to end."""

    def __init__(self, ticks: int) -> None:
        self._left = ticks

    @property
    def asked(self) -> int:
        self._left -= 1
        return int(self._left < 0)

    def __call__(self, now_us: int) -> None:
        return None

    def stop(self) -> bool:
        return False


def test_a_service_tells_systemd_that_it_is_ready_that_it_turns_and_that_it_stops(
    tmp_path: Path, listener: Listener, capsys: pytest.CaptureFixture[str]
) -> None:
    config = load_config(None, {"COMPANION_MASTER": "udpin:127.0.0.1:0", "COMPANION_HTTP": "off"})
    systemd = Systemd(environment(tmp_path, WATCHDOG_USEC="600000"))
    assert Service(config, Asked(30), Log("json"), systemd).run() == 0
    heard = listener.heard()
    assert heard[:2] == ["READY=1", "STATUS=idle: no mission"]
    assert heard[-1] == "STOPPING=1"
    assert heard.count("WATCHDOG=1") >= 3
    assert '"stopped"' in capsys.readouterr().err


def test_a_fault_of_our_own_between_flights_is_logged_in_one_line_and_ends_the_service_for_a_restart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COMPANION_MASTER", "udpin:127.0.0.1:0")
    monkeypatch.setenv("COMPANION_HTTP", "off")
    monkeypatch.setattr("companion.service.choice.Choice.look", lambda self: 1 / 0)
    assert run_service(None) == OUR_FAULT
    last = capsys.readouterr().err.splitlines()[-1]
    assert "a fault of the companion's own: ZeroDivisionError" in last
    assert "Traceback" in last


def test_the_unit_waits_for_readiness_is_watched_and_is_sound() -> None:
    text = UNIT.read_text()
    assert re.search(r"^Type=notify$", text, re.MULTILINE)
    assert re.search(r"^WatchdogSec=\d+$", text, re.MULTILINE)
    if which("systemd-analyze") is None:
        pytest.skip("no systemd-analyze here")
    found = subprocess.run(["systemd-analyze", "verify", str(UNIT.resolve())], capture_output=True, text=True)
    complaints = [line for line in found.stderr.splitlines() if "companion.service" in line]
    assert all("is not executable" in line for line in complaints), found.stderr  # it is not installed here
