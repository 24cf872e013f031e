"""The recorder: everything that crosses the seam, into one MCAP file.

Three families of channels:
    /mavlink/raw/<link>/rx, .../tx       every datagram as it crossed the socket; one channel a peer (`peer` in the
                                         channel's metadata), encoding "mavlink", no schema. The truth for a re-run.
    /mavlink/<sysid>/<compid>/<NAME>     each known packet as protobuf. A packet that crosses several links in one tick
                                         (forwarded, or sent to all) is decoded once.
    /companion/...                       our own records (`logs.schema`)

The seam is a table, and a message says where it belongs in it: log_time is when it happened, publish_time the tick's
`now_us`, both in [ns], `sequence` the index of the tick that took or gave it. The order in the file is the order
at the seam.
"""

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Self

from logs import schema
from logs.container import Attachment, Container, Direction
from logs.errors import RecordingError
from logs.lock import lock
from logs.transcode import Transcoder, transcoder
from wire.datagram import Address
from wire.framing import Framer

FLUSH_S = 0.5
"""Longest time between a message and its reaching the file [s]: what a crash can cost."""
BATCH_S = 0.05
"""The writer thread wakes this often [s]; waking for every message would cost the flight loop its turn."""
DECODE_BACKLOG = 20_000
"""Items waiting for the writer thread above which packets are no longer decoded, only kept raw (and counted)."""
MAX_BACKLOG = 200_000
"""Items waiting above which new ones are dropped, and counted as such."""
MAX_DECODED_CHANNELS = 8192
"""Channels for decoded packets; MCAP allows 65535 in all, and a hostile peer could ask for more."""
MAX_RAW_CHANNELS = 4096


@dataclass(frozen=True, slots=True)
class RecorderCounters:
    """What is in the file, and what is not.

    Attributes
    ----------
    rx, tx : datagrams recorded, by link.
    decoded : packets recorded as protobuf.
    messages : our own records.
    dropped_decoded : packets recorded raw only, since the writer was behind or there were too many senders.
    dropped_raw : datagrams and records that are not in the file: the writer was far behind, or the disk failed.
    """

    rx: Mapping[str, int] = field(default_factory=dict)
    tx: Mapping[str, int] = field(default_factory=dict)
    decoded: int = 0
    messages: int = 0
    dropped_decoded: int = 0
    dropped_raw: int = 0


