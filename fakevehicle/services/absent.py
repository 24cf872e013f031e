"""Services this vehicle does not have yet, each with an answer: a client that is told "none" does not wait.

An unanswered request costs a client dearly (seconds, often many), and an honest "none" costs nothing. What
is refused is also said in words; an empty list is an answer and no refusal. One class a service, so that each can make
room for a real one by itself.
"""

from collections.abc import Mapping

from fakevehicle.codec import Message
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import Handler, Service
from fakevehicle.services.words import Words
from wire.dialect import mavlink


class _Absent(Service):
    """A service that is not there.

    Parameters
    ----------
    outbox : where answers go.
    refuse : puts a refusal into words.
    """

    def __init__(self, outbox: Outbox, refuse: Words) -> None:
        self._outbox = outbox
        self._refuse = refuse


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
        self._refuse(sender, "Shell refused: this vehicle has none")
