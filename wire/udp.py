"""UDP links: non-blocking sockets that learn their peers, count everything and never raise for what a peer did.

The one module of `wire` that opens sockets and reads a clock; cores must not import it.

Stamps are nanoseconds of the monotonic clock (`time.monotonic_ns`). Where the kernel offers it (Linux) they say when
the datagram arrived, not when it was read: the kernel stamps in real time, and the age at reading is taken off the
monotonic clock, so a step of the wall clock cannot bend a recording.
"""

import errno
import select
import socket
import struct
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from types import TracebackType
from typing import Self

from wire.datagram import Address, Datagram
from wire.endpoint import Endpoint
from wire.errors import LinkError

RECEIVE_BUFFER = 16 * 1024 * 1024
"""Asked of the kernel [bytes]: a second or two at 20 000 datagrams a second, whose default holds 256 of them, 13 ms. It
grants `net.core.rmem_max`, often 0.2 MB, unless we have CAP_NET_ADMIN."""
MAX_PEERS = 32
"""Peers a link remembers; the one silent for longest makes room for a new one."""
MAX_DRAIN = 1024
"""Datagrams one `receive` takes at most, so that a flood cannot hold the caller."""

_LINUX = sys.platform == "linux"
_SO_TIMESTAMPNS = 35  # asm-generic/socket.h; the socket module has no name for most of these
_SO_RXQ_OVFL = 40
_SO_MEMINFO = 55
_SO_RCVBUFFORCE = 33
_IP_RECVERR = 11  # linux/in.h
_IPV6_RECVERR = 25  # linux/in6.h
_MSG_ERRQUEUE = 0x2000
_TIMESPEC = struct.Struct("@ll")
_COUNT = struct.Struct("@I")
_MEMINFO = struct.Struct("@9I")  # linux/sock_diag.h; the last is SK_MEMINFO_DROPS
_ANCILLARY = socket.CMSG_SPACE(_TIMESPEC.size) + socket.CMSG_SPACE(_COUNT.size) if _LINUX else 0


@dataclass(frozen=True, slots=True)
class Received:
    """One datagram as it came in: bytes, who sent it, and when it arrived [ns, monotonic clock]."""

    data: bytes
    peer: Address
    received_ns: int


@dataclass(frozen=True, slots=True)
class LinkCounters:
    """What crossed a socket since it was opened.

    Attributes
    ----------
    rx_datagrams, rx_bytes, tx_datagrams, tx_bytes : handed over and accepted by the kernel.
    send_errors : datagrams the kernel would not take (no route, buffer full).
    refused : ICMP "port unreachable" answers: nobody listens at a peer's address.
    handed : datagrams given to `send`, each counted once, however many peers (or none) were there to get it.
    drops : datagrams the kernel threw away since the receive buffer was full (Linux; 0 elsewhere; before 4.12 told
        with the next one that gets through).
    """

    rx_datagrams: int = 0
    rx_bytes: int = 0
    tx_datagrams: int = 0
    tx_bytes: int = 0
    send_errors: int = 0
    refused: int = 0
    drops: int = 0
    handed: int = 0


