"""MAVLink FTP, for reading only: list, open, read, burst, checksum, terminate, reset.

The payload of FILE_TRANSFER_PROTOCOL, little-endian (https://mavlink.io/en/services/ftp.html):

    uint16 sequence, uint8 session, opcode, size, request's opcode, burst complete, padding, uint32 offset, data[239]

Every request has one answer, its sequence one higher, its session and offset as asked; a burst has many, each one
higher again. What decides where servers differ:

- A session's number is the one the client asks for. MAVSDK and MAVProxy go on with their own number whatever the answer
  says (PX4 allots one, ArduPilot does as we do); opening a number that is open opens it anew. Sessions belong to who
  opened them, by link, address and MAVLink identity: two clients may both use number 0.
- A request that comes again soon with all its bytes, since the answer was lost, gets that answer again.
- A burst ends after `BURST_PACKETS`, or with the file, with "burst complete"; a client asks for the next one. It runs
  at `PACKETS_PER_TICK`, so that a socket's receive buffer holds it.
- A file is what it was when it was opened, though a log may grow under it.

Refused requests are put into words (STATUSTEXT) besides their NAK; the end of a file or list is no refusal.
"""

import struct
import zlib
from collections.abc import Mapping
from dataclasses import dataclass

from fakevehicle.codec import Message
from fakevehicle.files import MAX_READ, Entry, OpenFile, Tree
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import Handler, Service
from fakevehicle.services.words import Words
from wire.dialect import mavlink

HEADER = struct.Struct("<HBBBBBBI")
MAX_DATA = 239
PAYLOAD = HEADER.size + MAX_DATA
MAX_SESSIONS = 32
IDLE_US = 10_000_000
"""A session that nobody has used for this long makes room when all are taken."""
MAX_REMEMBERED = 64
"""Answers kept for requests that come again, one a client and session."""
REPEAT_US = 3_000_000
"""A request that comes again within this time is the same one; later, a client has begun anew."""
BURST_PACKETS = 256
PACKETS_PER_TICK = 8
"""Of all bursts together: 2000 packets and 478 kB a second."""
MAX_CHECKSUM = 64 * 1024 * 1024
"""A larger file's checksum is refused: it would hold up the flight."""

ACK, NAK = 128, 129
TERMINATE, RESET, LIST, OPEN, READ, CRC32, BURST, LIST_TIMES = 1, 2, 3, 4, 5, 14, 15, 16
_WRITES = {
    6: "create",
    7: "write",
    8: "remove",
    9: "create folder",
    10: "remove folder",
    11: "write",
    12: "cut",
    13: "rename",
}

FAIL, INVALID_SIZE, INVALID_SESSION, NO_SESSIONS, END_OF_FILE, UNKNOWN, PROTECTED, NOT_FOUND = 1, 3, 4, 5, 6, 7, 9, 10


@dataclass(frozen=True, slots=True)
class Request:
    """One request's fields; `data` is as long as its size says."""

    sequence: int
    session: int
    opcode: int
    offset: int
    size: int
    data: bytes

    @property
    def path(self) -> str:
        """The data as a path, ended by the first NUL."""
        return self.data.split(b"\0", 1)[0].decode("utf-8", "replace")


@dataclass(slots=True)
class Session:
    """One open file of one client, and the burst that runs on it (None: none does)."""

    file: OpenFile
    path: str
    used_us: int
    burst: "Burst | None" = None


@dataclass(slots=True)
class Burst:
    """What is left of a burst: the next packet's sequence and offset, bytes a packet, packets."""

    sequence: int
    offset: int
    size: int
    left: int


Key = tuple[Sender, int]
Refusal = tuple[int, str]
"""Error code, and the reason in words; empty for what is no refusal."""


