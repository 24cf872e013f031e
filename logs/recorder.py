"""The recorder: everything that crosses the seam, into MCAP files.

Four families of channels:
    /mavlink/raw/<link>/rx, .../tx       every datagram as it crossed the socket; one channel a peer (`peer` in the
                                         channel's metadata), encoding "mavlink", no schema. The truth for a re-run.
    /mavlink/<sysid>/<compid>/<NAME>     each known packet as protobuf. A packet that crosses several links in one tick
                                         (forwarded, or sent to all) is decoded once.
    /companion/...                       our own records (`logs.schema`)
    /map /vehicle /plan /scene /log /tf  the same for viewers (`logs.mirrors`), made by the writer thread

The seam is a table, and a message says where it belongs in it: log_time is when it happened, publish_time the tick's
`now_us`, both in [ns], `sequence` the index of the tick that took or gave it. The order in the file is the order
at the seam.

What is lost is counted where it is lost: in the kernel, on the way, in the queue, on the disk (`/companion/losses`).
A disk that is full ends a part, not the recording: what is on the disk is closed properly, and a new part is tried
every `RETRY_S`. Keys are masked (`logs.secrets`).
"""

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Self

from logs import schema
from logs.container import Attachment, Direction
from logs.errors import RecordingError
from logs.mirrors import Mirror
from logs.parameters import ATTACHMENT as PARAMETERS
from logs.parts import MOST_PARTS, Gap, Parts, Room, Rotation
from logs.scribe import Item, Scribe, TableItem
from logs.settling import Settler
from wire.datagram import Address

FLUSH_S = 0.4
"""The file is flushed this often [s]. With a tick, `BATCH_S` and the writing a crash costs less than half a second."""
BATCH_S = 0.05
"""The writer thread wakes this often [s]; waking for every message would cost the flight loop its turn."""
DECODE_BACKLOG = 20_000
"""Items waiting for the writer thread above which packets are no longer decoded, only kept raw (and counted)."""
MAX_BACKLOG = 200_000
"""Items waiting above which new ones are dropped, and counted as such."""
MAX_BACKLOG_BYTES = 64 * 1024 * 1024
"""Bytes of datagrams waiting above which it is the same: a datagram may be of 64 KiB."""
LOSSES_S = 1.0
"""Losses are recorded this often at most [s]."""
RETRY_S = 5.0
"""A new part is tried this often while the disk is full [s]."""
MAX_NOTICES = 100
MAX_TABLES = 100
"""Tables kept for the next part while nothing can be written."""


@dataclass(frozen=True, slots=True)
class RecorderCounters:
    """What is in the files, and what is not.

    Attributes
    ----------
    rx, tx : datagrams recorded, by link.
    decoded : packets recorded as protobuf.
    messages : our own records.
    dropped_decoded : packets recorded raw only, and mirrors left out: the writer was behind, there were too many
        senders, or the disk was filling up; and those lost with a chunk that did not fit.
    dropped_raw : datagrams and records that are not in the files: the writer was far behind, or the disk failed.
    masked : datagrams whose key was masked.
    parts : files.
    """

    rx: Mapping[str, int] = field(default_factory=dict)
    tx: Mapping[str, int] = field(default_factory=dict)
    decoded: int = 0
    messages: int = 0
    dropped_decoded: int = 0
    dropped_raw: int = 0
    masked: int = 0
    parts: int = 1


