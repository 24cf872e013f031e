"""The vehicle's own encoding and decoding, around pymavlink's message classes.

The companion has its own: a shared encoder would agree with its own mistakes. Sequence numbers count per link, as
PX4's do; everything goes out as MAVLink 2, whatever came in.
"""

from typing import Any

from wire.dialect import mavlink
from wire.framing import Packet

Message = Any
"""One of pymavlink's generated message classes; they carry no common static type worth the name."""

AUTOPILOT_COMPONENT = 1


class Encoder:
    """Packs messages for one link, counting their sequence."""

    def __init__(self, system_id: int) -> None:
        self._mavlink = mavlink.MAVLink(None, srcSystem=system_id, srcComponent=AUTOPILOT_COMPONENT)

    def pack(self, message: Message) -> bytes:
        """One MAVLink 2 packet.

        Parameters
        ----------
        message : a pymavlink message whose fields fit their types; anything else is our own mistake.

        Raises
        ------
        struct.error : a field does not fit.
        """
        packed: bytes = message.pack(self._mavlink)
        self._mavlink.seq = (self._mavlink.seq + 1) & 0xFF  # pack() leaves that to send(), which we do not use
        return packed


def decode(packet: Packet) -> Message | None:
    """The message in a framed packet, or None when the dialect does not know it.

    Payloads shorter than the message (MAVLink 2 cuts trailing zeros, MAVLink 1 has no extension fields) are read as
    if followed by zeros. Texts end at their first NUL.
    """
    kind = mavlink.mavlink_map.get(packet.message_id)
    if kind is None:
        return None
    size = kind.unpacker.size
    flat = kind.unpacker.unpack(packet.payload[:size].ljust(size, b"\0"))
    if len(flat) == len(kind.orders):
        return kind(*[flat[i] for i in kind.orders])
    on_wire: list[Any] = []  # some fields are arrays, flat on the wire (texts are one value already)
    position = 0
    for length in kind.lengths:
        on_wire.append(flat[position] if length == 1 else flat[position : position + length])
        position += length
    return kind(*[on_wire[i] for i in kind.orders])
