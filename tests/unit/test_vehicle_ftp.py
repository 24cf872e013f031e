"""MAVLink FTP and the log service, byte by byte: what a client may count on."""

import struct
import zlib
from typing import Any

import pytest

from fakevehicle.config import VehicleConfig
from fakevehicle.files import Entry, Files, MemoryFiles, Tree
from fakevehicle.services import ftp, logs
from fakevehicle.services.ftp import Ftp
from fakevehicle.services.logs import Logs
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.words import Words
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

ACK, NAK = 128, 129
TERMINATE, RESET, LIST, OPEN, READ, CREATE, CRC32, BURST = 1, 2, 3, 4, 5, 6, 14, 15
FAIL, INVALID_SESSION, NO_SESSIONS, END_OF_FILE, UNKNOWN, PROTECTED, NOT_FOUND = 1, 4, 5, 6, 7, 9, 10
ME, OTHER = Sender("gcs", ("127.0.0.1", 5), 255, 190), Sender("gcs", ("127.0.0.1", 6), 255, 190)
LOG = bytes(i * 7 % 251 for i in range(1000))


class Client:
    """Speaks FTP in bytes of its own making."""

    def __init__(self, tree: Tree | None = None) -> None:
        self.outbox = Outbox(1, ["gcs"])
        self.said: list[str] = []
        self.now_us = 0
        self.log = MemoryFiles({"flight.mcap": LOG, "empty": b""})
        tree = tree or Tree({"@PARAM/param.pck": lambda query: b"packed " + query.encode()}, {"log": self.log})
        self.ftp = Ftp(tree, self.outbox, Words(self.said.append, lambda: self.now_us))
        self.sequence = 0

    def send(self, opcode: int, data: bytes = b"", **fields: int) -> bytes:
        """Send one request; what was sent, to be sent again."""
        self.sequence = fields.get("sequence", self.sequence + 1)
        raw = struct.pack(
            "<HBBBBBBI",
            self.sequence & 0xFFFF,
            fields.get("session", 0),
            opcode,
            fields.get("size", len(data)),
            0,
            0,
            0,
            fields.get("offset", 0),
        )
        payload = (raw + data).ljust(251, b"\0")
        self.again(payload)
        return payload

    def again(self, payload: bytes, sender: Sender = ME) -> None:
        self.ftp.request(sender, mavlink.MAVLink_file_transfer_protocol_message(0, 1, 1, payload), self.now_us)

    def answers(self) -> list[tuple[int, int, int, int, int, int, bytes]]:
        """(sequence, session, opcode, request's opcode, burst complete, offset, data) of everything since."""
        found = []
        for datagram in self.outbox.take():
            payload = mavlink.MAVLink(None).decode(bytearray(datagram.data)).payload
            head = struct.unpack_from("<HBBBBBBI", bytes(payload))
            sequence, session, opcode, size, asked, complete, _, offset = head
            found.append((sequence, session, opcode, asked, complete, offset, bytes(payload[12 : 12 + size])))
        return found

    def ask(self, opcode: int, data: bytes = b"", **fields: int) -> tuple[int, bytes]:
        """Send, and the one answer's (opcode, data)."""
        self.send(opcode, data, **fields)
        ((sequence, session, answer, asked, _, offset, content),) = self.answers()
        assert sequence == (self.sequence + 1) & 0xFFFF
        assert (session, asked, offset) == (fields.get("session", 0), opcode, fields.get("offset", 0))
        return answer, content


@pytest.fixture
def client() -> Client:
    return Client()


def nak(code: int) -> tuple[int, bytes]:
    return NAK, bytes((code,))


