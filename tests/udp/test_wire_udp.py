"""Sockets on loopback: peers, counters, errors that belong to the system and errors that belong to a peer."""

import socket
import time
from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from wire import Datagram, Endpoint, LinkError
from wire.udp import MAX_PEERS, Received, UdpLink, wait

pytestmark = pytest.mark.udp


@pytest.fixture
def stack() -> Iterator[ExitStack]:
    with ExitStack() as opened:
        yield opened


def listen(stack: ExitStack, host: str = "127.0.0.1") -> UdpLink:
    return stack.enter_context(UdpLink("vehicle", Endpoint("udpin", host, 0)))


def call(stack: ExitStack, link: UdpLink) -> UdpLink:
    return stack.enter_context(UdpLink("companion", Endpoint("udpout", *link.local_address)))


def take(link: UdpLink, count: int) -> list[Received]:
    """Receive until `count` datagrams are there; the test fails if they do not come within a second."""
    taken: list[Received] = []
    deadline = time.monotonic() + 1.0
    while len(taken) < count:
        assert wait([link], deadline - time.monotonic()), f"{len(taken)} of {count} datagrams came"
        taken += link.receive()
    return taken


@pytest.mark.parametrize("host", ["127.0.0.1", "::1"])
def test_bytes_cross_both_ways_and_both_ends_count_them(stack: ExitStack, host: str) -> None:
    vehicle = listen(stack, host)
    companion = call(stack, vehicle)
    companion.send(Datagram("companion", b"setpoint"))
    (received,) = take(vehicle, 1)
    assert received.data == b"setpoint"
    assert received.peer == companion.local_address
    vehicle.send(Datagram("vehicle", b"ack", received.peer))
    (answer,) = take(companion, 1)
    assert (answer.data, answer.peer) == (b"ack", vehicle.local_address)
    for counters, rx, tx in ((vehicle.counters, 8, 3), (companion.counters, 3, 8)):
        assert (counters.rx_datagrams, counters.rx_bytes) == (1, rx)
        assert (counters.tx_datagrams, counters.tx_bytes) == (1, tx)
        assert (counters.send_errors, counters.refused, counters.drops) == (0, 0, 0)


def test_the_stamp_is_the_arrival_not_the_reading(stack: ExitStack) -> None:
    vehicle = listen(stack)
    companion = call(stack, vehicle)
    before = time.monotonic_ns()
    companion.send(Datagram("companion", b"x"))
    wait([vehicle], 1.0)
    arrived = time.monotonic_ns()
    time.sleep(0.05)
    (received,) = vehicle.receive()
    assert before - 1_000_000 <= received.received_ns <= arrived + 1_000_000


def test_without_a_peer_named_every_known_peer_is_sent_to(stack: ExitStack) -> None:
    vehicle = listen(stack)
    vehicle.send(Datagram("vehicle", b"into the void"))
    assert vehicle.counters.tx_datagrams == 0
    clients = [call(stack, vehicle) for _ in range(3)]
    for client in clients:
        client.send(Datagram("companion", b"hello"))
    take(vehicle, 3)
    assert vehicle.peers == tuple(client.local_address for client in clients)
    vehicle.send(Datagram("vehicle", b"telemetry"))
    assert [take(client, 1)[0].data for client in clients] == [b"telemetry"] * 3
    assert vehicle.counters.tx_datagrams == 3


def test_a_calling_link_answers_others_who_write_to_it(stack: ExitStack) -> None:
    ground = listen(stack)
    vehicle = call(stack, ground)
    stranger = stack.enter_context(UdpLink("stranger", Endpoint("udpout", *vehicle.local_address)))
    stranger.send(Datagram("stranger", b"hello"))
    take(vehicle, 1)
    assert vehicle.peers == (ground.local_address, stranger.local_address)
    vehicle.send(Datagram("vehicle", b"telemetry"))
    assert take(ground, 1)[0].data == take(stranger, 1)[0].data == b"telemetry"


