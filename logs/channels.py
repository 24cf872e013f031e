"""The channels of one part, each declared where it is first used."""

from dataclasses import dataclass
from typing import Literal

from logs import foxglove, schema
from logs.container import Container, Direction
from logs.mirrors import SCHEMAS
from logs.transcode import Transcoder, transcoder
from wire.datagram import Address

MAX_DECODED_CHANNELS = 8192
"""Channels for decoded packets; MCAP allows 65535 in all, and a hostile peer could ask for more."""
MAX_RAW_CHANNELS = 4096


@dataclass(frozen=True, slots=True)
class Kind:
    """What a channel's messages are counted as, and of which link; "made" are mirrors and the recorder's own."""

    family: Literal["rx", "tx", "decoded", "messages", "made"]
    link: str = ""


class Channels:
    """The channels of a container.

    Attributes
    ----------
    kinds : by channel id.
    """

    def __init__(self, container: Container) -> None:
        self._container = container
        self.kinds: dict[int, Kind] = {}
        self._raw: dict[tuple[str, Direction, Address | None], int] = {}
        self.packets: dict[int, tuple[int, Transcoder]] = {}  # by message id << 16 | system << 8 | component
        self._records: dict[tuple[str, type[schema.Record]], int] = {}
        self._mirrors: dict[str, int] = {}
        self._schemas: dict[str, int] = {}

    def raw(self, link: str, direction: Direction, peer: Address | None) -> int:
        """The channel of a link, direction and peer."""
        channel = self._raw.get((link, direction, peer))
        if channel is None:
            if len(self._raw) >= MAX_RAW_CHANNELS and peer is not None:
                return self.raw(link, direction, None)
            metadata = {"link": link, "direction": direction}
            if peer is not None:
                metadata |= {"peer_host": peer[0], "peer_port": str(peer[1])}
            channel = self._container.add_channel(f"/mavlink/raw/{link}/{direction}", "mavlink", 0, metadata)
            self._raw[link, direction, peer] = channel
            self.kinds[channel] = Kind(direction, link)
        return channel

    def packet(self, key: int) -> tuple[int, Transcoder] | None:
        """The channel and transcoder of a sender's message, not yet in `packets`; None: it is not known.

        Raises
        ------
        LookupError    There are too many channels already.
        """
        encode = transcoder(key >> 16)
        if encode is None:
            return None  # not remembered: three bytes of message id are too many for a table
        if len(self.packets) >= MAX_DECODED_CHANNELS:
            raise LookupError("too many senders")
        schema_id = self._schema(encode.schema_name, encode.descriptor_set)
        topic = f"/mavlink/{key >> 8 & 0xFF}/{key & 0xFF}/{encode.name}"
        channel = self._container.add_channel(topic, "protobuf", schema_id, {})
        self.packets[key] = (channel, encode)
        self.kinds[channel] = Kind("decoded")
        return channel, encode

    def record(self, topic: str, kind: type[schema.Record]) -> int:
        """The channel of our records of a kind."""
        channel = self._records.get((topic, kind))
        if channel is None:
            schema_id = self._schema(schema.schema_name(kind), schema.DESCRIPTOR_SET)
            channel = self._container.add_channel(topic, "protobuf", schema_id, {})
            self._records[topic, kind] = channel
            self.kinds[channel] = Kind("made" if kind is schema.Loss else "messages")
        return channel

    def mirror(self, topic: str) -> int:
        """The channel of a topic of `logs.mirrors`."""
        channel = self._mirrors.get(topic)
        if channel is None:
            schema_id = self._schema(f"{foxglove.PACKAGE}.{SCHEMAS[topic]}", foxglove.DESCRIPTOR_SET)
            channel = self._mirrors[topic] = self._container.add_channel(topic, "protobuf", schema_id, {})
            self.kinds[channel] = Kind("made")
        return channel

    def _schema(self, name: str, descriptor_set: bytes) -> int:
        schema_id = self._schemas.get(name)
        if schema_id is None:
            schema_id = self._schemas[name] = self._container.add_schema(name, "protobuf", descriptor_set)
        return schema_id
