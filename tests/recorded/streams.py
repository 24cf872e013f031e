"""Recorded telemetry of real autopilots, and a flight's view of it: what the companion would know at each second.

Run as a program it extracts what this needs from a whole recording:

    python tests/recorded/streams.py whole.tlog short.tlog.gz
"""

import gzip
import sys
from collections.abc import Iterator
from pathlib import Path

from companion.autopilots import AUTOPILOTS
from companion.autopilots.base import Autopilot
from companion.telemetry import Telemetry
from companion.vehiclelink import VEHICLE_LINK, VehicleLink
from wire.datagram import Datagram

DATA = Path(__file__).parents[1] / "data"
KEPT = (0, 1, 33, 49, 77, 193, 230, 242, 245, 253, 436)
THINNED_US = {30: 400_000, 32: 400_000}
"""Attitude and position come often: one in this time is enough, and younger than what counts as fresh."""
CLIENTS = (22, 76)


def packets(path: Path) -> Iterator[tuple[int, bytes]]:
    """(time [us], packet) of a tlog, gzipped or not: 8 bytes of time before each packet."""
    raw = gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()
    at = 0
    while at < len(raw):
        length, overhead = raw[at + 9], 12 + 13 * (raw[at + 10] & 1) if raw[at + 8] == 0xFD else 8
        end = at + 8 + overhead + length
        yield int.from_bytes(raw[at : at + 8], "big"), raw[at + 8 : end]
        at = end


def message_id(packet: bytes) -> int:
    return int.from_bytes(packet[7:10], "little") if packet[0] == 0xFD else packet[5]


def system_id(packet: bytes) -> int:
    return packet[5] if packet[0] == 0xFD else packet[3]


class Listener:
    """The companion's ears at a recording: the same link, telemetry and autopilot modules, a clock that is the file's.

    Attributes
    ----------
    now_us : since the file's first packet.
    acks : (time [s], command, result).
    """

    def __init__(self, name: str, number: int) -> None:
        self.telemetry, self.link = Telemetry(), VehicleLink(1, False)
        self.autopilot: Autopilot = AUTOPILOTS[number]
        self.now_us = 0
        self.acks: list[tuple[float, int, int]] = []
        self.texts: list[tuple[float, str]] = []
        self._packets = packets(DATA / name)
        self._first_us: int | None = None
        self._next: tuple[int, bytes] | None = None

    def until(self, second: float) -> "Listener":
        """Hear everything up to this second."""
        while True:
            if self._next is None:
                self._next = next(self._packets, None)
            if self._next is None:
                break
            time_us, packet = self._next
            self._first_us = time_us if self._first_us is None else self._first_us
            if time_us - self._first_us > second * 1e6:
                break
            self._next = None
            self._hear(time_us - self._first_us, packet)
        self.now_us = round(second * 1e6)
        return self

    def _hear(self, now_us: int, data: bytes) -> None:
        for packet, obeyed in self.link.packets(now_us, Datagram(VEHICLE_LINK, data, ("vehicle", 1))):
            if obeyed:
                self.telemetry.take(now_us, packet, self.link.decoder)
        t = self.telemetry
        self.acks += [(now_us / 1e6, a.command, a.result) for a in t.acks]
        self.texts += [(now_us / 1e6, text) for _, text in t.texts]
        t.acks.clear()
        t.texts.clear()

    @property
    def not_ready(self) -> list[str]:
        return self.autopilot.not_ready(self.now_us, self.telemetry)

    @property
    def in_control(self) -> bool:
        return self.autopilot.in_control(self.telemetry)


def extract(whole: Path, short: Path) -> None:
    """What the vehicle told that the companion reads, and what the client commanded."""
    kept, last_us, first_us = bytearray(), dict.fromkeys(THINNED_US, -(10**9)), None
    for time_us, packet in packets(whole):
        kind, ours = message_id(packet), system_id(packet) == 1
        keep = (ours and kind in KEPT) or (not ours and kind in CLIENTS) or first_us is None
        first_us = time_us if first_us is None else first_us
        if ours and kind in THINNED_US and time_us - last_us[kind] >= THINNED_US[kind]:
            keep, last_us[kind] = True, time_us
        if keep:
            kept += time_us.to_bytes(8, "big") + packet
    short.write_bytes(gzip.compress(bytes(kept), 9, mtime=0))


if __name__ == "__main__":
    extract(Path(sys.argv[1]), Path(sys.argv[2]))