class Ftp(Service):
    """Answers FILE_TRANSFER_PROTOCOL.

    Parameters
    ----------
    tree : the files.
    outbox : where answers go.
    refuse : puts a refusal into words.
    """

    def __init__(self, tree: Tree, outbox: Outbox, refuse: Words) -> None:
        self._tree = tree
        self._outbox = outbox
        self._refuse = refuse
        self._sessions: dict[Key, Session] = {}
        self._answered: dict[Key, tuple[bytes, bytes, int]] = {}  # the last request, its answer, and when

    @property
    def open_sessions(self) -> int:
        """How many files are open."""
        return len(self._sessions)

    def routes(self) -> Mapping[int, Handler]:
        """By message id."""
        return {mavlink.MAVLINK_MSG_ID_FILE_TRANSFER_PROTOCOL: self.request}

    def request(self, sender: Sender, message: Message, now_us: int) -> None:
        """Answer one request; answers that somebody sends us are ignored."""
        raw = bytes(message.payload)
        sequence, session, opcode, size, _, _, _, offset = HEADER.unpack_from(raw)
        if opcode in (ACK, NAK):
            return
        self._asking = sender
        key = sender, session
        known = self._answered.get(key)
        if known is not None and known[0] == raw and now_us - known[2] < REPEAT_US:
            self._send(sender, known[1])
            return
        asked = Request(sequence, session, opcode, offset, size, raw[HEADER.size : HEADER.size + size])
        held = self._sessions.get(key)
        if held is not None:
            held.used_us = now_us
        if size > MAX_DATA:
            answer: bytes | None = self._refusal(asked, (INVALID_SIZE, f"size {size}, expected at most {MAX_DATA}"))
        else:
            answer = self._answer(key, asked, now_us)
        if answer is not None:
            self._answered.pop(key, None)
            while len(self._answered) >= MAX_REMEMBERED:
                del self._answered[next(iter(self._answered))]  # the oldest
            self._answered[key] = raw, answer, now_us
            self._send(sender, answer)

    def step(self, now_us: int) -> None:
        """Send the next packets of the bursts, in turns."""
        if not self._sessions:
            return
        running = [(key, held) for key, held in self._sessions.items() if held.burst is not None]
        budget = PACKETS_PER_TICK
        while running and budget > 0:
            for key, held in running:
                if budget == 0:
                    break
                budget -= 1
                held.used_us = now_us
                self._burst_packet(key, held)
            running = [(key, held) for key, held in running if held.burst is not None]

    def _answer(self, key: Key, asked: Request, now_us: int) -> bytes | None:
        """What to answer; None: a burst answers by itself."""
        if asked.opcode in (LIST, LIST_TIMES):
            return self._list(asked)
        if asked.opcode == OPEN:
            return self._open(key, asked, now_us)
        if asked.opcode == CRC32:
            return self._checksum(asked)
        if asked.opcode == RESET:
            for mine in [other for other in self._sessions if other[0] == key[0]]:
                del self._sessions[mine]
            return _answer(asked, ACK)
        if asked.opcode in (READ, BURST, TERMINATE):
            held = self._sessions.get(key)
            if held is None:
                # Clients end a session after every listing, though it has none: nothing to complain about.
                reason = "" if asked.opcode == TERMINATE else f"no file is open as {asked.session}"
                return self._refusal(asked, (INVALID_SESSION, reason))
            if asked.opcode == READ:
                return self._read(held, asked)
            if asked.opcode == BURST:
                held.burst = Burst(asked.sequence + 1, asked.offset, asked.size or MAX_DATA, BURST_PACKETS)
                return None
            del self._sessions[key]
            return _answer(asked, ACK)
        if asked.opcode in _WRITES:
            return self._refusal(asked, (PROTECTED, f"cannot {_WRITES[asked.opcode]}, files can only be read"))
        return self._refusal(asked, (UNKNOWN, f"no operation {asked.opcode}"))

    def _list(self, asked: Request) -> bytes:
        """As many entries from number `offset` on as fit."""
        entries = self._tree.listing(asked.path)
        if entries is None:
            return self._refusal(asked, (NOT_FOUND, f"no folder {asked.path}"))
        out = b""
        for entry in entries[asked.offset :]:
            text = _line(entry, with_time=asked.opcode == LIST_TIMES)
            if len(out) + len(text) > MAX_DATA:
                break
            out += text
        return _answer(asked, ACK, out) if out else _answer(asked, NAK, bytes((END_OF_FILE,)))

    def _open(self, key: Key, asked: Request, now_us: int) -> bytes:
        self._sessions.pop(key, None)
        file = self._tree.open(asked.path)
        if file is None:
            return self._refusal(asked, (NOT_FOUND, f"no file {asked.path}"))
        if len(self._sessions) >= MAX_SESSIONS:
            idlest = min(self._sessions, key=lambda other: self._sessions[other].used_us)
            if now_us - self._sessions[idlest].used_us < IDLE_US:
                return self._refusal(asked, (NO_SESSIONS, f"{MAX_SESSIONS} files are open"))
            del self._sessions[idlest]
        self._sessions[key] = Session(file, asked.path, now_us)
        return _answer(asked, ACK, struct.pack("<I", min(file.size, 0xFFFFFFFF)))

    def _read(self, held: Session, asked: Request) -> bytes:
        data = held.file.read(asked.offset, asked.size or MAX_DATA)
        if data is None:
            return self._refusal(asked, (FAIL, f"{held.path} has gone"))
        return _answer(asked, ACK, data) if data else _answer(asked, NAK, bytes((END_OF_FILE,)))

    def _burst_packet(self, key: Key, held: Session) -> None:
        burst = held.burst
        if burst is None:
            return
        sender, session = key
        data = held.file.read(burst.offset, burst.size)
        asked = Request((burst.sequence - 1) & 0xFFFF, session, BURST, burst.offset, burst.size, b"")
        if not data:
            held.burst = None
            refusal = (END_OF_FILE, "") if data is not None else (FAIL, f"{held.path} has gone")
            self._send(sender, self._refusal(asked, refusal))
            return
        burst.sequence += 1
        burst.offset += len(data)
        burst.left -= 1
        done = burst.left == 0 or burst.offset >= held.file.size
        if done:
            held.burst = None
        self._send(sender, _answer(asked, ACK, data, burst_complete=done))

    def _checksum(self, asked: Request) -> bytes:
        """CRC-32 without inversion at either end, as PX4's and ArduPilot's."""
        file = self._tree.open(asked.path)
        if file is None:
            return self._refusal(asked, (NOT_FOUND, f"no file {asked.path}"))
        if file.size > MAX_CHECKSUM:
            return self._refusal(asked, (FAIL, f"{asked.path} is too large for a checksum"))
        return _answer(asked, ACK, struct.pack("<I", checksum(file)))

    def _refusal(self, asked: Request, refusal: Refusal) -> bytes:
        code, reason = refusal
        if reason:
            self._refuse(self._asking, f"File refused: {reason}")
        return _answer(asked, NAK, bytes((code,)))

    def _send(self, sender: Sender, answer: bytes) -> None:
        self._outbox.answer(
            sender, mavlink.MAVLink_file_transfer_protocol_message(0, sender.system_id, sender.component_id, answer)
        )


