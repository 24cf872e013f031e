"""What the service tells systemd: that it is ready, that its loop turns, and what it does.

The protocol is one datagram a message to the socket that NOTIFY_SOCKET names (sd_notify(3), sd_watchdog_enabled(3));
without that variable nothing is sent. A datagram that does not get through is dropped: a flight never waits for it.
"""

import os
import socket
from collections.abc import Mapping
from contextlib import suppress

from companion.drivers.tick import Tick

SHARE = 4
"""So many times in the watchdog's period it is told that the loop turns; systemd advises two at least."""


class Systemd:
    """Speaks to systemd, if it is there. As a tap it tells that the loop turns.

    Parameters
    ----------
    environment : of the process, with NOTIFY_SOCKET and, where there is a watchdog, WATCHDOG_USEC and WATCHDOG_PID.
    """

    def __init__(self, environment: Mapping[str, str]) -> None:
        path = environment.get("NOTIFY_SOCKET", "")
        self._address = "\0" + path[1:] if path.startswith("@") else path
        period, pid = environment.get("WATCHDOG_USEC", ""), environment.get("WATCHDOG_PID", str(os.getpid()))
        ours = period.isascii() and period.isdigit() and pid == str(os.getpid())
        self._every_us = max(1, int(period) // SHARE) if ours else None
        self._alive_us: int | None = None
        self._status = ""

    def __call__(self, tick: Tick) -> None:
        """A tap: the loop turns."""
        if self._every_us is None:
            return
        if self._alive_us is None or not 0 <= tick.now_us - self._alive_us < self._every_us:
            self._alive_us = tick.now_us
            self._send("WATCHDOG=1")

    def ready(self) -> None:
        """The ports are open and the loop is about to turn."""
        self._send("READY=1")

    def status(self, text: str) -> None:
        """One line for `systemctl status`; said when it is another one than before."""
        if text != self._status:
            self._status = text
            self._send("STATUS=" + text.replace("\n", " "))

    def stopping(self) -> None:
        """The service comes to its end."""
        self._send("STOPPING=1")

    def _send(self, text: str) -> None:
        if self._address:
            with suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as speaker:
                speaker.setblocking(False)
                speaker.sendto(text.encode(), self._address)