class Recorder:
    """Records one flight into one new file.

    Parameters
    ----------
    path : the file to make; an existing one is never touched.
    metadata : named tables of strings, written first ("run": version, seed, endpoints ...).
    attachments : files written first (mission ...).
    threaded : True: a thread frames, transcodes and writes, so the caller only pays for a queue, and the file is
        flushed every `FLUSH_S` of real time. False: everything at once in the caller, flushed every `FLUSH_S` of log
        time; the same calls then give a byte-identical file.

    Raises
    ------
    RecordingError    Here: the file exists or cannot be made. From `close`: the disk failed on the way; what went in
        until then is readable. The calls between never raise for the disk: the flight goes on, `failure` says why.
    """

    def __init__(
        self,
        path: Path,
        *,
        metadata: Mapping[str, Mapping[str, str]],
        attachments: Sequence[Attachment] = (),
        threaded: bool,
    ) -> None:
        self.path = path
        self.failure = ""
        try:
            self._file = open(path, "xb", buffering=0)  # noqa: SIM115  closed by `close`
        except FileExistsError:
            raise RecordingError(path, "the file exists already; a recording is never overwritten") from None
        except OSError as error:
            raise RecordingError(path, f"cannot make the file: {error.strerror or error}") from error
        lock(self._file)  # for as long as this process lives: nobody recovers what is still being written
        try:
            self._container = Container(self._file)
            self._container.add_metadata("schema", {"version": str(schema.SCHEMA_VERSION), "dialect": "all"})
            for name, values in metadata.items():
                self._container.add_metadata(name, values)
            for attachment in attachments:
                self._container.add_attachment(attachment.name, attachment.media_type, attachment.data)
        except OSError as error:
            self._file.close()
            raise RecordingError(path, f"cannot write: {error.strerror or error}") from error
        self._closed = False
        self._rx: dict[str, int] = {}
        self._tx: dict[str, int] = {}
        self._decoded = self._messages = self._dropped_decoded = self._dropped_raw = 0
        self._framers: dict[tuple[str, Direction], Framer] = {}
        self._raw_channels: dict[tuple[str, Direction, Address | None], int] = {}
        self._packet_channels: dict[int, tuple[int, Transcoder]] = {}
        self._record_channels: dict[tuple[str, type[schema.Record]], int] = {}
        self._schemas: dict[str, int] = {}
        self._seen: set[bytes] = set()  # datagrams decoded in tick `_seen_tick`
        self._seen_tick = -1
        self._flushed_ns: int | None = None
        self._queue: deque[Callable[[bool], int]] = deque()
        self._overflowed = 0  # counted by the caller, `_dropped_raw` by the writer: no two threads add to one number
        self._wake = threading.Event()
        self._thread: threading.Thread | None = None
        if threaded:
            self._thread = threading.Thread(target=self._run, name=f"recorder {path.name}", daemon=True)
            self._thread.start()

    def datagram(
        self,
        link: str,
        direction: Direction,
        data: bytes,
        *,
        log_time_ns: int,
        now_us: int,
        tick: int,
        peer: Address | None = None,
    ) -> None:
        """Record a datagram raw, and every packet in it decoded.

        Parameters
        ----------
        link, direction : where it crossed; "rx" came to us, "tx" left.
        log_time_ns : when it arrived or left [ns].
        now_us : time of the tick that took or gave it [us].
        tick : index of that tick.
        peer : who sent it, or to whom it went; None: to every peer of the link.

        Raises
        ------
        ValueError    A negative time or tick, or the recorder is closed.
        """
        _check_times(log_time_ns, now_us, tick)
        self._put(lambda decode: self._datagram(link, direction, data, log_time_ns, now_us, tick, peer, decode))

    def message(self, topic: str, message: schema.Record, *, log_time_ns: int, now_us: int, tick: int) -> None:
        """Record one of our records; times and tick as in `datagram`."""
        _check_times(log_time_ns, now_us, tick)
        self._put(lambda _: self._message(topic, message, log_time_ns, now_us, tick))

    def metadata(self, name: str, values: Mapping[str, str]) -> None:
        """Record a table of strings known only later, such as the outcome or the sockets' counters."""
        kept = dict(values)
        self._put(lambda _: self._metadata(name, kept))

    @property
    def counters(self) -> RecorderCounters:
        """A snapshot; while a writer thread runs, of what it has written so far."""
        return RecorderCounters(
            rx=dict(self._rx),
            tx=dict(self._tx),
            decoded=self._decoded,
            messages=self._messages,
            dropped_decoded=self._dropped_decoded,
            dropped_raw=self._dropped_raw + self._overflowed,
        )

    def close(self) -> None:
        """Write what is waiting, the loss counters and the summary; may be called twice.

        Raises
        ------
        RecordingError    The disk failed during the recording or now.
        """
        if self._closed:
            return
        self._closed = True
        if self._thread is not None:
            self._wake.set()
            self._thread.join()
        self._attempt(self._finish)
        self._file.close()
        if self.failure:
            raise RecordingError(
                self.path, f"{self.failure}; {self.counters.dropped_raw} entries are missing at its end"
            )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        try:
            self.close()
        except RecordingError:
            if error is None:  # otherwise the first trouble is the one to tell
                raise

    # ---- the caller's side of the queue -------------------------------------------------------------------------

    def _put(self, write: Callable[[bool], int]) -> None:
        """Write now, or leave it to the thread."""
        if self._closed:
            raise ValueError(f"recorder of {self.path} is closed")
        if self._thread is None:
            self._write(write, True)
        elif len(self._queue) >= MAX_BACKLOG:
            self._overflowed += 1
        else:
            self._queue.append(write)

    def _run(self) -> None:
        """The writer thread: take what is there, write it, sleep."""
        flush_at = time.monotonic() + FLUSH_S
        while True:
            closing = self._wake.wait(BATCH_S)
            while self._queue:
                self._write(self._queue.popleft(), len(self._queue) < DECODE_BACKLOG)
                if time.monotonic() >= flush_at:
                    self._attempt(self._container.flush)
                    flush_at = time.monotonic() + FLUSH_S
            if time.monotonic() >= flush_at:
                self._attempt(self._container.flush)
                flush_at = time.monotonic() + FLUSH_S
            if closing:
                return

    # ---- the writing side ---------------------------------------------------------------------------------------

    def _write(self, write: Callable[[bool], int], decode: bool) -> None:
        """Run one write; without a thread, also end the chunk when its time has come."""
        if self.failure:
            self._dropped_raw += 1
            return
        try:
            log_ns = write(decode)
            if self._thread is None and log_ns:
                if self._flushed_ns is None:
                    self._flushed_ns = log_ns
                elif log_ns - self._flushed_ns >= FLUSH_S * 1e9:
                    self._flushed_ns = log_ns
                    self._container.flush()
        except OSError as error:
            self.failure = f"writing failed: {error.strerror or error}"
            self._dropped_raw += 1
        except Exception as error:
            # Whatever it is, a writer thread must not die without a word: `close` tells it.
            if self._thread is None:
                raise
            self.failure = f"writing failed: {type(error).__name__}: {error}"
            self._dropped_raw += 1

    def _attempt(self, action: Callable[[], None]) -> None:
        if self.failure:
            return
        try:
            action()
        except OSError as error:
            self.failure = f"writing failed: {error.strerror or error}"

    def _datagram(
        self,
        link: str,
        direction: Direction,
        data: bytes,
        log_ns: int,
        now_us: int,
        tick: int,
        peer: Address | None,
        decode: bool,
    ) -> int:
        publish_ns = now_us * 1000
        self._container.add_message(self._raw_channel(link, direction, peer), tick, log_ns, publish_ns, data)
        counts = self._rx if direction == "rx" else self._tx
        counts[link] = counts.get(link, 0) + 1
        if tick != self._seen_tick:
            self._seen.clear()
            self._seen_tick = tick
        again = data in self._seen
        if again and direction == "tx":
            return log_ns
        self._seen.add(data)
        framer = self._framers.get((link, direction))
        if framer is None:
            framer = self._framers[link, direction] = Framer()
        for packet in framer.packets(data):
            if again:
                continue
            key = packet.message_id << 16 | packet.system_id << 8 | packet.component_id
            target = self._packet_channels.get(key)
            if target is None:
                target = self._packet_channel(packet.message_id, packet.system_id, packet.component_id, key)
                if target is None:
                    continue
            if not decode:
                self._dropped_decoded += 1
                continue
            self._container.add_message(target[0], tick, log_ns, publish_ns, target[1](packet.payload))
            self._decoded += 1
        return log_ns

    def _message(self, topic: str, message: schema.Record, log_ns: int, now_us: int, tick: int) -> int:
        kind = type(message)
        channel = self._record_channels.get((topic, kind))
        if channel is None:
            schema_id = self._schema(schema.schema_name(kind), schema.DESCRIPTOR_SET)
            channel = self._container.add_channel(topic, "protobuf", schema_id, {})
            self._record_channels[topic, kind] = channel
        self._container.add_message(channel, tick, log_ns, now_us * 1000, schema.encode(message))
        self._messages += 1
        return log_ns

    def _metadata(self, name: str, values: Mapping[str, str]) -> int:
        self._container.add_metadata(name, values)
        return 0

    def _raw_channel(self, link: str, direction: Direction, peer: Address | None) -> int:
        """The channel of a link, direction and peer, declared on first use."""
        channel = self._raw_channels.get((link, direction, peer))
        if channel is None:
            if len(self._raw_channels) >= MAX_RAW_CHANNELS and peer is not None:
                return self._raw_channel(link, direction, None)
            metadata = {"link": link, "direction": direction}
            if peer is not None:
                metadata |= {"peer_host": peer[0], "peer_port": str(peer[1])}
            channel = self._container.add_channel(f"/mavlink/raw/{link}/{direction}", "mavlink", 0, metadata)
            self._raw_channels[link, direction, peer] = channel
        return channel

    def _packet_channel(self, message_id: int, system: int, component: int, key: int) -> tuple[int, Transcoder] | None:
        """The channel and transcoder of a sender's message, declared on first use; None if it is not decoded."""
        encode = transcoder(message_id)
        if encode is None:
            return None  # not remembered: three bytes of message id are too many for a table
        if len(self._packet_channels) >= MAX_DECODED_CHANNELS:
            self._dropped_decoded += 1
            return None
        schema_id = self._schema(encode.schema_name, encode.descriptor_set)
        channel = self._container.add_channel(f"/mavlink/{system}/{component}/{encode.name}", "protobuf", schema_id, {})
        self._packet_channels[key] = (channel, encode)
        return channel, encode

    def _schema(self, name: str, descriptor_set: bytes) -> int:
        schema_id = self._schemas.get(name)
        if schema_id is None:
            schema_id = self._schemas[name] = self._container.add_schema(name, "protobuf", descriptor_set)
        return schema_id

    def _finish(self) -> None:
        """Write the loss counters and everything a reader seeks by."""
        values = {"dropped_raw": str(self.counters.dropped_raw), "dropped_decoded": str(self._dropped_decoded)}
        for (link, direction), framer in self._framers.items():
            at = f"{link}.{direction}"
            counters = framer.counters
            values |= {
                f"{at}.garbage_bytes": str(counters.garbage_bytes),
                f"{at}.bad_crc": str(counters.bad_crc),
                f"{at}.unknown": str(counters.unknown),
                f"{at}.truncated": str(counters.truncated),
            }
            if direction == "rx":
                for (system, component), sender in framer.senders.items():
                    values[f"{at}.{system}.{component}.received"] = str(sender.received)
                    values[f"{at}.{system}.{component}.lost"] = str(sender.lost)
        self._container.add_metadata("recorder", values)
        self._container.finish()


def _check_times(log_time_ns: int, now_us: int, tick: int) -> None:
    """MCAP's times and sequence are unsigned; a negative one would only be found by the writer thread."""
    if log_time_ns < 0 or now_us < 0 or tick < 0:
        raise ValueError(f"log_time_ns {log_time_ns}, now_us {now_us}, tick {tick}: expected none below zero")
