"""The demo: two processes on loopback, real sockets, real time; and what a flight must survive there."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

pytestmark = pytest.mark.udp


def companion(*arguments: str, **options) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "companion", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=180, check=False, **options)


@pytest.fixture(scope="module")
def demo(tmp_path_factory) -> dict:
    directory = tmp_path_factory.mktemp("demo")
    done = companion("demo", "--record", str(directory), "--json")
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(done.stdout)


def test_the_demo_flies_round_the_wall_as_its_mission_expects(demo):
    assert demo["ok"]
    assert demo["tracking_error_source"] == "truth"
    assert demo["tracking_error_p95_m"] < 0.35
    assert demo["min_clearance_m"] > 0.1


def test_setpoints_leave_at_50_hz_while_plans_are_made_beside_them(demo):
    assert demo["setpoint_rate_hz"] == pytest.approx(50.0, abs=0.5)
    assert demo["setpoint_gap_p99_ms"] < 30


def test_nothing_is_lost_between_the_sockets_and_the_recording(demo):
    assert demo["kernel_drops"] == demo["recorder_drops"] == demo["sequence_gaps"] == 0
    with Path(demo["recording"]).open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        counts = {d: 0 for d in ("rx", "tx")}
        for _, channel, _ in reader.iter_messages():
            if channel.topic.startswith("/mavlink/raw/autopilot/"):
                counts[channel.topic.rsplit("/", 1)[1]] += 1
        sockets = next(m.metadata for m in reader.iter_metadata() if m.name == "sockets")
        for channel in reader.get_summary().channels.values():
            if channel.message_encoding == "protobuf":
                assert reader.get_summary().schemas[channel.schema_id].data
        assert sum(1 for _ in reader.iter_decoded_messages(["/mavlink/1/1/LOCAL_POSITION_NED"])) > 500
    assert counts["rx"] == int(sockets["autopilot.rx_datagrams"])
    assert counts["tx"] == int(sockets["autopilot.tx_datagrams"]) == int(sockets["autopilot.handed"])


def test_a_page_of_the_flight_lies_beside_its_recording(demo):
    page = Path(demo["report"])
    assert page == Path(demo["recording"]).with_suffix(".html")
    assert page.read_text("utf-8").startswith("<!doctype html>")


def test_the_recording_of_real_sockets_and_real_jitter_runs_again_bit_for_bit(demo):
    done = companion("rerun", demo["recording"], "--json")
    assert done.returncode == 0, done.stdout + done.stderr
    result = json.loads(done.stdout)
    assert result["equal"] == result["outputs"] > 1000


def test_a_busy_port_is_one_clear_line(tmp_path):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        master = f"udpin:127.0.0.1:{port}"
        done = companion("fly", "missions/l_shape.yaml", "--master", master, "--record", str(tmp_path))
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert f"{port} is already in use" in done.stderr


def test_a_vehicle_that_never_answers_is_said_in_one_line_and_the_recording_is_closed(tmp_path):
    done = companion(
        *("fly", "missions/l_shape.yaml", "--master", "udpin:127.0.0.1:0", "--record", str(tmp_path)),
        *("--wait", "1", "--json"),
    )
    assert done.returncode == 1
    result = json.loads(done.stdout)
    assert "no HEARTBEAT from a vehicle in 1 s" in result["failure"]
    info = json.loads(companion("log", "info", result["recording"], "--json").stdout)
    assert info["complete"]


def test_ctrl_c_in_flight_lands_and_the_recording_is_closed_properly(tmp_path):
    command = [sys.executable, "-m", "companion", "demo", "--record", str(tmp_path), "--json"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    for line in process.stderr:
        if "step 2: goto" in line:
            break
    time.sleep(1.0)
    os.kill(process.pid, signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    result = json.loads(out)
    assert process.returncode == 1
    assert result["phase"] == "done"
    assert "operator" in result["failure"]
    info = json.loads(companion("log", "info", result["recording"], "--json").stdout)
    assert info["complete"]


def test_the_demo_flies_an_ardupilot_too(tmp_path):
    done = companion("demo", "--autopilot", "ardupilot", "--record", str(tmp_path), "--json")
    assert done.returncode == 0, done.stdout + done.stderr
    flight = json.loads(done.stdout)
    assert flight["phase"] == "done"
    assert flight["tracking_error_p95_m"] < 0.25
    assert flight["setpoint_rate_hz"] == pytest.approx(50.0, abs=0.5)