def test_an_answer_is_251_bytes_laid_out_as_the_guide_says() -> None:
    client = Client(Tree({"f": lambda _query: b"abc"}))
    client.send(OPEN, b"f", sequence=0x1234, session=7)
    (datagram,) = client.outbox.take()
    # Worked by hand from the message and the payload's table: target 0, 255, 190; then sequence 0x1235, session 7,
    # ACK 128, size 4, request's opcode 4, burst 0, padding 0, offset 0, and the file's size 3. MAVLink 2 cuts zeros.
    assert datagram.data[10:-2] == bytes.fromhex("00 ff be 3512 07 80 04 04 00 00 00000000 03")
    assert datagram.peer == ME.peer


def test_a_folder_is_listed_from_any_entry_on_until_the_end(client: Client) -> None:
    assert client.ask(LIST, b"/") == (ACK, b"D@PARAM\0Dlog\0")
    assert client.ask(LIST, b"/", offset=1) == (ACK, b"Dlog\0")
    assert client.ask(LIST, b"/", offset=2) == nak(END_OF_FILE)
    assert client.ask(LIST, b"/log") == (ACK, b"Fempty\t0\0Fflight.mcap\t1000\0")
    assert client.ask(LIST, b"@PARAM\0") == (ACK, b"Fparam.pck\t7\0")
    assert client.said == []
    assert client.ask(LIST, b"/nope") == nak(NOT_FOUND)
    assert client.ask(LIST, b"/log/../../etc") == nak(NOT_FOUND)
    assert client.said == ["File refused: no folder /nope", "File refused: no folder /log/../../etc"]


def test_a_folder_is_listed_with_times_to_who_asks_for_them() -> None:
    client = Client(Tree({"made": lambda _query: b"123"}, {"log": Dated({"a": b"12"})}))
    assert client.ask(16, b"/") == (ACK, b"Dlog\t0\t0\0Fmade\t3\t0\0")
    assert client.ask(16, b"log") == (ACK, b"Fa\t2\t1700000000\0")
    assert client.ask(16, b"log", offset=1) == nak(END_OF_FILE)


def test_ending_what_is_not_open_is_refused_without_words(client: Client) -> None:
    assert client.ask(TERMINATE, session=4) == nak(INVALID_SESSION)
    assert client.said == []
    assert client.ask(READ, session=4) == nak(INVALID_SESSION)
    assert client.said == ["File refused: no file is open as 4"]


def test_a_long_folder_comes_in_pieces_that_never_cut_a_name() -> None:
    names = [f"a_rather_long_name_of_a_recording_{i:03d}.mcap" for i in range(40)]
    client = Client(Tree(mounts={"log": MemoryFiles({name: b"" for name in names} | {"z" * 300: b""})}))
    heard: list[bytes] = []
    while True:
        opcode, data = client.ask(LIST, b"log", offset=len(heard))
        if opcode == NAK:
            break
        assert len(data) <= 239
        heard += data.removesuffix(b"\0").split(b"\0")
    assert heard == [f"F{name}\t0".encode() for name in names] + [b"S"]  # a name of 300 is counted, not told


def test_a_file_is_read_from_any_place_and_ends_with_end_of_file(client: Client) -> None:
    assert client.ask(OPEN, b"/log/flight.mcap\0") == (ACK, struct.pack("<I", 1000))
    assert client.ask(READ, size=239) == (ACK, LOG[:239])
    assert client.ask(READ, size=80, offset=500) == (ACK, LOG[500:580])
    assert client.ask(READ, size=239, offset=900) == (ACK, LOG[900:])
    assert client.ask(READ, size=239, offset=1000) == nak(END_OF_FILE)
    assert client.ask(READ, size=239, offset=2**32 - 1) == nak(END_OF_FILE)
    assert client.ask(TERMINATE) == (ACK, b"")
    assert client.ask(READ, size=1) == nak(INVALID_SESSION)


def test_an_answer_that_was_lost_is_given_again(client: Client) -> None:
    opened = client.send(OPEN, b"log/flight.mcap", session=3)
    first = client.answers()
    client.again(opened)
    assert client.answers() == first
    ended = client.send(TERMINATE, session=3)
    first = client.answers()
    client.again(ended)
    assert client.answers() == first  # and not "invalid session"
    client.send(TERMINATE, session=3)
    assert client.answers()[0][6] == bytes((INVALID_SESSION,))


