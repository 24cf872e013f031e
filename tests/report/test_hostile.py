"""Recordings of nonsense: any numbers in any packet at any time still make a page."""

import numpy as np
import pytest

from logs.reader import Recording
from logs.recorder import Recorder
from logs.report import report_page
from logs.report.gather import gather
from logs.report.traffic import ASKED, TOLD
from wire.dialect import mavlink

HEARTBEAT = bytes((0, 0, 0, 0, 2, 12, 255, 4, 3))


def packet(rng: np.random.Generator, k: int, system: int) -> bytes:
    """A whole MAVLink 2 packet of a kind that reports read, with anything in it."""
    number = int(rng.choice([0, *TOLD, *ASKED]))
    size = int(rng.integers(1, 60))
    values = rng.integers(0, 256, size) if rng.random() < 0.7 else rng.choice([0, 255, 127], size)
    payload = HEARTBEAT if number == 0 else values.astype(np.uint8).tobytes()
    head = bytes((len(payload), 0, 0, k % 256, system, 1)) + number.to_bytes(3, "little")
    crc = mavlink.x25crc(head + payload)
    crc.accumulate(bytes((mavlink.mavlink_map[number].crc_extra,)))
    return b"\xfd" + head + payload + int(crc.crc).to_bytes(2, "little")


@pytest.mark.parametrize("seed", range(12))
def test_nonsense_in_any_packet_makes_a_page_all_the_same(seed, tmp_path):
    rng, path = np.random.default_rng(seed), tmp_path / "nonsense.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for k in range(150):
            system = int(rng.choice([1, 1, 1, 255]))
            wild = seed % 3 == 0 and rng.random() < 0.05
            log_ns = int(rng.integers(0, 2**62)) if wild else k * 100_000_000
            way = "rx" if system == 1 else "tx"
            recorder.datagram("a", way, packet(rng, k, system), log_time_ns=log_ns, now_us=0, tick=k)
    report = gather(Recording.open(path))
    assert report.events
    assert report_page(report.to_json()).startswith("<!doctype html>")
