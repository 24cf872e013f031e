"""Telemetry logs as recordings: eight bytes of time [us, big-endian], then one packet, again and again.

A telemetry log does not say who sent what to whom. What came from a system with an autopilot counts as received on the
link `autopilot`, everything else as sent there. Damage is stepped over until a time and a whole packet follow again.
"""

import mmap
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from fastcrc import crc16

from logs.container import Direction
from logs.errors import RecordingError
from logs.export import unfinished
from logs.importing import Imported
from logs.recorder import Recorder
from wire.dialect import mavlink
from wire.framing import SIGNATURE_LENGTH, SIGNED, START_V1, START_V2

LINK = "autopilot"
LOOK = 1_000_000
"""A file without a packet in so many bytes is no telemetry log."""
_STAMP = 8
_EXTRA = {number: bytes((kind.crc_extra,)) for number, kind in mavlink.mavlink_map.items()}

Buffer = bytes | mmap.mmap


@dataclass(slots=True)
class Skipped:
    """Bytes that are in no packet."""

    count: int = 0


def packets(data: Buffer, skipped: Skipped) -> Iterator[tuple[int, bytes]]:
    """Time [us] and bytes of every packet, in the order of the file."""
    position, size = 0, len(data)
    found = False
    while position + _STAMP < size:
        end = _packet_end(data, position + _STAMP, size)
        if end:
            found = True
            yield int.from_bytes(data[position : position + _STAMP], "big"), bytes(data[position + _STAMP : end])
            position = end
            continue
        position += 1
        skipped.count += 1
        if not found and skipped.count >= LOOK:
            return
    skipped.count += size - position


def _packet_end(data: Buffer, start: int, size: int) -> int:
    """Where the packet at `start` ends; 0: there is none."""
    first = data[start]
    if first == START_V2 and start + 12 <= size:
        head, tail = 10, 2 + (SIGNATURE_LENGTH if data[start + 2] & SIGNED else 0)
        number = int.from_bytes(data[start + 7 : start + 10], "little")
    elif first == START_V1 and start + 8 <= size:
        head, tail, number = 6, 2, data[start + 5]
    else:
        return 0
    check = start + head + data[start + 1]
    end = check + tail
    if end > size:
        return 0
    extra = _EXTRA.get(number)
    if extra is None:  # a message nobody here knows: believed where the file goes on as it should
        return end if end == size or (end + _STAMP < size and data[end + _STAMP] in (START_V1, START_V2)) else 0
    right = crc16.mcrf4xx(extra, crc16.mcrf4xx(bytes(data[start + 1 : check])))
    return end if right == int.from_bytes(data[check : check + 2], "little") else 0


def import_tlog(source: Path, target: Path, force: bool = False) -> Imported:
    """Make a recording of a telemetry log.

    Raises
    ------
    RecordingError    It is none, or `target` cannot be written.
    """
    done = Imported(target)
    try:
        with open(source, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            skipped = Skipped()
            systems = _vehicles(data, skipped)
            if systems is None:
                raise RecordingError(source, "no packet behind a time is in it: no telemetry log")
            if skipped.count:
                done.told.append(f"{skipped.count} bytes are in no packet")
            if not systems:
                done.told.append("no autopilot is heard in it: everything counts as received")
            about = {"of": source.name, "format": "tlog", "skipped_bytes": str(skipped.count)}
            with (
                unfinished(target, force) as temporary,
                Recorder(temporary, metadata={"import": about}, threaded=False) as recorder,
            ):
                for tick, (stamp_us, packet) in enumerate(packets(data, Skipped())):
                    system = packet[5] if packet[0] == START_V2 else packet[3]
                    direction: Direction = "rx" if not systems or system in systems else "tx"
                    # One tick a packet: what the file holds twice, it holds twice here.
                    recorder.datagram(
                        LINK,
                        direction,
                        packet,
                        log_time_ns=stamp_us * 1000 & _MOST,
                        now_us=stamp_us & _MOST_US,
                        tick=tick,
                    )
                    done.messages += 1
    except ValueError as error:  # of mmap: an empty file
        raise RecordingError(source, "the file is empty") from error
    except OSError as error:
        raise RecordingError(source, f"cannot be read: {error.strerror or error}") from error
    return done


_MOST = (1 << 63) - 1
_MOST_US = _MOST // 1000
"""No time is beyond what a recording holds, whatever a damaged file says."""


def _vehicles(data: Buffer, skipped: Skipped) -> frozenset[int] | None:
    """The systems with an autopilot; None: there is no packet at all."""
    decoder = mavlink.MAVLink(None)
    found: set[int] = set()
    some = False
    for _, packet in packets(data, skipped):
        some = True
        v2 = packet[0] == START_V2
        number = int.from_bytes(packet[7:10], "little") if v2 else packet[5]
        if number != mavlink.MAVLINK_MSG_ID_HEARTBEAT:
            continue
        heartbeat = decoder.decode(bytearray(packet))
        if heartbeat.autopilot != mavlink.MAV_AUTOPILOT_INVALID and heartbeat.type != mavlink.MAV_TYPE_GCS:
            found.add(packet[5] if v2 else packet[3])
    return frozenset(found) if some else None