class Recorder:
    """Records one flight into one new file, or several parts.

    Parameters
    ----------
    path : the file to make; an existing one is never touched. Further parts stand beside it (`logs.parts`).
    metadata : named tables of strings, written first ("run": version, seed, endpoints ...).
    attachments : files written first (mission ...). Parameters among them (`logs.parameters`) are kept up to date:
        further parts begin with what has been told since, and every part in which some were told ends with it.
    threaded : True: a thread frames, transcodes and writes, so the caller only pays for a queue; the file is flushed
        every `FLUSH_S` of real time, and another thread has it put on the disk (`logs.settling`). False: everything at
        once in the caller, flushed every `FLUSH_S` of log time; the same calls then give a byte-identical file.
    rotation : when a part ends; checked where the file is flushed.
    room : how much space must be left on the disk; watched with a thread only.
    losses : further counters of what is lost, such as the sockets'; read from the writer's thread.

    Attributes
    ----------
    failure : why something is not in the files; empty as long as everything is.

    Raises
    ------
    RecordingError    Here: the file exists or cannot be made. From `close`: the disk failed on the way or was too slow;
        what went in is readable. The calls between never raise for the disk: the flight goes on, `failure` says why.
    """

    def __init__(
        self,
        path: Path,
        *,
        metadata: Mapping[str, Mapping[str, str]],
        attachments: Sequence[Attachment] = (),
        threaded: bool,
        rotation: Rotation | None = None,
        room: Room | None = None,
        losses: Callable[[], Mapping[str, int]] | None = None,
    ) -> None:
        self.path = path
        self.failure = ""
        self._notices: deque[str] = deque(maxlen=MAX_NOTICES)
        self._rotation = rotation or Rotation()
        self._parts = Parts(path, metadata, attachments, numbered=rotation is not None)
        assert self._parts.container is not None
        self._container, self._scribe = self._parts.container, Scribe(self._parts.container)
        for attachment in attachments:
            if attachment.name == PARAMETERS:
                self._scribe.parameters.read(attachment.data)
        self._attached = 0  # changes of the parameters that the part knows
        self._closed = False
        self._dropped_raw = 0
        self._last = (0, 0, 0)  # log time, now and tick of the newest item
        self._gap: Gap | None = None  # nothing is being written
        self._broken = False  # nor will be
        self._where = "in it"  # what is missing once something is
        self._goes_on = ""  # to be told once a part after a gap holds something
        self._tables: deque[TableItem] = deque(maxlen=MAX_TABLES)  # that wait for a part
        self._resumed_at: int | None = None  # entries missing before the gap that this part ended, if it did
        self._whole_to_ns = 0  # everything up to this log time is on the disk
        self._more_losses = losses or (lambda: {})
        self._told_losses: dict[str, int] = {}
        self._room, self._threaded = room or Room(), threaded
        self._decodes = True  # there is room for it
        self._warned = False
        self._flush_at = self._losses_at = self._retry_at = self._part_ends_at = -1  # [ns] of `_now_ns`
        self._queue: deque[Item] = deque()
        # Counted by the caller; `_dropped_raw` and `_taken_bytes` by the writer: no two threads add to one number.
        self._overflowed = self._overflowed_mirrors = self._put_bytes = 0
        self._taken_bytes = 0
        self._wake = threading.Event()
        self._thread: threading.Thread | None = None
        self._settler: Settler | None = None
        if threaded:
            self._settler = Settler(f"recorder {path.name} to disk")
            self._settler.follow(self._parts.descriptor, path.parent)
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
        if log_time_ns < 0 or now_us < 0 or tick < 0:
            _negative(log_time_ns, now_us, tick)
        self._put((log_time_ns, now_us, tick, link, direction, data, peer))

    def message(self, topic: str, message: schema.Record, *, log_time_ns: int, now_us: int, tick: int) -> None:
        """Record one of our records; times and tick as in `datagram`."""
        if log_time_ns < 0 or now_us < 0 or tick < 0:
            _negative(log_time_ns, now_us, tick)
        self._put((log_time_ns, now_us, tick, topic, message))

    def mirror(self, mirror: Mirror, *, log_time_ns: int, now_us: int, tick: int) -> None:
        """Something for viewers; times and tick as in `datagram`."""
        if log_time_ns < 0 or now_us < 0 or tick < 0:
            _negative(log_time_ns, now_us, tick)
        self._put((log_time_ns, now_us, tick, mirror))

    def metadata(self, name: str, values: Mapping[str, str]) -> None:
        """Record a table of strings known only later, such as the outcome or the sockets' counters."""
        self._put((name, dict(values)))

    @property
    def counters(self) -> RecorderCounters:
        """A snapshot; while a writer thread runs, of what it has written so far."""
        scribe = self._scribe
        return RecorderCounters(
            rx=dict(scribe.rx),
            tx=dict(scribe.tx),
            decoded=scribe.decoded,
            messages=scribe.messages + scribe.made,
            dropped_decoded=scribe.dropped_decoded + self._overflowed_mirrors,
            dropped_raw=self._dropped_raw + self._overflowed,
            masked=scribe.masked,
            parts=self._parts.number,
        )

    @property
    def paths(self) -> tuple[Path, ...]:
        """The files so far."""
        return tuple(self._parts.paths)

    def notices(self) -> list[str]:
        """What a person should know of the recording and has not been given here before: the disk fills up, is full."""
        told = []
        while self._notices:
            told.append(self._notices.popleft())
        return told

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
            if self._queue:  # whatever ended the thread
                self.failure = self.failure or "the writer ended before the flight"
        try:
            while self._queue:
                item = self._queue.popleft()
                if len(item) == 2:
                    self._write(item, False)
                else:
                    self._miss(item)
            if self._gap is not None and not self._broken and self._parts.number < MOST_PARTS:
                self._begin("the recording ended")  # there is room for what is missing to be told, if for anything
            self._attempt(self._finish)
            self._tell_it_goes_on()
        except Exception as error:
            if self._thread is None:
                raise
            self._break(error)
        finally:
            self._close_part()
            if self._settler is not None:
                self._settler.close()
                self._unsettled()
        if self.failure:
            missing = self.counters.dropped_raw
            where = "at its end" if self._gap is not None else self._where
            raise RecordingError(self.path, f"{self.failure}; {missing} entries are missing {where}")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        try:
            self.close()
        except RecordingError:
            if error is None:  # otherwise the first trouble is the one to tell
                raise

    # ---- the caller's side of the queue -------------------------------------------------------------------------

    def _put(self, item: Item) -> None:
        """Write now, or leave it to the thread."""
        if self._closed:
            raise ValueError(f"recorder of {self.path} is closed")
        if self._thread is None:
            self._write(item, True)
            if len(item) > 2:
                self._look()
            return
        full = len(self._queue) >= MAX_BACKLOG or self._put_bytes - self._taken_bytes >= MAX_BACKLOG_BYTES
        if full and len(item) == 4:
            self._overflowed_mirrors += 1
            return
        if full and len(item) > 2:
            if not self._overflowed:
                self._notices.append("the disk is too slow: not everything is recorded")
                self.failure = self.failure or "the disk was too slow"
            self._overflowed += 1
            return
        if len(item) == 7:
            self._put_bytes += len(item[5])
        self._queue.append(item)

    def _run(self) -> None:
        """The writer thread: take what is there, write it, sleep."""
        queue, write = self._queue, self._write
        while True:
            closing = self._wake.wait(BATCH_S)
            while queue:
                for _ in range(min(256, len(queue))):
                    item = queue.popleft()
                    try:
                        write(item, len(queue) < DECODE_BACKLOG and self._decodes)
                    except Exception as error:  # from ending the part
                        self._break(error)
                    if len(item) == 7:
                        self._taken_bytes += len(item[5])
                self._look_safely()
            self._look_safely()
            if closing:
                return

    def _look_safely(self) -> None:
        """`_look`, so that the thread does not die without a word."""
        try:
            self._look()
        except Exception as error:
            self._break(error)

    # ---- the writing side ---------------------------------------------------------------------------------------

    def _now_ns(self) -> int:
        """Real time with a thread; without, log time, so that the same calls give the same bytes."""
        return time.monotonic_ns() if self._threaded else self._last[0]

    def _write(self, item: Item, decode: bool) -> None:
        """Put one item into the present part; between two parts it is counted as missing, and a table waits."""
        if len(item) > 2:
            self._last = item[:3]
        if self._gap is not None:
            self._miss(item)
            return
        try:
            if len(item) == 7:
                self._scribe.datagram(item, decode)
            elif len(item) == 5:
                self._scribe.message(item)
            elif len(item) == 4:
                self._scribe.mirror(item, decode)
            else:
                self._container.add_metadata(*item)
                self._resumed_at = None
        except OSError as error:
            self._abandon(error)
            if len(item) == 2:
                self._miss(item)
        except Exception as error:
            # Whatever it is, a writer thread must not die without a word: `close` tells it.
            if self._thread is None:
                raise
            self._miss(item)
            self._break(error)

    def _miss(self, item: Item) -> None:
        """An item that cannot be written now."""
        if len(item) == 2:
            self._tables.append(item)
        elif len(item) == 4:
            self._scribe.dropped_decoded += 1
        else:
            self._dropped_raw += 1

    def _look(self) -> None:
        """What has its time: flushing, losses, the disk's room, the end of a part."""
        now_ns = self._now_ns()
        if now_ns < self._flush_at:
            return
        if self._gap is not None:
            self._retry()
            return
        if self._flush_at < 0:
            if now_ns:
                self._flush_at, self._losses_at = now_ns + _ns(FLUSH_S), now_ns + _ns(LOSSES_S)
                self._part_begins(now_ns)
            return
        self._flush_at = now_ns + _ns(FLUSH_S)
        if now_ns >= self._losses_at:
            self._losses_at = now_ns + _ns(LOSSES_S)
            self._attempt(self._record_losses)
        self._attempt(self._container.flush)
        self._tell_it_goes_on()
        self._unsettled()
        if self._gap is None and self._threaded:
            self._watch_room()
        if self._gap is None and self._part_is_full(now_ns):
            self._rotate()

    def _tell_it_goes_on(self) -> None:
        """Tell it once the disk took something: a part that it did not is taken away again, and tried again."""
        if self._goes_on and (self._resumed_at is None or self._container.newest_ns):
            self._notices.append(self._goes_on)
            self._goes_on = ""

    def _unsettled(self) -> None:
        """Tell once that the disk does not take what the system wrote for us."""
        if self._settler is not None and self._settler.trouble and not self.failure:
            self.failure = f"the disk failed: {self._settler.trouble}"
            self._notices.append(f"it is not sure that anything is recorded: {self.failure}")

    def _attempt(self, action: Callable[[], None]) -> None:
        if self._gap is not None:
            return
        try:
            action()
        except OSError as error:
            self._abandon(error)

    # ---- losses -------------------------------------------------------------------------------------------------

    def _record_losses(self) -> None:
        """A record for each counter that has changed."""
        values = {"recorder.dropped_raw": self._dropped_raw + self._overflowed} | self._scribe.losses()
        values["recorder.dropped_decoded"] += self._overflowed_mirrors
        with suppress(OSError, ValueError):  # the sockets are closed: what was told of them last holds
            values |= self._more_losses()
        for name, total in values.items():
            if total != self._told_losses.get(name, 0):
                self._told_losses[name] = total
                self._scribe.message((*self._last, schema.TOPICS[schema.Loss], schema.Loss(name, total)))

    def _finish(self) -> None:
        """Write the losses, parameters that were told meanwhile, and everything a reader seeks by."""
        self._record_losses()
        parameters = self._scribe.parameters
        if parameters.changes != self._attached:
            told = parameters.attachment()
            self._container.add_attachment(told.name, told.media_type, told.data)
        dropped = str(self._dropped_raw + self._overflowed)
        table = self._scribe.table() | {"dropped_decoded": str(self.counters.dropped_decoded)}
        self._container.add_metadata("recorder", {"dropped_raw": dropped, **table})
        self._container.finish()

    # ---- parts --------------------------------------------------------------------------------------------------

    def _part_begins(self, now_ns: int) -> None:
        seconds = self._rotation.seconds
        self._part_ends_at = now_ns + _ns(seconds) if seconds is not None else 1 << 63

    def _part_is_full(self, now_ns: int) -> bool:
        size = self._rotation.size_bytes
        full = (size is not None and self._container.size >= size) or now_ns >= self._part_ends_at
        return full and self._parts.number < MOST_PARTS

    def _rotate(self) -> None:
        """End this part, begin the next."""
        self._attempt(self._finish)
        if self._gap is None:
            self._close_part()
            self._begin("the part before was full")

    def _close_part(self) -> None:
        """Leave the present part; what the disk says only then is told, and ends nothing."""
        try:
            self._parts.close()
        except OSError as error:
            self.failure = self.failure or f"writing failed: {_reason(error)}"
            self._notices.append(f"it is not sure that all of the part before is recorded: {_reason(error)}")

    def _begin(self, why: str) -> None:
        """Begin the next part, if the disk takes it; otherwise there is a gap, or there goes on to be one."""
        gap = self._gap
        if gap is not None:
            gap = Gap(gap.reason, gap.from_ns, self._last[0], self._dropped_raw + self._overflowed - gap.missing)
        parameters = self._scribe.parameters
        if parameters.changes != self._attached:
            self._parts.attach(parameters.attachment())
            self._attached = parameters.changes
        try:
            self._container = self._parts.begin(why, gap)
        except OSError as error:
            if self._gap is None:
                self._open_gap(_reason(error))
            return
        self._scribe.begin(self._container)
        if self._settler is not None:
            self._settler.follow(self._parts.descriptor, self.path.parent)
        self._resumed_at = None if self._gap is None else self._gap.missing
        self._gap = None
        self._attempt(self._resume)
        if self._gap is not None:
            return
        self._told_losses.clear()  # every part tells all of them
        self._part_begins(self._now_ns())
        if gap is not None:
            self._where = "between its parts"
            self._goes_on = f"recording goes on in {self._parts.paths[-1]}: {gap.missing} entries are missing"

    def _resume(self) -> None:
        """What a further part begins with: what stands, and tables that found no room in the one before."""
        self._scribe.stand(self._last)
        while self._tables:
            self._container.add_metadata(*self._tables[0])
            self._tables.popleft()
            self._resumed_at = None

    def _abandon(self, error: OSError) -> None:
        """The disk did not take what there was: end this part with what it has, and try another later.

        A further part that nothing got into is taken away again, or a full disk would fill with them.
        """
        missing = self._dropped_raw + self._overflowed
        self._dropped_raw += self._scribe.take_back(self._container.abandon())
        same = False  # gap as before
        if self._resumed_at is not None and not self._container.newest_ns:
            missing, same = self._resumed_at, True
            if self._settler is not None:
                self._settler.forget()
            self._parts.withdraw()
        self._close_part()
        self._open_gap(_reason(error), missing, same)

    def _open_gap(self, reason: str, missing: int | None = None, same: bool = False) -> None:
        """From here on nothing is written.

        missing : how many entries were missing before the first of this gap. same : the gap was told already.
        """
        before = self._dropped_raw + self._overflowed if missing is None else missing
        self._whole_to_ns = self._container.newest_ns or self._whole_to_ns
        self._gap = Gap(reason, self._whole_to_ns, missing=before)
        self.failure = self.failure or f"writing failed: {reason}"
        self._retry_at = self._now_ns() + _ns(RETRY_S)
        goes_on = "the flight goes on without" if self._broken else f"a new part is tried every {RETRY_S:g} s"
        self._goes_on = ""
        if not same or self._broken:
            self._notices.append(f"nothing is recorded: {reason}; {goes_on}")

    def _break(self, error: Exception) -> None:
        """A fault of ours: nothing is recorded any more, and `close` says so."""
        self._broken = True
        reason = f"{type(error).__name__}: {error}"
        if self._gap is not None:
            self.failure = self.failure or f"writing failed: {reason}"
            self._notices.append(f"nothing is recorded: {reason}; the flight goes on without")
            return
        try:
            self._abandon(OSError(0, reason))
        except Exception:  # the same again: what is on the disk stays as it is
            self._close_part()
            self._open_gap(reason)

    def _retry(self) -> None:
        """A new part, if it is time for one and there is room."""
        now_ns = self._now_ns()
        if self._broken or now_ns < self._retry_at or self._parts.number >= MOST_PARTS:
            return
        self._retry_at = now_ns + _ns(RETRY_S)
        if self._threaded:
            free, room = self._free()
            if free < 2 * room.stop:
                return
        self._begin("there is room again")

    def _free(self) -> tuple[int, Room]:
        try:
            free, size = self._parts.disk()
        except OSError:
            return 1 << 62, self._room  # it cannot be told; writing will
        return free, self._room.of_disk(size)

    def _watch_room(self) -> None:
        """Tell of a disk that fills up, save on decoding, end the part while there is room to end it."""
        free, room = self._free()
        left = f"{free / 1e6:.1f} MB are left on the disk of {self.path.parent}"
        if free < room.stop:
            self._attempt(self._finish)
            if self._gap is None:
                self._close_part()
                self._open_gap(left)
            return
        if free < room.warn and not self._warned:
            self._notices.append(left)
        self._warned = free < room.warn
        if (free >= room.raw_only) != self._decodes:
            self._decodes = not self._decodes
            self._notices.append(f"{left}: packets are {'decoded again' if self._decodes else 'kept raw only'}")


def _ns(seconds: float) -> int:
    return round(seconds * 1e9)


def _reason(error: OSError) -> str:
    return str(error.strerror or error)


def _negative(log_time_ns: int, now_us: int, tick: int) -> None:
    """MCAP's times and sequence are unsigned; a negative one would only be found by the writer thread."""
    raise ValueError(f"log_time_ns {log_time_ns}, now_us {now_us}, tick {tick}: expected none below zero")