def test_a_burst_sends_everything_with_sequences_and_offsets_that_advance(client: Client) -> None:
    client.ask(OPEN, b"log/flight.mcap")
    client.send(BURST, size=100, sequence=0xFFFE)
    assert client.answers() == []
    client.ftp.step(0)
    heard = client.answers()
    assert len(heard) == ftp.PACKETS_PER_TICK
    client.ftp.step(4000)
    heard += client.answers()
    assert [h[0] for h in heard] == [(0xFFFF + i) & 0xFFFF for i in range(10)]
    assert [h[5] for h in heard] == [100 * i for i in range(10)]
    assert b"".join(h[6] for h in heard) == LOG
    assert [h[4] for h in heard] == [0] * 9 + [1]
    client.ftp.step(8000)
    assert client.answers() == []
    client.send(BURST, size=100, offset=1000)
    client.ftp.step(8000)
    assert [(h[2], h[6]) for h in client.answers()] == [nak(END_OF_FILE)]


def test_a_long_burst_stops_and_waits_to_be_asked_on() -> None:
    data = bytes(ftp.BURST_PACKETS * 239 + 5)
    client = Client(Tree({"f": lambda _query: data}))
    client.ask(OPEN, b"f")
    client.send(BURST)
    heard = []
    for tick in range(40):
        client.ftp.step(tick)
        heard += client.answers()
    assert (len(heard), heard[-1][4], heard[-1][5] + 239) == (ftp.BURST_PACKETS, 1, len(data) - 5)


def test_bursts_share_the_ticks_and_end_with_their_session(client: Client) -> None:
    for session in (1, 2):
        client.ask(OPEN, b"log/flight.mcap", session=session)
        client.send(BURST, session=session, size=50)
    client.ftp.step(0)
    assert sorted(h[1] for h in client.answers()) == [1] * 4 + [2] * 4
    assert client.ask(TERMINATE, session=1) == (ACK, b"")
    client.ftp.step(0)
    assert {h[1] for h in client.answers()} == {2}


def test_two_clients_may_use_one_number_and_a_reset_is_of_ones_own_files_only(client: Client) -> None:
    client.ask(OPEN, b"log/flight.mcap")
    client.again(struct.pack("<HBBBBBBI", 1, 0, OPEN, 9, 0, 0, 0, 0) + b"log/empty", OTHER)
    client.answers()
    assert client.ftp.open_sessions == 2
    assert client.ask(RESET) == (ACK, b"")
    assert client.ftp.open_sessions == 1
    assert client.ask(READ, size=9) == nak(INVALID_SESSION)


def test_opening_a_number_that_is_open_opens_it_anew(client: Client) -> None:
    client.ask(OPEN, b"log/empty")
    assert client.ask(OPEN, b"log/flight.mcap") == (ACK, struct.pack("<I", 1000))
    assert client.ask(READ, size=3) == (ACK, LOG[:3])


def test_sessions_are_bounded_and_idle_ones_make_room(client: Client) -> None:
    for session in range(ftp.MAX_SESSIONS):
        assert client.ask(OPEN, b"log/empty", session=session)[0] == ACK
    assert client.ask(OPEN, b"log/empty", session=99) == nak(NO_SESSIONS)
    client.now_us = ftp.IDLE_US
    assert client.ask(OPEN, b"log/empty", session=99)[0] == ACK
    assert client.ftp.open_sessions == ftp.MAX_SESSIONS


