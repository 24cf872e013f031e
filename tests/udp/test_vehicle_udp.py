"""The vehicle as a process of its own, heard and spoken to over loopback sockets."""

import signal
import socket
import subprocess
import sys
import time
from typing import Any

import pytest
from vehicle_process import VehicleProcess, free_port

from wire.dialect import mavlink

pytestmark = pytest.mark.udp


class Ear:
    """A bound socket that decodes what it hears and answers whom it heard."""

    def __init__(self) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(5.0)
        self.url = f"udpout:127.0.0.1:{self.socket.getsockname()[1]}"
        self.peer: Any = None
        self._mavlink = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)

    def next(self, kind: str) -> Any:
        for _ in range(5000):
            data, self.peer = self.socket.recvfrom(2048)
            message = self._mavlink.decode(bytearray(data))
            if message.get_type() == kind:
                return message
        raise AssertionError(kind)

    def say(self, message: Any) -> None:
        self.socket.sendto(message.pack(self._mavlink), self.peer)

    def __enter__(self) -> "Ear":
        return self

    def __exit__(self, *_: object) -> None:
        self.socket.close()


def test_it_calls_first_answers_on_each_link_and_ends_on_ctrl_c() -> None:
    with Ear() as one, Ear() as two, VehicleProcess("--connect", one.url, "--connect", two.url) as vehicle:
        for ear in (one, two):
            beat = ear.next("HEARTBEAT")
            assert (beat.autopilot, beat.get_srcSystem(), beat.get_srcComponent()) == (12, 1, 1)
        two.say(mavlink.MAVLink_command_long_message(1, 1, 512, 0, 148, 0, 0, 0, 0, 0, 0))
        assert two.next("AUTOPILOT_VERSION").capabilities & mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
        assert two.next("COMMAND_ACK").result == 0
        assert vehicle.stop(signal.SIGINT) == 0
        assert vehicle.log[-1].startswith("stopped after")


def test_simulated_time_runs_at_the_asked_speed() -> None:
    with Ear() as ear, VehicleProcess("--connect", ear.url, "--speed", "4") as vehicle:
        first, began = ear.next("ATTITUDE").time_boot_ms, time.monotonic()
        while time.monotonic() - began < 1.5:
            last = ear.next("ATTITUDE").time_boot_ms
        assert (last - first) / 1000.0 == pytest.approx(4 * (time.monotonic() - began), rel=0.15)
        assert vehicle.stop(signal.SIGTERM) == 0


def test_a_listening_link_answers_whoever_writes() -> None:
    port = free_port()
    with Ear() as ear, VehicleProcess("--connect", f"udpin:127.0.0.1:{port}"):
        ear.peer = ("127.0.0.1", port)
        ear.say(mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3))
        assert ear.next("HEARTBEAT").autopilot == 12


def test_a_busy_port_is_one_clear_line_and_exit_code_1() -> None:
    with Ear() as ear:
        port = ear.socket.getsockname()[1]
        run = subprocess.run(
            [sys.executable, "-m", "fakevehicle", "--connect", f"udpin:127.0.0.1:{port}"],
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
    assert run.returncode == 1
    assert run.stderr.count("\n") == 1
    assert "already in use" in run.stderr


def test_a_vehicle_that_was_begun_by_another_process_ends_with_it() -> None:
    began = subprocess.run(  # its input is at its end from the beginning, as a pipe is whose writer was killed
        [sys.executable, "-m", "fakevehicle", "--connect", f"udpout:127.0.0.1:{free_port()}", "--until-stdin-ends"],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=90,
        check=False,
    )
    assert began.returncode == 0, began.stderr
    assert "stopped after 0.0 s" in began.stdout
