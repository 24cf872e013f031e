"""Traffic for the tests of `logs`: real packets with their times, and a flight's worth of seam."""

from collections.abc import Iterator
from pathlib import Path

from logs import schema
from logs.recorder import Recorder
from wire.dialect import mavlink

TLOG = Path(__file__).parents[1] / "data" / "px4-offboard-65s-71s.tlog"
PEER = ("127.0.0.1", 14580)
TICK_US = 20_000


def captured() -> Iterator[tuple[int, bytes]]:
    """(time [us] from the first packet, packet) of the captured flight."""
    data = TLOG.read_bytes()
    position, start = 0, int.from_bytes(data[:8], "big")
    while position < len(data):
        stamp = int.from_bytes(data[position : position + 8], "big")
        end = position + 8 + data[position + 9] + 12
        yield stamp - start, data[position + 8 : end]
        position = end


def sent_by_ground(packet: bytes) -> bool:
    return packet[5] == 255


def record_captured(recorder: Recorder) -> tuple[int, int]:
    """Record the captured flight, tick by tick as a driver does; returns (rx, tx)."""
    rx = tx = 0
    rows: dict[int, tuple[list[tuple[int, bytes]], list[bytes]]] = {}
    for time_us, packet in captured():
        inputs, outputs = rows.setdefault(time_us // TICK_US, ([], []))
        if sent_by_ground(packet):
            outputs.append(packet)
        else:
            inputs.append((time_us, packet))
    for tick in range(max(rows) + 1):
        received, sent = rows.get(tick, ([], []))
        now_us = (tick + 1) * TICK_US
        for time_us, packet in received:
            recorder.datagram(
                "autopilot", "rx", packet, log_time_ns=time_us * 1000, now_us=now_us, tick=tick, peer=PEER
            )
            rx += 1
        record(recorder, schema.Tick(now_us, len(received), len(sent)), now_us, tick)
        for packet in sent:
            recorder.datagram("autopilot", "tx", packet, log_time_ns=now_us * 1000, now_us=now_us, tick=tick, peer=PEER)
            tx += 1
    return rx, tx


def record(recorder: Recorder, item: schema.Record, now_us: int, tick: int) -> None:
    recorder.message(schema.TOPICS[type(item)], item, log_time_ns=now_us * 1000, now_us=now_us, tick=tick)


def heartbeat(system: int = 1, component: int = 1, autopilot: int = 12, sequence: int = 0) -> bytes:
    mav = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
    mav.seq = sequence
    return bytes(mavlink.MAVLink_heartbeat_message(2, autopilot, 0x1D, 0, 3, 3).pack(mav))


def setpoint(north: float, sequence: int = 0) -> bytes:
    mav = mavlink.MAVLink(None, srcSystem=1, srcComponent=191)
    mav.seq = sequence
    message = mavlink.MAVLink_set_position_target_local_ned_message(
        100, 1, 1, 1, 0, north, 2.0, -3.0, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0, 0.5, 0.0
    )
    return bytes(message.pack(mav))
