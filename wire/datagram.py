"""One UDP payload, with the link it crossed."""

from dataclasses import dataclass

Address = tuple[str, int]
"""(host, port) of a peer, as `socket` spells it, cut to two fields for IPv6 too."""


@dataclass(frozen=True, slots=True)
class Datagram:
    """A UDP payload on its way into or out of a core.

    Attributes
    ----------
    link : name of the endpoint it crossed, as the driver named it (``"autopilot"``, ``"onboard"``, ``"gcs"`` ...).
    data : the bytes; usually one MAVLink packet, but any number is legal, and so is rubbish.
    peer : the far end. Incoming: who sent it. Outgoing: whom to send it to; None means every peer of the link.
    """

    link: str
    data: bytes
    peer: Address | None = None
