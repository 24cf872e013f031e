"""What crosses the seam, put into the channels of one part after another, and counted.

Framing goes on from part to part; channels are declared anew in each. Keys are masked before anything else is done.
"""

from collections.abc import Mapping

from logs import schema
from logs.channels import Channels
from logs.container import Container, Direction
from logs.mirrors import Mirror, Mirrors
from logs.parameters import PARAMETER_MESSAGES, ToldParameters
from logs.secrets import masked
from wire.datagram import Address
from wire.framing import Framer

# What waits for the writer. Plain tuples: one is made for every datagram, in the flight loop.
DatagramItem = tuple[int, int, int, str, Direction, bytes, Address | None]  # log time [ns], now [us], tick, ...
MessageItem = tuple[int, int, int, str, schema.Record]
MirrorItem = tuple[int, int, int, Mirror]
TableItem = tuple[str, Mapping[str, str]]
Item = DatagramItem | MessageItem | MirrorItem | TableItem


class Scribe:
    """Writes datagrams and records into a container.

    Attributes
    ----------
    rx, tx : datagrams written, by link. decoded, messages : packets and records written. made : mirrors, and losses.
    dropped_decoded : packets not decoded, mirrors left out. failed_mirrors : those of which nothing could be made.
    masked : datagrams whose key was masked. parameters : what vehicles told of theirs.
    """

    def __init__(self, container: Container) -> None:
        self.rx: dict[str, int] = {}
        self.tx: dict[str, int] = {}
        self.decoded = self.messages = self.made = self.dropped_decoded = self.masked = 0
        self._framers: dict[tuple[str, Direction], Framer] = {}
        self._seen: set[bytes] = set()  # datagrams decoded in tick `_seen_tick`
        self._seen_tick = -1
        self._mirrors = Mirrors()
        self.parameters = ToldParameters()
        self.failed_mirrors = 0
        self.begin(container)

    def begin(self, container: Container) -> None:
        """Write into another container from now on."""
        self._container, self._channels = container, Channels(container)

    def datagram(self, item: DatagramItem, decode: bool) -> None:
        """A datagram raw and, if so wanted, every known packet in it; `OSError` from the container."""
        log_ns, now_us, tick, link, direction, data, peer = item
        clean = masked(data)
        if clean is not data:
            data = clean
            self.masked += 1
        publish_ns = now_us * 1000
        add = self._container.add_message
        # Counted before it is added: what the container then cannot write is taken back with its chunk.
        counts = self.rx if direction == "rx" else self.tx
        counts[link] = counts.get(link, 0) + 1
        add(self._channels.raw(link, direction, peer), tick, log_ns, publish_ns, data)
        if tick != self._seen_tick:
            self._seen.clear()
            self._seen_tick = tick
        again = data in self._seen
        if again and direction == "tx":
            return
        self._seen.add(data)
        framer = self._framers.get((link, direction))
        if framer is None:
            framer = self._framers[link, direction] = Framer()
        packets, known = framer.packets(data), self._channels.packets
        for packet in packets if not again else ():
            if packet.message_id in PARAMETER_MESSAGES:
                self.parameters.heard(packet.message_id, packet.system_id, packet.component_id, packet.payload)
            key = packet.message_id << 16 | packet.system_id << 8 | packet.component_id
            target = known.get(key)
            if target is None:
                try:
                    target = self._channels.packet(key)
                except LookupError:
                    self.dropped_decoded += 1
                if target is None:
                    continue
            if not decode:
                self.dropped_decoded += 1
                continue
            self.decoded += 1
            add(target[0], tick, log_ns, publish_ns, target[1](packet.payload))

    def message(self, item: MessageItem) -> None:
        """One of our records; `OSError` from the container."""
        log_ns, now_us, tick, topic, message = item
        data = schema.encode(message)
        channel = self._channels.record(topic, type(message))
        if type(message) is schema.Loss:
            self.made += 1
        else:
            self.messages += 1
        self._container.add_message(channel, tick, log_ns, now_us * 1000, data)

    def mirror(self, item: MirrorItem, wanted: bool) -> None:
        """Something for viewers, left out where packets are not decoded; `OSError` from the container."""
        log_ns, _, _, mirror = item
        if not wanted:
            self.dropped_decoded += 1
            return
        try:
            messages = list(self._mirrors.messages(mirror, log_ns))
        except (ValueError, ArithmeticError, IndexError, TypeError):  # what is for viewers must not end the recording
            self.failed_mirrors += 1
            return
        for topic, data in messages:
            self._viewed(topic, data, item[:3])

    def stand(self, at: tuple[int, int, int]) -> None:
        """What stands and what is planned, at the start of a part (log time [ns], now [us], tick)."""
        for topic, data in self._mirrors.standing():
            self._viewed(topic, data, at)

    def _viewed(self, topic: str, data: bytes, at: tuple[int, int, int]) -> None:
        self.made += 1
        self._container.add_message(self._channels.mirror(topic), at[2], at[0], at[1] * 1000, data)

    def take_back(self, lost: Mapping[int, int]) -> int:
        """So many messages of each channel did not get into the file; returns how many were not made from others."""
        missing = 0
        for channel, count in lost.items():
            kind = self._channels.kinds[channel]
            match kind.family:
                case "rx":
                    self.rx[kind.link] -= count
                case "tx":
                    self.tx[kind.link] -= count
                case "decoded":
                    self.decoded -= count
                    self.dropped_decoded += count
                    continue
                case "messages":
                    self.messages -= count
                case "made":
                    self.made -= count
                    continue
            missing += count
        return missing

    def losses(self) -> dict[str, int]:
        """What was lost on the way to us and here, by name."""
        values = {
            "recorder.dropped_decoded": self.dropped_decoded,
            "recorder.masked_keys": self.masked,
            "recorder.failed_mirrors": self.failed_mirrors,
        }
        for (link, direction), framer in self._framers.items():
            if direction == "rx":
                for (system, component), sender in framer.senders.items():
                    values[f"{link}.{system}.{component}.sequence_gaps"] = sender.lost
        return values

    def table(self) -> dict[str, str]:
        """What the framers counted, as strings."""
        values = {"dropped_decoded": str(self.dropped_decoded)}
        if self.masked:
            values["masked_keys"] = str(self.masked)
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
        return values
