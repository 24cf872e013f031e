"""A replay answers a ground station that asks for parameters and missions: from what the recording holds.

Parameters come from the PARAM_VALUEs that the vehicle sent, the last of each name, bit for bit (PX4 puts integers into
the bytes of the float); those that were not sent, from the file of them that the recording holds. They are numbered
anew, since a recording seldom holds all of them. The mission is the last
that crossed the wire whole, up or down; or one that is handed over. A message asked for by REQUEST_MESSAGE is the last
that was sent of it. Everything else is denied, with a reason: nothing is obeyed, nothing is changed.

What is answered is ours, with a sequence of its own; the recorded datagrams stay what they were. No socket, no clock.

Sources: https://mavlink.io/en/services/parameter.html, https://mavlink.io/en/services/mission.html,
https://mavlink.io/en/services/ftp.html
"""

import struct
from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from fastcrc import crc16

from logs.parameters import HASH_CHECK, ToldParameters
from logs.reader import RecordedMessage
from logs.secrets import carries_key
from logs.wire_replay import is_autopilot
from wire.datagram import Address
from wire.dialect import mavlink
from wire.framing import Framer, Packet

HASH = HASH_CHECK.encode()
"""PX4's checksum of all parameters: a ground station would believe it knows the rest."""
MAX_WAITING = 20_000
"""Answers waiting at most; more questions are not heard."""
AT_ONCE = 8
"""Answers given at once: a burst would overflow the asker's receive buffer."""
EVERY_US = 4_000
"""Between two such bursts [us]."""
TOLD_US = 1_000_000
"""Between two STATUSTEXTs [us]."""
REFUSAL = "This is a replay: it obeys nothing"

_PARAM = struct.Struct("<4sHH16sB")
_FTP = struct.Struct("<HBBBBBxI")
_FTP_ACK, _FTP_NAK, _FTP_NO_FILE = 128, 129, 10
_FTP_ENDS = {1, 2}  # TerminateSession, ResetSessions


@dataclass(slots=True)
class _Told:
    """What one (system, component) has told of itself."""

    parameters: dict[bytes, tuple[int, bytes, int]] = field(default_factory=dict)  # name -> index, 4 bytes, type
    messages: dict[int, Packet] = field(default_factory=dict)


@dataclass(slots=True)
class _Transfer:
    """A mission crossing the wire."""

    count: int
    items: dict[int, Any] = field(default_factory=dict)