class UdpLink:
    """One UDP socket of a driver.

    ``udpin`` binds the endpoint and learns its peers from who writes to it. ``udpout`` calls the endpoint first, from
    `local` or any free port; whoever else writes to that port is learned and answered too.

    Parameters
    ----------
    name : what the driver calls the link; used in errors only.
    endpoint : where to listen or whom to call.
    local : source address of a ``udpout`` link, if it must be a fixed one (PX4 sends 18570 -> 14550).

    Raises
    ------
    LinkError     The port is taken, the host unknown, or the system refuses the socket.
    ValueError    `local` was given for a ``udpin`` endpoint.
    """

    def __init__(self, name: str, endpoint: Endpoint, local: Address | None = None) -> None:
        if local is not None and endpoint.kind == "udpin":
            raise ValueError("local is for udpout endpoints; a udpin endpoint is its own local address")
        self.name = name
        self.endpoint = endpoint
        self._fixed: Address | None = None
        self._peers: dict[Address, int] = {}  # address -> when it last wrote [ns]
        self._buffer = bytearray(65536)
        self._view = memoryview(self._buffer)
        self._rx_datagrams = self._rx_bytes = self._tx_datagrams = self._tx_bytes = 0
        self._send_errors = self._refused = self._drops = self._handed = 0
        self._socket = self._open(local)

    def _open(self, local: Address | None) -> socket.socket:
        """Resolve, create, tune and bind the socket."""
        bind_to = (self.endpoint.host, self.endpoint.port) if self.endpoint.kind == "udpin" else local
        try:
            family, _, _, _, address = socket.getaddrinfo(
                self.endpoint.host, self.endpoint.port, type=socket.SOCK_DGRAM, proto=socket.IPPROTO_UDP
            )[0]
        except OSError as error:
            reason = f"cannot find host {self.endpoint.host!r}: {error.strerror or error}"
            raise LinkError(self.name, str(self.endpoint), reason) from error
        if self.endpoint.kind == "udpout":
            self._fixed = (str(address[0]), int(address[1]))
        udp: socket.socket | None = None
        try:
            udp = socket.socket(family, socket.SOCK_DGRAM)
            udp.setblocking(False)
            _tune(udp)
            if bind_to is not None:
                udp.bind(bind_to)
            elif self._fixed is not None:
                # Bound now, on the route's own interface, so that local_address is known before the first datagram.
                udp.bind((_source_for(family, self._fixed), 0))
        except OSError as error:
            if udp is not None:
                udp.close()
            raise LinkError(self.name, str(self.endpoint), _reason(error, bind_to or self._fixed)) from error
        return udp

    @property
    def local_address(self) -> Address:
        """(host, port) this socket is bound to; the real port where 0 was asked for."""
        host, port = self._socket.getsockname()[:2]
        return (host, port)

    @property
    def peers(self) -> tuple[Address, ...]:
        """Everyone a `Datagram` with peer None goes to: the called peer first, then the learned ones."""
        learned = tuple(self._peers)
        return learned if self._fixed is None else (self._fixed, *learned)

    @property
    def receive_buffer_bytes(self) -> int:
        """Receive buffer the kernel granted [bytes]; it may be less than `RECEIVE_BUFFER`."""
        granted = self._socket.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF)
        return granted // 2 if _LINUX else granted  # Linux doubles the figure for its bookkeeping, socket(7)

    @property
    def counters(self) -> LinkCounters:
        """A snapshot of the counters."""
        if _LINUX and self._socket.fileno() >= 0:
            self._drops = max(self._drops, _drops_of(self._socket))
        return LinkCounters(
            rx_datagrams=self._rx_datagrams,
            rx_bytes=self._rx_bytes,
            tx_datagrams=self._tx_datagrams,
            tx_bytes=self._tx_bytes,
            send_errors=self._send_errors,
            refused=self._refused,
            drops=self._drops,
            handed=self._handed,
        )

    def receive(self) -> list[Received]:
        """Take what has arrived, at most `MAX_DRAIN` datagrams, in order; never waits, never raises for a peer."""
        taken: list[Received] = []
        offset_ns = _real_minus_monotonic_ns()  # once a drain: the kernel's stamps are in real time
        while len(taken) < MAX_DRAIN:
            try:
                size, ancillary, _, sender = self._socket.recvmsg_into((self._buffer,), _ANCILLARY)
            except BlockingIOError:
                break
            except OSError:
                if self._socket.fileno() < 0:
                    raise ValueError(f"link {self.name!r} is closed") from None
                if not _LINUX:  # elsewhere the exception itself is the only word of the refusal
                    self._refused += 1
                continue
            read_ns = time.monotonic_ns()
            received_ns = read_ns
            for level, kind, value in ancillary:
                if level != socket.SOL_SOCKET:
                    continue
                if kind == _SO_TIMESTAMPNS and len(value) == _TIMESPEC.size:
                    seconds, nanoseconds = _TIMESPEC.unpack(value)
                    # Never later than the reading, whatever the wall clock did in between.
                    received_ns = min(read_ns, seconds * 1_000_000_000 + nanoseconds - offset_ns)
                elif kind == _SO_RXQ_OVFL and len(value) == _COUNT.size:
                    self._drops = _COUNT.unpack(value)[0]
            peer: Address = sender[:2]
            self._learn(peer, received_ns)
            self._rx_datagrams += 1
            self._rx_bytes += size
            taken.append(Received(self._view[:size].tobytes(), peer, received_ns))
        if _LINUX and len(taken) < MAX_DRAIN:
            self._take_refusals()
        return taken

    def send(self, datagram: Datagram) -> None:
        """Send to `datagram.peer`, or to every known peer when it is None. Failures are counted, not raised."""
        self._handed += 1
        for peer in (datagram.peer,) if datagram.peer is not None else self.peers:
            for _ in range(2):
                try:
                    self._socket.sendto(datagram.data, peer)
                except ConnectionRefusedError:
                    # The answer to an earlier datagram, reported instead of sending this one: once more.
                    if not _LINUX:
                        self._refused += 1
                    continue
                except OSError:
                    if self._socket.fileno() < 0:
                        raise ValueError(f"link {self.name!r} is closed") from None
                    self._send_errors += 1
                    break
                self._tx_datagrams += 1
                self._tx_bytes += len(datagram.data)
                break
            else:
                self._send_errors += 1

    def fileno(self) -> int:
        """File descriptor, for `select`."""
        return self._socket.fileno()

    def close(self) -> None:
        """Close the socket; may be called twice."""
        self._socket.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()

    def _learn(self, peer: Address, now_ns: int) -> None:
        """Remember who wrote, and when; make room by forgetting the one silent for longest."""
        if peer == self._fixed:
            return
        if peer not in self._peers and len(self._peers) >= MAX_PEERS:
            del self._peers[min(self._peers, key=self._peers.__getitem__)]
        self._peers[peer] = now_ns

    def _take_refusals(self) -> None:
        """Count and clear the ICMP answers the kernel queued; left there, they would keep waking `wait`."""
        for _ in range(MAX_DRAIN):
            try:
                self._socket.recvmsg_into((self._buffer,), 512, _MSG_ERRQUEUE)
            except OSError:
                return
            self._refused += 1


