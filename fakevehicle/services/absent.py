"""Services this vehicle does not have yet, each with an answer: a client that is told "none" does not wait.

An unanswered request costs a client dearly (seconds, often many), and an honest "none" costs nothing. What
is refused is also said in words, by `warn`; an empty list is an answer and no refusal. Some clients ask over and over,
so `warn` is expected to keep quiet about what it has just said. One class a service, so that each can make room for a
real one by itself.
"""

from collections.abc import Callable, Mapping

from fakevehicle.codec import Message
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import Handler, Service
from wire.dialect import mavlink


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
