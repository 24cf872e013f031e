"""Other people's clients connected to a replay: MAVSDK hears the flight, pymavlink downloads parameters and mission."""

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from mavsdk_sync import until
from pymavlink import mavutil
from vehicle_process import free_port

from logs import Recording
from logs.importing import import_log
from logs.recorder import Recorder
from wire.dialect import mavlink as m

pytestmark = pytest.mark.udp

TLOG = Path(__file__).parents[1] / "data" / "px4-offboard-65s-71s.tlog"


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    """Six seconds of PX4 in offboard; its parameters and a mission were told before."""
    folder = tmp_path_factory.mktemp("replay")
    flight = Recording.open(import_log(TLOG, folder / "flight.mcap").path)
    mav = m.MAVLink(None, srcSystem=1, srcComponent=1)
    before: list[Any] = [
        m.MAVLink_heartbeat_message(2, 12, 0x1D, 0, 3, 3),
        *(m.MAVLink_param_value_message(b"PARAM_%d" % n, n / 4, 9, 40, n) for n in range(40)),
        m.MAVLink_mission_count_message(255, 190, 3),
        *(
            m.MAVLink_mission_item_int_message(255, 190, n, 6, 16, 0, 1, 0, 0, 0, 0, 473977420 + n, 85455940, 10 + n)
            for n in range(3)
        ),
    ]
    path = folder / "whole.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        first = next(flight.messages()).log_time_ns
        for tick, message in enumerate(before):
            recorder.datagram(
                "autopilot", "rx", bytes(message.pack(mav)), log_time_ns=first, now_us=first // 1000, tick=tick
            )
        for tick, item in enumerate(flight.messages(), len(before)):
            if item.channel.direction is not None:
                stamp = item.log_time_ns
                recorder.datagram(
                    "autopilot", item.channel.direction, item.data, log_time_ns=stamp, now_us=stamp // 1000, tick=tick
                )
    return Recording.open(path)


@contextmanager
def replayed(recording: Recording, *arguments: str) -> Iterator[Any]:
    """A process that replays the recording."""
    command = [sys.executable, "-m", "companion", "replay", str(recording.path), "--json", *arguments]
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def test_mavsdk_hears_a_replay_as_it_heard_the_flight(recording: Recording) -> None:
    pytest.importorskip("mavsdk")
    from mavsdk import ComponentType, Configuration, Mavsdk
    from mavsdk.plugins.telemetry import FlightMode, Telemetry

    recorded = [
        (row.lat / 1e7, row.lon / 1e7)
        for item in recording.messages()
        if item.channel.schema == "mavlink.GLOBAL_POSITION_INT"
        for row in [recording.decode(item)]
    ]
    port = free_port()
    client = Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION))
    try:
        client.add_any_connection(f"udpin://127.0.0.1:{port}")
        with replayed(recording, "--to", f"udpout:127.0.0.1:{port}", "--loop"):
            system = client.first_autopilot(20.0)
            assert system is not None
            telemetry = Telemetry(system)
            until(lambda: telemetry.flight_mode() == FlightMode.OFFBOARD, 10, "the recorded mode")
            until(telemetry.armed, 5, "armed, as recorded")

            def position() -> tuple[float, float]:
                found = telemetry.position()
                return found.latitude_deg, found.longitude_deg

            places: set[tuple[float, float]] = set()
            until(lambda: places.add(position()) or len(places) > 20, 10, "positions")
            places = {place for place in places if place[0] == place[0]}
            assert all(min(abs(a - c) + abs(b - d) for c, d in recorded) < 1e-9 for a, b in places)
    finally:
        client.destroy()


def test_pymavlink_downloads_parameters_and_mission_from_a_replay_and_gets_every_datagram(
    recording: Recording,
) -> None:
    raw = [item for item in recording.messages() if item.channel.direction == "rx"]
    expected = [item.data for item in raw if item.log_time_ns <= raw[0].log_time_ns + 2_000_000_000]
    port = free_port()
    with replayed(recording, "--to", f"udpin:127.0.0.1:{port}", "--duration", "2") as process:
        link = mavutil.mavlink_connection(f"udpout:127.0.0.1:{port}", source_system=255, dialect="all")
        try:
            heard: list[bytes] = []
            parameters: dict[str, float] = {}
            items: dict[int, tuple[int, float]] = {}
            asked = False
            until(lambda: link.mav.heartbeat_send(6, 8, 0, 0, 4) or link.recv_msg() is not None, 20, "the replay")
            link.mav.param_request_list_send(1, 1)
            link.mav.mission_request_list_send(1, 1)
            while (message := link.recv_match(blocking=True, timeout=0.8)) is not None:
                heard.append(bytes(message.get_msgbuf()))
                if message.get_type() == "PARAM_VALUE" and message.param_count == 40:
                    parameters[message.param_id] = message.param_value
                elif message.get_type() == "MISSION_COUNT" and not asked and message.get_srcSystem() == 1:
                    asked = True
                    for number in range(message.count):
                        link.mav.mission_request_int_send(1, 1, number)
                elif message.get_type() == "MISSION_ITEM_INT":
                    items[message.seq] = message.x, message.z
        finally:
            link.close()
        told = json.loads(process.communicate(timeout=10)[0])
    assert told["ok"]
    assert told["answers"] >= 40 + 1 + 3
    assert parameters == {f"PARAM_{number}": number / 4 for number in range(40)}
    assert items == {number: (473977420 + number, 10.0 + number) for number in range(3)}
    assert set(expected[len(expected) // 2 :]) <= set(heard)
