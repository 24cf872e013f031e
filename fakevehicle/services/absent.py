"""Services this vehicle does not have yet, each with an answer: a client that is told "none" does not wait.

An unanswered request costs a client dearly (file list 32 s, log list 7.5 s), and an honest "none" costs nothing. What
is refused is also said in words, by `warn`; an empty list is an answer and no refusal. Some clients ask over and over,
so `warn` is expected to keep quiet about what it has just said. One class a service, so that each can make room for a
real one by itself.
"""

import struct
from collections.abc import Callable, Mapping

from fakevehicle.codec import Message
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import Handler, Service
from wire.dialect import mavlink

_FTP_HEADER = struct.Struct("<HBBBBBBI")  # sequence, session, opcode, size, request's opcode, burst done, -, offset
_TERMINATE, _RESET, _LIST, _OPEN_READ, _CRC32, _BURST_READ, _READ = 1, 2, 3, 4, 14, 15, 5
_ACK, _NAK = 128, 129
_END_OF_FILE, _UNKNOWN_COMMAND, _NOT_FOUND, _INVALID_SESSION = 6, 7, 10, 4


class _Absent(Service):
    """A service that is not there.

    Parameters
    ----------
    outbox : where answers go.
    warn : tells people, but not the same thing over and over.
    """

    def __init__(self, outbox: Outbox, warn: Callable[[str], None]) -> None:
        self._outbox = outbox
        self._warn = warn


class NoMissions(_Absent):
    """The mission protocol, of a vehicle without plans."""

    def routes(self) -> Mapping[int, Handler]:
        """Every message of the protocol."""
        m = mavlink
        return {
            m.MAVLINK_MSG_ID_MISSION_REQUEST_LIST: self.request_list,
            m.MAVLINK_MSG_ID_MISSION_COUNT: self.count,
            m.MAVLINK_MSG_ID_MISSION_CLEAR_ALL: self.clear,
            m.MAVLINK_MSG_ID_MISSION_REQUEST: self.request,
            m.MAVLINK_MSG_ID_MISSION_REQUEST_INT: self.request,
            m.MAVLINK_MSG_ID_MISSION_SET_CURRENT: self.request,
            m.MAVLINK_MSG_ID_MISSION_ITEM: self.item,
            m.MAVLINK_MSG_ID_MISSION_ITEM_INT: self.item,
        }

    def request_list(self, sender: Sender, message: Message, _now_us: int) -> None:
        """MISSION_REQUEST_LIST: there are no items."""
        self._outbox.answer(
            sender,
            mavlink.MAVLink_mission_count_message(sender.system_id, sender.component_id, 0, message.mission_type),
        )

    def count(self, sender: Sender, message: Message, _now_us: int) -> None:
        """MISSION_COUNT: an empty plan is accepted, since it is what we have; any other cannot be flown."""
        accepted = message.count == 0
        self._ack(sender, message, mavlink.MAV_MISSION_ACCEPTED if accepted else mavlink.MAV_MISSION_UNSUPPORTED)
        if not accepted:
            self._warn("Mission refused: this vehicle flies no missions")

    def clear(self, sender: Sender, message: Message, _now_us: int) -> None:
        """MISSION_CLEAR_ALL: nothing is left."""
        self._ack(sender, message, mavlink.MAV_MISSION_ACCEPTED)

    def request(self, sender: Sender, message: Message, _now_us: int) -> None:
        """MISSION_REQUEST, MISSION_REQUEST_INT, MISSION_SET_CURRENT: no item has any number."""
        self._ack(sender, message, mavlink.MAV_MISSION_INVALID_SEQUENCE)
        self._warn("Mission item refused: there are none")

    def item(self, sender: Sender, message: Message, _now_us: int) -> None:
        """MISSION_ITEM, MISSION_ITEM_INT: nobody asked for one."""
        self._ack(sender, message, mavlink.MAV_MISSION_UNSUPPORTED)
        self._warn("Mission refused: this vehicle flies no missions")

    def _ack(self, sender: Sender, message: Message, result: int) -> None:
        kind = getattr(message, "mission_type", 0)  # MISSION_SET_CURRENT has none
        self._outbox.answer(
            sender, mavlink.MAVLink_mission_ack_message(sender.system_id, sender.component_id, result, kind)
        )


class NoLogs(_Absent):
    """The log protocol, of a vehicle that keeps none."""

    def routes(self) -> Mapping[int, Handler]:
        """List and data."""
        return {
            mavlink.MAVLINK_MSG_ID_LOG_REQUEST_LIST: self.request_list,
            mavlink.MAVLINK_MSG_ID_LOG_REQUEST_DATA: self.request_data,
        }

    def request_list(self, sender: Sender, _message: Message, _now_us: int) -> None:
        """LOG_REQUEST_LIST: no logs."""
        self._outbox.answer(sender, mavlink.MAVLink_log_entry_message(0, 0, 0, 0, 0))

    def request_data(self, sender: Sender, message: Message, _now_us: int) -> None:
        """LOG_REQUEST_DATA: the end of whatever was asked for."""
        self._outbox.answer(sender, mavlink.MAVLink_log_data_message(message.id, message.ofs, 0, bytes(90)))


class NoShell(_Absent):
    """SERIAL_CONTROL, of a vehicle without a shell."""

    def routes(self) -> Mapping[int, Handler]:
        """The one message."""
        return {mavlink.MAVLINK_MSG_ID_SERIAL_CONTROL: self.serial_control}

    def serial_control(self, sender: Sender, message: Message, _now_us: int) -> None:
        """SERIAL_CONTROL: no shell."""
        if message.flags & mavlink.SERIAL_CONTROL_FLAG_REPLY:
            return
        reply = mavlink.MAVLink_serial_control_message(
            message.device, mavlink.SERIAL_CONTROL_FLAG_REPLY, 0, 0, 0, bytes(70)
        )
        self._outbox.answer(sender, reply)
        self._warn("Shell refused: this vehicle has none")


class NoFiles(_Absent):
    """FTP, of a vehicle that keeps no files."""

    def routes(self) -> Mapping[int, Handler]:
        """The one message."""
        return {mavlink.MAVLINK_MSG_ID_FILE_TRANSFER_PROTOCOL: self.file_transfer}

    def file_transfer(self, sender: Sender, message: Message, _now_us: int) -> None:
        """FILE_TRANSFER_PROTOCOL: every folder is empty and no file is found."""
        raw = bytes(message.payload)
        sequence, session, opcode, _, _, _, _, offset = _FTP_HEADER.unpack_from(raw)
        if opcode in (_ACK, _NAK):
            return
        if opcode in (_TERMINATE, _RESET):
            kind, data = _ACK, b""
        elif opcode == _LIST:
            kind, data = _NAK, bytes([_END_OF_FILE])
        elif opcode in (_OPEN_READ, _CRC32):
            kind, data = _NAK, bytes([_NOT_FOUND])
            self._warn("File refused: this vehicle keeps none")
        elif opcode in (_READ, _BURST_READ):
            kind, data = _NAK, bytes([_INVALID_SESSION])
            self._warn("File refused: it was never opened")
        else:
            kind, data = _NAK, bytes([_UNKNOWN_COMMAND])
            self._warn("File operation refused: files can only be listed")
        header = _FTP_HEADER.pack((sequence + 1) & 0xFFFF, session, kind, len(data), opcode, 0, 0, offset)
        payload = (header + data).ljust(251, b"\0")
        self._outbox.answer(
            sender, mavlink.MAVLink_file_transfer_protocol_message(0, sender.system_id, sender.component_id, payload)
        )
