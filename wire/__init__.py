"""The leaf both speakers share: endpoint texts, UDP sockets, and framing of MAVLink datagrams. Framing, never meaning.

The way in: `Endpoint.parse` reads ``udpin:127.0.0.1:14540`` or ``udpin://127.0.0.1:14540``; `wire.udp.UdpLink` opens
it; what arrives is handed to a core as a `Datagram`; a `Framer` cuts its bytes into whole `Packet` s. The message
definitions both speakers use are `wire.dialect.mavlink`.

`wire.udp` is not imported here: it opens sockets and reads a clock, and cores import this package.

Units: nanoseconds for stamps (monotonic clock), bytes for sizes.
"""

from wire.datagram import Address, Datagram
from wire.endpoint import Endpoint
from wire.errors import EndpointError, LinkError, WireError
from wire.framing import Framer, FramingCounters, Packet, SenderCounters

__all__ = [
    "Address",
    "Datagram",
    "Endpoint",
    "EndpointError",
    "Framer",
    "FramingCounters",
    "LinkError",
    "Packet",
    "SenderCounters",
    "WireError",
]
