"""Services this vehicle does not have yet, each with an answer: a client that is told "none" does not wait.

An unanswered request costs a client dearly (file list 32 s, log list 7.5 s), and an honest "none" costs nothing. What
is refused is also said in words, by `warn`; an empty list is an answer and no refusal. Some clients ask over and over,
so `warn` is expected to keep quiet about what it has just said.
"""

import struct
from collections.abc import Callable

from fakevehicle.codec import Message
from fakevehicle.services.outbox import Outbox, Sender
from wire.dialect import mavlink

_FTP_HEADER = struct.Struct("<HBBBBBBI")  # sequence, session, opcode, size, request's opcode, burst done, -, offset
_TERMINATE, _RESET, _LIST, _OPEN_READ, _CRC32, _BURST_READ, _READ = 1, 2, 3, 4, 14, 15, 5
_ACK, _NAK = 128, 129
_END_OF_FILE, _UNKNOWN_COMMAND, _NOT_FOUND, _INVALID_SESSION = 6, 7, 10, 4


def mission_list(outbox: Outbox, sender: Sender, message: Message) -> None:
    """MISSION_REQUEST_LIST: there are no items."""
    outbox.answer(
        sender, mavlink.MAVLink_mission_count_message(sender.system_id, sender.component_id, 0, message.mission_type)
    )


def mission_count(outbox: Outbox, sender: Sender, message: Message, warn: Callable[[str], None]) -> None:
    """MISSION_COUNT: an empty plan is accepted, since it is what we have; any other cannot be flown."""
    accepted = message.count == 0
    result = mavlink.MAV_MISSION_ACCEPTED if accepted else mavlink.MAV_MISSION_UNSUPPORTED
    _mission_ack(outbox, sender, message, result)
    if not accepted:
        warn("Mission refused: this vehicle flies no missions")


def mission_clear(outbox: Outbox, sender: Sender, message: Message) -> None:
    """MISSION_CLEAR_ALL: nothing is left."""
    _mission_ack(outbox, sender, message, mavlink.MAV_MISSION_ACCEPTED)


def mission_request(outbox: Outbox, sender: Sender, message: Message, warn: Callable[[str], None]) -> None:
    """MISSION_REQUEST, MISSION_REQUEST_INT, MISSION_SET_CURRENT: no item has any number."""
    _mission_ack(outbox, sender, message, mavlink.MAV_MISSION_INVALID_SEQUENCE)
    warn("Mission item refused: there are none")


def mission_item(outbox: Outbox, sender: Sender, message: Message, warn: Callable[[str], None]) -> None:
    """MISSION_ITEM, MISSION_ITEM_INT: nobody asked for one."""
    _mission_ack(outbox, sender, message, mavlink.MAV_MISSION_UNSUPPORTED)
    warn("Mission refused: this vehicle flies no missions")


def _mission_ack(outbox: Outbox, sender: Sender, message: Message, result: int) -> None:
    kind = getattr(message, "mission_type", 0)  # MISSION_SET_CURRENT has none
    outbox.answer(sender, mavlink.MAVLink_mission_ack_message(sender.system_id, sender.component_id, result, kind))


def log_list(outbox: Outbox, sender: Sender, _message: Message) -> None:
    """LOG_REQUEST_LIST: no logs."""
    outbox.answer(sender, mavlink.MAVLink_log_entry_message(0, 0, 0, 0, 0))


def log_data(outbox: Outbox, sender: Sender, message: Message) -> None:
    """LOG_REQUEST_DATA: the end of whatever was asked for."""
    outbox.answer(sender, mavlink.MAVLink_log_data_message(message.id, message.ofs, 0, bytes(90)))


def serial_control(outbox: Outbox, sender: Sender, message: Message, warn: Callable[[str], None]) -> None:
    """SERIAL_CONTROL: no shell."""
    if message.flags & mavlink.SERIAL_CONTROL_FLAG_REPLY:
        return
    reply = mavlink.MAVLink_serial_control_message(
        message.device, mavlink.SERIAL_CONTROL_FLAG_REPLY, 0, 0, 0, bytes(70)
    )
    outbox.answer(sender, reply)
    warn("Shell refused: this vehicle has none")


def file_transfer(outbox: Outbox, sender: Sender, message: Message, warn: Callable[[str], None]) -> None:
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
        warn("File refused: this vehicle keeps none")
    elif opcode in (_READ, _BURST_READ):
        kind, data = _NAK, bytes([_INVALID_SESSION])
        warn("File refused: it was never opened")
    else:
        kind, data = _NAK, bytes([_UNKNOWN_COMMAND])
        warn("File operation refused: files can only be listed")
    header = _FTP_HEADER.pack((sequence + 1) & 0xFFFF, session, kind, len(data), opcode, 0, 0, offset)
    payload = (header + data).ljust(251, b"\0")
    outbox.answer(
        sender, mavlink.MAVLink_file_transfer_protocol_message(0, sender.system_id, sender.component_id, payload)
    )