def test_the_peer_silent_for_longest_makes_room_for_a_new_one(stack: ExitStack) -> None:
    vehicle = listen(stack)
    clients = [call(stack, vehicle) for _ in range(MAX_PEERS + 1)]
    for client in clients[:-1]:
        client.send(Datagram("companion", b"1"))
        take(vehicle, 1)
    clients[0].send(Datagram("companion", b"2"))  # the first is the oldest, but no longer silent
    take(vehicle, 1)
    clients[-1].send(Datagram("companion", b"1"))
    take(vehicle, 1)
    assert len(vehicle.peers) == MAX_PEERS
    assert clients[0].local_address in vehicle.peers
    assert clients[1].local_address not in vehicle.peers
    assert clients[-1].local_address in vehicle.peers


def test_a_link_can_call_from_a_fixed_port(stack: ExitStack) -> None:
    ground = listen(stack)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        free = probe.getsockname()[1]
    link = UdpLink("vehicle", Endpoint("udpout", *ground.local_address), local=("127.0.0.1", free))
    stack.enter_context(link)
    link.send(Datagram("vehicle", b"x"))
    assert take(ground, 1)[0].peer == ("127.0.0.1", free)


def test_a_refusal_is_counted_and_neither_raises_nor_keeps_waking_the_caller(stack: ExitStack) -> None:
    ground = listen(stack)
    vehicle = call(stack, ground)
    ground.close()
    for _ in range(5):
        vehicle.send(Datagram("vehicle", b"anyone?"))
    wait([vehicle], 1.0)
    assert vehicle.receive() == []
    assert vehicle.counters.refused == 5
    assert vehicle.counters.send_errors == 0
    assert wait([vehicle], 0.0) == []


def test_a_busy_port_is_one_line_that_names_it(stack: ExitStack) -> None:
    taken = listen(stack).local_address
    with pytest.raises(LinkError) as caught:
        UdpLink("gcs", Endpoint("udpin", *taken))
    assert str(caught.value) == (
        f"link 'gcs' (udpin:127.0.0.1:{taken[1]}): 127.0.0.1 port {taken[1]} is already in use by another program"
    )


def test_an_address_of_another_machine_is_one_line(stack: ExitStack) -> None:
    with pytest.raises(LinkError, match=r"192\.0\.2\.1 port 14540: this machine has no such address"):
        UdpLink("gcs", Endpoint("udpin", "192.0.2.1", 14540))


def test_datagrams_the_kernel_had_no_room_for_are_counted(stack: ExitStack) -> None:
    vehicle = listen(stack)
    companion = call(stack, vehicle)
    sent = 0
    payload = bytes(1400)
    while sent * len(payload) < 2 * vehicle.receive_buffer_bytes:
        companion.send(Datagram("companion", payload))
        sent += 1
    while wait([vehicle], 0.0):
        vehicle.receive()
    counters = vehicle.counters  # without another datagram that would bring the count
    assert counters.drops > 0
    assert counters.rx_datagrams + counters.drops == sent
    vehicle.close()
    assert vehicle.counters.drops == counters.drops


def test_wait_names_only_the_links_that_have_something_and_gives_up_in_time(stack: ExitStack) -> None:
    quiet, busy = listen(stack), listen(stack)
    started = time.monotonic()
    assert wait([quiet, busy], 0.02) == []
    assert 0.02 <= time.monotonic() - started < 0.5
    call(stack, busy).send(Datagram("companion", b"x"))
    assert wait([quiet, busy], 1.0) == [busy]


def test_a_fixed_source_for_a_listening_link_is_our_own_mistake() -> None:
    with pytest.raises(ValueError, match="udpout"):
        UdpLink("vehicle", Endpoint("udpin", "127.0.0.1", 0), local=("127.0.0.1", 0))


def test_what_the_kernel_will_not_send_is_counted_and_a_closed_link_is_our_own_mistake(stack: ExitStack) -> None:
    vehicle = listen(stack)
    vehicle.send(Datagram("vehicle", bytes(70_000), ("127.0.0.1", 9)))  # larger than any UDP datagram
    assert (vehicle.counters.send_errors, vehicle.counters.tx_datagrams) == (1, 0)
    vehicle.close()
    vehicle.close()
    with pytest.raises(ValueError, match="'vehicle' is closed"):
        vehicle.receive()
    with pytest.raises(ValueError, match="'vehicle' is closed"):
        vehicle.send(Datagram("vehicle", b"x", ("127.0.0.1", 9)))
