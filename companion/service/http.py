"""The service's page on this machine: `/` to read, `/state.json` for programs, `/health` and `/ready` for watchdogs.

Served from a thread of its own, which only hands out what the flight loop left in a `Board`; there is nothing to send
here that would change a flight.
"""

import json
import socket
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from companion.errors import LinkError
from companion.service.page import render

STALE_S = 2.0
"""What a loop has not put up again for so long is not its state any more."""
HUNG_S = 15.0
"""A loop that has put up nothing for so long does not turn any more: whoever looks after the process may restart it.
Compiling kernels the first time may take seconds."""
TIMEOUT_S = 5.0
MOST_THREADS = 16
HOSTS = ("127.0.0.1", "localhost", "[::1]")


class Board:
    """Where the flight loop puts up its state."""

    def __init__(self) -> None:
        self._state: dict[str, Any] = {}
        self._at_s = -1e9

    def put(self, state: dict[str, Any]) -> None:
        """Put up a state; it must not be changed afterwards."""
        self._state, self._at_s = state, time.monotonic()

    def state(self) -> dict[str, Any]:
        """What is up now."""
        return self._state

    def hung(self) -> str:
        """Why the process is of no use any more, or nothing. A vehicle that is not there is no reason."""
        return "the loop hangs" if time.monotonic() - self._at_s > HUNG_S else ""

    def not_ready(self) -> str:
        """Why no vehicle can be flown or watched just now, or nothing."""
        if time.monotonic() - self._at_s > STALE_S:
            return f"the loop has not shown its state for {STALE_S:g} s"
        return "" if self._state.get("vehicle", {}).get("heard") else "the vehicle is not heard"


@contextmanager
def served(place: tuple[str, int], board: Board) -> Iterator[tuple[str, int]]:
    """Serve the board as long as this lasts; yields where.

    Raises
    ------
    LinkError : the port is taken.
    """
    family = socket.AF_INET6 if ":" in place[0] else socket.AF_INET
    server_class = type("Server", (_Server,), {"board": board, "address_family": family})
    try:
        server = server_class(place, _Handler)
    except OSError as error:
        raise LinkError(f"http {place[0]}:{place[1]}: {error.strerror or error}") from error
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.2}, name="http", daemon=True)
    thread.start()
    try:
        yield server.server_address[0], server.server_address[1]
    finally:
        server.shutdown()
        server.server_close()
        thread.join(TIMEOUT_S)


class _Server(ThreadingHTTPServer):
    board: Board
    daemon_threads = True
    _busy = threading.BoundedSemaphore(MOST_THREADS)

    def process_request(self, request: Any, client_address: Any) -> None:
        if not self._busy.acquire(blocking=False):
            self.shutdown_request(request)
            return
        super().process_request(request, client_address)

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._busy.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A reader that goes away is nobody's trouble."""


class _Handler(BaseHTTPRequestHandler):
    server: _Server
    timeout = TIMEOUT_S
    server_version, sys_version = "companion", ""

    def do_GET(self) -> None:
        host = self.headers.get("Host", "").rsplit(":", 1)[0] if self.headers.get("Host") != "[::1]" else "[::1]"
        if host not in HOSTS:
            self._answer(HTTPStatus.FORBIDDEN, "text/plain", b"this page is for this machine only\n")
            return
        match self.path.partition("?")[0]:
            case "/":
                page = render(self.server.board.state(), self.server.board.not_ready())
                self._answer(HTTPStatus.OK, "text/html", page.encode())
            case "/state.json":
                self._answer(HTTPStatus.OK, "application/json", _json(self.server.board.state()))
            case "/health":
                self._judge(self.server.board.hung())
            case "/ready":
                self._judge(self.server.board.not_ready())
            case _:
                self._answer(HTTPStatus.NOT_FOUND, "text/plain", b"there are /, /state.json, /health and /ready\n")

    do_HEAD = do_GET

    def _judge(self, reason: str) -> None:
        status = HTTPStatus.SERVICE_UNAVAILABLE if reason else HTTPStatus.OK
        self._answer(status, "application/json", _json({"ok": not reason, "reason": reason or None}))

    def _answer(self, status: HTTPStatus, kind: str, body: bytes) -> None:
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Cache-Control", "no-store")
        self.send_header("X-Content-Type-Options", "nosniff")
        policy = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'"
        self.send_header("Content-Security-Policy", policy)
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def log_message(self, format: str, *args: Any) -> None:
        """The log is for flights."""


def _json(value: Mapping[str, Any]) -> bytes:
    return json.dumps(value, indent=2, allow_nan=False).encode() + b"\n"