class Answering:
    """Answers in the vehicle's place.

    Parameters
    ----------
    messages : the recording's; gone through once.
    link : toward the vehicle.
    mission : items (MISSION_ITEM_INT objects) to answer with, where none crossed the wire.
    parameters : a .params file, of those who were heard on the link: for what they did not tell on it.

    Attributes
    ----------
    parameters : by (system, component), the names in the order they are told.
    missions : by mission type, its items.
    """

    def __init__(
        self, messages: Iterable[RecordedMessage], link: str, mission: Sequence[Any] = (), parameters: bytes = b""
    ) -> None:
        self._told: dict[tuple[int, int], _Told] = {}
        self._main: tuple[int, int] | None = None
        self.missions: dict[int, list[Any]] = {}
        self._decoder, self._framer = mavlink.MAVLink(None), Framer()
        self._senders: dict[tuple[int, int], Any] = {}
        self._waiting: deque[tuple[bytes, Address]] = deque()
        self._next_us = 0
        self._told_us = -TOLD_US
        self._attached = ToldParameters()
        self._attached.read(parameters)
        self._gather(messages, link)
        self._complete()
        if mission and not self.missions.get(mavlink.MAV_MISSION_TYPE_MISSION):
            self.missions[mavlink.MAV_MISSION_TYPE_MISSION] = list(mission)
        self.parameters: Mapping[tuple[int, int], tuple[bytes, ...]] = {
            who: tuple(sorted(told.parameters, key=lambda name: told.parameters[name][0]))
            for who, told in self._told.items()
            if told.parameters
        }

    @property
    def pending(self) -> bool:
        """Whether there is something left to answer."""
        return bool(self._waiting)

    def receive(self, data: bytes, peer: Address, now_us: int) -> None:
        """Hear a datagram of a ground station's."""
        for packet in self._framer.packets(data):
            answer = _ANSWERS.get(packet.message_id)
            if answer is None or len(self._waiting) >= MAX_WAITING:
                continue
            try:
                question = self._decoder.decode(bytearray(packet.raw))
            except mavlink.MAVError:
                continue
            question.asker = (packet.system_id, packet.component_id)
            for who in self._addressed(question):
                for message in answer(self, who, question):
                    self._say(who, message, peer)
                    if isinstance(message, mavlink.MAVLink_command_ack_message) and message.result:
                        self._refuse(who, peer, now_us)
                    if isinstance(message, mavlink.MAVLink_mission_ack_message) and message.type:
                        self._refuse(who, peer, now_us)

    def take(self, now_us: int) -> list[tuple[bytes, Address]]:
        """What is to be sent now, and to whom."""
        if not self._waiting or now_us < self._next_us:
            return []
        self._next_us = now_us + EVERY_US
        return [self._waiting.popleft() for _ in range(min(AT_ONCE, len(self._waiting)))]

    # What the recording holds.

    def _gather(self, messages: Iterable[RecordedMessage], link: str) -> None:
        framer = Framer()
        transfers: dict[int, _Transfer] = {}
        for message in messages:
            channel = message.channel
            if channel.direction is None or channel.link != link:
                continue
            for packet in framer.packets(message.data):
                if packet.message_id in _MISSION:
                    self._mission(packet, transfers)
                if channel.direction == "rx":
                    self._keep(packet)

    def _keep(self, packet: Packet) -> None:
        who = (packet.system_id, packet.component_id)
        told = self._told.get(who)
        if told is None:
            if len(self._told) >= 256:
                return
            told = self._told[who] = _Told()
        if packet.message_id == mavlink.MAVLINK_MSG_ID_PARAM_VALUE:
            value, _, index, name, kind = _PARAM.unpack(packet.payload.ljust(_PARAM.size, b"\0")[: _PARAM.size])
            name = name.partition(b"\0")[0]
            if name != HASH and len(told.parameters) < 0xFFFF:
                known = told.parameters.get(name)
                if index == 0xFFFF:
                    index = known[0] if known is not None else 0x10000 + len(told.parameters)
                told.parameters[name] = index, value, kind
        elif packet.message_id == mavlink.MAVLINK_MSG_ID_HEARTBEAT:
            self._attached.heard(packet.message_id, *who, packet.payload)  # who packs integers in which way
            if self._main is None:
                self._main = who if is_autopilot(packet, self._decoder) else None
        if packet.message_id not in mavlink.mavlink_map or carries_key(packet.raw):
            return
        if len(told.messages) < 4096:
            told.messages[packet.message_id] = packet

    def _complete(self) -> None:
        """Add the attached parameters to those that were told."""
        for (system, component, name), (value, kind) in self._attached.packed().items():
            told = self._told.get((system, component))
            if told is not None and len(told.parameters) < 0xFFFF:
                told.parameters.setdefault(name.encode(), (0x10000 + len(told.parameters), value, kind))

    def _mission(self, packet: Packet, transfers: dict[int, _Transfer]) -> None:
        """Follow a transfer, in whichever direction; the mission of a type is the last that was whole."""
        message = self._decoder.decode(bytearray(packet.raw))
        kind = message.mission_type
        if packet.message_id == mavlink.MAVLINK_MSG_ID_MISSION_COUNT:
            transfers[kind] = _Transfer(message.count)
            if not message.count:
                self.missions[kind] = []
            return
        transfer = transfers.get(kind)
        if transfer is None or message.seq >= transfer.count:
            return
        transfer.items[message.seq] = message
        if len(transfer.items) == transfer.count:
            self.missions[kind] = [transfer.items[number] for number in range(transfer.count)]

    # What is asked.

    def _addressed(self, question: Any) -> list[tuple[int, int]]:
        """Those of the recording that a question is for."""
        if self._main is None:
            return []
        system, component = question.target_system, question.target_component
        if system not in (0, self._main[0]):
            return [who for who in self._told if who[0] == system and component in (who[1], 0)][:1]
        if component in (0, self._main[1]):
            return [self._main]
        return [who for who in self._told if who == (self._main[0], component)]

    def _say(self, who: tuple[int, int], message: Any, peer: Address) -> None:
        """Frame a message (or its number and payload) as of the vehicle, with our own sequence."""
        mav = self._senders.get(who)
        if mav is None:
            mav = self._senders[who] = mavlink.MAVLink(None, srcSystem=who[0], srcComponent=who[1])
        data = _framed(who, mav.seq, *message) if isinstance(message, tuple) else bytes(message.pack(mav))
        mav.seq = (mav.seq + 1) & 0xFF
        self._waiting.append((data, peer))

    def _refuse(self, who: tuple[int, int], peer: Address, now_us: int) -> None:
        if now_us - self._told_us >= TOLD_US:
            self._told_us = now_us
            text = mavlink.MAVLink_statustext_message(mavlink.MAV_SEVERITY_WARNING, REFUSAL.encode())
            self._say(who, text, peer)

    def _parameter(self, who: tuple[int, int], names: tuple[bytes, ...], number: int) -> tuple[int, bytes]:
        _, value, kind = self._told[who].parameters[names[number]]
        payload = _PARAM.pack(value, len(names), number, names[number], kind)
        return mavlink.MAVLINK_MSG_ID_PARAM_VALUE, payload

    def _list_parameters(self, who: tuple[int, int], question: Any) -> list[Any]:
        names = self.parameters.get(who, ())
        return [self._parameter(who, names, number) for number in range(len(names))]

    def _read_parameter(self, who: tuple[int, int], question: Any) -> list[Any]:
        names = self.parameters.get(who, ())
        number = question.param_index if hasattr(question, "param_index") else -1
        if number < 0:
            name = question.param_id.encode()
            number = names.index(name) if name in names else -1
        return [self._parameter(who, names, number)] if 0 <= number < len(names) else []

    def _list_mission(self, who: tuple[int, int], question: Any) -> list[Any]:
        items = self.missions.get(question.mission_type, [])
        return [mavlink.MAVLink_mission_count_message(*question.asker, len(items), question.mission_type)]

    def _read_mission(self, who: tuple[int, int], question: Any) -> list[Any]:
        items = self.missions.get(question.mission_type, [])
        if not 0 <= question.seq < len(items):
            invalid = mavlink.MAV_MISSION_INVALID_SEQUENCE
            return [mavlink.MAVLink_mission_ack_message(*question.asker, invalid, question.mission_type)]
        item = items[question.seq]
        values = {name: getattr(item, name) for name in item.fieldnames}
        values |= {"target_system": question.asker[0], "target_component": question.asker[1]}
        return [mavlink.MAVLink_mission_item_int_message(**values)]

    def _deny_mission(self, who: tuple[int, int], question: Any) -> list[Any]:
        denied = mavlink.MAV_MISSION_DENIED
        return [mavlink.MAVLink_mission_ack_message(*question.asker, denied, question.mission_type)]

    def _command(self, who: tuple[int, int], question: Any) -> list[Any]:
        result = mavlink.MAV_RESULT_DENIED
        more: list[Any] = []
        if question.command == mavlink.MAV_CMD_REQUEST_MESSAGE:
            number = question.param1  # a float: any, NaN and infinities too; one with a fraction names no message
            wanted = self._told[who].messages.get(number)
            if wanted is not None:
                result, more = mavlink.MAV_RESULT_ACCEPTED, [(wanted.message_id, wanted.payload)]
        system, component = question.asker
        ack = mavlink.MAVLink_command_ack_message(
            question.command, result, target_system=system, target_component=component
        )
        return [ack, *more]

    def _files(self, who: tuple[int, int], question: Any) -> list[Any]:
        """There is no file; a session that was never open is closed."""
        sequence, session, opcode, _, _, _, _ = _FTP.unpack(bytes(question.payload[: _FTP.size]))
        ends = opcode in _FTP_ENDS
        head = _FTP.pack(
            (sequence + 1) & 0xFFFF, session, _FTP_ACK if ends else _FTP_NAK, 0 if ends else 1, opcode, 0, 0
        )
        payload = head if ends else head + bytes((_FTP_NO_FILE,))
        message = mavlink.MAVLink_file_transfer_protocol_message(0, *question.asker, payload.ljust(251, b"\0"))
        return [message]


