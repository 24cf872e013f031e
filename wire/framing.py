"""Bytes to whole MAVLink packets, and nothing about what they mean.

Theory of operation
-------------------
A datagram is scanned from left to right. At a start byte (0xFE: MAVLink 1, 0xFD: MAVLink 2) the header says how
long the packet is:

    v1   FE len seq sys comp id                     payload[len]  crc[2]
    v2   FD len incompat compat seq sys comp id[3]  payload[len]  crc[2]  [signature[13]]

(https://mavlink.io/en/guide/serialization.html). The checksum is CRC-16/MCRF4XX over everything between the start
byte and the checksum, then one byte of the message's definition, CRC_EXTRA. What follows decides, in this order:

- the datagram ends first: perhaps truncated, perhaps a stray start byte; look on from the next byte
- message known, checksum right: a packet; look on behind it
- message known, checksum wrong: look on from the next byte, since the start byte may be a stray one
- message unknown, so no CRC_EXTRA: believed only if the datagram ends there or another start byte follows
- an incompatibility flag other than "signed": the packet is skipped whole, as the standard demands

Every byte ends up in one packet (returned or skipped) or in `garbage_bytes`. Nothing is carried from one datagram to
the next: half a packet left over would spoil the next good one. Signatures are kept in `Packet.raw`, unchecked.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from fastcrc import crc16

from wire.dialect import mavlink

START_V1 = 0xFE
START_V2 = 0xFD
SIGNED = 0x01
"""The one incompatibility flag there is: a 13-byte signature follows the checksum."""
SIGNATURE_LENGTH = 13
MAX_SENDERS = 256
"""Senders whose sequence is followed; packets of any further ones are only counted, as `untracked`."""
LATE_WINDOW = 16
"""A sequence number at most this far behind the newest is a late packet, not a gap of 240."""

_HEADER_V1 = 6
_HEADER_V2 = 10
_CRC_EXTRA: dict[int, bytes] = {number: bytes((cls.crc_extra,)) for number, cls in mavlink.mavlink_map.items()}
_crc = crc16.mcrf4xx


class Packet(NamedTuple):
    """One whole MAVLink packet. (A named tuple: built in a third of the time of a frozen dataclass.)

    Attributes
    ----------
    version : 1 or 2.
    sequence : 0 to 255, as the sender counted it.
    system_id, component_id : the sender.
    message_id : may be one the dialect does not know; then the checksum could not be checked.
    payload : as on the wire: MAVLink 2 cuts trailing zeros.
    raw : the whole packet, start byte to checksum or signature.
    """

    version: int
    sequence: int
    system_id: int
    component_id: int
    message_id: int
    payload: bytes
    raw: bytes


@dataclass(frozen=True, slots=True)
class FramingCounters:
    """What a framer met since it was made.

    Attributes
    ----------
    packets : returned, `unknown` ones among them.
    garbage_bytes : bytes in no packet: noise, damaged packets, truncated tails.
    bad_crc : damaged packets (a stray start byte counts too; candidates inside a counted one do not).
    unknown : packets of a message the dialect does not know.
    incompatible : packets skipped for an incompatibility flag we do not know.
    truncated : datagrams that end inside a packet.
    untracked : packets of senders beyond `MAX_SENDERS`.
    """

    packets: int = 0
    garbage_bytes: int = 0
    bad_crc: int = 0
    unknown: int = 0
    incompatible: int = 0
    truncated: int = 0
    untracked: int = 0


@dataclass(frozen=True, slots=True)
class SenderCounters:
    """Packets of one (system, component): received, missing by sequence, and come late or twice."""

    received: int
    lost: int
    late: int


class Framer:
    """Frames the datagrams of one direction of one link.

    >>> framer = Framer()
    >>> heartbeat = bytes.fromhex("fd090000cf010100000000000403020c1d0003d978")
    >>> [packet.system_id for packet in framer.packets(b"noise" + heartbeat)]
    [1]
    >>> framer.counters.garbage_bytes
    5
    """

    def __init__(self) -> None:
        self._packets = 0
        self._garbage_bytes = 0
        self._bad_crc = 0
        self._unknown = 0
        self._incompatible = 0
        self._truncated = 0
        self._untracked = 0
        self._senders: dict[int, list[int]] = {}  # sys << 8 | comp -> [newest sequence, received, lost, late]

    def packets(self, data: bytes) -> list[Packet]:
        """Every whole packet in one datagram, in order. Never raises, whatever the bytes.

        Parameters
        ----------
        data : one UDP payload.
        """
        found: list[Packet] = []
        size = len(data)
        position = 0
        garbage = 0
        counted_until = 0  # end of the damaged candidate counted last
        truncated = False
        while position < size:
            start = data[position]
            if start == START_V2:
                header, tail = _HEADER_V2, 2
            elif start == START_V1:
                header, tail = _HEADER_V1, 2
            else:
                position += 1
                garbage += 1
                continue
            body = position + header
            if body > size:
                truncated = True
                position += 1
                garbage += 1
                continue
            flags = 0
            if start == START_V2:
                flags = data[position + 2]
                if flags & SIGNED:
                    tail += SIGNATURE_LENGTH
                sequence, system_id, component_id = data[position + 4], data[position + 5], data[position + 6]
                message_id = data[position + 7] | data[position + 8] << 8 | data[position + 9] << 16
            else:
                sequence, system_id, component_id, message_id = data[position + 2 : body]
            check = body + data[position + 1]
            end = check + tail
            if end > size:
                truncated = True
                position += 1
                garbage += 1
                continue
            crc_extra = _CRC_EXTRA.get(message_id)
            if crc_extra is None:
                good = end == size or data[end] == START_V2 or data[end] == START_V1
            else:
                crc = _crc(crc_extra, _crc(data[position + 1 : check]))
                good = crc == data[check] | data[check + 1] << 8
                if not good and position >= counted_until:
                    self._bad_crc += 1
                    counted_until = end
            if not good:
                position += 1
                garbage += 1
                continue
            truncated = False  # what looked too long so far was a stray start byte
            if flags & ~SIGNED:
                self._incompatible += 1
            else:
                if crc_extra is None:
                    self._unknown += 1
                found.append(
                    Packet(
                        2 if start == START_V2 else 1,
                        sequence,
                        system_id,
                        component_id,
                        message_id,
                        data[body:check],
                        data[position:end],
                    )
                )
                self._follow(system_id << 8 | component_id, sequence)
            position = end
        self._packets += len(found)
        self._garbage_bytes += garbage
        self._truncated += truncated
        return found

    def _follow(self, sender: int, sequence: int) -> None:
        """Count what is missing between the newest packet of this sender and this one."""
        state = self._senders.get(sender)
        if state is None:
            if len(self._senders) >= MAX_SENDERS:
                self._untracked += 1
                return
            self._senders[sender] = [sequence, 1, 0, 0]
            return
        state[1] += 1
        step = (sequence - state[0]) & 0xFF
        if step == 1:
            state[0] = sequence
        elif step == 0:
            state[3] += 1
        elif step > 0xFF - LATE_WINDOW:
            state[3] += 1
            if state[2]:
                state[2] -= 1  # it was counted as lost when a newer one overtook it
        else:
            state[2] += step - 1
            state[0] = sequence

    @property
    def counters(self) -> FramingCounters:
        """A snapshot of the counters."""
        return FramingCounters(
            packets=self._packets,
            garbage_bytes=self._garbage_bytes,
            bad_crc=self._bad_crc,
            unknown=self._unknown,
            incompatible=self._incompatible,
            truncated=self._truncated,
            untracked=self._untracked,
        )

    @property
    def senders(self) -> Mapping[tuple[int, int], SenderCounters]:
        """A snapshot by (system_id, component_id), in order of first appearance."""
        return {
            (sender >> 8, sender & 0xFF): SenderCounters(received=state[1], lost=state[2], late=state[3])
            for sender, state in self._senders.items()
        }