def wait(links: Sequence[UdpLink], timeout_s: float) -> list[UdpLink]:
    """Block until a link has something to receive or the time is over.

    `select` and not `epoll`: its timeout counts microseconds, where epoll's counts milliseconds and would make every
    tick late by up to one.

    Parameters
    ----------
    links : the links to watch; with none this is a sleep.
    timeout_s : longest wait [s]; zero or less only looks.

    Returns
    -------
    The links ready to `receive`; empty when the time is over.
    """
    ready, _, _ = select.select(links, (), (), max(0.0, timeout_s))
    return ready


def _tune(udp: socket.socket) -> None:
    """Ask for a large receive buffer, and on Linux for stamps, drop counts and ICMP errors."""
    udp.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BUFFER)
    if not _LINUX:
        return
    with suppress(PermissionError):  # beyond net.core.rmem_max, for whom CAP_NET_ADMIN allows it; socket(7)
        udp.setsockopt(socket.SOL_SOCKET, _SO_RCVBUFFORCE, RECEIVE_BUFFER)
    udp.setsockopt(socket.SOL_SOCKET, _SO_TIMESTAMPNS, 1)
    udp.setsockopt(socket.SOL_SOCKET, _SO_RXQ_OVFL, 1)
    if udp.family == socket.AF_INET6:
        udp.setsockopt(socket.IPPROTO_IPV6, _IPV6_RECVERR, 1)
    else:
        udp.setsockopt(socket.IPPROTO_IP, _IP_RECVERR, 1)


def _real_minus_monotonic_ns() -> int:
    """What the wall clock is ahead of the monotonic one; read again when we were put aside between the two."""
    for _ in range(3):
        before_ns, real_ns, after_ns = time.monotonic_ns(), time.time_ns(), time.monotonic_ns()
        if after_ns - before_ns < 20_000:
            break
    return real_ns - (before_ns + after_ns) // 2


def _drops_of(udp: socket.socket) -> int:
    """Datagrams the kernel has thrown away, from the socket itself; 0 where it cannot be asked."""
    try:
        info = udp.getsockopt(socket.SOL_SOCKET, _SO_MEMINFO, _MEMINFO.size)
    except OSError:
        return 0
    return int(_MEMINFO.unpack(info)[-1]) if len(info) == _MEMINFO.size else 0


def _source_for(family: socket.AddressFamily, peer: Address) -> str:
    """Address this machine would send from to reach `peer`; connecting a UDP socket sends nothing."""
    with socket.socket(family, socket.SOCK_DGRAM) as probe:
        probe.connect(peer)
        return str(probe.getsockname()[0])


def _reason(error: OSError, bind_to: Address | None) -> str:
    """One line for what the system said."""
    where = f"{bind_to[0]} port {bind_to[1]}" if bind_to is not None else "a local port"
    if error.errno == errno.EADDRINUSE:
        return f"{where} is already in use by another program"
    if error.errno == errno.EADDRNOTAVAIL:
        return f"{where}: this machine has no such address"
    return f"{where}: {error.strerror or error}"