def test_a_file_that_grows_or_changes_is_read_as_it_was_when_opened(client: Client) -> None:
    versions = iter((b"first", b"second one"))
    client = Client(Tree({"f": lambda _query: next(versions)}, {"log": client.log}))
    client.ask(OPEN, b"f")
    assert client.ask(READ) == (ACK, b"first")
    assert client.ask(READ, offset=5) == nak(END_OF_FILE)
    log = MemoryFiles({"a": b"12345"})
    client = Client(Tree(mounts={"log": log}))
    client.ask(OPEN, b"log/a")
    log.contents["a"] += b"678"
    assert client.ask(READ) == (ACK, b"12345")
    del log.contents["a"]
    assert client.ask(READ) == nak(FAIL)
    assert client.said[-1] == "File refused: log/a has gone"


def test_a_query_reaches_a_made_file_only(client: Client) -> None:
    client.ask(OPEN, b"@PARAM/param.pck?withdefaults=1")
    assert client.ask(READ) == (ACK, b"packed withdefaults=1")
    assert client.ask(OPEN, b"log/flight.mcap?x")[0] == ACK


def test_a_checksum_is_the_plain_register_from_zero(client: Client) -> None:
    """A bit-by-bit CRC-32 with zero at the start and no inversion, which is what PX4 and ArduPilot calculate."""
    register = 0
    for byte in LOG:
        register ^= byte
        for _ in range(8):
            register = register >> 1 ^ (0xEDB88320 if register & 1 else 0)
    assert client.ask(CRC32, b"log/flight.mcap") == (ACK, struct.pack("<I", register))
    assert register != zlib.crc32(LOG)
    assert client.ask(CRC32, b"log/nope") == nak(NOT_FOUND)


@pytest.mark.parametrize(
    ("opcode", "code"), [(6, 9), (7, 9), (8, 9), (9, 9), (10, 9), (11, 9), (12, 9), (13, 9), (0, 7), (77, 7)]
)
def test_whatever_would_write_and_whatever_is_unknown_is_refused_in_words(
    client: Client, opcode: int, code: int
) -> None:
    assert client.ask(opcode, b"log/flight.mcap") == nak(code)
    assert client.said[0].startswith("File refused: ")
    assert client.log.contents["flight.mcap"] == LOG


def test_a_size_that_cannot_be_is_refused_and_answers_are_not_answered(client: Client) -> None:
    assert client.ask(OPEN, b"log/flight.mcap", size=240) == nak(3)
    for opcode in (ACK, NAK):
        client.send(opcode)
        assert client.answers() == []


@pytest.mark.parametrize("path", [b"", b"/", b"log", b"..", b"\xff\xfe", b"log/flight.mcap/x", b"@PARAM", b"?"])
def test_what_is_no_file_cannot_be_opened(client: Client, path: bytes) -> None:
    assert client.ask(OPEN, path) == nak(NOT_FOUND)


def test_a_name_cannot_be_claimed_twice() -> None:
    with pytest.raises(ValueError, match="claimed twice: log"):
        Tree({"log/a": lambda _query: b""}, {"log": MemoryFiles()})


def test_the_same_files_are_found_where_another_autopilots_clients_look_for_them() -> None:
    files = MemoryFiles({"a.mcap": b"abc", "day/b.mcap": b"de"})
    tree = Tree({"etc/p": lambda _query: b"x"}, {"log": files, "fs/microsd/log": files})

    def names(path: str) -> list[str] | None:
        listing = tree.listing(path)
        return None if listing is None else [f"{e.name}{'/' if e.is_dir else ''}" for e in listing]

    assert names("/") == ["etc/", "fs/", "log/"]
    assert (names("fs"), names("/fs/microsd/")) == (["microsd/"], ["log/"])
    assert names("/fs/microsd/log") == names("log") == ["a.mcap", "day/"]
    assert names("/fs/microsd/log/day") == ["b.mcap"]
    for folder in ("log", "/fs/microsd/log"):
        opened = tree.open(f"{folder}/day/b.mcap")
        assert opened is not None
        assert opened.read(0, 9) == b"de"
    assert (names("fs/other"), tree.open("/fs/microsd/log"), tree.open("fs/a.mcap")) == (None, None, None)


