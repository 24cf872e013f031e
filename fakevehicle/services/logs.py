"""The log service: LOG_REQUEST_LIST, LOG_REQUEST_DATA, LOG_REQUEST_END, over the recordings the driver keeps.

Logs are numbered from 0 in the order of their names, as PX4 numbers them. MAVSDK asks for 46 080 bytes at once and
waits for all of them in packets of 90 bytes at offsets that are multiples of 90; what got lost it asks for again. An
empty list is one LOG_ENTRY with num_logs 0, a request beyond the end one LOG_DATA with count 0, so that nobody waits.
Nothing can be erased; LOG_ERASE has no answer of its own, so the refusal is said in words.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

from fakevehicle.codec import Message
from fakevehicle.files import Entry, Files
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import Handler, Service
from fakevehicle.services.words import ALONE_US, Words
from wire.dialect import mavlink

CHUNK = 90
"""Bytes in one LOG_DATA."""
PACKETS_PER_TICK = 12
"""Of all downloads together: 3000 packets and 270 kB a second."""
ENTRIES_PER_TICK = 8
MAX_DOWNLOADS = 8
"""At once, one a client; the oldest gives way."""


@dataclass(slots=True)
class _Download:
    name: str
    number: int
    offset: int
    end: int


@dataclass(slots=True)
class _Listing:
    entries: list[tuple[int, Entry]]
    total: int


class Logs(Service):
    """Answers the LOG messages.

    Parameters
    ----------
    files : the recordings, all in the root of their tree.
    outbox : where answers go.
    refuse : puts a refusal into words.
    """

    def __init__(self, files: Files, outbox: Outbox, refuse: Words) -> None:
        self._files = files
        self._outbox = outbox
        self._refuse = refuse
        self._downloads: dict[Sender, _Download] = {}
        self._listings: dict[Sender, _Listing] = {}

    def routes(self) -> Mapping[int, Handler]:
        """By message id."""
        m = mavlink
        return {
            m.MAVLINK_MSG_ID_LOG_REQUEST_LIST: self.request_list,
            m.MAVLINK_MSG_ID_LOG_REQUEST_DATA: self.request_data,
            m.MAVLINK_MSG_ID_LOG_REQUEST_END: self.request_end,
            m.MAVLINK_MSG_ID_LOG_ERASE: self.erase,
        }

    def request_list(self, sender: Sender, message: Message, _now_us: int) -> None:
        """Tell the logs numbered `start` to `end`, or that there are none."""
        logs = self._logs()
        wanted = [(i, entry) for i, entry in enumerate(logs) if message.start <= i <= message.end]
        if not wanted:
            self._outbox.answer(sender, mavlink.MAVLink_log_entry_message(0, len(logs), max(0, len(logs) - 1), 0, 0))
            return
        _put(self._listings, sender, _Listing(wanted, len(logs)))

    def request_data(self, sender: Sender, message: Message, _now_us: int) -> None:
        """Send `count` bytes from `ofs` on; a client's new request ends its old one."""
        logs = self._logs()
        self._downloads.pop(sender, None)
        if message.id >= len(logs):
            self._refuse(sender, f"Log refused: there is no log {message.id}")
            self._nothing(sender, message.id, message.ofs)
            return
        log = logs[message.id]
        end = min(message.ofs + message.count, log.size)
        if message.ofs >= end:
            self._nothing(sender, message.id, message.ofs)
            return
        _put(self._downloads, sender, _Download(log.name, message.id, message.ofs, end))

    def request_end(self, sender: Sender, _message: Message, _now_us: int) -> None:
        """Stop sending."""
        self._downloads.pop(sender, None)
        self._listings.pop(sender, None)

    def erase(self, sender: Sender, _message: Message, _now_us: int) -> None:
        """Never."""
        self._refuse(sender, "Erasing logs refused: they can only be read", ALONE_US)

    def step(self, now_us: int) -> None:
        """Send the next entries and data, every client in its turn."""
        if not (self._listings or self._downloads):
            return
        for sender, listing in list(self._listings.items()):
            for number, entry in listing.entries[:ENTRIES_PER_TICK]:
                self._outbox.answer(
                    sender,
                    mavlink.MAVLink_log_entry_message(
                        number, listing.total, listing.total - 1, entry.time_unix_s, min(entry.size, 0xFFFFFFFF)
                    ),
                )
            del listing.entries[:ENTRIES_PER_TICK]
            if not listing.entries:
                del self._listings[sender]
        budget = PACKETS_PER_TICK
        while self._downloads and budget > 0:
            for sender, download in list(self._downloads.items())[:budget]:
                budget -= 1
                self._send(sender, download)

    def _send(self, sender: Sender, download: _Download) -> None:
        """One packet; the last one ends the download."""
        data = self._files.read(download.name, download.offset, min(CHUNK, download.end - download.offset))
        if not data:
            del self._downloads[sender]
            self._nothing(sender, download.number, download.offset)
            return
        self._outbox.answer(
            sender,
            mavlink.MAVLink_log_data_message(download.number, download.offset, len(data), data.ljust(CHUNK, b"\0")),
        )
        download.offset += len(data)
        if download.offset >= download.end:
            del self._downloads[sender]

    def _nothing(self, sender: Sender, number: int, offset: int) -> None:
        """The end of whatever was asked for."""
        self._outbox.answer(sender, mavlink.MAVLink_log_data_message(number, offset, 0, bytes(CHUNK)))

    def _logs(self) -> list[Entry]:
        """Every log, by name; at most as many as LOG_ENTRY can number."""
        entries = self._files.listing("") or []
        return [entry for entry in entries if not entry.is_dir][:0xFFFF]


Work = TypeVar("Work", _Download, _Listing)


def _put(table: dict[Sender, Work], sender: Sender, work: Work) -> None:
    """Set one client's work; the oldest client's makes room."""
    table.pop(sender, None)
    while len(table) >= MAX_DOWNLOADS:
        del table[next(iter(table))]
    table[sender] = work
