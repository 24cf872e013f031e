"""`companion replay` over loopback: what the vehicle sent, unless the rest is asked for in so many words."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from logs_traffic import captured, heartbeat, record_captured, sent_by_ground

from companion.cli.replay import Asked, replay_log
from logs.errors import RecordingError
from logs.recorder import Recorder
from logs.selection import Selection
from wire import Endpoint
from wire.udp import UdpLink, wait

pytestmark = pytest.mark.udp


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recording") / "flight.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        recorder.datagram("gcs", "rx", heartbeat(255, 190, 8), log_time_ns=0, now_us=0, tick=0)
        record_captured(recorder)
    return path


@pytest.fixture
def ground() -> Iterator[UdpLink]:
    with UdpLink("gcs", Endpoint("udpin", "127.0.0.1", 0)) as link:
        yield link


def replayed(
    log: Path, ground: UdpLink, capsys: pytest.CaptureFixture[str], **more: Any
) -> tuple[dict[str, Any], list[bytes]]:
    """What the replay said of itself, and what arrived."""
    host, port = ground.local_address
    assert replay_log(log, f"udpout:{host}:{port}", Asked(50.0, **more), True) == 0
    arrived = []
    while wait([ground], 0.05):
        arrived += [item.data for item in ground.receive()]
    return json.loads(capsys.readouterr().out), arrived


def test_a_ground_station_gets_what_the_vehicle_sent_and_nothing_else(
    log: Path, ground: UdpLink, capsys: pytest.CaptureFixture[str]
) -> None:
    told, arrived = replayed(log, ground, capsys)
    assert arrived == [packet for _, packet in captured() if not sent_by_ground(packet)]
    assert (told["link"], told["datagrams"], told["of"]) == ("autopilot", len(arrived), len(arrived))
    assert told["spacing_error_p99_ms"] >= 0.0


def test_commands_go_out_only_when_asked_for_in_so_many_words_and_then_alone(
    log: Path, ground: UdpLink, capsys: pytest.CaptureFixture[str]
) -> None:
    _, arrived = replayed(log, ground, capsys, to_a_vehicle=True)
    assert arrived == [packet for _, packet in captured() if sent_by_ground(packet)]


def test_rounds_and_filters_go_together(log: Path, ground: UdpLink, capsys: pytest.CaptureFixture[str]) -> None:
    wanted = Selection(names=("ATTITUDE",), systems=(1,), start_s=1.0, duration_s=1.0)
    told, arrived = replayed(log, ground, capsys, wanted=wanted, rounds=2)
    once = arrived[: len(arrived) // 2]
    assert arrived == once + once
    assert {data[7] for data in arrived} == {30}
    assert told["of"] == len(arrived) > 20


def test_what_a_ground_station_sent_is_no_telemetry(log: Path, ground: UdpLink) -> None:
    with pytest.raises(RecordingError, match="no autopilot was heard on link 'gcs'"):
        replay_log(log, "udpout:127.0.0.1:9", Asked(link_name="gcs"), True)
    with pytest.raises(RecordingError, match=r"no datagram of link autopilot is left .* it holds no NO_SUCH"):
        replay_log(log, "udpout:127.0.0.1:9", Asked(wanted=Selection(names=("NO_SUCH",))), True)
