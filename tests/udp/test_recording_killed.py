"""kill -9 while a process records: what is on the disk comes back, and no more than half a second is missing."""

import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from mcap.reader import NonSeekingReader, make_reader

from logs import Recording
from logs.recovery import recover_unfinished

pytestmark = pytest.mark.udp

RECORDS = """
import sys, time
from pathlib import Path
from logs import schema
from logs.recorder import Recorder

packet = bytes.fromhex("fd090000cf010100000000000403020c1d0003d978")
with Recorder(Path(sys.argv[1]), metadata={"run": {"seed": "1"}}, threaded=True) as recorder:
    print("recording", flush=True)
    tick = 0
    while True:
        now_us = time.time_ns() // 1000
        for _ in range(20):
            at = {"log_time_ns": time.time_ns(), "now_us": now_us, "tick": tick}
            recorder.datagram("autopilot", "rx", packet, **at)
        recorder.message("/companion/tick", schema.Tick(now_us, 20, 0), **at)
        tick += 1
        time.sleep(0.02)
"""
MISSING_S = 0.5


@contextmanager
def session(*command: str) -> "Iterator[subprocess.Popen[str]]":
    """A process and whatever it starts, gone at the end."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True)
    try:
        yield process
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        assert process.stdout is not None
        process.stdout.close()


def judge(folder: Path, killed_ns: int, most_missing_s: float) -> int:
    """Recover the one file of the folder; returns how many messages it holds."""
    (path,) = folder.glob("*.mcap")
    assert not Recording.open(path).complete
    linear = sum(1 for _ in Recording.open(path).messages())
    (done,) = recover_unfinished(folder)
    assert not isinstance(done, Exception)
    with path.open("rb") as file:
        stamps = [
            m.log_time for *_, m in NonSeekingReader(file, validate_crcs=True).iter_messages(log_time_order=False)
        ]
        file.seek(0)
        assert len(list(make_reader(file, validate_crcs=True).iter_messages())) == len(stamps) >= linear
    assert Recording.open(path).complete
    assert (killed_ns - max(stamps)) / 1e9 < most_missing_s
    assert recover_unfinished(folder) == []
    return len(stamps)


@pytest.mark.parametrize("kill", range(3))
def test_a_recording_whose_process_was_killed_misses_half_a_second_at_most(tmp_path: Path, kill: int) -> None:
    with session(sys.executable, "-c", RECORDS, str(tmp_path / "killed.mcap")) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "recording\n"
        time.sleep(random.Random(kill).uniform(0.8, 2.0))
        assert recover_unfinished(tmp_path) == []  # somebody writes it
        os.kill(process.pid, signal.SIGKILL)
        killed_ns = time.time_ns()
        process.wait()
        assert judge(tmp_path, killed_ns, MISSING_S) > 300


@pytest.mark.soak
@pytest.mark.parametrize("kill", range(50))
def test_a_flight_killed_at_any_moment_leaves_a_recording_that_is_recovered(tmp_path: Path, kill: int) -> None:
    """`KILLS` in the environment limits how many of the fifty are flown."""
    if kill >= int(os.environ.get("KILLS", "50")):
        pytest.skip("fewer were asked for")
    with session(sys.executable, "-m", "companion", "demo", "--record", str(tmp_path)) as process:
        while not list(tmp_path.glob("*.mcap")):
            assert process.poll() is None
            time.sleep(0.05)
        time.sleep(random.Random(kill).uniform(1.5, 12.0))
        assert process.poll() is None
        os.kill(process.pid, signal.SIGKILL)
        killed_ns = time.time_ns()
        process.wait()
        assert judge(tmp_path, killed_ns, MISSING_S) > 0
