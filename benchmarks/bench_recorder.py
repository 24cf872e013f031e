"""Recording at rates no vehicle has: `python -m benchmarks.bench_recorder [--full]`.

A process sends datagrams of MAVLink over loopback by the clock; another receives and records them, in the service's
way: receive, tick by tick at 50 Hz, recorder with its thread. What it costs is the receiving process's CPU time over
wall time; losses are the kernel's drops plus the recorder's, held against what was sent; memory is sampled each second.
The same traffic is then received by the same loop and kept by pymavlink's tlog writer (`mavutil`'s framing, a write
each), and by the plain `mcap` writer with the decoded packets as JSON. Default: 20 000 a second for 10 s, 60 000
for 3 s; `--full`: 60 s and 10 s.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mcap.reader import make_reader
from mcap.writer import Writer
from pymavlink.dialects.v20 import all as mavlink

from companion.drivers.recording import socket_losses
from logs import schema
from logs.errors import RecordingError
from logs.reader import Recording
from logs.recorder import Recorder
from wire.endpoint import Endpoint
from wire.udp import UdpLink, wait

TICK_S = 0.02
PACKETS = 4096


def packets() -> list[bytes]:
    """Traffic of a vehicle: what it says most often, no two of them the same."""
    found = []
    for sequence in range(PACKETS):
        mav = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
        mav.seq = sequence & 0xFF
        t, f = sequence * 37 + 123_456, [0.1 * sequence + k for k in range(12)]
        messages = (
            mavlink.MAVLink_attitude_message(t, *f[:6]),
            mavlink.MAVLink_local_position_ned_message(t, *f[:6]),
            mavlink.MAVLink_highres_imu_message(t, *f[:9], 101.3, 0.1, 100.0, 20.0, 65535, 0),
            mavlink.MAVLink_global_position_int_message(t, 473977418, 85455939, 488000, 100 * sequence, 1, 2, 3, 900),
            mavlink.MAVLink_attitude_message(t, *f[6:]),
            mavlink.MAVLink_attitude_quaternion_message(t, *f[:7], [1.0, 0.1, 0.2, 0.3]),
            mavlink.MAVLink_servo_output_raw_message(t, 0, *range(1000, 1016)),
            mavlink.MAVLink_position_target_local_ned_message(t, 1, 0, *f[:11]),
        )
        found.append(bytes(messages[sequence % len(messages)].pack(mav)))
    return found


def send(port: int, rate: int, seconds: float) -> None:
    """The sender's process: bursts every 2 ms, so many that the rate holds; says how many were sent."""
    import socket

    link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    link.connect(("127.0.0.1", port))
    traffic, sent, start = packets(), 0, time.monotonic()
    while (now := time.monotonic() - start) < seconds:
        due = int(now * rate)
        while sent < due:
            link.send(traffic[sent % PACKETS])
            sent += 1
        time.sleep(max(0.0, 0.002 - (time.monotonic() - start - now)))
    print(sent, flush=True)


@dataclass(frozen=True, slots=True)
class Measured:
    """One run."""

    name: str
    sent: int
    kept: int
    kernel_drops: int
    other_drops: int
    cpu_share: float
    memory_mb: tuple[float, float]  # after 2 s, and at the end
    stall_ms: tuple[float, float]  # longest time in which nothing was received, and our own CPU time in it
    file_mb: float


def memory_mb() -> float:
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