def test_a_vehicle_serves_its_recordings_where_px4s_clients_look() -> None:
    # the tree is the vehicle's own
    vehicle = Vehicle(VehicleConfig(), files=MemoryFiles({"a.mcap": b"abc"}))
    (service,) = [s for s in vehicle._services if isinstance(s, Ftp)]
    listing = service._tree.listing("/fs/microsd/log")
    assert listing is not None
    assert [(e.name, e.size) for e in listing] == [("a.mcap", 3)]


# Logs


class LogClient:
    def __init__(self, files: Files) -> None:
        self.outbox = Outbox(1, ["gcs"])
        self.said: list[str] = []
        self.now_us = 0
        self.logs = Logs(files, self.outbox, Words(self.said.append, lambda: self.now_us))

    def hear(self, ticks: int = 1) -> list[Any]:
        for tick in range(ticks):
            self.logs.step(tick)
        return [mavlink.MAVLink(None).decode(bytearray(d.data)) for d in self.outbox.take()]

    def entries(self, start: int = 0, end: int = 0xFFFF) -> list[Any]:
        self.logs.request_list(ME, mavlink.MAVLink_log_request_list_message(1, 1, start, end), 0)
        return self.hear(10)

    def data(self, number: int, offset: int, count: int, ticks: int = 100) -> list[Any]:
        self.logs.request_data(ME, mavlink.MAVLink_log_request_data_message(1, 1, number, offset, count), 0)
        return self.hear(ticks)


class Dated(MemoryFiles):
    def listing(self, path: str) -> list[Entry] | None:
        return [Entry(e.name, e.size, e.is_dir, 1_700_000_000) for e in super().listing(path) or []]


def test_logs_are_numbered_from_zero_with_size_and_date() -> None:
    client = LogClient(Dated({"b": b"12", "a": b"123", "folder/c": b"1"}))
    heard = [(e.id, e.num_logs, e.last_log_num, e.time_utc, e.size) for e in client.entries()]
    assert heard == [(0, 2, 1, 1_700_000_000, 3), (1, 2, 1, 1_700_000_000, 2)]
    assert [e.id for e in client.entries(1, 1)] == [1]


def test_no_log_is_told_at_once() -> None:
    client = LogClient(MemoryFiles())
    assert [(e.num_logs, e.size) for e in client.entries()] == [(0, 0)]
    assert [(d.id, d.ofs, d.count) for d in client.data(3, 180, 90)] == [(3, 180, 0)]
    assert client.said == ["Log refused: there is no log 3"]


def test_a_log_comes_in_packets_of_ninety_at_their_offsets() -> None:
    client = LogClient(MemoryFiles({"a": LOG}))
    heard = client.data(0, 0, 46_080)
    assert [d.ofs for d in heard] == list(range(0, 1000, 90))
    assert b"".join(bytes(d.data[: d.count]) for d in heard) == LOG
    heard = client.data(0, 90, 180)
    assert [(d.ofs, d.count) for d in heard] == [(90, 90), (180, 90)]
    assert [(d.ofs, d.count) for d in client.data(0, 1080, 90)] == [(1080, 0)]


def test_a_download_keeps_its_pace_and_stops_when_told() -> None:
    client = LogClient(MemoryFiles({"a": bytes(100_000)}))
    assert len(client.data(0, 0, 100_000, ticks=2)) == 2 * logs.PACKETS_PER_TICK
    client.logs.request_end(ME, mavlink.MAVLink_log_request_end_message(1, 1), 0)
    assert client.hear() == []


def test_nothing_is_erased_and_that_is_said() -> None:
    files = MemoryFiles({"a": LOG})
    client = LogClient(files)
    client.logs.erase(ME, mavlink.MAVLink_log_erase_message(1, 1), 0)
    assert client.said == ["Erasing logs refused: they can only be read"]
    assert files.contents == {"a": LOG}