def checksum(file: OpenFile) -> int:
    """CRC-32 (polynomial 0xEDB88320) of a file, started at zero and not inverted at the end."""
    crc = 0xFFFFFFFF
    offset = 0
    while offset < file.size:
        data = file.read(offset, MAX_READ)
        if not data:
            break
        crc = zlib.crc32(data, crc)
        offset += len(data)
    return crc ^ 0xFFFFFFFF


def _answer(asked: Request, opcode: int, data: bytes = b"", *, burst_complete: bool = False) -> bytes:
    """An answer's payload, 251 bytes."""
    header = HEADER.pack(
        (asked.sequence + 1) & 0xFFFF,
        asked.session,
        opcode,
        len(data),
        asked.opcode,
        burst_complete,
        0,
        asked.offset,
    )
    return (header + data).ljust(PAYLOAD, b"\0")


def _line(entry: Entry, *, with_time: bool) -> bytes:
    """One entry of a listing; a name that does not fit is skipped, but counted as the client counts.

    With its time, a folder has the same three fields as a file (ListDirectoryWithTime, in the guide since 2026).
    """
    kind, name = b"D" if entry.is_dir else b"F", entry.name.encode("utf-8", "replace")
    if with_time:
        text = kind + name + b"\t%d\t%d\0" % (entry.size, entry.time_unix_s)
    else:
        text = kind + name + (b"\0" if entry.is_dir else b"\t%d\0" % entry.size)
    return text if len(text) <= MAX_DATA else b"S\0"
