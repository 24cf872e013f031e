"""The parameter service: list, read, set, as PX4 does it.

INT32 values travel as their four bytes inside the float field (MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE), so that
-1 looks like NaN. `_HASH_CHECK` (index 65535) is a checksum over all of them, with which a ground station skips
the download. Unlike PX4 the vehicle is never silent: an unknown name gets PARAM_ERROR and a text.
"""

import math
import struct
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from fakevehicle.codec import Message
from fakevehicle.params import ParameterSet, ParameterType
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import Handler, Service
from wire.dialect import mavlink

HASH_NAME = "_HASH_CHECK"
NO_INDEX = HASH_INDEX = 65535
PER_TICK = 4
"""PARAM_VALUE messages a tick and download: about a thousand a second."""
MAX_DOWNLOADS = 8
NOT_FOUND = mavlink.MAV_PARAM_ERROR_DOES_NOT_EXIST


@dataclass(slots=True)
class _Download:
    sender: Sender
    next_index: int


class Parameters(Service):
    """Answers PARAM_REQUEST_LIST, PARAM_REQUEST_READ and PARAM_SET.

    Parameters
    ----------
    parameters : the vehicle's.
    outbox : where answers go.
    read_only : names that are fixed for the vehicle's life.
    warn : tells people (a STATUSTEXT).
    bytewise : PX4's way, see the module's text. Otherwise ArduPilot's: an integer is the float nearest to it, a value
        for one is cut to it whatever type was given, there is no hash, and no index but in a list.
    """

    def __init__(
        self,
        parameters: ParameterSet,
        outbox: Outbox,
        read_only: frozenset[str],
        warn: Callable[[str], None],
        *,
        bytewise: bool = True,
    ) -> None:
        self._bytewise = bytewise
        self._parameters = parameters
        self._outbox = outbox
        self._read_only = read_only
        self._warn = warn
        self._downloads: list[_Download] = []

    def routes(self) -> Mapping[int, Handler]:
        """List, read and set."""
        return {
            mavlink.MAVLINK_MSG_ID_PARAM_REQUEST_LIST: self.request_list,
            mavlink.MAVLINK_MSG_ID_PARAM_REQUEST_READ: self.request_read,
            mavlink.MAVLINK_MSG_ID_PARAM_SET: self.set,
        }

    def request_list(self, sender: Sender, _message: Message, _now_us: int) -> None:
        """Begin a download, or begin it again."""
        self._downloads = [d for d in self._downloads if d.sender != sender]
        if len(self._downloads) >= MAX_DOWNLOADS:
            self._warn(f"Parameters: {MAX_DOWNLOADS} downloads are running, ask again later")
            return
        self._downloads.append(_Download(sender, 0))

    def request_read(self, sender: Sender, message: Message, _now_us: int) -> None:
        """One parameter by name, or by index where that is not -1."""
        if message.param_index < 0 and message.param_id == HASH_NAME and self._bytewise:
            self._outbox.answer(sender, self._hash_message())
            return
        try:
            by_index = message.param_index >= 0
            name = self._parameters.name_at(message.param_index) if by_index else message.param_id
            self._outbox.answer(sender, self.message(name, indexed=by_index or self._bytewise))
        except (KeyError, IndexError):
            self._refuse(sender, message.param_id, message.param_index, NOT_FOUND, "no such parameter")

    def set(self, sender: Sender, message: Message, _now_us: int) -> None:
        """Set and echo; a refusal names the reason and sends the value that stands."""
        name = message.param_id
        if name == HASH_NAME:  # a ground station says that its copy is good: the download can end
            self._downloads = [d for d in self._downloads if d.sender != sender]
            return
        if name not in self._parameters:
            self._refuse(sender, name, -1, NOT_FOUND, "no such parameter")
            return
        kind = self._parameters.describe(name).type
        if message.param_type != kind.value and self._bytewise:
            reason = f"type {message.param_type}, expected {kind.value} ({kind.name})"
            self._refuse(sender, name, -1, mavlink.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE, reason)
        elif name in self._read_only:
            self._refuse(sender, name, -1, mavlink.MAV_PARAM_ERROR_READ_ONLY, "fixed at the start")
        else:
            value = message.param_value
            if kind is ParameterType.INT32:
                value = _int_from(value) if self._bytewise else _cut(value)
            try:
                self._parameters.set(name, value)
            except ValueError as error_:
                self._refuse(sender, name, -1, mavlink.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE, str(error_))
        self._outbox.broadcast(sender.link, self.message(name, indexed=self._bytewise))

    def step(self, now_us: int) -> None:
        """Send the next few values of each running download."""
        for download in self._downloads:
            end = min(download.next_index + PER_TICK, len(self._parameters))
            for index in range(download.next_index, end):
                self._outbox.answer(download.sender, self.message(self._parameters.name_at(index)))
            download.next_index = end
            if end == len(self._parameters) and self._bytewise:
                self._outbox.answer(download.sender, self._hash_message())
        if self._downloads:
            self._downloads = [d for d in self._downloads if d.next_index < len(self._parameters)]

    def message(self, name: str, *, indexed: bool = True) -> Message:
        """PARAM_VALUE of one parameter, with its index or none; KeyError when there is none of that name."""
        p = self._parameters
        value = p[name]
        kind = p.describe(name).type
        as_float = _float_from(int(value)) if kind is ParameterType.INT32 and self._bytewise else float(value)
        index = p.index(name) if indexed else NO_INDEX
        return mavlink.MAVLink_param_value_message(name.encode("ascii"), as_float, kind.value, len(p), index)

    def hash(self) -> int:
        """CRC-32 over every name and value in order, as PX4's param_hash_check: no inversion at either end."""
        crc = 0
        for name in self._parameters:
            kind = self._parameters.describe(name).type
            value = self._parameters[name]
            raw = struct.pack("<f", value) if kind is ParameterType.REAL32 else struct.pack("<i", int(value))
            for part in (name.encode("ascii"), raw):
                crc = zlib.crc32(part, crc ^ 0xFFFFFFFF) ^ 0xFFFFFFFF
        return crc

    def _hash_message(self) -> Message:
        value = struct.unpack("<f", struct.pack("<I", self.hash()))[0]
        return mavlink.MAVLink_param_value_message(
            HASH_NAME.encode("ascii"), value, mavlink.MAV_PARAM_TYPE_UINT32, len(self._parameters), HASH_INDEX
        )

    def _refuse(self, sender: Sender, name: str, index: int, error: int, reason: str) -> None:
        what = name if name else f"index {index}"
        self._outbox.answer(
            sender,
            mavlink.MAVLink_param_error_message(
                sender.system_id, sender.component_id, name.encode("ascii", "replace")[:16], index, error
            ),
        )
        self._warn(f"Parameter {what}: {reason.removeprefix(f'{name}: ')}")


def _float_from(value: int) -> float:
    """The float whose four bytes are those of an int32."""
    as_float: float = struct.unpack("<f", struct.pack("<i", value))[0]
    return as_float


def _cut(value: float) -> float:
    """Without its fraction, as a cast in C; not finite stays so."""
    return float(int(value)) if math.isfinite(value) else value


def _int_from(value: float) -> int:
    """Inverse of `_float_from`."""
    as_int: int = struct.unpack("<i", struct.pack("<f", value))[0]
    return as_int
