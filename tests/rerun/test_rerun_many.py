"""Recordings of all kinds of flights are what the companion does again: lockstep, UDP, both flavours, with faults."""

import json
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from companion.drivers.rerun import rerun
from companion.testing.flight import Flight
from companion.testing.spec import FlightSpec
from companion.testing.wire import LinkFaults
from logs.reader import Recording
from tests.vehicle_process import VehicleProcess, free_port

HOP = Path("missions/hop.yaml")
FLAVOURS = ("px4", "ardupilot")
TROUBLES: dict[str, dict] = {
    "gps off": {"faults": ("gps:off@10-14",)},
    "gyro bias": {"faults": ("gyro:bias=0.02,0,0@8",)},
    "lossy": {"link": LinkFaults(loss=0.15, duplicate=0.05, reorder=0.05, jitter_ms=30, seed=3)},
    "blackout": {"link": LinkFaults(blackouts=((11.0, 12.5),), garbage=20, seed=4)},
    "shouting": {"link": LinkFaults(shouting=True, garbage=5, seed=5)},
    "reboot": {"reboot_s": 12.0},
}
UDP_FAULTS = ((), ("gps:off@9-12",), ("gyro:bias=0.02,0,0@8",), ("motor2:bias=0.6@10",))


def in_lockstep(folder: Path, autopilot, name: str) -> Path:
    file = folder / f"{autopilot}-{name.replace(' ', '_')}.mcap"
    Flight(replace(FlightSpec(HOP, autopilot=autopilot, record=file), **TROUBLES[name])).fly()
    return file


def over_udp(folder: Path, autopilot: str, faults: tuple[str, ...]) -> Path:
    url = f"127.0.0.1:{free_port()}"
    options = [option for fault in faults for option in ("--fault", fault)]
    with VehicleProcess("--connect", f"udpout:{url}", "--autopilot", autopilot, *options):
        command = [sys.executable, "-m", "companion", "fly", str(HOP), "--master", f"udpin:{url}", "--json"]
        command += ["--record", str(folder / url[-5:])]
        flying = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            out, _ = flying.communicate(timeout=60)
        except subprocess.TimeoutExpired:  # a flight in trouble may wait long; it is a recording all the same
            for _ in range(2):
                flying.send_signal(signal.SIGINT)
                time.sleep(0.5)
            out, _ = flying.communicate(timeout=20)
    return Path(json.loads(out)["recording"])


def same(file: Path) -> tuple[float, int]:
    """That a re-run is the recording to the bit; how fast it was, and how many outputs there are.

    The speed is recorded time over CPU time: it is one thread, and waits for nothing.
    """
    fastest = 0.0
    for _ in range(2):
        began_s = time.process_time()
        done = rerun(Recording.open(file))
        fastest = max(fastest, done.simulated_s / (time.process_time() - began_s))
        assert done.comparison.first is None, (file, done.comparison.first)
        assert done.comparison.equal == done.comparison.outputs > done.ticks
    return fastest, done.comparison.outputs


@pytest.mark.parametrize(("autopilot", "name"), [("px4", "lossy"), ("ardupilot", "reboot")])
def test_a_flight_in_trouble_is_flown_again_to_the_bit(tmp_path, autopilot, name):
    _, outputs = same(in_lockstep(tmp_path, autopilot, name))
    assert outputs > 500


@pytest.mark.soak
def test_twenty_recordings_are_flown_again_to_the_bit_fifty_times_faster_than_they_were(tmp_path):
    files = [in_lockstep(tmp_path, autopilot, name) for autopilot in FLAVOURS for name in TROUBLES]
    with ThreadPoolExecutor(2) as pool:
        files += pool.map(lambda one: over_udp(tmp_path, *one), [(a, f) for a in FLAVOURS for f in UDP_FAULTS])
    assert len(files) == 20
    speeds = {file.name: same(file)[0] for file in files}
    assert min(speeds.values()) >= 50, speeds
    print({name: round(speed) for name, speed in speeds.items()})
