"""What the vehicle says in one tick, in order, with a bound on it."""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

from fakevehicle.codec import Encoder, Message
from wire.datagram import Address, Datagram
from wire.dialect import mavlink

MAX_DATAGRAMS = 512
"""Most datagrams of one tick; what is more is dropped and counted, so that a flood of requests stays harmless."""
MAX_SAID = 256
TEXT_LENGTH = 50
MAX_TEXT = 4 * TEXT_LENGTH


@dataclass(frozen=True, slots=True)
class Sender:
    """Who asked: the link, the address behind it, and the MAVLink identity."""

    link: str
    peer: Address | None
    system_id: int
    component_id: int


class Outbox:
    """Encodes and collects one tick's datagrams. One packet a datagram, as PX4 sends them."""

    def __init__(self, system_id: int, links: Sequence[str]) -> None:
        self._encoders = {link: Encoder(system_id) for link in links}
        self._out: list[Datagram] = []
        self._text_id = 0
        self._said: deque[str] = deque(maxlen=MAX_SAID)
        self.dropped = 0
        self.sent = 0

    def answer(self, sender: Sender, message: Message) -> None:
        """To one peer."""
        self._put(sender.link, message, sender.peer)

    def broadcast(self, link: str, message: Message) -> None:
        """To every peer of one link."""
        self._put(link, message, None)

    def everywhere(self, message: Message) -> None:
        """To every peer of every link."""
        for link in self._encoders:
            self._put(link, message, None)

    def text(self, severity: int, text: str) -> None:
        """A STATUSTEXT everywhere, in chunks of 50 characters when it is longer (at most 200)."""
        self._said.append(text)
        self._text_id = self._text_id % 0xFFFF + 1
        raw = text.encode("ascii", "replace")[:MAX_TEXT]
        chunks = [raw[i : i + TEXT_LENGTH] for i in range(0, len(raw), TEXT_LENGTH)] or [b""]
        if len(chunks) > 1 and len(chunks[-1]) == TEXT_LENGTH:
            chunks.append(b"")  # a full chunk promises another one
        identity = self._text_id if len(chunks) > 1 else 0
        for number, chunk in enumerate(chunks):
            self.everywhere(mavlink.MAVLink_statustext_message(severity, chunk, identity, number))

    def take(self) -> list[Datagram]:
        """Everything collected since the last call, in order."""
        out, self._out = self._out, []
        return out

    def take_said(self) -> list[str]:
        """The texts sent since the last call, for a log; the oldest are lost when nobody asks."""
        said = list(self._said)
        self._said.clear()
        return said

    def _put(self, link: str, message: Message, peer: Address | None) -> None:
        if len(self._out) >= MAX_DATAGRAMS:
            self.dropped += 1
            return
        self.sent += 1
        self._out.append(Datagram(link, self._encoders[link].pack(message), peer))
