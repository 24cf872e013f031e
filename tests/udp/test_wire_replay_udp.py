"""Wire replay over loopback: everything arrives, in order and in time."""

import time
from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from logs.replay_driver import Progress, replay
from logs.wire_replay import Due
from wire import Datagram, Endpoint
from wire.udp import UdpLink, wait

pytestmark = pytest.mark.udp


@pytest.fixture
def stack() -> Iterator[ExitStack]:
    with ExitStack() as opened:
        yield opened


def test_a_ground_station_gets_every_datagram_in_its_time(stack: ExitStack) -> None:
    ground = stack.enter_context(UdpLink("gcs", Endpoint("udpin", "127.0.0.1", 0)))
    link = stack.enter_context(UdpLink("replay", Endpoint("udpout", *ground.local_address)))
    traffic = [Due(number * 0.002, number.to_bytes(2, "big")) for number in range(100)]
    reports: list[Progress] = []
    started_ns = time.monotonic_ns()
    end = replay(traffic, link, reports.append, progress_s=0.05)
    received = []
    while wait([ground], 0.1):
        received += ground.receive()
    assert [item.data for item in received] == [item.data for item in traffic]
    late_s = [(item.received_ns - started_ns) / 1e9 - due.due_s for item, due in zip(received, traffic, strict=True)]
    assert min(late_s) >= 0.0
    assert sorted(late_s)[50] < 0.02
    assert end.datagrams == end.counters.tx_datagrams == 100
    assert len(reports) >= 3
    assert reports[-1] == end


def test_a_listening_replay_waits_for_the_first_to_ask(stack: ExitStack) -> None:
    link = stack.enter_context(UdpLink("replay", Endpoint("udpin", "127.0.0.1", 0)))
    ground = stack.enter_context(UdpLink("gcs", Endpoint("udpout", *link.local_address)))
    ground.send(Datagram("gcs", b"hello"))
    assert replay([Due(0.0, b"x")], link).counters.tx_datagrams == 1
    assert wait([ground], 1.0)
    assert ground.receive()[0].data == b"x"


def test_a_replay_can_be_stopped(stack: ExitStack) -> None:
    ground = stack.enter_context(UdpLink("gcs", Endpoint("udpin", "127.0.0.1", 0)))
    link = stack.enter_context(UdpLink("replay", Endpoint("udpout", *ground.local_address)))
    asked = iter([False, False, False])
    end = replay([Due(0.0, b"1"), Due(60.0, b"2")], link, stop=lambda: next(asked, True))
    assert end.datagrams == 1
