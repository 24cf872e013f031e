"""Endpoint texts: where a link listens, or whom it calls.

Two spellings are in daily use and both are read: ``udpin:127.0.0.1:14540`` (pymavlink, MAVProxy) and
``udpin://127.0.0.1:14540`` (MAVSDK). ``udp`` means ``udpin``, as it does to pymavlink.
"""

from dataclasses import dataclass
from typing import Literal

from wire.errors import EndpointError

Kind = Literal["udpin", "udpout"]

LOOPBACK = "127.0.0.1"
"""The host when none is written. To listen on every interface, write 0.0.0.0."""

_KINDS: dict[str, Kind] = {"udpin": "udpin", "udp": "udpin", "udpout": "udpout"}


@dataclass(frozen=True, slots=True)
class Endpoint:
    """One end of a UDP link.

    Attributes
    ----------
    kind : ``udpin`` binds and learns who writes to it; ``udpout`` calls `host`:`port` first.
    host : address or name; an IPv6 address without its brackets.
    port : 0 to 65535; 0 (any free port) only for ``udpin``.
    """

    kind: Kind
    host: str
    port: int

    def __post_init__(self) -> None:
        if self.kind not in ("udpin", "udpout"):
            raise ValueError(f"kind is {self.kind!r}; expected 'udpin' or 'udpout'")
        lowest = 0 if self.kind == "udpin" else 1
        if not lowest <= self.port <= 65535:
            raise ValueError(f"port of a {self.kind} endpoint is {self.port}; expected {lowest} to 65535")
        if not self.host:
            raise ValueError("host is empty")

    @classmethod
    def parse(cls, text: str) -> "Endpoint":
        """Read an endpoint in either spelling.

        Parameters
        ----------
        text : ``kind:host:port`` or ``kind://host:port``; the host may be left out (loopback) or be ``[IPv6]``.

        Raises
        ------
        EndpointError    Names the text, what was found and what was expected.
        """
        scheme, colon, rest = text.partition(":")
        kind = _KINDS.get(scheme)
        if kind is None or not colon:
            raise EndpointError(text, scheme, "udpin, udpout or udp, then ':' or '://', then HOST:PORT")
        host, port = _host_and_port(text, rest.removeprefix("//"))
        lowest = 0 if kind == "udpin" else 1
        if not (port.isascii() and port.isdecimal() and lowest <= int(port) <= 65535):
            raise EndpointError(text, port, f"a port from {lowest} to 65535 for {kind}")
        return cls(kind=kind, host=host or LOOPBACK, port=int(port))

    def __str__(self) -> str:
        """pymavlink's spelling; `parse` gives back an equal endpoint."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{self.kind}:{host}:{self.port}"


def _host_and_port(text: str, rest: str) -> tuple[str, str]:
    """Split ``host:port``, ``[IPv6]:port`` or a bare port."""
    if rest.startswith("["):
        host, bracket, tail = rest[1:].partition("]")
        if not bracket or not host or not tail.startswith(":"):
            raise EndpointError(text, rest, "[IPv6 ADDRESS]:PORT")
        port = tail[1:]
    else:
        host, _, port = rest.rpartition(":")
        if ":" in host:
            raise EndpointError(text, rest, "HOST:PORT, an IPv6 address in brackets")
    # A slash, a bracket or a blank in a host is a slip of the pen (a path, a second scheme), never a name.
    if any(character in "/[]@?#" or character.isspace() for character in host):
        raise EndpointError(text, host, "a host name or address")
    return host, port
