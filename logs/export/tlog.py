"""Telemetry logs: eight bytes of time [us, Unix, big-endian], then one packet, again and again.

QGroundControl, MAVExplorer, UAV Log Viewer and pymavlink read them. There is no room for a link: what crossed several
is told once, of the vehicle's link, unless links are selected.
"""

import heapq
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from logs.errors import RecordingError
from logs.export import Exported, begun, unfinished
from logs.reader import RecordedMessage, Recording
from logs.secrets import SETUP_SIGNING
from logs.selection import Selection, datagrams, nothing_left
from logs.wire_replay import vehicle_link
from wire.framing import Framer

_HORIZON_NS = 2_000_000_000
"""How far behind the newest log time a message may come and still be put into its place [ns]."""


def to_tlog(recording: Recording, path: Path, wanted: Selection, force: bool = False) -> Exported:
    """Write the packets of the selected datagrams, both directions, in the order of time.

    Without links or raw topics selected: of the vehicle's link, or of all links where no autopilot was heard.

    Raises
    ------
    RecordingError    The file cannot be written, or nothing is selected.
    """
    done = begun(recording, path)
    if not wanted.links and not any(topic.startswith("/mavlink/raw/") for topic in wanted.topics):
        try:
            wanted = replace(wanted, links=(vehicle_link(recording),))
        except RecordingError:
            done.left_out.append("nothing: no autopilot was heard, so the packets of all links are told")
    framers: dict[str, Framer] = {}
    keys = 0
    with unfinished(path, force) as temporary:
        with open(temporary, "wb") as file:
            for message in in_time(datagrams(recording.messages(), wanted)):
                framer = framers.setdefault(message.channel.topic, Framer())
                for packet in framer.packets(message.data):
                    if packet.message_id == SETUP_SIGNING:
                        keys += 1
                        continue
                    file.write((message.log_time_ns // 1000).to_bytes(8, "big") + packet.raw)
                    done.count(message.channel.topic)
        if not done.messages:
            raise nothing_left(recording, wanted, "packet")
    garbage = sum(framer.counters.garbage_bytes for framer in framers.values())
    if garbage:
        done.left_out.append(f"{garbage} bytes that are in no packet")
    if keys:
        done.left_out.append(f"{keys} SETUP_SIGNING: their keys are masked")
    return done


def in_time(messages: Iterable[RecordedMessage]) -> Iterator[RecordedMessage]:
    """In the order of log times, where they are out of it by two seconds at most; equal ones as they come."""
    waiting: list[tuple[int, int, RecordedMessage]] = []
    newest = 0
    for number, message in enumerate(messages):
        heapq.heappush(waiting, (message.log_time_ns, number, message))
        newest = max(newest, message.log_time_ns)
        while waiting and waiting[0][0] < newest - _HORIZON_NS:
            yield heapq.heappop(waiting)[2]
    while waiting:
        yield heapq.heappop(waiting)[2]