def _framed(who: tuple[int, int], sequence: int, number: int, payload: bytes) -> bytes:
    """A MAVLink 2 packet round a payload whose bytes must not change on the way."""
    payload = payload.rstrip(b"\0") or payload[:1]
    body = bytes((len(payload), 0, 0, sequence, *who)) + number.to_bytes(3, "little") + payload
    extra = bytes((mavlink.mavlink_map[number].crc_extra,))
    return b"\xfd" + body + crc16.mcrf4xx(extra, crc16.mcrf4xx(body)).to_bytes(2, "little")


_MISSION = {mavlink.MAVLINK_MSG_ID_MISSION_COUNT, mavlink.MAVLINK_MSG_ID_MISSION_ITEM_INT}
_ANSWERS: dict[int, Callable[[Answering, tuple[int, int], Any], list[Any]]] = {
    mavlink.MAVLINK_MSG_ID_PARAM_REQUEST_LIST: Answering._list_parameters,
    mavlink.MAVLINK_MSG_ID_PARAM_REQUEST_READ: Answering._read_parameter,
    mavlink.MAVLINK_MSG_ID_PARAM_SET: Answering._read_parameter,  # told what it is: as it was
    mavlink.MAVLINK_MSG_ID_MISSION_REQUEST_LIST: Answering._list_mission,
    mavlink.MAVLINK_MSG_ID_MISSION_REQUEST_INT: Answering._read_mission,
    mavlink.MAVLINK_MSG_ID_MISSION_REQUEST: Answering._read_mission,
    mavlink.MAVLINK_MSG_ID_MISSION_COUNT: Answering._deny_mission,
    mavlink.MAVLINK_MSG_ID_MISSION_CLEAR_ALL: Answering._deny_mission,
    mavlink.MAVLINK_MSG_ID_COMMAND_LONG: Answering._command,
    mavlink.MAVLINK_MSG_ID_COMMAND_INT: Answering._command,
    mavlink.MAVLINK_MSG_ID_FILE_TRANSFER_PROTOCOL: Answering._files,
}
