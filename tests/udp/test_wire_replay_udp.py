"""Wire replay over loopback: everything arrives, in order and in time."""

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack

import pytest

from logs.answering import Answering
from logs.reader import ChannelInfo, RecordedMessage
from logs.replay_driver import Key, Progress, replay
from logs.wire_replay import Due
from wire import Datagram, Endpoint
from wire.dialect import mavlink
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


def test_keys_pause_step_and_end_a_replay(stack: ExitStack) -> None:
    ground = stack.enter_context(UdpLink("gcs", Endpoint("udpin", "127.0.0.1", 0)))
    link = stack.enter_context(UdpLink("replay", Endpoint("udpout", *ground.local_address)))
    traffic = [Due(number * 0.01, bytes((number,)), number * 0.01) for number in range(100)]
    plan: list[tuple[Callable[[], bool], list[Key]]] = [
        (lambda: link.counters.tx_datagrams == 5, ["pause"]),
        (lambda: time.monotonic() > paused_s[0] + 0.1, ["step", "step"]),
        (lambda: link.counters.tx_datagrams == 7, ["quit"]),
    ]
    paused_s: list[float] = []

    def keys() -> list[Key]:
        """Pause after five, wait a while, step twice, end."""
        if not plan or not plan[0][0]():
            return []
        paused_s.append(time.monotonic())
        return plan.pop(0)[1]

    end = replay(traffic, link, keys=keys)
    assert (end.datagrams, end.ended, end.paused) == (7, True, True)
    assert end.elapsed_s > 0.1
    received = []
    while wait([ground], 0.05):
        received += ground.receive()
    assert [item.data for item in received] == [bytes((number,)) for number in range(7)]


def test_a_question_is_answered_while_the_replay_goes_on(stack: ExitStack) -> None:
    link = stack.enter_context(UdpLink("replay", Endpoint("udpin", "127.0.0.1", 0)))
    ground = stack.enter_context(UdpLink("gcs", Endpoint("udpout", *link.local_address)))
    mav = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    channel = ChannelInfo("/mavlink/raw/autopilot/rx", "mavlink", "", "autopilot", "rx")
    told = [
        mavlink.MAVLink_heartbeat_message(2, 12, 0, 0, 3, 3),
        mavlink.MAVLink_param_value_message(b"A", 2.5, 9, 1, 0),
    ]
    recorded = [RecordedMessage(channel, 0, 0, 0, bytes(message.pack(mav))) for message in told]
    asker = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
    ground.send(Datagram("gcs", bytes(mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3).pack(asker))))
    ground.send(Datagram("gcs", bytes(mavlink.MAVLink_param_request_list_message(1, 1).pack(asker))))
    time.sleep(0.01)
    traffic = [Due(number * 0.01, bytes((number,))) for number in range(5)]
    end = replay(traffic, link, answering=Answering(recorded, "autopilot"))
    received = []
    while wait([ground], 0.05):
        received += [item.data for item in ground.receive()]
    assert end.answers == 1
    assert [data for data in received if len(data) == 1] == [item.data for item in traffic]
    [answer] = [data for data in received if len(data) > 1]
    assert mavlink.MAVLink(None).decode(bytearray(answer)).param_value == 2.5
