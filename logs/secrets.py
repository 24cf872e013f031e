"""What must not stand in a recording: the key of SETUP_SIGNING (https://mavlink.io/en/guide/message_signing.html).

The key's bytes are written as zeros, and where the packet's checksum was right it is made right again. So what is
recorded is a whole packet with nothing in it, and a re-run, which is fed that packet, routes it as the flight did. It
is not the packet that was sent, and must never be sent to anybody: an all-zero key would be taken as the key.
"""

import re

from fastcrc import crc16

from wire.dialect import mavlink

SETUP_SIGNING = 256
_NUMBER = SETUP_SIGNING.to_bytes(3, "little")
# Start byte, a length that reaches into the key, one of the flags there are, and the message's number.
_PACKET = re.compile(rb"\xfd[\x0b-\xff][\x00\x01]....\x00\x01\x00", re.DOTALL)
_HEADER = 10
_KEY_AT, _KEY_BYTES = 10, 32  # behind initial_timestamp, target_system, target_component
_EXTRA = bytes((mavlink.mavlink_map[SETUP_SIGNING].crc_extra,))


def masked(data: bytes) -> bytes:
    """A datagram without the keys in it; the same object where there is none.

    A packet that is cut off or damaged still holds its key, so what looks like one is enough. Masking twice changes
    nothing more.
    """
    if _NUMBER not in data:
        return data
    out: bytearray | None = None
    for match in _PACKET.finditer(data):
        start = match.start()
        key, end = start + _HEADER + _KEY_AT, start + _HEADER + data[start + 1]
        stop = min(end, key + _KEY_BYTES, len(data))
        if stop <= key:
            continue
        out = bytearray(data) if out is None else out
        whole = end + 2 <= len(out)
        right = whole and bytes(out[end : end + 2]) == _checksum(bytes(out[start + 1 : end]))
        out[key:stop] = bytes(stop - key)
        if right:
            out[end : end + 2] = _checksum(bytes(out[start + 1 : end]))
    return data if out is None else bytes(out)


def carries_key(data: bytes) -> bool:
    """Whether a datagram holds what looks like SETUP_SIGNING, its key masked or not: not for anybody's ears."""
    return _NUMBER in data and _PACKET.search(data) is not None


def _checksum(body: bytes) -> bytes:
    return crc16.mcrf4xx(_EXTRA, crc16.mcrf4xx(body)).to_bytes(2, "little")
