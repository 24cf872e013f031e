"""PING and TIMESYNC: answered at once, so that peers can measure the link and our clock."""

from fakevehicle.codec import Message
from fakevehicle.services.outbox import Outbox, Sender
from wire.dialect import mavlink


def ping(outbox: Outbox, sender: Sender, message: Message) -> None:
    """Send a request (target 0, 0) back with its time and sequence; a response meant for us needs no answer."""
    if message.target_system == 0 and message.target_component == 0:
        outbox.answer(
            sender,
            mavlink.MAVLink_ping_message(message.time_usec, message.seq, sender.system_id, sender.component_id),
        )


def timesync(outbox: Outbox, sender: Sender, message: Message, now_us: int) -> None:
    """Answer a request (tc1 = 0) with our time since boot [ns]."""
    if message.tc1 == 0:
        outbox.answer(sender, mavlink.MAVLink_timesync_message(now_us * 1000, message.ts1))
