"""The spacing of a replay at rate 1, by the kernel's stamps on arrival: judged by the clock, so with the long tests."""

import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

from logs import Recording
from logs.importing import import_log
from wire import Endpoint
from wire.udp import Received, UdpLink, wait

pytestmark = [pytest.mark.udp, pytest.mark.soak]

TLOG = Path(__file__).parents[1] / "data" / "px4-offboard-65s-71s.tlog"


def test_99_of_100_spacings_are_right_to_2_ms_and_every_datagram_to_the_byte(tmp_path: Path) -> None:
    recording = Recording.open(import_log(TLOG, tmp_path / "flight.mcap").path)
    recorded = [item for item in recording.messages() if item.channel.direction == "rx"]
    received: list[Received] = []
    with UdpLink("gcs", Endpoint("udpin", "127.0.0.1", 0)) as ground:
        host, port = ground.local_address
        command = [sys.executable, "-m", "companion", "replay", str(recording.path), "--to", f"udpout:{host}:{port}"]
        with subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            while process.poll() is None or wait([ground], 0.1):
                wait([ground], 0.5)
                received += ground.receive()
        assert ground.counters.drops == 0
    assert [item.data for item in received] == [item.data for item in recorded]
    errors_ns = sorted(
        abs((received[n + 1].received_ns - received[n].received_ns) - (later.log_time_ns - item.log_time_ns))
        for n, (item, later) in enumerate(pairwise(recorded))
    )
    p50, p99 = (errors_ns[len(errors_ns) * share // 100] / 1e6 for share in (50, 99))
    print(f"{len(errors_ns)} spacings: error p50 {p50:.3f} ms, p99 {p99:.3f} ms, greatest {errors_ns[-1] / 1e6:.3f} ms")
    assert p99 <= 2.0
