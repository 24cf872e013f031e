"""Several vehicles in one process, and what a vehicle records of itself."""

import signal
import socket
from contextlib import ExitStack
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from vehicle_process import VehicleProcess, free_port

from fakevehicle.driver import px4_links
from logs import Recording, schema
from wire.dialect import mavlink

pytestmark = pytest.mark.udp


def hear(ear: socket.socket, kinds: tuple[str, ...], count: int) -> list[tuple[Any, Any]]:
    """The next messages of some kinds, each with who sent it."""
    found = []
    reader = mavlink.MAVLink(None)
    for _ in range(20_000):
        data, peer = ear.recvfrom(2048)
        message = reader.decode(bytearray(data))
        if message.get_type() in kinds:
            found.append((message, peer))
        if len(found) == count:
            return found
    raise AssertionError(kinds)


def test_the_ports_are_those_of_px4s_instances() -> None:
    """18570+i -> 14550 and 14580+i -> 14540+i; from the eleventh on all call 14549, the last below 14550."""
    for instance, companion in ((0, 14540), (1, 14541), (9, 14549), (10, 14549), (42, 14549)):
        gcs, onboard = px4_links(instance)
        assert (gcs.local, gcs.endpoint.port) == (("127.0.0.1", 18570 + instance), 14550)
        assert (onboard.local, onboard.endpoint.port) == (("127.0.0.1", 14580 + instance), companion)


def test_three_vehicles_call_one_place_and_each_obeys_its_own_commands_only() -> None:
    with ExitStack() as stack:
        ear = stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
        ear.bind(("127.0.0.1", 0))
        ear.settimeout(5.0)
        url = f"udpout:127.0.0.1:{ear.getsockname()[1]}"
        vehicle = stack.enter_context(VehicleProcess("--connect", url, "--count", "3", "--instance", "4"))
        # Told when it becomes known, and every two seconds: six are two of each, every system's from its own address.
        places = {m.get_srcSystem(): (peer, m) for m, peer in hear(ear, ("HOME_POSITION",), 6)}
        assert sorted(places) == [5, 6, 7]
        assert len({peer for peer, _ in places.values()}) == 3
        east = [places[system][1].longitude for system in (5, 6, 7)]
        metres = [(b - a) * 1e-7 * 75_500 for a, b in pairwise(east)]  # a degree at 47.4 north
        assert metres == pytest.approx([3.0, 3.0], abs=1.0)  # each knows its place to its GPS's noise
        client = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
        order = mavlink.MAVLink_command_long_message(6, 1, 512, 0, 148, 0, 0, 0, 0, 0, 0).pack(client)
        for peer, _ in places.values():
            ear.sendto(order, peer)
        ((answer, peer),) = hear(ear, ("COMMAND_ACK",), 1)
        assert (answer.get_srcSystem(), peer) == (6, places[6][0])
        assert vehicle.stop(signal.SIGINT) == 0
        assert [line.split(", home")[0].split(": ")[1] for line in vehicle.log if line.startswith("ready")] == [
            "system 5",
            "system 6",
            "system 7",
        ]


def test_listening_vehicles_count_their_ports_up() -> None:
    port = free_port()
    with VehicleProcess("--connect", f"udpin:127.0.0.1:{port}", "--count", "2") as vehicle:
        assert vehicle.stop() == 0
        assert [f"127.0.0.1:{port + i} (listening)" in line for i, line in enumerate(vehicle.log[:2])] == [True, True]


def test_a_vehicle_records_what_crossed_its_links_and_the_truth(tmp_path: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as ear:
        ear.bind(("127.0.0.1", 0))
        ear.settimeout(5.0)
        url = f"udpout:127.0.0.1:{ear.getsockname()[1]}"
        with VehicleProcess("--connect", url, "--record", str(tmp_path)) as vehicle:
            ((_, peer),) = hear(ear, ("HEARTBEAT",), 1)
            client = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
            order = mavlink.MAVLink_command_long_message(1, 1, 512, 0, 148, 0, 0, 0, 0, 0, 0).pack(client)
            ear.sendto(order, peer)
            hear(ear, ("COMMAND_ACK",), 1)
            hear(ear, ("HEARTBEAT",), 1)  # a second later
            assert vehicle.stop() == 0
    (file,) = tmp_path.iterdir()
    taken = [(m.channel.topic, m.data) for m in Recording.open(file).messages()]
    topics = {topic for topic, _ in taken}
    assert {"/mavlink/raw/onboard/rx", "/mavlink/raw/onboard/tx", "/mavlink/1/1/HEARTBEAT"} <= topics
    assert ("/mavlink/raw/onboard/rx", bytes(order)) in taken
    truths = [schema.decode(schema.Truth, data) for topic, data in taken if topic == "/vehicle/truth"]
    assert len(truths) > 20
    assert all(truth.on_ground for truth in truths)
    assert truths[-1].position_n == pytest.approx((0.0, 0.0, 0.0), abs=0.01)
