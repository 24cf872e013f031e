"""PING and TIMESYNC: answered at once, so that peers can measure the link and our clock."""

from collections.abc import Mapping

from fakevehicle.codec import Message
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import Handler, Service
from wire.dialect import mavlink


class Timing(Service):
    """Answers both."""

    def __init__(self, outbox: Outbox) -> None:
        self._outbox = outbox

    def routes(self) -> Mapping[int, Handler]:
        """PING and TIMESYNC."""
        return {mavlink.MAVLINK_MSG_ID_PING: self.ping, mavlink.MAVLINK_MSG_ID_TIMESYNC: self.timesync}

    def ping(self, sender: Sender, message: Message, _now_us: int) -> None:
        """Send a request (target 0, 0) back with its time and sequence; a response meant for us needs no answer."""
        if message.target_system == 0 and message.target_component == 0:
            self._outbox.answer(
                sender,
                mavlink.MAVLink_ping_message(message.time_usec, message.seq, sender.system_id, sender.component_id),
            )

    def timesync(self, sender: Sender, message: Message, now_us: int) -> None:
        """Answer a request (tc1 = 0) with our time since boot [ns]."""
        if message.tc1 == 0:
            self._outbox.answer(sender, mavlink.MAVLink_timesync_message(now_us * 1000, message.ts1))
