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