@contextmanager
def sender(port: int, rate: int, seconds: float) -> "Iterator[subprocess.Popen[str]]":
    command = [sys.executable, "-m", "benchmarks.bench_recorder", "--send", str(port), str(rate), str(seconds)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        yield process


Keep = Callable[[list[Any], int, int], None]


def receive(
    name: str, rate: int, seconds: float, open_: Callable[[Path, UdpLink], tuple[Keep, Callable[[], Any]]]
) -> Measured:
    """Receive as `fly_realtime` does, keep by `open_`'s first, close by its second."""
    with tempfile.TemporaryDirectory() as folder, UdpLink("autopilot", Endpoint.parse("udpin:127.0.0.1:0")) as link:
        path = Path(folder) / "bench.mcap"
        keep, close = open_(path, link)
        received, tick, memory, epoch_ns = 0, 0, 0.0, time.time_ns() - time.monotonic_ns()
        with sender(link.local_address[1], rate, seconds) as process:
            while not wait([link], 1.0):
                pass
            start, cpu = time.monotonic(), time.process_time()
            deadline, quiet, stall, then = start + TICK_S, 0, (0.0, 0.0), (start, cpu)
            while quiet < 25:
                inputs = []
                while (left := deadline - time.monotonic()) > 0:
                    for ready in wait([link], left):
                        inputs += ready.receive()
                        now = time.monotonic(), time.process_time()
                        stall = max(stall, (1e3 * (now[0] - then[0]), 1e3 * (now[1] - then[1])))
                        then = now
                now_us = (time.monotonic_ns() + epoch_ns) // 1000
                keep(inputs, now_us, tick)
                received += len(inputs)
                quiet = 0 if inputs or process.poll() is None else quiet + 1
                memory = memory or (memory_mb() if time.monotonic() - start > 2.0 else 0.0)
                tick += 1
                deadline = max(deadline + TICK_S, time.monotonic())
            end_memory = memory_mb()
            closed = close()
            cpu = time.process_time() - cpu
            assert process.stdout is not None
            sent = int(process.stdout.read())
        kept, other = closed if closed is not None else (received, 0)
        share = cpu / seconds
        file_mb, drops = path.stat().st_size / 1e6, link.counters.drops
        return Measured(name, sent, kept, drops, other, share, (memory, end_memory), stall, file_mb)


def ours(path: Path, link: UdpLink) -> tuple[Keep, Callable[[], Any]]:
    recorder = Recorder(path, metadata={}, threaded=True, losses=socket_losses({"autopilot": link}))
    epoch_ns = time.time_ns() - time.monotonic_ns()

    def keep(inputs: list[Any], now_us: int, tick: int) -> None:
        for got in inputs:
            stamp_ns = (got.received_ns + epoch_ns) // 1000 * 1000
            recorder.datagram(
                "autopilot", "rx", got.data, log_time_ns=stamp_ns, now_us=now_us, tick=tick, peer=got.peer
            )
        recorder.message(
            "/companion/tick", schema.Tick(now_us, len(inputs), 0), log_time_ns=now_us * 1000, now_us=now_us, tick=tick
        )

    def close() -> tuple[int, int]:
        with suppress(RecordingError):  # what it could not keep is counted
            recorder.close()
        counters = recorder.counters
        with path.open("rb") as file:
            summary = make_reader(file).get_summary()
        assert summary is not None
        assert summary.statistics is not None
        total = counters.rx["autopilot"] + counters.decoded + counters.messages
        assert summary.statistics.message_count == total
        told = {}
        for message in Recording.open(path).messages(["/companion/losses"]):
            loss = schema.decode(schema.Loss, message.data)
            told[loss.of] = loss.total
        assert told.get("autopilot.kernel_drops", 0) == link.counters.drops
        return counters.rx["autopilot"], counters.dropped_raw

    return keep, close


def tlog(path: Path, link: UdpLink) -> tuple[Keep, Callable[[], Any]]:
    """As `mavutil.mavlogfile`'s other end does it: parse, eight bytes of time, the packet."""
    file = path.open("wb")
    parser = mavlink.MAVLink(None)
    parser.robust_parsing = True

    def keep(inputs: list[Any], now_us: int, tick: int) -> None:
        for got in inputs:
            for message in parser.parse_buffer(got.data) or ():
                file.write(now_us.to_bytes(8, "big") + bytes(message.get_msgbuf()))

    return keep, file.close


def mcap_json(path: Path, link: UdpLink) -> tuple[Keep, Callable[[], Any]]:
    writer = Writer(str(path))
    writer.start()
    raw = writer.register_channel("/raw", "mavlink", 0)
    channels: dict[str, int] = {}
    parser = mavlink.MAVLink(None)
    parser.robust_parsing = True

    def keep(inputs: list[Any], now_us: int, tick: int) -> None:
        for got in inputs:
            writer.add_message(raw, got.received_ns, got.data, got.received_ns, tick)
            for message in parser.parse_buffer(got.data) or ():
                name = message.get_type()
                if name not in channels:
                    channels[name] = writer.register_channel(
                        f"/{name}", "json", writer.register_schema(name, "jsonschema", b"{}")
                    )
                data = json.dumps(message.to_dict(), default=str).encode()
                writer.add_message(channels[name], got.received_ns, data, got.received_ns, tick)

    return keep, writer.finish


COLUMNS = (
    *("writer", "datagrams/s", "seconds", "sent", "kept", "kernel drops", "other drops", "unexplained"),
    *(
        "CPU of a core",
        "us a datagram",
        "MB of memory after 2 s",
        "at the end",
        "MB on disk per 10^6",
        "longest stall ms (our CPU in it)",
        "load",
    ),
)


def row(m: Measured, rate: int, seconds: float) -> tuple[str, ...]:
    unexplained = m.sent - m.kept - m.kernel_drops - m.other_drops
    return (
        *(m.name, str(rate), f"{seconds:g}", str(m.sent), str(m.kept), str(m.kernel_drops), str(m.other_drops)),
        *(str(unexplained), f"{100 * m.cpu_share:.0f} %", f"{1e6 * m.cpu_share * seconds / max(1, m.kept):.1f}"),
        *(f"{m.memory_mb[0]:.0f}", f"{m.memory_mb[1]:.0f}", f"{1e6 * m.file_mb / max(1, m.kept):.0f}"),
        *(f"{m.stall_ms[0]:.0f} ({m.stall_ms[1]:.0f})", f"{os.getloadavg()[0]:.1f}"),
    )


def main() -> None:
    full = "--full" in sys.argv
    size = sum(map(len, packets())) / PACKETS
    print(f"\n## Recording ({os.cpu_count()} cores; datagrams of {size:.0f} bytes)\n")
    print(f"| {' | '.join(COLUMNS)} |\n|{'---|' * len(COLUMNS)}")
    for name, open_, rate, seconds in (
        ("ours: raw + protobuf", ours, 20_000, 60 if full else 10),
        ("ours: raw + protobuf", ours, 60_000, 10 if full else 3),
        ("pymavlink, tlog: raw", tlog, 20_000, 10 if full else 5),
        ("mcap package: raw + JSON", mcap_json, 20_000, 10 if full else 5),
    ):
        print(f"| {' | '.join(row(receive(name, rate, seconds, open_), rate, seconds))} |", flush=True)


if __name__ == "__main__":
    if "--send" in sys.argv:
        at = sys.argv.index("--send")
        send(int(sys.argv[at + 1]), int(sys.argv[at + 2]), float(sys.argv[at + 3]))
    else:
        main()
